// What a subject that is a volume has at a place. Each kind of subject answers this in a file of its own.
// needs: bind/subject.wgsl

/// Normalised value, 0 to 1, at a point of the subject's texture space (subject/place.wgsl).
fn texel_at(uvw: vec3f) -> f32 {
    return textureSampleLevel(volume, linear_sampler, uvw, 0.0).x;
}
