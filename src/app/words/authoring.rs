//! What an author does with whole templates, the search over the catalogue, the first hint.

words! {
    /// Copying, mirroring, grouping, searching.
    Making {
        copy: "Copy", "Kopieren", "Copiar", "复制";
        cut: "Cut out", "Ausschneiden", "Cortar", "剪切";
        paste: "Paste", "Einfügen", "Pegar", "粘贴";
        duplicate: "Duplicate", "Verdoppeln", "Duplicar", "复制一份";
        mirror_sagittal: "Mirrored copy, right and left", "Spiegelkopie, rechts und links", "Copia reflejada, derecha e izquierda", "镜像副本：左右";
        mirror_coronal: "Mirrored copy, front and back", "Spiegelkopie, vorn und hinten", "Copia reflejada, delante y detrás", "镜像副本：前后";
        mirror_axial: "Mirrored copy, above and below", "Spiegelkopie, oben und unten", "Copia reflejada, arriba y abajo", "镜像副本：上下";
        mirrored: "{0}, mirrored", "{0}, gespiegelt", "{0}, reflejo", "{0}（镜像）";
        mirror_here: "Move to the other side", "Auf die andere Seite", "Pasar al otro lado", "移到另一侧";
        lay: "Snap to the surface", "An die Oberfläche anlegen", "Ajustar a la superficie", "贴合到表面";
        group: "Group", "Gruppe", "Grupo", "组";
        group_hint: "Templates of a group are copied, mirrored and moved together; with Shift one moves alone", "Vorlagen einer Gruppe werden zusammen kopiert, gespiegelt und bewegt; mit Umschalt bewegt sich eine allein", "Las plantillas de un grupo se copian, reflejan y mueven juntas; con Mayús se mueve una sola", "同组模板一起复制、镜像和移动；按住 Shift 可单独移动";
        no_group: "None", "Keine", "Ninguno", "无";
        new_group: "New group", "Neue Gruppe", "Grupo nuevo", "新建组";
        group_previous: "Group with the one before", "Mit der davor gruppieren", "Agrupar con la anterior", "与上一个编组";
        leave_group: "Leave the group", "Gruppe verlassen", "Dejar el grupo", "离开组";
        nothing_before: "There is no template before this one", "Vor dieser Vorlage steht keine", "No hay ninguna plantilla antes de esta", "此模板之前没有其他模板";
        snap_on: "Handles in steps", "Griffe in Schritten", "Tiradores por pasos", "手柄步进";
        snap_off: "Handles without steps", "Griffe ohne Schritte", "Tiradores sin pasos", "手柄不步进";
        cannot_paste: "These templates cannot be pasted: {0}", "Diese Vorlagen lassen sich nicht einfügen: {0}", "Estas plantillas no se pueden pegar: {0}", "无法粘贴这些模板：{0}";
        pasted: "Pasted: {0}", "Eingefügt: {0}", "Pegadas: {0}", "已粘贴：{0}";
        on_clipboard: "On the clipboard: {0}", "In der Zwischenablage: {0}", "En el portapapeles: {0}", "已复制到剪贴板：{0}";
        nothing_to_paste: "There is nothing on the clipboard to paste here", "In der Zwischenablage ist nichts zum Einfügen", "No hay nada en el portapapeles que pegar aquí", "剪贴板中没有可粘贴的内容";
        press_keys: "This browser does not let the clipboard be read: press Ctrl+V", "Dieser Browser lässt die Zwischenablage nicht lesen: Strg+V drücken", "Este navegador no deja leer el portapapeles: pulse Ctrl+V", "此浏览器不允许读取剪贴板：请按 Ctrl+V";
        no_surface: "There is no surface under this template", "Unter dieser Vorlage liegt keine Oberfläche", "No hay superficie bajo esta plantilla", "此模板下方没有表面";
        search: "Search", "Suchen", "Buscar", "搜索";
        search_hint: "Search: peel, open, turn …", "Suchen: abrollen, öffnen …", "Buscar: enrollar, abrir…", "搜索模板";
        clear_search: "Clear the search", "Suche leeren", "Borrar la búsqueda", "清除搜索";
        found_nothing: "No template is called that", "Keine Vorlage heißt so", "Ninguna plantilla se llama así", "没有这样的模板";
        actions: "More for this template", "Mehr zu dieser Vorlage", "Más para esta plantilla", "此模板的更多操作";
        step_handles: "Steps of 15° and 0.05", "Schritte von 15° und 0,05", "Pasos de 15° y 0,05", "15° 与 0.05 步进";
        both_sides: "Both sides", "Beide Seiten", "Ambos lados", "两侧同时";
        alone: "Alone, without its group", "Allein, ohne die Gruppe", "Sola, sin su grupo", "单独移动，不带组";
        hint_title: "Three steps", "Drei Schritte", "Tres pasos", "三步完成";
        hint_choose: "Choose a template in the catalogue.", "Eine Vorlage im Katalog wählen.", "Elija una plantilla del catálogo.", "在目录中选择一个模板。";
        hint_place: "Click on the object; drag the yellow knob to open it.", "Auf das Objekt klicken; am gelben Knopf öffnen.", "Haga clic en el objeto; arrastre el botón amarillo para abrirlo.", "点击对象；拖动黄色旋钮将其打开。";
        tap_place: "Tap the object; drag the yellow knob to open it.", "Das Objekt antippen; am gelben Knopf öffnen.", "Toque el objeto; arrastre el botón amarillo para abrirlo.", "点按对象；拖动黄色旋钮将其打开。";
        hint_link: "Copy the link: it holds everything.", "Den Link kopieren: er enthält alles.", "Copie el enlace: lo contiene todo.", "复制链接：其中包含一切。";
        hint_done: "Got it", "Verstanden", "Entendido", "知道了";
    }
}
