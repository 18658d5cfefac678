use glam::DVec2;

use super::trigonometric::Trigonometric;
use crate::figure::complex::mul;

/// A triangle at rest with the gradients of its hat functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    /// Numbers of its corners in the mesh.
    pub(crate) vertices: [u32; 3],
    /// Gradients of the hat functions at rest.
    pub(crate) gradients: [DVec2; 3],
    /// Its area at rest.
    pub(crate) area: f64,
}

/// Gradients of the two coordinates of a map on a triangle: its rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rows(pub(crate) DVec2, pub(crate) DVec2);

impl Element {
    /// The triangle of these vertices whose corners lie there at rest, counter-clockwise.
    pub(crate) fn new(vertices: [u32; 3], [a, b, c]: [DVec2; 3]) -> Self {
        let twice = (b - a).perp_dot(c - a);
        Self {
            vertices,
            gradients: [
                (c - b).perp() / twice,
                (a - c).perp() / twice,
                (b - a).perp() / twice,
            ],
            area: twice / 2.0,
        }
    }

    /// Gradients of places of the vertices.
    pub(crate) fn rows(&self, places: &[DVec2]) -> Rows {
        let mut rows = Rows(DVec2::ZERO, DVec2::ZERO);
        for (vertex, gradient) in self.vertices.iter().zip(&self.gradients) {
            let place = places[*vertex as usize];
            rows.0 += place.x * *gradient;
            rows.1 += place.y * *gradient;
        }
        rows
    }
}

impl Rows {
    /// These rows turned and scaled by a complex number.
    pub(crate) fn turned(&self, z: DVec2) -> Self {
        Self(z.x * self.0 - z.y * self.1, z.y * self.0 + z.x * self.1)
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }

    /// Σ k²|row|², without the area.
    pub(crate) fn energy(&self, k2: DVec2) -> f64 {
        k2.x * self.0.length_squared() + k2.y * self.1.length_squared()
    }
}

/// The turn, as cosine and sine, that leaves least energy between the gradients of a deformation and those of the base
/// shape, scaled by `scale` and turned (spec/figures.md, round (a)).
pub(crate) fn best_turn(deformed: &Rows, base: &Rows, k2: DVec2, scale: f64) -> DVec2 {
    let m11 = k2.x * deformed.0.dot(base.0);
    let m12 = k2.x * deformed.0.dot(base.1);
    let m21 = k2.y * deformed.1.dot(base.0);
    let m22 = k2.y * deformed.1.dot(base.1);
    let (cos, sin) = (m11 + m22, m21 - m12);
    let uneven = (k2.x - k2.y) * scale;
    let (double_cos, double_sin) = (
        uneven * 0.5 * (base.0.length_squared() - base.1.length_squared()),
        -uneven * base.0.dot(base.1),
    );
    // At rest the rows are x and y to rounding, and a turn changes no length.
    let is_even = double_cos.abs() + double_sin.abs() <= 1e-12 * uneven.abs();
    if is_even {
        let length = (cos * cos + sin * sin).sqrt();
        return if length > 0.0 {
            DVec2::new(cos, sin) / length
        } else {
            DVec2::X
        };
    }
    Trigonometric {
        cos: -2.0 * cos,
        sin: -2.0 * sin,
        double_cos,
        double_sin,
    }
    .least()
}

/// What the energy of a triangle has of the turn z = scale·(cos α, sin α) of some of its vertices, f = place + z·arm,
/// and perhaps of its own turn.
///
/// `left` are the gradients of what does not depend on α, less what they should be; `arms` those of the arms, less
/// those of the base shape if the triangle's own turn is z.
pub(crate) fn energy_of_turn(
    left: &Rows,
    arms: &Rows,
    scale: f64,
    k2: DVec2,
    weight: f64,
) -> Trigonometric {
    let p = scale * arms.0;
    let q = -scale * arms.1;
    // Rows: left.0 + cos·p + sin·q and left.1 − cos·q + sin·p.
    let cos = 2.0 * (k2.x * left.0.dot(p) - k2.y * left.1.dot(q));
    let sin = 2.0 * (k2.x * left.0.dot(q) + k2.y * left.1.dot(p));
    let (pp, qq, pq) = (p.length_squared(), q.length_squared(), p.dot(q));
    let squares = (k2.x - k2.y) * (pp - qq);
    let products = 2.0 * (k2.x - k2.y) * pq;
    Trigonometric {
        cos: weight * cos,
        sin: weight * sin,
        double_cos: weight * 0.5 * squares,
        double_sin: weight * 0.5 * products,
    }
}

/// A place carried by a turn about a pivot.
pub(crate) fn turned_about(pivot: DVec2, place: DVec2, z: DVec2, at: DVec2) -> DVec2 {
    place + mul(z, at - pivot)
}
