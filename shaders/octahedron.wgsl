// Unit vectors as places on an unfolded octahedron, -1 to 1: two numbers instead of three, with even errors.
// needs: -

/// The unit vector of a place on the unfolded octahedron.
fn from_octahedron(at: vec2f) -> vec3f {
    let up = 1.0 - abs(at.x) - abs(at.y);
    let fold = max(-up, 0.0);
    return normalize(vec3f(at + select(vec2f(fold), vec2f(-fold), at >= vec2f(0.0)), up));
}

/// The place of a vector, which must not be 0, on the unfolded octahedron.
fn to_octahedron(dir: vec3f) -> vec2f {
    let at = dir.xy / (abs(dir.x) + abs(dir.y) + abs(dir.z));
    let folded = (1.0 - abs(at.yx)) * select(vec2f(-1.0), vec2f(1.0), at >= vec2f(0.0));
    return select(at, folded, dir.z < 0.0);
}
