// What the object has at a point when templates leave tissue alone (spec/contract.md, "Meaning" of `align`; Correa, eq. 5.9).
//
// Let O0 be the untouched object and Oi the object after template i:
//   Oi(x) = Oi-1(x)        if that is tissue that i keeps                                  (it stays)
//         = nothing        if Ti opened a gap at x, or Oi-1(Ti(x)) is tissue that i keeps  (it was taken away, or stands still elsewhere)
//         = Oi-1(Ti(x))    otherwise                                                       (it moved)
//
// WGSL has no recursion; asked plainly this one would take 2^n questions besides. Three things make it short:
// - A template that keeps nothing has one case: the chain of compose.wgsl.
// - Where Ti(x) = x and there is no gap, all three cases agree on Oi-1(x).
// - Templates in a row, a to b, that keep the same (a run): tissue kept by them never moves in the run, and nothing of it ever gets
//   where it was not (by induction: the first case leaves it, the second takes away whatever would come from it). So "does Oi-1(x)
//   have kept tissue" is the same question for each i of the run as for a: Oa-1(x), asked below the run, at x itself. With one set
//   at the bottom of the list Oa-1 is the rest, and the whole document is a chain that tests the label at each point on its way:
//
//     x  kept? -> it stays      p = Tb(x)  kept? -> nothing     p = Tb-1(p)  kept? -> nothing    ...
//
// `align_mode` 1 is one group alone, two questions without a loop; 2 is that chain (one set, below it nothing); 3 is the whole: a stack
// of open questions. A question is open in its first case (what does Oa-1 have at x itself) or in its last (what does Oi-1 have at
// Ti(x)).
// An `add` group is one template here, and keeps what any of its members keeps.
//
// Which templates moved what was found is told as well (`path`): the map along that path is smooth where the object is, so that
// Jacobians and gradients of the continuity are taken along it.
//
// Differs from the source: holds for lists; the mask is not interpolated but the nearest label, so that a boundary lies where the
// labels say; only normals see a smooth mask.
//
// Constraints (section 5.7): with C(x) = min(1, distance of x to the kept set / the group's longest displacement), a displacement
// becomes C(x) D(x), so that it is never longer than the way to the set (eq. 5.15); by coordinate, the main parameter of each member is
// taken C(x) times (eq. 5.19: our templates are even along their coordinate, and what a twist does nearer to its anchor is a
// smaller twist). Kept tissue itself stays. Or it moves as a whole, by a rigid motion that pass/rigid.wgsl finds.
// needs: types.wgsl bind/subject.wgsl bind/templates.wgsl bind/feature.wgsl displace/frame.wgsl displace/compose.wgsl

/// True where both sides of the surface of kept tissue are lit by it.
const KEEPS_TISSUE: bool = true;

/// Offset of finite differences of the map, subject units: small against every bend, large against the rounding of f32.
fn map_step() -> f32 {
    return 0.0005;
}

/// 0: nothing is kept; 1: by the only group of the list; 2: one set, or one depth, by the first templates of the list; 3: any.
/// A pipeline constant.
override align_mode: u32 = 3u;
/// How displacements give way to kept tissue, a bit for each CONSTRAIN_ mode that occurs; 0: none does. A pipeline constant.
override has_constraints: u32 = 14u;
/// What says that tissue is kept. Bit 0: its segment, bit 1: its depth. A pipeline constant, so that a picture asks one texture where
/// one is enough.
override kept_by: u32 = 3u;

/// Open questions at most; a template that would open one more is taken as if it kept nothing. So many alignments that all reach one
/// point and all differ from the one before do not occur.
const MAX_OPEN: u32 = 12u;

/// Where a point lies in the texture of distances.
fn distance_uvw(rest: vec3f, slab: u32) -> vec3f {
    let r = vec4f(rest, 1.0);
    let uvw = vec3f(
        dot(features.distance_from_rest_row0, r),
        dot(features.distance_from_rest_row1, r),
        dot(features.distance_from_rest_row2, r),
    );
    let edge = 0.5 / features.distance_dims.z;
    let z = clamp(uvw.z, edge, 1.0 - edge);
    return vec3f(uvw.xy, (z + f32(slab)) / f32(max(features.slabs.x, 1u)));
}

/// Depth of a rest point under the outer surface, subject units.
fn depth_at(rest: vec3f) -> f32 {
    return textureSampleLevel(distances, linear_sampler, distance_uvw(rest, features.slabs.z), 0.0).x;
}

/// True if a rest point lies in tissue that this set of sets holds. Exact by the nearest label. Nothing lies deep where the scan ends.
fn is_kept(rest: vec3f, keeps: u32, depth: f32) -> bool {
    let r = vec4f(rest, 1.0);
    if (kept_by & 2u) != 0u {
        if (keeps & KEEPS_DEEP) != 0u && depth_at(rest) >= depth {
            let uvw = vec3f(
                dot(subject.texture_from_rest_row0, r),
                dot(subject.texture_from_rest_row1, r),
                dot(subject.texture_from_rest_row2, r),
            );
            return all(uvw >= vec3f(0.0)) && all(uvw <= subject.texture_end.xyz);
        }
    }
    if (kept_by & 1u) == 0u {
        return false;
    }
    if (keeps & 15u) == 0u || subject.label_dims.w < 0.5 {
        return false;
    }
    let voxel = floor(vec3f(
        dot(subject.label_from_rest_row0, r),
        dot(subject.label_from_rest_row1, r),
        dot(subject.label_from_rest_row2, r),
    ) * subject.label_dims.xyz);
    if any(voxel < vec3f(0.0)) || any(voxel >= subject.label_dims.xyz) {
        return false;
    }
    let label = textureLoad(labels, vec3i(voxel), 0).x;
    let word = features.label_sets[label >> 5u][(label >> 3u) & 3u];
    return ((word >> (4u * (label & 7u))) & keeps & 15u) != 0u;
}

/// Distance of a rest point to the nearest of some sets (positive outside), or how much deeper than `depth` it should lie to be kept.
/// `slab` 0 is smooth.
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

/// Which of the first four parameters say how much a template of a kind does.
fn main_parameters(kind: u32) -> vec4f {
    switch kind {
        // Slices: the progress is the last of four. Pull and move: a vector. Cut: none.
        case 10u: {
            return vec4f(0.0, 0.0, 0.0, 1.0);
        }
        case 14u, 18u: {
            return vec4f(1.0, 1.0, 1.0, 0.0);
        }
        case 15u: {
            return vec4f(0.0);
        }
        default: {
            return vec4f(1.0, 0.0, 0.0, 0.0);
        }
    }
}

/// As `rest_from_subject` for the members of one group, each doing only a part (0 to 1) of what it is set to.
fn group_done_partly(pos: vec3f, bits: u32, part: f32) -> Mapped {
    var left = bits;
    var sum = vec3f(0.0);
    var continuity = NO_END;
    let at1 = vec4f(pos, 1.0);
    while left != 0u {
        let i = firstLeadingBit(left);
        left &= ~(1u << i);
        let q = vec3f(
            dot(templates.items[i].template_from_subject_row0, at1),
            dot(templates.items[i].template_from_subject_row1, at1),
            dot(templates.items[i].template_from_subject_row2, at1),
        );
        let kind = templates.items[i].kind;
        let p0 = templates.items[i].params0 * mix(vec4f(1.0), vec4f(part), main_parameters(kind));
        let d = shifted(i, q, p0);
        let moved = d.source;
        sum += vec3f(
            dot(templates.items[i].subject_from_template_row0.xyz, moved),
            dot(templates.items[i].subject_from_template_row1.xyz, moved),
            dot(templates.items[i].subject_from_template_row2.xyz, moved),
        );
        continuity = min(continuity, d.continuity);
    }
    return Mapped(pos + sum, continuity);
}

/// Where tissue moves as a whole: the segment by its own rigid motion, what is around it more and more by the template (`whole`). What the
/// template alone would draw through the segment is taken from beside it.
fn moved_as_a_whole(pos: vec3f, head: u32, whole: Mapped) -> Mapped {
    let sets = features.items[head].keeps.z;
    let at1 = vec4f(pos, 1.0);
    let rigid = vec3f(
        dot(features.motions[3u * head], at1),
        dot(features.motions[3u * head + 1u], at1),
        dot(features.motions[3u * head + 2u], at1),
    );
    if is_kept(rigid, sets, 0.0) {
        return Mapped(rigid, 1.0);
    }
    let exact = features.slabs.y;
    let away = max(distance_to_kept(rigid, sets, 0.0, exact), 0.0);
    let part = 1.0 - smoothstep(0.0, features.items[head].lengths.w, away);
    var source = mix(whole.pos, rigid, part);
    let voxel = features.distance_dims.w;
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
    let mode = features.items[head].keeps.w;
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
    let sets = features.items[head].keeps.z;
    if is_kept(pos, sets, 0.0) {
        return Mapped(pos, 1.0);
    }
    // Between its voxels a distance is wrong by less than half of one.
    let away = max(distance_to_kept(pos, sets, 0.0, features.slabs.y) - 0.5 * features.distance_dims.w, 0.0);
    let part = min(away / max(features.items[head].lengths.z, 1e-6), 1.0);
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

/// The templates of a mask that come before the one of this index.
fn below(mask: u32, level: u32) -> u32 {
    return mask & ~(0xffffffffu << level);
}

/// Align mode 1: the list is one group. Both questions are asked everywhere: devices that run both sides of every branch ask them anyhow,
/// and have no loop to walk.
fn grouped(pos: vec3f, mask: u32) -> Material {
    let item = features.items[0];
    let moved = group_map(pos, 0u, mask);
    let stays = mask == 0u || is_kept(pos, item.keeps.x, item.lengths.x);
    let stands_elsewhere = is_kept(moved.pos, item.keeps.x, item.lengths.x);
    let continuity = select(moved.continuity, -1.0, stands_elsewhere);
    return Material(select(moved.pos, pos, stays), select(continuity, 1.0, stays), select(mask, 0u, stays));
}

/// Align mode 2: the first templates of the list keep the same, the others keep nothing.
fn chained(pos: vec3f, mask: u32) -> Material {
    var left = mask;
    var at = Material(pos, NO_END, 0u);
    var head = templates.items[firstLeadingBit(max(left, 1u))].group;
    var item = features.items[head];
    if left != 0u && item.keeps.x != 0u && is_kept(pos, item.keeps.x, item.lengths.x) {
        at.continuity = 1.0;
        return at;
    }
    while left != 0u {
        let bits = left & (0xffffffffu << head);
        let moved = group_map(at.pos, head, bits);
        left &= ~bits;
        let is_same = all(moved.pos == at.pos);
        at.pos = moved.pos;
        at.continuity = min(at.continuity, moved.continuity);
        at.path |= bits;
        // One question serves both: does what moved come from where tissue stands still, and does the next template leave it alone.
        let keeps_too = item.keeps.x != 0u;
        head = templates.items[firstLeadingBit(max(left, 1u))].group;
        let next = features.items[head];
        let asks = select(left != 0u && next.keeps.x != 0u, !is_same, keeps_too);
        if !keeps_too {
            item = next;
        }
        if at.continuity < 0.0 {
            break;
        }
        if asks && is_kept(at.pos, item.keeps.x, item.lengths.x) {
            at.continuity = select(at.continuity, -1.0, keeps_too);
            break;
        }
    }
    at.continuity = select(at.continuity, 1.0, at.path == 0u);
    return at;
}

/// Align mode 3.
fn asked(pos: vec3f, mask: u32) -> Material {
    // Open questions: where to go on, what was on the way so far.
    var open_pos: array<vec4f, 12>;
    var open_continuity: array<f32, 12>;
    var open_path: array<u32, 12>;
    var open_bits: array<u32, 12>;
    var open_head: array<u32, 12>;
    var open_is_last: array<u32, 12>;
    var open = 0u;

    var at = Material(pos, NO_END, 0u);
    var left = mask;
    loop {
        // Down to the rest, or to nothing.
        while left != 0u {
            let head = templates.items[firstLeadingBit(left)].group;
            let bits = left & (0xffffffffu << head);
            left &= ~bits;
            let moved = group_map(at.pos, head, bits);
            let is_same = all(moved.pos == at.pos) && moved.continuity >= 0.0;
            let keeps = features.items[head].keeps;
            if keeps.x != 0u && !is_same && open < MAX_OPEN {
                open_pos[open] = vec4f(moved.pos, moved.continuity);
                open_continuity[open] = at.continuity;
                open_path[open] = at.path;
                open_bits[open] = bits;
                open_head[open] = head;
                open_is_last[open] = 0u;
                open++;
                left = below(mask, keeps.y);
            } else {
                at.pos = moved.pos;
                at.continuity = min(at.continuity, moved.continuity);
                at.path |= bits;
                if at.continuity < 0.0 {
                    left = 0u;
                }
            }
        }
        // Up again with what was found.
        var goes_down = false;
        while open > 0u && !goes_down {
            let top = open - 1u;
            let item = features.items[open_head[top]];
            let kept = at.continuity >= 0.0 && is_kept(at.pos, item.keeps.x, item.lengths.x);
            if open_is_last[top] != 0u {
                open--;
                if kept {
                    at.continuity = -1.0;
                }
            } else if kept {
                open--;
            } else {
                let moved = open_pos[top];
                at = Material(moved.xyz, min(open_continuity[top], moved.w), open_path[top] | open_bits[top]);
                if at.continuity < 0.0 {
                    open--;
                } else {
                    open_is_last[top] = 1u;
                    left = below(mask, open_head[top]);
                    goes_down = true;
                }
            }
        }
        if !goes_down {
            break;
        }
    }
    at.continuity = select(at.continuity, 1.0, at.path == 0u && at.continuity >= 0.0);
    return at;
}

/// What the object has at a point of subject space. Bit i of `mask`: template i may reach it.
fn material_at(pos: vec3f, mask: u32) -> Material {
    let count = min(templates.count.x, 32u);
    let every = select(0u, 0xffffffffu >> ((32u - count) & 31u), count > 0u);
    if align_mode == 1u {
        return grouped(pos, mask & every);
    }
    if align_mode == 2u {
        return chained(pos, mask & every);
    }
    if align_mode == 3u {
        return asked(pos, mask & every);
    }
    let mapped = rest_from_subject(pos, mask);
    return Material(mapped.pos, mapped.continuity, mask & every);
}

/// What the object has at a point of subject space: where it was at rest; a continuity below 0 where there is nothing.
fn object_from_subject(pos: vec3f, mask: u32) -> Mapped {
    let found = material_at(pos, mask);
    return Mapped(found.pos, found.continuity);
}

/// The map along a path that was found: smooth wherever material follows that path. What stayed where it was has none.
fn map_along(pos: vec3f, path: u32) -> Mapped {
    if has_constraints == 0u {
        return rest_from_subject(pos, path);
    }
    var left = path;
    var at = Mapped(pos, NO_END);
    while left != 0u {
        let head = templates.items[firstLeadingBit(left)].group;
        let bits = left & (0xffffffffu << head);
        left &= ~bits;
        let moved = group_map(at.pos, head, bits);
        at = Mapped(moved.pos, min(at.continuity, moved.continuity));
    }
    return Mapped(at.pos, select(at.continuity, 1.0, path == 0u));
}

/// How the surface of kept tissue shows in a piece of material next to it.
struct KeptSurface {
    /// Subject space, unit.
    normal: vec3f,
    /// 0 to 1.
    weight: f32,
    /// Rest space: from the place to where it is surely this side's tissue.
    inwards: vec3f,
}

/// The nearest of the surfaces that part material on this path from what stayed, or the other way round (equations 5.13 and 5.14: the
/// weight falls from 1 at the surface to 0 a thickness away on either side, and the gradient is turned round on the side that moved).
/// `jacobian` takes a step in subject space to one in rest space.
fn kept_surface(rest: vec3f, path: u32, jacobian: mat3x3f, to_eye: vec3f) -> KeptSurface {
    var weight = 0.0;
    var keeps = 0u;
    var depth = 0.0;
    var is_kept_side = false;
    // Half a voxel either way is the same surface: labels are nearest, distances smooth.
    let slack = features.distance_dims.w;
    let count = select(min(templates.count.x, 32u), 1u, align_mode == 1u);
    for (var i = 0u; i < count; i++) {
        let item = features.items[i];
        if item.keeps.x == 0u {
            continue;
        }
        let group = select(1u << i, 0xffffffffu, align_mode == 1u);
        let away = distance_to_kept(rest, item.keeps.x, item.lengths.x, 0u);
        let has_moved = (path & group) != 0u;
        let is_on_side = select(away <= slack, away >= -slack, has_moved);
        // Within the stairs of the labels it is the surface itself.
        let near = 1.0 - max(abs(away) - slack, 0.0) / max(item.lengths.y, slack);
        if is_on_side && near > weight {
            weight = near;
            keeps = item.keeps.x;
            depth = item.lengths.x;
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
    return KeptSurface(normal, seen, outwards * (-1.2 * subject.dims.w * weight));
}
