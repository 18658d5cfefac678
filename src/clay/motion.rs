//! How a stroke moves what is near its tools: the flow of a sweep in 64 bits, with the normals of surfaces in it
//! (spec/sweepers.md, A.1 and B.2). Places are in the clay's space.

use glam::{DMat3, DVec3};

use super::field::{Form, falloff};
use super::mesh::Vertex;
use crate::data::Grids;
use crate::displace::{
    Ball, MOST_STEPS, Mover, asked_in, coats_in, counted_in, images_of, spans, wanted_in,
};
use crate::document::{Clay, ClayKey, ClayMove, ClayStroke};
use crate::math::{Screw, Similarity, smooth_path};

/// Steps of a tool per width of its coating that it travels.
const STEPS_A_COAT: f64 = 8.0;
/// Half a unit of rounding of balls, as a part of their radius.
const ROUNDING: f64 = 1e-9;

/// Parts of a span in which a way is measured closely.
const FINE_PARTS: usize = 64;

/// Why a stroke does nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LeftOut {
    /// It names a tool that is not there, or one of a shape that this version does not have.
    #[error("tool {0} is not there or of a shape that is not known")]
    NoTool(usize),
    /// Its tool is made of it or of later strokes.
    #[error("tool {0} is made of this stroke or of later ones")]
    OfItself(usize),
    /// The mesh of its tool is not there: nothing is held.
    #[error("the mesh of tool {0} is not there")]
    NoMesh(usize),
    /// Its way is too long for its coating.
    #[error("it takes {steps} steps, more than {MOST_STEPS}")]
    TooLong {
        /// Steps that it would take.
        steps: usize,
    },
}

/// The tools of a stroke on their ways.
pub(super) struct Motion<'a> {
    movers: Vec<Mover<'a>>,
    forms: Vec<Form>,
    images: Vec<DVec3>,
    /// 0 along the axes that are mirrored, where a point of the plane stays.
    mirrored: [bool; 3],
}

/// A time from one to another in which every tool moves by one screw.
pub(super) struct Step {
    /// The tools at the start, in the middle and at the end.
    stages: [Vec<Pose>; 3],
    lasts: f64,
    /// What the tools reach, images too.
    pub(super) balls: Vec<Ball>,
    /// The longest way of a point of any tool.
    pub(super) travel: f64,
}

/// A tool at one moment.
struct Pose {
    /// From the space to the tool's own frame, as far as it turns.
    turn_back: DMat3,
    turn: DMat3,
    place: DVec3,
    per_scale: f64,
    /// Coatings in a unit of the tool's own frame.
    coats: f64,
    coat: f64,
    screw: Screw,
    /// Square of the radius of what the tool reaches about its place.
    reach: f64,
}

/// A tool that has a point in its reach.
#[derive(Clone, Copy)]
struct Hold {
    field: f64,
    gradient: DVec3,
    velocity: DVec3,
    /// Velocity of a normal that goes with the tool.
    turned: DVec3,
}

impl Hold {
    const NONE: Self = Self {
        field: 0.0,
        gradient: DVec3::ZERO,
        velocity: DVec3::ZERO,
        turned: DVec3::ZERO,
    };

    /// Velocity of the point, and of the normal there, if no other tool has it.
    fn alone(&self, normal: DVec3) -> (DVec3, DVec3) {
        let turned = self.turned * self.field - self.gradient * self.velocity.dot(normal);
        (self.velocity * self.field, turned)
    }
}

impl Pose {
    /// How the tool, or its image, holds a point and the normal there; `None` if it does not reach it.
    fn hold(&self, form: &Form, image: DVec3, pos: DVec3, normal: DVec3) -> Option<Hold> {
        let (p, n) = (image * pos, image * normal);
        let way = p - self.place;
        if way.length_squared() > self.reach {
            return None;
        }
        let q = (self.turn_back * way) * self.per_scale;
        let (distance, away) = form.distance(q);
        let (field, slope) = falloff(distance * self.coats);
        if field <= 0.0 {
            return None;
        }
        let screw = &self.screw;
        Some(Hold {
            field,
            gradient: image * (self.turn * away) * (slope / self.coat),
            velocity: image * screw.velocity(p),
            turned: image * (screw.turn.cross(n) - n * screw.growth),
        })
    }
}

/// The poses of a tool's way.
fn poses_of(way: &ClayMove) -> Vec<Similarity> {
    let keys = ClayKey::poses(&way.keys);
    if way.is_straight {
        keys
    } else {
        smooth_path(&keys)
    }
}

impl<'a> Motion<'a> {
    /// The tools of a stroke and its place in the list. A mesh that is not there holds nothing.
    ///
    /// # Errors
    /// If one of them is not in the list of tools, or made of the stroke or of later ones.
    pub(super) fn new(
        clay: &'a Clay,
        (index, stroke): (usize, &ClayStroke),
        grids: &Grids,
    ) -> Result<Self, LeftOut> {
        let movers = stroke.moves.iter().map(|way| {
            let tool = clay.tools.get(way.tool);
            if tool.is_some_and(|tool| !tool.is_made_before(index)) {
                return Err(LeftOut::OfItself(way.tool));
            }
            let shape = tool.and_then(|tool| tool.shape.as_ref().map(|shape| (shape, tool.coat)));
            let (shape, coat) = shape.ok_or(LeftOut::NoTool(way.tool))?;
            Ok(Mover::new(shape, 1.0, coat, poses_of(way)))
        });
        let movers = movers.collect::<Result<Vec<_>, _>>()?;
        let forms = movers.iter().map(|mover| Form::new(mover.shape, grids));
        Ok(Self {
            forms: forms.collect(),
            images: images_of(stroke.mirror),
            mirrored: stroke.mirror,
            movers,
        })
    }

    /// The place among the tools of the stroke of one that is not there.
    pub(super) fn absent(&self) -> Option<usize> {
        let mut forms = self.forms.iter();
        forms.position(|form| matches!(form, Form::Absent))
    }

    /// The times of all steps: in each no tool goes farther than an eighth of its coating.
    ///
    /// # Errors
    /// If they are more than [`MOST_STEPS`].
    pub(super) fn times(&self) -> Result<Vec<(f64, f64)>, LeftOut> {
        let spans = spans(&self.movers);
        let count = |steps: &dyn Fn((f64, f64)) -> f64| -> Vec<f64> {
            spans.iter().map(|span| steps(*span)).collect()
        };
        let is_few = |counts: &[f64]| counts.iter().sum::<f64>() <= MOST_STEPS as f64;
        let counted = count(&|span| counted_in(&self.movers, span));
        if !is_few(&counted) {
            let steps = counted.iter().sum::<f64>() as usize;
            return Err(LeftOut::TooLong { steps });
        }
        // A thin coating in the way of a wide one asks for more steps than the limit counts.
        let wanted = count(&|span| wanted_in(&self.movers, self.mirrored, span, STEPS_A_COAT));
        let counts = if is_few(&wanted) { wanted } else { counted };
        let counts: Vec<usize> = counts.iter().map(|count| *count as usize).collect();
        Ok(parts(&spans, &counts))
    }

    /// The fewest steps in which no tool goes farther than an eighth of its coating: by the way itself, of which
    /// [`Motion::times`] takes the fastest moment of each span.
    pub(super) fn fewest(&self) -> usize {
        let of_span = |span: (f64, f64)| {
            let asked = parts(&[span], &[FINE_PARTS]).into_iter();
            let asked = asked.map(|part| asked_in(&self.movers, self.mirrored, part, STEPS_A_COAT));
            // Rounding makes no further step.
            libm::ceil(asked.sum::<f64>() - ROUNDING) as usize
        };
        spans(&self.movers).into_iter().map(of_span).sum()
    }

    /// What the tools reach on their whole way, images too: balls about each tool in each span.
    pub(super) fn reach(&self) -> Vec<Ball> {
        let spans = spans(&self.movers);
        let steps: Vec<Step> = spans.iter().map(|span| self.step(*span)).collect();
        steps.into_iter().flat_map(|step| step.balls).collect()
    }

    /// The times at which a stroke that smooths does so: the start, and every half coating of the way, whatever the
    /// keys are that the way is told by.
    ///
    /// # Errors
    /// If the way is longer than the steps of a stroke allow.
    pub(super) fn moments(&self) -> Result<Vec<(f64, f64)>, LeftOut> {
        self.times()?;
        let spans = spans(&self.movers);
        // Halves of a coating.
        let ways = spans.iter().map(|span| 2.0 * coats_in(&self.movers, *span));
        let ways: Vec<f64> = ways.collect();
        let all: f64 = ways.iter().sum();
        let count = libm::ceil(all - ROUNDING) as usize;
        let mut moments = vec![(0.0, 0.0)];
        // The part of the whole way at which a span begins.
        let mut begin = 0.0;
        for ((from, to), way) in spans.into_iter().zip(ways) {
            let share = way / all;
            while moments.len() <= count {
                let part = moments.len() as f64 / count as f64;
                if part > begin + share + ROUNDING {
                    break;
                }
                let time = from + (to - from) * ((part - begin) / share).min(1.0);
                moments.push((time, time));
            }
            begin += share;
        }
        Ok(moments)
    }

    /// The step from one time to another of one span.
    pub(super) fn step(&self, (from, to): (f64, f64)) -> Step {
        let middle = 0.5 * (from + to);
        let stages = [from, middle, to].map(|time| {
            let poses = self.movers.iter().map(|mover| {
                let (piece, ..) = mover.at(middle);
                let (_, screw, pose) = mover.at_in(piece, time);
                let turn = DMat3::from_quat(pose.turn);
                let reach = mover.radius(&pose);
                Pose {
                    turn_back: turn.transpose(),
                    turn,
                    place: pose.place,
                    per_scale: 1.0 / pose.scale,
                    coats: pose.scale / mover.coat,
                    coat: mover.coat,
                    screw,
                    reach: reach * reach * (1.0 + ROUNDING),
                }
            });
            poses.collect()
        });
        let travel = self.movers.iter().map(|mover| mover.travel(from, to));
        let travel = travel.fold(0.0, f64::max);
        // What is driven by one tool may come into the reach of another on the way.
        let is_alone = self.movers.len() * self.images.len() == 1;
        let room = if is_alone { 0.0 } else { travel };
        let mut balls = Vec::new();
        for mover in &self.movers {
            let ball = mover.ball(from, to);
            balls.extend(self.images.iter().map(|image| Ball {
                middle: ball.middle * *image,
                radius: (ball.radius + room) * (1.0 + ROUNDING),
            }));
        }
        Step {
            stages,
            lasts: to - from,
            balls,
            travel,
        }
    }

    /// Velocity of a place, and of a normal that is carried along: n′ = −(∇V)ᵀ n.
    fn flow(&self, stage: &[Pose], pos: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        // A tool alone is what most strokes have.
        if let ([pose], [form], [image]) = (stage, &self.forms[..], &self.images[..]) {
            let hold = pose.hold(form, *image, pos, normal);
            return hold.map_or((DVec3::ZERO, DVec3::ZERO), |hold| hold.alone(normal));
        }
        let mut holds = [Hold::NONE; Clay::MAX_AT_ONCE];
        let mut count = 0;
        for image in &self.images {
            for (pose, form) in stage.iter().zip(&self.forms) {
                if count < holds.len()
                    && let Some(hold) = pose.hold(form, *image, pos, normal)
                {
                    holds[count] = hold;
                    count += 1;
                }
            }
        }
        match &holds[..count] {
            [] => (DVec3::ZERO, DVec3::ZERO),
            [one] => one.alone(normal),
            several => together(several, normal),
        }
    }

    /// Where a step takes a place and the normal there (classical Runge and Kutta). The same bits where no tool is.
    pub(super) fn carried(&self, step: &Step, pos: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        let [start, middle, end] = &step.stages;
        self.integrated([start, middle, end], step.lasts, pos, normal)
    }

    /// Where a place was before a step.
    pub(super) fn carried_back(&self, step: &Step, pos: DVec3) -> DVec3 {
        let [start, middle, end] = &step.stages;
        self.integrated([end, middle, start], -step.lasts, pos, DVec3::ZERO)
            .0
    }

    fn integrated(
        &self,
        [start, middle, end]: [&[Pose]; 3],
        lasts: f64,
        pos: DVec3,
        normal: DVec3,
    ) -> (DVec3, DVec3) {
        let half = 0.5 * lasts;
        let at = |stage: &[Pose], by: f64, rate: &(DVec3, DVec3)| {
            let (p, n) = (self.stays(pos, by * rate.0), normal + by * rate.1);
            self.flow(stage, pos + p, n)
        };
        let first = self.flow(start, pos, normal);
        let second = at(middle, half, &first);
        let third = at(middle, half, &second);
        let fourth = at(end, lasts, &third);
        let sum = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| a + 2.0 * (b + c) + d;
        let sixth = lasts / 6.0;
        let moved = self.stays(pos, sixth * sum(first.0, second.0, third.0, fourth.0));
        let turned = sixth * sum(first.1, second.1, third.1, fourth.1);
        if moved == DVec3::ZERO && turned == DVec3::ZERO {
            return (pos, normal);
        }
        (pos + moved, (normal + turned).normalize_or(normal))
    }

    /// A way from a place, without what would lead out of a mirror plane.
    fn stays(&self, pos: DVec3, mut way: DVec3) -> DVec3 {
        for axis in 0..3 {
            if self.mirrored[axis] && pos[axis] == 0.0 {
                way[axis] = 0.0;
            }
        }
        way
    }

    /// As [`Motion::carried`], of a vertex, which is rounded to the floats in which it is kept.
    pub(super) fn moved(&self, step: &Step, vertex: &Vertex) -> Vertex {
        let (pos, normal) = self.carried(step, vertex.pos(), vertex.normal());
        Vertex::new(pos, normal)
    }

    /// All fields together at the start of a step.
    pub(super) fn field(&self, step: &Step, pos: DVec3) -> f64 {
        let mut left = 1.0;
        for image in &self.images {
            for (pose, form) in step.stages[0].iter().zip(&self.forms) {
                let q = (pose.turn_back * (*image * pos - pose.place)) * pose.per_scale;
                left *= 1.0 - falloff(form.distance(q).0 * pose.coats).0;
            }
        }
        1.0 - left
    }

    /// Distance of a place from what the tools reach in a step, at most too small by what they travel; 0 within.
    pub(super) fn beyond_reach(&self, step: &Step, pos: DVec3) -> f64 {
        let mut least = f64::INFINITY;
        for stage in &step.stages {
            for image in &self.images {
                for (pose, form) in stage.iter().zip(&self.forms) {
                    let q = (pose.turn_back * (*image * pos - pose.place)) * pose.per_scale;
                    let coats = form.distance(q).0 * pose.coats;
                    least = least.min((coats - 1.0) * pose.coat);
                }
            }
        }
        (least - 0.25 * step.travel).max(0.0)
    }
}

/// Spans in equal parts.
fn parts(spans: &[(f64, f64)], counts: &[usize]) -> Vec<(f64, f64)> {
    let mut times = Vec::new();
    for ((from, to), count) in spans.iter().zip(counts) {
        let at = |i: usize| from + (to - from) * (i as f64 / *count as f64);
        times.extend((0..*count).map(|i| (at(i), at(i + 1))));
    }
    times
}

/// The flow of several tools at once, by the weights of the paper's equation 2.
fn together(holds: &[Hold], normal: DVec3) -> (DVec3, DVec3) {
    let fields: f64 = holds.iter().map(|hold| hold.field).sum();
    let left: f64 = holds.iter().map(|hold| 1.0 - hold.field).product();
    let share = 1.0 - left;
    let all: DVec3 = holds.iter().map(|hold| hold.gradient).sum();
    let mut of_share = DVec3::ZERO;
    for (j, hold) in holds.iter().enumerate() {
        let others = holds.iter().enumerate().filter(|(k, _)| *k != j);
        of_share += hold.gradient * others.map(|(_, other)| 1.0 - other.field).product::<f64>();
    }
    let (mut velocity, mut turned) = (DVec3::ZERO, DVec3::ZERO);
    for hold in holds {
        let weight = share * hold.field / fields;
        let gradient = of_share * (hold.field / fields)
            + (hold.gradient * fields - all * hold.field) * (share / (fields * fields));
        velocity += hold.velocity * weight;
        turned += hold.turned * weight - gradient * hold.velocity.dot(normal);
    }
    (velocity, turned)
}

/// A ball of balls: what several steps reach, tool by tool.
pub(super) fn around(steps: &[Step]) -> Vec<Ball> {
    let count = steps.first().map_or(0, |step| step.balls.len());
    let of_tool = |i: usize| {
        let balls: Vec<Ball> = steps.iter().map(|step| step.balls[i]).collect();
        Ball::around(&balls)
    };
    (0..count).filter_map(of_tool).collect()
}

/// True if a place lies in one of some balls.
pub(super) fn is_in(balls: &[Ball], pos: DVec3) -> bool {
    balls
        .iter()
        .any(|ball| ball.middle.distance_squared(pos) <= ball.radius * ball.radius)
}
