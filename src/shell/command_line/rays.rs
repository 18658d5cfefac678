//! `fabrica probe --rays`: rays in, a line for each of what it meets out (spec/surfaces.md, "The command line").

use std::io::{self, Write as _};
use std::path::Path;

use glam::{DVec3, Vec3};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::figures::with_sheet;
use super::numbers::read_numbers;
use super::objects::{Needed, objects_of};
use super::opening::Opened;
use super::probe::{Materials, WHOLE, quoted};
use super::subject::{report_drawing, subject_of};
use crate::math::srgb_from_linear;
use crate::render::{Meeting, RayEvent, Studio};

/// Prints where each ray turns more than half opaque; empty columns for one that does not.
pub(super) fn rays(
    common: &Common,
    opened: &Opened,
    path: Option<&Path>,
    moment: Moment,
) -> Result<(), CliError> {
    let (illustration, mut resources) = opened.illustration(moment, common)?;
    let given: Vec<[f64; 6]> = read_numbers(path, "ox,oy,oz,dx,dy,dz, six finite numbers")?;
    let mut asked = Vec::with_capacity(given.len());
    for (numbers, index) in given.iter().zip(1..) {
        let [ox, oy, oz, dx, dy, dz] = *numbers;
        let dir = DVec3::new(dx, dy, dz).try_normalize();
        let dir = dir.ok_or(CliError::NoDirection { ray: index })?;
        asked.push((DVec3::new(ox, oy, oz).as_vec3(), dir.as_vec3()));
    }
    let gpu = open_gpu(common)?;
    let subject = subject_of(&illustration, common, &opened.folder, WHOLE)?;
    report_drawing(&illustration, &resources, &subject);
    let here = std::mem::take(&mut resources.objects);
    let place = (common, opened.folder.as_path());
    resources.objects = objects_of(&illustration, Needed::All, here, place)?;
    let (illustration, resources) = with_sheet(&mut None, illustration, resources, &subject)?;
    let materials = Materials::of(&subject, &illustration, &resources);
    let studio = Studio::new(&gpu, &subject, true)?.with_resources(resources);
    let events = pollster::block_on(studio.events(&illustration, &asked))?;
    let name_of = |index: usize| {
        let named = illustration
            .objects
            .iter()
            .find(|object| object.index == index);
        named.map_or("", |object| &object.name)
    };
    let mut out = io::BufWriter::new(io::stdout().lock());
    for ((numbers, ray), event) in given.iter().zip(&asked).zip(&events) {
        let numbers = numbers.map(|number| number.to_string()).join(",");
        let found = match event {
            Some(event) => columns_of(event, *ray, &materials, name_of),
            None => ",".repeat(12),
        };
        writeln!(out, "{numbers},{found}").map_err(CliError::Output)?;
    }
    out.flush().map_err(CliError::Output)
}

/// The columns behind the ray's own.
fn columns_of<'o>(
    event: &RayEvent,
    (origin, dir): (Vec3, Vec3),
    materials: &Materials<'_>,
    object_name: impl Fn(usize) -> &'o str,
) -> String {
    let segment = match (event.meeting, event.segment, materials.fillings()) {
        (Meeting::Surface | Meeting::Inside, Some(k), Some(fillings)) => {
            fillings.segment_name(k).to_owned()
        }
        (Meeting::Cut, Some(k), Some(fillings)) => fillings.name_at(k, event.pos_in_rest),
        (Meeting::Object, Some(k), _) => object_name(k).to_owned(),
        _ => materials.at(event.pos_in_rest).unwrap_or_default().1,
    };
    let places = [
        origin + dir * event.distance,
        event.normal,
        event.pos_in_rest,
    ];
    let places = places.map(|place| place.to_array().map(|number| number.to_string()).join(","));
    let [r, g, b] = (event.albedo.to_array()).map(|linear| srgb_from_linear(f64::from(linear)));
    format!(
        "{},{},{},{},#{r:02x}{g:02x}{b:02x}",
        event.distance,
        places.join(","),
        event.meeting.name(),
        quoted(&segment)
    )
}
