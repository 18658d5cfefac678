//! Kept tissue: which labels a document's templates leave alone, and how far every place is from them.

use super::gpu_types::{
    CONSTRAIN_COORDINATE, CONSTRAIN_DISPLACEMENT, CONSTRAIN_RIGID, DistanceJob, FeatureItem,
    Features, KEEPS_DEEP, MAX_TEMPLATES, affine_rows,
};
use super::passes::Passes;
use super::programs::module;
use super::subject::{SubjectTextures, VoxelFrame, entry, volume_texture};
use super::{Gpu, RenderError, uniform_buffer};
use crate::data::Segment;
use crate::displace::max_displacement;
use crate::document::{
    Align, ConstrainBy, MAX_KEEP_SETS, PlacedTemplate, TemplateMode, keep_set, keep_sets,
};
use crate::math::Aabb;
use glam::{DAffine3, UVec3, Vec3};

/// Voxels of the distances at most: 128³, 16 MiB of texture. Surfaces stay exact to the fine voxels; what is coarser is where the distance
/// is asked for, and it is interpolated between.
const MOST_VOXELS: u64 = 1 << 21;
/// Bytes of the lines that are worked on at a time.
const PART_BYTES: u64 = 32 << 20;
/// Rounds of spreading the outside along the three axes. Each round turns three corners; no body has a dozen on the way out.
const SWEEP_ROUNDS: usize = 6;
/// Channel of the distance to the outside.
const CHANNEL_OUTSIDE: u32 = 4;
/// Below this (Hounsfield units) there is air: half of it lies between air and soft tissue.
const AIR_BELOW: f32 = -500.0;
/// How far around a segment that moves as a whole other tissue goes with it, as a share of the longest displacement: less folds it.
const RIGID_REACH: f32 = 0.3;
/// Where values have no unit: part of the window, from its low end, up to which there is nothing.
const DARK_PART: f32 = 0.12;

/// What of the labels a document's templates keep.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTissue {
    /// Sets of each label, four bits each, as the shaders take it.
    pub label_sets: [[u32; 4]; 8],
    /// Number of sets.
    pub set_count: u32,
    /// Some template keeps what lies deep under the outer surface.
    pub keeps_deep: bool,
    /// Per enabled template, in order.
    pub items: [FeatureItem; MAX_TEMPLATES],
    /// Names in `keep` that the subject has no segment for.
    pub unknown: Vec<String>,
    /// What the pipeline constant `align_mode` has to be. 0: nothing is kept or gives way; 1: the list is one group; 2: the first
    /// templates of the list keep the same; 3: any.
    pub align_mode: u32,
    /// How displacements give way, a bit for each `CONSTRAIN_` mode that occurs.
    pub constraints: u32,
}

/// The label that a name or number in `keep` means.
pub(super) fn labels_of(name: &str, segments: &[Segment]) -> Vec<u8> {
    let named: Vec<u8> = segments
        .iter()
        .filter(|s| s.name == name)
        .filter_map(|s| u8::try_from(s.label).ok())
        .collect();
    if !named.is_empty() {
        return named;
    }
    // Names may differ in case only where files were written by several programs.
    let similar: Vec<u8> = segments
        .iter()
        .filter(|s| s.name.eq_ignore_ascii_case(name))
        .filter_map(|s| u8::try_from(s.label).ok())
        .collect();
    if !similar.is_empty() {
        return similar;
    }
    match name.parse::<u8>() {
        Ok(label) if label > 0 => {
            // Where the segment overlaps others it stands under labels of their own.
            let own = segments.iter().find(|s| s.label == u16::from(label));
            let stands_for = |label: u16| segments.iter().filter(|s| s.label == label).count();
            let overlaps = segments
                .iter()
                .filter(|s| own.is_some_and(|own| s.name == own.name) && stands_for(s.label) > 1)
                .filter_map(|s| u8::try_from(s.label).ok());
            std::iter::once(label).chain(overlaps).collect()
        }
        _ => Vec::new(),
    }
}

impl KeptTissue {
    /// What the templates keep of a subject with these segments. `bounds` is the box of the subject at rest.
    pub fn of(templates: &[PlacedTemplate], segments: &[Segment], bounds: Aabb) -> Self {
        let mut kept = Self {
            label_sets: [[0; 4]; 8],
            set_count: 0,
            keeps_deep: false,
            items: [FeatureItem::default(); MAX_TEMPLATES],
            unknown: Vec::new(),
            align_mode: 0,
            constraints: 0,
        };
        let acting: Vec<PlacedTemplate> = templates
            .iter()
            .map(PlacedTemplate::acting)
            .filter(|t| t.enabled)
            .take(MAX_TEMPLATES)
            .collect();
        let enabled: Vec<&PlacedTemplate> = acting.iter().collect();
        let sets = keep_sets(&acting);
        for (set, names) in sets.iter().take(MAX_KEEP_SETS).enumerate() {
            for name in names {
                let labels = labels_of(name, segments);
                if labels.is_empty() && !kept.unknown.contains(name) {
                    kept.unknown.push(name.clone());
                }
                for label in labels.into_iter().map(usize::from) {
                    kept.label_sets[label / 32][label / 8 % 4] |= 1 << (4 * (label % 8) + set);
                }
            }
            kept.set_count = set as u32 + 1;
        }
        let bit = |keep: &[String]| {
            let wanted = keep_set(keep);
            sets.iter()
                .take(MAX_KEEP_SETS)
                .position(|set| *set == wanted)
                .map_or(0, |i| 1 << i)
        };
        let mut head = 0;
        for (index, template) in enabled.iter().enumerate() {
            if index == 0 || template.mode == TemplateMode::Compose {
                head = index;
            }
            let longest = max_displacement(template, bounds);
            let item = &mut kept.items[head];
            item.lengths[2] += longest;
            match &template.align {
                Align::Axis => {}
                Align::Surface { depth, thickness } => {
                    // Two depths in one group: what either keeps.
                    let is_first = item.keeps[0] & KEEPS_DEEP == 0;
                    item.lengths[0] = if is_first {
                        *depth
                    } else {
                        item.lengths[0].min(*depth)
                    };
                    item.lengths[1] = item.lengths[1].max(*thickness);
                    item.keeps[0] |= KEEPS_DEEP;
                    kept.keeps_deep = true;
                }
                Align::Segment { keep, thickness } => {
                    item.lengths[1] = item.lengths[1].max(*thickness);
                    item.keeps[0] |= bit(keep);
                }
            }
            if let Some(constrain) = &template.constrain
                && bit(&constrain.keep) != 0
            {
                item.keeps[2] |= bit(&constrain.keep);
                item.keeps[3] = match constrain.by {
                    ConstrainBy::Displacement => CONSTRAIN_DISPLACEMENT,
                    ConstrainBy::Coordinate => CONSTRAIN_COORDINATE,
                    ConstrainBy::Rigid => CONSTRAIN_RIGID,
                };
                kept.constraints |= 1 << item.keeps[3];
            }
        }
        for item in kept
            .items
            .iter_mut()
            .filter(|i| i.keeps[3] == CONSTRAIN_RIGID)
        {
            item.lengths[3] = (RIGID_REACH * item.lengths[2]).clamp(0.02, 0.06);
            // The motion nearest to a displacement goes farther than it in places.
            item.lengths[2] = 1.5 * item.lengths[2] + 0.02;
        }
        kept.find_runs(&enabled);
        kept
    }

    fn find_runs(&mut self, enabled: &[&PlacedTemplate]) {
        let is_head = |i: usize, t: &PlacedTemplate| i == 0 || t.mode == TemplateMode::Compose;
        let heads: Vec<usize> = enabled
            .iter()
            .enumerate()
            .filter(|(i, t)| is_head(*i, t))
            .map(|(i, _)| i)
            .collect();
        let (mut base, mut before) = (0, None);
        for &head in &heads {
            let item = &mut self.items[head];
            let same = (item.keeps[0], item.lengths[0].to_bits());
            if before != Some(same) {
                base = head;
                before = Some(same);
            }
            item.keeps[1] = base as u32;
        }
        let keeping: Vec<usize> = heads
            .iter()
            .copied()
            .filter(|&i| self.items[i].keeps[0] != 0)
            .collect();
        self.align_mode = if keeping.is_empty() && self.constraints == 0 {
            0
        } else if heads.len() == 1 {
            1
        } else if keeping.iter().all(|&i| self.items[i].keeps[1] == 0) {
            2
        } else {
            3
        };
    }

    /// One line for each name that the subject has no segment for.
    pub fn notices(&self) -> Vec<String> {
        self.unknown
            .iter()
            .map(|name| super::scene::kept_notice(name))
            .collect()
    }

    /// True if nothing is kept and nothing gives way.
    pub fn is_nothing(&self) -> bool {
        self.align_mode == 0
    }

    /// True if some segment moves as a whole.
    pub fn has_rigid(&self) -> bool {
        self.constraints & (1 << CONSTRAIN_RIGID) != 0
    }

    /// What the pipeline constant `kept_by` has to be: bit 0 for segments, bit 1 for the depth.
    pub fn kept_by(&self) -> u32 {
        u32::from(self.set_count > 0) | u32::from(self.keeps_deep) << 1
    }

    fn needs_distances(&self) -> bool {
        !self.is_nothing()
    }
}

/// The compute programs. Built once per device, the first time that a document keeps something.
#[derive(Debug)]
pub(super) struct DistancePasses {
    open_blocks: wgpu::ComputePipeline,
    sweep: wgpu::ComputePipeline,
    along: [wgpu::ComputePipeline; 3],
    smooth: [wgpu::ComputePipeline; 2],
    write: wgpu::ComputePipeline,
}

impl DistancePasses {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let module = module(gpu, "distance")?;
        let pipeline = |entry: &str| {
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: None,
                    module: &module,
                    entry_point: Some(entry),
                    compilation_options: Default::default(),
                    cache: None,
                })
        };
        Ok(Self {
            open_blocks: pipeline("open_blocks"),
            sweep: pipeline("sweep"),
            along: ["along_x", "along_y", "along_z"].map(pipeline),
            smooth: ["smooth_out", "smooth_back"].map(pipeline),
            write: pipeline("write_texture"),
        })
    }
}

/// What templates leave alone, on the GPU, for one document and subject.
#[derive(Debug)]
pub(super) struct FeatureTextures {
    pub uniform: wgpu::Buffer,
    pub view: wgpu::TextureView,
    texture: wgpu::Texture,
    plan: Option<Plan>,
    made_for: Option<MadeFor>,
    kept: Option<KeptTissue>,
}

/// What distances depend on besides the subject: the sets of each label, their number, whether the depth is wanted, and whether exact
/// distances are.
type MadeFor = ([[u32; 4]; 8], u32, bool, bool);

/// Where distances are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plan {
    fine: UVec3,
    coarse: UVec3,
    factor: u32,
    spacing: Vec3,
    reads_labels: bool,
    /// As in [`Features`].
    slabs: [u32; 4],
}

impl Plan {
    fn new(frame: &VoxelFrame, reads_labels: bool, kept: &KeptTissue) -> Self {
        let exact = u32::from(kept.constraints != 0);
        let deep = if kept.keeps_deep { 1 + exact } else { 0 };
        let slabs = [1 + exact + u32::from(kept.keeps_deep), exact, deep, 0];
        let mut factor = 1;
        let coarse = loop {
            let coarse = frame.dims.map(|n| n.div_ceil(factor));
            if coarse.as_u64vec3().element_product() <= MOST_VOXELS {
                break coarse;
            }
            factor += 1;
        };
        Self {
            fine: frame.dims,
            coarse,
            factor,
            spacing: frame.spacing,
            reads_labels,
            slabs,
        }
    }

    fn count(&self) -> u64 {
        self.coarse.as_u64vec3().element_product()
    }
}

impl FeatureTextures {
    /// Holds nothing until [`FeatureTextures::update`].
    pub(super) fn new(gpu: &Gpu) -> Self {
        let texture = texture_of(gpu, UVec3::ONE);
        Self {
            uniform: uniform_buffer(gpu, "features", &Features::default()),
            view: texture.create_view(&Default::default()),
            texture,
            plan: None,
            made_for: None,
            kept: None,
        }
    }

    /// What was last taken over.
    pub(super) fn kept(&self) -> Option<&KeptTissue> {
        self.kept.as_ref()
    }

    /// Takes over what a document keeps. The work is on its way to the GPU when this returns; nothing is read back. True if
    /// [`FeatureTextures::view`] is another one than before.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        passes: &Passes,
        subject: &SubjectTextures,
        kept: KeptTissue,
    ) -> bool {
        let mut is_new = false;
        if kept.needs_distances() {
            let made_for = (
                kept.label_sets,
                kept.set_count,
                kept.keeps_deep,
                kept.constraints != 0,
            );
            if self.made_for != Some(made_for)
                && let Some(passes) = passes.distance(gpu)
            {
                is_new = self.make(gpu, &passes, subject, &kept);
                self.made_for = Some(made_for);
            }
        }
        let frame = frame_for(subject, &kept);
        let coarse = self
            .plan
            .map_or(Vec3::ONE, |plan| plan.coarse.as_vec3() * plan.factor as f32);
        // The coarse grid may reach over the fine one's end by part of a voxel.
        let texture_from_rest = DAffine3::from_scale(coarse.as_dvec3().recip())
            * DAffine3::from_translation(glam::DVec3::splat(0.5))
            * frame.rest_from_voxel.inverse();
        let rows = affine_rows(&texture_from_rest.as_affine3a());
        let spacing = self
            .plan
            .map_or(1.0, |plan| plan.spacing.min_element() * plan.factor as f32);
        let dims = self.plan.map_or(UVec3::ONE, |plan| plan.coarse).as_vec3();
        let uniform = Features {
            distance_from_rest_row0: rows[0],
            distance_from_rest_row1: rows[1],
            distance_from_rest_row2: rows[2],
            distance_dims: dims.extend(spacing).to_array(),
            slabs: self.plan.map_or([1, 0, 0, 0], |plan| plan.slabs),
            label_sets: kept.label_sets,
            items: kept.items,
            motions: Default::default(),
        };
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.kept = Some(kept);
        is_new
    }

    /// The distances, read back.
    pub(super) async fn read(&self, gpu: &Gpu) -> Result<([u32; 3], Vec<[f32; 4]>), RenderError> {
        let [x, y, z] = [
            self.texture.width(),
            self.texture.height(),
            self.texture.depth_or_array_layers(),
        ];
        let pitch = (8 * x).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("distances readback"),
            size: u64::from(pitch) * u64::from(y) * u64::from(z),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(pitch),
                    rows_per_image: Some(y),
                },
            },
            self.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        let bytes = super::Readback::start(gpu, buffer).await?;
        let texels = bytes
            .chunks_exact(pitch as usize)
            .flat_map(|row| row.chunks_exact(8).take(x as usize))
            .map(|texel| {
                std::array::from_fn(|i| {
                    half::f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32()
                })
            });
        Ok(([x, y, z], texels.collect()))
    }

    fn make(
        &mut self,
        gpu: &Gpu,
        passes: &DistancePasses,
        subject: &SubjectTextures,
        kept: &KeptTissue,
    ) -> bool {
        let frame = frame_for(subject, kept);
        let reads_labels = frame == *subject.label_frame.as_ref().unwrap_or(&subject.frame)
            && subject.label_frame.is_some();
        let plan = Plan::new(&frame, reads_labels, kept);
        let is_new = self.plan != Some(plan);
        if is_new {
            let size = plan.coarse * UVec3::new(1, 1, plan.slabs[0]);
            self.texture = texture_of(gpu, size);
            self.view = self.texture.create_view(&Default::default());
            self.plan = Some(plan);
        }
        let work = Work::new(gpu, passes, subject, &plan, &frame, kept, &self.view);
        let [_, exact, deep, _] = plan.slabs;
        for set in 0..kept.set_count {
            work.distances(set);
        }
        if exact != 0 {
            work.write(exact, kept.set_count);
        }
        for set in 0..kept.set_count {
            work.smooth(set);
        }
        work.write(0, kept.set_count);
        if deep != 0 {
            work.flood(subject.foot_axis);
            work.distances(CHANNEL_OUTSIDE);
            work.write(deep, 0);
        }
        is_new
    }
}

/// The grid that distances are taken on: the labels', where sets of labels are asked for or the labels lie on the volume's grid.
fn frame_for(subject: &SubjectTextures, kept: &KeptTissue) -> VoxelFrame {
    match &subject.label_frame {
        Some(labels) if kept.set_count > 0 || labels.dims == subject.frame.dims => *labels,
        _ => subject.frame,
    }
}

/// Normalised value up to which there is nothing.
fn threshold(subject: &SubjectTextures) -> f32 {
    let info = &subject.info;
    let value = if info.is_ct || info.value_range[0] <= -500.0 {
        AIR_BELOW + info.hounsfield_offset
    } else {
        let [low, high] = info.window_auto;
        low + DARK_PART * (high - low)
    };
    let [offset, span, ..] = subject.uniform.value;
    (value - offset) / span
}

fn texture_of(gpu: &Gpu, dims: UVec3) -> wgpu::Texture {
    let format = wgpu::TextureFormat::Rgba16Float;
    let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
    volume_texture(gpu, "distances", dims, format, usage)
}

/// The buffers of one making, dropped when it is handed in.
struct Work<'a> {
    gpu: &'a Gpu,
    passes: &'a DistancePasses,
    subject: &'a SubjectTextures,
    plan: &'a Plan,
    view: &'a wgpu::TextureView,
    job: DistanceJob,
    lines: wgpu::Buffer,
    planes: wgpu::Buffer,
    fields: wgpu::Buffer,
    smoothed: wgpu::Buffer,
    flood: wgpu::Buffer,
    slices: u32,
}

impl<'a> Work<'a> {
    fn new(
        gpu: &'a Gpu,
        passes: &'a DistancePasses,
        subject: &'a SubjectTextures,
        plan: &'a Plan,
        frame: &VoxelFrame,
        kept: &KeptTissue,
        view: &'a wgpu::TextureView,
    ) -> Self {
        let buffer = |label, size: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.max(16),
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let line = 8 * u64::from(plan.coarse.x) * u64::from(plan.fine.y);
        let slices = (PART_BYTES / line).clamp(1, u64::from(plan.fine.z)) as u32;
        let plane = 8 * u64::from(plan.coarse.x) * u64::from(plan.coarse.y);
        let channels = if kept.keeps_deep {
            u64::from(CHANNEL_OUTSIDE) + 1
        } else {
            u64::from(kept.set_count)
        };
        let volume_from_voxel = subject.frame.texture_from_rest() * frame.rest_from_voxel;
        let rows = affine_rows(&volume_from_voxel.as_affine3a());
        Self {
            gpu,
            passes,
            subject,
            plan,
            view,
            job: DistanceJob {
                volume_from_voxel_row0: rows[0],
                volume_from_voxel_row1: rows[1],
                volume_from_voxel_row2: rows[2],
                fine: plan.fine.extend(plan.factor).to_array(),
                coarse: plan.coarse.extend(0).to_array(),
                spacing: plan.spacing.extend(threshold(subject)).to_array(),
                part: [0, 0, 3, u32::from(plan.reads_labels)],
                label_sets: kept.label_sets,
            },
            lines: buffer("distance lines", line * u64::from(slices)),
            planes: buffer("distance planes", plane * u64::from(plan.fine.z)),
            fields: buffer("distances", 4 * plan.count() * channels),
            smoothed: buffer("distances smoothed", 4 * plan.count()),
            flood: buffer("outside", 4 * plan.count()),
            slices,
        }
    }

    /// One dispatch. `bindings` of group 3 besides the job; `reads_subject` binds group 1.
    #[expect(
        clippy::too_many_arguments,
        reason = "all that a dispatch is told, each once"
    )]
    fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        job: &DistanceJob,
        bindings: &[(u32, &wgpu::Buffer)],
        reads_subject: bool,
        threads: [u32; 3],
        size: [u32; 3],
    ) {
        let job = uniform_buffer(self.gpu, "distance job", job);
        let mut entries = vec![entry(0, job.as_entire_binding())];
        entries.extend(
            bindings
                .iter()
                .map(|(binding, buffer)| entry(*binding, buffer.as_entire_binding())),
        );
        self.dispatch(encoder, pipeline, &entries, reads_subject, threads, size);
    }

    fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        entries: &[wgpu::BindGroupEntry<'_>],
        reads_subject: bool,
        threads: [u32; 3],
        size: [u32; 3],
    ) {
        let device = &self.gpu.device;
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("distance"),
            layout: &pipeline.get_bind_group_layout(3),
            entries,
        });
        let subject = reads_subject.then(|| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("distance subject"),
                layout: &pipeline.get_bind_group_layout(1),
                entries: &[
                    entry(
                        1,
                        wgpu::BindingResource::TextureView(&self.subject.volume_view),
                    ),
                    entry(2, wgpu::BindingResource::Sampler(&self.subject.sampler)),
                    entry(
                        3,
                        wgpu::BindingResource::TextureView(&self.subject.label_view),
                    ),
                ],
            })
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("distance"),
            timestamp_writes: None,
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(3, &group, &[]);
        if let Some(subject) = &subject {
            pass.set_bind_group(1, subject, &[]);
        }
        let groups: [u32; 3] = std::array::from_fn(|i| threads[i].div_ceil(size[i]));
        pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        self.gpu.device.create_command_encoder(&Default::default())
    }

    /// Finds the outside of the object.
    fn flood(&self, foot_axis: u32) {
        let mut encoder = self.encoder();
        let coarse = self.plan.coarse;
        let mut job = self.job;
        job.part[2] = foot_axis;
        self.run(
            &mut encoder,
            &self.passes.open_blocks,
            &job,
            &[(5, &self.flood)],
            true,
            coarse.to_array(),
            [4; 3],
        );
        let across = [
            [coarse.y, coarse.z, 1],
            [coarse.x, coarse.z, 1],
            [coarse.x, coarse.y, 1],
        ];
        for _ in 0..SWEEP_ROUNDS {
            for (axis, threads) in across.into_iter().enumerate() {
                job.part[2] = axis as u32;
                self.run(
                    &mut encoder,
                    &self.passes.sweep,
                    &job,
                    &[(5, &self.flood)],
                    false,
                    threads,
                    [8, 8, 1],
                );
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Signed distances of one channel.
    fn distances(&self, channel: u32) {
        let plan = self.plan;
        let mut job = self.job;
        job.coarse[3] = channel;
        let mut first = 0;
        while first < plan.fine.z {
            let slices = self.slices.min(plan.fine.z - first);
            job.part[0] = first;
            job.part[1] = slices;
            let mut encoder = self.encoder();
            let bindings = [(1, &self.lines), (5, &self.flood)];
            self.run(
                &mut encoder,
                &self.passes.along[0],
                &job,
                &bindings,
                true,
                [plan.fine.y, slices, 1],
                [8, 8, 1],
            );
            self.run(
                &mut encoder,
                &self.passes.along[1],
                &job,
                &[(1, &self.lines), (2, &self.planes)],
                false,
                [plan.coarse.x, plan.coarse.y, slices],
                [8, 8, 1],
            );
            self.gpu.queue.submit([encoder.finish()]);
            first += slices;
        }
        let mut encoder = self.encoder();
        self.run(
            &mut encoder,
            &self.passes.along[2],
            &job,
            &[(2, &self.planes), (3, &self.fields)],
            false,
            plan.coarse.to_array(),
            [8, 8, 1],
        );
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Takes the stairs off a channel.
    fn smooth(&self, channel: u32) {
        let mut encoder = self.encoder();
        let mut job = self.job;
        job.coarse[3] = channel;
        let both = [(3, &self.fields), (4, &self.smoothed)];
        for axis in 0..3 {
            job.part[2] = axis;
            self.run(
                &mut encoder,
                &self.passes.smooth[(axis % 2) as usize],
                &job,
                &both,
                false,
                self.plan.coarse.to_array(),
                [4; 3],
            );
        }
        let bytes = 4 * self.plan.count();
        encoder.copy_buffer_to_buffer(
            &self.smoothed,
            0,
            &self.fields,
            bytes * u64::from(channel),
            bytes,
        );
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Into a slab of the texture, the distances as they are now; without sets the depth.
    fn write(&self, slab: u32, set_count: u32) {
        let mut encoder = self.encoder();
        let mut job = self.job;
        job.part[0] = slab;
        job.part[1] = set_count;
        let job = uniform_buffer(self.gpu, "distance job", &job);
        let entries = [
            entry(0, job.as_entire_binding()),
            entry(3, self.fields.as_entire_binding()),
            entry(6, wgpu::BindingResource::TextureView(self.view)),
        ];
        self.dispatch(
            &mut encoder,
            &self.passes.write,
            &entries,
            false,
            self.plan.coarse.to_array(),
            [4; 3],
        );
        self.gpu.queue.submit([encoder.finish()]);
    }
}
