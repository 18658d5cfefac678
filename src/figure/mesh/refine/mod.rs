mod acute;
mod lattice;

use std::cmp::Ordering;
use std::collections::{BinaryHeap, VecDeque};

use glam::DVec2;

use self::acute::acute_points;
use super::delaunay::{Delaunay, NONE, Place};
use crate::figure::progress::Progress;

/// Cosine of the smallest angle that is aimed at, 25°.
const COS_LEAST_ANGLE: f64 = 0.906_307_787_036_65;
/// Edges and triangles' radii below this are not divided, pixels: where outlines meet at small angles, refinement
/// would not end.
const LEAST_LENGTH: f64 = 1.0 / 64.0;
/// Steps from one word of progress to the next.
const STEPS: u32 = 512;
/// Stands for a point where there is none.
const NO_POINT: u32 = u32::MAX;

/// What a refinement aims at.
pub(crate) struct Aim {
    /// Largest area of a triangle, square pixels.
    pub(crate) area: f64,
    /// Points at most.
    pub(crate) points: usize,
}

/// A triangulation while it is refined (Ruppert, with Shewchuk's shells around acute points).
struct Refinement<'a> {
    mesh: &'a mut Delaunay,
    /// By label, whether triangles are drawn; others are left as they are.
    is_drawn: &'a [bool; 256],
    aim: Aim,
    /// Fixed edges that a point comes too near to.
    edges: VecDeque<[u32; 2]>,
    /// Triangles that are too sharp; they are improved first.
    sharp: VecDeque<(u32, [u32; 3])>,
    /// Triangles that are too large; the largest is divided first, which takes fewest points.
    large: BinaryHeap<Large>,
    /// Points between which and a fixed edge there is a small angle.
    is_acute: Vec<bool>,
    /// Per point that divides a fixed edge the ends of the edge that was divided at first; none of others.
    divides: Vec<[u32; 2]>,
}

/// A triangle that is too large.
#[derive(Clone, Copy, Debug)]
struct Large {
    area: f64,
    index: u32,
    corners: [u32; 3],
}

impl Ord for Large {
    fn cmp(&self, other: &Self) -> Ordering {
        self.area
            .total_cmp(&other.area)
            .then(other.corners.cmp(&self.corners))
            .then(other.index.cmp(&self.index))
    }
}

impl PartialOrd for Large {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Large {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Large {}

/// What is wrong with a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    /// It is larger than it may be: its area.
    Large(f64),
    /// It has an angle below 25°.
    Sharp,
}

/// Refines until no drawn triangle is larger than the aim nor has an angle below 25°, but for those at acute corners of
/// outlines. False if that takes too many points, none if it was stopped.
pub(crate) fn refine(
    mesh: &mut Delaunay,
    is_drawn: &[bool; 256],
    aim: Aim,
    progress: &mut Progress<'_>,
) -> Option<bool> {
    let mut refinement = Refinement {
        is_acute: acute_points(mesh),
        divides: vec![[NO_POINT; 2]; mesh.points.len()],
        edges: VecDeque::new(),
        sharp: VecDeque::new(),
        large: BinaryHeap::new(),
        mesh,
        is_drawn,
        aim,
    };
    refinement.seed();
    for triangle in 0..refinement.mesh.triangles.len() as u32 {
        refinement.check(triangle);
    }
    let mut steps = 0_u32;
    loop {
        let (count, most) = (refinement.mesh.points.len(), refinement.aim.points);
        if count >= most {
            return Some(refinement.ends_well());
        }
        steps += 1;
        if steps.is_multiple_of(STEPS) && !progress(count as f32 / most as f32) {
            return None;
        }
        if let Some(edge) = refinement.edges.pop_front() {
            refinement.divide(edge);
        } else if let Some((triangle, corners)) = refinement.sharp.pop_front() {
            refinement.improve(triangle, corners);
        } else if let Some(large) = refinement.large.pop() {
            refinement.improve(large.index, large.corners);
        } else {
            return Some(true);
        }
    }
}

impl Refinement<'_> {
    /// Whether nothing is left to do but what has been put right meanwhile.
    fn ends_well(mut self) -> bool {
        let large = self.large.drain().map(|large| (large.index, large.corners));
        let noted: Vec<_> = self.sharp.drain(..).chain(large).collect();
        let is_bad = |(index, corners): (u32, [u32; 3])| {
            self.mesh.triangle(index).corners == corners && self.fault(index).is_some()
        };
        !noted.into_iter().any(is_bad)
    }

    /// Notes what is wrong with a triangle.
    fn check(&mut self, index: u32) {
        let triangle = *self.mesh.triangle(index);
        if !self.is_drawn[usize::from(triangle.label)] {
            return;
        }
        for edge in 0..3 {
            let (from, to) = (
                triangle.corners[(edge + 1) % 3],
                triangle.corners[(edge + 2) % 3],
            );
            if triangle.fixed[edge]
                && self.is_encroached(from, to, self.mesh.point(triangle.corners[edge]))
            {
                self.edges.push_back([from, to]);
            }
        }
        self.note(index);
    }

    /// Notes that a triangle is to be improved, if it is.
    fn note(&mut self, index: u32) {
        let corners = self.mesh.triangle(index).corners;
        match self.fault(index) {
            Some(Fault::Large(area)) => self.large.push(Large {
                area,
                index,
                corners,
            }),
            Some(Fault::Sharp) => self.sharp.push_back((index, corners)),
            None => {}
        }
    }

    /// Whether a point lies inside the circle over an edge.
    fn is_encroached(&self, from: u32, to: u32, p: DVec2) -> bool {
        let (a, b) = (self.mesh.point(from), self.mesh.point(to));
        (a - p).dot(b - p) < 0.0 && a.distance_squared(b) > 4.0 * LEAST_LENGTH * LEAST_LENGTH
    }

    /// Whether a triangle is too sharp without an acute corner of outlines as the cause, or too large.
    fn fault(&self, index: u32) -> Option<Fault> {
        let triangle = self.mesh.triangle(index);
        let [a, b, c] = triangle.corners.map(|corner| self.mesh.point(corner));
        let area = (b - a).perp_dot(c - a) / 2.0;
        let is_large = (area > self.aim.area).then_some(Fault::Large(area));
        let lengths = [
            b.distance_squared(c),
            c.distance_squared(a),
            a.distance_squared(b),
        ];
        let shortest = if lengths[0] <= lengths[1] && lengths[0] <= lengths[2] {
            0
        } else if lengths[1] <= lengths[2] {
            1
        } else {
            2
        };
        // The smallest angle lies opposite the shortest edge.
        let (one, other) = ((shortest + 1) % 3, (shortest + 2) % 3);
        let product = (lengths[one] * lengths[other]).sqrt();
        let cosine = (lengths[one] + lengths[other] - lengths[shortest]) / (2.0 * product);
        if cosine <= COS_LEAST_ANGLE || lengths[shortest] < LEAST_LENGTH * LEAST_LENGTH {
            return is_large;
        }
        let is_corner = triangle.fixed[one] && triangle.fixed[other];
        if is_corner || self.spans_acute(triangle.corners[one], triangle.corners[other]) {
            return is_large;
        }
        Some(Fault::Sharp)
    }

    /// Whether two points lie at the same distance from an acute point on two fixed edges that meet there.
    fn spans_acute(&self, one: u32, other: u32) -> bool {
        let (edge, other_edge) = (self.divides[one as usize], self.divides[other as usize]);
        if edge == other_edge {
            return false;
        }
        let shared = edge
            .into_iter()
            .find(|end| *end != NO_POINT && other_edge.contains(end));
        shared.is_some_and(|end| {
            let at = self.mesh.point(end);
            let (d, e) = (
                self.mesh.point(one).distance(at),
                self.mesh.point(other).distance(at),
            );
            self.is_acute[end as usize] && (d - e).abs() < 1e-6 * d
        })
    }

    /// Divides a fixed edge if it still is one: in its middle, or on a shell around an end that is acute.
    fn divide(&mut self, [from, to]: [u32; 2]) {
        let Some((triangle, edge)) = self
            .mesh
            .edge_between(from, to)
            .or_else(|| self.mesh.edge_between(to, from))
        else {
            return;
        };
        if !self.mesh.triangle(triangle).fixed[edge] {
            return;
        }
        let (a, b) = (self.mesh.point(from), self.mesh.point(to));
        let length = a.distance(b);
        if length < 2.0 * LEAST_LENGTH {
            return;
        }
        let part = match (self.is_acute[from as usize], self.is_acute[to as usize]) {
            (true, false) => shell(length) / length,
            (false, true) => 1.0 - shell(length) / length,
            _ => 0.5,
        };
        let divided = |point: u32| self.divides[point as usize];
        let ends = [divided(from), divided(to)]
            .into_iter()
            .find(|ends| ends[0] != NO_POINT);
        let point = self.mesh.split_edge(triangle, edge, a + part * (b - a));
        self.added(ends.unwrap_or([from, to]));
        self.check_around(point);
    }

    /// Puts a point into the middle of a triangle's circumcircle, or divides the fixed edges that are in its way.
    fn improve(&mut self, index: u32, corners: [u32; 3]) {
        if self.mesh.triangle(index).corners != corners || self.fault(index).is_none() {
            return;
        }
        let [a, b, c] = corners.map(|corner| self.mesh.point(corner));
        let centre = circumcentre(a, b, c);
        let (place, p) = match self.mesh.walk(index, centre, true) {
            Place::Point(_) => return,
            place => (place, centre),
        };
        let holder = match place {
            Place::Inside(triangle) => triangle,
            Place::Edge(triangle, edge) => {
                let found = self.mesh.triangle(triangle);
                if found.fixed[edge] {
                    let ends = [found.corners[(edge + 1) % 3], found.corners[(edge + 2) % 3]];
                    if self.mesh.point(ends[0]).distance(self.mesh.point(ends[1]))
                        >= 2.0 * LEAST_LENGTH
                    {
                        self.edges.push_back(ends);
                        self.note(index);
                    }
                    return;
                }
                triangle
            }
            Place::Point(_) => return,
        };
        let (_, encroached) = self.cavity(holder, p);
        if !encroached.is_empty() {
            self.edges.extend(encroached);
            self.note(index);
            return;
        }
        let point = match place {
            Place::Edge(triangle, edge) => self.mesh.split_edge(triangle, edge, p),
            _ => self.mesh.split_triangle(holder, p),
        };
        self.added([NO_POINT; 2]);
        self.check_around(point);
    }

    /// Notes a new point.
    fn added(&mut self, divides: [u32; 2]) {
        self.is_acute.push(false);
        self.divides.push(divides);
    }

    fn check_around(&mut self, point: u32) {
        for (triangle, _) in self.mesh.around(point) {
            self.check(triangle);
        }
    }

    /// The triangles whose circumcircles hold a point and that it sees, and the fixed edges around them that it would
    /// come too near to.
    fn cavity(&self, holder: u32, p: DVec2) -> (Vec<u32>, Vec<[u32; 2]>) {
        let mut seen = vec![holder];
        let mut found = Vec::new();
        let mut next = 0;
        while let Some(index) = seen.get(next).copied() {
            next += 1;
            let triangle = self.mesh.triangle(index);
            for edge in 0..3 {
                let across = triangle.next[edge];
                if triangle.fixed[edge] {
                    let ends = [
                        triangle.corners[(edge + 1) % 3],
                        triangle.corners[(edge + 2) % 3],
                    ];
                    if self.is_encroached(ends[0], ends[1], p) {
                        found.push(ends);
                    }
                } else if across != NONE
                    && !seen.contains(&across)
                    && self.mesh.is_in_circle(across, p)
                {
                    seen.push(across);
                }
            }
        }
        (seen, found)
    }
}

/// The power of two between a third and two thirds of a length.
fn shell(length: f64) -> f64 {
    let mut distance = 1.0;
    while distance > length * 2.0 / 3.0 {
        distance /= 2.0;
    }
    while distance < length / 3.0 {
        distance *= 2.0;
    }
    distance
}

fn circumcentre(a: DVec2, b: DVec2, c: DVec2) -> DVec2 {
    let (u, v) = (b - a, c - a);
    let (uu, vv) = (u.length_squared(), v.length_squared());
    a + DVec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / (2.0 * u.perp_dot(v))
}
