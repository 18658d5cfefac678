//! Tools on their way (spec/sweepers.md, A.1): poses, screws, and what is reached in a time. A `sweep` and the strokes
//! of a clay move the same tools.

use super::tools::{MOST_STEPS, ToolShape};
use crate::math::{Screw, Similarity};
use glam::DVec3;

/// Steps of a tool per width of its coating that it travels, where the reaches of several overlap.
const STEPS_A_COAT_OF_MANY: f64 = 8.0;

/// A tool on its way, in metric coordinates: of a `sweep` from the middle of the box, of a clay in its space.
#[derive(Clone, Debug)]
pub(crate) struct Mover<'a> {
    pub(crate) shape: &'a ToolShape,
    /// Subject units to a unit of the shape.
    pub(crate) unit: f64,
    /// Width of the coating, subject units.
    pub(crate) coat: f64,
    /// Farthest point of the tool from its origin at scale 1, subject units.
    pub(crate) farthest: f64,
    pub(crate) poses: Vec<Similarity>,
    pub(crate) screws: Vec<Screw>,
}

impl<'a> Mover<'a> {
    /// A tool that goes through these poses, at least one, in a time of 1. `unit`: subject units to one of the shape.
    pub(crate) fn new(shape: &'a ToolShape, unit: f64, coat: f64, poses: Vec<Similarity>) -> Self {
        let pieces = (poses.len() - 1) as f64;
        let screws = poses.windows(2).map(|pair| {
            let screw = pair[1].after(&pair[0].inverse()).log();
            screw.times(pieces)
        });
        Self {
            shape,
            unit,
            coat,
            farthest: f64::from(shape.farthest()) * unit,
            screws: screws.collect(),
            poses,
        }
    }

    /// The piece that holds a time, its screw in units of the whole time, and the pose then.
    pub(crate) fn at(&self, time: f64) -> (usize, Screw, Similarity) {
        let pieces = self.screws.len();
        let piece = ((time * pieces as f64) as usize).min(pieces.saturating_sub(1));
        self.at_in(piece, time)
    }

    /// As [`Mover::at`], of a piece that is known: at its end the next one begins.
    pub(crate) fn at_in(&self, piece: usize, time: f64) -> (usize, Screw, Similarity) {
        let Some(screw) = self.screws.get(piece) else {
            return (0, Screw::NONE, self.poses[0]);
        };
        let since = time - piece as f64 / self.screws.len() as f64;
        let pose = screw.times(since).exp().after(&self.poses[piece]);
        (piece, *screw, pose)
    }

    /// Radius of the tool with its coating about its origin.
    pub(crate) fn radius(&self, pose: &Similarity) -> f64 {
        self.farthest * pose.scale + self.coat
    }

    /// The longest way of a point of the tool with its coating from one time to another of one piece.
    pub(crate) fn travel(&self, from: f64, to: f64) -> f64 {
        let (piece, screw, _) = self.at(0.5 * (from + to));
        let fastest = [from, 0.5 * (from + to), to].map(|time| {
            let (_, _, pose) = self.at_in(piece, time);
            screw.velocity(pose.place).length() + screw.rate() * self.radius(&pose)
        });
        fastest.into_iter().fold(0.0, f64::max) * (to - from)
    }

    /// A ball that holds the tool with its coating from one time to another of one piece.
    pub(crate) fn ball(&self, from: f64, to: f64) -> Ball {
        let (piece, _, middle) = self.at(0.5 * (from + to));
        let mut radius = self.radius(&middle);
        for time in [from, to] {
            let (_, _, pose) = self.at_in(piece, time);
            let away = pose.place.distance(middle.place);
            radius = radius.max(self.radius(&pose) + away);
        }
        Ball {
            middle: middle.place,
            radius,
        }
    }
}

/// A ball, metric coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(crate) middle: DVec3,
    pub(crate) radius: f64,
}

impl Ball {
    /// A ball around several.
    pub(crate) fn around(balls: &[Self]) -> Option<Self> {
        let least = balls.iter().map(|b| b.middle - b.radius);
        let most = balls.iter().map(|b| b.middle + b.radius);
        let middle = 0.5 * (least.reduce(DVec3::min)? + most.reduce(DVec3::max)?);
        let far = balls.iter().map(|b| b.middle.distance(middle) + b.radius);
        Some(Self {
            middle,
            radius: far.fold(0.0, f64::max),
        })
    }
}

/// Signs of the axes of each image in these mirrors, the tools themselves first.
pub(crate) fn images_of(mirror: [bool; 3]) -> Vec<DVec3> {
    let mut images = vec![DVec3::ONE];
    for axis in (0..3).filter(|axis| mirror[*axis]) {
        let other = images.clone().into_iter().map(|mut signs| {
            signs[axis] = -1.0;
            signs
        });
        images.extend(other);
    }
    images
}

/// From break to break: times at which any tool goes over from one screw to another.
pub(crate) fn spans(movers: &[Mover<'_>]) -> Vec<(f64, f64)> {
    let mut breaks: Vec<f64> = Vec::new();
    for mover in movers {
        let pieces = mover.screws.len();
        let all = (0..=pieces).filter(|_| pieces > 0);
        breaks.extend(all.map(|k| k as f64 / pieces as f64));
    }
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    breaks.windows(2).map(|pair| (pair[0], pair[1])).collect()
}

/// The coatings that a tool travels in a span: of the one that travels the most of its own.
pub(crate) fn coats_in(movers: &[Mover<'_>], (from, to): (f64, f64)) -> f64 {
    let of_tool = movers.iter();
    let of_tool = of_tool.map(|mover| mover.travel(from, to) / mover.coat);
    of_tool.fold(0.0, f64::max)
}

/// Steps of a span as the limits of documents count them; they may be more than [`MOST_STEPS`].
pub(crate) fn counted_in(movers: &[Mover<'_>], span: (f64, f64)) -> f64 {
    libm::ceil(STEPS_A_COAT_OF_MANY * coats_in(movers, span))
}

/// Steps that a span takes, `alone` for each coating that a tool travels which meets no other; at most [`MOST_STEPS`].
pub(crate) fn wanted_in(
    movers: &[Mover<'_>],
    mirror: [bool; 3],
    span: (f64, f64),
    alone: f64,
) -> f64 {
    let asked = asked_in(movers, mirror, span, alone);
    libm::ceil(asked.min(MOST_STEPS as f64))
}

/// As [`wanted_in`], neither rounded up nor limited.
pub(crate) fn asked_in(
    movers: &[Mover<'_>],
    mirror: [bool; 3],
    (from, to): (f64, f64),
    alone: f64,
) -> f64 {
    let balls: Vec<Ball> = movers.iter().map(|m| m.ball(from, to)).collect();
    let images = images_of(mirror);
    let mut wanted = 0.0_f64;
    for (i, mover) in movers.iter().enumerate() {
        let mut per_travel = alone / mover.coat;
        for (j, other) in movers.iter().enumerate() {
            // With images of itself too.
            for (n, image) in images.iter().enumerate() {
                let apart = balls[i].middle.distance(*image * balls[j].middle);
                let is_other = i != j || n > 0;
                if is_other && apart < balls[i].radius + balls[j].radius {
                    let coat = mover.coat.min(other.coat);
                    per_travel = per_travel.max(STEPS_A_COAT_OF_MANY / coat);
                }
            }
        }
        wanted = wanted.max(mover.travel(from, to) * per_travel);
    }
    wanted
}
