//! How far every place is from kept tissue: textures of distances, made on the GPU.

use super::parts::PartPrograms;
use super::shares::{KeptShares, Members, SharesPrograms};
use crate::document::MAX_KEEP_SETS;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{submit_and_read, uniform_buffer};
use crate::render::device::cases::Cases;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::{Pipelines, compute_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::device::textures::{read_half_texels, volume_texture};
use crate::render::pack::gpu_types::{Affine, DistanceJob, Kept, LabelSets, MAX_MOTIONS};
use crate::render::pack::kept::KeptTissue;
use crate::render::pack::stamps::{MadeFrom, Stamp, Stamped};
use crate::render::subject::textures::{SubjectTextures, VoxelFrame};
use glam::{DAffine3, DMat3, DVec3, UVec3, Vec3};
use std::mem::offset_of;
use std::sync::Arc;

/// Voxels of the distances at most: 128³, 16 MiB of texture. Distances are measured to the fine voxels, so
/// that surfaces stay exact; only the points at which they are stored are coarser, with interpolation in between.
const MOST_VOXELS: u64 = 1 << 21;

/// Voxels at most of the perpendicular grid in place of a sheared one.
const MOST_SHEARED: f64 = 32e6;

/// Bytes of the lines that are worked on at a time.
const PART_BYTES: u64 = 32 << 20;

/// Rounds of spreading the outside along the three axes. Each round turns three corners; no body has a dozen on the
/// way out.
const SWEEP_ROUNDS: usize = 6;

/// Channel of the distance to the outside.
const CHANNEL_OUTSIDE: u32 = 4;

/// The compute programs that make distances; compiled when the first document keeps something.
#[derive(Debug, Default)]
pub(crate) struct DistancePrograms {
    pipelines: Pipelines<SubjectShader, Arc<DistancePipelines>>,
    parts: PartPrograms,
    shares: SharesPrograms,
}

#[derive(Debug)]
struct DistancePipelines {
    open_blocks: wgpu::ComputePipeline,
    sweep: wgpu::ComputePipeline,
    along: [wgpu::ComputePipeline; 3],
    smooth: [wgpu::ComputePipeline; 2],
    write: wgpu::ComputePipeline,
}

impl DistancePrograms {
    fn get(&self, gpu: &Gpu, subject: SubjectShader) -> Arc<DistancePipelines> {
        self.pipelines.get(subject, || {
            let module = module_for(gpu, ProgramId::Distance, subject, Cases::ALL);
            let pipeline = |entry: &str| compute_pipeline(gpu, &module, entry, &[]);
            Arc::new(DistancePipelines {
                open_blocks: pipeline("open_blocks"),
                sweep: pipeline("sweep"),
                along: ["along_x", "along_y", "along_z"].map(pipeline),
                smooth: ["smooth_out", "smooth_back"].map(pipeline),
                write: pipeline("write_texture"),
            })
        })
    }
}

/// What templates leave alone, on the GPU, for one document and subject.
#[derive(Debug)]
pub(crate) struct KeptTextures {
    pub uniform: wgpu::Buffer,
    pub view: wgpu::TextureView,
    /// Shares of the sets.
    pub shares: KeptShares,
    texture: wgpu::Texture,
    plan: Option<Plan>,
    made_for: Option<MadeFor>,
    /// Stamp of the textures.
    pub stamp: Stamp,
    made_from: MadeFrom<2>,
}

/// What distances and shares depend on: the stamp of the subject, the sets of each label, their number, which of them
/// are connected parts, which end at a smooth surface, whether the depth is wanted, and whether exact distances are.
type MadeFor = (Stamp, LabelSets, u32, [u32; MAX_KEEP_SETS], u32, bool, bool);

/// Where distances are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plan {
    fine: UVec3,
    coarse: UVec3,
    /// Fine voxels from one coarse sample to the next.
    ratio: Vec3,
    spacing: Vec3,
    /// By how much a distance between samples may be too long, subject units.
    slack: f32,
    /// The voxels are cubes.
    is_cubic: bool,
    reads_labels: bool,
    /// Slabs in the texture of distances, one behind the other along z.
    slab_count: u32,
    exact_slab: u32,
    depth_slab: u32,
}

impl Plan {
    fn new(frame: &MeasuredFrame, reads_labels: bool, kept: &KeptTissue) -> Self {
        let exact_slab = u32::from(kept.constraints != 0);
        let depth_slab = if kept.keeps_deep { 1 + exact_slab } else { 0 };
        let finest = frame.spacing.min_element();
        // A voxel that is several times as high as others are wide is sampled that often: between samples far apart a
        // distance is nothing to rely on.
        let parts = (frame.spacing / finest).round().max(Vec3::ONE);
        let mut factor = 1;
        let (coarse, ratio) = loop {
            let ratio = Vec3::splat(factor as f32) / parts;
            let count = frame.dims.as_vec3() / ratio;
            let coarse = (count - 1e-3).ceil().max(Vec3::ONE).as_uvec3();
            if coarse.as_u64vec3().element_product() <= MOST_VOXELS {
                break (coarse, ratio);
            }
            factor += 1;
        };
        // Linear between its corners, a distance is too long by half the diagonal of a cell at most, as beside a
        // single point. A voxel is no point: as large as a cell, it takes half a side of it.
        let cell = frame.spacing * ratio;
        let slack = match factor {
            1 => 0.5 * cell.max_element(),
            _ => 0.5 * cell.length(),
        };
        Self {
            fine: frame.dims,
            coarse,
            ratio,
            slack: slack + frame.slack,
            is_cubic: frame.spacing.max_element() < 1.01 * finest,
            spacing: frame.spacing,
            reads_labels,
            slab_count: 1 + exact_slab + u32::from(kept.keeps_deep),
            exact_slab,
            depth_slab,
        }
    }

    fn count(&self) -> u64 {
        self.coarse.as_u64vec3().element_product()
    }
}

impl KeptTextures {
    /// Holds nothing until [`KeptTextures::update`].
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let texture = texture_of(gpu, UVec3::ONE);
        Self {
            uniform: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("kept"),
                size: size_of::<Kept>() as u64,
                usage: wgpu::BufferUsages::UNIFORM
                    | wgpu::BufferUsages::COPY_DST
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            view: texture.create_view(&Default::default()),
            shares: KeptShares::new(gpu),
            texture,
            plan: None,
            made_for: None,
            stamp: 0,
            made_from: MadeFrom::default(),
        }
    }

    /// Takes over what a document keeps. The work is on its way to the GPU when this returns; nothing is read back.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        programs: &DistancePrograms,
        subject: &SubjectTextures,
        kept: &Stamped<Option<KeptTissue>>,
    ) {
        let is_stale = self.made_from.is_stale([subject.stamp, kept.stamp()]);
        let Some(kept) = kept.get().as_ref().filter(|_| is_stale) else {
            return;
        };
        if !kept.is_nothing() {
            let made_for = (
                subject.stamp,
                kept.label_sets,
                kept.set_count,
                kept.parts,
                kept.shared_sets,
                kept.keeps_deep,
                kept.constraints != 0,
            );
            if self.made_for != Some(made_for) {
                self.make(gpu, programs, subject, kept);
                self.made_for = Some(made_for);
            }
        }
        let frame = MeasuredFrame::of(&frame_for(subject, kept));
        let coarse = self
            .plan
            .map_or(Vec3::ONE, |plan| plan.coarse.as_vec3() * plan.ratio);
        // The coarse grid may reach over the fine one's end by part of a voxel.
        let texture_from_rest = DAffine3::from_scale(coarse.as_dvec3().recip())
            * DAffine3::from_translation(DVec3::splat(0.5))
            * frame.rest_from_voxel.inverse();
        let spacing = self
            .plan
            .map_or(1.0, |plan| (plan.spacing * plan.ratio).min_element());
        let dims = self.plan.map_or(UVec3::ONE, |plan| plan.coarse).as_vec3();
        let uniform = Kept {
            distance_from_rest: texture_from_rest.as_affine3a().into(),
            distance_dims: dims.to_array(),
            distance_slack: self.plan.map_or(0.0, |plan| plan.slack),
            spacing,
            slab_count: self.plan.map_or(1, |plan| plan.slab_count),
            exact_slab: self.plan.map_or(0, |plan| plan.exact_slab),
            depth_slab: self.plan.map_or(0, |plan| plan.depth_slab),
            is_coarse: self
                .plan
                .map_or(0, |plan| u32::from(plan.ratio.max_element() > 1.0)),
            parts: (kept.parts.iter().enumerate())
                .fold(0, |all, (set, parts)| all | parts << (4 * set)),
            shared_sets: self.shares.sets,
            shares_add: u32::from(kept.shares_add),
            rim: match (&subject.label_voxels, self.shares.sets) {
                (Some(labels), 1..) => 0.5 * labels.spacing.max_element(),
                _ => 0.0,
            },
            label_sets: kept.label_sets,
            items: kept.items,
            ..Kept::NONE
        };
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
    }

    /// What the pipeline constant `kept_by` has to be: that of the tissue, and bit 3 where segments end at the smooth
    /// surface of their shares.
    pub(crate) fn kept_by(&self, kept: &KeptTissue) -> u32 {
        let has_shares = kept.shared_sets != 0 && self.shares.sets != 0;
        kept.kept_by() | u32::from(has_shares) << 3
    }

    /// The distances, read back.
    pub(crate) async fn read(&self, gpu: &Gpu) -> Result<([u32; 3], Vec<[f32; 4]>), RenderError> {
        let [x, y, z] = [
            self.texture.width(),
            self.texture.height(),
            self.texture.depth_or_array_layers(),
        ];
        let texels = read_half_texels(gpu, &self.texture).await?;
        Ok(([x, y, z], texels))
    }

    /// What was found of the map as a whole, read back.
    pub(crate) async fn read_motions(&self, gpu: &Gpu) -> Result<Vec<Affine>, RenderError> {
        let bytes = submit_and_read(gpu, encoder(gpu), &self.uniform).await?;
        let start = offset_of!(Kept, motions);
        let motions = &bytes[start..start + size_of::<[Affine; MAX_MOTIONS]>()];
        Ok(bytemuck::pod_collect_to_vec(motions))
    }

    fn make(
        &mut self,
        gpu: &Gpu,
        programs: &DistancePrograms,
        subject: &SubjectTextures,
        kept: &KeptTissue,
    ) {
        let pipelines = &programs.get(gpu, subject.shader);
        let frame = frame_for(subject, kept);
        let reads_labels = frame == *subject.label_voxels.as_ref().unwrap_or(&subject.voxels)
            && subject.label_voxels.is_some();
        let frame = MeasuredFrame::of(&frame);
        let plan = Plan::new(&frame, reads_labels, kept);
        if self.plan != Some(plan) {
            let size = plan.coarse * UVec3::new(1, 1, plan.slab_count);
            self.texture = texture_of(gpu, size);
            self.view = self.texture.create_view(&Default::default());
            self.stamp += 1;
            self.plan = Some(plan);
        }
        let (is_new, members) = self.shares.make(gpu, &programs.shares, subject, kept);
        self.stamp += u64::from(is_new);
        let textures = (&self.view, members);
        let work = Work::new(gpu, pipelines, subject, &plan, &frame, kept, textures);
        for (set, parts) in (0..kept.set_count).zip(kept.parts) {
            if parts == 0 {
                work.distances(set, 0);
            } else if parts.trailing_zeros() == set {
                work.parts(&programs.parts, set, parts);
            }
        }
        if plan.exact_slab != 0 {
            work.write(plan.exact_slab, kept.set_count);
        }
        for set in 0..kept.set_count {
            work.smooth(set);
        }
        work.write(0, kept.set_count);
        if plan.depth_slab != 0 {
            work.flood(subject.foot_axis);
            work.distances(CHANNEL_OUTSIDE, 0);
            work.write(plan.depth_slab, 0);
        }
    }
}

/// The grid that distances are taken on: the labels', where sets of labels are asked for or the labels lie on the
/// volume's grid.
fn frame_for(subject: &SubjectTextures, kept: &KeptTissue) -> VoxelFrame {
    match &subject.label_voxels {
        Some(labels) if kept.set_count > 0 || labels.dims == subject.voxels.dims => *labels,
        _ => subject.voxels,
    }
}

/// A grid of perpendicular axes on which distances are measured.
#[derive(Clone, Copy, Debug)]
struct MeasuredFrame {
    dims: UVec3,
    /// Between voxels along each axis, subject units.
    spacing: Vec3,
    /// Rest space from voxel indices.
    rest_from_voxel: DAffine3,
    /// Voxel indices of the grid that it stands for, from its own.
    source_from_voxel: DAffine3,
    /// By how much a distance may be too long because a voxel of the other grid is not met, subject units.
    slack: f32,
}

impl MeasuredFrame {
    /// The grid itself; of a sheared one the perpendicular grid of the same first axis that holds it, with voxels as
    /// small as its smallest spacing where that makes no more than [`MOST_SHEARED`].
    fn of(frame: &VoxelFrame) -> Self {
        let m = frame.rest_from_voxel.matrix3;
        let lean = [
            (m.x_axis, m.y_axis),
            (m.y_axis, m.z_axis),
            (m.z_axis, m.x_axis),
        ]
        .map(|(a, b)| (a.dot(b) / (a.length() * b.length())).abs());
        if lean.iter().all(|lean| *lean < 1e-3) {
            return Self {
                dims: frame.dims,
                spacing: frame.spacing,
                rest_from_voxel: frame.rest_from_voxel,
                source_from_voxel: DAffine3::IDENTITY,
                slack: 0.0,
            };
        }
        let x = m.x_axis.normalize_or(DVec3::X);
        let y = m.y_axis.reject_from_normalized(x).normalize_or(DVec3::Y);
        let turn = DMat3::from_cols(x, y, x.cross(y));
        let ends = [DVec3::splat(-0.5), frame.dims.as_dvec3() - 0.5];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for i in 0..8 {
            let end = |axis: usize| ends[i >> axis & 1][axis];
            let corner = DVec3::new(end(0), end(1), end(2));
            let at = turn.transpose() * frame.rest_from_voxel.transform_point3(corner);
            low = low.min(at);
            high = high.max(at);
        }
        let size = high - low;
        let least = (size.element_product() / MOST_SHEARED).cbrt();
        let spacing = f64::from(frame.spacing.min_element()).max(least);
        let dims = (size / spacing - 1e-3).ceil().max(DVec3::ONE);
        let first = turn * (low + 0.5 * spacing);
        let rest_from_voxel = DAffine3::from_mat3_translation(turn * spacing, first);
        Self {
            dims: dims.as_uvec3(),
            spacing: Vec3::splat(spacing as f32),
            rest_from_voxel,
            source_from_voxel: frame.rest_from_voxel.inverse() * rest_from_voxel,
            // Tissue may reach into a voxel up to its centre without being met there.
            slack: (0.5 * 3.0_f64.sqrt() * spacing) as f32,
        }
    }
}

/// Normalised value up to which there is nothing.
fn threshold(subject: &SubjectTextures) -> f32 {
    (subject.info.outer_value() - subject.uniform.value_low) / subject.uniform.value_range
}

fn texture_of(gpu: &Gpu, dims: UVec3) -> wgpu::Texture {
    let format = wgpu::TextureFormat::Rgba16Float;
    let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
    volume_texture(gpu, "distances", dims, format, usage)
}

/// What a pass reads of the subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reads {
    Nothing,
    /// Values and labels of voxels.
    Voxels,
    /// These, and which segments of meshes lie at a voxel.
    Sets,
}

/// The buffers of one making, dropped when it is handed in.
struct Work<'a> {
    gpu: &'a Gpu,
    pipelines: &'a DistancePipelines,
    subject: &'a SubjectTextures,
    plan: &'a Plan,
    view: &'a wgpu::TextureView,
    job: DistanceJob,
    lines: wgpu::Buffer,
    planes: wgpu::Buffer,
    fields: wgpu::Buffer,
    smoothed: wgpu::Buffer,
    flood: wgpu::Buffer,
    members: wgpu::Buffer,
    line_bits: wgpu::Buffer,
    slices: u32,
}

impl<'a> Work<'a> {
    fn new(
        gpu: &'a Gpu,
        pipelines: &'a DistancePipelines,
        subject: &'a SubjectTextures,
        plan: &'a Plan,
        frame: &MeasuredFrame,
        kept: &KeptTissue,
        (view, members): (&'a wgpu::TextureView, Members),
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
        let bits = 4 * u64::from(plan.fine.x.div_ceil(32)) * u64::from(plan.fine.y);
        let slices = (PART_BYTES / line).clamp(1, u64::from(plan.fine.z)) as u32;
        let plane = 8 * u64::from(plan.coarse.x) * u64::from(plan.coarse.y);
        let channels = if kept.keeps_deep {
            u64::from(CHANNEL_OUTSIDE) + 1
        } else {
            u64::from(kept.set_count)
        };
        let are_told = members.words != 0
            && plan.reads_labels
            && frame.source_from_voxel == DAffine3::IDENTITY
            && subject.shader == SubjectShader::Volume;
        let volume_from_voxel = subject.voxels.texture_from_rest() * frame.rest_from_voxel;
        Self {
            gpu,
            pipelines,
            subject,
            plan,
            view,
            job: DistanceJob {
                volume_from_voxel: volume_from_voxel.as_affine3a().into(),
                fine: plan.fine.extend(0).to_array(),
                coarse: plan.coarse.extend(0).to_array(),
                spacing: plan.spacing.extend(0.0).to_array(),
                ratio: plan.ratio.extend(0.0).to_array(),
                label_from_voxel: frame.source_from_voxel.as_affine3a().into(),
                rest_from_voxel: frame.rest_from_voxel.as_affine3a().into(),
                threshold: threshold(subject),
                reads_labels: u32::from(plan.reads_labels),
                axis: 3,
                member_words: members.words,
                are_members_told: u32::from(are_told),
                label_sets: kept.label_sets,
                ..DistanceJob::default()
            },
            lines: buffer("distance lines", line * u64::from(slices)),
            planes: buffer("distance planes", plane * u64::from(plan.fine.z)),
            fields: buffer("distances", 4 * plan.count() * channels),
            smoothed: buffer("distances smoothed", 4 * plan.count()),
            flood: buffer("outside", 4 * plan.count()),
            members: members.bits,
            line_bits: buffer("members of distance lines", bits * u64::from(slices)),
            slices,
        }
    }

    /// One dispatch. `bindings` of group 3 besides the job; `reads` says what of group 1 is bound.
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
        reads: Reads,
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
        self.dispatch(encoder, pipeline, &entries, reads, threads, size);
    }

    fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        entries: &[wgpu::BindGroupEntry<'_>],
        reads: Reads,
        threads: [u32; 3],
        size: [u32; 3],
    ) {
        let device = &self.gpu.device;
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("distance"),
            layout: &pipeline.get_bind_group_layout(3),
            entries,
        });
        let subject = (reads != Reads::Nothing).then(|| {
            let (subject, view) = (self.subject, wgpu::BindingResource::TextureView);
            let mut entries = vec![
                entry(1, view(&subject.volume_view)),
                entry(2, wgpu::BindingResource::Sampler(&subject.sampler)),
                entry(3, view(&subject.label_view)),
            ];
            if let Some(meshes) = &subject.meshes
                && reads == Reads::Sets
                && subject.shader == SubjectShader::Both
            {
                entries.push(entry(0, subject.buffer.as_entire_binding()));
                entries.extend(meshes.entries());
            }
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("distance subject"),
                layout: &pipeline.get_bind_group_layout(1),
                entries: &entries,
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
        encoder(self.gpu)
    }

    /// Finds the outside of the object.
    fn flood(&self, foot_axis: u32) {
        let mut encoder = self.encoder();
        let coarse = self.plan.coarse;
        let mut job = self.job;
        job.axis = foot_axis;
        self.run(
            &mut encoder,
            &self.pipelines.open_blocks,
            &job,
            &[(5, &self.flood)],
            Reads::Voxels,
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
                job.axis = axis as u32;
                self.run(
                    &mut encoder,
                    &self.pipelines.sweep,
                    &job,
                    &[(5, &self.flood)],
                    Reads::Nothing,
                    threads,
                    [8, 8, 1],
                );
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Signed distances of the sets that are the connected parts of one, the largest first.
    fn parts(&self, programs: &PartPrograms, first: u32, parts: u32) {
        let mut job = self.job;
        job.channel = first;
        job.part_count = parts.count_ones();
        programs.find(self.gpu, self.subject, &job, &self.flood);
        let sets = (first..CHANNEL_OUTSIDE).filter(|set| parts & (1 << set) != 0);
        for (set, rank) in sets.zip(1..) {
            self.distances(set, rank);
        }
    }

    /// Signed distances of one channel; `part` is the rank of a connected part, 0 stands for all.
    fn distances(&self, channel: u32, part: u32) {
        let plan = self.plan;
        let mut job = self.job;
        job.channel = channel;
        job.part = part;
        // Only where something gives way to a set has a cube to be a box.
        let is_box = !plan.is_cubic || (plan.exact_slab != 0 && channel != CHANNEL_OUTSIDE);
        job.half_box = if is_box { 0.5 } else { 0.0 };
        job.half_ball =
            0.5 * plan.spacing.min_element() - job.half_box * plan.spacing.min_element();
        let mut first = 0;
        while first < plan.fine.z {
            let slices = self.slices.min(plan.fine.z - first);
            job.first_slice = first;
            job.slice_count = slices;
            let mut encoder = self.encoder();
            let bindings = [
                (1, &self.lines),
                (5, &self.flood),
                (7, &self.members),
                (8, &self.line_bits),
            ];
            self.run(
                &mut encoder,
                &self.pipelines.along[0],
                &job,
                &bindings,
                Reads::Sets,
                [plan.fine.y, slices, 1],
                [8, 8, 1],
            );
            self.run(
                &mut encoder,
                &self.pipelines.along[1],
                &job,
                &[(1, &self.lines), (2, &self.planes)],
                Reads::Nothing,
                [plan.coarse.x, plan.coarse.y, slices],
                [8, 8, 1],
            );
            self.gpu.queue.submit([encoder.finish()]);
            first += slices;
        }
        let mut encoder = self.encoder();
        self.run(
            &mut encoder,
            &self.pipelines.along[2],
            &job,
            &[(2, &self.planes), (3, &self.fields)],
            Reads::Nothing,
            plan.coarse.to_array(),
            [8, 8, 1],
        );
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Takes the stairs off a channel.
    fn smooth(&self, channel: u32) {
        let mut encoder = self.encoder();
        let mut job = self.job;
        job.channel = channel;
        let both = [(3, &self.fields), (4, &self.smoothed)];
        for axis in 0..3 {
            job.axis = axis;
            self.run(
                &mut encoder,
                &self.pipelines.smooth[(axis % 2) as usize],
                &job,
                &both,
                Reads::Nothing,
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
        job.slab = slab;
        job.set_count = set_count;
        let job = uniform_buffer(self.gpu, "distance job", &job);
        let entries = [
            entry(0, job.as_entire_binding()),
            entry(3, self.fields.as_entire_binding()),
            entry(6, wgpu::BindingResource::TextureView(self.view)),
        ];
        self.dispatch(
            &mut encoder,
            &self.pipelines.write,
            &entries,
            Reads::Nothing,
            self.plan.coarse.to_array(),
            [4; 3],
        );
        self.gpu.queue.submit([encoder.finish()]);
    }
}
