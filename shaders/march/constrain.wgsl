// Displacements that give way to kept tissue (Correa, section 5.7).
//
// Let C(x) = min(1, distance of x to the kept set / the group's longest displacement). There are three modes:
// - by displacement: D(x) becomes C(x) D(x), which is never longer than the way to the kept set (eq. 5.15);
// - by coordinate: the main parameter of each member is multiplied by C(x) (eq. 5.19; the templates here are even along
//   their coordinate, so that a twist near its anchor is a smaller twist);
// - rigid: the kept tissue moves as a whole, by a rigid motion that pass/rigid.wgsl finds.
// In the first two modes kept tissue stays where it is.
// needs: types.wgsl affine.wgsl kinds.wgsl bind/templates.wgsl bind/kept.wgsl displace/frame.wgsl displace/compose.wgsl
//   march/kept.wgsl

/// How displacements give way to kept tissue, a bit for each CONSTRAIN_ mode that occurs; 0: none does. A pipeline
/// constant.
override has_constraints: u32 = 14u;

/// The main parameters among the first four of a kind, which say how much a template does: 1 for those, 0 for others.
fn main_parameters(kind: u32) -> vec4f {
    return vec4f((MAIN_PARAMETERS >> vec4u(kind)) & vec4u(1u));
}

/// As `rest_from_subject` for the members of one group, with their main parameters multiplied by `part`, 0 to 1.
fn group_done_partly(pos: vec3f, bits: u32, part: f32) -> Mapped {
    var left = bits;
    var sum = vec3f(0.0);
    var continuity = NO_END;
    while left != 0u {
        let i = firstLeadingBit(left);
        left &= ~(1u << i);
        let q = apply_affine(templates.items[i].template_from_subject, pos);
        let kind = templates.items[i].kind;
        let p0 = templates.items[i].params0 * mix(vec4f(1.0), vec4f(part), main_parameters(kind));
        let d = shifted(i, q, p0);
        let moved = d.source;
        sum += apply_linear(templates.items[i].subject_from_template, moved);
        continuity = min(continuity, d.continuity);
    }
    return Mapped(pos + sum, continuity);
}

/// The map where a segment moves as a whole: the segment by its own rigid motion, the tissue around by a blend that
/// turns into the map of the templates (`whole`) with the distance. Where the templates alone would move other tissue
/// through the segment, tissue beside the segment is taken.
fn moved_as_a_whole(pos: vec3f, head: u32, whole: Mapped) -> Mapped {
    let sets = kept.items[head].gives_way_to;
    let rigid = apply_affine(kept.motions[head], pos);
    if is_kept(rigid, sets, 0.0) {
        return Mapped(rigid, 1.0);
    }
    let exact = kept.exact_slab;
    let away = max(distance_to_kept(rigid, sets, 0.0, exact), 0.0);
    let part = 1.0 - smoothstep(0.0, kept.items[head].fade, away);
    var source = mix(whole.pos, rigid, part);
    let voxel = kept.spacing;
    for (var turn = 0u; turn < 2u; turn++) {
        let here = distance_to_kept(source, sets, 0.0, exact);
        if here >= 0.5 * voxel {
            break;
        }
        var slope = vec3f(0.0);
        for (var axis = 0u; axis < 3u; axis++) {
            let along = select(vec3f(0.0), vec3f(voxel), vec3u(0u, 1u, 2u) == vec3u(axis));
            slope += along * (distance_to_kept(source + along, sets, 0.0, exact) - here);
        }
        source += slope / max(length(slope), 1e-9) * (0.5 * voxel - here);
    }
    return Mapped(source, select(whole.continuity, -1.0, is_kept(source, sets, 0.0)));
}

/// The map of one group, with its constraint.
fn group_map(pos: vec3f, head: u32, bits: u32) -> Mapped {
    let whole = rest_from_subject(pos, bits);
    if has_constraints == 0u {
        return whole;
    }
    let mode = kept.items[head].constraint;
    if (has_constraints & (1u << CONSTRAIN_RIGID)) != 0u {
        if mode == CONSTRAIN_RIGID {
            return moved_as_a_whole(pos, head, whole);
        }
    }
    if (has_constraints & ((1u << CONSTRAIN_DISPLACEMENT) | (1u << CONSTRAIN_COORDINATE))) == 0u {
        return whole;
    }
    if mode == CONSTRAIN_NOTHING {
        return whole;
    }
    let sets = kept.items[head].gives_way_to;
    if is_kept(pos, sets, 0.0) {
        return Mapped(pos, 1.0);
    }
    // Between its voxels a distance is wrong by less than half of one.
    let away = max(distance_to_kept(pos, sets, 0.0, kept.exact_slab) - 0.5 * kept.spacing, 0.0);
    let part = min(away / max(kept.items[head].longest, 1e-6), 1.0);
    if (has_constraints & (1u << CONSTRAIN_COORDINATE)) != 0u {
        if mode == CONSTRAIN_COORDINATE {
            // Half of a turn is more than half of its chord: no farther than the way there is.
            let partly = group_done_partly(pos, bits, part);
            let way = partly.pos - pos;
            return Mapped(pos + way * min(away / max(length(way), 1e-9), 1.0), partly.continuity);
        }
    }
    return Mapped(pos + part * (whole.pos - pos), whole.continuity);
}
