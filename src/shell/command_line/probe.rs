//! `fabrica probe`: points in, a line of numbers for each out (spec/contract.md, "The command line").

use std::io::{self, BufRead, Read as _, Write as _};
use std::path::Path;

use glam::{DVec3, Vec3};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::opening::Opened;
use super::output::shortened;
use super::subject::{report_kept, subject_of};
use crate::data::{Subject, VolumeLimits};
use crate::render::{Probe, Sample, Studio};

/// Prints the source of each point, and with `with_object` value and segment there.
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
    let subject = if with_object {
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
    let samples = match &subject {
        Some(subject) => {
            report_kept(&illustration, &resources, subject);
            let studio = Studio::new(&gpu, subject, false)?.with_resources(resources);
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
        let end = match &subject {
            Some(subject) => format!(",{}", object_at(subject, *s, *continuity)),
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

/// Value and segment of the material that came from a place, the segment quoted where a comma would break the line;
/// nothing where a gap is or the subject ends.
fn object_at(subject: &Subject, pos_in_rest: Vec3, continuity: f32) -> String {
    let material = subject.material_at(pos_in_rest);
    let Some(material) = material.filter(|_| continuity >= 0.0) else {
        return ",".to_owned();
    };
    let value = material.value.map(|value| value.to_string());
    let mut segment = material.segment.unwrap_or_default();
    if segment.contains([',', '"', '\n']) {
        segment = format!("\"{}\"", segment.replace('"', "\"\"").replace('\n', " "));
    }
    format!("{},{segment}", value.unwrap_or_default())
}
