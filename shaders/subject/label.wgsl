// The label of a volume at a place.
// needs: types.wgsl affine.wgsl bind/subject.wgsl

/// Label of the label voxel nearest to a point of rest space; 0 where there is none.
fn nearest_label(rest: vec3f) -> u32 {
    let voxel = floor(apply_affine(subject.label_from_rest, rest) * subject.label_dims.xyz);
    let has_label = subject.has_labels != 0u && all(voxel >= vec3f(0.0)) && all(voxel < subject.label_dims.xyz);
    let last = vec3i(subject.label_dims.xyz) - 1;
    let label = textureLoad(labels, clamp(vec3i(voxel), vec3i(0), last), 0).x;
    return select(0u, label, has_label);
}
