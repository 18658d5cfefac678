//! Layer 3: the built-in subjects. Nothing is downloaded: each is a model in mm, painted voxel by voxel.
//!
//! The labels, and the values, are the same bit for bit on every machine: only arithmetic that IEEE 754 rounds exactly
//! is used, sines come from `libm`, and nothing depends on the order of a hash or on the number of threads.
//!
//! A subject that is improved keeps its older revisions, which documents name: what a link shows stays. What differs
//! between them is a choice of the model ([`Generator::of_revision`]); the newest is what new documents show.
//!
//! A small `resolution` gives the coarse picture that a page shows first, a large one the same model finely.
//!
//! ```
//! use fabrica::data::{SubjectPart, SubjectSink};
//! struct Count(usize);
//! impl SubjectSink for Count {
//!     fn take(&mut self, part: SubjectPart) -> Result<(), String> {
//!         match part {
//!             SubjectPart::Volume(header) => assert_eq!(header.grid.dims.max_element(), 32),
//!             SubjectPart::Scalars(next) => self.0 += next.len(),
//!             _ => {}
//!         }
//!         Ok(())
//!     }
//!     fn progress(&mut self, _: f32) -> bool {
//!         true
//!     }
//! }
//! let mut count = Count(0);
//! fabrica::subjects::generate("cube", 32, &mut count).unwrap();
//! assert_eq!(count.0, 32 * 32 * 32);
//! ```

mod apple;
mod bar;
mod cube;
mod hand;
mod hand_cords;
mod hand_plan;
mod head;
mod head_brain;
mod head_skin;
mod head_skull;
mod head_soft;
mod knee;
mod lanes;
mod limb;
mod loft;
mod paint;
mod piggybank;
mod profile;
mod random;
mod shape;
mod tomato;
mod tools;
mod torso;
mod torso_belly;
mod torso_chest;
mod torso_frame;
mod torso_lungs;
mod torso_wall;

use std::ops::Range;

use glam::{DAffine3, DMat3, DVec3, UVec3, Vec3};

use crate::data::{Grid, Mesh, Segment, Segmentation, SubjectPart, SubjectSink, Volume, Voxels};
use lanes::LANES;
use paint::{Block, Canvas, Model, ROWS, Revision};

pub use paint::FINE_RESOLUTION;
pub use tools::tool;

/// Voxels along the longest side of a subject for the picture that is shown first.
pub const COARSE_RESOLUTION: u32 = 64;
/// Fewest voxels along the longest side that are made.
pub const MIN_RESOLUTION: u32 = 16;
/// Most voxels along the longest side that are made.
pub const MAX_RESOLUTION: u32 = 512;

/// Why a subject was not made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubjectError {
    /// No subject has this name.
    #[error("there is no built-in subject \"{0}\" (there are {list})", list = all_names().collect::<Vec<_>>().join(", "))]
    UnknownName(String),
    /// Too small to show anything, or too large to be made.
    #[error(
        "a built-in subject has from {MIN_RESOLUTION} to {MAX_RESOLUTION} voxels along its longest side, not {0}"
    )]
    Resolution(u32),
    /// The receiver refused the volume.
    #[error("{0}")]
    Refused(String),
    /// The receiver asked to stop.
    #[error("stopped")]
    Stopped,
}

/// Names of all built-in subjects, as written in documents.
pub fn all_names() -> impl Iterator<Item = &'static str> {
    names().iter().chain(mesh_names()).copied()
}

/// Names of the built-in subjects that are meshes.
pub fn mesh_names() -> &'static [&'static str] {
    &["apple"]
}

/// A built-in subject that is a mesh, mm: the same vertices bit for bit on every machine. `None` for a name that means
/// none.
pub fn mesh(name: &str) -> Option<Mesh> {
    (name == "apple").then(apple::apple)
}

/// Names of the built-in subjects that are made of voxels, as written in documents.
pub fn names() -> &'static [&'static str] {
    &[
        "bar",
        "cube",
        "tomato",
        "piggybank",
        "head",
        "hand",
        "torso",
        "knee",
    ]
}

/// The model of a revision; the newest stands in for one that is not there yet.
fn model(name: &str, revision: u32) -> Option<Box<dyn Model>> {
    let revision = match revision {
        0 | 1 => Revision::First,
        _ => Revision::Second,
    };
    Some(match name {
        "bar" => Box::new(bar::Bar),
        "cube" => Box::new(cube::Cube),
        "tomato" => Box::new(tomato::Tomato::new()),
        "piggybank" => Box::new(piggybank::Piggybank::new()),
        "hand" => Box::new(hand::Hand::new(revision)),
        "knee" => Box::new(knee::Knee::new(revision)),
        "torso" => Box::new(torso::Torso::new(revision)),
        "head" => Box::new(head::Head::new(revision)),
        _ => return None,
    })
}

/// Some whole z slices of a subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slab {
    /// Values of the voxels, x fastest, Hounsfield units.
    pub values: Vec<i16>,
    /// Labels, in the same order.
    pub labels: Vec<u8>,
}

impl Slab {
    /// The slab as pieces of its subject.
    pub fn into_parts(self) -> [SubjectPart; 2] {
        let scalars = SubjectPart::Scalars(Voxels::I16(self.values));
        [scalars, SubjectPart::Labels(self.labels)]
    }
}

/// Makes a subject in slabs, in any order and from as many threads as the caller likes: the result does not depend on
/// it.
pub struct Generator {
    model: Box<dyn Model>,
    dims: UVec3,
    spacing: f32,
    /// Centre of the first voxel, mm.
    origin: Vec3,
}

impl Generator {
    /// Slices that are made together; a slab that starts and ends at a multiple of it costs least.
    pub const SLAB: u32 = LANES as u32;

    /// Prepares the first revision of a subject, `resolution` voxels along its longest side.
    ///
    /// # Errors
    /// As [`Generator::of_revision`].
    pub fn new(name: &str, resolution: u32) -> Result<Self, SubjectError> {
        Self::of_revision(name, 1, resolution)
    }

    /// Prepares a revision of a subject, `resolution` voxels along its longest side. The newest stands in for one that
    /// is not there yet.
    ///
    /// # Errors
    /// [`SubjectError::UnknownName`], [`SubjectError::Resolution`].
    pub fn of_revision(name: &str, revision: u32, resolution: u32) -> Result<Self, SubjectError> {
        check_resolution(resolution)?;
        let model = model(name, revision).ok_or_else(|| {
            // A hostile name is not repeated at length.
            SubjectError::UnknownName(name.chars().take(40).collect())
        })?;
        Ok(Self::of(model, resolution))
    }

    fn of(model: Box<dyn Model>, resolution: u32) -> Self {
        let (min, max) = model.bounds_mm();
        let size = max - min;
        let spacing = size.max_element() / resolution as f32;
        let dims = (size / spacing).round().as_uvec3().max(UVec3::ONE);
        // The grid is laid about the middle of the box, for its sides are no exact multiples of the spacing.
        let origin = (min + max) * 0.5 - (dims - UVec3::ONE).as_vec3() * (0.5 * spacing);
        Self {
            model,
            dims,
            spacing,
            origin,
        }
    }

    /// The volume without its voxels and labels. The values are CT-like numbers (HU).
    pub fn header(&self) -> Volume {
        let grid = Grid {
            dims: self.dims,
            world_from_voxel: DAffine3::from_mat3_translation(
                DMat3::from_diagonal(DVec3::splat(f64::from(self.spacing))),
                self.origin.as_dvec3(),
            ),
        };
        Volume {
            grid,
            voxels: Voxels::I16(Vec::new()),
            slope: 1.0,
            intercept: 0.0,
            value_range: self.model.value_range(),
            has_size: true,
            segmentation: Some(Segmentation {
                grid,
                labels: Vec::new(),
                segments: self
                    .model
                    .segments()
                    .iter()
                    .enumerate()
                    .map(|(index, spec)| Segment {
                        label: index as u16 + 1,
                        name: spec.name.to_owned(),
                        color_srgb: Some(spec.color_srgb),
                    })
                    .collect(),
            }),
        }
    }

    /// Slices of the whole volume.
    pub fn slice_count(&self) -> u32 {
        self.dims.z
    }

    /// Makes slices; those outside the volume are left out.
    pub fn slab(&self, slices: Range<u32>) -> Slab {
        let end = slices.end.min(self.dims.z);
        let start = slices.start.min(end);
        let (nx, ny) = (self.dims.x as usize, self.dims.y as usize);
        let count = nx * ny * (end - start) as usize;
        let [lowest, highest] = self.model.value_range();
        let mut slab = Slab {
            values: vec![0; count],
            labels: vec![0; count],
        };
        let mut z0 = start - start % Self::SLAB;
        while z0 < end {
            for y0 in (0..ny).step_by(LANES) {
                for x0 in (0..nx).step_by(LANES) {
                    let first = UVec3::new(x0 as u32, y0 as u32, z0).as_vec3();
                    let block = Block {
                        origin: self.origin + first * self.spacing,
                        spacing: self.spacing,
                    };
                    let mut canvas = Canvas::new(lowest, self.model.passage());
                    self.model.paint(&block, &mut canvas);
                    for row in 0..ROWS {
                        let y = y0 + row % LANES;
                        let z = z0 + (row / LANES) as u32;
                        if y >= ny || z < start || z >= end {
                            continue;
                        }
                        let at = x0 + nx * (y + ny * (z - start) as usize);
                        let n = LANES.min(nx - x0);
                        for i in 0..n {
                            let value = canvas.values[row][i].clamp(lowest, highest);
                            slab.values[at + i] = (value + 0.5).floor() as i16;
                        }
                        slab.labels[at..at + n].copy_from_slice(&canvas.labels[row][..n]);
                    }
                }
            }
            z0 += Self::SLAB;
        }
        slab
    }
}

/// Makes the first revision of a subject, `resolution` voxels along its longest side, and hands it to `sink` slab by
/// slab.
pub fn generate(
    name: &str,
    resolution: u32,
    sink: &mut dyn SubjectSink,
) -> Result<(), SubjectError> {
    run(&Generator::new(name, resolution)?, sink)
}

/// Makes the cube alone, as [`generate`] does by name: a program that calls this and not that holds no other subject.
///
/// # Errors
/// As [`generate`].
pub fn generate_cube(resolution: u32, sink: &mut dyn SubjectSink) -> Result<(), SubjectError> {
    check_resolution(resolution)?;
    run(&Generator::of(Box::new(cube::Cube), resolution), sink)
}

fn check_resolution(resolution: u32) -> Result<(), SubjectError> {
    if (MIN_RESOLUTION..=MAX_RESOLUTION).contains(&resolution) {
        Ok(())
    } else {
        Err(SubjectError::Resolution(resolution))
    }
}

fn run(generator: &Generator, sink: &mut dyn SubjectSink) -> Result<(), SubjectError> {
    sink.take(SubjectPart::header(generator.header()))
        .map_err(SubjectError::Refused)?;
    let n = generator.slice_count();
    let mut done = 0;
    while done < n {
        let next = (done + Generator::SLAB).min(n);
        for part in generator.slab(done..next).into_parts() {
            sink.take(part).map_err(SubjectError::Refused)?;
        }
        done = next;
        if !sink.progress(done as f32 / n as f32) {
            return Err(SubjectError::Stopped);
        }
    }
    Ok(())
}
