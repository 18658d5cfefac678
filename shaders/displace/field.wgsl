// Field: a displacement that was sampled on a grid and read from a file. Template space; the samples fill the box from
// face to face.
// Source: Correa, section 9.3 (regular grids) and 4.3 (displacement textures); spec/templates.md.
//
//   +---+---+---+---+
//   | · | · | · | · |    xyz: displacement, w: continuity. Linear between the eight samples around a point; the
//   +---+---+---+---+    outermost samples go on to the faces; at rest beyond the faces
//   | · | · | · | · |
//   +---+---+---+---+
//
// This function interpolates by itself: the weights of the hardware have eight bits, which would show as steps.
// `templates.pool[held]` holds the number of samples along x, y and z, and the slice of the texture at which the
// samples begin (w). Without samples the template is at rest.
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl displace/rbf.wgsl

/// p0.x: strength, a factor of the displacement; p0.w: edge, the distance from the faces over which the displacement
/// fades in. `held`: index of the field in `templates.pool`.
fn displace_field(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f, held: u32) -> Displaced {
    let place = templates.pool[held];
    if is_beyond(q, vec3f(0.0), vec3f(1.0)) || place.x < 1.0 || p0.x == 0.0 {
        return at_rest(q);
    }
    let at = clamp(q * place.xyz - 0.5, vec3f(0.0), place.xyz - 1.0);
    let low = floor(at);
    let part = at - low;
    let last = vec3i(place.xyz) - 1;
    let near = vec3i(low);
    var sum = vec4f(0.0);
    for (var i = 0; i < 8; i++) {
        let step = vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
        let weight = select(1.0 - part, part, step > vec3i(0));
        let texel = min(near + step, last) + vec3i(0, 0, i32(place.w));
        sum += textureLoad(fields, texel, 0) * (weight.x * weight.y * weight.z);
    }
    return Displaced(q + sum.xyz * (p0.x * inner_weight(q, p0.w)), sum.w);
}
