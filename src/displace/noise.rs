//! The noise of cracks, as `shaders/displace/noise.wgsl` has it.

/// Octaves that are added up.
const OCTAVES: u32 = 4;
/// 1 + 1/2 + 1/4 + 1/8.
const WEIGHT: f32 = 1.875;

/// The noise at a place, -1 to 1; 1 is the size of the largest cells (spec/surfaces.md, "The noise of cracks").
pub fn noise(u: f32, v: f32, seed: u32) -> f32 {
    let octave = |k: u32| {
        let fine = (1u32 << k) as f32;
        let salt = k.wrapping_add(seed.wrapping_mul(16));
        octave(u * fine, v * fine, salt) / fine
    };
    (0..OCTAVES).map(octave).sum::<f32>() / WEIGHT
}

fn octave(u: f32, v: f32, salt: u32) -> f32 {
    let bounded = |x: f32| x.clamp(-1e9, 1e9);
    let (u, v) = (bounded(u), bounded(v));
    let (i, j) = (u.floor(), v.floor());
    let eased = |a: f32| a * a * a * (a * (6.0 * a - 15.0) + 10.0);
    let (a, b) = (eased(u - i), eased(v - j));
    let (i, j) = (i as i32, j as i32);
    let mix = |x: f32, y: f32, part: f32| x * (1.0 - part) + y * part;
    let row = |j: i32| mix(corner(i, j, salt), corner(i.wrapping_add(1), j, salt), a);
    mix(row(j), row(j.wrapping_add(1)), b)
}

/// The value at a whole-number place, -1 to 1.
fn corner(i: i32, j: i32, salt: u32) -> f32 {
    let mut h = (i as u32).wrapping_mul(0x9E37_79B1)
        ^ (j as u32).wrapping_mul(0x85EB_CA77)
        ^ salt.wrapping_mul(0xC2B2_AE3D);
    h ^= h >> 16;
    h = h.wrapping_mul(0x7FEB_352D);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846C_A68B);
    h ^= h >> 16;
    (h >> 16) as f32 / 32767.5 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_even_bounded_and_has_no_steps() {
        let (mut sum, mut most) = (0.0, 0.0_f32);
        for i in 0..200 {
            for j in 0..50 {
                let (u, v) = (i as f32 * 0.173 - 17.0, j as f32 * 0.311 - 7.0);
                let value = noise(u, v, 3);
                sum += value;
                most = most.max(value.abs());
                let beside = noise(u + 1e-3, v, 3);
                assert!((beside - value).abs() < 0.02, "a step at {u}, {v}");
            }
        }
        assert!((sum / 1e4).abs() < 0.05, "about as much above 0 as below");
        assert!((0.6..=1.0).contains(&most), "{most}");
        assert_ne!(noise(0.3, 0.4, 0), noise(0.3, 0.4, 1), "seeds differ");
        // At whole places of the first octave all octaves stand at corners.
        let corners = [0, 1, 2, 3].map(|k| corner(5 << k, -3 * (1 << k), k) / (1 << k) as f32);
        assert!((noise(5.0, -3.0, 0) - corners.iter().sum::<f32>() / WEIGHT).abs() < 1e-6);
        assert!(noise(f32::MAX, f32::MIN, 999).is_finite());
    }
}
