//! The keys of the document, each described once.
//!
//! [`ROOT`] lists the keys of the document itself; a key that holds objects names the list of their keys. Defaults,
//! ranges, the canonical form, notices about unknown keys, the order of keys in JSON, objects that a JSON pointer makes
//! on its way, and the reference of the format (`reference.md`) all follow from these lists. Parameters of templates
//! stand in the catalogue in the same manner ([`ParamSpec`](super::ParamSpec)).
//!
//! To add a key: one line here, its field in `model`, and the line that reads it in `read`.

use super::limits::{
    MAX_ALT, MAX_BALL_MM, MAX_CLEAN_MM, MAX_CLEAN_STEPS, MAX_CONTROLS, MAX_CURVE, MAX_CUT,
    MAX_LABEL_FILES, MAX_LABELS, MAX_LAYERS, MAX_MESHES, MAX_OBJECTS, MAX_POINTS, MAX_RECIPES,
    MAX_SEEDS, MAX_SMOOTH_MM, MAX_STEPS, MAX_STROKE_PLACES, MAX_STROKES, MAX_TEMPLATES,
    MIN_BALL_MM,
};
use super::model::figure::{
    DEFAULT_DETAIL, MAX_CONTOURS, MAX_FLOOD_SEEDS, MAX_HANDLES, MAX_LANDMARKS, MAX_LINE, MAX_MOVE,
    MAX_ONLY, MAX_OUTLINE, MAX_POLYGON, MAX_REGIONS, MAX_TURN, Propagation, Rest, Rotations,
    SCALE_RANGE,
};
use super::model::{
    Align, BodyKind, Camera, Clay, ClayShape, ClayStroke, ClayVolume, ConstrainBy, GhostBy,
    HatchBy, Layer, Light, MeshAxes, MeshParts, MeshReading, MeshUnits, ObjectPlacement,
    OpacityMode, ParamKind, RawVoxels, SceneObject, Step, Style, StylePreset, SurfaceLook,
    TemplateKind, TemplateMode, Tone,
};
use super::text::{json, pointer};
use crate::displace::{
    COAT, Holds, LONG, LONGEST, MAX_KEYS, MAX_TOOL_POINTS, MAX_TOOLS, ROUND, SCALE, SOLID,
    ToolShape,
};
use crate::math::{Placement, plain_f64};
use serde_json::{Map, Value, json};
use std::collections::HashMap;
use std::sync::LazyLock;

/// One key of an object of the document.
#[derive(Debug)]
pub(crate) struct Key {
    /// As written in documents.
    pub(crate) name: &'static str,
    /// Place among the keys of an object when it is written; [`BY_NAME`] comes last. One name has one place everywhere,
    /// since unknown objects are ordered by it too.
    pub(crate) order: u16,
    /// Type, default and range.
    pub(crate) kind: Kind,
    /// When the key is left out in canonical form.
    pub(crate) left_out: LeftOut,
    /// True if a pointer to something inside makes the key at its default where it is missing.
    pub(crate) is_made: bool,
    /// True if no step may set the key or anything inside it.
    pub(crate) is_fixed: bool,
    /// True if no step may set the key as a whole, nor an entry of its list, nor keys of an entry that the
    /// schema lacks.
    pub(crate) is_whole: bool,
    /// One sentence for the reference. The programs do without these texts.
    #[cfg(test)]
    pub(crate) meaning: &'static str,
}

/// When a key is left out in canonical form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LeftOut {
    /// Left out where its value is the default.
    AtDefault,
    /// At its default, if no other key stands beside it.
    Alone,
    /// At its default, and at 0 in a handle of a figure that holds no point: what turns only so far as it is told.
    Turn,
    /// At its default, except in a `field`: without a placement its file says where the box lies.
    ExceptField,
    /// At its default, except in an object with a file: without a placement the file says where it lies.
    ExceptFile,
    /// At its default, except in a region of a figure that has no `from`: there it changes what the source's own region
    /// has.
    OfSource,
    /// Never: it stays even at its default.
    Never,
    /// Never: a missing key means something else than any value.
    Optional,
}

/// Type, default and range of a key.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// The number of the format.
    Format,
    /// A text; the default is empty.
    Text,
    /// A text of which the first `most` characters count; the default is empty.
    Limited {
        /// Most characters that count.
        most: usize,
    },
    /// An address, relative to the document or absolute.
    Address,
    /// SHA-256, 64 hexadecimal digits.
    Hash,
    /// The name of a built-in subject.
    Builtin,
    /// The name of a template's kind.
    Template,
    /// The name of a tool that the program generates.
    Tool,
    /// One of several names; the first is the default.
    Name(&'static [&'static str]),
    /// A colour, `#rgb` or `#rrggbb`.
    Color,
    /// A colour or `none`; the default is white.
    Background,
    /// `auto` (the default), the name of a preset, or a list of points with these keys.
    Transfer(&'static [Key]),
    /// `none` (the default), the name of a preset, or an object with these keys.
    Style(&'static [Key]),
    /// `auto` (the default) or the lowest and the highest value.
    Window,
    /// A JSON boolean.
    Flag {
        /// The value of a missing key.
        default: bool,
    },
    /// A whole number from 0; the default is 0.
    Whole,
    /// A number in a closed range.
    Number {
        /// The value of a missing key.
        default: f64,
        /// Lowest value; smaller ones are raised to this.
        min: f64,
        /// Highest value; larger ones are lowered to this.
        max: f64,
    },
    /// A number in a closed range, in full precision: another one that rounds to the default is not the default.
    Exact {
        /// The value of a missing key.
        default: f64,
        /// Lowest value.
        min: f64,
        /// Highest value.
        max: f64,
    },
    /// An angle in radians, up to 4π either way, or null (the default): it is open.
    Turn,
    /// A whole number in a closed range; others are rounded.
    Count {
        /// The value of a missing key.
        default: f64,
        /// Lowest value.
        min: f64,
        /// Highest value.
        max: f64,
    },
    /// One number, a lower end, or two, the ends of a range.
    Range,
    /// Six numbers: the least x, y and z of a box and the greatest, mm.
    Box,
    /// Three numbers, each in a closed range.
    Vector {
        /// The value of a missing key.
        default: [f64; 3],
        /// Lowest value of each number.
        min: f64,
        /// Highest value of each number.
        max: f64,
    },
    /// Two numbers of full precision, each in a closed range; the default is twice 0.
    Point {
        /// Greatest absolute value of a number.
        max: f64,
    },
    /// A list of pairs of numbers of full precision; fewer than `least` and more than `most` are refused, but where the
    /// key is left out at its default, no pair at all is the same as no key.
    Points {
        /// Number of entries at least.
        least: usize,
        /// Number of entries at most.
        most: usize,
        /// Greatest absolute value of a number.
        max: f64,
    },
    /// One number for both axes, a list of two numbers, each 0.1 to 100, or `rigid`; the default is 1.
    Rigidity,
    /// `none` (the default), `smooth` or a colour.
    Behind,
    /// The id of an element of a drawing, or the number of a shape.
    Shape,
    /// A unit quaternion x, y, z, w; the default is the identity.
    Rotation,
    /// A list of pairs of numbers, each in -10 to 10; more than `most` are not drawn.
    Pairs {
        /// Most pairs that are drawn.
        most: usize,
    },
    /// A list of three numbers each; more than `most` are not drawn.
    Triples {
        /// Most entries that are drawn.
        most: usize,
        /// Greatest absolute value of a number.
        max: f64,
    },
    /// A list of three numbers each; more than `most` are refused.
    Vectors {
        /// Number of entries at most.
        most: usize,
        /// The entries' name in a message.
        what: &'static str,
        /// Greatest absolute value of a number.
        max: f64,
    },
    /// A list of whole numbers, three for each place: the first place, then each less the one before; more than `most`
    /// places are refused.
    Path {
        /// Number of places at most.
        most: usize,
        /// Greatest absolute value of a coordinate of a place.
        max: f64,
    },
    /// A list of whole numbers, so many for each key of a path; keys beyond its end have what goes without saying, more
    /// than `most` keys are refused.
    Wholes {
        /// Numbers for each key.
        each: usize,
        /// Number of keys at most.
        most: usize,
        /// Lowest value.
        min: f64,
        /// Highest value; of three numbers that are a vector also its greatest length.
        max: f64,
    },
    /// A list of names or numbers of segments.
    Segments,
    /// Names of segments, by label number.
    Labels,
    /// For each segment an opacity or an object with these keys.
    Looks(&'static [Key]),
    /// An object with these keys.
    Object(&'static [Key]),
    /// A list of objects with these keys; more than `most` are refused.
    List {
        /// Keys of an entry.
        of: &'static [Key],
        /// Number of entries at most.
        most: usize,
        /// The entries' name in a message.
        what: &'static str,
    },
    /// A list of objects with these keys; more than `most` are not drawn.
    FirstOf {
        /// Keys of an entry.
        of: &'static [Key],
        /// Most entries that are drawn.
        most: usize,
    },
    /// An object with these keys, or a list of such objects; more than `most` are refused.
    OneOrMore {
        /// Keys of an object.
        of: &'static [Key],
        /// Number of entries at most.
        most: usize,
        /// The entries' name in a message.
        what: &'static str,
    },
    /// The parameters of a template; they depend on its kind.
    Params,
    /// For each JSON pointer a value.
    Set,
}

/// The place of keys that are written after all others, by name.
pub(crate) const BY_NAME: u16 = u16::MAX;

/// Points farther out are clamped: a subject is one unit long, and floats get coarse out there.
pub(crate) const FAR: f64 = 1e4;
/// Largest value of a voxel that is told from infinity.
pub(crate) const MAX_VALUE: f64 = f32::MAX as f64 / 4.0;
/// Greatest coordinate of control points, cuts and curves, template units.
pub(crate) const MAX_PAIR: f64 = 10.0;

/// A key that is left out at its default, and made by a pointer to something inside.
const fn key(order: u16, name: &'static str, kind: Kind, meaning: &'static str) -> Key {
    _ = meaning;
    Key {
        name,
        order,
        kind,
        left_out: LeftOut::AtDefault,
        is_made: true,
        is_fixed: false,
        is_whole: false,
        #[cfg(test)]
        meaning,
    }
}

impl Key {
    /// This key, written even at its default.
    const fn stays(mut self) -> Self {
        self.left_out = LeftOut::Never;
        self
    }

    /// This key, whose absence means something else than any value.
    const fn optional(mut self) -> Self {
        self.left_out = LeftOut::Optional;
        self
    }

    /// This key, left out in the cases of `left_out` only.
    const fn leaves(mut self, left_out: LeftOut) -> Self {
        self.left_out = left_out;
        self
    }

    /// This key, not made by a pointer to something inside.
    const fn unmade(mut self) -> Self {
        self.is_made = false;
        self
    }

    /// This key, of which steps may set parts, but never the whole.
    const fn whole(mut self) -> Self {
        self.is_whole = true;
        self
    }

    /// This key, refused in steps.
    const fn fixed(mut self) -> Self {
        self.is_fixed = true;
        self
    }
}

const fn number(default: f64, min: f64, max: f64) -> Kind {
    Kind::Number { default, min, max }
}

const fn vector(default: glam::Vec3, min: f64, max: f64) -> Kind {
    Kind::Vector {
        default: [default.x as f64, default.y as f64, default.z as f64],
        min,
        max,
    }
}

const ORIGIN: glam::Vec3 = Placement::DOCUMENT_DEFAULT.at;

/// Keys of a document.
#[rustfmt::skip]
pub(crate) const ROOT: &[Key] = &[
    key(10, "fabrica", Kind::Format, "number of the document format; the one key that a document must have").stays().fixed(),
    key(20, "title", Kind::Text, "title of the illustration"),
    key(30, "caption", Kind::Text, "text under the picture"),
    key(35, "alt", Kind::Limited { most: MAX_ALT }, "text in place of the picture at step 0, for who cannot see it; without it the program describes the picture. A step may have its own"),
    key(40, "credit", Kind::Text, "credit line"),
    key(50, "lang", Kind::Text, "language of the texts, a BCP 47 tag such as `en`"),
    key(60, "subject", Kind::Object(SUBJECT), "what is illustrated").fixed(),
    key(65, "objects", Kind::List { of: OBJECT, most: MAX_OBJECTS, what: "objects" }, "tools and neighbours of the subject: never displaced, occluding and occluded at their true depth. Of several of one name the first counts where a name is asked for"),
    key(67, "figure", Kind::Object(FIGURE), "how a figure (a plate, a photograph, a drawing) is divided into regions and bent by handles. Points are `[x, y]` in its plane at rest: origin in the middle of the picture, x to the right, y up, 1 is the picture's longest side; angles are radians, counter-clockwise; px are pixels of the map of regions. Numbers and lists of points of equal length ease from step to step").optional().whole(),
    key(70, "templates", Kind::List { of: TEMPLATE, most: MAX_TEMPLATES, what: "templates" }, "deformations, in the order in which they act on the subject"),
    key(80, "look", Kind::Object(LOOK), "colours, opacity and background"),
    key(90, "camera", Kind::Object(CAMERA), "a perspective camera"),
    key(100, "labels", Kind::List { of: CAPTION, most: MAX_LABELS, what: "labels" }, "texts that follow the tissue that they are fastened to"),
    key(105, "controls", Kind::List { of: CONTROL, most: MAX_CONTROLS, what: "controls" }, "values that the readers of a lesson may move themselves").fixed(),
    key(110, "steps", Kind::List { of: STEP, most: MAX_STEPS, what: "steps" }, "the steps of a lesson; step 0 is the document itself, each further step changes the one before it").fixed(),
];

/// Greatest coordinate of points of another picture, which may have any unit.
const MAX_LIKE: f64 = 1e9;

const fn exact(default: f64, min: f64, max: f64) -> Kind {
    Kind::Exact { default, min, max }
}

const fn points(least: usize, most: usize) -> Kind {
    Kind::Points {
        least,
        most,
        max: FAR,
    }
}

/// Points of another picture.
const fn like(most: usize) -> Kind {
    Kind::Points {
        least: 3,
        most,
        max: MAX_LIKE,
    }
}

/// Keys of `/figure`.
#[rustfmt::skip]
pub(crate) const FIGURE: &[Key] = &[
    key(BY_NAME, "regions", Kind::List { of: REGION, most: MAX_REGIONS, what: "regions" }, "parts of the figure, from behind to front").whole(),
    key(BY_NAME, "handles", Kind::List { of: HANDLE, most: MAX_HANDLES, what: "handles" }, "what bends the figure: each holds a point, a region or a line"),
    key(BY_NAME, "only", points(3, MAX_ONLY), "polygon: handles move nothing outside it, but for rigid parts that it crosses; without it they act everywhere"),
    key(BY_NAME, "propagation", Kind::Name(&Propagation::NAMES), "how turns and scales spread from handles: as smoothly as rigidities allow, those of the nearest handle, or means of all, whose weights fall linearly or as a Gaussian from one to the other"),
    key(BY_NAME, "reach", exact(0.0, 0.0, 2.0), "how far handles act; 0: everywhere"),
    key(BY_NAME, "rotations", Kind::Name(&Rotations::NAMES), "`found`: each triangle takes the turn that suits it best; `propagated`: the turn that spreads from the handles"),
    key(BY_NAME, "context", Kind::Object(CONTEXT), "points whose arrangement is kept, or taken from another picture; without points there is none"),
    key(BY_NAME, "contours", Kind::List { of: CONTOUR, most: MAX_CONTOURS, what: "contours" }, "outlines of regions that take the style of others"),
    key(BY_NAME, "rest", Kind::Name(&Rest::NAMES), "what lies in no region: it bends with the figure, stays where it is, or is left out").fixed(),
    key(BY_NAME, "detail", Kind::Count { default: DEFAULT_DETAIL as f64, min: 500.0, max: 60_000.0 }, "triangles aimed at").fixed(),
];

/// Keys of an entry of `/figure/regions`.
#[rustfmt::skip]
const REGION: &[Key] = &[
    key(250, "name", Kind::Text, "name of the region, unlike any other's and not `rest`; without it `region 1` and so on").fixed(),
    key(530, "from", Kind::Object(SOURCE), "which pixels it takes; may be left out for a region of that name in a built-in figure or an SVG").optional().unmade().fixed(),
    key(BY_NAME, "fill", Kind::Flag { default: true }, "true: holes become part of it; without it so, but with `hide` not").optional().fixed(),
    key(BY_NAME, "grow", exact(0.0, -32.0, 32.0), "px that it is grown by; a negative number shrinks it").leaves(LeftOut::OfSource).fixed(),
    key(BY_NAME, "least", Kind::Count { default: 16.0, min: 0.0, max: 1e6 }, "parts of fewer px are left out").leaves(LeftOut::OfSource).fixed(),
    key(BY_NAME, "smooth", exact(1.5, 0.0, 32.0), "px over which its outline is smoothed").leaves(LeftOut::OfSource).fixed(),
    key(BY_NAME, "rigidity", Kind::Rigidity, "how strongly it resists, along the picture's x and y: 1 is fat, 10 is bone; `rigid`: each of its parts moves as a whole. Switches at the start of a passage").leaves(LeftOut::OfSource),
    key(BY_NAME, "fixed", Kind::Flag { default: false }, "true: it stays where it is. Switches at the start of a passage").leaves(LeftOut::OfSource),
    key(370, "order", exact(0.0, -100.0, 100.0), "place in the order of drawing; what has more is in front").leaves(LeftOut::OfSource),
    key(BY_NAME, "cut", Kind::Flag { default: false }, "true: it is a sheet of its own that can leave what lies around it").leaves(LeftOut::OfSource).fixed(),
    key(BY_NAME, "behind", Kind::Behind, "what is seen where a `cut` region lay: a hole, soft tissue in colours interpolated from around it, or of one colour").leaves(LeftOut::OfSource).fixed(),
    key(BY_NAME, "hide", Kind::Flag { default: false }, "true: it is no part of the figure (paper, a scale bar)").leaves(LeftOut::OfSource).fixed(),
];

/// Keys of a region's `from`: one of them each.
#[rustfmt::skip]
const SOURCE: &[Key] = &[
    key(BY_NAME, "flood", Kind::Object(FLOOD), "pixels of like colour around points").optional(),
    key(BY_NAME, "polygon", points(3, MAX_POLYGON), "a polygon, filled by the non-zero rule").optional(),
    key(BY_NAME, "path", Kind::Shape, "what is filled in an element of an SVG or below it").optional(),
];

/// Keys of a region's `from.flood`.
#[rustfmt::skip]
const FLOOD: &[Key] = &[
    key(320, "at", points(1, MAX_FLOOD_SEEDS), "where it begins; in all regions together at most 256 points").stays(),
    key(BY_NAME, "tolerance", exact(24.0, 0.0, 255.0), "difference in any of red, green and blue (0 … 255) up to which a pixel is like the first"),
    key(BY_NAME, "gap", exact(0.0, 0.0, 16.0), "px that unlike pixels are grown by before the flood, so that it does not leak through holes of an outline"),
    key(BY_NAME, "connected", Kind::Flag { default: true }, "false: all like pixels are taken, wherever they lie"),
];

/// Keys of an entry of `/figure/handles`.
#[rustfmt::skip]
const HANDLE: &[Key] = &[
    key(250, "name", Kind::Text, "the author's name for the handle"),
    key(320, "at", Kind::Point { max: FAR }, "the point that it holds; a handle has one of `at`, `region` and `points`. Switches at the start of a passage").optional().unmade(),
    key(BY_NAME, "region", Kind::Text, "name of the region that it holds. Switches at the start of a passage").optional(),
    key(BY_NAME, "points", points(2, MAX_LINE), "the line that it holds. Switches at the start of a passage").optional().unmade(),
    key(460, "to", points(2, MAX_LINE), "where the points of the line go, as many, in place of `move`, `turn` and `scale`").optional().unmade(),
    key(BY_NAME, "radius", exact(0.01, 0.001, 0.2), "vertices within this of its point or line are held. Switches at the start of a passage"),
    key(BY_NAME, "move", Kind::Point { max: MAX_MOVE }, "how far it moves what it holds"),
    key(BY_NAME, "turn", Kind::Turn, "by which angle it turns it; `null`: open for a point, which finds its turn itself, and 0 for a region or a line. A turn that is or becomes open switches at the start of a passage").leaves(LeftOut::Turn),
    key(632, "scale", exact(1.0, SCALE_RANGE[0], SCALE_RANGE[1]), "by which factor it scales it"),
    key(420, "enabled", Kind::Flag { default: true }, "false: it is as if it were not there. Switches at the start of a passage"),
];

/// Keys of `/figure/context`.
#[rustfmt::skip]
const CONTEXT: &[Key] = &[
    key(BY_NAME, "points", points(3, MAX_LANDMARKS), "the points. Switches at the start of a passage"),
    key(BY_NAME, "strength", exact(5.0, 0.0, 10.0), "how strongly they act: the rigidity of a sheet between them. Switches at the start of a passage"),
    key(480, "keep", Kind::Flag { default: true }, "true: a pose keeps their arrangement"),
    key(BY_NAME, "like", like(MAX_LANDMARKS), "the same points of another picture, as many, in any unit"),
    key(410, "amount", exact(1.0, 0.0, 1.0), "how much of the other picture's arrangement is taken over"),
];

/// Keys of an entry of `/figure/contours`.
#[rustfmt::skip]
const CONTOUR: &[Key] = &[
    key(BY_NAME, "region", Kind::Text, "name of the region whose outline it is"),
    key(BY_NAME, "like", like(MAX_OUTLINE), "the other outline, in any unit").stays(),
    key(410, "amount", exact(1.0, 0.0, 1.0), "how much of it is taken over"),
    key(BY_NAME, "mirror", Kind::Flag { default: false }, "true: the other outline is mirrored in x first"),
    key(480, "keep", points(0, 16), "places of the outline that stay"),
];

/// Keys of `/subject`.
#[rustfmt::skip]
pub(crate) const SUBJECT: &[Key] = &[
    key(210, "builtin", Kind::Builtin, "a subject that the program generates; it goes before `src` and `sha256`").leaves(LeftOut::Alone),
    key(215, "clay", Kind::Object(CLAY), "what is made by shaping a starting shape with tools: it is seen, cut and labelled as a mesh of one segment, `clay`. It goes before every other source").optional().unmade(),
    key(220, "revision", Kind::Whole, "revision of a built-in subject; without it the first one").optional(),
    key(230, "src", Kind::Address, "address of a file").optional(),
    key(240, "sha256", Kind::Hash, "hash of the file's bytes; without `src` the reader supplies the file that has it").optional(),
    key(250, "name", Kind::Text, "the author's name for the file"),
    key(270, "frame", Kind::Whole, "which volume of a file that holds several, counted from 0"),
    key(280, "raw", Kind::Object(RAW), "the layout of the voxels in a file that does not describe it").optional().unmade(),
    key(275, "units", UNITS, "length of one unit of a mesh file; without it millimetres, in a GLB metres").optional(),
    key(276, "axes", AXES, "directions of a mesh file's axes; without it what the file says, else `ras` in STL and PLY and `y-up` in OBJ and GLB").optional(),
    key(277, "parts", PARTS, "what becomes a segment of a mesh file: each part that it names, each piece that hangs together, or the whole file"),
    key(BY_NAME, "smooth", SMOOTH, "edges of a mesh sharper than this many degrees stay sharp; without it the file's own normals, and 40 where it has none").optional(),
    key(282, "meshes", Kind::List { of: MESH, most: MAX_MESHES, what: "meshes" }, "meshes. With none of `builtin`, `src` and `sha256` they are the subject, else surfaces of the same patient, in the millimetres of the scan"),
    key(284, "box", Kind::Box, "of a subject of meshes alone, the box whose centre is the origin and whose longest side is 1 unit; without it that of the vertices").optional(),
    key(290, "segments", Kind::OneOrMore { of: SEGMENTATION, most: MAX_LABEL_FILES, what: "label volumes" }, "label volumes beside the subject, or names for its own labels"),
    key(310, "features", Kind::List { of: RECIPE, most: MAX_RECIPES, what: "features" }, "recipes of segments that are made from the values of the subject"),
];

/// Keys of `/subject/clay`. Its unit of length is the longest side of the starting shape.
#[rustfmt::skip]
pub(crate) const CLAY: &[Key] = &[
    key(530, "from", Kind::Object(CLAY_FROM), "what it is before the first stroke: a shape, a mesh file, or a part of a volume. Its centre is the origin, and its longest side is 1 unit"),
    key(BY_NAME, "detail", exact(0.02, Clay::DETAIL[0], Clay::DETAIL[1]), "longest edge of its triangles where strokes come, subject units"),
    key(BY_NAME, "tools", Kind::List { of: CLAY_TOOL, most: Clay::MAX_TOOLS, what: "tools" }, "what strokes are made by. Without this key there is one, with all its keys at their defaults").optional().unmade(),
    key(BY_NAME, "strokes", Kind::List { of: CLAY_STROKE, most: Clay::MAX_STROKES, what: "strokes" }, "what shapes it, one after the other"),
];

/// Keys of `/subject/clay/from`.
#[rustfmt::skip]
pub(crate) const CLAY_FROM: &[Key] = &[
    key(BY_NAME, "shape", Kind::Name(&ClayShape::NAMES), "a ball of radius ½, a cube of side 1, a plate 1 × 1 × 0.15 (z), both with edges rounded by 0.02, or a torus about z of radius 0.35 to the middle of its tube, which has radius 0.15. A unit is 100 mm. `of`, `src` and `sha256` go before it"),
    key(BY_NAME, "of", Kind::Object(CLAY_OF), "a subject of voxels, a built-in one or a scan; it goes before `shape`, `src` and `sha256`. The clay begins with its `segment` or its `iso`").optional().unmade(),
    key(BY_NAME, "segment", Kind::Text, "name of the segment of `of` that is meant; it goes before `iso`"),
    key(BY_NAME, "iso", exact(0.0, -MAX_VALUE, MAX_VALUE), "of `of`, what has at least this value is meant").optional(),
    key(BY_NAME, "walls", Kind::Name(&ClayVolume::WALLS), "`outer` takes of what is meant the outer wall of the largest piece, which is filled; `all` every wall of every piece"),
    key(230, "src", Kind::Address, "address of a mesh file, all of whose parts are one clay").optional(),
    key(240, "sha256", Kind::Hash, "hash of the file's bytes; without `src` the reader supplies the file that has it").optional(),
    key(250, "name", Kind::Text, "the author's name for the file"),
    key(275, "units", UNITS, "length of one unit of the file; without it millimetres, in a GLB metres").optional(),
    key(276, "axes", AXES, "directions of the file's axes; without it what the file says, else `ras` in STL and PLY and `y-up` in OBJ and GLB").optional(),
];

/// Keys of `/subject/clay/from/of`: those of a subject that say where voxels come from.
#[rustfmt::skip]
pub(crate) const CLAY_OF: &[Key] = &[
    key(210, "builtin", Kind::Builtin, "a subject that the program generates, one that is made of voxels; it goes before `src` and `sha256`").leaves(LeftOut::Alone),
    key(220, "revision", Kind::Whole, "revision of a built-in subject; without it the first one").optional(),
    key(230, "src", Kind::Address, "address of a file with a scan").optional(),
    key(240, "sha256", Kind::Hash, "hash of the file's bytes; without `src` the reader supplies the file that has it").optional(),
    key(250, "name", Kind::Text, "the author's name for the file"),
    key(270, "frame", Kind::Whole, "which volume of a file that holds several, counted from 0"),
    key(280, "raw", Kind::Object(RAW), "the layout of the voxels in a file that does not describe it").optional().unmade(),
];

/// Keys of a tool of a clay. Its lengths are subject units.
#[rustfmt::skip]
pub(crate) const CLAY_TOOL: &[Key] = &{
    let [a, b, c, d, e, f, g, h, i, j, k, l] = shape_keys(&ToolShape::OF_CLAYS, "its form. A capsule lies along z, a torus about z. A `mesh` is that of a file, a `clay` this clay after its first strokes; each lies about the centre of its box", "of a ball (0.1 without this key, at least 0.005), a capsule (0.08), the tube of a torus or a curve (0.05)");
    [a, b, c, d, e, f, g, h, i, j, k, l,
    key(BY_NAME, "strokes", Kind::Count { default: 0.0, min: 0.0, max: Clay::MAX_STROKES as f64 }, "how many of the clay's first strokes a `clay` is made of. A stroke whose tool is made of it or of later strokes is left out"),
    key(BY_NAME, "coat", exact(0.1, COAT[0], COAT[1]), "width of the coating in which its motion fades")]
};

/// Keys of a stroke of a clay.
#[rustfmt::skip]
pub(crate) const CLAY_STROKE: &[Key] = &{
    let [a, b, c, d, e] = CLAY_MOVE;
    [a, b, c, d, e,
    key(BY_NAME, "with", Kind::List { of: CLAY_WITH, most: Clay::MAX_AT_ONCE - 1, what: "further tools" }, "further tools that act at the same time; with their images at most eight act at once"),
    key(BY_NAME, "mirror", Kind::Text, "letters of x, y and z: every tool has an image beyond the middle plane of the subject across that axis, which acts at the same time"),
    key(BY_NAME, "do", Kind::Name(&ClayStroke::NAMES), "`sweep` takes along what the tools touch, `smooth` evens it out"),
    key(BY_NAME, "strength", Kind::Count { default: ClayStroke::DEFAULT_STRENGTH as f64, min: 1.0, max: 100.0 }, "how strongly a stroke smooths"),
    key(BY_NAME, "off", Kind::Flag { default: false }, "true: the stroke is counted, but left out")]
};

/// Keys of an entry of a stroke's `with`.
pub(crate) const CLAY_WITH: &[Key] = &CLAY_MOVE;

/// What is said of each tool of a stroke.
#[rustfmt::skip]
const CLAY_MOVE: [Key; 5] = [
    key(BY_NAME, "tool", Kind::Whole, "index of the tool in `tools`"),
    key(BY_NAME, "path", Kind::Path { most: MAX_KEYS, max: FAR }, "places of the tool's origin, thousandths of a subject unit: x, y and z of the first key, then of each further one less the one before; a tool with one key holds what is in it").stays().unmade(),
    key(BY_NAME, "turns", Kind::Wholes { each: 3, most: MAX_KEYS, min: -179.0, max: 179.0 }, "turns about the tool's origin, whole degrees: for each key a rotation vector in the subject's axes, at most 179 long, the first from rest, each later one from the key before. Keys beyond the list do not turn"),
    key(BY_NAME, "scales", Kind::Wholes { each: 1, most: MAX_KEYS, min: 5.0, max: 2000.0 }, "sizes, whole per cent of the tool's own. Keys beyond the list have the last one, without a list 100"),
    key(BY_NAME, "straight", Kind::Flag { default: false }, "true: one screw from key to key; false: from three keys on places are joined by a Catmull-Rom curve, each span of four screws"),
];

/// Units of a mesh file.
const UNITS: Kind = Kind::Name(&MeshUnits::NAMES);
/// Axes of a mesh file.
const AXES: Kind = Kind::Name(&MeshAxes::NAMES);
/// Parts of a mesh file.
const PARTS: Kind = Kind::Name(&MeshParts::NAMES);
/// The angle from which on an edge stays sharp, degrees.
const SMOOTH: Kind = number(plain(MeshReading::DEFAULT_SMOOTH_DEG), 0.0, 180.0);

/// Keys of an entry of `/subject/meshes`.
#[rustfmt::skip]
pub(crate) const MESH: &[Key] = &[
    key(230, "src", Kind::Address, "address of a file").optional(),
    key(240, "sha256", Kind::Hash, "hash of the file's bytes; without `src` the reader supplies the file that has it").optional(),
    key(250, "name", Kind::Text, "the author's name for the file; the segment of a file with one part is called so, else `surface`"),
    key(275, "units", UNITS, "length of one unit of the file; without it millimetres, in a GLB metres").optional(),
    key(276, "axes", AXES, "directions of the file's axes; without it what the file says, else `ras` in STL and PLY and `y-up` in OBJ and GLB").optional(),
    key(277, "parts", PARTS, "what becomes a segment: each part that the file names, each piece that hangs together, or the whole file"),
    key(BY_NAME, "smooth", SMOOTH, "edges sharper than this many degrees stay sharp, 0 is faceted; without it the file's own normals, and 40 where it has none").optional(),
];

/// Keys of an entry of `/objects`.
#[rustfmt::skip]
pub(crate) const OBJECT: &[Key] = &[
    key(210, "builtin", Kind::Tool, "a tool that the program generates, its working end towards -z; it goes before `src` and `sha256`").optional().fixed(),
    key(230, "src", Kind::Address, "address of a mesh file").optional().fixed(),
    key(240, "sha256", Kind::Hash, "hash of the file's bytes; without `src` the reader supplies the file that has it").optional().fixed(),
    key(250, "name", Kind::Text, "the author's name for the object; without it `object 1` and so on").fixed(),
    key(260, "group", Kind::Text, "objects and templates of one group are selected and moved together; the picture does not depend on it"),
    key(275, "units", UNITS, "length of one unit of the file, where the file says where the object lies; without it millimetres, in a GLB metres").optional().fixed(),
    key(276, "axes", AXES, "directions of the file's axes; without it what the file says, else `ras` in STL and PLY and `y-up` in OBJ and GLB").optional().fixed(),
    key(BY_NAME, "smooth", SMOOTH, "edges sharper than this many degrees stay sharp, 0 is faceted; without it the file's own normals, and 40 where it has none").optional().fixed(),
    key(320, "at", vector(ORIGIN, -FAR, FAR), "centre of its unturned box, subject space. An object with a file and none of `at`, `rotate` and `size` lies where its file says, in the subject's millimetres").leaves(LeftOut::ExceptFile),
    key(330, "rotate", Kind::Rotation, "its turn about that centre").leaves(LeftOut::ExceptFile),
    key(340, "size", number(plain(ObjectPlacement::DOCUMENT_DEFAULT.size), 0.001, 10.0), "its longest side before the turn, subject units").leaves(LeftOut::ExceptFile),
    key(420, "enabled", Kind::Flag { default: true }, "false: the object is not drawn, and nothing is carved by it"),
    key(520, "color", Kind::Color, "colour; without it the file's").optional(),
    key(610, "opacity", number(1.0, 0.0, 1.0), "opacity of one crossing"),
    key(622, "inside", Kind::Color, "colour of back sides; without it 0.75 of the colour of the point, in linear light").optional(),
    key(626, "gloss", number(plain(SceneObject::DEFAULT_GLOSS), 0.0, 1.0), "gloss"),
];

/// Keys of `/subject/raw`.
#[rustfmt::skip]
pub(crate) const RAW: &[Key] = &[
    key(340, "size", Kind::Vector { default: [1.0; 3], min: 1.0, max: 65_536.0 }, "voxels along x, y and z; x is fastest").unmade(),
    key(360, "type", Kind::Name(&RawVoxels::ELEMENTS), "type of a voxel"),
    key(370, "order", Kind::Name(&RawVoxels::ORDERS), "byte order"),
    key(380, "spacing", Kind::Vector { default: [1.0; 3], min: 1e-6, max: 1e6 }, "size of a voxel, mm").unmade(),
    key(390, "skip", Kind::Whole, "bytes before the first voxel"),
];

/// Keys of a label volume in `/subject/segments`.
#[rustfmt::skip]
pub(crate) const SEGMENTATION: &[Key] = &[
    key(230, "src", Kind::Address, "address of the label volume").optional(),
    key(240, "sha256", Kind::Hash, "hash of its bytes; without `src` the reader supplies the file that has it").optional(),
    key(300, "names", Kind::Labels, "names of its segments, by label number: `{ \"1\": \"bone\" }`"),
];

/// Keys of a recipe in `/subject/features`.
#[rustfmt::skip]
pub(crate) const RECIPE: &[Key] = &[
    key(250, "name", Kind::Text, "name of the segment; without it `feature 1` and so on"),
    key(520, "color", Kind::Color, "colour of the segment; without it one that the program picks").optional(),
    key(530, "from", Kind::Object(FROM), "the first draft of the segment; without it, where there is `paint`, nothing").stays().unmade(),
    key(570, "clean", Kind::List { of: CLEAN, most: MAX_CLEAN_STEPS, what: "steps of a clean-up" }, "steps of a clean-up, each an object of one key").unmade(),
    key(575, "paint", Kind::List { of: PAINT, most: MAX_STROKES, what: "strokes" }, "strokes of a ball that adds or erases voxels after the clean-up, in this order").stays().unmade(),
];

/// Keys of a stroke in a recipe's `paint`.
#[rustfmt::skip]
pub(crate) const PAINT: &[Key] = &[
    key(BY_NAME, "erase", Kind::Flag { default: false }, "true: what the ball touches is taken out of the segment, not added"),
    key(BY_NAME, "radius", number(1.0, MIN_BALL_MM as f64, MAX_BALL_MM as f64), "radius of the ball, mm; a voxel is touched if its centre is"),
    key(BY_NAME, "path", Kind::Path { most: MAX_STROKE_PLACES, max: FAR }, "the line that the ball's centre goes along, thousandths of a subject unit in the undeformed subject: x, y and z of its first point, then of each further one less the one before").stays().unmade(),
];

/// Keys of a recipe's `from`.
#[rustfmt::skip]
pub(crate) const FROM: &[Key] = &[
    key(540, "threshold", Kind::Range, "all voxels with a value in this range, ends included").optional().unmade(),
    key(BY_NAME, "grow", Kind::Object(GROW), "the voxels with a value in a range that are connected to a seed; it goes before `threshold`").stays().unmade(),
];

/// Keys of a recipe's `from.grow`.
#[rustfmt::skip]
pub(crate) const GROW: &[Key] = &[
    key(550, "seeds", Kind::Vectors { most: MAX_SEEDS, what: "seeds", max: FAR }, "points in the undeformed subject").stays().unmade(),
    key(560, "range", Kind::Range, "the range of values, ends included").stays().unmade(),
];

/// Keys of a step in a recipe's `clean`: one of them each.
#[rustfmt::skip]
pub(crate) const CLEAN: &[Key] = &[
    key(BY_NAME, "largest", number(1.0, 1.0, 1000.0), "keeps this many of the largest connected parts").stays(),
    key(BY_NAME, "fill", Kind::Flag { default: false }, "fills enclosed cavities").stays(),
    key(BY_NAME, "close", number(0.0, 0.0, MAX_CLEAN_MM as f64), "closes gaps up to twice this width, mm").stays(),
    key(BY_NAME, "smooth", number(0.0, 0.0, MAX_SMOOTH_MM as f64), "smooths the outline by a Gaussian of this standard deviation, mm").stays(),
    key(BY_NAME, "grow", number(0.0, 0.0, MAX_CLEAN_MM as f64), "adds voxels up to this distance, mm").stays(),
    key(BY_NAME, "shrink", number(0.0, 0.0, MAX_CLEAN_MM as f64), "removes voxels up to this distance from the outside, mm").stays(),
];

/// Keys of an entry of `/templates`.
#[rustfmt::skip]
pub(crate) const TEMPLATE: &[Key] = &[
    key(200, "kind", Kind::Template, "kind of the deformation").optional(),
    key(250, "name", Kind::Text, "the author's name for the template"),
    key(260, "group", Kind::Text, "templates of one group are selected and moved together; the picture does not depend on it"),
    key(320, "at", vector(ORIGIN, -FAR, FAR), "centre of the box, subject space").leaves(LeftOut::ExceptField),
    key(330, "rotate", Kind::Rotation, "rotation of the box").leaves(LeftOut::ExceptField),
    key(340, "size", vector(Placement::DOCUMENT_DEFAULT.size, 1e-4, FAR), "sides of the box, subject units").leaves(LeftOut::ExceptField),
    key(350, "curve", Kind::Object(CURVE), "the line that the top of the template lies along (dissertation, section 5.3), from x = 0 at its first point to x = 1 at its last, in proportion to its length. Heights stand on its mitred normals, y stays straight, beyond its ends the line goes straight on, and the template is as long as the line. Where the line bends more sharply than the template is deep, nothing is moved"),
    key(400, "params", Kind::Params, "parameters; the kind says which (see below)"),
    key(410, "amount", number(1.0, 0.0, 1.0), "how much of the deformation is done: at 0 nothing, at 1 what the parameters say"),
    key(420, "enabled", Kind::Flag { default: true }, "false: the template is left out"),
    key(430, "mode", Kind::Name(&TemplateMode::NAMES), "`compose` deforms what the templates before it left, `add` adds its displacement to that of the template before it"),
    key(440, "align", Kind::Object(ALIGN), "the tissue that the template leaves where it is (section 5.4)"),
    key(450, "constrain", Kind::Object(CONSTRAIN), "tissue towards which the displacement fades, so that no other tissue is drawn through it (section 5.7); a missing key constrains nothing").optional(),
];

/// Keys of a template's `curve`.
#[rustfmt::skip]
pub(crate) const CURVE: &[Key] = &[
    key(BY_NAME, "points", Kind::Pairs { most: MAX_CURVE }, "x and z of the points in template space, at least two; `[[0, 1], [1, 1]]` is the straight box").unmade(),
    key(BY_NAME, "spline", Kind::Flag { default: true }, "true: a smooth curve through the points (Catmull-Rom, drawn as 16 to 21 straight pieces, the same number to each span); false: straight from point to point"),
];

/// Keys of a template's `align`.
#[rustfmt::skip]
pub(crate) const ALIGN: &[Key] = &[
    key(460, "to", Kind::Name(&Align::NAMES), "`axis` moves everything, `surface` keeps what lies deeper than `depth` under the outer surface, `segment` keeps the segments in `keep`"),
    key(480, "keep", Kind::Segments, "segments that stay where they are").stays().unmade(),
    key(490, "depth", number(plain(Align::DEFAULT_DEPTH), 0.0, 10.0), "depth under the outer surface from which on tissue stays, subject units"),
    key(500, "thickness", number(plain(Align::DEFAULT_THICKNESS), 0.0, 10.0), "width of the blend between moved and kept tissue, subject units"),
];

/// Keys of a template's `constrain`.
#[rustfmt::skip]
pub(crate) const CONSTRAIN: &[Key] = &[
    key(470, "by", Kind::Name(&ConstrainBy::NAMES), "`displacement`: its length fades (section 5.7.1); `coordinate`: the main parameter fades (section 5.7.2); `rigid`: the segments in `keep` move rigidly, by the least-squares fit to the displacement, and nearby tissue blends into that motion (section 5.7.2); `bodies`: as `rigid`, but each of these segments by a motion of its own, as the bones of a joint (each counts as a set of its own); `parts`: as `bodies`, but each connected part by itself, as several bones in one segment (the largest, as many as sets are left of four; what is smaller goes with the largest)").stays(),
    key(480, "keep", Kind::Segments, "segments that are not deformed").stays().unmade(),
];

/// Keys in `params` of an `rbf`, besides its parameters.
#[rustfmt::skip]
pub(crate) const RBF: &[Key] = &[
    key(BY_NAME, "points", Kind::FirstOf { of: POINT, most: MAX_POINTS }, "control points").unmade(),
    key(BY_NAME, "cut", Kind::Pairs { most: MAX_CUT }, "x and y of a line in template space that divides the box in two; its ends go straight on. Fewer than two points divide nothing").unmade(),
];

/// Keys of a control point of an `rbf`.
#[rustfmt::skip]
pub(crate) const POINT: &[Key] = &[
    key(320, "at", Kind::Vector { default: [0.5; 3], min: -MAX_PAIR, max: MAX_PAIR }, "position, template space").stays().unmade(),
    key(BY_NAME, "move", Kind::Vector { default: [0.0; 3], min: -MAX_PAIR, max: MAX_PAIR }, "inverse displacement: what is seen at `at` comes from `at` + `move`, template space").stays().unmade(),
];

/// Keys in `params` of a `field`, besides its parameters.
#[rustfmt::skip]
pub(crate) const FIELD: &[Key] = &[
    key(230, "src", Kind::Address, "address of the displacement field").optional(),
    key(240, "sha256", Kind::Hash, "hash of its bytes; without `src` the reader supplies the file that has it").optional(),
    key(250, "name", Kind::Text, "the author's name for the file"),
];

/// Keys in `params` of a `carve`, besides its parameters.
#[rustfmt::skip]
pub(crate) const CARVE: &[Key] = &[
    key(BY_NAME, "object", Kind::Text, "name of the entry of `objects` by whose surface is cut; its place is the template's place"),
];

/// Keys in `params` of a `sweep`, besides its parameters.
#[rustfmt::skip]
pub(crate) const SWEEP: &[Key] = &[
    key(BY_NAME, "mirror", Kind::Text, "letters of x, y and z: every tool has an image beyond the middle plane of the box across that axis, which acts at the same time"),
    key(BY_NAME, "tools", Kind::FirstOf { of: TOOL, most: MAX_TOOLS }, "tools that act at once; with their images at most eight are drawn. Without this key there is one, with all its keys at their defaults").optional().unmade(),
];

/// Keys of a tool of a `sweep`. Its lengths are fractions of the shortest side of the box.
#[rustfmt::skip]
pub(crate) const TOOL: &[Key] = &{
    let [a, b, c, d, e, f, g, h, i, j, k, l] = shape_keys(&ToolShape::OF_SWEEPS, "its form. A capsule lies along z, a torus about z. A `mesh` is that of a file, about the centre of its box, with the file's axes", "of a ball (0.15 without this key, at least 0.005), a capsule (0.08), the tube of a torus or a curve (0.05)");
    [a, b, c, d, e, f, g, h, i, j, k, l,
    key(BY_NAME, "coat", number(0.25, COAT[0], COAT[1]), "width of the coating in which its motion fades"),
    key(BY_NAME, "spline", Kind::Flag { default: false }, "true: places are joined by a Catmull-Rom curve, each span of four screws; false: one screw from key to key"),
    key(BY_NAME, "path", Kind::FirstOf { of: PATH_KEY, most: MAX_KEYS }, "its poses, each an object with these keys or its place alone; with one it stands still. Without this key `[[0.5, 0.5, 1.15], [0.5, 0.5, 0.65]]`").optional().unmade()]
};

/// The keys that give a tool its form.
#[rustfmt::skip]
const fn shape_keys(names: &'static [&'static str], shape: &'static str, radius: &'static str) -> [Key; 12] {
    [
    key(230, "src", Kind::Address, "address of the file of a `mesh`").optional(),
    key(240, "sha256", Kind::Hash, "hash of its bytes; without `src` the reader supplies the file that has it. A document has at most 16 different ones").optional(),
    key(250, "name", Kind::Text, "the author's name for the file"),
    key(BY_NAME, "shape", Kind::Name(names), shape),
    key(BY_NAME, "longest", number(ToolShape::LONGEST as f64, LONGEST[0], LONGEST[1]), "longest side of the box of a `mesh` or a `clay`"),
    key(BY_NAME, "radius", number(0.15, ROUND[0], ROUND[1]), radius).optional(),
    key(BY_NAME, "radii", Kind::Vector { default: [0.2, 0.15, 0.1], min: SOLID[0], max: SOLID[1] }, "half axes of an ellipsoid"),
    key(BY_NAME, "length", number(0.4, LONG[0], LONG[1]), "of the straight part of a capsule"),
    key(BY_NAME, "half", Kind::Vector { default: [0.15; 3], min: SOLID[0], max: SOLID[1] }, "half sides of a box"),
    key(BY_NAME, "round", number(0.02, ROUND[0], ROUND[1]), "radius of the edges of a box, at most its least half side"),
    key(BY_NAME, "ring", number(0.2, SOLID[0], SOLID[1]), "radius of a torus, to the middle of its tube"),
    key(BY_NAME, "points", Kind::Triples { most: MAX_TOOL_POINTS, max: 4.0 }, "of a curve: two or more places with straight pieces between them. Without this key `[[0, 0, -0.2], [0, 0, 0.2]]`").optional().unmade(),
    ]
}

/// Keys of a pose of a tool.
#[rustfmt::skip]
pub(crate) const PATH_KEY: &[Key] = &[
    key(320, "at", Kind::Vector { default: [0.5; 3], min: -MAX_PAIR, max: MAX_PAIR }, "place of the tool's origin, template space").stays().unmade(),
    key(330, "rotate", Kind::Rotation, "turn about its origin"),
    key(632, "scale", number(1.0, SCALE[0], SCALE[1]), "scale about its origin"),
];

/// Keys of `/look`.
#[rustfmt::skip]
pub(crate) const LOOK: &[Key] = &[
    key(580, "transfer", Kind::Transfer(TRANSFER), "opacity and colour over value. A preset is relative to `window`, listed points stand at absolute values; colours mix in linear light"),
    key(590, "window", Kind::Window, "the value range that a preset is stretched over; `auto` is the preset's own"),
    key(600, "tint", number(0.0, 0.0, 1.0), "how far segments keep their own colours over the transfer function; without it the preset's own, and 0 with listed points").optional(),
    key(610, "opacity", Kind::Name(&OpacityMode::NAMES), "how opacity follows the deformation (section 4.5.4): a surface keeps its opacity from every side, particles are conserved, or no correction"),
    key(620, "gradient", number(0.0, 0.0, 1.0), "how far opacity follows the gradient of the value, with its correction at cuts (section 6.2.5): at 1 even tissue is clear and borders stay"),
    key(616, "body", Kind::Name(&BodyKind::NAMES), "what the bodies of meshes are: `hollow` is the surface alone, so that cuts show its back side; `thick` is a shell from the surface inwards; `solid` is full; `auto` is hollow beside a volume and where the mesh is open, else solid"),
    key(500, "thickness", number(plain(SurfaceLook::DEFAULT_THICKNESS), plain(SurfaceLook::THICKNESS_RANGE[0]), plain(SurfaceLook::THICKNESS_RANGE[1])), "thickness of the shell of a `thick` mesh, subject units"),
    key(622, "inside", Kind::Color, "colour of back sides of meshes, and of their cut faces without a layer; without it, in linear light, 0.75 of the colour of the point and of the segment's mean colour").optional(),
    key(624, "layers", Kind::List { of: LAYER, most: MAX_LAYERS, what: "layers" }, "what lies under the surface of meshes: each entry is the material from its depth down to the next"),
    key(626, "gloss", number(plain(SurfaceLook::DEFAULT_GLOSS), 0.0, 1.0), "gloss of meshes"),
    key(290, "segments", Kind::Looks(BODY), "segments that are drawn as bodies of their own, by name: `{ \"brain\": 1, \"skull\": { \"opacity\": 0.3, \"color\": \"#eadfc4\" } }`. A number is an opacity. Where segments overlap, the one that the subject lists first decides. Opacities and colours ease from step to step").unmade(),
    key(630, "background", Kind::Background, "behind the object; `none` is transparent"),
    key(632, "scale", Kind::Flag { default: false }, "true: a scale bar in millimetres stands in the picture. It holds in the plane through the camera's target that faces the eye, and is left out where nobody knows how large the subject is"),
    key(634, "sides", Kind::Flag { default: false }, "true: letters of the patient's sides (R, L, A, P, S, I) stand at the edges of the picture"),
    key(BY_NAME, "strokes", Kind::Count { default: Clay::MAX_STROKES as f64, min: 0.0, max: Clay::MAX_STROKES as f64 }, "how many strokes of a clay are shown, from the first on, those that are off counted; without it all. It goes through the whole numbers from step to step").optional(),
    key(636, "style", Kind::Style(STYLE), "how an illustrator would draw it: the name of a preset, or an object whose keys change one. Widths and distances are thousandths of the shorter side of the picture. Numbers and colours ease from step to step, also from preset to preset"),
    key(638, "light", Kind::Object(LIGHT), "where the light comes from and how it falls. An empty object is the light whose values are all at their default; without the key there is none, and the picture is lit as ever, from the upper left. Numbers ease from step to step").optional(),
];

/// Keys of `/look/style`.
#[rustfmt::skip]
pub(crate) const STYLE: &[Key] = &[
    key(750, "preset", Kind::Name(&StylePreset::NAMES), "the preset that the other keys change; what they leave out is as in the preset"),
    key(752, "outline", Kind::Object(OUTLINE), "lines around what is seen, and along its creases").optional(),
    key(754, "tone", Kind::Object(TONE), "shading from a warm colour in the light to a cool one in the shade").optional(),
    key(756, "hatch", Kind::Object(HATCH), "strokes in the shade").optional(),
    key(758, "stipple", Kind::Object(STIPPLE), "dots in the shade").optional(),
    key(760, "ghost", Kind::Object(GHOST), "tissue that what lies behind it is seen through, while its rims stay").optional(),
];

/// How strongly a part of a style is drawn.
const STRENGTH: Kind = number(0.0, 0.0, 1.0);

/// Keys of `/look/style/outline`.
#[rustfmt::skip]
pub(crate) const OUTLINE: &[Key] = &[
    key(BY_NAME, "width", number(plain(Style::PLAIN.outline.width), 0.0, 20.0), "width of a line, thousandths of the shorter side of the picture; without it the preset's, and 2 where that has no lines").optional(),
    key(520, "color", Kind::Color, "colour of the lines; without it the preset's, else `#1a1a1a`").optional(),
    key(762, "creases", number(plain(Style::PLAIN.outline.creases), 0.0, 1.0), "how readily a crease gets a line: at 0 there are outlines alone; without it the preset's, else 0.5").optional(),
];

/// Keys of `/look/style/tone`.
#[rustfmt::skip]
pub(crate) const TONE: &[Key] = &[
    key(764, "levels", Kind::Count { default: 0.0, min: 0.0, max: Tone::MAX_LEVELS as f64 }, "number of steps between light and shade; 0 is smooth, 1 counts as 2; without it the preset's, else 0").optional(),
    key(766, "warm", Kind::Color, "colour in the light; without it the preset's, else `#f3d9b8`").optional(),
    key(768, "cool", Kind::Color, "colour in the shade; without it the preset's, else `#3b4f6b`").optional(),
    key(BY_NAME, "strength", STRENGTH, "how far the two colours stand in the stead of the tissue's own; without it the preset's, and 1 where that has no tone").optional(),
];

/// Keys of `/look/style/hatch`.
#[rustfmt::skip]
pub(crate) const HATCH: &[Key] = &[
    key(380, "spacing", number(plain(Style::PLAIN.hatch.spacing), 2.0, 50.0), "from one stroke to the next, thousandths of the shorter side of the picture; without it the preset's, else 6").optional(),
    key(BY_NAME, "width", number(plain(Style::PLAIN.hatch.width), 0.2, 20.0), "width of a stroke, thousandths of the shorter side of the picture; without it the preset's, else 1").optional(),
    key(470, "by", Kind::Name(&HatchBy::NAMES), "what the strokes follow: the direction in which the surface bends most, or the long axis of what is drawn; without it the preset's, else `curvature`").optional(),
    key(520, "color", Kind::Color, "colour of the strokes; without it the preset's, else `#1a1a1a`").optional(),
    key(BY_NAME, "strength", STRENGTH, "how much of the tone the strokes make; without it the preset's, and 1 where that has none").optional(),
];

/// Keys of `/look/style/stipple`.
#[rustfmt::skip]
pub(crate) const STIPPLE: &[Key] = &[
    key(380, "spacing", number(plain(Style::PLAIN.stipple.spacing), 2.0, 50.0), "from one dot to the next, thousandths of the shorter side of the picture; without it the preset's, else 5").optional(),
    key(340, "size", number(plain(Style::PLAIN.stipple.size), 0.2, 20.0), "diameter of a dot, thousandths of the shorter side of the picture; without it the preset's, else 1.5").optional(),
    key(520, "color", Kind::Color, "colour of the dots; without it the preset's, else `#1a1a1a`").optional(),
    key(BY_NAME, "strength", STRENGTH, "how much of the tone the dots make; without it the preset's, and 1 where that has none").optional(),
];

/// Keys of `/look/style/ghost`.
#[rustfmt::skip]
pub(crate) const GHOST: &[Key] = &[
    key(470, "by", Kind::Name(&GhostBy::NAMES), "which tissue it is: surfaces, the more the straighter they face the eye, what templates keep left out, or everything, the more the farther it is from the boxes of the templates; without it the preset's, else `facing`").optional(),
    key(BY_NAME, "strength", STRENGTH, "how clear it becomes; without it the preset's, and 0.5 where that has none").optional(),
];

/// Keys of `/look/light`. Segments are called `skin`: a place of its own would change the order in which these are
/// written.
#[rustfmt::skip]
pub(crate) const LIGHT: &[Key] = &[
    key(530, "from", Kind::Vector { default: Light::WRITTEN_FROM, min: -FAR, max: FAR }, "towards the key light in the camera's axes: right, up, to the viewer. The length does not count; without a direction, and within 2.5 degrees of straight from behind, it is the default"),
    key(770, "soft", number(plain(Light::DOCUMENT_DEFAULT.soft), 0.0, 1.0), "how soft the shadow of the key light is"),
    key(772, "contact", number(plain(Light::DOCUMENT_DEFAULT.contact), 0.0, 1.0), "how dark creases and cuts are where surfaces meet"),
    key(BY_NAME, "skin", number(plain(Light::DOCUMENT_DEFAULT.skin), 0.0, 1.0), "how far light goes under the surface, as under skin; at 0 not at all"),
];

/// Keys of a point in `/look/transfer`.
#[rustfmt::skip]
pub(crate) const TRANSFER: &[Key] = &[
    key(510, "value", number(0.0, -MAX_VALUE, MAX_VALUE), "the value that the point stands at").stays(),
    key(520, "color", Kind::Color, "colour at this value; white if missing").optional(),
    key(610, "opacity", number(0.0, 0.0, 1.0), "opacity of a layer of 0.01 subject units").stays(),
];

/// Keys of an entry of `/look/segments`.
#[rustfmt::skip]
pub(crate) const BODY: &[Key] = &[
    key(520, "color", Kind::Color, "colour; without it the segment's own").optional(),
    key(610, "opacity", number(1.0, 0.0, 1.0), "1 is solid, 0 is hidden; between them the opacity of a layer of 0.05 subject units. Of a mesh, the opacity of one crossing or one cut face; without it the file's").stays(),
    key(616, "body", Kind::Name(&BodyKind::NAMES), "what the body of a mesh is; without this key and the next ones as in `look`").optional(),
    key(500, "thickness", number(plain(SurfaceLook::DEFAULT_THICKNESS), plain(SurfaceLook::THICKNESS_RANGE[0]), plain(SurfaceLook::THICKNESS_RANGE[1])), "thickness of the shell of a `thick` mesh, subject units").optional(),
    key(622, "inside", Kind::Color, "colour of back sides of a mesh, and of its cut faces without a layer").optional(),
    key(624, "layers", Kind::List { of: LAYER, most: MAX_LAYERS, what: "layers" }, "what lies under the surface of a mesh; an empty list is nothing").optional(),
    key(626, "gloss", number(plain(SurfaceLook::DEFAULT_GLOSS), 0.0, 1.0), "gloss of a mesh").optional(),
];

/// Keys of a layer in `/look/layers` or in `layers` of an entry of `/look/segments`.
#[rustfmt::skip]
pub(crate) const LAYER: &[Key] = &[
    key(490, "depth", number(0.0, 0.0, 1.0), "where the material begins, subject units under the surface"),
    key(250, "name", Kind::Text, "name of the material, which `keep` may ask for; a segment of the same name comes first"),
    key(520, "color", Kind::Color, "colour; without it that of cut faces without a layer").optional(),
    key(628, "grain", number(0.0, 0.0, plain(Layer::MAX_GRAIN)), "how much the colour varies from place to place"),
];

/// Keys of `/camera`.
#[rustfmt::skip]
pub(crate) const CAMERA: &[Key] = &[
    key(640, "target", vector(Camera::DOCUMENT_DEFAULT.target, -FAR, FAR), "the point in the middle of the picture, subject space"),
    key(330, "rotate", Kind::Rotation, "turns the camera about the target; the identity looks from +y towards -y with +z up"),
    key(650, "distance", number(plain(Camera::DOCUMENT_DEFAULT.distance), 0.01, 1e3), "distance from the target, subject units"),
    key(660, "fov", number(plain(Camera::DOCUMENT_DEFAULT.fov_deg), 0.1, 170.0), "field of view across the shorter side of the picture, degrees"),
];

/// Keys of an entry of `/labels`.
#[rustfmt::skip]
pub(crate) const CAPTION: &[Key] = &[
    key(320, "at", vector(ORIGIN, -FAR, FAR), "the point of tissue that the text is fastened to, in the undeformed subject"),
    key(670, "text", Kind::Text, "the text"),
    key(420, "enabled", Kind::Flag { default: true }, "false: the label is left out"),
];

/// Keys of an entry of `/controls`.
#[rustfmt::skip]
pub(crate) const CONTROL: &[Key] = &[
    key(245, "pointer", Kind::Text, "JSON pointer to a number or a truth value that a step may set"),
    key(250, "name", Kind::Text, "what the reader reads beside it; without it the name of the value"),
    key(730, "min", number(0.0, -FAR, FAR), "lowest value that the reader can set; needed where the value has no range of its own").optional(),
    key(740, "max", number(0.0, -FAR, FAR), "highest value that the reader can set; needed where the value has no range of its own").optional(),
];

/// Keys of an entry of `/steps`.
#[rustfmt::skip]
pub(crate) const STEP: &[Key] = &[
    key(20, "title", Kind::Text, "title of the step"),
    key(30, "caption", Kind::Text, "text under the picture at this step"),
    key(35, "alt", Kind::Limited { most: MAX_ALT }, "text in place of the picture at this step; without it the program describes the picture"),
    key(680, "set", Kind::Set, "JSON pointers into the document and the values that they get"),
    key(690, "seconds", number(1.0, 0.0, 3600.0), "length of the passage to this step"),
    key(700, "hold", number(plain(Step::DEFAULT_HOLD), 0.0, 3600.0), "how long a lesson that plays by itself stays at this step, seconds"),
    key(710, "notes", Kind::Text, "text for the teacher; it is not drawn, but everybody who has the document can read it"),
];

/// A default of the model as a decimal number: 0.02, not 0.019999999552965164.
const fn plain(value: f32) -> f64 {
    // Defaults have at most six digits behind the point.
    let millionths = value as f64 * 1e6;
    let whole = (millionths + 0.5) as i64;
    whole as f64 / 1e6
}

/// The fixed keys in the parameters of a kind, besides those of its [`TemplateSpec`](super::TemplateSpec).
pub(crate) fn params_of(kind: Option<TemplateKind>) -> &'static [Key] {
    match kind.map(|kind| kind.facts().holds) {
        Some(Holds::Points) => RBF,
        Some(Holds::File) => FIELD,
        Some(Holds::Object) => CARVE,
        Some(Holds::Tools) => SWEEP,
        Some(Holds::Parameters) | None => &[],
    }
}

/// The key of a name in a list of keys.
pub(crate) fn find(keys: &'static [Key], name: &str) -> Option<&'static Key> {
    keys.iter().find(|key| key.name == name)
}

impl Kind {
    /// Keys of the objects that a value of this kind holds, itself or in a list.
    pub(crate) fn keys(self) -> &'static [Key] {
        match self {
            Self::Object(of)
            | Self::List { of, .. }
            | Self::FirstOf { of, .. }
            | Self::OneOrMore { of, .. }
            | Self::Looks(of)
            | Self::Style(of)
            | Self::Transfer(of) => of,
            _ => &[],
        }
    }

    /// The JSON of a list, object or vector at its default; `None` for kinds that hold nothing to point into.
    fn container(self) -> Option<Value> {
        Some(match self {
            Self::Vector { default, .. } => Value::from(default.map(json::number).to_vec()),
            Self::Point { .. } => json!([0, 0]),
            Self::Rotation => json!([0, 0, 0, 1]),
            Self::List { .. }
            | Self::FirstOf { .. }
            | Self::Pairs { .. }
            | Self::Triples { .. }
            | Self::Points { .. }
            | Self::Vectors { .. }
            | Self::Path { .. }
            | Self::Wholes { .. }
            | Self::Segments => json!([]),
            Self::Object(_)
            | Self::OneOrMore { .. }
            | Self::Labels
            | Self::Looks(_)
            | Self::Style(_)
            | Self::Params
            | Self::Set => json!({}),
            _ => return None,
        })
    }

    /// The JSON that means the same as a missing key of this kind; `None` where there is no such value.
    pub(crate) fn default_value(self) -> Option<Value> {
        Some(match self {
            Self::Text | Self::Limited { .. } => json!(""),
            Self::Name(names) => json!(names.first()?),
            Self::Background => json!("#ffffff"),
            Self::Transfer(_) | Self::Window => json!("auto"),
            Self::Style(_) => json!("none"),
            Self::Flag { default } => json!(default),
            Self::Whole => json!(0),
            Self::Number { default, .. }
            | Self::Count { default, .. }
            | Self::Exact { default, .. } => Value::Number(json::number(default)),
            Self::Turn => Value::Null,
            Self::Rigidity => json!(1),
            Self::Behind => json!("none"),
            other => return other.container(),
        })
    }
}

/// The JSON that means the same as a missing parameter.
pub(crate) fn param_default(kind: &ParamKind) -> Option<Value> {
    match kind {
        ParamKind::Number { default, .. } | ParamKind::Count { default, .. } => {
            Some(json!(plain_f64(*default)))
        }
        ParamKind::Flag { default } => Some(json!(default)),
        ParamKind::Choice { names } => Some(json!(names.first()?)),
        ParamKind::Vector { default, .. } => Some(json!(default.map(plain_f64))),
        ParamKind::Rotation => Kind::Rotation.container(),
    }
}

/// What stands at a path when the document says nothing: a list, an object or a vector. `kind` is that of the template
/// on the way, since it says which parameters there are. `None` where a pointer makes nothing.
pub(crate) fn default_at(path: &[String], kind: Option<TemplateKind>) -> Option<Value> {
    let mut path = path.iter();
    let mut keys = ROOT;
    loop {
        let key = find(keys, path.next()?)?;
        let Some(inner) = path.as_slice().first() else {
            return match key.name {
                // Without these keys there is something all the same.
                "tools" => Some(json!([{}])),
                "path" if std::ptr::eq(keys, TOOL) => {
                    Some(json!([[0.5, 0.5, 1.15], [0.5, 0.5, 0.65]]))
                }
                _ => key.kind.container().filter(|_| key.is_made),
            };
        };
        match key.kind {
            Kind::Object(of) | Kind::OneOrMore { of, .. } | Kind::Style(of) => keys = of,
            Kind::List { of, .. } | Kind::FirstOf { of, .. } => {
                keys = of;
                path.next();
                if path.as_slice().is_empty() {
                    return None;
                }
            }
            Kind::Params => {
                if path.as_slice().len() == 1
                    && let Some(value) = param_at(kind?, inner)
                {
                    return Some(value);
                }
                // What a kind holds besides its parameters.
                keys = params_of(kind);
            }
            _ => return None,
        }
    }
}

/// What stands at a parameter that the document does not give, if it is a vector or a rotation.
fn param_at(kind: TemplateKind, name: &str) -> Option<Value> {
    let spec = kind.spec().params.iter().find(|spec| spec.name == name)?;
    match spec.kind {
        ParamKind::Vector { .. } | ParamKind::Rotation => param_default(&spec.kind),
        _ => None,
    }
}

/// What a value can be that one number or one truth value stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scalar {
    /// True or false; the value of a missing one.
    Flag(bool),
    /// A number in a closed range; whole, if `is_whole`.
    Number {
        /// The value of a missing one.
        default: f64,
        /// Lowest value.
        min: f64,
        /// Highest value.
        max: f64,
        /// Fractions are rounded.
        is_whole: bool,
    },
}

/// What the value at a path can be, if it is a number, a truth value or a number of three that belong together. `kind`
/// is that of the template on the way.
pub(crate) fn scalar_at(path: &[String], kind: Option<TemplateKind>) -> Option<Scalar> {
    let mut path = path.iter();
    let mut keys = ROOT;
    loop {
        let key = find(keys, path.next()?)?;
        let rest = path.as_slice();
        match key.kind {
            Kind::Flag { default } if rest.is_empty() => return Some(Scalar::Flag(default)),
            Kind::Number { default, min, max }
            | Kind::Count { default, min, max }
            | Kind::Exact { default, min, max }
                if rest.is_empty() =>
            {
                let is_whole = matches!(key.kind, Kind::Count { .. });
                return Some(Scalar::Number {
                    default,
                    min,
                    max,
                    is_whole,
                });
            }
            Kind::Vector { default, min, max } => return component(rest, &default, min, max),
            Kind::Point { max } => return component(rest, &[0.0; 2], -max, max),
            Kind::Turn if rest.is_empty() => {
                return Some(Scalar::Number {
                    default: 0.0,
                    min: -MAX_TURN,
                    max: MAX_TURN,
                    is_whole: false,
                });
            }
            Kind::Object(of) | Kind::Style(of) => keys = of,
            Kind::List { of, .. } => {
                keys = of;
                pointer::index(path.next()?)?;
            }
            Kind::Params => return param_scalar(kind?, rest),
            _ => return None,
        }
    }
}

/// The number at the path `rest` in a parameter list of a template of this kind.
fn param_scalar(kind: TemplateKind, rest: &[String]) -> Option<Scalar> {
    let (name, rest) = rest.split_first()?;
    let spec = kind.spec().params.iter().find(|spec| spec.name == name)?;
    match spec.kind {
        ParamKind::Flag { default } if rest.is_empty() => Some(Scalar::Flag(default)),
        ParamKind::Number { default, min, max } | ParamKind::Count { default, min, max }
            if rest.is_empty() =>
        {
            Some(Scalar::Number {
                default: plain_f64(default),
                min: plain_f64(min),
                max: plain_f64(max),
                is_whole: matches!(spec.kind, ParamKind::Count { .. }),
            })
        }
        ParamKind::Vector {
            default, min, max, ..
        } => component(
            rest,
            &default.map(plain_f64),
            plain_f64(min),
            plain_f64(max),
        ),
        _ => None,
    }
}

/// One of several numbers.
fn component(rest: &[String], default: &[f64], min: f64, max: f64) -> Option<Scalar> {
    let [index] = rest else {
        return None;
    };
    Some(Scalar::Number {
        default: *default.get(pointer::index(index)?)?,
        min,
        max,
        is_whole: false,
    })
}

/// True if a step may not set what stands at this path, whatever it is there.
pub(crate) fn is_fixed(path: &[String]) -> bool {
    let mut path = path.iter();
    let mut keys = ROOT;
    // True in an entry of a list that steps may not set as a whole.
    let mut is_part = false;
    while let Some(name) = path.next() {
        let Some(key) = find(keys, name) else {
            return is_part;
        };
        let is_whole = |rest: &[String]| key.is_whole && rest.is_empty();
        if key.is_fixed || is_whole(path.as_slice()) {
            return true;
        }
        keys = match key.kind {
            Kind::Object(of) => of,
            Kind::List { of, .. } => {
                path.next();
                if is_whole(path.as_slice()) {
                    return true;
                }
                of
            }
            _ => return false,
        };
        is_part = key.is_whole && matches!(key.kind, Kind::List { .. });
    }
    false
}

/// The list of the document with entries that have fixed keys, if the path leads to it or to one of its entries.
pub(crate) fn list_with_fixed(path: &[String]) -> Option<(&'static str, &'static [Key])> {
    let key = find(ROOT, path.first()?).filter(|_| path.len() < 3)?;
    match key.kind {
        Kind::List { of, .. } if of.iter().any(|key| key.is_fixed) => Some((key.name, of)),
        _ => None,
    }
}

/// A style as an object: a text is the name of its preset.
pub(crate) fn style_object(style: &Value) -> Map<String, Value> {
    match style {
        Value::Object(map) => map.clone(),
        name => Map::from_iter([("preset".to_owned(), name.clone())]),
    }
}

/// True if the JSON of an object of the scene takes its triangles from a file.
pub(crate) fn is_of_file(object: &Map<String, Value>) -> bool {
    let has = |key| object.contains_key(key);
    !has("builtin") && (has("src") || has("sha256"))
}

/// Calls `visit` with every object of the document: its JSON pointer, where `*` stands for an index or a name; what a
/// template kind's `params` hold besides parameters, where the keys belong to that; the keys.
pub(crate) fn visit(visit: &mut impl FnMut(&str, Option<Holds>, &'static [Key])) {
    fn inside(
        at: &str,
        holds: Option<Holds>,
        visit: &mut impl FnMut(&str, Option<Holds>, &'static [Key]),
        keys: &'static [Key],
    ) {
        visit(at, holds, keys);
        for key in keys {
            let at = pointer::join(at, key.name);
            let entry = pointer::join(&at, "*");
            match key.kind {
                Kind::Object(of) | Kind::OneOrMore { of, .. } | Kind::Style(of) => {
                    inside(&at, None, visit, of);
                }
                Kind::List { of, .. }
                | Kind::FirstOf { of, .. }
                | Kind::Looks(of)
                | Kind::Transfer(of) => inside(&entry, None, visit, of),
                Kind::Params => {
                    inside(&at, Some(Holds::Points), visit, RBF);
                    inside(&at, Some(Holds::File), visit, FIELD);
                    inside(&at, Some(Holds::Object), visit, CARVE);
                    inside(&at, Some(Holds::Tools), visit, SWEEP);
                }
                _ => {}
            }
        }
    }
    inside("", None, visit, ROOT);
}

/// Place of every known name among the keys of an object.
static ORDER: LazyLock<HashMap<&'static str, u16>> = LazyLock::new(|| {
    let mut order: HashMap<&'static str, u16> = HashMap::new();
    visit(&mut |_, _, keys| {
        for key in keys {
            order.insert(key.name, key.order);
        }
    });
    order
});

/// Place of a key when its object is written; [`BY_NAME`] for a key that has none.
pub(crate) fn order_of(name: &str) -> u16 {
    ORDER.get(name).copied().unwrap_or(BY_NAME)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_one_place_and_an_object_no_name_twice() {
        let mut order: HashMap<&str, u16> = HashMap::new();
        let mut names: HashMap<u16, &str> = HashMap::new();
        visit(&mut |at, _, keys| {
            for (i, key) in keys.iter().enumerate() {
                let before = order.insert(key.name, key.order);
                assert!(
                    before.is_none_or(|before| before == key.order),
                    "{at}/{} stands at another place elsewhere",
                    key.name
                );
                let same = names.insert(key.order, key.name);
                assert!(
                    key.order == BY_NAME || same.is_none_or(|same| same == key.name),
                    "{at}/{} has the place of {same:?}",
                    key.name
                );
                assert!(
                    keys[..i].iter().all(|other| other.name != key.name),
                    "{at}/{}",
                    key.name
                );
                assert!(!key.meaning.is_empty(), "{at}/{} has no meaning", key.name);
            }
        });
        assert!(order.len() > 80, "only {} names were seen", order.len());
    }

    #[test]
    fn defaults_are_the_decimal_numbers_of_the_contract() {
        assert_eq!(
            [0.02_f32, 0.01, 2.5, 30.0, 0.5, 1.0].map(plain),
            [0.02, 0.01, 2.5, 30.0, 0.5, 1.0]
        );
    }
}
