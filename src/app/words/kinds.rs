//! The catalogue's names and explanations. English is what the catalogue itself says, but for two titles; a match
//! without a kind does not compile, and a test holds the number of parameters.

use super::{Lang, capitalized, lang, of};
use crate::document::TemplateKind;

/// German, Spanish, Chinese; English stands in the catalogue.
type Line = [&'static str; Lang::COUNT - 1];

/// Texts of one kind of template.
struct Kind {
    title: [&'static str; Lang::COUNT],
    summary: Line,
    /// Name and summary of each parameter, in the catalogue's order.
    params: &'static [(Line, Line)],
}

const ANGLE: Line = ["Winkel", "Ángulo", "角度"];
const DEPTH: Line = ["Tiefe", "Profundidad", "深度"];
const AMOUNT: Line = ["Maß", "Cantidad", "幅度"];
const LENGTH: Line = ["Länge", "Longitud", "长度"];
const FALLOFF: Line = ["Abklingen", "Atenuación", "衰减"];
const STRENGTH: Line = ["Stärke", "Intensidad", "强度"];
const EDGE: Line = ["Rand", "Borde", "边缘"];
const EDGE_MEANS: Line = [
    "Breite, in der es an den Flächen des Quaders endet",
    "Anchura en que termina en las caras de la caja",
    "在盒子各面处收尾的宽度",
];
const TIMES: Line = [
    "Mal die Verschiebung",
    "Veces el desplazamiento",
    "位移的倍数",
];
const OFFSET: Line = ["Versatz", "Desplazamiento", "位移"];
const HALF_OPENING: Line = [
    "Halbe Öffnung oben",
    "Media abertura arriba",
    "顶部开口的一半",
];
const HALF_LENGTH: Line = [
    "Halbe Länge des Schnitts",
    "Mitad de la longitud de la incisión",
    "切口长度的一半",
];

fn kind_words(kind: TemplateKind) -> Kind {
    use TemplateKind as K;
    match kind {
        K::Poke => Kind {
            title: ["Poke", "Beule", "Bulto", "凸起"],
            summary: [
                "Eine Beule entlang z eindrücken oder herausziehen",
                "Hundir o sacar un bulto según z",
                "沿 z 压入或拉出一个凸起",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Höhe; positiv zieht heraus",
                        "Altura; positivo saca hacia fuera",
                        "高度；正值向外拉",
                    ],
                ),
                (
                    ["Breite", "Anchura", "宽度"],
                    ["Breite der Beule", "Anchura del bulto", "凸起的宽度"],
                ),
            ],
        },
        K::Twist => Kind {
            title: ["Twist", "Verdrehen", "Torsión", "扭转"],
            summary: [
                "Um die z-Achse verdrehen",
                "Torcer en torno al eje z",
                "绕 z 轴扭转",
            ],
            params: &[
                (
                    ANGLE,
                    ["Drehung der Mitte", "Giro del centro", "中部的转角"],
                ),
                (
                    FALLOFF,
                    [
                        "0 dreht den ganzen Quader, 1 klingt von der Achse an ab",
                        "0 gira toda la caja, 1 se atenúa desde el eje",
                        "0 转动整个盒子，1 从轴线起逐渐减弱",
                    ],
                ),
            ],
        },
        K::Wave => Kind {
            title: ["Wave", "Welle", "Onda", "波纹"],
            summary: [
                "Ringförmige Wellen entlang y",
                "Ondas concéntricas según y",
                "沿 y 的同心波纹",
            ],
            params: &[
                (
                    ["Höhe", "Amplitud", "振幅"],
                    ["Höhe der Wellen", "Altura de la onda", "波纹的高度"],
                ),
                (
                    ["Frequenz", "Frecuencia", "频率"],
                    [
                        "Radiant je Einheit des Radius",
                        "Radianes por unidad de radio",
                        "每单位半径的弧度",
                    ],
                ),
                (
                    FALLOFF,
                    [
                        "0 wellt den ganzen Quader, 1 klingt von der Achse an ab",
                        "0 ondula toda la caja, 1 se atenúa desde el eje",
                        "0 使整个盒子起伏，1 从轴线起逐渐减弱",
                    ],
                ),
            ],
        },
        K::Bend => Kind {
            title: ["Bend", "Biegen", "Doblar", "弯曲"],
            summary: [
                "Einen Balken biegen, der entlang y verläuft",
                "Doblar una barra que corre según y",
                "弯曲沿 y 方向的长条",
            ],
            params: &[
                (
                    ANGLE,
                    [
                        "Nach -z, oder nach +z, wenn negativ",
                        "Hacia -z, o hacia +z si es negativo",
                        "朝 -z，负值则朝 +z",
                    ],
                ),
                (
                    ["Anfang", "Inicio", "起点"],
                    [
                        "Wo entlang y die Biegung beginnt",
                        "Dónde empieza la curva según y",
                        "弯曲沿 y 的起点",
                    ],
                ),
                (
                    ["Ende", "Fin", "终点"],
                    [
                        "Wo entlang y die Biegung endet",
                        "Dónde acaba la curva según y",
                        "弯曲沿 y 的终点",
                    ],
                ),
            ],
        },
        K::Squeeze => Kind {
            title: ["Squeeze", "Einschnüren", "Estrechar", "收腰"],
            summary: [
                "Eine Taille auf halber Höhe",
                "Una cintura a media altura",
                "在半高处收窄",
            ],
            params: &[(STRENGTH, ["Wie schmal", "Cuánto se estrecha", "收窄程度"])],
        },
        K::Dilate => Kind {
            title: ["Dilate", "Weiten", "Dilatar", "膨胀"],
            summary: [
                "Ein Bauch auf halber Höhe",
                "Un abombamiento a media altura",
                "在半高处鼓起",
            ],
            params: &[(STRENGTH, ["Wie weit", "Cuánto se ensancha", "鼓起程度"])],
        },
        K::Peel => Kind {
            title: ["Peel", "Abrollen", "Enrollar", "卷起"],
            summary: [
                "Eine Schicht vom Rand x = 0 her aufrollen",
                "Enrollar una capa desde el borde x = 0",
                "从 x = 0 边缘卷起一层",
            ],
            params: &[
                (
                    ["Fortschritt", "Avance", "进度"],
                    [
                        "Wie weit die Rolle entlang x gekommen ist",
                        "Hasta dónde ha llegado el rollo según x",
                        "卷曲沿 x 的进度",
                    ],
                ),
                (
                    DEPTH,
                    [
                        "Dicke der Schicht unter der Oberseite, Teil von z",
                        "Grosor de la capa bajo la cara superior, fracción de z",
                        "顶面下层的厚度，z 的比例",
                    ],
                ),
                (
                    ["Radius", "Radio", "半径"],
                    [
                        "Innenseite der Rolle, Teil von x",
                        "Interior del rollo, fracción de x",
                        "卷的内半径，x 的比例",
                    ],
                ),
                (
                    ANGLE,
                    [
                        "Wo die Rolle endet und der Lappen gerade weitergeht",
                        "Dónde acaba el rollo y el colgajo sigue recto",
                        "卷曲结束、皮瓣伸直之处",
                    ],
                ),
            ],
        },
        K::Flap => Kind {
            title: ["Flap", "Klappe", "Colgajo", "翻瓣"],
            summary: [
                "Eine Tür, die sich um ihre Kante x = 0, z = 1 öffnet",
                "Una puerta que se abre por su arista x = 0, z = 1",
                "绕 x = 0、z = 1 边打开的门",
            ],
            params: &[
                (
                    ANGLE,
                    [
                        "Wie weit sie offen ist",
                        "Cuánto está abierta",
                        "打开的角度",
                    ],
                ),
                (
                    DEPTH,
                    [
                        "Dicke der Tür unter der Oberseite, Teil von z",
                        "Grosor de la puerta bajo la cara superior, fracción de z",
                        "顶面下门的厚度，z 的比例",
                    ],
                ),
            ],
        },
        K::Split => Kind {
            title: ["Split", "Spalten", "Partir", "劈开"],
            summary: [
                "Zwei Hälften entlang x auseinander",
                "Dos mitades separadas según x",
                "沿 x 分成两半",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Halbe Breite der Öffnung",
                        "Mitad de la anchura de la abertura",
                        "开口宽度的一半",
                    ],
                ),
                (
                    ["Linse", "Lente", "透镜形"],
                    [
                        "1 schließt die Öffnung an beiden Enden in y",
                        "1 cierra la abertura en ambos extremos de y",
                        "1 使开口在 y 两端闭合",
                    ],
                ),
                (
                    ["Keil", "Cuña", "楔形"],
                    [
                        "Unten geschlossen, oben offen",
                        "Cerrada abajo, abierta arriba",
                        "底部闭合，顶部张开",
                    ],
                ),
            ],
        },
        K::Slices => Kind {
            title: ["Slices", "Scheiben", "Rodajas", "切片"],
            summary: [
                "Entlang z in Scheiben schneiden und auseinanderziehen",
                "Cortar en rodajas según z y separarlas",
                "沿 z 切成薄片并拉开",
            ],
            params: &[
                (
                    ["Anzahl", "Número", "数量"],
                    ["Zahl der Scheiben", "Número de rodajas", "薄片数量"],
                ),
                (
                    ["Abstand", "Separación", "间隔"],
                    ["Zwischen zwei Scheiben", "Entre dos rodajas", "两片之间"],
                ),
                (
                    ["Versatz", "Corrimiento", "偏移"],
                    [
                        "Seitwärts, entlang x, je Scheibe",
                        "Hacia el lado, según x, por rodaja",
                        "每片沿 x 的侧移",
                    ],
                ),
                (
                    ["Fortschritt", "Avance", "进度"],
                    [
                        "0 geschlossen, 1 auseinandergezogen",
                        "0 cerradas, 1 separadas",
                        "0 闭合，1 拉开",
                    ],
                ),
            ],
        },
        K::Retractor => Kind {
            title: ["Retractor", "Wundhaken", "Separador", "牵开器"],
            summary: [
                "Einen Schnitt entlang x aufziehen; das Gewebe daneben wird gestaucht",
                "Abrir una incisión según x comprimiendo el tejido de al lado",
                "拉开沿 x 的切口，压缩旁边的组织",
            ],
            params: &[
                (AMOUNT, HALF_OPENING),
                (LENGTH, HALF_LENGTH),
                (
                    ["Reichweite", "Alcance", "范围"],
                    [
                        "Wie weit daneben das Gewebe nachgibt",
                        "Hasta dónde cede el tejido de al lado",
                        "旁侧组织让位的范围",
                    ],
                ),
            ],
        },
        K::Cutquad => Kind {
            title: ["Incision", "Schnitt", "Incisión", "切口"],
            summary: [
                "Ein Schnitt entlang y mit gewölbten Lippen",
                "Una incisión según y con labios abombados",
                "沿 y 的切口，边缘隆起",
            ],
            params: &[
                (AMOUNT, HALF_OPENING),
                (LENGTH, HALF_LENGTH),
                (
                    ["Wulst", "Reborde", "隆起"],
                    [
                        "Höhe der gewölbten Lippen",
                        "Altura de los labios abombados",
                        "隆起边缘的高度",
                    ],
                ),
            ],
        },
        K::Peeler => Kind {
            title: ["Tongue", "Zunge", "Lengüeta", "舌瓣"],
            summary: [
                "Eine Zunge der obersten Schicht anheben",
                "Levantar una lengüeta de la capa superior",
                "掀起顶层的舌形瓣",
            ],
            params: &[
                (
                    ["Hub", "Elevación", "抬起"],
                    ["Höhe an der Spitze", "Altura en la punta", "尖端的高度"],
                ),
                (
                    ["Breite", "Anchura", "宽度"],
                    ["Breite der Zunge", "Anchura de la lengüeta", "舌瓣的宽度"],
                ),
            ],
        },
        K::Pull => Kind {
            title: ["Pull", "Ziehen", "Estirar", "牵拉"],
            summary: [
                "Die Mitte des Quaders entlang eines Vektors ziehen",
                "Tirar del centro de la caja según un vector",
                "沿向量牵拉盒子中部",
            ],
            params: &[(
                OFFSET,
                [
                    "Wohin die Mitte kommt, Teile des Quaders",
                    "Adónde va el centro, fracciones de la caja",
                    "中部的去向，盒子的比例",
                ],
            )],
        },
        K::Cut => Kind {
            title: ["Cut", "Ausschneiden", "Recortar", "切除"],
            summary: [
                "Material entfernen, nichts bewegen",
                "Quitar material sin mover nada",
                "移除材料，不移动任何部分",
            ],
            params: &[(
                ["Form", "Forma", "形状"],
                ["Was entfernt wird", "Lo que se quita", "移除的形状"],
            )],
        },
        K::Hole => Kind {
            title: ["Hole", "Loch", "Agujero", "孔"],
            summary: [
                "Eine runde Öffnung entlang z zur Seite schieben",
                "Apartar el tejido en una abertura redonda según z",
                "沿 z 推开一个圆孔",
            ],
            params: &[
                (AMOUNT, ["Radius oben", "Radio arriba", "顶部半径"]),
                (
                    ["Verjüngung", "Conicidad", "锥度"],
                    [
                        "Radius unten als Teil davon",
                        "Radio abajo como fracción del de arriba",
                        "底部半径与顶部之比",
                    ],
                ),
            ],
        },
        K::Lens => Kind {
            title: ["Lens", "Lupe", "Lupa", "放大镜"],
            summary: [
                "Die Mitte des Quaders vergrößern",
                "Ampliar el centro de la caja",
                "放大盒子中部",
            ],
            params: &[(STRENGTH, ["Wie stark", "Cuánto", "放大程度"])],
        },
        K::Move => Kind {
            title: ["Move", "Versetzen", "Trasladar", "移出"],
            summary: [
                "Den Quader ganz herausnehmen und anderswo hinsetzen",
                "Sacar la caja entera y ponerla en otro sitio",
                "将盒子整体取出放到别处",
            ],
            params: &[
                (
                    OFFSET,
                    [
                        "Wie weit, Teile des Quaders",
                        "Cuánto, fracciones de la caja",
                        "距离，盒子的比例",
                    ],
                ),
                (
                    ["Drehung", "Giro", "旋转"],
                    [
                        "Um seine Mitte gedreht",
                        "Girado en torno a su centro",
                        "绕其中心旋转",
                    ],
                ),
            ],
        },
        K::Rbf => Kind {
            title: ["Points", "Punkte", "Puntos", "控制点"],
            summary: [
                "Verschiebungen an Kontrollpunkten, dazwischen interpoliert",
                "Desplazamientos en puntos de control, interpolados",
                "控制点处的位移，其间插值",
            ],
            params: &[
                (STRENGTH, TIMES),
                (
                    ["Weichheit", "Suavidad", "柔度"],
                    [
                        "Reichweite eines Punktes, Teile des Quaders",
                        "Alcance de un punto, fracciones de la caja",
                        "控制点的作用范围，盒子的比例",
                    ],
                ),
                (
                    ["Exponent", "Exponente", "指数"],
                    [
                        "Der Multiquadrik; -0,5 ist glatt und örtlich",
                        "De la multicuádrica; -0,5 es suave y local",
                        "多二次函数的指数；-0.5 平滑而局部",
                    ],
                ),
                (
                    ["Ausziehen", "Extruir", "拉伸"],
                    [
                        "Die Punkte gelten in x und y, für jedes z",
                        "Los puntos cuentan en x e y, para cada z",
                        "控制点仅按 x 和 y 计，对所有 z 有效",
                    ],
                ),
                (
                    FALLOFF,
                    [
                        "0 zieht durch den ganzen Quader, 1 klingt von der Mitte an ab",
                        "0 extruye toda la caja, 1 se atenúa desde el centro",
                        "0 贯穿整个盒子，1 从中部开始衰减",
                    ],
                ),
                (EDGE, EDGE_MEANS),
            ],
        },
        K::Field => Kind {
            title: [
                "Displacement field",
                "Verschiebungsfeld",
                "Campo de desplazamiento",
                "位移场",
            ],
            summary: [
                "Ein Verschiebungsfeld aus einer Datei",
                "Un campo de desplazamiento de un archivo",
                "文件中的位移场",
            ],
            params: &[
                (STRENGTH, TIMES),
                (
                    ["Einheit", "Unidad", "单位"],
                    [
                        "Der Vektoren in der Datei",
                        "De los vectores del archivo",
                        "文件中矢量的单位",
                    ],
                ),
                (
                    ["Achsen", "Ejes", "坐标轴"],
                    [
                        "Richtungen der Vektoren in der Datei",
                        "Direcciones de los vectores del archivo",
                        "文件中矢量的方向",
                    ],
                ),
                (EDGE, EDGE_MEANS),
            ],
        },
    }
}

/// The column of a language other than English.
fn column() -> Option<usize> {
    match lang() {
        Lang::English | Lang::Mirrored => None,
        Lang::German => Some(0),
        Lang::Spanish => Some(1),
        Lang::Chinese => Some(2),
    }
}

/// What people call a kind.
pub(crate) fn title(kind: TemplateKind) -> &'static str {
    of(kind_words(kind).title)
}

/// One line on what a kind does.
pub(crate) fn summary(kind: TemplateKind) -> &'static str {
    column().map_or(kind.spec().summary, |column| {
        kind_words(kind).summary[column]
    })
}

/// What people call a parameter, by its index in the catalogue.
pub(crate) fn param_name(kind: TemplateKind, param: usize) -> String {
    let words = column().and_then(|column| Some(kind_words(kind).params.get(param)?.0[column]));
    words.map_or_else(
        || capitalized(kind.spec().params[param].name),
        str::to_owned,
    )
}

/// One line on a parameter, without the unit of angles, which are shown in degrees.
pub(crate) fn param_summary(kind: TemplateKind, param: usize) -> &'static str {
    let words = column().and_then(|column| Some(kind_words(kind).params.get(param)?.1[column]));
    words.unwrap_or_else(|| {
        kind.spec().params[param]
            .summary
            .trim_end_matches(", radians")
    })
}

/// What people call a value of a parameter that has names for them.
pub(crate) fn choice(name: &str) -> String {
    let line = match name {
        "box" => ["Box", "Quader", "Caja", "盒子"],
        "sphere" => ["Sphere", "Kugel", "Esfera", "球"],
        "cylinder" => ["Cylinder", "Zylinder", "Cilindro", "圆柱"],
        "mm" => ["Millimetres", "Millimeter", "Milímetros", "毫米"],
        "subject" => [
            "Subject units",
            "Objekteinheiten",
            "Unidades del objeto",
            "对象单位",
        ],
        "auto" => [
            "As the file says",
            "Wie die Datei sagt",
            "Según el archivo",
            "按文件",
        ],
        "lps" => [
            "Left, posterior, superior",
            "Links, hinten, oben",
            "Izquierda, posterior, superior",
            "左、后、上",
        ],
        "ras" => [
            "Right, anterior, superior",
            "Rechts, vorne, oben",
            "Derecha, anterior, superior",
            "右、前、上",
        ],
        "halfspace" => ["Halfspace", "Halbraum", "Semiespacio", "半空间"],
        _ => return capitalized(name),
    };
    of(line).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::ParamKind;

    #[test]
    fn every_parameter_has_words() {
        for kind in TemplateKind::ALL {
            let words = kind_words(kind);
            let spec = kind.spec();
            assert_eq!(words.params.len(), spec.params.len(), "{}", spec.name);
            for param in spec.params {
                if let ParamKind::Choice { names } = param.kind {
                    super::super::set_lang(Lang::German);
                    for name in names {
                        assert_ne!(choice(name), capitalized(name), "{name} has no words");
                    }
                    super::super::set_lang(Lang::English);
                }
            }
        }
    }
}
