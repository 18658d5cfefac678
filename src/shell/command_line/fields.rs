//! Displacement fields for the command line: read for the `field` templates of a document.

use std::path::{Path, PathBuf};

use super::args::Common;
use super::error::CliError;
use super::output::notice;
use super::subject::{subject_of, tool_grids};
use crate::assets::{Assets, Data, ResourceNews, Want, tool_files};
use crate::data::{Grid, Grids, Resources, VolumeLimits};
use crate::document::{Illustration, SubjectRef, TemplateData};
use crate::load::{FieldFile, read_field};
use crate::shell::files::{Folder, local};
use crate::subjects::{FINE_RESOLUTION, Generator};

/// The samples of each `field` template that acts, the grids of tools that are meshes, and the recipe of a clay, which
/// captions go with.
///
/// # Errors
/// [`CliError::Field`] with the template's pointer.
pub(super) fn fields_of(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
) -> Result<Resources, CliError> {
    let mut assets = Assets::default();
    let mut paths = Vec::new();
    for template in illustration.templates.iter().filter(|t| t.enabled) {
        let TemplateData::Field(field) = &template.data else {
            continue;
        };
        let place = format!("/templates/{}", template.index);
        let failed = |why: String| CliError::Field(format!("{place}: {why}"));
        let Some(want) = Want::field(field) else {
            notice(format!("{place}: the field names no file; it is not drawn"));
            continue;
        };
        let (path, file) = file_of(&want, folder, &common.field).map_err(failed)?;
        let taken = assets.take(&want, Data::Field(file));
        taken.map_err(|other| failed(format!("{} is {other}", path.display())))?;
        paths.push((template.index, path));
    }
    let clay = Want::subject(&illustration.subject_shown()).clay().cloned();
    let files = tool_files(illustration);
    let files = files.iter().map(|(_, file)| *file);
    let grids = Grids {
        files: tool_grids(files, (common, folder), true)?,
        baked: Vec::new(),
    };
    if paths.is_empty() {
        return Ok(Resources {
            clay,
            grids,
            ..Resources::default()
        });
    }
    assets.set_grid(subject_grid(illustration, common, folder)?);
    let (resources, news) = assets.resources(illustration);
    for news in news {
        match news {
            ResourceNews::NoSegment { .. }
            | ResourceNews::MeshesKept
            | ResourceNews::FieldNotice { .. }
            | ResourceNews::TooThin { .. }
            | ResourceNews::ToolIsSheet { .. } => notice(news),
            ResourceNews::FieldRefused { template, .. } => {
                let path = paths.iter().find(|(index, _)| *index == template);
                let path = path.map(|(_, path)| path.display().to_string());
                let path = path.unwrap_or_default();
                return Err(CliError::Field(format!("{news} ({path})")));
            }
        }
    }
    Ok(Resources {
        clay,
        grids,
        ..resources
    })
}

/// The file of a field: at its address, else the one of those given that has its hash.
fn file_of(want: &Want, folder: &Path, given: &[PathBuf]) -> Result<(PathBuf, FieldFile), String> {
    if let Some(src) = want.src() {
        let path = local(folder, src).ok_or_else(|| {
            format!(
                "the field is at {src}; this program reads local files only: fetch it and give it by --field FILE"
            )
        })?;
        let file = read(&path)?;
        return Ok((path, file));
    }
    let mut others = Vec::new();
    for path in given {
        if let Ok(file) = read(path) {
            match want.check(&file.sha256) {
                Ok(()) => return Ok((path.clone(), file)),
                Err(other) => others.push(format!("{} is {other}", path.display())),
            }
        }
    }
    let name = want.name();
    others.insert(
        0,
        format!(
            "the document needs the field “{name}” (SHA-256 {}): give it by --field FILE",
            want.sha256().unwrap_or_default()
        ),
    );
    Err(others.join("; "))
}

fn read(path: &Path) -> Result<FieldFile, String> {
    let (mut files, name) = Folder::of(path);
    read_field(&mut files, &name).map_err(|error| error.to_string())
}

/// Where the subject's voxels lie, without making them where that can be.
pub(super) fn subject_grid(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
) -> Result<Grid, CliError> {
    if common.subject.is_none()
        && let SubjectRef::Builtin { name, revision } = &illustration.subject
        && let Ok(generator) = Generator::of_revision(name, *revision, FINE_RESOLUTION)
    {
        return Ok(generator.header().grid);
    }
    let limits = VolumeLimits {
        max_dim: u32::MAX,
        max_voxels: u64::MAX,
    };
    let subject = subject_of(illustration, common, folder, limits)?;
    let volume = subject.values();
    volume.map(|volume| volume.grid).ok_or_else(|| {
        CliError::Field(
            "the subject has no voxels that a displacement field could lie over".to_owned(),
        )
    })
}
