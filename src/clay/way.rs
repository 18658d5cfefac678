//! Where the strokes of a clay carry a place of its starting shape, and back: for captions, which stay on their tissue.

use glam::DVec3;

use super::motion::{Motion, Step, around, is_in};
use crate::displace::Ball;
use crate::document::Clay;

/// Steps whose reach is looked at together.
const BLOCK: usize = 8;

/// The strokes of a clay as one map. Those that smooth or are left out carry nothing.
pub struct Way<'a> {
    strokes: Vec<Carried<'a>>,
}

/// A stroke, and what it reaches: all of it, and in blocks.
struct Carried<'a> {
    motion: Motion<'a>,
    steps: Vec<Step>,
    blocks: Vec<Vec<Ball>>,
    all: Vec<Ball>,
}

impl<'a> Way<'a> {
    /// The map of all strokes.
    pub fn of(clay: &'a Clay) -> Self {
        let acting = clay.strokes.iter();
        let acting = acting.filter(|stroke| !stroke.is_off && stroke.smooth.is_none());
        let carried = acting.filter_map(|stroke| {
            let motion = Motion::new(clay, stroke).ok()?;
            let times = motion.times().ok()?;
            let steps: Vec<Step> = times.iter().map(|time| motion.step(*time)).collect();
            Some(Carried {
                all: around(&steps),
                blocks: steps.chunks(BLOCK).map(around).collect(),
                motion,
                steps,
            })
        });
        Self {
            strokes: carried.collect(),
        }
    }

    /// Where a place of the starting shape is in the clay. Both in the clay's space.
    pub fn forward(&self, pos: DVec3) -> DVec3 {
        self.forward_with_normal(pos, DVec3::ZERO).0
    }

    /// As [`Way::forward`], with the normal of a surface there.
    pub fn forward_with_normal(&self, pos: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        let mut at = (pos, normal);
        for stroke in &self.strokes {
            if !is_in(&stroke.all, at.0) {
                continue;
            }
            for (steps, balls) in stroke.steps.chunks(BLOCK).zip(&stroke.blocks) {
                if !is_in(balls, at.0) {
                    continue;
                }
                for step in steps {
                    at = stroke.motion.carried(step, at.0, at.1);
                }
            }
        }
        at
    }

    /// Where a place of the clay was in the starting shape. Both in the clay's space.
    pub fn back(&self, pos: DVec3) -> DVec3 {
        let mut pos = pos;
        for stroke in self.strokes.iter().rev() {
            // What the stroke reaches it leaves there.
            if !is_in(&stroke.all, pos) {
                continue;
            }
            for (steps, balls) in stroke.steps.chunks(BLOCK).zip(&stroke.blocks).rev() {
                if !is_in(balls, pos) {
                    continue;
                }
                for step in steps.iter().rev() {
                    pos = stroke.motion.carried_back(step, pos);
                }
            }
        }
        pos
    }
}
