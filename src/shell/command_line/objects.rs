//! Objects of the scene for the command line: generated, or read from local files.

use std::path::Path;
use std::sync::Arc;

use super::args::Common;
use super::error::{CliError, MissingSubject};
use super::output::notice;
use super::subject::{mesh_data, path_of, report_missing, surface_of};
use crate::assets::{Assets, Data, Role, Source, Want, Wanted};
use crate::data::{ObjectMeshes, Surface};
use crate::document::Illustration;
use crate::subjects::{SubjectError, tool};

/// Which objects of a document are needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Needed {
    /// Those that are seen.
    All,
    /// Those that templates carve by.
    Carving,
}

/// The meshes of a document's objects, besides those that are there. A notice names those whose files are not there;
/// they are left out.
///
/// # Errors
/// [`CliError::Subject`] if a file cannot be read, is no mesh, or is another one than the document means.
pub(super) fn objects_of(
    illustration: &Illustration,
    needed: Needed,
    here: ObjectMeshes,
    (common, folder): (&Common, &Path),
) -> Result<ObjectMeshes, CliError> {
    let mut assets = Assets::default();
    let is_here = |want: &Want| {
        let mut objects = illustration.objects.iter();
        objects.any(|object| {
            here.iter().any(|(source, _)| *source == object.source)
                && Want::object(object, illustration).is_some_and(|other| other.is_same_mesh(want))
        })
    };
    for want in Wanted::of(illustration).0 {
        let is_needed = needed == Needed::All || want.reading.carves;
        if want.role != Role::Object || !is_needed || is_here(&want) {
            continue;
        }
        match &want.source {
            Source::Builtin { name, .. } => {
                let data = Data::Object {
                    mesh: generated(name, want.reading.carves)?,
                    sha256: None,
                };
                // What is generated has no hash that could be another one.
                let _always_taken = assets.take(&want, data);
            }
            // No object is one.
            Source::Clay(_) => {}
            Source::File { .. } => {
                let Some(path) = path_of(&want, common, folder) else {
                    report_missing("object", &want, folder);
                    continue;
                };
                let data = mesh_data(&path, &want, folder, &[], "an object")?;
                let taken = assets.take(&want, data);
                taken.map_err(|other| MissingSubject::other(&path, other))?;
            }
        }
    }
    let (resources, news) = assets.resources(illustration);
    news.iter().for_each(notice);
    Ok(here.into_iter().chain(resources.objects).collect())
}

/// A tool that the program generates; `carves`: one that a template carves by.
///
/// # Errors
/// [`SubjectError::UnknownName`].
pub(super) fn generated(name: &str, carves: bool) -> Result<Arc<Surface>, MissingSubject> {
    let mesh = tool(name).ok_or_else(|| SubjectError::UnknownName(name.to_owned()))?;
    let surface = surface_of(&mesh)?;
    if !carves {
        return Ok(surface);
    }
    let surface = Arc::unwrap_or_clone(surface).carving(&mut |_| true);
    let surface = surface.map_err(|error| SubjectError::Refused(error.to_string()))?;
    Ok(Arc::new(surface))
}
