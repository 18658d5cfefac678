//! The surface, the tissue and the segment under a pixel.

use super::passes::Passes;
use super::raycast::{March, encode_march, frame_group, rays_group};
use crate::data::Sheet;
use crate::render::device::bindings::encoder;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::{Answer, Readback};
use crate::render::device::textures::{PICK_FORMAT, Target, read_texture};
use crate::render::pack::frame::frame_of;
use crate::render::pack::gpu_types::MAX_ASKED_RAYS;
use crate::render::pack::raycast_key::Finds;
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
    /// The object there, an index into the document's list; `None` where the subject is seen.
    pub object: Option<usize>,
}

/// A pick on its way back; `None` where there is nothing under the pixel.
pub type PendingPick = Answer<Option<Pick>>;

/// `objects` are the indices of those that are drawn.
fn read_pick(bytes: &[u8], has_labels: bool, objects: &[usize]) -> Option<Pick> {
    let floats: Vec<f32> = bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect();
    let quad = |i: usize| -> Option<[f32; 4]> {
        floats.get(4 * i..4 * i + 4).and_then(|q| q.try_into().ok())
    };
    let ([x, y, z, depth], [nx, ny, nz, label], [rx, ry, rz, value], [object, ..]) =
        (quad(0)?, quad(1)?, quad(2)?, quad(3)?);
    (depth >= 0.0).then_some(Pick {
        pos_in_subject: Vec3::new(x, y, z),
        normal: Vec3::new(nx, ny, nz),
        pos_in_rest: Vec3::new(rx, ry, rz),
        value,
        segment: (has_labels && label > 0.5).then_some(label as u16),
        depth,
        object: numbered(object, objects),
    })
}

/// The index of an object that shaders number from 1; `None` for 0.
fn numbered(number: f32, objects: &[usize]) -> Option<usize> {
    let drawn = (number as usize).checked_sub(1)?;
    objects.get(drawn).copied()
}

/// What a ray (origin, unit direction) meets of a figure, which lies in the plane z = 0.
fn picked(sheet: &Option<&Sheet>, (origin, dir): (Vec3, Vec3)) -> Option<Pick> {
    let depth = -origin.z / dir.z;
    if !(depth.is_finite() && depth > 0.0) {
        return None;
    }
    let place = origin + depth * dir;
    let (_, at_rest) = (*sheet)?.back(place.truncate())?;
    Some(Pick {
        pos_in_subject: place.truncate().extend(0.0),
        normal: Vec3::Z * origin.z.signum(),
        pos_in_rest: at_rest.extend(0.0),
        value: 0.0,
        segment: None,
        depth,
        object: None,
    })
}

/// Where a ray meets a figure.
fn event(sheet: &Option<&Sheet>, ray: (Vec3, Vec3)) -> Option<RayEvent> {
    let pick = picked(sheet, ray)?;
    Some(RayEvent {
        distance: pick.depth,
        meeting: match pick.normal.z > 0.0 {
            true => Meeting::Surface,
            false => Meeting::Inside,
        },
        segment: None,
        normal: pick.normal,
        pos_in_rest: pick.pos_in_rest,
        albedo: Vec3::ONE,
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

/// What a ray meets (spec/surfaces.md, "What the object has at a point, and what a ray meets").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// A triangle from its front.
    Surface,
    /// A triangle from its back.
    Inside,
    /// The cut face of a body.
    Cut,
    /// A triangle of an object.
    Object,
    /// Opacity of a scan.
    Volume,
}

impl Meeting {
    /// What it is called on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Surface => "surface",
            Self::Inside => "inside",
            Self::Cut => "cut",
            Self::Object => "object",
            Self::Volume => "volume",
        }
    }
}

/// Where a ray turns more than half opaque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayEvent {
    /// Distance from the ray's origin, subject units.
    pub distance: f32,
    /// What is there.
    pub meeting: Meeting,
    /// The segment of a mesh, or the object as an index into the document's list, from 0.
    pub segment: Option<usize>,
    /// Unit normal towards the origin, subject space; of a triangle that of its plane.
    pub normal: Vec3,
    /// Where it was before any template acted, rest space.
    pub pos_in_rest: Vec3,
    /// Colour before light, linear.
    pub albedo: Vec3,
}

/// Events on their way back, one per ray; `None` for a ray that stays more than half clear.
pub type PendingEvents = Answer<Vec<Option<RayEvent>>>;

fn read_events(bytes: &[u8], objects: &[usize]) -> Vec<Option<RayEvent>> {
    let event = |row: &[u8]| {
        let [at, normal, rest, albedo]: [[f32; 4]; 4] = std::array::from_fn(|texel| {
            std::array::from_fn(|i| {
                let byte = 16 * texel + 4 * i;
                f32::from_le_bytes([row[byte], row[byte + 1], row[byte + 2], row[byte + 3]])
            })
        });
        let meeting = match at[1] as u32 {
            1 => Meeting::Surface,
            2 => Meeting::Inside,
            3 => Meeting::Cut,
            4 => Meeting::Object,
            5 => Meeting::Volume,
            _ => return None,
        };
        let place = |texel: [f32; 4]| Vec3::new(texel[0], texel[1], texel[2]);
        Some(RayEvent {
            distance: at[0],
            meeting,
            segment: match meeting {
                Meeting::Object => numbered(at[2], objects),
                _ => (at[2] as usize).checked_sub(1),
            },
            normal: place(normal),
            pos_in_rest: place(rest),
            albedo: place(albedo),
        })
    };
    bytes.chunks_exact(PITCH as usize).map(event).collect()
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
        if let Some(sheet) = self.sheet() {
            return Answer::known(picked(&sheet, self.view.ray(pixel)));
        }
        let has_labels = self.subject.has_segments();
        let read = self.read(self.view, &[self.view.ray(pixel)], 4, Finds::Pick);
        let objects = self.scene.objects_drawn().to_vec();
        Answer::new(read, move |bytes| read_pick(bytes, has_labels, &objects))
    }

    /// Marches a ray per pixel, all in one go, and starts reading how far away their surfaces are. There has to be at
    /// least one pixel, and no more than a texture has rows.
    pub(crate) fn depths(&self, pixels: &[Vec2]) -> PendingDepths {
        let rays: Vec<(Vec3, Vec3)> = pixels.iter().map(|pixel| self.view.ray(*pixel)).collect();
        if let Some(sheet) = self.sheet() {
            let depth = |ray: &(Vec3, Vec3)| picked(&sheet, *ray).map(|pick| pick.depth);
            return Answer::known(rays.iter().map(depth).collect());
        }
        let read = self.read(self.view, &rays, 1, Finds::Pick);
        Answer::new(read, read_depths)
    }

    /// Marches rays of subject space (origin, unit direction) and starts reading where each turns more than half
    /// opaque. There has to be at least one, and no more than a texture has rows.
    pub(crate) fn events(&self, rays: &[(Vec3, Vec3)]) -> PendingEvents {
        if let Some(sheet) = self.sheet() {
            return Answer::known(rays.iter().map(|ray| event(&sheet, *ray)).collect());
        }
        let view = rays
            .first()
            .map_or(*self.view, |&(origin, dir)| View::along(origin, dir));
        let objects = self.scene.objects_drawn().to_vec();
        let read = self.read(&view, rays, 4, Finds::Event);
        Answer::new(read, move |bytes| read_events(bytes, &objects))
    }

    /// The bent figure, if the subject is one: nobody has to be asked about it.
    fn sheet(&self) -> Option<Option<&Sheet>> {
        let sheet = self.scene.sheet().map(|buffers| &buffers.sheet);
        self.subject.plate.as_ref().map(|_| sheet)
    }

    /// The first `texels` of the four that are found, a row per ray. Steps are as fine as the view asks for.
    fn read(&self, view: &View, rays: &[(Vec3, Vec3)], texels: u32, finds: Finds) -> Readback {
        let (gpu, scene, layouts) = (self.gpu, self.scene, &self.passes.layouts);
        let frame = frame_of(view, view, scene.bounds(), self.subject.frame.detail, 0);
        let frame = frame_group(gpu, layouts, &frame);
        let rows = rays.len() as u32;
        let target = Target::new(gpu, "pick", [texels, rows], PICK_FORMAT);
        let pipeline = self.passes.raycast.pipeline(gpu, scene.key_for(finds));
        let mut encoder = encoder(gpu);
        for (batch, first) in rays
            .chunks(MAX_ASKED_RAYS)
            .zip((0..).step_by(MAX_ASKED_RAYS))
        {
            let asked = rays_group(gpu, layouts, batch);
            encode_march(
                &mut encoder,
                &March {
                    targets: &[&target.view],
                    pipeline: &pipeline,
                    frame: &frame,
                    subject: &self.subject.bind_group,
                    scene: &scene.bindings,
                    pass: Some(&asked),
                    viewport: [texels, rows],
                    tiles: &[[0, first, texels, batch.len() as u32]],
                    weight: 1.0,
                },
            );
        }
        read_texture(gpu, encoder, &target.texture, PITCH)
    }
}
