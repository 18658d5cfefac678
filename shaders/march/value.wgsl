// The gradient of the subject's value at a point of rest space.
// needs: types.wgsl bind/subject.wgsl affine.wgsl subject/place.wgsl

/// Reaches of the two central differences that a quick gradient is the mean of, voxels. One of 1 alone shows the voxels
/// as terraces.
const GRADIENT_NEAR: f32 = 1.0;
const GRADIENT_FAR: f32 = 2.2;

/// Gradient of the normalised value in rest space, per voxel spacing, for taps around a surface: by central differences
/// of two reaches along the voxel axes.
fn quick_gradient_at(uvw: vec3f) -> vec3f {
    var difference = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let axis = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
        let near = axis * GRADIENT_NEAR / subject.dims.xyz;
        let far = axis * GRADIENT_FAR / subject.dims.xyz;
        let slope = 0.5 * (texel_at(uvw + near) - texel_at(uvw - near)) / GRADIENT_NEAR
            + 0.5 * (texel_at(uvw + far) - texel_at(uvw - far)) / GRADIENT_FAR;
        difference += axis * 0.5 * slope;
    }
    return apply_transposed(subject.texture_from_rest, difference * subject.dims.xyz) * subject.detail;
}

/// Gradient of the normalised value in rest space, per voxel spacing, for surfaces: by Sobel's operator in three
/// dimensions, which is central differences of one voxel, weighted 1 2 1 across each of the other axes. On a ball it is
/// six times as exact as the quick gradient (`cargo xtask evaluate`), and has less of the noise of a scan. A cubic
/// B-spline was more exact still where there is no noise, and had twice as much of it. Quick pictures take it too: with
/// a noisier gradient those of a noisy scan are darker by several levels, and finished tiles would stand out.
fn gradient_at(uvw: vec3f) -> vec3f {
    var difference = vec3f(0.0);
    for (var i = 0u; i < 27u; i++) {
        let at = vec3f(vec3u(i % 3u, (i / 3u) % 3u, i / 9u)) - 1.0;
        let across = 2.0 - abs(at);
        let weights = vec3f(across.y * across.z, across.z * across.x, across.x * across.y) / 32.0;
        difference += at * weights * texel_at(uvw + at / subject.dims.xyz);
    }
    return apply_transposed(subject.texture_from_rest, difference * subject.dims.xyz) * subject.detail;
}
