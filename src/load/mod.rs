//! Layer 3: files in, volumes out. Bytes come through a [`FileSet`], voxels leave through a
//! [`VolumeSink`] slab by slab, so nothing is held twice; what had to be decided or repaired
//! stands in a [`LoadReport`].
//!
//! Nothing here knows paths, threads or browsers: the native program opens files, a browser's worker reads slices of a
//! dropped file, tests give bytes. Memory follows the bytes that really come, never what a header promises.
//!
//! ```
//! use fabrica::{data::VolumeBuilder, load};
//! # let mut file = vec![0u8; 352];
//! # file[..4].copy_from_slice(&348i32.to_le_bytes());
//! # for (i, n) in [3i16, 2, 2, 1].iter().enumerate() { file[40 + 2 * i..42 + 2 * i].copy_from_slice(&n.to_le_bytes()); }
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
mod dicom_data;
mod dicom_pixels;
mod dicom_series;
mod error;
mod field;
mod files;
mod geometry;
mod header;
mod labels;
mod metaimage;
mod nifti;
mod nodes;
mod nrrd;
mod place;
mod raw;
mod report;
mod stream;
mod voxels;

use std::cell::RefCell;
use std::rc::Rc;

use sha2::{Digest as _, Sha256};

pub use describe::{Description, describe, describe_raw};
pub use dicom::{is_segmentation, main_name};
pub use error::LoadError;
pub use field::{FieldFile, FieldUse, is_field, read_field};
pub use files::{FileHandle, FileSet, MemoryFiles, OneFile};
pub use geometry::orientation_code;
pub use labels::{LabelSource, read_header, read_labels, read_subject};
pub use raw::{RawLayout, read_raw};
pub use report::{Format, LoadReport, Warning};
pub use voxels::ElementType;

use crate::data::VolumeSink;
use files::open;
use place::Source;
use stream::{Packing, SharedHash};

/// Stands for a file's name where all files of a set are meant: a folder of DICOM, or many files dropped together.
pub const ALL_FILES: &str = ".";

/// Bytes looked at to tell what a file is.
const SNIFF_BYTES: usize = 1024;

/// What is wanted of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadOptions {
    /// Which volume of a file that holds several, from 0.
    pub frame: u64,
    /// More voxels are refused before any memory is asked for. The default is 2³³ (a cube of 2,048): beyond it, not even
    /// reduction is quick.
    pub max_voxels: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            frame: 0,
            max_voxels: 1 << 33,
        }
    }
}

/// Reads a volume from the file of this name in `files`, told by its content first, by its name where content says
/// nothing. Streams: the sink has the first voxels long before the last byte was read. The file is read to its end, so
/// that `report` holds the hash of its bytes.
///
/// # Errors
/// [`LoadError`], with name and place. The sink may have begun by then, and what it holds is to be thrown away.
/// [`LoadError::Cancelled`] also comes where a collecting sink failed; it knows why.
pub fn read_volume(
    files: &mut dyn FileSet,
    name: &str,
    options: &ReadOptions,
    sink: &mut dyn VolumeSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let hash: SharedHash = Rc::new(RefCell::new(Sha256::new()));
    let mut reading = Reading {
        files,
        options,
        sink,
        report,
        hash,
    };
    let own = reading.read(name)?;
    let digest = own.unwrap_or_else(|| reading.hash.borrow().clone().finalize().into());
    report.sha256 = Some(digest);
    Ok(())
}

/// What all readers share while one file is read.
struct Reading<'a> {
    files: &'a mut dyn FileSet,
    options: &'a ReadOptions,
    sink: &'a mut dyn VolumeSink,
    report: &'a mut LoadReport,
    hash: SharedHash,
}

impl Reading<'_> {
    /// Reads; returns a hash where it is not that of all bytes in the order read.
    fn read(&mut self, name: &str) -> Result<Option<[u8; 32]>, LoadError> {
        if name == ALL_FILES {
            return self.read_dicom(name);
        }
        // The image half of a pair is bare voxels: only its name tells.
        if let Some(headers) = files::siblings(name, "img", "hdr") {
            let header = files::first_there(self.files, name, &headers)?;
            return self.read(&header);
        }
        let mut stream = open(self.files, name, name, Some(&self.hash))?;
        if stream.peek(2)? == [0x1f, 0x8b] {
            stream.unpack(Packing::Gzip);
        }
        let start = stream.peek(SNIFF_BYTES)?;
        let outcome = match sniff(&start, name) {
            Kind::Nifti => {
                let pair = nifti::read(&mut stream, name, self.options, self.sink, self.report)?;
                self.report.bytes_read += stream.raw_count();
                drop(stream);
                match pair {
                    None => Ok(()),
                    Some(header) => self.read_image_half(name, &header),
                }
            }
            kind @ (Kind::Nrrd | Kind::MetaImage) => {
                let header = if matches!(kind, Kind::Nrrd) {
                    nrrd::read_header(&mut stream, self.options, self.report)?
                } else {
                    metaimage::read_header(&mut stream, self.options, self.report)?
                };
                match header.files.clone() {
                    None => place::read(Source::Attached(stream), &header, self.sink, self.report),
                    Some(names) => {
                        stream.finish(|_| true)?;
                        self.report.bytes_read += stream.raw_count();
                        drop(stream);
                        self.read_other_files(name, names, &header)
                    }
                }
            }
            Kind::Dicom => {
                drop(stream);
                return self.read_dicom(name);
            }
            Kind::Empty => Err(LoadError::Empty {
                name: name.to_owned(),
            }),
            Kind::Refused(what) => Err(LoadError::Unsupported {
                name: name.to_owned(),
                what: what.to_owned(),
            }),
            Kind::Unknown => Err(LoadError::UnknownFormat {
                name: name.to_owned(),
                begins: start
                    .iter()
                    .take(8)
                    .map(|byte| format!("{byte:02x}"))
                    .collect::<Vec<_>>()
                    .join(" "),
            }),
        };
        outcome.map(|()| None)
    }

    fn read_dicom(&mut self, name: &str) -> Result<Option<[u8; 32]>, LoadError> {
        dicom::read(self.files, name, self.options, self.sink, self.report).map(Some)
    }

    fn read_other_files(
        &mut self,
        name: &str,
        names: Vec<String>,
        header: &place::Header,
    ) -> Result<(), LoadError> {
        let names = names
            .iter()
            .map(|name| files::resolve(self.files, name))
            .collect();
        let source = Source::Files {
            files: self.files,
            header_name: name.to_owned(),
            names,
            hash: self.hash.clone(),
        };
        place::read(source, header, self.sink, self.report)
    }

    fn read_image_half(&mut self, name: &str, header: &nifti::Header) -> Result<(), LoadError> {
        let images = files::siblings(name, "hdr", "img").unwrap_or_default();
        let image = files::first_there(self.files, name, &images)?;
        let mut stream = open(self.files, &image, name, Some(&self.hash))?;
        if image.to_lowercase().ends_with(".gz") && stream.peek(2)? == [0x1f, 0x8b] {
            stream.unpack(Packing::Gzip);
        }
        nifti::read_voxels(&mut stream, header, self.options, self.sink, self.report)?;
        self.report.bytes_read += stream.raw_count();
        Ok(())
    }
}

enum Kind {
    Dicom,
    Nifti,
    Nrrd,
    MetaImage,
    Empty,
    /// Known, and not read: in words.
    Refused(&'static str),
    Unknown,
}

fn sniff(start: &[u8], name: &str) -> Kind {
    let lower = name.to_lowercase();
    let named = |ending: &str| {
        lower.ends_with(ending)
            || lower
                .strip_suffix(".gz")
                .is_some_and(|inner| inner.ends_with(ending))
    };
    if start.is_empty() {
        return Kind::Empty;
    }
    if nifti::is_header(start) || named(".nii") || named(".hdr") {
        return Kind::Nifti;
    }
    if nrrd::is_header(start) {
        return Kind::Nrrd;
    }
    if metaimage::is_header(start) || named(".mha") || named(".mhd") {
        return Kind::MetaImage;
    }
    if start.get(128..132) == Some(b"DICM") || dicom::has_ending(name) {
        return Kind::Dicom;
    }
    if named(".mgz") || named(".mgh") {
        return Kind::Refused(
            "FreeSurfer's MGH is not read: convert it to NIfTI (mri_convert does)",
        );
    }
    const SIGNS: [(&[u8], &str); 7] = [
        (b"\x89PNG", "a PNG picture is no volume"),
        (b"\xff\xd8\xff", "a JPEG picture is no volume"),
        (
            b"PK\x03\x04",
            "a ZIP archive: unpack it and open the scan in it",
        ),
        (
            b"\x93NUMPY",
            "a NumPy array says nothing of voxel size or orientation: save it as NIfTI or NRRD",
        ),
        (
            b"# vtk DataFile",
            "VTK files are not read: save as MetaImage or NIfTI",
        ),
        (b"glTF", "a surface (glTF), no volume"),
        (b"ply\n", "a surface (PLY), no volume"),
    ];
    for (sign, what) in SIGNS {
        if start.starts_with(sign) {
            return Kind::Refused(what);
        }
    }
    if dicom::is_header(start) && !named(".raw") {
        return Kind::Dicom;
    }
    if named(".obj") || named(".stl") || named(".ply") {
        return Kind::Refused("a surface, no volume");
    }
    Kind::Unknown
}
