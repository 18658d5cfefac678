// Bodies: segments that are drawn by their share of each place (pass/bodies.wgsl) instead of by the values.
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/bodies.wgsl march/opacity.wgsl

/// Reaches of the central differences that the normal of a body is the mean of, voxels. Labels are yes or no, so they
/// are wider than the scan's; a layer thinner than the far one loses some of its relief.
const BODY_NEAR: f32 = 1.3;
const BODY_FAR: f32 = 3.4;

/// Shares of bodies at a point of rest space (see `body_shares`).
fn body_at(pos: vec3f) -> vec4f {
    let uvw = apply_affine(subject.label_from_rest, pos);
    let is_inside = all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
    return select(vec4f(0.0), textureSampleLevel(body_shares, linear_sampler, uvw, 0.0), is_inside);
}

/// Opacity of 0.01 units where bodies take the place of what the values say. The voxels around a body that the body
/// fills less than half of belong to no segment and would stay as a film of its values around it: they go too.
fn with_bodies(opacity: f32, shares: vec4f) -> f32 {
    let clear = max(shares.x - shares.z, 0.0);
    let seen = clamp((shares.y - shares.z) / max(clear, 1e-3), 0.0, 1.0);
    let through = 1.0 - pow(1.0 - seen, OPACITY_LENGTH / BODY_LAYER);
    let own = mix(through, 1.0, smoothstep(0.35, 0.65, shares.z / max(shares.x, 1e-3)));
    let film = smoothstep(0.05, 0.35, shares.x);
    return mix(opacity * (1.0 - film), own, smoothstep(0.25, 0.55, shares.x));
}

/// Direction from outside bodies to their inside in rest space, about 1 per voxel at their surface, 0 elsewhere; out of
/// hidden bodies.
fn body_gradient_at(pos: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < 3u; i++) {
        let axis = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(i));
        // Two distances: the near one for thin bodies, the far one against the stairs of labels.
        let near = axis * BODY_NEAR * subject.detail;
        let far = axis * BODY_FAR * subject.detail;
        let slope = 0.3 * (body_at(pos + near) - body_at(pos - near)) + 0.7 * (body_at(pos + far) - body_at(pos - far));
        sum += axis * dot(slope, vec4f(1.0, 0.0, 1.0, -2.0));
    }
    return sum * 0.5;
}

/// Part of the tissue seen at a place that belongs to bodies, 0 to 1.
fn body_weight(shares: vec4f) -> f32 {
    return smoothstep(0.1, 0.35, shares.x - shares.w);
}
