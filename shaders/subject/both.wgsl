// What a volume with meshes beside it has at a place. Each kind of subject answers this in a file of its own.
// needs: types.wgsl affine.wgsl bind/subject.wgsl subject/place.wgsl subject/mesh.wgsl

/// True if a subject of this kind has label voxels.
const HAS_LABEL_VOXELS: bool = true;

/// The labels at a point of rest space that are still to be taken.
struct Labels {
    /// That of the volume, or NO_LABEL.
    voxel: u32,
    /// The segments of meshes, a set (subject/mesh.wgsl).
    segments: vec4u,
}

/// Label of the volume's nearest voxel, and the segments of meshes that a point of rest space is inside of.
fn labels_at(rest: vec3f) -> Labels {
    var found = labels_beside(rest);
    let voxel = floor(apply_affine(subject.label_from_rest, rest) * subject.label_dims.xyz);
    if subject.has_labels != 0u && all(voxel >= vec3f(0.0)) && all(voxel < subject.label_dims.xyz) {
        found.voxel = textureLoad(labels, vec3i(voxel), 0).x;
    }
    return found;
}

/// Takes the next label, the volume's first; NO_LABEL if there is none.
fn take_label(left: ptr<function, Labels>) -> u32 {
    let label = (*left).voxel;
    (*left).voxel = NO_LABEL;
    if label != NO_LABEL {
        return label;
    }
    var segments = (*left).segments;
    let segment = take_segment(&segments);
    (*left).segments = segments;
    return select(subject.labels_before + segment, NO_LABEL, segment == NO_LABEL);
}

/// Labels besides those of the voxels: the segments of meshes.
fn labels_beside(rest: vec3f) -> Labels {
    return Labels(NO_LABEL, set_at(rest));
}
