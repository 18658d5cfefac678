use glam::{DVec3, IVec3};

use super::volume::Segmentation;

/// Label voxels of a volume at most whose sets end at a smooth surface: 64 MiB of shares for each set. In larger
/// volumes sets end at the voxels.
pub const MOST_SHARED_VOXELS: u64 = 1 << 26;

/// Voxels of a crumb at most, as in shaders/pass/shares.wgsl.
const CRUMB: usize = 27;

/// The least share of a voxel's own label, as there.
const HELD: f64 = 0.65;

/// Which labels of a volume belong to which sets of kept tissue, where the sets end at the smooth surface of their
/// shares (shaders/march/kept.wgsl). In 64 bits, for single places; pictures read textures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptLabels {
    sets: [u8; 256],
}

impl KeptLabels {
    /// `sets_of` has a bit for each set that a label belongs to.
    pub fn new(sets_of: impl Fn(u8) -> u8) -> Self {
        Self {
            sets: std::array::from_fn(|label| sets_of(label as u8)),
        }
    }

    /// No label belongs to any set: a place has the label of the nearest voxel.
    pub fn none() -> Self {
        Self::new(|_| 0)
    }

    /// Label at a place, in label voxels from the middle of the first: that of the nearest voxel if this lies on the
    /// place's side of all surfaces of kept tissue, else the one of the eight voxels around that has most weight there.
    /// `None` outside.
    pub fn label_at(&self, labels: &Segmentation, voxel: DVec3) -> Option<u8> {
        let own = label_of(labels, voxel.round().as_ivec3())?;
        if self.ends_at_voxels(labels) {
            return Some(own);
        }
        let around = Around::of(labels, voxel);
        let side = self.sides(labels, &around);
        if self.sets[usize::from(own)] == side {
            return Some(own);
        }
        let mut weights = [0.0; 256];
        for (corner, weight) in around.corners() {
            let label = around.labels[index_of(corner)];
            if self.sets[usize::from(label)] == side {
                weights[usize::from(label)] += weight;
            }
        }
        let best = (0..=255_u8).max_by(|a, b| {
            let weight = |label: &u8| weights[usize::from(*label)];
            weight(a).total_cmp(&weight(b)).then(b.cmp(a))
        });
        let best = best.filter(|label| weights[usize::from(*label)] > 0.0);
        Some(best.unwrap_or(own))
    }

    /// The sets within whose surface a place lies, a bit for each; in label voxels from the middle of the first.
    pub fn sets_at(&self, labels: &Segmentation, voxel: DVec3) -> u8 {
        match label_of(labels, voxel.round().as_ivec3()) {
            None => 0,
            Some(own) if self.ends_at_voxels(labels) => self.sets[usize::from(own)],
            Some(_) => self.sides(labels, &Around::of(labels, voxel)),
        }
    }

    /// True where a place is in the sets of its nearest voxel.
    fn ends_at_voxels(&self, labels: &Segmentation) -> bool {
        let is_large = labels.labels.len() as u64 > MOST_SHARED_VOXELS;
        is_large || self.sets.iter().all(|sets| *sets == 0)
    }

    fn sides(&self, labels: &Segmentation, around: &Around) -> u8 {
        let is_in = |set: u8| {
            let has = around.labels.map(|label| self.has(label, set));
            // 64 voxels of the rest hang together and are no crumb; at the edge of the labels they are fewer.
            let is_whole = has.iter().all(|other| *other == has[0]);
            let is_within = [around.at(0), around.at(63)].map(|at| clamped(labels, at) == at);
            if is_whole && (has[0] || is_within == [true; 2]) {
                return has[0];
            }
            let members = self.members(labels, around, set);
            let shares = around.corners();
            let shares = shares.map(|(at, weight)| weight * self.share(around, &members, at, set));
            shares.iter().sum::<f64>() >= 0.5
        };
        (0..4).fold(0, |sets, set| sets | u8::from(is_in(set)) << set)
    }

    /// Share of a set at one of the voxels around a place, in steps of 1 / 255: textures hold bytes. `members`: which
    /// of the voxels belong to the set.
    fn share(&self, around: &Around, members: &[bool; 64], at: IVec3, set: u8) -> f64 {
        let own = around.labels[index_of(at)];
        let (mut weight, mut own_share) = (0.0, 0.0);
        for i in 0..27 {
            let aside = IVec3::new(i % 3, i / 3 % 3, i / 9) - 1;
            let there = index_of(at + aside);
            let part = 1.0 / f64::from(8 << aside.abs().element_sum());
            weight += if members[there] { part } else { 0.0 };
            own_share += match around.labels[there] == own {
                true => part,
                false => 0.0,
            };
        }
        let is_member = members[index_of(at)];
        if is_member && !self.has(own, set) {
            // A crumb is of the set, and not of its label.
            own_share = weight;
        }
        let held = own_share.max(HELD);
        let part = match own_share >= HELD {
            true => 1.0,
            false => (1.0 - held) / (1.0 - own_share),
        };
        let share = match is_member {
            true => held + (weight - own_share).max(0.0) * part,
            false => weight * part,
        };
        (255.0 * share).round() / 255.0
    }

    fn has(&self, label: u8, set: u8) -> bool {
        self.sets[usize::from(label)] >> set & 1 != 0
    }

    /// Which of the voxels around a place belong to a set: by their labels, or as crumbs of the rest.
    fn members(&self, labels: &Segmentation, around: &Around, set: u8) -> [bool; 64] {
        let mut is_member = around
            .labels
            .map(|label| self.has(label, set).then_some(true));
        for i in 0..64 {
            if is_member[i].is_none() {
                let is_large = |at| {
                    around
                        .index_of(at)
                        .is_some_and(|i| is_member[i] == Some(false))
                };
                let start = clamped(labels, around.at(i));
                let (piece, is_crumb) = self.piece_of(labels, start, set, is_large);
                for (at, is_member) in is_member.iter_mut().enumerate() {
                    if piece.contains(&clamped(labels, around.at(at))) {
                        *is_member = Some(is_crumb);
                    }
                }
            }
        }
        is_member.map(|is_member| is_member == Some(true))
    }

    /// Voxels of the piece of the rest of a set that a voxel belongs to, and true if they are a crumb; not all of them
    /// where the piece is larger. `is_large` knows some voxels of larger pieces.
    fn piece_of(
        &self,
        labels: &Segmentation,
        start: IVec3,
        set: u8,
        is_large: impl Fn(IVec3) -> bool,
    ) -> (Vec<IVec3>, bool) {
        let is_rest = |at| label_of(labels, at).is_some_and(|label| !self.has(label, set));
        let mut piece = vec![start];
        let mut next = 0;
        while next < piece.len() {
            for axis in [IVec3::X, IVec3::Y, IVec3::Z] {
                for to in [piece[next] + axis, piece[next] - axis] {
                    if !is_rest(to) || piece.contains(&to) {
                        continue;
                    }
                    if piece.len() == CRUMB || is_large(to) {
                        return (piece, false);
                    }
                    piece.push(to);
                }
            }
            next += 1;
        }
        (piece, true)
    }
}

/// The 64 label voxels around a place: the eight whose middles hold it, and those around these. Beyond the labels those
/// at their edge.
struct Around {
    /// The first of the 64.
    low: IVec3,
    /// How far the place lies from the second towards the third along each axis, 0 to 1.
    part: DVec3,
    /// Their labels, x fastest.
    labels: [u8; 64],
}

impl Around {
    fn of(labels: &Segmentation, voxel: DVec3) -> Self {
        let low = voxel.floor().as_ivec3() - 1;
        Self {
            low,
            part: voxel - voxel.floor(),
            labels: std::array::from_fn(|i| {
                label_of(labels, clamped(labels, low + place_of(i))).unwrap_or(0)
            }),
        }
    }

    fn at(&self, index: usize) -> IVec3 {
        self.low + place_of(index)
    }

    /// Index of a voxel if it is one of them.
    fn index_of(&self, at: IVec3) -> Option<usize> {
        let place = at - self.low;
        let is_one = place.min_element() >= 0 && place.max_element() < 4;
        is_one.then(|| index_of(place))
    }

    /// The eight voxels, as places among the 64, each with its weight in what is linear between them.
    fn corners(&self) -> [(IVec3, f64); 8] {
        std::array::from_fn(|i| {
            let step = IVec3::new(i as i32 & 1, i as i32 >> 1 & 1, i as i32 >> 2);
            let weight = DVec3::select(step.cmpeq(IVec3::ONE), self.part, 1.0 - self.part);
            (step + 1, weight.element_product())
        })
    }
}

/// Place of one of 64 voxels among them, and its index by its place.
fn place_of(index: usize) -> IVec3 {
    let i = index as i32;
    IVec3::new(i & 3, i >> 2 & 3, i >> 4)
}

fn index_of(place: IVec3) -> usize {
    (place.x + 4 * (place.y + 4 * place.z)) as usize
}

/// The voxel of the labels that is nearest to one.
fn clamped(labels: &Segmentation, at: IVec3) -> IVec3 {
    at.clamp(IVec3::ZERO, labels.grid.dims.as_ivec3() - 1)
}

/// Label of a voxel; `None` beyond the labels.
fn label_of(labels: &Segmentation, at: IVec3) -> Option<u8> {
    let dims = labels.grid.dims.as_ivec3();
    if at.cmplt(IVec3::ZERO).any() || at.cmpge(dims).any() {
        return None;
    }
    let [x, y, z] = at.to_array().map(i64::from);
    let index = x + i64::from(dims.x) * (y + i64::from(dims.y) * z);
    Some(labels.labels.get(index as usize).copied().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec3;

    /// Kept: label 1.
    fn kept() -> KeptLabels {
        KeptLabels::new(|label| u8::from(label == 1))
    }

    #[test]
    fn a_place_has_a_label_of_its_side() {
        // A slope of one voxel in two along x: label 1 below.
        let slope = Segmentation::cube(12, 1.0, |at| u8::from(at.y >= at.x / 2 + 3) + 1, &[]);
        let labels = kept();
        let mut told = [0, 0];
        for i in 0..400 {
            let voxel = DVec3::new(2.0 + 0.02 * f64::from(i), 3.7 + 0.01 * f64::from(i), 6.0);
            let own = label_of(&slope, voxel.round().as_ivec3());
            let found = labels.label_at(&slope, voxel);
            let side = labels.sets_at(&slope, voxel);
            assert_eq!(found == Some(1), side == 1, "{voxel}");
            told[usize::from(own != found)] += 1;
        }
        assert!(
            told[1] > 10 && told[0] > 200,
            "the stairs are off: {told:?}"
        );
        assert_eq!(labels.label_at(&slope, DVec3::splat(-0.6)), None);
        assert_eq!(
            KeptLabels::none().label_at(&slope, DVec3::splat(-0.4)),
            Some(1)
        );
    }

    #[test]
    fn what_is_thin_stays_and_crumbs_go() {
        // A plate and a rod of one voxel; a hole of 27 voxels and one of 28.
        let hole = |at: UVec3| {
            let from = at.as_ivec3() - IVec3::new(2, 2, 10);
            from.min_element() >= 0 && from.max_element() < 3
        };
        let thin = Segmentation::cube(
            16,
            1.0,
            |at| match at.to_array() {
                [_, _, z] if z > 8 => u8::from(!hole(at)),
                [_, 7, 2] | [5, _, _] => 1,
                _ => 0,
            },
            &[],
        );
        let kept = kept();
        for i in 0..150 {
            let t = 0.1 * f64::from(i);
            let side = |voxel| kept.sets_at(&thin, voxel);
            assert_eq!(side(DVec3::new(t, 7.0, 2.0)), 1, "the rod at {t}");
            assert_eq!(side(DVec3::new(5.0, t, 6.0)), 1, "the plate at {t}");
        }
        assert_eq!(kept.label_at(&thin, DVec3::new(3.0, 3.0, 11.0)), Some(0));
        assert!(kept.piece_of(&thin, IVec3::new(3, 3, 11), 0, |_| false).1);
        let larger = Segmentation::cube(
            16,
            1.0,
            |at| u8::from(!hole(at) && at != UVec3::new(5, 3, 11)),
            &[],
        );
        assert!(!kept.piece_of(&larger, IVec3::new(3, 3, 11), 0, |_| false).1);
    }

    /// Shares of four sets that exclude each other and leave nothing out add up to 1 at each voxel, but for the steps
    /// of 1 / 255 that each is rounded to; shares of sets that overlap do not.
    #[test]
    fn shares_of_sets_that_exclude_each_other_add_up_to_1() {
        let n = 14;
        // Four cells about four places, their borders disturbed voxel by voxel.
        let places = [
            DVec3::new(3.0, 4.0, 3.0),
            DVec3::new(10.0, 3.0, 5.0),
            DVec3::new(5.0, 11.0, 7.0),
            DVec3::new(9.0, 8.0, 12.0),
        ];
        let label = |at: UVec3| {
            let noise = (at.x * 7 + at.y * 13 + at.z * 29) * 389 % 1_000;
            let off = f64::from(noise) / 500.0 * DVec3::new(1.0, -1.0, 0.5);
            let from = |k: &usize| places[*k].distance(at.as_dvec3() + off);
            let nearest = (0..4).min_by(|a, b| from(a).total_cmp(&from(b)));
            nearest.unwrap_or(0) as u8
        };
        let labels = Segmentation::cube(n, 1.0, label, &[]);
        let apart = KeptLabels::new(|label| 1 << label.min(3));
        // The second set has the first one's label as well.
        let overlapping =
            KeptLabels::new(|label| [0b0011, 0b0010, 0b0100, 0b1000][usize::from(label.min(3))]);
        let (mut mixed, mut larger) = (0, 0);
        for i in 0..n.pow(3) {
            let voxel = UVec3::new(i % n, i / n % n, i / (n * n));
            let around = Around::of(&labels, voxel.as_dvec3());
            // The voxel itself is the second of the four along each axis.
            let at = IVec3::ONE;
            let sum = |sets: &KeptLabels| {
                let shares = (0..4).map(|set| {
                    let members = around.labels.map(|label| sets.has(label, set));
                    sets.share(&around, &members, at, set)
                });
                let shares: Vec<f64> = shares.collect();
                (shares.iter().sum::<f64>(), shares)
            };
            let (whole, shares) = sum(&apart);
            assert!(
                (whole - 1.0).abs() <= 2.0 / 255.0 + 1e-9,
                "{voxel}: {shares:?}"
            );
            let own = usize::from(label(voxel));
            assert!(
                shares[own] >= HELD - 0.5 / 255.0,
                "{voxel}: {shares:?} of label {own}"
            );
            mixed += usize::from(shares.iter().filter(|share| **share > 0.0).count() > 2);
            larger += usize::from(sum(&overlapping).0 > 1.1);
        }
        assert!(mixed > 50, "{mixed} voxels where three labels meet");
        assert!(larger > 200, "a set that overlaps is found out: {larger}");
    }
}
