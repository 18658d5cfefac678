//! Displacement fields for the command line: read for the `field` templates of a document, written from a whole composed map.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::GzEncoder;
use glam::{DVec3, Vec3};

use super::cli::{CliError, Common, Moment, Opened, open_gpu, subject_of};
use super::files::Folder;
use super::subject::local;
use crate::data::{Grid, VolumeLimits};
use crate::displace::deformed_bounds;
use crate::document::{FieldRef, FieldSamples, Illustration, ParamValue, SubjectRef, TemplateData};
use crate::load::{FieldFile, FieldUse, read_field};
use crate::render::Probe;
use crate::subjects::{FINE_RESOLUTION, Generator};

/// Gives each `field` template of an illustration its samples, and its place where the file says it.
///
/// # Errors
/// [`CliError::Field`] with the template's pointer.
pub(super) fn attach_fields(
    illustration: &mut Illustration,
    common: &Common,
    folder: &Path,
    notice: &mut dyn FnMut(String),
) -> Result<(), CliError> {
    let has_fields = |i: &Illustration| {
        let mut data = i.templates.iter().map(|t| &t.data);
        data.any(|data| matches!(data, TemplateData::Field(_)))
    };
    if !has_fields(illustration) {
        return Ok(());
    }
    let grid = subject_grid(illustration, common, folder)?;
    for template in &mut illustration.templates {
        let place = format!("/templates/{}", template.index);
        let failed = |why: String| CliError::Field(format!("{place}: {why}"));
        let [is_subject_units, is_lps] = field_choices(&template.params);
        let TemplateData::Field(field) = &mut template.data else {
            continue;
        };
        let Some(path) = path_of(field, folder, &common.field).map_err(failed)? else {
            notice(format!("{place}: the field names no file; it is not drawn"));
            continue;
        };
        let file = read(&path).map_err(failed)?;
        if let Some(wanted) = field
            .sha256
            .as_ref()
            .filter(|wanted| **wanted != file.sha256)
        {
            return Err(failed(format!(
                "{} is another file than the document means: its SHA-256 is {}, wanted is {wanted}",
                path.display(),
                file.sha256
            )));
        }
        let given = FieldUse {
            is_subject_units: is_subject_units == 1,
            is_lps: [None, Some(true), Some(false)][is_lps.min(2) as usize],
            subject: &grid,
        };
        let (samples, notices) = file
            .fit(&given)
            .map_err(|why| failed(format!("{why} ({})", path.display())))?;
        for line in notices {
            notice(format!("{place}: {line}"));
        }
        if !field.is_placed {
            template.placement = samples.placement;
        }
        field.samples = Some(FieldSamples(std::sync::Arc::new(samples)));
    }
    Ok(())
}

/// Units and axes, by their index in the catalogue.
fn field_choices(params: &[ParamValue]) -> [u32; 2] {
    [1, 2].map(|i| match params.get(i) {
        Some(ParamValue::Choice(choice)) => *choice,
        _ => 0,
    })
}

fn path_of(field: &FieldRef, folder: &Path, given: &[PathBuf]) -> Result<Option<PathBuf>, String> {
    if let Some(src) = &field.src {
        return match local(folder, src) {
            Ok(path) => Ok(Some(path)),
            Err(_) => Err(format!(
                "the field is at {src}; this program reads local files only: fetch it and give it by --field FILE"
            )),
        };
    }
    let Some(wanted) = &field.sha256 else {
        return Ok(None);
    };
    let is_it = |path: &&PathBuf| read(path).is_ok_and(|file| file.sha256 == *wanted);
    match given.iter().find(is_it) {
        Some(path) => Ok(Some(path.clone())),
        None => Err(format!(
            "the document needs the field “{}” (SHA-256 {wanted}): give it by --field FILE",
            field.name
        )),
    }
}

fn read(path: &Path) -> Result<FieldFile, String> {
    let (mut files, name) = Folder::of(path);
    read_field(&mut files, &name).map_err(|error| error.to_string())
}

/// Where the subject's voxels lie, without making them where that can be.
fn subject_grid(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
) -> Result<Grid, CliError> {
    if common.subject.is_none()
        && let SubjectRef::Builtin { name } = &illustration.subject
        && let Ok(generator) = Generator::new(name, FINE_RESOLUTION)
    {
        return Ok(generator.header().grid);
    }
    let limits = VolumeLimits {
        max_dim: u32::MAX,
        max_voxels: u64::MAX,
    };
    Ok(subject_of(illustration, common, folder, limits)?.grid)
}

/// The composed map of a document with its continuity, as an NRRD file: per sample the way to the source in millimetres (left, posterior,
/// superior, from output to input) and A. The samples fill the box in which the deformed object lies.
pub(super) fn export_field(
    common: &Common,
    opened: &Opened,
    moment: Moment,
    size: u32,
) -> Result<Vec<u8>, CliError> {
    let illustration = opened.illustration(moment, common)?;
    let grid = subject_grid(&illustration, common, &opened.folder)?;
    let bounds = deformed_bounds(&illustration.templates, grid.subject_bounds());
    let (min, side) = (bounds.min.as_dvec3(), (bounds.max - bounds.min).as_dvec3());
    let step = side.max_element() / f64::from(size);
    let dims = (side / step - 1e-6).ceil().max(DVec3::ONE).as_uvec3();
    // In the middle of the box, as it is a little smaller than whole samples.
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
    let samples = pollster::block_on(async {
        Probe::new(&gpu)
            .await?
            .samples(&illustration, &points)
            .await
    })?;
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
