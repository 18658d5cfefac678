//! Layer 3: files in, subjects out. Bytes come through a [`FileSet`], pieces of the subject leave through a
//! [`SubjectSink`](crate::data::SubjectSink), voxels slab by slab, so nothing is held twice; what had to be decided or
//! repaired stands in a [`LoadReport`].
//!
//! Meshes come through the same [`FileSet`] and leave whole, as a [`Mesh`](crate::data::Mesh), by [`read_mesh`]:
//! nothing of them can be shown before all corners are welded. Readers of scans know them by sight only.
//!
//! Nothing here knows paths, threads or browsers: the native program opens files, a browser's worker reads slices of a
//! dropped file, tests give bytes. Memory follows the bytes that really come, never what a header promises.
//!
//! ```
//! use fabrica::{data::VolumeBuilder, load};
//! # let mut file = vec![0u8; 352];
//! # file[..4].copy_from_slice(&348i32.to_le_bytes());
//! # for (i, n) in [3i16, 2, 2, 1].iter().enumerate() {
//! #     file[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes());
//! # }
//! # file[70..72].copy_from_slice(&2i16.to_le_bytes());
//! # for i in 0..4 { file[76 + 4 * i..80 + 4 * i].copy_from_slice(&1f32.to_le_bytes()); }
//! # file[344..348].copy_from_slice(b"n+1\0");
//! # file.extend([0, 1, 2, 3]);
//! let mut files = load::MemoryFiles::new([("scan.nii", file)]);
//! let (mut volume, mut report) = (VolumeBuilder::new(), load::LoadReport::default());
//! load::read_volume(&mut files, "scan.nii", &load::ReadOptions::default(), &mut volume, &mut report)?;
//! let volume = volume.finish()?;
//! assert_eq!(volume.value_range, [0.0, 3.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod describe;
mod dicom;
mod dicom_codecs;
mod dicom_data;
mod dicom_pixels;
mod dicom_series;
mod error;
mod fault;
mod field;
mod files;
mod geometry;
mod header;
mod labels;
mod mesh;
mod metaimage;
mod nifti;
mod nodes;
mod nrrd;
mod options;
mod place;
mod raw;
mod read;
mod report;
mod sniff;
mod stream;
mod subject;
mod voxels;

pub use describe::{Description, describe, describe_raw, short, times};
pub use dicom::{is_segmentation, main_name};
pub use error::{FaultKind, LoadError};
pub use fault::FileFault;
pub use field::{FieldFile, FieldUse, is_field, read_field};
pub use files::{ALL_FILES, FileHandle, FileSet, MemoryFiles, OneFile};
pub use geometry::orientation_code;
pub use labels::{LabelFile, read_header, read_label_file, read_labels};
pub use mesh::{
    Aside, Axes, MAX_TRIANGLES, MeshDescription, MeshError, MeshFile, MeshFormat, MeshOptions,
    MeshOrNot, MeshReport, Origin, PartsMode, Progress, ReadMeshes, Repair, Units, are_mesh_names,
    cubic, describe_mesh, is_mesh_name, mesh_among, mesh_or_not, names_beside, read_mesh,
    read_mesh_subject, read_meshes,
};

pub use options::ReadOptions;
pub use raw::{RawLayout, read_raw};
pub use read::read_volume;
pub use report::{Format, LoadReport, Warning};
pub use subject::{LabelSource, read_subject};
pub use voxels::ElementType;
