//! Reads meshes of the subject and objects of the scene: the entries of `subject.meshes` and of `objects`.

use super::object::Object;
use super::reader::Reader;
use crate::document::limits::MAX_BOX_MM;
use crate::document::model::{
    MeshAxes, MeshParts, MeshReading, MeshRef, MeshUnits, ObjectPlacement, ObjectSource,
    SceneObject, SubjectBox,
};
use crate::document::schema::Kind;
use crate::document::text::{DocumentError, NoticeKind};
use glam::DVec3;

impl Reader {
    /// The meshes of a subject, without those that name no file.
    pub(super) fn meshes(&mut self, subject: &Object<'_>) -> Result<Vec<MeshRef>, DocumentError> {
        let mut meshes = Vec::new();
        for (index, object) in subject.children("meshes")?.enumerate() {
            let object = object?;
            self.unknown_keys(&object);
            let mesh = MeshRef {
                index,
                src: object.text("src")?.map(str::to_owned),
                sha256: object.hash()?,
                name: object.string("name")?,
                reading: self.mesh_reading(&object)?,
            };
            if mesh.src.is_none() && mesh.sha256.is_none() {
                self.nothing(&object, "a mesh with neither `src` nor `sha256` is");
            } else {
                meshes.push(mesh);
            }
        }
        Ok(meshes)
    }

    /// How a mesh is read that may be the subject's own file, or an entry of `subject.meshes`.
    pub(super) fn mesh_reading(
        &mut self,
        object: &Object<'_>,
    ) -> Result<MeshReading, DocumentError> {
        let parts = MeshParts::ALL[self.choice(object, "parts")?];
        Ok(MeshReading {
            parts,
            ..self.reading_of_object(object)?
        })
    }

    /// How the file of an object is read, which has no segments.
    fn reading_of_object(&mut self, object: &Object<'_>) -> Result<MeshReading, DocumentError> {
        let smooth = object.map.contains_key("smooth");
        Ok(MeshReading {
            smooth_deg: match smooth {
                true => Some(self.number(object, "smooth")?),
                false => None,
            },
            ..self.reading_as_whole(object)?
        })
    }

    /// How a file is read whose parts are one, with the normals that it has.
    pub(super) fn reading_as_whole(
        &mut self,
        object: &Object<'_>,
    ) -> Result<MeshReading, DocumentError> {
        let own = "what the file says";
        Ok(MeshReading {
            units: self
                .choice_if_any(object, "units", own)?
                .map(|i| MeshUnits::ALL[i]),
            axes: self
                .choice_if_any(object, "axes", own)?
                .map(|i| MeshAxes::ALL[i]),
            parts: MeshParts::Whole,
            smooth_deg: None,
        })
    }

    /// Index of a name among those of the schema; `None` where the key is missing, and for an unknown name, in whose
    /// place a notice says `instead`.
    pub(super) fn choice_if_any(
        &mut self,
        object: &Object<'_>,
        key: &str,
        instead: &str,
    ) -> Result<Option<usize>, DocumentError> {
        let (Some(name), Kind::Name(names)) = (object.text(key)?, object.kind(key)) else {
            return Ok(None);
        };
        let found = names.iter().position(|known| *known == name);
        if found.is_none() {
            self.unknown_value(object.at(key), name, instead);
        }
        Ok(found)
    }

    /// The box that gives a subject of meshes alone its place and its size.
    pub(super) fn subject_box(
        &mut self,
        subject: &Object<'_>,
    ) -> Result<Option<SubjectBox>, DocumentError> {
        let expected = "a list of six numbers, the least x, y, z and the greatest";
        let Some(values) = subject.numbers::<6>("box", expected)? else {
            return Ok(None);
        };
        let [a, b, c, d, e, f] = values.map(|v| v.clamp(-MAX_BOX_MM, MAX_BOX_MM));
        let (min_mm, max_mm) = (DVec3::new(a, b, c), DVec3::new(d, e, f));
        let drawn = SubjectBox {
            min_mm,
            max_mm: max_mm.max(min_mm),
        };
        // What is less than a 32-bit float can hold gives no unit that anything could be measured in.
        if drawn.mm_per_unit() < f64::from(f32::MIN_POSITIVE) {
            return Err(DocumentError::NoSize {
                pointer: subject.at("box"),
            });
        }
        let [min, max] = [drawn.min_mm.to_array(), drawn.max_mm.to_array()];
        let numbers = [min[0], min[1], min[2], max[0], max[1], max[2]];
        self.clamped(|| subject.at("box"), values, numbers);
        Ok(Some(drawn))
    }

    /// The objects of the scene, without those that name nothing that this version knows.
    pub(super) fn objects(&mut self, root: &Object<'_>) -> Result<Vec<SceneObject>, DocumentError> {
        let mut objects = Vec::new();
        let mut names: Vec<String> = Vec::new();
        for (index, object) in root.children("objects")?.enumerate() {
            let object = object?;
            let name = match object.string("name")? {
                name if name.is_empty() => format!("object {}", index + 1),
                name => name,
            };
            if names.contains(&name) {
                let at = match object.map.contains_key("name") {
                    true => object.at("name"),
                    false => object.pointer.clone(),
                };
                self.note(at, NoticeKind::SameName { name: name.clone() });
            }
            names.push(name.clone());
            objects.extend(self.scene_object(index, name, &object)?);
        }
        Ok(objects)
    }

    fn scene_object(
        &mut self,
        index: usize,
        name: String,
        object: &Object<'_>,
    ) -> Result<Option<SceneObject>, DocumentError> {
        self.unknown_keys(object);
        // Only checked: nothing that is drawn depends on the group.
        object.string("group")?;
        let source = self.object_source(object)?;
        let placement = ObjectPlacement {
            at: self.vector(object, "at")?,
            rotate: self.rotation(object, "rotate")?,
            size: self.number(object, "size")?,
        };
        let is_file = matches!(source, Some(ObjectSource::File { .. }));
        let mut keys = ["at", "rotate", "size"].iter();
        let is_placed = !is_file || keys.any(|key| object.map.contains_key(*key));
        let color_srgb = self.color(object, "color", "the file's own")?;
        let inside_srgb = self.color(object, "inside", "the default")?;
        let opacity = self.number(object, "opacity")?;
        let gloss = self.number(object, "gloss")?;
        let enabled = object.flag("enabled")?;
        Ok(source.map(|source| SceneObject {
            index,
            name,
            source,
            placement: is_placed.then_some(placement),
            color_srgb,
            inside_srgb,
            opacity,
            gloss,
            enabled,
        }))
    }

    /// Where the triangles of an object come from; `None`, with a notice, if that is nothing that is known.
    fn object_source(
        &mut self,
        object: &Object<'_>,
    ) -> Result<Option<ObjectSource>, DocumentError> {
        let builtin = object.text("builtin")?;
        let (src, sha256) = (object.text("src")?, object.hash()?);
        let reading = self.reading_of_object(object)?;
        if let Some(name) = builtin {
            for key in ["src", "sha256"] {
                if object.map.contains_key(key) {
                    let taken = "the built-in object";
                    self.note(object.at(key), NoticeKind::LeftAside { taken });
                }
            }
            let mut known = SceneObject::BUILTINS.into_iter();
            let found = known.find(|known| *known == name);
            if found.is_none() {
                self.unknown_value(object.at("builtin"), name, "nothing");
            }
            return Ok(found.map(ObjectSource::Builtin));
        }
        if src.is_none() && sha256.is_none() {
            let what = "an object with none of `builtin`, `src` and `sha256` is";
            self.nothing(object, what);
            return Ok(None);
        }
        Ok(Some(ObjectSource::File {
            src: src.map(str::to_owned),
            sha256,
            reading,
        }))
    }

    /// An entry names nothing that could be drawn.
    fn nothing(&mut self, object: &Object<'_>, what: &'static str) {
        self.note(object.pointer.clone(), NoticeKind::NotDrawn { what });
    }
}
