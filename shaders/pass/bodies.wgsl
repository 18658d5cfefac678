// How much of each place belongs to segments that are drawn as bodies of their own, from the labels: done when the look
// of segments changes, so that a sample of the picture costs one texture read more and borders come out smooth.
// needs: types.wgsl bind/subject.wgsl

/// How each segment is drawn.
@group(3) @binding(0) var<uniform> body_looks: Bodies;
/// Shares of segments drawn as bodies, 0 to 1, in the layout that `body_shares` is read in.
@group(3) @binding(1) var shares_out: texture_storage_3d<rgba8unorm, write>;

/// One voxel: the labels around it, weighted 1 2 1 along each axis.
@compute @workgroup_size(4, 4, 4)
fn share_bodies(@builtin(global_invocation_id) at: vec3u) {
    let size = textureDimensions(shares_out);
    if any(at >= size) {
        return;
    }
    // The shares may be coarser than the labels; both span the same box.
    let dims = vec3f(subject.label_dims.xyz);
    let middle = vec3i(floor((vec3f(at) + 0.5) / vec3f(size) * dims));
    let last = vec3i(dims) - 1;
    var sum = vec4f(0.0);
    for (var i = 0; i < 27; i++) {
        let offset = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let label = textureLoad(labels, clamp(middle + offset, vec3i(0), last), 0).x;
        let opacity = body_looks.items[label & 255u].a;
        let weight = 1.0 / f32(8u << u32(dot(abs(offset), vec3i(1))));
        let share = vec4f(
            1.0,
            opacity,
            select(0.0, 1.0, opacity >= BODY_SOLID),
            select(0.0, 1.0, opacity < BODY_HIDDEN),
        );
        sum += select(vec4f(0.0), share * weight, opacity >= 0.0);
    }
    textureStore(shares_out, at, sum);
}
