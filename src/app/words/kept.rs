//! What a template leaves alone, and what the tissues of the built-in subjects are called.

use super::of;

words! {
    /// Tissue that a template leaves alone.
    Keep {
        leaves: "Leaves alone", "Lässt unberührt", "Deja intacto", "不触及";
        leaves_hint: "What this template does not touch: it stays where it is, and what is over it is taken off", "Was diese Vorlage nicht anrührt: Es bleibt, wo es ist, und was darüber liegt, wird abgehoben", "Lo que esta plantilla no toca: se queda en su sitio y se levanta lo que hay encima", "此模板不触动的部分：它留在原处，其上的组织被掀开";
        nothing: "Nothing", "Nichts", "Nada", "无";
        deep: "What lies deep", "Tiefes", "Lo profundo", "深层";
        tissue: "Tissue", "Gewebe", "Tejido", "组织";
        depth: "Depth", "Tiefe", "Profundidad", "深度";
        depth_hint: "How far under the skin untouched tissue begins, in parts of the longest side", "Wie weit unter der Haut das Unberührte beginnt, in Teilen der längsten Seite", "A qué profundidad bajo la piel empieza lo intacto, en partes del lado más largo", "不触及的组织从皮肤下多深开始，以最长边为单位";
        blend: "Blend", "Übergang", "Transición", "过渡";
        blend_hint: "How far on either side of the parted surfaces their light is taken from them", "Wie weit beiderseits der getrennten Flächen das Licht von ihnen bestimmt wird", "Hasta qué distancia a cada lado de las superficies separadas la luz se toma de ellas", "分离面两侧多大范围内的光照取自该面";
        yields: "Gives way to", "Weicht aus", "Cede ante", "避让";
        yields_hint: "What is never moved nor passed through: the displacement fades towards it", "Was nie bewegt und nie durchdrungen wird: Zu ihm hin lässt die Verschiebung nach", "Lo que nunca se mueve ni se atraviesa: el desplazamiento se desvanece hacia ello", "既不移动也不被穿过的组织：位移在其附近逐渐减小";
        shorter: "Moves less far", "Kürzere Wege", "Menos recorrido", "移动更短";
        weaker: "Acts less", "Schwächer", "Menos efecto", "作用更弱";
        no_segments: "There are no tissues yet: make one in the panel “Tissues”.", "Es gibt noch keine Gewebe: im Bereich „Gewebe“ eines anlegen.", "Todavía no hay tejidos: cree uno en el panel «Tejidos».", "尚无组织：请在“组织”面板中创建。";
        whole: "As a whole", "Als Ganzes", "Como un todo", "整体移动";
        constraint: "constraint", "Rücksicht", "la restricción", "约束";
    }
}

/// What a segment of a built-in subject is called; names that a file brought stay as they are.
pub(crate) fn segment(name: &str) -> String {
    let line = match name {
        "airway" => ["Airway", "Atemweg", "Vía aérea", "气道"],
        "arteries" => ["Arteries", "Arterien", "Arterias", "动脉"],
        "bone" => ["Bone", "Knochen", "Hueso", "骨"],
        "brain" => ["Brain", "Gehirn", "Cerebro", "大脑"],
        "brain stem" => ["Brain stem", "Hirnstamm", "Tronco encefálico", "脑干"],
        "cartilage" => ["Cartilage", "Knorpel", "Cartílago", "软骨"],
        "cerebellum" => ["Cerebellum", "Kleinhirn", "Cerebelo", "小脑"],
        "coins" => ["Coins", "Münzen", "Monedas", "硬币"],
        "core" => ["Core", "Kern", "Núcleo", "核心"],
        "csf" => [
            "Cerebrospinal fluid",
            "Hirnwasser",
            "Líquido cefalorraquídeo",
            "脑脊液",
        ],
        "dura" => ["Dura", "Harte Hirnhaut", "Duramadre", "硬脑膜"],
        "eyes" => ["Eyes", "Augen", "Ojos", "眼"],
        "fat" => ["Fat", "Fett", "Grasa", "脂肪"],
        "femur" => ["Femur", "Oberschenkelknochen", "Fémur", "股骨"],
        "fibula" => ["Fibula", "Wadenbein", "Peroné", "腓骨"],
        "flesh" => ["Flesh", "Fruchtfleisch", "Pulpa", "果肉"],
        "glands" => ["Glands", "Drüsen", "Glándulas", "腺体"],
        "hair" => ["Hair", "Haar", "Pelo", "毛发"],
        "jelly" => ["Jelly", "Gelee", "Gelatina", "果冻"],
        "joint fluid" => [
            "Joint fluid",
            "Gelenkflüssigkeit",
            "Líquido articular",
            "关节液",
        ],
        "ligaments" => ["Ligaments", "Bänder", "Ligamentos", "韧带"],
        "menisci" => ["Menisci", "Menisken", "Meniscos", "半月板"],
        "mucosa" => ["Mucosa", "Schleimhaut", "Mucosa", "黏膜"],
        "muscle" => ["Muscle", "Muskel", "Músculo", "肌肉"],
        "nails" => ["Nails", "Nägel", "Uñas", "指甲"],
        "nerves" => ["Nerves", "Nerven", "Nervios", "神经"],
        "patella" => ["Patella", "Kniescheibe", "Rótula", "髌骨"],
        "seeds" => ["Seeds", "Kerne", "Semillas", "种子"],
        "shell" => ["Shell", "Hülle", "Cubierta", "外壳"],
        "skin" => ["Skin", "Haut", "Piel", "皮肤"],
        "teeth" => ["Teeth", "Zähne", "Dientes", "牙齿"],
        "tendons" => ["Tendons", "Sehnen", "Tendones", "肌腱"],
        "tibia" => ["Tibia", "Schienbein", "Tibia", "胫骨"],
        "tongue" => ["Tongue", "Zunge", "Lengua", "舌"],
        "veins" => ["Veins", "Venen", "Venas", "静脉"],
        "ventricles" => ["Ventricles", "Hirnkammern", "Ventrículos", "脑室"],
        "wall" => ["Wall", "Wand", "Pared", "壁"],
        "white matter" => ["White matter", "Weiße Substanz", "Sustancia blanca", "白质"],
        _ => return name.to_owned(),
    };
    of(line).to_owned()
}
