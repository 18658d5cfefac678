//! Objects of the scene: tools and neighbours of the subject.

words! {
    /// The list of objects and everything about the selected one.
    Objects {
        heading: "Objects", "Gegenstände", "Objetos", "物体";
        heading_hint: "Tools and neighbours: they stand in the scene, and no template moves them", "Werkzeuge und Nachbarn: Sie stehen in der Szene, und keine Vorlage bewegt sie", "Instrumentos y vecinos: están en la escena y ninguna plantilla los mueve", "工具与邻近物：位于场景中，不受模板影响";
        add: "Add an object", "Gegenstand hinzufügen", "Añadir un objeto", "添加物体";
        add_hint: "Add a tool: it comes to what the middle of the picture shows", "Werkzeug hinzufügen: Es kommt dahin, was die Bildmitte zeigt", "Añadir un instrumento: aparece ante lo que muestra el centro de la imagen", "添加工具：放到图像中央所示之处";
        full: "A document holds at most 16 objects.", "Ein Dokument fasst höchstens 16 Gegenstände.", "Un documento admite como máximo 16 objetos.", "一个文档最多包含 16 个物体。";
        scalpel: "Scalpel", "Skalpell", "Bisturí", "手术刀";
        forceps: "Forceps", "Pinzette", "Pinzas", "镊子";
        retractor: "Retractor", "Wundhaken", "Separador", "牵开器";
        needle: "Needle", "Nadel", "Aguja", "针";
        mesh: "mesh file", "Netzdatei", "archivo de malla", "网格文件";
        unknown: "Unknown object", "Unbekannter Gegenstand", "Objeto desconocido", "未知物体";
        unknown_hint: "This version does not know this object. It is kept as it is, and not drawn.", "Diese Version kennt diesen Gegenstand nicht. Er bleibt erhalten und wird nicht gezeichnet.", "Esta versión no conoce este objeto. Se conserva tal cual y no se dibuja.", "此版本不认识这个物体。它会原样保留，但不绘制。";
        one: "object", "Gegenstand", "objeto", "物体";
        what_is_it: "What is this mesh?", "Was ist dieses Netz?", "¿Qué es esta malla?", "这个网格是什么？";
        leave_it: "Leave it", "Nicht verwenden", "Dejarla", "不使用";
        as_subject: "The subject", "Das Objekt", "El sujeto", "对象";
        as_subject_hint: "A new document begins with it.", "Ein neues Dokument beginnt mit ihm.", "Empieza con ella un documento nuevo.", "以它开始一个新文档。";
        as_part: "A part of the subject", "Ein Teil des Objekts", "Una parte del sujeto", "对象的一部分";
        as_part_hint: "It is cut and moved with the meshes that are there, in the same millimetres. Only beside meshes from files.", "Es wird mit den vorhandenen Netzen geschnitten und bewegt, in denselben Millimetern. Nur neben Netzen aus Dateien.", "Se corta y se mueve con las mallas presentes, en los mismos milímetros. Solo junto a mallas de archivos.", "与现有网格一起被切割和移动，使用相同的毫米坐标。仅限来自文件的网格。";
        as_object: "An object", "Ein Gegenstand", "Un objeto", "物体";
        as_object_hint: "It stands beside the subject, and no template moves it.", "Es steht neben dem Objekt, und keine Vorlage bewegt es.", "Está junto al sujeto y ninguna plantilla la mueve.", "位于对象旁边，不受模板影响。";
        row: "Object {0}: {1}", "Gegenstand {0}: {1}", "Objeto {0}: {1}", "物体 {0}：{1}";
        up: "Move the object up", "Gegenstand nach oben", "Subir el objeto", "上移物体";
        down: "Move the object down", "Gegenstand nach unten", "Bajar el objeto", "下移物体";
        duplicate: "Duplicate object", "Gegenstand verdoppeln", "Duplicar objeto", "复制一份物体";
        delete: "Delete object", "Gegenstand löschen", "Eliminar objeto", "删除物体";
        name_hint: "What you call it; templates that cut by it name it so", "Wie er heißen soll; Vorlagen, die mit ihm schneiden, nennen ihn so", "Cómo lo llama usted; así lo nombran las plantillas que cortan con él", "您对它的称呼；用它切割的模板以此引用";
        position: "Position", "Ort", "Posición", "坐标";
        turned_hint: "About x, y and z, in this order; the working end points down at rest", "Um x, y und z, in dieser Folge; ungedreht zeigt das Arbeitsende nach unten", "En torno a x, y y z, en este orden; sin girar, la punta mira hacia abajo", "依次绕 x、y、z；未旋转时工作端朝下";
        size_hint: "Its longest side, in parts of the subject's longest side", "Seine längste Seite, in Teilen der längsten Seite des Objekts", "Su lado más largo, en partes del lado más largo del sujeto", "其最长边，以对象最长边为单位";
        from_file: "It lies where its file says.", "Er liegt, wo seine Datei es sagt.", "Está donde indica su archivo.", "位于其文件所述之处。";
        place_here: "Place it freely", "Frei platzieren", "Colocarlo libremente", "自由放置";
        opacity_hint: "How much of what lies behind it it covers", "Wie viel er von dem verdeckt, was hinter ihm liegt", "Cuánto cubre de lo que hay detrás", "遮挡其后方物体的程度";
        own_colour: "The colours of its own", "Seine eigenen Farben", "Sus propios colores", "恢复自身颜色";
        as_tool: "A tool in hand", "Ein Werkzeug in der Hand", "Un instrumento en la mano", "手中的器械";
        as_tool_hint: "It shapes a clay; of anything else it sweeps tissue along", "Es formt Ton; bei allem anderen nimmt es Gewebe mit", "Modela la arcilla; en lo demás arrastra el tejido", "用来塑造黏土；对其他对象则拖移组织";
        carves: "Cut by", "Geschnitten mit", "Corta", "切割物体";
        carves_hint: "The object by whose surface is cut; the template goes with it", "Der Gegenstand, an dessen Fläche geschnitten wird; die Vorlage geht mit ihm", "El objeto por cuya superficie se corta; la plantilla va con él", "沿其表面切割的物体；模板随之移动";
        carves_nothing: "No visible object has this name: choose one, or show it.", "Kein sichtbarer Gegenstand heißt so: einen wählen oder ihn einblenden.", "Ningún objeto visible se llama así: elija uno o muéstrelo.", "没有可见的物体使用此名称：请选择一个，或将其显示。";
        brought: "A scalpel was brought to cut by: move it, or choose another object", "Ein Skalpell wurde dazu geholt: verschieben, oder einen anderen Gegenstand wählen", "Se ha traído un bisturí para cortar: muévalo o elija otro objeto", "已放入一把手术刀用于切割：可移动它，或选择其他物体";
        group_hint: "Objects and templates of a group are moved together", "Gegenstände und Vorlagen einer Gruppe werden zusammen bewegt", "Los objetos y plantillas de un grupo se mueven juntos", "同组的物体和模板一起移动";
    }
}

/// What a tool of the program is called, by its name in documents.
pub(crate) fn tool(builtin: &str) -> &'static str {
    let w = w();
    match builtin {
        "scalpel" => w.scalpel,
        "forceps" => w.forceps,
        "retractor" => w.retractor,
        "needle" => w.needle,
        _ => w.unknown,
    }
}
