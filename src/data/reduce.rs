use std::fmt;

use glam::{DAffine3, DVec3, UVec3};

use super::{Grid, SubjectPart, SubjectSink, Volume, Voxels};

/// The most that a device takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VolumeLimits {
    /// Voxels along one axis (the device's largest 3D texture).
    pub max_dim: u32,
    /// Voxels in all, the product of the three axes.
    pub max_voxels: u64,
}

/// By how much a volume was made coarser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduction {
    /// Voxels of the file.
    pub from: UVec3,
    /// Voxels that are kept along each axis.
    pub to: UVec3,
}

impl fmt::Display for Reduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (a, b) = (self.from, self.to);
        let factor = a.as_dvec3() / b.as_dvec3();
        write!(
            f,
            "the volume of {} × {} × {} voxels is too large for this device and was reduced to {} × {} × {} ",
            a.x, a.y, a.z, b.x, b.y, b.z
        )?;
        let round = |x: f64| (x * 100.0).round() / 100.0;
        if factor.max_element() - factor.min_element() < 0.005 {
            write!(f, "({} times coarser)", round(factor.x))
        } else {
            write!(
                f,
                "({} × {} × {} times coarser)",
                round(factor.x),
                round(factor.y),
                round(factor.z)
            )
        }
    }
}

/// Voxels along each axis that fit: the axis with the finest spacing gives way first, so that voxels become more alike
/// before all become coarser.
pub fn dims_that_fit(grid: &Grid, limits: VolumeLimits) -> UVec3 {
    let max_dim = limits.max_dim.max(1);
    let most = grid.dims.min(UVec3::splat(max_dim));
    let count = |dims: UVec3| {
        let dims = dims.as_u64vec3();
        dims.x.saturating_mul(dims.y).saturating_mul(dims.z)
    };
    if count(most) <= limits.max_voxels {
        return most;
    }
    let lengths = grid.dims.as_dvec3() * grid.spacing_mm();
    let dims_at = |spacing: f64| {
        (lengths / spacing)
            .floor()
            .as_uvec3()
            .clamp(UVec3::ONE, most)
    };
    // The finest common spacing that fits, by bisection: 60 halvings are more than a double has digits.
    let (mut too_fine, mut fits) = (0.0, lengths.max_element());
    for _ in 0..60 {
        let middle = 0.5 * (too_fine + fits);
        if count(dims_at(middle)) <= limits.max_voxels {
            fits = middle;
        } else {
            too_fine = middle;
        }
    }
    dims_at(fits)
}

/// A grid with these dims over the box of `grid`, so that both have one subject space.
pub fn resized(grid: &Grid, dims: UVec3) -> Grid {
    let factor = grid.dims.as_dvec3() / dims.as_dvec3();
    Grid {
        dims,
        world_from_voxel: grid.world_from_voxel
            * DAffine3::from_translation(factor * 0.5 - DVec3::splat(0.5))
            * DAffine3::from_scale(factor),
    }
}

/// A sink in front of another sink that makes a volume coarser if it is too large, and passes on what else comes. It
/// holds one coarse slice and never the full volume. Scalars become the mean over the box that a coarse voxel covers
/// (of fractional size, edges weighted), labels become the one with the largest share in that box.
pub struct Reducer<'a> {
    inner: &'a mut dyn SubjectSink,
    limits: VolumeLimits,
    scalars: Option<MeanAxes>,
    labels: Option<LabelAxes>,
    reduction: Option<Reduction>,
}

impl fmt::Debug for Reducer<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reducer")
            .field("limits", &self.limits)
            .field("reduction", &self.reduction)
            .finish_non_exhaustive()
    }
}

impl<'a> Reducer<'a> {
    /// A reducer in front of `inner`; a volume within `limits` passes unchanged.
    pub fn new(inner: &'a mut dyn SubjectSink, limits: VolumeLimits) -> Self {
        Self {
            inner,
            limits,
            scalars: None,
            labels: None,
            reduction: None,
        }
    }

    /// The reduction of the scalars, known once the header has arrived; `None` if they fit. Its text is a notice.
    pub fn reduction(&self) -> Option<Reduction> {
        self.reduction
    }
}

/// The fine indices that one coarse index covers along an axis, with the weight of each (they sum to the factor).
struct Axis {
    /// Per fine index: the coarse index in which it begins, and its share of that; the rest belongs to the next coarse
    /// index.
    shares: Vec<(u32, f32)>,
    factor: f64,
}

impl Axis {
    fn new(fine: u32, coarse: u32) -> Self {
        let factor = f64::from(fine) / f64::from(coarse);
        let shares = (0..fine)
            .map(|i| {
                let at = ((f64::from(i) / factor) + 1e-9)
                    .floor()
                    .min(f64::from(coarse - 1));
                let end = (at + 1.0) * factor;
                let share = (end - f64::from(i)).clamp(0.0, 1.0);
                let share = if at as u32 == coarse - 1 || share > 1.0 - 1e-6 {
                    1.0
                } else {
                    share
                };
                (at as u32, share as f32)
            })
            .collect();
        Self { shares, factor }
    }
}

struct MeanAxes {
    fine: UVec3,
    coarse: UVec3,
    x: Axis,
    y: Axis,
    z: Axis,
    /// Fine slices that have come.
    slice: usize,
    row: Vec<f32>,
    plane: Vec<f32>,
    sum: Vec<f32>,
}

impl MeanAxes {
    fn new(fine: UVec3, coarse: UVec3) -> Self {
        let n = coarse.x as usize * coarse.y as usize;
        Self {
            fine,
            coarse,
            x: Axis::new(fine.x, coarse.x),
            y: Axis::new(fine.y, coarse.y),
            z: Axis::new(fine.z, coarse.z),
            slice: 0,
            row: vec![0.0; coarse.x as usize],
            plane: vec![0.0; n],
            sum: vec![0.0; n],
        }
    }

    /// Sums one fine slice into `plane`.
    fn flatten<T: Copy>(&mut self, slice: &[T], to_float: impl Fn(T) -> f32) {
        let (fine_x, coarse_x) = (self.fine.x as usize, self.coarse.x as usize);
        self.plane.fill(0.0);
        for (fine_row, &(y, share)) in slice.chunks_exact(fine_x).zip(&self.y.shares) {
            self.row.fill(0.0);
            for (&value, &(x, share)) in fine_row.iter().zip(&self.x.shares) {
                let value = to_float(value);
                let x = x as usize;
                self.row[x] += value * share;
                if share < 1.0 {
                    self.row[x + 1] += value * (1.0 - share);
                }
            }
            let start = y as usize * coarse_x;
            for (sum, &value) in self.plane[start..].iter_mut().zip(&self.row) {
                *sum += value * share;
            }
            if share < 1.0 {
                for (sum, &value) in self.plane[start + coarse_x..].iter_mut().zip(&self.row) {
                    *sum += value * (1.0 - share);
                }
            }
        }
    }

    /// Takes fine slices, gives the coarse ones that are complete.
    fn push<T: Copy>(
        &mut self,
        voxels: &[T],
        to_float: impl Fn(T) -> f32,
        from_float: impl Fn(f32) -> T,
    ) -> Vec<T> {
        let mut done = Vec::new();
        let per_voxel = (1.0 / (self.x.factor * self.y.factor * self.z.factor)) as f32;
        for slice in voxels.chunks_exact(self.fine.x as usize * self.fine.y as usize) {
            let Some(&(z, share)) = self.z.shares.get(self.slice) else {
                break;
            };
            self.flatten(slice, &to_float);
            for (sum, &value) in self.sum.iter_mut().zip(&self.plane) {
                *sum += value * share;
            }
            self.slice += 1;
            let is_complete = self
                .z
                .shares
                .get(self.slice)
                .is_none_or(|&(next, _)| next != z);
            if is_complete {
                done.extend(self.sum.iter().map(|&sum| from_float(sum * per_voxel)));
                for (sum, &value) in self.sum.iter_mut().zip(&self.plane) {
                    *sum = value * (1.0 - share);
                }
            }
        }
        done
    }

    /// Takes fine slices of voxels, gives the coarse ones that are complete, of the same type.
    fn push_voxels(&mut self, fine: Voxels) -> Voxels {
        // A mean lies between the values that it is taken of, so that rounding stays in the type.
        match fine {
            Voxels::U8(v) => Voxels::U8(self.push(&v, f32::from, |x| x.round() as u8)),
            Voxels::I16(v) => Voxels::I16(self.push(&v, f32::from, |x| x.round() as i16)),
            Voxels::U16(v) => Voxels::U16(self.push(&v, f32::from, |x| x.round() as u16)),
            Voxels::F32(v) => Voxels::F32(self.push(&v, |x| x, |x| x)),
        }
    }
}

/// Labels that compete for one coarse voxel; more than four in one box are rare, and the fifth is left out.
type Shares = [(u8, f32); 4];

struct LabelAxes {
    fine: UVec3,
    coarse: UVec3,
    x: Axis,
    y: Axis,
    z: Axis,
    slice: usize,
    /// Labels of a slice that is not whole yet.
    pending: Vec<u8>,
    shares: Vec<Shares>,
    next_shares: Vec<Shares>,
}

fn add_share(shares: &mut Shares, label: u8, weight: f32) {
    for entry in shares.iter_mut() {
        if entry.1 == 0.0 {
            *entry = (label, weight);
            return;
        }
        if entry.0 == label {
            entry.1 += weight;
            return;
        }
    }
}

/// The label with the largest share; of equal ones, one that is something rather than nothing.
fn largest(shares: &Shares) -> u8 {
    let mut best = shares[0];
    for &(label, weight) in &shares[1..] {
        if weight > best.1 + 1e-4 || (weight > best.1 - 1e-4 && weight > 0.0 && best.0 == 0) {
            best = (label, weight);
        }
    }
    best.0
}

impl LabelAxes {
    fn new(fine: UVec3, coarse: UVec3) -> Self {
        let n = coarse.x as usize * coarse.y as usize;
        Self {
            fine,
            coarse,
            x: Axis::new(fine.x, coarse.x),
            y: Axis::new(fine.y, coarse.y),
            z: Axis::new(fine.z, coarse.z),
            slice: 0,
            pending: Vec::new(),
            shares: vec![Shares::default(); n],
            next_shares: vec![Shares::default(); n],
        }
    }

    fn push(&mut self, labels: &[u8]) -> Vec<u8> {
        let slice_len = self.fine.x as usize * self.fine.y as usize;
        self.pending.extend_from_slice(labels);
        let pending = std::mem::take(&mut self.pending);
        let mut done = Vec::new();
        let slices = pending.chunks_exact(slice_len);
        self.pending = slices.remainder().to_vec();
        for slice in slices {
            let Some(&(z, share)) = self.z.shares.get(self.slice) else {
                break;
            };
            let coarse_x = self.coarse.x as usize;
            for (row, &(y, y_share)) in slice.chunks_exact(self.fine.x as usize).zip(&self.y.shares)
            {
                for (&label, &(x, x_share)) in row.iter().zip(&self.x.shares) {
                    let start = y as usize * coarse_x + x as usize;
                    let corners = [
                        (start, x_share * y_share),
                        (start + 1, (1.0 - x_share) * y_share),
                        (start + coarse_x, x_share * (1.0 - y_share)),
                        (start + coarse_x + 1, (1.0 - x_share) * (1.0 - y_share)),
                    ];
                    for (at, weight) in corners {
                        if weight > 0.0 {
                            add_share(&mut self.shares[at], label, weight * share);
                            if share < 1.0 {
                                add_share(&mut self.next_shares[at], label, weight * (1.0 - share));
                            }
                        }
                    }
                }
            }
            self.slice += 1;
            if self
                .z
                .shares
                .get(self.slice)
                .is_none_or(|&(next, _)| next != z)
            {
                done.extend(self.shares.iter().map(largest));
                std::mem::swap(&mut self.shares, &mut self.next_shares);
                self.next_shares.fill(Shares::default());
            }
        }
        done
    }
}

impl Reducer<'_> {
    /// The header of the volume as it leaves here.
    fn begin(&mut self, mut header: Box<Volume>) -> Box<Volume> {
        (self.scalars, self.labels, self.reduction) = (None, None, None);
        let (from, to) = (header.grid.dims, dims_that_fit(&header.grid, self.limits));
        if from != to {
            self.scalars = Some(MeanAxes::new(from, to));
            self.reduction = Some(Reduction { from, to });
            header.grid = resized(&header.grid, to);
        }
        if let Some(labels) = &mut header.segmentation {
            let (from, to) = (labels.grid.dims, dims_that_fit(&labels.grid, self.limits));
            if from != to {
                self.labels = Some(LabelAxes::new(from, to));
                labels.grid = resized(&labels.grid, to);
            }
        }
        header
    }
}

impl SubjectSink for Reducer<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        let part = match part {
            SubjectPart::Volume(header) => SubjectPart::Volume(self.begin(header)),
            SubjectPart::Scalars(fine) if let Some(axes) = &mut self.scalars => {
                let coarse = axes.push_voxels(fine);
                if coarse.is_empty() {
                    return Ok(());
                }
                SubjectPart::Scalars(coarse)
            }
            SubjectPart::Labels(fine) if let Some(axes) = &mut self.labels => {
                let coarse = axes.push(&fine);
                if coarse.is_empty() {
                    return Ok(());
                }
                SubjectPart::Labels(coarse)
            }
            // What fits, and what has no voxels.
            other => other,
        };
        self.inner.take(part)
    }

    fn progress(&mut self, fraction: f32) -> bool {
        self.inner.progress(fraction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Segmentation, VolumeBuilder};

    fn header(dims: UVec3, spacing: DVec3, voxels: Voxels) -> Volume {
        Volume {
            has_size: true,
            grid: Grid {
                dims,
                world_from_voxel: DAffine3::from_translation(DVec3::new(10.0, -3.0, 7.0))
                    * DAffine3::from_rotation_x(0.3)
                    * DAffine3::from_scale(spacing),
            },
            voxels,
            slope: 1.0,
            intercept: 0.0,
            value_range: [0.0, 0.0],
            segmentation: None,
        }
    }

    const LIMITS: VolumeLimits = VolumeLimits {
        max_dim: 8,
        max_voxels: 1 << 20,
    };

    #[test]
    fn subject_space_stays_and_a_ramp_stays_a_ramp() {
        let dims = UVec3::new(11, 20, 13);
        let volume = header(dims, DVec3::new(1.0, 0.5, 2.0), Voxels::F32(Vec::new()));
        let mut builder = VolumeBuilder::new();
        let mut reducer = Reducer::new(&mut builder, LIMITS);
        let header = SubjectPart::header(volume.clone());
        reducer.take(header).expect("it fits");
        let value = |x: f64, y: f64, z: f64| 3.0 * x - 2.0 * y + 0.5 * z;
        for z in 0..dims.z {
            let mut slice = Vec::new();
            for y in 0..dims.y {
                for x in 0..dims.x {
                    slice.push(value(x.into(), y.into(), z.into()) as f32);
                }
            }
            let scalars = SubjectPart::Scalars(Voxels::F32(slice));
            reducer.take(scalars).expect("they fit");
        }
        let reduction = reducer.reduction().expect("reduced");
        assert_eq!(reduction.to, UVec3::new(8, 8, 8));
        assert!(reduction.to_string().contains("11 × 20 × 13"));
        let reduced = builder.finish().expect("all came");
        assert!(
            (reduced.grid.mm_per_unit() - volume.grid.mm_per_unit()).abs() < 1e-9,
            "the box stays"
        );
        let fine_from_coarse =
            volume.grid.subject_from_voxel().inverse() * reduced.grid.subject_from_voxel();
        for z in 0..8 {
            for y in 0..8 {
                for x in 0..8 {
                    let coarse = UVec3::new(x, y, z);
                    let fine = fine_from_coarse.transform_point3(coarse.as_dvec3());
                    // The mean of a piecewise constant ramp over a fractional box is off by at most an eighth of a
                    // voxel per axis.
                    let found = f64::from(reduced.value_at(coarse).expect("inside"));
                    let expected = value(fine.x, fine.y, fine.z);
                    assert!(
                        (found - expected).abs() < 5.5 / 8.0,
                        "{coarse}: {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn whole_factors_give_exact_means() {
        let volume = header(UVec3::new(16, 16, 16), DVec3::ONE, Voxels::I16(Vec::new()));
        let mut builder = VolumeBuilder::new();
        let mut reducer = Reducer::new(&mut builder, LIMITS);
        reducer.take(SubjectPart::header(volume)).expect("it fits");
        // Slabs of different sizes.
        for slices in [1, 3, 7, 5] {
            let values = (0..slices * 256).map(|i| if i % 2 == 0 { -1000 } else { 3000 });
            let scalars = SubjectPart::Scalars(Voxels::I16(values.collect()));
            reducer.take(scalars).expect("they fit");
        }
        let reduced = builder.finish().expect("all came");
        assert_eq!(reduced.voxels, Voxels::I16(vec![1000; 512]));
    }

    #[test]
    fn labels_take_the_majority_and_sizes_fit() {
        let mut volume = header(UVec3::splat(4), DVec3::ONE, Voxels::U8(Vec::new()));
        volume.segmentation = Some(Segmentation {
            grid: volume.grid,
            labels: Vec::new(),
            segments: Vec::new(),
        });
        let mut builder = VolumeBuilder::new();
        let mut reducer = Reducer::new(
            &mut builder,
            VolumeLimits {
                max_dim: 2,
                max_voxels: 8,
            },
        );
        reducer.take(SubjectPart::header(volume)).expect("it fits");
        let scalars = SubjectPart::Scalars(Voxels::U8(vec![7; 64]));
        reducer.take(scalars).expect("they fit");
        let labels: Vec<u8> = (0..64)
            .map(|i| {
                if i % 4 < 2 {
                    5
                } else {
                    u8::from(i % 4 == 3) * 9
                }
            })
            .collect();
        for part in labels.chunks(7) {
            let labels = SubjectPart::Labels(part.to_vec());
            reducer.take(labels).expect("they fit");
        }
        let reduced = builder.finish().expect("all came");
        // Of equal shares 0 and 9, the one that is something.
        assert_eq!(
            reduced.segmentation.expect("labels").labels,
            [5, 9, 5, 9, 5, 9, 5, 9]
        );
    }

    #[test]
    fn limits_are_kept_and_fine_axes_give_way_first() {
        let grid = header(
            UVec3::new(512, 512, 60),
            DVec3::new(0.5, 0.5, 3.0),
            Voxels::U8(Vec::new()),
        )
        .grid;
        for max_voxels in [1, 100, 1_000_000, 10_000_000, 1 << 40] {
            let limits = VolumeLimits {
                max_dim: 2048,
                max_voxels,
            };
            let dims = dims_that_fit(&grid, limits);
            assert!(dims.as_u64vec3().element_product() <= max_voxels, "{dims}");
        }
        let limits = VolumeLimits {
            max_dim: 2048,
            max_voxels: 6_000_000,
        };
        assert_eq!(dims_that_fit(&grid, limits).z, 60);
    }
}
