//! What DOC on the command line means: a file, a link, a payload, or standard input.

use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use super::args::{Common, Moment};
use super::error::CliError;
use super::fields::fields_of;
use super::objects::{Needed, objects_of};
use super::output::{notice, shortened};
use super::subject::subject_of;
use crate::data::{ObjectMeshes, Resources, VolumeLimits};
use crate::document::{Document, Illustration, MAX_BYTES};
use crate::link::{self, LinkError};
use crate::render::missed_notices;

/// A document, where its relative addresses start, and the step that its link names.
pub(super) struct Opened {
    pub(super) document: Document,
    pub(super) folder: PathBuf,
    pub(super) step: usize,
}

impl Opened {
    pub(super) fn report_notices(&self) {
        for line in self.document.notices() {
            notice(line);
        }
    }

    /// What the document says at a moment, its notices said, and what its templates hold: samples of fields, and the
    /// objects that it carves by.
    pub(super) fn illustration(
        &self,
        moment: Moment,
        common: &Common,
    ) -> Result<(Illustration, Resources), CliError> {
        let illustration = self.at_moment(moment)?;
        missed_notices(&illustration.templates)
            .iter()
            .for_each(notice);
        let mut resources = fields_of(&illustration, common, &self.folder)?;
        let place = (common, self.folder.as_path());
        resources.objects = objects_of(&illustration, Needed::Carving, ObjectMeshes::new(), place)?;
        let mut carving = illustration.templates.iter().filter_map(|t| t.carves_by());
        if carving.any(|found| found.placement.is_none()) {
            let limits = VolumeLimits {
                max_dim: u32::MAX,
                max_voxels: u64::MAX,
            };
            let subject = subject_of(&illustration, common, &self.folder, limits)?;
            resources.frame = Some(subject.frame());
        }
        Ok((illustration, resources))
    }

    fn at_moment(&self, moment: Moment) -> Result<Illustration, CliError> {
        self.report_notices();
        let last = self.document.step_count();
        let step = moment.step.unwrap_or_else(|| {
            if self.step > last {
                notice(format!(
                    "the link opens at step {}, the last is {last}",
                    self.step
                ));
            }
            self.step.min(last)
        });
        let at_step = self.document.at_step(step).map_err(CliError::Step)?;
        for line in at_step.notices() {
            if !self.document.notices().contains(line) {
                notice(format!("step {step}: {line}"));
            }
        }
        match moment.time {
            Some(_) if step == 0 => {
                notice("there is no passage to step 0; --time changes nothing");
                Ok(at_step.illustration().clone())
            }
            Some(seconds) => self.document.at_time(step, seconds).map_err(CliError::Step),
            None => Ok(at_step.illustration().clone()),
        }
    }
}

/// Opens DOC: an existing path, a link, a payload, or `-`.
pub(super) fn open(doc: &str) -> Result<Opened, CliError> {
    let here = PathBuf::from(".");
    if doc == "-" {
        let text = read_text(io::stdin().lock(), "standard input")?;
        return from_text(&text, "standard input", here);
    }
    let path = Path::new(doc);
    if path.exists() {
        let file = std::fs::File::open(path).map_err(|source| CliError::Read {
            path: doc.to_owned(),
            source,
        })?;
        let text = read_text(file, doc)?;
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => here,
        };
        return from_text(&text, doc, folder);
    }
    match link::decode(doc) {
        Ok(link) => Ok(Opened {
            document: link.document,
            folder: here,
            step: link.step,
        }),
        Err(source @ (LinkError::Foreign { .. } | LinkError::Empty)) if !doc.contains('#') => {
            Err(CliError::NeitherFileNorLink {
                path: format!("“{}”", shortened(doc)),
                source,
            })
        }
        Err(source) => Err(CliError::Link {
            path: shortened(doc),
            source,
        }),
    }
}

/// True if a file holds a document or a link: it looks like the one by its key `fabrica`, broken or not, or is the
/// other. False if it cannot be read, or is none.
pub(super) fn is_document(path: &Path) -> bool {
    let mut bytes = Vec::new();
    let read = std::fs::File::open(path)
        .and_then(|file| file.take(MAX_BYTES as u64).read_to_end(&mut bytes));
    let text = String::from_utf8_lossy(&bytes);
    let text = text.trim_start_matches('\u{feff}').trim();
    read.is_ok() && (text.starts_with('{') && text.contains("\"fabrica\"") || is_link(text))
}

/// True if a text is one link and nothing else.
fn is_link(text: &str) -> bool {
    text.trim().lines().count() == 1 && link::decode(text).is_ok()
}

fn read_text(from: impl io::Read, path: &str) -> Result<String, CliError> {
    let mut bytes = Vec::new();
    from.take(MAX_BYTES as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| CliError::Read {
            path: path.to_owned(),
            source,
        })?;
    if bytes.len() > MAX_BYTES {
        return Err(CliError::TooLong {
            path: path.to_owned(),
        });
    }
    String::from_utf8(bytes).map_err(|_not_utf8| CliError::NotUtf8 {
        path: path.to_owned(),
    })
}

/// A file holds a document, or just its link.
fn from_text(text: &str, path: &str, folder: PathBuf) -> Result<Opened, CliError> {
    if is_link(text)
        && let Ok(link) = link::decode(text)
    {
        return Ok(Opened {
            document: link.document,
            folder,
            step: link.step,
        });
    }
    let document = Document::from_json(text).map_err(|source| CliError::Document {
        path: path.to_owned(),
        source,
    })?;
    Ok(Opened {
        document,
        folder,
        step: 0,
    })
}
