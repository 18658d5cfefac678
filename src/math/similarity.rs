//! Similarities of space (a turn, one scale, a place), the screws that lead from one to another, and paths of them
//! (spec/sweepers.md, A.1 and A.2). In 64 bits, with functions that give the same bits on every machine.

use glam::{DQuat, DVec3};

/// Below this modulus the quotients of [`Quotients`] are taken as series.
const SERIES: f64 = 1e-3;
/// A cosine of half a turn below this is a turn by π, whose axis has two directions.
const HALF_TURN: f64 = 1e-12;
/// Screws that one span of a smooth path is made of.
const SCREWS_A_SPAN: usize = 4;

/// A similarity: p goes to `scale` · (`turn` p) + `place`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Factor of lengths, above 0.
    pub scale: f64,
    /// Unit quaternion.
    pub turn: DQuat,
    /// Where the origin goes.
    pub place: DVec3,
}

/// The logarithm of a similarity: the velocity of a point p is `growth` · p + `turn` × p + `way`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Growth of lengths, κ.
    pub growth: f64,
    /// Axis times angle, θn.
    pub turn: DVec3,
    /// Velocity of the origin, u.
    pub way: DVec3,
}

/// a = (e^κ − 1)/κ and C + iS = (e^(κ+iθ) − 1)/(κ + iθ).
struct Quotients {
    a: f64,
    c: f64,
    s: f64,
}

impl Quotients {
    fn of(growth: f64, angle: f64) -> Self {
        let a = if growth.abs() < SERIES {
            1.0 + growth / 2.0 * (1.0 + growth / 3.0 * (1.0 + growth / 4.0 * (1.0 + growth / 5.0)))
        } else {
            libm::expm1(growth) / growth
        };
        let square = growth * growth + angle * angle;
        let (c, s) = if square < SERIES * SERIES {
            // 1 + z/2 (1 + z/3 (1 + z/4 (1 + z/5))), z = κ + iθ.
            let (mut re, mut im) = (1.0, 0.0);
            for n in [5.0, 4.0, 3.0, 2.0] {
                let next = (growth * re - angle * im, growth * im + angle * re);
                (re, im) = (1.0 + next.0 / n, next.1 / n);
            }
            (re, im)
        } else {
            let grown = libm::exp(growth);
            let half = libm::sin(angle / 2.0);
            // e^κ cosθ − 1, without a difference of like numbers.
            let re = libm::expm1(growth) - 2.0 * grown * half * half;
            let im = grown * libm::sin(angle);
            let re_by = (re * growth + im * angle) / square;
            (re_by, (im * growth - re * angle) / square)
        };
        Self { a, c, s }
    }
}

impl Similarity {
    /// Leaves every point where it is.
    pub const IDENTITY: Self = Self {
        scale: 1.0,
        turn: DQuat::IDENTITY,
        place: DVec3::ZERO,
    };

    /// With a turn that is a unit quaternion but for rounding.
    pub fn new(scale: f64, turn: DQuat, place: DVec3) -> Self {
        Self {
            scale,
            turn: unit(turn),
            place,
        }
    }

    /// Where a point goes.
    pub fn of(&self, pos: DVec3) -> DVec3 {
        self.turn * (pos * self.scale) + self.place
    }

    /// This similarity after another one.
    pub fn after(&self, first: &Self) -> Self {
        Self {
            scale: self.scale * first.scale,
            turn: unit(self.turn * first.turn),
            place: self.of(first.place),
        }
    }

    /// The similarity that takes every point back.
    pub fn inverse(&self) -> Self {
        let turn = self.turn.conjugate();
        Self {
            scale: 1.0 / self.scale,
            turn,
            place: turn * (-self.place / self.scale),
        }
    }

    /// The screw that leads here from the identity in a time of 1, by the short way round.
    pub fn log(&self) -> Screw {
        let growth = libm::log(self.scale);
        let turn = turn_of(self.turn);
        let angle = turn.length();
        let by = Quotients::of(growth, angle);
        let along = if angle > 0.0 { turn / angle } else { DVec3::Z };
        let on_axis = along * along.dot(self.place);
        let off_axis = self.place - on_axis;
        let across = off_axis * by.c - along.cross(off_axis) * by.s;
        Screw {
            growth,
            turn,
            way: on_axis / by.a + across / (by.c * by.c + by.s * by.s),
        }
    }
}

impl Screw {
    /// Moves nothing.
    pub const NONE: Self = Self {
        growth: 0.0,
        turn: DVec3::ZERO,
        way: DVec3::ZERO,
    };

    /// This screw for a part of the time, or for several times.
    pub fn times(&self, factor: f64) -> Self {
        Self {
            growth: self.growth * factor,
            turn: self.turn * factor,
            way: self.way * factor,
        }
    }

    /// Velocity of a point.
    pub fn velocity(&self, pos: DVec3) -> DVec3 {
        pos * self.growth + self.turn.cross(pos) + self.way
    }

    /// The same motion as it is seen from a pose that stands still.
    pub fn within(&self, pose: &Similarity) -> Self {
        let back = pose.turn.conjugate();
        Self {
            growth: self.growth,
            turn: back * self.turn,
            way: back * self.velocity(pose.place) / pose.scale,
        }
    }

    /// Where it leads from the identity in a time of 1.
    pub fn exp(&self) -> Similarity {
        let angle = self.turn.length();
        let by = Quotients::of(self.growth, angle);
        let along = if angle > 0.0 {
            self.turn / angle
        } else {
            DVec3::Z
        };
        let on_axis = along * along.dot(self.way);
        let off_axis = self.way - on_axis;
        Similarity {
            scale: libm::exp(self.growth),
            turn: turned(self.turn),
            place: on_axis * by.a + off_axis * by.c + along.cross(off_axis) * by.s,
        }
    }

    /// Longest velocity at distance 1 from a point that stays: √(κ² + θ²).
    pub fn rate(&self) -> f64 {
        libm::sqrt(self.growth * self.growth + self.turn.length_squared())
    }

    /// True if it moves nothing.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }
}

/// A smooth way through poses: places on Catmull-Rom curves whose ends are doubled, turns by the short way, scales
/// geometrically; four poses to a span. Fewer than three poses stay as they are.
pub fn smooth_path(keys: &[Similarity]) -> Vec<Similarity> {
    if keys.len() < 3 {
        return keys.to_vec();
    }
    let mut path = vec![keys[0]];
    for i in 0..keys.len() - 1 {
        let [from, to] = [keys[i], keys[i + 1]];
        let before = keys[i.saturating_sub(1)].place;
        let behind = keys[(i + 2).min(keys.len() - 1)].place;
        let turn = turn_of(unit(to.turn * from.turn.conjugate()));
        let growth = libm::log(to.scale / from.scale);
        for step in 1..SCREWS_A_SPAN {
            let t = step as f64 / SCREWS_A_SPAN as f64;
            let place = from.place * 2.0
                + (to.place - before) * t
                + (before * 2.0 - from.place * 5.0 + to.place * 4.0 - behind) * (t * t)
                + (from.place * 3.0 - before - to.place * 3.0 + behind) * (t * t * t);
            path.push(Similarity {
                scale: from.scale * libm::exp(growth * t),
                turn: unit(turned(turn * t) * from.turn),
                place: place * 0.5,
            });
        }
        path.push(to);
    }
    path
}

/// Axis times angle of a turn, by the short way; of half a turn about the axis whose first component that is not 0 is
/// above 0.
fn turn_of(turn: DQuat) -> DVec3 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let axis = DVec3::new(turn.x, turn.y, turn.z);
    let half = libm::sqrt(axis.length_squared());
    if half < HALF_TURN {
        return axis * 2.0;
    }
    let first = axis.to_array().into_iter().find(|x| x.abs() > HALF_TURN);
    let is_back = turn.w < HALF_TURN && first.is_some_and(|x| x < 0.0);
    let along = axis / if is_back { -half } else { half };
    along * (2.0 * libm::atan2(half, turn.w))
}

/// The turn about an axis by the length of the vector.
fn turned(turn: DVec3) -> DQuat {
    let angle = libm::sqrt(turn.length_squared());
    if angle < HALF_TURN {
        return unit(DQuat::from_xyzw(
            turn.x / 2.0,
            turn.y / 2.0,
            turn.z / 2.0,
            1.0,
        ));
    }
    let axis = turn * (libm::sin(angle / 2.0) / angle);
    DQuat::from_xyzw(axis.x, axis.y, axis.z, libm::cos(angle / 2.0))
}

/// A quaternion at length 1, which products lose by rounding.
fn unit(turn: DQuat) -> DQuat {
    let length = libm::sqrt(turn.length_squared());
    if length > 0.0 {
        turn / length
    } else {
        DQuat::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The matrix of a screw, and its power series: the exponential in other words.
    fn series(screw: &Screw, pos: DVec3) -> DVec3 {
        let linear = |v: DVec3| v * screw.growth + screw.turn.cross(v);
        let mut term = screw.velocity(pos);
        let mut sum = pos;
        for n in 1..80 {
            sum += term;
            term = linear(term) / f64::from(n + 1);
        }
        sum
    }

    fn screws() -> Vec<Screw> {
        let mut screws = Vec::new();
        let ways = [DVec3::ZERO, DVec3::new(0.3, -1.2, 0.7)];
        for growth in [-1.5, -0.2, -5e-4, 0.0, 1e-9, 3e-4, 0.7, 2.0] {
            for angle in [0.0, 1e-8, 5e-4, 0.3, 1.7, 3.1] {
                for way in ways {
                    let turn = DVec3::new(0.36, -0.48, 0.8) * angle;
                    screws.push(Screw { growth, turn, way });
                }
            }
        }
        screws
    }

    #[test]
    fn the_exponential_is_the_power_series_and_the_logarithm_takes_it_back() {
        let pos = DVec3::new(0.7, 0.2, -0.9);
        for screw in screws() {
            let pose = screw.exp();
            assert!(
                pose.of(pos).distance(series(&screw, pos)) < 1e-11,
                "{screw:?}"
            );
            let back = pose.log();
            assert!((back.growth - screw.growth).abs() < 1e-12, "{screw:?}");
            assert!(back.turn.distance(screw.turn) < 1e-11, "{screw:?} {back:?}");
            assert!(back.way.distance(screw.way) < 1e-11, "{screw:?} {back:?}");
            let there_and_back = pose.inverse().after(&pose);
            assert!(there_and_back.of(pos).distance(pos) < 1e-12, "{screw:?}");
        }
    }

    #[test]
    fn parts_of_a_screw_add_up() {
        for screw in screws() {
            let parts = screw.times(0.3).exp().after(&screw.times(0.7).exp());
            let pos = DVec3::new(-0.4, 1.1, 0.5);
            assert!(
                parts.of(pos).distance(screw.exp().of(pos)) < 1e-11,
                "{screw:?}"
            );
        }
    }

    #[test]
    fn half_a_turn_has_one_axis() {
        for sign in [1.0, -1.0] {
            let turn = DQuat::from_xyzw(-0.6 * sign, 0.8 * sign, 0.0, 0.0);
            let pose = Similarity {
                turn,
                ..Similarity::IDENTITY
            };
            let expected = DVec3::new(0.6, -0.8, 0.0) * PI;
            assert!(pose.log().turn.distance(expected) < 1e-12);
        }
    }

    #[test]
    fn a_smooth_path_meets_its_keys() {
        let key = |x: f64, y: f64, scale: f64, angle: f64| Similarity {
            scale,
            turn: turned(DVec3::new(0.0, 0.0, angle)),
            place: DVec3::new(x, y, 0.0),
        };
        let keys = [
            key(0.0, 0.0, 1.0, 0.0),
            key(1.0, 0.0, 4.0, 1.0),
            key(1.0, 1.0, 1.0, -1.0),
        ];
        let path = smooth_path(&keys);
        assert_eq!(path.len(), 9);
        for (i, key) in keys.iter().enumerate() {
            assert_eq!(path[4 * i], *key);
        }
        assert!((path[2].scale - 2.0).abs() < 1e-12);
        assert!((turn_of(path[2].turn).z - 0.5).abs() < 1e-12);
        // Half way of the first span, by the curve's own formula: (−p₀ + 9 p₀ + 9 p₁ − p₂)/16.
        assert!(path[2].place.distance(DVec3::new(0.5, -0.0625, 0.0)) < 1e-12);
        assert_eq!(smooth_path(&keys[..2]), keys[..2]);
    }
}
