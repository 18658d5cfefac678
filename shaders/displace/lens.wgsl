// Lens: magnify the middle of the box. Template space. Defined everywhere.
// Source: spec/templates.md.
//
//   1 +---.---.---+
//     | / \ | / \ |     in the ball of radius ½ the source is drawn to the middle, so that the middle is seen larger
//     |( -- + -- )|
//     | \ / | \ / |
//   0 +---'---'---+
//     0     ½     1
//
// needs: displace/frame.wgsl

/// p0: strength, 0 to 0.9: at the middle, the fraction by which the source lies nearer to the middle.
fn displace_lens(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let from_middle = q - 0.5;
    let bell = max(0.0, 1.0 - 4.0 * dot(from_middle, from_middle));
    return Displaced(q - from_middle * (p0.x * bell * bell), 1.0);
}
