//! `fabrica clay`: the mesh of a clay as a file, or what it is like.

use std::path::Path;

use super::args::{Common, Moment};
use super::error::{CliError, MissingSubject};
use super::opening::Opened;
use super::output::{notice, print, write_whole};
use super::progress::Progress;
use super::stop;
use super::subject::begun;
use crate::assets::Want;
use crate::clay::{Check, ClayError, Form, MeshFormat, Shaping, mesh_sha256};
use crate::document::Clay;

/// Writes the clay of a document after its first strokes.
pub(super) fn write_clay(
    common: &Common,
    opened: &Opened,
    (output, is_text): (&Path, bool),
    strokes: Option<u32>,
    moment: Moment,
) -> Result<(), CliError> {
    let end = output.extension().unwrap_or_default().to_string_lossy();
    let format = MeshFormat::of_extension(&end).ok_or(CliError::Usage(
        "name a file that ends in .ply, .obj, .stl or .glb",
    ))?;
    let (want, title) = clay_of(common, opened, strokes, moment)?;
    let given = (common, opened.folder.as_path());
    let shaped = shape(&want, given, Some(output), |_, shaping| shaping.shaped())?;
    let form = if is_text { Form::Text } else { Form::Binary };
    write_whole(output, &shaped.file(format, form, &title))
}

/// Prints what the mesh of a clay is like after its first strokes.
pub(super) fn check_clay(
    common: &Common,
    opened: &Opened,
    strokes: Option<u32>,
    moment: Moment,
    is_json: bool,
) -> Result<(), CliError> {
    let (want, _) = clay_of(common, opened, strokes, moment)?;
    let given = (common, opened.folder.as_path());
    // Strokes that smooth are no deformation of space, and may let triangles meet.
    let smoothing = |clay: &Clay| {
        let acting = clay.strokes.iter().filter(|stroke| !stroke.is_off);
        acting.filter(|stroke| stroke.smooth.is_some()).count()
    };
    let take = |clay: &Clay, shaping: &Shaping| (smoothing(clay), shaping.shaped());
    let (smoothing, shaped) = shape(&want, given, None, take)?;
    let mut check = Check::of_clay(&shaped);
    // Of the mesh as it is written, in millimetres.
    check.sha256 = mesh_sha256(&shaped.positions_mm(), &shaped.triangles);
    print(&if is_json {
        let mut json = check.to_json();
        json["smoothing_strokes"] = smoothing.into();
        format!("{json:#}\n")
    } else {
        format!("{}strokes that smooth: {smoothing}\n", check.lines())
    })
}

/// What a document wants at a moment, its first strokes if a number is given, if its subject is a clay, and its title.
fn clay_of(
    common: &Common,
    opened: &Opened,
    strokes: Option<u32>,
    moment: Moment,
) -> Result<(Want, String), CliError> {
    let (mut illustration, _) = opened.illustration(moment, common)?;
    if strokes.is_some() {
        illustration.look.strokes = strokes;
    }
    let want = Want::subject(&illustration.subject_shown());
    match want.clay() {
        Some(_) => Ok((want, illustration.title)),
        None => Err(CliError::Usage("the document's subject is no clay")),
    }
}

/// Shapes the clay of a want and takes of it what is asked for; `folder` is that of the document. `output`: what is to
/// be written, if anything is.
///
/// # Errors
/// [`CliError::Subject`] if it cannot be made; [`CliError::Stopped`].
pub(super) fn shape<T>(
    want: &Want,
    (common, folder): (&Common, &Path),
    output: Option<&Path>,
    take: impl FnOnce(&Clay, &Shaping) -> T,
) -> Result<T, CliError> {
    stop::watch();
    let (mut desk, clay, _) = begun(want, common, folder)?;
    let mut progress = Progress::of("shaped");
    let made = desk.shape(&clay, &mut |part| {
        progress.tell(part);
        !stop::is_wished()
    });
    drop(progress);
    match made {
        Ok(shaping) => {
            shaping.notices().iter().for_each(notice);
            Ok(take(&clay, shaping))
        }
        Err(ClayError::Stopped) if let Some(path) = output => Err(CliError::Stopped {
            path: path.display().to_string(),
        }),
        Err(error) => Err(MissingSubject::Clay(error).into()),
    }
}
