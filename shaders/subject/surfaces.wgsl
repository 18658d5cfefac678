// What a subject of meshes alone has at a place. Each kind of subject answers this in a file of its own.
// needs: subject/place.wgsl subject/mesh.wgsl

/// True if a subject of this kind has label voxels.
const HAS_LABEL_VOXELS: bool = false;

/// The segments at a point of rest space that are still to be taken: a set, see subject/mesh.wgsl.
alias Labels = vec4u;

/// The segments that a point of rest space is inside of.
fn labels_at(rest: vec3f) -> Labels {
    return set_at(rest);
}

/// Takes the first segment of a set, from 1; NO_LABEL if the set is empty.
fn take_label(left: ptr<function, Labels>) -> u32 {
    return take_segment(left);
}

/// Labels besides those of the voxels; the voxels of meshes alone have them all.
fn labels_beside(_rest: vec3f) -> Labels {
    return vec4u(0u);
}
