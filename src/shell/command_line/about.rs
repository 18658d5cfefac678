//! What a document holds: `fabrica info` of a document or a link.

use std::fmt::Write as _;

use glam::DVec3;

use super::args::Common;
use super::clay::shape;
use super::error::CliError;
use super::opening::Opened;
use super::output::{one_line, print};
use crate::assets::Want;
use crate::clay::Shaping;
use crate::data::measure;
use crate::document::{
    Clay, ClayStart, ClayTool, ClayVolume, Illustration, MeshRef, SubjectRef, VoxelPart,
    VoxelSource,
};
use crate::load::{cubic, short, times};

/// Most lines of one list; what is beyond them is counted.
const MOST_LINES: usize = 64;

/// Prints what a document holds, as it stands before its first step. A clay is shaped for it; another file than that of
/// a clay is not opened.
///
/// # Errors
/// [`CliError::Subject`] if the clay cannot be made.
pub(super) fn about(common: &Common, opened: &Opened) -> Result<(), CliError> {
    opened.report_notices();
    let illustration = opened.document.illustration();
    let mut text = "kind: Fabrica document\n".to_owned();
    if !illustration.title.is_empty() {
        text += &format!("title: {}\n", one_line(&illustration.title));
    }
    text += &match &illustration.subject {
        SubjectRef::Builtin { name, revision } => {
            format!("subject: {}\n", of_builtin(name, *revision))
        }
        SubjectRef::Address { src, name, .. } => format!("subject: {}\n", of_file(src, name)),
        SubjectRef::Supplied { sha256, name, .. } => {
            format!("subject: {}\n", of_supplied(sha256, name))
        }
        SubjectRef::Meshes { meshes, .. } => of_meshes(meshes),
        SubjectRef::Clay(clay) => {
            let want = Want::subject(&illustration.subject_shown());
            let given = (common, opened.folder.as_path());
            shape(&want, given, None, |shown, shaping| {
                of_clay(clay, shown, shaping)
            })?
        }
    };
    print(&(text + &of_rest(illustration)))
}

/// A file at an address.
fn of_file(src: &str, name: &str) -> String {
    match name {
        "" => format!("file {}", one_line(&src)),
        name => format!("file {}, “{}”", one_line(&src), one_line(&name)),
    }
}

/// A file that the reader supplies.
fn of_supplied(sha256: &str, name: &str) -> String {
    let name = one_line(&name);
    format!("a file that the reader has, “{name}” (SHA-256 {sha256})")
}

fn of_mesh(mesh: &MeshRef) -> String {
    of_either(mesh.src.as_deref(), mesh.sha256.as_deref(), &mesh.name)
}

/// A file at an address, or one that the reader supplies.
fn of_either(src: Option<&str>, sha256: Option<&str>, name: &str) -> String {
    match (src, sha256) {
        (Some(src), _) => of_file(src, name),
        (None, Some(sha256)) => of_supplied(sha256, name),
        (None, None) => "none".to_owned(),
    }
}

/// A built-in subject, with its revision if that is not the first.
fn of_builtin(name: &str, revision: u32) -> String {
    match revision {
        0 | 1 => format!("built-in {}", one_line(&name)),
        _ => format!("built-in {}, revision {revision}", one_line(&name)),
    }
}

/// The part of a volume that a clay begins with.
fn of_volume(volume: &ClayVolume) -> String {
    let part = match &volume.part {
        VoxelPart::Segment(name) => format!("segment {}", one_line(name)),
        VoxelPart::Iso(value) => format!("values from {value}"),
    };
    let of = match &volume.of {
        VoxelSource::Builtin { name, revision } => of_builtin(name, *revision),
        VoxelSource::File {
            src, sha256, name, ..
        } => of_either(src.as_deref(), sha256.as_deref(), name),
    };
    let walls = if volume.has_all_walls {
        ", all walls"
    } else {
        ""
    };
    format!("{part} of {of}{walls}")
}

fn of_meshes(meshes: &[MeshRef]) -> String {
    let lines = meshes.iter().map(|mesh| format!("  {}\n", of_mesh(mesh)));
    format!(
        "subject: meshes: {}\n{}",
        meshes.len(),
        lines.collect::<String>()
    )
}

/// A clay with the strokes that are `shown`.
fn of_clay(clay: &Clay, shown: &Clay, shaping: &Shaping) -> String {
    let mut text = "subject: clay\n".to_owned();
    let start = match &shown.from {
        ClayStart::Shape(shape) => shape.name().to_owned(),
        ClayStart::Mesh(mesh) => of_mesh(mesh),
        ClayStart::Volume(volume) => of_volume(volume),
        ClayStart::Unknown(name) => one_line(name),
    };
    // Writing to a string does not fail.
    let _ = writeln!(text, "start: {start}");
    let _ = writeln!(text, "detail: {}", clay.detail);
    let _ = writeln!(text, "tools: {}", clay.tools.len());
    for ClayTool { shape, coat } in &clay.tools {
        let shape = shape.as_ref().map_or("not known", |shape| shape.name());
        let _ = writeln!(text, "  {shape}, coat {coat}");
    }
    let strokes = clay.strokes.len();
    let _ = match shown.strokes.len() {
        all if all == strokes => writeln!(text, "strokes: {strokes}"),
        first => writeln!(
            text,
            "strokes: {strokes}, of which the first {first} are shown"
        ),
    };
    let smoothing = shown
        .strokes
        .iter()
        .filter(|stroke| stroke.smooth.is_some());
    let off = shown.strokes.iter().filter(|stroke| stroke.is_off);
    let left_out = shaping.left_out();
    for (what, count) in [
        ("smoothing", smoothing.count()),
        ("off", off.count()),
        ("left out", left_out.len()),
    ] {
        let _ = writeln!(text, "  {what}: {count}");
    }
    for (index, why) in left_out.iter().take(MOST_LINES) {
        let _ = writeln!(text, "  stroke {}: {why}", index + 1);
    }
    let shaped = shaping.shaped();
    let whole = measure(&shaped.positions_mm(), &shaped.triangles);
    let [least, greatest] = whole.bounds_mm;
    let _ = writeln!(text, "triangles: {}", whole.triangle_count);
    let _ = writeln!(text, "vertices: {}", whole.vertex_count);
    let _ = writeln!(text, "pieces: {}", whole.piece_count);
    let _ = writeln!(text, "size: {} mm", times(greatest - least));
    let place = |at: DVec3| at.to_array().map(short).join(", ");
    let _ = writeln!(text, "box: {} to {} mm", place(least), place(greatest));
    let _ = match whole.volume_mm3 {
        Some(volume) => writeln!(text, "volume: {}", cubic(volume)),
        None => writeln!(text, "volume: none: it is open"),
    };
    text
}

/// Templates by their kinds, and what else there is, each if there is any.
fn of_rest(illustration: &Illustration) -> String {
    let mut text = String::new();
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for template in &illustration.templates {
        let name = template.kind.spec().name;
        match kinds.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((name, 1)),
        }
    }
    let kinds = kinds.iter().map(|(name, count)| format!("{count} {name}"));
    let kinds: Vec<String> = kinds.collect();
    let _ = match &kinds[..] {
        [] => writeln!(text, "templates: none"),
        some => writeln!(text, "templates: {}", some.join(", ")),
    };
    for (what, count) in [
        ("objects", illustration.objects.len()),
        ("labels", illustration.captions.len()),
    ] {
        if count > 0 {
            let _ = writeln!(text, "{what}: {count}");
        }
    }
    let _ = writeln!(text, "steps: {}", illustration.steps.len());
    for (number, step) in (1..).zip(&illustration.steps).take(MOST_LINES) {
        let _ = writeln!(text, "  {number} {}", one_line(&step.title));
    }
    text
}
