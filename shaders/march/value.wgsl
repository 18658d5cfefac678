// The gradient of the subject's value at a point of rest space.
// needs: types.wgsl bind/frame.wgsl bind/subject.wgsl affine.wgsl subject/place.wgsl

/// Reaches of the two central differences that a quick gradient is the mean of, voxels. One of 1 alone shows the voxels
/// as terraces.
const GRADIENT_NEAR: f32 = 1.0;
const GRADIENT_FAR: f32 = 2.2;
/// Fetches of a fine gradient: for each axis the eight of a cubic B-spline.
const FINE_FETCHES: u32 = 24u;

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

/// The same of the uniform cubic B-spline whose coefficients are the voxels: smooth, and flat where the voxels of an
/// even slope change from layer to layer. Two neighbouring weights are one fetch between their voxels (Sigg and
/// Hadwiger, "Fast third-order texture filtering", GPU Gems 2, 2005).
fn fine_difference_at(uvw: vec3f, fetches: u32) -> vec3f {
    let place = uvw * subject.dims.xyz - 0.5;
    let voxel = floor(place);
    let f = place - voxel;
    let r = 1.0 - f;
    // The weights of the spline for the four voxels of an axis are w0 to w3; those of its slope are s0 to s3.
    let w0 = r * r * r / 6.0;
    let w1 = (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
    let w3 = f * f * f / 6.0;
    let low_weight = w0 + w1;
    let high_weight = 1.0 - low_weight;
    let low = (voxel - 0.5 + w1 / low_weight) / subject.dims.xyz;
    let high = (voxel + 1.5 + w3 / high_weight) / subject.dims.xyz;
    // s0 + s1, which is -(s2 + s3) and never above -1/2.
    let slope = f * f - f - 0.5;
    let low_slope = (voxel - 0.5 + (1.5 * f * f - 2.0 * f) / slope) / subject.dims.xyz;
    let high_slope = (voxel + 1.5 - 0.5 * f * f / slope) / subject.dims.xyz;
    var difference = vec3f(0.0);
    for (var i = 0u; i < fetches; i++) {
        let is_along = vec3u(i >> 3u) == vec3u(0u, 1u, 2u);
        let is_high = (vec3u(i, i >> 1u, i >> 2u) & vec3u(1u)) == vec3u(1u);
        let weight = select(select(low_weight, high_weight, is_high), select(slope, -slope, is_high), is_along);
        let at = select(select(low, high, is_high), select(low_slope, high_slope, is_high), is_along);
        difference += select(vec3f(0.0), vec3f(weight.x * weight.y * weight.z * texel_at(at)), is_along);
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
