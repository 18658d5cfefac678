use std::cell::RefCell;
use std::rc::Rc;

use sha2::{Digest as _, Sha256};

use super::draft::Draft;
use super::error::MeshError;
use super::format::{MeshFormat, MeshKind};
use super::input::{Input, Progress};
use super::options::{Axes, MeshOptions, Units};
use super::parts::divide;
use super::repair::repair;
use super::report::{MeshReport, Origin};
use super::{glb, mtl, obj, ply, stl};
use crate::data::Mesh;
use crate::load::files::{self, FileSet};
use crate::load::sniff::{Kind, SNIFF_BYTES, sniff};
use crate::load::stream::{Packing, SharedHash, Stream};
use crate::load::{ALL_FILES, LoadError};

/// What a file turns out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshOrNot {
    /// A mesh in a format that is read.
    Mesh(MeshFormat),
    /// A mesh in a format that is not read: what to do.
    Refused(&'static str),
    /// Something else.
    Not,
}

/// Opens a file and unpacks gzip.
fn open<'f>(
    files: &'f mut dyn FileSet,
    name: &str,
    hash: Option<&SharedHash>,
) -> Result<Stream<'f>, LoadError> {
    let mut stream = files::open(files, name, name, hash)?;
    if stream.peek(2)? == [0x1f, 0x8b] {
        stream.unpack(Packing::Gzip);
    }
    Ok(stream)
}

/// Tells whether a file is a mesh, by its content, then by its name. Reads its first bytes only.
///
/// # Errors
/// [`LoadError`] if the file cannot be read.
pub fn mesh_or_not(files: &mut dyn FileSet, name: &str) -> Result<MeshOrNot, LoadError> {
    if name == ALL_FILES {
        return Ok(MeshOrNot::Not);
    }
    let mut stream = open(files, name, None)?;
    let start = stream.peek(SNIFF_BYTES)?;
    let byte_len = stream
        .byte_len()
        .filter(|_| stream.packing() == Packing::Plain);
    Ok(match sniff(&start, name, byte_len) {
        Kind::Mesh(MeshKind::Read(format)) => MeshOrNot::Mesh(format),
        Kind::Mesh(MeshKind::Refused(words)) => MeshOrNot::Refused(words),
        // An empty file is what it is called.
        Kind::Empty => match super::format::by_name(&name.to_lowercase()) {
            Some(MeshKind::Read(format)) => MeshOrNot::Mesh(format),
            _ => MeshOrNot::Not,
        },
        _ => MeshOrNot::Not,
    })
}

/// Reads and repairs the mesh of this name in `files`, told by its content first, then by its name. Of an OBJ material
/// libraries and pictures beside it are looked for, by the last part of their paths. `progress` is told how far it is,
/// 0 to 1, and stops the reading by `false`. Memory grows with the bytes that come, never with what a header promises.
///
/// # Errors
/// [`MeshError`], with name and place.
pub fn read_mesh(
    files: &mut dyn FileSet,
    name: &str,
    options: &MeshOptions,
    progress: &mut Progress<'_>,
) -> Result<(Mesh, MeshReport), MeshError> {
    let format = match mesh_or_not(files, name)? {
        MeshOrNot::Mesh(format) => format,
        MeshOrNot::Refused(words) => {
            return Err(LoadError::Unsupported {
                name: name.to_owned(),
                what: words.to_owned(),
            }
            .into());
        }
        MeshOrNot::Not => {
            return Err(LoadError::Unsupported {
                name: name.to_owned(),
                what: "not a mesh that Fabrica knows (OBJ, STL, PLY, GLB)".to_owned(),
            }
            .into());
        }
    };
    let hash: SharedHash = Rc::new(RefCell::new(Sha256::new()));
    let mut draft = Draft::new(name, options.max_triangles);
    let mut elsewhere = obj::Elsewhere::default();
    let mut input = Input::new(open(files, name, Some(&hash))?, &mut *progress);
    if input.peek(1)?.is_empty() {
        return Err(LoadError::Empty {
            name: name.to_owned(),
        }
        .into());
    }
    let form = match format {
        MeshFormat::Obj => {
            elsewhere = obj::read(&mut input, &mut draft)?;
            ""
        }
        MeshFormat::Stl => stl::read(&mut input, &mut draft, options.max_triangles)?,
        MeshFormat::Ply => ply::read(&mut input, &mut draft, name)?,
        MeshFormat::Glb => {
            glb::read(&mut input, &mut draft, name)?;
            ""
        }
    };
    if input.finish()? {
        draft.leave(super::report::Aside::TrailingBytes);
    }
    drop(input);
    let obj::Elsewhere {
        libraries,
        materials,
    } = elsewhere;
    mtl::read(files, name, &libraries, &materials, &mut draft, progress)?;
    let units = match options.units {
        Some(units) => (units, Origin::Given),
        None => (format_units(format), Origin::Format),
    };
    let axes = match (options.axes, draft.space) {
        (Some(axes), _) => (axes, Origin::Given),
        (None, Some(axes)) => (axes, Origin::File),
        (None, None) => (format_axes(format), Origin::Format),
    };
    let aside = std::mem::take(&mut draft.aside);
    let (mut mesh, repair) = repair(draft, name, axes.0.ras_from_file(), units.0.mm())?;
    divide(&mut mesh, options.parts);
    let sha256 = hash.borrow().clone().finalize().into();
    let report = MeshReport {
        format,
        form,
        units,
        axes,
        repair,
        aside,
        sha256,
    };
    Ok((mesh, report))
}

/// One unit of a file of which nothing is said.
fn format_units(format: MeshFormat) -> Units {
    match format {
        MeshFormat::Glb => Units::Metre,
        MeshFormat::Obj | MeshFormat::Stl | MeshFormat::Ply => Units::Millimetre,
    }
}

/// The axes of a file of which nothing is said.
fn format_axes(format: MeshFormat) -> Axes {
    match format {
        MeshFormat::Obj | MeshFormat::Glb => Axes::YUp,
        MeshFormat::Stl | MeshFormat::Ply => Axes::Ras,
    }
}
