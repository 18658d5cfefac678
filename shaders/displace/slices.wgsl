// Slices: cut into slabs along z and draw them apart. Template space. Defined everywhere.
// Source: Correa, appendix C, as in spec/templates.md.
//
//   z         +-------+      the last slab goes on upwards
//             +-------+
//                            gap·progress; the source stays at the top of the slab below
//         +-------+
//         +-------+          shift·progress sideways per slab
//
//     +-------+
//   0 +-------+              the first slab goes on downwards
//     0       1  x
//
// needs: displace/frame.wgsl

/// Where tissue is drawn to, by its place at rest.
fn carry_slices(rest: vec3f, p0: vec4f) -> vec3f {
    let count = clamp(floor(p0.x + 0.5), 1.0, 32.0);
    let k = clamp(floor(rest.z * count), 0.0, count - 1.0);
    return rest + k * p0.w * vec3f(p0.z, 0.0, p0.y);
}

/// p0: count, gap, shift, progress.
fn displace_slices(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let count = clamp(floor(p0.x + 0.5), 1.0, 32.0);
    let thickness = 1.0 / count;
    let gap = p0.y * p0.w;
    let shift = p0.z * p0.w;
    let period = thickness + gap;
    let k = clamp(floor(q.z / period), 0.0, count - 1.0);
    let r = q.z - k * period;
    let is_last = k >= count - 1.0;

    let over = r - thickness;
    let is_in_gap = !is_last && over > 0.0;
    // Below 0 all through a slab, so that only a gap carries a part of the next slab's shift.
    let through_gap = select(0.0, clamp(over / max(gap, 1e-12), 0.0, 1.0), is_in_gap && gap > 0.0);
    // As differences from q, so that closed slices are exactly the identity.
    let source = vec3f(
        q.x - shift * (k + through_gap),
        q.y,
        q.z - k * gap - select(0.0, over, is_in_gap),
    );

    var continuity = min(1.0, min(select(1.0, r, k > 0.0), select(-over, 1.0, is_last)));
    continuity = select(continuity, -min(over, period - r), is_in_gap);
    let is_closed = gap < CLOSED && abs(shift) < CLOSED;
    return Displaced(source, select(continuity, 1.0, is_closed));
}
