use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, Cursor, Read};

use super::LoadError;
use super::stream::{SharedHash, Stream};

/// Stands for a file's name where all files of a set are meant: a folder of DICOM, or many files dropped together.
pub const ALL_FILES: &str = ".";

/// Files that one header may name.
const MAX_FILES: u64 = 100_000;

/// An opened file: bytes to pull, and how many there are if that is known (it gives progress, and unmasks headers that
/// promise more).
pub struct FileHandle<'a> {
    /// The bytes, from the first. Read in large pieces; no buffer is needed.
    pub read: Box<dyn Read + 'a>,
    /// Length of the file, bytes; `None` if it is not known.
    pub byte_len: Option<u64>,
}

impl fmt::Debug for FileHandle<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FileHandle")
            .field("byte_len", &self.byte_len)
            .finish_non_exhaustive()
    }
}

/// The files that a reader may ask for: the one opened and, where a format spreads over several, those beside it. A
/// name is relative to the opened file's folder and may come out of a header: an implementation must not follow it out
/// of that folder (`..`, absolute paths).
pub trait FileSet {
    /// Opens a file at its beginning. A file may be opened again; one is open at a time.
    ///
    /// # Errors
    /// [`io::ErrorKind::NotFound`] if there is none of this name.
    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>>;

    /// Names of all files, for formats whose volumes are spread over many (DICOM). None where only those are given that
    /// a header asks for.
    fn names(&mut self) -> Vec<String> {
        Vec::new()
    }

    /// False if a file can be opened once only.
    fn can_reopen(&self) -> bool {
        true
    }
}

/// A single file, which can be read once: for a reader that cannot go back.
pub struct OneFile<R> {
    name: String,
    read: Option<R>,
    byte_len: Option<u64>,
}

impl<R> OneFile<R> {
    /// From a reader at the file's first byte.
    pub fn new(name: &str, read: R, byte_len: Option<u64>) -> Self {
        Self {
            name: name.to_owned(),
            read: Some(read),
            byte_len,
        }
    }
}

impl<R> fmt::Debug for OneFile<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OneFile")
            .field("name", &self.name)
            .field("byte_len", &self.byte_len)
            .finish_non_exhaustive()
    }
}

impl<R: Read> FileSet for OneFile<R> {
    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        if name != self.name {
            return Err(io::ErrorKind::NotFound.into());
        }
        let read = self
            .read
            .take()
            .ok_or_else(|| io::Error::other("the file can be read once only"))?;
        Ok(FileHandle {
            read: Box::new(read),
            byte_len: self.byte_len,
        })
    }

    fn can_reopen(&self) -> bool {
        false
    }
}

/// Files in memory, for small ones and tests.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles {
    files: BTreeMap<String, Vec<u8>>,
}

impl MemoryFiles {
    /// From names and contents.
    pub fn new<S: Into<String>>(files: impl IntoIterator<Item = (S, Vec<u8>)>) -> Self {
        Self {
            files: files
                .into_iter()
                .map(|(name, bytes)| (name.into(), bytes))
                .collect(),
        }
    }
}

impl FileSet for MemoryFiles {
    fn names(&mut self) -> Vec<String> {
        self.files.keys().cloned().collect()
    }

    fn open(&mut self, name: &str) -> io::Result<FileHandle<'_>> {
        let bytes = self
            .files
            .get(name.strip_prefix("./").unwrap_or(name))
            .ok_or(io::ErrorKind::NotFound)?;
        Ok(FileHandle {
            read: Box::new(Cursor::new(bytes.as_slice())),
            byte_len: Some(bytes.len() as u64),
        })
    }
}

/// The name under which the set has a file that a header calls so: as written, without `./`, or without its folders
/// (files dropped on a page have none).
pub(crate) fn resolve(files: &mut dyn FileSet, name: &str) -> String {
    let plain = name.strip_prefix("./").unwrap_or(name);
    let last = plain.rsplit(['/', '\\']).next().unwrap_or(plain);
    let is_missing = |files: &mut dyn FileSet, name: &str| {
        files
            .open(name)
            .is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
    };
    if last != plain && is_missing(files, plain) && !is_missing(files, last) {
        return last.to_owned();
    }
    plain.to_owned()
}

/// Opens `name`, which `asked_by` needs.
pub(crate) fn open<'a>(
    files: &'a mut dyn FileSet,
    name: &str,
    asked_by: &str,
    hash: Option<&SharedHash>,
) -> Result<Stream<'a>, LoadError> {
    match files.open(name) {
        Ok(handle) => Ok(Stream::new(
            name,
            handle.read,
            handle.byte_len,
            hash.cloned(),
        )),
        Err(error) if error.kind() == io::ErrorKind::NotFound && name != asked_by => {
            Err(LoadError::MissingFile {
                name: asked_by.to_owned(),
                needed: name.to_owned(),
            })
        }
        Err(error) => Err(LoadError::Io {
            name: name.to_owned(),
            offset: 0,
            message: error.to_string(),
        }),
    }
}

/// Names that the other half of a pair may have, the likeliest first; `None` if `name` does not end in `from` (or that
/// and `.gz`). Keeps the case of the ending.
pub(crate) fn siblings(name: &str, from: &str, to: &str) -> Option<Vec<String>> {
    let (inner, packed) = match name.len().checked_sub(3) {
        Some(at) if name.is_char_boundary(at) && name[at..].eq_ignore_ascii_case(".gz") => {
            (&name[..at], Some(&name[at..]))
        }
        _ => (name, None),
    };
    let (stem, ending) = inner.rsplit_once('.')?;
    if !ending.eq_ignore_ascii_case(from) || stem.is_empty() {
        return None;
    }
    let to = if ending.chars().all(|c| c.is_ascii_uppercase()) {
        to.to_uppercase()
    } else {
        to.to_owned()
    };
    let plain = format!("{stem}.{to}");
    let gz = format!("{plain}{}", packed.unwrap_or(".gz"));
    Some(if packed.is_some() {
        vec![gz, plain]
    } else {
        vec![plain, gz]
    })
}

/// The first of the names that can be opened.
pub(crate) fn first_there(
    files: &mut dyn FileSet,
    asked_by: &str,
    names: &[String],
) -> Result<String, LoadError> {
    for name in names {
        match files.open(name) {
            Ok(_) => return Ok(name.clone()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => {
                return Err(LoadError::Io {
                    name: name.clone(),
                    offset: 0,
                    message: error.to_string(),
                });
            }
        }
    }
    Err(LoadError::MissingFile {
        name: asked_by.to_owned(),
        needed: names.first().cloned().unwrap_or_default(),
    })
}

/// The names that a pattern like `slice%03d.raw` stands for.
pub(crate) fn pattern_files(
    pattern: &str,
    first: i64,
    last: i64,
    step: i64,
) -> Option<Vec<String>> {
    let (before, rest) = pattern.split_once('%')?;
    let (width, after) = rest.split_once(['d', 'i', 'u'])?;
    let is_padded = width.starts_with('0');
    let width: usize = if width.is_empty() {
        0
    } else {
        width.parse().ok()?
    };
    let span = last.checked_sub(first)?;
    if width > 32 || step == 0 || span.signum() * step.signum() < 0 {
        return None;
    }
    let count = span.checked_div(step)?.unsigned_abs().saturating_add(1);
    if count > MAX_FILES {
        return None;
    }
    Some(
        (0..count as i64)
            .map(|i| {
                let number = first + i * step;
                if is_padded {
                    format!("{before}{number:0width$}{after}")
                } else {
                    format!("{before}{number:width$}{after}")
                }
            })
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_named_alike() {
        assert_eq!(
            siblings("a.b.hdr", "hdr", "img").expect("a pair"),
            ["a.b.img", "a.b.img.gz"]
        );
        assert_eq!(
            siblings("A.HDR.GZ", "hdr", "img").expect("a pair"),
            ["A.IMG.GZ", "A.IMG"]
        );
        assert_eq!(siblings("a.nii", "hdr", "img"), None);
        assert_eq!(siblings(".hdr", "hdr", "img"), None);
        assert_eq!(siblings("é.z", "hdr", "img"), None);
    }

    #[test]
    fn patterns_count_up_and_down() {
        assert_eq!(
            pattern_files("a%d.raw", 9, 11, 1),
            Some(vec!["a9.raw".into(), "a10.raw".into(), "a11.raw".into()])
        );
        assert_eq!(
            pattern_files("a%03d", 4, 0, -2),
            Some(vec!["a004".into(), "a002".into(), "a000".into()])
        );
        assert_eq!(pattern_files("a%d", 0, 5, -1), None);
        assert_eq!(pattern_files("a%d", 0, i64::MAX, 1), None);
        assert_eq!(pattern_files("a%d", i64::MIN, i64::MAX, 1), None);
        assert_eq!(pattern_files("a%999999d", 0, 1, 1), None);
        assert_eq!(pattern_files("a", 0, 1, 1), None);
    }
}
