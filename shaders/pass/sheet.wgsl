// A bent figure: triangles in the order of their overlap, without a depth buffer, so that translucent pixels blend
// rightly. One sample is drawn into a layer of its own, which is then mixed into the samples before.
// needs: types.wgsl affine.wgsl srgb.wgsl bind/frame.wgsl bind/sheet.wgsl

/// A squeezed plate is read at so many places along the direction in which it is squeezed, at most.
const MOST_TAPS: f32 = 8.0;

/// A corner of a triangle.
struct Corner {
    @builtin(position) at: vec4f,
    /// Where it is at rest, subject space.
    @location(0) rest: vec2f,
    /// Straight linear colour in place of the plate's; alpha 0: the plate's.
    @location(1) color: vec4f,
}

/// Places a corner in the picture: so that the middle of a pixel meets what the ray through the pixel's jittered point
/// would meet.
@vertex
fn place_corner(@location(0) rest: vec2f, @location(1) place: vec2f, @location(2) color: vec4f) -> Corner {
    let from_eye = vec3f(place, 0.0) - offset_of(frame.subject_from_view);
    let in_view = apply_transposed(frame.subject_from_view, from_eye);
    let depth = -in_view.z;
    // Pixels of the target, times the depth.
    let half_size = 0.5 * frame.size_px;
    let pixel = half_size * (vec2f(in_view.x, -in_view.y) / frame.lens + depth)
        + depth * (vec2f(0.5) - frame.jitter - vec2f(0.0, frame.first_row));
    let ndc = 2.0 * pixel / sheet.viewport - depth;
    return Corner(vec4f(ndc.x, -ndc.y, 0.5 * depth, depth), rest, color);
}

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// A texel of a smaller copy, linear premultiplied; beyond the edge the last one.
fn texel_at(texel: vec2i, level: u32) -> vec4f {
    let end = vec2i(textureDimensions(plate, level)) - 1;
    let found = textureLoad(plate, clamp(texel, vec2i(0), end), level);
    return vec4f(linear_from_srgb(found.rgb) * found.a, found.a);
}

/// A smaller copy between its texels. `at`: part of the plate's width and height, from the top left.
fn level_at(at: vec2f, level: u32) -> vec4f {
    let place = at * vec2f(textureDimensions(plate, level)) - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let texel = vec2i(corner);
    let top = mix(texel_at(texel, level), texel_at(texel + vec2i(1, 0), level), part.x);
    let bottom = mix(texel_at(texel + vec2i(0, 1), level), texel_at(texel + vec2i(1, 1), level), part.x);
    return mix(top, bottom, part.y);
}

/// The plate under a pixel that spans `dx` and `dy` (texels of the plate), linear premultiplied: the mean along the
/// longer way, from a copy whose texels are as large as the shorter way. In arithmetic that every device has, since
/// filters of devices round differently.
fn plate_at(at: vec2f, dx: vec2f, dy: vec2f) -> vec4f {
    let is_x = dot(dx, dx) > dot(dy, dy);
    let along = select(dy, dx, is_x);
    let longer = max(length(along), 1e-6);
    let shorter = abs(dx.x * dy.y - dx.y * dy.x) / longer;
    let taps = clamp(ceil(longer / max(shorter, 1e-6) - 0.01), 1.0, MOST_TAPS);
    let last = f32(sheet.levels - 1u);
    // No finer than the shorter way, so that nothing jumps where one tap more is taken.
    let level = clamp(log2(max(max(longer / taps, shorter), 1.0)), 0.0, last);
    let fine = u32(level);
    let part = level - f32(fine);
    var sum = vec4f(0.0);
    for (var tap = 0.0; tap < taps; tap += 1.0) {
        let place = at + along / sheet.texels * ((tap + 0.5) / taps - 0.5);
        var color = level_at(place, fine);
        if part > 0.0 {
            color = mix(color, level_at(place, fine + 1u), part);
        }
        sum += color;
    }
    return sum / taps;
}

/// The colour of the sheet, linear premultiplied. In every sample it is that of the middle of the pixel, and samples
/// soften edges only: an unbent plate stays as sharp as it is.
@fragment
fn draw_sheet(corner: Corner) -> @location(0) vec4f {
    let at = vec2f(0.5 + 0.5 * corner.rest.x / sheet.half_size.x, 0.5 - 0.5 * corner.rest.y / sheet.half_size.y);
    let dx = dpdx(at);
    let dy = dpdy(at);
    if corner.color.a > 0.5 {
        return corner.color;
    }
    let shift = vec2f(0.5) - frame.jitter;
    let middle = at + dx * shift.x + dy * shift.y;
    return plate_at(middle, dx * sheet.texels, dy * sheet.texels);
}

/// A sample of the layer, for the picture that it is mixed into.
@fragment
fn lay(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return textureLoad(plate, vec2i(at.xy), 0);
}
