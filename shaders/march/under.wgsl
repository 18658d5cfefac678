// The tissue of a volume under the surface that a ray has found.
// needs: types.wgsl bind/subject.wgsl subject/place.wgsl march/sample.wgsl
//   march/plain.wgsl|march/align.wgsl|march/baked.wgsl

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
