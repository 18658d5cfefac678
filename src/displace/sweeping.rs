//! The steps in which the flow of a `sweep` is integrated (spec/sweepers.md, A.3): poses, screws and reach of every
//! tool in each, found once per edit in 64 bits.
//!
//! # Differs from the source
//!
//! Angelidis, Wyvill and Cani (*Sweepers*, section 3.2) divide a path into s sub-steps p ↦ exp(φ(p)·L/s)·p, in each of
//! which the field φ stands still. Here a sweep is their limit, the flow of the weighted velocities.
//! - It depends on no s: at the smallest s of the paper the image of a point lies up to 1.1 coatings from the limit,
//!   and halves that only as s doubles. Part of a path and then the rest are the whole, so that `progress` animates.
//! - It has an inverse, the flow backwards, which is what a template evaluates. The paper has none (section 7).
//! - It folds nothing, whatever the tools and paths. Of a sub-step of one tool that can be proved where 1.875·|ξ| is
//!   less than the coating, ξ its way, for then det J = det E·(1 + ξ·∇φ) is above 0; by no smaller factor. For several
//!   tools the paper conjectures it (appendix A).
//! - Its steps are those of the integrator, so many to a coating travelled, and the paper's bounds for s are not used:
//!   (1) and 4.2 take the box about the coating at the first key, which is too small for a tool that grows, and by (3)
//!   a still thin coating inside a wide one that moves folds.
//! - The field is 1 inside too, and the distance is scaled by the cube root of the pose's determinant, whose exponent
//!   is lost in print: the coating keeps its width while a tool grows.

use super::clusters::clusters;
use super::facts::Given;
use super::mover::{Ball, Mover, counted_in, images_of, spans, wanted_in};
use super::tools::{MOST_STEPS, PathKey, SweepTool, SweepTools, ToolShape};
use crate::math::{Aabb, Screw, Similarity, smooth_path};
use glam::{DQuat, DVec3, Vec3};

/// Steps of a tool alone per width of its coating that it travels.
const STEPS_A_COAT: f64 = 6.0;
/// How much finer than to its width a sheared coating has to be known, for each coating of the way and of its stretch.
const SHEARED: f64 = 0.14;
/// Stages of a step: each asks for the field of every tool.
pub(super) const STAGES: usize = 4;
/// Fields that a cell of the skip grid may ask for, and parts of a cell along each side that may be asked about. So
/// lavapipe makes a grid of 48 cells a side of a sweep of a tool alone within 0.3 s.
const MOST_FIELDS: usize = 8_192;
const MOST_PARTS: u32 = 3;
/// A field of tools that act together takes so much longer than one of a tool alone, as measured.
const SHARED_WEIGHT: usize = 4;
/// Pieces of a curve that a turn asks about, as in shaders/displace/tools.wgsl.
const PIECES_AT_ONCE: usize = 4;
/// Reach is rounded up by this part of it, for floats of 32 bits.
pub(super) const ROUNDING: f64 = 1e-5;

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

/// One step: every tool of a cluster moves by one screw.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) start: f64,
    pub(super) end: f64,
    /// How many steps before this one are as long, and go by the same screws.
    pub(super) before: usize,
    /// For each tool what it reaches, its screw, and its pose at the start.
    pub(super) tools: Vec<(Ball, Screw, Similarity)>,
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

/// The flow of tools that act together, and the steps in which it is integrated.
#[derive(Clone, Debug)]
pub(super) struct ClusterFlow<'a> {
    pub(super) movers: Vec<Mover<'a>>,
    /// Signs of the axes of each image, and its tool among `movers`.
    pub(super) images: Vec<(DVec3, usize)>,
    /// Signs of the axes by which all of them are mirrored together; the first mirrors nothing.
    pub(super) copies: Vec<DVec3>,
    pub(super) steps: Vec<Step>,
}

/// How a `sweep` is evaluated.
#[derive(Clone, Debug)]
pub(crate) struct Sweeping<'a> {
    movers: Vec<Mover<'a>>,
    pub(super) mirror: [bool; 3],
    /// By clusters of tools: each copy of a cluster moves tissue that no other reaches.
    pub(super) flows: Vec<ClusterFlow<'a>>,
    size: DVec3,
}

impl<'a> Sweeping<'a> {
    /// The steps of tools in a box of this size.
    pub(crate) fn new(tools: &'a SweepTools, size: Vec3) -> Self {
        let mut sweeping = Self::still(tools, size);
        let all = clusters(&sweeping.movers, sweeping.mirror).into_iter();
        let flows = all.map(|cluster| {
            let movers = cluster.tools.iter().filter_map(|i| sweeping.movers.get(*i));
            ClusterFlow {
                movers: movers.cloned().collect(),
                images: cluster.images,
                copies: cluster.copies,
                steps: Vec::new(),
            }
        });
        let mut flows: Vec<ClusterFlow<'_>> = flows.collect();
        // Each is done in as many steps as is its share of those that are counted, as the sweeps of a document are.
        let counts: Vec<usize> = flows.iter().map(|f| counted_steps(&f.movers)).collect();
        let all: usize = counts.iter().sum();
        for (flow, count) in flows.iter_mut().zip(counts) {
            let most = (tools.most_steps * count).div_ceil(all.max(1));
            flow.make_steps(sweeping.mirror, most);
        }
        flows.retain(|flow| !flow.steps.is_empty());
        sweeping.flows = flows;
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
                flows: Vec::new(),
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
            flows: Vec::new(),
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
        [pieces, counted_steps(&sweeping.movers)]
    }

    /// The box outside which nothing moves until a time, metric local coordinates; empty if nothing moves at all.
    fn swept(&self, progress: f64) -> Aabb {
        let boxes = self.flows.iter().flat_map(|flow| flow.swept(progress));
        boxes.fold(Aabb::EMPTY, Aabb::union)
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
        let of_flow = |flow: &ClusterFlow<'_>| {
            let copies = flow.copies.iter();
            copies
                .map(|copy| flow.fields_at(*copy * place))
                .sum::<usize>()
        };
        self.flows.iter().map(of_flow).sum()
    }

    /// The longest way of any material until a time, subject units.
    pub(crate) fn longest(&self, progress: f32) -> f32 {
        let of_flow = |flow: &ClusterFlow<'_>| {
            let done = |step: &Step| {
                let part = (f64::from(progress) - step.start) / (step.end - step.start);
                step.travel * part.clamp(0.0, 1.0)
            };
            flow.steps.iter().map(done).sum::<f64>() as f32
        };
        self.flows.iter().map(of_flow).fold(0.0, f32::max)
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
        // No place is in the reach of two clusters.
        let of_place = self.flows.iter().map(|flow| {
            let weight = if flow.is_alone() { 1 } else { SHARED_WEIGHT };
            flow.fields() * weight
        });
        let of_place = of_place.max().unwrap_or(0);
        let is_few = |parts: &u32| (*parts as usize + 1).pow(3) * of_place <= MOST_FIELDS;
        (1..=MOST_PARTS).rev().find(is_few).unwrap_or(0)
    }
}

/// Steps as the limits of a document count them.
fn counted_steps(movers: &[Mover<'_>]) -> usize {
    let spans = spans(movers).into_iter();
    let of_span = |span| counted_in(movers, span).min(MOST_STEPS as f64) as usize;
    spans.map(of_span).sum()
}

/// A box mirrored by the signs of its axes; an empty one stays empty.
fn mirrored(own: Aabb, signs: DVec3) -> Aabb {
    if own.is_empty() {
        return own;
    }
    let [one, other] = [own.min, own.max].map(|corner| corner * signs.as_vec3());
    Aabb {
        min: one.min(other),
        max: one.max(other),
    }
}

impl ClusterFlow<'_> {
    /// Finds the steps, `most` of them where they can be so few.
    fn make_steps(&mut self, mirror: [bool; 3], most: usize) {
        let spans = spans(&self.movers);
        let wanted: Vec<f64> = spans
            .iter()
            .map(|span| wanted_in(&self.movers, mirror, *span, STEPS_A_COAT))
            .collect();
        // Where thin coatings of others ask for more than may be, each span still gets what its own tools ask for.
        let own = spans.iter().zip(&wanted);
        let own: Vec<f64> = own
            .map(|(span, wanted)| counted_in(&self.movers, *span).min(*wanted))
            .collect();
        let [least, all] = [&own, &wanted].map(|counts| counts.iter().sum::<f64>());
        let room = (most as f64 - least).max(0.0);
        let part = (room / (all - least).max(1.0)).min(1.0);
        for (((from, to), wanted), own) in spans.into_iter().zip(wanted).zip(own) {
            let count = libm::ceil(own + (wanted - own) * part);
            for i in 0..count as usize {
                let at = |i: usize| from + (to - from) * (i as f64 / count);
                self.step(at(i), at(i + 1), i);
            }
        }
    }

    /// Adds a step. `before`: how many steps of the same span come before it.
    fn step(&mut self, start: f64, end: f64, before: usize) {
        let travel = self.movers.iter().map(|mover| mover.travel(start, end));
        let travel = travel.fold(0.0, f64::max);
        // What is driven by one tool may come into the reach of another on the way.
        let room = if self.images.len() > 1 { travel } else { 0.0 };
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
    pub(super) fn is_alone(&self) -> bool {
        let is_curve = |mover: &Mover<'_>| matches!(mover.shape, ToolShape::Curve { .. });
        self.images.len() == 1 && !self.movers.iter().any(is_curve)
    }

    /// Turns of a loop, each for a field, that a place takes which all images reach in all steps.
    fn fields(&self) -> usize {
        let points = |tool: usize| (self.movers.get(tool)).map_or(0, |m| m.shape.points().len());
        let fields = self.images.iter().map(|(_, tool)| turns_of(points(*tool)));
        self.steps.len() * STAGES * fields.sum::<usize>()
    }

    /// Balls about what moves in a step, images too.
    fn moving(&self, step: &Step) -> Vec<Ball> {
        let images = self.images.iter().filter_map(|(image, tool)| {
            let (ball, screw, _) = step.tools.get(*tool)?;
            let middle = ball.middle * *image;
            (!screw.is_none()).then_some(Ball { middle, ..*ball })
        });
        images.collect()
    }

    /// A ball about the reach of all that moves in some steps, images too.
    pub(super) fn reach(&self, steps: &[Step]) -> Option<Ball> {
        let balls: Vec<Ball> = steps.iter().flat_map(|step| self.moving(step)).collect();
        Ball::around(&balls)
    }

    /// The boxes outside which its copies move nothing until a time, as [`Sweeping::swept`].
    pub(super) fn swept(&self, progress: f64) -> Vec<Aabb> {
        let steps = self.steps.iter().filter(|step| step.start < progress);
        let balls = steps.flat_map(|step| self.moving(step)).map(|ball| {
            let middle = ball.middle.as_vec3();
            let radius = (ball.radius * (1.0 + ROUNDING)) as f32;
            Aabb {
                min: middle - radius,
                max: middle + radius,
            }
        });
        let swept = balls.fold(Aabb::EMPTY, Aabb::union);
        let copies = self.copies.iter();
        copies.map(|signs| mirrored(swept, *signs)).collect()
    }

    /// As [`Sweeping::fields_at`], of the first copy, at a place in metric local coordinates.
    #[cfg(feature = "render")]
    fn fields_at(&self, place: DVec3) -> usize {
        let holds = |ball: &Ball, at: DVec3| ball.middle.distance(at) <= ball.radius;
        let of_step = |step: &Step| {
            let all = self.reach(std::slice::from_ref(step));
            if !all.is_some_and(|ball| holds(&ball, place)) {
                return 0;
            }
            let reaches = |(image, tool): &&(DVec3, usize)| {
                let ball = step.tools.get(*tool).map(|(ball, ..)| ball);
                ball.is_some_and(|ball| holds(ball, *image * place))
            };
            STAGES * self.images.iter().filter(reaches).count()
        };
        self.steps.iter().map(of_step).sum()
    }
}

/// Turns that the field of a tool takes: one, or one for each of the pieces of a curve, so many points, that are asked
/// at once.
pub(super) fn turns_of(points: usize) -> usize {
    let pieces = points.saturating_sub(1);
    pieces.div_ceil(PIECES_AT_ONCE).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wide coating past a thin one, twice and far apart: the clusters share the steps of the sweep.
    #[test]
    fn clusters_share_the_steps_of_their_sweep() {
        let ball = |radius: f32, coat: f32, keys: &[Vec3]| SweepTool {
            shape: Some(ToolShape::Ball { radius }),
            coat,
            path: keys.iter().map(|at| PathKey::at(*at)).collect(),
            ..SweepTool::default()
        };
        let pair = |y: f32| {
            let ends = [-3.5, 4.5].map(|x| Vec3::new(x, y, 0.5));
            let middle = [Vec3::new(0.5, y, 0.5)];
            [ball(0.15, 2.0, &ends), ball(0.005, 0.01, &middle)]
        };
        let tools = SweepTools {
            tools: [pair(-4.0), pair(5.0)].concat(),
            ..SweepTools::default()
        };
        let sweeping = Sweeping::new(&tools, Vec3::ONE);
        let steps: Vec<usize> = sweeping.flows.iter().map(|f| f.steps.len()).collect();
        assert_eq!(steps, [MOST_STEPS / 2; 2]);
    }
}
