//! Files of figures, from their bytes to the plate that is bent.

use std::io::Read as _;
use std::sync::Arc;

use sha2::{Digest as _, Sha256};

use crate::data::{SubjectPart, SubjectSink};
use crate::figure::{FigureFile, ReadPlate, SNIFF_BYTES, read_plate};
use crate::load::{FileSet, LoadError, LoadReport, Warning};
use crate::pictures::MAX_FILE_BYTES;
#[cfg(not(target_arch = "wasm32"))]
use crate::{
    data::VolumeLimits,
    document::Reading,
    shell::loading::{Post, PostingSink},
};

/// What a file is, if it is that of a figure.
///
/// # Errors
/// [`LoadError::Io`] if the file cannot be read.
pub fn figure_file(files: &mut dyn FileSet, name: &str) -> Result<Option<FigureFile>, LoadError> {
    if !files.can_reopen() {
        return Ok(None);
    }
    Ok(FigureFile::of(&bytes_of(files, name, SNIFF_BYTES as u64)?))
}

/// The bytes of a figure's file. The report gets their hash.
///
/// # Errors
/// [`LoadError`] if the file cannot be read, or is larger than a picture may be.
pub fn figure_bytes(
    files: &mut dyn FileSet,
    name: &str,
    report: &mut LoadReport,
) -> Result<Vec<u8>, LoadError> {
    let bytes = bytes_of(files, name, MAX_FILE_BYTES + 1)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(LoadError::Figure {
            name: name.to_owned(),
            message: format!(
                "the file has more than {MAX_FILE_BYTES} bytes, the most that a picture may have"
            ),
        });
    }
    report.sha256 = Some(Sha256::digest(&bytes).into());
    Ok(bytes)
}

fn bytes_of(files: &mut dyn FileSet, name: &str, most: u64) -> Result<Vec<u8>, LoadError> {
    let mut bytes = Vec::new();
    let read = match files.open(name) {
        Ok(file) => file.read.take(most).read_to_end(&mut bytes),
        Err(error) => Err(error),
    };
    read.map_err(|error| LoadError::Io {
        name: name.to_owned(),
        offset: bytes.len() as u64,
        message: error.to_string(),
    })?;
    Ok(bytes)
}

/// Reads the plate of a figure and hands it over.
///
/// # Errors
/// [`LoadError`], with the name; also where the sink stops it.
pub fn read_figure(
    files: &mut dyn FileSet,
    name: &str,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let bytes = figure_bytes(files, name, report)?;
    let read = read_plate(&bytes).map_err(|error| LoadError::Figure {
        name: name.to_owned(),
        message: error.to_string(),
    })?;
    hand_over(read, name, sink, report)
}

/// Hands over a plate that was read.
///
/// # Errors
/// [`LoadError`] where the sink stops it.
pub fn hand_over(
    read: ReadPlate,
    name: &str,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    for what in read.asides {
        report.warn(Warning::Figure { what });
    }
    let taken = sink.take(SubjectPart::Plate(Arc::new(read.plate)));
    taken.map_err(|why| LoadError::Figure {
        name: name.to_owned(),
        message: why,
    })
}

/// Reads a subject of any kind, as its document says: a scan, meshes, or a figure.
///
/// # Errors
/// As [`read_figure`] and [`meshes::read_any`](super::meshes::read_any).
#[cfg(not(target_arch = "wasm32"))]
pub fn read_any(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    match reading.raw.is_none() && figure_file(files, name)?.is_some() {
        true => read_figure(files, name, sink, report),
        false => super::meshes::read_any(files, name, reading, sink, report),
    }
}

/// Reads a subject of any kind and posts its pieces and how the load ended.
#[cfg(not(target_arch = "wasm32"))]
pub fn read_file(
    files: &mut dyn FileSet,
    name: &str,
    limits: VolumeLimits,
    reading: &Reading,
    post: &mut dyn Post,
) {
    let is_figure =
        reading.raw.is_none() && figure_file(files, name).is_ok_and(|file| file.is_some());
    if !is_figure {
        return super::meshes::read_file(files, name, limits, reading, post);
    }
    let mut report = LoadReport::default();
    let mut sink = PostingSink::new(post);
    let outcome = read_figure(files, name, &mut sink, &mut report);
    sink.end(outcome, &report, None);
}
