//! Files of the native program, as `load` wants them.

use std::fs::File;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::data::SubjectSink;
use crate::document::MeshRef;
use crate::load::{
    ALL_FILES, FileHandle, FileSet, LoadError, LoadReport, ReadOptions, read_volume,
};

/// Files of a folder that are looked at, and folders within each other.
const MAX_FILES: usize = 20_000;
const MAX_DEPTH: u32 = 5;

/// The files of one folder and what lies below it, nothing else.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    /// The folder was opened itself, so that the files in its subfolders belong to it.
    is_whole: bool,
}

impl Folder {
    /// A folder by its path.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            is_whole: false,
        }
    }

    /// The folder that a file is in, and the file's name there; of a folder, itself and [`ALL_FILES`].
    pub fn of(file: &Path) -> (Self, String) {
        if file.is_dir() {
            let folder = Self {
                path: file.to_owned(),
                is_whole: true,
            };
            return (folder, ALL_FILES.to_owned());
        }
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

/// Adds the plain files of a folder, named from where it began.
fn list(folder: &Path, before: &str, depth: u32, names: &mut Vec<String>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        if names.len() >= MAX_FILES {
            return;
        }
        // A name that is no text cannot be asked for again; links are not followed, they may lead anywhere.
        let (Ok(name), Ok(kind)) = (entry.file_name().into_string(), entry.file_type()) else {
            continue;
        };
        if kind.is_file() {
            names.push(format!("{before}{name}"));
        } else if kind.is_dir() && depth > 0 {
            list(&entry.path(), &format!("{before}{name}/"), depth - 1, names);
        }
    }
}

impl FileSet for Folder {
    fn names(&mut self) -> Vec<String> {
        let mut names = Vec::new();
        let depth = if self.is_whole { MAX_DEPTH } else { 0 };
        list(&self.path, "", depth, &mut names);
        names
    }

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

/// Files picked together, wherever each lies, by their names.
#[derive(Clone, Debug)]
pub(super) struct Picked(pub Vec<(String, PathBuf)>);

impl FileSet for Picked {
    fn names(&mut self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let found = self.0.iter().find(|(known, _)| known == name);
        let Some((_, path)) = found else {
            // What a file names, such as its materials, lies beside it.
            for (_, path) in &self.0 {
                let mut folder = Folder::of(path).0;
                if let Ok(byte_len) = folder.open(name).map(|file| file.byte_len) {
                    return Ok(FileHandle {
                        read: Box::new(File::open(folder.path.join(name))?),
                        byte_len,
                    });
                }
            }
            return Err(io::ErrorKind::NotFound.into());
        };
        let (mut folder, name) = Folder::of(path);
        let byte_len = folder.open(&name)?.byte_len;
        Ok(FileHandle {
            read: Box::new(File::open(path)?),
            byte_len,
        })
    }
}

/// The files of a subject of several meshes, and the name of the first: `first` itself, the others at their addresses,
/// which start from `folder`, and all that are `given` besides, for meshes that are known by their hash.
pub(super) fn mesh_set(
    folder: &Path,
    first: &Path,
    meshes: &[MeshRef],
    given: impl IntoIterator<Item = PathBuf>,
) -> (Picked, String) {
    let name = Folder::of(first).1;
    let mut picked = vec![(name.clone(), first.to_owned())];
    for src in meshes.iter().skip(1).filter_map(|mesh| mesh.src.as_ref()) {
        picked.extend(local(folder, src).map(|path| (src.clone(), path)));
    }
    picked.extend(
        given
            .into_iter()
            .map(|path| (path.to_string_lossy().into_owned(), path)),
    );
    (Picked(picked), name)
}

/// The file that an address in a document means; `None` for one on the network. Relative addresses start from `folder`.
pub(super) fn local(folder: &Path, src: &str) -> Option<PathBuf> {
    if src.contains("://") || src.starts_with("//") || src.starts_with("data:") {
        return None;
    }
    let path = folder.join(src);
    if !path.exists()
        && let Some(plain) = percent_decoded(src)
        && folder.join(&plain).exists()
    {
        // In an address a space is %20.
        return Some(folder.join(plain));
    }
    Some(path)
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

/// Reads the volume at a path: [`read_volume`] in the file's folder.
///
/// # Errors
/// As [`read_volume`].
pub fn read_volume_at(
    path: &Path,
    options: &ReadOptions,
    sink: &mut dyn SubjectSink,
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
