//! Which bricks of a subject hold segments that are drawn as bodies: the others need no work.

use crate::render::pack::gpu_types::{BODY_BRICK, BODY_MIXED, BODY_NOTHING};
use crate::render::subject::bricks::{BRICK, LabelSet};
use glam::UVec3;

/// What fills the bricks of the shares, `BODY_BRICK` voxels along a side, x fastest: a label, `BODY_MIXED` or
/// `BODY_NOTHING`. A label stands for a brick whose voxels and those around it all have it. `sets` are the labels of
/// the bricks of the label voxels, `None` where they are not known; `labels` and `shares` are sizes in voxels, over the
/// same box; `bodies` are the labels that are drawn as bodies.
pub(super) fn fillings(
    sets: Option<&[LabelSet]>,
    [labels, shares]: [UVec3; 2],
    bodies: &LabelSet,
) -> Vec<u32> {
    let bricks = shares.map(|n| n.div_ceil(BODY_BRICK));
    let Some(sets) = sets else {
        return vec![BODY_MIXED; bricks.as_usizevec3().element_product()];
    };
    // The bricks of labels that the voxels of a brick of shares are made from, along each axis.
    let spans = [0, 1, 2].map(|axis| {
        let (fine, coarse) = (u64::from(labels[axis]), u64::from(shares[axis]));
        let last = fine.max(1) - 1;
        let middle = |voxel: u64| (2 * voxel + 1) * fine / (2 * coarse.max(1));
        let span = |brick: u32| {
            let first = u64::from(brick * BODY_BRICK);
            let end = first + u64::from(BODY_BRICK) - 1;
            // One voxel around, and one more for the rounding of the shader.
            let [low, high] = [middle(first).saturating_sub(2), (middle(end) + 2).min(last)];
            (low / u64::from(BRICK)) as usize..=(high / u64::from(BRICK)) as usize
        };
        (0..bricks[axis]).map(span).collect::<Vec<_>>()
    });
    let dims = labels.map(|n| n.div_ceil(BRICK)).as_usizevec3();
    let mut fillings = Vec::with_capacity(bricks.as_usizevec3().element_product());
    for z in &spans[2] {
        for y in &spans[1] {
            for x in &spans[0] {
                let mut met = [0; 8];
                for row in z
                    .clone()
                    .flat_map(|z| y.clone().map(move |y| y + dims.y * z))
                {
                    let row = dims.x * row;
                    for set in sets
                        .get(row + x.start()..=row + x.end())
                        .unwrap_or_default()
                    {
                        met = std::array::from_fn(|i| met[i] | set[i]);
                    }
                }
                fillings.push(filling(&met, bodies));
            }
        }
    }
    fillings
}

fn filling(met: &LabelSet, bodies: &LabelSet) -> u32 {
    let has_body = met.iter().zip(bodies).any(|(a, b)| a & b != 0);
    let number: u32 = met.iter().map(|word| word.count_ones()).sum();
    match (has_body, number) {
        (false, _) => BODY_NOTHING,
        (true, 1) => (0..256)
            .find(|label| met[*label as usize / 32] & (1 << (label % 32)) != 0)
            .unwrap_or(BODY_MIXED),
        (true, _) => BODY_MIXED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set_of(labels: &[u32]) -> LabelSet {
        let mut set = [0; 8];
        for label in labels {
            set[*label as usize / 32] |= 1 << (label % 32);
        }
        set
    }

    #[test]
    fn a_brick_is_mixed_where_a_body_borders_on_something_else() {
        // Label 40 is a body and fills the first three of five bricks of a row; label 2 is none.
        let sets = [40, 40, 40, 2, 2].map(|label| set_of(&[label]));
        let row = UVec3::new(40, 8, 8);
        let found = fillings(Some(&sets), [row, row], &set_of(&[40]));
        assert_eq!(found, [40, 40, BODY_MIXED, BODY_MIXED, BODY_NOTHING]);
        // Along another axis too, with a last brick that is not whole.
        let column = UVec3::new(3, 37, 2);
        let found = fillings(Some(&sets), [column, column], &set_of(&[40]));
        assert_eq!(found, [40, 40, BODY_MIXED, BODY_MIXED, BODY_NOTHING]);
        // Shares half as fine: each of their bricks is made from two of the labels, and borders on a third.
        let coarse = UVec3::new(20, 4, 4);
        let found = fillings(Some(&sets), [row, coarse], &set_of(&[40]));
        assert_eq!(found, [40, BODY_MIXED, BODY_NOTHING]);
        assert_eq!(fillings(None, [row, row], &set_of(&[40])), [BODY_MIXED; 5]);
    }
}
