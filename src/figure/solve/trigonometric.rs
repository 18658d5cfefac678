use glam::DVec2;

use crate::figure::complex::polar;

/// Angles from which the least value is looked for: there are at most two valleys.
const STARTS: u32 = 16;
/// Steps of Newton's method at most.
const STEPS: u32 = 30;

/// cos·cos α + sin·sin α + double_cos·cos 2α + double_sin·sin 2α.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Trigonometric {
    pub(crate) cos: f64,
    pub(crate) sin: f64,
    pub(crate) double_cos: f64,
    pub(crate) double_sin: f64,
}

impl Trigonometric {
    pub(crate) fn add(&mut self, other: &Self) {
        self.cos += other.cos;
        self.sin += other.sin;
        self.double_cos += other.double_cos;
        self.double_sin += other.double_sin;
    }

    fn value(&self, at: DVec2) -> f64 {
        let double = DVec2::new(at.x * at.x - at.y * at.y, 2.0 * at.x * at.y);
        self.cos * at.x + self.sin * at.y + self.double_cos * double.x + self.double_sin * double.y
    }

    /// First and second derivative.
    fn slopes(&self, at: DVec2) -> (f64, f64) {
        let double = DVec2::new(at.x * at.x - at.y * at.y, 2.0 * at.x * at.y);
        let first = self.sin * at.x - self.cos * at.y
            + 2.0 * (self.double_sin * double.x - self.double_cos * double.y);
        let second = -self.cos * at.x
            - self.sin * at.y
            - 4.0 * (self.double_cos * double.x + self.double_sin * double.y);
        (first, second)
    }

    /// Cosine and sine of the angle with the least value; angle 0 if all are equal.
    pub(crate) fn least(&self) -> DVec2 {
        let single = self.cos.abs() + self.sin.abs();
        let double = self.double_cos.abs() + self.double_sin.abs();
        if double <= 1e-14 * single || double == 0.0 {
            let length = (self.cos * self.cos + self.sin * self.sin).sqrt();
            return if length > 0.0 {
                -DVec2::new(self.cos, self.sin) / length
            } else {
                DVec2::X
            };
        }
        let step = std::f64::consts::TAU / f64::from(STARTS);
        let starts: Vec<f64> = (0..STARTS)
            .map(|i| self.value(polar(1.0, step * f64::from(i))))
            .collect();
        let n = starts.len();
        let is_valley =
            |i: &usize| starts[*i] <= starts[(i + 1) % n] && starts[*i] <= starts[(i + n - 1) % n];
        let mut best = (f64::INFINITY, DVec2::X);
        for i in (0..n).filter(is_valley) {
            let at = self.valley(step * i as f64, step);
            let value = self.value(at);
            if value < best.0 {
                best = (value, at);
            }
        }
        best.1
    }

    /// The bottom of the valley around an angle, by Newton's method kept within `reach` of it.
    fn valley(&self, start: f64, reach: f64) -> DVec2 {
        let (mut low, mut high) = (start - reach, start + reach);
        let mut angle = start;
        for _ in 0..STEPS {
            let (first, second) = self.slopes(polar(1.0, angle));
            if first > 0.0 {
                high = angle;
            } else {
                low = angle;
            }
            let newton = angle - first / second;
            let next = if second > 0.0 && newton > low && newton < high {
                newton
            } else {
                (low + high) / 2.0
            };
            if (next - angle).abs() < 1e-15 {
                break;
            }
            angle = next;
        }
        polar(1.0, angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::complex::arg;

    #[test]
    fn the_least_value_is_found_among_two_valleys() {
        for i in 0..200 {
            let part = |k: i32| f64::from((i * k) % 41 - 20) / 10.0;
            let sum = Trigonometric {
                cos: part(7),
                sin: part(11),
                double_cos: part(13),
                double_sin: part(17),
            };
            let found = sum.value(sum.least());
            let tried =
                (0..3600).map(|k| sum.value(polar(1.0, f64::from(k) * 0.1_f64.to_radians())));
            let least = tried.fold(f64::INFINITY, f64::min);
            assert!(found <= least + 1e-12, "{sum:?}: {found} above {least}");
        }
    }

    #[test]
    fn a_plain_cosine_has_its_least_value_opposite() {
        let sum = Trigonometric {
            cos: -1.0,
            sin: -1.0,
            ..Trigonometric::default()
        };
        assert!(
            (arg(sum.least()) - std::f64::consts::FRAC_PI_4).abs() < 1e-15,
            "at 45°"
        );
    }
}
