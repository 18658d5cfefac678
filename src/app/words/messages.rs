//! Messages of the program, loading, questions.

words! {
    /// Messages that are shown and read aloud.
    Messages {
        link_on_clipboard: "The link is on the clipboard", "Der Link ist in der Zwischenablage", "El enlace está en el portapapeles", "链接已在剪贴板中";
        link_long: "The link has {0} characters, which some programs cut off; a saved document is safer", "Der Link hat {0} Zeichen, was manche Programme kürzen; ein gesichertes Dokument ist sicherer", "El enlace tiene {0} caracteres y algunos programas lo cortan; es más seguro guardar el documento", "链接有 {0} 个字符，有些程序会截断；保存文档更稳妥";
        clipboard_refused: "The clipboard did not take the link", "Die Zwischenablage hat den Link nicht angenommen", "El portapapeles no aceptó el enlace", "剪贴板未能接受链接";
        saved: "Saved {0}", "{0} gesichert", "{0} guardado", "已保存 {0}";
        saved_in_downloads: "{0} is in this browser's downloads", "{0} liegt bei den Downloads dieses Browsers", "{0} está en las descargas de este navegador", "{0} 已存入此浏览器的下载内容";
        saving: "Saving the picture…", "Das Bild wird gesichert …", "Guardando la imagen…", "正在保存图片…";
        bending: "Bending the figure…", "Die Figur wird gebogen …", "Doblando la figura…", "正在弯曲图形…";
        stop_bending: "Stop bending", "Biegen anhalten", "Detener el doblado", "停止弯曲";
        bending_stopped: "Stopped: the figure is shown as it was before.", "Angehalten: Die Figur ist zu sehen, wie sie vorher war.", "Detenido: la figura se muestra como estaba antes.", "已停止：图形显示的是之前的样子。";
        bend_on: "Go on", "Weiter", "Continuar", "继续";
        stop_saving: "Stop saving", "Sichern anhalten", "Detener el guardado", "停止保存";
        saving_stopped: "Saving was stopped; no file was made", "Das Sichern wurde angehalten; es gibt keine Datei", "Se detuvo el guardado; no se creó ningún archivo", "已停止保存，未生成文件";
        not_saved: "The file was not saved", "Die Datei wurde nicht gesichert", "El archivo no se guardó", "文件未保存";
        cannot_be_held: "The scan cannot be held", "Der Scan lässt sich nicht aufnehmen", "El estudio no cabe en memoria", "无法容纳该扫描";
        loading_stopped: "Loading was stopped", "Das Laden wurde angehalten", "Se detuvo la carga", "已停止载入";
        does_not_fit: "The scan does not fit on the graphics device", "Der Scan passt nicht auf das Grafikgerät", "El estudio no cabe en el dispositivo gráfico", "图形设备容纳不下该扫描";
        incomplete: "The scan is incomplete", "Der Scan ist unvollständig", "El estudio está incompleto", "扫描不完整";
        picture_failed: "The picture could not be made", "Das Bild konnte nicht erzeugt werden", "No se pudo crear la imagen", "无法生成图片";
        device_lost: "The graphics device was lost. Your work is kept: copy the link, or start again", "Das Grafikgerät ging verloren. Die Arbeit ist erhalten: Link kopieren oder neu starten", "Se perdió el dispositivo gráfico. Su trabajo se conserva: copie el enlace o reinicie", "图形设备已丢失。您的工作已保留：请复制链接，或重新启动";
        more_notices: "{0} (and {1} more)", "{0} (und {1} weitere)", "{0} (y {1} más)", "{0}（另有 {1} 条）";
        no_tool: "The mesh of a tool has to be OBJ, STL, PLY or GLB", "Das Netz eines Werkzeugs muss OBJ, STL, PLY oder GLB sein", "La malla de un instrumento tiene que ser OBJ, STL, PLY o GLB", "器械的网格必须是 OBJ、STL、PLY 或 GLB";
        no_mesh: "A mesh of the subject has to be OBJ, STL, PLY or GLB", "Ein Netz des Objekts muss OBJ, STL, PLY oder GLB sein", "Una malla del objeto tiene que ser OBJ, STL, PLY o GLB", "对象的网格必须是 OBJ、STL、PLY 或 GLB";
        no_object: "An object has to be a surface mesh: OBJ, STL, PLY or GLB", "Ein Gegenstand muss ein Oberflächennetz sein: OBJ, STL, PLY oder GLB", "Un objeto tiene que ser una malla: OBJ, STL, PLY o GLB", "物体必须是表面网格：OBJ、STL、PLY 或 GLB";
        not_drawn_yet: "{0}: kept in the document, but not drawn yet", "{0}: im Dokument behalten, aber noch nicht gezeichnet", "{0}: se conserva en el documento, pero aún no se dibuja", "{0}：已保留在文档中，但尚未绘制";
        meshes_beside: "Further meshes (subject.meshes)", "Weitere Netze (subject.meshes)", "Otras mallas (subject.meshes)", "其他网格（subject.meshes）";
        cannot_be_opened: "This document cannot be opened: {0}", "Dieses Dokument lässt sich nicht öffnen: {0}", "Este documento no se puede abrir: {0}", "无法打开此文档：{0}";
        step_too_far: "The link opens at step {0}, the last is {1}", "Der Link öffnet bei Schritt {0}, der letzte ist {1}", "El enlace abre en el paso {0}; el último es {1}", "链接要打开第 {0} 步，但最后一步是第 {1} 步";
        other_file: "This is another file than the one the document was made with; undo brings the first one's name back", "Das ist eine andere Datei als die, mit der das Dokument gemacht wurde; Rückgängig bringt den ersten Namen zurück", "Este no es el archivo con el que se hizo el documento; deshacer recupera el nombre del primero", "这不是制作该文档时所用的文件；撤销可恢复原来的名称";
        wrong_file: "This is another file than the one that the illustration was made with", "Das ist eine andere Datei als die, mit der die Illustration gemacht wurde", "Este no es el archivo con el que se hizo la ilustración", "这不是制作该图解时所用的文件";
        other_file_details: "expected {0}\nopened {1}", "erwartet {0}\ngeöffnet {1}", "esperado {0}\nabierto {1}", "应为 {0}\n打开的是 {1}";
        cannot_draw: "The picture could not be drawn", "Das Bild konnte nicht gezeichnet werden", "No se pudo dibujar la imagen", "无法绘制图像";
        nothing_to_click: "There is nothing to click on yet", "Es gibt noch nichts anzuklicken", "Todavía no hay nada en que hacer clic", "还没有可点击的内容";
        point_not_found: "The point could not be found", "Der Punkt wurde nicht gefunden", "No se encontró el punto", "找不到该点";
        nothing_here: "There is nothing at this place: click on the object", "Hier ist nichts: bitte auf das Objekt klicken", "Aquí no hay nada: haga clic en el objeto", "此处没有内容：请点击对象";
        field_refused: "The displacement field cannot be used", "Das Verschiebungsfeld ist nicht brauchbar", "El campo de desplazamiento no se puede usar", "无法使用该位移场";
        unshaped: "Captions in Arabic or Hebrew letters are not set rightly here; the reader in a page does it", "Beschriftungen in arabischen oder hebräischen Buchstaben werden hier nicht richtig gesetzt; der Leser in einer Seite kann es", "Los rótulos en letras árabes o hebreas no se componen bien aquí; el lector en una página sí lo hace", "此处无法正确排印阿拉伯文或希伯来文标注；网页阅读器可以";
        less: "Less", "Weniger", "Menos", "收起";
        details: "Details", "Einzelheiten", "Detalles", "详情";
        dismiss: "Dismiss", "Ausblenden", "Descartar", "关闭";
        fetch_it: "This document shows a scan from {0}. Fetch it?", "Dieses Dokument zeigt einen Scan von {0}. Laden?", "Este documento muestra un estudio de {0}. ¿Descargarlo?", "此文档显示来自 {0} 的扫描。要获取吗？";
        fetch_field: "This document displaces tissue by a file from {0}. Fetch it?", "Dieses Dokument verschiebt Gewebe nach einer Datei von {0}. Laden?", "Este documento desplaza tejido según un archivo de {0}. ¿Descargarlo?", "此文档按来自 {0} 的文件移动组织。要获取吗？";
        fetch: "Fetch", "Laden", "Descargar", "获取";
        no: "No", "Nein", "No", "否";
        cancel_loading: "Cancel loading", "Laden abbrechen", "Cancelar la carga", "取消载入";
        loading: "Loading", "Laden", "Cargando", "正在载入";
        messages: "Messages", "Meldungen", "Mensajes", "消息";
        close_messages: "Close messages", "Meldungen schließen", "Cerrar los mensajes", "关闭消息";
        document_missing: "There is no document at this address: {0}", "Unter dieser Adresse gibt es kein Dokument: {0}", "No hay ningún documento en esta dirección: {0}", "此网址没有文档：{0}";
        document_refused: "The server did not give the document: {0}", "Der Server hat das Dokument nicht herausgegeben: {0}", "El servidor no entregó el documento: {0}", "服务器没有提供该文档：{0}";
        document_unreachable: "The document could not be fetched: {0}", "Das Dokument konnte nicht geladen werden: {0}", "No se pudo descargar el documento: {0}", "无法获取该文档：{0}";
        document_too_long: "This file is too long for a document: {0}", "Diese Datei ist zu lang für ein Dokument: {0}", "Este archivo es demasiado largo para ser un documento: {0}", "此文件过长，不是文档：{0}";
        server_answered: "The server answered {0}.", "Der Server hat {0} geantwortet.", "El servidor respondió {0}.", "服务器返回 {0}。";
        new_for_subject: "A new document was started for this subject", "Für dieses Objekt wurde ein neues Dokument begonnen", "Se ha empezado un documento nuevo para este objeto", "已为此对象新建文档";
        keep_templates: "Keep my templates", "Meine Vorlagen behalten", "Conservar mis plantillas", "保留我的模板";
        slow: "Slow graphics: pictures come in steps", "Langsame Grafik: Bilder entstehen schrittweise", "Gráficos lentos: las imágenes llegan por pasos", "图形设备较慢：图像会分步呈现";
        slow_details: "A whole picture takes {0} s on this device. While something moves it is drawn coarsely; afterwards it becomes sharp by itself.", "Ein ganzes Bild dauert auf diesem Gerät {0} s. Solange sich etwas bewegt, wird es grob gezeichnet; danach wird es von selbst scharf.", "Una imagen completa tarda {0} s en este equipo. Mientras algo se mueve se dibuja de forma tosca; después se afina por sí sola.", "在此设备上，一幅完整图像需要 {0} 秒。移动时以较粗的方式绘制，之后会自动变清晰。";
        nothing_so_far: "Nothing so far.", "Bisher nichts.", "Nada por ahora.", "暂无消息。";
    }
}
