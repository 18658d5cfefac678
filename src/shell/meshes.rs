//! Loads of meshes, from their description to the events that the app waits for.

use std::sync::Arc;

use glam::DVec3;

use super::loading::{Post, PostingSink, hash_of, is_mesh_file, read_scan, read_scan_file};
use crate::assets::LoadEvent;
use crate::data::{SubjectPart, SubjectSink, Surface, VolumeLimits};
use crate::document::{MeshReading, MeshRef, Reading};
use crate::load::{
    FileSet, LoadError, LoadReport, MeshFile, MeshOptions, Warning, read_mesh_subject,
};
use crate::subjects::{SubjectError, mesh, tool};

/// Reads a subject from a file, a scan or meshes, and posts its pieces and how the load ended.
pub fn read_file(
    files: &mut dyn FileSet,
    name: &str,
    limits: VolumeLimits,
    reading: &Reading,
    post: &mut dyn Post,
) {
    match is_mesh_file(files, name, reading) {
        Ok(false) => read_scan_file(files, name, limits, reading, post),
        is_mesh => {
            let mut sink = PostingSink::new(post);
            let mut report = LoadReport::default();
            let outcome =
                is_mesh.and_then(|_| read_meshes(files, name, reading, &mut sink, &mut report));
            sink.end(outcome, &report, None);
        }
    }
}

/// Reads a subject, a scan or meshes, as its document says.
///
/// # Errors
/// As [`read_scan`] and [`read_mesh_subject`].
pub fn read_any(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    match is_mesh_file(files, name, reading)? {
        true => read_meshes(files, name, reading, sink, report),
        false => read_scan(files, name, reading, sink, report),
    }
}

fn read_meshes(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let meshes = mesh_files(files, name, reading, report)?;
    let mut finishing = Finishing::new(sink, reading.carves, reading.sweeps);
    read_mesh_subject(files, &meshes, box_of(reading), finishing.sink(), report)
}

/// The box that takes the place of that of all vertices, if the document has one.
pub(super) fn box_of(reading: &Reading) -> Option<[DVec3; 2]> {
    reading.bounds.map(|bounds| [bounds.min_mm, bounds.max_mm])
}

/// Makes a built-in subject that is a mesh, or a tool; `carves`: one that a template carves by.
pub fn make_mesh(name: &str, carves: bool, post: &mut dyn Post) {
    let Some(mesh) = mesh(name).or_else(|| tool(name)) else {
        post.post(LoadEvent::Failed {
            message: SubjectError::UnknownName(name.chars().take(40).collect()).to_string(),
            details: String::new(),
            fault: None,
        });
        return;
    };
    let mut sink = PostingSink::new(post);
    let mut finishing = Finishing::new(&mut sink, carves, false);
    let sink = finishing.sink();
    let surface = Surface::new(&mesh, None, &mut |part| sink.progress(part));
    let part = surface.map(|surface| SubjectPart::Surface(Arc::new(surface)));
    let is_whole = part.is_ok_and(|part| sink.take(part).is_ok());
    post.post(match is_whole {
        true => LoadEvent::Done { sha256: None },
        // A mesh of the program's own has a size.
        false => LoadEvent::Cancelled,
    });
}

/// Passes on the surface of an object with what a template `carve` reads of it, and that of a tool with its grid of
/// distances.
pub(super) struct Finishing<'a> {
    behind: &'a mut dyn SubjectSink,
    carves: bool,
    sweeps: bool,
}

impl<'a> Finishing<'a> {
    /// Part of the work that is done when there is a surface.
    const SURFACE: f32 = 0.5;

    pub(super) fn new(behind: &'a mut dyn SubjectSink, carves: bool, sweeps: bool) -> Self {
        Self {
            behind,
            carves,
            sweeps,
        }
    }

    /// This one where there is something to be made besides, else the sink behind it.
    pub(super) fn sink(&mut self) -> &mut dyn SubjectSink {
        match self.carves || self.sweeps {
            true => self,
            false => self.behind,
        }
    }
}

impl SubjectSink for Finishing<'_> {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        let SubjectPart::Surface(surface) = part else {
            return self.behind.take(part);
        };
        let mut go_on = |part| {
            self.behind
                .progress(Self::SURFACE + (1.0 - Self::SURFACE) * part)
        };
        let mut made = Ok(Arc::unwrap_or_clone(surface));
        if self.carves {
            made = made.and_then(|surface| surface.carving(&mut go_on));
        }
        if self.sweeps {
            made = made.and_then(|surface| surface.sweeping(&mut go_on));
        }
        let surface = made.map_err(|stopped| stopped.to_string())?;
        self.behind.take(SubjectPart::Surface(Arc::new(surface)))
    }

    fn progress(&mut self, fraction: f32) -> bool {
        self.behind.progress(Self::SURFACE * fraction)
    }
}

/// The files of a subject of meshes, `name` that of the first: by their addresses, by the last parts of those, or by
/// their hashes among all files. One that is not there is left out where the document says how large the subject is,
/// and missed where it does not.
pub(super) fn mesh_files(
    files: &mut dyn FileSet,
    name: &str,
    reading: &Reading,
    report: &mut LoadReport,
) -> Result<Vec<MeshFile>, LoadError> {
    let file_of = |file: String, name: &str, mesh: &MeshReading| MeshFile {
        file,
        name: name.to_owned(),
        options: MeshOptions::from(mesh),
        smooth_degrees: mesh.smooth_deg,
    };
    let called = reading.meshes.first().map_or("", |mesh| mesh.name.as_str());
    let mut found = vec![file_of(name.to_owned(), called, &reading.mesh)];
    let mut missing = Vec::new();
    for mesh in reading.meshes.iter().skip(1) {
        match find_mesh(files, mesh) {
            Some(file) => found.push(file_of(file, &mesh.name, &mesh.reading)),
            None => missing.push(match (mesh.name.as_str(), &mesh.src, &mesh.sha256) {
                ("", Some(src), _) => src.clone(),
                ("", None, hash) => format!("SHA-256 {}", hash.as_deref().unwrap_or_default()),
                (name, ..) => name.to_owned(),
            }),
        }
    }
    let list = missing.join(", ");
    match (missing.is_empty(), reading.bounds) {
        (true, _) => {}
        (false, Some(_)) => report.warn(Warning::Mesh {
            what: format!("meshes of the subject that are not there are left out: {list}"),
        }),
        (false, None) => {
            return Err(LoadError::Mesh {
                message: format!(
                    "meshes of the subject are not there, and without `subject.box` nothing is drawn: {list}"
                ),
            });
        }
    }
    Ok(found)
}

fn find_mesh(files: &mut dyn FileSet, mesh: &MeshRef) -> Option<String> {
    if let Some(src) = &mesh.src {
        let last = src.rsplit('/').next().unwrap_or_default();
        let names = [src.as_str(), last];
        let found = names.into_iter().find(|name| files.open(name).is_ok());
        return found.map(str::to_owned);
    }
    let wanted = mesh.sha256.as_ref()?;
    let mut names = files.names().into_iter();
    names.find(|name| hash_of(files, name).is_some_and(|hash| hash.eq_ignore_ascii_case(wanted)))
}
