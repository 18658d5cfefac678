//! Where a segment lies.

use glam::{DVec3, Vec3};

use super::Segmentation;

/// Voxels that are looked at in a first pass: enough for all but the smallest segments, and done in a few milliseconds.
const FIRST_PASS: usize = 1 << 21;

/// Voxels of a segment that a first pass has to find.
const ENOUGH: u64 = 64;

/// Where a part of the untouched subject lies, subject space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// A point of the part itself, as near to its centroid as there is one.
    pub middle: Vec3,
    /// Its centroid, which need not belong to it: that of a bowl does not.
    pub centroid: Vec3,
    /// How far it reaches from its centroid, subject units.
    pub reach: f32,
}

impl Site {
    /// The site of a point.
    pub fn point(pos: Vec3) -> Self {
        Self {
            middle: pos,
            centroid: pos,
            reach: 0.0,
        }
    }
}

impl Segmentation {
    /// Where the segment of this name lies; `None` if no voxel belongs to it. Looks at a part of the voxels where there
    /// are many, and at all of them if it finds too little of the segment there.
    pub fn site_of(&self, name: &str) -> Option<Site> {
        let mut is_it = [false; 256];
        for segment in self.segments.iter().filter(|s| s.name == name) {
            if let Some(is_it) = is_it.get_mut(usize::from(segment.label)) {
                *is_it = true;
            }
        }
        // Every so many voxels along each axis.
        let share = self.labels.len() as f64 / FIRST_PASS as f64;
        let stride = share.cbrt().ceil().max(1.0) as usize;
        self.site(&is_it, stride, ENOUGH)
            .or_else(|| self.site(&is_it, 1, 1))
    }

    /// The site of the voxels of some labels, of every `stride`th voxel along each axis; `None` if they are fewer than
    /// `least`.
    fn site(&self, is_it: &[bool; 256], stride: usize, least: u64) -> Option<Site> {
        let [width, height, _] = self.grid.dims.to_array().map(|n| n as usize);
        let each = |take: &mut dyn FnMut(DVec3)| {
            let rows = self.labels.chunks(width.max(1)).enumerate();
            let is_row = |row: &usize| {
                (row % height.max(1)).is_multiple_of(stride)
                    && (row / height.max(1)).is_multiple_of(stride)
            };
            for (row, labels) in rows.filter(|(row, _)| is_row(row)) {
                let (y, z) = (row % height, row / height);
                for (x, &label) in labels.iter().enumerate().step_by(stride) {
                    if is_it[usize::from(label)] {
                        take(DVec3::new(x as f64, y as f64, z as f64));
                    }
                }
            }
        };
        let (mut count, mut sum) = (0_u64, DVec3::ZERO);
        each(&mut |voxel| {
            count += 1;
            sum += voxel;
        });
        if count < least.max(1) {
            return None;
        }
        let subject_from_voxel = self.grid.subject_from_voxel();
        let mean = sum / count as f64;
        // Distances in the subject's own lengths: voxels need not be cubes.
        let lengths = subject_from_voxel.matrix3;
        let (mut nearest, mut middle, mut farthest) = (f64::INFINITY, mean, 0.0_f64);
        each(&mut |voxel| {
            let far = (lengths * (voxel - mean)).length_squared();
            farthest = farthest.max(far);
            if far < nearest {
                (nearest, middle) = (far, voxel);
            }
        });
        let pos = |voxel: DVec3| subject_from_voxel.transform_point3(voxel).as_vec3();
        Some(Site {
            middle: pos(middle),
            centroid: pos(mean),
            reach: farthest.sqrt() as f32,
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::UVec3;

    use super::*;

    /// Voxels of 2 mm, `n` along each side, with labels by their indices.
    fn labelled(n: u32, label: impl Fn(UVec3) -> u8) -> Segmentation {
        let segments = [(1, "box"), (2, "box"), (3, "dot"), (4, "absent")];
        Segmentation::cube(n, 2.0, label, &segments)
    }

    #[test]
    fn a_segment_has_a_centroid_a_middle_and_a_reach() {
        // Two plates of one name, under two labels: nothing of them is between.
        let plates = labelled(20, |voxel| match voxel.x {
            4 => 1,
            16 => 2,
            _ => 0,
        });
        let site = plates.site_of("box").expect("it is there");
        let at = |x: f32| (x + 0.5) / 20.0 - 0.5;
        assert!((site.centroid.x - at(10.0)).abs() < 1e-5, "{site:?}");
        assert!(site.centroid.y.abs() < 1e-5 && site.centroid.z.abs() < 1e-5);
        let is_plate = |x: f32| {
            [4.0, 16.0]
                .iter()
                .any(|plate| (x - at(*plate)).abs() < 1e-5)
        };
        assert!(is_plate(site.middle.x), "a point of a plate: {site:?}");
        assert!(site.middle.y.abs() < 0.05, "near the centroid: {site:?}");
        let corner = Vec3::new(6.0, 9.5, 9.5).length() / 20.0;
        assert!((site.reach - corner).abs() < 1e-4, "{site:?}");
        assert_eq!(plates.site_of("absent"), None);
        assert_eq!(plates.site_of("nobody"), None);
    }

    #[test]
    fn a_single_voxel_is_found_among_many() {
        let n = 150;
        assert!((n as usize).pow(3) > FIRST_PASS, "not all are looked at");
        let dot = UVec3::new(7, 33, 101);
        let dots = labelled(n, |voxel| match voxel {
            voxel if voxel == dot => 3,
            voxel if voxel.x < 20 => 1,
            _ => 0,
        });
        let site = dots.site_of("dot").expect("it is there");
        let pos = (dot.as_vec3() + 0.5) / n as f32 - 0.5;
        assert!(site.middle.distance(pos) < 1e-5, "{site:?}");
        assert_eq!(site.reach, 0.0);
        let slab = dots.site_of("box").expect("it is there");
        assert!(
            (slab.centroid.x - (10.0 / 150.0 - 0.5)).abs() < 0.01,
            "{slab:?}"
        );
    }
}
