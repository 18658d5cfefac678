// Flap: a door that opens about its x = 0, z = 1 edge. Metric. Defined everywhere.
// Source: Correa, appendix C, as rebuilt in spec/templates.md.
//
//      /
//   z / door, turned rigidly by `angle`
//   1 +. . . . . . +
//     |   (gap)    |     depth·sz deep
//   Zp+------------+
//     |            |     at rest
//   0 +------------+
//     0            1  x
//
// A is in subject units: in the door the distance to its faces, at rest the distance to the walls of the bed.
// needs: displace/frame.wgsl displace/angles.wgsl

/// Both readings of a point of a flap: turned with the door, or where it always was. `displace_flap` decides; the grid
/// looks at both.
struct Opened {
    /// Source of the point if the point belongs to the door, template space.
    source: vec3f,
    /// A of the door, subject units.
    door_continuity: f32,
    /// A of what stays, subject units.
    rest_continuity: f32,
}

/// p0: angle (radians), depth.
fn opened(q: vec3f, size: vec3f, p0: vec4f) -> Opened {
    // Coordinates from the hinge of the door: x to the right, z up.
    let x = q.x * size.x;
    let z = (q.z - 1.0) * size.z;
    let thickness = p0.y * size.z;
    let side = min(q.y, 1.0 - q.y) * size.y;

    // At a quarter turn the door's hinge face and the plane of the top are one: A ties all over the gap and the door is
    // to win, whatever the rounding of the angle says.
    let turned = sin_cos(p0.x);
    let sc = select(turned, vec2f(0.0), abs(turned) < vec2f(1e-6));
    let source_x = x * sc.y + z * sc.x;
    let source_z = z * sc.y - x * sc.x;
    return Opened(
        vec3f(source_x / size.x, q.y, 1.0 + source_z / size.z),
        min(min(min(source_x, size.x - source_x), min(source_z + thickness, -source_z)), side),
        max(max(max(-x, x - size.x), max(-thickness - z, z)), -side),
    );
}

/// p0: angle (radians), depth.
fn displace_flap(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if p0.x <= 0.0 {
        return at_rest(q);
    }
    let o = opened(q, size, p0);
    if o.door_continuity >= min(o.rest_continuity, 0.0) {
        return Displaced(o.source, o.door_continuity);
    }
    return Displaced(q, o.rest_continuity);
}
