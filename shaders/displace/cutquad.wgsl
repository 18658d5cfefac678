// Cutquad: an incision along y, opening along x, with lips that bulge. Template space.
// Source: Correa, appendix C, with edges closed where no tear is meant (spec/templates.md).
//
//   z  section across
//   1 +-.^.         .^.-+     the lips rise by `ripple`
//     |    \ (gap) /    |
//     |     '.   .'     |     the opening grows with z²
//   0 +-------'.'-------+
//     0  .1    ½     .9 1 x   tissue within 0.4 of the mid plane moves aside
//
// Above the cube, tissue moves as on the top face. Beyond the other faces, tissue stays at rest.
// needs: displace/frame.wgsl displace/angles.wgsl

/// Only tissue nearer to the mid plane than this distance (template units) moves aside.
const CUTQUAD_REACH: f32 = 0.4;

/// p0: amount, length, ripple.
fn displace_cutquad(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    // Shut it is the identity to the bit, also where a device contracts products and sums.
    if p0.x <= 0.0 || is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let z = min(q.z, 1.0);
    let along = (q.y - 0.5) / max(p0.y, 1e-6);
    let m = 1.0 - min(along * along, 1.0);
    let opening = min(p0.x * m * z * z, 0.38);

    let across = q.x - 0.5;
    let d = abs(across);
    let t = clamp((d - opening) / (CUTQUAD_REACH - opening), 0.0, 1.0);
    let moved = select(0.0, CUTQUAD_REACH * t - d, d < CUTQUAD_REACH);
    let wave = sin_cos(TAU * t).x;
    let lift = p0.z * min(1.0, 10.0 * p0.x) * (1.0 - t) * m * z * z * wave * wave;
    let continuity = select(d - opening, 1.0, opening < CLOSED);
    return Displaced(q + vec3f(select(moved, -moved, across < 0.0), 0.0, -lift), continuity);
}
