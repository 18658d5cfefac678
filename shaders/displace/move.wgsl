// Move: take the box out whole and put it elsewhere. Metric. Defined everywhere.
// Source: spec/templates.md.
//
//              .-'-.
//             /     \      the box, turned about its centre and set down at `offset`
//             '-. .-'
//   1 +- - - -+  '
//     | (gap) |            the bed it was taken from
//   0 +- - - -+
//     0       1  x
//
// A is in subject units: in the box the distance to its faces, elsewhere the distance to the walls of the bed.
// needs: displace/frame.wgsl

/// Distance to the nearest face of the box, subject units; below 0 outside.
fn inside_box(q: vec3f, size: vec3f) -> f32 {
    let d = min(q, 1.0 - q) * size;
    return min(d.x, min(d.y, d.z));
}

/// Where a point of the moved box came from, template space. Parameters as of `displace_move`.
fn moved_back(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> vec3f {
    let axis = vec3f(p0.w, p1.x, p1.y);
    let v = size * (q - 0.5 - p0.xyz);
    // The inverse turn: the quaternion's vector part reversed.
    let across = cross(v, axis);
    let turned = v + 2.0 * (p1.z * across + cross(across, axis));
    return 0.5 + turned / size;
}

/// p0: offset (xyz, fractions of the box), x of the quaternion; p1: y, z, w of the quaternion.
fn displace_move(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f) -> Displaced {
    if all(p0.xyz == vec3f(0.0)) && all(vec3f(p0.w, p1.xy) == vec3f(0.0)) {
        return at_rest(q);
    }
    let source = moved_back(q, size, p0, p1);
    let box_continuity = inside_box(source, size);
    let rest_continuity = -inside_box(q, size);
    if box_continuity >= min(rest_continuity, 0.0) {
        return Displaced(source, box_continuity);
    }
    return Displaced(q, rest_continuity);
}
