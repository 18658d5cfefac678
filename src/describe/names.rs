//! What built-in subjects and their segments are called.

use super::lang::{Lang, Line};
use crate::document::SubjectRef;

/// What a built-in subject is called, by its name in documents; `None` for one that is not known here.
pub fn subject(name: &str) -> Option<Line> {
    Some(match name {
        "apple" => ["Apple", "Apfel", "Manzana", "苹果"],
        "bar" => ["Bar", "Balken", "Barra", "长条"],
        "cube" => ["Cube", "Würfel", "Cubo", "立方体"],
        "tomato" => ["Tomato", "Tomate", "Tomate", "番茄"],
        "piggybank" => ["Piggybank", "Sparschwein", "Hucha", "存钱罐"],
        "head" => ["Head", "Kopf", "Cabeza", "头部"],
        "hand" => ["Hand", "Hand", "Mano", "手"],
        "knee" => ["Knee", "Knie", "Rodilla", "膝"],
        "torso" => ["Torso", "Rumpf", "Torso", "躯干"],
        _ => return None,
    })
}

/// What a segment of a built-in subject is called, by its name in documents; `None` for one that is not known here.
#[rustfmt::skip]
pub fn segment(name: &str) -> Option<Line> {
    Some(match name {
        "air" => ["Air", "Luft", "Aire", "空气"],
        "airway" => ["Airway", "Atemweg", "Vía aérea", "气道"],
        "arteries" => ["Arteries", "Arterien", "Arterias", "动脉"],
        "bone" => ["Bone", "Knochen", "Hueso", "骨"],
        "bowel" => ["Bowel", "Dünndarm", "Intestino delgado", "小肠"],
        "brain" => ["Brain", "Gehirn", "Cerebro", "大脑"],
        "brain stem" => ["Brain stem", "Hirnstamm", "Tronco encefálico", "脑干"],
        "bronchi" => ["Bronchi", "Bronchien", "Bronquios", "支气管"],
        "calyx" => ["Calyx", "Kelch", "Cáliz", "花萼"],
        "cartilage" => ["Cartilage", "Knorpel", "Cartílago", "软骨"],
        "cerebellum" => ["Cerebellum", "Kleinhirn", "Cerebelo", "小脑"],
        "clavicles" => ["Clavicles", "Schlüsselbeine", "Clavículas", "锁骨"],
        "coins" => ["Coins", "Münzen", "Monedas", "硬币"],
        "colon" => ["Colon", "Dickdarm", "Colon", "结肠"],
        "contents" => ["Contents", "Inhalt", "Contenido", "内容物"],
        "core" => ["Core", "Kern", "Núcleo", "核心"],
        "csf" => ["Cerebrospinal fluid", "Hirnwasser", "Líquido cefalorraquídeo", "脑脊液"],
        "diaphragm" => ["Diaphragm", "Zwerchfell", "Diafragma", "膈"],
        "discs" => ["Discs", "Bandscheiben", "Discos", "椎间盘"],
        "dura" => ["Dura", "Harte Hirnhaut", "Duramadre", "硬脑膜"],
        "eyes" => ["Eyes", "Augen", "Ojos", "眼"],
        "fat" => ["Fat", "Fett", "Grasa", "脂肪"],
        "femur" => ["Femur", "Oberschenkelknochen", "Fémur", "股骨"],
        "fibula" => ["Fibula", "Wadenbein", "Peroné", "腓骨"],
        "flesh" => ["Flesh", "Fruchtfleisch", "Pulpa", "果肉"],
        "gallbladder" => ["Gallbladder", "Gallenblase", "Vesícula biliar", "胆囊"],
        "glands" => ["Glands", "Drüsen", "Glándulas", "腺体"],
        "hair" => ["Hair", "Haar", "Pelo", "毛发"],
        "heart" => ["Heart", "Herz", "Corazón", "心脏"],
        "humeri" => ["Humeri", "Oberarmknochen", "Húmeros", "肱骨"],
        "iris" => ["Iris", "Iris", "Iris", "虹膜"],
        "jelly" => ["Jelly", "Gelee", "Gelatina", "果冻"],
        "joint fluid" => ["Joint fluid", "Gelenkflüssigkeit", "Líquido articular", "关节液"],
        "kidneys" => ["Kidneys", "Nieren", "Riñones", "肾"],
        "lens" => ["Lens", "Linse", "Cristalino", "晶状体"],
        "ligaments" => ["Ligaments", "Bänder", "Ligamentos", "韧带"],
        "lips" => ["Lips", "Lippen", "Labios", "唇"],
        "liver" => ["Liver", "Leber", "Hígado", "肝"],
        "lungs" => ["Lungs", "Lungen", "Pulmones", "肺"],
        "menisci" => ["Menisci", "Menisken", "Meniscos", "半月板"],
        "mucosa" => ["Mucosa", "Schleimhaut", "Mucosa", "黏膜"],
        "muscle" => ["Muscle", "Muskel", "Músculo", "肌肉"],
        "nails" => ["Nails", "Nägel", "Uñas", "指甲"],
        "nerves" => ["Nerves", "Nerven", "Nervios", "神经"],
        "oesophagus" => ["Oesophagus", "Speiseröhre", "Esófago", "食管"],
        "pancreas" => ["Pancreas", "Bauchspeicheldrüse", "Páncreas", "胰腺"],
        "patella" => ["Patella", "Kniescheibe", "Rótula", "髌骨"],
        "pelvis" => ["Pelvis", "Becken", "Pelvis", "骨盆"],
        "pupil" => ["Pupil", "Pupille", "Pupila", "瞳孔"],
        "ribs" => ["Ribs", "Rippen", "Costillas", "肋骨"],
        "scapulae" => ["Scapulae", "Schulterblätter", "Escápulas", "肩胛骨"],
        "seeds" => ["Seeds", "Kerne", "Semillas", "种子"],
        "shell" => ["Shell", "Hülle", "Cubierta", "外壳"],
        "skin" => ["Skin", "Haut", "Piel", "皮肤"],
        "spine" => ["Spine", "Wirbelsäule", "Columna vertebral", "脊柱"],
        "spleen" => ["Spleen", "Milz", "Bazo", "脾"],
        "sternum" => ["Sternum", "Brustbein", "Esternón", "胸骨"],
        "stomach" => ["Stomach", "Magen", "Estómago", "胃"],
        "teeth" => ["Teeth", "Zähne", "Dientes", "牙齿"],
        "tendons" => ["Tendons", "Sehnen", "Tendones", "肌腱"],
        "tibia" => ["Tibia", "Schienbein", "Tibia", "胫骨"],
        "tongue" => ["Tongue", "Zunge", "Lengua", "舌"],
        "ureters" => ["Ureters", "Harnleiter", "Uréteres", "输尿管"],
        "veins" => ["Veins", "Venen", "Venas", "静脉"],
        "ventricles" => ["Ventricles", "Hirnkammern", "Ventrículos", "脑室"],
        "wall" => ["Wall", "Wand", "Pared", "壁"],
        "white matter" => ["White matter", "Weiße Substanz", "Sustancia blanca", "白质"],
        _ => return None,
    })
}

/// What segments of the cube and the piggy bank are called: words that an author's own segment may have too, where they
/// mean something else, so that only descriptions of pictures know them.
#[rustfmt::skip]
fn plain_segment(name: &str) -> Option<Line> {
    Some(match name {
        "ball" => ["Ball", "Kugel", "Bola", "球"],
        "bottom" => ["Bottom layer", "Untere Schicht", "Capa inferior", "底层"],
        "middle" => ["Middle layer", "Mittlere Schicht", "Capa media", "中层"],
        "plug" => ["Plug", "Stopfen", "Tapón", "塞子"],
        "top" => ["Top layer", "Obere Schicht", "Capa superior", "顶层"],
        _ => return None,
    })
}

/// A segment's name within a sentence: known ones in the language, also where a number tells a second one apart; names
/// that a file or an author brought stay as they are.
pub(super) fn segment_in_sentence(name: &str, lang: Lang) -> String {
    if let Some(line) = segment(name).or_else(|| plain_segment(name)) {
        return in_sentence(lang.of(line), lang);
    }
    if let Some((before, number)) = name.rsplit_once(' ')
        && number.parse::<u32>().is_ok()
        && let Some(line) = segment(before)
    {
        return format!("{} {number}", in_sentence(lang.of(line), lang));
    }
    super::lang::one_line(name, MAX_NAME)
}

/// The object's name within a sentence: what a built-in subject is called, what the author called a file, or `None`.
pub(super) fn subject_in_sentence(of: &SubjectRef, lang: Lang) -> Option<String> {
    let name = match of {
        SubjectRef::Builtin { name, .. } => match subject(name) {
            Some(line) => return Some(in_sentence(lang.of(line), lang)),
            None => name,
        },
        SubjectRef::Address { name, .. } | SubjectRef::Supplied { name, .. } => name,
        SubjectRef::Meshes { meshes, .. } => match meshes.as_slice() {
            [one] => &one.name,
            _ => return None,
        },
        SubjectRef::Clay(_) => {
            let clay = lang.of(["Clay", "Ton", "Arcilla", "黏土"]);
            return Some(in_sentence(clay, lang));
        }
    };
    let name = super::lang::one_line(name, MAX_NAME);
    (!name.is_empty()).then_some(name)
}

/// True if left and right are a patient's: of a scan, and of built-in subjects that are part of a body.
pub fn has_patient(of: &SubjectRef) -> bool {
    match of {
        SubjectRef::Builtin { name, .. } => {
            matches!(name.as_str(), "head" | "hand" | "torso" | "knee")
        }
        SubjectRef::Clay(_) => false,
        SubjectRef::Address { .. } | SubjectRef::Supplied { .. } | SubjectRef::Meshes { .. } => {
            true
        }
    }
}

/// Most characters of a name in a sentence.
const MAX_NAME: usize = 80;

/// Where nouns have no capitals, without its own.
fn in_sentence(name: &str, lang: Lang) -> String {
    match lang {
        Lang::English | Lang::Spanish => name.to_lowercase(),
        Lang::German | Lang::Chinese => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_language() {
        let name = |name: &str| Lang::ALL.map(|lang| segment_in_sentence(name, lang));
        assert_eq!(name("bone"), ["bone", "Knochen", "hueso", "骨"]);
        assert_eq!(name("bone 2"), ["bone 2", "Knochen 2", "hueso 2", "骨 2"]);
        assert_eq!(name("Tumor A\n7"), ["Tumor A 7"; 4].map(str::to_owned));
        assert_eq!(name(&"x".repeat(500))[0].chars().count(), MAX_NAME + 1);
    }
}
