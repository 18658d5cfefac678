// From pixels of the picture to directions of view space.
// needs: types.wgsl bind/frame.wgsl

/// Direction from the eye through a point of the picture (pixels, origin top left): unit, view space.
fn dir_in_view_of(pixel: vec2f) -> vec3f {
    let ndc = (pixel / frame.size_px) * 2.0 - 1.0;
    return normalize(vec3f(ndc.x * frame.lens.x, -ndc.y * frame.lens.y, -1.0));
}
