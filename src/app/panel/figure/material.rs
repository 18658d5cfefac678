//! What regions are made of.

use crate::app::words::figure::{FigureWords, w};
use crate::document::figure::Rigidity;

/// A word of the figure's table.
type Word = fn(&FigureWords) -> &'static str;

/// What a region can be made of, from the stiffest to the softest, and how strongly it resists then.
pub(super) const MATERIALS: [(Word, Rigidity); 5] = [
    (|w| w.bone, Rigidity::Rigid),
    (|w| w.cartilage, Rigidity::Elastic([5.0, 5.0])),
    (|w| w.muscle_x, Rigidity::Elastic([5.0, 1.0])),
    (|w| w.muscle_y, Rigidity::Elastic([1.0, 5.0])),
    (|w| w.soft, Rigidity::SOFT),
];

/// What a region of this rigidity is made of.
pub(super) fn name(rigidity: Rigidity) -> &'static str {
    let known = MATERIALS.iter().find(|(_, known)| *known == rigidity);
    known.map_or(w().own, |(word, _)| word(w()))
}
