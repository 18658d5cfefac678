use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape};
use super::spec::{TemplateSpec, number};
use super::sweeping::Sweeping;
use glam::Vec3;

/// Half side of a part of a box between whose corners a sweep takes nothing beyond where it takes them, as a part of
/// the width that [`Sweeping::least_width`] tells. Measured on pushed and turning balls and blocks: parts of an eighth
/// of a coating hold what a push of eight coatings brings, and a turn with a tenth of their size more.
const DETAIL_WIDTHS: f32 = 1.0 / 14.0;
/// Smaller than any box: of what takes too long to ask, the bound of its shift is taken.
const NO_DETAIL: f32 = 1e-6;

/// All that is known about sweep besides its formula. It is grabbed at the first of its tools that moves.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "sweep",
        summary: "Tools that move and take with them what is near; nothing folds",
        params: &[number(
            "progress",
            "How far the tools have come on their paths",
            1.0,
            0.0,
            1.0,
        )],
        main_param: Some(0),
    },
    holds: Holds::Tools,
    amount: Amount::Parameters,
    reach: |given| {
        let progress = given.p[0];
        let sweeping = Sweeping::of(given);
        let bounds = sweeping.bounds(progress);
        let (false, Some(width)) = (bounds.is_empty(), sweeping.least_width()) else {
            return Reach::NONE;
        };
        // Material stays in the union of the reaches.
        let most = (Vec3::splat(sweeping.longest(progress)) / given.size).min(bounds.size());
        let (detail, parts) = match sweeping.most_parts() {
            0 => (NO_DETAIL, 1),
            parts => (DETAIL_WIDTHS * width / given.size.max_element(), parts),
        };
        Reach::shifted(bounds, -most, most).by_parts(detail, parts)
    },
    grip: Grip::Number(|given| Sweeping::place(given, given.p[0]), INF),
    icon: Icon::PLAIN,
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 7)),
    shape: Shape::CUBE,
};
