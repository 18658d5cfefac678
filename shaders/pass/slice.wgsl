// A flat cut through the deformed object: finds at each pixel of a plane, as the picture does at a sample, where the
// material came from, its value and its label. Without a march a slice costs about as much as one step of the picture.
//
//   pixel --> subject space --> object_from_subject --> value, label --> grey by the window, or colours of the look
//
// needs: types.wgsl bind/subject.wgsl bind/slice.wgsl srgb.wgsl slice/plane.wgsl slice/objects.wgsl
//   slice/volume.wgsl|slice/surfaces.wgsl|slice/both.wgsl

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
        let pixel = floor(at.xy) + place;
        sum += with_objects(pixel, color_at(pixel));
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
