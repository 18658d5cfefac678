//! The list of templates and everything about the selected one.

words! {
    /// The list of templates.
    Templates {
        heading: "Templates", "Vorlagen", "Plantillas", "模板";
        unknown_kind: "This version does not know this kind of template. It is kept as it is, and not drawn.", "Diese Version kennt diese Art von Vorlage nicht. Sie bleibt erhalten und wird nicht gezeichnet.", "Esta versión no conoce este tipo de plantilla. Se conserva tal cual y no se dibuja.", "此版本不认识这种模板。它会原样保留，但不绘制。";
        delete: "Delete", "Löschen", "Eliminar", "删除";
        later: "Move down: acts later", "Nach unten: wirkt später", "Bajar: actúa después", "下移：更晚起效";
        earlier: "Move up: acts earlier", "Nach oben: wirkt früher", "Subir: actúa antes", "上移：更早起效";
        nothing_placed: "Nothing is placed yet. Choose a template, then click on the object.", "Noch nichts platziert. Eine Vorlage wählen, dann auf das Objekt klicken.", "Aún no hay nada colocado. Elija una plantilla y haga clic en el objeto.", "尚未放置任何模板。选择一个模板，然后点击对象。";
        order: "They act from top to bottom.", "Sie wirken von oben nach unten.", "Actúan de arriba abajo.", "从上到下依次作用。";
        unknown: "Unknown template", "Unbekannte Vorlage", "Plantilla desconocida", "未知模板";
        added: "summed", "summiert", "sumada", "相加";
        hide: "Hide {0}", "{0} ausblenden", "Ocultar {0}", "隐藏 {0}";
        show: "Show {0}", "{0} einblenden", "Mostrar {0}", "显示 {0}";
        delete_template: "Delete template", "Vorlage löschen", "Eliminar plantilla", "删除模板";
        duplicate_template: "Duplicate template", "Vorlage verdoppeln", "Duplicar plantilla", "复制一份模板";
        name: "Name", "Name", "Nombre", "名称";
        name_hint: "What you call it; shown in the list", "Wie sie heißen soll; steht in der Liste", "Cómo la llama usted; aparece en la lista", "您对它的称呼；显示在列表中";
        joins: "Combine", "Verbindung", "Combinar", "组合";
        joins_hint: "How this template and the one before it act together", "Wie diese Vorlage und die davor zusammenwirken", "Cómo actúan juntas esta plantilla y la anterior", "此模板与前一个模板如何共同作用";
        after: "In sequence", "Nacheinander", "En secuencia", "依次";
        after_hint: "It acts on tissue that the templates before it have already moved", "Sie wirkt auf Gewebe, das die Vorlagen davor schon bewegt haben", "Actúa sobre el tejido que ya movieron las plantillas anteriores", "作用于前面的模板已移动过的组织";
        summed: "Summed", "Summiert", "Sumadas", "相加";
        summed_hint: "Its displacement is added to that of the template before it", "Ihre Verschiebung wird zu der der Vorlage davor addiert", "Su desplazamiento se suma al de la plantilla anterior", "其位移与前一个模板的位移相加";
        placement: "Placement", "Lage", "Ubicación", "位置";
        fold_placement: "Fold placement", "Lage einklappen", "Plegar ubicación", "收起位置";
        unfold_placement: "Unfold placement", "Lage ausklappen", "Desplegar ubicación", "展开位置";
        centre: "Centre", "Mitte", "Centro", "中心";
        centre_hint: "Centre, in parts of the subject's longest side: right, front, up", "Mitte, in Teilen der längsten Seite des Objekts: rechts, vorn, oben", "Centro, en partes del lado más largo del objeto: derecha, delante, arriba", "中心，以对象最长边为单位：右、前、上";
        turned: "Rotation", "Drehung", "Rotación", "旋转";
        turned_hint: "About x, y and z, in this order", "Um x, y und z, in dieser Folge", "En torno a x, y y z, en este orden", "依次绕 x、y、z";
        size: "Size", "Größe", "Tamaño", "大小";
        size_hint: "Sides of the box", "Seiten des Quaders", "Lados de la caja", "盒子的边长";
        slider: "{0} slider", "{0}: Regler", "{0}: deslizador", "{0}滑块";
        reset: "Reset {0}", "{0} zurücksetzen", "Restablecer {0}", "重置{0}";
        range: "{0}\n{1} to {2}{3}", "{0}\n{1} bis {2}{3}", "{0}\nde {1} a {2}{3}", "{0}\n{1} 至 {2}{3}";
    }
}
