// What is known of a traced surface in two words of 32 bits.
// needs: octahedron.wgsl

/// The brightest light that the words hold.
const LIGHT_RANGE: f32 = 2.0;

/// The words of a unit normal, a segment and the light that arrives.
fn surface_words(normal: vec3f, segment: u32, light: f32) -> vec2u {
    let lit = pack2x16unorm(vec2f(0.0, light / LIGHT_RANGE));
    return vec2u(pack2x16snorm(to_octahedron(normal)), lit | min(segment, 0xffffu));
}
