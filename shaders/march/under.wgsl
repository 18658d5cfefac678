// The tissue of a volume under the surface that a ray has found.
// needs: types.wgsl bind/subject.wgsl subject/place.wgsl march/sample.wgsl march/segments.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

/// How far behind a surface its segment is looked for, in voxels.
const BEHIND_SURFACE: f32 = 0.75;

/// Segment (0: none) of the tissue that a surface with this normal bounds.
fn segment_behind(pos: vec3f, normal: vec3f) -> u32 {
    return segment_around(map_point(pos - normal * (BEHIND_SURFACE * subject.detail), 0xffffffffu).pos);
}

/// Segment (0: none) and value a little deeper along a ray than its surface, on which half of the voxels are air.
fn tissue_under(pos: vec3f, dir: vec3f) -> vec2f {
    var segment = 0.0;
    var value = 0.0;
    for (var k = 1; k <= 4; k++) {
        let inside = map_point(pos + dir * (f32(k) * 0.5 * subject.detail), 0xffffffffu).pos;
        segment = f32(label_here(inside));
        value = subject.value_low + subject.value_range * texel_at(texture_from_rest(inside));
        if segment > 0.0 || (k >= 2 && subject.has_labels == 0u) {
            break;
        }
    }
    return vec2f(segment, value);
}
