//! Which strokes hatch which segment: segments that touch are told apart without colour.

use super::volume::Segmentation;

/// Ways in which the strokes of a segment may run: along its axis, and turned by a third and by two thirds of a half
/// turn.
const TURNS: u8 = 3;
/// Kinds of strokes: lines, broken lines, crossed lines, and rows of dashes as short as they lie apart.
const KINDS: u8 = 4;
/// Patterns of which a segment takes one by its label, where no other touches it.
const USUAL: u8 = 9;
/// Voxels whose neighbours are looked at, at most.
const MOST_VOXELS: f64 = 1e6;
/// Rounds in which each segment may take another pattern than before.
const ROUNDS: usize = 4;
/// How much worse it is that segments have one kind and one turn than one kind alone: their axes may differ by as much
/// as the turns.
const SAME_TURN: f64 = 3.0;
/// The kind whose turns do not tell: crossed lines.
const CROSSED: u8 = 2;
/// What lies so far apart, as a part of the longest side, may be seen beside each other too.
const NEAR: f64 = 1.0 / 16.0;
/// How much it counts, as a part of what touches.
const NEAR_WEIGHT: f64 = 0.1;
/// How much the usual pattern is preferred, as a part of the contact of a face.
const HABIT: f64 = 0.01;

/// The pattern of each label's strokes: three times its kind, as shaders/style/strokes.wgsl counts them, plus how often
/// they are turned by 60 degrees. Labels whose voxels touch get different kinds where that can be done; the others keep
/// the pattern that their number gives.
pub fn stroke_patterns(labels: &Segmentation) -> [u8; 256] {
    let mut patterns = std::array::from_fn(|label| (label % 3 + label / 3 % 3 * 3) as u8);
    let contacts = Contacts::of(labels);
    let mut order: Vec<usize> = (1..256)
        .filter(|label| contacts.total(*label) > 0.0)
        .collect();
    // What touches most comes first.
    order.sort_by(|a, b| {
        contacts
            .total(*b)
            .total_cmp(&contacts.total(*a))
            .then(a.cmp(b))
    });
    let usual = patterns;
    for round in 0..=ROUNDS {
        for (place, &label) in order.iter().enumerate() {
            // In the first round only those before have a pattern.
            let others = if round == 0 {
                &order[..place]
            } else {
                &order[..]
            };
            let clash = |pattern: u8| -> f64 {
                let clashes = others.iter().map(|&other| {
                    let theirs = patterns[other];
                    let is_kind = other != label && theirs / TURNS == pattern / TURNS;
                    let is_turn = is_kind
                        && (theirs % TURNS == pattern % TURNS || pattern / TURNS == CROSSED);
                    let weight =
                        f64::from(u8::from(is_kind)) + SAME_TURN * f64::from(u8::from(is_turn));
                    weight * contacts.between(label, other)
                });
                let habit = if pattern == usual[label] { 0.0 } else { HABIT };
                // The kind that is new only where the usual ones do not do.
                clashes.sum::<f64>() + habit + if pattern < USUAL { 0.0 } else { HABIT }
            };
            let best =
                (0..KINDS * TURNS).min_by(|a, b| clash(*a).total_cmp(&clash(*b)).then(a.cmp(b)));
            patterns[label] = best.unwrap_or(usual[label]);
        }
    }
    patterns
}

/// How much labels touch each other or nearly so: roots of numbers of faces, so that a long thin thing counts too.
struct Contacts(Vec<f64>);

impl Contacts {
    fn of(labels: &Segmentation) -> Self {
        let voxels = labels.grid.dims.as_dvec3().element_product();
        let step = (voxels / MOST_VOXELS).cbrt().ceil().max(1.0) as usize;
        let [width, height, depth] = labels.grid.dims.to_array().map(|side| side as usize);
        let label = |at: usize| labels.labels.get(at).map_or(0, |label| usize::from(*label));
        let near = (f64::from(labels.grid.dims.max_element()) * NEAR)
            .ceil()
            .max(2.0) as usize;
        let mut faces = vec![0.0; 256 * 256];
        for z in (0..depth).step_by(step) {
            for y in (0..height).step_by(step) {
                for x in (0..width).step_by(step) {
                    let at = x + width * (y + height * z);
                    let own = label(at);
                    let mut count = |is_there: bool, way: usize, weight: f64| {
                        let other = if is_there { label(at + way) } else { 0 };
                        if own != other && own > 0 && other > 0 {
                            faces[256 * own + other] += weight;
                            faces[256 * other + own] += weight;
                        }
                    };
                    for (reach, weight) in [(1, 1.0), (near, NEAR_WEIGHT)] {
                        count(x + reach < width, reach, weight);
                        count(y + reach < height, reach * width, weight);
                        count(z + reach < depth, reach * width * height, weight);
                    }
                }
            }
        }
        Self(faces.into_iter().map(f64::sqrt).collect())
    }

    fn between(&self, one: usize, other: usize) -> f64 {
        self.0.get(256 * one + other).copied().unwrap_or(0.0)
    }

    fn total(&self, label: usize) -> f64 {
        (0..256).map(|other| self.between(label, other)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_that_touch_have_strokes_of_other_kinds() {
        // Four quarters that meet along a line in the middle, of which by their numbers two are alike (2 and 11); a
        // fifth one lies apart.
        let labels = [1, 2, 11, 20];
        let quarters = Segmentation::cube(
            20,
            1.0,
            |at| match at.z {
                0..12 => labels[usize::from(at.x >= 10) + 2 * usize::from(at.y >= 10)],
                19.. => 5,
                _ => 0,
            },
            &[],
        );
        let patterns = stroke_patterns(&quarters);
        for (one, other) in [(1, 2), (1, 11), (2, 20), (11, 20)] {
            assert_ne!(
                patterns[one] / TURNS,
                patterns[other] / TURNS,
                "{one} and {other}: {patterns:?}"
            );
        }
        assert_eq!(patterns[5], 2 + 3, "what touches nothing keeps its pattern");
        assert_eq!(patterns[9], 0, "nor does what is not there");
    }

    #[test]
    fn four_that_all_touch_have_four_kinds() {
        let wedges = Segmentation::cube(
            24,
            1.0,
            |at| match (at.z < 6, at.x < 12, at.y < 12) {
                (true, _, _) => 1,
                (_, true, true) => 2,
                (_, true, false) => 3,
                _ => 4,
            },
            &[],
        );
        let patterns = stroke_patterns(&wedges);
        let mut kinds: Vec<u8> = (1..5).map(|label| patterns[label] / TURNS).collect();
        kinds.sort_unstable();
        assert_eq!(kinds, [0, 1, 2, 3]);
    }
}
