//! Strokes shape a mesh, step by step (spec/sweepers.md, B.1 and B.2). The same recipe gives the same mesh, bit for
//! bit, on every machine: 64-bit floats, only what IEEE 754 rounds exactly and functions of `libm`, one fixed order.

use std::collections::BinaryHeap;
use std::sync::Arc;

use glam::DVec3;

use super::error::ClayError;
use super::mesh::{ClayMesh, Vertex};
use super::motion::{LeftOut, Motion, Step, around, is_in};
use super::refine::{Carry, MAX_TRIANGLES, Stepping, Work};
use super::roomy::Roomy;
use super::smooth;
use super::space::Space;
use super::start;
use crate::data::{DistanceGrid, Grids};
use crate::displace::ToolShape;
use crate::document::{Clay, ClayStart};

/// Steps whose reach is looked at together, and blocks of them.
const BLOCK: usize = 8;
const WIDE: usize = 64;
/// Most strokes that are named one by one.
const MOST_NOTICES: usize = 4;
/// Rounds in which a starting shape gets edges that strokes would leave as they are.
const ROUNDS: usize = 8;

/// A clay that is being shaped.
#[derive(Clone, Debug)]
pub struct Shaping {
    pub(super) mesh: ClayMesh,
    pub(super) after: Roomy<Vertex>,
    pub(super) moved_in: Roomy<u32>,
    pub(super) turned_in: Roomy<u32>,
    space: Space,
    /// Number of the step, over all strokes.
    number: u32,
    pub(super) detail: f64,
    /// The vertices that the last stroke moved.
    pub(super) touched: Roomy<bool>,
    /// Strokes that did nothing, and why.
    left_out: Vec<(usize, LeftOut)>,
    /// The stroke since which there were too many triangles to split edges.
    full_since: Option<usize>,
    /// What was done to the file that it was made of, in words.
    pub(super) start_notices: Vec<String>,
    done: usize,
    work: Work,
    /// Those of tools that are meshes, and of itself after as many strokes as its baked tools are made of.
    grids: Grids,
    /// No triangle has an edge longer than the detail; false where that is not known.
    is_fine: bool,
}

/// The motion in one step.
struct Moved<'a> {
    motion: &'a Motion<'a>,
    step: &'a Step,
}

impl Carry for Moved<'_> {
    fn carry(&self, vertex: &Vertex) -> Vertex {
        self.motion.moved(self.step, vertex)
    }
}

/// Nothing moves.
pub(super) struct Still;

impl Carry for Still {
    fn carry(&self, vertex: &Vertex) -> Vertex {
        *vertex
    }
}

/// The vertices that may move in the steps to come.
#[derive(Default)]
struct Candidates {
    wide: Vec<u32>,
    near: Vec<u32>,
}

impl Shaping {
    /// The built-in starting shape of a clay; what begins with a file or with a volume is made by
    /// [`Shaping::of_mesh`] and [`Shaping::of_volume`].
    ///
    /// # Errors
    /// If this version does not know it, or it is no shape.
    pub fn new(clay: &Clay) -> Result<Self, ClayError> {
        let shape = match &clay.from {
            ClayStart::Shape(shape) => *shape,
            ClayStart::Mesh(_) => return Err(ClayError::NoFile),
            ClayStart::Volume(_) => return Err(ClayError::NoVoxels),
            ClayStart::Unknown(name) => return Err(ClayError::UnknownStart(name.clone())),
        };
        let (vertices, triangles) = start::shape(shape, clay.detail);
        // The built-in shapes are closed surfaces, which a test holds.
        let mut shaping = ClayMesh::new(vertices, triangles)
            .map(|mesh| Self::of(mesh, Space::default(), clay.detail))
            .ok_or_else(|| ClayError::UnknownStart("shape".to_owned()))?;
        if clay.detail >= start::FINEST {
            shaping.settle();
        }
        Ok(shaping)
    }

    /// A clay of this mesh, which no stroke has touched.
    pub(super) fn of(mesh: ClayMesh, space: Space, detail: f64) -> Self {
        let mut shaping = Self {
            after: mesh.vertices.clone(),
            moved_in: vec![0; mesh.vertices.len()].into(),
            turned_in: vec![0; mesh.vertices.len()].into(),
            touched: vec![false; mesh.vertices.len()].into(),
            mesh,
            space,
            number: 0,
            detail,
            left_out: Vec::new(),
            full_since: None,
            start_notices: Vec::new(),
            done: 0,
            work: Work::default(),
            grids: Grids::default(),
            is_fine: false,
        };
        // So that the first stroke has no more to look at than those after it.
        shaping.is_fine = shaping.long_triangles().is_empty();
        shaping
    }

    /// All but the mesh and what follows its vertices.
    pub(super) fn without_lists(&self) -> Self {
        Self {
            mesh: ClayMesh::default(),
            after: Roomy::default(),
            moved_in: Roomy::default(),
            turned_in: Roomy::default(),
            touched: Roomy::default(),
            space: self.space,
            left_out: self.left_out.clone(),
            start_notices: self.start_notices.clone(),
            work: self.work,
            grids: self.grids.clone(),
            ..*self
        }
    }

    /// This one with the grids of tools that are meshes.
    #[must_use]
    pub fn with_meshes(mut self, files: &[(String, Arc<DistanceGrid>)]) -> Self {
        self.grids.files = files.to_vec();
        self
    }

    /// The grids of its tools, as far as they are there.
    pub fn grids(&self) -> &Grids {
        &self.grids
    }

    /// True if a stroke that is still to come has a tool made of this clay as it stood earlier, and that was not kept.
    pub fn lacks(&self, clay: &Clay) -> bool {
        let done = self.done as u32;
        let mut wanted = baked_for(clay, self.done);
        wanted.any(|strokes| strokes < done && !self.has_baked(strokes))
    }

    fn has_baked(&self, strokes: u32) -> bool {
        self.grids.baked.iter().any(|(known, _)| *known == strokes)
    }

    /// Keeps the clay as it stands as a grid of distances, if a tool of the strokes to come is made of it.
    fn bake(&mut self, clay: &Clay, go_on: &mut dyn FnMut(f32) -> bool) -> Result<(), ClayError> {
        let strokes = self.done as u32;
        if self.has_baked(strokes) || baked_for(clay, self.done).all(|wanted| wanted != strokes) {
            return Ok(());
        }
        let shaped = self.shaped();
        let is_closed = self.mesh.border_count() == 0;
        let (positions, triangles) = (&shaped.positions, &shaped.triangles);
        let grid = DistanceGrid::of_mesh(positions, triangles, is_closed, &mut |_| go_on(0.0));
        let grid = grid.ok_or(ClayError::Stopped)?;
        self.grids.baked.push((strokes, Arc::new(grid)));
        Ok(())
    }

    /// Looks after all edges until nothing changes, so that a stroke that only carries them leaves them alone.
    fn settle(&mut self) {
        for _ in 0..ROUNDS {
            let before = self.mesh.triangle_count();
            let all = 0..self.mesh.vertex_places();
            let all: Vec<u32> = all.filter(|v| self.mesh.is_vertex(*v)).collect();
            self.look_after(&all);
            if self.mesh.triangle_count() == before {
                return;
            }
        }
    }

    /// Splits, collapses and flips the edges of vertices that lie where they stay.
    fn look_after(&mut self, vertices: &[u32]) {
        let mut stepping = self.stepping();
        for vertex in vertices {
            stepping.touch(*vertex);
        }
        stepping.look_after(&Still);
        let is_full = stepping.is_full;
        self.note_full(is_full);
    }

    fn note_full(&mut self, is_full: bool) {
        if is_full && self.full_since.is_none() {
            self.full_since = Some(self.done);
        }
    }

    pub(super) fn stepping(&mut self) -> Stepping<'_> {
        self.number += 1;
        Stepping {
            mesh: &mut self.mesh,
            after: &mut self.after,
            moved_in: &mut self.moved_in,
            turned_in: &mut self.turned_in,
            number: self.number,
            moved: Vec::new(),
            made: Vec::new(),
            detail: self.detail,
            is_full: false,
            work: &mut self.work,
        }
    }

    /// Does the next stroke of a clay. `go_on` hears the part that is done and says whether to go on; after an error
    /// this shaping is good for nothing more.
    ///
    /// # Errors
    /// If it was stopped.
    pub fn stroke(
        &mut self,
        clay: &Clay,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), ClayError> {
        let index = self.done;
        let Some(stroke) = clay.strokes.get(index) else {
            return Ok(());
        };
        self.touched.fill(false);
        self.bake(clay, go_on)?;
        if !stroke.is_off {
            let motion = Motion::new(clay, (index, stroke), &self.grids);
            if let Ok(motion) = &motion
                && let Some(place) = motion.absent()
            {
                let tool = stroke.moves.get(place).map_or(0, |one| one.tool);
                self.left_out.push((index, LeftOut::NoMesh(tool)));
            }
            let done = motion.and_then(|motion| match stroke.smooth {
                Some(strength) => Ok((motion.moments()?, motion, Some(strength))),
                None => Ok((motion.times()?, motion, None)),
            });
            match done {
                Ok((times, motion, None)) => self.sweep(&motion, &times, go_on)?,
                Ok((times, motion, Some(strength))) => {
                    self.smooth(&motion, &times, strength, go_on)?;
                }
                Err(why) => self.left_out.push((index, why)),
            }
        }
        self.done += 1;
        Ok(())
    }

    fn sweep(
        &mut self,
        motion: &Motion<'_>,
        times: &[(f64, f64)],
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), ClayError> {
        let mut long = self.long_triangles();
        self.is_fine = long.is_empty();
        let (mut done, all) = (0, times.len());
        for times in times.chunks(WIDE) {
            let steps: Vec<Step> = times.iter().map(|time| motion.step(*time)).collect();
            let mut candidates = Candidates::default();
            let balls = around(&steps);
            let vertices = 0..self.mesh.vertex_places();
            candidates.wide = self.within(vertices, &balls);
            for steps in steps.chunks(BLOCK) {
                if !go_on(done as f32 / all as f32) {
                    return Err(ClayError::Stopped);
                }
                let balls = around(steps);
                candidates.near = self.within(candidates.wide.iter().copied(), &balls);
                for step in steps {
                    self.step(motion, step, &mut long, &mut candidates);
                    done += 1;
                }
            }
        }
        Ok(())
    }

    /// The vertices that lie in some balls.
    fn within(
        &self,
        vertices: impl Iterator<Item = u32>,
        balls: &[crate::displace::Ball],
    ) -> Vec<u32> {
        let mesh = &self.mesh;
        let is_there =
            |v: &u32| mesh.is_vertex(*v) && is_in(balls, mesh.vertices[*v as usize].pos());
        vertices.filter(is_there).collect()
    }

    fn step(
        &mut self,
        motion: &Motion<'_>,
        step: &Step,
        long: &mut Vec<u32>,
        candidates: &mut Candidates,
    ) {
        if !long.is_empty() {
            let made = self.split_reached(motion, step, long);
            candidates.wide.extend(&made);
            candidates.near.extend(&made);
        }
        let moving = self.within(candidates.near.iter().copied(), &step.balls);
        self.work.steps += 1;
        self.work.reached += moving.len();
        let carry = Moved { motion, step };
        let mut stepping = self.stepping();
        for vertex in moving {
            let after = motion.moved(step, &stepping.mesh.vertices[vertex as usize]);
            stepping.move_to(vertex, after);
        }
        stepping.look_after(&carry);
        let Stepping {
            moved,
            made,
            is_full,
            ..
        } = stepping;
        candidates.wide.extend(&made);
        candidates.near.extend(&made);
        self.note_made(&made);
        for vertex in moved {
            if self.moved_in[vertex as usize] == self.number && self.mesh.is_vertex(vertex) {
                self.mesh.vertices[vertex as usize] = self.after[vertex as usize];
                self.touched[vertex as usize] = true;
            }
        }
        self.note_full(is_full);
    }

    /// New vertices have not moved yet, whatever had their places before.
    fn note_made(&mut self, made: &[u32]) {
        self.touched.lengthen(self.mesh.vertices.len(), false);
        for vertex in made {
            self.touched[*vertex as usize] = false;
        }
    }

    /// The triangles that have an edge longer than the detail. Steps split what they move, so that where there was none
    /// there is none to look for, unless there are too many triangles to split.
    fn long_triangles(&self) -> Vec<u32> {
        if self.is_fine && self.full_since.is_none() {
            return Vec::new();
        }
        let all = 0..self.mesh.triangle_places();
        all.filter(|t| self.is_long(*t)).collect()
    }

    /// True if a triangle has an edge longer than the detail.
    fn is_long(&self, triangle: u32) -> bool {
        let Some(corners) = self.mesh.triangle(triangle) else {
            return false;
        };
        let [a, b, c] = corners.map(|v| self.mesh.vertices[v as usize].pos());
        let [one, two, three] = [a - b, b - c, c - a].map(DVec3::length_squared);
        one.max(two).max(three) > self.detail * self.detail
    }

    /// The longest edge of a triangle, if it is longer than the detail: its square and its half-edge.
    fn longest(&self, triangle: u32) -> Option<(f64, u32)> {
        self.mesh.triangle(triangle)?;
        let halves = 3 * triangle..3 * triangle + 3;
        let squares = halves.map(|half| {
            let [a, b] = [self.mesh.from(half), self.mesh.to(half)]
                .map(|v| self.mesh.vertices[v as usize].pos());
            (a.distance_squared(b), half)
        });
        let longest = squares.reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        (longest.0 > self.detail * self.detail).then_some(longest)
    }

    /// Splits the edges of the triangles that meet the reach of a step until none is longer than the detail: a coarse
    /// mesh may have no vertex there. Gives the new vertices.
    fn split_reached(&mut self, motion: &Motion<'_>, step: &Step, long: &mut Vec<u32>) -> Vec<u32> {
        let mut made = Vec::new();
        let mut queue = BinaryHeap::new();
        long.retain(|triangle| self.longest(*triangle).is_some());
        for triangle in long.iter() {
            if let Some((square, half)) = self.longest(*triangle)
                && self.is_met(motion, step, *triangle)
            {
                queue.push((square.to_bits(), std::cmp::Reverse(half)));
            }
        }
        while let Some((bits, std::cmp::Reverse(half))) = queue.pop() {
            let Some((square, still)) = self.longest(half / 3) else {
                continue;
            };
            if square.to_bits() != bits || still != half {
                continue;
            }
            if self.mesh.triangle_count() >= MAX_TRIANGLES {
                self.note_full(true);
                break;
            }
            let mut stepping = self.stepping();
            let vertex = stepping.split(half, &Still);
            made.push(vertex);
            let around: Vec<u32> = self.mesh.fan(vertex).map(|half| half / 3).collect();
            for triangle in around {
                let Some((square, half)) = self.longest(triangle) else {
                    continue;
                };
                long.push(triangle);
                if self.is_met(motion, step, triangle) {
                    queue.push((square.to_bits(), std::cmp::Reverse(half)));
                }
            }
        }
        if !made.is_empty() {
            long.sort_unstable();
            long.dedup();
            self.note_made(&made);
        }
        made
    }

    /// True if a triangle meets the reach of the tools in a step, to an eighth of the detail.
    fn is_met(&self, motion: &Motion<'_>, step: &Step, triangle: u32) -> bool {
        let Some(corners) = self.mesh.triangle(triangle) else {
            return false;
        };
        let corners = corners.map(|v| self.mesh.vertices[v as usize].pos());
        let mut open = vec![corners];
        while let Some(corners) = open.pop() {
            let [a, b, c] = corners;
            let middle = (a + b + c) / 3.0;
            let far = corners.map(|p| p.distance(middle));
            let radius = far.into_iter().fold(0.0, f64::max);
            let is_near =
                |ball: &crate::displace::Ball| ball.middle.distance(middle) <= ball.radius + radius;
            if !step.balls.iter().any(is_near) {
                continue;
            }
            let beyond = motion.beyond_reach(step, middle);
            if beyond == 0.0 || (beyond <= radius && radius < self.detail / 8.0) {
                return true;
            }
            if beyond <= radius {
                let [ab, bc, ca] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
                open.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
        }
        false
    }

    fn smooth(
        &mut self,
        motion: &Motion<'_>,
        moments: &[(f64, f64)],
        strength: u32,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), ClayError> {
        let mut long = self.long_triangles();
        for (done, moment) in moments.iter().enumerate() {
            if !go_on(done as f32 / moments.len() as f32) {
                return Err(ClayError::Stopped);
            }
            let step = motion.step(*moment);
            if !long.is_empty() {
                self.split_reached(motion, &step, &mut long);
            }
            let near = self.within(0..self.mesh.vertex_places(), &step.balls);
            let part = |pos: DVec3| f64::from(strength) / 200.0 * motion.field(&step, pos);
            let moved = smooth::smoothed(&mut self.mesh, &near, &part);
            self.look_after(&moved);
            self.touched.lengthen(self.mesh.vertices.len(), false);
            for vertex in moved {
                self.touched[vertex as usize] = true;
            }
        }
        Ok(())
    }

    /// What has been done so far, the preparation of the start too.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.mesh.vertex_count()
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.mesh.triangle_count()
    }

    /// Bytes that the mesh and what follows its vertices have taken.
    pub fn bytes(&self) -> usize {
        let stamps = self.moved_in.taken() + self.turned_in.taken();
        self.mesh.bytes() + self.after.taken() + stamps + self.touched.taken()
    }

    /// Number of strokes that are done, those that are off or left out counted too.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Strokes that did nothing, by their places in the list, and why.
    pub fn left_out(&self) -> &[(usize, LeftOut)] {
        &self.left_out
    }

    /// The stroke since which no edge is split, as there are [`MAX_TRIANGLES`].
    pub fn full_since(&self) -> Option<usize> {
        self.full_since
    }

    /// What was done to a file, what was left out and what was met, in words: strokes by their numbers, from 1.
    pub fn notices(&self) -> Vec<String> {
        let mut lines = self.start_notices.clone();
        for (index, why) in self.left_out.iter().take(MOST_NOTICES) {
            let number = index + 1;
            lines.push(match why {
                LeftOut::NoMesh(_) => format!("a tool of stroke {number} holds nothing: {why}"),
                _ => format!("stroke {number} is left out: {why}"),
            });
        }
        if let Some(more) = self.left_out.len().checked_sub(MOST_NOTICES + 1) {
            lines.push(format!("{} more strokes are left out", more + 1));
        }
        if let Some(stroke) = self.full_since {
            lines.push(format!(
                "since stroke {} the clay has {MAX_TRIANGLES} triangles, and no edge is split any more",
                stroke + 1
            ));
        }
        lines
    }

    /// The mesh as it stands.
    pub fn shaped(&self) -> Shaped {
        let (vertices, triangles, kept) = self.mesh.compact();
        let is_touched = |v: &u32| self.touched.get(*v as usize).copied().unwrap_or(false);
        Shaped {
            positions: vertices.iter().map(|vertex| vertex.pos).collect(),
            normals: vertices.iter().map(|vertex| vertex.normal).collect(),
            triangles,
            touched: kept.iter().map(is_touched).collect(),
            detail: self.detail,
            space: self.space,
        }
    }
}

/// By how many strokes the tools are made that strokes from one on have, once for each that has one.
fn baked_for(clay: &Clay, from: usize) -> impl Iterator<Item = u32> + '_ {
    let strokes = clay
        .strokes
        .iter()
        .skip(from)
        .filter(|stroke| !stroke.is_off);
    let tools = strokes
        .flat_map(|stroke| &stroke.moves)
        .filter_map(|one| clay.tools.get(one.tool));
    tools.filter_map(|tool| match tool.shape {
        Some(ToolShape::Clay { strokes, .. }) => Some(strokes),
        _ => None,
    })
}

/// A clay's mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shaped {
    /// Vertices, the clay's space.
    pub positions: Vec<glam::Vec3>,
    /// Unit normals of the vertices.
    pub normals: Vec<glam::Vec3>,
    /// Indices of three vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// True for the vertices that the last stroke moved.
    pub touched: Vec<bool>,
    /// The longest that a stroke leaves an edge, the clay's space.
    pub detail: f64,
    /// Where the clay's space lies.
    pub space: Space,
}
