// How much of each place belongs to segments that are drawn as bodies of their own, from the labels: done when the look
// of segments changes, so that a sample of the picture costs one texture read more and borders come out smooth.
// needs: types.wgsl bind/subject.wgsl

/// How each segment is drawn.
@group(3) @binding(0) var<uniform> body_looks: Bodies;
/// Shares of segments drawn as bodies, 0 to 1, in the layout that `body_shares` is read in.
@group(3) @binding(1) var shares_out: texture_storage_3d<rgba8unorm, write>;

/// Bricks to write. x: 10 bits each of its place along the axes; y: the label that all its voxels and those around it
/// have, or else BODY_MIXED or BODY_NOTHING.
@group(3) @binding(2) var<storage, read> bricks: array<vec2u>;

/// A part of a brick: 2 x 2 x 2 voxels.
@compute @workgroup_size(4, 4, 4)
fn share_bodies(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) part: vec3u) {
    let number = group.x + BODY_ROW * group.y;
    if number >= arrayLength(&bricks) {
        return;
    }
    let brick = bricks[number];
    let first = BODY_BRICK * vec3u(brick.x & 1023u, (brick.x >> 10u) & 1023u, brick.x >> 20u) + 2u * part;
    let size = textureDimensions(shares_out);
    // The shares may be coarser than the labels; both span the same box.
    let dims = vec3f(subject.label_dims.xyz);
    for (var i = 0u; i < 8u; i++) {
        let at = first + vec3u(i & 1u, (i >> 1u) & 1u, i >> 2u);
        if any(at >= size) {
            continue;
        }
        var share = vec4f(0.0);
        if brick.y == BODY_MIXED {
            share = share_around(vec3i(floor((vec3f(at) + 0.5) / vec3f(size) * dims)), vec3i(dims) - 1);
        } else if brick.y < BODY_MIXED {
            share = share_of(brick.y);
        }
        textureStore(shares_out, at, share);
    }
}

/// The least share of a voxel's own label, as in pass/shares.wgsl: what is one voxel thin is not lost.
const HELD: f32 = 0.65;

/// Shares of one voxel: of the labels around it, weighted 1 2 1 along each axis. Its own label has HELD at least, and
/// the others have the rest of 1 in proportion.
fn share_around(middle: vec3i, last: vec3i) -> vec4f {
    var others = vec4f(0.0);
    var own_share = 0.0;
    let own = textureLoad(labels, clamp(middle, vec3i(0), last), 0).x;
    for (var i = 0; i < 27; i++) {
        let offset = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let label = textureLoad(labels, clamp(middle + offset, vec3i(0), last), 0).x;
        let weight = 1.0 / f32(8u << u32(dot(abs(offset), vec3i(1))));
        own_share += select(0.0, weight, label == own);
        others += share_of(label & 255u) * select(weight, 0.0, label == own);
    }
    let held = max(own_share, HELD);
    let part = select(1.0, (1.0 - held) / max(1.0 - own_share, 1e-6), own_share < HELD);
    return share_of(own & 255u) * held + others * part;
}

/// Shares of a place that is all of one label.
fn share_of(label: u32) -> vec4f {
    let opacity = body_looks.items[label].a;
    let share = vec4f(
        1.0,
        opacity,
        select(0.0, 1.0, opacity >= BODY_SOLID),
        select(0.0, 1.0, opacity < BODY_HIDDEN),
    );
    return select(vec4f(0.0), share, opacity >= 0.0);
}
