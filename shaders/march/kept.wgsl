// Kept tissue: whether a point of rest space lies in kept tissue, and how far from it.
// Differs from the source (Correa, section 5.4): membership is read from the nearest label voxel and not interpolated,
// so that a boundary lies where the labels have it; only normals use a smoothed mask.
// needs: types.wgsl affine.wgsl bind/subject.wgsl subject/place.wgsl bind/kept.wgsl displace/frame.wgsl
//   subject/volume.wgsl|subject/surfaces.wgsl|subject/both.wgsl

/// How a document keeps tissue. 0: it keeps none. 1: the list is one group. 2: the first templates of the list keep the
/// same set or depth, the others keep nothing. 3: any other case. 4: the list is one group that gives way to tissue,
/// and none is kept. A pipeline constant.
override align_mode: u32 = 3u;

/// By what tissue is kept. Bit 0: by its segment; bit 1: by its depth under the outer surface; bit 2: some segments
/// by their connected parts. A pipeline constant, so that a picture reads only the textures that it needs.
override kept_by: u32 = 7u;

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

/// True if a rest point lies in one of the sets in `keeps` (a bit for each, and KEEPS_DEEP), by the nearest label
/// voxel. `depth`: depth under the outer surface from where on KEEPS_DEEP holds, subject units. Points outside the scan
/// are not deep.
fn is_kept(rest: vec3f, keeps: u32, depth: f32) -> bool {
    if (kept_by & 2u) != 0u {
        if (keeps & KEEPS_DEEP) != 0u && depth_at(rest) >= depth {
            return is_in_subject(texture_from_rest(rest));
        }
    }
    if (kept_by & 1u) == 0u {
        return false;
    }
    if (keeps & 15u) == 0u {
        return false;
    }
    var left = labels_at(rest);
    loop {
        let label = take_label(&left);
        if label == NO_LABEL {
            break;
        }
        let word = kept.label_sets[label >> 5u][(label >> 3u) & 3u];
        let found = (word >> (4u * (label & 7u))) & keeps & 15u;
        if found != 0u && is_in_parts(rest, found) {
            return true;
        }
    }
    return false;
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
