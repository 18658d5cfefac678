use super::baked::BakePasses;
use super::bodies::{BodyPass, BodyTextures};
use super::feature::{DistancePasses, FeatureTextures};
use super::gpu_types::{Grid, Look, TABLE_FORMAT, Templates};
use super::grid::GridPasses;
use super::look::{TABLE_SIZE, TransferTable};
use super::programs::module;
use super::rigid::RigidPasses;
use super::subject::{entry, volume_texture};
use super::{Gpu, RenderError, SubjectInfo, uniform_buffer};
use crate::document::OpacityMode;
use glam::UVec3;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Format of the accumulated picture: linear light, premultiplied, blendable everywhere.
pub(super) const LINEAR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of the shown picture.
pub(super) const OUTPUT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Format of what a pick reads.
pub(super) const PICK_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// What a ray march pipeline is made for. Few of them per document: software GPUs run every branch, so what a document
/// does not use is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct RaycastKey {
    /// Bit k: templates of kind k occur.
    pub drawn_kinds: u32,
    /// The subject has labels and the look tints by them.
    pub has_labels: bool,
    /// There is a grid to leap with.
    pub has_grid: bool,
    /// How kept tissue is found: 0 nothing is kept, 1 by one group, 2 by a chain, 3 by asking back.
    pub align_mode: u32,
    /// How displacements give way to kept tissue, a bit for each `CONSTRAIN_` mode that occurs.
    pub constraints: u32,
    /// What says that tissue is kept: bit 0 its segment, bit 1 its depth.
    pub kept_by: u32,
    /// Opacity follows the gradient.
    pub has_edges: bool,
    /// Segments are drawn as bodies of their own.
    pub has_bodies: bool,
    /// The map is read from its baked texture.
    pub is_baked: bool,
    /// For picking instead of drawing.
    pub is_pick: bool,
}

impl RaycastKey {
    /// True if templates leave tissue alone or give way to it: a longer program.
    pub(super) fn keeps_tissue(&self) -> bool {
        self.align_mode != 0
    }

    /// The pipeline constants of march/align.wgsl.
    pub(super) fn align_constants(&self) -> [(&'static str, f64); 3] {
        [
            ("align_mode", f64::from(self.align_mode)),
            ("has_constraints", f64::from(self.constraints)),
            ("kept_by", f64::from(self.kept_by)),
        ]
    }
}

/// Layouts, samplers and pipelines. Built once per device and shared.
#[derive(Debug)]
pub(super) struct Passes {
    pub frame_layout: wgpu::BindGroupLayout,
    pub subject_layout: wgpu::BindGroupLayout,
    pub scene_layout: wgpu::BindGroupLayout,
    pub resolve_layout: wgpu::BindGroupLayout,
    pub linear_sampler: wgpu::Sampler,
    pub grid: GridPasses,
    pub bake: BakePasses,
    distance: OnceLock<Arc<DistancePasses>>,
    /// For documents in which a segment moves as a whole.
    pub rigid: RigidPasses,
    bodies: OnceLock<Arc<BodyPass>>,
    resolve_pipeline: wgpu::RenderPipeline,
    raycast_module: wgpu::ShaderModule,
    /// For documents that keep tissue; compiled when the first one comes.
    aligned_module: OnceLock<wgpu::ShaderModule>,
    /// For pictures of the baked map; compiled when the first one comes.
    baked_module: OnceLock<wgpu::ShaderModule>,
    raycast_layout: wgpu::PipelineLayout,
    baked_layout: wgpu::PipelineLayout,
    raycast_pipelines: Mutex<HashMap<RaycastKey, Arc<wgpu::RenderPipeline>>>,
}

impl Passes {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let device = &gpu.device;
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let frame_layout = layout("frame", &[uniform(0)]);
        let subject_layout = layout(
            "subject",
            &[
                uniform(0),
                texture(1, wgpu::TextureViewDimension::D3, FILTERED),
                sampler(2),
                texture(
                    3,
                    wgpu::TextureViewDimension::D3,
                    wgpu::TextureSampleType::Uint,
                ),
                texture(4, wgpu::TextureViewDimension::D2, FILTERED),
            ],
        );
        let scene_layout = layout(
            "scene",
            &[
                uniform(0),
                uniform(1),
                texture(2, wgpu::TextureViewDimension::D2, FILTERED),
                uniform(3),
                texture(
                    4,
                    wgpu::TextureViewDimension::D3,
                    wgpu::TextureSampleType::Uint,
                ),
                uniform(5),
                texture(6, wgpu::TextureViewDimension::D3, FILTERED),
                texture(7, wgpu::TextureViewDimension::D3, FILTERED),
                uniform(8),
                texture(9, wgpu::TextureViewDimension::D3, FILTERED),
            ],
        );
        let resolve_layout = layout(
            "resolve",
            &[
                uniform(0),
                texture(1, wgpu::TextureViewDimension::D2, FILTERED),
                sampler(2),
            ],
        );
        let empty = layout("empty", &[]);
        let bake = BakePasses::new(gpu)?;
        let raycast_groups = [
            Some(&frame_layout),
            Some(&subject_layout),
            Some(&scene_layout),
            Some(&bake.layout),
        ];
        let raycast_layout = |groups| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("raycast"),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let baked_layout = raycast_layout(&raycast_groups);
        let raycast_layout = raycast_layout(&raycast_groups[..3]);
        let resolve_pipeline_layout =
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("resolve"),
                bind_group_layouts: &[
                    Some(&empty),
                    Some(&empty),
                    Some(&empty),
                    Some(&resolve_layout),
                ],
                immediate_size: 0,
            });
        let resolve_module = module(gpu, "resolve")?;
        let resolve_pipeline = render_pipeline(
            gpu,
            &PipelineParts {
                label: "resolve",
                layout: &resolve_pipeline_layout,
                module: &resolve_module,
                entry: "encode",
                constants: &[],
                format: OUTPUT_FORMAT,
                blend: None,
            },
        );
        Ok(Self {
            grid: GridPasses::new(gpu)?,
            bake,
            distance: OnceLock::new(),
            rigid: RigidPasses::default(),
            bodies: OnceLock::new(),
            raycast_module: module(gpu, "raycast")?,
            aligned_module: OnceLock::new(),
            baked_module: OnceLock::new(),
            linear_sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("linear"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            frame_layout,
            subject_layout,
            scene_layout,
            resolve_layout,
            resolve_pipeline,
            raycast_layout,
            baked_layout,
            raycast_pipelines: Mutex::new(HashMap::new()),
        })
    }

    /// The pipeline for a key; made on first use.
    pub(super) fn raycast(&self, gpu: &Gpu, key: RaycastKey) -> Arc<wgpu::RenderPipeline> {
        let mut made = self
            .raycast_pipelines
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let pipeline = made.entry(key).or_insert_with(|| {
            let number = |flag: bool| f64::from(u8::from(flag));
            let mut constants = vec![
                ("drawn_kinds", f64::from(key.drawn_kinds)),
                ("has_labels", number(key.has_labels)),
                ("has_grid", number(key.has_grid)),
                ("has_edges", number(key.has_edges)),
                ("has_bodies", number(key.has_bodies)),
            ];
            let other = if key.is_baked {
                other_module(&self.baked_module, gpu, "raycast_baked")
            } else if key.keeps_tissue() {
                other_module(&self.aligned_module, gpu, "raycast_aligned")
            } else {
                None
            };
            if other.is_some() && !key.is_baked {
                constants.extend(key.align_constants());
            }
            Arc::new(render_pipeline(
                gpu,
                &PipelineParts {
                    label: "raycast",
                    layout: if key.is_baked {
                        &self.baked_layout
                    } else {
                        &self.raycast_layout
                    },
                    module: other.unwrap_or(&self.raycast_module),
                    entry: if key.is_pick { "pick" } else { "draw" },
                    constants: &constants,
                    format: if key.is_pick {
                        PICK_FORMAT
                    } else {
                        LINEAR_FORMAT
                    },
                    // Sample k counts 1/(k + 1): the mean so far.
                    blend: (!key.is_pick).then_some(MEAN),
                },
            ))
        });
        Arc::clone(pipeline)
    }

    /// The programs that make distances; compiled when first asked for. `None` if the table lacks them.
    pub(super) fn distance(&self, gpu: &Gpu) -> Option<Arc<DistancePasses>> {
        if self.distance.get().is_none()
            && let Ok(passes) = DistancePasses::new(gpu)
        {
            let _set_already = self.distance.set(Arc::new(passes));
        }
        self.distance.get().cloned()
    }

    /// The program that shares places out to bodies; compiled when first asked for. `None` if the table lacks it.
    pub(super) fn bodies(&self, gpu: &Gpu) -> Option<Arc<BodyPass>> {
        if self.bodies.get().is_none()
            && let Ok(pass) = BodyPass::new(gpu)
        {
            let _set_already = self.bodies.set(Arc::new(pass));
        }
        self.bodies.get().cloned()
    }

    pub(super) fn resolve(&self) -> &wgpu::RenderPipeline {
        &self.resolve_pipeline
    }
}

/// A module that not every document needs; compiled when first asked for.
fn other_module<'a>(
    slot: &'a OnceLock<wgpu::ShaderModule>,
    gpu: &Gpu,
    program: &str,
) -> Option<&'a wgpu::ShaderModule> {
    if slot.get().is_none()
        && let Ok(module) = module(gpu, program)
    {
        let _set_already = slot.set(module);
    }
    slot.get()
}

const FILTERED: wgpu::TextureSampleType = wgpu::TextureSampleType::Float { filterable: true };

const MEAN_PART: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::Constant,
    dst_factor: wgpu::BlendFactor::OneMinusConstant,
    operation: wgpu::BlendOperation::Add,
};
const MEAN: wgpu::BlendState = wgpu::BlendState {
    color: MEAN_PART,
    alpha: MEAN_PART,
};

pub(super) fn uniform(binding: u32) -> wgpu::BindGroupLayoutEntry {
    layout_entry(
        binding,
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
    )
}

fn texture(
    binding: u32,
    view_dimension: wgpu::TextureViewDimension,
    sample_type: wgpu::TextureSampleType,
) -> wgpu::BindGroupLayoutEntry {
    layout_entry(
        binding,
        wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        },
    )
}

fn sampler(binding: u32) -> wgpu::BindGroupLayoutEntry {
    layout_entry(
        binding,
        wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
    )
}

fn layout_entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    }
}

/// What a pipeline over the whole target is made of.
pub(super) struct PipelineParts<'a> {
    pub label: &'a str,
    pub layout: &'a wgpu::PipelineLayout,
    pub module: &'a wgpu::ShaderModule,
    pub entry: &'a str,
    pub constants: &'a [(&'a str, f64)],
    pub format: wgpu::TextureFormat,
    pub blend: Option<wgpu::BlendState>,
}

pub(super) fn render_pipeline(gpu: &Gpu, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
    let options = wgpu::PipelineCompilationOptions {
        constants: parts.constants,
        ..Default::default()
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(parts.label),
            layout: Some(parts.layout),
            vertex: wgpu::VertexState {
                module: parts.module,
                entry_point: Some("cover"),
                compilation_options: options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: parts.module,
                entry_point: Some(parts.entry),
                compilation_options: options,
                targets: &[Some(wgpu::ColorTargetState {
                    format: parts.format,
                    blend: parts.blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn scene_group(
    gpu: &Gpu,
    passes: &Passes,
    [templates, look]: [&wgpu::Buffer; 2],
    table: &wgpu::Texture,
    grid: &(wgpu::Buffer, wgpu::TextureView),
    (features, fields, bodies): (&FeatureTextures, &wgpu::TextureView, &BodyTextures),
) -> wgpu::BindGroup {
    let table_view = table.create_view(&Default::default());
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("scene"),
        layout: &passes.scene_layout,
        entries: &[
            entry(0, templates.as_entire_binding()),
            entry(1, look.as_entire_binding()),
            entry(2, wgpu::BindingResource::TextureView(&table_view)),
            entry(3, grid.0.as_entire_binding()),
            entry(4, wgpu::BindingResource::TextureView(&grid.1)),
            entry(5, features.uniform.as_entire_binding()),
            entry(6, wgpu::BindingResource::TextureView(&features.view)),
            entry(7, wgpu::BindingResource::TextureView(fields)),
            entry(8, bodies.uniform.as_entire_binding()),
            entry(9, wgpu::BindingResource::TextureView(&bodies.view)),
        ],
    })
}

/// Group 2: templates, look, grid and kept tissue of one illustration.
#[derive(Debug)]
pub(super) struct Scene {
    pub templates: wgpu::Buffer,
    look: wgpu::Buffer,
    table: wgpu::Texture,
    /// Uniform and cells of the grid, or of none.
    grid: (wgpu::Buffer, wgpu::TextureView),
    pub bind_group: wgpu::BindGroup,
}

impl Scene {
    /// With nothing in it and no grid.
    pub(super) fn new(
        gpu: &Gpu,
        passes: &Passes,
        grid: Option<(&wgpu::Buffer, &wgpu::TextureView)>,
        features: &FeatureTextures,
        fields: &wgpu::TextureView,
        bodies: &BodyTextures,
    ) -> Self {
        let templates = uniform_buffer(gpu, "templates", &Templates::NONE);
        let look = uniform_buffer(gpu, "look", &Look::default());
        let table = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("transfer table"),
            size: wgpu::Extent3d {
                width: TABLE_SIZE as u32,
                height: 1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TABLE_FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let no_grid = uniform_buffer(gpu, "no grid", &Grid::default());
        let format = wgpu::TextureFormat::Rg32Uint;
        let no_use = wgpu::TextureUsages::empty();
        let no_cells = volume_texture(gpu, "no grid", UVec3::ONE, format, no_use)
            .create_view(&Default::default());
        let (grid_buffer, grid_view) = grid.unwrap_or((&no_grid, &no_cells));
        let grid = (grid_buffer.clone(), grid_view.clone());
        let bind_group = scene_group(
            gpu,
            passes,
            [&templates, &look],
            &table,
            &grid,
            (features, fields, bodies),
        );
        Self {
            templates,
            look,
            table,
            grid,
            bind_group,
        }
    }

    /// Takes over another texture of distances, of fields or of bodies.
    pub(super) fn set_features(
        &mut self,
        gpu: &Gpu,
        passes: &Passes,
        features: &FeatureTextures,
        fields: &wgpu::TextureView,
        bodies: &BodyTextures,
    ) {
        let uniforms = [&self.templates, &self.look];
        self.bind_group = scene_group(
            gpu,
            passes,
            uniforms,
            &self.table,
            &self.grid,
            (features, fields, bodies),
        );
    }

    pub(super) fn set_templates(&self, gpu: &Gpu, templates: &Templates) {
        gpu.queue
            .write_buffer(&self.templates, 0, bytemuck::bytes_of(templates));
    }

    pub(super) fn set_look(
        &self,
        gpu: &Gpu,
        table: &TransferTable,
        mode: OpacityMode,
        info: &SubjectInfo,
    ) {
        gpu.queue.write_buffer(
            &self.look,
            0,
            bytemuck::bytes_of(&table.uniform(mode, info)),
        );
        gpu.queue.write_texture(
            self.table.as_image_copy(),
            bytemuck::cast_slice(&table.texels()),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(8 * TABLE_SIZE as u32),
                rows_per_image: Some(1),
            },
            wgpu::Extent3d {
                width: TABLE_SIZE as u32,
                height: 1,
                depth_or_array_layers: 1,
            },
        );
    }
}
