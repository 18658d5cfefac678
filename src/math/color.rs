//! The sRGB curve (IEC 61966-2-1), with the same bits on every machine.

use std::sync::LazyLock;

/// Linear light of each byte: a mesh has several for each of its triangles, and powers take long.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let c = byte as f32 / 255.0;
        if c <= 0.04045 {
            c / 12.92
        } else {
            // The power in 64 bits is rounded once; `libm::powf` is one unit off for 23 of the bytes.
            libm::pow(f64::from((c + 0.055) / 1.055), f64::from(2.4_f32)) as f32
        }
    })
});

/// Linear light, 0 to 1, of one sRGB byte.
pub fn linear_from_srgb(byte: u8) -> f32 {
    LINEAR[usize::from(byte)]
}

/// The sRGB byte nearest to a value of linear light; values outside 0 to 1 give the nearest end.
pub fn srgb_from_linear(value: f64) -> u8 {
    let value = value.clamp(0.0, 1.0);
    let c = if value <= 0.003_130_8 {
        value * 12.92
    } else {
        1.055 * libm::pow(value, 1.0 / 2.4) - 0.055
    };
    (c * 255.0).round() as u8
}

/// The colour `part` (0 to 1) of the way between two sRGB colours, mixed in linear light.
pub fn mix_srgb(from: [u8; 3], to: [u8; 3], part: f32) -> [u8; 3] {
    std::array::from_fn(|i| {
        let (a, b) = (linear_from_srgb(from[i]), linear_from_srgb(to[i]));
        srgb_from_linear(f64::from(a + (b - a) * part))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_survive_linear_light() {
        for byte in 0..=255 {
            let linear = linear_from_srgb(byte);
            assert_eq!(srgb_from_linear(f64::from(linear)), byte);
            let exact = f64::from(byte) / 255.0;
            let exact = if exact <= 0.04045 {
                exact / 12.92
            } else {
                libm::pow((exact + 0.055) / 1.055, 2.4)
            };
            assert!((f64::from(linear) - exact).abs() <= 6e-7 * exact, "{byte}");
        }
        assert_eq!(srgb_from_linear(-1.0), 0);
        assert_eq!(srgb_from_linear(2.0), 255);
        // Half the light of white is sRGB 188.
        assert_eq!(mix_srgb([0; 3], [255; 3], 0.5), [188; 3]);
    }
}
