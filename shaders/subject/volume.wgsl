// What a subject that is a volume has at a place. Each kind of subject answers this in a file of its own.
// needs: affine.wgsl bind/subject.wgsl

/// Normalised value, 0 to 1, at a point of the subject's texture space (subject/place.wgsl).
fn texel_at(uvw: vec3f) -> f32 {
    return textureSampleLevel(volume, linear_sampler, uvw, 0.0).x;
}

/// Stands for the label of a place outside the segmentation.
const NO_LABEL: u32 = 0xffffffffu;

/// Label at a point of rest space: that of the nearest voxel of the segmentation.
fn label_at(rest: vec3f) -> u32 {
    let voxel = floor(apply_affine(subject.label_from_rest, rest) * subject.label_dims.xyz);
    if any(voxel < vec3f(0.0)) || any(voxel >= subject.label_dims.xyz) {
        return NO_LABEL;
    }
    return textureLoad(labels, vec3i(voxel), 0).x;
}
