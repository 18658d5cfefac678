// Where a point of rest space lies in the subject, whatever its kind.
// needs: types.wgsl affine.wgsl bind/subject.wgsl

/// The subject's texture space, from 0 to `subject.texture_end`, from a point of rest space.
fn texture_from_rest(pos: vec3f) -> vec3f {
    return apply_affine(subject.texture_from_rest, pos);
}

/// True inside the subject's box.
fn is_in_subject(uvw: vec3f) -> bool {
    return all(uvw >= vec3f(0.0)) && all(uvw <= subject.texture_end.xyz);
}
