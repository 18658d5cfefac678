//! What a document says of its subject: which, from where, and how its file is to be read.

use serde_json::Value;

use super::error::DocumentError;
use super::illustration::{RawVoxels, Reading, SegmentsRef, SubjectRef};
use super::json::shortened;
use super::notice::NoticeKind;
use super::object::{Object, wrong};
use super::pointer::join;
use super::resolve::Reader;
use super::{BUILTIN_SUBJECTS, MAX_LABEL_FILES};

/// Longest side of bare voxels.
const MAX_RAW_SIDE: f64 = 65_536.0;
/// Size of a bare voxel, mm.
const RAW_SPACING_MM: [f64; 2] = [1e-6, 1e6];

impl Reader {
    pub(super) fn subject(&mut self, object: &Object<'_>) -> Result<SubjectRef, DocumentError> {
        self.unknown_keys(
            object,
            &[
                "builtin", "revision", "src", "sha256", "name", "frame", "raw", "segments",
                "features",
            ],
        );
        let builtin = object.text("builtin")?;
        let src = object.text("src")?;
        let sha256 = hash(object)?;
        let name = object.string("name")?;
        if let Some(builtin) = builtin {
            if !BUILTIN_SUBJECTS.contains(&builtin) {
                self.note(
                    object.at("builtin"),
                    NoticeKind::UnknownSubject {
                        found: shortened(builtin, 40),
                    },
                );
            }
            for key in ["src", "sha256", "frame", "raw"] {
                if object.map.contains_key(key) {
                    self.note(
                        object.at(key),
                        NoticeKind::LeftAside {
                            taken: "the built-in subject",
                        },
                    );
                }
            }
            return Ok(SubjectRef::Builtin {
                name: builtin.to_owned(),
            });
        }
        let reading = self.reading(object)?;
        Ok(match (src, sha256) {
            (Some(src), sha256) => SubjectRef::Address {
                src: src.to_owned(),
                sha256,
                name,
                reading,
            },
            (None, Some(sha256)) => SubjectRef::Supplied {
                sha256,
                name,
                reading,
            },
            (None, None) => SubjectRef::Builtin {
                name: super::DEFAULT_SUBJECT.to_owned(),
            },
        })
    }

    /// What the document says of a file that leaves a choice.
    fn reading(&mut self, object: &Object<'_>) -> Result<Reading, DocumentError> {
        let raw = if object.map.contains_key("raw") {
            let object = object.child("raw")?;
            Some(self.raw(&object)?)
        } else {
            None
        };
        Ok(Reading {
            frame: whole(object, "frame")?,
            raw,
        })
    }

    fn raw(&mut self, object: &Object<'_>) -> Result<RawVoxels, DocumentError> {
        self.unknown_keys(object, &["size", "type", "order", "spacing", "skip"]);
        let size = object
            .numbers("size", "a list of three numbers")?
            .unwrap_or([1.0; 3]);
        let size = self
            .clamp(|| object.at("size"), size, [1.0, MAX_RAW_SIDE])
            .map(|side| side as u32);
        let element = match object.text("type")? {
            None => RawVoxels::DEFAULT_ELEMENT,
            Some(name) => match RawVoxels::ELEMENTS.iter().find(|known| **known == name) {
                Some(known) => known,
                None => {
                    self.unknown_value(object.at("type"), name, RawVoxels::DEFAULT_ELEMENT);
                    RawVoxels::DEFAULT_ELEMENT
                }
            },
        };
        let big_endian = match object.text("order")? {
            None | Some("little") => false,
            Some("big") => true,
            Some(other) => {
                self.unknown_value(object.at("order"), other, "little");
                false
            }
        };
        let spacing_mm = object
            .numbers("spacing", "a list of three numbers")?
            .unwrap_or([1.0; 3]);
        Ok(RawVoxels {
            size,
            element,
            big_endian,
            spacing_mm: self.clamp(|| object.at("spacing"), spacing_mm, RAW_SPACING_MM),
            skip_bytes: whole(object, "skip")?,
        })
    }

    pub(super) fn revision(&mut self, object: &Object<'_>) -> Result<Option<u32>, DocumentError> {
        match object.map.get("revision") {
            None => Ok(None),
            Some(value) => value
                .as_u64()
                .and_then(|revision| u32::try_from(revision).ok())
                .map(Some)
                .ok_or_else(|| wrong(&object.at("revision"), "a whole number", value)),
        }
    }

    /// One label volume, or a list of them.
    pub(super) fn segments(
        &mut self,
        subject: &Object<'_>,
    ) -> Result<Vec<SegmentsRef>, DocumentError> {
        match subject.map.get("segments") {
            None => Ok(Vec::new()),
            Some(Value::Array(_)) => {
                let items = subject.limited_list("segments", "label volumes", MAX_LABEL_FILES)?;
                let at = subject.at("segments");
                items
                    .iter()
                    .enumerate()
                    .map(|(i, item)| {
                        self.label_volume(&Object::new(join(&at, &i.to_string()), item)?)
                    })
                    .collect()
            }
            Some(_) => Ok(vec![self.label_volume(&subject.child("segments")?)?]),
        }
    }

    fn label_volume(&mut self, object: &Object<'_>) -> Result<SegmentsRef, DocumentError> {
        self.unknown_keys(object, &["src", "sha256", "names"]);
        let names = object.child("names")?;
        let mut list = Vec::new();
        for (number, value) in names.map {
            let name = match value {
                Value::String(name) => name.clone(),
                other => return Err(wrong(&names.at(number), "a name", other)),
            };
            match number.parse::<u32>() {
                Ok(label) => list.push((label, name)),
                Err(_) => self.unknown_value(names.at(number), number, "no label"),
            }
        }
        list.sort();
        Ok(SegmentsRef {
            src: object.text("src")?.map(str::to_owned),
            sha256: hash(object)?,
            names: list,
        })
    }
}

/// A whole number from 0; 0 where there is none.
fn whole(object: &Object<'_>, key: &str) -> Result<u64, DocumentError> {
    match object.map.get(key) {
        None => Ok(0),
        Some(value) => value
            .as_u64()
            .ok_or_else(|| wrong(&object.at(key), "a whole number from 0", value)),
    }
}

pub(super) fn hash(object: &Object<'_>) -> Result<Option<String>, DocumentError> {
    match object.text("sha256")? {
        None => Ok(None),
        Some(text) if text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit()) => {
            Ok(Some(text.to_ascii_lowercase()))
        }
        Some(_) => Err(wrong(
            &object.at("sha256"),
            "64 hexadecimal digits",
            &object.map["sha256"],
        )),
    }
}
