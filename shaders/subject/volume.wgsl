// What a subject that is a volume has at a place. Each kind of subject answers this in a file of its own.
// needs: affine.wgsl bind/subject.wgsl subject/place.wgsl

/// True if a subject of this kind has label voxels.
const HAS_LABEL_VOXELS: bool = true;

/// The labels at a point of rest space that are still to be taken: of a volume one at most.
alias Labels = u32;

/// Label at a point of rest space: that of the nearest voxel of the segmentation.
fn labels_at(rest: vec3f) -> Labels {
    let voxel = floor(apply_affine(subject.label_from_rest, rest) * subject.label_dims.xyz);
    if subject.has_labels == 0u || any(voxel < vec3f(0.0)) || any(voxel >= subject.label_dims.xyz) {
        return NO_LABEL;
    }
    return textureLoad(labels, vec3i(voxel), 0).x;
}

/// Takes the next label; NO_LABEL if there is none.
fn take_label(left: ptr<function, Labels>) -> u32 {
    let label = *left;
    *left = NO_LABEL;
    return label;
}

/// Labels besides those of the voxels; a volume alone has none.
fn labels_beside(_rest: vec3f) -> Labels {
    return NO_LABEL;
}
