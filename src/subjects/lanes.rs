//! Eight floats side by side: a row of eight voxels is worked out at once.
//!
//! Only operations that IEEE 754 rounds exactly (+, −, ×, ÷, √, comparison) are offered, each written lane by lane, so
//! the bits are the same on every machine whether or not the compiler turns a loop into vector instructions.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Voxels in a row of a block, and rows and layers of a block.
pub(super) const LANES: usize = 8;

/// Eight floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lanes(pub(super) [f32; LANES]);

/// One lane by lane operation.
macro_rules! each {
    ($lane:ident => $value:expr) => {{
        let mut out = [0.0f32; LANES];
        let mut $lane = 0;
        while $lane < LANES {
            out[$lane] = $value;
            $lane += 1;
        }
        Lanes(out)
    }};
}

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    pub(super) fn splat(value: f32) -> Self {
        Self([value; LANES])
    }

    /// `start`, `start + step`, … each by one multiplication, so that no error adds up.
    #[inline(always)]
    pub(super) fn ramp(start: f32, step: f32) -> Self {
        each!(i => start + step * i as f32)
    }

    /// Square root.
    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        each!(i => self.0[i].sqrt())
    }

    /// Magnitude.
    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        each!(i => self.0[i].abs())
    }

    /// The smaller one; lanes hold no NaN.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        each!(i => if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] })
    }

    /// The larger one; lanes hold no NaN.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        each!(i => if other.0[i] > self.0[i] { other.0[i] } else { self.0[i] })
    }

    /// Between two numbers.
    #[inline(always)]
    pub(super) fn clamp(self, low: f32, high: f32) -> Self {
        self.max(Self::splat(low)).min(Self::splat(high))
    }

    /// `other` where `t` is 1, `self` where it is 0.
    #[inline(always)]
    pub(super) fn mix(self, other: Self, t: Self) -> Self {
        self + (other - self) * t
    }

    /// Smallest lane.
    pub(super) fn lowest(self) -> f32 {
        self.0
            .iter()
            .fold(f32::INFINITY, |a, &b| if b < a { b } else { a })
    }

    /// Largest lane.
    pub(super) fn highest(self) -> f32 {
        self.0
            .iter()
            .fold(f32::NEG_INFINITY, |a, &b| if b > a { b } else { a })
    }

    /// A function of each lane, for what cannot be written in lanes.
    #[inline(always)]
    pub(super) fn map(self, mut f: impl FnMut(f32) -> f32) -> Self {
        each!(i => f(self.0[i]))
    }
}

macro_rules! operator {
    ($name:ident, $method:ident, $op:tt) => {
        impl $name for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                each!(i => self.0[i] $op other.0[i])
            }
        }
        impl $name<f32> for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                each!(i => self.0[i] $op other)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each!(i => -self.0[i])
    }
}

/// Eight points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points {
    /// x of each.
    pub(super) x: Lanes,
    /// y of each.
    pub(super) y: Lanes,
    /// z of each.
    pub(super) z: Lanes,
}
