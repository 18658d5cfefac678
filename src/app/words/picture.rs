//! What stands over the picture: placing, handles, sides of the patient.

words! {
    /// Texts over the picture: placing, handles, sides of the patient.
    OverPicture {
        picture_of: "Picture of {0}", "Bild von {0}", "Imagen de {0}", "{0}的图像";
        picture_named: "Picture: {0}", "Bild: {0}", "Imagen: {0}", "图像：{0}";
        no_device: "There is no graphics device to draw with", "Es gibt kein Grafikgerät zum Zeichnen", "No hay dispositivo gráfico con el que dibujar", "没有可用于绘制的图形设备";
        tap_where: "Tap where the {0} goes", "Antippen, wohin: {0}", "Toque dónde va: {0}", "点按要放置{0}的位置";
        click_where: "Click on the object where the {0} goes", "Auf das Objekt klicken, wohin: {0}", "Haga clic en el objeto donde va: {0}", "在对象上点击要放置{0}的位置";
        cancel_placing: "Cancel placing", "Platzieren abbrechen", "Cancelar la colocación", "取消放置";
        middle: "Middle", "Mitte", "Centro", "中央";
        in_the_middle: "In the middle", "In die Mitte", "En el centro", "放在中央";
        enter: "Enter", "Eingabetaste", "Intro", "回车键";
        select: "Select {0}", "{0} auswählen", "Seleccionar {0}", "选择{0}";
        back_to_first: "Back to the first view", "Zurück zur ersten Ansicht", "Volver a la primera vista", "回到初始视图";
        drop_here: "Drop a scan or a document to open it. It stays on this machine.", "Scan oder Dokument hier ablegen, um es zu öffnen. Es bleibt auf diesem Gerät.", "Suelte aquí un estudio o un documento para abrirlo. No sale de este equipo.", "将扫描或文档拖放到此处打开。文件只留在本机。";
        handles: "Handles", "Griffe", "Tiradores", "手柄";
        r#move: "Move", "Schieben", "Mover", "移动";
        turn: "Turn", "Drehen", "Girar", "旋转";
        size: "Size", "Größe", "Tamaño", "大小";
        hide: "Hide", "Ausblenden", "Ocultar", "隐藏";
        show: "Show", "Einblenden", "Mostrar", "显示";
        duplicate: "Duplicate", "Verdoppeln", "Duplicar", "复制一份";
        delete: "Delete", "Löschen", "Eliminar", "删除";
        deselect: "Deselect", "Auswahl aufheben", "Anular selección", "取消选择";
        drag_main: "Drag {0}", "{0} ziehen", "Arrastrar {0}", "拖动{0}";
        move_freely: "Move freely", "Frei schieben", "Mover libremente", "自由移动";
        move_along: "Move along {0}", "Entlang {0} schieben", "Mover según {0}", "沿 {0} 移动";
        move_across: "Move across {0}", "Quer zu {0} schieben", "Mover en el plano perpendicular a {0}", "在垂直于 {0} 的平面内移动";
        turn_about: "Turn about {0}", "Um {0} drehen", "Girar en torno a {0}", "绕 {0} 旋转";
        size_near: "Size {0} at the near end", "Größe {0} am nahen Ende", "Tamaño {0} en el extremo cercano", "{0} 近端大小";
        size_far: "Size {0} at the far end", "Größe {0} am fernen Ende", "Tamaño {0} en el extremo lejano", "{0} 远端大小";
        view: "View: {0}", "Ansicht: {0}", "Vista: {0}", "视图：{0}";
        front: "Front", "Vorn", "Delante", "前";
        back: "Back", "Hinten", "Detrás", "后";
        right: "Right", "Rechts", "Derecha", "右";
        left: "Left", "Links", "Izquierda", "左";
        top: "Top", "Oben", "Arriba", "上";
        bottom: "Bottom", "Unten", "Abajo", "下";
        from_front: "From the front, anterior", "Von vorn, anterior", "Desde delante, anterior", "从前面看";
        from_back: "From the back, posterior", "Von hinten, posterior", "Desde detrás, posterior", "从后面看";
        from_right: "From the patient's right", "Von der rechten Seite des Patienten", "Desde la derecha del paciente", "从患者右侧看";
        from_left: "From the patient's left", "Von der linken Seite des Patienten", "Desde la izquierda del paciente", "从患者左侧看";
        from_above: "From above, superior", "Von oben, superior", "Desde arriba, superior", "从上面看";
        from_below: "From below, inferior", "Von unten, inferior", "Desde abajo, inferior", "从下面看";
        shaping: "The clay is still being shaped", "Der Ton wird noch geformt", "La arcilla aún se está modelando", "黏土仍在塑形";
        earlier_object: "Earlier picture: the object is still loading", "Früheres Bild: das Objekt wird noch geladen", "Imagen anterior: el objeto aún se está cargando", "先前的图像：对象仍在载入";
        object_missing: "Earlier picture: the scan of this document is not here", "Früheres Bild: der Scan dieses Dokuments ist nicht da", "Imagen anterior: falta el estudio de este documento", "先前的图像：缺少此文档的扫描";
        coarse: "Coarse for now: the fine picture is on its way", "Vorerst grob: das feine Bild folgt", "De momento sin detalle: la imagen fina está en camino", "暂为粗略图像：精细图像即将就绪";
        segments_coming: "Provisional: the label file is still loading", "Vorläufig: die Datei mit Segmenten wird noch geladen", "Provisional: el archivo de etiquetas aún se está cargando", "暂定图像：标签文件仍在载入";
        tool_coming: "Provisional: the mesh of a tool is still loading", "Vorläufig: das Netz eines Werkzeugs wird noch geladen", "Provisional: la malla de un instrumento aún se está cargando", "暂定图像：器械的网格仍在加载";
        mesh_coming: "Provisional: a mesh beside the scan is still loading", "Vorläufig: ein Netz neben dem Scan wird noch geladen", "Provisional: una malla junto al escáner aún se está cargando", "暂定图像：扫描旁的网格仍在载入";
        object_coming: "Provisional: an object is still loading", "Vorläufig: ein Gegenstand wird noch geladen", "Provisional: un objeto aún se está cargando", "暂定图像：物体仍在载入";
        field_coming: "Provisional: a displacement field is still loading", "Vorläufig: ein Verschiebungsfeld wird noch geladen", "Provisional: un campo de desplazamiento aún se está cargando", "暂定图像：位移场仍在载入";
        tissues_coming: "Provisional: tissues are still being made", "Vorläufig: Gewebe werden noch gebildet", "Provisional: aún se están creando los tejidos", "暂定图像：组织仍在生成";
        show_panels: "Show the panels", "Bereiche zeigen", "Mostrar los paneles", "显示面板";
    }
}
