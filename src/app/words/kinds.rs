//! What people call the catalogue's kinds and parameters, and what these do, as one sees it on the box. A match without
//! a kind does not compile, and a test holds the number of parameters.

use super::{Lang, capitalized, of};
use crate::document::TemplateKind;

/// A text in every language.
type Line = [&'static str; Lang::COUNT];

/// Texts of one kind of template.
struct Kind {
    title: Line,
    summary: Line,
    /// Name and summary of each parameter, in the catalogue's order.
    params: &'static [(Line, Line)],
}

const ANGLE: Line = ["Angle", "Winkel", "Ángulo", "角度"];
const DEPTH: Line = ["Depth", "Tiefe", "Profundidad", "深度"];
const AMOUNT: Line = ["Amount", "Maß", "Cantidad", "幅度"];
const LENGTH: Line = ["Length", "Länge", "Longitud", "长度"];
const FALLOFF: Line = ["Falloff", "Abklingen", "Atenuación", "衰减"];
const STRENGTH: Line = ["Strength", "Stärke", "Intensidad", "强度"];
const EDGE: Line = ["Edge", "Rand", "Borde", "边缘"];
const EDGE_MEANS: Line = [
    "Width over which it ends at the faces of the box",
    "Breite, in der es an den Flächen des Quaders endet",
    "Anchura en que termina en las caras de la caja",
    "在盒子各面处收尾的宽度",
];
const TIMES: Line = [
    "Times the displacement",
    "Mal die Verschiebung",
    "Veces el desplazamiento",
    "位移的倍数",
];
const OFFSET: Line = ["Offset", "Versatz", "Desplazamiento", "位移"];
const HALF_OPENING: Line = [
    "Half the opening, at the surface",
    "Halbe Öffnung an der Oberfläche",
    "Mitad de la abertura en la superficie",
    "表面开口的一半",
];
const HALF_LENGTH: Line = [
    "Half the length of the incision",
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
                "Push in or pull out a bump",
                "Eine Beule eindrücken oder herausziehen",
                "Hundir o sacar un bulto",
                "压入或拉出一个凸起",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Height; positive pulls out",
                        "Höhe; positiv zieht heraus",
                        "Altura; positivo saca hacia fuera",
                        "高度；正值向外拉",
                    ],
                ),
                (
                    ["Width", "Breite", "Anchura", "宽度"],
                    [
                        "Width of the bump",
                        "Breite der Beule",
                        "Anchura del bulto",
                        "凸起的宽度",
                    ],
                ),
            ],
        },
        K::Twist => Kind {
            title: ["Twist", "Verdrehen", "Torsión", "扭转"],
            summary: [
                "Twist about the axis that points into the depth",
                "Um die Achse verdrehen, die in die Tiefe zeigt",
                "Torcer en torno al eje que entra en profundidad",
                "绕指向深处的轴扭转",
            ],
            params: &[
                (
                    ANGLE,
                    [
                        "Turn of the middle",
                        "Drehung der Mitte",
                        "Giro del centro",
                        "中部的转角",
                    ],
                ),
                (
                    FALLOFF,
                    [
                        "0 turns the whole box, 1 falls off from the axis on",
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
                "Ring-shaped ripples, up and down",
                "Ringförmige Wellen, auf und ab",
                "Ondas concéntricas, arriba y abajo",
                "上下起伏的同心波纹",
            ],
            params: &[
                (
                    ["Amplitude", "Höhe", "Amplitud", "振幅"],
                    [
                        "Height of the ripple",
                        "Höhe der Wellen",
                        "Altura de la onda",
                        "波纹的高度",
                    ],
                ),
                (
                    ["Frequency", "Frequenz", "Frecuencia", "频率"],
                    [
                        "How close together the rings lie",
                        "Wie dicht die Ringe liegen",
                        "Lo juntos que están los anillos",
                        "圆环的疏密",
                    ],
                ),
                (
                    FALLOFF,
                    [
                        "0 ripples the whole box, 1 falls off from the axis on",
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
                "Bend an upright bar",
                "Einen aufrechten Balken biegen",
                "Doblar una barra vertical",
                "弯曲一根竖直的长条",
            ],
            params: &[
                (
                    ANGLE,
                    [
                        "Into the depth; outwards if negative",
                        "In die Tiefe; nach außen, wenn negativ",
                        "Hacia el fondo; hacia fuera si es negativo",
                        "弯向深处；负值则向外",
                    ],
                ),
                (
                    ["Start", "Anfang", "Inicio", "起点"],
                    [
                        "Where the bend begins, from the lower end",
                        "Wo die Biegung beginnt, vom unteren Ende aus",
                        "Dónde empieza la curva, desde el extremo inferior",
                        "弯曲的起点，从下端算起",
                    ],
                ),
                (
                    ["End", "Ende", "Fin", "终点"],
                    [
                        "Where the bend ends, from the lower end",
                        "Wo die Biegung endet, vom unteren Ende aus",
                        "Dónde acaba la curva, desde el extremo inferior",
                        "弯曲的终点，从下端算起",
                    ],
                ),
            ],
        },
        K::Squeeze => Kind {
            title: ["Squeeze", "Einschnüren", "Estrechar", "收腰"],
            summary: [
                "A waist half way down",
                "Eine Taille auf halber Tiefe",
                "Una cintura a media profundidad",
                "在半深处收窄",
            ],
            params: &[(
                STRENGTH,
                ["How narrow", "Wie schmal", "Cuánto se estrecha", "收窄程度"],
            )],
        },
        K::Dilate => Kind {
            title: ["Dilate", "Weiten", "Dilatar", "膨胀"],
            summary: [
                "A bulge half way down",
                "Ein Bauch auf halber Tiefe",
                "Un abombamiento a media profundidad",
                "在半深处鼓起",
            ],
            params: &[(
                STRENGTH,
                ["How wide", "Wie weit", "Cuánto se ensancha", "鼓起程度"],
            )],
        },
        K::Peel => Kind {
            title: ["Peel", "Abrollen", "Enrollar", "卷起"],
            summary: [
                "Roll a layer up from its left edge",
                "Eine Schicht vom linken Rand her aufrollen",
                "Enrollar una capa desde el borde izquierdo",
                "从左边缘卷起一层",
            ],
            params: &[
                (
                    ["Progress", "Fortschritt", "Avance", "进度"],
                    [
                        "How far the roll has come from left to right",
                        "Wie weit die Rolle von links nach rechts gekommen ist",
                        "Hasta dónde ha llegado el rollo, de izquierda a derecha",
                        "卷曲从左到右的进度",
                    ],
                ),
                (
                    DEPTH,
                    [
                        "Thickness of the layer, as a part of the box's depth",
                        "Dicke der Schicht, Teil der Tiefe des Quaders",
                        "Grosor de la capa, parte de la profundidad de la caja",
                        "层的厚度，占盒子深度的比例",
                    ],
                ),
                (
                    ["Radius", "Radius", "Radio", "半径"],
                    [
                        "Inside of the roll, as a part of the box's width",
                        "Innenseite der Rolle, Teil der Breite des Quaders",
                        "Interior del rollo, parte de la anchura de la caja",
                        "卷的内半径，占盒子宽度的比例",
                    ],
                ),
                (
                    ANGLE,
                    [
                        "Where the roll ends and the flap goes on straight",
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
                "A door that opens about its left edge",
                "Eine Tür, die sich um ihre linke Kante öffnet",
                "Una puerta que se abre por su borde izquierdo",
                "绕左边缘打开的门",
            ],
            params: &[
                (
                    ANGLE,
                    [
                        "How far it is open",
                        "Wie weit sie offen ist",
                        "Cuánto está abierta",
                        "打开的角度",
                    ],
                ),
                (
                    DEPTH,
                    [
                        "Thickness of the door, as a part of the box's depth",
                        "Dicke der Tür, Teil der Tiefe des Quaders",
                        "Grosor de la puerta, parte de la profundidad de la caja",
                        "门的厚度，占盒子深度的比例",
                    ],
                ),
            ],
        },
        K::Split => Kind {
            title: ["Split", "Spalten", "Partir", "劈开"],
            summary: [
                "Two halves apart, to the left and to the right",
                "Zwei Hälften auseinander, nach links und nach rechts",
                "Dos mitades separadas, a izquierda y derecha",
                "向左右分成两半",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Half width of the opening",
                        "Halbe Breite der Öffnung",
                        "Mitad de la anchura de la abertura",
                        "开口宽度的一半",
                    ],
                ),
                (
                    ["Lens", "Linse", "Lente", "透镜形"],
                    [
                        "1 closes the opening at its upper and lower end",
                        "1 schließt die Öffnung am oberen und unteren Ende",
                        "1 cierra la abertura en su extremo superior e inferior",
                        "1 使开口的上下两端闭合",
                    ],
                ),
                (
                    ["Wedge", "Keil", "Cuña", "楔形"],
                    [
                        "Closed in the depth, open at the surface",
                        "In der Tiefe geschlossen, an der Oberfläche offen",
                        "Cerrada en el fondo, abierta en la superficie",
                        "深处闭合，表面张开",
                    ],
                ),
            ],
        },
        K::Crack => Kind {
            title: ["Crack", "Riss", "Grieta", "裂缝"],
            summary: [
                "A jagged break down from the surface, drawn apart",
                "Ein gezackter Bruch von der Oberfläche nach unten, auseinandergezogen",
                "Una rotura dentada desde la superficie hacia abajo, separada",
                "从表面向下的锯齿状断裂，向两侧拉开",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Width of the opening at the surface",
                        "Breite der Öffnung an der Oberfläche",
                        "Anchura de la abertura en la superficie",
                        "表面开口的宽度",
                    ],
                ),
                (
                    ["Lens", "Linse", "Lente", "透镜形"],
                    [
                        "1 closes the opening at both ends",
                        "1 schließt die Öffnung an beiden Enden",
                        "1 cierra la abertura en ambos extremos",
                        "1 表示两端闭合",
                    ],
                ),
                (
                    DEPTH,
                    [
                        "How deep it goes, as a part of the box's depth",
                        "Wie tief er reicht, Teil der Tiefe des Quaders",
                        "Hasta dónde llega, parte de la profundidad de la caja",
                        "裂缝深度，占盒子深度的比例",
                    ],
                ),
                (
                    ["Roughness", "Rauheit", "Rugosidad", "粗糙度"],
                    [
                        "Height of the teeth",
                        "Höhe der Zacken",
                        "Altura de los dientes",
                        "锯齿的高度",
                    ],
                ),
                (
                    ["Grain", "Körnung", "Grano", "颗粒"],
                    [
                        "Size of the largest teeth",
                        "Größe der größten Zacken",
                        "Tamaño de los dientes más grandes",
                        "最大锯齿的尺寸",
                    ],
                ),
                (
                    ["Variant", "Variante", "Variante", "变体"],
                    [
                        "Which of a thousand cracks",
                        "Welcher von tausend Rissen",
                        "Cuál de mil grietas",
                        "一千种裂缝中的哪一种",
                    ],
                ),
                (
                    ["Ripple", "Wellung", "Ondulación", "波纹"],
                    [
                        "Height of the waves",
                        "Höhe der Wellen",
                        "Altura de las ondas",
                        "波的高度",
                    ],
                ),
                (
                    ["Waves", "Wellen", "Ondas", "波数"],
                    [
                        "Number of waves along the crack; below 0 down into it",
                        "Zahl der Wellen entlang des Risses; unter 0 in die Tiefe",
                        "Número de ondas a lo largo de la grieta; por debajo de 0, hacia el fondo",
                        "沿裂缝方向的波数；小于 0 时沿深度方向",
                    ],
                ),
            ],
        },
        K::Slices => Kind {
            title: ["Slices", "Scheiben", "Rodajas", "切片"],
            summary: [
                "Cut into slabs, one below the other in depth, and draw them apart",
                "In der Tiefe in Scheiben schneiden und auseinanderziehen",
                "Cortar en rodajas en profundidad y separarlas",
                "沿深度切成薄片并拉开",
            ],
            params: &[
                (
                    ["Count", "Anzahl", "Número", "数量"],
                    [
                        "Number of slabs",
                        "Zahl der Scheiben",
                        "Número de rodajas",
                        "薄片数量",
                    ],
                ),
                (
                    ["Gap", "Abstand", "Separación", "间隔"],
                    [
                        "Between two slabs",
                        "Zwischen zwei Scheiben",
                        "Entre dos rodajas",
                        "两片之间",
                    ],
                ),
                (
                    ["Shift", "Versatz", "Corrimiento", "偏移"],
                    [
                        "Sideways, to the right, per slab",
                        "Seitwärts, nach rechts, je Scheibe",
                        "Hacia la derecha, por rodaja",
                        "每片向右的侧移",
                    ],
                ),
                (
                    ["Progress", "Fortschritt", "Avance", "进度"],
                    [
                        "0 closed, 1 drawn apart",
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
                "Draw a horizontal incision open; the tissue beside it is compressed",
                "Einen waagrechten Schnitt aufziehen; das Gewebe daneben wird gestaucht",
                "Abrir una incisión horizontal comprimiendo el tejido de al lado",
                "拉开水平切口，压缩旁边的组织",
            ],
            params: &[
                (AMOUNT, HALF_OPENING),
                (LENGTH, HALF_LENGTH),
                (
                    ["Reach", "Reichweite", "Alcance", "范围"],
                    [
                        "How far beside it tissue gives way",
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
                "A vertical incision with lips that bulge",
                "Ein senkrechter Schnitt mit gewölbten Lippen",
                "Una incisión vertical con labios abombados",
                "竖直切口，边缘隆起",
            ],
            params: &[
                (AMOUNT, HALF_OPENING),
                (LENGTH, HALF_LENGTH),
                (
                    ["Ripple", "Wulst", "Reborde", "隆起"],
                    [
                        "Height of the bulging lips",
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
                "Lift a tongue of the top layer",
                "Eine Zunge der obersten Schicht anheben",
                "Levantar una lengüeta de la capa superior",
                "掀起顶层的舌形瓣",
            ],
            params: &[
                (
                    ["Lift", "Hub", "Elevación", "抬起"],
                    [
                        "Height at the tip",
                        "Höhe an der Spitze",
                        "Altura en la punta",
                        "尖端的高度",
                    ],
                ),
                (
                    ["Width", "Breite", "Anchura", "宽度"],
                    [
                        "Width of the tongue",
                        "Breite der Zunge",
                        "Anchura de la lengüeta",
                        "舌瓣的宽度",
                    ],
                ),
            ],
        },
        K::Pull => Kind {
            title: ["Pull", "Ziehen", "Estirar", "牵拉"],
            summary: [
                "Draw the middle of the box in any direction",
                "Die Mitte des Quaders in eine beliebige Richtung ziehen",
                "Tirar del centro de la caja en cualquier dirección",
                "向任意方向牵拉盒子中部",
            ],
            params: &[(
                OFFSET,
                [
                    "Where the middle goes, fractions of the box",
                    "Wohin die Mitte kommt, Teile des Quaders",
                    "Adónde va el centro, fracciones de la caja",
                    "中部的去向，盒子的比例",
                ],
            )],
        },
        K::Cut => Kind {
            title: ["Cut", "Ausschneiden", "Recortar", "切除"],
            summary: [
                "Remove material, move nothing",
                "Material entfernen, nichts bewegen",
                "Quitar material sin mover nada",
                "移除材料，不移动任何部分",
            ],
            params: &[(
                ["Shape", "Form", "Forma", "形状"],
                [
                    "What is removed",
                    "Was entfernt wird",
                    "Lo que se quita",
                    "移除的形状",
                ],
            )],
        },
        K::Hole => Kind {
            title: ["Hole", "Loch", "Agujero", "孔"],
            summary: [
                "Push tissue aside into a round opening",
                "Gewebe zu einer runden Öffnung beiseiteschieben",
                "Apartar el tejido en una abertura redonda",
                "推开组织，形成圆孔",
            ],
            params: &[
                (
                    AMOUNT,
                    [
                        "Radius at the surface",
                        "Radius an der Oberfläche",
                        "Radio en la superficie",
                        "表面处的半径",
                    ],
                ),
                (
                    ["Taper", "Verjüngung", "Conicidad", "锥度"],
                    [
                        "Radius in the depth, as a part of the one at the surface",
                        "Radius in der Tiefe als Teil des Radius an der Oberfläche",
                        "Radio en el fondo como parte del de la superficie",
                        "深处半径与表面半径之比",
                    ],
                ),
            ],
        },
        K::Lens => Kind {
            title: ["Lens", "Lupe", "Lupa", "放大镜"],
            summary: [
                "Magnify the middle of the box",
                "Die Mitte des Quaders vergrößern",
                "Ampliar el centro de la caja",
                "放大盒子中部",
            ],
            params: &[(STRENGTH, ["How much", "Wie stark", "Cuánto", "放大程度"])],
        },
        K::Move => Kind {
            title: ["Move", "Versetzen", "Trasladar", "移出"],
            summary: [
                "Take the box out whole and put it elsewhere",
                "Den Quader ganz herausnehmen und anderswo hinsetzen",
                "Sacar la caja entera y ponerla en otro sitio",
                "将盒子整体取出放到别处",
            ],
            params: &[
                (
                    OFFSET,
                    [
                        "How far, fractions of the box",
                        "Wie weit, Teile des Quaders",
                        "Cuánto, fracciones de la caja",
                        "距离，盒子的比例",
                    ],
                ),
                (
                    ["Turn", "Drehung", "Giro", "旋转"],
                    [
                        "Turned about its centre",
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
                "Move single points; the tissue between them follows",
                "Einzelne Punkte bewegen; das Gewebe dazwischen folgt",
                "Mover puntos sueltos; el tejido intermedio los sigue",
                "移动若干点，其间的组织随之移动",
            ],
            params: &[
                (STRENGTH, TIMES),
                (
                    ["Softness", "Weichheit", "Suavidad", "柔度"],
                    [
                        "Reach of a control point, fractions of the box",
                        "Reichweite eines Punktes, Teile des Quaders",
                        "Alcance de un punto, fracciones de la caja",
                        "控制点的作用范围，盒子的比例",
                    ],
                ),
                (
                    ["Exponent", "Exponent", "Exponente", "指数"],
                    [
                        "How the pull fades with distance; -0.5 is smooth and stays near",
                        "Wie der Zug mit dem Abstand nachlässt; -0,5 ist glatt und bleibt in der Nähe",
                        "Cómo decae con la distancia; -0,5 es suave y local",
                        "牵引随距离减弱的方式；-0.5 平滑而局部",
                    ],
                ),
                (
                    ["Extrude", "Ausziehen", "Extruir", "拉伸"],
                    [
                        "The same at every depth",
                        "In jeder Tiefe gleich",
                        "Igual a cualquier profundidad",
                        "在任何深度都相同",
                    ],
                ),
                (
                    FALLOFF,
                    [
                        "0 reaches through the whole box, 1 fades from its middle on",
                        "0 reicht durch den ganzen Quader, 1 klingt von der Mitte an ab",
                        "0 atraviesa toda la caja, 1 se atenúa desde el centro",
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
                "A displacement field from a file",
                "Ein Verschiebungsfeld aus einer Datei",
                "Un campo de desplazamiento de un archivo",
                "文件中的位移场",
            ],
            params: &[
                (STRENGTH, TIMES),
                (
                    ["Units", "Einheit", "Unidad", "单位"],
                    [
                        "Of the vectors in the file",
                        "Der Vektoren in der Datei",
                        "De los vectores del archivo",
                        "文件中矢量的单位",
                    ],
                ),
                (
                    ["Axes", "Achsen", "Ejes", "坐标轴"],
                    [
                        "Directions of the vectors in the file",
                        "Richtungen der Vektoren in der Datei",
                        "Direcciones de los vectores del archivo",
                        "文件中矢量的方向",
                    ],
                ),
                (EDGE, EDGE_MEANS),
            ],
        },
        K::Carve => Kind {
            title: ["Carve", "Nachformen", "Tallar", "雕切"],
            summary: [
                "Cut by the surface of an object, and push aside what was there",
                "Entlang der Fläche eines Gegenstands schneiden und beiseite drücken, was dort war",
                "Cortar por la superficie de un objeto y apartar lo que había",
                "沿物体表面切开，并推开原处的组织",
            ],
            params: &[
                (
                    ["Push", "Verdrängung", "Empuje", "推移"],
                    [
                        "How deep in the object the tissue stood that now lies at its surface",
                        "Wie tief im Gegenstand das Gewebe stand, das nun an seiner Fläche liegt",
                        "A qué profundidad del objeto estaba el tejido que ahora toca su superficie",
                        "现贴于物体表面的组织原先位于物体内多深",
                    ],
                ),
                (
                    ["Reach", "Reichweite", "Alcance", "范围"],
                    [
                        "How far from the object tissue is pushed",
                        "Wie weit um den Gegenstand Gewebe verdrängt wird",
                        "Hasta qué distancia del objeto se empuja el tejido",
                        "物体周围多远的组织被推移",
                    ],
                ),
            ],
        },
        K::Sweep => Kind {
            title: ["Sweep", "Mitnehmen", "Arrastrar", "拖移"],
            summary: [
                "Tools move through the tissue and take with them what is near; nothing tears or folds",
                "Werkzeuge bewegen sich durch das Gewebe und nehmen mit, was nahe ist; nichts reißt oder faltet sich",
                "Unos instrumentos se mueven por el tejido y se llevan lo que está cerca; nada se rasga ni se pliega",
                "器械在组织中移动，带动附近的组织；不撕裂，不折叠",
            ],
            params: &[(
                ["Progress", "Fortschritt", "Avance", "进度"],
                [
                    "How far the tools have come on their paths",
                    "Wie weit die Werkzeuge auf ihren Wegen gekommen sind",
                    "Hasta dónde han llegado los instrumentos en su recorrido",
                    "器械沿路径行进的程度",
                ],
            )],
        },
    }
}

/// What people call a kind.
pub(crate) fn title(kind: TemplateKind) -> &'static str {
    of(kind_words(kind).title)
}

/// One line on what a kind does, in directions as one sees them who looks at the box from outside: left and right along
/// its x axis, down and up along y, into the depth against z.
pub(crate) fn summary(kind: TemplateKind) -> &'static str {
    of(kind_words(kind).summary)
}

/// What people call a parameter, by its index in the catalogue.
pub(crate) fn param_name(kind: TemplateKind, param: usize) -> &'static str {
    kind_words(kind)
        .params
        .get(param)
        .map_or("", |words| of(words.0))
}

/// One line on a parameter.
pub(crate) fn param_summary(kind: TemplateKind, param: usize) -> &'static str {
    kind_words(kind)
        .params
        .get(param)
        .map_or("", |words| of(words.1))
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

/// A sentence on a value of a parameter that has names for them.
pub(crate) fn choice_hint(name: &str) -> &'static str {
    of(match name {
        "box" => [
            "Everything in the box is removed",
            "Alles im Quader wird entfernt",
            "Se quita todo lo que hay en la caja",
            "移除盒子内的一切",
        ],
        "sphere" => [
            "A ball that fills the box is removed",
            "Eine Kugel, die den Quader füllt, wird entfernt",
            "Se quita una esfera que llena la caja",
            "移除充满盒子的球体",
        ],
        "cylinder" => [
            "A round shaft into the depth is removed",
            "Ein runder Schacht in die Tiefe wird entfernt",
            "Se quita un pozo redondo en profundidad",
            "移除通向深处的圆柱",
        ],
        "halfspace" => [
            "Everything above the middle of the box is removed",
            "Alles über der Mitte des Quaders wird entfernt",
            "Se quita todo lo que está por encima del centro de la caja",
            "移除盒子中面以上的一切",
        ],
        "mm" => [
            "The vectors in the file are millimetres",
            "Die Vektoren in der Datei sind Millimeter",
            "Los vectores del archivo son milímetros",
            "文件中的矢量以毫米为单位",
        ],
        "subject" => [
            "The vectors in the file are parts of the subject's longest side",
            "Die Vektoren in der Datei sind Teile der längsten Seite des Objekts",
            "Los vectores del archivo son partes del lado más largo del objeto",
            "文件中的矢量以对象最长边的比例为单位",
        ],
        "auto" => [
            "The directions that the file states",
            "Die Richtungen, die die Datei nennt",
            "Las direcciones que indica el archivo",
            "文件所注明的方向",
        ],
        "lps" => [
            "The vectors point to the patient's left, back and head, as in DICOM and ITK",
            "Die Vektoren zeigen nach links, hinten und oben am Patienten, wie in DICOM und ITK",
            "Los vectores apuntan a la izquierda, atrás y arriba del paciente, como en DICOM e ITK",
            "矢量指向患者的左、后、头侧，如 DICOM 与 ITK",
        ],
        "ras" => [
            "The vectors point to the patient's right, front and head, as in NIfTI",
            "Die Vektoren zeigen nach rechts, vorn und oben am Patienten, wie in NIfTI",
            "Los vectores apuntan a la derecha, delante y arriba del paciente, como en NIfTI",
            "矢量指向患者的右、前、头侧，如 NIfTI",
        ],
        _ => [""; Lang::COUNT],
    })
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
                        assert_ne!(choice_hint(name), "", "{name} has no hint");
                    }
                    super::super::set_lang(Lang::English);
                }
            }
        }
    }
}
