// A slice through a mesh: what is filled in the colours of its segments, and surfaces as lines.
// needs: types.wgsl textures.wgsl bind/subject.wgsl bind/mesh_look.wgsl bind/slice.wgsl affine.wgsl
// displace/compose.wgsl subject/place.wgsl subject/mesh.wgsl subject/crossing.wgsl march/filling.wgsl slice/plane.wgsl
// march/plain.wgsl|march/align.wgsl

/// Between two pixels the map goes no farther than this many times their distance; farther is a jump.
const SLICE_STRETCH: f32 = 12.0;

/// What the deformed object has at a point of subject space: its depth under the surface stands for a value.
fn object_at(pos: vec3f) -> Here {
    let mapped = object_from_subject(pos, 0xffffffffu);
    let segment = filled_at(mapped.pos);
    return Here(
        mapped.pos,
        texel_at(texture_from_rest(mapped.pos)),
        mapped.continuity,
        segment,
        segment != 0u && mapped.continuity >= 0.0,
    );
}

/// The triangle that lies between two places of the slice; NO_TRIANGLE for none.
fn surface_between(first: vec2f, second: vec2f) -> u32 {
    let a = subject_from_pixel(first);
    let b = subject_from_pixel(second);
    let one = object_from_subject(a, 0xffffffffu);
    let other = object_from_subject(b, 0xffffffffu);
    if min(one.continuity, other.continuity) < 0.0 || distance(one.pos, other.pos) > SLICE_STRETCH * distance(a, b) {
        return NO_TRIANGLE;
    }
    return first_crossing(one.pos, other.pos, NO_TRIANGLE).triangle;
}

/// Linear RGB of the object at a place, over the background.
fn color_at(pixel: vec2f) -> vec3f {
    let across = surface_between(pixel - vec2f(SLICE_LINE, 0.0), pixel + vec2f(SLICE_LINE, 0.0));
    let along = surface_between(pixel - vec2f(0.0, SLICE_LINE), pixel + vec2f(0.0, SLICE_LINE));
    let line = min(across, along);
    if line != NO_TRIANGLE {
        return surface_color(line, place_alone(vec3f(1.0 / 3.0)), true) * SLICE_SURFACE;
    }
    let here = object_at(subject_from_pixel(pixel));
    if !here.is_there {
        return slice.background.rgb;
    }
    return filling_color(here.label, here.pos);
}
