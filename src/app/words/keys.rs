//! The sheet of keys and gestures.

words! {
    /// The list of keys.
    Keys {
        heading: "Keys and gestures", "Tasten und Gesten", "Teclas y gestos", "按键与手势";
        close: "Close the sheet", "Blatt schließen", "Cerrar la hoja", "关闭此页";
        drag: "Drag", "Ziehen", "Arrastrar", "拖动";
        pan: "Right drag, two fingers", "Rechts ziehen, zwei Finger", "Arrastrar con el derecho, dos dedos", "右键拖动、双指";
        pan_does: "Move the picture", "Bild verschieben", "Mover la imagen", "移动图像";
        wheel: "Wheel, pinch", "Rad, zwei Finger spreizen", "Rueda, pellizcar", "滚轮、双指捏合";
        wheel_does: "Closer, further away", "Näher, weiter weg", "Acercar, alejar", "拉近、拉远";
        double_click: "Double click", "Doppelklick", "Doble clic", "双击";
        double_click_does: "Turn about the point", "Um den Punkt drehen", "Girar en torno al punto", "绕该点旋转";
        handle: "Ctrl + handle", "Strg + Griff", "Ctrl + tirador", "Ctrl + 手柄";
        alt_handle: "Alt + handle", "Alt + Griff", "Alt + tirador", "Alt + 手柄";
        shift_handle: "Shift + handle", "Umschalt + Griff", "Mayús + tirador", "Shift + 手柄";
        right_click: "Right click, long press", "Rechtsklick, langes Drücken", "Clic derecho, pulsación larga", "右键单击、长按";
        right_click_does: "Menu of the template", "Menü der Vorlage", "Menú de la plantilla", "模板菜单";
        ball: "[ and ] while painting", "[ und ] beim Malen", "[ y ] al pintar", "涂绘时按 [ 和 ]";
        ball_does: "A smaller or larger ball", "Kleinere oder größere Kugel", "Bola menor o mayor", "缩小或放大球";
        copy: "Copy the template", "Vorlage kopieren", "Copiar la plantilla", "复制模板";
        cut: "Cut the template out", "Vorlage ausschneiden", "Cortar la plantilla", "剪切模板";
        paste: "Paste templates, a link or a document", "Vorlagen, Link oder Dokument einfügen", "Pegar plantillas, un enlace o un documento", "粘贴模板、链接或文档";
        mirror: "Mirrored copy, right and left", "Spiegelkopie, rechts und links", "Copia reflejada, derecha e izquierda", "镜像副本：左右";
        lay: "Snap to the surface", "An die Oberfläche anlegen", "Ajustar a la superficie", "贴合到表面";
        group: "Group with the one before", "Mit der davor gruppieren", "Agrupar con la anterior", "与上一个编组";
        ungroup: "Leave the group", "Gruppe verlassen", "Dejar el grupo", "离开组";
        snap: "Handles in steps or not", "Griffe in Schritten oder nicht", "Tiradores por pasos o no", "手柄步进开关";
        next_panel: "Next panel", "Nächster Bereich", "Panel siguiente", "下一个面板";
        search: "Search the catalogue", "Im Katalog suchen", "Buscar en el catálogo", "搜索目录";
        seek: "Find a tissue or a label", "Gewebe oder Beschriftung finden", "Encontrar un tejido o un rótulo", "查找组织或标注";
        alt_drag: "Alt drag", "Alt + Ziehen", "Alt + arrastrar", "Alt 拖动";
        alt_drag_does: "Roll", "Rollen", "Rodar", "滚转";
        arrows: "Arrows", "Pfeile", "Flechas", "方向键";
        page_up: "Page up", "Bild auf", "Re Pág", "Page Up";
        page_down: "Page down", "Bild ab", "Av Pág", "Page Down";
        undo: "Undo", "Rückgängig", "Deshacer", "撤销";
        redo: "Redo", "Wiederholen", "Rehacer", "重做";
        open: "Open a scan or a document", "Scan oder Dokument öffnen", "Abrir un estudio o un documento", "打开扫描或文档";
        save_picture: "Save the picture", "Bild sichern", "Guardar la imagen", "保存图片";
        save_document: "Save the document", "Dokument sichern", "Guardar el documento", "保存文档";
        copy_link: "Copy the link", "Link kopieren", "Copiar el enlace", "复制链接";
        turn_object: "Turn the object", "Objekt drehen", "Girar el objeto", "转动对象";
        closer: "Closer", "Näher", "Acercar", "拉近";
        further: "Further away", "Weiter weg", "Alejar", "拉远";
        first_view: "Back to the first view", "Zurück zur ersten Ansicht", "Volver a la primera vista", "回到初始视图";
        place_in_middle: "Place in the middle of the picture", "In die Bildmitte setzen", "Colocar en el centro de la imagen", "放在图像中央";
        drop: "Drop what is being done", "Abbrechen", "Dejar lo que se está haciendo", "取消当前操作";
        before: "Template before", "Vorlage davor", "Plantilla anterior", "上一个模板";
        next: "Next template", "Nächste Vorlage", "Plantilla siguiente", "下一个模板";
        move_it: "Move the template", "Vorlage verschieben", "Mover la plantilla", "移动模板";
        turn_it: "Turn the template", "Vorlage drehen", "Girar la plantilla", "旋转模板";
        size_it: "Size the template", "Größe der Vorlage", "Tamaño de la plantilla", "缩放模板";
        open_further: "Open it further", "Weiter öffnen", "Abrirla más", "开得更大";
        close_it: "Close it", "Schließen", "Cerrarla", "收拢";
        hide: "Hide or show the template", "Vorlage aus- oder einblenden", "Ocultar o mostrar la plantilla", "隐藏或显示模板";
        duplicate: "Duplicate the template", "Vorlage verdoppeln", "Duplicar la plantilla", "复制一份模板";
        delete: "Delete the template", "Vorlage löschen", "Eliminar la plantilla", "删除模板";
        earlier: "Move the template up: it acts earlier", "Vorlage nach oben: wirkt früher", "Subir la plantilla: actúa antes", "上移模板：更早起效";
        later: "Move the template down: it acts later", "Vorlage nach unten: wirkt später", "Bajar la plantilla: actúa después", "下移模板：更晚起效";
        next_step: "Next step", "Nächster Schritt", "Paso siguiente", "下一步";
        step_of: "Step {0} of {1}", "Schritt {0} von {1}", "Paso {0} de {1}", "第 {0} 步，共 {1} 步";
        start_of_one: "Start, one step follows", "Anfang, ein Schritt folgt", "Inicio, sigue un paso", "起始，后有 1 步";
        start_of: "Start, {0} steps follow", "Anfang, {0} Schritte folgen", "Inicio, siguen {0} pasos", "起始，后有 {0} 步";
        step_before: "Step before", "Schritt davor", "Paso anterior", "上一步";
        picture_alone: "Present: the picture without panels", "Präsentieren: das Bild ohne Bereiche", "Presentar: la imagen sin paneles", "演示：不显示面板";
        this_sheet: "This sheet", "Dieses Blatt", "Esta hoja", "此页";
        front: "From the front", "Von vorn", "Desde delante", "从前面看";
        back: "From the back", "Von hinten", "Desde detrás", "从后面看";
        right: "From the patient's right", "Von rechts (Patient)", "Desde la derecha del paciente", "从患者右侧看";
        left: "From the patient's left", "Von links (Patient)", "Desde la izquierda del paciente", "从患者左侧看";
        above: "From above", "Von oben", "Desde arriba", "从上面看";
        below: "From below", "Von unten", "Desde abajo", "从下面看";
    }
}
