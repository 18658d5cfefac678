//! What fills the bodies of a mesh, asked on the processor: for the command line and tests.

use glam::Vec3;

use crate::data::{Subject, Surface};
use crate::document::{BodyKind, Look, SurfaceLook};

/// What fills a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Filling {
    /// The segment: an index into the surface's.
    pub segment: usize,
    /// Depth under the segment's own triangles, subject units.
    pub depth: f32,
    /// Name of the layer there, or else of the segment.
    pub name: String,
}

/// The bodies of a mesh as a document has them.
#[derive(Clone, Debug)]
pub struct Fillings<'a> {
    surface: &'a Surface,
    names: Vec<String>,
    looks: Vec<SurfaceLook>,
}

/// What a body is, once `auto` is decided.
pub(crate) fn body_of(body: BodyKind, is_closed: bool, is_beside_volume: bool) -> BodyKind {
    match body {
        BodyKind::Auto if is_closed && !is_beside_volume => BodyKind::Solid,
        BodyKind::Auto => BodyKind::Hollow,
        other => other,
    }
}

impl<'a> Fillings<'a> {
    /// The bodies of the meshes of a subject, alone or beside its volume; `None` if it has none.
    pub fn of(subject: &'a Subject, look: &Look) -> Option<Self> {
        let (surface, segments) = (subject.surface()?, subject.mesh_segments());
        let is_beside_volume = subject.values().is_some();
        let looks = segments.iter().zip(1..).map(|(segment, number)| {
            let number = (!is_beside_volume).then_some(number);
            let mut own = look.of_mesh_segment(&segment.name, number).surface;
            own.body = body_of(own.body, segment.is_closed, is_beside_volume);
            own
        });
        let looks = looks.collect();
        Some(Self {
            surface,
            names: segments.into_iter().map(|segment| segment.name).collect(),
            looks,
        })
    }

    /// What a segment is called in this subject.
    pub fn segment_name(&self, segment: usize) -> &str {
        &self.names[segment]
    }

    /// What fills a place of rest space: of several segments the first (spec/surfaces.md, `filled_k`). `None` where
    /// nothing does.
    pub fn at(&self, place: Vec3) -> Option<Filling> {
        let inside = self.surface.inside_of(place);
        let segments = self.looks.iter().enumerate();
        let fills = |(segment, look): (usize, &SurfaceLook)| {
            if inside >> segment & 1 == 0 || look.body == BodyKind::Hollow {
                return None;
            }
            let depth = self.surface.distance_to(segment, place);
            let is_filled = look.body == BodyKind::Solid || depth <= look.thickness;
            is_filled.then(|| Filling {
                segment,
                depth,
                name: self.name_of(segment, depth),
            })
        };
        segments.filter_map(fills).next()
    }

    /// Name of the layer of a segment at a place of rest space, or else of the segment.
    pub fn name_at(&self, segment: usize, place: Vec3) -> String {
        self.name_of(segment, self.surface.distance_to(segment, place))
    }

    /// Name of the layer at a depth in a segment, or else of the segment.
    fn name_of(&self, segment: usize, depth: f32) -> String {
        let layers = self.looks[segment].layers.iter();
        let layer = layers.take_while(|layer| layer.depth <= depth).last();
        let named = layer.filter(|layer| !layer.name.is_empty());
        named.map_or_else(|| self.names[segment].clone(), |layer| layer.name.clone())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::data::mesh::testing::cube;
    use crate::data::{Mesh, MeshPart};
    use crate::document::Document;

    /// Boxes of these half sides around the origin, a segment each.
    fn boxes(halves: &[f32]) -> Surface {
        let (corners, triangles) = cube();
        let mut mesh = Mesh::default();
        for (&half, k) in halves.iter().zip(0_u32..) {
            let corners = corners.iter().map(|corner| half * (2.0 * *corner - 1.0));
            mesh.positions.extend(corners);
            let at = mesh.triangles.len();
            let own = triangles.iter().map(|t| t.map(|i| 8 * k + i));
            mesh.triangles.extend(own);
            mesh.parts.push(MeshPart {
                name: format!("box {k}"),
                triangles: at..mesh.triangles.len(),
            });
        }
        Surface::new(&mesh, None, &mut |_| true).expect("a surface")
    }

    fn look(json: &str) -> Look {
        let text =
            format!(r#"{{"fabrica":1,"subject":{{"meshes":[{{"src":"a.stl"}}]}},"look":{json}}}"#);
        let document = Document::from_json(&text).expect("a good document");
        document.illustration().look.clone()
    }

    #[test]
    fn the_first_segment_that_is_filled_decides() {
        // The inner box is half as large as the outer one, whose sides are 1 unit long.
        let surface = boxes(&[5.0, 10.0]);
        let look = look(
            r#"{"body":"solid","layers":[{"depth":0.05,"name":"flesh"},{"depth":0.1}],
                "segments":{"box 0":{"body":"hollow"}}}"#,
        );
        let subject = Subject::from(Arc::new(surface));
        let fillings = Fillings::of(&subject, &look).expect("it has meshes");
        let at = |x: f32| {
            fillings
                .at(Vec3::new(x, 0.0, 0.0))
                .map(|f| (f.segment, f.name))
        };
        assert_eq!(at(0.49), Some((1, "box 1".to_owned())));
        assert_eq!(at(0.43), Some((1, "flesh".to_owned())));
        assert_eq!(
            at(0.1),
            Some((1, "box 1".to_owned())),
            "a layer without a name"
        );
        assert_eq!(at(0.51), None);
        let depth = fillings.at(Vec3::ZERO).expect("filled").depth;
        assert!((depth - 0.5).abs() < 1e-5, "by its own triangles: {depth}");
        assert!(
            (fillings.surface.depth_at(Vec3::ZERO) - 0.5).abs() < 1e-5,
            "the greatest"
        );
        assert!((fillings.surface.depth_at(Vec3::X) + 0.5).abs() < 1e-5);
    }

    #[test]
    fn shells_are_filled_near_their_surface() {
        let subject = Subject::from(Arc::new(boxes(&[10.0])));
        let look = look(r#"{"body":"thick","thickness":0.1}"#);
        let fillings = Fillings::of(&subject, &look).expect("it has meshes");
        let is_filled = |x: f32| fillings.at(Vec3::new(x, 0.0, 0.0)).is_some();
        assert_eq!(
            [0.51, 0.41, 0.39, 0.0].map(is_filled),
            [false, true, false, false]
        );
    }
}
