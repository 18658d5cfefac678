use glam::DVec2;

/// Cells in a grid for each triangle.
const CELLS_PER_TRIANGLE: f64 = 1.0;
/// Weights of a triangle's corners above minus this count as inside, so that rounding leaves no gap between two.
const MARGIN: f64 = 1e-9;

/// Triangles sorted into the cells of a square grid, to find those that hold a place.
#[derive(Clone, Debug)]
pub struct Grid {
    low: DVec2,
    cell: f64,
    size: [usize; 2],
    /// Where each cell's triangles begin; one more than there are cells.
    starts: Vec<u32>,
    /// The triangles of all cells, in each in their own order.
    triangles: Vec<u32>,
}

impl Grid {
    /// A grid over triangles whose vertices have these places. Places that are no numbers are left out.
    pub fn new(places: &[DVec2], triangles: &[[u32; 3]]) -> Self {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for place in places.iter().filter(|place| place.is_finite()) {
            low = low.min(*place);
            high = high.max(*place);
        }
        if low.x > high.x {
            (low, high) = (DVec2::ZERO, DVec2::ONE);
        }
        let span = (high - low).max(DVec2::splat(1e-9));
        let wanted = (triangles.len() as f64 * CELLS_PER_TRIANGLE).max(1.0);
        // As many cells as wanted, unless the triangles lie along a line.
        let cell = (span.x * span.y / wanted)
            .sqrt()
            .max(span.max_element() / 4096.0);
        let size = [(span.x / cell) as usize + 1, (span.y / cell) as usize + 1];
        let mut grid = Self {
            low,
            cell,
            size,
            starts: vec![0; size[0] * size[1] + 1],
            triangles: Vec::new(),
        };
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| places[vertex as usize]);
        let mut counts = vec![0_u32; size[0] * size[1]];
        for triangle in triangles {
            grid.visit(corners(triangle), |cell| counts[cell] += 1);
        }
        for (cell, count) in counts.iter().enumerate() {
            grid.starts[cell + 1] = grid.starts[cell] + count;
        }
        let mut next = grid.starts.clone();
        let mut sorted = vec![0; grid.starts[counts.len()] as usize];
        for (triangle, index) in triangles.iter().zip(0..) {
            grid.visit(corners(triangle), |cell| {
                sorted[next[cell] as usize] = index;
                next[cell] += 1;
            });
        }
        grid.triangles = sorted;
        grid
    }

    fn index(&self, at: f64, axis: usize) -> usize {
        (((at - self.low[axis]) / self.cell).max(0.0) as usize).min(self.size[axis] - 1)
    }

    /// Calls `visit` with each cell that the box around a triangle meets.
    fn visit(&self, corners: [DVec2; 3], mut visit: impl FnMut(usize)) {
        if corners.iter().any(|corner| !corner.is_finite()) {
            return;
        }
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        for row in self.index(low.y, 1)..=self.index(high.y, 1) {
            for column in self.index(low.x, 0)..=self.index(high.x, 0) {
                visit(row * self.size[0] + column);
            }
        }
    }

    /// All triangles that may hold a place, in their order.
    pub fn candidates(&self, at: DVec2) -> &[u32] {
        if !at.is_finite() {
            return &[];
        }
        let cell = self.index(at.y, 1) * self.size[0] + self.index(at.x, 0);
        &self.triangles[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// The first triangle that holds a place, and the weights of its corners there.
    pub fn first(
        &self,
        at: DVec2,
        corners: impl Fn(usize) -> [DVec2; 3],
    ) -> Option<(usize, [f64; 3])> {
        let weighted = |triangle: &u32| {
            Some((
                *triangle as usize,
                weights(corners(*triangle as usize), at)?,
            ))
        };
        self.candidates(at).iter().find_map(weighted)
    }
}

/// The weights of a triangle's corners at a place in it; none if it lies outside, or the triangle has no area.
pub fn weights([a, b, c]: [DVec2; 3], at: DVec2) -> Option<[f64; 3]> {
    let area = (b - a).perp_dot(c - a);
    let weights = [
        (b - at).perp_dot(c - at) / area,
        (c - at).perp_dot(a - at) / area,
        (a - at).perp_dot(b - at) / area,
    ];
    weights
        .iter()
        .all(|weight| *weight >= -MARGIN)
        .then_some(weights)
}
