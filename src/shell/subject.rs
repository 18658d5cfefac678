//! The subject of a document for the command line: generated, or read from a local file.

use std::path::{Path, PathBuf};
use std::sync::mpsc::sync_channel;

use super::files::Folder;
use super::reading::{ReadingFlags, hint};
use super::segments::add_segments;
use crate::data::{
    BuildError, Reducer, Segment, Volume, VolumeBuilder, VolumeLimits, VolumeSink, Voxels,
};
use crate::document::{Illustration, Reading, SegmentsRef, SubjectRef};
use crate::load::{LoadError, LoadReport, RawLayout, ReadOptions, read_raw, read_volume};
use crate::subjects::{FINE_RESOLUTION, Generator, SubjectError};

/// Why a document's subject is not there.
#[derive(Debug, thiserror::Error)]
pub enum MissingSubject {
    /// An address that is no local file.
    #[error(
        "the subject is at {src}; this program reads local files only: fetch it and give it by --subject FILE"
    )]
    Remote {
        /// As written in the document.
        src: String,
    },
    /// A file that the reader is to supply.
    #[error("the document needs the file {name} (SHA-256 {sha256}): give it by --subject FILE")]
    Wanted {
        /// What the author called it.
        name: String,
        /// Of its bytes.
        sha256: String,
    },
    /// Another file than the document means.
    #[error(
        "{path} is another file than the document means: its SHA-256 is {found}, wanted is {wanted}"
    )]
    OtherFile {
        /// The file.
        path: String,
        /// SHA-256 in the document.
        wanted: String,
        /// SHA-256 of its bytes.
        found: String,
    },
    /// No such built-in subject in this version.
    #[error(transparent)]
    Builtin(#[from] SubjectError),
    /// The file cannot be read.
    #[error("{source} [{path}]")]
    File {
        /// The file.
        path: String,
        /// Why.
        source: LoadError,
    },
    /// What was read is no volume.
    #[error("{source} [{path}]")]
    Build {
        /// The file or subject.
        path: String,
        /// Why.
        source: BuildError,
    },
}

/// Where a document's subject comes from.
#[derive(Clone, Copy, Debug)]
pub struct SubjectSource<'a> {
    /// Folder that relative addresses start from.
    pub folder: &'a Path,
    /// Takes the place of the document's subject.
    pub instead: Option<&'a Path>,
    /// How its file is read, before what the document says.
    pub reading: &'a ReadingFlags,
    /// Label volumes beside it, besides those that the document names.
    pub segments: &'a [PathBuf],
    /// What the device takes; larger volumes are reduced.
    pub limits: VolumeLimits,
}

/// Generates or reads the subject of a document with its segments: those of its file, those of label volumes beside it, and the features
/// that the document describes. `notice` takes what the user should know.
///
/// # Errors
/// Why it is not there.
pub fn load_subject(
    illustration: &Illustration,
    source: SubjectSource<'_>,
    notice: &mut dyn FnMut(String),
) -> Result<Volume, MissingSubject> {
    let mut volume = load_scan(illustration, source, notice)?;
    let is_of_scan = |named: &&SegmentsRef| named.src.is_none() && named.sha256.is_none();
    for named in illustration.segments.iter().filter(is_of_scan) {
        name_segments(&mut volume, named);
    }
    add_segments(volume, illustration, source.folder, source.segments, notice)
}

fn load_scan(
    illustration: &Illustration,
    source: SubjectSource<'_>,
    notice: &mut dyn FnMut(String),
) -> Result<Volume, MissingSubject> {
    if let Some(path) = source.instead {
        let wanted = match &illustration.subject {
            SubjectRef::Supplied { sha256, .. } => Some(sha256.as_str()),
            SubjectRef::Address { sha256, .. } => sha256.as_deref(),
            SubjectRef::Builtin { .. } => None,
        };
        let reading = source.reading.over(illustration.subject.reading());
        let (volume, found) = read(path, &reading, source.limits, notice)?;
        if let Some(wanted) = wanted
            && found.as_deref() != Some(wanted)
        {
            notice(format!(
                "{} is another file than the document means (SHA-256 {wanted})",
                path.display()
            ));
        }
        return Ok(volume);
    }
    match &illustration.subject {
        SubjectRef::Builtin { name } => {
            if let Some(revision) = illustration.subject_revision.filter(|r| *r > 1) {
                notice(format!(
                    "/subject/revision: this version does not know revision {revision} of {name}; the first is drawn"
                ));
            }
            generate(name)
        }
        SubjectRef::Address {
            src,
            sha256,
            reading,
            ..
        } => {
            let path = local(source.folder, src)?;
            let reading = source.reading.over(Some(reading));
            let (volume, found) = read(&path, &reading, source.limits, notice)?;
            if let (Some(wanted), Some(found)) = (sha256, &found)
                && wanted != found
            {
                return Err(MissingSubject::OtherFile {
                    path: path.display().to_string(),
                    wanted: wanted.clone(),
                    found: found.clone(),
                });
            }
            Ok(volume)
        }
        SubjectRef::Supplied { sha256, name, .. } => Err(MissingSubject::Wanted {
            name: if name.is_empty() {
                "without a name".to_owned()
            } else {
                format!("“{name}”")
            },
            sha256: sha256.clone(),
        }),
    }
}

/// A built-in subject in full resolution, with as many threads as there are cores.
///
/// # Errors
/// [`SubjectError::UnknownName`].
pub fn generate(name: &str) -> Result<Volume, MissingSubject> {
    let generator = Generator::new(name, FINE_RESOLUTION)?;
    let mut builder = VolumeBuilder::new();
    builder
        .begin(&generator.header())
        .map_err(SubjectError::Refused)?;
    let n_threads = std::thread::available_parallelism().map_or(1, |n| n.get().min(16)) as u32;
    let thickness = Generator::SLAB;
    let n_slabs = generator.slice_count().div_ceil(thickness);
    std::thread::scope(|scope| {
        let outputs: Vec<_> = (0..n_threads)
            .map(|first| {
                // Two slabs ahead, so that little is held.
                let (sender, receiver) = sync_channel(2);
                let generator = &generator;
                scope.spawn(move || {
                    for slab in (first..n_slabs).step_by(n_threads as usize) {
                        let start = slab * thickness;
                        let end = (start + thickness).min(generator.slice_count());
                        if sender.send(generator.slab(start..end)).is_err() {
                            return;
                        }
                    }
                });
                receiver
            })
            .collect();
        for slab in 0..n_slabs {
            let output = outputs.get((slab % n_threads) as usize);
            if let Some(slab) = output.and_then(|output| output.recv().ok()) {
                builder.scalars(Voxels::I16(slab.values));
                builder.labels(slab.labels);
            }
        }
    });
    builder.finish().map_err(|source| MissingSubject::Build {
        path: name.to_owned(),
        source,
    })
}

/// A volume and the SHA-256 of its file.
fn read(
    path: &Path,
    reading: &Reading,
    limits: VolumeLimits,
    notice: &mut dyn FnMut(String),
) -> Result<(Volume, Option<String>), MissingSubject> {
    let mut builder = VolumeBuilder::new();
    let mut reducer = Reducer::new(&mut builder, limits);
    let mut report = LoadReport::default();
    let shown = path.display().to_string();
    let options = ReadOptions {
        frame: reading.frame,
        ..ReadOptions::default()
    };
    let (mut files, name) = Folder::of(path);
    let result = match &reading.raw {
        Some(raw) => read_raw(
            &mut files,
            &name,
            &RawLayout::from(raw),
            &options,
            &mut reducer,
            &mut report,
        ),
        None => read_volume(&mut files, &name, &options, &mut reducer, &mut report),
    };
    if let Some(reduction) = reducer.reduction() {
        notice(reduction.to_string());
    }
    for line in report.notices() {
        notice(format!("{shown}: {line}"));
    }
    let build = |source| MissingSubject::Build {
        path: shown.clone(),
        source,
    };
    match result {
        Ok(()) => {}
        // The builder stopped it and knows why.
        Err(LoadError::Cancelled) => {
            return Err(builder.finish().err().map_or(
                MissingSubject::File {
                    path: shown.clone(),
                    source: LoadError::Cancelled,
                },
                build,
            ));
        }
        Err(source) => {
            if let Some(hint) = hint(&name, &source) {
                notice(hint);
            }
            return Err(MissingSubject::File {
                path: shown,
                source,
            });
        }
    }
    let mut volume = builder.finish().map_err(build)?;
    if let Some(labels) = volume
        .labels
        .as_mut()
        .filter(|labels| labels.segments.is_empty())
    {
        labels.segments = report.segments.clone();
    }
    Ok((volume, report.sha256_hex()))
}

/// The file that an address in a document means.
pub(super) fn local(folder: &Path, src: &str) -> Result<PathBuf, MissingSubject> {
    if src.contains("://") || src.starts_with("//") || src.starts_with("data:") {
        return Err(MissingSubject::Remote {
            src: src.chars().take(200).collect(),
        });
    }
    let path = folder.join(src);
    if !path.exists()
        && let Some(plain) = percent_decoded(src)
        && folder.join(&plain).exists()
    {
        // In an address a space is %20.
        return Ok(folder.join(plain));
    }
    Ok(path)
}

fn percent_decoded(src: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(src.len());
    let mut rest = src;
    while let Some((before, after)) = rest.split_once('%') {
        bytes.extend_from_slice(before.as_bytes());
        bytes.push(u8::from_str_radix(after.get(..2)?, 16).ok()?);
        rest = after.get(2..)?;
    }
    bytes.extend_from_slice(rest.as_bytes());
    String::from_utf8(bytes).ok()
}

/// The author's names go before those of the file.
fn name_segments(volume: &mut Volume, named: &SegmentsRef) {
    let Some(labels) = &mut volume.labels else {
        return;
    };
    for (label, name) in &named.names {
        let Ok(label) = u16::try_from(*label) else {
            continue;
        };
        match labels.segments.iter_mut().find(|s| s.label == label) {
            Some(segment) => segment.name.clone_from(name),
            None => labels.segments.push(Segment {
                label,
                name: name.clone(),
                color_srgb: None,
            }),
        }
    }
    labels.segments.sort_by_key(|segment| segment.label);
}
