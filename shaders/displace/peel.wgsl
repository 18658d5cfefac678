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

/// Both readings of a point of a peel: rolled up with the flap, or lying where it always lay. Which one holds is
/// decided by `displace_peel`; the skip grid looks at both.
struct Peeled {
    /// Source of the point if the point belongs to the flap, template space.
    source: vec3f,
    /// A of the flap, subject units.
    flap_continuity: f32,
    /// How far along the layer it lies from the hinge, subject units; below 0 it is no part of the flap.
    along: f32,
    /// How far it lies outside the layer's bed, below 0 inside, subject units.
    outside: f32,
    /// Distance in x from the hinge, below 0 on the peeled side, subject units.
    past_hinge: f32,
}

/// p0: progress, depth, radius, angle (radians).
fn peeled(q: vec3f, size: vec3f, p0: vec4f) -> Peeled {
    let pos = q * size;
    let thickness = p0.y * size.z;
    let bed = size.z - thickness;
    let hinge = p0.x * size.x;
    let radius = p0.z * size.x;
    let side = min(q.y, 1.0 - q.y) * size.y;
    let outside = max(max(bed - pos.z, -pos.x), max(pos.z - size.z, -side));

    let rolled = unroll(hinge - pos.x, size.z + radius - pos.z, p0.w);
    let along = (radius + 0.5 * thickness) * rolled.angle + rolled.along;
    let source_x = hinge - along;
    // Depth under the top of the flap; its source z is the top minus this.
    let under_top = rolled.across - radius;
    return Peeled(
        vec3f(source_x / size.x, q.y, 1.0 - under_top / size.z),
        min(min(source_x, thickness - under_top), min(under_top, side)),
        along,
        outside,
        pos.x - hinge,
    );
}

/// p0: progress, depth, radius, angle (radians).
fn displace_peel(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if p0.x <= 0.0 || p0.w <= 0.0 {
        return at_rest(q);
    }
    let p = peeled(q, size, p0);
    let rest_continuity = select(length(vec2f(p.past_hinge, p.outside)), p.outside, p.past_hinge < 0.0);
    if p.along >= 0.0 && p.flap_continuity >= min(rest_continuity, 0.0) {
        return Displaced(p.source, p.flap_continuity);
    }
    return Displaced(q, rest_continuity);
}
