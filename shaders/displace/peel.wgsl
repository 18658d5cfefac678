// Peel: roll a layer up from the x = 0 edge. Metric. Defined everywhere.
// Source: Correa, appendix C, as rebuilt in spec/templates.md.
//
//          .--.          the roll: inside radius r, turns by at most `angle`, then goes on straight
//   z     (    )
//   1 +~~~~`. /__________+
//     | (gap)X     layer |   depth·sz thick
//   Zp+------+-----------+
//     |     Xh           |   Xh = progress·sx: the hinge; to its right and below everything is at rest
//   0 +------------------+
//     0                  1  x
//
// A is in subject units: inside the flap the distance to its faces, at rest the distance to the walls of the bed.
// The hinge face is whole tissue: it chooses between flap and rest, but it is no cut.
// needs: displace/frame.wgsl displace/angles.wgsl

/// p0: progress, depth, radius, angle (radians).
fn displace_peel(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if p0.x <= 0.0 || p0.w <= 0.0 {
        return at_rest(q);
    }
    let pos = q * size;
    let thickness = p0.y * size.z;
    let bed = size.z - thickness;
    let hinge = p0.x * size.x;
    let radius = p0.z * size.x;
    let side = min(q.y, 1.0 - q.y) * size.y;

    let outside = max(max(bed - pos.z, -pos.x), max(pos.z - size.z, -side));
    let rest_continuity = select(length(vec2f(pos.x - hinge, outside)), outside, pos.x < hinge);

    let rolled = unroll(hinge - pos.x, size.z + radius - pos.z, p0.w);
    let along = (radius + 0.5 * thickness) * rolled.angle + rolled.along;
    let source_x = hinge - along;
    // Depth under the top of the flap; its source z is the top minus this.
    let under_top = rolled.across - radius;
    let flap_continuity = min(min(source_x, thickness - under_top), min(under_top, side));
    if along >= 0.0 && flap_continuity >= min(rest_continuity, 0.0) {
        return Displaced(vec3f(source_x / size.x, q.y, 1.0 - under_top / size.z), flap_continuity);
    }
    return Displaced(q, rest_continuity);
}
