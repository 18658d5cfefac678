// A slice through a scan.
// needs: slice/plane.wgsl slice/values.wgsl march/plain.wgsl|march/align.wgsl

/// What the deformed object has at a point of subject space.
fn object_at(pos: vec3f) -> Here {
    return volume_from(object_from_subject(pos, 0xffffffffu));
}

/// Linear RGB of the object at a place, over the background.
fn color_at(pixel: vec2f) -> vec3f {
    return marked_color_of(object_at(subject_from_pixel(pixel)));
}
