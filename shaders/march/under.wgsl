// The tissue of a volume under the surface that a ray has found.
// needs: types.wgsl affine.wgsl bind/subject.wgsl subject/place.wgsl march/sample.wgsl

/// Segment (0: none) and value a little deeper along a ray than its surface, on which half of the voxels are air.
fn tissue_under(pos: vec3f, dir: vec3f) -> vec2f {
    var segment = 0.0;
    var value = 0.0;
    for (var k = 1; k <= 4; k++) {
        let inside = map_point(pos + dir * (f32(k) * 0.5 * subject.detail), 0xffffffffu).pos;
        let uvw = apply_affine(subject.label_from_rest, inside);
        let voxel = clamp(vec3i(floor(uvw * subject.label_dims.xyz)), vec3i(0), vec3i(subject.label_dims.xyz) - 1);
        segment = f32(textureLoad(labels, voxel, 0).x);
        value = subject.value_low + subject.value_range * texel_at(texture_from_rest(inside));
        if segment > 0.0 || (k >= 2 && subject.has_labels == 0u) {
            break;
        }
    }
    return vec2f(segment, value);
}
