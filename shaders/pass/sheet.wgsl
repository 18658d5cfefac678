// A bent figure: triangles in the order of their overlap, without a depth buffer, so that translucent pixels blend
// rightly. One sample is drawn into a layer of its own, which is then mixed into the samples before.
// needs: types.wgsl affine.wgsl srgb.wgsl bind/frame.wgsl bind/sheet.wgsl

/// A squeezed plate is read at so many places along the direction in which it is squeezed, at most.
const MOST_TAPS: f32 = 8.0;

/// Rasterisers move corners to places on a grid, of a sixteenth of a pixel in some: triangles are handed to them larger
/// by this on all sides (pixels), and each pixel tells itself whether it lies within, alike on every device.
const MARGIN: f32 = 0.125;
/// Sine of the sharpest corner that gets the whole margin. At a smaller one the tip would reach far.
const SHARPEST: f32 = 0.02;
/// Corners that are nearer to the eye than this, or behind it, have no pixel (subject units).
const NEAREST: f32 = 1e-3;

/// A corner of a triangle.
struct Corner {
    @builtin(position) at: vec4f,
    /// Straight linear colour in place of the plate's; alpha 0: the plate's.
    @location(0) color: vec4f,
    /// Where the triangle's first two corners are seen, pixels of the whole picture.
    @location(1) @interpolate(flat) seen: vec4f,
    /// The same of the third; z: 1 if all three are before the eye.
    @location(2) @interpolate(flat) last_seen: vec3f,
    /// Where the first corner is, and where it is at rest, subject space.
    @location(3) @interpolate(flat) first: vec4f,
    /// Columns of the map from directions in the bent triangle to those at rest.
    @location(4) @interpolate(flat) rest_from_place: vec4f,
}

/// Where a place of the figure's plane is seen: xy pixels of the whole picture, times the depth, z.
fn seen_at(place: vec2f) -> vec3f {
    let from_eye = vec3f(place, 0.0) - offset_of(frame.subject_from_view);
    let in_view = apply_transposed(frame.subject_from_view, from_eye);
    let depth = -in_view.z;
    let half_size = 0.5 * frame.size_px;
    return vec3f(half_size * (vec2f(in_view.x, -in_view.y) / frame.lens + depth), depth);
}

/// The place of the figure's plane that is seen at a pixel of the whole picture.
fn place_under(pixel: vec2f) -> vec2f {
    let side = (pixel / (0.5 * frame.size_px) - 1.0) * frame.lens;
    let dir = apply_linear(frame.subject_from_view, vec3f(side.x, -side.y, -1.0));
    let eye = offset_of(frame.subject_from_view);
    // Along the plane nothing of it is seen.
    let down = select(min(dir.z, -1e-6), max(dir.z, 1e-6), dir.z > 0.0);
    return eye.xy - dir.xy * (eye.z / down);
}

fn cross_of(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.y - a.y * b.x;
}

/// A corner of a triangle that is larger by the margin.
fn enlarged(corner: vec2f, next: vec2f, last: vec2f) -> vec2f {
    let from_next = corner - next;
    let from_last = corner - last;
    let one = from_next / max(length(from_next), 1e-6);
    let other = from_last / max(length(from_last), 1e-6);
    return corner + (one + other) * (MARGIN / max(abs(cross_of(one, other)), SHARPEST));
}

/// Places a corner in the picture: so that the middle of a pixel meets what the ray through the pixel's jittered point
/// would meet. Every corner has the whole triangle: its `places` are `first_two` and `third`.
@vertex
fn place_corner(
    @builtin(vertex_index) index: u32,
    @location(0) first_two: vec4f,
    @location(1) third: vec2f,
    @location(2) rest: vec2f,
    @location(3) rest_from_place: vec4f,
    @location(4) color: vec4f,
) -> Corner {
    var seen = array(seen_at(first_two.xy), seen_at(first_two.zw), seen_at(third));
    let is_before = min(min(seen[0].z, seen[1].z), seen[2].z) > NEAREST;
    let own = index % 3u;
    let depth = seen[own].z;
    var pixel = seen[own].xy;
    var corners = array(vec2f(0.0), vec2f(0.0), vec2f(0.0));
    if is_before {
        corners = array(seen[0].xy / seen[0].z, seen[1].xy / seen[1].z, seen[2].xy / seen[2].z);
        pixel = enlarged(corners[own], corners[(own + 1u) % 3u], corners[(own + 2u) % 3u]) * depth;
    }
    // Pixels of the target, times the depth.
    pixel += depth * (vec2f(0.5) - frame.jitter - vec2f(0.0, frame.first_row));
    let ndc = 2.0 * pixel / sheet.viewport - depth;
    return Corner(
        vec4f(ndc.x, -ndc.y, 0.5 * depth, depth),
        color,
        vec4f(corners[0], corners[1]),
        vec3f(corners[2], f32(is_before)),
        vec4f(first_two.xy, rest),
        rest_from_place,
    );
}

/// True if a pixel lies to the left of the way from one corner to another. It is to the right of the way back then, to
/// the last bit, so that of two triangles that share an edge one has the pixel.
fn is_left(start: vec2f, end: vec2f, pixel: vec2f) -> bool {
    let is_back = start.x > end.x || (start.x == end.x && start.y > end.y);
    let low = select(start, end, is_back);
    let high = select(end, start, is_back);
    return (cross_of(high - low, pixel - low) >= 0.0) != is_back;
}

/// True if the triangle has a pixel.
fn has(corner: Corner, pixel: vec2f) -> bool {
    let a = corner.seen.xy;
    let b = corner.seen.zw;
    let c = corner.last_seen.xy;
    let is_left_turn = cross_of(b - a, c - a) > 0.0;
    return is_left(a, b, pixel) == is_left_turn
        && is_left(b, c, pixel) == is_left_turn
        && is_left(c, a, pixel) == is_left_turn;
}

/// The place of the plate that a pixel of the whole picture shows where the triangle is: part of the plate's width and
/// height, from the top left.
fn on_plate(corner: Corner, pixel: vec2f) -> vec2f {
    let map = mat2x2f(corner.rest_from_place.xy, corner.rest_from_place.zw);
    let rest = corner.first.zw + map * (place_under(pixel) - corner.first.xy);
    return vec2f(0.5 + 0.5 * rest.x / sheet.half_size.x, 0.5 - 0.5 * rest.y / sheet.half_size.y);
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
    let middle = corner.at.xy + vec2f(0.0, frame.first_row);
    if corner.last_seen.z > 0.5 && !has(corner, middle - 0.5 + frame.jitter) {
        discard;
    }
    if corner.color.a > 0.5 {
        return corner.color;
    }
    let at = on_plate(corner, middle);
    let dx = on_plate(corner, middle + vec2f(1.0, 0.0)) - at;
    let dy = on_plate(corner, middle + vec2f(0.0, 1.0)) - at;
    return plate_at(at, dx * sheet.texels, dy * sheet.texels);
}

/// A sample of the layer, for the picture that it is mixed into.
@fragment
fn lay(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return textureLoad(plate, vec2i(at.xy), 0);
}
