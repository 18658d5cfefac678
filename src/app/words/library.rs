//! The library: examples and recent documents.

words! {
    /// Examples and recent documents.
    Library {
        examples: "Examples", "Beispiele", "Ejemplos", "示例";
        examples_hint: "Finished illustrations and lessons, to look at and to go on from", "Fertige Illustrationen und Lektionen, zum Ansehen und Weiterarbeiten", "Ilustraciones y lecciones terminadas, para ver y para partir de ellas", "可供查看并在其基础上继续编辑的成品插图和课程";
        or_example: "Or start from an example", "Oder mit einem Beispiel beginnen", "O empiece con un ejemplo", "或从示例开始";
        recent: "Recent documents", "Zuletzt geöffnet", "Documentos recientes", "最近的文档";
        page: "Show", "Zeigen", "Mostrar", "显示";
        close: "Close the examples", "Beispiele schließen", "Cerrar los ejemplos", "关闭示例";
        search: "Search the examples", "Beispiele durchsuchen", "Buscar en los ejemplos", "搜索示例";
        search_hint: "Search: knee, flap, skull …", "Suchen: Knie, Lappen, Schädel …", "Buscar: rodilla, colgajo…", "搜索：膝、皮瓣…";
        clear_search: "Clear the search for examples", "Suche nach Beispielen leeren", "Borrar la búsqueda de ejemplos", "清除示例搜索";
        subject: "Subject of the examples", "Objekt der Beispiele", "Objeto de los ejemplos", "示例的对象";
        all_subjects: "All subjects", "Alle Objekte", "Todos los objetos", "所有对象";
        template: "Template of the examples", "Vorlage der Beispiele", "Plantilla de los ejemplos", "示例的模板";
        all_templates: "All templates", "Alle Vorlagen", "Todas las plantillas", "所有模板";
        one_step: "{0}, 1 step", "{0}, 1 Schritt", "{0}, 1 paso", "{0}，1 步";
        steps: "{0}, {1} steps", "{0}, {1} Schritte", "{0}, {1} pasos", "{0}，{1} 步";
        open: "Open the example {0}", "Beispiel {0} öffnen", "Abrir el ejemplo {0}", "打开示例 {0}";
        make_mine: "Make it mine", "Kopie bearbeiten", "Editar una copia", "编辑副本";
        make_mine_of: "Make it mine: {0}", "Kopie bearbeiten: {0}", "Editar una copia: {0}", "编辑副本：{0}";
        make_mine_hint: "Opens a copy to edit; the example stays as it is", "Öffnet eine Kopie zum Bearbeiten; das Beispiel bleibt, wie es ist", "Abre una copia para editar; el ejemplo queda como está", "打开一份可编辑的副本；示例保持不变";
        copy_of: "Copy of {0}", "Kopie von {0}", "Copia de {0}", "{0}的副本";
        not_fetched: "The examples could not be fetched. Check the connection.", "Die Beispiele konnten nicht geladen werden. Bitte die Verbindung prüfen.", "No se pudieron descargar los ejemplos. Compruebe la conexión.", "无法获取示例。请检查网络连接。";
        again: "Try again", "Noch einmal versuchen", "Intentar de nuevo", "重试";
        found_nothing: "No example is like that", "Kein Beispiel passt dazu", "Ningún ejemplo coincide", "没有符合的示例";
        no_recent: "Nothing yet. Documents that make room for another are listed here, on this device only.", "Noch nichts. Dokumente, die einem anderen Platz machen, stehen hier, nur auf diesem Gerät.", "Nada todavía. Los documentos que dejan sitio a otro aparecen aquí, solo en este equipo.", "暂无内容。被其他文档替换的文档会列在这里，仅保存在本设备上。";
        open_recent: "Open {0}", "{0} öffnen", "Abrir {0}", "打开 {0}";
        forget: "Remove {0} from the list", "{0} aus der Liste nehmen", "Quitar {0} de la lista", "从列表中移除 {0}";
    }
}
