//! Control points and the cut between them.

words! {
    /// Texts of control points and of the cut between them.
    Points {
        count: "{0} points", "{0} Punkte", "{0} puntos", "{0} 个控制点";
        how: "Drag a dot: the tissue goes along. Double-click adds one, Delete takes one away.", "Einen Punkt ziehen: das Gewebe geht mit. Doppelklick fügt einen hinzu, Entf nimmt einen weg.", "Arrastre un punto: el tejido lo sigue. Doble clic añade uno, Supr lo quita.", "拖动圆点，组织随之移动。双击添加，Delete 键删除。";
        point: "Control point {0}", "Kontrollpunkt {0}", "Punto de control {0}", "控制点 {0}";
        missed: "Control point {0}, missed by {1} subject units", "Kontrollpunkt {0}, um {1} Objekteinheiten verfehlt", "Punto de control {0}, errado por {1} unidades del objeto", "控制点 {0}，偏差 {1} 个对象单位";
        add: "Add a control point", "Kontrollpunkt hinzufügen", "Añadir un punto de control", "添加控制点";
        cut: "Cut", "Schnitt", "Corte", "切口";
        cut_how: "A line through the box; each side follows its own points", "Eine Linie durch den Quader; jede Seite folgt ihren eigenen Punkten", "Una línea por la caja; cada lado sigue sus propios puntos", "穿过盒子的线；两侧各随自己的控制点";
        cut_add: "Lengthen the cut", "Schnitt verlängern", "Alargar el corte", "延长切口";
        cut_remove: "Remove the cut", "Schnitt entfernen", "Quitar el corte", "移除切口";
        cut_place: "Cut, place {0}", "Schnitt, Stelle {0}", "Corte, lugar {0}", "切口，位置 {0}";
    }
}
