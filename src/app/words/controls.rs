//! Values that readers may move.

words! {
    /// Values that the readers of a lesson may move.
    Controls {
        heading: "For readers to move", "Für Leser zum Bewegen", "Para que lo mueva el lector", "供读者调节";
        add: "Add a value", "Wert hinzufügen", "Añadir un valor", "添加数值";
        none: "A value that is listed here gets a slider or a switch in the lesson, beside its steps.", "Ein Wert, der hier steht, bekommt in der Lektion einen Regler oder Schalter neben den Schritten.", "Un valor de esta lista tendrá en la lección un deslizador o un interruptor junto a los pasos.", "列在此处的数值会在课程的步骤旁显示滑块或开关。";
        name_of: "Name of the control of {0}", "Name des Reglers für {0}", "Nombre del control de {0}", "{0} 的控件名称";
        remove: "Remove {0}", "{0} entfernen", "Quitar {0}", "移除{0}";
        is_on: "{0}: on", "{0}: an", "{0}: activado", "{0}：启用";
    }
}
