// Hole: push a round opening aside, along z. Template space.
// Source: spec/templates.md.
//
//   z
//   1 +--.      .--+     carries both ways along z, rest at the sides
//     |   \gap /   |     radius amount·(taper + (1 - taper)·z)
//     |    |  |    |     tissue out to r = ½ gives way
//   0 +----|  |----+
//     0     ½      1  x
//
// needs: displace/frame.wgsl

/// p0: amount (radius at the top, fraction of the box), taper (radius at the bottom as a fraction of it, 0 to 1).
fn displace_hole(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0, 0.0, -NO_END), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let z = clamp(q.z, 0.0, 1.0);
    let opening = min(p0.x * (p0.y + (1.0 - p0.y) * z), 0.475);
    let from_axis = q.xy - 0.5;
    let r = length(from_axis);
    // Source radius over radius, less 1: ½(r - o)/(½ - o)/r - 1 = -o(½ - r)/((½ - o) r), and -1 in the gap.
    let inward = opening * max(0.5 - r, 0.0) / max((0.5 - opening) * r, 1e-12);
    let moved = -min(inward, 1.0) * from_axis;
    let continuity = select(r - opening, 1.0, opening < CLOSED);
    return Displaced(vec3f(q.xy + moved, q.z), continuity);
}
