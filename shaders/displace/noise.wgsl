// The noise of cracks: four octaves of values at whole-number places, eased between them (spec/surfaces.md, "The noise
// of cracks"). The same bits of the hash everywhere; `displace/noise.rs` is the same in Rust.
//
// needs: -

/// Octaves that are added up; each is twice as fine and half as strong as the one before.
const NOISE_OCTAVES: u32 = 4u;
/// 1 + 1/2 + 1/4 + 1/8: brings the sum to -1 … 1.
const NOISE_WEIGHT: f32 = 1.875;

/// The value at a whole-number place, -1 to 1. `salt` tells octaves and seeds apart.
fn noise_corner(at: vec2i, salt: u32) -> f32 {
    let place = bitcast<vec2u>(at);
    var h = (place.x * 0x9E3779B1u) ^ (place.y * 0x85EBCA77u) ^ (salt * 0xC2B2AE3Du);
    h ^= h >> 16u;
    h *= 0x7FEB352Du;
    h ^= h >> 15u;
    h *= 0x846CA68Bu;
    h ^= h >> 16u;
    return f32(h >> 16u) / 32767.5 - 1.0;
}

/// One octave, -1 to 1.
fn noise_octave(at: vec2f, salt: u32) -> f32 {
    // Beyond these places floats have no fractions left, and whole numbers an end.
    let bounded = clamp(at, vec2f(-1e9), vec2f(1e9));
    let low = floor(bounded);
    let a = bounded - low;
    let weight = a * a * a * (a * (6.0 * a - 15.0) + 10.0);
    let corner = vec2i(low);
    let bottom = mix(noise_corner(corner, salt), noise_corner(corner + vec2i(1, 0), salt), weight.x);
    let top = mix(noise_corner(corner + vec2i(0, 1), salt), noise_corner(corner + vec2i(1, 1), salt), weight.x);
    return mix(bottom, top, weight.y);
}

/// The noise at a place, -1 to 1; 1 is the size of the largest cells. `seed` is whole.
fn noise(at: vec2f, seed: u32) -> f32 {
    var sum = 0.0;
    var fine = 1.0;
    for (var k = 0u; k < NOISE_OCTAVES; k++) {
        sum += noise_octave(at * fine, k + 16u * seed) / fine;
        fine *= 2.0;
    }
    return sum / NOISE_WEIGHT;
}
