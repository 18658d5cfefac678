// Segments around a point of rest space: their colours, blended over 27 voxels of the segmentation.
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/bodies.wgsl

/// The 27 label voxels around a point.
struct Around {
    /// Index of the label voxel nearest to the point, the middle of the 27.
    middle: vec3i,
    /// Columns: weights per axis of the voxel before the middle one, of the middle one, of the one after it.
    weights: mat3x3f,
}

fn around_at(pos: vec3f) -> Around {
    let uvw = apply_affine(subject.label_from_rest, pos);
    // Quadratic B-spline: borders between segments come out smooth, where eight voxels would leave stairs.
    let at = uvw * subject.label_dims.xyz - 0.5;
    let middle = floor(at + 0.5);
    let part = at - middle;
    let weights = mat3x3f(
        0.5 * (0.5 - part) * (0.5 - part),
        0.75 - part * part,
        0.5 * (0.5 + part) * (0.5 + part),
    );
    return Around(vec3i(middle), weights);
}

/// Label of voxel i of the 27.
fn label_around(around: Around, i: i32) -> u32 {
    let last = vec3i(subject.label_dims.xyz) - 1;
    let voxel = clamp(around.middle + vec3i(i % 3, (i / 3) % 3, i / 9) - 1, vec3i(0), last);
    return textureLoad(labels, voxel, 0).x;
}

/// Weight of voxel i of the 27; all weights add up to 1.
fn weight_around(around: Around, i: i32) -> f32 {
    return around.weights[i % 3].x * around.weights[(i / 3) % 3].y * around.weights[i / 9].z;
}

/// Label of the segment that most of what is around a point belongs to; 0 where none is. Its borders are smooth, where
/// those of the nearest voxel are stairs. By the majority vote of Boyer and Moore (1991), with weights: voxels of no
/// segment do not vote, since half of the voxels around a surface are air.
fn segment_around(pos: vec3f) -> u32 {
    let around = around_at(pos);
    var leader = 0u;
    var lead = 0.0;
    for (var i = 0; i < 27; i++) {
        let label = label_around(around, i);
        let weight = select(weight_around(around, i), 0.0, label == 0u || subject.has_labels == 0u);
        let is_ours = label == leader;
        let is_new = !is_ours && weight > lead;
        lead = select(abs(lead - weight), lead + weight, is_ours);
        leader = select(leader, label, is_new);
    }
    return leader;
}

/// Linear RGB of the visible bodies around a point, premultiplied by how much of it is theirs (alpha).
fn body_color_at(pos: vec3f) -> vec4f {
    let around = around_at(pos);
    var sum = vec4f(0.0);
    for (var i = 0; i < 27; i++) {
        let item = bodies.items[label_around(around, i) & 255u];
        sum += select(vec4f(0.0), vec4f(item.rgb, 1.0) * weight_around(around, i), item.a >= BODY_HIDDEN);
    }
    return sum;
}
