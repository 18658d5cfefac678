// What each pixel of a picture shows, as pass/raycast.wgsl traced it.
// needs: types.wgsl octahedron.wgsl bind/frame.wgsl bind/style.wgsl march/view.wgsl style/words.wgsl

/// What a pixel shows.
struct Shown {
    /// Distance from the eye, below 0 where nothing is.
    t: f32,
    /// View space.
    pos: vec3f,
    /// Unit, towards the eye, view space.
    normal: vec3f,
    /// Where the tissue was at rest, rest space.
    rest: vec3f,
    /// Its label; from 512 on an object.
    segment: u32,
    /// Light that arrives: what is sent to the eye as a part of the tissue's colour.
    light: f32,
}

/// The pixel of the whole picture that is nearest to one beside it.
fn nearest_pixel(pixel: vec2i) -> vec2i {
    return clamp(pixel, vec2i(0), vec2i(frame.size_px) - 1);
}

/// The texel of a pixel of the whole picture.
fn traced_texel(pixel: vec2i) -> vec2i {
    return pixel - vec2i(0, i32(style.first_row));
}

/// What a pixel of the whole picture shows.
fn shown_at(pixel: vec2i) -> Shown {
    let inside = nearest_pixel(pixel);
    let texel = traced_texel(inside);
    let place = textureLoad(traced_place, texel, 0);
    let words = textureLoad(traced_surface, texel, 0);
    var shown: Shown;
    shown.t = place.w;
    shown.pos = dir_in_view_of(vec2f(inside) + frame.jitter) * place.w;
    shown.normal = from_octahedron(unpack2x16snorm(words.x));
    shown.rest = place.xyz;
    shown.segment = words.y & 0xffffu;
    shown.light = unpack2x16unorm(words.y).y * LIGHT_RANGE;
    return shown;
}

/// What a pixel shows of this place and no more.
fn rest_at(pixel: vec2i) -> vec4f {
    return textureLoad(traced_place, traced_texel(nearest_pixel(pixel)), 0);
}

/// Length of a pixel at a distance from the eye, subject units.
fn pixel_length(t: f32) -> f32 {
    return 2.0 * frame.lens.x / frame.size_px.x * t;
}
