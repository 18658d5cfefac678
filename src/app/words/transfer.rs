//! The transfer function over the histogram.

words! {
    /// Texts of the editor of the transfer function.
    Transfer {
        plot: "Opacity and colour over value", "Deckkraft und Farbe über dem Wert", "Opacidad y color según el valor", "不透明度和颜色随数值的变化";
        point_is: "Point {0}: value {1}, opacity {2}", "Punkt {0}: Wert {1}, Deckkraft {2}", "Punto {0}: valor {1}, opacidad {2}", "点 {0}：数值 {1}，不透明度 {2}";
        point_hint: "Drag; draw it out of the field, press Delete or hold it to remove it", "Ziehen; zum Entfernen aus dem Feld ziehen, Entf drücken oder gedrückt halten", "Arrastre; para quitarlo, sáquelo del campo, pulse Supr o manténgalo pulsado", "拖动；拖出区域、按 Delete 或长按可移除";
        window_hint: "Window: the values over which the colours are spread", "Fenster: die Werte, über die sich die Farben verteilen", "Ventana: los valores entre los que se reparten los colores", "窗口：颜色所覆盖的数值范围";
        line_hint: "Click on the line or double-click to add a point", "Auf die Linie klicken oder doppelklicken fügt einen Punkt hinzu", "Haga clic en la línea o doble clic para añadir un punto", "点击曲线或双击可添加点";
        whole: "Show the whole axis", "Die ganze Achse zeigen", "Mostrar todo el eje", "显示整个坐标轴";
        closer: "Closer to the points", "Näher an die Punkte", "Acercarse a los puntos", "放大到各点";
        choose: "Choose a point to set its colour and numbers.", "Wähle einen Punkt, um Farbe und Zahlen einzustellen.", "Elija un punto para fijar su color y sus números.", "选择一个点来设置颜色和数值。";
        colour: "Colour", "Farbe", "Color", "颜色";
        segments: "Named segments", "Benannte Segmente", "Segmentos con nombre", "已命名的分割";
        ct: "CT", "CT", "TC", "CT";
        other: "MRI and other scans", "MRT und andere Scans", "RM y otros estudios", "MRI 及其他扫描";
        tint: "Tint", "Tönung", "Tinte", "着色";
        tint_hint: "How much the segments' own colours show", "Wie stark die eigenen Farben der Segmente durchkommen", "Cuánto se ven los colores propios de los segmentos", "分割自身颜色的显示程度";
    }
}
