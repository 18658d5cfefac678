//! What a template leaves alone, and what the tissues of the built-in subjects are called.

use super::of;
use crate::describe;

words! {
    /// Tissue that a template leaves alone.
    Keep {
        leaves: "Keep in place", "Am Platz lassen", "Dejar en su sitio", "保持原位";
        leaves_hint: "Tissue that this template does not move: it stays where it is, and the tissue over it is taken off", "Gewebe, das diese Vorlage nicht bewegt: Es bleibt, wo es ist, und das Gewebe darüber wird abgehoben", "Tejido que esta plantilla no mueve: se queda en su sitio y se retira el que lo cubre", "此模板不移动的组织：留在原处，其上的组织被移开";
        nothing: "Nothing", "Nichts", "Nada", "无";
        nothing_hint: "The template moves everything in its box", "Die Vorlage bewegt alles in ihrem Quader", "La plantilla mueve todo lo que hay en su caja", "模板移动其盒子内的一切";
        deep: "What lies deep", "Tiefes", "Lo profundo", "深层";
        deep_hint: "Everything deeper under the skin than a depth that you choose stays in place", "Alles, was tiefer als eine gewählte Tiefe unter der Haut liegt, bleibt an seinem Platz", "Todo lo que está bajo la piel a más de la profundidad elegida se queda en su sitio", "皮肤下超过所选深度的一切保持原位";
        tissue: "Tissue", "Gewebe", "Tejido", "组织";
        tissue_hint: "The tissues that you tick stay in place, bone for example", "Die angekreuzten Gewebe bleiben an ihrem Platz, etwa Knochen", "Los tejidos marcados se quedan en su sitio, por ejemplo el hueso", "勾选的组织保持原位，例如骨";
        depth: "Depth", "Tiefe", "Profundidad", "深度";
        depth_hint: "How far under the skin untouched tissue begins, in parts of the longest side", "Wie weit unter der Haut das Unberührte beginnt, in Teilen der längsten Seite", "A qué profundidad bajo la piel empieza lo intacto, en partes del lado más largo", "保持原位的组织从皮肤下多深开始，以最长边为单位";
        blend: "Blend", "Übergang", "Transición", "过渡";
        blend_hint: "How far on either side of the parted surfaces their light is taken from them", "Wie weit beiderseits der getrennten Flächen das Licht von ihnen bestimmt wird", "Hasta qué distancia a cada lado de las superficies separadas la luz se toma de ellas", "分离面两侧多大范围内的光照取自该面";
        yields: "Protect", "Schützen", "Proteger", "保护";
        yields_hint: "Tissue that is neither bent nor passed through: the movement fades towards it", "Gewebe, das weder verbogen noch durchdrungen wird: Die Bewegung lässt zu ihm hin nach", "Tejido que no se dobla ni se atraviesa: el movimiento se desvanece hacia él", "不弯曲也不被穿过的组织：越靠近它，移动越弱";
        unprotected_hint: "No tissue is protected", "Kein Gewebe wird geschützt", "No se protege ningún tejido", "不保护任何组织";
        shorter: "Shorter path", "Kürzerer Weg", "Trayecto más corto", "缩短位移";
        shorter_hint: "Tissue beside the protected one moves less far", "Gewebe neben dem geschützten bewegt sich weniger weit", "El tejido junto al protegido se mueve menos", "受保护组织旁的组织移动得更少";
        weaker: "Weaker", "Schwächer", "Más débil", "减弱";
        weaker_hint: "The template acts less beside the protected tissue", "Die Vorlage wirkt neben dem geschützten Gewebe schwächer", "La plantilla actúa menos junto al tejido protegido", "模板在受保护组织旁作用减弱";
        no_segments: "There are no tissues yet: make one in the panel “Tissues”.", "Es gibt noch keine Gewebe: im Bereich „Gewebe“ eines anlegen.", "Todavía no hay tejidos: cree uno en el panel «Tejidos».", "尚无组织：请在“组织”面板中创建。";
        inside: "Inside lies {0}: it would be dragged through what encloses it.", "Darin liegt {0}: Es würde durch das Umschließende gezogen.", "Dentro está {0}: se arrastraría a través de lo que lo rodea.", "其内有{0}：会被拖拽穿过包裹它的结构。";
        keep_inside: "Also keep what lies inside", "Auch das Innere bewahren", "Conservar también lo de dentro", "一并保留内部组织";
        keep_inside_hint: "Keeps the tissue inside in place too", "Lässt auch das Gewebe im Inneren an seinem Platz", "Deja también en su sitio el tejido del interior", "使内部的组织也留在原位";
        whole: "Rigid", "Starr", "Rígido", "刚性";
        whole_hint: "The protected tissue moves along in one piece and keeps its shape", "Das geschützte Gewebe bewegt sich als ein Stück mit und behält seine Form", "El tejido protegido se mueve en una pieza y conserva su forma", "受保护组织作为整体移动，形状不变";
        bodies: "Rigid, each by itself", "Starr, jedes für sich", "Rígido, cada uno por sí", "各自刚性";
        bodies_hint: "Each of the protected tissues moves along in one piece of its own, as bones do at a joint", "Jedes der geschützten Gewebe bewegt sich als eigenes Stück mit, wie Knochen an einem Gelenk", "Cada tejido protegido se mueve en una pieza propia, como los huesos de una articulación", "每个受保护组织各自作为整体移动，如关节处的骨";
        parts: "Rigid, part by part", "Starr, Stück für Stück", "Rígido, pieza por pieza", "逐块刚性";
        parts_hint: "Each connected part of the protected tissue moves along in one piece of its own, where several bones are one tissue; four at most", "Jedes zusammenhängende Stück des geschützten Gewebes bewegt sich für sich mit, wo mehrere Knochen ein Gewebe sind; höchstens vier", "Cada parte conexa del tejido protegido se mueve en una pieza propia, cuando varios huesos son un solo tejido; cuatro como máximo", "受保护组织的每个相连部分各自作为整体移动，适用于多块骨属于同一组织的情形；最多四块";
        constraint: "constraint", "Rücksicht", "la restricción", "约束";
    }
}

/// What a segment is called: those of built-in subjects in the language of the interface, also where a number tells a
/// second one apart; names that a file brought stay as they are.
pub(crate) fn segment(name: &str) -> String {
    if let Some((before, number)) = name.rsplit_once(' ')
        && number.parse::<u32>().is_ok()
    {
        return format!("{} {number}", segment(before));
    }
    match describe::segment(name) {
        Some(line) => of(line).to_owned(),
        None => name.to_owned(),
    }
}
