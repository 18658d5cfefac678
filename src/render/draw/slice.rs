//! Flat cuts through the deformed object: shown as grey by a window or in the look's colours, or read as numbers.

use super::image::{Image, read_picture};
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::{Layouts, pipeline_layout};
use crate::render::device::pipelines::{PipelineParts, Pipelines, render_pass, render_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::device::readback::Answer;
use crate::render::device::textures::{
    OUTPUT_FORMAT, PICK_FORMAT, Target, read_texture, row_pitch,
};
use crate::render::pack::gpu_types::{Affine, SLICE_COLORS, SLICE_GREY, SLICE_MARKED, Slice};
use crate::render::pack::look::linear_color;
use crate::render::pack::raycast_key::{Finds, RaycastKey};
use crate::render::scene::Scene;
use crate::render::subject::textures::SubjectTextures;
use glam::{Vec2, Vec3};

/// Where a slice lies: subject space from pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlicePlane {
    /// The top left corner of the first pixel, subject space.
    pub corner: Vec3,
    /// From one pixel to the next to the right, subject units.
    pub right: Vec3,
    /// From one pixel to the next below, subject units.
    pub down: Vec3,
}

impl SlicePlane {
    /// Subject space at a place of the slice, pixels from its top left corner.
    pub fn subject_from_pixel(&self, pixel: Vec2) -> Vec3 {
        self.corner + self.right * pixel.x + self.down * pixel.y
    }
}

/// How a slice is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SliceColors {
    /// Values from black to white over a window, linear in what the screen is sent.
    Grey {
        /// Value of black and of white.
        window: [f32; 2],
        /// Bodies lie over the grey in their colours.
        marks_bodies: bool,
    },
    /// In the look's colours.
    Look,
}

/// Values that a slice shows in a colour, whatever else it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkedValues {
    /// The lowest and the highest of them, in the subject's own values.
    pub range: [f32; 2],
    /// Their colour, sRGB bytes. What lies below still shows through.
    pub color_srgb: [u8; 3],
}

/// How much of their colour marked values take, 0 to 1: the tissue below stays readable.
const MARK_STRENGTH: f32 = 0.75;

/// A slice to be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceView {
    /// The plane that is cut.
    pub plane: SlicePlane,
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// Whether grey levels or colours are drawn.
    pub colors: SliceColors,
    /// Where nothing is, sRGB bytes.
    pub background_srgb: [u8; 3],
    /// Samples per pixel along each side, 1 to 4.
    pub samples: u32,
    /// Values that are tinted; `None` for none.
    pub marked: Option<MarkedValues>,
}

/// What the object has at one pixel of a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceTexel {
    /// Value of the subject, interpolated.
    pub value: f32,
    /// Label of the nearest voxel of the segments; `None` for none.
    pub segment: Option<u16>,
    /// The composed continuity; below 0 there is a gap.
    pub continuity: f32,
    /// False in a gap and outside the subject: then value and segment mean nothing.
    pub is_there: bool,
    /// Where it was before any template acted.
    pub pos_in_rest: Vec3,
}

/// Numbers of a slice on their way back, row by row from the top.
pub type PendingSlice = Answer<Vec<SliceTexel>>;

fn texels(bytes: &[u8], [width, height]: [u32; 2], pitch: u32) -> Vec<SliceTexel> {
    let rows = bytes
        .chunks_exact(pitch.max(1) as usize)
        .take(height as usize);
    rows.flat_map(|row| {
        let pixels = row.chunks_exact(32).take(width as usize);
        pixels.map(|pixel| {
            let f: [f32; 8] = std::array::from_fn(|i| {
                let at = |k: usize| pixel.get(4 * i + k).copied().unwrap_or_default();
                f32::from_le_bytes([at(0), at(1), at(2), at(3)])
            });
            SliceTexel {
                value: f[0],
                segment: (f[1] > 0.5).then_some(f[1] as u16),
                continuity: f[2],
                is_there: f[3] > 0.5,
                pos_in_rest: Vec3::new(f[4], f[5], f[6]),
            }
        })
    })
    .collect()
}

/// What a pipeline is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct SliceKey {
    /// What of the document the program has to hold.
    drawn: RaycastKey,
    is_read: bool,
}

/// Layout and pipelines of slices. Built once per device; each pipeline is made at its first use.
#[derive(Debug)]
pub(crate) struct SlicePasses {
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    /// Each is compiled when the first slice comes that is drawn by it.
    modules: Pipelines<(ProgramId, SubjectShader, Cases), wgpu::ShaderModule>,
    pipelines: Pipelines<SliceKey, wgpu::RenderPipeline>,
}

impl SlicePasses {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let groups = [
            &layouts.empty,
            &layouts.subject,
            &layouts.scene,
            &layouts.slice,
        ];
        Self {
            modules: Pipelines::default(),
            layout: layouts.slice.clone(),
            pipeline_layout: pipeline_layout(gpu, "slice", &groups),
            pipelines: Pipelines::default(),
        }
    }

    fn pipeline(&self, gpu: &Gpu, key: SliceKey) -> wgpu::RenderPipeline {
        self.pipelines.get(key, || self.make(gpu, key))
    }

    fn make(&self, gpu: &Gpu, key: SliceKey) -> wgpu::RenderPipeline {
        let mut constants = vec![
            ("drawn_kinds", f64::from(key.drawn.drawn_kinds)),
            ("has_objects", f64::from(u8::from(key.drawn.has_objects))),
            key.drawn.textures_constant(true),
        ];
        let mut program = ProgramId::Slice;
        if key.drawn.keeps_tissue() {
            constants.extend(key.drawn.align_constants());
            program = ProgramId::SliceAligned;
        }
        let (subject, cases) = (key.drawn.subject, key.drawn.cases());
        let make = || module_for(gpu, program, subject, cases);
        let module = self.modules.get((program, subject, cases), make);
        let (entry, format) = if key.is_read {
            ("read", PICK_FORMAT)
        } else {
            ("draw", OUTPUT_FORMAT)
        };
        let parts = PipelineParts {
            label: "slice",
            layout: &self.pipeline_layout,
            module: &module,
            entry,
            constants: &constants,
            formats: &[format],
            blend: None,
        };
        render_pipeline(gpu, &parts)
    }
}

/// What a slice is drawn with.
pub(crate) struct SliceScene<'a> {
    pub gpu: &'a Gpu,
    pub passes: &'a SlicePasses,
    pub subject: &'a SubjectTextures,
    pub scene: &'a Scene,
}

impl SliceScene<'_> {
    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        slice: &Slice,
        is_read: bool,
    ) {
        let key = SliceKey {
            drawn: self.scene.key_for(Finds::Picture),
            is_read,
        };
        let pipeline = self.passes.pipeline(self.gpu, key);
        let buffer = uniform_buffer(self.gpu, "slice", slice);
        let group = self
            .gpu
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("slice"),
                layout: &self.passes.layout,
                entries: &[entry(0, buffer.as_entire_binding())],
            });
        let mut pass = render_pass(encoder, "slice", &[target]);
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(1, &self.subject.bind_group, &[]);
        pass.set_bind_group(2, &self.scene.bindings, &[]);
        pass.set_bind_group(3, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Starts reading the numbers of a slice.
    pub(crate) fn read(
        &self,
        plane: &SlicePlane,
        size_px: [u32; 2],
    ) -> Result<PendingSlice, RenderError> {
        let size = checked_size(self.gpu, size_px, 2)?;
        let target = Target::new(
            self.gpu,
            "slice numbers",
            [2 * size[0], size[1]],
            PICK_FORMAT,
        );
        let mut encoder = encoder(self.gpu);
        self.encode(&mut encoder, &target.view, &uniform_of(plane), true);
        let pitch = row_pitch(32 * size[0]);
        let reading = read_texture(self.gpu, encoder, &target.texture, pitch);
        Ok(Answer::new(reading, move |bytes| {
            texels(bytes, size, pitch)
        }))
    }
}

fn checked_size(gpu: &Gpu, size: [u32; 2], texels: u32) -> Result<[u32; 2], RenderError> {
    let max = gpu.device.limits().max_texture_dimension_2d;
    if size[0] == 0 || size[1] == 0 || size[0].saturating_mul(texels) > max || size[1] > max {
        return Err(RenderError::BadSize {
            width: size[0],
            height: size[1],
            max: max / texels,
        });
    }
    Ok(size)
}

fn uniform_of(plane: &SlicePlane) -> Slice {
    let row = |i: usize| [plane.right[i], plane.down[i], 0.0, plane.corner[i]];
    Slice {
        subject_from_pixel: Affine {
            row0: row(0),
            row1: row(1),
            row2: row(2),
        },
        ..Slice::default()
    }
}

/// The slices that are on show, each with its texture. Drawn anew only when something about one changed.
#[derive(Debug, Default)]
pub(crate) struct SliceBoard {
    slots: Vec<Option<Slot>>,
    generation: u64,
}

#[derive(Debug)]
struct Slot {
    target: Target,
    size: [u32; 2],
    generation: u64,
    /// What the texture shows: the slice and the scene's revision.
    shown: Option<(SliceView, u64)>,
}

impl SliceBoard {
    /// Brings a slot up to date. True if it was drawn.
    pub(crate) fn draw(
        &mut self,
        slot: usize,
        view: &SliceView,
        scene: &SliceScene<'_>,
    ) -> Result<bool, RenderError> {
        let size = checked_size(scene.gpu, view.size_px, 1)?;
        if self.slots.len() <= slot {
            self.slots.resize_with(slot + 1, || None);
        }
        let Some(place) = self.slots.get_mut(slot) else {
            return Ok(false);
        };
        if place.as_ref().is_none_or(|made| made.size != size) {
            self.generation += 1;
            *place = Some(Slot {
                target: Target::new(scene.gpu, "slice", size, OUTPUT_FORMAT),
                size,
                generation: self.generation,
                shown: None,
            });
        }
        let Some(place) = place else {
            return Ok(false);
        };
        let shown = Some((*view, scene.scene.revision));
        if place.shown == shown {
            return Ok(false);
        }
        let info = &scene.subject.info;
        let [low, high] = info.value_range;
        let (mode, [grey_scale, grey_offset]) = match view.colors {
            SliceColors::Grey {
                window: [black, white],
                marks_bodies,
            } => {
                let width = (white - black).max(f32::MIN_POSITIVE);
                let mode = if marks_bodies {
                    SLICE_MARKED
                } else {
                    SLICE_GREY
                };
                (mode, [(high - low) / width, (low - black) / width])
            }
            SliceColors::Look => (SLICE_COLORS, [0.0; 2]),
        };
        let (marked_color, [marked_from, marked_to]) = match view.marked {
            Some(MarkedValues { range, color_srgb }) => {
                let span = (high - low).max(f32::MIN_POSITIVE);
                let color = linear_color(color_srgb).to_array();
                // Beyond the subject's values nothing is told apart.
                let texel = |value: f32| ((value - low) / span).clamp(-1.0, 2.0);
                (color, range.map(texel))
            }
            None => ([0.0; 3], [0.0; 2]),
        };
        let slice = Slice {
            background: linear_color(view.background_srgb).extend(1.0).to_array(),
            grey_scale,
            grey_offset,
            mode,
            samples: view.samples.clamp(1, 4),
            marked_color,
            marked_strength: view.marked.map_or(0.0, |_| MARK_STRENGTH),
            marked_from,
            marked_to,
            ..uniform_of(&view.plane)
        };
        let mut encoder = encoder(scene.gpu);
        scene.encode(&mut encoder, &place.target.view, &slice, false);
        scene.gpu.queue.submit([encoder.finish()]);
        place.shown = shown;
        Ok(true)
    }

    /// Starts reading the picture of a slot.
    pub(crate) fn read(
        &self,
        slot: usize,
        gpu: &Gpu,
    ) -> Result<impl Future<Output = Result<Image, RenderError>> + use<>, RenderError> {
        let slot = self.slots.get(slot).and_then(Option::as_ref);
        let slot = slot.ok_or(RenderError::NoSubject)?;
        Ok(read_picture(gpu, encoder(gpu), &slot.target.texture))
    }

    /// Everything is drawn anew: another subject is shown.
    pub(crate) fn forget(&mut self) {
        for slot in self.slots.iter_mut().flatten() {
            slot.shown = None;
        }
    }

    /// The picture of a slot (Rgba8Unorm, sRGB-encoded) and a number that changes with its texture.
    pub(crate) fn view(&self, slot: usize) -> Option<(&wgpu::TextureView, u64)> {
        let slot = self.slots.get(slot)?.as_ref()?;
        Some((&slot.target.view, slot.generation))
    }
}
