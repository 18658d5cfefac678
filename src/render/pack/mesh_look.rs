//! How the segments of a mesh are drawn, as shaders take it.

use super::filling::body_of;
use super::gpu_types::{
    BODY_FULL, BODY_HOLLOW, BODY_THICK, MESH_LAYERS, MeshLayer, MeshLook, MeshSegment,
};
use super::look::linear_color;
use crate::data::SurfaceSegment;
use crate::document::{BodyKind, Look};

/// Stands for a colour that is not given.
const NO_COLOR: [f32; 4] = [0.0, 0.0, 0.0, -1.0];

impl MeshLook {
    /// True if a segment is a shell.
    pub(crate) fn has_shells(&self) -> bool {
        self.segments.iter().any(|own| own.kind == BODY_THICK)
    }
}

/// What `look` says of the segments of meshes, alone or beside a volume. Layers beyond what the shaders hold are left
/// out.
pub(crate) fn mesh_look_of(
    look: &Look,
    segments: &[SurfaceSegment],
    is_beside_volume: bool,
) -> MeshLook {
    let mut packed = MeshLook::default();
    let mut lists = Vec::new();
    let mut used = 0;
    let color_of = |srgb: Option<[u8; 3]>| {
        srgb.map_or(NO_COLOR, |srgb| linear_color(srgb).extend(1.0).to_array())
    };
    for ((slot, segment), number) in packed.segments.iter_mut().zip(segments).zip(1..) {
        // Beside a volume numbers mean its labels.
        let own = look.of_mesh_segment(&segment.name, (!is_beside_volume).then_some(number));
        let surface = own.surface;
        let first_layer = match lists.iter().find(|(layers, _)| *layers == surface.layers) {
            Some((_, first)) => *first,
            None => {
                let first = used;
                for layer in surface.layers.iter().take(MESH_LAYERS - used) {
                    packed.layers[used] = MeshLayer {
                        color: color_of(layer.color_srgb),
                        depth: layer.depth,
                        grain: layer.grain,
                        padding: [0; 2],
                    };
                    used += 1;
                }
                lists.push((surface.layers.clone(), first));
                first
            }
        };
        let kind = match body_of(surface.body, segment.is_closed, is_beside_volume) {
            BodyKind::Thick => BODY_THICK,
            BodyKind::Solid => BODY_FULL,
            BodyKind::Hollow | BodyKind::Auto => BODY_HOLLOW,
        };
        packed.has_filled |= u32::from(kind != BODY_HOLLOW);
        *slot = MeshSegment {
            color: color_of(own.color_srgb),
            inside: color_of(surface.inside_srgb),
            kind,
            thickness: surface.thickness,
            gloss: surface.gloss,
            opacity: own.opacity.unwrap_or(-1.0),
            first_layer: first_layer as u32,
            layer_count: surface.layers.len().min(MESH_LAYERS - first_layer) as u32,
            padding: [0; 2],
        };
    }
    packed
}

/// Names of the open segments that `look` makes solid: lids close them.
pub fn lidded(look: &Look, segments: &[SurfaceSegment], is_beside_volume: bool) -> Vec<String> {
    let is_lidded = |(segment, number): &(&SurfaceSegment, u32)| {
        let number = (!is_beside_volume).then_some(*number);
        let own = look.of_mesh_segment(&segment.name, number);
        !segment.is_closed && own.surface.body == BodyKind::Solid
    };
    let lidded = segments.iter().zip(1..).filter(is_lidded);
    lidded.map(|(segment, _)| segment.name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    #[test]
    fn segments_take_what_the_document_says() {
        let document = Document::from_json(
            r##"{"fabrica":1,"subject":{"meshes":[{"src":"a.stl"}]},"look":{"body":"thick","thickness":0.05,
                "layers":[{"depth":0,"color":"#ff0000"},{"depth":0.1,"grain":0.2}],
                "segments":{"shell":{"opacity":0.4,"body":"auto","color":"#0000ff"},"2":{"layers":[],"gloss":0.9}}}}"##,
        )
        .expect("a good document");
        let segment = |name: &str, is_closed| SurfaceSegment {
            name: name.to_owned(),
            is_closed,
            mean_srgb: [9; 3],
            opacity: 1.0,
        };
        let segments = [
            segment("bone", true),
            segment("skin", true),
            segment("shell", false),
        ];
        let look = mesh_look_of(&document.illustration().look, &segments, false);
        let [bone, skin, shell, ..] = look.segments;
        assert_eq!(
            [bone.kind, skin.kind, shell.kind],
            [BODY_THICK, BODY_THICK, BODY_HOLLOW]
        );
        assert_eq!([bone.opacity, shell.opacity], [-1.0, 0.4]);
        assert_eq!([bone.color[3], shell.color[2]], [-1.0, 1.0]);
        assert_eq!(
            [bone.layer_count, skin.layer_count, shell.layer_count],
            [2, 0, 2]
        );
        assert_eq!(
            bone.first_layer, shell.first_layer,
            "the same layers are held once"
        );
        assert_eq!([bone.thickness, skin.gloss], [0.05, 0.9]);
        assert_eq!(look.layers[1].grain, 0.2);
        assert!(look.has_shells());
        assert_eq!(look.has_filled, 1);
    }

    #[test]
    fn open_segments_that_are_solid_are_named() {
        let document = Document::from_json(
            r#"{"fabrica":1,"subject":{"src":"a.stl"},"look":{"body":"solid","segments":{"sheet":{"body":"hollow"}}}}"#,
        )
        .expect("a good document");
        let segments = [("skull", true), ("hand", false), ("sheet", false)];
        let segments = segments.map(|(name, is_closed)| SurfaceSegment {
            name: name.to_owned(),
            is_closed,
            mean_srgb: [9; 3],
            opacity: 1.0,
        });
        assert_eq!(
            lidded(&document.illustration().look, &segments, false),
            ["hand"]
        );
    }
}
