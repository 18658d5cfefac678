// Rays and boxes.
// needs: -

/// Where a ray is inside a box: x in, y out; empty if x > y. `inverse_dir` is 1/direction, with no zero in the direction.
fn ray_in_box(origin: vec3f, inverse_dir: vec3f, box_min: vec3f, box_max: vec3f) -> vec2f {
    let a = (box_min - origin) * inverse_dir;
    let b = (box_max - origin) * inverse_dir;
    let near = min(a, b);
    let far = max(a, b);
    return vec2f(
        max(max(near.x, near.y), near.z),
        min(min(far.x, far.y), far.z),
    );
}

/// The direction with components that are nearly 0 pushed off it (by less than a thousandth of a pixel), so that it can be inverted.
fn without_zeros(dir: vec3f) -> vec3f {
    let least = vec3f(1e-6);
    return select(dir, select(-least, least, dir >= vec3f(0.0)), abs(dir) < least);
}

/// Applies the affine given by its rows to a point.
fn apply_affine(row0: vec4f, row1: vec4f, row2: vec4f, pos: vec3f) -> vec3f {
    let p = vec4f(pos, 1.0);
    return vec3f(dot(row0, p), dot(row1, p), dot(row2, p));
}

/// Applies the linear part of the affine given by its rows to a vector.
fn apply_linear(row0: vec4f, row1: vec4f, row2: vec4f, dir: vec3f) -> vec3f {
    return vec3f(dot(row0.xyz, dir), dot(row1.xyz, dir), dot(row2.xyz, dir));
}

/// Applies the transposed linear part: takes gradients back along the map.
fn apply_transposed(row0: vec4f, row1: vec4f, row2: vec4f, dir: vec3f) -> vec3f {
    return row0.xyz * dir.x + row1.xyz * dir.y + row2.xyz * dir.z;
}
