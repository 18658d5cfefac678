//! Which segment each pixel of a picture shows.

use super::picture::{Band, PictureJob};
use crate::render::device::bindings::encoder;
use crate::render::device::error::RenderError;
use crate::render::device::textures::{PICK_FORMAT, Target, read_texture, row_pitch};
use crate::render::pack::raycast_key::Finds;
use glam::Vec2;

/// What each pixel of a picture shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sighting {
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// Rows from the top. `None`: there is no surface under the pixel; else the label of the segment at the first
    /// visible surface, 0 where it belongs to none.
    pub labels: Vec<Option<u16>>,
}

/// Size of a picture that tells what is in sight, pixels: of the shape of `fabrica render`'s, and large enough that
/// the share of a segment is that of a full-size picture within two hundredths.
pub const SIGHT_PX: [u32; 2] = [160, 120];

/// Bytes of a texel of [`PICK_FORMAT`].
const TEXEL: usize = 16;

/// Marches one ray per pixel, through its middle, and reads back what each found.
pub(super) async fn identify(job: &PictureJob) -> Result<Sighting, RenderError> {
    if job.subject.plate.is_some() {
        return Ok(identify_sheet(job));
    }
    let gpu = &job.gpu;
    let target = Target::new(gpu, "segments", job.size, PICK_FORMAT);
    job.march(
        &[&target.view],
        Band {
            first: 0,
            size: job.size,
        },
        (job.scene.key_for(Finds::Segments), None),
        0,
        |_| Ok(()),
    )
    .await?;
    let width = job.size[0] as usize;
    let pitch = row_pitch((TEXEL * width) as u32);
    let bytes = read_texture(gpu, encoder(gpu), &target.texture, pitch).await;
    target.texture.destroy();
    let bytes = bytes?;
    if let Some(message) = gpu.take_errors().into_iter().next() {
        return Err(RenderError::Refused {
            pass: "segments",
            message,
        });
    }
    let has_labels = job.subject.has_segments();
    let rows = bytes.chunks_exact(pitch as usize);
    let texels = rows.flat_map(|row| row.as_chunks::<TEXEL>().0.iter().take(width));
    let labels = texels.map(|&[a, b, c, d, e, f, g, h, ..]| {
        let depth = f32::from_le_bytes([a, b, c, d]);
        let label = f32::from_le_bytes([e, f, g, h]);
        (depth >= 0.0).then_some(if has_labels { label as u16 } else { 0 })
    });
    Ok(Sighting {
        size_px: job.size,
        labels: labels.collect(),
    })
}

/// What each pixel shows of a figure, in its middle: labels count its regions from 1. Its triangles are laid down from
/// behind to front, so that the time hangs on the pixels that each covers.
fn identify_sheet(job: &PictureJob) -> Sighting {
    let [width, height] = job.size;
    let mut labels = vec![None; width as usize * height as usize];
    let sheet = job.scene.sheet().map(|buffers| &buffers.sheet);
    let sighting = |labels| Sighting {
        size_px: job.size,
        labels,
    };
    let Some(sheet) = sheet else {
        return sighting(labels);
    };
    let pixel = |place: &Vec2| job.view.pixel_from_subject(place.extend(0.0));
    let pixels: Vec<Option<Vec2>> = sheet.places.iter().map(pixel).collect();
    let corner = |vertex: u32| pixels.get(vertex as usize).copied().flatten();
    let last = Vec2::new(width as f32, height as f32) - 1.0;
    for triangle in sheet.order.iter().map(|triangle| *triangle as usize) {
        let corners = sheet.mesh.triangles.get(triangle);
        let region = sheet.mesh.region_of.get(triangle);
        let (Some([a, b, c]), Some(region)) = (corners.map(|t| t.map(corner)), region) else {
            continue;
        };
        let (Some(a), Some(b), Some(c)) = (a, b, c) else {
            continue;
        };
        let area = (b - a).perp_dot(c - a);
        let low = (a.min(b).min(c) - 0.5).ceil().max(Vec2::ZERO);
        let high = (a.max(b).max(c) - 0.5).floor().min(last);
        if area == 0.0 || low.cmpgt(high).any() {
            continue;
        }
        for row in low.y as u32..=high.y as u32 {
            for column in low.x as u32..=high.x as u32 {
                let at = Vec2::new(column as f32, row as f32) + 0.5;
                let parts = [
                    (b - at).perp_dot(c - at) / area,
                    (c - at).perp_dot(a - at) / area,
                    (a - at).perp_dot(b - at) / area,
                ];
                let index = row as usize * width as usize + column as usize;
                if parts.iter().all(|part| *part >= 0.0) {
                    labels[index] = Some(region + 1);
                }
            }
        }
    }
    sighting(labels)
}
