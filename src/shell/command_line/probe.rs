//! `fabrica probe`: points in, a line of numbers for each out (spec/contract.md, "The command line").

use std::io::{self, Write as _};
use std::path::Path;

use glam::{DVec3, Vec3};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::numbers::read_numbers;
use super::opening::Opened;
use super::subject::{report_drawing, subject_of};
use crate::data::{KeptLabels, Resources, Subject, VolumeLimits};
use crate::document::{Align, Illustration, PlacedTemplate};
use crate::render::{Fillings, Gpu, KeptTissue, Probe, Sample, Studio};

/// A scan is asked as it is, however large.
pub(super) const WHOLE: VolumeLimits = VolumeLimits {
    max_dim: u32::MAX,
    max_voxels: u64::MAX,
};

/// What is printed of each point besides its source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Columns {
    /// Value and segment of what is there.
    pub object: bool,
    /// Depth of the source under the surface of a mesh.
    pub depth: bool,
}

/// Prints the source of each point, and what `columns` ask for.
pub(super) fn probe(
    common: &Common,
    opened: &Opened,
    points: Option<&Path>,
    columns: Columns,
    moment: Moment,
) -> Result<(), CliError> {
    let (illustration, resources) = opened.illustration(moment, common)?;
    let points: Vec<[f64; 3]> = read_numbers(points, "x,y,z, three finite numbers")?;
    let gpu = open_gpu(common)?;
    let subject = match columns.object || columns.depth {
        true => Some(subject_of(&illustration, common, &opened.folder, WHOLE)?),
        false => None,
    };
    let surface = subject.as_ref().and_then(Subject::surface);
    if columns.depth && surface.is_none() {
        return Err(CliError::Usage(
            "--depth asks for the depth under a mesh, and this subject has none",
        ));
    }
    let positions: Vec<Vec3> = points
        .iter()
        .map(|p| DVec3::from_array(*p).as_vec3())
        .collect();
    let samples = match &subject {
        Some(subject) if columns.object => {
            report_drawing(&illustration, &resources, subject);
            let studio = Studio::new(&gpu, subject, false)?.with_resources(resources.clone());
            pollster::block_on(studio.probe_object(&illustration, &positions))?
        }
        _ => map_samples(
            &gpu,
            common,
            opened,
            (&illustration, resources.clone()),
            &positions,
        )?,
    };
    let materials = subject
        .as_ref()
        .map(|s| Materials::of(s, &illustration, &resources));
    let mut out = io::BufWriter::new(io::stdout().lock());
    for ([x, y, z], sample) in points.iter().zip(&samples) {
        let Sample {
            pos_in_rest: s,
            continuity,
        } = sample;
        write!(out, "{x},{y},{z},{},{},{},{continuity}", s.x, s.y, s.z)
            .map_err(CliError::Output)?;
        if let Some(materials) = materials.as_ref().filter(|_| columns.object) {
            let found = match *continuity < 0.0 {
                true => None,
                false => materials.at(*s),
            };
            let (value, segment) = found.unwrap_or_default();
            write!(out, ",{value},{}", quoted(&segment)).map_err(CliError::Output)?;
        }
        if let Some(surface) = surface.filter(|_| columns.depth) {
            write!(out, ",{}", surface.depth_at(*s)).map_err(CliError::Output)?;
        }
        writeln!(out).map_err(CliError::Output)?;
    }
    out.flush().map_err(CliError::Output)
}

/// The composed map of a document at places of the deformed object, with its constraints: for those the subject is
/// opened too. Alignment is no map and is left out.
pub(super) fn map_samples(
    gpu: &Gpu,
    common: &Common,
    opened: &Opened,
    (illustration, resources): (&Illustration, Resources),
    points: &[Vec3],
) -> Result<Vec<Sample>, CliError> {
    let gives_way = |template: &PlacedTemplate| {
        let constrain = template.constrain.as_ref();
        template.enabled && constrain.is_some_and(|constrain| !constrain.keep.is_empty())
    };
    if !illustration.templates.iter().any(gives_way) {
        return Ok(pollster::block_on(async {
            Probe::new(gpu)
                .await?
                .samples(illustration, &resources, points)
                .await
        })?);
    }
    let subject = subject_of(illustration, common, &opened.folder, WHOLE)?;
    report_drawing(illustration, &resources, &subject);
    let mut unaligned = illustration.clone();
    for template in &mut unaligned.templates {
        template.align = Align::Axis;
    }
    let studio = Studio::new(gpu, &subject, false)?.with_resources(resources);
    Ok(pollster::block_on(studio.probe_object(&unaligned, points))?)
}

/// What a subject has at places of rest space, as a document draws it.
pub(super) struct Materials<'a> {
    subject: &'a Subject,
    kept: KeptLabels,
    fillings: Option<Fillings<'a>>,
}

impl<'a> Materials<'a> {
    pub(super) fn of(
        subject: &'a Subject,
        illustration: &Illustration,
        resources: &Resources,
    ) -> Self {
        Self {
            subject,
            kept: KeptTissue::labels(&illustration.templates, resources, subject.segments()),
            fillings: Fillings::of(subject, &illustration.look),
        }
    }

    /// The bodies of its meshes, if it has any.
    pub(super) fn fillings(&self) -> Option<&Fillings<'a>> {
        self.fillings.as_ref()
    }

    /// Value (of a mesh the depth under its surface) and name of the segment or layer at a place; `None` where nothing
    /// is. Either may be empty. Where a mesh fills a place of a volume, the mesh is there.
    pub(super) fn at(&self, place: Vec3) -> Option<(String, String)> {
        let filling = self
            .fillings
            .as_ref()
            .and_then(|fillings| fillings.at(place));
        if let Some(filling) = filling {
            return Some((filling.depth.to_string(), filling.name));
        }
        self.subject.values()?;
        let material = self.subject.material_at(place, &self.kept)?;
        let value = material.value.map(|value| value.to_string());
        Some((
            value.unwrap_or_default(),
            material.segment.unwrap_or_default(),
        ))
    }
}

/// A name in quotes where a comma would break the line.
pub(super) fn quoted(name: &str) -> String {
    match name.contains([',', '"', '\n']) {
        true => format!("\"{}\"", name.replace('"', "\"\"").replace('\n', " ")),
        false => name.to_owned(),
    }
}
