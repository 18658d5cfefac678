//! Files of the native program, as `load` wants them.

use std::fs::File;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::data::VolumeSink;
use crate::load::{FileHandle, FileSet, LoadError, LoadReport, ReadOptions, read_volume};

/// The files of one folder and what lies below it, nothing else.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// A folder by its path.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The folder that a file is in, and the file's name there.
    pub fn of(file: &Path) -> (Self, String) {
        let name = file
            .file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let folder = match file.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        (Self::new(folder), name)
    }
}

impl FileSet for Folder {
    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let below = Path::new(name);
        let stays = below
            .components()
            .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        if !stays {
            return Err(io::Error::other("a header may only name files beside it"));
        }
        let file = File::open(self.path.join(below))?;
        let metadata = file.metadata()?;
        if !metadata.is_file() {
            return Err(io::Error::other("not a plain file"));
        }
        Ok(FileHandle {
            read: Box::new(file),
            byte_len: Some(metadata.len()),
        })
    }
}

/// Reads the volume at a path: [`read_volume`] in the file's folder.
///
/// # Errors
/// As [`read_volume`].
pub fn read_volume_at(
    path: &Path,
    options: &ReadOptions,
    sink: &mut dyn VolumeSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let (mut folder, name) = Folder::of(path);
    read_volume(&mut folder, &name, options, sink, report)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_outside_are_not_opened() {
        let mut folder = Folder::new(".");
        assert!(folder.open("Cargo.toml").is_ok(), "inside");
        assert!(folder.open("./src/lib.rs").is_ok(), "below");
        assert!(folder.open("../Cargo.toml").is_err(), "out of the folder");
        assert!(
            folder.open("src/../../Cargo.toml").is_err(),
            "out on a detour"
        );
        assert!(folder.open("/etc/hostname").is_err(), "from the root");
        assert!(folder.open("src").is_err(), "a folder is no file");
    }
}
