//! What `fabrica clay --check` says of a mesh: its make-up, its edges, where it meets itself, and its hash.

mod crossing;
mod joints;
#[cfg(test)]
mod testing;

use glam::Vec3;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use super::shaping::Shaped;
use crossing::{Face, crossing};
use joints::Joints;

pub use crossing::MAX_CROSSING;

/// An edge is short if it is shorter than this part of the detail: no stroke is to leave one (spec/sweepers.md, B.1),
/// but where its collapse would break the mesh.
const SHORT: f64 = 16.0;

/// A mesh in numbers. Made once per command, in a few seconds for 300,000 triangles.
///
/// Lengths are in the unit of the positions that were given (subject units), volumes in its cube. The words *edge*,
/// *piece* and *fan* go by indices: two vertices at one place are two.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// All triangles, broken ones too.
    pub triangles: usize,
    /// All vertices, loose ones too.
    pub vertices: usize,
    /// Vertices that no triangle has.
    pub loose_vertices: usize,
    /// Triangles with an index out of range, with a corner twice (these two are left out of all that follows), or with
    /// a coordinate that is not finite.
    pub broken_triangles: usize,
    /// Triangles of exactly no area: their corners lie on a line. They are left out of `crossing`, since what their
    /// edges meet is met by the triangles on the other sides of these edges.
    pub flat_triangles: usize,
    /// Parts that hang together over vertices.
    pub pieces: usize,
    /// Vertices less edges and more triangles, all without the loose: 2 for a ball, 0 for a torus.
    pub euler: i64,
    /// Edges of one triangle.
    pub border_edges: usize,
    /// Edges of more than two triangles, and edges that two run through in the same direction.
    pub bad_edges: usize,
    /// Vertices whose triangles do not hang together over the edges at the vertex (the middle of a bow-tie).
    pub vertices_of_several_fans: usize,
    /// True if `longest_edge` and `shortest_edge` are of the edges with an end that the last stroke moved.
    pub is_of_stroke: bool,
    /// The longest of these edges; `None` if there is none.
    pub longest_edge: Option<f64>,
    /// The shortest of these edges; `None` if there is none.
    pub shortest_edge: Option<f64>,
    /// How many of these edges are shorter than a sixteenth of the stroke's detail; `None` if no stroke was told.
    pub short_edges: Option<usize>,
    /// The smallest angle of all triangles, degrees, 0 … 60; `None` if there is no triangle.
    pub smallest_angle_deg: Option<f64>,
    /// Pairs of triangles that meet, be it in a point; neighbours only where they meet elsewhere than in the vertex or
    /// the edge that they share. Triangles of the same three corners count. At most [`MAX_CROSSING`].
    pub crossing: usize,
    /// The volume that is enclosed, below 0 if the mesh is inside out. `None` if an edge has not as many triangles one
    /// way as the other: there is no inside then.
    pub volume: Option<f64>,
    /// [`mesh_sha256`] of what was given.
    pub sha256: String,
}

/// What the last stroke of a clay did.
#[derive(Clone, Copy, Debug)]
pub struct LastStroke<'a> {
    /// For each vertex whether it moved.
    pub moved: &'a [bool],
    /// The longest that an edge may be, in the unit of the positions.
    pub detail: f64,
}

impl Check {
    /// Looks at a clay and what its last stroke did.
    pub fn of_clay(shaped: &Shaped) -> Self {
        let stroke = LastStroke {
            moved: &shaped.touched,
            detail: shaped.detail,
        };
        Self::of(&shaped.positions, &shaped.triangles, Some(stroke))
    }

    /// Looks at a mesh. Without a last stroke all edges are measured.
    pub fn of(positions: &[Vec3], triangles: &[[u32; 3]], stroke: Option<LastStroke<'_>>) -> Self {
        let is_whole = |triangle: &&[u32; 3]| {
            let [a, b, c] = **triangle;
            let is_in_range = triangle.iter().all(|&i| (i as usize) < positions.len());
            is_in_range && a != b && b != c && c != a
        };
        let whole: Vec<[u32; 3]> = triangles.iter().filter(is_whole).copied().collect();
        let mut faces: Vec<Face> = Vec::with_capacity(whole.len());
        for &corners in &whole {
            let at = corners.map(|i| positions[i as usize]);
            if at.iter().all(|p| p.is_finite()) {
                faces.push(Face::new(corners, at));
            }
        }
        let broken_triangles = triangles.len() - faces.len();
        let smallest = faces.iter().map(Face::smallest_angle).reduce(f64::min);
        // The sum of nothing is −0.
        let six_volumes = 0.0 + faces.iter().map(Face::six_volumes).sum::<f64>();
        let all_faces = faces.len();
        faces.retain(|face| !face.is_flat());

        let joints = Joints::of(positions.len(), &whole);
        let mut lengths: Option<[f64; 2]> = None;
        let mut short_edges = 0;
        let least = stroke.map_or(0.0, |stroke| stroke.detail / SHORT);
        let is_moved =
            |i: u32| stroke.is_none_or(|stroke| stroke.moved.get(i as usize) == Some(&true));
        for &[a, b] in &joints.edges {
            let length =
                (positions[a as usize].as_dvec3() - positions[b as usize].as_dvec3()).length();
            if (is_moved(a) || is_moved(b)) && length.is_finite() {
                let [shortest, longest] = lengths.unwrap_or([length; 2]);
                lengths = Some([shortest.min(length), longest.max(length)]);
                short_edges += usize::from(length < least);
            }
        }
        Self {
            triangles: triangles.len(),
            vertices: positions.len(),
            loose_vertices: joints.loose_vertices,
            broken_triangles,
            flat_triangles: all_faces - faces.len(),
            pieces: joints.pieces,
            euler: (positions.len() - joints.loose_vertices + whole.len()) as i64
                - joints.edges.len() as i64,
            border_edges: joints.border_edges,
            bad_edges: joints.bad_edges,
            vertices_of_several_fans: joints.vertices_of_several_fans,
            is_of_stroke: stroke.is_some(),
            longest_edge: lengths.map(|[_, longest]| longest),
            shortest_edge: lengths.map(|[shortest, _]| shortest),
            short_edges: stroke.map(|_| short_edges),
            smallest_angle_deg: smallest.map(f64::to_degrees),
            crossing: crossing(&faces),
            volume: (joints.is_closed && all_faces == whole.len()).then_some(six_volumes / 6.0),
            sha256: mesh_sha256(positions, triangles),
        }
    }

    /// True if every edge has one triangle or two that go through it in opposite directions, and every vertex has one
    /// fan. Such a mesh without `border_edges` is closed.
    pub fn is_two_manifold(&self) -> bool {
        self.bad_edges == 0 && self.vertices_of_several_fans == 0 && self.broken_triangles == 0
    }

    /// All of it under the names of the fields; what there is none of is `null`.
    pub fn to_json(&self) -> Value {
        json!({
            "triangles": self.triangles, "vertices": self.vertices, "loose_vertices": self.loose_vertices,
            "broken_triangles": self.broken_triangles, "flat_triangles": self.flat_triangles, "pieces": self.pieces,
            "euler": self.euler, "border_edges": self.border_edges, "bad_edges": self.bad_edges,
            "vertices_of_several_fans": self.vertices_of_several_fans, "is_of_stroke": self.is_of_stroke,
            "longest_edge": self.longest_edge, "shortest_edge": self.shortest_edge,
            "short_edges": self.short_edges, "smallest_angle_deg": self.smallest_angle_deg, "crossing": self.crossing, "volume": self.volume,
            "sha256": self.sha256,
        })
    }

    /// One fact per line, in words. What is nowhere but in bad meshes (loose vertices, broken and flat triangles) is
    /// left out where there is none.
    pub fn lines(&self) -> String {
        let number = |x: Option<f64>| x.map_or_else(|| "none".to_owned(), |x| format!("{x:.6}"));
        let reach = if self.is_of_stroke {
            " in reach of the last stroke"
        } else {
            ""
        };
        let or_more = if self.crossing == MAX_CROSSING {
            " or more"
        } else {
            ""
        };
        let volume = self.volume.map_or_else(
            || "none: it is not closed".to_owned(),
            |x| format!("{x:.6}"),
        );
        let mut lines = vec![
            format!("triangles: {}", self.triangles),
            format!("vertices: {}", self.vertices),
            format!("pieces: {}", self.pieces),
            format!("Euler number: {}", self.euler),
            format!("border edges: {}", self.border_edges),
            format!("edges that are not two-manifold: {}", self.bad_edges),
            format!(
                "vertices that are not two-manifold: {}",
                self.vertices_of_several_fans
            ),
            format!("longest edge{reach}: {}", number(self.longest_edge)),
            format!("shortest edge{reach}: {}", number(self.shortest_edge)),
        ];
        let short = self.short_edges;
        lines.extend(short.map(|n| format!("edges shorter than detail/{SHORT}{reach}: {n}")));
        lines.extend([
            format!("smallest angle: {}°", number(self.smallest_angle_deg)),
            format!(
                "pairs of triangles that intersect: {}{or_more}",
                self.crossing
            ),
            format!("volume: {volume}"),
            format!("sha256: {}", self.sha256),
        ]);
        let rare = [
            ("vertices of no triangle", self.loose_vertices),
            ("broken triangles", self.broken_triangles),
            ("triangles of no area", self.flat_triangles),
        ];
        let rare = rare.into_iter().filter(|(_, count)| *count > 0);
        lines.splice(2..2, rare.map(|(what, count)| format!("{what}: {count}")));
        lines.join("\n") + "\n"
    }
}

/// The hash of a mesh, as 64 lower-case hexadecimal digits: SHA-256 of all positions (x, y, z, 32-bit floats), then all
/// indices (32 bits), little-endian.
pub fn mesh_sha256(positions: &[Vec3], triangles: &[[u32; 3]]) -> String {
    let mut hash = Sha256::new();
    for position in positions {
        hash.update(position.to_array().map(f32::to_le_bytes).as_flattened());
    }
    for triangle in triangles {
        hash.update(triangle.map(u32::to_le_bytes).as_flattened());
    }
    hash.finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::testing::*;
    use super::*;

    fn check(positions: &[Vec3], triangles: &[[u32; 3]]) -> Check {
        Check::of(positions, triangles, None)
    }

    #[test]
    fn a_tetrahedron_is_closed() {
        let found = check(&tetrahedron(), &TETRAHEDRON);
        assert_eq!(
            (found.triangles, found.vertices, found.pieces, found.euler),
            (4, 4, 1, 2)
        );
        assert_eq!(
            (found.border_edges, found.bad_edges, found.crossing),
            (0, 0, 0)
        );
        assert!(found.is_two_manifold(), "{found:?}");
        assert_eq!(found.volume, Some(1.0 / 6.0));
        assert_eq!(
            [found.longest_edge, found.shortest_edge],
            [Some(2f64.sqrt()), Some(1.0)]
        );
        let angle = found.smallest_angle_deg.expect("there are triangles");
        assert!((angle - 45.0).abs() < 1e-12, "{angle}");
        // The other way round it is inside out.
        let turned = TETRAHEDRON.map(|[a, b, c]| [a, c, b]);
        assert_eq!(check(&tetrahedron(), &turned).volume, Some(-1.0 / 6.0));
        // One triangle turned over: three edges are gone through twice in one direction.
        let mut one = TETRAHEDRON;
        one[2].swap(0, 1);
        let found = check(&tetrahedron(), &one);
        assert_eq!(
            (found.bad_edges, found.border_edges, found.volume),
            (3, 0, None)
        );
    }

    #[test]
    fn a_torus_has_the_euler_number_0() {
        let (positions, triangles) = torus(48, 24);
        let found = check(&positions, &triangles);
        assert_eq!(
            (
                found.pieces,
                found.euler,
                found.border_edges,
                found.crossing
            ),
            (1, 0, 0, 0)
        );
        assert!(found.is_two_manifold(), "{found:?}");
        let exact = 2.0 * std::f64::consts::PI.powi(2) * 0.35 * 0.15 * 0.15;
        let volume = found.volume.expect("it is closed");
        assert!(
            (volume / exact - 1.0).abs() < 0.02,
            "{volume} is not about {exact}"
        );
    }

    #[test]
    fn pieces_and_loose_vertices_are_counted() {
        let mut positions = tetrahedron();
        positions.push(Vec3::splat(7.0));
        positions.extend(tetrahedron().iter().map(|&p| p + Vec3::splat(2.0)));
        let mut triangles = TETRAHEDRON.to_vec();
        triangles.extend(TETRAHEDRON.map(|triangle| triangle.map(|i| i + 5)));
        let found = check(&positions, &triangles);
        assert_eq!(
            (
                found.pieces,
                found.euler,
                found.vertices,
                found.loose_vertices
            ),
            (2, 4, 9, 1)
        );
        assert!(
            (found.volume.expect("closed") - 1.0 / 3.0).abs() < 1e-12,
            "{found:?}"
        );
        assert!(found.is_two_manifold() && found.crossing == 0, "{found:?}");
    }

    #[test]
    fn an_open_disc_has_a_border() {
        let mut positions = vec![Vec3::ZERO];
        positions.extend((0..6).map(|i| Vec3::new((i as f32).cos(), (i as f32).sin(), 0.0)));
        let triangles: Vec<[u32; 3]> = (1..6).map(|i| [0, i, i + 1]).collect();
        let found = check(&positions, &triangles);
        assert_eq!((found.border_edges, found.euler, found.pieces), (7, 1, 1));
        assert_eq!((found.volume, found.crossing), (None, 0));
        assert!(found.is_two_manifold(), "{found:?}");
        assert!(
            found.lines().contains("volume: none: it is not closed\n"),
            "{}",
            found.lines()
        );
    }

    #[test]
    fn edges_of_three_triangles_and_bow_ties_are_no_manifold() {
        let positions = places([
            [0., 0., 0.],
            [0., 0., 1.],
            [1., 0., 0.],
            [0., 1., 0.],
            [-1., -1., 0.],
        ]);
        let found = check(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!(
            (
                found.bad_edges,
                found.border_edges,
                found.vertices_of_several_fans
            ),
            (1, 6, 0)
        );
        assert!(!found.is_two_manifold() && found.crossing == 0, "{found:?}");

        // Two triangles that share a corner: they touch there and do not cross.
        let bow = places([
            [0., 0., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [-1., 0., 0.],
            [-1., -1., 0.],
        ]);
        let found = check(&bow, &[[0, 1, 2], [0, 3, 4]]);
        assert_eq!(
            (
                found.vertices_of_several_fans,
                found.bad_edges,
                found.pieces
            ),
            (1, 0, 1)
        );
        assert!(!found.is_two_manifold() && found.crossing == 0, "{found:?}");

        // Two closed bodies with one corner in common.
        let mut positions = tetrahedron();
        positions.extend(tetrahedron()[1..].iter().map(|&p| -p));
        let mut triangles = TETRAHEDRON.to_vec();
        triangles
            .extend(TETRAHEDRON.map(|[a, b, c]| [a, c, b].map(|i| if i == 0 { 0 } else { i + 3 })));
        let found = check(&positions, &triangles);
        assert_eq!(
            (
                found.vertices_of_several_fans,
                found.border_edges,
                found.crossing
            ),
            (1, 0, 0)
        );
    }

    #[test]
    fn two_bodies_that_go_through_each_other_cross() {
        let (mut positions, mut triangles) = torus(24, 12);
        let first = positions.len() as u32;
        let (other, more) = torus(24, 12);
        triangles.extend(more.iter().map(|triangle| triangle.map(|i| i + first)));
        // Linked like a chain: through the hole and no further.
        positions.extend(other.iter().map(|p| Vec3::new(p.x + 0.35, p.z, p.y)));
        assert_eq!(check(&positions, &triangles).crossing, 0);
        for position in &mut positions[first as usize..] {
            position.x += 0.1;
        }
        let found = check(&positions, &triangles);
        assert!(found.crossing > 20 && found.is_two_manifold(), "{found:?}");
    }

    #[test]
    fn three_hundred_thousand_triangles_take_no_minute() {
        let (positions, triangles) = torus(500, 300);
        let start = std::time::Instant::now();
        let found = check(&positions, &triangles);
        assert_eq!(
            (found.triangles, found.euler, found.crossing),
            (300_000, 0, 0)
        );
        // It is 0.6 s. Comparing all pairs takes many minutes.
        assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
    }

    #[test]
    fn edges_of_the_last_stroke_are_those_with_a_moved_end() {
        let positions = places([[0., 0., 0.], [1., 0., 0.], [0., 3., 0.], [0., 0., 10.]]);
        let checked = |moved: Option<&[bool]>| {
            let stroke = moved.map(|moved| LastStroke {
                moved,
                detail: 50.0,
            });
            Check::of(&positions, &TETRAHEDRON, stroke)
        };
        let measured = |moved: Option<&[bool]>| {
            let found = checked(moved);
            [found.shortest_edge, found.longest_edge].map(|x| x.map(|x| x * x))
        };
        let about = |found: [Option<f64>; 2], expected: [f64; 2]| {
            let [a, b] = found.map(|x| x.expect("there are edges"));
            assert!(
                (a - expected[0]).abs() < 1e-9 && (b - expected[1]).abs() < 1e-9,
                "{a} {b}"
            );
        };
        about(measured(None), [1.0, 109.0]);
        about(measured(Some(&[true; 4])), [1.0, 109.0]);
        about(measured(Some(&[false, true, false, false])), [1.0, 101.0]);
        about(measured(Some(&[false, false, true])), [9.0, 109.0]);
        assert_eq!(measured(Some(&[false; 4])), [None; 2]);
        // Edges of 1 and 3 are shorter than 50/16, that of √10 is not.
        let short = |moved: Option<&[bool]>| checked(moved).short_edges;
        assert_eq!(short(None), None);
        assert_eq!(short(Some(&[true; 4])), Some(2));
        assert_eq!(short(Some(&[false, false, false, true])), Some(0));
        let text = checked(Some(&[false; 4])).lines();
        assert!(
            text.contains("edges shorter than detail/16 in reach of the last stroke: 0\n"),
            "{text}"
        );
        assert!(
            text.contains("longest edge in reach of the last stroke: none\n"),
            "{text}"
        );
    }

    #[test]
    fn broken_and_flat_triangles_are_counted_and_harm_nothing() {
        let mut positions = tetrahedron();
        positions.extend([
            Vec3::new(0.5, 0.0, 0.0),
            Vec3::NAN,
            Vec3::splat(f32::MAX),
            Vec3::splat(-f32::MAX),
        ]);
        let mut triangles = TETRAHEDRON.to_vec();
        triangles.extend([[0, 1, 8], [1, 1, 2], [u32::MAX; 3]]);
        let found = check(&positions, &triangles);
        assert_eq!(
            (found.broken_triangles, found.euler, found.loose_vertices),
            (3, 2, 4)
        );
        assert!(!found.is_two_manifold(), "{found:?}");
        triangles.truncate(4);
        triangles.extend([[0, 1, 4], [0, 1, 5], [0, 6, 7]]);
        let found = check(&positions, &triangles);
        assert_eq!(
            (found.broken_triangles, found.flat_triangles, found.volume),
            (1, 2, None)
        );
        assert_eq!((found.smallest_angle_deg, found.crossing), (Some(0.0), 0));
        let nothing = check(&[], &[]);
        assert_eq!(
            (nothing.pieces, nothing.euler, nothing.longest_edge),
            (0, 0, None)
        );
        assert_eq!((nothing.smallest_angle_deg, nothing.crossing), (None, 0));
        assert!(
            nothing.lines().contains("volume: 0.000000\n"),
            "{nothing:?}"
        );
    }

    #[test]
    fn the_hash_is_that_of_the_bytes() {
        // python3 -c "import hashlib, struct; print(hashlib.sha256(struct.pack('<12f', 0,0,0, 1,0,0, 0,1,0, 0,0,1)
        //   + struct.pack('<12I', 0,2,1, 0,1,3, 1,2,3, 2,0,3)).hexdigest())"
        let known = "8d3a8124194d41ded4cfecf1cff06f91e2402e2826a304de2bc0808645ff07a8";
        assert_eq!(check(&tetrahedron(), &TETRAHEDRON).sha256, known);
        let mut positions = tetrahedron();
        positions[0].x = -0.0;
        assert_ne!(
            mesh_sha256(&positions, &TETRAHEDRON),
            known,
            "the sign of 0 is a bit too"
        );
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(mesh_sha256(&[], &[]), empty);
    }

    #[test]
    fn more_pairs_than_are_counted_are_said_to_be_more() {
        let mut found = check(&tetrahedron(), &TETRAHEDRON);
        found.crossing = MAX_CROSSING;
        let text = found.lines();
        assert!(text.contains(": 1000000 or more\n"), "{text}");
    }

    #[test]
    fn json_and_text_say_the_same() {
        let found = check(&tetrahedron(), &TETRAHEDRON);
        let json = found.to_json();
        assert_eq!(
            (json["triangles"].as_u64(), json["euler"].as_i64()),
            (Some(4), Some(2))
        );
        assert_eq!(json["longest_edge"].as_f64(), found.longest_edge);
        assert_eq!(json["sha256"].as_str(), Some(&*found.sha256));
        assert!(
            check(&[], &[]).to_json()["longest_edge"].is_null(),
            "no edge"
        );
        let text = found.lines();
        assert_eq!(text.lines().count(), 13, "{text}");
        for fact in [
            "triangles: 4\n",
            "Euler number: 2\n",
            "shortest edge: 1.000000\n",
            "volume: 0.166667\n",
        ] {
            assert!(text.contains(fact), "{fact} is not in {text}");
        }
    }
}
