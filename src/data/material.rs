use glam::{DVec3, UVec3, Vec3};

use super::kept_labels::KeptLabels;
use super::subject::Subject;
use super::volume::Volume;

/// What an untouched subject has at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Value, interpolated as the picture does it; `None` if the subject has no values.
    pub value: Option<f32>,
    /// Name of the segment, or its number if it has no name; `None` outside every segment.
    pub segment: Option<String>,
}

impl Subject {
    /// What a scan has at a place of rest space, with the segment that a picture which keeps this tissue has there;
    /// `None` where the subject ends, and everywhere in a mesh.
    pub fn material_at(&self, pos_in_rest: Vec3, kept: &KeptLabels) -> Option<Material> {
        match self {
            Self::Space(space) => Some(Material {
                value: Some(value_at(&space.volume, pos_in_rest)?),
                segment: segment_at(&space.volume, pos_in_rest, kept),
            }),
            // What fills a mesh is up to a document, and so are the regions of a figure.
            Self::Mesh(_) | Self::Figure(_) => None,
        }
    }
}

/// Value of a volume at a place of rest space; `None` outside.
fn value_at(volume: &Volume, pos_in_rest: Vec3) -> Option<f32> {
    let pos = volume
        .grid
        .subject_from_voxel()
        .inverse()
        .transform_point3(pos_in_rest.as_dvec3());
    let dims = volume.grid.dims.as_dvec3();
    let is_inside = pos.cmpge(DVec3::splat(-0.5)).all() && pos.cmple(dims - 0.5).all();
    if !is_inside {
        return None;
    }
    // Linear between the eight voxels around, the outermost continued to the edge, as the picture has it.
    let pos = pos.clamp(DVec3::ZERO, dims - 1.0);
    let low = pos.floor();
    let part = pos - low;
    let low = low.as_uvec3();
    let mut value = 0.0_f64;
    for corner in 0..8_u32 {
        let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
        let weight =
            DVec3::select(step.cmpeq(UVec3::ONE), part, DVec3::ONE - part).element_product();
        let voxel = (low + step).min(volume.grid.dims - 1);
        value += weight * f64::from(volume.value_at(voxel).unwrap_or(0.0));
    }
    Some(value as f32)
}

/// Name of the segment of a volume at a place of rest space (its number if it has no name).
fn segment_at(volume: &Volume, pos_in_rest: Vec3, kept: &KeptLabels) -> Option<String> {
    let labels = volume.segmentation.as_ref()?;
    // Labels may lie on their own grid; both lie in the scanner's space.
    let world = (volume.grid.world_from_voxel * volume.grid.subject_from_voxel().inverse())
        .transform_point3(pos_in_rest.as_dvec3());
    let voxel = labels
        .grid
        .world_from_voxel
        .inverse()
        .transform_point3(world);
    let label = kept.label_at(labels, voxel).filter(|label| *label != 0)?;
    let segment = labels.segments.iter().find(|s| s.label == u16::from(label));
    Some(segment.map_or_else(|| label.to_string(), |segment| segment.name.clone()))
}
