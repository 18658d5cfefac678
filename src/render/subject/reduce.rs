//! Volumes that are larger than the device takes.

use crate::data::{
    Reducer, Reduction, SubjectPart, SubjectSink as _, Volume, VolumeBuilder, Voxels,
};
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;

/// A coarser copy if the volume is larger than the device takes, and how much coarser it is.
///
/// # Errors
/// [`RenderError::TooLarge`].
pub(crate) fn reduced_to_fit(
    gpu: &Gpu,
    volume: &Volume,
) -> Result<Option<(Volume, Reduction)>, RenderError> {
    let limits = gpu.volume_limits();
    let dims = volume.grid.dims;
    let count = dims.as_u64vec3().element_product();
    if dims.max_element() <= limits.max_dim && count <= limits.max_voxels {
        return Ok(None);
    }
    let too_large = |why: String| RenderError::TooLarge(why);
    let mut builder = VolumeBuilder::new();
    let mut reducer = Reducer::new(&mut builder, limits);
    let header = Volume {
        grid: volume.grid,
        voxels: empty_like(&volume.voxels),
        slope: volume.slope,
        intercept: volume.intercept,
        value_range: volume.value_range,
        has_size: volume.has_size,
        segmentation: volume
            .segmentation
            .as_ref()
            .map(|l| crate::data::Segmentation {
                grid: l.grid,
                labels: Vec::new(),
                segments: l.segments.clone(),
            }),
    };
    reducer
        .take(SubjectPart::header(header))
        .map_err(too_large)?;
    let slice = dims.x as usize * dims.y as usize;
    for z in 0..dims.z as usize {
        let scalars = copy_range(&volume.voxels, z * slice, slice);
        reducer
            .take(SubjectPart::Scalars(scalars))
            .map_err(too_large)?;
    }
    if let Some(labels) = &volume.segmentation {
        reducer
            .take(SubjectPart::Labels(labels.labels.clone()))
            .map_err(too_large)?;
    }
    let small = builder
        .finish()
        .map_err(|why| RenderError::TooLarge(why.to_string()))?;
    let reduction = Reduction {
        from: dims,
        to: small.grid.dims,
    };
    Ok(Some((small, reduction)))
}

fn empty_like(voxels: &Voxels) -> Voxels {
    match voxels {
        Voxels::U8(_) => Voxels::U8(Vec::new()),
        Voxels::I16(_) => Voxels::I16(Vec::new()),
        Voxels::U16(_) => Voxels::U16(Vec::new()),
        Voxels::F32(_) => Voxels::F32(Vec::new()),
    }
}

fn copy_range(voxels: &Voxels, start: usize, count: usize) -> Voxels {
    fn part<T: Copy>(all: &[T], start: usize, count: usize) -> Vec<T> {
        all.iter().skip(start).take(count).copied().collect()
    }
    match voxels {
        Voxels::U8(v) => Voxels::U8(part(v, start, count)),
        Voxels::I16(v) => Voxels::I16(part(v, start, count)),
        Voxels::U16(v) => Voxels::U16(part(v, start, count)),
        Voxels::F32(v) => Voxels::F32(part(v, start, count)),
    }
}
