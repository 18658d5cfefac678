//! `cargo xtask islands`: draws every document of the gallery at each step and every built-in subject, and fails if
//! crumbs float beside the object.
//!
//! An island is a piece of the picture (8-connected, alpha above 96 of 255) that hangs not together with the largest
//! one and has fewer than 40 pixels, at 800 × 600 with 4 samples a pixel and nothing behind the object. What each pixel
//! of an island shows the program tells itself, by `fabrica probe --rays`: things of their own are allowed by the names
//! of their segments.

use std::fs;
use std::path::{Path, PathBuf};

use fabrica::document::{Camera, Document, Illustration, newest_revision};
use fabrica::subjects;
use glam::{Quat, Vec3};
use serde_json::json;

use crate::compare::values;
use crate::examples::documents;
use crate::gallery::{native, render, written};
use crate::pieces::{self, pieces};
use crate::run::{Outcome, fed, program, report, root};

/// Width and height of the pictures, pixels.
const SIZE_PX: [u32; 2] = [800, 600];
/// Samples of a pixel.
const SAMPLES: u32 = 4;
/// A piece of so many pixels is no crumb.
const LEAST_PX: usize = 40;
/// Islands of a picture that are named one by one.
const MOST_NAMED: usize = 12;

/// Things of their own, which may float beside the object: documents of the gallery or built-in subjects, and the
/// segments that such an island shows.
const OWN_THINGS: &[(&str, &[&str])] = &[];

/// Draws what is asked for, and names the islands.
pub(crate) fn islands(args: &[String]) -> Outcome {
    let mut program_file = None;
    let mut only: Option<&str> = None;
    for pair in args.chunks(2) {
        match pair {
            [flag, value] if flag == "--program" => program_file = Some(PathBuf::from(value)),
            [flag, value] if flag == "--only" => only = Some(value),
            _ => return Err("islands takes --only NAME and --program FILE".to_owned()),
        }
    }
    let fabrica = native(program_file.as_deref())?;
    let is_wanted = |name: &str| only.is_none_or(|only| name.contains(only));
    let mut pictures = documents(root())?;
    for name in subjects::all_names() {
        pictures.push((name.to_owned(), as_it_is(name)?));
    }
    let (mut count, mut bad) = (0, Vec::new());
    for (name, document) in pictures.iter().filter(|(name, _)| is_wanted(name)) {
        let (mut drawn, mut small) = (0, Vec::new());
        for step in 0..=document.illustration().steps.len() {
            let (pieces, found) = crumbs(&fabrica, name, document, step)?;
            drawn += pieces;
            small.extend(found);
        }
        let steps = document.illustration().steps.len() + 1;
        report(&format!(
            "{name}: {steps} pictures, {drawn} pieces, {} crumbs",
            small.len()
        ));
        count += steps;
        bad.extend(small);
    }
    match (count, bad.len()) {
        (0, _) => Err("no document and no subject has such a name".to_owned()),
        (_, 0) => {
            report(&format!("{count} pictures without crumbs"));
            Ok(())
        }
        (_, crumbs) => Err(format!(
            "{crumbs} crumbs in {count} pictures:\n  {}",
            bad.join("\n  ")
        )),
    }
}

/// A built-in subject as new documents show it.
fn as_it_is(name: &str) -> Result<Document, String> {
    let tree =
        json!({ "fabrica": 1, "subject": { "builtin": name, "revision": newest_revision(name) } });
    Document::from_json(&tree.to_string()).map_err(|error| format!("{name}: {error}"))
}

/// The number of pieces of a picture, and a line about each island that is no thing of its own.
fn crumbs(
    fabrica: &Path,
    name: &str,
    document: &Document,
    step: usize,
) -> Result<(usize, Vec<String>), String> {
    let folder = root().join("target/xtask/islands");
    let located = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    fs::create_dir_all(&folder).map_err(|error| located(&folder, error))?;
    let picture = folder.join(format!("{name}-{step}.png"));
    let text = folder.join(format!("{name}.json"));
    fs::write(&text, document.to_json()).map_err(|error| located(&text, error))?;
    let mut command = render(fabrica, &text, step, SIZE_PX, SAMPLES);
    written(command.arg("--transparent"), &picture)?;
    let bytes = fs::read(&picture).map_err(|error| located(&picture, error))?;
    let (_, rgba) = values(&bytes)?;
    let pieces = pieces(SIZE_PX[0], &rgba);
    let count = pieces.len();
    let small = pieces::islands(pieces, LEAST_PX);
    let state = document.at_step(step).map_err(|error| error.to_string())?;
    let mut bad = Vec::new();
    let left_out = small.len().saturating_sub(MOST_NAMED);
    for island in small.iter().take(MOST_NAMED) {
        let shown = segments(fabrica, &text, step, state.illustration(), island)?;
        let is_own = !shown.is_empty() && shown.iter().all(|segment| is_own_thing(name, segment));
        if !is_own {
            let (x, y) = island[0];
            let what = match shown.is_empty() {
                true => "nothing that a ray meets".to_owned(),
                false => shown.join(", "),
            };
            bad.push(format!(
                "{name}, step {step}: {} pixels at {x}, {y}: {what}",
                island.len()
            ));
        }
    }
    if left_out > 0 {
        bad.push(format!("{name}, step {step}: {left_out} more"));
    }
    Ok((count, bad))
}

/// True if a segment of a document is listed as a thing of its own.
fn is_own_thing(name: &str, segment: &str) -> bool {
    let of_document = OWN_THINGS.iter().filter(|(document, _)| *document == name);
    of_document
        .flat_map(|(_, segments)| *segments)
        .any(|own| *own == segment)
}

/// Names of the segments that rays through these pixels meet first, in the order of the alphabet.
fn segments(
    fabrica: &Path,
    document: &Path,
    step: usize,
    shown: &Illustration,
    pixels: &[(u32, u32)],
) -> Result<Vec<String>, String> {
    let lines = pixels.iter().map(|&(x, y)| {
        let (from, dir) = ray(&shown.camera, x as f32 + 0.5, y as f32 + 0.5);
        let numbers = [from.x, from.y, from.z, dir.x, dir.y, dir.z];
        let numbers: Vec<String> = numbers.map(|n| n.to_string()).into();
        numbers.join(",") + "\n"
    });
    let lines: String = lines.collect();
    let mut command = program(fabrica);
    command.arg("probe").arg(document).arg("--rays");
    command.args(["--step", &step.to_string()]);
    let done = fed(&mut command, &lines)?;
    if !done.status.success() {
        return Err(String::from_utf8_lossy(&done.stderr).trim().to_owned());
    }
    // ox,oy,oz,dx,dy,dz,t,x,y,z,nx,ny,nz,sx,sy,sz,what,segment,color
    let told = String::from_utf8_lossy(&done.stdout).into_owned();
    let names = told.lines().filter_map(|line| line.split(',').nth(17));
    let mut names: Vec<String> = names
        .filter(|name| !name.is_empty())
        .map(str::to_owned)
        .collect();
    names.sort_unstable();
    names.dedup();
    Ok(names)
}

/// The ray through a place of the picture, pixels from the top left: eye and unit direction, subject space. The picture
/// looks from +y with +z upwards before the camera turns; its field of view spans the shorter side.
fn ray(camera: &Camera, x: f32, y: f32) -> (Vec3, Vec3) {
    let [width, height] = SIZE_PX.map(|side| side as f32);
    let half = (camera.fov_deg.to_radians() * 0.5).tan() / width.min(height);
    let ahead = Vec3::new(-(2.0 * x - width) * half, -1.0, (height - 2.0 * y) * half);
    let turn: Quat = camera.rotate;
    let eye = camera.target + turn * Vec3::Y * camera.distance;
    (eye, (turn * ahead).normalize_or(Vec3::NEG_Y))
}
