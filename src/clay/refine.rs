//! The edges of a clay follow its steps: long ones split, short ones collapse, some flip (spec/sweepers.md, B.2; after
//! Angelidis, Wyvill and Cani, Sweepers, section 5.1). An edge is judged by where its ends go in the step; new and
//! merged vertices are made before the step and moved by it.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec3;

use super::mesh::{ClayMesh, Vertex};
use super::roomy::Roomy;

/// Most triangles: beyond them no edge is split.
pub const MAX_TRIANGLES: usize = 300_000;

/// Cosines of the angles between normals at which edges split and collapse: 20° and 8°.
const SPLIT_COS: f64 = 0.939_692_620_785_908_4;
const COLLAPSE_COS: f64 = 0.990_268_068_741_570_3;
/// Cosine of the angle between two triangles that count as flat: 5°.
const FLAT_COS: f64 = 0.996_194_698_091_745_5;
/// Cosine of the angle by which no normal of a triangle may turn: 60°.
const TURN_COS: f64 = 0.5;
/// Squares that differ by less than this part may be rounded to either side.
const NEAR: f64 = 1e-12;
/// The smallest of six angles has to grow by this part of it for a flip: rounding alone turns no edge.
const WORTH: f64 = 1e-3;

/// Where what is made before a step is taken by it.
pub(super) trait Carry {
    /// A vertex after the step.
    fn carry(&self, vertex: &Vertex) -> Vertex;
}

/// The mesh in a step: where its vertices are before, and where those that move are after.
pub(super) struct Stepping<'a> {
    pub(super) mesh: &'a mut ClayMesh,
    /// Places after the step, for the vertices in `moved`.
    pub(super) after: &'a mut Roomy<Vertex>,
    /// The number of the step in which a vertex was last moved.
    pub(super) moved_in: &'a mut Roomy<u32>,
    /// This step's number.
    pub(super) number: u32,
    /// The vertices that this step moves.
    pub(super) moved: Vec<u32>,
    /// The number of the step in which edges of a vertex may have come to ask for a flip.
    pub(super) turned_in: &'a mut Roomy<u32>,
    /// Vertices that came to be in this step, moved or not.
    pub(super) made: Vec<u32>,
    /// Longest edge.
    pub(super) detail: f64,
    /// True once an edge stayed long because of [`MAX_TRIANGLES`].
    pub(super) is_full: bool,
    /// What is done to edges is counted here.
    pub(super) work: &'a mut Work,
}

/// What has been done to shape a clay, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps of strokes that move.
    pub steps: usize,
    /// Vertices in reach of the tools in these steps, all steps added up.
    pub reached: usize,
    /// Edges that were split.
    pub splits: usize,
    /// Edges whose ends became one.
    pub collapses: usize,
    /// Edges that were turned to the other two corners of their triangles.
    pub flips: usize,
}

impl Work {
    /// What has been done since an earlier count.
    #[must_use]
    pub fn since(&self, earlier: Self) -> Self {
        Self {
            steps: self.steps - earlier.steps,
            reached: self.reached - earlier.reached,
            splits: self.splits - earlier.splits,
            collapses: self.collapses - earlier.collapses,
            flips: self.flips - earlier.flips,
        }
    }
}

/// An edge in a queue: its length as bits, which are in order as no length is below 0, and its ends.
type Queued = (u64, Reverse<(u32, u32)>);

/// Where an edge stands in a queue, by the square of its length.
fn rank(square: f64, is_shortest_first: bool) -> u64 {
    match is_shortest_first {
        true => !square.to_bits(),
        false => square.to_bits(),
    }
}

/// Edges that ask for something, by their ends after the step. None asks to be split and to collapse.
#[derive(Default)]
struct Asked {
    /// To be split, longest first.
    long: BinaryHeap<Queued>,
    /// To collapse, shortest first.
    short: BinaryHeap<Queued>,
}

/// The way from the middle of an edge to that of the cubic through its ends.
#[inline]
fn to_cubic_middle(a: &Vertex, b: &Vertex) -> DVec3 {
    let along = b.pos() - a.pos();
    let (n, m) = (a.normal(), b.normal());
    (m * along.dot(m) - n * along.dot(n)) * 0.125
}

/// How long a way is beside a length. Most are far from it, and need no root to tell.
#[inline]
fn compared(way: DVec3, with: f64) -> Option<Ordering> {
    let (square, limit) = (way.length_squared(), with * with);
    if square < limit * (1.0 - NEAR) {
        Some(Ordering::Less)
    } else if square > limit * (1.0 + NEAR) {
        Some(Ordering::Greater)
    } else {
        way.length().partial_cmp(&with)
    }
}

/// The vertex in the middle of two: on the cubic unless that is far off.
pub(super) fn between(a: &Vertex, b: &Vertex, detail: f64) -> Vertex {
    let off = to_cubic_middle(a, b);
    let middle = (a.pos() + b.pos()) * 0.5;
    let pos = if off.length() <= detail / 10.0 {
        middle + off
    } else {
        middle
    };
    let normal = (a.normal() + b.normal()).normalize_or(a.normal());
    Vertex::new(pos, normal)
}

fn must_split(a: &Vertex, b: &Vertex, detail: f64) -> bool {
    is_split_at(a.pos().distance_squared(b.pos()), a, b, detail)
}

/// As [`must_split`], of an edge with a length of this square.
#[inline]
fn is_split_at(square: f64, a: &Vertex, b: &Vertex, detail: f64) -> bool {
    if square > detail * detail {
        return true;
    }
    if square <= detail * detail / 16.0 {
        return false;
    }
    a.normal().dot(b.normal()) < SPLIT_COS
        || compared(to_cubic_middle(a, b), detail / 20.0) == Some(Ordering::Greater)
}

/// True if an edge with a length of this square collapses.
#[inline]
fn is_collapsed_at(square: f64, a: &Vertex, b: &Vertex, detail: f64) -> bool {
    if square >= detail * detail / 4.0 {
        return false;
    }
    let is_plain = a.normal().dot(b.normal()) > COLLAPSE_COS;
    square < detail * detail / 256.0
        || (is_plain && compared(to_cubic_middle(a, b), detail / 40.0) == Some(Ordering::Less))
}

/// Twice the area of a triangle, along its normal.
pub(super) fn area_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// The greatest cosine of an angle of a triangle: that of the smallest angle. 1 for one without area.
fn sharpest([a, b, c]: [DVec3; 3]) -> f64 {
    let cos = |at: DVec3, one: DVec3, two: DVec3| {
        let (u, v) = (one - at, two - at);
        let lengths = libm::sqrt(u.length_squared() * v.length_squared());
        if lengths > 0.0 {
            u.dot(v) / lengths
        } else {
            1.0
        }
    };
    cos(a, b, c).max(cos(b, c, a)).max(cos(c, a, b))
}

impl Stepping<'_> {
    fn is_moved(&self, vertex: u32) -> bool {
        self.moved_in[vertex as usize] == self.number
    }

    /// A vertex after the step.
    fn after(&self, vertex: u32) -> &Vertex {
        match self.is_moved(vertex) {
            true => &self.after[vertex as usize],
            false => &self.mesh.vertices[vertex as usize],
        }
    }

    /// Takes note of where a vertex goes; one that stays is not moved.
    pub(super) fn move_to(&mut self, vertex: u32, after: Vertex) {
        if after == self.mesh.vertices[vertex as usize] {
            self.moved_in[vertex as usize] = 0;
            return;
        }
        self.after[vertex as usize] = after;
        if self.moved_in[vertex as usize] != self.number {
            self.moved_in[vertex as usize] = self.number;
            self.moved.push(vertex);
        }
    }

    /// Takes a vertex as moved, though it stays where it is.
    pub(super) fn touch(&mut self, vertex: u32) {
        self.after[vertex as usize] = self.mesh.vertices[vertex as usize];
        self.moved_in[vertex as usize] = self.number;
        self.moved.push(vertex);
    }

    /// Splits an edge in the middle: the new vertex.
    pub(super) fn split(&mut self, half: u32, carry: &impl Carry) -> u32 {
        let ends = [self.mesh.from(half), self.mesh.to(half)];
        let [a, b] = ends.map(|end| self.mesh.vertices[end as usize]);
        let middle = between(&a, &b, self.detail);
        let vertex = self.mesh.split(half, middle);
        self.work.splits += 1;
        let places = self.mesh.vertices.len();
        self.after.lengthen(places, middle);
        self.moved_in.lengthen(places, 0);
        self.turned_in.lengthen(places, 0);
        self.moved_in[vertex as usize] = 0;
        self.made.push(vertex);
        self.move_to(vertex, carry.carry(&middle));
        self.note_turned_around(vertex);
        vertex
    }

    /// Takes note that edges of a vertex may ask for a flip.
    fn note_turned(&mut self, vertex: u32) {
        self.turned_in[vertex as usize] = self.number;
    }

    /// As [`Self::note_turned`], of a vertex that is new or lies elsewhere and of its neighbours.
    fn note_turned_around(&mut self, vertex: u32) {
        self.note_turned(vertex);
        for half in self.mesh.fan(vertex) {
            for other in [self.mesh.to(half), self.mesh.across(half)] {
                self.turned_in[other as usize] = self.number;
            }
        }
    }

    /// Puts an edge into the queue of what it asks for. Only edges that the step moves as a whole collapse.
    fn ask(&self, [a, b]: [u32; 2], asked: &mut Asked) {
        self.ask_from((a, self.after(a)), b, asked);
    }

    /// As [`Self::ask`], with the first end as it is after the step.
    #[inline]
    fn ask_from(&self, (a, one): (u32, &Vertex), b: u32, asked: &mut Asked) {
        let two = self.after(b);
        let square = one.pos().distance_squared(two.pos());
        let ends = Reverse((a.min(b), a.max(b)));
        if is_split_at(square, one, two, self.detail) {
            asked.long.push((rank(square, false), ends));
        } else if is_collapsed_at(square, one, two, self.detail)
            && self.is_moved(a)
            && self.is_moved(b)
        {
            asked.short.push((rank(square, true), ends));
        }
    }

    /// What the edges of the vertices that move ask for. Takes note of the vertices that may have an edge to be
    /// flipped: most steps leave nearly all edges as they are.
    fn asked(&mut self) -> Asked {
        let mut asked = Asked::default();
        let mut fan = Vec::new();
        for i in 0..self.moved.len() {
            let vertex = self.moved[i];
            if !self.is_moving(vertex) {
                continue;
            }
            let one = *self.after(vertex);
            let is_border = self.mesh.is_border(vertex);
            let mut may_turn = is_border;
            self.fan_after(vertex, &mut fan);
            for (at, (_, to, pos)) in fan.iter().enumerate() {
                if *to > vertex && self.is_moved(*to) {
                    continue;
                }
                self.ask_from((vertex, &one), *to, &mut asked);
                may_turn = may_turn || is_wide(one.pos(), *pos, beside(&fan, at));
            }
            if may_turn {
                self.note_turned(vertex);
            }
            if is_border {
                for edge in self.edges_of(vertex) {
                    self.ask(edge, &mut asked);
                }
            }
        }
        asked
    }

    /// The half-edges that leave a vertex, where each leads to, and where that lies after the step.
    fn fan_after(&self, vertex: u32, fan: &mut Vec<(u32, u32, DVec3)>) {
        fan.clear();
        for half in self.mesh.fan(vertex) {
            let to = self.mesh.to(half);
            fan.push((half, to, self.after(to).pos()));
        }
    }

    /// The half-edge of what a queue gave, if the edge is still there and as long as it was.
    fn still(&self, (key, Reverse((a, b))): Queued, is_shortest_first: bool) -> Option<u32> {
        let half = self.mesh.half(a, b).or_else(|| self.mesh.half(b, a))?;
        let square = self.after(a).pos().distance_squared(self.after(b).pos());
        (rank(square, is_shortest_first) == key).then_some(half)
    }

    /// The edges that a vertex of this step has: each end of those that have two such vertices has it once.
    fn edges_of(&self, vertex: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
        let halves = self.mesh.fan(vertex).flat_map(|half| {
            // The last edge of a border vertex has no half-edge that leaves it.
            [self.mesh.to(half), self.mesh.across(half)]
        });
        halves.map(move |other| [vertex, other])
    }

    /// True of a vertex that moves and is there.
    fn is_moving(&self, vertex: u32) -> bool {
        self.mesh.is_vertex(vertex) && self.is_moved(vertex)
    }

    /// Lets the edges follow: long ones split, short ones collapse, then slender triangles flip.
    pub(super) fn look_after(&mut self, carry: &impl Carry) {
        let mut asked = self.asked();
        self.split_long(&mut asked, carry);
        self.collapse_asked(asked, carry);
        self.flip_slender();
    }

    /// Lets the ends of short edges become one.
    pub(super) fn collapse_short(&mut self, carry: &impl Carry) {
        let asked = self.asked();
        self.collapse_asked(asked, carry);
    }

    /// Splits long edges, longest first, until none is left. What new edges ask for is added.
    fn split_long(&mut self, asked: &mut Asked, carry: &impl Carry) {
        while let Some(queued) = asked.long.pop() {
            let Some(half) = self.still(queued, false) else {
                continue;
            };
            if self.mesh.triangle_count() >= MAX_TRIANGLES {
                self.is_full = true;
                return;
            }
            let vertex = self.split(half, carry);
            for [from, to] in self.edges_of(vertex) {
                if self.is_moved(from) || self.is_moved(to) {
                    self.ask([from, to], asked);
                }
            }
        }
    }

    /// Lets the ends of short edges become one, shortest first, until none is left that may.
    fn collapse_asked(&mut self, mut asked: Asked, carry: &impl Carry) {
        while let Some(queued) = asked.short.pop() {
            let Some(half) = self.still(queued, true) else {
                continue;
            };
            let Some(vertex) = self.collapse(half, carry) else {
                continue;
            };
            if !self.is_moved(vertex) {
                continue;
            }
            for other in self.mesh.ring(vertex) {
                if self.is_moved(other) {
                    self.ask([vertex, other], &mut asked);
                }
            }
        }
    }

    /// Collapses an edge, if that leaves the surface whole, its normals within 60° and no edge to be split.
    pub(super) fn collapse(&mut self, half: u32, carry: &impl Carry) -> Option<u32> {
        let ends = [self.mesh.from(half), self.mesh.to(half)];
        if !self.mesh.may_collapse(half) {
            return None;
        }
        let [a, b] = ends.map(|end| self.mesh.vertices[end as usize]);
        let before = between(&a, &b, self.detail);
        let after = carry.carry(&before);
        for (end, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            for leaving in self.mesh.fan(end) {
                let [one, two] = [self.mesh.to(leaving), self.mesh.across(leaving)];
                if one != other && must_split(&after, self.after(one), self.detail) {
                    return None;
                }
                if one == other || two == other {
                    continue;
                }
                let [p, q] = [one, two].map(|v| self.after(v).pos());
                let old = area_normal([self.after(end).pos(), p, q]);
                let new = area_normal([after.pos(), p, q]);
                if !is_turned_little(old, new) {
                    return None;
                }
            }
        }
        let vertex = self.mesh.collapse(half, before);
        self.work.collapses += 1;
        self.move_to(vertex, after);
        self.note_turned_around(vertex);
        Some(vertex)
    }

    /// One round of flips where triangles are flat and become less slender.
    fn flip_slender(&mut self) {
        let mut fan = Vec::new();
        for i in 0..self.moved.len() {
            let vertex = self.moved[i];
            if self.turned_in[vertex as usize] != self.number || !self.is_moving(vertex) {
                continue;
            }
            let middle = self.after(vertex).pos();
            self.fan_after(vertex, &mut fan);
            // What lies on both sides of an edge is then before and behind it in the fan.
            let mut is_as_it_was = !self.mesh.is_border(vertex);
            for at in 0..fan.len() {
                let (half, mut to, pos) = fan[at];
                if !is_as_it_was {
                    // The edge may have gone with a flip before.
                    if self.mesh.from(half) != vertex {
                        continue;
                    }
                    to = self.mesh.to(half);
                }
                if to > vertex && self.is_moved(to) {
                    continue;
                }
                if is_as_it_was && !is_wide(middle, pos, beside(&fan, at)) {
                    continue;
                }
                if self.is_worth_a_flip(half)
                    && let Some(new) = self.mesh.flip(half)
                {
                    self.work.flips += 1;
                    is_as_it_was = false;
                    for half in [Some(new), self.mesh.twin(new)].into_iter().flatten() {
                        let ends = [self.mesh.from(half), self.mesh.across(half)];
                        ends.into_iter().for_each(|vertex| self.note_turned(vertex));
                    }
                }
            }
        }
    }

    fn is_worth_a_flip(&self, half: u32) -> bool {
        let Some(other) = self.mesh.twin(half) else {
            return false;
        };
        let corners = [
            self.mesh.from(half),
            self.mesh.to(half),
            self.mesh.across(half),
            self.mesh.across(other),
        ];
        let [a, b, c, d] = corners.map(|v| self.after(v).pos());
        if !is_wide(a, b, [c, d]) {
            return false;
        }
        let [one, two] = [area_normal([a, b, c]), area_normal([b, a, d])];
        let lengths = libm::sqrt(one.length_squared() * two.length_squared());
        if one.dot(two) < FLAT_COS * lengths {
            return false;
        }
        let [first, second] = [area_normal([c, d, b]), area_normal([d, c, a])];
        let old = sharpest([a, b, c]).max(sharpest([b, a, d]));
        let new = sharpest([c, d, b]).max(sharpest([d, c, a]));
        new < old - WORTH
            && is_turned_little(one + two, first)
            && is_turned_little(one + two, second)
            && !must_split(self.after(corners[2]), self.after(corners[3]), self.detail)
    }
}

/// Where the neighbours before and behind one of a fan lie.
#[inline]
fn beside(fan: &[(u32, u32, DVec3)], at: usize) -> [DVec3; 2] {
    let behind = if at + 1 < fan.len() { at + 1 } else { 0 };
    let before = if at > 0 { at } else { fan.len() } - 1;
    [behind, before].map(|k| fan[k].2)
}

/// False if the angles across an edge are less than half a turn together: the edge is the better one.
#[inline]
fn is_wide(a: DVec3, b: DVec3, [c, d]: [DVec3; 2]) -> bool {
    (a - c).dot(b - c) < 0.0 || (a - d).dot(b - d) < 0.0
}

/// True if a triangle has an area still, and its normal is less than 60° from what it was; one that had none may have
/// any.
fn is_turned_little(old: DVec3, new: DVec3) -> bool {
    let lengths = libm::sqrt(old.length_squared() * new.length_squared());
    new.length_squared() > 0.0 && (lengths == 0.0 || old.dot(new) > TURN_COS * lengths)
}
