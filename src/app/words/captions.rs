//! Captions, the texts that follow their tissue (“labels” to the user).

words! {
    /// Texts of captions on tissue.
    Captions {
        heading: "Labels", "Beschriftungen", "Rótulos", "标注";
        add: "Add a label", "Beschriftung hinzufügen", "Añadir un rótulo", "添加标注";
        none: "A label names a place in the object and follows it when it is opened.", "Eine Beschriftung benennt eine Stelle des Objekts und folgt ihr beim Öffnen.", "Un rótulo nombra un lugar del objeto y lo sigue al abrirlo.", "标注为对象上的位置命名，并在展开时随之移动。";
        click_where: "Click on what the label names", "Anklicken, was benannt wird", "Haga clic en lo que se nombra", "点击要标注的位置";
        tap_where: "Tap what it names", "Antippen, was es benennt", "Toque lo que nombra", "点按标注位置";
        cancel: "Cancel the label", "Beschriftung abbrechen", "Cancelar el rótulo", "取消标注";
        caption_n: "Label {0}", "Beschriftung {0}", "Rótulo {0}", "标注 {0}";
        text_n: "Text of label {0}", "Text der Beschriftung {0}", "Texto del rótulo {0}", "标注 {0} 的文字";
        of_drawing: "Words of the drawing", "Wörter der Zeichnung", "Palabras del dibujo", "图中的文字";
        of_drawing_hint: "The drawing's own letters do not bend: take its words as labels", "Die Schrift der Zeichnung biegt sich nicht: ihre Wörter als Beschriftungen nehmen", "Las letras del dibujo no se doblan: tome sus palabras como rótulos", "图中文字不会随之弯曲：可用作标注";
        take_word: "Label: {0}", "Beschriftung: {0}", "Rótulo: {0}", "标注：{0}";
        remove: "Remove the label {0}", "Beschriftung {0} entfernen", "Quitar el rótulo {0}", "移除标注 {0}";
    }
}
