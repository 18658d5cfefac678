//! Segments that are drawn as bodies of their own: solid, see-through or hidden, whatever their values say.

use super::feature::labels_of;
use super::gpu_types::{BODY_HIDDEN, Bodies};
use super::look::linear_color;
use super::passes::Passes;
use super::programs::module;
use super::subject::{SubjectTextures, entry, volume_texture};
use super::{Gpu, RenderError, uniform_buffer};
use crate::data::{LabelVolume, Segment};
use crate::document::SegmentLook;
use glam::UVec3;

/// Voxels of the shares at most, four bytes each: labels on a finer grid are read every second or third voxel.
const MOST_VOXELS: u64 = 1 << 25;
/// Color of a body whose segment has none, sRGB.
const PLAIN_SRGB: [u8; 3] = [200; 3];

/// Labels by brick: bit `n` for label `n`.
pub(super) type LabelSet = [u32; 8];

/// Which labels lie in each brick of a grid of `dims` voxels; the labels have to lie on it too.
pub(super) fn labels_in_bricks(labels: &LabelVolume, brick: u32) -> Vec<LabelSet> {
    let dims = labels.grid.dims.as_usizevec3();
    let brick = brick as usize;
    let count = [dims.x, dims.y, dims.z].map(|n| n.div_ceil(brick));
    let mut sets = vec![[0; 8]; count.iter().product()];
    for (row, voxels) in labels.labels.chunks_exact(dims.x.max(1)).enumerate() {
        let first = ((row / dims.y / brick) * count[1] + row % dims.y / brick) * count[0];
        for (part, set) in voxels.chunks(brick).zip(sets.iter_mut().skip(first)) {
            for &label in part {
                set[usize::from(label >> 5)] |= 1 << (label & 31);
            }
        }
    }
    sets
}

/// How each label is drawn. Where segments overlap, the one that the subject lists first decides. Names that mean no segment go to
/// `unknown`.
fn bodies_of(looks: &[SegmentLook], segments: &[Segment], unknown: &mut Vec<String>) -> Bodies {
    let mut bodies = Bodies::NONE;
    let mut ranks = [usize::MAX; 256];
    for look in looks {
        let labels = labels_of(&look.name, segments);
        if labels.is_empty() {
            unknown.push(look.name.clone());
        }
        for label in labels.into_iter().map(usize::from) {
            let means = |s: &Segment| {
                usize::from(s.label) == label && s.name.eq_ignore_ascii_case(&look.name)
            };
            // One that is meant by its number goes after all names.
            let rank = segments.iter().position(means).unwrap_or(segments.len());
            if rank >= ranks[label] {
                continue;
            }
            ranks[label] = rank;
            let own = segments.get(rank).and_then(|s| s.color_srgb);
            let color = look.color_srgb.or(own).unwrap_or(PLAIN_SRGB);
            bodies.items[label] = linear_color(color).extend(look.opacity).to_array();
        }
    }
    bodies
}

/// The compute program. Built once per device, the first time that a document draws bodies.
#[derive(Debug)]
pub(super) struct BodyPass(wgpu::ComputePipeline);

impl BodyPass {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let module = module(gpu, "bodies")?;
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("bodies"),
                layout: None,
                module: &module,
                entry_point: Some("share_bodies"),
                compilation_options: Default::default(),
                cache: None,
            });
        Ok(Self(pipeline))
    }
}

/// Bindings 8 and 9 of the scene.
#[derive(Debug)]
pub(super) struct BodyTextures {
    pub uniform: wgpu::Buffer,
    pub view: wgpu::TextureView,
    dims: UVec3,
    looks: Vec<SegmentLook>,
    bodies: Bodies,
}

/// What an update changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Changed {
    /// The picture.
    pub picture: bool,
    /// [`BodyTextures::view`] is another one.
    pub view: bool,
}

impl BodyTextures {
    /// No bodies.
    pub(super) fn new(gpu: &Gpu) -> Self {
        Self {
            uniform: uniform_buffer(gpu, "bodies", &Bodies::NONE),
            view: texture_of(gpu, UVec3::ONE),
            dims: UVec3::ONE,
            looks: Vec::new(),
            bodies: Bodies::NONE,
        }
    }

    /// True if anything is drawn as a body, or hidden.
    pub(super) fn is_used(&self) -> bool {
        self.bodies != Bodies::NONE
    }

    /// The labels that are drawn as bodies and not hidden.
    pub(super) fn visible(&self) -> LabelSet {
        let mut set = [0; 8];
        for (label, item) in self.bodies.items.iter().enumerate() {
            if item[3] >= BODY_HIDDEN {
                set[label / 32] |= 1 << (label % 32);
            }
        }
        set
    }

    /// Takes over how segments look. Names that mean no segment go to `unknown`. The work is on its way to the GPU when this returns.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        passes: &Passes,
        subject: &SubjectTextures,
        looks: &[SegmentLook],
        unknown: &mut Vec<String>,
    ) -> Changed {
        if self.looks == looks {
            return Changed::default();
        }
        self.looks = looks.to_vec();
        let bodies = bodies_of(looks, &subject.segments, unknown);
        let mut changed = Changed {
            picture: self.bodies != bodies,
            view: false,
        };
        if changed.picture {
            self.bodies = bodies;
            gpu.queue
                .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&bodies));
            if self.is_used()
                && let Some(pass) = passes.bodies(gpu)
            {
                changed.view = self.make(gpu, &pass, subject);
            }
        }
        changed
    }

    fn make(&mut self, gpu: &Gpu, pass: &BodyPass, subject: &SubjectTextures) -> bool {
        let [x, y, z, _] = subject.uniform.label_dims.map(|n| n as u32);
        let fine = UVec3::new(x, y, z).max(UVec3::ONE);
        let dims = (1..)
            .map(|factor| fine.map(|n| n.div_ceil(factor)))
            .find(|dims| dims.as_u64vec3().element_product() <= MOST_VOXELS)
            .unwrap_or(UVec3::ONE);
        let is_new = self.dims != dims;
        if is_new {
            self.view = texture_of(gpu, dims);
            self.dims = dims;
        }
        let device = &gpu.device;
        let group = |index, entries: &[wgpu::BindGroupEntry<'_>]| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("bodies"),
                layout: &pass.0.get_bind_group_layout(index),
                entries,
            })
        };
        let shares = group(
            3,
            &[
                entry(0, self.uniform.as_entire_binding()),
                entry(1, wgpu::BindingResource::TextureView(&self.view)),
            ],
        );
        let labels = group(
            1,
            &[
                entry(0, subject.buffer.as_entire_binding()),
                entry(3, wgpu::BindingResource::TextureView(&subject.label_view)),
            ],
        );
        let mut encoder = device.create_command_encoder(&Default::default());
        {
            let mut work = encoder.begin_compute_pass(&Default::default());
            work.set_pipeline(&pass.0);
            work.set_bind_group(1, &labels, &[]);
            work.set_bind_group(3, &shares, &[]);
            let groups = dims.map(|n| n.div_ceil(4));
            work.dispatch_workgroups(groups.x, groups.y, groups.z);
        }
        gpu.queue.submit([encoder.finish()]);
        is_new
    }
}

fn texture_of(gpu: &Gpu, dims: UVec3) -> wgpu::TextureView {
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let usage = wgpu::TextureUsages::STORAGE_BINDING;
    volume_texture(gpu, "bodies", dims, format, usage).create_view(&Default::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Grid;
    use glam::DAffine3;

    #[test]
    fn the_first_of_overlapping_segments_decides() {
        let segment = |label, name: &str| Segment {
            label,
            name: name.to_owned(),
            color_srgb: Some([255; 3]),
        };
        // Label 3 stands for where skull and head overlap.
        let segments = [
            segment(1, "skull"),
            segment(3, "skull"),
            segment(2, "head"),
            segment(3, "head"),
        ];
        let look = |name: &str, opacity| SegmentLook {
            name: name.to_owned(),
            opacity,
            color_srgb: None,
        };
        let mut unknown = Vec::new();
        let looks = [look("head", 1.0), look("skull", 0.25), look("horn", 1.0)];
        let bodies = bodies_of(&looks, &segments, &mut unknown);
        let opacities = [0, 1, 2, 3, 4].map(|label| bodies.items[label][3]);
        assert_eq!(opacities, [-1.0, 0.25, 1.0, 0.25, -1.0]);
        assert_eq!(unknown, ["horn"]);
    }

    #[test]
    fn bricks_know_their_labels() {
        let dims = UVec3::new(10, 9, 3);
        let mut labels = vec![0; 270];
        labels[9 + 10 * 8 + 90] = 200;
        labels[0] = 3;
        let volume = LabelVolume {
            grid: Grid {
                dims,
                world_from_voxel: DAffine3::IDENTITY,
            },
            labels,
            segments: Vec::new(),
        };
        let sets = labels_in_bricks(&volume, 8);
        assert_eq!(sets.len(), 4, "two by two by one bricks");
        assert_eq!(sets[0][0], 0b1001, "air and label 3");
        assert_eq!(sets[3][6], 1 << (200 - 192), "in the last brick");
        assert_eq!(sets[1][6] | sets[2][6], 0, "and in no other");
    }
}
