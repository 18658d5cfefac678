//! Which labels are drawn as bodies of their own, and how.

use super::gpu_types::{BODY_HIDDEN, Bodies};
use super::kept::labels_of;
use super::look::linear_color;
use crate::data::{FIRST_MESH_LABEL, Segment};
use crate::document::SegmentLook;

/// Color of a body whose segment has none, sRGB.
const PLAIN_SRGB: [u8; 3] = [200; 3];

/// How each label is drawn. Where segments overlap, the one that the subject lists first decides. Names that mean no
/// segment go to `unknown`.
pub(crate) fn bodies_of(
    looks: &[SegmentLook],
    segments: &[Segment],
    unknown: &mut Vec<String>,
) -> Bodies {
    let mut bodies = Bodies::NONE;
    let mut ranks = [usize::MAX; 256];
    for look in looks {
        let labels = labels_of(&look.name, segments);
        if labels.is_empty() {
            unknown.push(look.name.clone());
        }
        // Meshes beside a volume are drawn by their triangles, as `mesh_look_of` has it.
        let voxels = labels.into_iter().filter(|&label| label < FIRST_MESH_LABEL);
        for label in voxels.map(usize::from) {
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

impl Bodies {
    /// True if anything is drawn as a body, or hidden.
    pub(crate) fn is_any(&self) -> bool {
        *self != Self::NONE
    }

    /// The labels that are drawn as bodies or hidden: bit `n` for label `n`.
    pub(crate) fn labels(&self) -> [u32; 8] {
        self.labels_from(0.0)
    }

    /// The labels that are drawn as bodies and not hidden: bit `n` for label `n`.
    pub(crate) fn visible(&self) -> [u32; 8] {
        self.labels_from(BODY_HIDDEN)
    }

    fn labels_from(&self, least_opacity: f32) -> [u32; 8] {
        let mut set = [0; 8];
        for (label, item) in self.items.iter().enumerate() {
            if item[3] >= least_opacity {
                set[label / 32] |= 1 << (label % 32);
            }
        }
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            opacity,
            ..SegmentLook::solid(name)
        };
        let mut unknown = Vec::new();
        let looks = [look("head", 1.0), look("skull", 0.25), look("horn", 1.0)];
        let bodies = bodies_of(&looks, &segments, &mut unknown);
        let opacities = [0, 1, 2, 3, 4].map(|label| bodies.items[label][3]);
        assert_eq!(opacities, [-1.0, 0.25, 1.0, 0.25, -1.0]);
        assert_eq!(unknown, ["horn"]);
    }
}
