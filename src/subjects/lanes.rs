//! Eight floats side by side: a row of eight voxels is worked out at once.
//!
//! Only operations that IEEE 754 rounds exactly (+, −, ×, ÷, √, comparison) are offered, so the bits are the same on
//! every machine, whichever vector instructions it has. (Which of two zeros is the smaller may differ; nothing asks for
//! their sign.)

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, Neg, Sub};

use wide::f32x8;

/// Voxels in a row of a block, and rows and layers of a block.
pub(super) const LANES: usize = 8;

/// Eight numbers that are computed at once: a row of voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lanes(f32x8);

impl From<[f32; LANES]> for Lanes {
    #[inline(always)]
    fn from(lanes: [f32; LANES]) -> Self {
        Self(f32x8::from(lanes))
    }
}

impl Lanes {
    /// This number in every lane.
    #[inline(always)]
    pub(super) fn splat(value: f32) -> Self {
        Self(f32x8::splat(value))
    }

    /// `start`, `start + step`, … each by one multiplication, so that no error adds up.
    #[inline(always)]
    pub(super) fn ramp(start: f32, step: f32) -> Self {
        Self::from([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]) * step + start
    }

    /// Square root of each number.
    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    /// Absolute value of each number.
    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Self(self.0.abs())
    }

    /// The smaller one; lanes hold no NaN.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }

    /// The larger one; lanes hold no NaN.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }

    /// Each number brought into the range from `low` to `high`.
    #[inline(always)]
    pub(super) fn clamp(self, low: f32, high: f32) -> Self {
        self.max(Self::splat(low)).min(Self::splat(high))
    }

    /// `other` where `t` is 1, `self` where it is 0.
    #[inline(always)]
    pub(super) fn mix(self, other: Self, t: Self) -> Self {
        self + (other - self) * t
    }

    /// The smallest of the eight numbers.
    pub(super) fn lowest(self) -> f32 {
        (0..LANES).fold(
            f32::INFINITY,
            |low, i| if self[i] < low { self[i] } else { low },
        )
    }

    /// The largest of the eight numbers.
    pub(super) fn highest(self) -> f32 {
        (0..LANES).fold(f32::NEG_INFINITY, |high, i| {
            if self[i] > high { self[i] } else { high }
        })
    }

    /// A function of each lane, for what cannot be written in lanes.
    #[inline(always)]
    pub(super) fn map(mut self, mut f: impl FnMut(f32) -> f32) -> Self {
        for lane in self.0.as_mut_array() {
            *lane = f(*lane);
        }
        self
    }
}

impl Index<usize> for Lanes {
    type Output = f32;
    #[inline(always)]
    fn index(&self, i: usize) -> &f32 {
        &self.0.as_array()[i]
    }
}

impl IndexMut<usize> for Lanes {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut f32 {
        &mut self.0.as_mut_array()[i]
    }
}

macro_rules! operator {
    ($name:ident, $method:ident, $op:tt) => {
        impl $name for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }
        impl $name<f32> for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self(self.0 $op f32x8::splat(other))
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
        Self(-self.0)
    }
}

/// Eight points, coordinate by coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points {
    /// x of each point.
    pub(super) x: Lanes,
    /// y of each point.
    pub(super) y: Lanes,
    /// z of each point.
    pub(super) z: Lanes,
}
