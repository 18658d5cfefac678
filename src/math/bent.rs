use super::Aabb;
use glam::{DVec2, Vec2, Vec3};

/// Straight segments that a spline is drawn with: as many to each of its spans as make up this number, so that its
/// corners are as blunt as possible and its own points are among them.
const SPLINE_SEGMENTS: usize = 16;
/// Points nearer to each other than this count as one point, template units.
const SAME_PLACE: f64 = 1e-3;
/// Cosine of the sharpest turn that a corner may have: the mitre of a sharper corner is too long to be of use.
const SHARPEST: f64 = -0.5;
/// Beside the curve, segments get shorter on the inner side. Where less than this fraction of the length is left, the
/// space folds and nothing is displaced.
const LEAST_ROOM: f32 = 0.05;
/// How far beyond a mitre line a point still belongs to the segment, as a fraction of its length, so that rounding
/// leaves no gap between two segments.
const PAST_MITRE: f32 = 1e-4;
/// A length that stands for infinity where arithmetic with infinity would give NaN.
const FAR: f32 = 1e3;

/// Why points make no line that a space can be bent along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotBent {
    /// Fewer than two points that are apart from each other.
    TooShort,
    /// The line turns back on itself.
    TurnsBack,
}

/// A corner of the line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Joint {
    /// Position along x and z of the straight box, measured from its corner, subject units.
    at: Vec2,
    /// Offset from the corner to the point at unit distance from the line, on the mitred normal.
    mitre: Vec2,
}

/// The space of a box that is bent along a line in its x-z plane (Correa, section 5.3); y stays straight. The map W(s,
/// t) is bilinear between the mitred normals of the line, with the arc length `s` and the distance `t` from the line.
/// Before the first and after the last point the line goes straight on.
///
/// ```text
///      m0      m1        m2        the line begins at x = 0 and ends at x = 1, in proportion to its length;
///      |  t    |  s → __/          the line itself lies at z = height.
///      p0 ---- p1 ---p2
/// ```
///
/// The shader displace/curve.wgsl gets the same numbers ([`Bent::rows`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Bent {
    joints: Vec<Joint>,
    /// Sides of the straight box, subject units.
    straight: Vec3,
    /// Sides of the box that is laid along the line, subject units.
    size: Vec3,
    /// Position along the box at which the line begins, and its height over the bottom, subject units.
    origin: Vec2,
    /// The line stands for a smooth one: its corners are no edges.
    is_smooth: bool,
}

/// The part of a box that lies on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnLine {
    /// Height (z) of the plane that lies on the line, template units.
    pub height: f32,
    /// x of the planes that lie at the first and at the last point, template units.
    pub ends: [f32; 2],
}

impl OnLine {
    /// The top, from x = 0 to x = 1.
    pub const TOP: Self = Self {
        height: 1.0,
        ends: [0.0, 1.0],
    };
}

impl Bent {
    /// The space bent along these points (x and z of the straight box, template units): along a Catmull-Rom spline, or
    /// straight from each point to the next.
    ///
    /// # Errors
    /// [`NotBent`].
    pub fn new(
        places: &[Vec2],
        is_spline: bool,
        straight: Vec3,
        on_line: OnLine,
    ) -> Result<Self, NotBent> {
        // Mitres are differences of nearly equal directions: 64 bits keep their digits.
        let mut line: Vec<DVec2> = Vec::with_capacity(2 * SPLINE_SEGMENTS);
        let mut add = |place: DVec2| {
            let is_new = line
                .last()
                .is_none_or(|last| last.distance(place) >= SAME_PLACE);
            if is_new {
                line.push(place);
            }
        };
        let known = places.iter().filter(|place| place.is_finite());
        let places: Vec<DVec2> = known.map(|place| place.as_dvec2()).collect();
        let place = |i: usize| places.get(i).copied();
        let spans = places.len().saturating_sub(1);
        let per_span = if is_spline && spans > 1 {
            SPLINE_SEGMENTS.div_ceil(spans)
        } else {
            1
        };
        for piece in 0..=spans * per_span {
            let (i, part) = (piece / per_span, piece % per_span);
            let (Some(from), Some(to)) = (place(i), place(i + 1)) else {
                place(i).into_iter().for_each(&mut add);
                break;
            };
            // Beyond its ends the line goes straight on.
            let before = i.checked_sub(1).and_then(place);
            let before = before.unwrap_or(2.0 * from - to);
            let after = place(i + 2).unwrap_or(2.0 * to - from);
            let u = part as f64 / per_span as f64;
            let (u2, u3) = (u * u, u * u * u);
            let sum = 2.0 * from
                + (to - before) * u
                + (2.0 * before - 5.0 * from + 4.0 * to - after) * u2
                + (3.0 * from - before - 3.0 * to + after) * u3;
            add(0.5 * sum);
        }
        let flat = Vec2::new(straight.x, straight.z).as_dvec2();
        let line: Vec<DVec2> = line.into_iter().map(|place| place * flat).collect();
        let steps: Vec<DVec2> = line.windows(2).map(|two| two[1] - two[0]).collect();
        let length: f64 = steps.iter().map(|step| step.length()).sum();
        let ways: Vec<DVec2> = steps.iter().map(|step| step.normalize_or_zero()).collect();
        let [Some(first), Some(last)] = [ways.first(), ways.last()] else {
            return Err(NotBent::TooShort);
        };
        if ways.contains(&DVec2::ZERO) || !length.is_finite() {
            return Err(NotBent::TooShort);
        }
        let mut joints = Vec::with_capacity(line.len());
        for (i, &at) in line.iter().enumerate() {
            let before = i.checked_sub(1).and_then(|i| ways.get(i)).unwrap_or(first);
            let after = ways.get(i).unwrap_or(last);
            let cos = before.dot(*after);
            if cos < SHARPEST {
                return Err(NotBent::TurnsBack);
            }
            let mitre = (before.perp() + after.perp()) / (1.0 + cos);
            joints.push(Joint {
                at: at.as_vec2(),
                mitre: mitre.as_vec2(),
            });
        }
        let [from, to] = on_line.ends;
        let per_unit = length as f32 / (to - from);
        Ok(Self {
            joints,
            straight,
            size: Vec3::new(per_unit, straight.y, straight.z),
            origin: Vec2::new(from * per_unit, on_line.height * straight.z),
            is_smooth: is_spline,
        })
    }

    /// Sides of the box that is laid along the line, subject units. The template acts in a box of this size.
    pub fn size(&self) -> Vec3 {
        self.size
    }

    /// As the shader takes it: x where the line begins along the box, y its height over the bottom, z the number of
    /// segments (below 0: lit as a smooth line), w the straight box's side along x; then place and mitre of every
    /// corner.
    pub fn rows(&self) -> Vec<[f32; 4]> {
        let segments = self.joints.len() - 1;
        let head = [
            self.origin.x,
            self.origin.y,
            if self.is_smooth {
                -(segments as f32)
            } else {
                segments as f32
            },
            self.straight.x,
        ];
        let corners = self.joints.iter();
        let corners = corners.map(|j| [j.at.x, j.at.y, j.mitre.x, j.mitre.y]);
        std::iter::once(head).chain(corners).collect()
    }

    fn segments(&self) -> impl Iterator<Item = (usize, &Joint, &Joint)> {
        let ends = self.joints.iter().skip(1);
        let pairs = self.joints.iter().zip(ends);
        pairs.enumerate().map(|(i, (from, to))| (i, from, to))
    }

    fn last(&self) -> usize {
        self.joints.len() - 2
    }

    /// Template space to the space of the straight box, both in template units.
    pub fn bend(&self, q: Vec3) -> Vec3 {
        let s = q.x * self.size.x - self.origin.x;
        let t = q.z * self.size.z - self.origin.y;
        let at = self.at(s, t);
        Vec3::new(at.x / self.straight.x, q.y, at.y / self.straight.z)
    }

    /// Maps arc length `s` and distance `t` from the line to the straight box's x-z plane, subject units (Correa,
    /// section 5.3, W(s, t)).
    fn at(&self, s: f32, t: f32) -> Vec2 {
        let mut start = 0.0;
        let mut found = Vec2::ZERO;
        for (i, from, to) in self.segments() {
            let along = to.at - from.at;
            let length = along.length();
            if i == 0 || s > start {
                let way = s - start;
                let part = (way / length).clamp(0.0, 1.0);
                let (low, high) = (from.at + t * from.mitre, to.at + t * to.mitre);
                found = low.lerp(high, part) + along / length * (way - part * length);
            }
            start += length;
        }
        found
    }

    /// The space of the straight box to template space; `None` at points that the bent space does not reach.
    pub fn unbend(&self, q: Vec3) -> Option<Vec3> {
        let at = Vec2::new(q.x * self.straight.x, q.z * self.straight.z);
        let mut nearest: Option<(f32, f32)> = None;
        let mut start = 0.0;
        for (i, from, to) in self.segments() {
            let along = to.at - from.at;
            let length = along.length();
            let way = along / length;
            let (u, t) = ((at - from.at).dot(way), way.perp_dot(at - from.at));
            let low = t * from.mitre.dot(way);
            let room = length + t * (to.mitre - from.mitre).dot(way);
            let part = (u - low) / room;
            let is_beyond = (i == 0 && u < 0.0) || (i == self.last() && u > length);
            let is_inside =
                room > LEAST_ROOM * length && (-PAST_MITRE..=1.0 + PAST_MITRE).contains(&part);
            if (is_beyond || is_inside) && nearest.is_none_or(|(_, best)| t.abs() < best.abs()) {
                let s = if is_beyond {
                    u
                } else {
                    part.clamp(0.0, 1.0) * length
                };
                nearest = Some((start + s, t));
            }
            start += length;
        }
        let (s, t) = nearest?;
        Some(Vec3::new(
            (s + self.origin.x) / self.size.x,
            q.y,
            (t + self.origin.y) / self.size.z,
        ))
    }

    /// The smallest ratio of a segment's length at distance `t` from the line to its length on the line: 1 on the line,
    /// below 0 where the space folds.
    fn room(&self, t: f32) -> f32 {
        let rooms = self.segments().map(|(_, from, to)| {
            let along = to.at - from.at;
            1.0 + t * (to.mitre - from.mitre).dot(along) / along.length_squared()
        });
        rooms.fold(1.0, f32::min)
    }

    /// True if the line is bent more sharply than a layer under the top of the box is deep (`layer` as a fraction of
    /// the height): the layer folds there, and nothing is displaced.
    pub fn is_folded(&self, layer: f32) -> bool {
        [1.0 - layer, 1.0]
            .map(|z| self.room(z * self.size.z - self.origin.y))
            .iter()
            .any(|room| *room < LEAST_ROOM)
    }

    /// The height nearest to `z` that is not beyond a fold, template units: how deep an outline can be drawn.
    pub fn unfolded(&self, z: f32) -> f32 {
        let t = z * self.size.z - self.origin.y;
        let t = self.segments().fold(t, |t, (_, from, to)| {
            let along = to.at - from.at;
            let per_unit = (to.mitre - from.mitre).dot(along) / along.length_squared();
            let farthest = (LEAST_ROOM - 1.0) / per_unit;
            if per_unit > 0.0 {
                t.max(farthest)
            } else if per_unit < 0.0 {
                t.min(farthest)
            } else {
                t
            }
        });
        (t + self.origin.y) / self.size.z
    }

    /// A range of heights z (template units) as distances t from the line, with finite ends.
    fn across(&self, z: [f32; 2]) -> [f32; 2] {
        z.map(|z| (z * self.size.z - self.origin.y).clamp(-FAR, FAR))
    }

    /// Between two heights, the greatest ratio of a step's length in template space to its length in the straight box,
    /// both in subject units.
    pub fn stretch(&self, z: [f32; 2]) -> f32 {
        let least = self.across(z).map(|t| self.room(t).max(LEAST_ROOM));
        let slant = self.slant();
        (1.0 + slant * slant).sqrt() / least[0].min(least[1])
    }

    /// Between two heights, the greatest ratio of a step's length in the straight box to its length in template space,
    /// both in subject units.
    pub fn widening(&self, z: [f32; 2]) -> f32 {
        let most = self.across(z).map(|t| {
            let rooms = self.segments().map(|(_, from, to)| {
                let along = to.at - from.at;
                (1.0 + t * (to.mitre - from.mitre).dot(along) / along.length_squared()).abs()
            });
            rooms.fold(1.0, f32::max)
        });
        let slant = self.slant();
        // Along the line the widest line decides, across it the longest mitre.
        (most[0].max(most[1]).powi(2) + 1.0 + slant * slant).sqrt()
    }

    /// The greatest lean of a mitre: the tangent of half the sharpest turn.
    fn slant(&self) -> f32 {
        let leans = self.segments().flat_map(|(_, from, to)| {
            let way = (to.at - from.at).normalize_or_zero();
            [from.mitre.dot(way).abs(), to.mitre.dot(way).abs()]
        });
        leans.fold(0.0, f32::max)
    }

    /// The box, in the space of the straight box, that holds the image of a box of template space. Infinite sides get
    /// finite ends far away.
    pub fn bent_box(&self, own: Aabb) -> Aabb {
        if own.is_empty() {
            return Aabb::EMPTY;
        }
        let along = [own.min.x, own.max.x].map(|x| {
            let s = x * self.size.x - self.origin.x;
            s.clamp(-FAR, FAR)
        });
        let across = self.across([own.min.z, own.max.z]);
        // The map is bilinear between two corners of the line, so its extremes are at the corners of the pieces.
        let mut cuts = along.to_vec();
        let mut start = 0.0;
        for (_, from, to) in self.segments() {
            cuts.push(start);
            start += from.at.distance(to.at);
        }
        cuts.push(start);
        let cuts = cuts.iter().map(|s| s.clamp(along[0], along[1]));
        let corners = cuts.flat_map(|s| across.map(|t| self.at(s, t)));
        let flat = Vec2::new(self.straight.x, self.straight.z);
        let corners = corners.map(|at| at / flat);
        let bounds = Aabb::from_points(corners.map(|at| Vec3::new(at.x, 0.0, at.y)));
        let mut bounds = bounds.expanded(1e-4);
        (bounds.min.y, bounds.max.y) = (own.min.y, own.max.y);
        bounds
    }

    /// The box of template space that holds everything that is seen inside a box of the straight space.
    pub fn unbent_box(&self, straight: Aabb) -> Aabb {
        if straight.is_empty() {
            return Aabb::EMPTY;
        }
        let corners = straight.corners().map(|q| {
            let at = Vec2::new(q.x * self.straight.x, q.z * self.straight.z);
            at.clamp(Vec2::splat(-FAR), Vec2::splat(FAR))
        });
        let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let mut start = 0.0;
        for (i, from, to) in self.segments() {
            let along = to.at - from.at;
            let length = along.length();
            for at in corners {
                let u = (at - from.at).dot(along) / length;
                let t = along.perp_dot(at - from.at) / length;
                // Beyond its ends the line goes on; between them s stays between the ends.
                let before = if i == 0 { u.min(0.0) } else { 0.0 };
                let after = if i == self.last() {
                    u.max(length)
                } else {
                    length
                };
                low = low.min(Vec2::new(start + before, t));
                high = high.max(Vec2::new(start + after, t));
            }
            start += length;
        }
        let to_own = |st: Vec2| (st + self.origin) / Vec2::new(self.size.x, self.size.z);
        let (low, high) = (to_own(low), to_own(high));
        Aabb {
            min: Vec3::new(low.x, straight.min.y, low.y),
            max: Vec3::new(high.x, straight.max.y, high.y),
        }
    }

    /// The line itself and the line at distance `z` from it, as points of the straight box, template units.
    pub fn beside(&self, t: f32) -> Vec<Vec2> {
        let flat = Vec2::new(self.straight.x, self.straight.z);
        let corners = self.joints.iter();
        corners.map(|j| (j.at + t * j.mitre) / flat).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec3 = Vec3::new(0.8, 0.5, 0.3);

    fn dome(is_spline: bool) -> Bent {
        let places = [[0.0, 0.6], [0.3, 1.0], [0.7, 1.05], [1.0, 0.5]].map(Vec2::from_array);
        Bent::new(&places, is_spline, SIZE, OnLine::TOP).expect("it is bent")
    }

    #[test]
    fn back_and_forth_is_nothing() {
        for bent in [dome(true), dome(false)] {
            for i in 0..2000_u16 {
                let [a, b, c] =
                    [0.618_034, 0.754_878, 0.569_84].map(|k| (f32::from(i) * k).fract());
                let own = Vec3::new(3.0 * a - 1.0, b, 0.2 + 2.0 * c);
                let back = bent.unbend(bent.bend(own)).expect("it is laid there");
                assert!((back - own).length() < 2e-5, "{own} came back as {back}");
            }
        }
    }

    /// A spline of any number of points goes through each of them, and turns no more at a corner than the sixteen
    /// pieces did that left its points aside.
    #[test]
    fn a_spline_meets_its_own_points() {
        for count in 3..=9_usize {
            let places: Vec<Vec2> = (0..count)
                .map(|i| {
                    let x = i as f32 / (count - 1) as f32;
                    Vec2::new(x, if i % 2 == 0 { 0.8 } else { 1.0 })
                })
                .collect();
            let bent = Bent::new(&places, true, SIZE, OnLine::TOP).expect("it is bent");
            let corners = bent.beside(0.0);
            assert!(corners.len() > 16, "{count} points: {}", corners.len());
            for place in &places {
                let ways = corners.iter().map(|corner| corner.distance(*place));
                let nearest = ways.fold(f32::INFINITY, f32::min);
                assert!(
                    nearest < 1e-6,
                    "{count} points: {place} missed by {nearest}"
                );
            }
            // Negative control: the places between are no corners.
            let between = places[0].lerp(places[1], 0.5);
            let ways = corners.iter().map(|corner| corner.distance(between));
            assert!(ways.fold(f32::INFINITY, f32::min) > 1e-3);
        }
    }

    #[test]
    fn a_straight_line_bends_nothing() {
        let places = [
            Vec2::new(0.0, 1.0),
            Vec2::new(0.4, 1.0),
            Vec2::new(1.0, 1.0),
        ];
        for is_spline in [true, false] {
            let bent = Bent::new(&places, is_spline, SIZE, OnLine::TOP).expect("a line");
            for q in [
                Vec3::ZERO,
                Vec3::new(-2.0, 0.1, 4.0),
                Vec3::new(0.3, 0.9, 0.2),
            ] {
                assert!((bent.bend(q) - q).length() < 1e-5);
                assert!((bent.unbend(q).expect("everywhere") - q).length() < 1e-5);
            }
            assert!(!bent.is_folded(1.0));
            assert!((bent.size() - SIZE).length() < 1e-6);
        }
    }

    #[test]
    fn lengths_on_the_line_are_kept() {
        let bent = dome(true);
        let mut way = 0.0;
        for i in 0..100_u8 {
            let [a, b] = [i, i + 1].map(|i| {
                let at = bent.bend(Vec3::new(f32::from(i) / 100.0, 0.0, 1.0));
                at * SIZE
            });
            way += a.distance(b);
        }
        // Chords cut the corners by a little.
        assert!((way - bent.size().x).abs() < 2e-3, "{way}");
    }

    #[test]
    fn boxes_hold_what_they_should() {
        for bent in [dome(true), dome(false)] {
            let own = Aabb {
                min: Vec3::new(-0.2, 0.0, 0.5),
                max: Vec3::new(0.8, 1.0, 1.6),
            };
            let seen = bent.bent_box(own);
            let straight = Aabb {
                min: Vec3::new(-0.4, 0.2, -0.3),
                max: Vec3::new(0.9, 0.6, 1.2),
            };
            let held = bent.unbent_box(straight).expanded(1e-4);
            for i in 0..3000_u16 {
                let [a, b, c] =
                    [0.618_034, 0.754_878, 0.569_84].map(|k| (f32::from(i) * k).fract());
                let part = Vec3::new(a, b, c);
                assert!(seen.contains(bent.bend(own.min + own.size() * part)));
                let q = straight.min + straight.size() * part;
                if let Some(own) = bent.unbend(q) {
                    assert!(held.contains(own), "{q} comes from {own}, outside {held:?}");
                }
            }
        }
    }

    #[test]
    fn steps_are_no_longer_than_said() {
        let bent = dome(false);
        let z = [0.3, 1.8];
        let (stretch, widening) = (bent.stretch(z), bent.widening(z));
        for i in 0..3000_u16 {
            let [a, b, c] = [0.618_034, 0.754_878, 0.569_84].map(|k| (f32::from(i) * k).fract());
            let own = Vec3::new(1.6 * a - 0.3, 0.5, 0.3 + 1.5 * b);
            let turn = std::f32::consts::TAU * c;
            let step = 1e-3 * Vec3::new(turn.cos(), 0.0, turn.sin()) / bent.size();
            if (own + step).z < z[0] || (own + step).z > z[1] {
                continue;
            }
            let seen = (bent.bend(own + step) - bent.bend(own)) * SIZE;
            let ratio = seen.length() / 1e-3;
            assert!(
                ratio <= widening * 1.001,
                "{ratio} is wider than {widening}"
            );
            assert!(
                1.0 / ratio <= stretch * 1.02,
                "{ratio} is less than 1 / {stretch}"
            );
        }
    }

    #[test]
    fn what_cannot_be_bent_says_so() {
        let bent = |places: &[[f32; 2]], is_spline| {
            let places: Vec<Vec2> = places.iter().map(|p| Vec2::from_array(*p)).collect();
            Bent::new(&places, is_spline, SIZE, OnLine::TOP)
        };
        for is_spline in [true, false] {
            assert_eq!(bent(&[], is_spline), Err(NotBent::TooShort));
            assert_eq!(bent(&[[0.5, 1.0]], is_spline), Err(NotBent::TooShort));
            let same = [[0.5, 1.0]; 9];
            assert_eq!(bent(&same, is_spline), Err(NotBent::TooShort));
        }
        let back = [[0.0, 1.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(bent(&back, false), Err(NotBent::TurnsBack));
        assert!(bent(&[[0.0, f32::NAN], [1.0, 1.0], [2.0, 1.0]], false).is_ok());
        let sharp = [[0.0, 0.4], [0.5, 1.0], [1.0, 0.4]];
        let sharp = bent(&sharp, true).expect("it is bent");
        let doubled = [[0.0, 0.4], [0.0, 0.4], [0.5, 1.0], [0.5, 1.0], [1.0, 0.4]];
        assert!(bent(&doubled, false).is_ok());
        // Whatever the depth, there are numbers.
        for z in [-50.0, -1.0, 0.0, 0.5, 3.0] {
            assert!(sharp.bend(Vec3::new(0.5, 0.5, z)).is_finite());
        }
        let deep = Bent::new(
            &[[0.0, 0.9], [0.5, 1.0], [1.0, 0.9]].map(Vec2::from_array),
            true,
            Vec3::new(0.1, 0.5, 2.0),
            OnLine::TOP,
        );
        assert!(deep.expect("it is bent").is_folded(1.0));
    }
}
