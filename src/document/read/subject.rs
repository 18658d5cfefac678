//! Reading of the subject: which one, from where, and how its file is read.

use super::object::{Object, wrong};
use super::reader::Reader;
use crate::document::limits::{BUILTIN_SUBJECTS, DEFAULT_SUBJECT, DRAWN_FIGURES, newest_revision};
use crate::document::model::{MeshRef, RawVoxels, Reading, SegmentsRef, SubjectRef};
use crate::document::text::{DocumentError, NoticeKind, shortened};
use serde_json::Value;
use std::sync::Arc;

/// Keys of a subject that say how its file is read, besides its box.
const OF_FILE: [&str; 6] = ["frame", "raw", "units", "axes", "parts", "smooth"];

impl Reader {
    /// The subject, and the meshes beside it: those of a subject of meshes alone are the subject, and a clay has none.
    pub(super) fn subject(
        &mut self,
        object: &Object<'_>,
    ) -> Result<(SubjectRef, Vec<MeshRef>), DocumentError> {
        self.unknown_keys(object);
        // Checked here, whatever is shown.
        object.whole("revision")?;
        let meshes = self.meshes(object)?;
        let has = |key: &&str| object.map.contains_key(*key);
        let is_meshes = !object.list("meshes")?.is_empty();
        if has(&"clay") {
            if is_meshes {
                let what = "a clay";
                self.note(object.at("meshes"), NoticeKind::Beside { what });
            }
            return Ok((self.clay_alone(object)?, Vec::new()));
        }
        if is_meshes && !["builtin", "src", "sha256"].iter().any(has) {
            self.left_aside(object, &["name"], "the list of meshes");
            self.left_aside(object, &OF_FILE, "the list of meshes");
            let bounds = self.reading(object)?.bounds;
            object.string("name")?;
            return Ok((SubjectRef::Meshes { meshes, bounds }, Vec::new()));
        }
        Ok((self.volume_or_mesh(object)?, meshes))
    }

    /// Names those of these keys that are there, since another source is shown.
    pub(super) fn left_aside(&mut self, object: &Object<'_>, keys: &[&str], taken: &'static str) {
        for key in keys.iter().filter(|key| object.map.contains_key(**key)) {
            self.note(object.at(key), NoticeKind::LeftAside { taken });
        }
    }

    /// A subject that is a clay, whatever else it names.
    fn clay_alone(&mut self, object: &Object<'_>) -> Result<SubjectRef, DocumentError> {
        let child = object.child("clay")?;
        let clay = self.clay(&child)?;
        // Only checked.
        for key in ["builtin", "src", "name"] {
            object.text(key)?;
        }
        object.hash()?;
        self.mesh_reading(object)?;
        self.left_aside(object, &["builtin", "src", "sha256"], "the clay");
        self.left_aside(object, &OF_FILE, "the clay");
        self.left_aside(object, &["box"], "the clay");
        Ok(SubjectRef::Clay(Arc::new(clay)))
    }

    /// The subject of a document that is neither a clay nor made of `meshes` alone.
    fn volume_or_mesh(&mut self, object: &Object<'_>) -> Result<SubjectRef, DocumentError> {
        let builtin = object.text("builtin")?;
        let src = object.text("src")?;
        let sha256 = object.hash()?;
        let name = object.string("name")?;
        if let Some(builtin) = builtin {
            if !BUILTIN_SUBJECTS.contains(&builtin) && !DRAWN_FIGURES.contains(&builtin) {
                self.note(
                    object.at("builtin"),
                    NoticeKind::UnknownSubject {
                        found: shortened(builtin, 40),
                    },
                );
            }
            self.mesh_reading(object)?;
            self.left_aside(object, &["src", "sha256"], "the built-in subject");
            self.left_aside(object, &OF_FILE, "the built-in subject");
            return Ok(SubjectRef::Builtin {
                name: builtin.to_owned(),
                revision: self.revision(object, builtin)?,
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
                name: DEFAULT_SUBJECT.to_owned(),
                revision: self.revision(object, DEFAULT_SUBJECT)?,
            },
        })
    }

    /// How a file is read that leaves a choice.
    fn reading(&mut self, object: &Object<'_>) -> Result<Reading, DocumentError> {
        let raw = if object.map.contains_key("raw") {
            let object = object.child("raw")?;
            Some(self.raw(&object)?)
        } else {
            None
        };
        Ok(Reading {
            frame: object.whole("frame")?,
            raw,
            mesh: self.mesh_reading(object)?,
            bounds: self.subject_box(object)?,
            meshes: Vec::new(),
            carves: false,
            sweeps: false,
        })
    }

    pub(super) fn raw(&mut self, object: &Object<'_>) -> Result<RawVoxels, DocumentError> {
        self.unknown_keys(object);
        let size = self.numbers(object, "size")?.map(|side| side as u32);
        let element = RawVoxels::ELEMENTS[self.choice(object, "type")?];
        let big_endian = self.choice(object, "order")? == 1;
        Ok(RawVoxels {
            size,
            element,
            big_endian,
            spacing_mm: self.numbers(object, "spacing")?,
            skip_bytes: object.whole("skip")?,
        })
    }

    /// The revision of a built-in subject. The newest stands in for one that this version does not know.
    pub(super) fn revision(
        &mut self,
        object: &Object<'_>,
        name: &str,
    ) -> Result<u32, DocumentError> {
        let revision = u32::try_from(object.whole("revision")?).unwrap_or(u32::MAX);
        let newest = newest_revision(name);
        if revision > newest && BUILTIN_SUBJECTS.contains(&name) {
            let kind = NoticeKind::UnknownRevision { revision, newest };
            self.note(object.at("revision"), kind);
        }
        Ok(revision.clamp(1, newest))
    }

    /// One label volume, or a list of them.
    pub(super) fn segments(
        &mut self,
        subject: &Object<'_>,
    ) -> Result<Vec<SegmentsRef>, DocumentError> {
        match subject.map.get("segments") {
            None => Ok(Vec::new()),
            Some(Value::Array(_)) => subject
                .children("segments")?
                .map(|object| self.label_volume(&object?))
                .collect(),
            Some(_) => Ok(vec![self.label_volume(&subject.child("segments")?)?]),
        }
    }

    fn label_volume(&mut self, object: &Object<'_>) -> Result<SegmentsRef, DocumentError> {
        self.unknown_keys(object);
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
            sha256: object.hash()?,
            names: list,
        })
    }
}
