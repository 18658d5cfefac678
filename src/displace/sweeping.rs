//! The steps in which the flow of a `sweep` is integrated (spec/sweepers.md, A.3): poses, screws and reach of every
//! tool in each, found once per edit in 64 bits, and packed for shaders/displace/sweep.wgsl.

use super::drawn::{
    DRAWN_ALONE, DRAWN_CROWDED, DRAWN_ELLIPSOIDS, DRAWN_GRIDS, DRAWN_PIECES, DRAWN_TOGETHER,
};
use super::facts::Given;
use super::mover::{Ball, Mover, counted_in, images_of, spans, wanted_in};
use super::tools::{PathKey, SweepTool, SweepTools, ToolFile, ToolShape};
use crate::math::{Aabb, Screw, Similarity, smooth_path};
use glam::{DQuat, DVec3, UVec3, Vec3};

/// Steps of a tool alone per width of its coating that it travels.
const STEPS_A_COAT: f64 = 6.0;
/// Steps in a block, and blocks in a block of blocks, as in shaders/displace/sweep.wgsl.
const BLOCK: usize = 8;
/// Rows of the pool before those of images.
const HEAD_ROWS: usize = 4;
/// Texels of a step for itself, and for each tool.
const STEP_ROWS: usize = 2;
const TOOL_ROWS: usize = 6;
/// How much finer than to its width a sheared coating has to be known, for each coating of the way and of its stretch.
const SHEARED: f64 = 0.14;
/// Bits of the nodes of a grid along one axis, as in shaders/displace/tools.wgsl.
const NODE_BITS: u32 = 6;
/// What is not there yet holds nothing: as a ball, from which everything is far away. Its number, and its form.
const NOTHING_NUMBER: usize = 0;
const NOTHING: [f32; 4] = [0.0, 0.0, 0.0, -1e6];
/// Stages of a step: each asks for the field of every tool.
const STAGES: usize = 4;
/// Fields that a cell of the skip grid may ask for, and parts of a cell along each side that may be asked about. So
/// lavapipe makes a grid of 48 cells a side of a sweep of a tool alone within 0.3 s.
const MOST_FIELDS: usize = 8_192;
const MOST_PARTS: u32 = 3;
/// A field of tools that act together takes so much longer than one of a tool alone, as measured.
const SHARED_WEIGHT: usize = 4;
/// Fields of a place from which on several are asked in one turn of a loop. A ray asks for some two hundred places, and
/// lavapipe ends all loops after 65,535 turns.
const CROWDED: usize = 256;
/// Pieces of a curve that a turn asks about, as in shaders/displace/tools.wgsl.
const PIECES_AT_ONCE: usize = 4;
/// Reach is rounded up by this part of it, for floats of 32 bits.
const ROUNDING: f64 = 1e-5;

/// A tool of a sweep in a box of this size; none of an unknown shape.
fn mover_of(tool: &SweepTool, size: DVec3) -> Option<Mover<'_>> {
    let shape = tool.shape.as_ref()?;
    let unit = size.min_element();
    let keys: Vec<Similarity> = tool
        .path
        .iter()
        .map(|key| {
            let turn = DQuat::from_array(key.rotate.to_array().map(f64::from));
            let place = size * (key.at.as_dvec3() - 0.5);
            Similarity::new(f64::from(key.scale), turn, place)
        })
        .collect();
    let poses = match tool.spline {
        true => smooth_path(&keys),
        false => keys,
    };
    Some(Mover::new(shape, unit, f64::from(tool.coat) * unit, poses))
}

/// One step: every tool moves by one screw.
#[derive(Clone, Debug)]
struct Step {
    start: f64,
    end: f64,
    /// How many steps before this one are as long, and go by the same screws.
    before: usize,
    /// For each tool what it reaches, its screw, and its pose at the start.
    tools: Vec<(Ball, Screw, Similarity)>,
    /// The longest way of a point of any tool.
    travel: f64,
}

/// How a tool of a `sweep` goes, in template space.
#[derive(Clone, Debug)]
pub struct ToolWay {
    /// Its poses from the first key to the last, [`WAY_PARTS`] to a span between two keys.
    pub poses: Vec<PathKey>,
    /// Lines that show its form where it has come to, and those of its images.
    pub outline: Vec<Vec<Vec3>>,
}

/// Poses of a [`ToolWay`] from one key to the next.
pub const WAY_PARTS: usize = 16;

/// Where a grid of distances lies in the texture of sweeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridPlace {
    /// Its first texel.
    pub first: usize,
    /// Nodes along each axis.
    pub nodes: UVec3,
}

/// How a `sweep` is evaluated.
#[derive(Clone, Debug)]
pub(crate) struct Sweeping<'a> {
    movers: Vec<Mover<'a>>,
    mirror: [bool; 3],
    steps: Vec<Step>,
    size: DVec3,
}

impl<'a> Sweeping<'a> {
    /// The steps of tools in a box of this size.
    pub(crate) fn new(tools: &'a SweepTools, size: Vec3) -> Self {
        let mut sweeping = Self::still(tools, size);
        let spans = spans(&sweeping.movers);
        let wanted: Vec<f64> = spans
            .iter()
            .map(|span| wanted_in(&sweeping.movers, sweeping.mirror, *span, STEPS_A_COAT))
            .collect();
        // Where thin coatings of others ask for more than may be, each span still gets what its own tools ask for.
        let own = spans.iter().zip(&wanted);
        let own: Vec<f64> = own
            .map(|(span, wanted)| counted_in(&sweeping.movers, *span).min(*wanted))
            .collect();
        let [least, all] = [&own, &wanted].map(|counts| counts.iter().sum::<f64>());
        let room = (tools.most_steps as f64 - least).max(0.0);
        let part = (room / (all - least).max(1.0)).min(1.0);
        for (((from, to), wanted), own) in spans.into_iter().zip(wanted).zip(own) {
            let count = libm::ceil(own + (wanted - own) * part);
            for i in 0..count as usize {
                let at = |i: usize| from + (to - from) * (i as f64 / count);
                sweeping.step(at(i), at(i + 1), i);
            }
        }
        sweeping
    }

    /// Where the first tool that moves is held at a time, template space: beside its origin, so that the handle of its
    /// way does not lie on its keys, and goes along where the tool only turns or grows. The middle of the box if there
    /// is none.
    pub(crate) fn place(given: &Given, time: f32) -> Vec3 {
        let acting = || given.tools.iter().flat_map(SweepTools::acting);
        let moving = acting().find(|tool| tool.path.len() > 1);
        let tool = moving.or_else(|| acting().next());
        let size = given.size.as_dvec3();
        let mover = tool.and_then(|tool| mover_of(tool, size));
        let place = mover.map_or(DVec3::ZERO, |mover| {
            let (_, _, pose) = mover.at(f64::from(time));
            pose.of(DVec3::splat(mover.farthest / libm::sqrt(3.0)))
        });
        (place / size + 0.5).as_vec3()
    }

    /// How the tools go, each in its place in the list; none of an unknown shape.
    /// Lines of a form, as [`ToolShape::outline`], are those of `outline`.
    pub(crate) fn ways(
        tools: &SweepTools,
        size: Vec3,
        progress: f32,
        outline: &dyn Fn(&ToolShape) -> Vec<Vec<Vec3>>,
    ) -> Vec<Option<ToolWay>> {
        let size = size.as_dvec3();
        let images = images_of(tools.mirror);
        let way = |tool: &SweepTool| {
            let mover = mover_of(tool, size)?;
            let parts = WAY_PARTS * (tool.path.len() - 1);
            let poses = (0..=parts).map(|i| {
                let (_, _, pose) = mover.at(i as f64 / parts.max(1) as f64);
                PathKey {
                    at: (pose.place / size + 0.5).as_vec3(),
                    rotate: pose.turn.as_quat(),
                    scale: pose.scale as f32,
                }
            });
            let (_, _, pose) = mover.at(f64::from(progress));
            let lines = outline(mover.shape);
            let mut outline = Vec::new();
            for image in &images {
                for line in &lines {
                    let places = line.iter().map(|p| {
                        let metric = pose.of(p.as_dvec3() * mover.unit) * *image;
                        (metric / size + 0.5).as_vec3()
                    });
                    outline.push(places.collect());
                }
            }
            Some(ToolWay {
                poses: poses.collect(),
                outline,
            })
        };
        tools.tools.iter().map(way).collect()
    }

    /// The steps of what a template holds.
    pub(crate) fn of(given: &'a Given) -> Self {
        match &given.tools {
            Some(tools) => Self::new(tools, given.size),
            None => Self {
                movers: Vec::new(),
                mirror: [false; 3],
                steps: Vec::new(),
                size: given.size.as_dvec3(),
            },
        }
    }

    /// The tools alone, without steps.
    pub(crate) fn still(tools: &'a SweepTools, size: Vec3) -> Self {
        let size = size.as_dvec3();
        let movers = tools.acting().filter_map(|t| mover_of(t, size));
        Self {
            movers: movers.collect(),
            mirror: tools.mirror,
            steps: Vec::new(),
            size,
        }
    }

    /// Pieces of paths, and steps as the limits of a document count them. Where there is room for fewer pieces the
    /// steps are not counted.
    pub(crate) fn counted(tools: &'a SweepTools, size: Vec3, room: usize) -> [usize; 2] {
        let sweeping = Self::still(tools, size);
        let pieces = sweeping.movers.iter().map(|m| m.screws.len()).sum();
        if pieces > room {
            return [pieces, 0];
        }
        let spans = spans(&sweeping.movers).into_iter();
        let steps = spans.map(|span| counted_in(&sweeping.movers, span) as usize);
        [pieces, steps.sum()]
    }

    /// Adds a step. `before`: how many steps of the same span come before it.
    fn step(&mut self, start: f64, end: f64, before: usize) {
        let travel = self.movers.iter().map(|mover| mover.travel(start, end));
        let travel = travel.fold(0.0, f64::max);
        // What is driven by one tool may come into the reach of another on the way.
        let room = if self.movers.len() * self.images().len() > 1 {
            travel
        } else {
            0.0
        };
        let tools = self.movers.iter().map(|mover| {
            let ball = mover.ball(start, end);
            let (piece, screw, _) = mover.at(0.5 * (start + end));
            let (_, _, pose) = mover.at_in(piece, start);
            let radius = (ball.radius + room) * (1.0 + ROUNDING);
            (Ball { radius, ..ball }, screw, pose)
        });
        self.steps.push(Step {
            start,
            end,
            before,
            tools: tools.collect(),
            travel,
        });
    }

    /// True if one tool acts that is no curve, without images: its steps are packed for a way of the shader that is
    /// shorter.
    fn is_alone(&self) -> bool {
        let is_curve = |mover: &Mover<'_>| matches!(mover.shape, ToolShape::Curve { .. });
        self.movers.len() * self.images().len() == 1 && !self.movers.iter().any(is_curve)
    }

    /// Signs of the axes of each image, the tools themselves first.
    fn images(&self) -> Vec<DVec3> {
        images_of(self.mirror)
    }

    /// A ball about the reach of all that moves in some steps, images too.
    fn reach(&self, steps: &[Step]) -> Option<Ball> {
        let tools = steps.iter().flat_map(|step| &step.tools);
        let moving = tools.filter(|(_, screw, _)| !screw.is_none());
        let images = self.images();
        let balls = moving.flat_map(|(ball, ..)| {
            images.iter().map(|image| Ball {
                middle: ball.middle * *image,
                radius: ball.radius,
            })
        });
        Ball::around(&balls.collect::<Vec<_>>())
    }

    /// The box outside which nothing moves until a time, metric local coordinates; empty if nothing moves at all.
    fn swept(&self, progress: f64) -> Aabb {
        let mut swept = Aabb::EMPTY;
        for step in self.steps.iter().filter(|step| step.start < progress) {
            for (ball, screw, _) in &step.tools {
                if screw.is_none() {
                    continue;
                }
                for image in self.images() {
                    let middle = (ball.middle * image).as_vec3();
                    let radius = (ball.radius * (1.0 + ROUNDING)) as f32;
                    swept = swept.union(Aabb {
                        min: middle - radius,
                        max: middle + radius,
                    });
                }
            }
        }
        swept
    }

    /// The box outside which nothing moves until a time, template space.
    pub(crate) fn bounds(&self, progress: f32) -> Aabb {
        let swept = self.swept(f64::from(progress));
        if swept.is_empty() {
            return Aabb::EMPTY;
        }
        let size = self.size.as_vec3();
        Aabb {
            min: swept.min / size + 0.5,
            max: swept.max / size + 0.5,
        }
    }

    /// Fields that the shader evaluates for a place that no step moves, template space: four for each step and each
    /// image of a tool that reaches it there.
    #[cfg(feature = "render")]
    pub(crate) fn fields_at(&self, at: Vec3) -> usize {
        let place = self.size * (at.as_dvec3() - 0.5);
        let images = self.images();
        let of_step = |step: &Step| {
            let holds = |ball: &Ball, at: DVec3| ball.middle.distance(at) <= ball.radius;
            let is_reached = |ball: Ball| holds(&ball, place);
            if !self
                .reach(std::slice::from_ref(step))
                .is_some_and(is_reached)
            {
                return 0;
            }
            let reaches = |image: &DVec3| {
                let balls = step.tools.iter().map(|(ball, ..)| ball);
                balls.filter(|ball| holds(ball, *image * place)).count()
            };
            4 * images.iter().map(reaches).sum::<usize>()
        };
        self.steps.iter().map(of_step).sum()
    }

    /// The longest way of any material until a time, subject units.
    pub(crate) fn longest(&self, progress: f32) -> f32 {
        let done = |step: &Step| {
            let part = (f64::from(progress) - step.start) / (step.end - step.start);
            step.travel * part.clamp(0.0, 1.0)
        };
        self.steps.iter().map(done).sum::<f64>() as f32
    }

    /// The smallest coating, subject units.
    #[cfg(feature = "render")]
    pub(crate) fn least_coat(&self) -> Option<f32> {
        let coats = self.movers.iter().map(|mover| mover.coat as f32);
        coats.reduce(f32::min)
    }

    /// Width to which a texture of the map has to be as fine as to a coating, subject units: the smallest coating, or a
    /// part of it where a tool turns. What shears in its coating has a source that is read a little off; that tissue
    /// then lies far along the turn.
    pub(crate) fn least_width(&self) -> Option<f32> {
        let widths = self.movers.iter().map(|mover| {
            let turned: f64 = mover.screws.iter().map(|s| s.turn.length()).sum();
            let angle = turned / mover.screws.len().max(1) as f64;
            let farthest = mover
                .poses
                .iter()
                .map(|pose| mover.radius(pose) - mover.coat);
            let coats = angle * farthest.fold(0.0, f64::max) / mover.coat;
            // The curvature of the map grows with the way in coatings, and its stretch with that way too. The factor is
            // measured: of what boxes and ellipsoids shear by two or three coatings 99 % is drawn within a texel.
            mover.coat / (SHEARED * coats * (1.0 + 2.0 * coats)).max(1.0)
        });
        widths.map(|width| width as f32).reduce(f32::min)
    }

    /// Parts along each side by whose corners a cell of the skip grid may ask, so that an edit is soon shown; 0 if even
    /// the corners of the cell itself take too long.
    pub(crate) fn most_parts(&self) -> u32 {
        let fields: usize = self
            .movers
            .iter()
            .map(|m| turns_of(m.shape.points().len()))
            .sum();
        let weight = if self.is_alone() { 1 } else { SHARED_WEIGHT };
        let of_place = self.steps.len() * STAGES * fields * self.images().len() * weight;
        let is_few = |parts: &u32| (*parts as usize + 1).pow(3) * of_place <= MOST_FIELDS;
        (1..=MOST_PARTS).rev().find(is_few).unwrap_or(0)
    }

    /// Number of [`Sweeping::texels`].
    fn texel_count(&self) -> usize {
        let points: usize = self.movers.iter().map(|m| m.shape.points().len()).sum();
        let count = self.steps.len();
        let blocks = count.div_ceil(BLOCK) + count.div_ceil(BLOCK * BLOCK);
        count * (STEP_ROWS + TOOL_ROWS * self.movers.len()) + blocks + points
    }

    /// What the shader reads from its texture: the steps, balls about blocks of them and about blocks of blocks, and
    /// the points of curves.
    pub(crate) fn texels(&self) -> Vec<[f32; 4]> {
        let mut texels = Vec::with_capacity(self.texel_count());
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
        let begin = *first;
        *first += self.texel_count();
        let last = self
            .steps
            .partition_point(|step| step.start < f64::from(progress));
        if last == 0 {
            return Vec::new();
        }
        let swept = self.swept(f64::from(progress));
        let (count, bases) = (self.steps.len(), self.movers.len());
        let images = self.images();
        let blocks = begin + count * (STEP_ROWS + TOOL_ROWS * bases);
        let blocks_of_blocks = blocks + count.div_ceil(BLOCK);
        let mut points = blocks_of_blocks + count.div_ceil(BLOCK * BLOCK);
        let mirror = (0..3)
            .filter(|axis| self.mirror[*axis])
            .map(|axis| 1 << axis);
        let mirror: u32 = mirror.sum();
        let mut rows = vec![
            [
                begin as f32,
                blocks as f32,
                blocks_of_blocks as f32,
                bases as f32,
            ],
            [
                (last - 1) as f32,
                progress,
                (images.len() * bases) as f32,
                mirror as f32,
            ],
            swept.min.extend(0.0).to_array(),
            swept.max.extend(0.0).to_array(),
        ];
        for image in &images {
            for base in 0..bases {
                rows.push(image.as_vec3().extend(base as f32).to_array());
            }
        }
        for mover in &self.movers {
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
                ToolShape::Curve { radius, .. } => {
                    [radius * unit, points as f32, count as f32, 0.0]
                }
                ToolShape::Ellipsoid { radii } => (*radii * unit).extend(0.0).to_array(),
                ToolShape::Box { half, round } => {
                    let round = round.min(half.min_element());
                    let core = (*half - round).max(Vec3::ZERO);
                    (core * unit).extend(round * unit).to_array()
                }
                ToolShape::Ball { radius } => [0.0, 0.0, 0.0, radius * unit],
                ToolShape::Capsule { radius, length } => {
                    [0.0, 0.0, 0.5 * length * unit, radius * unit]
                }
                ToolShape::Torus { ring, radius } => [ring * unit, 0.0, 0.0, radius * unit],
            };
            points += count;
            rows.push(form);
            rows.push([number as f32, (1.0 / mover.coat) as f32, 0.0, 0.0]);
        }
        rows
    }
}

impl Sweeping<'_> {
    /// What the sweep of these rows ([`Sweeping::rows`]) has, as bits of `drawn_kinds`; nothing if nothing moves. Else
    /// it is the same at each progress, so that no program is made while that changes.
    pub(crate) fn drawn_in(rows: &[[f32; 4]]) -> u32 {
        let number = |row: usize, part: usize| rows.get(row).map_or(0, |row| row[part] as usize);
        let (tools, images) = (number(0, 3), number(1, 2));
        if images == 0 {
            return 0;
        }
        let forms = (0..tools).map(|tool| HEAD_ROWS + images + 2 * tool);
        let mut bits = 0;
        let mut fields = 0;
        for form in forms {
            let (shape, points) = (number(form + 1, 0), number(form, 2));
            bits |= match shape {
                ToolShape::ELLIPSOID => DRAWN_ELLIPSOIDS,
                ToolShape::CURVE => DRAWN_PIECES,
                ToolShape::MESH => DRAWN_GRIDS,
                _ => 0,
            };
            fields += turns_of(if shape == ToolShape::CURVE { points } else { 0 });
        }
        if images == 1 && bits & DRAWN_PIECES == 0 {
            return bits | DRAWN_ALONE;
        }
        let steps = (number(0, 1) - number(0, 0)) / (STEP_ROWS + TOOL_ROWS * tools);
        let is_crowded = steps * STAGES * fields * (images / tools) > CROWDED;
        bits | DRAWN_TOGETHER | if is_crowded { DRAWN_CROWDED } else { 0 }
    }
}

/// Turns that the field of a tool takes: one, or one for each of the pieces of a curve, so many points, that are asked
/// at once.
fn turns_of(points: usize) -> usize {
    let pieces = points.saturating_sub(1);
    pieces.div_ceil(PIECES_AT_ONCE).max(1)
}

/// A ball as the shader takes it: w is the square of its radius; of nothing, a ball that holds no point.
fn packed_ball(ball: Option<Ball>) -> [f32; 4] {
    let Some(ball) = ball else {
        return [0.0, 0.0, 0.0, -1.0];
    };
    let square = ball.radius * ball.radius * (1.0 + ROUNDING);
    ball.middle.as_vec3().extend(square as f32).to_array()
}
