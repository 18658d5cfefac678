//! Objects of the scene as shaders take them: where they stand and how they look.

use std::sync::Arc;

use glam::{Affine3A, DAffine3, DVec3, Mat3A, Vec3A};

use super::gpu_types::{SceneObject, SceneObjects};
use super::look::linear_color;
use super::triangles::{texels_of, texels_of_textures, triangles_at};
use crate::data::{Resources, SubjectFrame, Surface};
use crate::document::{self, ObjectPlacement};

/// Texels that the pictures of all objects take at most: twice what one file may have, with its smaller copies. Those
/// of the objects behind are not drawn.
const MOST_TEXTURE_TEXELS: u32 = 12_000_000;

/// The objects that are drawn, and the meshes that their texels are made of.
#[derive(Clone, Debug, Default)]
pub(crate) struct DrawnObjects {
    /// As shaders take them.
    pub items: SceneObjects,
    /// Index in the document's list of each of `items`.
    pub indices: Vec<usize>,
    /// Each mesh once, in the order of their texels, and whether its pictures are drawn.
    pub meshes: Vec<(Arc<Surface>, bool)>,
}

/// Two are equal if they share their meshes in memory.
impl PartialEq for DrawnObjects {
    fn eq(&self, other: &Self) -> bool {
        self.items == other.items && self.indices == other.indices && self.has_meshes_of(other)
    }
}

impl DrawnObjects {
    /// The objects of a document whose meshes have come and that are seen.
    pub(crate) fn of(
        objects: &[document::SceneObject],
        resources: &Resources,
        subject: &SubjectFrame,
    ) -> Self {
        let mut drawn = Self::default();
        let mut begin = Vec::new();
        let mut texels = 0;
        let mut room = MOST_TEXTURE_TEXELS;
        let color_of = |srgb: Option<[u8; 3]>| match srgb {
            Some(srgb) => linear_color(srgb).extend(1.0).to_array(),
            None => [0.0, 0.0, 0.0, -1.0],
        };
        for object in objects
            .iter()
            .filter(|object| object.enabled && object.opacity > 0.0)
        {
            let Some(mesh) = resources.object(object) else {
                continue;
            };
            let Some(slot) = drawn.items.items.get_mut(drawn.indices.len()) else {
                break;
            };
            let known = drawn
                .meshes
                .iter()
                .position(|(known, _)| Arc::ptr_eq(known, mesh));
            let at = known.unwrap_or_else(|| {
                begin.push(texels);
                texels += texels_of(mesh);
                let pictures = texels_of_textures(mesh);
                let has_pictures = pictures > 0 && pictures <= room;
                if has_pictures {
                    (texels, room) = (texels + pictures, room - pictures);
                }
                drawn.meshes.push((Arc::clone(mesh), has_pictures));
                drawn.meshes.len() - 1
            });
            *slot = SceneObject {
                object_from_subject: object_from_subject(object, mesh, subject).into(),
                color: color_of(object.color_srgb),
                inside: color_of(object.inside_srgb),
                opacity: object.opacity,
                gloss: object.gloss,
                nodes_at: begin[at],
                triangles_at: begin[at] + triangles_at(mesh),
                node_count: mesh.tree.nodes.len() as u32,
                textures_at: match drawn.meshes[at].1 {
                    true => begin[at] + texels_of(mesh),
                    false => 0,
                },
                padding: [0; 2],
            };
            drawn.indices.push(object.index);
        }
        drawn.items.count = drawn.indices.len() as u32;
        drawn
    }

    /// True if pictures lie on the triangles of one that is drawn.
    pub(crate) fn has_textures(&self) -> bool {
        self.meshes.iter().any(|(_, has_pictures)| *has_pictures)
    }

    /// True if the texels of both are the same.
    pub(crate) fn has_meshes_of(&self, other: &Self) -> bool {
        let mut pairs = self.meshes.iter().zip(&other.meshes);
        self.meshes.len() == other.meshes.len() && pairs.all(|(a, b)| Arc::ptr_eq(&a.0, &b.0))
    }
}

/// Subject space to an object's own space, whose origin is the middle of the object's box and whose unit is its longest
/// side.
fn object_from_subject(
    object: &document::SceneObject,
    mesh: &Surface,
    subject: &SubjectFrame,
) -> Affine3A {
    match object.placement {
        Some(ObjectPlacement { at, rotate, size }) => {
            // The rows of a turn are the columns of the turn back.
            let back = Mat3A::from_quat(rotate).transpose() * (1.0 / size);
            Affine3A {
                matrix3: back,
                translation: back * -Vec3A::from(at),
            }
        }
        None => {
            let place = |frame: &SubjectFrame| {
                DAffine3::from_scale_rotation_translation(
                    DVec3::splat(frame.mm_per_unit),
                    glam::DQuat::IDENTITY,
                    frame.middle_mm,
                )
            };
            (place(&mesh.frame).inverse() * place(subject)).as_affine3a()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::cube;
    use crate::data::{Mesh, MeshPart};
    use crate::document::Document;
    use glam::Vec3;

    fn mesh() -> Arc<Surface> {
        let (positions, triangles) = cube();
        let mesh = Mesh {
            positions,
            triangles,
            parts: vec![MeshPart {
                name: "cube".to_owned(),
                triangles: 0..12,
            }],
            ..Mesh::default()
        };
        Arc::new(Surface::new(&mesh, None, &mut |_| true).expect("it has a size"))
    }

    #[test]
    fn objects_stand_where_the_document_says() {
        let document = Document::from_json(
            r##"{"fabrica":1,"objects":[{"src":"a.stl","at":[0.5,0,0],"rotate":[0,0,0.7071067811865476,0.7071067811865476],
                "size":0.2},{"src":"a.stl","color":"#ff0000","enabled":false},{"src":"a.stl","opacity":0},
                {"src":"b.stl"},{"src":"a.stl"}]}"##,
        )
        .expect("a good document");
        let objects = &document.illustration().objects;
        let mesh = mesh();
        let mut resources = Resources::default();
        let mut subject = mesh.frame;
        (subject.middle_mm, subject.mm_per_unit) = (DVec3::ZERO, 100.0);
        assert_eq!(
            DrawnObjects::of(objects, &resources, &subject),
            DrawnObjects::default(),
            "nothing has come"
        );
        let source = objects[0].source.clone();
        resources.objects.push((source, Arc::clone(&mesh)));
        let drawn = DrawnObjects::of(objects, &resources, &subject);
        assert_eq!(drawn.indices, [0, 4], "those that are there and seen");
        assert_eq!(drawn.meshes.len(), 1, "the mesh is held once");
        let place = |k: usize, pos: Vec3| {
            let map = drawn.items.items[k].object_from_subject;
            Vec3::from_array(
                [map.row0, map.row1, map.row2].map(|[x, y, z, w]| Vec3::new(x, y, z).dot(pos) + w),
            )
        };
        // A quarter turn about z takes the object's x to the subject's y.
        let end = place(0, Vec3::new(0.5, 0.1, 0.0));
        assert!(end.distance(Vec3::new(0.5, 0.0, 0.0)) < 1e-6, "{end}");
        // Where its file says, in millimetres.
        let middle = (mesh.frame.middle_mm / 100.0).as_vec3();
        assert!(place(1, middle).length() < 1e-6);
        let side = (mesh.frame.mm_per_unit / 100.0) as f32;
        assert!(place(1, middle + side * Vec3::X).distance(Vec3::X) < 1e-6);
    }
}
