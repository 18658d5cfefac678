//! Shares of kept tissue, made on the GPU: how much of each label voxel belongs to each set, so that what is kept ends
//! at a smooth surface.

use super::parts::dispatch;
use crate::data::MOST_SHARED_VOXELS;
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::compute_pipeline;
use crate::render::device::programs::{ProgramId, module};
use crate::render::device::textures::{extent, volume_texture};
use crate::render::pack::gpu_types::SharesJob;
use crate::render::pack::kept::KeptTissue;
use crate::render::subject::textures::SubjectTextures;
use glam::UVec3;
use std::sync::OnceLock;

/// Bytes of shares that are written at a time.
const PART_BYTES: u64 = 32 << 20;

/// Rounds of spreading what is large along the three axes.
const SPREAD_ROUNDS: usize = 6;

/// The compute program that makes shares; compiled when the first document keeps something.
#[derive(Debug, Default)]
pub(crate) struct SharesPrograms(OnceLock<SharesPipelines>);

#[derive(Debug)]
struct SharesPipelines {
    mark_rest: wgpu::ComputePipeline,
    find_boxes: wgpu::ComputePipeline,
    fill_boxes: wgpu::ComputePipeline,
    spread_large: wgpu::ComputePipeline,
    find_members: wgpu::ComputePipeline,
    write_shares: wgpu::ComputePipeline,
}

impl SharesPrograms {
    fn get(&self, gpu: &Gpu) -> &SharesPipelines {
        self.0.get_or_init(|| {
            let module = module(gpu, ProgramId::Shares, Cases::ALL);
            let pipeline = |entry: &str| compute_pipeline(gpu, &module, entry, &[]);
            SharesPipelines {
                mark_rest: pipeline("mark_rest"),
                find_boxes: pipeline("find_boxes"),
                fill_boxes: pipeline("fill_boxes"),
                spread_large: pipeline("spread_large"),
                find_members: pipeline("find_members"),
                write_shares: pipeline("write_shares"),
            }
        })
    }
}

/// The texture of shares, for one document and subject.
#[derive(Debug)]
pub(crate) struct KeptShares {
    /// Group 2, binding 14.
    pub view: wgpu::TextureView,
    /// The sets that it has, a bit for each.
    pub sets: u32,
    /// What it holds: voxels along each axis, and bytes of each.
    made: Option<(UVec3, u32)>,
}

/// Which label voxels belong to each set, by their labels or as its crumbs, while distances are made.
#[derive(Debug)]
pub(crate) struct Members {
    /// A bit for each voxel, 32 of a row in a word, sets behind sets.
    pub bits: wgpu::Buffer,
    /// Words in a row; 0 where there are none.
    pub words: u32,
}

impl KeptShares {
    /// Shares of no set.
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            view: texture_of(gpu, UVec3::ONE, 1).create_view(&Default::default()),
            sets: 0,
            made: None,
        }
    }

    /// Makes the shares of the sets that end at a smooth surface, and tells their members. True if there is another
    /// texture than before. The work is on its way to the GPU when this returns.
    pub(crate) fn make(
        &mut self,
        gpu: &Gpu,
        programs: &SharesPrograms,
        subject: &SubjectTextures,
        kept: &KeptTissue,
    ) -> (bool, Members) {
        let dims = subject.label_voxels.map_or(UVec3::ZERO, |frame| frame.dims);
        let channels = match u32::BITS - kept.shared_sets.leading_zeros() {
            0..=1 => 1,
            2 => 2,
            _ => 4,
        };
        let voxels = dims.as_u64vec3().element_product();
        if kept.shared_sets == 0 || voxels == 0 || voxels > MOST_SHARED_VOXELS {
            self.sets = 0;
            let none = buffer_of(gpu, "members", 4);
            return (
                false,
                Members {
                    bits: none,
                    words: 0,
                },
            );
        }
        let is_new = self.made != Some((dims, channels));
        if is_new {
            self.view.texture().destroy();
            self.view = texture_of(gpu, dims, channels).create_view(&Default::default());
            self.made = Some((dims, channels));
        }
        self.sets = kept.shared_sets;
        let work = Work::new(gpu, programs.get(gpu), subject, kept, (dims, channels));
        for set in (0..channels).filter(|set| kept.shared_sets >> set & 1 != 0) {
            work.find_members(set);
        }
        work.write(self.view.texture());
        (
            is_new,
            Members {
                words: work.job.words,
                bits: work.members,
            },
        )
    }
}

/// The buffers of one making.
struct Work<'a> {
    gpu: &'a Gpu,
    pipelines: &'a SharesPipelines,
    subject: &'a SubjectTextures,
    job: SharesJob,
    rest: wgpu::Buffer,
    members: wgpu::Buffer,
    boxes: wgpu::Buffer,
    large: wgpu::Buffer,
}

impl<'a> Work<'a> {
    fn new(
        gpu: &'a Gpu,
        pipelines: &'a SharesPipelines,
        subject: &'a SubjectTextures,
        kept: &KeptTissue,
        (dims, channels): (UVec3, u32),
    ) -> Self {
        let words = dims.x.div_ceil(32);
        let row_bytes = (dims.x * channels).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let plane = 4 * u64::from(words) * u64::from(dims.y) * u64::from(dims.z);
        let planes = plane * u64::from(channels);
        Self {
            gpu,
            pipelines,
            subject,
            job: SharesJob {
                dims: dims.extend(0).to_array(),
                words,
                channels,
                row_words: row_bytes / 4,
                label_sets: kept.label_sets,
                ..SharesJob::default()
            },
            rest: buffer_of(gpu, "rest of sets", planes),
            members: buffer_of(gpu, "members", planes),
            boxes: buffer_of(gpu, "boxes of the rest", plane),
            large: buffer_of(gpu, "large pieces of the rest", plane),
        }
    }

    /// Finds the rest of a set, and the members with the crumbs of it.
    fn find_members(&self, set_index: u32) {
        let mut job = SharesJob {
            set_index,
            ..self.job
        };
        let [_, y, z, _] = job.dims;
        let words = [job.words, y, z];
        let groups = words.map(|n| n.div_ceil(4));
        let (rest, members) = ((1, &self.rest), (2, &self.members));
        let (boxes, large) = ((3, &self.boxes), (4, &self.large));
        let pipelines = self.pipelines;
        let mut encoder = encoder(self.gpu);
        let mut run = |pipeline, job: &SharesJob, buffers: &[_], reads_labels, groups| {
            self.run(&mut encoder, pipeline, job, buffers, reads_labels, groups);
        };
        run(&pipelines.mark_rest, &job, &[rest], true, groups);
        run(&pipelines.find_boxes, &job, &[rest, boxes], false, groups);
        run(&pipelines.fill_boxes, &job, &[boxes, large], false, groups);
        let across = [[y, z], [words[0], z], [words[0], y]];
        for _ in 0..SPREAD_ROUNDS {
            for (axis, threads) in (0..).zip(across) {
                job.axis = axis;
                let [first, second] = threads.map(|n| n.div_ceil(8));
                let groups = [first, second, 1];
                run(&pipelines.spread_large, &job, &[rest, large], false, groups);
            }
        }
        let all = [rest, members, large];
        run(&pipelines.find_members, &job, &all, false, groups);
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Writes the shares into the texture, some slices at a time.
    fn write(&self, texture: &wgpu::Texture) {
        let [x, y, z, _] = self.job.dims;
        let slice = 4 * u64::from(self.job.row_words) * u64::from(y);
        let slices = (PART_BYTES / slice).clamp(1, u64::from(z)) as u32;
        let part = buffer_of(self.gpu, "shares", slice * u64::from(slices));
        let mut first_slice = 0;
        while first_slice < z {
            let slice_count = slices.min(z - first_slice);
            let job = SharesJob {
                first_slice,
                slice_count,
                ..self.job
            };
            let mut encoder = encoder(self.gpu);
            self.run(
                &mut encoder,
                &self.pipelines.write_shares,
                &job,
                &[(2, &self.members), (5, &part)],
                true,
                [job.row_words.div_ceil(8), y.div_ceil(8), slice_count],
            );
            encoder.copy_buffer_to_texture(
                wgpu::TexelCopyBufferInfo {
                    buffer: &part,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(4 * job.row_words),
                        rows_per_image: Some(y),
                    },
                },
                wgpu::TexelCopyTextureInfo {
                    origin: wgpu::Origin3d {
                        x: 0,
                        y: 0,
                        z: first_slice,
                    },
                    ..texture.as_image_copy()
                },
                extent(UVec3::new(x, y, slice_count)),
            );
            self.gpu.queue.submit([encoder.finish()]);
            first_slice += slice_count;
        }
    }

    /// One dispatch, with these buffers in group 3 besides the job.
    fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        job: &SharesJob,
        buffers: &[(u32, &wgpu::Buffer)],
        reads_labels: bool,
        groups: [u32; 3],
    ) {
        let job = uniform_buffer(self.gpu, "shares job", job);
        let mut entries = vec![entry(0, job.as_entire_binding())];
        let buffers = buffers.iter();
        entries.extend(buffers.map(|(at, buffer)| entry(*at, buffer.as_entire_binding())));
        let view = wgpu::BindingResource::TextureView(&self.subject.label_view);
        let labels = [entry(3, view)];
        let labels = reads_labels.then_some(&labels[..]);
        dispatch(self.gpu, encoder, pipeline, &entries, labels, groups);
    }
}

fn buffer_of(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size.max(4),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn texture_of(gpu: &Gpu, dims: UVec3, channels: u32) -> wgpu::Texture {
    let format = match channels {
        1 => wgpu::TextureFormat::R8Unorm,
        2 => wgpu::TextureFormat::Rg8Unorm,
        _ => wgpu::TextureFormat::Rgba8Unorm,
    };
    let usage = wgpu::TextureUsages::COPY_DST;
    volume_texture(gpu, "shares of kept tissue", dims, format, usage)
}
