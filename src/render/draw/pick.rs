//! The surface, the tissue and the segment under a pixel.

use super::passes::Passes;
use super::raycast::{March, encode_marches, frame_group};
use crate::render::device::bindings::encoder;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::{Answer, Readback};
use crate::render::device::textures::{PICK_FORMAT, Target, read_texture};
use crate::render::pack::frame::frame_of;
use crate::render::pack::gpu_types::Frame;
use crate::render::pack::view::View;
use crate::render::scene::Scene;
use crate::render::subject::textures::SubjectTextures;
use glam::{Vec2, Vec3};

/// The surface, the tissue and the segment under a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Where the surface is, subject space (deformed).
    pub pos_in_subject: Vec3,
    /// Unit normal towards the eye, subject space.
    pub normal: Vec3,
    /// Where it was before any template acted.
    pub pos_in_rest: Vec3,
    /// Value of the subject there.
    pub value: f32,
    /// Label of the segment there, if the subject has segments and it belongs to one.
    pub segment: Option<u16>,
    /// Distance from the eye, subject units.
    pub depth: f32,
}

/// A pick on its way back; `None` where there is nothing under the pixel.
pub type PendingPick = Answer<Option<Pick>>;

fn read_pick(bytes: &[u8], has_labels: bool) -> Option<Pick> {
    let floats: Vec<f32> = bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let quad = |i: usize| -> Option<[f32; 4]> {
        floats.get(4 * i..4 * i + 4).and_then(|q| q.try_into().ok())
    };
    let ([x, y, z, depth], [nx, ny, nz, label], [rx, ry, rz, value]) =
        (quad(0)?, quad(1)?, quad(2)?);
    (depth >= 0.0).then_some(Pick {
        pos_in_subject: Vec3::new(x, y, z),
        normal: Vec3::new(nx, ny, nz),
        pos_in_rest: Vec3::new(rx, ry, rz),
        value,
        segment: (has_labels && label > 0.5).then_some(label as u16),
        depth,
    })
}

/// How far away the surface is under each of several pixels, on its way back. One item per pixel: the distance from the
/// eye in subject units, `None` where there is nothing.
pub type PendingDepths = Answer<Vec<Option<f32>>>;

/// The fourth value of each row's first texel.
fn read_depths(bytes: &[u8]) -> Vec<Option<f32>> {
    let rows = bytes.chunks_exact(PITCH as usize);
    let depths = rows.map(|row| f32::from_le_bytes([row[12], row[13], row[14], row[15]]));
    depths
        .map(|depth| (depth >= 0.0).then_some(depth))
        .collect()
}

/// Bytes of a row of what is read back: at most four texels of 16 bytes.
const PITCH: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// What picks look at.
pub(crate) struct PickScene<'a> {
    pub gpu: &'a Gpu,
    pub passes: &'a Passes,
    pub subject: &'a SubjectTextures,
    pub scene: &'a Scene,
    pub view: &'a View,
}

impl PickScene<'_> {
    /// Marches one ray and starts reading what it found.
    pub(crate) fn pick(&self, pixel: Vec2) -> PendingPick {
        let has_labels = self.subject.uniform.has_labels != 0;
        Answer::new(self.read(&[pixel], 4), move |bytes| {
            read_pick(bytes, has_labels)
        })
    }

    /// Marches a ray per pixel, all in one pass, and starts reading how far away their surfaces are. There has to be at
    /// least one pixel, and no more than a texture has rows.
    pub(crate) fn depths(&self, pixels: &[Vec2]) -> PendingDepths {
        Answer::new(self.read(pixels, 1), read_depths)
    }

    /// The first `texels` of the four of a pick, a row per pixel.
    fn read(&self, pixels: &[Vec2], texels: u32) -> Readback {
        let (gpu, scene, view) = (self.gpu, self.scene, self.view);
        let frame = frame_of(view, view, scene.bounds(), self.subject.frame.detail, 0);
        let frames: Vec<wgpu::BindGroup> = pixels
            .iter()
            .map(|pixel| {
                let pick = pixel.to_array();
                frame_group(gpu, &self.passes.layouts, &Frame { pick, ..frame })
            })
            .collect();
        let rows = pixels.len() as u32;
        let tiles: Vec<[u32; 4]> = (0..rows).map(|row| [0, row, texels, 1]).collect();
        let target = Target::new(gpu, "pick", [texels, rows], PICK_FORMAT);
        let pipeline = self.passes.raycast.pipeline(gpu, scene.key(true));
        let mut encoder = encoder(gpu);
        encode_marches(
            &mut encoder,
            &March {
                target: &target.view,
                pipeline: &pipeline,
                frame: &frames[0],
                subject: &self.subject.bind_group,
                scene: &scene.bindings,
                baked: None,
                viewport: [texels, rows],
                tiles: &tiles,
                weight: 1.0,
            },
            &frames,
        );
        read_texture(gpu, encoder, &target.texture, PITCH)
    }
}
