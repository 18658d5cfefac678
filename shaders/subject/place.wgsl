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

/// Normalised value, 0 to 1, at a point of the subject's texture space; of meshes alone the depth under the surface.
fn texel_at(uvw: vec3f) -> f32 {
    return textureSampleLevel(volume, linear_sampler, uvw, 0.0).x;
}

/// Stands for no label.
const NO_LABEL: u32 = 0xffffffffu;
