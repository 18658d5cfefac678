//! Slices, distances, the ghost and standard views.

words! {
    /// The slices beside the picture.
    Slices {
        axial: "Axial", "Axial", "Axial", "横断面";
        coronal: "Coronal", "Koronal", "Coronal", "冠状面";
        sagittal: "Sagittal", "Sagittal", "Sagital", "矢状面";
        picture: "Picture", "Bild", "Imagen", "图像";
        pane: "View", "Ansicht", "Vista", "视图";
        slice: "{0} slice", "Schnitt {0}", "Corte {0}", "{0}切片";
        position: "{0} position", "Lage {0}", "Posición {0}", "{0}位置";
        value: "value {0}", "Wert {0}", "valor {0}", "数值 {0}";
        nothing: "nothing", "nichts", "nada", "空";
        show: "Slices beside the picture", "Schnitte neben dem Bild", "Cortes junto a la imagen", "在图像旁显示切片";
        hide: "The picture without slices", "Das Bild ohne Schnitte", "La imagen sin cortes", "隐藏切片";
        expand: "{0} alone", "Nur {0}", "Solo {0}", "仅{0}";
        all: "All four views", "Alle vier Ansichten", "Las cuatro vistas", "四个视图";
        colours: "Slices in colour", "Schnitte in Farbe", "Cortes en color", "彩色切片";
        greys: "Slices in grey", "Schnitte in Grau", "Cortes en gris", "灰度切片";
        move_template: "Move {0} in the slice", "{0} im Schnitt verschieben", "Mover {0} en el corte", "在切片中移动{0}";
        ghost_show: "Compare with the original", "Mit dem Original vergleichen", "Comparar con el original", "与原始状态对比";
        ghost_hide: "End the comparison", "Vergleich beenden", "Terminar la comparación", "结束对比";
        wires_show: "Edges of the triangles", "Kanten der Dreiecke", "Aristas de los triángulos", "显示三角形的边";
        wires_hide: "Hide the edges of the triangles", "Kanten der Dreiecke ausblenden", "Ocultar las aristas de los triángulos", "隐藏三角形的边";
        measure: "Measure distances", "Abstände messen", "Medir distancias", "测量距离";
        measure_end: "End measuring", "Messen beenden", "Terminar de medir", "结束测量";
        measure_hint: "Choose two points", "Zwei Punkte wählen", "Elija dos puntos", "选择两点";
        measure_remove: "Remove distance {0}", "Abstand {0} entfernen", "Quitar la distancia {0}", "移除距离 {0}";
        mm: "{0} mm", "{0} mm", "{0} mm", "{0} 毫米";
        distance_n: "Distance {0}: {1}", "Abstand {0}: {1}", "Distancia {0}: {1}", "距离 {0}：{1}";
        views: "Standard views", "Standardansichten", "Vistas estándar", "标准视图";
        amount: "Overall", "Insgesamt", "Total", "总体";
        amount_hint: "From closed to what is set below", "Von geschlossen bis zu dem, was unten eingestellt ist", "De cerrado a lo que se indica abajo", "从闭合到下方设置的程度";
        key_slices: "Slices", "Schnitte", "Cortes", "切片";
        key_ghost: "Compare with the original", "Mit dem Original vergleichen", "Comparar con el original", "与原始状态对比";
        key_wires: "Edges of a mesh's triangles", "Kanten der Dreiecke eines Netzes", "Aristas de los triángulos de una malla", "网格三角形的边";
        key_level: "Window and level: drag over a slice", "Fenster und Lage: über einen Schnitt ziehen", "Ventana y nivel: arrastrar sobre un corte", "窗宽窗位：在切片上拖动";
        level_drag: "Right drag over a slice, two fingers", "Rechts über einen Schnitt ziehen, zwei Finger", "Arrastrar con el derecho sobre un corte, dos dedos", "在切片上右键拖动、双指";
        level_does: "Window (right, left) and level (up, down)", "Fenster (rechts, links) und Lage (auf, ab)", "Ventana (derecha, izquierda) y nivel (arriba, abajo)", "窗宽（左右）与窗位（上下）";
        key_measure: "Measure", "Messen", "Medir", "测量";
    }
}
