// Bend: bend a bar that runs along y, towards -z (towards +z if negative). Metric. Defined everywhere.
// Source: Correa, appendix C, made rigid as in spec/templates.md.
//
//   z
//   1 +-----._            straight, bent from `start` to `end` along y, straight again
//   ½ +-----.__'-.        the middle plane keeps its length
//   0 +----.__ '. \
//             '\ \ \      the far straight part is turned by `angle` as a whole
//     0  start  \_\_\ y
//
// Differs from the source: a straight part follows the arc's tangent; where the straight parts meet on the far side of
// the centre of curvature D jumps (a seam) and A stays 1.
//
// Everything is scaled by the curvature kappa = phi/length instead of using the radius, which reaches 1e4 lengths at
// the smallest angle: there the radius would cancel to a few digits.
// needs: displace/frame.wgsl displace/angles.wgsl

/// p0: angle (radians), start, end.
fn displace_bend(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    let phi = abs(p0.x);
    if phi < 1e-4 {
        return at_rest(q);
    }
    let to_lower = select(-1.0, 1.0, p0.x > 0.0);
    let end = min(max(p0.z, p0.y + 0.01), 1.0);
    let start = min(p0.y, end - 0.01);
    let arc_length = (end - start) * size.y;
    let kappa = phi / arc_length;
    let u = (q.y - start) * size.y;
    // Height over the middle plane, away from the centre of curvature: v = w + radius.
    let w = to_lower * (q.z - 0.5) * size.z;
    let around = turn_of(kappa * u, 1.0 + kappa * w);
    var along = u;
    var height = w;
    if around <= phi {
        let scaled = vec2f(kappa * u, 1.0 + kappa * w);
        along = around / kappa;
        // hypot(u, v) - radius without the cancellation.
        height = (kappa * (u * u + w * w) + 2.0 * w) / (length(scaled) + 1.0);
    } else if around - phi < TAU - around {
        let sc = sin_cos(phi);
        let half_sc = sin_cos(0.5 * phi);
        // radius·(phi - sin phi), by its series where the difference would cancel.
        let phi2 = phi * phi;
        let series = phi2 * (1.0 / 6.0) * (1.0 - phi2 * 0.05 * (1.0 - phi2 * (1.0 / 42.0)));
        let lost = arc_length * select(1.0 - sc.x / phi, series, phi < 0.5);
        along = u * sc.y - w * sc.x + lost;
        height = u * sc.x + w * sc.y - arc_length * 2.0 * half_sc.x * half_sc.x / phi;
    }
    return Displaced(q + vec3f(0.0, (along - u) / size.y, to_lower * (height - w) / size.z), 1.0);
}
