//! Which segments lie inside others, found on a coarse copy of the labels.
//!
//! The kept segments are closed first: a ball of [`BALL`] rolls around them from the outside, and where it cannot get
//! is inside. So the holes of a skull for nerves and for the spinal cord do not open it.

use glam::{UVec3, Vec3};

use super::mask::Mask;
use super::time_slices::TimeSlices;
use super::{Segment, Segmentation};

/// Cells of the coarse copy along the longest side: a flood through all of them takes a few milliseconds.
const CELLS: f32 = 56.0;
/// Radius of the ball, in parts of the longest side: 2 cm for a head, more than half of the hole for the spinal cord.
const BALL: f32 = 0.08;
/// The share of a segment's cells that have to lie inside.
const LEAST: f32 = 0.9;

/// Labels of a subject in few cells. Made once for each segmentation.
#[derive(Clone, Debug, PartialEq)]
pub struct CoarseLabels {
    dims: UVec3,
    spacing_mm: Vec3,
    /// x fastest; the label in the middle of each cell.
    labels: Vec<u8>,
}

impl CoarseLabels {
    /// The coarse copy of a segmentation.
    pub fn of(segmentation: &Segmentation) -> Self {
        let grid = &segmentation.grid;
        let size_mm = grid.dims.as_vec3() * grid.spacing_mm().as_vec3();
        let cell_mm = (size_mm.max_element() / CELLS).max(1e-6);
        let dims = (size_mm / cell_mm).ceil().as_uvec3();
        let dims = dims.clamp(UVec3::ONE, grid.dims.max(UVec3::ONE));
        let middles = |axis: usize| -> Vec<usize> {
            let (few, all) = (dims[axis] as usize, grid.dims[axis] as usize);
            (0..few).map(|i| (2 * i + 1) * all / (2 * few)).collect()
        };
        let [xs, ys, zs] = [0, 1, 2].map(middles);
        let [width, height] = [grid.dims.x, grid.dims.y].map(|n| n as usize);
        let mut labels = Vec::with_capacity(xs.len() * ys.len() * zs.len());
        for z in zs {
            for y in &ys {
                let row = (y + height * z) * width;
                labels.extend(
                    xs.iter()
                        .map(|x| segmentation.labels.get(row + x).copied().unwrap_or(0)),
                );
            }
        }
        Self {
            dims,
            spacing_mm: size_mm / dims.as_vec3(),
            labels,
        }
    }

    /// Names of the segments that lie inside the kept ones, in the order of `segments`, which names the labels.
    pub async fn inside(
        &self,
        segments: &[Segment],
        is_kept: impl Fn(&Segment) -> bool,
        time_slices: &TimeSlices,
    ) -> Vec<String> {
        let mut kept = [false; 256];
        for segment in segments.iter().filter(|segment| is_kept(segment)) {
            if let Some(kept) = kept.get_mut(usize::from(segment.label)) {
                *kept = true;
            }
        }
        let reach_mm = BALL * (self.dims.as_vec3() * self.spacing_mm).max_element();
        // Room around, in which the ball rolls.
        let margin = (reach_mm / self.spacing_mm).ceil().as_uvec3() + 1;
        let dims = self.dims + 2 * margin;
        let [width, height, _] = dims.to_array().map(|n| n as usize);
        let mut mask = Mask {
            dims,
            bits: vec![0; dims.as_u64vec3().element_product() as usize],
        };
        let mut places = Vec::with_capacity(self.labels.len());
        for z in 0..self.dims.z {
            for y in 0..self.dims.y {
                for x in 0..self.dims.x {
                    let [x, y, z] = (UVec3::new(x, y, z) + margin)
                        .to_array()
                        .map(|n| n as usize);
                    places.push(x + width * (y + height * z));
                }
            }
        }
        for (&label, &place) in self.labels.iter().zip(&places) {
            mask.bits[place] = u8::from(kept[usize::from(label)]);
        }
        let spacing = self.spacing_mm.to_array();
        mask.spread(1, spacing, reach_mm, time_slices).await;
        mask.fill(time_slices).await;
        mask.spread(0, spacing, reach_mm, time_slices).await;
        // Cells of each label, all of them and those inside; what is kept itself is neither.
        let mut cells = [[0_u32; 2]; 256];
        for (&label, &place) in self.labels.iter().zip(&places) {
            let label = usize::from(label);
            if !kept[label] {
                cells[label][0] += 1;
                cells[label][1] += u32::from(mask.bits[place]);
            }
        }
        let mut found: Vec<String> = Vec::new();
        for segment in segments.iter().filter(|segment| !is_kept(segment)) {
            let own = segments.iter().filter(|other| other.name == segment.name);
            let [all, inside] = own.fold([0, 0], |[all, inside], other| {
                let [a, b] = cells
                    .get(usize::from(other.label))
                    .copied()
                    .unwrap_or_default();
                [all + a, inside + b]
            });
            let is_inside = all > 0 && inside as f32 >= LEAST * all as f32;
            if is_inside && !found.contains(&segment.name) {
                found.push(segment.name.clone());
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use std::pin::pin;
    use std::task::{Context, Poll, Waker};

    use super::*;

    fn inside(labels: &Segmentation, keep: &[&str]) -> Vec<String> {
        let coarse = CoarseLabels::of(labels);
        let unlimited = TimeSlices::unlimited();
        let is_kept = |segment: &Segment| keep.contains(&segment.name.as_str());
        let work = pin!(coarse.inside(&labels.segments, is_kept, &unlimited));
        match work.poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(names) => names,
            Poll::Pending => panic!("without time slices nothing waits"),
        }
    }

    /// A ball of skin (4) around a shell of bone (1) around a brain (2) with a vessel (3, also under 5 with the brain),
    /// all of 80 voxels; a hole of the given radius goes through skin and bone from below.
    fn head(hole: f32) -> Segmentation {
        let label = |voxel: UVec3| {
            let pos = voxel.as_vec3() - Vec3::splat(39.5);
            let is_hole = pos.z < 0.0 && pos.truncate().length() < hole;
            match pos.length() {
                r if r < 5.0 => 3,
                r if r < 7.0 => 5,
                r if r < 28.0 => 2,
                _ if is_hole => 0,
                r if r < 31.0 => 1,
                r if r < 35.0 => 4,
                _ => 0,
            }
        };
        let segments = [
            (1, "bone"),
            (2, "brain"),
            (3, "vessel"),
            (4, "skin"),
            (5, "brain"),
            (5, "vessel"),
            (6, "absent"),
        ];
        Segmentation::cube(80, 1.0, label, &segments)
    }

    #[test]
    fn what_a_skull_with_a_small_hole_encloses_is_inside() {
        for hole in [0.0, 4.0] {
            let head = head(hole);
            assert_eq!(inside(&head, &["bone"]), ["brain", "vessel"], "hole {hole}");
        }
        let head = head(4.0);
        assert_eq!(inside(&head, &["skin"]), ["bone", "brain", "vessel"]);
        assert_eq!(inside(&head, &["bone", "brain"]), ["vessel"]);
        assert_eq!(inside(&head, &["vessel"]), [""; 0]);
        assert_eq!(inside(&head, &[]), [""; 0]);
    }

    #[test]
    fn a_bowl_encloses_nothing() {
        assert_eq!(inside(&head(24.0), &["bone"]), [""; 0]);
    }
}
