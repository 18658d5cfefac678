//! The top bar, its menu, and the names of the panels.

words! {
    /// Texts of the top bar, its menu and the tabs of the panels.
    Bar {
        open: "Open", "Öffnen", "Abrir", "打开";
        open_hint: "Open a scan (NIfTI) or a document. It stays on this machine.", "Einen Scan (NIfTI) oder ein Dokument öffnen. Es bleibt auf diesem Gerät.", "Abrir un estudio (NIfTI) o un documento. No sale de este equipo.", "打开扫描（NIfTI）或文档。文件只留在本机。";
        open_file: "Open a file", "Datei öffnen", "Abrir un archivo", "打开文件";
        undo: "Undo", "Rückgängig", "Deshacer", "撤销";
        undo_what: "Undo: {0}", "Rückgängig: {0}", "Deshacer: {0}", "撤销：{0}";
        redo: "Redo", "Wiederholen", "Rehacer", "重做";
        redo_what: "Redo: {0}", "Wiederholen: {0}", "Rehacer: {0}", "重做：{0}";
        copy_link: "Copy link", "Link kopieren", "Copiar enlace", "复制链接";
        link: "Link", "Link", "Enlace", "链接";
        copied: "Copied", "Kopiert", "Copiado", "已复制";
        link_hint: "The link holds the whole illustration: {0} characters", "Der Link enthält die ganze Illustration: {0} Zeichen", "El enlace contiene toda la ilustración: {0} caracteres", "链接包含整幅插图：{0} 个字符";
        link_length: "Length of the link", "Länge des Links", "Longitud del enlace", "链接长度";
        link_is_long: "Some programs cut links as long as this: better save the document as a file", "Manche Programme kürzen so lange Links: besser das Dokument als Datei sichern", "Algunos programas cortan enlaces tan largos: mejor guardar el documento como archivo", "有些程序会截断这么长的链接：最好将文档存为文件";
        subject: "Subject", "Objekt", "Objeto", "对象";
        subject_hint: "What is shown", "Was gezeigt wird", "Lo que se muestra", "显示的内容";
        newer_subject: "{0}, newer version", "{0}, neuere Fassung", "{0}, versión nueva", "{0}（新版）";
        newer_subject_hint: "The same subject as it is drawn today. Templates, labels and steps stay.", "Dasselbe Objekt, wie es heute gezeichnet wird. Vorlagen, Beschriftungen und Schritte bleiben.", "El mismo objeto tal como se dibuja hoy. Las plantillas, las etiquetas y los pasos se conservan.", "同一对象的最新绘制版本。模板、标注和步骤保持不变。";
        open_file_more: "Open a file…", "Datei öffnen …", "Abrir un archivo…", "打开文件…";
        scan_from_address: "Scan from an address", "Scan von einer Adresse", "Estudio de una dirección", "来自网址的扫描";
        own_surface: "Your surface", "Eigene Oberfläche", "Superficie propia", "自己的表面";
        own_surfaces: "Your surfaces", "Eigene Oberflächen", "Superficies propias", "自己的表面";
        clay: "Clay", "Ton", "Arcilla", "黏土";
        own_scan: "Your scan", "Eigener Scan", "Estudio propio", "自己的扫描";
        picture_from_address: "Plate from an address", "Bildtafel von einer Adresse", "Lámina de una dirección", "来自网址的图版";
        own_picture: "Your plate", "Eigene Bildtafel", "Lámina propia", "自己的图版";
        more: "More", "Mehr", "Más", "更多";
        new_document: "New document", "Neues Dokument", "Documento nuevo", "新建文档";
        save_document: "Save document", "Dokument sichern", "Guardar documento", "保存文档";
        save_mesh: "Save mesh as {0}", "Netz als {0} sichern", "Guardar malla como {0}", "网格存为 {0}";
        save_picture: "Save picture", "Bild sichern", "Guardar imagen", "保存图片";
        picture_alone: "Present", "Präsentieren", "Presentar", "演示";
        theme_light: "Light colours", "Helle Farben", "Colores claros", "浅色界面";
        theme_dark: "Dark colours", "Dunkle Farben", "Colores oscuros", "深色界面";
        high_contrast: "High contrast", "Hoher Kontrast", "Contraste alto", "高对比度";
        usual_contrast: "Usual contrast", "Üblicher Kontrast", "Contraste normal", "普通对比度";
        larger: "Larger", "Größer", "Más grande", "放大界面";
        smaller: "Smaller", "Kleiner", "Más pequeño", "缩小界面";
        messages: "Messages", "Meldungen", "Mensajes", "消息";
        keys: "Keys and gestures", "Tasten und Gesten", "Teclas y gestos", "按键与手势";
        language: "Language", "Sprache", "Idioma", "语言";
        link_of: "Link: {0} characters", "Link: {0} Zeichen", "Enlace: {0} caracteres", "链接：{0} 个字符";
        panel: "Panel", "Bereich", "Panel", "面板";
        add: "Add", "Hinzufügen", "Añadir", "添加";
        templates: "Templates", "Vorlagen", "Plantillas", "模板";
        tissues: "Tissues", "Gewebe", "Tejidos", "组织";
        look: "Look", "Aussehen", "Aspecto", "外观";
        text: "Text", "Text", "Texto", "文字";
    }
}
