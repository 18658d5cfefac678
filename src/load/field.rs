//! Displacement fields: vectors on a grid (NRRD, NIfTI, MetaImage) or at scattered nodes (CSV), made into the samples
//! of a `field`.
//!
//! A field maps output to input, as ITK's warps do: at a place of the deformed object stands the way to where its
//! material was. Its vectors are in the file's own directions: in an NRRD those of its `space`, in a NIfTI and a
//! MetaImage left, posterior, superior (ITK writes them so), but right, anterior, superior in a NIfTI of the intent
//! "displacement vectors" (1006). The `axes` of the template overrule that.

use glam::{DAffine3, DMat3, DQuat, DVec3, UVec3};
use half::f16;

use super::{
    FileSet, LoadError, LoadReport, ReadOptions, Warning, nodes, read_header, read_volume,
};
use crate::data::{Grid, Reducer, SampledField, VolumeBuilder, VolumeLimits};
use crate::math::Placement;

/// Samples along an axis at most; finer fields are averaged. 16 MiB on the device.
const MAX_SIDE: u32 = 128;
/// Samples of a file that are read at all, times its components.
const MAX_SAMPLES: u64 = 1 << 28;
/// Axes further from square than this are no box.
const MAX_SKEW: f64 = 2e-3;
/// Largest displacement, in sides of the box; a larger one is taken for a mistake of units.
const MAX_BOXES: f64 = 50.0;

/// A displacement field as it stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldFile {
    /// Where the samples lie: of nodes in subject units it is in subject space, else in mm, RAS+.
    pub grid: Grid,
    /// Vectors and continuity (1 where the file has none), x fastest.
    pub samples: Vec<[f32; 4]>,
    /// What takes the file's vectors to RAS+.
    pub signs: DVec3,
    /// From a table of nodes, which lie in the same unit as their displacements.
    pub is_nodes: bool,
    /// SHA-256 of the file, lower-case hex.
    pub sha256: String,
    /// What the user should know.
    pub notices: Vec<String>,
}

/// How a template reads its file, and the subject that the field is laid over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldUse<'a> {
    /// The vectors are in subject units and not in millimetres.
    pub is_subject_units: bool,
    /// Directions of the vectors: `Some(true)` left, posterior, superior; `Some(false)` right, anterior, superior.
    pub is_lps: Option<bool>,
    /// Grid of the subject.
    pub subject: &'a Grid,
}

/// True for the header of a file of vectors and for the name of a table of nodes: a displacement field, not a scan.
pub fn is_field(files: &mut dyn FileSet, name: &str) -> bool {
    nodes::has_ending(name)
        || read_header(files, name, &ReadOptions::default())
            .is_ok_and(|(_, report)| report.is_vectors)
}

/// Reads a displacement field.
///
/// # Errors
/// As [`read_volume`]; [`LoadError::NotField`] for another number of components than 3 or 4, and for samples that are
/// no numbers.
pub fn read_field(files: &mut dyn FileSet, name: &str) -> Result<FieldFile, LoadError> {
    let refuse = |what: String| LoadError::NotField {
        name: name.to_owned(),
        what,
    };
    if nodes::has_ending(name) {
        let table = nodes::read(files, name)?;
        return Ok(FieldFile {
            grid: table.grid,
            samples: table.samples,
            signs: DVec3::ONE,
            is_nodes: true,
            sha256: table.sha256,
            notices: table.notices,
        });
    }
    let mut samples: Vec<[f32; 4]> = Vec::new();
    let mut field: Option<FieldFile> = None;
    let mut count = 3;
    for component in 0..4 {
        if component == count {
            break;
        }
        let options = ReadOptions {
            frame: component,
            max_voxels: MAX_SAMPLES,
        };
        let mut report = LoadReport::default();
        let mut builder = VolumeBuilder::new();
        let limits = VolumeLimits {
            max_dim: MAX_SIDE,
            max_voxels: u64::from(MAX_SIDE).pow(3),
        };
        let mut reducer = Reducer::new(&mut builder, limits);
        let result = read_volume(files, name, &options, &mut reducer, &mut report);
        let reduction = reducer.reduction();
        if component == 0 && report.frame_count != 0 {
            count = report.frame_count;
            if !(3..=4).contains(&count) {
                return Err(refuse(format!(
                    "it has {count} numbers per sample; a displacement field has 3, or 4 with the continuity"
                )));
            }
        }
        result?;
        let bad = report.warnings.iter().find_map(|warning| match warning {
            Warning::NotFinite { count } => Some(*count),
            _ => None,
        });
        if let Some(bad) = bad {
            return Err(refuse(format!("{bad} of its samples are no numbers")));
        }
        let volume = builder.finish().map_err(|why| refuse(why.to_string()))?;
        if component == 0 {
            let mut notices: Vec<String> = report
                .warnings
                .iter()
                .filter(|w| !matches!(w, Warning::Frames { .. } | Warning::Constant { .. }))
                .map(ToString::to_string)
                .collect();
            if let Some(reduction) = reduction {
                let (from, to) = (reduction.from, reduction.to);
                notices.push(format!("the field is drawn with {to} samples of {from}"));
            }
            samples = vec![[0.0, 0.0, 0.0, 1.0]; volume.grid.voxel_count()];
            field = Some(FieldFile {
                grid: volume.grid,
                samples: Vec::new(),
                signs: DVec3::from_array(report.vector_signs.map(f64::from)),
                is_nodes: false,
                sha256: report.sha256_hex().unwrap_or_default(),
                notices,
            });
        }
        for (i, sample) in samples.iter_mut().enumerate() {
            let stored = volume.voxels.get(i).unwrap_or(0.0);
            sample[component as usize] = stored * volume.slope + volume.intercept;
        }
    }
    let mut field = field.ok_or(LoadError::Cancelled)?;
    field.samples = samples;
    Ok(field)
}

impl FieldFile {
    /// The samples as a template over this subject has them, and what the user should know of that.
    ///
    /// # Errors
    /// In words: a skewed grid, a field that lies beside the subject, displacements that cannot be meant.
    pub fn fit(&self, given: &FieldUse<'_>) -> Result<(SampledField, Vec<String>), String> {
        let subject = given.subject;
        let mm_per_unit = subject.mm_per_unit();
        let subject_from_world = subject.subject_from_voxel() * subject.world_from_voxel.inverse();
        let dims = self.grid.dims;
        let n = dims.as_dvec3();
        // A mirrored grid is read backwards along x: a box is only turned.
        let is_mirrored = self.grid.world_from_voxel.matrix3.determinant() < 0.0;
        let own_from_voxel = match is_mirrored {
            true => {
                let back = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
                self.grid.world_from_voxel
                    * DAffine3::from_mat3_translation(back, DVec3::X * (n.x - 1.0))
            }
            false => self.grid.world_from_voxel,
        };
        let in_subject_units = given.is_subject_units;
        let subject_from_voxel = if self.is_nodes && in_subject_units {
            own_from_voxel
        } else {
            subject_from_world * own_from_voxel
        };
        let m = subject_from_voxel.matrix3;
        let lengths = DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length());
        let axes = DMat3::from_cols(
            m.x_axis / lengths.x,
            m.y_axis / lengths.y,
            m.z_axis / lengths.z,
        );
        let skew = [
            axes.x_axis.dot(axes.y_axis),
            axes.y_axis.dot(axes.z_axis),
            axes.z_axis.dot(axes.x_axis),
        ];
        if skew.iter().any(|cos| cos.abs() > MAX_SKEW) {
            return Err("its grid is skewed: sample it on a grid with right angles".to_owned());
        }
        let rotate = DQuat::from_mat3(&axes).normalize();
        let size = lengths * n;
        let at = subject_from_voxel.transform_point3((n - 1.0) * 0.5);
        let half =
            axes.x_axis.abs() * size.x + axes.y_axis.abs() * size.y + axes.z_axis.abs() * size.z;
        let bounds = subject.subject_bounds();
        let (min, max) = (at - half * 0.5, at + half * 0.5);
        let is_beside =
            min.cmpgt(bounds.max.as_dvec3()).any() || max.cmplt(bounds.min.as_dvec3()).any();
        if is_beside {
            let far = (at * mm_per_unit).round();
            return Err(format!(
                "it lies beside the subject (its middle is {}, {}, {} mm from the subject's): it belongs to another scan",
                far.x, far.y, far.z
            ));
        }
        let signs = match given.is_lps {
            Some(true) => DVec3::new(-1.0, -1.0, 1.0),
            Some(false) => DVec3::ONE,
            None => self.signs,
        };
        let scale = if in_subject_units {
            1.0
        } else {
            1.0 / mm_per_unit
        };
        let back = axes.transpose();
        let mut out = Sampled {
            dims,
            displacements: Vec::with_capacity(self.samples.len()),
        };
        let [nx, ny, nz] = dims.to_array().map(|side| side as usize);
        let mut texels = Vec::with_capacity(4 * self.samples.len());
        let (mut least, mut most, mut longest) = (DVec3::ZERO, DVec3::ZERO, 0.0_f64);
        for row in self.samples.chunks_exact(nx).take(ny * nz) {
            for i in 0..nx {
                let [x, y, z, a] = row[if is_mirrored { nx - 1 - i } else { i }];
                let shift = DVec3::new(x.into(), y.into(), z.into()) * signs * scale;
                let d = back * shift / size;
                longest = longest.max(d.abs().max_element());
                least = least.min(d);
                most = most.max(d);
                let values = [d.x as f32, d.y as f32, d.z as f32, a.clamp(-6e4, 6e4)];
                texels.extend(values.map(|v| f16::from_f32(v).to_bits()));
                out.displacements.push((d, a));
            }
        }
        if !(longest.is_finite() && longest <= MAX_BOXES) {
            return Err(format!(
                "its longest displacement is {longest:.0} times the field itself: the unit is another one"
            ));
        }
        let mut notices = self.notices.clone();
        if longest == 0.0 {
            notices.push("the field displaces nothing".to_owned());
        }
        let (folds, cells) = out.folds();
        if folds > 0 {
            let percent = 100.0 * folds as f64 / cells as f64;
            notices.push(format!(
                "the field folds space over itself in {folds} of {cells} cells ({percent:.2} %): tissue is drawn twice or turned inside out there"
            ));
        }
        let samples = SampledField {
            dims: dims.to_array(),
            texels,
            shift: [least.as_vec3() - 1e-4, most.as_vec3() + 1e-4],
            placement: Placement {
                at: at.as_vec3(),
                rotate: rotate.as_quat(),
                size: size.as_vec3(),
            },
        };
        Ok((samples, notices))
    }
}

/// Displacements (template space) and continuity on their grid.
struct Sampled {
    dims: UVec3,
    displacements: Vec<(DVec3, f32)>,
}

impl Sampled {
    /// Cells of material in which the Jacobian determinant of the map is below 0, and all cells. Gaps fold nothing.
    fn folds(&self) -> (usize, usize) {
        let [nx, ny, nz] = self.dims.to_array().map(|side| side as usize);
        let n = self.dims.as_dvec3();
        let (mut folds, mut cells) = (0, 0);
        for z in 0..nz.saturating_sub(1) {
            for y in 0..ny.saturating_sub(1) {
                for x in 0..nx.saturating_sub(1) {
                    let i = x + nx * (y + ny * z);
                    let corners = [i, i + 1, i + nx, i + nx * ny].map(|k| self.displacements[k]);
                    cells += 1;
                    if corners.iter().any(|(_, a)| *a < 0.0) {
                        continue;
                    }
                    let [d, dx, dy, dz] = corners.map(|(d, _)| d);
                    let jacobian = DMat3::from_cols(
                        DVec3::X + (dx - d) * n.x,
                        DVec3::Y + (dy - d) * n.y,
                        DVec3::Z + (dz - d) * n.z,
                    );
                    folds += usize::from(jacobian.determinant() < 0.0);
                }
            }
        }
        (folds, cells)
    }
}
