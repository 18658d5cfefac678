// Displacements that give way to kept tissue (Correa, section 5.7).
//
// Let d(x) be a distance that the way from x to the kept set has at least, D(x) the displacement. There are three
// modes:
// - by displacement: D(x) becomes min(1, d(x) / (h |D(x)|)) D(x), with h = HEADROOM;
// - by coordinate: the main parameter of each member is multiplied by min(1, d(x) / longest), `longest` the group's
//   longest displacement (eq. 5.19; the templates here are even along their coordinate, so that a twist near its anchor
//   is a smaller twist), and what comes of it is no longer than d(x);
// - rigid: the kept tissue moves as a whole, by a rigid motion that pass/rigid.wgsl finds, each set by its own.
// In the first two modes kept tissue stays where it is. In a list that is where the templates before have brought it:
// the object is asked there, as for an alignment (`KeptGroup.keeps` has the set too, march/asked.wgsl), and the
// distance is that at rest from what is there.
//
// Differs from the source: eq. 5.15 multiplies by d(x) / max |D|, one number for the whole space, so that tissue far
// from what is kept hardly moves where the displacement is long elsewhere. Here the displacement at the point itself is
// compared. The promise is the same, with a shorter proof: the source p of a point x has
// |p - x| = min(|D|, d(x) / h) <= d(x), and the ball of radius d(x) about x holds nothing of the kept set. Along a
// displacement of one direction u in that zone the map has the slope 1 + (u . grad d) / h >= 1 - 1/h > 0: it does not
// fold, as eq. 5.15 may where |D| is its maximum. `d` is the distance as it is stored less what linear interpolation
// between its samples may add (`kept.distance_slack`), and less what the smooth surface of the set may lie before the
// labels (`kept.rim`).
// needs: types.wgsl affine.wgsl kinds.wgsl bind/templates.wgsl bind/kept.wgsl displace/frame.wgsl displace/compose.wgsl
//   march/kept.wgsl

/// How displacements give way to kept tissue, a bit for each CONSTRAIN_ mode that occurs, and for CONSTRAIN_LATE and
/// CONSTRAIN_MANY; 0: none does. A pipeline constant: software rasterisers take long for what is not asked, and for
/// loops about texture reads.
override has_constraints: u32 = 62u;

/// How many times as long as the displacement the way to kept tissue has to be for the displacement to be whole. Nearer
/// to 1 more tissue goes its whole way, and what lies beside kept tissue is stretched more, by h / (h - 1) at most.
const HEADROOM: f32 = 1.25;

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

/// What the templates before a group have at a point in which the group acts: where it was at rest; the continuity is
/// below 0 where they opened a gap. Constraints of theirs are left out: tissue that they guard too has not moved, and
/// `before` is where the first of those stands.
fn before_group(pos: vec3f, head: u32) -> Mapped {
    if (has_constraints & (1u << CONSTRAIN_LATE)) == 0u {
        return Mapped(pos, 1.0);
    }
    let before = kept.items[head].before;
    if before == 0u {
        return Mapped(pos, 1.0);
    }
    return rest_from_subject(pos, ~(0xffffffffu << before));
}

/// How a point lies to some sets.
struct Guarded {
    /// True if what is there is in one of the sets.
    is_in: bool,
    /// How far it lies from them, by the distance at rest.
    away: f32,
}

/// How a point lies to some sets as the templates before a group have them. `by_voxels`: sets end at the voxels of
/// their labels, as segments that move as a whole do.
fn guarded(pos: vec3f, head: u32, sets: u32, by_voxels: bool) -> Guarded {
    let there = before_group(pos, head);
    var is_in = false;
    if by_voxels {
        is_in = is_labelled(there.pos, sets);
    } else {
        is_in = is_kept(there.pos, sets, 0.0);
    }
    is_in = is_in && there.continuity >= 0.0;
    return Guarded(is_in, distance_to_kept(there.pos, sets, 0.0, kept.exact_slab));
}

/// True if what the templates before a group have at a point is of one of the sets, which end at their voxels.
fn is_of_bodies(pos: vec3f, head: u32, sets: u32) -> bool {
    let there = before_group(pos, head);
    return is_labelled(there.pos, sets) && there.continuity >= 0.0;
}

/// How far from a body a point lies, for the seam around it: by as much as distances may be too long they count little,
/// so that there is no step where the segment ends.
fn way_to_body(place: Guarded) -> f32 {
    let told = max(place.away, 0.0);
    return told * told / (told + max(kept.distance_slack, 1e-6));
}

/// How firmly a body holds tissue that lies `away` from it: 1 at its surface, to 0 at the end of its seam, where it
/// lets go without a crease.
fn hold(away: f32, seam: f32) -> f32 {
    let left = 1.0 - min(away / max(seam, 1e-6), 1.0);
    return left * left;
}

/// The map where segments move as a whole: each segment by its own rigid motion, the tissue around by a blend of what
/// the templates do (`whole`) and of the motions. Let h be how firmly a body holds the tissue: its motion has the
/// weight h / (1 - h) against 1 for the templates. Alone its part is h, so that the blend takes the whole seam. Between
/// two bodies much nearer to each other than their seams are wide it is nearly b / (a + b), a and b the ways to them:
/// it takes all of the way from one to the other, evenly. Where the templates alone would move other tissue through a
/// segment, tissue beside the segment is taken.
fn moved_as_a_whole(pos: vec3f, head: u32, whole: Mapped) -> Mapped {
    let sets = kept.items[head].gives_way_to;
    let seams = kept.seams[head];
    var by = vec3f(0.0);
    var total = 1.0;
    if (has_constraints & (1u << CONSTRAIN_MANY)) == 0u {
        // The number of the set stands here: software rasterisers read a uniform lane by lane at a place that they do
        // not know.
        let rigid = apply_affine(kept.motions[4u * head], pos);
        let place = guarded(rigid, head, 1u, true);
        if place.is_in {
            return Mapped(rigid, 1.0);
        }
        let held = hold(way_to_body(place), seams.x);
        total = 1.0 / max(1.0 - held, 1e-7);
        by = held * total * (rigid - whole.pos);
    } else {
        var away = vec4f(0.0);
        var widths = vec4f(0.0);
        for (var left = sets; left != 0u; left &= left - 1u) {
            let channel = firstTrailingBit(left);
            let rigid = apply_affine(kept.motions[4u * head + channel], pos);
            let place = guarded(rigid, head, 1u << channel, true);
            if place.is_in {
                return Mapped(rigid, 1.0);
            }
            away[channel] = way_to_body(place);
            widths[channel] = seams[channel] * hold(away[channel], seams[channel]);
        }
        // Beside a body of wide seam one of a narrow seam has a wide one too: they share the way between them.
        let squares = widths * widths;
        let all_squares = squares.x + squares.y + squares.z + squares.w;
        for (var left = sets; left != 0u; left &= left - 1u) {
            let channel = firstTrailingBit(left);
            let seam = sqrt(seams[channel] * seams[channel] + max(all_squares - squares[channel], 0.0));
            let held = hold(away[channel], seam);
            let weight = held / max(1.0 - held, 1e-7);
            by += weight * (apply_affine(kept.motions[4u * head + channel], pos) - whole.pos);
            total += weight;
        }
    }
    var source = whole.pos + by / total;
    let voxel = kept.spacing;
    var is_in = is_of_bodies(source, head, sets);
    // Distances are read on the way out alone, in a loop whose turns are not known before: one of two turns becomes
    // branches, which software rasterisers run everywhere.
    for (var turns = select(0u, 2u, is_in); turns > 0u; turns = select(0u, turns - 1u, is_in)) {
        let away = distance_to_kept(before_group(source, head).pos, sets, 0.0, kept.exact_slab);
        // The way out is up the distance.
        var slope = vec3f(0.0);
        for (var axis = 0u; axis < 3u; axis++) {
            let along = select(vec3f(0.0), vec3f(voxel), vec3u(0u, 1u, 2u) == vec3u(axis));
            let there = before_group(source + along, head);
            slope += along * (distance_to_kept(there.pos, sets, 0.0, kept.exact_slab) - away);
        }
        source += slope / max(length(slope), 1e-9) * (0.5 * voxel - away);
        is_in = is_of_bodies(source, head, sets);
    }
    return Mapped(source, select(whole.continuity, -1.0, is_in));
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
    let place = guarded(pos, head, sets, false);
    if place.is_in {
        return Mapped(pos, 1.0);
    }
    // The smooth surface lies up to half a voxel before the labels from which distances are taken: nothing moves at it.
    let away = max(place.away - kept.distance_slack - kept.rim, 0.0);
    if (has_constraints & (1u << CONSTRAIN_COORDINATE)) != 0u {
        if mode == CONSTRAIN_COORDINATE {
            let part = min(away / max(kept.motions[4u * head].row0.x, 1e-6), 1.0);
            // Half of a turn is more than half of its chord: no farther than the way there is.
            let partly = group_done_partly(pos, bits, part);
            let way = partly.pos - pos;
            return Mapped(pos + way * min(away / max(length(way), 1e-9), 1.0), partly.continuity);
        }
    }
    let way = whole.pos - pos;
    let part = min(away / max(HEADROOM * length(way), 1e-9), 1.0);
    return Mapped(pos + part * way, whole.continuity);
}
