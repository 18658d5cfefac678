// The gradient of the subject's value at a point of rest space.
// needs: types.wgsl bind/subject.wgsl affine.wgsl subject/place.wgsl

/// Reaches of the two central differences that a gradient is the mean of, voxels. One of 1 alone shows the voxels as
/// terraces.
const GRADIENT_NEAR: f32 = 1.0;
const GRADIENT_FAR: f32 = 2.2;

/// Gradient of the normalised value in rest space, per voxel spacing: central differences of two reaches along the
/// voxel axes.
fn gradient_at(uvw: vec3f) -> vec3f {
    var difference = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let axis = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
        let near = axis * GRADIENT_NEAR / subject.dims.xyz;
        let far = axis * GRADIENT_FAR / subject.dims.xyz;
        let slope = 0.5 * (texel_at(uvw + near) - texel_at(uvw - near)) / GRADIENT_NEAR
            + 0.5 * (texel_at(uvw + far) - texel_at(uvw - far)) / GRADIENT_FAR;
        difference += axis * 0.5 * slope;
    }
    difference *= subject.dims.xyz;
    return apply_transposed(subject.texture_from_rest, difference) * subject.detail;
}
