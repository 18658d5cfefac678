//! The shapes of tools in 64 bits, for the clay (spec/sweepers.md, A.1 and A.4). The picture of a `sweep` has the same
//! shapes in shaders/displace/tools.wgsl; a test holds them together.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::data::{DistanceGrid, Grids};
use crate::displace::ToolShape;

/// Steps of Newton to the nearest point of an ellipsoid: enough for all ranges in 64 bits.
const ELLIPSOID_STEPS: usize = 40;

/// A tool's form in its own frame, subject units.
#[derive(Clone, Debug)]
pub(super) enum Form {
    Ball {
        radius: f64,
    },
    Ellipsoid {
        radii: DVec3,
    },
    Capsule {
        radius: f64,
        half: f64,
    },
    Box {
        core: DVec3,
        round: f64,
    },
    Torus {
        ring: f64,
        radius: f64,
    },
    Curve {
        points: Vec<DVec3>,
        radius: f64,
    },
    Grid {
        grid: Arc<DistanceGrid>,
        longest: f64,
    },
    /// A mesh that is not there: it holds nothing.
    Absent,
}

/// So far is everything from what is not there, subject units.
const FAR: f64 = 1e6;

impl Form {
    /// The form of a shape whose lengths are subject units.
    pub(super) fn new(shape: &ToolShape, grids: &Grids) -> Self {
        match shape {
            ToolShape::Ball { radius } => Self::Ball {
                radius: f64::from(*radius),
            },
            ToolShape::Ellipsoid { radii } => Self::Ellipsoid {
                radii: radii.as_dvec3(),
            },
            ToolShape::Capsule { radius, length } => Self::Capsule {
                radius: f64::from(*radius),
                half: 0.5 * f64::from(*length),
            },
            ToolShape::Box { half, round } => {
                let round = round.min(half.min_element());
                Self::Box {
                    core: half.as_dvec3() - f64::from(round),
                    round: f64::from(round),
                }
            }
            ToolShape::Torus { ring, radius } => Self::Torus {
                ring: f64::from(*ring),
                radius: f64::from(*radius),
            },
            ToolShape::Curve { points, radius } => Self::Curve {
                points: points.iter().map(|point| point.as_dvec3()).collect(),
                radius: f64::from(*radius),
            },
            ToolShape::Mesh { .. } | ToolShape::Clay { .. } => match grids.of(shape) {
                Some((grid, longest)) => Self::Grid {
                    grid: Arc::clone(grid),
                    longest: longest.into(),
                },
                None => Self::Absent,
            },
        }
    }

    /// Distance from the form, 0 inside, and its gradient: the direction away from the nearest point, 0 inside. That of
    /// a grid is a difference over a cell.
    pub(super) fn distance(&self, q: DVec3) -> (f64, DVec3) {
        match self {
            Self::Ball { radius } => beyond(q, *radius),
            Self::Ellipsoid { radii } => ellipsoid(q, *radii),
            Self::Capsule { radius, half } => {
                beyond(q - DVec3::Z * q.z.clamp(-half, *half), *radius)
            }
            Self::Box { core, round } => beyond(q - q.clamp(-*core, *core), *round),
            Self::Torus { ring, radius } => {
                let out = DVec2::new(q.x, q.y);
                let length = out.length();
                // On the axis all directions are equally near.
                let along = if length > 0.0 { out / length } else { DVec2::X };
                beyond(q - (along * *ring).extend(0.0), *radius)
            }
            Self::Curve { points, radius } => {
                let pieces = points.windows(2).map(|piece| {
                    let along = piece[1] - piece[0];
                    let square = along.length_squared().max(1e-20);
                    let part = ((q - piece[0]).dot(along) / square).clamp(0.0, 1.0);
                    q - piece[0] - along * part
                });
                let nearest = pieces.reduce(|a, b| {
                    if b.length_squared() < a.length_squared() {
                        b
                    } else {
                        a
                    }
                });
                beyond(nearest.unwrap_or(q), *radius)
            }
            Self::Grid { grid, longest } => {
                let (distance, gradient) = grid.distance_and_gradient(q / *longest);
                (distance * longest, gradient)
            }
            Self::Absent => (FAR, DVec3::ZERO),
        }
    }
}

/// What is left of a way from the middle of something round.
fn beyond(way: DVec3, radius: f64) -> (f64, DVec3) {
    let length = way.length();
    if length <= radius {
        return (0.0, DVec3::ZERO);
    }
    (length - radius, way / length)
}

/// The nearest point is a² q / (a² + t), where sum (a q / (a² + t))² = 1.
fn ellipsoid(q: DVec3, radii: DVec3) -> (f64, DVec3) {
    let inside = q / radii;
    if inside.length_squared() <= 1.0 {
        return (0.0, DVec3::ZERO);
    }
    let scaled = radii * q;
    let squares = radii * radii;
    // From the left of the root, where the sum is convex and falls: Newton stays on that side.
    let mut t = (radii * (q.abs() - radii)).max_element().max(0.0);
    for _ in 0..ELLIPSOID_STEPS {
        let part = (squares + t).recip();
        let ratio = scaled * part;
        let square = ratio * ratio;
        let slope = 2.0 * square.dot(part);
        let step = (square.element_sum() - 1.0) / slope.max(1e-300);
        if step <= t * 1e-15 {
            break;
        }
        t += step;
    }
    let along = q / (squares + t);
    let length = along.length();
    (t * length, along / length.max(1e-300))
}

/// The field at a distance in coatings, 1 from 0 down and 0 from 1 up, and its slope.
pub(super) fn falloff(x: f64) -> (f64, f64) {
    if x <= 0.0 {
        return (1.0, 0.0);
    }
    if x >= 1.0 {
        return (0.0, 0.0);
    }
    let left = 1.0 - x;
    let field = left * left * left * (1.0 + x * (3.0 + 6.0 * x));
    (field, -30.0 * (x * left) * (x * left))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forms() -> Vec<Form> {
        let names = ToolShape::NAMES.iter();
        let mut forms: Vec<Form> = names
            .map(|name| Form::new(&ToolShape::named(name).unwrap(), &Grids::default()))
            .collect();
        forms.push(Form::Ellipsoid {
            radii: DVec3::new(2.0, 0.005, 0.3),
        });
        forms
    }

    #[test]
    fn the_gradient_is_that_of_the_distance_and_leads_to_the_surface() {
        let mut state = 11_u32;
        let mut draw = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) * 1.2 - 0.6
        };
        for form in forms() {
            let mut outside = 0;
            for _ in 0..300 {
                let q = DVec3::new(draw(), draw(), draw());
                let (distance, gradient) = form.distance(q);
                if distance <= 1e-4 {
                    continue;
                }
                outside += 1;
                assert!((gradient.length() - 1.0).abs() < 1e-12, "{form:?} {q}");
                let (left, _) = form.distance(q - gradient * distance);
                assert!(left < 1e-7, "{form:?} {q} {left}");
                let (half, _) = form.distance(q - gradient * (0.5 * distance));
                assert!((half - 0.5 * distance).abs() < 1e-9, "{form:?} {q}");
            }
            assert!(outside > 50, "{form:?}");
        }
    }

    #[test]
    fn the_falloff_is_the_polynomial_of_the_paper() {
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let (field, slope) = falloff(x);
            let paper = 1.0 + x * x * x * (x * (15.0 - 6.0 * x) - 10.0);
            assert!((field - paper).abs() < 1e-14);
            let h = 1e-6;
            let difference = (falloff(x + h).0 - falloff(x - h).0) / (2.0 * h);
            assert!((slope - difference).abs() < 1e-6, "{x}");
        }
        assert_eq!(falloff(-1.0), (1.0, 0.0));
        assert_eq!(falloff(1.0), (0.0, 0.0));
    }
}
