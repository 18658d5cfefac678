//! The making of what a template `carve` reads of an object ([`Carver`]).

use std::sync::Arc;

use glam::{UVec3, Vec3};

use super::carver::{CARVER_MARGIN, Carver, CarverLevel, FADED};
use super::triangle::{Nearest, Triangle};
use super::whole::{Surface, SurfaceError};
use super::winding::Winding;

/// Cells along the longest side of an object's box at least.
const LEAST_CELLS: f32 = 128.0;
/// Cells along it at most: thin objects get finer cells, as many as [`MOST_NODES`] allows.
const MOST_CELLS: f32 = 640.0;
/// Nodes of the finest level for which cells are made finer than [`LEAST_CELLS`] asks.
const MOST_NODES: f32 = 1.4e6;
/// The coarsest level reaches so far from the box, as a multiple of its longest side: the smallest object with the
/// widest reach.
const FARTHEST: f32 = 1000.0;
/// No correction of a node is larger, cells: where it would be, the distance has a kink, and a correction rings.
const MOST_CORRECTION: f32 = 0.1;
/// Nodes farther than so many of their cells from the surface take the distance that the next coarser level has there.
/// Of its nodes around such a place none lies on the other side of the surface.
const FAR: f32 = 6.0;
/// Nor do they where the second differences there are larger than this, cells: near an edge of the surface, or near
/// where it is equally far on two sides.
const MOST_BEND: f32 = 0.16;
/// Tissue goes no farther than to this part of the way on which it stays nearest to its own wall.
const PART_OF_WAY: f32 = 0.9;

impl Surface {
    /// This surface, which stands alone, with what a template `carve` reads of it. `go_on` as in [`Surface::new`].
    ///
    /// # Errors
    /// [`SurfaceError::Stopped`].
    pub fn carving(self, go_on: &mut dyn FnMut(f32) -> bool) -> Result<Self, SurfaceError> {
        let carver = Carver::of(&self, go_on).ok_or(SurfaceError::Stopped)?;
        Ok(Self {
            carver: Some(Arc::new(carver)),
            ..self
        })
    }
}

/// The nodes of a level on their way to texels.
struct Nodes {
    count: UVec3,
    cell: f32,
    /// The triangle nearest to each node, and the distance to it, below 0 inside.
    nearest: Vec<(u32, f32)>,
}

impl Carver {
    /// The grids of an object: of a surface alone, in its own space. `go_on` is told how far it is, 0 to 1; false stops
    /// it, and gives `None`.
    fn of(surface: &Surface, go_on: &mut dyn FnMut(f32) -> bool) -> Option<Self> {
        let object = Shape::of(surface);
        let half = surface.frame.bounds.size() * 0.5;
        let cell = 1.0 / cells_along(half);
        let mut levels = Vec::new();
        let mut side = cell;
        loop {
            levels.push(Nodes::new(half, side));
            if (CARVER_MARGIN as f32 - FADED) * side >= FARTHEST {
                break;
            }
            side *= 2.0;
        }
        let total: usize = levels.iter().map(|level| level.nearest.len()).sum();
        let mut done = 0;
        // From the coarsest to the finest: far from the surface a level takes the distances of the one around it.
        for index in (0..levels.len()).rev() {
            let (finer, coarser) = levels.split_at_mut(index + 1);
            let Some(level) = finer.last_mut() else {
                continue;
            };
            let around = coarser.first().map(Around::of);
            let part = level.nearest.len() as f32 / total as f32;
            let before = done as f32 / total as f32;
            let mut told = |of: f32| go_on(0.7 * (before + part * of));
            if !level.measure(&object, around.as_ref(), &mut told) {
                return None;
            }
            done += level.nearest.len();
        }
        let finest = levels.first()?;
        let rooms = finest.rooms(&object, &mut |of| go_on(0.7 + 0.2 * of))?;
        Some(Self::packed(&object, half, cell, &levels, &rooms))
    }

    fn packed(object: &Shape<'_>, half: Vec3, cell: f32, levels: &[Nodes], rooms: &[f32]) -> Self {
        let room = rooms.iter().copied().fold(0.0, f32::max);
        let mut packed = Self {
            half,
            cell,
            levels: Vec::new(),
            least: f32::INFINITY,
            room,
            texels: Vec::new(),
        };
        let corrected: Vec<Vec<f32>> = levels.iter().map(Nodes::corrected).collect();
        let all = corrected.iter().flatten();
        packed.least = all.copied().fold(f32::INFINITY, f32::min);
        let most_room = ((1 << Self::ROOM_BITS) - 1) as f32;
        let most = ((1 << (32 - Self::ROOM_BITS)) - 1) as f32;
        for (nodes, distances) in levels.iter().zip(&corrected) {
            let farthest = distances.iter().copied().fold(packed.least, f32::max);
            let step = ((farthest - packed.least) / most).max(f32::MIN_POSITIVE);
            let first = packed.texels.len() as u32;
            packed.levels.push(CarverLevel {
                nodes: nodes.count,
                first,
                step,
            });
            for (index, distance) in distances.iter().enumerate() {
                let (triangle, _) = nodes.nearest[index];
                let foot = object.triangle(triangle).nearest_point(nodes.place(index));
                // Beside the wall each node has its own; elsewhere it is that of the wall's nearest point.
                let is_beside = nodes.cell == cell && nodes.is_beside(index);
                let own = match is_beside {
                    true => rooms[index],
                    false => levels[0].interpolated(foot, |node| rooms[node]),
                };
                let far = ((distance - packed.least) / step + 0.5).clamp(0.0, most) as u32;
                let deep = (own / room.max(f32::MIN_POSITIVE) * most_room + 0.5) as u32;
                packed
                    .texels
                    .push(far << Self::ROOM_BITS | deep.min((1 << Self::ROOM_BITS) - 1));
            }
        }
        packed
    }
}

/// Cells along the longest side: more than asked for where the box is thin.
fn cells_along(half: Vec3) -> f32 {
    let mut cells = LEAST_CELLS;
    loop {
        let finer = cells + 32.0;
        let nodes = (2.0 * half * finer).ceil() + (1 + 2 * CARVER_MARGIN) as f32;
        if finer > MOST_CELLS || nodes.element_product() > MOST_NODES {
            return cells;
        }
        cells = finer;
    }
}

/// A surface that is asked often.
struct Shape<'a> {
    surface: &'a Surface,
    /// Of each part; none of a surface that is open.
    windings: Vec<Winding>,
}

impl<'a> Shape<'a> {
    fn of(surface: &'a Surface) -> Self {
        let is_closed = surface.segments.iter().all(|segment| segment.is_closed);
        let of_segment = |segment: usize| {
            let own = surface.triangles.iter().enumerate();
            let own = own.filter(|(i, _)| surface.segment_of(*i) == segment);
            Winding::new(&own.map(|(_, triangle)| *triangle).collect::<Vec<_>>())
        };
        let segments = 0..surface.segments.len();
        Self {
            surface,
            windings: match is_closed {
                true => segments.map(of_segment).collect(),
                false => Vec::new(),
            },
        }
    }

    fn is_closed(&self) -> bool {
        !self.windings.is_empty()
    }

    fn triangle(&self, index: u32) -> &Triangle {
        &self.surface.triangles[index as usize]
    }

    /// True inside of any part: by the winding number, which a closed part has outside of nothing.
    fn is_inside(&self, place: Vec3) -> bool {
        if !self.is_closed() {
            return self.surface.inside_of(place) != 0;
        }
        let is_inside =
            |part: &Winding| part.bounds().contains(place) && part.at(place).abs() >= 0.5;
        self.windings.iter().any(is_inside)
    }

    /// The nearest point of the surface, if it is nearer than `within`, and its triangle.
    fn nearest(&self, place: Vec3, within: f32) -> Option<Nearest> {
        let surface = self.surface;
        surface
            .tree
            .nearest(&surface.triangles, place, within, |_| true)
    }
}

impl Nodes {
    fn new(half: Vec3, cell: f32) -> Self {
        let count = (2.0 * half / cell).ceil().as_uvec3() + (1 + 2 * CARVER_MARGIN);
        Self {
            count,
            cell,
            nearest: vec![(0, 0.0); count.element_product() as usize],
        }
    }

    fn node(&self, index: usize) -> UVec3 {
        let i = index as u32;
        let [width, height, _] = self.count.to_array();
        UVec3::new(i % width, i / width % height, i / (width * height))
    }

    fn index(&self, node: UVec3) -> usize {
        (node.x + self.count.x * (node.y + self.count.y * node.z)) as usize
    }

    /// The place of a node in the object's space.
    fn place(&self, index: usize) -> Vec3 {
        let from_middle = self.node(index).as_vec3() - (self.count - 1).as_vec3() * 0.5;
        from_middle * self.cell
    }

    /// Distances and nearest triangles of all nodes. False if it was stopped.
    fn measure(
        &mut self,
        object: &Shape<'_>,
        around: Option<&Around<'_>>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> bool {
        let [width, height, _] = self.count.to_array();
        let row = width as usize;
        let slice = row * height as usize;
        let mut is_inside = false;
        for index in 0..self.nearest.len() {
            if index % slice == 0 && !go_on(index as f32 / self.nearest.len() as f32) {
                return false;
            }
            let place = self.place(index);
            if let Some(around) = around
                && let Some(distance) = around.distance(place, FAR * self.cell)
            {
                let nearest = around.level.nearest_around(place, object);
                self.nearest[index] = (nearest.triangle as u32, distance);
                is_inside = distance < 0.0;
                continue;
            }
            let is_first = index % row == 0;
            // The node before is near: its triangle bounds the search.
            let before = match (is_first, index.checked_sub(row)) {
                (false, _) => self.nearest[index - 1],
                (true, Some(other)) => self.nearest[other],
                (true, None) => (0, 0.0),
            };
            let bound = object
                .triangle(before.0)
                .nearest_point(place)
                .distance(place);
            let found = object.nearest(place, bound);
            let (triangle, distance) = found.map_or((before.0, bound), |nearest| {
                (nearest.triangle as u32, nearest.distance)
            });
            // Without a triangle between two nodes both lie on one side.
            let may_cross = is_first || before.1.abs() + distance <= self.cell * 1.05;
            if may_cross || !object.is_closed() {
                is_inside = object.is_inside(place);
            }
            let signed = if is_inside { -distance } else { distance };
            self.nearest[index] = (triangle, signed);
        }
        true
    }

    /// The quadratic B-spline of these coefficients at a place that is not at the end of the grid.
    fn spline(&self, place: Vec3, coefficients: &[f32]) -> f32 {
        let last = (self.count - 1).as_vec3();
        let at = place / self.cell + last * 0.5;
        let middle = at.round().clamp(Vec3::ONE, last - 1.0);
        let t = at - middle;
        let (before, behind) = (0.5 * (0.5 - t) * (0.5 - t), 0.5 * (0.5 + t) * (0.5 + t));
        let weights = [before, 1.0 - before - behind, behind];
        let corner = middle.as_uvec3() - 1;
        let mut sum = 0.0;
        for (k, z) in weights.iter().zip(0..) {
            for (j, y) in weights.iter().zip(0..) {
                let first = self.index(corner + UVec3::new(0, y, z));
                let line = coefficients.get(first..first + 3).unwrap_or_default();
                let along = line.iter().zip(&weights).map(|(c, i)| c * i.x);
                sum += along.sum::<f32>() * j.y * k.z;
            }
        }
        sum
    }

    /// The nearest point of the triangles that are nearest to the eight nodes around a place. That of all triangles is
    /// hardly nearer, and takes no search.
    fn nearest_around(&self, place: Vec3, object: &Shape<'_>) -> Nearest {
        let last = (self.count - 1).as_vec3();
        let low = (place / self.cell + last * 0.5)
            .floor()
            .clamp(Vec3::ZERO, last - 1.0);
        let first = self.index(low.as_uvec3());
        let (row, slice) = (
            self.count.x as usize,
            (self.count.x * self.count.y) as usize,
        );
        let mut asked = [u32::MAX; 8];
        let (mut best, mut least) = ((0, place), f32::INFINITY);
        for corner in 0..8 {
            let step = (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * slice;
            let (triangle, _) = self.nearest[first + step];
            // Around a place there are few triangles, if these are not small.
            if asked[..corner].contains(&triangle) {
                continue;
            }
            asked[corner] = triangle;
            let point = object.triangle(triangle).nearest_point(place);
            let squared = point.distance_squared(place);
            if squared < least {
                (best, least) = ((triangle, point), squared);
            }
        }
        Nearest {
            triangle: best.0 as usize,
            point: best.1,
            distance: least.sqrt(),
        }
    }

    /// Second differences of the distances at a node along the axes; 0 along one at whose end the node lies.
    fn bends(&self, index: usize) -> Vec3 {
        let (node, last) = (self.node(index), self.count - 1);
        let here = self.nearest[index].1;
        let along = |axis: usize| {
            if node[axis] == 0 || node[axis] == last[axis] {
                return 0.0;
            }
            let mut beside = [node, node];
            beside[0][axis] -= 1;
            beside[1][axis] += 1;
            let [low, high] = beside.map(|node| self.nearest[self.index(node)].1);
            low + high - 2.0 * here
        };
        Vec3::new(along(0), along(1), along(2))
    }

    /// The distances as the coefficients of a quadratic B-spline: less an eighth of their second differences, without
    /// which the spline would lie above them where they curve upwards.
    fn corrected(&self) -> Vec<f32> {
        let most = MOST_CORRECTION * self.cell;
        let nodes = self.nearest.iter().enumerate();
        let each = nodes.map(|(index, &(_, here))| {
            here - (0.125 * self.bends(index).element_sum()).clamp(-most, most)
        });
        each.collect()
    }

    /// Numbers of nodes, linear between them.
    fn interpolated(&self, place: Vec3, number: impl Fn(usize) -> f32) -> f32 {
        let last = (self.count - 1).as_vec3();
        let at = (place / self.cell + last * 0.5).clamp(Vec3::ZERO, last - 1e-3);
        let (low, part) = (at.floor().as_uvec3(), at.fract());
        let mut sum = 0.0;
        for corner in 0..8_u32 {
            let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            let weights = Vec3::select(step.cmpeq(UVec3::ONE), part, 1.0 - part);
            let weight = weights.element_product();
            if weight > 0.0 {
                sum += weight * number(self.index(low + step));
            }
        }
        sum
    }

    /// True for a node so near the wall that it may be one of the eight around a point of the wall.
    fn is_beside(&self, index: usize) -> bool {
        self.nearest[index].1.abs() <= 1.8 * self.cell
    }

    /// How deep in the object tissue may have stood that lies at the wall, for the nodes beside the wall; 0 elsewhere.
    fn rooms(&self, object: &Shape<'_>, go_on: &mut dyn FnMut(f32) -> bool) -> Option<Vec<f32>> {
        let slice = (self.count.x * self.count.y) as usize;
        let mut rooms = vec![0.0; self.nearest.len()];
        for index in 0..rooms.len() {
            if index % slice == 0 && !go_on(index as f32 / rooms.len() as f32) {
                return None;
            }
            let (triangle, distance) = self.nearest[index];
            if !self.is_beside(index) {
                continue;
            }
            let place = self.place(index);
            let triangle = object.triangle(triangle);
            let foot = triangle.nearest_point(place);
            let out = (place - foot) * distance.signum();
            let inwards = match out.length() > 1e-4 * self.cell {
                true => -out.normalize_or_zero(),
                false => -triangle.area_normal().normalize_or_zero(),
            };
            rooms[index] = self.room(object, foot, inwards);
        }
        Some(rooms)
    }

    /// [`PART_OF_WAY`] of the longest way inwards from a point of the surface on which every place lies inside and at
    /// least that part of its way from the surface.
    fn room(&self, object: &Shape<'_>, foot: Vec3, inwards: Vec3) -> f32 {
        let depth_at = |place: Vec3| -self.interpolated(place, |node| self.nearest[node].1);
        let mut way = 0.5 * self.cell;
        while way < 1.0 {
            let place = foot + inwards * way;
            let slack = depth_at(place) - PART_OF_WAY * way;
            if slack > 0.3 * self.cell {
                // Both change by at most as much as the way.
                way += ((slack - 0.15 * self.cell) / (1.0 + PART_OF_WAY)).max(0.25 * self.cell);
                continue;
            }
            // The surface's nearest point, and how far one may go before it is too near.
            let nearest = self.nearest_around(place, object);
            if nearest.distance < PART_OF_WAY * way * 0.9999 {
                return PART_OF_WAY * self.shortened(object, foot, inwards, way, nearest.point);
            }
            if slack < -self.cell {
                // Far from the surface, and yet not inside.
                return PART_OF_WAY * way;
            }
            way += 0.5 * self.cell;
        }
        PART_OF_WAY * way
    }

    /// The way at whose end a point of the surface is just not too near, and no other point either.
    fn shortened(
        &self,
        object: &Shape<'_>,
        foot: Vec3,
        inwards: Vec3,
        way: f32,
        point: Vec3,
    ) -> f32 {
        // |inwards · way - across| = part · way, solved for the shorter way.
        const LEFT: f32 = 1.0 - PART_OF_WAY * PART_OF_WAY;
        let (mut way, mut point) = (way, point);
        for _ in 0..12 {
            let across = point - foot;
            let along = across.dot(inwards);
            let inner = along * along - LEFT * across.length_squared();
            let own = (along - inner.max(0.0).sqrt()) / LEFT;
            way = way.min(own.max(0.0));
            let nearest = self.nearest_around(foot + inwards * way, object);
            if nearest.distance >= PART_OF_WAY * way * 0.999 {
                break;
            }
            point = nearest.point;
        }
        way
    }
}

/// The next coarser level, from which a level takes distances far from the surface.
struct Around<'a> {
    level: &'a Nodes,
    coefficients: Vec<f32>,
    /// False for nodes at which, or beside which, the distances bend so much that a spline is not exact.
    is_even: Vec<bool>,
}

impl<'a> Around<'a> {
    fn of(level: &'a Nodes) -> Self {
        let most = MOST_BEND * level.cell;
        let bends = (0..level.nearest.len()).map(|index| level.bends(index).abs().element_sum());
        let mut is_even: Vec<bool> = bends.map(|bend| bend <= most).collect();
        // A spline reads the 27 nodes around a place: along each axis a node takes over what both beside it are.
        let (row, slice) = (level.count.x, level.count.x * level.count.y);
        for step in [1, row, slice].map(|step| step as usize) {
            let own = is_even.clone();
            let both = own.iter().zip(own.iter().skip(2 * step));
            for (even, (before, behind)) in is_even.iter_mut().skip(step).zip(both) {
                *even &= before & behind;
            }
        }
        Self {
            level,
            coefficients: level.corrected(),
            is_even,
        }
    }

    /// The distance of a place, if the surface is farther away than `far` and the distances around are even.
    fn distance(&self, place: Vec3, far: f32) -> Option<f32> {
        let last = (self.level.count - 1).as_vec3();
        let at = place / self.level.cell + last * 0.5;
        let middle = at.round().clamp(Vec3::ONE, last - 1.0).as_uvec3();
        if !self.is_even[self.level.index(middle)] {
            return None;
        }
        let distance = self.level.spline(place, &self.coefficients);
        (distance.abs() > far).then_some(distance)
    }
}
