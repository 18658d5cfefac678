use super::facts::{Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape};
use super::spec::{TemplateSpec, number};
use super::sweeping::Sweeping;
use glam::Vec3;

/// Half side of a box in which differences still tell how the map changes, in widths of the smallest coating.
const DETAIL_COATS: f32 = 0.125;

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
        let (false, Some(coat)) = (bounds.is_empty(), sweeping.least_coat()) else {
            return Reach::NONE;
        };
        // Material stays in the union of the reaches.
        let most = (Vec3::splat(sweeping.longest(progress)) / given.size).min(bounds.size());
        let detail = DETAIL_COATS * coat / given.size.max_element();
        Reach::shifted(bounds, -most, most).with_detail(detail)
    },
    grip: Grip::Number(|given| Sweeping::place(given, given.p[0]), INF),
    icon: Icon::PLAIN,
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 7)),
    shape: Shape::CUBE,
};
