//! Numbers, vectors and colours as an edit writes them into a document.

use crate::math::round_to;
use glam::{Quat, Vec3};
use serde_json::{Value, json};

/// A length, rounded to four decimals: 0.025 mm for a subject of 25 cm, or a hundredth of a fine voxel in mm.
pub(crate) fn rounded(value: f32) -> Value {
    json!(round_to(f64::from(value), 4))
}

/// A side of a template, rounded to four decimals but never to nothing.
pub(crate) fn rounded_size(value: f32) -> Value {
    rounded(value.max(1e-4))
}

/// A voxel value, which may have any scale: four decimals, or five digits below 1.
pub(crate) fn rounded_value(value: f32) -> Value {
    let value = f64::from(value);
    if value == 0.0 || value.abs() >= 1.0 {
        json!(round_to(value, 4))
    } else {
        json!(format!("{value:.4e}").parse::<f64>().unwrap_or(value))
    }
}

/// An end of a recipe's range of values, rounded to hundredths.
pub(crate) fn hundredths(value: f32) -> Value {
    json!(round_to(f64::from(value), 2))
}

/// x, y and z.
pub(crate) fn vector(v: Vec3) -> Value {
    Value::from(v.to_array().map(rounded).to_vec())
}

/// x, y, z and w. Of the two quaternions of a rotation, the one with w at or above 0, so that the identity is always
/// the default.
pub(crate) fn rotation(q: Quat) -> Value {
    let q = if q.w < 0.0 { -q } else { q };
    Value::from(q.to_array().map(rounded).to_vec())
}

/// A colour as `#rrggbb`.
pub(crate) fn color_text(color_srgb: [u8; 3]) -> String {
    format!("#{}", crate::math::hex(&color_srgb))
}
