// The surfaces of kept tissue, from which the material next to them takes its normal (Correa, section 5.4.3).
// needs: types.wgsl bind/subject.wgsl bind/templates.wgsl bind/kept.wgsl march/kept.wgsl march/interface.wgsl

/// The nearest of the surfaces between kept tissue and the material that moved along `path`, seen from either side
/// (equations 5.13 and 5.14: the weight falls from 1 at the surface to 0 at the distance of the align's thickness, and
/// the gradient is reversed on one of the sides). `rest`: the point, rest space. `jacobian` takes a step in subject
/// space to one in rest space.
fn kept_surface(rest: vec3f, path: u32, jacobian: mat3x3f, to_eye: vec3f) -> KeptSurface {
    if align_mode == 4u {
        return KeptSurface(to_eye, 0.0, vec3f(0.0));
    }
    var weight = 0.0;
    var keeps = 0u;
    var depth = 0.0;
    var is_kept_side = false;
    // A voxel either way is the same surface: shares and distances are smoothed each in a way of its own.
    let slack = kept.spacing;
    let count = select(min(templates.count, 32u), 1u, align_mode == 1u);
    for (var i = 0u; i < count; i++) {
        let item = kept.items[i];
        // A displacement that gives way to tissue moves what lies beside it with it: there is no surface between them.
        if item.aligned == 0u {
            continue;
        }
        let group = select(1u << i, 0xffffffffu, align_mode == 1u);
        let away = distance_to_kept(rest, item.aligned, item.depth, 0u);
        let has_moved = (path & group) != 0u;
        let is_on_side = select(away <= slack, away >= -slack, has_moved);
        // So near it is the surface itself.
        let near = 1.0 - max(abs(away) - slack, 0.0) / max(item.blend, slack);
        if is_on_side && near > weight {
            weight = near;
            keeps = item.aligned;
            depth = item.depth;
            is_kept_side = !has_moved;
        }
    }
    // The depth has the stairs of voxels still in it, the sets are smooth.
    let reach = slack * select(1.0, 2.0, (keeps & KEEPS_DEEP) != 0u);
    var gradient = vec3f(0.0);
    for (var axis = 0u; axis < select(0u, 3u, weight > 0.0); axis++) {
        let along = select(vec3f(0.0), vec3f(reach), vec3u(0u, 1u, 2u) == vec3u(axis));
        let change = distance_to_kept(rest + along, keeps, depth, 0u) - distance_to_kept(rest - along, keeps, depth, 0u);
        gradient += along * change;
    }
    // Away from what is kept, out of the kept side and into the other: turned to point out of this one.
    let outwards = gradient / max(length(gradient), 1e-9) * select(-1.0, 1.0, is_kept_side);
    let normal = normalize(outwards * jacobian + to_eye * 1e-5);
    // A surface that faces away is not the face that is seen.
    let seen = weight * smoothstep(-0.02, 0.15, dot(normal, to_eye));
    return KeptSurface(normal, seen, outwards * (-1.2 * subject.detail * weight));
}
