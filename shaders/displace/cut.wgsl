// Cut: remove material, move nothing. Template space. Defined everywhere.
// Source: spec/templates.md.
//
//     box          sphere       cylinder     halfspace
//   1 +-------+     .-----.     .-----.                      A < 0 inside: removed
//     | (gap) |    / (gap) \   | (gap) |     (gap)
//     |       |   |         |  |       |   ~~~~~~~~~ z = ½
//     |       |    \       /   |       |     kept
//   0 +-------+     '-----'     '-----'
//
// needs: displace/frame.wgsl

/// p0: shape (0 box, 1 sphere, 2 cylinder along z, 3 halfspace).
fn displace_cut(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let c = q - 0.5;
    var continuity = max(max(abs(c.x), abs(c.y)), abs(c.z)) - 0.5;
    if p0.x > 2.5 {
        continuity = -c.z;
    } else if p0.x > 1.5 {
        continuity = max(length(c.xy), abs(c.z)) - 0.5;
    } else if p0.x > 0.5 {
        continuity = length(c) - 0.5;
    }
    return Displaced(q, continuity);
}
