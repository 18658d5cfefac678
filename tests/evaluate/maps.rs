//! Sections 6.2.1 to 6.2.3: the errors of a map that is baked into a texture, and of a texture of its Jacobian.

use super::bench::{jacobian, probe};
use crate::reference::{self, Placed, as_reference};
use fabrica::document::PlacedTemplate;
use glam::{DMat3, DVec3, UVec3};
use half::f16;

/// Type in which each component of a baked map is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Precision {
    Single,
    Half,
    Bits16,
    Bits8,
}

impl Precision {
    pub(crate) const ALL: [(Self, &'static str); 4] = [
        (Self::Bits8, "8 bit"),
        (Self::Bits16, "16 bit"),
        (Self::Half, "16-bit float"),
        (Self::Single, "32-bit float"),
    ];

    /// A value after it was kept in this type; the range is that of its component.
    fn kept(self, value: f64, [low, high]: [f64; 2]) -> f64 {
        let levels = match self {
            Self::Single => return f64::from(value as f32),
            Self::Half => return f16::from_f64(value).to_f64(),
            Self::Bits16 => 65_535.0,
            Self::Bits8 => 255.0,
        };
        let span = (high - low).max(1e-12);
        low + ((value - low) / span * levels).round() / levels * span
    }
}

/// A map sampled on a lattice over the first template's box, corners included.
pub(crate) struct Baked {
    dims: UVec3,
    /// Displacement in subject units and continuity.
    texels: Vec<[f64; 4]>,
}

impl Baked {
    pub(crate) fn new(list: &[PlacedTemplate], dims: UVec3, precision: Precision) -> Self {
        let count = dims.element_product();
        let place = |i: u32| {
            let cell = UVec3::new(i % dims.x, i / dims.x % dims.y, i / dims.x / dims.y);
            let q = cell.as_vec3() / (dims - 1).as_vec3();
            list[0].placement.subject_from_template(q)
        };
        let points: Vec<_> = (0..count).map(place).collect();
        let samples = probe(list, &points);
        let mut texels: Vec<[f64; 4]> = points
            .iter()
            .zip(&samples)
            .map(|(point, sample)| {
                let moved = (sample.pos_in_rest - *point).as_dvec3();
                [moved.x, moved.y, moved.z, f64::from(sample.continuity)]
            })
            .collect();
        for channel in 0..4 {
            let all = texels.iter().map(|t| t[channel]);
            let range = [
                all.clone().fold(f64::INFINITY, f64::min),
                all.fold(f64::NEG_INFINITY, f64::max),
            ];
            for texel in &mut texels {
                texel[channel] = precision.kept(texel[channel], range);
            }
        }
        Self { dims, texels }
    }

    /// Between the eight texels around a place of the box.
    fn at(&self, q: DVec3) -> [f64; 4] {
        let at = q.clamp(DVec3::ZERO, DVec3::ONE) * (self.dims - 1).as_dvec3();
        let low = at.floor().min((self.dims - 2).as_dvec3());
        let part = at - low;
        let low = low.as_uvec3();
        let mut sum = [0.0; 4];
        for corner in 0..8u32 {
            let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            let cell = low + step;
            let weight = DVec3::select(step.cmpgt(UVec3::ZERO), part, 1.0 - part).element_product();
            let index = cell.x + self.dims.x * (cell.y + self.dims.y * cell.z);
            for (to, from) in sum.iter_mut().zip(self.texels[index as usize]) {
                *to += weight * from;
            }
        }
        sum
    }
}

/// How far a map is from the closed form.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MapError {
    /// Root of the mean square and largest distance of source positions, subject units.
    pub(crate) rms: f64,
    pub(crate) worst: f64,
    /// Share of the places on the wrong side of a cut.
    pub(crate) wrong_side: f64,
}

/// Places in the box with what the closed form says; those nearer to a cut than 0.004 units count only for its side.
pub(crate) struct Places {
    list: Vec<Placed>,
    places: Vec<(DVec3, DVec3, DVec3, f64)>,
}

impl Places {
    pub(crate) fn new(list: &[PlacedTemplate], count: u32) -> Self {
        let plain = as_reference(list);
        // A lattice of golden ratios (Roberts 2018): even, and off every texel.
        let q = |i: u32| {
            let k = f64::from(i);
            let one = |ratio: f64| 0.06 + 0.88 * (0.5 + k * ratio).fract();
            DVec3::new(one(0.819_172_5), one(0.671_043_6), one(0.549_700_5))
        };
        let places = (0..count)
            .map(|i| {
                let q = q(i).as_vec3();
                let pos = list[0].placement.subject_from_template(q).as_dvec3();
                let (source, a) = reference::map(&plain, pos);
                (q.as_dvec3(), pos, source, a)
            })
            .collect();
        Self {
            list: plain,
            places,
        }
    }

    fn error(&self, found: impl Fn(usize, DVec3, DVec3) -> (DVec3, f64)) -> MapError {
        let (mut sum, mut n) = (0.0, 0.0);
        let mut error = MapError::default();
        for (i, (q, pos, source, a)) in self.places.iter().enumerate() {
            let (at, continuity) = found(i, *q, *pos);
            error.wrong_side += f64::from(u8::from((continuity < 0.0) != (*a < 0.0)));
            if *a > 0.004 {
                let off = (at - *source).length();
                sum += off * off;
                n += 1.0;
                error.worst = error.worst.max(off);
            }
        }
        error.rms = f64::sqrt(sum / f64::max(n, 1.0));
        error.wrong_side /= self.places.len() as f64;
        error
    }

    /// Of a baked map.
    pub(crate) fn of(&self, baked: &Baked) -> MapError {
        self.error(|_, q, pos| {
            let [x, y, z, a] = baked.at(q);
            (pos + DVec3::new(x, y, z), a)
        })
    }

    /// Of the formulas, as the program evaluates them.
    pub(crate) fn exact(&self, list: &[PlacedTemplate]) -> MapError {
        let points: Vec<_> = self.places.iter().map(|p| p.1.as_vec3()).collect();
        let samples = probe(list, &points);
        self.error(|i, _, _| {
            let sample = &samples[i];
            (sample.pos_in_rest.as_dvec3(), f64::from(sample.continuity))
        })
    }

    /// Section 6.2.3: mean angle (degrees) between normals carried over by the closed form's Jacobian and by one that
    /// is kept with ten bits per component over −2 to 2, by one that is divided by its largest component first
    /// (equation 6.1), and by the program's differences; and the mean of the determinants.
    pub(crate) fn jacobians(&self, list: &[PlacedTemplate]) -> ([f64; 3], f64) {
        let kept = |m: DMat3, limit: f64| {
            let one = |v: f64| {
                let v = v.clamp(-limit, limit);
                ((v + limit) / (2.0 * limit) * 1023.0).round() / 1023.0 * 2.0 * limit - limit
            };
            DMat3::from_cols_array(&m.to_cols_array().map(one))
        };
        let step = 0.0005f32;
        let mut points = Vec::new();
        for (_, pos, ..) in &self.places {
            let pos = pos.as_vec3();
            points.extend([
                pos,
                pos + glam::Vec3::X * step,
                pos + glam::Vec3::Y * step,
                pos + glam::Vec3::Z * step,
            ]);
        }
        let samples = probe(list, &points);
        let (mut sums, mut det, mut n) = ([0.0; 3], 0.0, 0.0);
        for (i, (_, pos, _, a)) in self.places.iter().enumerate() {
            if *a < 0.01 {
                continue;
            }
            let exact = jacobian(&self.list, *pos);
            let largest = exact
                .to_cols_array()
                .iter()
                .fold(0.0f64, |m, v| m.max(v.abs()));
            let [base, x, y, z] = [0, 1, 2, 3].map(|k| samples[4 * i + k].pos_in_rest.as_dvec3());
            let step = f64::from(step);
            let own = DMat3::from_cols((x - base) / step, (y - base) / step, (z - base) / step);
            // Ways of normals: as even over the sphere as the places over the box.
            let k = i as f64;
            let up = 2.0 * (0.5 + k * 0.618_034).fract() - 1.0;
            let around = k * 2.399_963;
            let flat = (1.0 - up * up).max(0.0).sqrt();
            let n0 = DVec3::new(flat * around.cos(), flat * around.sin(), up);
            let right = exact.transpose() * n0;
            let others = [kept(exact, 2.0), kept(exact / largest, 1.0), own];
            for (sum, other) in sums.iter_mut().zip(others) {
                *sum += right.angle_between(other.transpose() * n0).to_degrees();
            }
            det += exact.determinant();
            n += 1.0;
        }
        (sums.map(|s| s / n), det / n)
    }
}
