// Which voxels belong to a set of kept tissue, and where samples of distances lie among them.
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/distance_job.wgsl
//   subject/volume.wgsl|subject/surfaces.wgsl|subject/both.wgsl

/// The label voxel in which a fine voxel lies.
fn label_voxel_of(voxel: vec3i) -> vec3i {
    return vec3i(floor(apply_affine(job.label_from_voxel, vec3f(voxel)) + 0.5));
}

/// Label of a fine voxel.
fn label_of(voxel: vec3i) -> u32 {
    let at = label_voxel_of(voxel);
    let is_inside = all(at >= vec3i(0)) && all(at < vec3i(textureDimensions(labels)));
    return select(0u, textureLoad(labels, clamp(at, vec3i(0), vec3i(textureDimensions(labels)) - 1), 0).x, is_inside);
}

fn coarse_index(at: vec3u) -> u32 {
    return at.x + job.coarse.x * (at.y + job.coarse.y * at.z);
}

/// The samples of a line along one axis: index of the first, from one to the next, and how many.
struct SampleLine {
    first: u32,
    stride: u32,
    count: u32,
}

/// The line along `job.axis` at a place across it; beyond the samples it has none.
fn line_at(across: vec2u) -> SampleLine {
    let axis = job.axis;
    let size = job.coarse.xyz;
    let sides = select(select(size.xy, size.xz, axis == 1u), size.yz, axis == 0u);
    if any(across >= sides) {
        return SampleLine(0u, 0u, 0u);
    }
    let x_or_y = select(vec3u(across.x, 0u, across.y), vec3u(0u, across), axis == 0u);
    let start = select(x_or_y, vec3u(across, 0u), axis == 2u);
    let stride = select(select(size.x * size.y, size.x, axis == 1u), 1u, axis == 0u);
    return SampleLine(coarse_index(start), stride, size[axis]);
}

/// True if a label belongs to the set that is worked on.
fn is_in_channel(label: u32) -> bool {
    let word = job.label_sets[label >> 5u][(label >> 3u) & 3u];
    return ((word >> (4u * (label & 7u))) & (1u << job.channel)) != 0u;
}

/// The label by which a fine voxel belongs to the set that is worked on; NO_LABEL where it does not.
fn member_label(voxel: vec3i) -> u32 {
    let own = label_of(voxel);
    if is_in_channel(own) {
        return own;
    }
    return member_beside(voxel);
}

/// The label of a mesh by which a fine voxel belongs to that set.
fn member_beside(voxel: vec3i) -> u32 {
    var left = labels_beside(apply_affine(job.rest_from_voxel, vec3f(voxel)));
    loop {
        let label = take_label(&left);
        if label == NO_LABEL || is_in_channel(label) {
            return label;
        }
    }
    return NO_LABEL;
}

/// The fine voxel in which a sample lies.
fn voxel_of(sample: vec3u) -> vec3i {
    return vec3i(min(vec3u((vec3f(sample) + 0.5) * job.ratio.xyz), job.fine.xyz - 1u));
}

/// True if the voxels on the straight way from one to another belong to the set by this label; the first is not asked.
fn is_joined(start: vec3i, end: vec3i, label: u32) -> bool {
    let way = end - start;
    let steps = max(abs(way.x), max(abs(way.y), abs(way.z)));
    var joined = true;
    for (var i = 1; i <= steps && joined; i++) {
        let at = start + vec3i(floor(vec3f(way) * f32(i) / f32(steps) + 0.5));
        joined = member_label(at) == label;
    }
    return joined;
}
