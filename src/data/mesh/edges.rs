//! The edges of triangles: who shares them, and in which direction each goes along.

/// One side of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The edge: its two vertices, the smaller index first.
    pub(crate) edge: [u32; 2],
    pub(crate) triangle: u32,
    /// True if the triangle goes from the smaller index to the larger.
    pub(crate) is_forward: bool,
}

/// All sides of triangles, those of one edge together.
pub(crate) fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (&[a, b, c], triangle) in triangles.iter().zip(0..) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            sides.push(Side {
                edge: [from.min(to), from.max(to)],
                triangle,
                is_forward: from < to,
            });
        }
    }
    sides.sort_unstable();
    sides
}

/// The sides of each edge.
pub(crate) fn by_edge(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.edge == b.edge)
}

/// Sets that are joined one by one, of the numbers from 0.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The number that stands for the set of this one: the smallest.
    pub(crate) fn find(&mut self, mut index: u32) -> u32 {
        while self.0[index as usize] != index {
            // Half of the way is cut off each time.
            let above = self.0[self.0[index as usize] as usize];
            self.0[index as usize] = above;
            index = above;
        }
        index
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
