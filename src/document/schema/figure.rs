//! The keys of `figure` (spec/figures.md, "The document").

use super::{BY_NAME, FAR, Key, Kind, LeftOut, key};
use crate::document::model::figure::{
    DEFAULT_DETAIL, MAX_CONTOURS, MAX_HANDLES, MAX_REGIONS, Propagation, Rest, Rotations,
};

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
    key(BY_NAME, "only", points(3, 64), "polygon: handles move nothing outside it, but for rigid parts that it crosses; without it they act everywhere"),
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
    key(BY_NAME, "polygon", points(3, 512), "a polygon, filled by the non-zero rule").optional(),
    key(BY_NAME, "path", Kind::Shape, "what is filled in an element of an SVG or below it").optional(),
];

/// Keys of a region's `from.flood`.
#[rustfmt::skip]
const FLOOD: &[Key] = &[
    key(320, "at", points(1, 16), "where it begins; in all regions together at most 256 points").stays(),
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
    key(BY_NAME, "points", points(2, 32), "the line that it holds. Switches at the start of a passage").optional().unmade(),
    key(460, "to", points(2, 32), "where the points of the line go, as many, in place of `move`, `turn` and `scale`").optional().unmade(),
    key(BY_NAME, "radius", exact(0.01, 0.001, 0.2), "vertices within this of its point or line are held. Switches at the start of a passage"),
    key(BY_NAME, "move", Kind::Point { max: 4.0 }, "how far it moves what it holds"),
    key(BY_NAME, "turn", Kind::Turn, "by which angle it turns it; `null`: open for a point, which finds its turn itself, and 0 for a region or a line. A turn that is or becomes open switches at the start of a passage").leaves(LeftOut::Turn),
    key(632, "scale", exact(1.0, 0.05, 20.0), "by which factor it scales it"),
    key(420, "enabled", Kind::Flag { default: true }, "false: it is as if it were not there. Switches at the start of a passage"),
];

/// Keys of `/figure/context`.
#[rustfmt::skip]
const CONTEXT: &[Key] = &[
    key(BY_NAME, "points", points(3, 64), "the points. Switches at the start of a passage"),
    key(BY_NAME, "strength", exact(5.0, 0.0, 10.0), "how strongly they act: the rigidity of a sheet between them. Switches at the start of a passage"),
    key(480, "keep", Kind::Flag { default: true }, "true: a pose keeps their arrangement"),
    key(BY_NAME, "like", like(64), "the same points of another picture, as many, in any unit"),
    key(410, "amount", exact(1.0, 0.0, 1.0), "how much of the other picture's arrangement is taken over"),
];

/// Keys of an entry of `/figure/contours`.
#[rustfmt::skip]
const CONTOUR: &[Key] = &[
    key(BY_NAME, "region", Kind::Text, "name of the region whose outline it is"),
    key(BY_NAME, "like", like(256), "the other outline, in any unit").stays(),
    key(410, "amount", exact(1.0, 0.0, 1.0), "how much of it is taken over"),
    key(BY_NAME, "mirror", Kind::Flag { default: false }, "true: the other outline is mirrored in x first"),
    key(480, "keep", points(0, 16), "places of the outline that stay"),
];
