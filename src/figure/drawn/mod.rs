//! The built-in figures: drawings that the program carries with it, and how their regions resist (spec/figures.md, "The
//! built-in figures").
//!
//! Each is an SVG of curves and gradients. The id of an element is the name of a region, letter for letter, with spaces
//! where the name has them; what is drawn in the element moves with the region. Regions are listed from behind to front,
//! as they are drawn.
//!
//! ```
//! use fabrica::figure::drawn::{NAMES, drawn};
//! let arm = drawn("drawn-arm").expect("a built-in figure");
//! assert_eq!(arm.title, "Arm");
//! assert!(arm.regions.iter().any(|region| region.name == "humerus"));
//! assert!(NAMES.iter().all(|name| drawn(name).is_some()));
//! assert!(drawn("arm").is_none(), "the names begin with drawn-");
//! ```

use crate::document::figure::{Region, Rigidity, Source};

/// Names of the built-in figures.
pub const NAMES: [&str; 5] = [
    "drawn-arm",
    "drawn-foot",
    "drawn-neck",
    "drawn-heart",
    "drawn-face",
];

/// A built-in figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What it shows, in one or two words.
    pub title: &'static str,
    /// The drawing.
    pub svg: &'static str,
    /// Its regions, from behind to front.
    pub regions: Vec<Region>,
}

/// The built-in figure of this name, if there is one. All that is not said of its regions is at its default.
pub fn drawn(name: &str) -> Option<Drawn> {
    let (title, svg, regions): (_, _, &[(&str, Rigidity)]) = match name {
        "drawn-arm" => ("Arm", include_str!("arm.svg"), &ARM),
        "drawn-foot" => ("Foot", include_str!("foot.svg"), &FOOT),
        "drawn-neck" => ("Head and neck", include_str!("neck.svg"), &NECK),
        "drawn-heart" => ("Heart", include_str!("heart.svg"), &HEART),
        "drawn-face" => ("Face", include_str!("face.svg"), &FACE),
        _ => return None,
    };
    let region = |(name, rigidity): &(&str, Rigidity)| Region {
        from: Some(Source::Path((*name).to_owned())),
        rigidity: *rigidity,
        ..Region::new(name)
    };
    let regions = regions.iter().map(region).collect();
    Some(Drawn {
        title,
        svg,
        regions,
    })
}

const BONE: Rigidity = Rigidity::Rigid;

const fn soft(k: f64) -> Rigidity {
    Rigidity::Elastic([k, k])
}

/// Muscles resist a little more than the skin that slides over them.
const ARM: [(&str, Rigidity); 8] = [
    ("skin", soft(1.0)),
    ("triceps", soft(1.5)),
    ("humerus", BONE),
    ("brachialis", soft(1.5)),
    ("biceps", soft(1.5)),
    ("ulna", BONE),
    ("radius", BONE),
    ("hand", BONE),
];

/// Tendon and fascia hardly stretch.
const FOOT: [(&str, Rigidity); 10] = [
    ("skin", soft(1.0)),
    ("plantar fascia", soft(5.0)),
    ("Achilles tendon", soft(5.0)),
    ("tibia", BONE),
    ("talus", BONE),
    ("calcaneus", BONE),
    ("midfoot", BONE),
    ("metatarsals", BONE),
    ("toes", BONE),
    ("fibula", BONE),
];

/// Discs are tougher than skin, and give way nevertheless: they are where a spine bends.
const NECK: [(&str, Rigidity); 14] = [
    ("skin", soft(1.0)),
    ("gullet and windpipe", soft(1.5)),
    ("spinal cord", soft(2.0)),
    ("discs", soft(2.0)),
    ("C1", BONE),
    ("C2", BONE),
    ("C3", BONE),
    ("C4", BONE),
    ("C5", BONE),
    ("C6", BONE),
    ("C7", BONE),
    ("T1", BONE),
    ("skull", BONE),
    ("jaw", BONE),
];

/// Blood in the chambers gives way, muscle less, valves and the great artery least.
const HEART: [(&str, Rigidity); 8] = [
    ("wall", soft(2.0)),
    ("aorta", soft(4.0)),
    ("right atrium", soft(1.0)),
    ("left atrium", soft(1.0)),
    ("right ventricle", soft(1.0)),
    ("left ventricle", soft(1.0)),
    ("septum", soft(2.0)),
    ("valves", soft(4.0)),
];

/// Features keep their form a little better than the cheeks between them.
const FACE: [(&str, Rigidity); 6] = [
    ("outline", soft(1.0)),
    ("ears", soft(2.0)),
    ("eyes", soft(3.0)),
    ("brows", soft(2.0)),
    ("nose", soft(2.0)),
    ("mouth", soft(2.0)),
];
