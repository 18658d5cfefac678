//! How the triangles of a mesh hang together, by their indices alone.

/// How triangles hang together.
pub(super) struct Joints {
    pub(super) loose_vertices: usize,
    pub(super) pieces: usize,
    /// Each edge once, the smaller index first, in order.
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) border_edges: usize,
    pub(super) bad_edges: usize,
    pub(super) vertices_of_several_fans: usize,
    /// Every edge has as many triangles one way as the other.
    pub(super) is_closed: bool,
}

impl Joints {
    /// Of triangles whose corners differ and are in range.
    pub(super) fn of(vertex_count: usize, triangles: &[[u32; 3]]) -> Self {
        // A side is its two ends, smaller first, whether it runs from the smaller, and the number of its first corner.
        let mut sides: Vec<([u32; 2], bool, usize)> = Vec::with_capacity(3 * triangles.len());
        for (triangle, corners) in triangles.iter().enumerate() {
            for side in 0..3 {
                let [a, b] = [corners[side], corners[(side + 1) % 3]];
                sides.push(([a.min(b), a.max(b)], a < b, 3 * triangle + side));
            }
        }
        sides.sort_unstable();
        let mut found = Self {
            loose_vertices: 0,
            pieces: 0,
            edges: Vec::with_capacity(sides.len() / 2),
            border_edges: 0,
            bad_edges: 0,
            vertices_of_several_fans: 0,
            is_closed: true,
        };
        // Corners of triangles are one where their triangles share an edge: what is one is a fan.
        let mut fans = Sets::new(sides.len());
        let mut pieces = Sets::new(vertex_count);
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            let (edge, _, first) = group[0];
            found.edges.push(edge);
            pieces.join(edge[0] as usize, edge[1] as usize);
            let forward = group
                .iter()
                .filter(|(_, is_forward, _)| *is_forward)
                .count();
            match [group.len(), forward] {
                [1, _] => found.border_edges += 1,
                [2, 1] => {}
                _ => found.bad_edges += 1,
            }
            found.is_closed &= 2 * forward == group.len();
            for &(_, is_forward, side) in &group[1..] {
                // The corners at the smaller and at the larger end, of the first and of this one.
                let ends = |side: usize, is_forward: bool| {
                    let next = side / 3 * 3 + (side + 1) % 3;
                    if is_forward {
                        [side, next]
                    } else {
                        [next, side]
                    }
                };
                let [a, b] = [ends(first, group[0].1), ends(side, is_forward)];
                fans.join(a[0], b[0]);
                fans.join(a[1], b[1]);
            }
        }
        let mut fans_at = vec![0u32; vertex_count];
        for (corner, &vertex) in triangles.as_flattened().iter().enumerate() {
            fans_at[vertex as usize] += u32::from(fans.root(corner) == corner);
        }
        for (vertex, &count) in fans_at.iter().enumerate() {
            found.loose_vertices += usize::from(count == 0);
            found.vertices_of_several_fans += usize::from(count > 1);
            found.pieces += usize::from(count > 0 && pieces.root(vertex) == vertex);
        }
        found
    }
}

/// Numbers that are put together into sets; each set goes by its smallest number.
struct Sets(Vec<usize>);

impl Sets {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            // Every second link is shortened on the way, which keeps the ways short.
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    fn join(&mut self, a: usize, b: usize) {
        let [a, b] = [self.root(a), self.root(b)];
        self.0[a.max(b)] = a.min(b);
    }
}
