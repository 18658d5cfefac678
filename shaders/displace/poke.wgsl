// Poke: push in or pull out a bump along z. Template space.
// Source: Correa, "Discontinuous displacement mapping", appendix C, with edges closed where no tear is
// meant (spec/templates.md).
//
//   z
//   1 +- - ./^\. - -+     carries upwards: a pulled bump leaves the cube through its top
//     |   /  |  \   |
//     |  /   |   \  |     what moves: a bell about the axis, more the higher
//   0 +-'----+----'-+     rest
//     0      ½      1  x
//
// Differs from the source: the bell is brought to exactly 0 at r = ½, so that nothing tears at the sides.
// needs: displace/frame.wgsl

/// p0: amount (height, fraction of the box; below 0 pushes in), sigma (width of the bell, fraction of the box).
fn displace_poke(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let z = min(q.z, 1.0);
    let from_axis = q.xy - 0.5;
    let inv_two_sigma2 = 0.5 / max(p0.y * p0.y, 1e-12);
    let edge = exp(-0.25 * inv_two_sigma2);
    let bell = max(0.0, (exp(-dot(from_axis, from_axis) * inv_two_sigma2) - edge) / (1.0 - edge));
    return Displaced(vec3f(q.xy, q.z - p0.x * z * bell), 1.0);
}
