// Affine maps between spaces, by their rows.
// needs: -

/// An affine map: each row holds the three factors and the offset of one coordinate of the result.
struct Affine {
    row0: vec4f,
    row1: vec4f,
    row2: vec4f,
}

/// Where the map takes a point.
fn apply_affine(map: Affine, pos: vec3f) -> vec3f {
    let p = vec4f(pos, 1.0);
    return vec3f(dot(map.row0, p), dot(map.row1, p), dot(map.row2, p));
}

/// Where its linear part takes a vector.
fn apply_linear(map: Affine, dir: vec3f) -> vec3f {
    return vec3f(dot(map.row0.xyz, dir), dot(map.row1.xyz, dir), dot(map.row2.xyz, dir));
}

/// Where its transposed linear part takes a gradient: from the space that the map leads to back to the one it comes
/// from.
fn apply_transposed(map: Affine, gradient: vec3f) -> vec3f {
    return map.row0.xyz * gradient.x + map.row1.xyz * gradient.y + map.row2.xyz * gradient.z;
}

/// Half extent of the image of a box of this half extent.
fn apply_to_extent(map: Affine, half: vec3f) -> vec3f {
    return vec3f(dot(abs(map.row0.xyz), half), dot(abs(map.row1.xyz), half), dot(abs(map.row2.xyz), half));
}

/// The map back.
fn inverse_affine(map: Affine) -> Affine {
    let columns = mat3x3f(
        cross(map.row1.xyz, map.row2.xyz),
        cross(map.row2.xyz, map.row0.xyz),
        cross(map.row0.xyz, map.row1.xyz),
    ) * (1.0 / dot(map.row0.xyz, cross(map.row1.xyz, map.row2.xyz)));
    let rows = transpose(columns);
    let offset = -(columns * offset_of(map));
    return Affine(vec4f(rows[0], offset.x), vec4f(rows[1], offset.y), vec4f(rows[2], offset.z));
}

/// Where the map takes the origin.
fn offset_of(map: Affine) -> vec3f {
    return vec3f(map.row0.w, map.row1.w, map.row2.w);
}
