//! The format's number, and how much a document may hold.

/// Number of the document format that this version reads and writes.
pub const FORMAT: u32 = 1;
/// Most templates in a document.
pub const MAX_TEMPLATES: usize = 32;
/// Most different sets of kept tissue (`align`, `constrain`) in a document.
pub const MAX_KEEP_SETS: usize = 4;
/// Most label volumes beside a subject.
pub const MAX_LABEL_FILES: usize = 8;
/// Most meshes of a subject (`subject.meshes`).
pub const MAX_MESHES: usize = 64;
/// Most objects in a document.
pub const MAX_OBJECTS: usize = 16;
/// Most layers of a body.
pub const MAX_LAYERS: usize = 8;
/// Greatest coordinate of a subject's box, mm; above it millimetres get lost in 32-bit floats of a file.
pub(crate) const MAX_BOX_MM: f64 = 1e7;
/// Most control points of an `rbf`.
pub const MAX_POINTS: usize = 64;
/// Most fields of a document that are drawn.
pub const MAX_FIELDS: usize = 4;
/// Most objects of a document that carve.
pub const MAX_CARVERS: usize = 4;
/// Most points on the cut of an `rbf`.
pub const MAX_CUT: usize = 16;
/// Most points of a template's curve.
pub const MAX_CURVE: usize = 9;
/// Most captions in a document.
pub const MAX_LABELS: usize = 256;
/// Most characters of a text in place of a picture (`alt`) that count.
pub const MAX_ALT: usize = 2000;
/// Most steps in a document.
pub const MAX_STEPS: usize = 100;
/// Most values of a document that readers may move (`controls`).
pub const MAX_CONTROLS: usize = 16;
/// Most recipes in a document.
pub const MAX_RECIPES: usize = 16;
/// Most steps in the clean-up of one recipe.
pub const MAX_CLEAN_STEPS: usize = 16;
/// Most seeds of one recipe.
pub const MAX_SEEDS: usize = 64;
/// Most strokes of a ball in one recipe.
pub const MAX_STROKES: usize = 1000;
/// Most places of one stroke.
pub const MAX_STROKE_PLACES: usize = 64;
/// Largest radius of a ball that paints, mm.
pub const MAX_BALL_MM: f32 = 50.0;
/// Smallest radius of a ball that paints, mm.
pub const MIN_BALL_MM: f32 = 0.01;
/// Longest reach of one step of a clean-up, mm.
pub const MAX_CLEAN_MM: f32 = 50.0;
/// Widest smoothing of a clean-up, mm (standard deviation).
pub const MAX_SMOOTH_MM: f32 = 10.0;
/// Most bytes of a document's JSON.
pub const MAX_BYTES: usize = 1 << 20;
/// Most levels of nested arrays and objects in a document, counting the root.
pub const MAX_DEPTH: usize = 64;
/// Most notices that are listed for one document.
pub(crate) const MAX_NOTICES: usize = 200;

/// The subject of a document that names none.
pub const DEFAULT_SUBJECT: &str = "head";
/// The figures that the program draws. Every built-in subject whose name begins like theirs is a figure
/// ([`SubjectRef::is_drawn_figure`](super::SubjectRef::is_drawn_figure)).
pub const DRAWN_FIGURES: [&str; 5] = [
    "drawn-arm",
    "drawn-foot",
    "drawn-neck",
    "drawn-heart",
    "drawn-face",
];
/// Those that are meshes, of which no clay begins as of voxels.
pub(crate) const MESH_SUBJECTS: [&str; 1] = ["apple"];
/// The newest revisions of the built-in subjects that were improved since their first.
const REVISIONS: [(&str, u32); 4] = [("hand", 2), ("head", 2), ("knee", 2), ("torso", 2)];
/// The other subjects that the program generates, or will generate in a later release.
pub const BUILTIN_SUBJECTS: [&str; 9] = [
    "apple",
    "bar",
    "cube",
    "tomato",
    "piggybank",
    "head",
    "hand",
    "torso",
    "knee",
];

/// The newest revision of a built-in subject; 1 for those that have one alone.
pub fn newest_revision(name: &str) -> u32 {
    let found = REVISIONS.iter().find(|(subject, _)| *subject == name);
    found.map_or(1, |(_, revision)| *revision)
}
