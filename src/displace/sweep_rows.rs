//! A `sweep` as its shader reads it (shaders/displace/sweep.wgsl): steps in a texture, all else in rows of the pool.

use super::drawn::{
    DRAWN_ALONE, DRAWN_CROWDED, DRAWN_ELLIPSOIDS, DRAWN_GRIDS, DRAWN_PIECES, DRAWN_TOGETHER,
};
use super::mover::{Ball, Mover};
use super::sweeping::{ClusterFlow, ROUNDING, STAGES, Sweeping, turns_of};
use super::tools::{ToolFile, ToolShape};
use crate::math::Aabb;
use glam::{DVec3, UVec3, Vec3};

/// Steps in a block, and blocks in a block of blocks.
const BLOCK: usize = 8;
/// Rows of the pool before those of the copies of clusters, and for each of these.
const HEAD_ROWS: usize = 3;
const COPY_ROWS: usize = 5;
/// Texels of a step for itself, and for each tool.
const STEP_ROWS: usize = 2;
const TOOL_ROWS: usize = 6;
/// Bits of the nodes of a grid along one axis, as in shaders/displace/tools.wgsl.
const NODE_BITS: u32 = 6;
/// What is not there yet holds nothing: as a ball, from which everything is far away. Its number, and its form.
const NOTHING_NUMBER: usize = 0;
const NOTHING: [f32; 4] = [0.0, 0.0, 0.0, -1e6];
/// A box that holds no point, in numbers that uniforms may hold.
const NOWHERE: Aabb = Aabb {
    min: Vec3::splat(1e30),
    max: Vec3::splat(-1e30),
};
/// Fields of a place from which on several are asked in one turn of a loop. A ray asks for some two hundred places, and
/// lavapipe ends all loops after 65,535 turns.
const CROWDED: usize = 256;

/// Where a grid of distances lies in the texture of sweeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridPlace {
    /// Its first texel.
    pub first: usize,
    /// Nodes along each axis.
    pub nodes: UVec3,
}

impl Sweeping<'_> {
    /// What the shader reads from its texture, cluster by cluster: the steps, balls about blocks of them and about
    /// blocks of blocks, and the points of curves.
    pub(crate) fn texels(&self) -> Vec<[f32; 4]> {
        let mut texels = Vec::new();
        for flow in &self.flows {
            flow.pack_texels(&mut texels);
        }
        texels
    }

    /// What the shader reads from the pool, for texels that begin at `first`; nothing if nothing moves. `grid_of` says
    /// where the grid of a mesh lies, if it is there.
    pub(crate) fn rows(
        &self,
        progress: f32,
        first: &mut usize,
        grid_of: &dyn Fn(&ToolFile) -> Option<GridPlace>,
    ) -> Vec<[f32; 4]> {
        let mut begin = *first;
        *first += self
            .flows
            .iter()
            .map(ClusterFlow::texel_count)
            .sum::<usize>();
        let until = f64::from(progress);
        let boxes: Vec<Vec<Aabb>> = self.flows.iter().map(|flow| flow.swept(until)).collect();
        let swept = boxes.iter().flatten().copied();
        let swept = swept.fold(Aabb::EMPTY, Aabb::union);
        if swept.is_empty() {
            return Vec::new();
        }
        let mirror = (0..3)
            .filter(|axis| self.mirror[*axis])
            .map(|axis| 1 << axis);
        let mirror: u32 = mirror.sum();
        let copies = boxes.iter().flatten().count();
        let mut rows = vec![
            [copies as f32, progress, mirror as f32, 0.0],
            swept.min.extend(0.0).to_array(),
            swept.max.extend(0.0).to_array(),
        ];
        let mut shared = Vec::new();
        for (flow, boxes) in self.flows.iter().zip(boxes) {
            let of_images = HEAD_ROWS + COPY_ROWS * copies + shared.len();
            rows.extend(flow.copy_rows(until, &boxes, begin, of_images));
            shared.extend(flow.shared_rows(begin, grid_of));
            begin += flow.texel_count();
        }
        rows.extend(shared);
        rows
    }

    /// What the sweep of these rows ([`Sweeping::rows`]) has, as bits of `drawn_kinds`; nothing if nothing moves. Else
    /// it is the same at each progress, so that no program is made while that changes.
    pub(crate) fn drawn_in(rows: &[[f32; 4]]) -> u32 {
        let number = |row: usize, part: usize| rows.get(row).map_or(0, |row| row[part] as usize);
        let mut bits = 0;
        for copy in 0..number(0, 0) {
            let row = HEAD_ROWS + COPY_ROWS * copy;
            let (steps_end, tools) = (number(row, 1), number(row, 3));
            let (images, of_images) = (number(row + 1, 1), number(row + 1, 2));
            let form_of = |image: usize| of_images + images + 2 * number(of_images + image, 3);
            let mut fields = 0;
            let mut has_curves = false;
            for form in (0..images).map(form_of) {
                let (shape, points) = (number(form + 1, 0), number(form, 2));
                bits |= match shape {
                    ToolShape::ELLIPSOID => DRAWN_ELLIPSOIDS,
                    ToolShape::CURVE => DRAWN_PIECES,
                    ToolShape::MESH => DRAWN_GRIDS,
                    _ => 0,
                };
                let is_curve = shape == ToolShape::CURVE;
                has_curves |= is_curve;
                fields += turns_of(if is_curve { points } else { 0 });
            }
            if images == 1 && !has_curves {
                bits |= DRAWN_ALONE;
                continue;
            }
            let steps = (steps_end - number(row, 0)) / (STEP_ROWS + TOOL_ROWS * tools);
            let is_crowded = steps * STAGES * fields > CROWDED;
            bits |= DRAWN_TOGETHER | if is_crowded { DRAWN_CROWDED } else { 0 };
        }
        bits
    }
}

impl ClusterFlow<'_> {
    /// Texels of the steps alone.
    fn step_texels(&self) -> usize {
        self.steps.len() * (STEP_ROWS + TOOL_ROWS * self.movers.len())
    }

    /// Texels of all that it packs.
    fn texel_count(&self) -> usize {
        let points: usize = self.movers.iter().map(|m| m.shape.points().len()).sum();
        let count = self.steps.len();
        let blocks = count.div_ceil(BLOCK) + count.div_ceil(BLOCK * BLOCK);
        self.step_texels() + blocks + points
    }

    fn pack_texels(&self, texels: &mut Vec<[f32; 4]>) {
        texels.reserve(self.texel_count());
        let with = |v: DVec3, w: f64| v.as_vec3().extend(w as f32).to_array();
        let is_alone = self.is_alone();
        for step in &self.steps {
            let lasts = step.end - step.start;
            texels.push([step.start as f32, lasts as f32, step.before as f32, 0.0]);
            texels.push(packed_ball(self.reach(std::slice::from_ref(step))));
            for (ball, screw, pose) in &step.tools {
                texels.push(packed_ball(Some(*ball)));
                let inverse = pose.inverse();
                // Rows of a turn are the axes turned back.
                let rows =
                    [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| pose.turn * axis * inverse.scale);
                for (row, place) in rows.into_iter().zip(inverse.place.to_array()) {
                    texels.push(with(row, place));
                }
                let screw = match is_alone {
                    true => screw.within(pose),
                    false => *screw,
                };
                texels.push(with(screw.turn, screw.growth));
                texels.push(with(screw.way, pose.scale));
            }
        }
        for block in [BLOCK, BLOCK * BLOCK] {
            for steps in self.steps.chunks(block) {
                texels.push(packed_ball(self.reach(steps)));
            }
        }
        for mover in &self.movers {
            for point in mover.shape.points() {
                texels.push(with(point.as_dvec3() * mover.unit, 0.0));
            }
        }
    }

    /// The rows of its copies, which move nothing outside `boxes` until a time. Its texels begin at `begin`, the rows
    /// of its images at `of_images`.
    fn copy_rows(
        &self,
        until: f64,
        boxes: &[Aabb],
        begin: usize,
        of_images: usize,
    ) -> Vec<[f32; 4]> {
        let last = self.steps.partition_point(|step| step.start < until) as f32 - 1.0;
        let blocks = begin + self.step_texels();
        let blocks_of_blocks = blocks + self.steps.len().div_ceil(BLOCK);
        let head = [begin, blocks, blocks_of_blocks, self.movers.len()].map(|n| n as f32);
        let acting = [last, self.images.len() as f32, of_images as f32, 0.0];
        let copies = self.copies.iter().zip(boxes);
        let rows = copies.flat_map(|(signs, swept)| {
            // Another cluster begins before.
            let swept = if swept.is_empty() { NOWHERE } else { *swept };
            let corners = [signs.as_vec3(), swept.min, swept.max];
            let [signs, min, max] = corners.map(|v| v.extend(0.0).to_array());
            [head, acting, signs, min, max]
        });
        rows.collect()
    }

    /// What its copies share: the rows of its images and tools.
    fn shared_rows(
        &self,
        begin: usize,
        grid_of: &dyn Fn(&ToolFile) -> Option<GridPlace>,
    ) -> Vec<[f32; 4]> {
        let images = self.images.iter();
        let images = images.map(|(signs, tool)| signs.as_vec3().extend(*tool as f32).to_array());
        let mut rows: Vec<[f32; 4]> = images.collect();
        let points: usize = self.movers.iter().map(|m| m.shape.points().len()).sum();
        let mut points = begin + self.texel_count() - points;
        for mover in &self.movers {
            rows.extend(tool_rows(mover, points, grid_of));
            points += mover.shape.points().len();
        }
        rows
    }
}

/// The two rows of a tool, whose points, if it has any, begin at texel `points`.
fn tool_rows(
    mover: &Mover<'_>,
    points: usize,
    grid_of: &dyn Fn(&ToolFile) -> Option<GridPlace>,
) -> [[f32; 4]; 2] {
    let shape = mover.shape;
    let unit = mover.unit as f32;
    let count = shape.points().len();
    let mut number = shape.number();
    let form = match shape {
        ToolShape::Mesh { file, longest } => match grid_of(file) {
            Some(GridPlace { first, nodes }) => {
                let [x, y, z] = nodes.to_array();
                let sides = x | y << NODE_BITS | z << (2 * NODE_BITS);
                [first as f32, sides as f32, longest * unit, 0.0]
            }
            None => {
                number = NOTHING_NUMBER;
                NOTHING
            }
        },
        // No sweep has one.
        ToolShape::Clay { .. } => {
            number = NOTHING_NUMBER;
            NOTHING
        }
        ToolShape::Curve { radius, .. } => [radius * unit, points as f32, count as f32, 0.0],
        ToolShape::Ellipsoid { radii } => (*radii * unit).extend(0.0).to_array(),
        ToolShape::Box { half, round } => {
            let round = round.min(half.min_element());
            let core = (*half - round).max(Vec3::ZERO);
            (core * unit).extend(round * unit).to_array()
        }
        ToolShape::Ball { radius } => [0.0, 0.0, 0.0, radius * unit],
        ToolShape::Capsule { radius, length } => [0.0, 0.0, 0.5 * length * unit, radius * unit],
        ToolShape::Torus { ring, radius } => [ring * unit, 0.0, 0.0, radius * unit],
    };
    [form, [number as f32, (1.0 / mover.coat) as f32, 0.0, 0.0]]
}

/// A ball as the shader takes it: w is the square of its radius; of nothing, a ball that holds no point.
fn packed_ball(ball: Option<Ball>) -> [f32; 4] {
    let Some(ball) = ball else {
        return [0.0, 0.0, 0.0, -1.0];
    };
    let square = ball.radius * ball.radius * (1.0 + ROUNDING);
    ball.middle.as_vec3().extend(square as f32).to_array()
}
