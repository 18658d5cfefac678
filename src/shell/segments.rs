//! Label volumes beside a scan, for the command line: those that a document names and those that are given with `--segments`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::files::Folder;
use super::subject::{MissingSubject, local};
use crate::data::{LabelVolume, Turns, Volume, segment};
use crate::document::{Illustration, SegmentsRef};
use crate::load::{LoadReport, ReadOptions, read_labels};

/// A label volume that was read, by the hash of its bytes.
struct Given {
    path: PathBuf,
    sha256: Option<String>,
    labels: LabelVolume,
}

fn read(path: &Path, names: &[(u32, String)]) -> Result<Given, MissingSubject> {
    let (mut files, name) = Folder::of(path);
    let names: BTreeMap<u16, String> = names
        .iter()
        .filter_map(|(number, name)| Some((u16::try_from(*number).ok()?, name.clone())))
        .collect();
    let mut report = LoadReport::default();
    let options = ReadOptions::default();
    let labels =
        read_labels(&mut files, &name, &names, &options, &mut report).map_err(|source| {
            MissingSubject::File {
                path: path.display().to_string(),
                source,
            }
        })?;
    Ok(Given {
        path: path.to_owned(),
        sha256: report.sha256_hex(),
        labels,
    })
}

/// Brings the label volumes that the document names, in its order, then the others that were given, and makes the features that the
/// document describes.
///
/// # Errors
/// If a label volume cannot be read, or is another file than the document means.
pub(super) fn add_segments(
    volume: Volume,
    illustration: &Illustration,
    folder: &Path,
    given: &[PathBuf],
    notice: &mut dyn FnMut(String),
) -> Result<Volume, MissingSubject> {
    let mut given: Vec<Given> = given
        .iter()
        .map(|path| read(path, &[]))
        .collect::<Result<_, _>>()?;
    let mut files = Vec::new();
    for wanted in &illustration.segments {
        let SegmentsRef { src, sha256, names } = wanted;
        let found = sha256.as_ref().and_then(|wanted| {
            let is_it = |given: &Given| given.sha256.as_ref() == Some(wanted);
            given.iter().position(is_it)
        });
        let labels = match (found, src, sha256) {
            (Some(i), _, _) => {
                let given = given.remove(i);
                match names.is_empty() {
                    true => given.labels,
                    // Numbers are those of the file, which only reading knows.
                    false => read(&given.path, names)?.labels,
                }
            }
            (None, Some(src), _) => {
                let read = read(&local(folder, src)?, names)?;
                if let (Some(wanted), Some(found)) = (sha256, read.sha256)
                    && *wanted != found
                {
                    return Err(MissingSubject::OtherFile {
                        path: read.path.display().to_string(),
                        wanted: wanted.clone(),
                        found,
                    });
                }
                read.labels
            }
            (None, None, Some(sha256)) => {
                notice(format!(
                    "the document needs a label volume (SHA-256 {sha256}): give it by --segments FILE; its segments are left out"
                ));
                continue;
            }
            // Names only: for the segments in the scan's own file.
            (None, None, None) => continue,
        };
        files.push(Arc::new(labels));
    }
    files.extend(given.into_iter().map(|given| Arc::new(given.labels)));
    if files.is_empty() && illustration.features.is_empty() {
        return Ok(volume);
    }
    let volume = Arc::new(volume);
    let made = pollster::block_on(segment(
        Arc::clone(&volume),
        files,
        illustration.features.clone(),
        Turns::endless(),
    ));
    made.notices.into_iter().for_each(&mut *notice);
    let mut volume = Arc::unwrap_or_clone(volume);
    volume.labels = made.labels.map(Arc::unwrap_or_clone);
    Ok(volume)
}
