//! The panel of colours and background.

words! {
    /// The panel of colours and background.
    Look {
        heading: "Look", "Aussehen", "Aspecto", "外观";
        colours: "Colours", "Farben", "Colores", "颜色";
        colours_hint: "Which values are seen, in which colour", "Welche Werte man sieht, und in welcher Farbe", "Qué valores se ven y de qué color", "显示哪些数值，用什么颜色";
        preset_hint: "{0}: this scan in these colours", "{0}: dieser Scan in diesen Farben", "{0}: este estudio con estos colores", "{0}：以这些颜色显示此扫描";
        automatic: "Automatic", "Automatisch", "Automático", "自动";
        automatic_is: "Automatic ({0})", "Automatisch ({0})", "Automático ({0})", "自动（{0}）";
        any_scan: "scan", "Scan", "estudio", "扫描";
        own_points: "Custom ({0} points)", "Eigene ({0} Punkte)", "Propios ({0} puntos)", "自定义（{0} 个点）";
        colour_n: "Colour {0}", "Farbe {0}", "Color {0}", "颜色 {0}";
        value_n: "Value {0}", "Wert {0}", "Valor {0}", "数值 {0}";
        opacity_n: "Opacity {0}", "Deckkraft {0}", "Opacidad {0}", "不透明度 {0}";
        value: "Value", "Wert", "Valor", "数值";
        opacity_hint: "Opacity of 0.01 subject units", "Deckkraft von 0,01 Objekteinheiten", "Opacidad de 0,01 unidades del objeto", "0.01 对象单位的不透明度";
        remove_point: "Remove point {0}", "Punkt {0} entfernen", "Quitar el punto {0}", "移除点 {0}";
        add_point: "Add a point", "Punkt hinzufügen", "Añadir un punto", "添加点";
        window: "Window", "Fenster", "Ventana", "窗宽窗位";
        window_hint: "The values over which a preset's colours are spread, and the grey of slices", "Die Werte, über die sich die Farben einer Vorlage und das Grau der Schnitte verteilen", "Los valores entre los que se reparten los colores de un ajuste y el gris de los cortes", "预设颜色和切片灰度所覆盖的数值范围";
        window_from: "Window from", "Fenster von", "Ventana desde", "窗口下限";
        window_to: "Window to", "Fenster bis", "Ventana hasta", "窗口上限";
        reset_window: "Reset window", "Fenster zurücksetzen", "Restablecer la ventana", "重置窗口";
        opacity_heading: "Opacity of stretched tissue", "Deckkraft von gedehntem Gewebe", "Opacidad del tejido estirado", "拉伸组织的不透明度";
        opacity: "Opacity", "Deckkraft", "Opacidad", "不透明度";
        surfaces: "Keep surfaces", "Flächen erhalten", "Conservar superficies", "保持表面";
        mass: "Keep mass", "Masse erhalten", "Conservar masa", "保持质量";
        as_it_is: "Unchanged", "Unverändert", "Sin cambios", "不变";
        surfaces_hint: "A stretched surface stays as opaque as it was.", "Eine gedehnte Fläche bleibt so deckend, wie sie war.", "Una superficie estirada sigue igual de opaca.", "拉伸的表面保持原来的不透明度。";
        mass_hint: "Stretched tissue grows thinner, compressed tissue denser.", "Gedehntes Gewebe wird dünner, gestauchtes dichter.", "El tejido estirado se aclara, el comprimido se densifica.", "拉伸的组织变薄，压缩的组织变密。";
        as_it_is_hint: "Opacity does not follow the deformation.", "Die Deckkraft folgt der Verformung nicht.", "La opacidad no sigue la deformación.", "不透明度不随变形改变。";
        edges: "Edges only", "Nur Kanten", "Solo bordes", "仅边缘";
        edges_hint: "Even tissue turns clear; where the value changes, and at cuts, it stays as opaque as it was. Shows with faint opacities", "Gleichmäßiges Gewebe wird klar; wo sich der Wert ändert und an Schnitten bleibt es so deckend, wie es war. Wirkt bei schwachen Deckkräften", "El tejido uniforme se vuelve claro; donde cambia el valor y en los cortes sigue igual de opaco. Se nota con opacidades débiles", "均匀组织变得透明；数值变化处和切面保持原有不透明度。在低不透明度下效果明显";
        background: "Background", "Hintergrund", "Fondo", "背景";
        background_is: "Background: {0}", "Hintergrund: {0}", "Fondo: {0}", "背景：{0}";
        white: "White", "Weiß", "Blanco", "白色";
        paper: "Paper", "Papier", "Papel", "纸色";
        grey: "Grey", "Grau", "Gris", "灰色";
        slate: "Slate", "Schiefer", "Pizarra", "石板灰";
        black: "Black", "Schwarz", "Negro", "黑色";
        transparent: "Transparent", "Durchsichtig", "Transparente", "透明";
        background_colour: "Background colour", "Hintergrundfarbe", "Color de fondo", "背景颜色";
        scale: "Scale bar", "Maßstab", "Barra de escala", "比例尺";
        scale_hint: "A bar in millimetres in the picture, for readers and in saved pictures. It holds at the depth that the camera looks at: what is nearer is drawn larger", "Ein Balken in Millimetern im Bild, für Leser und in gesicherten Bildern. Er gilt in der Tiefe, auf die die Kamera blickt: Näheres ist größer gezeichnet", "Una barra en milímetros en la imagen, para los lectores y en las imágenes guardadas. Vale a la profundidad que mira la cámara: lo más cercano se dibuja mayor", "图像中的毫米比例尺，供读者查看，也写入保存的图片。它适用于相机所注视的深度：更近的部分画得更大";
        sides: "Letters of the patient's sides", "Buchstaben der Seiten des Patienten", "Letras de los lados del paciente", "患者方位字母";
        sides_hint: "R, L, A, P, S and I at the edges of the picture, for readers and in saved pictures; here they always stand", "R, L, A, P, S und I an den Rändern des Bildes, für Leser und in gesicherten Bildern; hier stehen sie immer", "R, L, A, P, S e I en los bordes de la imagen, para los lectores y en las imágenes guardadas; aquí están siempre", "图像边缘的 R、L、A、P、S、I，供读者查看，也写入保存的图片；此处始终显示";
        any_colour: "Any colour", "Beliebige Farbe", "Cualquier color", "任意颜色";
    }
}
