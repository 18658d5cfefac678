//! The panel of title, caption and credit.

words! {
    /// The panel of title, legend and credit.
    Text {
        heading: "Text", "Text", "Texto", "文字";
        title: "Title", "Titel", "Título", "标题";
        title_hint: "Craniotomy", "Kraniotomie", "Craneotomía", "开颅术";
        caption: "Caption", "Bildtext", "Leyenda", "说明";
        caption_hint: "What the picture shows", "Was das Bild zeigt", "Lo que muestra la imagen", "图像所示内容";
        credit: "Credit", "Nachweis", "Créditos", "署名";
        credit_hint: "Your name, where the scan is from", "Ihr Name, Herkunft des Scans", "Su nombre, procedencia del estudio", "您的姓名、扫描来源";
        lettering: "Write title, credit and labels into saved pictures", "Titel, Nachweis und Beschriftungen in gesicherte Bilder schreiben", "Escribir título, créditos y rótulos en las imágenes guardadas", "在保存的图片中写入标题、署名和标注";
        show_title: "Show the title over the picture", "Titel über dem Bild zeigen", "Mostrar el título sobre la imagen", "在图像上方显示标题";
        scan_name: "Name of the scan", "Name des Scans", "Nombre del estudio", "扫描名称";
        scan_name_example: "CT head", "CT Kopf", "TC de cabeza", "头部 CT";
        scan_stays: "The scan stays on this machine. Whoever opens the link is asked for the file; the name tells which.", "Der Scan bleibt auf diesem Gerät. Wer den Link öffnet, wird nach der Datei gefragt; der Name sagt, nach welcher.", "El estudio no sale de este equipo. A quien abra el enlace se le pedirá el archivo; el nombre dice cuál.", "扫描留在本机。打开链接的人会被要求提供该文件；名称说明是哪一个。";
    }
}
