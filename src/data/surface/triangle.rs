//! One triangle: the nearest point, where a line crosses, and the solid angle.

use glam::{DVec3, Vec3};

/// The corners of a triangle, rest space, counter-clockwise seen from its front.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Triangle(pub [Vec3; 3]);

/// The point of triangles that is nearest to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Index of the triangle.
    pub triangle: usize,
    /// The nearest point, in the space of the triangles.
    pub point: Vec3,
    /// From the place to the point.
    pub distance: f32,
}

impl Triangle {
    /// Normal of the front, as long as twice the area.
    pub fn area_normal(&self) -> Vec3 {
        let [a, b, c] = self.0;
        (b - a).cross(c - a)
    }

    /// The point nearest to a place (Ericson, Real-Time Collision Detection, section 5.1.5).
    pub fn nearest_point(&self, place: Vec3) -> Vec3 {
        let [a, b, c] = self.0;
        let (ab, ac, ap) = (b - a, c - a, place - a);
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let bp = place - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return a + ab * (d1 / (d1 - d3));
        }
        let cp = place - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return a + ac * (d2 / (d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
            let part = (d4 - d3) / ((d4 - d3) + (d5 - d6));
            return b + (c - b) * part;
        }
        let scale = 1.0 / (va + vb + vc);
        a + ab * (vb * scale) + ac * (vc * scale)
    }

    /// Where on the way from a place a line crosses, 0 to 1, and whether it comes from the front.
    ///
    /// By volumes of tetrahedra, whose signs agree for triangles that share an edge, so that no line slips through
    /// between two of them (Segura, Feito 2001).
    pub fn crossing(&self, from: Vec3, way: Vec3) -> Option<(f32, bool)> {
        let [a, b, c] = self.0.map(|corner| corner - from);
        let (u, v, w) = (
            edge_side(way, c, b),
            edge_side(way, a, c),
            edge_side(way, b, a),
        );
        let is_front = u >= 0.0 && v >= 0.0 && w >= 0.0;
        let is_back = u <= 0.0 && v <= 0.0 && w <= 0.0;
        let sum = u + v + w;
        if !(is_front || is_back) || sum == 0.0 {
            return None;
        }
        let part =
            (u * a.dot(way) + v * b.dot(way) + w * c.dot(way)) / (sum * way.length_squared());
        // Fronts are met against their normal.
        (0.0..=1.0)
            .contains(&part)
            .then(|| (part, self.area_normal().dot(way) < 0.0))
    }

    /// Half of the signed solid angle seen from a place, positive where the back is seen (van Oosterom, Strackee 1983).
    pub fn half_solid_angle(&self, place: DVec3) -> f64 {
        let [a, b, c] = self.0.map(|corner| corner.as_dvec3() - place);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        a.dot(b.cross(c)).atan2(below)
    }
}

/// On which side of an edge a line through the origin passes; exactly negated if the corners are swapped.
fn edge_side(way: Vec3, p: Vec3, q: Vec3) -> f32 {
    // The order of the corners is made the same for both triangles of the edge, so that rounding is too.
    let is_swapped = (p.x, p.y, p.z) > (q.x, q.y, q.z);
    let (p, q) = if is_swapped { (q, p) } else { (p, q) };
    let side = way.dot(p.cross(q));
    if is_swapped { -side } else { side }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::surface::testing::{Random, soup};

    #[test]
    fn the_nearest_point_is_no_farther_than_any_other() {
        let mut random = Random(1);
        for corners in soup(50, 2) {
            let triangle = Triangle(corners);
            for _ in 0..20 {
                let place = random.place();
                let nearest = triangle.nearest_point(place).distance(place);
                let [a, b, c] = triangle.0;
                for i in 0..=20 {
                    for j in 0..=20 - i {
                        let (u, v) = (i as f32 / 20.0, j as f32 / 20.0);
                        let point = a + (b - a) * u + (c - a) * v;
                        assert!(nearest <= point.distance(place) + 1e-5);
                    }
                }
            }
        }
    }

    #[test]
    fn lines_cross_where_they_should() {
        let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
        let down = triangle.crossing(Vec3::new(0.2, 0.2, 1.0), Vec3::new(0.0, 0.0, -4.0));
        assert_eq!(down, Some((0.25, true)));
        let up = triangle.crossing(Vec3::new(0.2, 0.2, -1.0), Vec3::new(0.0, 0.0, 4.0));
        assert_eq!(up, Some((0.25, false)));
        assert_eq!(
            triangle.crossing(Vec3::new(0.7, 0.7, 1.0), Vec3::NEG_Z * 4.0),
            None
        );
        assert_eq!(
            triangle.crossing(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z * 0.5),
            None
        );
        // A line in the plane crosses nothing.
        assert_eq!(
            triangle.crossing(Vec3::new(-1.0, 0.2, 0.0), Vec3::X * 4.0),
            None
        );
    }

    #[test]
    fn no_line_slips_through_a_shared_edge() {
        let mut random = Random(9);
        for _ in 0..2000 {
            let corners: [Vec3; 4] = std::array::from_fn(|_| random.place());
            let [a, b, c, d] = corners;
            // Two triangles on either side of the edge from a to b, and a line that meets the edge nearly.
            let on_edge = a + (b - a) * 0.3;
            let way = (random.place() - on_edge) * 2.0;
            let from = on_edge - way * 0.5;
            let [one, other] = [Triangle([a, b, c]), Triangle([b, a, d])];
            let normal = one.area_normal().dot(way) * other.area_normal().dot(way);
            if normal > 0.0 {
                let hits = [one, other].map(|t| t.crossing(from, way).is_some());
                assert!(hits[0] || hits[1]);
            }
        }
    }
}
