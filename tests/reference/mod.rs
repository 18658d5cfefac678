//! A plain f64 reading of spec/templates.md, for tests only. It was written from that page, line by line and in its
//! words, and not from the shaders: what both get wrong has to be misread twice.

mod curve;

use fabrica::document::{PlacedTemplate, TemplateMode};
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::TAU;

/// A template as the document has it: ranges already applied, parameters as numbers in catalogue order (a flag is 0 or
/// 1, a choice its index, a vector three numbers, a quaternion four).
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// Name in the catalogue.
    pub(crate) kind: &'static str,
    /// Centre of the box, subject space.
    pub(crate) at: DVec3,
    /// Template axes to subject axes.
    pub(crate) rotate: DQuat,
    /// Side lengths, subject units.
    pub(crate) size: DVec3,
    /// Parameters in the order of the catalogue, as plain numbers.
    pub(crate) params: Vec<f64>,
    /// True for `"mode": "add"`.
    pub(crate) is_added: bool,
    /// `"curve"`: its points and whether it is a spline.
    pub(crate) curve: Option<(Vec<DVec2>, bool)>,
}

impl Placed {
    fn template_from_subject(&self, p: DVec3) -> DVec3 {
        self.rotate.inverse() * (p - self.at) / self.size + 0.5
    }

    fn subject_from_template_vector(&self, v: DVec3) -> DVec3 {
        self.rotate * (self.size * v)
    }
}

/// The enabled templates of a list, with their parameters as plain numbers.
pub(crate) fn as_reference(list: &[PlacedTemplate]) -> Vec<Placed> {
    let enabled = list.iter().filter(|t| t.enabled);
    enabled
        .map(|t| {
            let mut floats = Vec::new();
            t.params.iter().for_each(|p| p.pack(&mut floats));
            Placed {
                kind: t.kind.spec().name,
                at: t.placement.at.as_dvec3(),
                rotate: DQuat::from_array(t.placement.rotate.to_array().map(f64::from)).normalize(),
                size: t.placement.size.as_dvec3(),
                params: floats.into_iter().map(f64::from).collect(),
                is_added: t.mode == TemplateMode::Add,
                curve: t.curve.as_ref().map(|curve| {
                    let points = curve.points.iter();
                    (points.map(|p| p.as_dvec2()).collect(), curve.is_spline)
                }),
            }
        })
        .collect()
}

/// Source position and continuity of the whole list at a point of the deformed object.
pub(crate) fn map(templates: &[Placed], pos: DVec3) -> (DVec3, f64) {
    map_with(templates, pos, &mut |q, _| q)
}

/// As [`map`]; `touch` may move the point in template space (it is given the template's size as well) before a template
/// sees it (to ask how firmly the result stands).
pub(crate) fn map_with(
    templates: &[Placed],
    pos: DVec3,
    touch: &mut dyn FnMut(DVec3, DVec3) -> DVec3,
) -> (DVec3, f64) {
    if templates.is_empty() {
        return (pos, 1.0);
    }
    // Groups of one composed template and the adds that follow it; an add with nothing before it composes.
    let mut groups: Vec<Vec<&Placed>> = Vec::new();
    for template in templates {
        match groups.last_mut() {
            Some(group) if template.is_added => group.push(template),
            _ => groups.push(vec![template]),
        }
    }
    let mut p = pos;
    let mut continuity = f64::INFINITY;
    for group in groups.iter().rev() {
        let mut displacement = DVec3::ZERO;
        for template in group {
            let q = touch(template.template_from_subject(p), template.size);
            let line = template
                .curve
                .as_ref()
                .map(|(points, is_spline)| curve::Line::along(points, *is_spline, template.size));
            let (source, a) = match line {
                None => source(template.kind, q, template.size, &template.params),
                Some(line) => line.source(q, |own, size| {
                    source(template.kind, own, size, &template.params)
                }),
            };
            displacement += template.subject_from_template_vector(source - q);
            continuity = continuity.min(a);
        }
        p += displacement;
    }
    (p, continuity)
}

fn smoothstep(a: f64, b: f64, t: f64) -> f64 {
    let t = ((t - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Beyond an end that rests: `carry` says for x low, x high, y low, y high, z low, z high whether that end carries.
fn rests(q: DVec3, carry: [bool; 6]) -> bool {
    (0..3)
        .any(|axis| (q[axis] < 0.0 && !carry[2 * axis]) || (q[axis] > 1.0 && !carry[2 * axis + 1]))
}

/// Angle and the two coordinates (theta, u', v') of a point in the arc's frame.
fn unroll(u: f64, v: f64, phi: f64) -> (f64, f64, f64) {
    let mut hat = u.atan2(v);
    if hat < 0.0 {
        hat += TAU;
    }
    let theta = if hat <= phi {
        hat
    } else if hat - phi < TAU - hat {
        phi
    } else {
        0.0
    };
    let (sin, cos) = theta.sin_cos();
    (theta, u * cos - v * sin, u * sin + v * cos)
}

/// The noise of cracks (spec/surfaces.md): N(u, v; seed).
fn noise(u: f64, v: f64, seed: f64) -> f64 {
    let corner = |i: f64, j: f64, k: u32| {
        let whole = |x: f64| (x as i64) as u32;
        let x = whole(i).wrapping_mul(0x9E37_79B1)
            ^ whole(j).wrapping_mul(0x85EB_CA77)
            ^ (k + 16 * seed as u32).wrapping_mul(0xC2B2_AE3D);
        let x = (x ^ (x >> 16)).wrapping_mul(0x7FEB_352D);
        let x = (x ^ (x >> 15)).wrapping_mul(0x846C_A68B);
        let h = x ^ (x >> 16);
        f64::from(h >> 16) / 32767.5 - 1.0
    };
    let value = |u: f64, v: f64, k: u32| {
        let ease = |a: f64| a.powi(3) * (a * (6.0 * a - 15.0) + 10.0);
        let (i, j) = (u.floor(), v.floor());
        let (a, b) = (ease(u - i), ease(v - j));
        let row = |j: f64| (1.0 - a) * corner(i, j, k) + a * corner(i + 1.0, j, k);
        (1.0 - b) * row(j) + b * row(j + 1.0)
    };
    let octaves = (0..4).map(|k| {
        let fine = f64::from(1 << k);
        value(fine * u, fine * v, k) / fine
    });
    octaves.sum::<f64>() / 1.875
}

fn zero_if_tiny(o: f64, a: f64) -> f64 {
    if o < 1e-6 { 1.0 } else { a }
}

/// `source(q)` and `A(q)` of one template.
pub(crate) fn source(kind: &str, q: DVec3, size: DVec3, p: &[f64]) -> (DVec3, f64) {
    const N: bool = false;
    const Y: bool = true;
    let (x, y, z) = (q.x, q.y, q.z);
    let (sx, sy, sz) = (size.x, size.y, size.z);
    let c = q.clamp(DVec3::ZERO, DVec3::ONE);
    let metric = q * size;
    let rest = (q, 1.0);
    match kind {
        "poke" => {
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (amount, sigma) = (p[0], p[1]);
            let r2 = (c.x - 0.5).powi(2) + (c.y - 0.5).powi(2);
            let e0 = (-0.125 / (sigma * sigma)).exp();
            let g = (((-r2 / (2.0 * sigma * sigma)).exp() - e0) / (1.0 - e0)).max(0.0);
            (q + DVec3::new(0.0, 0.0, -amount * c.z * g), 1.0)
        }
        "twist" => {
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (angle, falloff) = (p[0], p[1]);
            let (mx, my) = ((c.x - 0.5) * sx, (c.y - 0.5) * sy);
            let r = mx.hypot(my) / sx.min(sy);
            let w = if falloff == 0.0 {
                1.0
            } else {
                1.0 - smoothstep((1.0 - falloff) / 2.0, 0.5, r)
            };
            let theta = angle * c.z * w;
            let source_x = mx * theta.cos() + my * theta.sin();
            let source_y = -mx * theta.sin() + my * theta.cos();
            (DVec3::new(source_x / sx + 0.5, source_y / sy + 0.5, z), 1.0)
        }
        "wave" => {
            if rests(q, [N, N, Y, Y, N, N]) {
                return rest;
            }
            let (amplitude, frequency, falloff) = (p[0], p[1], p[2]);
            let rho = (c.x - 0.5).hypot(c.z - 0.5);
            let w = if falloff == 0.0 {
                1.0
            } else {
                1.0 - smoothstep((1.0 - falloff) / 2.0, 0.5, rho)
            };
            (
                q + DVec3::Y * (amplitude * (frequency * rho).sin() * w),
                1.0,
            )
        }
        "bend" => {
            let angle = p[0];
            let mut start = p[1];
            let mut end = p[2];
            if end < start + 0.01 {
                end = (start + 0.01).min(1.0);
            }
            if start > end - 0.01 {
                start = end - 0.01;
            }
            let phi = angle.abs();
            if phi < 1e-4 {
                return rest;
            }
            let s = angle.signum();
            let y1 = start * sy;
            let length = (end - start) * sy;
            let radius = length / phi;
            let u = metric.y - y1;
            let v = s * (z - 0.5) * sz + radius;
            let (theta, u1, v1) = unroll(u, v, phi);
            let source_y = y1 + radius * theta + u1;
            let source_z = s * (v1 - radius);
            (DVec3::new(x, source_y / sy, source_z / sz + 0.5), 1.0)
        }
        "squeeze" | "dilate" => {
            if rests(q, [Y, Y, Y, Y, N, N]) {
                return rest;
            }
            let h = |z: f64| 1.0 / (1.0 + (20.0 * (z - 0.5).abs() - 5.0).exp());
            let k = p[0] * (h(c.z) - h(0.0)) / (h(0.5) - h(0.0));
            let k = if kind == "dilate" { -k } else { k };
            (q + DVec3::new(k * (c.x - 0.5), k * (c.y - 0.5), 0.0), 1.0)
        }
        "peel" => {
            let (progress, depth, radius, angle) = (p[0], p[1], p[2], p[3]);
            if progress == 0.0 || angle == 0.0 {
                return rest;
            }
            let zt = sz;
            let tau = depth * sz;
            let zp = zt - tau;
            let xh = progress * sx;
            let r = radius * sx;
            let rn = r + tau / 2.0;
            let m = y.min(1.0 - y) * sy;
            let (theta, u1, v1) = unroll(xh - metric.x, zt + r - metric.z, angle);
            let s = rn * theta + u1;
            let xs = xh - s;
            let zs = zt + r - v1;
            let a_flap = xs.min(zs - zp).min(zt - zs).min(m);
            let c = (zp - metric.z).max(-metric.x).max(metric.z - zt).max(-m);
            let a_rest = if metric.x < xh {
                c
            } else {
                (metric.x - xh).hypot(c)
            };
            if s >= 0.0 && a_flap >= a_rest.min(0.0) {
                (DVec3::new(xs / sx, y, zs / sz), a_flap)
            } else {
                (q, a_rest)
            }
        }
        "flap" => {
            let (angle, depth) = (p[0], p[1]);
            if angle == 0.0 {
                return rest;
            }
            let zt = sz;
            let zp = zt - depth * sz;
            let m = y.min(1.0 - y) * sy;
            let (mx, mz) = (metric.x, metric.z);
            let xs = mx * angle.cos() + (mz - zt) * angle.sin();
            let zs = zt - mx * angle.sin() + (mz - zt) * angle.cos();
            let a_flap = xs.min(sx - xs).min(zs - zp).min(zt - zs).min(m);
            let a_rest = (-mx).max(mx - sx).max(zp - mz).max(mz - zt).max(-m);
            if a_flap >= a_rest.min(0.0) {
                (DVec3::new(xs / sx, y, zs / sz), a_flap)
            } else {
                (q, a_rest)
            }
        }
        "split" => {
            let (amount, lens, wedge) = (p[0], p[1], p[2] != 0.0);
            if rests(q, [Y, Y, Y, Y, !wedge, Y]) {
                return rest;
            }
            let f =
                amount * (if wedge { c.z } else { 1.0 }) * (1.0 - lens * (2.0 * c.y - 1.0).powi(2));
            let dx = if x < 0.5 - f {
                f
            } else if x > 0.5 + f {
                -f
            } else {
                0.5 - x
            };
            (
                q + DVec3::new(dx, 0.0, 0.0),
                zero_if_tiny(f, (x - 0.5).abs() - f),
            )
        }
        "crack" => {
            let (amount, lens, depth, roughness) = (p[0], p[1], p[2], p[3]);
            let (grain, seed, ripple, cycles) = (p[4], p[5], p[6], p[7]);
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (y, z) = (c.y, c.z);
            let wave = (TAU * cycles.abs() * if cycles >= 0.0 { y } else { z }).sin();
            let jagged = noise(y / grain, z * (sz / sy) / grain, seed);
            let c = (0.5 + roughness * jagged + ripple * wave).clamp(0.05, 0.95);
            let room = if x < c { c } else { 1.0 - c };
            let deep = ((z - 1.0 + depth) / depth).clamp(0.0, 1.0);
            let o = (0.5 * amount * (1.0 - lens * (2.0 * y - 1.0).powi(2)) * deep).min(0.9 * room);
            let d = (x - c).abs();
            let source = if d < o {
                0.0
            } else if d < room {
                room * (d - o) / (room - o)
            } else {
                d
            };
            let from = if x < c { c - source } else { c + source };
            (DVec3::new(from, q.y, q.z), zero_if_tiny(o, d - o))
        }
        "slices" => {
            let count = (p[0] + 0.5).floor();
            let (gap, shift, progress) = (p[1], p[2], p[3]);
            let tau = 1.0 / count;
            let g = gap * progress;
            let t = tau + g;
            let k = (z / t).floor().clamp(0.0, count - 1.0);
            let r = z - k * t;
            let is_last = k == count - 1.0;
            let source_z = k * tau + if is_last { r } else { r.min(tau) };
            let part = if is_last || g == 0.0 {
                0.0
            } else {
                ((r - tau) / g).clamp(0.0, 1.0)
            };
            let source_x = x - shift * progress * (k + part);
            let a = if g == 0.0 && shift * progress == 0.0 {
                1.0
            } else if !is_last && r > tau {
                -(r - tau).min(t - r)
            } else {
                let mut a: f64 = 1.0;
                if k > 0.0 {
                    a = a.min(r);
                }
                if !is_last {
                    a = a.min(tau - r);
                }
                a
            };
            (DVec3::new(source_x, y, source_z), a)
        }
        "retractor" => {
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (amount, length, reach) = (p[0], p[1], p[2]);
            let e = (-5.0 * (0.5 / length).powi(2)).exp();
            let profile =
                (((-5.0 * ((0.5 - c.x) / length).powi(2)).exp() - e) / (1.0 - e)).max(0.0);
            let o = (amount * c.z * profile).min(0.95 * reach);
            let d = (y - 0.5).abs();
            let source = if d < o {
                0.0
            } else if d < reach {
                (d - o) / (reach - o) * reach
            } else {
                d
            };
            let side = if y < 0.5 { -1.0 } else { 1.0 };
            (
                DVec3::new(x, 0.5 + side * source, z),
                zero_if_tiny(o, d - o),
            )
        }
        "cutquad" => {
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (amount, length, ripple) = (p[0], p[1], p[2]);
            let m = 1.0 - ((y - 0.5) / length).powi(2).clamp(0.0, 1.0);
            let o = (amount * m * c.z * c.z).min(0.38);
            let d = (x - 0.5).abs();
            let t = ((d - o) / (0.4 - o)).clamp(0.0, 1.0);
            let source = if d < 0.4 { 0.4 * t } else { d };
            let side = if x < 0.5 { -1.0 } else { 1.0 };
            let dz = -ripple
                * (10.0 * amount).min(1.0)
                * (1.0 - t)
                * m
                * c.z
                * c.z
                * (TAU * t).sin().powi(2);
            (
                DVec3::new(0.5 + side * source, y, z + dz),
                zero_if_tiny(o, d - o),
            )
        }
        "peeler" => {
            if rests(q, [N, N, N, N, N, Y]) {
                return rest;
            }
            let (lift, width) = (p[0], p[1]);
            let z0 = 4.0 * ((x - 0.5) / width).powi(2);
            let t = lift * y * y + z0;
            let dz = -(t - z0).min((z - z0).max(0.0));
            let a = if z < z0 {
                z0 - z
            } else if z > t {
                z - t
            } else {
                (z - t).max(z0 - z)
            };
            (q + DVec3::Z * dz, zero_if_tiny(t - z0, a))
        }
        "pull" => {
            let offset = DVec3::new(p[0], p[1], p[2]);
            let r = (q - 0.5).length();
            let g = if r < 0.5 {
                (1.0 - 4.0 * r * r).powi(2)
            } else {
                0.0
            };
            (q - offset * g, 1.0)
        }
        "cut" => {
            let (dx, dy, dz) = ((x - 0.5).abs(), (y - 0.5).abs(), (z - 0.5).abs());
            let a = match p[0] as u32 {
                0 => dx.max(dy).max(dz) - 0.5,
                1 => (q - 0.5).length() - 0.5,
                2 => (dx.hypot(dy) - 0.5).max(dz - 0.5),
                _ => 0.5 - z,
            };
            (q, a)
        }
        "hole" => {
            if rests(q, [N, N, N, N, Y, Y]) {
                return rest;
            }
            let (amount, taper) = (p[0], p[1]);
            let o = (amount * (taper + (1.0 - taper) * c.z)).min(0.475);
            let (dx, dy) = (x - 0.5, y - 0.5);
            let r = dx.hypot(dy);
            let source = if r < o {
                0.0
            } else if r < 0.5 {
                0.5 * (r - o) / (0.5 - o)
            } else {
                r
            };
            let scale = if r > 0.0 { source / r } else { 0.0 };
            (
                DVec3::new(0.5 + dx * scale, 0.5 + dy * scale, z),
                zero_if_tiny(o, r - o),
            )
        }
        "lens" => {
            let r = (q - 0.5).length();
            if r < 0.5 {
                (
                    0.5 + (q - 0.5) * (1.0 - p[0] * (1.0 - 4.0 * r * r).powi(2)),
                    1.0,
                )
            } else {
                rest
            }
        }
        "move" => {
            let offset = DVec3::new(p[0], p[1], p[2]);
            let turn = DQuat::from_xyzw(p[3], p[4], p[5], p[6]);
            if offset == DVec3::ZERO && turn.xyz() == DVec3::ZERO {
                return rest;
            }
            let xc = size * (q - 0.5);
            let xs = turn.inverse() * (xc - size * offset);
            let qs = 0.5 + xs / size;
            let m = |q: DVec3| (q.min(1.0 - q) * size).min_element();
            let (a_flap, a_rest) = (m(qs), -m(q));
            if a_flap >= a_rest.min(0.0) {
                (qs, a_flap)
            } else {
                (q, a_rest)
            }
        }
        other => panic!("the reference does not know `{other}`"),
    }
}

/// The spec's own fixed points, so that the reference is not trusted blindly.
#[cfg(test)]
mod own_checks {
    use super::*;

    #[test]
    fn peel_lays_the_layer_on_its_roll() {
        // Half peeled, a half turn: the edge that was at x = 0 now lies above the tissue, its top face down.
        let size = DVec3::ONE;
        let params = [0.5, 0.2, 0.1, std::f64::consts::PI];
        let rn = 0.2;
        // The end of the arc is at s = rn pi > 0.5, so that x = 0 is on the arc.
        let theta: f64 = 0.5 / rn;
        let across = 0.15;
        let p = DVec3::new(0.5 - across * theta.sin(), 0.5, 1.1 - across * theta.cos());
        let (source, a) = source("peel", p, size, &params);
        assert!(
            (source - DVec3::new(0.0, 0.5, 0.95)).length() < 1e-12,
            "{source}"
        );
        assert!(a.abs() < 1e-12, "the flap's end is a face, but A = {a}");
    }

    #[test]
    fn bend_keeps_lengths_on_the_middle_plane() {
        let params = [std::f64::consts::FRAC_PI_2, 0.25, 0.75];
        let radius = 0.5 / std::f64::consts::FRAC_PI_2;
        let size = DVec3::splat(1.0);
        let p = DVec3::new(0.5, 0.25 + radius, 0.5 - radius - 0.1);
        let (source, _) = source("bend", p, size, &params);
        assert!(
            (source - DVec3::new(0.5, 0.85, 0.5)).length() < 1e-12,
            "{source}"
        );
    }
}
