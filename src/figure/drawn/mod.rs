//! The built-in figures: drawings that the program carries with it, and how their regions resist (spec/figures.md, "The
//! built-in figures").
//!
//! Each is an SVG of curves and gradients. The id of an element is the name of a region, letter for letter, with spaces
//! where the name has them; what is drawn in the element moves with the region. Regions are listed from behind to
//! front, as they are drawn.
//!
//! ```
//! use fabrica::document::DRAWN_FIGURES;
//! use fabrica::figure::drawn::drawn;
//! let arm = drawn("drawn-arm").expect("a built-in figure");
//! assert_eq!(arm.title, "Arm");
//! assert!(arm.regions.iter().any(|region| region.name == "humerus"));
//! assert!(DRAWN_FIGURES.iter().all(|name| drawn(name).is_some()));
//! assert!(drawn("arm").is_none(), "the names begin with drawn-");
//! ```

use crate::document::figure::{Region, Rigidity, Source};

/// A built-in figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What it shows, in one or two words.
    pub title: &'static str,
    /// An SVG whose elements are named after the regions.
    pub svg: &'static str,
    /// Its regions, from behind to front.
    pub regions: Vec<Region>,
}

/// The built-in figure of this name, if there is one. Its regions have paths,
/// rigidities and growth; all else of them is at its default.
pub fn drawn(name: &str) -> Option<Drawn> {
    let (title, svg, regions): (_, _, &[(&str, Rigidity, f64)]) = match name {
        "drawn-arm" => ("Arm", include_str!("arm.svg"), &ARM),
        "drawn-foot" => ("Foot", include_str!("foot.svg"), &FOOT),
        "drawn-neck" => ("Head and neck", include_str!("neck.svg"), &NECK),
        "drawn-heart" => ("Heart", include_str!("heart.svg"), &HEART),
        "drawn-face" => ("Face", include_str!("face.svg"), &FACE),
        _ => return None,
    };
    let region = |(name, rigidity, grow): &(&str, Rigidity, f64)| Region {
        from: Some(Source::Path((*name).to_owned())),
        rigidity: *rigidity,
        grow: *grow,
        ..Region::new(name)
    };
    let regions = regions.iter().map(region).collect();
    Some(Drawn {
        title,
        svg,
        regions,
    })
}

/// A region is grown by this many pixels of the map, so that the line around a shape belongs to it: a line within the
/// figure, one around a chamber of the heart, the figure's own outline with what is within 2 pixels of it.
const LINE: f64 = 1.5;
const THICK: f64 = 4.0;
const EDGE: f64 = 3.0;

const BONE: Rigidity = Rigidity::Rigid;

const fn soft(k: f64) -> Rigidity {
    Rigidity::Elastic([k, k])
}

/// Muscles resist a little more than the skin that slides over them.
const ARM: [(&str, Rigidity, f64); 8] = [
    ("skin", soft(1.0), EDGE),
    ("triceps", soft(1.5), LINE),
    ("humerus", BONE, LINE),
    ("brachialis", soft(1.5), LINE),
    ("biceps", soft(1.5), LINE),
    ("ulna", BONE, LINE),
    ("radius", BONE, LINE),
    ("hand", BONE, EDGE),
];

/// Tendon and fascia hardly stretch.
const FOOT: [(&str, Rigidity, f64); 10] = [
    ("skin", soft(1.0), EDGE),
    ("plantar fascia", soft(5.0), LINE),
    ("Achilles tendon", soft(5.0), LINE),
    ("tibia", BONE, LINE),
    ("talus", BONE, LINE),
    ("calcaneus", BONE, LINE),
    ("midfoot", BONE, LINE),
    ("metatarsals", BONE, LINE),
    ("toes", BONE, LINE),
    ("fibula", BONE, LINE),
];

/// Discs are tougher than skin, and give way nevertheless: they are where a spine bends.
const NECK: [(&str, Rigidity, f64); 14] = [
    ("skin", soft(1.0), EDGE),
    ("gullet and windpipe", soft(1.5), LINE),
    ("spinal cord", soft(2.0), LINE),
    ("discs", soft(2.0), LINE),
    ("C1", BONE, LINE),
    ("C2", BONE, LINE),
    ("C3", BONE, LINE),
    ("C4", BONE, LINE),
    ("C5", BONE, LINE),
    ("C6", BONE, LINE),
    ("C7", BONE, LINE),
    ("T1", BONE, LINE),
    ("skull", BONE, LINE),
    ("jaw", BONE, LINE),
];

/// Blood in the chambers gives way, muscle less, valves and the great artery least. The valves lie behind the chambers
/// in the list, though they are drawn before them: their rings are a region, their leaflets move with the chamber that
/// they hang in, and a chamber's outline has no notches where a contour would be laid on it.
const HEART: [(&str, Rigidity, f64); 8] = [
    ("wall", soft(2.0), EDGE),
    ("aorta", soft(4.0), EDGE),
    ("valves", soft(4.0), LINE),
    ("right atrium", soft(1.0), THICK),
    ("left atrium", soft(1.0), THICK),
    ("right ventricle", soft(1.0), THICK),
    ("left ventricle", soft(1.0), THICK),
    ("septum", soft(2.0), LINE),
];

/// Features keep their form a little better than the cheeks between them.
const FACE: [(&str, Rigidity, f64); 6] = [
    ("outline", soft(1.0), EDGE),
    ("ears", soft(2.0), EDGE),
    ("eyes", soft(3.0), LINE),
    ("brows", soft(2.0), LINE),
    ("nose", soft(4.0), LINE),
    ("mouth", soft(1.5), LINE),
];

/// The 16 points of `drawn-face` that a likeness moves, figure space: forehead, chin; then of the viewer's left and
/// right side each cheek, jaw, outer and inner corner of the eye, lid under the brow, wing of the nose, corner of the
/// mouth. They lie a little inside of outlines: a point pulls at one vertex, and on a line one would see it.
pub const FACE_POINTS: [[f64; 2]; 16] = [
    [0.000, 0.247],
    [0.000, -0.324],
    [-0.209, -0.033],
    [0.209, -0.033],
    [-0.152, -0.217],
    [0.152, -0.217],
    [-0.165, -0.001],
    [0.165, -0.001],
    [-0.072, -0.004],
    [0.072, -0.004],
    [-0.125, 0.055],
    [0.125, 0.055],
    [-0.044, -0.129],
    [0.044, -0.129],
    [-0.077, -0.239],
    [0.077, -0.239],
];

/// Where [`FACE_POINTS`] lie in an old face: brows, nose and mouth have sunk, the nose is long, jowls hang.
pub const OLD_FACE: [[f64; 2]; 16] = [
    [0.000, 0.283],
    [0.000, -0.360],
    [-0.181, -0.037],
    [0.181, -0.037],
    [-0.189, -0.284],
    [0.189, -0.284],
    [-0.156, -0.041],
    [0.156, -0.041],
    [-0.072, -0.015],
    [0.072, -0.015],
    [-0.125, 0.008],
    [0.125, 0.008],
    [-0.059, -0.181],
    [0.059, -0.181],
    [-0.091, -0.315],
    [0.091, -0.315],
];

/// Where [`FACE_POINTS`] lie in a child's face: a high forehead, eyes low and wide apart, a small nose, a short chin.
pub const CHILD_FACE: [[f64; 2]; 16] = [
    [0.000, 0.239],
    [0.000, -0.273],
    [-0.236, -0.093],
    [0.236, -0.093],
    [-0.163, -0.204],
    [0.163, -0.204],
    [-0.188, -0.077],
    [0.188, -0.077],
    [-0.080, -0.081],
    [0.080, -0.081],
    [-0.139, -0.015],
    [0.139, -0.015],
    [-0.033, -0.159],
    [0.033, -0.159],
    [-0.064, -0.227],
    [0.064, -0.227],
];
