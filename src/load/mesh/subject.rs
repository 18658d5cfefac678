use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use super::options::MeshOptions;
use super::read::read_mesh;
use super::textures::{fit, notices, take_packed};
use crate::data::{Mesh, SubjectPart, SubjectSink, Surface, SurfaceError};
use crate::load::files::FileSet;
use crate::load::report::Warning;
use crate::load::{LoadError, LoadReport};
use crate::pictures::{Picture, decode};

/// Part of the time that reading takes; preparing takes the rest.
const READING: f32 = 0.2;

/// Name of a part that neither file nor document names.
const NAMELESS: &str = "surface";

/// A file of a subject of meshes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// Its name among the files.
    pub file: String,
    /// The author's name for it; may be empty.
    pub name: String,
    /// How it is read.
    pub options: MeshOptions,
    /// The crease angle, degrees; `None` takes the file's own normals.
    pub smooth_degrees: Option<f32>,
}

/// Meshes of a subject that have been read. Their pictures are still packed: what unpacks them is a program of its own
/// in the page.
#[derive(Debug)]
pub struct ReadMeshes {
    meshes: Vec<(Mesh, Option<f32>)>,
    /// How notices of each mesh begin.
    callings: Vec<String>,
    /// The name of the first file.
    first: String,
    /// Pictures that are to be unpacked: the index of the mesh, that of its texture, and the file of the picture.
    packed: Vec<(usize, usize, Vec<u8>)>,
}

/// Reads the meshes of a subject. The report's hash is that of the first file.
///
/// # Errors
/// [`LoadError`], with name and place; also where the sink stops it.
pub fn read_meshes(
    files: &mut dyn FileSet,
    meshes: &[MeshFile],
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<ReadMeshes, LoadError> {
    let mut read = ReadMeshes {
        meshes: Vec::new(),
        callings: Vec::new(),
        first: meshes
            .first()
            .map_or_else(String::new, |mesh| mesh.file.clone()),
        packed: Vec::new(),
    };
    let mut triangles = 0;
    for (k, entry) in meshes.iter().enumerate() {
        let options = MeshOptions {
            max_triangles: entry.options.max_triangles.saturating_sub(triangles),
            ..entry.options
        };
        let (mut mesh, found) = read_mesh(files, &entry.file, &options, &mut |part| {
            sink.progress(READING * (k as f32 + part) / meshes.len() as f32)
        })?;
        triangles += mesh.triangles.len() as u64;
        if k == 0 {
            report.sha256 = Some(found.sha256);
        }
        // Of several files each notice says which is meant.
        let of = match (meshes.len(), entry.name.as_str()) {
            (1, _) => String::new(),
            (_, "") => format!("mesh {}: ", k + 1),
            (_, name) => format!("{name}: "),
        };
        let repaired = found.repair.phrases().join(", ");
        if !repaired.is_empty() {
            let what = format!("{of}the mesh was repaired: {repaired}");
            report.warn(Warning::Mesh { what });
        }
        for aside in &found.aside {
            let what = format!("{of}{aside}");
            report.warn(Warning::Mesh { what });
        }
        let pictures = take_packed(&mut mesh).into_iter();
        read.packed
            .extend(pictures.map(|(texture, packed)| (k, texture, packed)));
        read.meshes.push((mesh, entry.smooth_degrees));
        read.callings.push(of);
    }
    name_parts(&mut read.meshes, meshes);
    Ok(read)
}

impl ReadMeshes {
    /// The file of a picture that is still packed, if there is one. What it holds goes to [`ReadMeshes::unpacked`].
    pub fn next_packed(&self) -> Option<&[u8]> {
        self.packed.last().map(|(_, _, packed)| packed.as_slice())
    }

    /// Takes what the file of [`ReadMeshes::next_packed`] holds, or, in words, why it could not be read: it is left
    /// aside then.
    pub fn unpacked(&mut self, outcome: Result<Picture, String>, report: &mut LoadReport) {
        let Some((mesh, texture, _)) = self.packed.pop() else {
            return;
        };
        match outcome {
            Ok(mut picture) => {
                picture.make_opaque();
                self.meshes[mesh].0.textures[texture].picture = Some(picture);
                let textures = self
                    .meshes
                    .iter_mut()
                    .flat_map(|(mesh, _)| &mut mesh.textures);
                let mut pictures: Vec<&mut Picture> = textures
                    .filter_map(|texture| texture.picture.as_mut())
                    .collect();
                fit(&mut pictures);
            }
            Err(why) => {
                let what = format!("{}a texture is left aside: {why}", self.callings[mesh]);
                report.warn(Warning::Mesh { what });
            }
        }
    }

    /// Prepares the meshes to be drawn as one and hands them over. `within` as for [`Surface::of`].
    ///
    /// # Errors
    /// [`LoadError`]; also where the sink stops it.
    pub fn prepare(
        self,
        within: Option<[DVec3; 2]>,
        sink: &mut dyn SubjectSink,
        report: &mut LoadReport,
    ) -> Result<(), LoadError> {
        for ((mesh, _), of) in self.meshes.iter().zip(&self.callings) {
            for aside in mesh.textures.iter().flat_map(notices) {
                let what = format!("{of}{aside}");
                report.warn(Warning::Mesh { what });
            }
        }
        let meshes: Vec<(&Mesh, Option<f32>)> =
            self.meshes.iter().map(|(mesh, s)| (mesh, *s)).collect();
        let surface = Surface::of(&meshes, within, &mut |part| {
            sink.progress(READING + (1.0 - READING) * part)
        });
        let first = self.first.as_str();
        let surface = surface.map_err(|error| match error {
            SurfaceError::NoSize | SurfaceError::FarFromBox => LoadError::Mesh {
                message: format!("{error} ({first})"),
            },
            SurfaceError::Stopped => LoadError::Cancelled,
        })?;
        let taken = sink.take(SubjectPart::Surface(Arc::new(surface)));
        taken.map_err(LoadError::refused(first))
    }
}

/// Reads the meshes of a subject, prepares them to be drawn as one and hands them over. The report's hash is that of
/// the first file. `within` as for [`Surface::of`].
///
/// # Errors
/// [`LoadError`], with name and place; also where the sink stops it.
pub fn read_mesh_subject(
    files: &mut dyn FileSet,
    meshes: &[MeshFile],
    within: Option<[DVec3; 2]>,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let mut read = read_meshes(files, meshes, sink, report)?;
    while let Some(packed) = read.next_packed() {
        let outcome = decode(packed).map_err(|error| error.to_string());
        read.unpacked(outcome, report);
        if !sink.progress(READING) {
            return Err(LoadError::Cancelled);
        }
    }
    read.prepare(within, sink, report)
}

/// Names the parts of all files (spec/surfaces.md, `subject.meshes`): of a file with one part by the author's name for
/// it, of others by the file's names, behind the author's where there are several files. No two are alike.
fn name_parts(read: &mut [(Mesh, Option<f32>)], meshes: &[MeshFile]) {
    let are_several = meshes.len() > 1;
    let mut taken = BTreeSet::new();
    for ((mesh, _), entry) in read.iter_mut().zip(meshes) {
        let is_one = mesh.parts.len() == 1;
        for part in &mut mesh.parts {
            let own = std::mem::take(&mut part.name);
            let wanted = match (is_one, entry.name.as_str()) {
                (true, "") => NAMELESS.to_owned(),
                (true, name) => name.to_owned(),
                (false, name) if are_several && !name.is_empty() => format!("{name} {own}"),
                (false, _) => own,
            };
            let numbered = (2..).map(|number| format!("{wanted} {number}"));
            let mut names = std::iter::once(wanted.clone()).chain(numbered);
            // There is always another number.
            part.name = names.find(|name| !taken.contains(name)).unwrap_or_default();
            taken.insert(part.name.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::MemoryFiles;

    struct Taken(Option<Arc<Surface>>);

    impl SubjectSink for Taken {
        fn take(&mut self, part: SubjectPart) -> Result<(), String> {
            if let SubjectPart::Surface(surface) = part {
                self.0 = Some(surface);
            }
            Ok(())
        }

        fn progress(&mut self, _fraction: f32) -> bool {
            true
        }
    }

    /// Triangles of 10 mm beside each other, an OBJ part each.
    fn obj(parts: &[&str], x: f32) -> Vec<u8> {
        let mut text = String::new();
        for (name, k) in parts.iter().zip(0..) {
            let y = 20 * k;
            text += &format!(
                "o {name}\nv {x} {y} 0\nv {} {y} 0\nv {x} {} 0\n",
                x + 10.0,
                y + 10
            );
            text += &format!("f {} {} {}\n", 3 * k + 1, 3 * k + 2, 3 * k + 3);
        }
        text.into_bytes()
    }

    fn read(
        meshes: &[(&str, &[&str], &str)],
        within: Option<[DVec3; 2]>,
    ) -> Result<Arc<Surface>, LoadError> {
        let contents = meshes
            .iter()
            .zip(0..)
            .map(|((file, parts, _), k)| (*file, obj(parts, 30.0 * k as f32)));
        let mut files = MemoryFiles::new(contents);
        let entries: Vec<MeshFile> = meshes
            .iter()
            .map(|(file, _, name)| MeshFile {
                file: (*file).to_owned(),
                name: (*name).to_owned(),
                options: MeshOptions {
                    axes: Some(crate::load::Axes::Ras),
                    ..MeshOptions::default()
                },
                smooth_degrees: None,
            })
            .collect();
        let (mut taken, mut report) = (Taken(None), LoadReport::default());
        read_mesh_subject(&mut files, &entries, within, &mut taken, &mut report)?;
        Ok(taken.0.expect("it came"))
    }

    fn names(surface: &Surface) -> Vec<&str> {
        surface
            .segments
            .iter()
            .map(|segment| segment.name.as_str())
            .collect()
    }

    #[test]
    fn parts_are_named_by_author_and_file() {
        let one = read(&[("a.obj", &["left"], "talus")], None).expect("a mesh");
        assert_eq!(names(&one), ["talus"]);
        let one = read(&[("a.obj", &["left", "right"], "talus")], None).expect("a mesh");
        assert_eq!(names(&one), ["left", "right"]);
        let several = read(
            &[
                ("a.obj", &["left", "right"], "talus"),
                ("b.obj", &["x"], "skin"),
                ("c.obj", &["x"], "skin"),
                ("d.obj", &["y"], ""),
            ],
            None,
        );
        let several = several.expect("meshes");
        assert_eq!(
            names(&several),
            ["talus left", "talus right", "skin", "skin 2", "surface"]
        );
    }

    #[test]
    fn the_box_of_all_or_of_the_document_gives_the_unit() {
        let both: [(&str, &[&str], &str); 2] = [("a.obj", &["a"], "a"), ("b.obj", &["b"], "b")];
        let all = read(&both, None).expect("meshes");
        assert_eq!(all.frame.mm_per_unit, 40.0);
        assert!((all.frame.middle_mm - DVec3::new(20.0, 5.0, 0.0)).length() < 1e-9);
        let alone = read(&both[..1], None).expect("a mesh");
        let kept = read(&both, Some([DVec3::ZERO, DVec3::new(10.0, 10.0, 0.0)])).expect("meshes");
        assert_eq!(kept.frame.mm_per_unit, 10.0);
        let of_first = |surface: &Surface| {
            let own = surface.triangles.iter().zip(&surface.owners);
            own.filter(|(_, segment)| **segment == 0)
                .map(|(t, _)| t.0)
                .next()
        };
        assert_eq!(
            of_first(&kept),
            of_first(&alone),
            "a second mesh moves nothing"
        );
        assert!(
            (kept.frame.bounds.max.x - 3.5).abs() < 1e-5,
            "{:?}",
            kept.frame.bounds
        );
        let far = read(&both, Some([DVec3::ZERO, DVec3::splat(0.01)]));
        assert!(matches!(far, Err(LoadError::Mesh { .. })), "{far:?}");
    }
}
