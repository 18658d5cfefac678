//! `fabrica probe`: points in, a line of numbers for each out (spec/contract.md, "The command line").

use std::io::{self, BufRead, Read as _, Write as _};
use std::path::Path;

use glam::{DVec3, UVec3, Vec3};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::opening::Opened;
use super::output::shortened;
use super::subject::{say_kept, subject_of};
use crate::data::{Volume, VolumeLimits};
use crate::render::{Probe, Sample, Studio};

/// Prints where each point came from, and with `with_object` what is there.
pub(super) fn probe(
    common: &Common,
    opened: &Opened,
    points: Option<&Path>,
    with_object: bool,
    moment: Moment,
) -> Result<(), CliError> {
    let (illustration, resources) = opened.illustration(moment, common)?;
    let points = match points {
        Some(path) => {
            let shown = path.display().to_string();
            let file = std::fs::File::open(path).map_err(|source| CliError::Read {
                path: shown.clone(),
                source,
            })?;
            read_points(io::BufReader::new(file), &shown)?
        }
        None => read_points(io::stdin().lock(), "standard input")?,
    };
    let gpu = open_gpu(common)?;
    let volume = if with_object {
        let limits = VolumeLimits {
            max_dim: u32::MAX,
            max_voxels: u64::MAX,
        };
        Some(subject_of(&illustration, common, &opened.folder, limits)?)
    } else {
        None
    };
    let positions: Vec<Vec3> = points
        .iter()
        .map(|p| DVec3::from_array(*p).as_vec3())
        .collect();
    let samples = match &volume {
        Some(volume) => {
            say_kept(&illustration, &resources, volume);
            let studio = Studio::new(&gpu, volume, false)?.with_resources(resources);
            pollster::block_on(studio.probe_object(&illustration, &positions))?
        }
        None => pollster::block_on(async {
            Probe::new(&gpu)
                .await?
                .samples(&illustration, &resources, &positions)
                .await
        })?,
    };
    let mut out = io::BufWriter::new(io::stdout().lock());
    for (
        [x, y, z],
        Sample {
            pos_in_rest: s,
            continuity,
        },
    ) in points.iter().zip(&samples)
    {
        let end = match &volume {
            Some(volume) => format!(",{}", object_at(volume, *s, *continuity)),
            None => String::new(),
        };
        writeln!(out, "{x},{y},{z},{},{},{},{continuity}{end}", s.x, s.y, s.z)
            .map_err(CliError::Output)?;
    }
    out.flush().map_err(CliError::Output)
}

/// Longest line of points, bytes.
const MAX_LINE: u64 = 4096;

fn read_points(mut from: impl BufRead, path: &str) -> Result<Vec<[f64; 3]>, CliError> {
    let mut points = Vec::new();
    let mut bytes = Vec::new();
    for line in 1.. {
        bytes.clear();
        let n = (&mut from)
            .take(MAX_LINE)
            .read_until(b'\n', &mut bytes)
            .map_err(|source| CliError::Read {
                path: path.to_owned(),
                source,
            })?;
        if n == 0 {
            break;
        }
        let text = String::from_utf8_lossy(&bytes);
        let text = text.trim().trim_start_matches('\u{feff}');
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        points.push(parse_point(text).ok_or_else(|| CliError::Point {
            path: path.to_owned(),
            line,
            found: shortened(text),
        })?);
    }
    Ok(points)
}

fn parse_point(text: &str) -> Option<[f64; 3]> {
    let mut numbers = text.split(',').map(|number| {
        let number = number.trim().parse::<f64>().ok()?;
        // The map is evaluated in 32 bits, which must hold it too.
        (number.is_finite() && (number as f32).is_finite()).then_some(number)
    });
    let point = [numbers.next()??, numbers.next()??, numbers.next()??];
    numbers.next().is_none().then_some(point)
}

/// Value and segment of the material that came from a place; nothing where a gap is or the scan ends.
fn object_at(volume: &Volume, pos_in_rest: Vec3, continuity: f32) -> String {
    let pos = volume
        .grid
        .subject_from_voxel()
        .inverse()
        .transform_point3(pos_in_rest.as_dvec3());
    let dims = volume.grid.dims.as_dvec3();
    let is_inside = pos.cmpge(DVec3::splat(-0.5)).all() && pos.cmple(dims - 0.5).all();
    if continuity < 0.0 || !is_inside {
        return ",".to_owned();
    }
    // Linear between the eight voxels around, the outermost continued to the edge, as the picture has it.
    let pos = pos.clamp(DVec3::ZERO, dims - 1.0);
    let low = pos.floor();
    let part = pos - low;
    let low = low.as_uvec3();
    let mut value = 0.0_f64;
    for corner in 0..8_u32 {
        let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
        let weight =
            DVec3::select(step.cmpeq(UVec3::ONE), part, DVec3::ONE - part).element_product();
        let voxel = (low + step).min(volume.grid.dims - 1);
        value += weight * f64::from(volume.value_at(voxel).unwrap_or(0.0));
    }
    format!("{},{}", value as f32, segment_at(volume, pos_in_rest))
}

/// Name of the segment at a place (its number if it has no name), quoted where a comma would break the line.
fn segment_at(volume: &Volume, pos_in_rest: Vec3) -> String {
    let Some(labels) = &volume.segmentation else {
        return String::new();
    };
    // Labels may lie on their own grid; both lie in the scanner's space.
    let world = (volume.grid.world_from_voxel * volume.grid.subject_from_voxel().inverse())
        .transform_point3(pos_in_rest.as_dvec3());
    let voxel = labels
        .grid
        .world_from_voxel
        .inverse()
        .transform_point3(world)
        .round();
    if voxel.cmplt(DVec3::ZERO).any() || voxel.cmpge(labels.grid.dims.as_dvec3()).any() {
        return String::new();
    }
    let (v, dims) = (voxel.as_u64vec3(), labels.grid.dims.as_u64vec3());
    let index = v.x + dims.x * (v.y + dims.y * v.z);
    let label = labels.labels.get(index as usize).copied().unwrap_or(0);
    if label == 0 {
        return String::new();
    }
    match labels.segments.iter().find(|s| s.label == u16::from(label)) {
        Some(segment) if segment.name.contains([',', '"', '\n']) => {
            format!(
                "\"{}\"",
                segment.name.replace('"', "\"\"").replace('\n', " ")
            )
        }
        Some(segment) => segment.name.clone(),
        None => label.to_string(),
    }
}
