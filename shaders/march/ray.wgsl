// Rays and boxes.
// needs: -

/// Where a ray is inside a box: x in, y out; empty if x > y. `inverse_dir` is 1/direction, with no zero in the
/// direction.
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

/// The direction with components near 0 set to ±1e-6, less than a thousandth of a pixel, so that each component can be
/// inverted.
fn without_zeros(dir: vec3f) -> vec3f {
    let least = vec3f(1e-6);
    return select(dir, select(-least, least, dir >= vec3f(0.0)), abs(dir) < least);
}
