//! The long axes of segments: what hatching follows.

use super::volume::Segmentation;
use glam::{DAffine3, DMat3, DVec3, UVec3, Vec3};

/// Voxels that are looked at, at most: every second or third of a large volume tells the axis as well.
const MOST_VOXELS: f64 = 1e6;
/// Turns of the power iteration, each a squaring: enough to part axes whose lengths differ by a hundredth.
const SQUARINGS: u32 = 10;
/// An axis is one only where the extent along it is so much larger than the next.
const LEAST_LENGTH: f64 = 1.05;

/// The voxels of one segment, counted with their places and the products of their places.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sum: DVec3,
    products: DMat3,
}

/// The long axis of each label, as unit vectors of rest space by label; item 0 is that of all labels above 0 together.
/// `rest_from_voxel` says where the voxels of the labels lie. A segment without a long axis, as a ball is, takes the
/// axis from foot to head, z.
pub fn long_axes(labels: &Segmentation, rest_from_voxel: &DAffine3) -> [Vec3; 256] {
    let dims = labels.grid.dims;
    let voxels = dims.as_dvec3().element_product();
    let step = (voxels / MOST_VOXELS).cbrt().ceil().max(1.0) as usize;
    let mut moments = vec![Moments::default(); 256];
    let [width, height, depth] = dims.to_array().map(|side| side as usize);
    for z in (0..depth).step_by(step) {
        for y in (0..height).step_by(step) {
            let start = (z * height + y) * width;
            let row = labels.labels.get(start..start + width).unwrap_or_default();
            for (x, &label) in row.iter().enumerate().step_by(step) {
                if label > 0 {
                    let voxel = UVec3::new(x as u32, y as u32, z as u32);
                    let at = rest_from_voxel.transform_point3(voxel.as_dvec3());
                    if let Some(moments) = moments.get_mut(usize::from(label)) {
                        moments.add(at);
                    }
                }
            }
        }
    }
    let all = moments
        .iter()
        .fold(Moments::default(), |all, one| all.with(one));
    std::array::from_fn(|label| match label {
        0 => all.long_axis(),
        _ => moments.get(label).map_or(Vec3::Z, Moments::long_axis),
    })
}

impl Moments {
    fn add(&mut self, at: DVec3) {
        self.count += 1.0;
        self.sum += at;
        self.products += DMat3::from_cols(at * at.x, at * at.y, at * at.z);
    }

    fn with(self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            sum: self.sum + other.sum,
            products: self.products + other.products,
        }
    }

    /// The direction of the largest extent, upwards.
    fn long_axis(&self) -> Vec3 {
        if self.count < 2.0 {
            return Vec3::Z;
        }
        let mean = self.sum / self.count;
        let spread = self.products * self.count.recip()
            - DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z);
        let largest = |m: &DMat3| {
            let columns = [m.x_axis, m.y_axis, m.z_axis];
            columns.into_iter().fold(DVec3::ZERO, |best, column| {
                if column.length_squared() > best.length_squared() {
                    column
                } else {
                    best
                }
            })
        };
        // A power of the matrix has the direction of its largest eigenvalue in every column.
        let mut power = spread;
        for _ in 0..SQUARINGS {
            let size = largest(&power).length();
            if size <= 0.0 {
                return Vec3::Z;
            }
            power *= size.recip();
            power *= power;
        }
        let axis = largest(&power).normalize_or(DVec3::Z);
        let along = axis.dot(spread * axis);
        let trace = spread.x_axis.x + spread.y_axis.y + spread.z_axis.z;
        // The larger of the other two is at least half of what is left.
        if along < LEAST_LENGTH * LEAST_LENGTH * 0.5 * (trace - along) {
            return Vec3::Z;
        }
        let upwards = if axis.z < 0.0 { -axis } else { axis };
        upwards.as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rods_have_their_direction_and_balls_have_none() {
        let n = 40;
        let way = Vec3::new(1.0, 2.0, -1.0).normalize();
        let middle = Vec3::splat(20.0);
        let label = |voxel: UVec3| {
            let from_middle = voxel.as_vec3() - middle;
            let along = from_middle.dot(way);
            let off = (from_middle - way * along).length();
            if off < 3.0 && along.abs() < 16.0 {
                1
            } else if (from_middle - Vec3::new(12.0, -12.0, 12.0)).length() < 5.0 {
                2
            } else {
                0
            }
        };
        let labels = Segmentation::cube(n, 1.0, label, &[(1, "rod"), (2, "ball")]);
        let axes = long_axes(&labels, &DAffine3::IDENTITY);
        assert!(axes[1].dot(way).abs() > 0.999, "{}", axes[1]);
        assert!(axes[1].z > 0.0, "upwards");
        assert_eq!(axes[2], Vec3::Z, "a ball");
        assert_eq!(axes[3], Vec3::Z, "no voxel");
        // Voxels that are longer along z.
        let stretched = DAffine3::from_scale(DVec3::new(1.0, 1.0, 4.0));
        let axes = long_axes(&labels, &stretched);
        let wanted = Vec3::new(way.x, way.y, 4.0 * way.z).normalize();
        assert!(axes[1].dot(wanted).abs() > 0.99, "{}", axes[1]);
    }
}
