//! Objects of the scene for the command line: generated, or read from local files.

use std::path::Path;
use std::sync::Arc;

use super::args::Common;
use super::error::{CliError, MissingSubject};
use super::subject::{mesh_data, path_of, report_missing, surface_of};
use crate::assets::{Assets, Data, Role, Source, Wanted};
use crate::data::{ObjectMeshes, Surface};
use crate::document::Illustration;
use crate::subjects::{SubjectError, tool};

/// The meshes of a document's objects. A notice names those whose files are not there; they are left out.
///
/// # Errors
/// [`CliError::Subject`] if a file cannot be read, is no mesh, or is another one than the document means.
pub(super) fn objects_of(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
) -> Result<ObjectMeshes, CliError> {
    let mut assets = Assets::default();
    for want in Wanted::of(illustration).0 {
        if want.role != Role::Object {
            continue;
        }
        match &want.source {
            Source::Builtin(name) => {
                let data = Data::Object {
                    mesh: generated(name)?,
                    sha256: None,
                };
                // What is generated has no hash that could be another one.
                let _always_taken = assets.take(&want, data);
            }
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
    Ok(assets.resources(illustration).0.objects)
}

/// A tool that the program generates.
///
/// # Errors
/// [`SubjectError::UnknownName`].
pub(super) fn generated(name: &str) -> Result<Arc<Surface>, MissingSubject> {
    let mesh = tool(name).ok_or_else(|| SubjectError::UnknownName(name.to_owned()))?;
    surface_of(&mesh)
}
