//! What all tests of the readers share: how files are read without the shell, what is known of real ones, and chance.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::path::{Path, PathBuf};

use fabrica::data::{SubjectSink, Volume, VolumeBuilder};
use fabrica::load::{self, ALL_FILES, FileHandle, FileSet, LoadError, LoadReport, ReadOptions};
use glam::{DVec3, UVec3};

/// The files of a folder and of those in it, for paths that the tests themselves write.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new(path: impl Into<PathBuf>) -> Self {
        Self(path.into())
    }
}

fn list(folder: &Path, before: &str, names: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = format!("{before}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            list(&entry.path(), &format!("{name}/"), names);
        } else {
            names.push(name);
        }
    }
}

impl FileSet for Folder {
    fn open(&mut self, name: &str) -> std::io::Result<FileHandle<'_>> {
        let file = std::fs::File::open(self.0.join(name))?;
        let byte_len = Some(file.metadata()?.len());
        Ok(FileHandle {
            read: Box::new(file),
            byte_len,
        })
    }

    fn names(&mut self) -> Vec<String> {
        let mut names = Vec::new();
        list(&self.0, "", &mut names);
        names
    }
}

/// Reads the volume at a path; of a folder, all its files.
pub(crate) fn read_volume_at(
    path: &Path,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    if path.is_dir() {
        return load::read_volume(&mut Folder::new(path), ALL_FILES, options, sink, report);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(Path::new("."));
    load::read_volume(&mut Folder::new(folder), &name, options, sink, report)
}

/// One of the volumes of these files, from 0.
pub(crate) fn load_files(
    files: &mut dyn FileSet,
    name: &str,
    frame: u64,
) -> Result<(Volume, LoadReport), LoadError> {
    load_by(frame, |options, builder, report| {
        load::read_volume(files, name, options, builder, report)
    })
}

/// One of the volumes at a path, from 0.
pub(crate) fn load_frame(path: &Path, frame: u64) -> Result<(Volume, LoadReport), LoadError> {
    load_by(frame, |options, builder, report| {
        read_volume_at(path, options, builder, report)
    })
}

fn load_by(
    frame: u64,
    read: impl FnOnce(&ReadOptions, &mut VolumeBuilder, &mut LoadReport) -> Result<(), LoadError>,
) -> Result<(Volume, LoadReport), LoadError> {
    let mut report = LoadReport::default();
    let mut builder = VolumeBuilder::new();
    let options = ReadOptions {
        frame,
        ..ReadOptions::default()
    };
    read(&options, &mut builder, &mut report)?;
    Ok((builder.finish().expect("all voxels came"), report))
}

/// The volume at a path.
pub(crate) fn load_path(path: &Path) -> Result<(Volume, LoadReport), LoadError> {
    load_frame(path, 0)
}

/// What the data's own README states of a file, taken there with other programs.
pub(crate) struct Fact {
    pub(crate) file: &'static str,
    pub(crate) dims: [u32; 3],
    /// Millimetres.
    pub(crate) spacing: [f64; 3],
    pub(crate) range: [f32; 2],
    /// Orientation by three letters; empty where the file gives none.
    pub(crate) code: &'static str,
    /// Type of the numbers in the file.
    pub(crate) stored: &'static str,
}

pub(crate) const fn fact(
    file: &'static str,
    dims: [u32; 3],
    spacing: [f64; 3],
    range: [f32; 2],
    code: &'static str,
    stored: &'static str,
) -> Fact {
    Fact {
        file,
        dims,
        spacing,
        range,
        code,
        stored,
    }
}

impl Fact {
    /// Loads the file and asserts everything but the range of its values, which the README rounds for some files.
    pub(crate) fn load(&self, folder: &Path) -> Volume {
        let name = self.file;
        let (volume, report) =
            load_path(&folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let code = load::orientation_code(&volume.grid);
        println!("{name}: {code} {:?}", report.notices());
        assert_eq!(volume.grid.dims, UVec3::from(self.dims), "{name}: size");
        let spacing = volume.grid.spacing_mm();
        assert!(
            (spacing - DVec3::from(self.spacing)).abs().max_element() < 1e-3,
            "{name}: spacing {spacing}"
        );
        if !self.code.is_empty() {
            assert_eq!(code, self.code, "{name}: orientation");
        }
        assert_eq!(report.stored_type, self.stored, "{name}: type");
        volume
    }
}

/// How often to damage each file: more where `FABRICA_FUZZ_ROUNDS` asks for it.
pub(crate) fn rounds(usual: usize) -> usize {
    let asked = std::env::var("FABRICA_FUZZ_ROUNDS").ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// A small generator of numbers, so that a failure comes again.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize
    }
}
