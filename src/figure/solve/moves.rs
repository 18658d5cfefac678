use glam::DVec2;

use super::hold::{Grip, GripKind, Holding};
use super::line::{BentLine, Target};
use super::rigid::Parts;
use crate::document::figure::{Figure, Handle, Hold};
use crate::figure::complex::{arg, conj_mul, mul, polar};
use crate::figure::mesh::Mesh;
use crate::figure::notice::Notice;

/// Handles of one rigid part are named if the nearest rigid motion misses one by more than this, figure units.
const MISFIT: f64 = 0.01;

/// Where handles take what they hold, for one base shape and one pose. Built in every frame.
#[derive(Clone, Debug)]
pub(crate) struct Moved {
    /// Per vertex where it is taken; its base place if nothing holds it.
    pub(crate) places: Vec<DVec2>,
    /// Per vertex turn and log scale of what holds it; 0 if nothing does.
    pub(crate) spins: Vec<[f64; 2]>,
    /// Point handles whose turns are open, with what they hold.
    pub(crate) open: Vec<OpenPin>,
}

/// A point handle without a turn.
#[derive(Clone, Debug)]
pub(crate) struct OpenPin {
    /// Number of its grip.
    pub(crate) grip: u32,
    /// The vertices that turn with it.
    pub(crate) vertices: Vec<u32>,
    /// Its anchor in the base shape.
    pub(crate) pivot: DVec2,
    /// Where the anchor is taken.
    pub(crate) place: DVec2,
    /// The factor that it is scaled by.
    pub(crate) scale: f64,
    /// The turn that is guessed from other handles.
    pub(crate) turn: f64,
}

/// What a grip does to its anchor, and its turn and scale.
#[derive(Clone, Copy, Debug)]
struct Motion {
    before: DVec2,
    after: DVec2,
    turn: Option<f64>,
    scale: f64,
}

impl Moved {
    /// Nothing is moved: every vertex stays in a base shape.
    pub(crate) fn none(base: &[DVec2]) -> Self {
        Self {
            places: base.to_vec(),
            spins: vec![[0.0; 2]; base.len()],
            open: Vec::new(),
        }
    }

    /// Where the handles of a figure take what they hold in a base shape.
    pub(crate) fn new(
        mesh: &Mesh,
        parts: &Parts,
        holding: &Holding,
        figure: &Figure,
        base: &[DVec2],
        notices: &mut Vec<Notice>,
    ) -> Self {
        let mut moved = Self::none(base);
        let motions: Vec<Motion> = holding
            .grips
            .iter()
            .map(|grip| motion(mesh, grip, figure, base))
            .collect();
        let held = holding.held();
        for (number, grip) in (0_u32..).zip(&holding.grips) {
            let vertices = &held[number as usize];
            if let Some(line) = line_of(mesh, grip, figure, base) {
                for vertex in vertices {
                    moved.set(*vertex, line.target(base[*vertex as usize]));
                }
                continue;
            }
            let mut motion = motions[number as usize];
            let pins = grip
                .part
                .map(|part| holding.pins_of(part))
                .unwrap_or_default();
            if pins.len() > 1 && pins[0] == number {
                let (fitted, by) = fit(&pins, &motions);
                motion = fitted;
                if let (true, Some(part)) = (by > MISFIT, grip.part) {
                    let tissue = parts.parts[part as usize].tissue;
                    notices.push(Notice::BoneMisfit {
                        region: mesh.tissues[usize::from(tissue)].name.clone(),
                        by,
                    });
                }
            }
            let is_open =
                grip.kind == GripKind::Point && motion.turn.is_none() && !vertices.is_empty();
            let turn = motion
                .turn
                .unwrap_or_else(|| guess(number, holding, &motions));
            let z = polar(motion.scale, turn);
            let log_scale = libm::log(motion.scale);
            for vertex in vertices {
                let place = motion.after + mul(z, base[*vertex as usize] - motion.before);
                let target = if grip.kind == GripKind::Outside || grip.handle.is_none() {
                    Target {
                        place: base[*vertex as usize],
                        turn: 0.0,
                        log_scale: 0.0,
                    }
                } else {
                    Target {
                        place,
                        turn,
                        log_scale,
                    }
                };
                moved.set(*vertex, target);
            }
            if is_open {
                moved.open.push(OpenPin {
                    grip: number,
                    vertices: vertices.clone(),
                    pivot: motion.before,
                    place: motion.after,
                    scale: motion.scale,
                    turn,
                });
            }
        }
        moved
    }

    pub(crate) fn set(&mut self, vertex: u32, target: Target) {
        self.places[vertex as usize] = target.place;
        self.spins[vertex as usize] = [target.turn, target.log_scale];
    }
}

fn handle<'a>(grip: &Grip, figure: &'a Figure) -> Option<&'a Handle> {
    grip.handle.and_then(|index| figure.handles.get(index))
}

/// What a grip does to its anchor; a fixed region does nothing.
fn motion(mesh: &Mesh, grip: &Grip, figure: &Figure, base: &[DVec2]) -> Motion {
    let before = grip
        .anchors
        .first()
        .map_or(DVec2::ZERO, |anchor| anchor.carried(mesh, base));
    let still = Motion {
        before,
        after: before,
        turn: Some(0.0),
        scale: 1.0,
    };
    let Some(handle) = handle(grip, figure) else {
        return still;
    };
    if let Hold::Line { to: Some(to), .. } = &handle.hold {
        return Motion {
            after: to.first().copied().unwrap_or(before),
            ..still
        };
    }
    let is_point = grip.kind == GripKind::Point;
    Motion {
        before,
        after: before + handle.motion.by,
        turn: if is_point {
            handle.motion.turn
        } else {
            Some(handle.motion.turn.unwrap_or(0.0))
        },
        scale: handle.motion.scale,
    }
}

/// The line of a handle that says where its points go.
pub(crate) fn line_of(
    mesh: &Mesh,
    grip: &Grip,
    figure: &Figure,
    base: &[DVec2],
) -> Option<BentLine> {
    let Hold::Line {
        points,
        to: Some(to),
    } = &handle(grip, figure)?.hold
    else {
        return None;
    };
    // Points that are equal at rest are left out there: carried, they are equal too.
    debug_assert_eq!(points.len(), grip.anchors.len(), "an anchor for each point");
    let carried: Vec<DVec2> = grip
        .anchors
        .iter()
        .map(|anchor| anchor.carried(mesh, base))
        .collect();
    Some(BentLine::new(&carried, to))
}

/// The turn of an open pin as the other handles suggest it: near ones count most.
fn guess(number: u32, holding: &Holding, motions: &[Motion]) -> f64 {
    let own = motions[number as usize];
    let mut sum = DVec2::ZERO;
    for (i, (grip, other)) in holding.grips.iter().zip(motions).enumerate() {
        let (a, b) = (other.before - own.before, other.after - own.after);
        let square = a.length_squared();
        if i != number as usize && grip.kind != GripKind::Outside && square > 0.0 {
            sum += conj_mul(a, b) / (square * square);
        }
    }
    arg(sum)
}

/// The rigid motion nearest to what several pins do to their anchors, with the scale of the first; and by how much it
/// misses the worst.
fn fit(pins: &[u32], motions: &[Motion]) -> (Motion, f64) {
    let of = |pin: &u32| motions[*pin as usize];
    let n = pins.len() as f64;
    let before = pins.iter().map(|pin| of(pin).before).sum::<DVec2>() / n;
    let after = pins.iter().map(|pin| of(pin).after).sum::<DVec2>() / n;
    let first = of(&pins[0]);
    let products = pins
        .iter()
        .map(|pin| conj_mul(of(pin).before - before, of(pin).after - after));
    let sum = products.sum::<DVec2>();
    // Pins at one place say nothing of a turn.
    let turn = if sum.length_squared() > 1e-24 {
        arg(sum)
    } else {
        first.turn.unwrap_or(0.0)
    };
    let z = polar(first.scale, turn);
    let miss = |pin: &u32| (after + mul(z, of(pin).before - before)).distance(of(pin).after);
    let fitted = Motion {
        before,
        after,
        turn: Some(turn),
        scale: first.scale,
    };
    (fitted, pins.iter().map(miss).fold(0.0, f64::max))
}
