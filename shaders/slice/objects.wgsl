// Objects in a slice: their surfaces as lines. No template moves them.
// needs: types.wgsl bind/slice.wgsl affine.wgsl objects.wgsl textures.wgsl march/overrides.wgsl slice/plane.wgsl

/// The object that lies between two places of the slice.
fn object_between(first: vec2f, second: vec2f) -> ObjectCrossing {
    let start = subject_from_pixel(first);
    return object_on(start, subject_from_pixel(second) - start, 0.0, 1.0);
}

/// Linear RGB of the slice at a place, with the lines of objects over what is there.
fn with_objects(pixel: vec2f, color: vec3f) -> vec3f {
    if has_objects == 0u {
        return color;
    }
    var met = object_between(pixel - vec2f(SLICE_LINE, 0.0), pixel + vec2f(SLICE_LINE, 0.0));
    if met.object == NO_OBJECT {
        met = object_between(pixel - vec2f(0.0, SLICE_LINE), pixel + vec2f(0.0, SLICE_LINE));
    }
    if met.object == NO_OBJECT {
        return color;
    }
    return object_color(met, place_alone(met.weights)) * SLICE_SURFACE;
}
