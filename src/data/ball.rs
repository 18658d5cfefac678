//! Painting and erasing in a set of voxels with a ball.
//!
//! By 64-bit additions, products, quotients and comparisons in a fixed order, as all that is done with sets: the same
//! bit for bit on every machine.

use glam::{DMat3, DVec3, IVec3, UVec3};

use super::Grid;
use super::mask::Mask;
use super::time_slices::TimeSlices;
use crate::document::Stroke;

impl Mask {
    /// Adds the voxels whose centres the ball of a stroke touches, or takes them out. A centre is touched if it is at
    /// most the radius, mm, away from the line along the places of the stroke. `grid` is that of the set.
    pub async fn paint(&mut self, grid: &Grid, stroke: &Stroke, time_slices: &TimeSlices) {
        let to = u8::from(!stroke.erases);
        let radius = f64::from(stroke.radius_mm);
        let voxel_from_rest = grid.subject_from_voxel().inverse();
        let in_voxels = |place: IVec3| voxel_from_rest.transform_point3(Stroke::in_rest(place));
        let mm_from_voxel = grid.world_from_voxel.matrix3;
        let places: Vec<DVec3> = stroke.places.iter().map(|&p| in_voxels(p)).collect();
        // A stroke of one place is a ball.
        let ball = places.first().map(|&place| [place; 2]);
        let lines = places.windows(2).map(|ends| [ends[0], ends[1]]);
        for line in ball.into_iter().filter(|_| places.len() == 1).chain(lines) {
            self.sweep(mm_from_voxel, line, radius, to, time_slices)
                .await;
        }
    }

    /// Sets the voxels whose centres are at most a radius, mm, from the line between two points, in voxels.
    async fn sweep(
        &mut self,
        mm_from_voxel: DMat3,
        [start, end]: [DVec3; 2],
        radius: f64,
        to: u8,
        time_slices: &TimeSlices,
    ) {
        let Some([low, high]) = box_around(mm_from_voxel, [start, end], radius, self.dims) else {
            return;
        };
        let way = mm_from_voxel * (end - start);
        let way_squared = way.dot(way);
        let radius_squared = radius * radius;
        let (width, height) = (self.dims.x as usize, self.dims.y as usize);
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                let row = DVec3::new(0.0, f64::from(y), f64::from(z)) - start;
                let row = mm_from_voxel * row;
                let at = (y as usize + height * z as usize) * width;
                for x in low.x..=high.x {
                    let pos = row + mm_from_voxel.x_axis * f64::from(x);
                    let part = match way_squared > 0.0 {
                        true => (pos.dot(way) / way_squared).clamp(0.0, 1.0),
                        false => 0.0,
                    };
                    let off = pos - way * part;
                    if off.dot(off) <= radius_squared {
                        self.bits[at + x as usize] = to;
                    }
                }
            }
            time_slices.give_way().await;
        }
    }
}

/// First and last voxels of a box that holds the ball's way, within the grid; `None` if the way misses the grid.
fn box_around(
    mm_from_voxel: DMat3,
    [start, end]: [DVec3; 2],
    radius: f64,
    dims: UVec3,
) -> Option<[UVec3; 2]> {
    // The ball is as wide along an axis of the grid as the row of the inverse is long. A voxel more than needed.
    let rows = mm_from_voxel.inverse().transpose();
    let reach = DVec3::new(
        rows.x_axis.length(),
        rows.y_axis.length(),
        rows.z_axis.length(),
    );
    let reach = reach * radius + 1.0;
    let (low, high) = (start.min(end) - reach, start.max(end) + reach);
    let last = dims.as_dvec3() - 1.0;
    if !(low.cmple(last).all() && high.cmpge(DVec3::ZERO).all()) {
        return None;
    }
    let within = |pos: DVec3| pos.clamp(DVec3::ZERO, last).as_uvec3();
    Some([within(low), within(high)])
}
