//! From distances to voxels: a block of the grid, and the painter that lays one tissue over another.

use glam::Vec3;

use super::lanes::{LANES, Lanes, Points};

/// Voxels along the longest side of a subject as it is normally shown.
pub const FINE_RESOLUTION: u32 = 256;
/// Rows in a block.
pub(super) const ROWS: usize = LANES * LANES;

/// What a model is: a box in mm, its segments, and how one block of it is painted. Built once per subject.
pub(super) trait Model: Send + Sync {
    /// The box that is shown, (min, max) mm; x right, y anterior, z superior.
    fn bounds_mm(&self) -> (Vec3, Vec3);
    /// Segments; the label is the index plus one.
    fn segments(&self) -> &'static [SegmentSpec];
    /// Lowest and highest value that can occur.
    fn value_range(&self) -> [f32; 2];
    /// How its borders are laid.
    fn passage(&self) -> Passage {
        Passage::Straight
    }
    /// Fills in values and labels of one block of voxels.
    fn paint(&self, block: &Block, out: &mut Canvas);
}

/// A segment's name and natural colour.
pub(super) struct SegmentSpec {
    /// As used in `keep`.
    pub(super) name: &'static str,
    /// Natural colour: red, green and blue in sRGB, 0 to 255.
    pub(super) color_srgb: [u8; 3],
}

/// A segment of this name and colour; shorter to write in tables.
pub(super) const fn segment(name: &'static str, color_srgb: [u8; 3]) -> SegmentSpec {
    SegmentSpec { name, color_srgb }
}

/// Eight by eight by eight voxels of the grid.
pub(super) struct Block {
    /// Centre of the first voxel, mm.
    pub(super) origin: Vec3,
    /// Distance between voxel centres, mm.
    pub(super) spacing: f32,
}

impl Block {
    /// Middle of the block, mm.
    pub(super) fn center(&self) -> Vec3 {
        self.origin + Vec3::splat(0.5 * (LANES - 1) as f32 * self.spacing)
    }

    /// From the middle to the corner voxel centres, mm.
    pub(super) fn radius(&self) -> f32 {
        0.5 * (LANES - 1) as f32 * self.spacing * 1.732_051
    }

    /// The eight voxel centres of a row, mm.
    #[inline(always)]
    pub(super) fn row(&self, row: usize) -> Points {
        Points {
            x: Lanes::ramp(self.origin.x, self.spacing),
            y: Lanes::splat(self.origin.y + (row % LANES) as f32 * self.spacing),
            z: Lanes::splat(self.origin.z + (row / LANES) as f32 * self.spacing),
        }
    }
}

/// How the value passes from one tissue to the next over the width of a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    /// Along a straight line. The grid of voxels cannot hold its bends: smooth skin shows their layers.
    Straight,
    /// Along the integral of a quadratic B-spline, about as steep in the middle and twice as wide: at the frequency of
    /// the grid it has less than a tenth of the line's spectrum.
    Smooth,
}

impl Passage {
    /// Share of the inner tissue, 0 to 1, at a signed distance (negative inside) from a border of a width, both mm.
    #[inline(always)]
    fn cover(self, distance: Lanes, width: f32) -> Lanes {
        match self {
            Self::Straight => (Lanes::splat(0.5) - distance * (1.0 / width)).clamp(0.0, 1.0),
            Self::Smooth => {
                // In intervals of the spline, from the inner end of its three.
                let t = (distance * (1.5 / width) + 1.5).clamp(0.0, 3.0);
                let cube = |end: f32| {
                    let left = (Lanes::splat(end) - t).max(Lanes::splat(0.0));
                    left * left * left
                };
                (cube(3.0) - cube(2.0) * 3.0 + cube(1.0) * 3.0) * (1.0 / 6.0)
            }
        }
    }
}

/// Values and labels of one block.
pub(super) struct Canvas {
    /// Values of each row.
    pub(super) values: [Lanes; ROWS],
    /// Labels of each row.
    pub(super) labels: [[u8; LANES]; ROWS],
    passage: Passage,
}

impl Canvas {
    /// All of one value and without a segment. Borders are laid by this passage.
    pub(super) fn new(value: f32, passage: Passage) -> Self {
        Self {
            values: [Lanes::splat(value); ROWS],
            labels: [[0; LANES]; ROWS],
            passage,
        }
    }

    /// Gives voxels that have no segment yet one where `distance` (mm) is negative, and leaves their values.
    pub(super) fn claim(&mut self, row: usize, distance: Lanes, label: u8) {
        for (i, mine) in self.labels[row].iter_mut().enumerate() {
            if *mine == 0 && distance[i] < 0.0 {
                *mine = label;
            }
        }
    }

    /// Gives voxels another segment where `distance` (mm) is negative, and leaves their values.
    pub(super) fn relabel(&mut self, row: usize, distance: Lanes, label: u8) {
        for (i, mine) in self.labels[row].iter_mut().enumerate() {
            if distance[i] < 0.0 {
                *mine = label;
            }
        }
    }

    /// Changes the values where `distance` (mm) is negative, over `width` mm around its border, and leaves the
    /// segments.
    #[inline(always)]
    pub(super) fn tone(&mut self, row: usize, distance: Lanes, width: f32, value: f32) {
        let cover = self.passage.cover(distance, width);
        self.values[row] = self.values[row].mix(Lanes::splat(value), cover);
    }

    /// Lays a tissue over what a row shows, where `distance` (mm, negative inside) says so. The label changes at 0, the
    /// value over `width` mm around it: a voxel that the border crosses holds some of both, as in a scan.
    #[inline(always)]
    pub(super) fn lay(&mut self, row: usize, distance: Lanes, width: f32, value: Lanes, label: u8) {
        let cover = self.passage.cover(distance, width);
        self.values[row] = self.values[row].mix(value, cover);
        self.relabel(row, distance, label);
    }
}

/// Over how many mm a border is smoothed at a voxel spacing: wide enough that a gradient taken between neighbours is
/// smooth.
pub(super) fn border_width(spacing: f32) -> f32 {
    2.6 * spacing
}

/// Which revision of a subject is painted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Revision {
    /// Cords and vessels are as thin as the model has them: of a chain of voxels some may be lost.
    First,
    /// They are as thick as it takes for the voxels of each tube to hang together on the grid that is normally shown,
    /// and borders are smooth.
    Second,
}

impl Revision {
    /// How borders are laid.
    pub(super) fn passage(self) -> Passage {
        match self {
            Self::First => Passage::Straight,
            Self::Second => Passage::Smooth,
        }
    }

    /// Least radius of a tube, mm, in a block of a model with this box.
    pub(super) fn least_mm(self, block: &Block, (min, max): (Vec3, Vec3)) -> f32 {
        match self {
            Self::First => 0.0,
            // The centre of a voxel is never farther from a point in it: so the voxels along an axis share faces.
            Self::Second => {
                let shown = (max - min).max_element() / FINE_RESOLUTION as f32;
                0.87 * block.spacing.min(shown)
            }
        }
    }
}
