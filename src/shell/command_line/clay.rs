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
use crate::clay::{Check, ClayError, Export, Form, Shaped, mesh_sha256};

/// The formats that are written, by the ends of file names.
#[derive(Clone, Copy)]
enum Format {
    Ply,
    Obj,
    Stl,
    Glb,
}

/// Writes the clay of a document after its first strokes.
pub(super) fn write_clay(
    common: &Common,
    opened: &Opened,
    output: &Path,
    strokes: Option<u32>,
    moment: Moment,
) -> Result<(), CliError> {
    let end = output.extension().unwrap_or_default().to_string_lossy();
    let format = match end.to_lowercase().as_str() {
        "ply" => Format::Ply,
        "obj" => Format::Obj,
        "stl" => Format::Stl,
        "glb" => Format::Glb,
        _ => {
            return Err(CliError::Usage(
                "name a file that ends in .ply, .obj, .stl or .glb",
            ));
        }
    };
    let (shaped, title) = shaped(common, opened, strokes, moment, Some(output))?;
    let export = Export {
        positions_mm: &shaped.positions_mm(),
        normals: &shaped.normals,
        triangles: &shaped.triangles,
        title: &title,
    };
    let bytes = match format {
        Format::Ply => export.ply(Form::Binary),
        Format::Obj => export.obj(),
        Format::Stl => export.stl(Form::Binary),
        Format::Glb => export.glb(),
    };
    write_whole(output, &bytes)
}

/// Prints what the mesh of a clay is like after its first strokes.
pub(super) fn check_clay(
    common: &Common,
    opened: &Opened,
    strokes: Option<u32>,
    moment: Moment,
    is_json: bool,
) -> Result<(), CliError> {
    let (shaped, _) = shaped(common, opened, strokes, moment, None)?;
    let mut check = Check::of(&shaped.positions, &shaped.triangles, Some(&shaped.touched));
    // Of the mesh as it is written, in millimetres.
    check.sha256 = mesh_sha256(&shaped.positions_mm(), &shaped.triangles);
    print(&match is_json {
        true => format!("{:#}\n", check.to_json()),
        false => check.lines(),
    })
}

/// The clay of a document, and the document's title. `output`: what is to be written, if anything is.
fn shaped(
    common: &Common,
    opened: &Opened,
    strokes: Option<u32>,
    moment: Moment,
    output: Option<&Path>,
) -> Result<(Shaped, String), CliError> {
    let (mut illustration, _) = opened.illustration(moment, common)?;
    if strokes.is_some() {
        illustration.look.strokes = strokes;
    }
    let want = Want::subject(&illustration.subject_shown());
    if want.clay().is_none() {
        return Err(CliError::Usage("the document's subject is no clay"));
    }
    stop::watch();
    let (mut desk, clay, _) = begun(&want, common, &opened.folder)?;
    let mut progress = Progress::of("shaped");
    let made = desk.shape(&clay, &mut |part| {
        progress.tell(part);
        !stop::is_wished()
    });
    drop(progress);
    match made {
        Ok(shaping) => {
            shaping.notices().iter().for_each(notice);
            Ok((shaping.shaped(), illustration.title))
        }
        Err(ClayError::Stopped) if let Some(path) = output => Err(CliError::Stopped {
            path: path.display().to_string(),
        }),
        Err(error) => Err(MissingSubject::Clay(error).into()),
    }
}
