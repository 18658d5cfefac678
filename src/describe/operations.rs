//! What a template does, in one sentence, and how far.

use super::lang::{Lang, Line, one_line};
use crate::document::{
    Align, ConstrainBy, ParamKind, ParamValue, PlacedTemplate, TemplateData, TemplateKind,
};

/// What one template of a document does.
#[derive(Clone, Debug, PartialEq)]
pub struct Operation {
    /// Index in the document's `templates`.
    pub index: usize,
    /// The kind of template.
    pub kind: TemplateKind,
    /// The author's name for it, or empty.
    pub name: String,
    /// How far it goes; `None` for a kind that is done or not.
    pub extent: Option<Extent>,
    /// The sentence, without its end.
    pub(super) sentence: String,
    /// What it leaves alone; each a sentence without its end.
    pub(super) kept: Vec<String>,
}

/// How far a template goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// A part of what is possible, or times the displacement: 1 is all.
    Part(f32),
    /// An angle, degrees.
    Angle(f32),
    /// A length, subject units.
    Length(f32),
}

/// Below this an opening, a turn or a strength is none.
const NOTHING: f32 = 1e-4;

/// How lengths are told: the millimetres in one subject unit, where they are known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ruler {
    pub(super) mm_per_unit: Option<f64>,
    pub(super) lang: Lang,
}

impl Ruler {
    fn tell(self, extent: Extent) -> String {
        let lang = self.lang;
        match extent {
            Extent::Part(part) => lang.percent(part),
            Extent::Angle(degrees) => format!("{:.0}°", degrees).replace('-', "−"),
            Extent::Length(length) => match self.mm_per_unit {
                Some(mm) => {
                    let mm = lang.number(f64::from(length.abs()) * mm);
                    lang.fill(["{0} mm", "{0} mm", "{0} mm", "{0} 毫米"], &[&mm])
                }
                None => lang.fill(OF_LONGEST, &[&lang.percent(length.abs())]),
            },
        }
    }
}

const OF_LONGEST: Line = [
    "{0} of the longest side",
    "{0} der längsten Seite",
    "{0} del lado más largo",
    "最长边的 {0}",
];

/// What a template does; `None` if it is switched off or changes nothing.
pub(super) fn operation_of(placed: &PlacedTemplate, ruler: Ruler) -> Option<Operation> {
    let template = placed.acting();
    if !template.enabled {
        return None;
    }
    let lang = ruler.lang;
    let (line, extent) = doing(&template)?;
    // A box that shrinks tells by its amount how far it is.
    let extent = extent.or((placed.amount < 1.0).then_some(Extent::Part(placed.amount)));
    let told = extent.map(|extent| ruler.tell(extent));
    let count = template.number("count");
    let mut sentence = lang.fill(line, &[&told.clone().unwrap_or_default(), &count]);
    if !line[0].contains("{0}")
        && let Some(told) = told
    {
        sentence.push_str(lang.of([", ", ", ", ", ", "，"]));
        sentence.push_str(&told);
    }
    for (line, extent) in besides(&template) {
        sentence.push_str(&lang.fill(line, &[&ruler.tell(extent)]));
    }
    if template.curve.is_some() {
        sentence.push_str(lang.of(ALONG_CURVE));
    }
    let name = one_line(&placed.name, 80);
    if !name.is_empty() {
        sentence.push_str(&lang.fill([" (“{0}”)", " („{0}“)", " («{0}»)", "（“{0}”）"], &[&name]));
    }
    Some(Operation {
        index: placed.index,
        kind: placed.kind,
        name: placed.name.clone(),
        extent,
        sentence,
        kept: kept(&template, ruler),
    })
}

const ALONG_CURVE: Line = [
    ", along a curve",
    ", entlang einer Kurve",
    ", a lo largo de una curva",
    "，沿一条曲线",
];

/// The sentence of a kind with a gap for how far, and how far it goes; `None` where it does nothing.
fn doing(template: &PlacedTemplate) -> Option<(Line, Option<Extent>)> {
    use TemplateKind as K;
    let size = template.placement.size;
    let number = |name: &str| template.number(name);
    let some = |value: f32| (value.abs() > NOTHING).then_some(value);
    let length = |value: f32, line: Line| Some((line, Some(Extent::Length(some(value)?))));
    let part = |value: f32, line: Line| Some((line, Some(Extent::Part(some(value)?))));
    // Openings are told as parts of the widest that there is: how wide they are at the surface depends on where it
    // lies in the template's box.
    let of_most = |line: Line| part(part_of_most(template), line);
    let degrees =
        |value: f32, line: Line| Some((line, Some(Extent::Angle(some(value)?.to_degrees()))));
    match template.kind {
        K::Poke => match number("amount") {
            amount if amount > 0.0 => of_most([
                "A bump is pulled out, {0}",
                "Eine Beule ist herausgezogen, {0}",
                "Se ha sacado un bulto, {0}",
                "向外拉出一个凸起，{0}",
            ]),
            _ => of_most([
                "A dent is pushed in, {0}",
                "Eine Delle ist eingedrückt, {0}",
                "Se ha hundido un hoyo, {0}",
                "向内压出一个凹陷，{0}",
            ]),
        },
        K::Twist => degrees(
            number("angle"),
            [
                "It is twisted by {0}",
                "Um {0} verdreht",
                "Torsión de {0}",
                "扭转 {0}",
            ],
        ),
        K::Wave => length(
            number("amplitude") * size.y,
            [
                "Ripples run through it, {0} high",
                "Wellen laufen hindurch, {0} hoch",
                "Lo recorren ondas de {0} de altura",
                "波纹穿过其间，高 {0}",
            ],
        ),
        K::Bend => match number("angle") {
            angle if angle > 0.0 => degrees(
                angle,
                [
                    "It is bent inwards by {0}",
                    "Um {0} nach innen gebogen",
                    "Curvatura hacia dentro de {0}",
                    "向内弯曲 {0}",
                ],
            ),
            angle => degrees(
                -angle,
                [
                    "It is bent outwards by {0}",
                    "Um {0} nach außen gebogen",
                    "Curvatura hacia fuera de {0}",
                    "向外弯曲 {0}",
                ],
            ),
        },
        K::Squeeze => part(
            number("strength"),
            [
                "A waist is drawn in, strength {0}",
                "Eine Taille ist eingeschnürt, Stärke {0}",
                "Se ha estrechado una cintura, intensidad {0}",
                "中部收窄，强度 {0}",
            ],
        ),
        K::Dilate => part(
            number("strength"),
            [
                "The middle bulges, strength {0}",
                "Die Mitte ist geweitet, Stärke {0}",
                "El centro está dilatado, intensidad {0}",
                "中部鼓起，强度 {0}",
            ],
        ),
        K::Peel if some(number("angle")).is_none() => None,
        K::Peel => part(
            number("progress"),
            [
                "The layer is peeled back, {0}",
                "Die Schicht ist abgerollt, {0}",
                "La capa está enrollada, {0}",
                "表层已卷起，{0}",
            ],
        ),
        K::Flap => degrees(
            number("angle"),
            [
                "A flap is folded open by {0}",
                "Eine Klappe ist um {0} aufgeklappt",
                "Un colgajo está abierto {0}",
                "一片皮瓣翻开 {0}",
            ],
        ),
        K::Split => of_most([
            "Two halves are drawn apart, {0}",
            "Zwei Hälften sind auseinandergezogen, {0}",
            "Dos mitades están separadas, {0}",
            "分成两半并拉开，{0}",
        ]),
        K::Slices if number("count") < 1.5 => None,
        K::Slices if some(number("gap")).or(some(number("shift"))).is_none() => None,
        K::Slices => part(
            number("progress"),
            [
                "Cut into {1} slices and drawn apart, {0}",
                "In {1} Scheiben geschnitten und auseinandergezogen, {0}",
                "Corte en {1} rodajas separadas, {0}",
                "切成 {1} 片并拉开，{0}",
            ],
        ),
        K::Retractor => of_most([
            "An incision is drawn open, {0}",
            "Ein Schnitt ist aufgezogen, {0}",
            "Una incisión está abierta con separadores, {0}",
            "切口已拉开，{0}",
        ]),
        K::Cutquad => of_most([
            "An incision gapes, {0}",
            "Ein Schnitt klafft, {0}",
            "Una incisión está abierta, {0}",
            "切口张开，{0}",
        ]),
        K::Peeler => length(
            number("lift") * size.z,
            [
                "A tongue of tissue is lifted, {0} high",
                "Eine Gewebezunge ist angehoben, {0} hoch",
                "Una lengüeta de tejido está levantada {0}",
                "一条舌形瓣掀起 {0}",
            ],
        ),
        K::Pull => length(
            (vector(template) * size).length(),
            [
                "Tissue is pulled {0} out of its place",
                "Gewebe ist um {0} von seinem Platz gezogen",
                "El tejido está estirado {0} desde su sitio",
                "组织被牵离原位 {0}",
            ],
        ),
        K::Crack => of_most([
            "A crack is drawn apart, {0}",
            "Ein Riss ist auseinandergezogen, {0}",
            "Una grieta está abierta, {0}",
            "裂缝已拉开，{0}",
        ]),
        K::Cut => Some((removed(template), None)),
        K::Hole => of_most([
            "Tissue is pushed aside into a round opening, {0}",
            "Gewebe ist zu einer runden Öffnung beiseitegeschoben, {0}",
            "El tejido está apartado en una abertura redonda, {0}",
            "组织被推开成圆孔，{0}",
        ]),
        K::Lens => part(
            number("strength"),
            [
                "A part is magnified, strength {0}",
                "Ein Teil ist vergrößert, Stärke {0}",
                "Una parte está ampliada, intensidad {0}",
                "局部放大，强度 {0}",
            ],
        ),
        K::Move => {
            let line = [
                "A piece is taken out and put {0} away",
                "Ein Stück ist herausgenommen und um {0} versetzt",
                "Un trozo está sacado y colocado a {0}",
                "一块被取出，移开 {0}",
            ];
            let turned = [
                "A piece is turned where it is",
                "Ein Stück ist an seinem Platz gedreht",
                "Un trozo está girado en su sitio",
                "一块在原位转动",
            ];
            let is_turned = turn_of(template) > 0.05;
            let moved = length((vector(template) * size).length(), line);
            moved.or(is_turned.then_some((turned, None)))
        }
        K::Rbf if !has_moves(template) => None,
        K::Rbf => part(
            number("strength"),
            [
                "Single points are moved and the tissue between them follows, strength {0}",
                "Einzelne Punkte sind verschoben, das Gewebe dazwischen folgt, Stärke {0}",
                "Se han movido puntos sueltos y el tejido intermedio los sigue, intensidad {0}",
                "若干点被移动，其间的组织随之移动，强度 {0}",
            ],
        ),
        K::Field => part(
            number("strength"),
            [
                "A displacement field is applied, strength {0}",
                "Ein Verschiebungsfeld ist angewandt, Stärke {0}",
                "Se aplica un campo de desplazamiento, intensidad {0}",
                "应用了位移场，强度 {0}",
            ],
        ),
        K::Sweep if !has_moves(template) => None,
        K::Sweep => part(
            number("progress"),
            [
                "Tools push and pull the tissue along, {0} of their way",
                "Werkzeuge schieben und ziehen das Gewebe mit, {0} ihres Weges",
                "Unos instrumentos empujan y arrastran el tejido, {0} de su recorrido",
                "器械推拉组织，行程 {0}",
            ],
        ),
        K::Carve if template.carves_by().is_none() => None,
        K::Carve => {
            let line = [
                "The tissue is cut by a tool and pushed aside by {0}",
                "Das Gewebe ist von einem Werkzeug geschnitten und um {0} beiseite gedrückt",
                "El tejido está cortado por un instrumento y apartado {0}",
                "组织被器械切开，并推开 {0}",
            ];
            let still = [
                "The tissue is cut by a tool",
                "Das Gewebe ist von einem Werkzeug geschnitten",
                "El tejido está cortado por un instrumento",
                "组织被器械切开",
            ];
            length(number("push").max(0.0), line).or(Some((still, None)))
        }
    }
}

/// What else a kind does, each with a gap for how far.
fn besides(template: &PlacedTemplate) -> Vec<(Line, Extent)> {
    let mut besides = Vec::new();
    match template.kind {
        TemplateKind::Slices => {
            let shift = template.number("shift") * template.placement.size.x;
            if shift.abs() > NOTHING {
                let line = [
                    ", each {0} to the side of the one before",
                    ", jede um {0} seitlich der vorigen",
                    ", cada una {0} al lado de la anterior",
                    "，每片比前一片侧移 {0}",
                ];
                besides.push((line, Extent::Length(shift)));
            }
        }
        TemplateKind::Twist => {
            let line = [
                " over {0}",
                ", auf {0} Länge",
                " en {0}",
                "，分布于 {0}长度",
            ];
            besides.push((line, Extent::Length(template.placement.size.z)));
        }
        TemplateKind::Move => {
            let turn = turn_of(template);
            if turn > 0.05 {
                let line = [
                    ", turned by {0}",
                    ", um {0} gedreht",
                    ", girado {0}",
                    "，转动 {0}",
                ];
                besides.push((line, Extent::Angle(turn)));
            }
        }
        _ => {}
    }
    besides
}

/// The main number of a template, as a part of the most that it can be.
fn part_of_most(template: &PlacedTemplate) -> f32 {
    let spec = template.kind.spec();
    let Some(main) = spec.main_param.and_then(|i| spec.params.get(i)) else {
        return 0.0;
    };
    let ParamKind::Number { min, max, .. } = main.kind else {
        return 0.0;
    };
    let value = template.number(main.name);
    value / if value < 0.0 { min } else { max }
}

/// The first vector among the parameters.
fn vector(template: &PlacedTemplate) -> glam::Vec3 {
    let mut vectors = template.params.iter().filter_map(|value| match value {
        ParamValue::Vector(vector) => Some(*vector),
        _ => None,
    });
    vectors.next().unwrap_or_default()
}

/// How far the rotation among the parameters turns, degrees.
fn turn_of(template: &PlacedTemplate) -> f32 {
    let mut turns = template.params.iter().filter_map(|value| match value {
        ParamValue::Rotation(turn) => Some(*turn),
        _ => None,
    });
    let turn = turns.next().unwrap_or_default();
    turn.angle_between(glam::Quat::IDENTITY).to_degrees()
}

fn has_moves(template: &PlacedTemplate) -> bool {
    match &template.data {
        TemplateData::Points(points) => {
            let mut points = points.points.iter();
            points.any(|point| point.shift.length() > NOTHING)
        }
        TemplateData::Tools(tools) => tools.acting().any(|tool| tool.path.len() > 1),
        _ => false,
    }
}

/// What a cut removes, by its shape.
fn removed(template: &PlacedTemplate) -> Line {
    let shapes = template.params.iter().find_map(|value| match value {
        ParamValue::Choice(index) => Some(*index),
        _ => None,
    });
    match shapes {
        Some(1) => [
            "A ball is cut out",
            "Eine Kugel ist ausgeschnitten",
            "Se ha recortado una esfera",
            "切除了一块球形部分",
        ],
        Some(2) => [
            "A cylinder is cut out",
            "Ein Zylinder ist ausgeschnitten",
            "Se ha recortado un cilindro",
            "切除了一块圆柱形部分",
        ],
        Some(3) => [
            "Everything on one side of a plane is cut away",
            "Alles auf einer Seite einer Ebene ist weggeschnitten",
            "Se ha recortado todo lo que está a un lado de un plano",
            "平面一侧的全部被切除",
        ],
        _ => [
            "A block is cut away",
            "Ein Block ist weggeschnitten",
            "Se ha recortado un bloque",
            "切除了一块方形部分",
        ],
    }
}

/// What a template leaves alone.
fn kept(template: &PlacedTemplate, ruler: Ruler) -> Vec<String> {
    let lang = ruler.lang;
    let mut kept = Vec::new();
    match &template.align {
        Align::Axis => {}
        Align::Surface { depth, .. } => {
            let line = [
                "What lies more than {0} under the surface stays in place",
                "Was tiefer als {0} unter der Oberfläche liegt, bleibt am Platz",
                "Lo que está a más de {0} bajo la superficie se queda en su sitio",
                "表面下超过 {0} 的部分保持原位",
            ];
            kept.push(lang.fill(line, &[&ruler.tell(Extent::Length(*depth))]));
        }
        Align::Segment { keep, .. } => {
            let line = [
                "Left in place: {0}",
                "Am Platz gelassen: {0}",
                "Sin mover: {0}",
                "保持原位：{0}",
            ];
            kept.extend(listed(keep, line, lang));
        }
    }
    if let Some(constrain) = &template.constrain {
        let line = match constrain.by {
            ConstrainBy::Displacement | ConstrainBy::Coordinate => [
                "Protected tissue: {0}",
                "Geschütztes Gewebe: {0}",
                "Tejido protegido: {0}",
                "受保护组织：{0}",
            ],
            ConstrainBy::Bodies => [
                "Tissue of which each part moves in one piece: {0}",
                "Gewebe, von dem sich jedes als ein Stück bewegt: {0}",
                "Tejido del que cada parte se mueve en una pieza: {0}",
                "各自整体移动的组织：{0}",
            ],
            ConstrainBy::Parts => [
                "Tissue of which each connected part moves in one piece: {0}",
                "Gewebe, von dem sich jedes zusammenhängende Stück für sich bewegt: {0}",
                "Tejido del que cada parte conexa se mueve en una pieza: {0}",
                "各相连部分各自整体移动的组织：{0}",
            ],
            ConstrainBy::Rigid => [
                "Tissue that moves in one piece: {0}",
                "Gewebe, das sich als ein Stück bewegt: {0}",
                "Tejido que se mueve en una pieza: {0}",
                "整体移动的组织：{0}",
            ],
        };
        kept.extend(listed(&constrain.keep, line, lang));
    }
    kept
}

/// A line with the names of segments; nothing if there are none.
pub(super) fn listed(names: &[String], line: Line, lang: Lang) -> Option<String> {
    /// Most names in one sentence; if there are more, one name fewer is told, and how many others there are.
    const MOST: usize = 9;
    let told = match names.len() {
        0 => return None,
        n if n > MOST => MOST - 1,
        n => n,
    };
    let names_told = names.iter().take(told);
    let mut texts: Vec<String> = names_told
        .map(|name| super::names::segment_in_sentence(name, lang))
        .filter(|name| !name.is_empty())
        .collect();
    if names.len() > told {
        let more = names.len() - told;
        texts.push(lang.fill(
            ["{0} more", "{0} weitere", "{0} más", "另外 {0} 种"],
            &[&more],
        ));
    }
    (!texts.is_empty()).then(|| lang.fill(line, &[&lang.list(&texts)]))
}
