// Surfaces of meshes in a slice, as lines.
// needs: types.wgsl textures.wgsl bind/subject.wgsl bind/mesh_look.wgsl displace/compose.wgsl subject/mesh.wgsl
//   subject/crossing.wgsl march/filling.wgsl slice/plane.wgsl march/plain.wgsl|march/align.wgsl

/// Between two pixels the map goes no farther than this many times their distance; farther is a jump.
const SLICE_STRETCH: f32 = 12.0;

/// The triangle that lies between two places of the slice; NO_TRIANGLE for none.
fn surface_between(first: vec2f, second: vec2f) -> u32 {
    let a = subject_from_pixel(first);
    let b = subject_from_pixel(second);
    let one = object_from_subject(a, 0xffffffffu);
    let other = object_from_subject(b, 0xffffffffu);
    if min(one.continuity, other.continuity) < 0.0 || distance(one.pos, other.pos) > SLICE_STRETCH * distance(a, b) {
        return NO_TRIANGLE;
    }
    return first_crossing(one.pos, other.pos, NO_TRIANGLE, false).triangle;
}

/// The triangle whose line lies over a pixel; NO_TRIANGLE for none.
fn line_at(pixel: vec2f) -> u32 {
    let across = surface_between(pixel - vec2f(SLICE_LINE, 0.0), pixel + vec2f(SLICE_LINE, 0.0));
    let along = surface_between(pixel - vec2f(0.0, SLICE_LINE), pixel + vec2f(0.0, SLICE_LINE));
    return min(across, along);
}

/// Linear RGB of the line of a triangle.
fn line_color(triangle: u32) -> vec3f {
    return surface_color(triangle, place_alone(vec3f(1.0 / 3.0)), true) * SLICE_SURFACE;
}
