//! Points of the plane as complex numbers: turns and scales about the origin are products. Sines and roots are libm's,
//! so that they have the same bits everywhere.

use glam::DVec2;

/// The number with this absolute value and angle.
pub(crate) fn polar(scale: f64, angle: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle);
    scale * DVec2::new(cos, sin)
}

/// a·b.
pub(crate) fn mul(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// conj(a)·b: how b lies to a.
pub(crate) fn conj_mul(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x)
}

/// a/b; 0 if b is 0.
pub(crate) fn div(a: DVec2, b: DVec2) -> DVec2 {
    let length = b.length_squared();
    if length > 0.0 {
        conj_mul(b, a) / length
    } else {
        DVec2::ZERO
    }
}

/// The angle, above -π up to π; 0 of 0.
pub(crate) fn arg(a: DVec2) -> f64 {
    libm::atan2(a.y, a.x)
}

/// The angle that differs from `angle` by whole turns and is nearest to `near`.
pub(crate) fn continued(angle: f64, near: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle + turn * ((near - angle) / turn).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_undo_products() {
        let (a, b) = (DVec2::new(0.3, -1.2), DVec2::new(-2.0, 0.7));
        assert!((div(mul(a, b), b) - a).length() < 1e-15, "a·b/b");
        assert!(
            (mul(polar(2.0, 0.4), polar(0.5, -0.4)) - DVec2::X).length() < 1e-15,
            "an inverse"
        );
        assert!(
            (arg(conj_mul(polar(1.0, 3.0), polar(2.0, 3.5))) - 0.5).abs() < 1e-15,
            "an angle between"
        );
    }

    #[test]
    fn angles_go_on_from_the_last() {
        assert!(
            (continued(-3.0, 3.0) - (std::f64::consts::TAU - 3.0)).abs() < 1e-15,
            "over half a turn"
        );
        assert_eq!(continued(1.0, 0.5), 1.0, "near enough");
    }
}
