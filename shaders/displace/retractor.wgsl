// Retractor: draw an incision along x open, compressing the tissue beside it. Template space.
// Source: Correa, appendix C, with edges closed where no tear is meant (spec/templates.md).
//
//   z  section across               y  from above
//   1 +--.         .--+           1 +-----------+
//     |   \ (gap) /   |             |  .-----.  |    tissue within `reach` of the mid line gives way
//     |    \     /    |           ½ + <  gap  > +    closed at both ends of the cube
//   0 +-----\._./-----+             |  '-----'  |
//     0      ½        1 y         0 +-----------+ x
//
// Carries upwards, rest elsewhere.
// needs: displace/frame.wgsl

/// p0: amount, length, reach.
fn displace_retractor(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let reach = p0.z;
    let inv_length = 1.0 / max(p0.y, 1e-6);
    let t = (0.5 - q.x) * inv_length;
    let edge = exp(-1.25 * inv_length * inv_length);
    let profile = max(0.0, (exp(-5.0 * t * t) - edge) / (1.0 - edge));
    let opening = min(p0.x * min(q.z, 1.0) * profile, 0.95 * reach);

    let across = q.y - 0.5;
    let d = abs(across);
    var moved = 0.0;
    if d < reach {
        // (d - o)/(reach - o)·reach - d = -o (reach - d)/(reach - o), and -d in the gap.
        moved = -min(d, opening * (reach - d) / (reach - opening));
    }
    let continuity = select(d - opening, 1.0, opening < CLOSED);
    return Displaced(vec3f(q.x, q.y + select(moved, -moved, across < 0.0), q.z), continuity);
}
