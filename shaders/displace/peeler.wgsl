// Peeler: lift a tongue of the top layer. Template space.
// Source: Correa, appendix C, as in spec/templates.md.
//
//   z        from the front            from the side
//       .                 .                      .-  tongue, lifted by lift·y²
//   1 + - \  tongue, up / - +            _..--''
//     |    '.         .'    |        z0 +-----------+
//     |      '-.___.-'      |           |  whole    |
//   0 +--------- z0 --------+           +-----------+ y     y = 1 tears, as meant
//     0         ½           1 x
//
// z0 = 4((x-½)/width)² is the bed, t = z0 + lift·y² the underside of the lifted tongue; between them a gap.
// Carries upwards for x and y, where the formula uses the true z; rest elsewhere.
// needs: displace/frame.wgsl

/// p0: lift (height of the tip, fraction of the box), width of the tongue (fraction of the box).
fn displace_peeler(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let across = (q.x - 0.5) / max(p0.y, 1e-6);
    let bed = 4.0 * across * across;
    let lift = p0.x * q.y * q.y;
    let over = q.z - bed;
    let moved = -min(lift, max(over, 0.0));
    // Under the bed -over, above the tongue's underside over - lift, in the gap the larger of the two (both below 0).
    let continuity = select(max(-over, over - lift), 1.0, lift < CLOSED);
    return Displaced(vec3f(q.xy, q.z + moved), continuity);
}
