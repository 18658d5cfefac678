//! `fabrica export-field`: the composed map of a document as a displacement field.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::GzEncoder;
use glam::{DVec3, Vec3};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::fields::subject_grid;
use super::opening::Opened;
use super::output::notice;
use super::probe::map_samples;
use crate::document::Align;
use crate::placed::deformed_bounds;

/// The composed map of a document with its continuity, as an NRRD file: per sample the way to the source in millimetres
/// (left, posterior, superior, from output to input) and A. The samples fill the box in which the deformed object lies.
pub(super) fn export_field(
    common: &Common,
    opened: &Opened,
    moment: Moment,
    size: u32,
) -> Result<Vec<u8>, CliError> {
    let (illustration, resources) = opened.illustration(moment, common)?;
    let grid = subject_grid(&illustration, common, &opened.folder)?;
    let (templates, at_rest) = (&illustration.templates, grid.subject_bounds());
    let bounds = deformed_bounds(templates, &resources, at_rest);
    let (min, side) = (bounds.min.as_dvec3(), (bounds.max - bounds.min).as_dvec3());
    let step = side.max_element() / f64::from(size);
    let dims = (side / step - 1e-6).ceil().max(DVec3::ONE).as_uvec3();
    // In the middle of the box, since the box is a little smaller than whole samples.
    let first = min + 0.5 * (side - dims.as_dvec3() * step) + 0.5 * step;
    let mut points = Vec::with_capacity(dims.element_product() as usize);
    for z in 0..dims.z {
        for y in 0..dims.y {
            for x in 0..dims.x {
                let at = first + DVec3::new(x.into(), y.into(), z.into()) * step;
                points.push(at.as_vec3());
            }
        }
    }
    let gpu = open_gpu(common)?;
    for template in templates
        .iter()
        .filter(|t| t.enabled && t.align != Align::Axis)
    {
        notice(format!(
            "/templates/{}/align: an alignment is no map, and the field has none of it",
            template.index
        ));
    }
    let samples = map_samples(&gpu, common, opened, (&illustration, resources), &points)?;
    let mm = grid.mm_per_unit();
    let world_from_subject = grid.world_from_voxel * grid.subject_from_voxel().inverse();
    let lps = DVec3::new(-1.0, -1.0, 1.0);
    let origin = world_from_subject.transform_point3(first) * lps;
    let mm_step = step * mm;
    let mut bytes = format!(
        "NRRD0005\n# Composed displacement of an illustration: from output to input, mm; the fourth number is the continuity (below 0: a gap).\n\
         type: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 4 {} {} {}\n\
         space directions: none ({},0,0) (0,{},0) (0,0,{})\nkinds: 4-vector domain domain domain\n\
         endian: little\nencoding: gzip\nspace origin: ({},{},{})\n\n",
        dims.x, dims.y, dims.z, -mm_step, -mm_step, mm_step, origin.x, origin.y, origin.z
    )
    .into_bytes();
    let mut packed = GzEncoder::new(&mut bytes, Compression::fast());
    let to_lps = Vec3::new(-1.0, -1.0, 1.0) * mm as f32;
    for (point, sample) in points.iter().zip(&samples) {
        let way = (sample.pos_in_rest - *point) * to_lps;
        for value in [way.x, way.y, way.z, sample.continuity] {
            packed
                .write_all(&value.to_le_bytes())
                .map_err(CliError::Output)?;
        }
    }
    packed.finish().map_err(CliError::Output)?;
    Ok(bytes)
}
