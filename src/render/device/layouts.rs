//! The table of bindings: what the programs of the picture bind, and what WebGPU leaves for more.
//!
//! | group | holds | uniform buffers | textures | samplers |
//! |---|---|---|---|---|
//! | 0 | the frame: camera and sampling | 1 | | |
//! | 1 | the subject: values, labels, palette, triangles, depths and fills of meshes | 1 | 6 | 1 |
//! | 2 | the scene: templates, look, skip grid, kept tissue, fields, bodies, meshes, objects, carve, sweep | 7 | 9 | |
//! | 3 | the pass: the baked map | 1 | 1 | |
//! | | in all | 10 | 16 | 1 |
//! | | left in one stage | 2 | 0 | 15 |
//!
//! Group 3 belongs to the pass: other passes (picks, resolve, slices) bind less there. A picture uses no storage
//! buffer.

use super::gpu::Gpu;
use wgpu::TextureViewDimension::{D2, D3};

/// What a binding holds.
#[derive(Clone, Copy, Debug)]
enum Holds {
    Uniform,
    /// Numbers that are interpolated.
    Texture(wgpu::TextureViewDimension),
    /// Numbers that are taken as they are.
    Exact(wgpu::TextureViewDimension),
    /// Whole numbers, which are not interpolated.
    Numbers(wgpu::TextureViewDimension),
    Sampler,
}

/// What the bindings of a group hold, from binding 0 on.
type Group = &'static [Holds];

const FRAME: Group = &[Holds::Uniform];
/// The uniform, values, how they are read, labels, the colours of labels, triangles, depths and fills of meshes.
const SUBJECT: Group = &[
    Holds::Uniform,
    Holds::Texture(D3),
    Holds::Sampler,
    Holds::Numbers(D3),
    Holds::Texture(D2),
    Holds::Numbers(D2),
    Holds::Texture(D3),
    Holds::Numbers(D3),
];
/// Templates, look and its table, the skip grid and its cells, kept tissue and its distances, fields, bodies and
/// their shares, how a mesh is drawn, objects and their triangles, the grids of objects that carve, shares of kept
/// tissue, steps of sweeps.
const SCENE: Group = &[
    Holds::Uniform,
    Holds::Uniform,
    Holds::Texture(D2),
    Holds::Uniform,
    Holds::Numbers(D3),
    Holds::Uniform,
    Holds::Texture(D3),
    Holds::Texture(D3),
    Holds::Uniform,
    Holds::Texture(D3),
    Holds::Uniform,
    Holds::Uniform,
    Holds::Numbers(D2),
    Holds::Numbers(D2),
    Holds::Texture(D3),
    Holds::Exact(D2),
];
/// Where the baked map lies, and the map.
const BAKED: Group = &[Holds::Uniform, Holds::Texture(D3)];
/// The rays that are asked, at a binding that the baked map leaves: one module draws and picks.
const RAYS: Group = &[Holds::Uniform];
pub(crate) const RAYS_BINDING: u32 = 2;
/// The accumulated picture and how it is read.
const RESOLVE: Group = &[Holds::Uniform, Holds::Texture(D2), Holds::Sampler];
/// The style, and what each pixel shows: its colour, its place, its surface.
const STYLE: Group = &[
    Holds::Uniform,
    Holds::Texture(D2),
    Holds::Exact(D2),
    Holds::Numbers(D2),
];
const SLICE: Group = &[Holds::Uniform];
/// Where the plate of a figure lies, and its pixels.
const SHEET: Group = &[Holds::Uniform, Holds::Exact(D2)];

/// The layouts of all groups, and the sampler that goes with them. Built once per device.
#[derive(Debug)]
pub(crate) struct Layouts {
    /// Group 0 of the picture.
    pub frame: wgpu::BindGroupLayout,
    /// Group 1 of the picture and of slices.
    pub subject: wgpu::BindGroupLayout,
    /// Group 2 of the picture and of slices.
    pub scene: wgpu::BindGroupLayout,
    /// Group 3 of a picture that is drawn from the baked map.
    pub baked: wgpu::BindGroupLayout,
    /// Group 3 of picks: the rays that are asked.
    pub rays: wgpu::BindGroupLayout,
    /// Group 3 of the pass from the accumulated picture to the one that is shown.
    pub resolve: wgpu::BindGroupLayout,
    /// Group 3 of the pass that draws a style.
    pub style: wgpu::BindGroupLayout,
    /// Group 3 of the pass that draws a figure.
    pub sheet: wgpu::BindGroupLayout,
    /// Group 3 of slices.
    pub slice: wgpu::BindGroupLayout,
    /// Stands for a group that a pass does not bind.
    pub empty: wgpu::BindGroupLayout,
    /// Reads textures with interpolation, to their edges.
    pub linear_sampler: wgpu::Sampler,
}

impl Layouts {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            frame: group_layout_from(gpu, "frame", 0, FRAME, PLACED),
            subject: group_layout(gpu, "subject", SUBJECT),
            scene: group_layout(gpu, "scene", SCENE),
            baked: group_layout(gpu, "baked", BAKED),
            rays: group_layout_from(gpu, "rays", RAYS_BINDING, RAYS, DRAWN),
            resolve: group_layout(gpu, "resolve", RESOLVE),
            style: group_layout(gpu, "style", STYLE),
            sheet: group_layout_from(gpu, "sheet", 0, SHEET, PLACED),
            slice: group_layout(gpu, "slice", SLICE),
            empty: group_layout(gpu, "empty", &[]),
            linear_sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("linear"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
        }
    }
}

/// The layout of a pipeline with these groups, from group 0 on.
pub(crate) fn pipeline_layout(
    gpu: &Gpu,
    label: &str,
    groups: &[&wgpu::BindGroupLayout],
) -> wgpu::PipelineLayout {
    let groups: Vec<_> = groups.iter().map(|group| Some(*group)).collect();
    gpu.device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        })
}

/// Bound where pixels are coloured.
const DRAWN: wgpu::ShaderStages = wgpu::ShaderStages::FRAGMENT;
/// Bound where corners of triangles are placed too.
const PLACED: wgpu::ShaderStages = wgpu::ShaderStages::VERTEX_FRAGMENT;

fn group_layout(gpu: &Gpu, label: &str, group: Group) -> wgpu::BindGroupLayout {
    group_layout_from(gpu, label, 0, group, DRAWN)
}

fn group_layout_from(
    gpu: &Gpu,
    label: &str,
    first: u32,
    group: Group,
    visibility: wgpu::ShaderStages,
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (first..)
        .zip(group)
        .map(|(binding, holds)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: holds.binding_type(),
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        })
}

impl Holds {
    fn binding_type(self) -> wgpu::BindingType {
        let texture = |view_dimension, sample_type| wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        match self {
            Self::Uniform => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            Self::Texture(dimension) => texture(
                dimension,
                wgpu::TextureSampleType::Float { filterable: true },
            ),
            Self::Exact(dimension) => texture(
                dimension,
                wgpu::TextureSampleType::Float { filterable: false },
            ),
            Self::Numbers(dimension) => texture(dimension, wgpu::TextureSampleType::Uint),
            Self::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_with_everything_on_leaves_what_the_table_says() {
        let all = [FRAME, SUBJECT, SCENE, BAKED];
        let count = |is_it: fn(&Holds) -> bool| {
            let counts = all
                .iter()
                .map(|group| group.iter().filter(|h| is_it(h)).count());
            counts.sum::<usize>() as u32
        };
        let limits = wgpu::Limits::defaults();
        let uniforms = count(|h| matches!(h, Holds::Uniform));
        let textures =
            count(|h| matches!(h, Holds::Texture(_) | Holds::Exact(_) | Holds::Numbers(_)));
        let samplers = count(|h| matches!(h, Holds::Sampler));
        assert_eq!([uniforms, textures, samplers], [10, 16, 1]);
        let left = [
            limits.max_uniform_buffers_per_shader_stage - uniforms,
            limits.max_sampled_textures_per_shader_stage - textures,
            limits.max_samplers_per_shader_stage - samplers,
        ];
        assert_eq!(left, [2, 0, 15]);
        assert_eq!(all.len() as u32, limits.max_bind_groups, "no group is left");
    }
}
