//! What the bodies of meshes are made of.

words! {
    /// Bodies of meshes and their layers.
    Bodies {
        heading: "Bodies", "Körper", "Cuerpos", "实体";
        body: "Body", "Körper", "Cuerpo", "实体类型";
        auto: "Automatic", "Automatisch", "Automático", "自动";
        auto_hint: "Hollow beside a scan and where the mesh is open, else solid", "Hohl neben einem Scan und wo das Netz offen ist, sonst massiv", "Hueco junto a un estudio y donde la malla está abierta; si no, macizo", "与扫描并存或网格开放时为空心，否则为实心";
        hollow: "Hollow", "Hohl", "Hueco", "空心";
        hollow_hint: "The surface alone; cuts show its back side", "Die Fläche allein; Schnitte zeigen ihre Rückseite", "Solo la superficie; los cortes muestran su cara interior", "仅有表面；切口显示其背面";
        thick: "Thick", "Schale", "Grueso", "厚壳";
        thick_hint: "A shell, from the surface inwards", "Eine Schale, von der Fläche nach innen", "Una cáscara, de la superficie hacia dentro", "从表面向内的一层壳";
        solid: "Solid", "Massiv", "Macizo", "实心";
        solid_hint: "Full; cuts show what it is made of", "Gefüllt; Schnitte zeigen, woraus er ist", "Lleno; los cortes muestran de qué está hecho", "充满；切口显示其内部材料";
        thickness: "Thickness", "Dicke", "Grosor", "厚度";
        thickness_hint: "How deep the shell goes, in parts of the subject's longest side", "Wie tief die Schale reicht, in Teilen der längsten Seite des Objekts", "Hasta dónde llega la cáscara, en partes del lado más largo", "壳的厚度，以对象最长边为单位";
        inside: "Inside", "Innen", "Interior", "内侧";
        inside_hint: "Colour of back sides and of cut faces without a layer", "Farbe von Rückseiten und von Schnittflächen ohne Schicht", "Color de las caras interiores y de los cortes sin capa", "背面及无分层切面的颜色";
        inside_auto: "As the outside, darker", "Wie außen, dunkler", "Como el exterior, más oscuro", "与外侧相同但更暗";
        gloss: "Gloss", "Glanz", "Brillo", "光泽";
        gloss_hint: "How much light it mirrors", "Wie viel Licht er spiegelt", "Cuánta luz refleja", "反射光线的程度";
        layers: "Layers", "Schichten", "Capas", "分层";
        no_layers: "Cuts show one colour. Layers are materials under the surface, each from its depth down to the next.", "Schnitte zeigen eine Farbe. Schichten sind Materialien unter der Fläche, jede von ihrer Tiefe bis zur nächsten.", "Los cortes muestran un solo color. Las capas son materiales bajo la superficie, cada una desde su profundidad hasta la siguiente.", "切口显示单一颜色。分层是表面之下的材料，每层从其深度延伸到下一层。";
        add_layer: "Add a layer", "Schicht hinzufügen", "Añadir una capa", "添加层";
        remove_layer: "Remove {0}", "{0} entfernen", "Quitar {0}", "移除{0}";
        layer_n: "Layer {0}", "Schicht {0}", "Capa {0}", "第 {0} 层";
        name_of: "Name of layer {0}", "Name von Schicht {0}", "Nombre de la capa {0}", "第 {0} 层名称";
        colour_of: "Colour of layer {0}", "Farbe von Schicht {0}", "Color de la capa {0}", "第 {0} 层颜色";
        depth: "Depth", "Tiefe", "Profundidad", "深度";
        depth_hint: "Where it begins under the surface, in parts of the subject's longest side", "Wo sie unter der Fläche beginnt, in Teilen der längsten Seite des Objekts", "Dónde empieza bajo la superficie, en partes del lado más largo", "在表面下开始的深度，以对象最长边为单位";
        grain: "Grain", "Körnung", "Grano", "颗粒";
        grain_hint: "How much its colour varies", "Wie sehr ihre Farbe schwankt", "Cuánto varía su color", "颜色变化的程度";
        full: "There are at most 8 layers.", "Es gibt höchstens 8 Schichten.", "Hay como máximo 8 capas.", "最多 8 层。";
    }
}
