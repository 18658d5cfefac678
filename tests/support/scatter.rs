//! Random templates, placements and points, the same on every machine.

#![allow(dead_code, reason = "each test uses a part of it")]

use fabrica::document::{Curve, ParamKind, ParamValue, PlacedTemplate, TemplateKind};
use fabrica::math::Placement;
use glam::{Quat, Vec2, Vec3};

/// A small generator, the same numbers everywhere (xorshift64*).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 40) as f32 / (1u64 << 24) as f32
    }
    pub(crate) fn between(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.unit()
    }
    pub(crate) fn index(&mut self, n: usize) -> usize {
        ((self.unit() * n as f32) as usize).min(n - 1)
    }
    pub(crate) fn vector(&mut self, lo: f32, hi: f32) -> Vec3 {
        Vec3::new(
            self.between(lo, hi),
            self.between(lo, hi),
            self.between(lo, hi),
        )
    }
    pub(crate) fn rotation(&mut self) -> Quat {
        loop {
            let v = [(); 4].map(|()| self.between(-1.0, 1.0));
            let q = Quat::from_array(v);
            if (0.01..1.0).contains(&q.length_squared()) {
                return q.normalize();
            }
        }
    }
    /// Anywhere in the range; one time in six an end, one in six the default.
    pub(crate) fn number(&mut self, lo: f32, hi: f32, default: f32) -> f32 {
        match self.index(12) {
            0 => lo,
            1 => hi,
            2 | 3 => default,
            _ => self.between(lo, hi),
        }
    }
    pub(crate) fn param(&mut self, kind: &ParamKind) -> ParamValue {
        match *kind {
            ParamKind::Number { default, min, max } => {
                ParamValue::Number(self.number(min, max, default))
            }
            ParamKind::Count { default, min, max } => {
                ParamValue::Number((self.number(min, max, default) + 0.5).floor())
            }
            ParamKind::Flag { .. } => ParamValue::Flag(self.unit() < 0.5),
            ParamKind::Choice { names } => ParamValue::Choice(self.index(names.len()) as u32),
            ParamKind::Vector {
                default,
                min,
                max,
                max_length,
            } => match self.index(8) {
                0 => ParamValue::Vector(Vec3::ZERO),
                1 => ParamValue::Vector(Vec3::from_array(default)),
                2 => ParamValue::Vector(self.vector(min, max).clamp_length_max(max_length)),
                _ => ParamValue::Vector(
                    self.vector(min.max(-1.0), max.min(1.0))
                        .clamp_length_max(max_length),
                ),
            },
            ParamKind::Rotation => ParamValue::Rotation(if self.unit() < 0.3 {
                Quat::IDENTITY
            } else {
                self.rotation()
            }),
        }
    }
    pub(crate) fn template(&mut self, kind: TemplateKind) -> PlacedTemplate {
        let side = |r: &mut Self| 0.08 * 25f32.powf(r.unit());
        let placement = Placement {
            at: self.vector(-0.5, 0.5),
            rotate: if self.unit() < 0.2 {
                Quat::IDENTITY
            } else {
                self.rotation()
            },
            size: Vec3::new(side(self), side(self), side(self)),
        };
        let params = kind.spec().params.iter();
        placed(
            kind,
            placement,
            params.map(|p| self.param(&p.kind)).collect(),
        )
    }
    /// A line that a template of this size can be laid along: it goes on and turns, a little or much.
    pub(crate) fn curve(&mut self, size: Vec3) -> Curve {
        loop {
            let count = 2 + self.index(8);
            let most = [0.15, 0.5, 1.2][self.index(3)];
            let step = size.x * self.between(0.6, 1.3) / (count - 1) as f32;
            let mut heading = self.between(-0.8, 0.8);
            let mut at = Vec2::new(0.0, size.z * self.between(0.7, 1.2));
            let mut points = Vec::new();
            for _ in 0..count {
                points.push(at / Vec2::new(size.x, size.z));
                at += Vec2::from_angle(heading) * step;
                heading += self.between(-most, most);
            }
            let curve = Curve {
                is_spline: self.unit() < 0.7,
                ..Curve::spline(points)
            };
            let is_near = curve.points.iter().all(|p| p.abs().max_element() < 10.0);
            if is_near && curve.bent(size).is_ok() {
                return curve;
            }
        }
    }
    /// In and about a template's box half of the time, in the object the other half.
    pub(crate) fn point(&mut self, list: &[PlacedTemplate]) -> Vec3 {
        if list.is_empty() || self.unit() < 0.4 {
            return self.vector(-0.6, 0.6);
        }
        let at = self.index(list.len());
        let q = match self.index(3) {
            0 => self.vector(-0.5, 2.0),
            1 => self.vector(-0.02, 1.02),
            // On a grid of halves and ends every now and then: faces and middles are part of the contract.
            _ => self.vector(0.0, 1.0),
        };
        list[at].subject_from_template(q)
    }
}

pub(crate) fn placed(
    kind: TemplateKind,
    placement: Placement,
    params: Vec<ParamValue>,
) -> PlacedTemplate {
    PlacedTemplate {
        params,
        ..PlacedTemplate::new(kind, placement)
    }
}

pub(crate) fn defaults(kind: TemplateKind) -> Vec<ParamValue> {
    let params = kind.spec().params.iter();
    params.map(|p| p.kind.default_value()).collect()
}
