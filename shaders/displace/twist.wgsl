// Twist: turn about the z axis. Metric in x and y, so that a circle stays one in a box of any proportions.
// Source: Correa, appendix C, made rigid as in spec/templates.md.
//
//     y                z carries upwards, the other ends rest
//   1 +---.--.---+
//     | /  ->  \ |     the turn grows with z from none to `angle`; from (1 - falloff)/2 of the shorter side to ½ it
//     fades
//     ||   +    ||     falloff 0 turns the whole box and tears at its sides, as meant
//     | \  <-  / |
//   0 +---'--'---+  x
//
// needs: displace/frame.wgsl displace/angles.wgsl

/// p0: angle (radians), falloff.
fn displace_twist(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if is_beyond(q, vec3f(0.0), vec3f(1.0, 1.0, NO_END)) {
        return at_rest(q);
    }
    let from_axis = (q.xy - 0.5) * size.xy;
    let r = length(from_axis) / min(size.x, size.y);
    // Above the cube all turns as the top does.
    let sc = sin_cos(p0.x * min(q.z, 1.0) * falloff_weight(r, p0.y));
    // As a difference, so that no turn is exactly no displacement.
    let moved = vec2f(
        from_axis.x * (sc.y - 1.0) + from_axis.y * sc.x,
        from_axis.y * (sc.y - 1.0) - from_axis.x * sc.x,
    );
    return Displaced(vec3f(q.xy + moved / size.xy, q.z), 1.0);
}
