//! What all tests of the readers share: how a path is read without the shell.

#![allow(dead_code, reason = "each test uses a part of it")]

use std::path::{Path, PathBuf};

use fabrica::data::{Volume, VolumeBuilder, VolumeSink};
use fabrica::load::{self, ALL_FILES, FileHandle, FileSet, LoadError, LoadReport, ReadOptions};

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
    sink: &mut dyn VolumeSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    if path.is_dir() {
        return load::read_volume(&mut Folder::new(path), ALL_FILES, options, sink, report);
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(Path::new("."));
    load::read_volume(&mut Folder::new(folder), &name, options, sink, report)
}

/// One of the volumes at a path, from 0.
pub(crate) fn load_frame(path: &Path, frame: u64) -> Result<(Volume, LoadReport), LoadError> {
    let mut report = LoadReport::default();
    let mut builder = VolumeBuilder::new();
    let options = ReadOptions {
        frame,
        ..ReadOptions::default()
    };
    read_volume_at(path, &options, &mut builder, &mut report)?;
    Ok((builder.finish().expect("all voxels came"), report))
}

/// The volume at a path.
pub(crate) fn load_path(path: &Path) -> Result<(Volume, LoadReport), LoadError> {
    load_frame(path, 0)
}
