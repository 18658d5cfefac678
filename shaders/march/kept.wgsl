// Kept tissue: whether a point of rest space lies in kept tissue, and how far from it.
//
// A set ends where its share is one half. The share of each label voxel comes from the 27 voxels around
// (pass/shares.wgsl), with that of its own label 0.65 at least, and is linear between voxels. So the surface is smooth,
// lies within half a voxel of the border of the labels, and has the middle of each voxel on the side of its label.
//
// Differs from the source (Correa, section 5.4): there the mask is smoothed without such a hold, and thin tissue is
// lost. Segments that move as a whole are held by the nearest label voxel (`is_labelled`): their map has no step there.
// needs: types.wgsl affine.wgsl bind/subject.wgsl subject/place.wgsl bind/kept.wgsl displace/frame.wgsl
//   subject/label.wgsl subject/volume.wgsl|subject/surfaces.wgsl|subject/both.wgsl

/// How a document keeps tissue. 0: it keeps none. 1: the list is one group. 2: the first templates of the list keep the
/// same set or depth, the others keep nothing. 3: any other case. 4: the list is one group that gives way to tissue,
/// and none is kept. A pipeline constant.
override align_mode: u32 = 3u;

/// By what tissue is kept. Bit 0: by its segment; bit 1: by its depth under the outer surface; bit 2: some segments
/// by their connected parts; bit 3: segments end at the smooth surface of their shares. A pipeline constant, so that a
/// picture reads only the textures that it needs.
override kept_by: u32 = 15u;

/// Texture coordinates of a rest point in this slab of the texture of distances.
fn distance_uvw(rest: vec3f, slab: u32) -> vec3f {
    let uvw = apply_affine(kept.distance_from_rest, rest);
    let edge = 0.5 / kept.distance_dims.z;
    let z = clamp(uvw.z, edge, 1.0 - edge);
    return vec3f(uvw.xy, (z + f32(slab)) / f32(max(kept.slab_count, 1u)));
}

/// Depth of a rest point under the outer surface, subject units.
fn depth_at(rest: vec3f) -> f32 {
    return textureSampleLevel(distances, linear_sampler, distance_uvw(rest, kept.depth_slab), 0.0).x;
}

/// True if a rest point that has a label of these sets lies in one of them: of connected parts, in the nearest.
fn is_in_parts(rest: vec3f, sets: u32) -> bool {
    if (kept_by & 4u) == 0u {
        return true;
    }
    let d = textureSampleLevel(distances, linear_sampler, distance_uvw(rest, kept.exact_slab), 0.0);
    var is_in = false;
    for (var channel = 0u; channel < 4u; channel++) {
        let parts = vec4u((kept.parts >> (4u * channel)) & 15u);
        let each = select(vec4f(NO_END), d, (parts & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u));
        let least = min(min(each.x, each.y), min(each.z, each.w));
        is_in = is_in || ((sets & (1u << channel)) != 0u && d[channel] <= least);
    }
    return is_in;
}

/// Sets of a label, a bit for each.
fn sets_of_label(label: u32) -> u32 {
    let word = kept.label_sets[label >> 5u][(label >> 3u) & 3u];
    return (word >> (4u * (label & 7u))) & 15u;
}

/// True if one of these labels belongs to the sets.
fn is_any_in(given: Labels, rest: vec3f, sets: u32) -> bool {
    var left = given;
    loop {
        let label = take_label(&left);
        if label == NO_LABEL {
            break;
        }
        let found = sets_of_label(label) & sets;
        if found != 0u && is_in_parts(rest, found) {
            return true;
        }
    }
    return false;
}

/// True if a rest point lies in one of these sets by the nearest label voxel: what segments that move as a whole hold.
fn is_labelled(rest: vec3f, sets: u32) -> bool {
    return (kept_by & 1u) != 0u && sets != 0u && is_any_in(labels_at(rest), rest, sets);
}

/// Share of each set at a rest point, 0 to 1; linear between the middles of label voxels, 0 outside of them.
fn shares_at(rest: vec3f) -> vec4f {
    let uvw = apply_affine(subject.label_from_rest, rest);
    let is_inside = all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
    return select(vec4f(0.0), textureSampleLevel(kept_shares, linear_sampler, uvw, 0.0), is_inside);
}

/// True if a rest point lies within the smooth surface about what the sets have together.
fn is_within(rest: vec3f, sets: u32) -> bool {
    let held = (vec4u(sets) & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u);
    let each = select(vec4f(0.0), shares_at(rest), held);
    let largest = max(max(each.x, each.y), max(each.z, each.w));
    return select(largest, dot(each, vec4f(1.0)), kept.shares_add != 0u) >= 0.5;
}

/// True if a rest point lies in one of the sets in `keeps` (a bit for each, and KEEPS_DEEP), which end at their smooth
/// surface. `depth`: depth under the outer surface from where on KEEPS_DEEP holds, subject units. Points outside the
/// scan are not deep.
fn is_kept(rest: vec3f, keeps: u32, depth: f32) -> bool {
    if (kept_by & 2u) != 0u {
        if (keeps & KEEPS_DEEP) != 0u && depth_at(rest) >= depth {
            return is_in_subject(texture_from_rest(rest));
        }
    }
    if (kept_by & 1u) == 0u {
        return false;
    }
    let sets = keeps & 15u;
    if sets == 0u {
        return false;
    }
    if HAS_LABEL_VOXELS && (kept_by & 8u) != 0u {
        return is_within(rest, sets) || is_any_in(labels_beside(rest), rest, sets);
    }
    return is_any_in(labels_at(rest), rest, sets);
}

/// Distance of a rest point to the nearest of the sets in `keeps`, subject units: above 0 outside, below 0 inside. For
/// KEEPS_DEEP: how much deeper the point would have to lie to reach `depth`. The distances of `slab` 0 are smoothed.
fn distance_to_kept(rest: vec3f, keeps: u32, depth: f32, slab: u32) -> f32 {
    var least = NO_END;
    if (kept_by & 2u) != 0u {
        if (keeps & KEEPS_DEEP) != 0u {
            least = depth - depth_at(rest);
        }
    }
    if (kept_by & 1u) != 0u {
        if (keeps & 15u) != 0u {
            let d = textureSampleLevel(distances, linear_sampler, distance_uvw(rest, slab), 0.0);
            let held = (vec4u(keeps) & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u);
            let each = select(vec4f(NO_END), d, held);
            least = min(least, min(min(each.x, each.y), min(each.z, each.w)));
        }
    }
    return least;
}

/// The side of the surfaces of kept tissue that a rest point lies on: the sets with such surfaces that hold it.
fn side_at(rest: vec3f) -> u32 {
    if (kept_by & 8u) == 0u {
        return 0u;
    }
    let bits = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), shares_at(rest) >= vec4f(0.5));
    return (bits.x | bits.y | bits.z | bits.w) & kept.shared_sets;
}

/// True if a segment lies on a side.
fn is_on_side(label: u32, side: u32) -> bool {
    return (kept_by & 8u) == 0u || (sets_of_label(label) & kept.shared_sets) == side;
}

/// Label of a point of rest space: that of the nearest voxel if this lies on the point's side of the surfaces of kept
/// tissue, else the one on this side that has most weight among the eight voxels around.
fn label_here(rest: vec3f) -> u32 {
    let nearest = nearest_label(rest);
    let side = side_at(rest);
    if is_on_side(nearest, side) {
        return nearest;
    }
    let last = vec3i(subject.label_dims.xyz) - 1;
    let at = apply_affine(subject.label_from_rest, rest) * subject.label_dims.xyz - 0.5;
    let part = fract(at);
    var labels_around: array<u32, 8>;
    var weights: array<f32, 8>;
    for (var i = 0; i < 8; i++) {
        let step = vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
        let label = textureLoad(labels, clamp(vec3i(floor(at)) + step, vec3i(0), last), 0).x;
        let along = select(1.0 - part, part, step == vec3i(1));
        labels_around[i] = label;
        weights[i] = select(0.0, along.x * along.y * along.z, is_on_side(label, side));
    }
    var best = nearest;
    var most = 0.0;
    for (var i = 0; i < 8; i++) {
        var weight = 0.0;
        for (var k = 0; k < 8; k++) {
            weight += select(0.0, weights[k], labels_around[k] == labels_around[i]);
        }
        let is_first = weight == most && labels_around[i] < best;
        if weights[i] > 0.0 && (weight > most || is_first) {
            best = labels_around[i];
            most = weight;
        }
    }
    return best;
}
