// Squeeze: a waist at mid height. Dilate: a bulge there. Template space.
// Source: Correa, appendix C, with edges closed where no tear is meant (spec/templates.md).
//
//   z   squeeze        dilate
//   1 +-------+      +-------+      rest
//      \     /        |     |
//   ½   )   (        (       )      x and y carry: outside the cube the displacement of its sides goes on
//      /     \        |     |
//   0 +-------+      +-------+      rest
//     0   ½   1 x
//
// needs: displace/frame.wgsl

/// How much the cross section gives way at height z, 0 at the ends and 1 at one half.
fn waist(z: f32) -> f32 {
    // h(0) and h(½) of spec/templates.md.
    let low = 1.0 / (1.0 + exp(5.0));
    let high = 1.0 / (1.0 + exp(-5.0));
    return (1.0 / (1.0 + exp(20.0 * abs(z - 0.5) - 5.0)) - low) / (high - low);
}

/// A waist at mid height; below 0 the waist becomes a bulge.
fn waisted(q: vec3f, strength: f32) -> Displaced {
    if is_beyond(q, vec3f(-NO_END, -NO_END, 0.0), vec3f(NO_END, NO_END, 1.0)) {
        return at_rest(q);
    }
    let moved = strength * waist(q.z) * (in_cube(q).xy - 0.5);
    return Displaced(vec3f(q.xy + moved, q.z), 1.0);
}

/// p0: strength, 0 to 2. `q` in template space, as in every template.
fn displace_squeeze(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    return waisted(q, p0.x);
}
