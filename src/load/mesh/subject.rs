use std::sync::Arc;

use super::error::MeshError;
use super::options::MeshOptions;
use super::read::read_mesh;
use crate::data::{SubjectPart, SubjectSink, Surface, SurfaceError};
use crate::load::files::FileSet;
use crate::load::report::Warning;
use crate::load::{LoadError, LoadReport};

/// Part of the time that reading takes; preparing takes the rest.
const READING: f32 = 0.2;

/// Reads a mesh, prepares it to be drawn and hands it over. `smooth_degrees` as for [`Surface::new`].
///
/// # Errors
/// [`LoadError`], with name and place; also where the sink stops it.
pub fn read_mesh_subject(
    files: &mut dyn FileSet,
    name: &str,
    options: &MeshOptions,
    smooth_degrees: Option<f32>,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    let (mesh, found) = read_mesh(files, name, options, &mut |part| {
        sink.progress(READING * part)
    })
    .map_err(|error| match error {
        MeshError::File(error) => error,
        other => LoadError::Mesh {
            message: other.to_string(),
        },
    })?;
    report.sha256 = Some(found.sha256);
    let repaired = found.repair.phrases().join(", ");
    if !repaired.is_empty() {
        let what = format!("the mesh was repaired: {repaired}");
        report.warn(Warning::Mesh { what });
    }
    for aside in &found.aside {
        let what = aside.to_string();
        report.warn(Warning::Mesh { what });
    }
    let surface = Surface::new(&mesh, smooth_degrees, &mut |part| {
        sink.progress(READING + (1.0 - READING) * part)
    });
    let surface = surface.map_err(|error| match error {
        SurfaceError::NoSize => LoadError::Mesh {
            message: format!("{error} ({name})"),
        },
        SurfaceError::Stopped => LoadError::Cancelled,
    })?;
    let taken = sink.take(SubjectPart::Surface(Arc::new(surface)));
    taken.map_err(LoadError::refused(name))
}
