//! The surface, the tissue and the segment under a pixel.

use super::passes::Passes;
use super::raycast::{March, encode_march, frame_group};
use crate::render::device::bindings::encoder;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::Readback;
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

/// A pick on its way back. Await it, or ask once per frame.
#[derive(Debug)]
pub struct PendingPick {
    reading: Readback,
    has_labels: bool,
}

impl PendingPick {
    /// The answer if it has come; does not wait. `Some(Ok(None))`: there is nothing under the pixel.
    pub fn poll_now(&mut self) -> Option<Result<Option<Pick>, RenderError>> {
        let has_labels = self.has_labels;
        self.reading
            .poll_now()
            .map(|bytes| bytes.map(|b| read_pick(&b, has_labels)))
    }
}

impl Future for PendingPick {
    type Output = Result<Option<Pick>, RenderError>;

    fn poll(
        mut self: std::pin::Pin<&mut Self>,
        context: &mut std::task::Context<'_>,
    ) -> std::task::Poll<Self::Output> {
        let has_labels = self.has_labels;
        std::pin::Pin::new(&mut self.reading)
            .poll(context)
            .map(|bytes| bytes.map(|b| read_pick(&b, has_labels)))
    }
}

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

/// Marches one ray and starts reading what it found.
pub(crate) fn encode_pick(
    gpu: &Gpu,
    passes: &Passes,
    subject: &SubjectTextures,
    scene: &Scene,
    view: &View,
    pixel: Vec2,
    has_labels: bool,
) -> PendingPick {
    let frame = Frame {
        pick: pixel.to_array(),
        ..frame_of(view, view, scene.bounds(), subject.frame.detail, 0)
    };
    let target = Target::new(gpu, "pick", [4, 1], PICK_FORMAT);
    let pipeline = passes.raycast.pipeline(gpu, scene.key(true));
    let mut encoder = encoder(gpu);
    encode_march(
        &mut encoder,
        &March {
            target: &target.view,
            pipeline: &pipeline,
            frame: &frame_group(gpu, &passes.layouts, &frame),
            subject: &subject.bind_group,
            scene: &scene.bindings,
            baked: None,
            viewport: [4, 1],
            tiles: &[[0, 0, 4, 1]],
            weight: 1.0,
        },
    );
    PendingPick {
        reading: read_texture(
            gpu,
            encoder,
            &target.texture,
            wgpu::COPY_BYTES_PER_ROW_ALIGNMENT,
        ),
        has_labels,
    }
}
