use super::frame::SubjectFrame;
use crate::math::Aabb;
use glam::{DAffine3, DVec3, UVec3, Vec3};

/// An oriented voxel grid. x runs fastest in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Voxels along each axis, none of them 0.
    pub dims: UVec3,
    /// Takes a voxel index (centre of the first voxel at 0) to mm, RAS+. Any invertible affine: oblique, sheared,
    /// mirrored.
    pub world_from_voxel: DAffine3,
}

impl Grid {
    /// Number of voxels, the product of the three dimensions.
    pub fn voxel_count(&self) -> usize {
        self.dims.as_u64vec3().element_product() as usize
    }

    /// Distance between neighbouring voxel centres along each grid axis, mm.
    pub fn spacing_mm(&self) -> DVec3 {
        let m = self.world_from_voxel.matrix3;
        DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length())
    }

    /// Axis-aligned box in world space of all voxel corners at their outer edges, (min, max) mm.
    pub fn world_bounds(&self) -> (DVec3, DVec3) {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for i in 0..8u32 {
            let pick = |bit: u32, n: u32| {
                if i & bit == 0 {
                    -0.5
                } else {
                    f64::from(n) - 0.5
                }
            };
            let corner = DVec3::new(
                pick(1, self.dims.x),
                pick(2, self.dims.y),
                pick(4, self.dims.z),
            );
            let pos = self.world_from_voxel.transform_point3(corner);
            min = min.min(pos);
            max = max.max(pos);
        }
        (min, max)
    }

    /// Millimetres in one subject unit: the longest side of [`Grid::world_bounds`].
    pub fn mm_per_unit(&self) -> f64 {
        let (min, max) = self.world_bounds();
        (max - min).max_element()
    }

    /// Where a volume on this grid lies, and how fine it is.
    pub fn frame(&self) -> SubjectFrame {
        let (min, max) = self.world_bounds();
        let mm_per_unit = self.mm_per_unit();
        SubjectFrame {
            bounds: self.subject_bounds(),
            mm_per_unit,
            middle_mm: 0.5 * (min + max),
            detail: (self.spacing_mm().min_element() / mm_per_unit) as f32,
        }
    }

    /// Subject space (spec/templates.md, "Spaces") from voxel indices.
    pub fn subject_from_voxel(&self) -> DAffine3 {
        let (min, max) = self.world_bounds();
        let to_subject = DAffine3::from_scale(DVec3::splat(1.0 / self.mm_per_unit()))
            * DAffine3::from_translation(-(min + max) * 0.5);
        to_subject * self.world_from_voxel
    }

    /// Texture space (outer edges of the grid at 0 and 1) from subject space.
    pub fn texture_from_subject(&self) -> DAffine3 {
        let texture_from_voxel = DAffine3::from_scale(self.dims.as_dvec3().recip())
            * DAffine3::from_translation(DVec3::splat(0.5));
        texture_from_voxel * self.subject_from_voxel().inverse()
    }

    /// Box of the untouched subject in subject space: centred at the origin, longest side 1.
    pub fn subject_bounds(&self) -> Aabb {
        let (min, max) = self.world_bounds();
        let half: Vec3 = ((max - min) * (0.5 / self.mm_per_unit())).as_vec3();
        Aabb {
            min: -half,
            max: half,
        }
    }
}

/// Scalars in the type they are kept in. Other file types are converted to the next that holds them.
#[derive(Clone, Debug, PartialEq)]
pub enum Voxels {
    /// Unsigned 8-bit numbers.
    U8(Vec<u8>),
    /// Signed 16-bit numbers.
    I16(Vec<i16>),
    /// Unsigned 16-bit numbers.
    U16(Vec<u16>),
    /// Anything wider or scaled to fractions.
    F32(Vec<f32>),
}

impl Voxels {
    /// Number of voxels held so far.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(v) => v.len(),
            Self::I16(v) => v.len(),
            Self::U16(v) => v.len(),
            Self::F32(v) => v.len(),
        }
    }

    /// True if nothing is held.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The stored number at a linear index, without slope and intercept. `None` past the end.
    pub fn get(&self, index: usize) -> Option<f32> {
        match self {
            Self::U8(v) => v.get(index).map(|&x| f32::from(x)),
            Self::I16(v) => v.get(index).map(|&x| f32::from(x)),
            Self::U16(v) => v.get(index).map(|&x| f32::from(x)),
            Self::F32(v) => v.get(index).copied(),
        }
    }
}

/// One named segment of a label volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Number in the label volume, above 0.
    pub label: u16,
    /// Name as shown and as used in `keep`.
    pub name: String,
    /// Natural colour, sRGB bytes, if one is known.
    pub color_srgb: Option<[u8; 3]>,
}

/// Which segment each voxel belongs to, by its label; label 0 is no segment. Has its own grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// Grid of the labels; often but not always that of the scan.
    pub grid: Grid,
    /// One label per voxel, x fastest.
    pub labels: Vec<u8>,
    /// Named segments, those of files in label order. A name may have several labels: where segments overlap,
    /// the overlap has a label of its own, which is listed once for each of these segments, in their order; the first
    /// one gives the colour.
    pub segments: Vec<Segment>,
}

#[cfg(test)]
impl Segmentation {
    /// For unit tests: `n` voxels of `mm` along each side with labels by their indices, and segments by labels and
    /// names.
    pub(crate) fn cube(
        n: u32,
        mm: f64,
        label: impl Fn(UVec3) -> u8,
        segments: &[(u16, &str)],
    ) -> Self {
        let voxels = (0..n).flat_map(|z| (0..n).flat_map(move |y| (0..n).map(move |x| [x, y, z])));
        let segment = |&(label, name): &(u16, &str)| Segment {
            label,
            name: name.to_owned(),
            color_srgb: None,
        };
        Self {
            grid: Grid {
                dims: UVec3::splat(n),
                world_from_voxel: DAffine3::from_scale(DVec3::splat(mm)),
            },
            labels: voxels.map(|voxel| label(UVec3::from(voxel))).collect(),
            segments: segments.iter().map(segment).collect(),
        }
    }
}

/// A scalar volume in memory: `value = stored · slope + intercept`. Built once per subject.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Size, spacing and orientation.
    pub grid: Grid,
    /// Scalars as stored, x fastest, `grid.voxel_count()` of them.
    pub voxels: Voxels,
    /// Factor from stored number to value.
    pub slope: f32,
    /// Value of the stored number 0.
    pub intercept: f32,
    /// Smallest and largest finite value (slope and intercept applied); equal if the volume is constant.
    pub value_range: [f32; 2],
    /// Segments, where the subject has them.
    pub segmentation: Option<Segmentation>,
    /// The file says how large its voxels are. False: 1 mm was taken, so lengths in mm mean nothing.
    pub has_size: bool,
}

impl Volume {
    /// Value at a voxel, slope and intercept applied. `None` outside the grid.
    pub fn value_at(&self, voxel: UVec3) -> Option<f32> {
        if voxel.cmpge(self.grid.dims).any() {
            return None;
        }
        let dims = self.grid.dims.as_u64vec3();
        let v = voxel.as_u64vec3();
        let index = v.x + dims.x * (v.y + dims.y * v.z);
        self.voxels
            .get(index as usize)
            .map(|stored| stored * self.slope + self.intercept)
    }
}
