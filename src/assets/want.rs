use std::sync::Arc;

use crate::data::MeshGrids;
use crate::document::{
    Clay, FieldRef, Illustration, MeshAxes, MeshReading, MeshRef, ObjectSource, Reading,
    SceneObject, SegmentsRef, SubjectBox, SubjectRef, TemplateData, ToolFile,
};
use crate::load::MeshOptions;

/// The use that a document makes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The subject of the document.
    Subject,
    /// A label volume beside the subject.
    Segments,
    /// A displacement field of a template.
    Field,
    /// A mesh of the subject besides the file of [`Role::Subject`].
    Mesh,
    /// An object of the scene.
    Object,
    /// The mesh of a tool, of a template or of a clay.
    Tool,
}

/// Where the data for a want come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// Made by the program.
    Builtin {
        /// The name of the subject or the tool.
        name: String,
        /// Which of its revisions, from 1.
        revision: u32,
    },
    /// Shaped by the program, stroke by stroke; it may begin with a file.
    Clay(Arc<Clay>),
    /// A file. One without an address is supplied by the reader, who is asked for it by the author's name.
    File {
        /// Address, relative to the document or absolute, as written in the document.
        src: Option<String>,
        /// SHA-256 of its bytes, lower-case hex.
        sha256: Option<String>,
        /// The author's name for the file; may be empty.
        name: String,
    },
}

/// One file or built-in subject that a document needs from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Want {
    /// The use that the document makes of the file.
    pub role: Role,
    /// Where the file or the subject comes from.
    pub source: Source,
    /// Which volume of the file is meant, how bare voxels lie, and how a mesh is read; the default for label volumes
    /// and fields.
    pub reading: Reading,
    /// Of a clay the grids of its tools that are meshes, as far as they are there.
    pub meshes: MeshGrids,
    /// The clay is still being shaped, and wanted soon: see [`Surface::sketch_of`](crate::data::Surface::sketch_of).
    pub is_sketch: bool,
}

/// The hash of an arrived file is not the one in the document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("another file than the document means: its SHA-256 is {found}, wanted is {wanted}")]
pub struct OtherFile {
    /// SHA-256 in the document.
    pub wanted: String,
    /// SHA-256 of the bytes that came.
    pub found: String,
}

impl Want {
    /// The subject of a document. Of meshes alone it is the first, which is read together with the others.
    pub fn subject(subject: &SubjectRef) -> Self {
        let mut reading = subject.reading().cloned().unwrap_or_default();
        let source = match subject {
            SubjectRef::Meshes { meshes, bounds } => {
                let first = meshes.first();
                reading.mesh = first.map(|mesh| mesh.reading).unwrap_or_default();
                reading.bounds = *bounds;
                if meshes.len() > 1 {
                    reading.meshes.clone_from(meshes);
                }
                Source::File {
                    src: first.and_then(|mesh| mesh.src.clone()),
                    sha256: first.and_then(|mesh| mesh.sha256.clone()),
                    name: first.map(|mesh| mesh.name.clone()).unwrap_or_default(),
                }
            }
            SubjectRef::Builtin { name, revision } => Source::Builtin {
                name: name.clone(),
                revision: *revision,
            },
            SubjectRef::Clay(clay) => Source::Clay(Arc::clone(clay)),
            SubjectRef::Address {
                src, sha256, name, ..
            } => Source::File {
                src: Some(src.clone()),
                sha256: sha256.clone(),
                name: name.clone(),
            },
            SubjectRef::Supplied { sha256, name, .. } => Source::File {
                src: None,
                sha256: Some(sha256.clone()),
                name: name.clone(),
            },
        };
        Self {
            role: Role::Subject,
            source,
            reading,
            meshes: Vec::new(),
            is_sketch: false,
        }
    }

    /// A label volume; `None` where a document only names segments of the subject's own file.
    pub fn segments(segments: &SegmentsRef) -> Option<Self> {
        let SegmentsRef { src, sha256, .. } = segments;
        Self::file(Role::Segments, src, sha256, "", MeshReading::default())
    }

    /// A displacement field; `None` where the template names no file.
    pub fn field(field: &FieldRef) -> Option<Self> {
        let FieldRef {
            src, sha256, name, ..
        } = field;
        Self::file(Role::Field, src, sha256, name, MeshReading::default())
    }

    /// A mesh of the subject; `None` where the document names no file.
    pub fn mesh(mesh: &MeshRef) -> Option<Self> {
        let MeshRef {
            src, sha256, name, ..
        } = mesh;
        Self::file(Role::Mesh, src, sha256, name, mesh.reading)
    }

    /// The mesh of a tool, with the axes that its file has; `None` where the tool names no file, or is left out.
    pub fn tool(tool: &ToolFile) -> Option<Self> {
        tool.key()?;
        let ToolFile {
            src, sha256, name, ..
        } = tool;
        let mesh = MeshReading {
            axes: Some(MeshAxes::Ras),
            ..MeshReading::default()
        };
        let want = Self::file(Role::Tool, src, sha256, name, mesh)?;
        Some(Self {
            reading: Reading {
                sweeps: true,
                ..want.reading
            },
            ..want
        })
    }

    /// All meshes beside a volume, in one: they are read together, off the picture's thread. The first of them is the
    /// one that has to be there; `bounds` is the volume's box. `None` where no mesh names a file.
    pub fn meshes(meshes: &[MeshRef], bounds: SubjectBox) -> Option<Self> {
        let mut want = Self::mesh(meshes.first()?)?;
        want.reading.bounds = Some(bounds);
        if meshes.len() > 1 {
            want.reading.meshes = meshes.to_vec();
        }
        Some(want)
    }

    /// True if a mesh that is read for this want is the file of this hash, lower-case hex.
    pub fn reads(&self, sha256: &str) -> bool {
        let all = self.reading.meshes.iter();
        let mut hashes = all
            .filter_map(|mesh| mesh.sha256.as_deref())
            .chain(self.sha256());
        hashes.any(|own| own.eq_ignore_ascii_case(sha256))
    }

    /// The mesh of an object of an illustration, with what carving takes if templates carve by it; `None` where the
    /// document names no file.
    pub fn object(object: &SceneObject, illustration: &Illustration) -> Option<Self> {
        let want = match &object.source {
            ObjectSource::Builtin(name) => Self {
                role: Role::Object,
                source: Source::Builtin {
                    name: (*name).to_owned(),
                    revision: 1,
                },
                reading: Reading::default(),
                meshes: Vec::new(),
                is_sketch: false,
            },
            ObjectSource::File {
                src,
                sha256,
                reading,
            } => Self::file(Role::Object, src, sha256, &object.name, *reading)?,
        };
        Some(Self {
            reading: Reading {
                carves: illustration.carves_by(&object.source),
                ..want.reading
            },
            ..want
        })
    }

    fn file(
        role: Role,
        src: &Option<String>,
        sha256: &Option<String>,
        name: &str,
        mesh: MeshReading,
    ) -> Option<Self> {
        (src.is_some() || sha256.is_some()).then(|| Self {
            role,
            source: Source::File {
                src: src.clone(),
                sha256: sha256.clone(),
                name: name.to_owned(),
            },
            reading: Reading {
                mesh,
                ..Reading::default()
            },
            meshes: Vec::new(),
            is_sketch: false,
        })
    }

    /// How the file is read if it holds a mesh, of at most this many triangles.
    pub fn mesh_options(&self, max_triangles: u64) -> MeshOptions {
        MeshOptions {
            max_triangles,
            ..MeshOptions::from(&self.reading.mesh)
        }
    }

    /// True if both mean one file, read in one way, in one role, whatever they call it and whether or not it carves.
    pub fn is_same_mesh(&self, other: &Self) -> bool {
        let is_same_source = match (&self.source, &other.source) {
            (Source::Builtin { .. }, Source::Builtin { .. }) => self.source == other.source,
            (Source::File { .. }, Source::File { .. }) => {
                self.src() == other.src() && self.sha256() == other.sha256()
            }
            _ => false,
        };
        let reading = Reading {
            carves: self.reading.carves,
            ..other.reading.clone()
        };
        self.role == other.role && is_same_source && self.reading == reading
    }

    /// The name that the reader is asked for the file by, or that of what the program makes.
    pub fn name(&self) -> &str {
        match &self.source {
            Source::Builtin { name, .. } | Source::File { name, .. } => name,
            Source::Clay(clay) => clay.file().map_or("clay", |file| file.name),
        }
    }

    /// The recipe of a clay.
    pub fn clay(&self) -> Option<&Arc<Clay>> {
        match &self.source {
            Source::Clay(clay) => Some(clay),
            Source::Builtin { .. } | Source::File { .. } => None,
        }
    }

    /// Address of the file, as written in the document; `None` without one.
    pub fn src(&self) -> Option<&str> {
        match &self.source {
            Source::Builtin { .. } => None,
            Source::Clay(clay) => clay.file()?.src,
            Source::File { src, .. } => src.as_deref(),
        }
    }

    /// SHA-256 that the document gives.
    pub fn sha256(&self) -> Option<&str> {
        match &self.source {
            Source::Builtin { .. } => None,
            Source::Clay(clay) => clay.file()?.sha256,
            Source::File { sha256, .. } => sha256.as_deref(),
        }
    }

    /// True if the reader has to supply its file: it has a hash and no address.
    pub fn is_supplied(&self) -> bool {
        self.src().is_none() && self.sha256().is_some()
    }

    /// True if it needs a file, at an address or from the reader.
    pub fn has_file(&self) -> bool {
        self.src().is_some() || self.is_supplied()
    }

    /// Accepts a file of this hash, lower-case hex.
    ///
    /// # Errors
    /// [`OtherFile`] with both hashes if the document gives another one.
    pub fn check(&self, found: &str) -> Result<(), OtherFile> {
        match self.sha256() {
            Some(wanted) if !wanted.eq_ignore_ascii_case(found) => Err(OtherFile {
                wanted: wanted.to_owned(),
                found: found.to_owned(),
            }),
            _ => Ok(()),
        }
    }
}

/// Everything that an illustration needs from outside: its subject first, then label volumes, then fields of templates
/// that act, then further meshes of the subject, objects and meshes of tools. A file that is meant twice and read in
/// one way is wanted once in each role.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted(pub Vec<Want>);

impl Wanted {
    /// What this illustration names.
    pub fn of(illustration: &Illustration) -> Self {
        let mut wants = vec![Want::subject(&illustration.subject_shown())];
        wants.extend(illustration.segments.iter().filter_map(Want::segments));
        for template in illustration.templates.iter().filter(|t| t.enabled) {
            if let TemplateData::Field(field) = &template.data
                && let Some(want) = Want::field(field)
                && !wants.contains(&want)
            {
                wants.push(want);
            }
        }
        let meshes = illustration.meshes_beside.iter();
        let objects = illustration.objects.iter().filter(|o| o.enabled);
        let object = |object| Want::object(object, illustration);
        let tools = tool_files(illustration);
        let further = meshes.map(Want::mesh).chain(objects.map(object));
        let further = further.chain(tools.into_iter().map(|(_, file)| Want::tool(file)));
        for want in further.flatten() {
            if !wants.contains(&want) {
                wants.push(want);
            }
        }
        Self(wants)
    }
}

/// The files of the tools that act, of a clay and of templates, each with the pointer of its tool.
pub fn tool_files(illustration: &Illustration) -> Vec<(String, &ToolFile)> {
    let mut files = Vec::new();
    if let SubjectRef::Clay(clay) = &illustration.subject {
        let tools = clay.tools.iter().enumerate();
        files.extend(tools.filter_map(|(i, tool)| {
            let file = tool.shape.as_ref()?.file()?;
            Some((format!("/subject/clay/tools/{i}"), file))
        }));
    }
    for template in illustration.templates.iter().filter(|t| t.enabled) {
        if let TemplateData::Tools(tools) = &template.data {
            files.extend(tools.acting().filter_map(|tool| {
                let file = tool.shape.as_ref()?.file()?;
                let at = format!("/templates/{}/params/tools/{}", template.index, tool.index);
                Some((at, file))
            }));
        }
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::load::{Axes, PartsMode, Units};

    fn wanted(json: &str) -> Vec<Want> {
        let document = Document::from_json(json).expect("a document");
        Wanted::of(document.illustration()).0
    }

    #[test]
    fn every_mesh_and_object_is_wanted_once() {
        let text = r#"{ "fabrica": 1, "subject": { "meshes": [
            { "src": "talus.stl", "units": "cm", "parts": "pieces" }, { "sha256": "HASH", "name": "skin", "axes": "lps" },
            { "sha256": "HASH", "name": "skin", "axes": "lps" }, { "src": "talus.stl" } ] },
            "objects": [ { "builtin": "needle" }, { "src": "plate.obj", "name": "plate", "units": "in" },
            { "src": "off.obj", "enabled": false } ] }"#;
        let wants = wanted(&text.replace("HASH", &"0a".repeat(32)));
        let roles: Vec<(Role, Option<&str>)> = wants.iter().map(|w| (w.role, w.src())).collect();
        let expected = [
            (Role::Subject, Some("talus.stl")),
            (Role::Object, None),
            (Role::Object, Some("plate.obj")),
        ];
        assert_eq!(roles, expected);
        let options = wants[0].mesh_options(7);
        assert_eq!(options.units, Some(Units::Centimetre));
        assert_eq!(
            (options.parts, options.max_triangles),
            (PartsMode::Pieces, 7)
        );
        let read_with_it = &wants[0].reading.meshes;
        assert_eq!(read_with_it.len(), 4, "all are one subject");
        assert_eq!(read_with_it[3].src.as_deref(), Some("talus.stl"));
        assert_eq!(wants[1].source, builtin("needle"));
        assert_eq!(wants[2].mesh_options(7).units, Some(Units::Inch));
        let Source::File { name, .. } = &wants[2].source else {
            panic!("a file");
        };
        assert_eq!(name, "plate", "by this name the reader is asked for it");
    }

    #[test]
    fn meshes_of_tools_are_wanted_once() {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "tools": [
            { "shape": "mesh", "src": "a.stl" }, { "shape": "mesh" }, {}] } }, "templates": [
            { "kind": "sweep", "params": { "tools": [{ "shape": "mesh", "src": "a.stl", "longest": 1 },
                { "shape": "mesh", "sha256": "HASH", "name": "tooth" }] } },
            { "kind": "sweep", "enabled": false, "params": { "tools": [{ "shape": "mesh", "src": "off.stl" }] } }] }"#;
        let wants = wanted(&text.replace("HASH", &"0a".repeat(32)));
        let roles: Vec<(Role, &str)> = wants.iter().map(|want| (want.role, want.name())).collect();
        assert_eq!(
            roles,
            [
                (Role::Subject, "clay"),
                (Role::Tool, ""),
                (Role::Tool, "tooth")
            ]
        );
        assert!(wants[1].reading.sweeps && wants[2].is_supplied());
        // Neither the unit nor the axes of its format matter.
        assert_eq!(wants[1].mesh_options(7).axes, Some(Axes::Ras));
    }

    fn builtin(name: &str) -> Source {
        let name = name.to_owned();
        Source::Builtin { name, revision: 1 }
    }

    #[test]
    fn beside_a_subject_all_meshes_are_wanted() {
        let wants = wanted(
            r#"{ "fabrica": 1, "subject": { "builtin": "head", "meshes": [{ "src": "a.stl" }] } }"#,
        );
        let roles: Vec<Role> = wants.iter().map(|want| want.role).collect();
        assert_eq!(roles, [Role::Subject, Role::Mesh]);
        assert_eq!(wants[0].source, builtin("head"));
    }
}
