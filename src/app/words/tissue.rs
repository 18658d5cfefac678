//! Tissues: the segments of the subject, and those made here.

words! {
    /// The tissue panel and its messages.
    Tissue {
        heading: "Tissues", "Gewebe", "Tejidos", "组织";
        add: "Make a tissue", "Gewebe anlegen", "Crear un tejido", "创建组织";
        add_hint: "Finds a tissue by its values in the scan, so that templates can leave it alone", "Findet ein Gewebe an seinen Werten im Scan, damit Vorlagen es unberührt lassen können", "Encuentra un tejido por sus valores en la imagen, para que las plantillas lo dejen intacto", "按扫描数值找出组织，使模板可以不触及它";
        none: "This scan comes without segments. Make a tissue out of its values.", "Dieser Scan kommt ohne Segmente. Ein Gewebe aus seinen Werten erstellen.", "Este estudio no trae segmentos. Cree un tejido a partir de sus valores.", "此扫描没有分割标签。可根据其数值创建组织。";
        loading: "As soon as the scan is loaded", "Sobald der Scan geladen ist", "En cuanto la imagen esté cargada", "扫描加载完成后可用";
        alone: "Show {0} alone", "Nur {0} zeigen", "Mostrar solo {0}", "仅显示{0}";
        glimpse: "Show {0} for a moment", "{0} kurz zeigen", "Mostrar {0} un momento", "短暂显示{0}";
        all: "Show everything again", "Wieder alles zeigen", "Mostrar todo de nuevo", "重新显示全部";
        search: "Search tissues and labels", "Gewebe und Beschriftungen suchen", "Buscar tejidos y rótulos", "搜索组织和标注";
        search_hint: "Search: heart, vein …", "Suchen: Herz, Vene …", "Buscar: corazón, vena…", "搜索：心、静脉…";
        clear_search: "Clear the search for tissues", "Gewebesuche leeren", "Borrar la búsqueda de tejidos", "清除组织搜索";
        turn_to: "Turn to {0}", "Zu {0} drehen", "Girar hacia {0}", "转到{0}";
        found_nothing: "No tissue and no label is called that", "Kein Gewebe und keine Beschriftung heißt so", "Ningún tejido ni rótulo se llama así", "没有这样名称的组织或标注";
        nowhere: "There is no {0} in this scan", "In diesem Scan ist nichts von: {0}", "En esta imagen no hay nada de: {0}", "此扫描中没有{0}";
        not_yet: "Still being found: {0}", "Wird noch gesucht: {0}", "Todavía se busca: {0}", "仍在查找：{0}";
        look: "How {0} is drawn", "Wie {0} gezeichnet wird", "Cómo se dibuja {0}", "{0}的绘制方式";
        drawn: "Drawn", "Gezeichnet", "Dibujo", "绘制";
        as_scan: "As scanned", "Wie im Scan", "Como en la imagen", "按扫描";
        body: "As a body", "Als Körper", "Como cuerpo", "实体";
        hidden: "Hidden", "Verborgen", "Oculto", "隐藏";
        opacity: "Opacity", "Deckkraft", "Opacidad", "不透明度";
        opacity_hint: "Less lets what lies behind shine through", "Weniger lässt durchscheinen, was dahinter liegt", "Menos deja ver lo que hay detrás", "数值越低，越能透出后方结构";
        color: "Colour", "Farbe", "Color", "颜色";
        own_color: "Back to its own colour", "Zurück zur eigenen Farbe", "Volver a su propio color", "恢复原有颜色";
        edit: "Edit {0}", "{0} bearbeiten", "Editar {0}", "编辑{0}";
        remove: "Remove {0}", "{0} entfernen", "Quitar {0}", "移除{0}";
        name: "Name", "Name", "Nombre", "名称";
        taken: "There is a tissue “{0}” already: this one becomes “{1}”.", "Ein Gewebe „{0}“ gibt es schon: Dieses wird „{1}“.", "Ya hay un tejido «{0}»: este se llamará «{1}».", "已有名为“{0}”的组织：此组织将命名为“{1}”。";
        tissue_n: "tissue {0}", "Gewebe {0}", "tejido {0}", "组织 {0}";
        from: "Found by", "Gefunden durch", "Hallado por", "查找方式";
        values: "Values", "Werte", "Valores", "数值";
        points: "Growing", "Wachsen", "Crecimiento", "区域生长";
        lowest: "Lowest", "Ab", "Desde", "最低值";
        lowest_hint: "The lowest value in the scan that belongs to the tissue", "Der kleinste Wert im Scan, der zum Gewebe gehört", "El valor más bajo de la imagen que pertenece al tejido", "属于该组织的最低扫描数值";
        highest: "Highest", "Bis", "Hasta", "最高值";
        highest_hint: "The highest value in the scan that belongs to the tissue", "Der größte Wert im Scan, der zum Gewebe gehört", "El valor más alto de la imagen que pertenece al tejido", "属于该组织的最高扫描数值";
        histogram: "How often which values occur, and those that the tissue takes", "Wie oft welche Werte vorkommen, und welche das Gewebe nimmt", "Con qué frecuencia aparece cada valor, y cuáles toma el tejido", "各数值出现的频率，以及该组织所取的数值";
        vessels: "With contrast agent, vessels may be taken with the bone: raise the lowest value, or let the tissue grow from a point.", "Mit Kontrastmittel können Gefäße mit dem Knochen erfasst werden: „Ab“ erhöhen oder das Gewebe von einem Punkt aus wachsen lassen.", "Con medio de contraste, los vasos pueden tomarse junto con el hueso: suba el valor «Desde» o haga crecer el tejido desde un punto.", "若使用造影剂，血管可能与骨一同被选取：请提高最低值，或从一个点开始生长。";
        click: "Click where it is", "Anklicken, wo es ist", "Haga clic donde está", "点击其所在处";
        click_hint: "Each click on the object adds a point that the tissue grows from", "Jeder Klick auf das Objekt fügt einen Punkt hinzu, von dem das Gewebe wächst", "Cada clic en el objeto añade un punto desde el que crece el tejido", "每次点击对象都会添加一个生长起点";
        from_cross: "Point at the crosshair", "Punkt am Fadenkreuz", "Punto en la cruz", "取十字线处的点";
        seeds: "Points: {0}", "Punkte: {0}", "Puntos: {0}", "起点：{0}";
        clear: "Remove all points", "Alle Punkte entfernen", "Quitar todos los puntos", "移除所有起点";
        clean: "Clean up, in voxels of {0} mm", "Bereinigen, in Voxeln zu {0} mm", "Limpiar, en vóxeles de {0} mm", "清理（体素，边长 {0} mm）";
        close: "Close gaps", "Lücken zu", "Unir huecos", "闭合缝隙";
        close_hint: "Closes gaps up to twice as wide, in voxels", "Schließt Lücken bis zur doppelten Breite, in Voxeln", "Cierra huecos de hasta el doble de ancho, en vóxeles", "闭合宽度不超过两倍此值的缝隙（体素）";
        largest: "Parts", "Teile", "Partes", "部分数";
        largest_hint: "Keeps so many of the largest parts; 0 keeps all", "Behält so viele der größten Teile; 0 behält alle", "Conserva tantas de las partes mayores; 0 las conserva todas", "保留最大的若干部分；0 表示全部";
        fill: "Fill holes", "Löcher füllen", "Rellenar agujeros", "填充孔洞";
        smooth: "Smooth", "Glätten", "Suavizar", "平滑";
        smooth_hint: "Smooths the outline, in voxels", "Glättet den Umriss, in Voxeln", "Suaviza el contorno, en vóxeles", "平滑轮廓（体素）";
        grow: "Grow by", "Zugabe", "Ampliar", "扩大";
        grow_hint: "Adds so many voxels all around; less than 0 takes away", "Fügt ringsum so viele Voxel an; unter 0 nimmt weg", "Añade tantos vóxeles alrededor; menos de 0 los quita", "四周扩大的体素数；小于 0 则缩小";
        own_steps: "This tissue is cleaned up in {0} steps of its own.", "Dieses Gewebe wird in {0} eigenen Schritten bereinigt.", "Este tejido se limpia con {0} pasos propios.", "该组织使用自定义的 {0} 个清理步骤。";
        reset: "Start over", "Neu beginnen", "Empezar de nuevo", "重新设置";
        working: "Finding tissues: {0} %", "Gewebe werden gesucht: {0} %", "Buscando tejidos: {0} %", "正在查找组织：{0} %";
        stop: "Stop", "Anhalten", "Detener", "停止";
        stopped: "Stopped: the picture shows what was found before.", "Angehalten: Das Bild zeigt, was zuvor gefunden war.", "Detenido: la imagen muestra lo hallado antes.", "已停止：图像显示的是之前找到的组织。";
        go_on: "Go on", "Weiter suchen", "Continuar", "继续";
        done: "Done", "Fertig", "Listo", "完成";
        leave: "Discard", "Verwerfen", "Descartar", "放弃";
        leave_hint: "Leaves the tissue unmade (Esc)", "Das Gewebe wird nicht angelegt (Esc)", "No se crea el tejido (Esc)", "不创建该组织（Esc）";
        volume: "{0} cm³", "{0} cm³", "{0} cm³", "{0} 立方厘米";
        provisional: "provisional: about {0} cm³", "vorläufig: etwa {0} cm³", "provisional: unos {0} cm³", "暂定：约 {0} 立方厘米";
        nothing: "nothing found", "nichts gefunden", "nada encontrado", "未找到";
        labels_taken: "Taken as tissues of the scan: {0}", "Als Gewebe des Scans übernommen: {0}", "Tomado como tejidos de la imagen: {0}", "已作为扫描的组织：{0}";
        labels_wanted: "The illustration needs a label file of the scan: drop it on the picture", "Die Illustration braucht eine Datei mit Segmenten des Scans: auf das Bild ziehen", "La ilustración necesita un archivo de etiquetas de la imagen: suéltelo sobre ella", "该图解需要扫描的标签文件：请将其拖到图像上";
    }
}
