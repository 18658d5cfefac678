// Wave: concentric ripple along y. Template space.
// Source: Correa, appendix C, as in spec/templates.md.
//
//   y     carries both ways
//   1 +-.---._.---.-+
//     | '._.' '._.' |      rings about the middle, displaced along y; at rest beyond the sides in x and z
//   0 +-------------+      with falloff 0 the ripple reaches the sides and tears there, on purpose
//     0      ½      1  x (and z)
//
// needs: displace/frame.wgsl displace/angles.wgsl

/// p0: amplitude, frequency (radians per unit of radius), falloff.
fn displace_wave(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0, -NO_END, 0.0), vec3f(1.0, NO_END, 1.0)) {
        return at_rest(q);
    }
    let rho = length(q.xz - 0.5);
    let lift = p0.x * sin_cos(p0.y * rho).x * falloff_weight(rho, p0.z);
    return Displaced(vec3f(q.x, q.y + lift, q.z), 1.0);
}
