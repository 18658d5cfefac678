//! Section 6.3: normals by each method against those of an object whose deformed surface is known, and 6.3.1: its shape
//! from them.

use super::bench::{LIGHT, METHODS, Method, Object, Scan, jacobian};
use crate::reference::{self, Placed, as_reference};
use fabrica::document::PlacedTemplate;
use glam::DVec3;

/// Places on the deformed surface with their normals.
pub(crate) struct Surface {
    places: Vec<(DVec3, DVec3)>,
}

/// Signed distance at rest of the material at a place of the deformed object; outside in a gap.
fn distance(object: Object, list: &[Placed], pos: DVec3) -> f64 {
    let (rest, a) = reference::map(list, pos);
    if a < 0.0 { 1.0 } else { object.distance(rest) }
}

/// Where a ray meets the surface first, to 1e-9 units.
fn hit(object: Object, list: &[Placed], from: DVec3, dir: DVec3, length: f64) -> Option<DVec3> {
    let step = 0.004;
    let mut low = 0.0;
    while distance(object, list, from + dir * (low + step)) > 0.0 {
        low += step;
        if low > length {
            return None;
        }
    }
    let mut high = low + step;
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if distance(object, list, from + dir * middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(from + dir * high)
}

/// Normal of the deformed surface in f64; `None` on a cut.
fn normal_at(object: Object, list: &[Placed], pos: DVec3, margin: f64) -> Option<DVec3> {
    let (rest, a) = reference::map(list, pos);
    if a < margin || object.distance(rest).abs() > 1e-6 {
        return None;
    }
    // No edge nearby: the closed form has one normal there.
    let along = (jacobian(list, pos).transpose() * object.normal(rest)).normalize();
    let tangent = along.any_orthonormal_vector();
    let is_smooth = [tangent, along.cross(tangent)].iter().all(|t| {
        [-margin, margin].iter().all(|side| {
            let beside = pos + *t * *side;
            let there =
                jacobian(list, beside).transpose() * object.normal(reference::map(list, beside).0);
            there.normalize().dot(along) > 0.7
        })
    });
    is_smooth.then_some(along)
}

impl Surface {
    /// Seen from everywhere around.
    pub(crate) fn new(object: Object, list: &[PlacedTemplate], voxel: f64, count: u32) -> Self {
        let list = as_reference(list);
        let places = (0..count)
            .filter_map(|i| {
                let k = f64::from(i);
                let up = 2.0 * (k + 0.5) / f64::from(count) - 1.0;
                let flat = (1.0 - up * up).sqrt();
                let around = k * 2.399_963;
                let out = DVec3::new(flat * around.cos(), flat * around.sin(), up);
                let pos = hit(object, &list, out * 0.9, -out, 0.9)?;
                Some((pos, normal_at(object, &list, pos, 1.5 * voxel)?))
            })
            .collect();
        Self { places }
    }

    /// Mean angle between normals that were found and the right ones and that which one place in a hundred exceeds,
    /// degrees; none of normals that there are not.
    fn angles(&self, found: &[(DVec3, f64)]) -> Option<[f64; 2]> {
        let found = self.places.iter().zip(found);
        let mut angles: Vec<f64> = found
            .filter(|(_, (normal, _))| normal.length() > 0.5)
            .map(|((_, right), (normal, _))| right.angle_between(*normal).to_degrees())
            .collect();
        angles.sort_by(f64::total_cmp);
        (!angles.is_empty()).then(|| {
            let mean = angles.iter().sum::<f64>() / angles.len() as f64;
            [mean, angles[angles.len() * 99 / 100]]
        })
    }

    /// [`Surface::angles`] of a method on a scan at rest.
    pub(crate) fn angles_at_rest(&self, scan: &Scan, method: u32) -> [f64; 2] {
        let points: Vec<_> = self.places.iter().map(|p| p.0.as_vec3()).collect();
        let found = Method::new(scan, &[], "normals", method).run(&points);
        self.angles(&found).unwrap_or([f64::NAN; 2])
    }

    pub(crate) fn len(&self) -> usize {
        self.places.len()
    }
}

/// What a method is wrong by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormalError {
    pub(crate) name: &'static str,
    /// Mean angle and that which one place in a hundred exceeds, degrees; none for the dot product, which has no
    /// normal.
    pub(crate) angle: Option<[f64; 2]>,
    /// Root of the mean square of the error of diffuse light, 0 to 1.
    pub(crate) light: f64,
}

/// Every method but the unlit one on a deformed scan.
pub(crate) fn normal_errors(
    scan: &Scan,
    list: &[PlacedTemplate],
    surface: &Surface,
) -> Vec<NormalError> {
    let points: Vec<_> = surface.places.iter().map(|p| p.0.as_vec3()).collect();
    METHODS[1..]
        .iter()
        .map(|&(method, name)| {
            let found = Method::new(scan, list, "normals", method).run(&points);
            let square: f64 = surface
                .places
                .iter()
                .zip(&found)
                .map(|((_, right), (_, light))| (light - right.dot(LIGHT).max(0.0)).powi(2))
                .sum();
            NormalError {
                name,
                angle: surface.angles(&found),
                light: (square / points.len() as f64).sqrt(),
            }
        })
        .collect()
}

/// A picture of n² pixels of diffuse light along y, by one method; 1 outside the object.
pub(crate) fn picture(
    scan: &Scan,
    object: Object,
    list: &[PlacedTemplate],
    n: u32,
    method: u32,
) -> Vec<f64> {
    let plain = as_reference(list);
    let mut lit = vec![1.0; (n * n) as usize];
    let (mut points, mut pixels) = (Vec::new(), Vec::new());
    for i in 0..n * n {
        let across = (f64::from(i % n) + 0.5) / f64::from(n) - 0.5;
        let up = 0.5 - (f64::from(i / n) + 0.5) / f64::from(n);
        let from = DVec3::new(-across, 0.7, up);
        if let Some(pos) = hit(object, &plain, from, DVec3::NEG_Y, 1.4) {
            points.push(pos.as_vec3());
            pixels.push(i as usize);
        }
    }
    let found = Method::new(scan, list, "normals", method).run(&points);
    let light = DVec3::new(0.42, 0.66, 0.62);
    for (pixel, (normal, own)) in pixels.into_iter().zip(found) {
        lit[pixel] = if normal.length() > 0.5 {
            let half = (light + DVec3::Y).normalize();
            0.08 + 0.62 * normal.dot(light).max(0.0) + 0.3 * normal.dot(half).max(0.0).powi(40)
        } else {
            0.08 + 0.62 * own
        };
    }
    lit
}

/// Section 6.3.1: a height field of n² seen along −z over ±0.3 units, its true height, and the slopes that a method's
/// normals say.
pub(crate) struct Relief {
    n: usize,
    height: Vec<f64>,
    slopes: Vec<[f64; 2]>,
}

impl Relief {
    pub(crate) fn new(
        scan: &Scan,
        object: Object,
        list: &[PlacedTemplate],
        n: usize,
        method: u32,
    ) -> Self {
        let plain = as_reference(list);
        let side = |i: usize| -0.3 + 0.6 * i as f64 / (n - 1) as f64;
        let places: Vec<DVec3> = (0..n * n)
            .map(|i| {
                let from = DVec3::new(side(i % n), side(i / n), 0.7);
                hit(object, &plain, from, DVec3::NEG_Z, 1.4).unwrap_or(from)
            })
            .collect();
        let points: Vec<_> = places.iter().map(|p| p.as_vec3()).collect();
        let found = Method::new(scan, list, "normals", method).run(&points);
        Self {
            n,
            height: places.iter().map(|p| p.z).collect(),
            slopes: found
                .iter()
                .map(|(normal, _)| {
                    let z = normal.z.max(0.05);
                    [-normal.x / z, -normal.y / z]
                })
                .collect(),
        }
    }

    /// Spread of the true heights, subject units.
    pub(crate) fn spread(&self) -> f64 {
        let mean = self.height.iter().sum::<f64>() / self.height.len() as f64;
        let square: f64 = self.height.iter().map(|h| (h - mean).powi(2)).sum();
        (square / self.height.len() as f64).sqrt()
    }

    /// Height by integrating the slopes (Horn 1986): each place becomes what its neighbours and the slopes towards them
    /// say, again and again, from flat. Root of the mean square error, subject units, after each number of rounds.
    pub(crate) fn errors(&self, rounds: &[u32]) -> Vec<f64> {
        let n = self.n;
        let step = 0.6 / (n - 1) as f64;
        let mut z = vec![0.0; n * n];
        let mut errors = Vec::new();
        let mut done = 0;
        for &until in rounds {
            while done < until {
                done += 1;
                for i in 0..n * n {
                    let (x, y) = (i % n, i / n);
                    let (mut sum, mut count) = (0.0, 0.0);
                    let mut from = |j: usize, axis: usize, sign: f64| {
                        let slope = 0.5 * (self.slopes[i][axis] + self.slopes[j][axis]);
                        sum += z[j] + sign * slope * step;
                        count += 1.0;
                    };
                    if x > 0 {
                        from(i - 1, 0, 1.0);
                    }
                    if x + 1 < n {
                        from(i + 1, 0, -1.0);
                    }
                    if y > 0 {
                        from(i - n, 1, 1.0);
                    }
                    if y + 1 < n {
                        from(i + n, 1, -1.0);
                    }
                    z[i] = sum / count;
                }
            }
            let off = self.height.iter().zip(&z).map(|(h, z)| h - z);
            let mean = off.clone().sum::<f64>() / z.len() as f64;
            let square: f64 = off.map(|o| (o - mean).powi(2)).sum();
            errors.push((square / z.len() as f64).sqrt());
        }
        errors
    }
}
