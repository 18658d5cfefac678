use super::bodies::{LabelSet, labels_in_bricks};
use super::gpu_types::{Subject, affine_rows};
use super::passes::Passes;
use super::{Gpu, RenderError, uniform_buffer};
use crate::data::{Histogram, LabelVolume, Reducer, Segment, Volume, VolumeBuilder, Voxels};
use crate::math::Aabb;
use glam::{Affine3A, DAffine3, DVec3, UVec3, Vec3};
use half::f16;

/// Voxels along a side of a brick.
pub const BRICK: u32 = 8;
/// Bytes converted and handed to the GPU at a time: small enough that a frame is not missed.
const SLAB_BYTES: usize = 2 << 20;
/// Voxels looked at for the histogram at most.
const HISTOGRAM_SAMPLES: usize = 1 << 20;

/// Smallest and largest value of each block of 8³ voxels, a border of one voxel included (interpolation reaches so far),
/// normalised as in the texture. Tells without the GPU where something may be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Bricks {
    /// Bricks along each axis.
    pub dims: UVec3,
    /// Smallest and largest, x fastest.
    pub ranges: Vec<[f32; 2]>,
}

/// What a volume looks like by default, and what its values span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubjectInfo {
    /// Smallest and largest value.
    pub value_range: [f32; 2],
    /// Window from the histogram, for presets without one of their own.
    pub window_auto: [f32; 2],
    /// True if the values are Hounsfield units, with `hounsfield_offset` added.
    pub is_ct: bool,
    /// Value of water: 0 for Hounsfield units, about 1,024 for scans that are stored unsigned.
    pub hounsfield_offset: f32,
    /// True if there are segments with colours.
    pub has_segments: bool,
}

/// A volume on the GPU. Built once per subject.
#[derive(Debug)]
pub(super) struct SubjectTextures {
    /// Group 1.
    pub bind_group: wgpu::BindGroup,
    /// Normalised value ranges.
    pub bricks: Bricks,
    /// What it is.
    pub info: SubjectInfo,
    /// Labels by brick, where they lie on the grid of the values.
    pub label_bricks: Option<Vec<LabelSet>>,
    /// Of the untouched subject.
    pub bounds: Aabb,
    /// The uniform, as uploaded.
    pub uniform: Subject,
    /// The uniform's buffer.
    pub buffer: wgpu::Buffer,
    /// Scalars, labels and how the scalars are read: what is made from them by computing.
    pub volume_view: wgpu::TextureView,
    pub label_view: wgpu::TextureView,
    pub sampler: wgpu::Sampler,
    /// Where the voxels of the scalars lie.
    pub frame: VoxelFrame,
    /// Where the voxels of the labels lie.
    pub label_frame: Option<VoxelFrame>,
    /// Axis of the volume's grid that runs from foot to head.
    pub foot_axis: u32,
    /// Named segments.
    pub segments: Vec<Segment>,
}

/// Where the voxels of a grid lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VoxelFrame {
    /// Voxels along each axis.
    pub dims: UVec3,
    /// Between their centres along each axis, subject units.
    pub spacing: Vec3,
    /// Rest space from voxel indices.
    pub rest_from_voxel: DAffine3,
}

impl VoxelFrame {
    fn new(dims: UVec3, rest_from_voxel: DAffine3) -> Self {
        let m = rest_from_voxel.matrix3;
        Self {
            dims,
            spacing: DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length()).as_vec3(),
            rest_from_voxel,
        }
    }

    /// Texture space (outer edges at 0 and 1) from rest space.
    pub(super) fn texture_from_rest(&self) -> DAffine3 {
        DAffine3::from_scale(self.dims.as_dvec3().recip())
            * DAffine3::from_translation(DVec3::splat(0.5))
            * self.rest_from_voxel.inverse()
    }
}

/// A volume on its way to the GPU, slab by slab.
#[derive(Debug)]
pub(super) struct Upload {
    volume_texture: wgpu::Texture,
    label_texture: wgpu::Texture,
    next_slice: u32,
    next_label_slice: u32,
    scale: Normalise,
    bricks: BrickBuilder,
    scratch: Vec<u16>,
}

#[derive(Clone, Copy, Debug)]
struct Normalise {
    slope: f32,
    offset: f32,
}

impl Normalise {
    fn of(volume: &Volume) -> Self {
        let [low, high] = volume.value_range;
        let range = span(volume.value_range);
        debug_assert!(high >= low, "a value range is sorted");
        Self {
            slope: volume.slope / range,
            offset: (volume.intercept - low) / range,
        }
    }

    /// 0 to 1; what is no number counts as the smallest value.
    fn apply(self, stored: f32) -> f32 {
        let n = stored * self.slope + self.offset;
        if n > 0.0 { n.min(1.0) } else { 0.0 }
    }
}

fn span(range: [f32; 2]) -> f32 {
    let span = range[1] - range[0];
    if span.is_finite() && span > 0.0 {
        span
    } else {
        1.0
    }
}

/// A coarser copy if the volume is larger than the device takes, with the notice that says so.
///
/// # Errors
/// [`RenderError::TooLarge`].
pub(super) fn reduced_to_fit(
    gpu: &Gpu,
    volume: &Volume,
) -> Result<Option<(Volume, String)>, RenderError> {
    use crate::data::VolumeSink as _;
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
        labels: volume.labels.as_ref().map(|l| crate::data::LabelVolume {
            grid: l.grid,
            labels: Vec::new(),
            segments: l.segments.clone(),
        }),
    };
    reducer.begin(&header).map_err(too_large)?;
    let slice = dims.x as usize * dims.y as usize;
    for z in 0..dims.z as usize {
        reducer.scalars(copy_range(&volume.voxels, z * slice, slice));
    }
    if let Some(labels) = &volume.labels {
        reducer.labels(labels.labels.clone());
    }
    let notice = reducer.reduction().map(|r| r.to_string());
    let small = builder
        .finish()
        .map_err(|why| RenderError::TooLarge(why.to_string()))?;
    Ok(Some((small, notice.unwrap_or_default())))
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

impl Upload {
    /// Makes the textures. The volume must fit ([`reduced_to_fit`]) and be whole.
    pub(super) fn new(gpu: &Gpu, volume: &Volume) -> Result<Self, RenderError> {
        let count = volume.grid.voxel_count();
        if volume.voxels.len() != count || count == 0 {
            return Err(RenderError::TooLarge(format!(
                "{} voxels came of {count}",
                volume.voxels.len()
            )));
        }
        let label_dims = match &volume.labels {
            Some(labels) if labels.labels.len() == labels.grid.voxel_count() => labels.grid.dims,
            _ => UVec3::ONE,
        };
        Ok(Self {
            volume_texture: volume_texture(
                gpu,
                "volume",
                volume.grid.dims,
                wgpu::TextureFormat::R16Float,
                wgpu::TextureUsages::COPY_DST,
            ),
            label_texture: label_texture(gpu, label_dims),
            next_slice: 0,
            next_label_slice: 0,
            scale: Normalise::of(volume),
            bricks: BrickBuilder::new(volume.grid.dims),
            scratch: Vec::new(),
        })
    }

    /// Fraction done, 0 to 1.
    pub(super) fn progress(&self) -> f32 {
        self.next_slice as f32 / self.volume_texture.depth_or_array_layers().max(1) as f32
    }

    /// Converts and hands over the next slab. True when all is handed over.
    pub(super) fn advance(&mut self, gpu: &Gpu, volume: &Volume) -> bool {
        let dims = volume.grid.dims;
        let slice = dims.x as usize * dims.y as usize;
        if self.next_slice < dims.z {
            let slices =
                (SLAB_BYTES / (2 * slice).max(1)).clamp(1, (dims.z - self.next_slice) as usize);
            let start = self.next_slice as usize * slice;
            self.scratch.clear();
            convert(
                &volume.voxels,
                start,
                slices * slice,
                self.scale,
                &mut self.scratch,
            );
            for (i, z_slice) in self.scratch.chunks_exact(slice).enumerate() {
                self.bricks.add_slice(self.next_slice + i as u32, z_slice);
            }
            write_slices(
                gpu,
                &self.volume_texture,
                self.next_slice,
                slices as u32,
                2,
                bytemuck::cast_slice(&self.scratch),
            );
            self.next_slice += slices as u32;
            return false;
        }
        let depth = self.label_texture.depth_or_array_layers();
        if let Some(labels) = &volume.labels
            && self.next_label_slice < depth
            && labels.grid.dims.z == depth
        {
            let slice = labels.grid.dims.x as usize * labels.grid.dims.y as usize;
            let slices =
                (SLAB_BYTES / slice.max(1)).clamp(1, (depth - self.next_label_slice) as usize);
            let start = self.next_label_slice as usize * slice;
            if let Some(part) = labels.labels.get(start..start + slices * slice) {
                let at = self.next_label_slice;
                write_slices(gpu, &self.label_texture, at, slices as u32, 1, part);
            }
            self.next_label_slice += slices as u32;
            return false;
        }
        true
    }

    /// The subject, once [`Upload::advance`] said that all is handed over.
    pub(super) fn finish(self, gpu: &Gpu, passes: &Passes, volume: &Volume) -> SubjectTextures {
        let labels = volume
            .labels
            .as_ref()
            .filter(|l| l.labels.len() == l.grid.voxel_count());
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let views = [view(&self.volume_texture), view(&self.label_texture)];
        let info = info(volume, false);
        assemble(gpu, passes, volume, labels, views, self.bricks.bricks, info)
    }
}

impl SubjectTextures {
    /// The same volume with other segments. `volume` is the one that was uploaded.
    ///
    /// # Errors
    /// [`RenderError::TooLarge`] if the device does not take so many labels along an axis, or they are not whole.
    pub(super) fn with_labels(
        &self,
        gpu: &Gpu,
        passes: &Passes,
        volume: &Volume,
        labels: Option<&LabelVolume>,
    ) -> Result<Self, RenderError> {
        let dims = labels.map_or(UVec3::ONE, |labels| labels.grid.dims);
        let most = gpu.device.limits().max_texture_dimension_3d;
        if dims.max_element() > most
            || labels.is_some_and(|l| l.labels.len() != l.grid.voxel_count())
        {
            return Err(RenderError::TooLarge(format!(
                "{} × {} × {} labels do not fit on this device",
                dims.x, dims.y, dims.z
            )));
        }
        let texture = label_texture(gpu, dims);
        if let Some(labels) = labels {
            let slice = dims.x as usize * dims.y as usize;
            let at_once = (SLAB_BYTES / slice.max(1)).max(1);
            for (i, part) in labels.labels.chunks(at_once * slice).enumerate() {
                let slices = (part.len() / slice) as u32;
                write_slices(gpu, &texture, (i * at_once) as u32, slices, 1, part);
            }
        }
        let views = [
            self.volume_view.clone(),
            texture.create_view(&Default::default()),
        ];
        let (bricks, info) = (self.bricks.clone(), self.info);
        Ok(assemble(gpu, passes, volume, labels, views, bricks, info))
    }
}

fn label_texture(gpu: &Gpu, dims: UVec3) -> wgpu::Texture {
    let format = wgpu::TextureFormat::R8Uint;
    volume_texture(gpu, "labels", dims, format, wgpu::TextureUsages::COPY_DST)
}

/// A texture of three dimensions that programs read; `usage` is what else is done with it.
pub(super) fn volume_texture(
    gpu: &Gpu,
    label: &str,
    dims: UVec3,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent(dims),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | usage,
        view_formats: &[],
    })
}

/// Everything that the passes want, around textures that are filled. `info` is complete but for the segments.
fn assemble(
    gpu: &Gpu,
    passes: &Passes,
    volume: &Volume,
    labels: Option<&LabelVolume>,
    [volume_view, label_view]: [wgpu::TextureView; 2],
    bricks: Bricks,
    mut info: SubjectInfo,
) -> SubjectTextures {
    let grid = &volume.grid;
    let dims = grid.dims.as_vec3();
    let label_grid = labels.map_or(grid, |l| &l.grid);
    // Labels may lie on another grid; both go through world space.
    let subject_from_world = grid.subject_from_voxel() * grid.world_from_voxel.inverse();
    let label_texture_from_voxel = DAffine3::from_scale(label_grid.dims.as_dvec3().recip())
        * DAffine3::from_translation(glam::DVec3::splat(0.5));
    let label_from_rest =
        label_texture_from_voxel * (subject_from_world * label_grid.world_from_voxel).inverse();
    let to = affine_rows(&affine32(&grid.texture_from_subject()));
    let label = affine_rows(&affine32(&label_from_rest));
    let spacing = (grid.spacing_mm().min_element() / grid.mm_per_unit()) as f32;
    let uniform = Subject {
        texture_from_rest_row0: to[0],
        texture_from_rest_row1: to[1],
        texture_from_rest_row2: to[2],
        label_from_rest_row0: label[0],
        label_from_rest_row1: label[1],
        label_from_rest_row2: label[2],
        dims: [dims.x, dims.y, dims.z, spacing],
        label_dims: {
            let d = if labels.is_some() {
                label_grid.dims.as_vec3()
            } else {
                glam::Vec3::ONE
            };
            [d.x, d.y, d.z, f32::from(u8::from(labels.is_some()))]
        },
        texture_end: [1.0, 1.0, 1.0, 0.0],
        value: [volume.value_range[0], span(volume.value_range), 0.0, 0.0],
    };
    let mut colors = [[0u8; 4]; 256];
    let mut has_segments = false;
    for segment in labels.into_iter().flat_map(|l| &l.segments) {
        if let (Some(slot), Some([r, g, b])) = (
            colors.get_mut(usize::from(segment.label)),
            segment.color_srgb,
        ) {
            // Of segments that overlap, the first that is listed gives its color.
            if *slot == [0; 4] {
                *slot = [r, g, b, 255];
            }
            has_segments = true;
        }
    }
    let palette = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("palette"),
        size: extent(UVec3::new(256, 1, 1)),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    write_slices(gpu, &palette, 0, 1, 4, bytemuck::cast_slice(&colors));
    let buffer = uniform_buffer(gpu, "subject", &uniform);
    let palette_view = palette.create_view(&Default::default());
    let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("subject"),
        layout: &passes.subject_layout,
        entries: &[
            entry(0, buffer.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&volume_view)),
            entry(2, wgpu::BindingResource::Sampler(&passes.linear_sampler)),
            entry(3, wgpu::BindingResource::TextureView(&label_view)),
            entry(4, wgpu::BindingResource::TextureView(&palette_view)),
        ],
    });
    info.has_segments = has_segments;
    let up = subject_from_world.inverse().matrix3 * grid.subject_from_voxel().matrix3;
    let rises = [up.x_axis, up.y_axis, up.z_axis].map(|axis| (axis.z / axis.length()).abs());
    let foot_axis = (0..3).fold(0, |best, i| if rises[i] > rises[best] { i } else { best });
    SubjectTextures {
        buffer,
        volume_view,
        label_view,
        sampler: passes.linear_sampler.clone(),
        frame: VoxelFrame::new(grid.dims, grid.subject_from_voxel()),
        label_frame: labels
            .map(|l| VoxelFrame::new(l.grid.dims, subject_from_world * l.grid.world_from_voxel)),
        foot_axis: foot_axis as u32,
        segments: labels.map(|l| l.segments.clone()).unwrap_or_default(),
        bind_group,
        bricks,
        label_bricks: labels
            .filter(|labels| labels.grid == *grid)
            .map(|labels| labels_in_bricks(labels, BRICK)),
        info,
        bounds: grid.subject_bounds(),
        uniform,
    }
}

/// One bind group entry.
pub(super) fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn affine32(affine: &DAffine3) -> Affine3A {
    affine.as_affine3a()
}

fn extent(dims: UVec3) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: dims.x,
        height: dims.y,
        depth_or_array_layers: dims.z,
    }
}

fn write_slices(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    first: u32,
    slices: u32,
    texel_bytes: u32,
    bytes: &[u8],
) {
    let (width, height) = (texture.width(), texture.height());
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d {
                x: 0,
                y: 0,
                z: first,
            },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * texel_bytes),
            rows_per_image: Some(height),
        },
        wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: slices,
        },
    );
}

/// Appends normalised half floats.
fn convert(voxels: &Voxels, start: usize, count: usize, scale: Normalise, out: &mut Vec<u16>) {
    fn run<T: Copy>(
        all: &[T],
        start: usize,
        count: usize,
        to: impl Fn(T) -> f32,
        out: &mut Vec<u16>,
    ) {
        let part = all.get(start..start + count).unwrap_or_default();
        out.extend(part.iter().map(|&v| f16::from_f32(to(v)).to_bits()));
    }
    match voxels {
        Voxels::U8(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::I16(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::U16(v) => run(v, start, count, |x| scale.apply(f32::from(x)), out),
        Voxels::F32(v) => run(v, start, count, |x| scale.apply(x), out),
    }
}

/// Finds out what kind of numbers these are.
fn info(volume: &Volume, has_segments: bool) -> SubjectInfo {
    let histogram = sampled_histogram(volume);
    let [low, high] = volume.value_range;
    let is_hounsfield = low <= -200.0 && high >= 200.0;
    // Twelve bits stored unsigned with water at about 1,024: most of what is not air lies about there.
    let share =
        share_between(&histogram, 880.0, 1180.0) / share_between(&histogram, 300.0, high).max(1e-6);
    let is_offset_ct =
        !is_hounsfield && low >= 0.0 && (1800.0..=4200.0).contains(&high) && share > 0.35;
    let window_auto = histogram.robust_window();
    SubjectInfo {
        value_range: volume.value_range,
        window_auto: if window_auto[1] > window_auto[0] {
            window_auto
        } else {
            [low, low + span(volume.value_range)]
        },
        is_ct: is_hounsfield || is_offset_ct,
        hounsfield_offset: if is_offset_ct { 1024.0 } else { 0.0 },
        has_segments,
    }
}

fn sampled_histogram(volume: &Volume) -> Histogram {
    let mut counts = vec![0u64; 256];
    let scale = Normalise::of(volume);
    let n = volume.voxels.len();
    // An odd stride does not run along the axes of grids with even sides.
    let stride = (n / HISTOGRAM_SAMPLES).max(1) | 1;
    let mut i = 0;
    while let Some(stored) = volume.voxels.get(i) {
        let bin = (scale.apply(stored) * 255.0 + 0.5) as usize;
        if let Some(count) = counts.get_mut(bin) {
            *count += 1;
        }
        i += stride;
    }
    Histogram {
        value_range: volume.value_range,
        counts,
    }
}

fn share_between(histogram: &Histogram, low: f32, high: f32) -> f32 {
    let [min, _] = histogram.value_range;
    let width = span(histogram.value_range) / 255.0;
    let (mut inside, mut total) = (0, 0);
    for (i, &count) in histogram.counts.iter().enumerate() {
        let value = min + i as f32 * width;
        total += count;
        if (low..=high).contains(&value) {
            inside += count;
        }
    }
    inside as f32 / total.max(1) as f32
}

#[derive(Debug)]
struct BrickBuilder {
    voxels: UVec3,
    bricks: Bricks,
    slice: Vec<[f32; 2]>,
    row: Vec<[f32; 2]>,
}

const NOTHING: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

fn join(into: &mut [f32; 2], other: [f32; 2]) {
    into[0] = into[0].min(other[0]);
    into[1] = into[1].max(other[1]);
}

/// Bricks that a coordinate belongs to: its own, and the neighbour that it borders on.
fn owners(coordinate: u32, count: u32) -> impl Iterator<Item = u32> {
    let own = coordinate / BRICK;
    let below = (coordinate.is_multiple_of(BRICK) && own > 0).then(|| own - 1);
    let above = (coordinate % BRICK == BRICK - 1 && own + 1 < count).then_some(own + 1);
    [Some(own), below, above].into_iter().flatten()
}

impl BrickBuilder {
    fn new(voxels: UVec3) -> Self {
        let dims = UVec3::new(
            voxels.x.div_ceil(BRICK),
            voxels.y.div_ceil(BRICK),
            voxels.z.div_ceil(BRICK),
        );
        let count = dims.as_u64vec3().element_product() as usize;
        Self {
            voxels,
            bricks: Bricks {
                dims,
                ranges: vec![NOTHING; count],
            },
            slice: vec![NOTHING; (dims.x * dims.y) as usize],
            row: vec![NOTHING; dims.x as usize],
        }
    }

    fn add_slice(&mut self, z: u32, texels: &[u16]) {
        let dims = self.bricks.dims;
        self.slice.fill(NOTHING);
        for (y, row) in texels.chunks_exact(self.voxels.x as usize).enumerate() {
            for (brick, range) in self.row.iter_mut().enumerate() {
                let start = (brick * BRICK as usize).saturating_sub(1);
                let end = ((brick + 1) * BRICK as usize + 1).min(row.len());
                // Half floats from 0 to 1 sort as their bits do.
                let (mut low, mut high) = (u16::MAX, 0);
                for &bits in row.get(start..end).unwrap_or_default() {
                    low = low.min(bits);
                    high = high.max(bits);
                }
                *range = [f16::from_bits(low).to_f32(), f16::from_bits(high).to_f32()];
            }
            for by in owners(y as u32, dims.y) {
                let start = (by * dims.x) as usize;
                for (into, &range) in self.slice.iter_mut().skip(start).zip(&self.row) {
                    join(into, range);
                }
            }
        }
        for bz in owners(z, dims.z) {
            let start = (bz * dims.x * dims.y) as usize;
            for (into, &range) in self.bricks.ranges.iter_mut().skip(start).zip(&self.slice) {
                join(into, range);
            }
        }
    }
}

/// A whole grid's bricks at once (tests).
#[cfg(test)]
fn bricks_of(grid: &crate::data::Grid, texels: &[u16]) -> Bricks {
    let mut builder = BrickBuilder::new(grid.dims);
    let slice = (grid.dims.x * grid.dims.y) as usize;
    for (z, part) in texels.chunks_exact(slice).enumerate() {
        builder.add_slice(z as u32, part);
    }
    builder.bricks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Grid;
    use glam::DMat3;

    #[test]
    fn bricks_hold_their_border() {
        let dims = UVec3::new(19, 17, 10);
        let grid = Grid {
            dims,
            world_from_voxel: DAffine3::from_mat3(DMat3::IDENTITY),
        };
        let texel = |x: u32, y: u32, z: u32| ((x * 7 + y * 31 + z * 101) % 257) as f32 / 256.0;
        let mut texels = Vec::new();
        for z in 0..dims.z {
            for y in 0..dims.y {
                for x in 0..dims.x {
                    texels.push(f16::from_f32(texel(x, y, z)).to_bits());
                }
            }
        }
        let bricks = bricks_of(&grid, &texels);
        assert_eq!(bricks.dims, UVec3::new(3, 3, 2));
        for (i, range) in bricks.ranges.iter().enumerate() {
            let i = i as u32;
            let brick = UVec3::new(i % 3, (i / 3) % 3, i / 9);
            let mut expected = NOTHING;
            let start = (brick * BRICK).saturating_sub(UVec3::ONE);
            let end = (brick * BRICK + BRICK + 1).min(dims);
            for z in start.z..end.z {
                for y in start.y..end.y {
                    for x in start.x..end.x {
                        let v = f16::from_f32(texel(x, y, z)).to_f32();
                        join(&mut expected, [v, v]);
                    }
                }
            }
            assert_eq!(*range, expected, "brick {brick}");
        }
    }

    #[test]
    fn what_is_no_number_counts_as_the_smallest() {
        let scale = Normalise {
            slope: 0.1,
            offset: 0.2,
        };
        assert_eq!(scale.apply(f32::NAN), 0.0);
        assert_eq!(scale.apply(f32::INFINITY), 1.0);
        assert_eq!(scale.apply(f32::NEG_INFINITY), 0.0);
    }
}
