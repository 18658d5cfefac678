// Pull: draw the middle of the box along a vector. Template space. Defined everywhere, smooth, without folds.
// Source: spec/templates.md (a compact bell of the kind of Correa's appendix C).
//
//   1 +---.---.---+
//     | /   ^   \ |     the ball of radius ½ gives way, most in the middle
//     |(    |    )|
//     | \   +   / |
//   0 +---'---'---+
//     0     ½     1
//
// needs: displace/frame.wgsl

/// p0: offset (xyz), fractions of the box, at most 0.3 long.
fn displace_pull(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let from_middle = q - 0.5;
    let bell = max(0.0, 1.0 - 4.0 * dot(from_middle, from_middle));
    return Displaced(q - p0.xyz * (bell * bell), 1.0);
}
