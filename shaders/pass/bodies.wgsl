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

/// What the share of hidden segments has less beside segments that are drawn by their values: half of a place is then
/// the middle of the ramp that takes off the film around bodies (`with_bodies`), and both end at the border of their
/// labels. Else the film would take the outermost part of an organ, and the whole of a vessel that is one voxel thin.
const BESIDE_VALUES: f32 = 0.3;
/// The part of a block of 5 x 5 x 5 voxels that is filled by what counts as thin: fully up to the first, not at all
/// from the second on. A vessel of two voxels fills 0.16, a sheet of one voxel 0.2, what is thick 0.4 of a block beside
/// it.
const THIN: vec2f = vec2f(0.2, 0.28);

/// Shares of one voxel: of the labels around it, weighted 1 2 1 along each axis. Its own label has HELD at least, and
/// the others have the rest of 1 in proportion.
fn share_around(middle: vec3i, last: vec3i) -> vec4f {
    var others = vec4f(0.0);
    var by_value = 0.0;
    var own_share = 0.0;
    // The least and the greatest label that is drawn by its values: hardly ever are there more.
    var ends = vec2u(255u, 0u);
    let own = textureLoad(labels, clamp(middle, vec3i(0), last), 0).x;
    for (var i = 0; i < 27; i++) {
        let offset = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let label = textureLoad(labels, clamp(middle + offset, vec3i(0), last), 0).x;
        let weight = 1.0 / f32(8u << u32(dot(abs(offset), vec3i(1))));
        own_share += select(0.0, weight, label == own);
        let other = select(weight, 0.0, label == own);
        others += share_of(label & 255u) * other;
        if is_by_value(label & 255u) {
            by_value += other;
            ends = vec2u(min(ends.x, label), max(ends.y, label));
        }
    }
    let held = max(own_share, HELD);
    let part = select(1.0, (1.0 - held) / max(1.0 - own_share, 1e-6), own_share < HELD);
    let share = share_of(own & 255u) * held + others * part;
    // Between thick tissue what is hidden keeps its share, so that a thin layer of it goes as a whole.
    var yields = 0.0;
    if is_by_value(own & 255u) {
        by_value = held + by_value * part;
        yields = 1.0;
    } else if by_value > 0.0 && share.w > 0.0 {
        by_value *= part;
        yields = thinness_of(ends, middle, last);
    }
    let less = min(yields * BESIDE_VALUES * by_value / max(1.0 - share.w, 1e-6), share.w);
    // Half as much less of w leaves the slope of a body's surface as it is (`body_gradient_at`).
    return share - vec4f(less, 0.0, 0.0, 0.5 * less);
}

/// How far one of two segments is thin around a voxel, 0 to 1.
fn thinness_of(pair: vec2u, middle: vec3i, last: vec3i) -> f32 {
    var counts = vec2f(0.0);
    for (var i = 0; i < 125; i++) {
        let offset = vec3i(i % 5, (i / 5) % 5, i / 25) - 2;
        let label = textureLoad(labels, clamp(middle + offset, vec3i(0), last), 0).x;
        counts += select(vec2f(0.0), vec2f(1.0), vec2u(label) == pair);
    }
    return 1.0 - smoothstep(THIN.x, THIN.y, min(counts.x, counts.y) / 125.0);
}

/// True for a segment that is drawn by its values.
fn is_by_value(label: u32) -> bool {
    return label != 0u && body_looks.items[label].a < 0.0;
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
