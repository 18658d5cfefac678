//! Where the strokes of a clay carry a place of its starting shape, and back: for captions, which stay on their tissue.

use glam::DVec3;

use super::motion::{Motion, Step, around, is_in};
use crate::data::Grids;
use crate::displace::Ball;
use crate::document::Clay;

/// Steps whose reach is looked at together.
const BLOCK: usize = 8;

/// The strokes of a clay as one map. Those that smooth or are left out carry nothing.
pub struct Way<'a> {
    strokes: Vec<Carried<'a>>,
}

/// A stroke, and what it reaches. Its steps are made when they are needed: those of all strokes would fill the memory.
struct Carried<'a> {
    motion: Motion<'a>,
    reach: Vec<Ball>,
}

impl<'a> Way<'a> {
    /// The map of all strokes, with tools of these grids.
    pub fn of(clay: &'a Clay, grids: &Grids) -> Self {
        let acting = clay.strokes.iter().enumerate();
        let acting = acting.filter(|(_, stroke)| !stroke.is_off && stroke.smooth.is_none());
        let carried = acting.filter_map(|stroke| {
            let motion = Motion::new(clay, stroke, grids).ok()?;
            motion.times().ok()?;
            Some(Carried {
                reach: motion.reach(),
                motion,
            })
        });
        Self {
            strokes: carried.collect(),
        }
    }

    /// Where places of the starting shape are in the clay, with the normals of a surface there, in the clay's space.
    pub fn forward(&self, vertices: &mut [(DVec3, DVec3)]) {
        for stroke in &self.strokes {
            stroke.each_block(false, vertices, |motion, steps, vertex| {
                for step in steps {
                    *vertex = motion.carried(step, vertex.0, vertex.1);
                }
            });
        }
    }

    /// Where a place of the starting shape is in the clay.
    pub fn forward_of(&self, pos: DVec3) -> DVec3 {
        let mut one = [(pos, DVec3::ZERO)];
        self.forward(&mut one);
        one[0].0
    }

    /// Where places of the clay were in the starting shape; their normals stay. Both in the clay's space.
    pub fn back(&self, vertices: &mut [(DVec3, DVec3)]) {
        for stroke in self.strokes.iter().rev() {
            stroke.each_block(true, vertices, |motion, steps, vertex| {
                for step in steps.iter().rev() {
                    vertex.0 = motion.carried_back(step, vertex.0);
                }
            });
        }
    }

    /// Where a place of the clay was in the starting shape.
    pub fn back_of(&self, pos: DVec3) -> DVec3 {
        let mut one = [(pos, DVec3::ZERO)];
        self.back(&mut one);
        one[0].0
    }
}

impl Carried<'_> {
    /// Does something with each block of steps and each vertex that it may move, in the order of time or against it.
    /// What a stroke reaches it leaves there, so that the others stay out of it.
    fn each_block(
        &self,
        is_back: bool,
        vertices: &mut [(DVec3, DVec3)],
        act: impl Fn(&Motion<'_>, &[Step], &mut (DVec3, DVec3)),
    ) {
        let reached = (0..vertices.len()).filter(|i| is_in(&self.reach, vertices[*i].0));
        let reached: Vec<usize> = reached.collect();
        if reached.is_empty() {
            return;
        }
        let times = self.motion.times().unwrap_or_default();
        let mut blocks: Vec<&[(f64, f64)]> = times.chunks(BLOCK).collect();
        if is_back {
            blocks.reverse();
        }
        for block in blocks {
            let steps: Vec<Step> = block.iter().map(|time| self.motion.step(*time)).collect();
            let balls = around(&steps);
            for i in &reached {
                if is_in(&balls, vertices[*i].0) {
                    act(&self.motion, &steps, &mut vertices[*i]);
                }
            }
        }
    }
}
