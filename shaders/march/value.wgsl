// The gradient of the subject's value at a point of rest space.
// needs: types.wgsl bind/frame.wgsl bind/subject.wgsl affine.wgsl subject/place.wgsl

/// Reaches of the two central differences that a quick gradient is the mean of, voxels. One of 1 alone shows the voxels
/// as terraces.
const GRADIENT_NEAR: f32 = 1.0;
const GRADIENT_FAR: f32 = 2.2;
/// Fetches of a fine gradient: the place and the 26 around it.
const FINE_FETCHES: u32 = 27u;

/// Gradient by central differences of two reaches along the voxel axes, per unit of texture coordinates and voxel.
fn quick_difference_at(uvw: vec3f, axes: u32) -> vec3f {
    var difference = vec3f(0.0);
    for (var i = 0u; i < axes; i++) {
        let axis = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
        let near = axis * GRADIENT_NEAR / subject.dims.xyz;
        let far = axis * GRADIENT_FAR / subject.dims.xyz;
        let slope = 0.5 * (texel_at(uvw + near) - texel_at(uvw - near)) / GRADIENT_NEAR
            + 0.5 * (texel_at(uvw + far) - texel_at(uvw - far)) / GRADIENT_FAR;
        difference += axis * 0.5 * slope;
    }
    return difference;
}

/// The same by Sobel's operator in three dimensions: central differences of one voxel, weighted 1 2 1 across each of
/// the other axes. On a ball it is six times as exact (`cargo xtask evaluate`), and has less of the noise of a scan. A
/// cubic B-spline was more exact still where there is no noise, and had twice as much of it.
fn fine_difference_at(uvw: vec3f, fetches: u32) -> vec3f {
    var difference = vec3f(0.0);
    for (var i = 0u; i < fetches; i++) {
        let at = vec3f(vec3u(i % 3u, (i / 3u) % 3u, i / 9u)) - 1.0;
        let across = 2.0 - abs(at);
        let weights = vec3f(across.y * across.z, across.z * across.x, across.x * across.y) / 32.0;
        difference += at * weights * texel_at(uvw + at / subject.dims.xyz);
    }
    return difference;
}

/// Gradient of the normalised value in rest space, per voxel spacing: fine or quick. Of two loops one has no turn,
/// since some devices run both sides of a branch.
fn gradient_by(uvw: vec3f, is_fine: bool) -> vec3f {
    let quick = quick_difference_at(uvw, select(3u, 0u, is_fine));
    let fine = fine_difference_at(uvw, select(0u, FINE_FETCHES, is_fine));
    return apply_transposed(subject.texture_from_rest, (quick + fine) * subject.dims.xyz) * subject.detail;
}

/// The gradient that a picture of this kind takes for its surfaces: fine in a finished one.
fn gradient_at(uvw: vec3f) -> vec3f {
    return gradient_by(uvw, frame.is_finished != 0u);
}
