//! The dialog that shares an illustration.

words! {
    /// Texts of the dialog that shares an illustration.
    Share {
        share: "Share…", "Teilen …", "Compartir…", "分享…";
        heading: "Share", "Teilen", "Compartir", "分享";
        close: "Close the dialog", "Dialog schließen", "Cerrar el diálogo", "关闭对话框";
        length: "The link has {0} characters.", "Der Link hat {0} Zeichen.", "El enlace tiene {0} caracteres.", "链接有 {0} 个字符。";
        long: "Some programs cut links as long as this: better pass on the document as a file.", "Manche Programme kürzen so lange Links: besser das Dokument als Datei weitergeben.", "Algunos programas cortan enlaces tan largos: mejor pasar el documento como archivo.", "有些程序会截断这么长的链接：最好以文件形式传递文档。";
        local: "Others cannot open this: it needs a file of yours, which is not in the link. Give them the file too.", "Andere können das nicht öffnen: Es braucht eine Datei von Ihnen, die nicht im Link steckt. Geben Sie auch die Datei weiter.", "Otros no pueden abrirlo: necesita un archivo suyo que no está en el enlace. Entregue también el archivo.", "其他人无法打开：它需要您本地的文件，而链接中不含该文件。请一并提供该文件。";
        no_page: "A window has no page of its own: links and code begin with “#”. The variable FABRICA_PAGE names a page.", "Ein Fenster hat keine eigene Seite: Links und Codes beginnen mit „#“. Die Variable FABRICA_PAGE nennt eine Seite.", "Una ventana no tiene página propia: los enlaces y códigos empiezan por «#». La variable FABRICA_PAGE indica una página.", "窗口没有自己的网页：链接和代码以“#”开头。可用变量 FABRICA_PAGE 指定网页。";
        qr: "QR code of the link", "QR-Code des Links", "Código QR del enlace", "链接的二维码";
        qr_dense: "The code is dense: some phones do not read it from a projector.", "Der Code ist dicht: Manche Telefone lesen ihn nicht von der Leinwand.", "El código es denso: algunos teléfonos no lo leen de una proyección.", "二维码较密：有些手机无法从投影读取。";
        qr_none: "The link is too long for a QR code ({0} characters at most).", "Der Link ist zu lang für einen QR-Code (höchstens {0} Zeichen).", "El enlace es demasiado largo para un código QR ({0} caracteres como máximo).", "链接过长，无法生成二维码（最多 {0} 个字符）。";
        for_pages: "For your own page", "Für die eigene Seite", "Para su propia página", "用于您自己的网页";
        element: "Copy as element", "Als Element kopieren", "Copiar como elemento", "复制为元素";
        element_hint: "HTML with the viewer's script, for pages that allow scripts", "HTML mit dem Skript des Viewers, für Seiten, die Skripte erlauben", "HTML con el script del visor, para páginas que permiten scripts", "含查看器脚本的 HTML，用于允许脚本的网页";
        frame: "Copy as frame", "Als Rahmen kopieren", "Copiar como marco", "复制为框架";
        frame_hint: "HTML with an iframe, for learning platforms that allow frames", "HTML mit einem iframe, für Lernplattformen, die Rahmen erlauben", "HTML con un iframe, para plataformas que permiten marcos", "含 iframe 的 HTML，用于允许框架的学习平台";
        plain: "Copy as text with link", "Als Text mit Link kopieren", "Copiar como texto con enlace", "复制为带链接的文本";
        plain_hint: "HTML without scripts and frames: title, text, steps, what the picture shows, and the link", "HTML ohne Skripte und Rahmen: Titel, Text, Schritte, was das Bild zeigt, und der Link", "HTML sin scripts ni marcos: título, texto, pasos, lo que muestra la imagen y el enlace", "不含脚本和框架的 HTML：标题、说明、步骤、图像内容和链接";
        files: "As files", "Als Dateien", "Como archivos", "作为文件";
        size: "Pixels along the longer side", "Pixel an der längeren Seite", "Píxeles del lado más largo", "长边像素数";
        dpi: "Dots per inch in print", "Punkte pro Zoll im Druck", "Puntos por pulgada al imprimir", "打印时每英寸点数";
        paper: "Behind the object", "Hinter dem Objekt", "Detrás del objeto", "物体后面";
        paper_background: "Background", "Hintergrund", "Fondo", "背景";
        paper_background_hint: "The colour that the document has", "Die Farbe, die das Dokument hat", "El color que tiene el documento", "文档的背景颜色";
        paper_clear: "Nothing", "Nichts", "Nada", "无";
        paper_clear_hint: "Transparent, for slides and pages of any colour", "Durchsichtig, für Folien und Seiten jeder Farbe", "Transparente, para diapositivas y páginas de cualquier color", "透明，适用于任何颜色的幻灯片和页面";
        paper_shadow: "Shadow", "Schatten", "Sombra", "阴影";
        paper_shadow_hint: "A soft shadow on the background, as if the object lay on paper", "Ein weicher Schatten auf dem Hintergrund, als läge das Objekt auf Papier", "Una sombra suave sobre el fondo, como si el objeto estuviera sobre papel", "背景上的柔和阴影，如同物体放在纸上";
        paper_clear_shadow: "Shadow alone", "Nur Schatten", "Solo sombra", "仅阴影";
        paper_clear_shadow_hint: "Transparent but for a soft shadow", "Durchsichtig bis auf einen weichen Schatten", "Transparente salvo una sombra suave", "除柔和阴影外透明";
        printed: "In print the longer side has {0} cm.", "Im Druck hat die längere Seite {0} cm.", "Impreso, el lado más largo mide {0} cm.", "打印时长边为 {0} 厘米。";
        automatic: "Automatic", "Automatisch", "Automático", "自动";
        on_clipboard: "The HTML is on the clipboard", "Das HTML ist in der Zwischenablage", "El HTML está en el portapapeles", "HTML 已在剪贴板中";
    }
}
