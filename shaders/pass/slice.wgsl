// A flat cut through the deformed object: finds at each pixel of a plane, as the picture does at a sample, where the
// material came from, its value and its label. Without a march a slice costs about as much as one step of the picture.
//
//   pixel --> subject space --> object_from_subject --> value, label --> grey by the window, or colours of the look
//
// needs: types.wgsl bind/subject.wgsl bind/templates.wgsl bind/look.wgsl bind/bodies.wgsl affine.wgsl
// displace/compose.wgsl subject/place.wgsl subject/volume.wgsl
//   march/plain.wgsl|march/align.wgsl

/// The plane and how it is shown.
@group(3) @binding(0) var<uniform> slice: Slice;

/// How thick the cut is for the opacity of colours, subject units: haze stays faint, skin is solid.
const SLICE_THICKNESS: f32 = 0.03;
/// How opaque tissue must be to have a colour of its own; below it fades into the background.
const SLICE_OPACITY_LENGTH: f32 = 0.01;

/// How much of a body's colour lies over the grey where bodies are marked.
const SLICE_MARK: f32 = 0.45;

/// What the object has at a point.
struct Here {
    /// Where the material was at rest, rest space.
    pos: vec3f,
    /// Normalised value, 0 to 1.
    texel: f32,
    /// As composed; below 0 in a gap.
    continuity: f32,
    /// Number of the segment, 0 for none.
    label: u32,
    /// False in a gap and outside the volume.
    is_there: bool,
}

/// What the deformed object has at a point of subject space.
fn object_at(pos: vec3f) -> Here {
    let mapped = object_from_subject(pos, 0xffffffffu);
    let uvw = texture_from_rest(mapped.pos);
    let is_inside = is_in_subject(uvw);
    let voxel = floor(apply_affine(subject.label_from_rest, mapped.pos) * subject.label_dims.xyz);
    let has_label = subject.has_labels != 0u && all(voxel >= vec3f(0.0)) && all(voxel < subject.label_dims.xyz);
    let last = vec3i(subject.label_dims.xyz) - 1;
    let label = textureLoad(labels, clamp(vec3i(voxel), vec3i(0), last), 0).x;
    return Here(
        mapped.pos,
        texel_at(uvw),
        mapped.continuity,
        select(0u, label, has_label),
        is_inside && mapped.continuity >= 0.0,
    );
}

/// Subject space from a place in the slice (pixels, origin top left).
fn subject_from_pixel(pixel: vec2f) -> vec3f {
    return apply_affine(slice.subject_from_pixel, vec3f(pixel, 0.0));
}

/// Linear RGB of the object at a place, over the background; marked values are tinted.
fn color_at(pixel: vec2f) -> vec3f {
    let here = object_at(subject_from_pixel(pixel));
    if !here.is_there {
        return slice.background.rgb;
    }
    let color = color_of(here);
    if slice.marked.w > 0.0 && here.texel >= slice.marked_from && here.texel <= slice.marked_to {
        return mix(color, slice.marked.rgb, slice.marked.w);
    }
    return color;
}

/// Linear RGB of the object where there is something, over the background.
fn color_of(here: Here) -> vec3f {
    if slice.mode != SLICE_COLORS {
        let level = clamp(here.texel * slice.grey_scale + slice.grey_offset, 0.0, 1.0);
        // The window is linear in what a screen is sent, as on every radiologist's workstation.
        let grey = linear_from_srgb(vec3f(level));
        let mark = bodies.items[here.label & 255u];
        if slice.mode == SLICE_MARKED && mark.a > 0.0 {
            return mix(grey, mark.rgb, SLICE_MARK);
        }
        return grey;
    }
    let known = textureSampleLevel(lut, linear_sampler, vec2f(here.texel * look.table_scale + look.table_offset, 0.5), 0.0);
    let tint = textureLoad(palette, vec2i(i32(here.label), 0), 0);
    var albedo = mix(known.rgb, known.rgb * mix(vec3f(1.0), tint.rgb, tint.a), look.tint);
    var clear = pow(max(1.0 - known.a, 0.0), SLICE_THICKNESS / SLICE_OPACITY_LENGTH);
    let body = bodies.items[here.label & 255u];
    if body.a >= 0.0 {
        albedo = body.rgb;
        clear = pow(max(1.0 - body.a, 0.0), SLICE_THICKNESS / BODY_LAYER);
    }
    return mix(albedo, slice.background.rgb, clear);
}

/// Linear from sRGB, per channel (IEC 61966-2-1).
fn linear_from_srgb(c: vec3f) -> vec3f {
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

/// sRGB from linear, per channel (IEC 61966-2-1).
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let c = clamp(linear, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3f(0.0031308));
}

/// One triangle that covers everything.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// The slice, sRGB: mean of a square of samples per pixel.
@fragment
fn draw(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let side = max(slice.samples, 1u);
    var sum = vec3f(0.0);
    for (var k = 0u; k < side * side; k++) {
        let place = (vec2f(vec2u(k % side, k / side)) + 0.5) / f32(side);
        sum += color_at(floor(at.xy) + place);
    }
    return vec4f(srgb_from_linear(sum / f32(side * side)), 1.0);
}

/// The numbers, two texels per pixel side by side: value, segment, continuity and whether anything is there; rest
/// position.
@fragment
fn read(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let column = u32(at.x);
    let here = object_at(subject_from_pixel(vec2f(f32(column / 2u) + 0.5, at.y)));
    if column % 2u == 1u {
        return vec4f(here.pos, 0.0);
    }
    let value = subject.value_low + subject.value_range * here.texel;
    return vec4f(value, f32(here.label), here.continuity, select(0.0, 1.0, here.is_there));
}
