//! A mesh of triangles that splits, collapses and flips its edges: what a clay is made of (spec/sweepers.md, B.2).
//!
//! Flat arrays with indices of 32 bits; what is taken away leaves its place free for what comes next, so that indices
//! stay. Half-edge 3t + k runs from corner k of triangle t to the next corner.

use glam::{DVec3, Vec3};

use super::roomy::Roomy;

/// Stands for an index where there is none.
pub(super) const NONE: u32 = u32::MAX;

/// Where a vertex lies, and the normal of the surface there.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::NoUninit)]
#[repr(C)]
pub(super) struct Vertex {
    pub(super) pos: Vec3,
    /// Unit length.
    pub(super) normal: Vec3,
}

impl Vertex {
    /// Rounded to the floats in which it is kept.
    pub(super) fn new(pos: DVec3, normal: DVec3) -> Self {
        Self {
            pos: pos.as_vec3(),
            normal: normal.as_vec3(),
        }
    }

    pub(super) fn pos(&self) -> DVec3 {
        self.pos.as_dvec3()
    }

    pub(super) fn normal(&self) -> DVec3 {
        self.normal.as_dvec3()
    }
}

/// Triangles with their neighbours. Every edge has one triangle or two, which run through it in opposite directions.
#[derive(Clone, Debug, Default)]
pub(super) struct ClayMesh {
    /// Places and normals before the step that is being done.
    pub(super) vertices: Roomy<Vertex>,
    /// A half-edge that leaves the vertex, of a border vertex the one along the border; [`NONE`]: the place is free.
    pub(super) leaving: Roomy<u32>,
    /// Vertices of a triangle, counter-clockwise seen from outside; [`NONE`] first: the place is free.
    pub(super) triangles: Roomy<[u32; 3]>,
    /// The other half-edge of each half-edge; [`NONE`] at a border.
    pub(super) twins: Roomy<[u32; 3]>,
    pub(super) free_vertices: Roomy<u32>,
    pub(super) free_triangles: Roomy<u32>,
}

/// The half-edge that follows in a triangle.
pub(super) fn next(half: u32) -> u32 {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

fn previous(half: u32) -> u32 {
    if half.is_multiple_of(3) {
        half + 2
    } else {
        half - 1
    }
}

impl ClayMesh {
    /// A mesh of triangles; `None` if an edge has more than two triangles or two in the same direction, or a vertex has
    /// several fans.
    pub(super) fn new(mut vertices: Vec<Vertex>, mut triangles: Vec<[u32; 3]>) -> Option<Self> {
        let count = vertices.len();
        vertices.shrink_to_fit();
        triangles.shrink_to_fit();
        let mut mesh = Self::unjoined(vertices, triangles);
        // Half-edges by their ends, the lower one first: twins are then beside each other.
        let mut halves: Vec<(u32, u32, u32)> = Vec::with_capacity(3 * mesh.triangles.len());
        for half in 0..3 * mesh.triangles.len() as u32 {
            let (from, to) = (mesh.from(half), mesh.to(half));
            if from == to || from as usize >= count {
                return None;
            }
            halves.push((from.min(to), from.max(to), half));
        }
        halves.sort_unstable();
        for edge in halves.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            match edge {
                [_] => {}
                [one, two] if mesh.from(one.2) != mesh.from(two.2) => mesh.join(one.2, two.2),
                _ => return None,
            }
        }
        mesh.with_fans()
    }

    /// A mesh whose half-edges are joined already, `twins` as the field: several edges may have the same two ends.
    /// `None` if a vertex has several fans.
    pub(super) fn joined(
        vertices: Vec<Vertex>,
        triangles: Vec<[u32; 3]>,
        twins: Vec<[u32; 3]>,
    ) -> Option<Self> {
        let mut mesh = Self::unjoined(vertices, triangles);
        mesh.twins = twins.into();
        mesh.with_fans()
    }

    fn unjoined(vertices: Vec<Vertex>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            leaving: vec![NONE; vertices.len()].into(),
            vertices: vertices.into(),
            twins: vec![[NONE; 3]; triangles.len()].into(),
            triangles: triangles.into(),
            free_vertices: Roomy::default(),
            free_triangles: Roomy::default(),
        }
    }

    /// Finds a half-edge that leaves each vertex.
    fn with_fans(mut self) -> Option<Self> {
        let mut corners = vec![0_u32; self.vertices.len()];
        for half in 0..3 * self.triangles.len() as u32 {
            let vertex = self.from(half);
            corners[vertex as usize] += 1;
            self.leaving[vertex as usize] = half;
        }
        for vertex in 0..self.vertices.len() as u32 {
            if corners[vertex as usize] > 0 {
                self.turn_to_border(vertex);
                if self.fan(vertex).count() != corners[vertex as usize] as usize {
                    return None;
                }
            } else {
                self.free_vertices.push(vertex);
            }
        }
        Some(self)
    }

    /// Half-edges of edges that have to be split before edges can be told by their ends: all but one of those that have
    /// both ends in common; where there are none, those between two triangles with the same corners. None is in a
    /// triangle of another of them, so that all can be split.
    pub(super) fn doubled(&self) -> Vec<u32> {
        let halves = 0..3 * self.triangle_places();
        let is_first = |half: &u32| {
            let is_there = self.triangle(half / 3).is_some();
            is_there && self.twin(*half).is_none_or(|twin| *half < twin)
        };
        let ends = |half: u32| {
            let (from, to) = (self.from(half), self.to(half));
            (from.min(to), from.max(to), half)
        };
        let mut edges: Vec<(u32, u32, u32)> = halves.filter(is_first).map(ends).collect();
        edges.sort_unstable();
        let by_ends = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        let doubled = self.apart(by_ends.flat_map(|edge| &edge[1..]).map(|edge| edge.2));
        if !doubled.is_empty() {
            return doubled;
        }
        // Split earlier, these would leave two triangles with the same corners again.
        let is_back_to_back = |half: &u32| {
            let twin = self.twin(*half);
            twin.is_some_and(|twin| self.across(*half) == self.across(twin))
        };
        self.apart(edges.iter().map(|edge| edge.2).filter(is_back_to_back))
    }

    /// Those of some edges that have no triangle in common with one before.
    fn apart(&self, halves: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut is_used = vec![false; self.triangles.len()];
        let mut apart = Vec::new();
        for half in halves {
            let sides = || [Some(half), self.twin(half)].into_iter().flatten();
            if sides().all(|side| !is_used[(side / 3) as usize]) {
                sides().for_each(|side| is_used[(side / 3) as usize] = true);
                apart.push(half);
            }
        }
        apart
    }

    pub(super) fn from(&self, half: u32) -> u32 {
        self.triangles.as_flattened()[half as usize]
    }

    pub(super) fn to(&self, half: u32) -> u32 {
        self.from(next(half))
    }

    /// The vertex across the triangle of a half-edge.
    pub(super) fn across(&self, half: u32) -> u32 {
        self.from(previous(half))
    }

    /// The half-edge of the neighbour, if there is one.
    pub(super) fn twin(&self, half: u32) -> Option<u32> {
        let twin = self.twins.as_flattened()[half as usize];
        (twin != NONE).then_some(twin)
    }

    fn set_twin(&mut self, half: u32, twin: u32) {
        self.twins.as_flattened_mut()[half as usize] = twin;
    }

    fn join(&mut self, one: u32, two: u32) {
        if one != NONE {
            self.set_twin(one, two);
        }
        if two != NONE {
            self.set_twin(two, one);
        }
    }

    /// Number of places for triangles, free ones too.
    pub(super) fn triangle_places(&self) -> u32 {
        self.triangles.len() as u32
    }

    /// Number of places for vertices, free ones too.
    pub(super) fn vertex_places(&self) -> u32 {
        self.vertices.len() as u32
    }

    /// Number of triangles.
    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.len() - self.free_triangles.len()
    }

    /// Number of vertices.
    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.len() - self.free_vertices.len()
    }

    /// Bytes that the mesh has taken, by the room in its lists.
    pub(super) fn bytes(&self) -> usize {
        self.vertices.taken()
            + self.leaving.taken()
            + self.triangles.taken()
            + self.twins.taken()
            + self.free_vertices.taken()
            + self.free_triangles.taken()
    }

    /// The vertices of a triangle; `None` if its place is free.
    pub(super) fn triangle(&self, index: u32) -> Option<[u32; 3]> {
        let corners = self.triangles[index as usize];
        (corners[0] != NONE).then_some(corners)
    }

    pub(super) fn is_vertex(&self, vertex: u32) -> bool {
        self.leaving[vertex as usize] != NONE
    }

    /// The half-edges that leave a vertex, counter-clockwise; of a border vertex all but the last edge.
    pub(super) fn fan(&self, vertex: u32) -> Fan<'_> {
        let first = self.leaving[vertex as usize];
        Fan {
            mesh: self,
            first,
            half: first,
        }
    }

    /// Number of edges that have one triangle alone.
    pub(super) fn border_count(&self) -> usize {
        let live = self.triangles.iter().zip(self.twins.iter());
        let live = live.filter(|(corners, _)| corners[0] != NONE);
        live.flat_map(|(_, twins)| twins)
            .filter(|twin| **twin == NONE)
            .count()
    }

    /// True if an edge at the vertex has one triangle alone.
    pub(super) fn is_border(&self, vertex: u32) -> bool {
        self.twin(self.leaving[vertex as usize]).is_none()
    }

    /// The half-edge from one vertex to another, if a triangle has it. It is looked for at both at once, so that one
    /// with very many triangles, as files have them, costs no more than the other.
    pub(super) fn half(&self, from: u32, to: u32) -> Option<u32> {
        let (mut leaving, mut coming) = (self.fan(from), self.fan(to));
        loop {
            let half = leaving.next()?;
            if self.to(half) == to {
                return Some(half);
            }
            let half = coming.next()?;
            if self.across(half) == from {
                return Some(previous(half));
            }
        }
    }

    /// Two vertices, the one with fewer triangles first.
    fn smaller_first(&self, [a, b]: [u32; 2]) -> [u32; 2] {
        let (mut of_a, mut of_b) = (self.fan(a), self.fan(b));
        loop {
            match (of_a.next(), of_b.next()) {
                (Some(_), None) => return [b, a],
                (Some(_), Some(_)) => {}
                (None, _) => return [a, b],
            }
        }
    }

    /// The neighbours of a vertex that are not at a border, each once.
    pub(super) fn ring(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.fan(vertex).map(|half| self.to(half))
    }

    /// Those of some vertices that lie at a border. What is done to triangles around any other need not look for its
    /// border, through all of its triangles.
    fn at_border<const N: usize>(&self, vertices: [u32; N]) -> [Option<u32>; N] {
        vertices.map(|vertex| self.is_border(vertex).then_some(vertex))
    }

    /// Lets the half-edge that a border vertex keeps be the one along the border.
    fn turn_to_border(&mut self, vertex: u32) {
        let first = self.leaving[vertex as usize];
        let mut half = first;
        while let Some(twin) = self.twin(half) {
            half = next(twin);
            if half == first {
                return;
            }
        }
        self.leaving[vertex as usize] = half;
    }

    fn new_triangle(&mut self) -> u32 {
        self.free_triangles.pop().unwrap_or_else(|| {
            let places = self.triangles.len();
            self.triangles.lengthen(places + 1, [NONE; 3]);
            self.twins.lengthen(places + 1, [NONE; 3]);
            places as u32
        })
    }

    fn new_vertex(&mut self, vertex: Vertex) -> u32 {
        if let Some(index) = self.free_vertices.pop() {
            self.vertices[index as usize] = vertex;
            return index;
        }
        let places = self.vertices.len();
        self.vertices.lengthen(places + 1, vertex);
        self.leaving.lengthen(places + 1, NONE);
        places as u32
    }

    /// Puts a triangle into a place, with the half-edges beyond its edges.
    fn put(&mut self, index: u32, corners: [u32; 3], twins: [u32; 3]) {
        self.triangles[index as usize] = corners;
        for k in 0..3 {
            self.join(3 * index + k, twins[k as usize]);
            self.leaving[corners[k as usize] as usize] = 3 * index + k;
        }
    }

    fn twin_or_none(&self, half: u32) -> u32 {
        self.twin(half).unwrap_or(NONE)
    }

    /// Splits an edge: its new vertex.
    pub(super) fn split(&mut self, half: u32, vertex: Vertex) -> u32 {
        let [a, b, c] = [self.from(half), self.to(half), self.across(half)];
        let [beyond_b, beyond_c] = [next(half), previous(half)].map(|h| self.twin_or_none(h));
        let other = self.twin(half);
        let d = other.map_or(c, |other| self.across(other));
        let border = self.at_border([a, b, c, d]);
        let m = self.new_vertex(vertex);
        let near = half / 3;
        let far = self.new_triangle();
        self.put(near, [a, m, c], [NONE, NONE, beyond_c]);
        self.put(far, [m, b, c], [NONE, beyond_b, 3 * near + 1]);
        if let Some(other) = other {
            let [beyond_a, beyond_d] = [next(other), previous(other)].map(|h| self.twin_or_none(h));
            let [here, there] = [other / 3, self.new_triangle()];
            self.put(here, [b, m, d], [3 * far, NONE, beyond_d]);
            self.put(there, [m, a, d], [3 * near, beyond_a, 3 * here + 1]);
        }
        let at_border = border.into_iter().flatten();
        for vertex in at_border.chain(other.is_none().then_some(m)) {
            self.turn_to_border(vertex);
        }
        m
    }

    /// True if the ends of an edge may become one vertex and the mesh stays a closed surface of the same kind. Ends at
    /// a border may not.
    pub(super) fn may_collapse(&self, half: u32) -> bool {
        let Some(other) = self.twin(half) else {
            return false;
        };
        let [a, b] = [self.from(half), self.to(half)];
        if self.is_border(a) || self.is_border(b) {
            return false;
        }
        let [c, d] = [self.across(half), self.across(other)];
        let is_poor = |vertex| !self.is_border(vertex) && self.fan(vertex).nth(3).is_none();
        if c == d || is_poor(c) || is_poor(d) {
            return false;
        }
        // A common neighbour beyond the two triangles would become an edge of four.
        let [few, many] = self.smaller_first([a, b]);
        let common = self.ring(few).filter(|v| self.half(many, *v).is_some());
        // Ends with three edges each leave two triangles back to back.
        let edges = |end| self.fan(end).take(7).count();
        common.count() == 2 && edges(a) + edges(b) > 6
    }

    /// Lets the ends of an edge become one vertex, which takes the place of the first; for what [`Self::may_collapse`].
    pub(super) fn collapse(&mut self, half: u32, vertex: Vertex) -> u32 {
        let [a, b] = [self.from(half), self.to(half)];
        let around: Vec<u32> = self.fan(b).collect();
        for leaving in around {
            self.triangles[(leaving / 3) as usize][(leaving % 3) as usize] = a;
        }
        for side in [Some(half), self.twin(half)].into_iter().flatten() {
            let [one, two] = [next(side), previous(side)].map(|h| self.twin_or_none(h));
            let border = self.at_border([self.across(side)]);
            self.triangles[(side / 3) as usize] = [NONE; 3];
            self.free_triangles.push(side / 3);
            self.join(one, two);
            // One of the two is there, as the corner across has more than one triangle.
            for inner in [one, two].into_iter().filter(|h| *h != NONE) {
                let start = self.from(inner);
                self.leaving[start as usize] = inner;
            }
            for c in border.into_iter().flatten() {
                self.turn_to_border(c);
            }
        }
        self.leaving[b as usize] = NONE;
        self.free_vertices.push(b);
        self.vertices[a as usize] = vertex;
        a
    }

    /// Turns an inner edge to join the vertices across: the new half-edge, or `None` if the mesh would break.
    pub(super) fn flip(&mut self, half: u32) -> Option<u32> {
        let other = self.twin(half)?;
        let [a, b] = [self.from(half), self.to(half)];
        let [c, d] = [self.across(half), self.across(other)];
        let is_poor = |vertex| !self.is_border(vertex) && self.fan(vertex).nth(3).is_none();
        if c == d
            || is_poor(a)
            || is_poor(b)
            || self.half(c, d).is_some()
            || self.half(d, c).is_some()
        {
            return None;
        }
        let [beyond_bc, beyond_ca] = [next(half), previous(half)].map(|h| self.twin_or_none(h));
        let [beyond_ad, beyond_db] = [next(other), previous(other)].map(|h| self.twin_or_none(h));
        let [one, two] = [half / 3, other / 3];
        let border = self.at_border([a, b, c, d]);
        self.put(one, [c, d, b], [NONE, beyond_db, beyond_bc]);
        self.put(two, [d, c, a], [3 * one, beyond_ca, beyond_ad]);
        for vertex in border.into_iter().flatten() {
            self.turn_to_border(vertex);
        }
        Some(3 * one)
    }

    /// Vertices and triangles without free places, in their order, and the old index of each vertex.
    pub(super) fn compact(&self) -> (Vec<Vertex>, Vec<[u32; 3]>, Vec<u32>) {
        let mut new_of = vec![NONE; self.vertices.len()];
        let mut kept = Vec::new();
        for vertex in (0..self.vertex_places()).filter(|v| self.is_vertex(*v)) {
            new_of[vertex as usize] = kept.len() as u32;
            kept.push(vertex);
        }
        let live = self.triangles.iter().filter(|corners| corners[0] != NONE);
        let triangles = live
            .map(|corners| corners.map(|v| new_of[v as usize]))
            .collect();
        let vertices = kept.iter().map(|v| self.vertices[*v as usize]).collect();
        (vertices, triangles, kept)
    }
}

/// The half-edges that leave a vertex.
pub(super) struct Fan<'a> {
    mesh: &'a ClayMesh,
    first: u32,
    half: u32,
}

impl Iterator for Fan<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.half == NONE {
            return None;
        }
        let half = self.half;
        let twin = self.mesh.twin(previous(half));
        self.half = twin.filter(|twin| *twin != self.first).unwrap_or(NONE);
        Some(half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f32, y: f32, z: f32) -> Vertex {
        Vertex {
            pos: Vec3::new(x, y, z),
            normal: Vec3::Z,
        }
    }

    fn octahedron() -> ClayMesh {
        let vertices = vec![
            vertex(1.0, 0.0, 0.0),
            vertex(-1.0, 0.0, 0.0),
            vertex(0.0, 1.0, 0.0),
            vertex(0.0, -1.0, 0.0),
            vertex(0.0, 0.0, 1.0),
            vertex(0.0, 0.0, -1.0),
        ];
        let mut triangles = Vec::new();
        for [x, y, z] in [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]] {
            triangles.extend([[x, y, z], [y, x, 5]]);
        }
        ClayMesh::new(vertices, triangles).unwrap()
    }

    /// Every pointer leads back, every fan is whole.
    fn check(mesh: &ClayMesh) {
        let mut corners = 0;
        for index in (0..mesh.triangle_places()).filter(|t| mesh.triangle(*t).is_some()) {
            for half in 3 * index..3 * index + 3 {
                let twin = mesh.twin(half);
                if let Some(twin) = twin {
                    assert_eq!(mesh.twin(twin), Some(half));
                    assert_eq!(mesh.from(twin), mesh.to(half));
                    assert_eq!(mesh.to(twin), mesh.from(half));
                }
                assert!(mesh.fan(mesh.from(half)).any(|other| other == half));
            }
            corners += 3;
        }
        let live = (0..mesh.vertex_places()).filter(|v| mesh.is_vertex(*v));
        assert_eq!(corners, live.map(|v| mesh.fan(v).count()).sum::<usize>());
        let (vertices, triangles, _) = mesh.compact();
        assert!(ClayMesh::new(vertices, triangles).is_some());
    }

    #[test]
    fn edges_split_collapse_and_flip_at_random() {
        let mut mesh = octahedron();
        let mut state = 7_u32;
        let mut draw = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % below
        };
        let mut done = [0; 3];
        for _ in 0..3000 {
            let half = draw(3 * mesh.triangle_places());
            if mesh.triangle(half / 3).is_none() {
                continue;
            }
            let new = vertex(draw(100) as f32, draw(100) as f32, draw(100) as f32);
            match draw(3) {
                0 if mesh.triangle_count() < 200 => {
                    mesh.split(half, new);
                    done[0] += 1;
                }
                1 if mesh.may_collapse(half) => {
                    mesh.collapse(half, new);
                    done[1] += 1;
                }
                _ => done[2] += usize::from(mesh.flip(half).is_some()),
            }
            check(&mesh);
            let (vertices, triangles, _) = mesh.compact();
            // Euler's number stays that of a ball.
            assert_eq!(vertices.len() * 2, triangles.len() + 4);
        }
        assert!(done.iter().all(|count| *count > 100), "{done:?}");
    }

    #[test]
    fn a_border_splits_and_never_collapses() {
        let corners = vec![
            vertex(0.0, 0.0, 0.0),
            vertex(1.0, 0.0, 0.0),
            vertex(0.0, 1.0, 0.0),
        ];
        let mut mesh = ClayMesh::new(corners, vec![[0, 1, 2]]).unwrap();
        for i in 0..40 {
            let half = (i * 7) % (3 * mesh.triangle_places());
            mesh.split(half, vertex(0.1, 0.1, 0.0));
            check(&mesh);
        }
        for half in 0..3 * mesh.triangle_places() {
            let ends = [mesh.from(half), mesh.to(half)];
            if ends.iter().any(|v| mesh.is_border(*v)) {
                assert!(!mesh.may_collapse(half));
            }
        }
    }

    #[test]
    fn what_is_no_surface_is_refused() {
        let vertices = vec![vertex(0.0, 0.0, 0.0); 5];
        let of = |triangles: &[[u32; 3]]| ClayMesh::new(vertices.clone(), triangles.to_vec());
        assert!(of(&[[0, 1, 2], [0, 1, 3]]).is_none(), "same direction");
        assert!(of(&[[0, 1, 2], [1, 0, 3], [1, 0, 4]]).is_none(), "three");
        assert!(of(&[[0, 1, 2], [0, 3, 4]]).is_none(), "two fans");
        assert!(of(&[[0, 0, 2]]).is_none());
        assert!(of(&[[0, 1, 9]]).is_none());
    }
}
