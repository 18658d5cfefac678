// The skip grid over the deformed space: per cell, which templates may reach it and whether anything visible may map
// into it. Compute only; made anew when a template, the transfer function or the subject changes.
//
//   deformed space, one cell          template i                     rest space, bricks
//   +---+                                                            +--+--+--+--+
//   | · |  box: centre, half   -->   two readings at most   -->      |  |##|  |  |   the box of where the cell came
//   from
//   +---+                            (flap | rest), each a box       |  |##|##|  |   meets a visible brick, or does not
//
// A box is carried back through the list. Each template is evaluated at the box's centre and at the middles of its six
// sides: the differences say how the box is turned and stretched there, the second differences how far from straight
// that is. Where a template is small against the box that is not enough, and its bound of displacement is used. What a
// sweep presses together comes from far apart, which differences do not show: there the corners of the box's parts say
// where the box comes from. Where a template is two-valued (the flap lies over what was there before) both readings are
// followed, each only if the box can hold material of it. Conservative but for details finer than `detail`, which
// tests/gpu/grid.rs looks for by probing.
// needs: types.wgsl affine.wgsl kinds.wgsl bind/templates.wgsl bind/kept.wgsl displace/compose.wgsl

/// 1 if templates leave tissue alone or give way to it. A pipeline constant.
override has_kept: u32 = 1u;

/// What to do (see types.wgsl).
@group(3) @binding(0) var<uniform> job: GridJob;
/// Summed table of visible bricks: entry (x, y, z) counts those below x, y, z; one more entry than bricks on each axis.
@group(3) @binding(1) var<storage, read> visible_sums: array<u32>;
/// Per cell: mask of the templates that may reach it.
@group(3) @binding(2) var<storage, read_write> cell_masks: array<u32>;
/// Per cell: 0 visible, else the way to the nearest visible one, as far as is known.
@group(3) @binding(3) var<storage, read_write> cell_ways: array<u32>;
/// Distances in the other buffer: one pass reads the buffer that the pass before has written.
@group(3) @binding(4) var<storage, read_write> cell_ways_before: array<u32>;
/// Masks, read by one pass and written by the one before.
@group(3) @binding(6) var<storage, read_write> cell_masks_before: array<u32>;
/// x: mask; y: way.
@group(3) @binding(5) var grid_out: texture_storage_3d<rg32uint, write>;

/// Ways through the list that are followed for one cell at most; where there are more (many cuts crossing in one cell),
/// it counts as visible and reached by all.
const MAX_WAYS: u32 = 24u;
/// The continuity may change across the box by this much more than its differences say.
const CONTINUITY_SAFETY: f32 = 1.5;
/// Places at which differences across a box are taken: its centre and the middles of its sides.
const CROSS_PLACES: u32 = 7u;
/// Where corners of parts of a box are asked, what lies between them comes from so much beyond the box about where they
/// come from, as a part of its longest side. Found by trying: what is pushed stays within, what turns does not quite.
const BEYOND_CORNERS: f32 = 0.1;

/// A box on its way back through the list, subject space.
struct Walk {
    /// Centre of the box.
    at: vec3f,
    /// Half the length of each side of the box.
    half: vec3f,
    /// Displacement of the group so far.
    sum: vec3f,
    /// Images of the three half sides under the group so far.
    side0: vec3f,
    side1: vec3f,
    side2: vec3f,
    /// Half extent that comes on top.
    spread: vec3f,
    /// Templates still to come.
    left: u32,
    /// Head of the group that is being summed.
    group: u32,
    /// True if that group has a segment that moves as a whole, and its motion reaches the box.
    is_rigid: bool,
}

/// One reading of a template at a point.
struct Reading {
    /// source - q, template space.
    moved: vec3f,
    /// A of this reading: below 0 it has no material here.
    continuity: f32,
}

fn to_template(i: u32, pos: vec3f) -> vec3f {
    return apply_affine(templates.items[i].template_from_subject, pos);
}

fn to_template_vector(i: u32, v: vec3f) -> vec3f {
    return apply_linear(templates.items[i].template_from_subject, v);
}

fn to_subject_vector(i: u32, v: vec3f) -> vec3f {
    return apply_linear(templates.items[i].subject_from_template, v);
}

/// Half extent in subject space of a template-space box of half extent `half`.
fn to_subject_extent(i: u32, half: vec3f) -> vec3f {
    return apply_to_extent(templates.items[i].subject_from_template, half);
}

/// True if template i lies along a curve.
fn is_curved(i: u32) -> bool {
    return (drawn_kinds & DRAWN_CURVES) != 0u && templates.items[i].curve != 0u;
}

/// Displacement and continuity of template i at `q`, in the space of its straight box, along its curve if it has one.
fn moved_reading(i: u32, q: vec3f) -> Reading {
    if !is_curved(i) {
        return own_reading(i, q);
    }
    let first = templates.items[i].curve;
    let size = templates.items[i].size.xyz;
    let own = unbend(first, size, q);
    let reading = own_reading(i, own.xyz);
    let moved = bend(first, size, own.xyz + reading.moved) - q;
    return Reading(select(vec3f(0.0), moved, own.w > 0.5), select(1.0, reading.continuity, own.w > 0.5));
}

/// True if the space of template i may fold, end or jump from one line to another in a box of these half sides: two
/// points of it then lie farther from each other in its own space than any steps between them are.
fn is_folded(i: u32, q: vec3f, walk: Walk) -> bool {
    let first = templates.items[i].curve;
    let size = templates.items[i].size.xyz;
    let middle = unbend(first, size, q);
    var is_whole = middle.w > 0.5;
    for (var corner = 0u; corner < 14u; corner++) {
        // The eight corners, then the middles of the six sides.
        let bits = select(vec3u(0u), vec3u(1u), (vec3u(corner) & vec3u(1u, 2u, 4u)) != vec3u(0u));
        let side = corner - 8u;
        let axis = select(vec3f(0.0), vec3f(select(-1.0, 1.0, side < 3u)), vec3u(side % 3u) == vec3u(0u, 1u, 2u));
        let to = select(axis, 2.0 * vec3f(bits) - 1.0, corner < 8u) * walk.half;
        let own = unbend(first, size, q + to_template_vector(i, to));
        let way = length((own.xyz - middle.xyz) * size);
        is_whole = is_whole && own.w > 0.5 && way <= 1.05 * job.items[i].stretch * length(to) + 1e-4;
    }
    return !is_whole;
}

/// The same reading in the template's own space. Templates that tear at a face are read as if the point lay inside.
fn own_reading(i: u32, q: vec3f) -> Reading {
    let size = templates.items[i].size.xyz;
    let p0 = templates.items[i].params0;
    let p1 = templates.items[i].params1;
    let kind = templates.items[i].kind;
    if (drawn_kinds & DRAWN_PEEL) != 0u && kind == KIND_PEEL {
        let p = peeled(q, size, p0);
        return Reading(p.source - q, min(p.flap_continuity, p.along));
    }
    if (drawn_kinds & DRAWN_FLAP) != 0u && kind == KIND_FLAP {
        let o = opened(q, size, p0);
        return Reading(o.source - q, o.door_continuity);
    }
    if (drawn_kinds & DRAWN_MOVE) != 0u && kind == KIND_MOVE {
        let source = moved_back(q, size, p0, p1);
        return Reading(source - q, inside_box(source, size));
    }
    let is_torn = job.items[i].is_torn != 0u;
    let inside = clamp(q, job.items[i].own_min.xyz, job.items[i].own_max.xyz);
    let at = select(q, inside, is_torn);
    let d = displace(kind, at, size, p0, p1, templates.items[i].held);
    return Reading(d.source - at, d.continuity);
}

/// A place in the box from -1 to 1: the centre, then the middles of the six sides, both of an axis one behind the
/// other.
fn place_on_cross(k: u32) -> vec3f {
    // Of the centre it is none of the three.
    let axis = (k - 1u) / 2u;
    let side = select(1.0, -1.0, (k & 1u) == 0u);
    return select(vec3f(0.0), vec3f(side), vec3u(0u, 1u, 2u) == vec3u(axis));
}

/// A place in the box from -1 to 1: the centre, then the corners of its parts, so many along each side.
fn place_on_lattice(k: u32, parts: u32) -> vec3f {
    let n = parts + 1u;
    let at = vec3u((k - 1u) % n, ((k - 1u) / n) % n, (k - 1u) / (n * n));
    return (2.0 * vec3f(at) / f32(parts) - 1.0) * select(1.0, 0.0, k == 0u);
}

/// Continuity of the reading that the point never moved. For templates with one reading: 1 where the template is torn
/// from the tissue around it, else -1.
fn rest_continuity(i: u32, seen: vec3f, half: vec3f) -> f32 {
    var q = seen;
    if is_curved(i) {
        let own = unbend(templates.items[i].curve, templates.items[i].size.xyz, seen);
        if own.w < 0.5 || job.items[i].is_torn != 0u {
            return 1.0;
        }
        q = own.xyz;
    }
    let size = templates.items[i].size.xyz;
    let p0 = templates.items[i].params0;
    let kind = templates.items[i].kind;
    if kind == KIND_PEEL {
        let p = peeled(q, size, p0);
        return max(p.outside, p.past_hinge);
    }
    if kind == KIND_FLAP {
        return opened(q, size, p0).rest_continuity;
    }
    if kind == KIND_MOVE {
        return -inside_box(q, size);
    }
    let is_torn = job.items[i].is_torn != 0u;
    let pokes_out = any(q - half < job.items[i].reach0_min.xyz) || any(q + half > job.items[i].reach0_max.xyz);
    return select(-NO_END, 1.0, is_torn && pokes_out);
}

fn constraint_of(i: u32) -> u32 {
    return kept.items[templates.items[i].group].constraint;
}

/// The voxel of the smooth distances that is nearest to a place at rest. Beyond them the distance is that at their edge
/// and more; how much more is left out.
fn distance_voxel(rest: vec3f) -> vec3i {
    let uvw = apply_affine(kept.distance_from_rest, rest);
    let last = vec3i(kept.distance_dims) - 1;
    return min(vec3i(clamp(uvw, vec3f(0.0), vec3f(1.0)) * kept.distance_dims), last);
}

/// Distance of a voxel to the nearest of some sets of segments.
fn distance_to_sets(voxel: vec3i, sets: u32) -> f32 {
    let near = textureLoad(distances, voxel, 0);
    let held = (vec4u(sets) & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u);
    let each = select(vec4f(NO_END), near, held);
    return min(min(each.x, each.y), min(each.z, each.w));
}

/// Diagonal of a voxel of the distances, subject units. A place lies half of it from the voxel that is read at most,
/// and smoothing mixes voxels that lie one of it apart in the mean.
fn voxel_diagonal() -> f32 {
    let per_unit = vec3f(
        length(kept.distance_from_rest.row0.xyz),
        length(kept.distance_from_rest.row1.xyz),
        length(kept.distance_from_rest.row2.xyz),
    ) * kept.distance_dims;
    return length(1.0 / per_unit);
}

/// True if tissue in the box may stay where it is, as template i leaves it alone.
fn may_stay(i: u32, center: vec3f, half: vec3f) -> bool {
    if has_kept == 0u {
        return false;
    }
    let item = kept.items[templates.items[i].group];
    if item.keeps == 0u {
        return false;
    }
    if item.run != 0u {
        // What lies below may have moved it there; where it came from is not known here.
        return true;
    }
    // Nothing acts before: what stays is where it was at rest. Distances change by no more than the way; they are read
    // at the nearest voxel and smoothed, three voxels in all, or more where voxels are far from cubes. The smooth
    // surface lies off the labels.
    let reach = length(half) + max(3.0 * kept.spacing, 1.5 * voxel_diagonal()) + kept.rim;
    let voxel = distance_voxel(center);
    var least = distance_to_sets(voxel, item.keeps);
    if (item.keeps & KEEPS_DEEP) != 0u {
        let behind = vec3i(0, 0, i32(kept.depth_slab * u32(kept.distance_dims.z)));
        least = min(least, item.depth - textureLoad(distances, voxel + behind, 0).x);
    }
    return least <= reach;
}

/// Where the motion of one of a group's segments takes a box from, as centre and half extent.
fn moved_whole(head: u32, channel: u32, center: vec3f, half: vec3f) -> array<vec3f, 2> {
    let motion = kept.motions[4u * head + channel];
    return array<vec3f, 2>(apply_affine(motion, center), apply_to_extent(motion, half));
}

/// True if a segment that moves as a whole, or what goes with it, may be in the box.
fn is_reached_by_rigid(head: u32, center: vec3f, half: vec3f) -> bool {
    if has_kept == 0u || kept.items[head].constraint != CONSTRAIN_RIGID {
        return false;
    }
    // What stands there was brought by the templates before, from where is not known here.
    var is_reached = kept.items[head].before != 0u;
    // Over the sets alone that there are: software rasterisers would run the body of a branch for all four.
    for (var left = kept.items[head].gives_way_to; left != 0u && !is_reached; left &= left - 1u) {
        let channel = firstTrailingBit(left);
        let box = moved_whole(head, channel, center, half);
        let least = distance_to_sets(distance_voxel(box[0]), 1u << channel);
        let seam = kept.seams[head][channel] + kept.distance_slack;
        let reach = length(half) + seam + max(3.0 * kept.spacing, 1.5 * voxel_diagonal());
        is_reached = least <= reach;
    }
    return is_reached;
}

/// The box after the group that was being summed.
fn group_done(walk: Walk) -> Walk {
    var next = walk;
    next.at = walk.at + walk.sum;
    next.half = abs(walk.side0) + abs(walk.side1) + abs(walk.side2) + walk.spread;
    if has_kept != 0u && walk.is_rigid {
        // From anywhere between where the templates and where the motions take it from, and pushed out of the segment.
        var low = next.at - next.half;
        var high = next.at + next.half;
        for (var left = kept.items[walk.group].gives_way_to; left != 0u; left &= left - 1u) {
            let box = moved_whole(walk.group, firstTrailingBit(left), walk.at, walk.half);
            low = min(low, box[0] - box[1]);
            high = max(high, box[0] + box[1]);
        }
        next.at = 0.5 * (low + high);
        next.half = 0.5 * (high - low) + 2.0 * kept.spacing;
    }
    next.is_rigid = false;
    next.sum = vec3f(0.0);
    next.side0 = vec3f(next.half.x, 0.0, 0.0);
    next.side1 = vec3f(0.0, next.half.y, 0.0);
    next.side2 = vec3f(0.0, 0.0, next.half.z);
    next.spread = vec3f(0.0);
    return next;
}

fn sum_at(at: vec3u) -> u32 {
    return visible_sums[at.x + (job.bricks.x + 1u) * (at.y + (job.bricks.y + 1u) * at.z)];
}

/// True if the rest-space box meets a visible brick.
fn meets_visible(at: vec3f, half: vec3f) -> bool {
    // No comparison with a number that is none holds; such a box is not argued about.
    if !(all(abs(at) < vec3f(1e20)) && all(half < vec3f(1e20))) {
        return true;
    }
    let center = apply_affine(job.brick_from_rest, at);
    let extent = apply_to_extent(job.brick_from_rest, half);
    let count = vec3f(job.bricks.xyz);
    if any(center + extent < vec3f(0.0)) || any(center - extent > count) {
        return false;
    }
    let low = vec3u(clamp(floor(center - extent), vec3f(0.0), count - 1.0));
    let high = vec3u(clamp(floor(center + extent), vec3f(0.0), count - 1.0)) + 1u;
    let near = sum_at(low) + sum_at(vec3u(high.xy, low.z)) + sum_at(vec3u(high.x, low.y, high.z)) + sum_at(vec3u(low.x, high.yz));
    let far = sum_at(high) + sum_at(vec3u(low.xy, high.z)) + sum_at(vec3u(low.x, high.y, low.z)) + sum_at(vec3u(high.x, low.yz));
    return far != near;
}

/// x: mask of the templates that may reach the box; y: 0 if something visible may be in it, else 1.
///
/// Where a template has two readings in the box both are followed: the list is walked again for every combination, and
/// `choices` has a bit for each template on the way that offered a choice, set where the unmoved reading is taken.
fn look_at(center: vec3f, half: vec3f) -> vec2u {
    if drawn_kinds == 0u {
        return vec2u(0u, select(1u, 0u, meets_visible(center, half)));
    }
    let count = min(templates.count, 32u);
    let every = select(0u, 0xffffffffu >> ((32u - count) & 31u), count > 0u);
    var mask = 0u;
    var is_visible = false;
    var choices = 0u;
    var ways = 0u;
    var has_more = true;
    while has_more {
        var walk: Walk;
        walk.at = center;
        walk.half = half;
        walk.side0 = vec3f(half.x, 0.0, 0.0);
        walk.side1 = vec3f(0.0, half.y, 0.0);
        walk.side2 = vec3f(0.0, 0.0, half.z);
        walk.left = every;
        walk.group = 0xffffffffu;
        var offered = 0u;
        var has_material = true;
        while walk.left != 0u && has_material {
            let i = firstLeadingBit(walk.left);
            walk.left &= ~(1u << i);
            if templates.items[i].group != walk.group {
                walk = group_done(walk);
                walk.group = templates.items[i].group;
                walk.is_rigid = is_reached_by_rigid(walk.group, walk.at, walk.half);
            }
            let q = to_template(i, walk.at);
            let across = apply_to_extent(templates.items[i].template_from_subject, walk.half);
            let meets0 = all(q + across >= job.items[i].reach0_min.xyz) && all(q - across <= job.items[i].reach0_max.xyz);
            let meets1 = all(q + across >= job.items[i].reach1_min.xyz) && all(q - across <= job.items[i].reach1_max.xyz);
            // A segment that moves as a whole takes the tissue around it along, beyond the template's box too.
            mask |= select(0u, 1u << i, walk.is_rigid);
            if !meets0 && !meets1 {
                continue;
            }
            mask |= 1u << i;

            // The continuity of peel, flap and move has slope 1 in subject units, so the box's half diagonal bounds its
            // change.
            let margin = length(walk.half) * job.items[i].stretch;
            let is_within = job.items[i].material == MATERIAL_WITHIN;
            let is_bent = is_curved(i);
            let sides = max(across.x, max(across.y, across.z)) / job.items[i].detail;
            // Asked by the corners of so many parts along each side; 0 where differences across the box say enough.
            let parts = select(u32(ceil(max(sides, 1.0))), 0u, job.items[i].parts == 0u || is_bent);
            var is_coarse = sides > max(f32(job.items[i].parts), 1.0);
            var folds = false;
            if is_bent {
                folds = is_folded(i, q, walk);
                is_coarse = is_coarse || folds;
            }
            let rest = rest_continuity(i, q, across);
            let has_rest = folds || rest + margin >= 0.0 || (is_coarse && is_within) || may_stay(i, walk.at, walk.half);
            // Near kept tissue a constrained template acts with any part of its parameters, from none to all.
            let is_partial = has_kept != 0u && constraint_of(i) != CONSTRAIN_NOTHING && constraint_of(i) != CONSTRAIN_RIGID;

            var next = walk;
            var has_moved = true;
            if is_partial {
                let low = min(job.items[i].shift_min.xyz, vec3f(0.0));
                let high = max(job.items[i].shift_max.xyz, vec3f(0.0));
                let farthest = max(abs(low), abs(high)) * templates.items[i].size.xyz;
                // Turned or bent material has no bound of its own; the group's longest displacement holds.
                let longest = kept.items[templates.items[i].group].longest;
                next.spread += vec3f(max(max(longest, length(farthest)), job.items[i].longest));
            } else if is_coarse && is_bent && (folds || job.items[i].material != MATERIAL_BENT) {
                next.spread += vec3f(job.items[i].longest);
            } else if is_coarse && job.items[i].material < MATERIAL_BENT {
                if is_within {
                    // From anywhere in the cube.
                    next.sum += to_subject_vector(i, vec3f(0.5) - q);
                    next.side0 -= vec3f(walk.half.x, 0.0, 0.0);
                    next.side1 -= vec3f(0.0, walk.half.y, 0.0);
                    next.side2 -= vec3f(0.0, 0.0, walk.half.z);
                    next.spread += to_subject_extent(i, vec3f(0.5));
                } else {
                    let low = job.items[i].shift_min.xyz;
                    let high = job.items[i].shift_max.xyz;
                    next.sum -= to_subject_vector(i, 0.5 * (low + high));
                    next.spread += to_subject_extent(i, 0.5 * (high - low));
                }
            } else {
                let is_by_parts = parts > 0u && !is_coarse;
                var places = select(CROSS_PLACES, 1u + (parts + 1u) * (parts + 1u) * (parts + 1u), is_by_parts);
                // Where the box is known to be seen, only what moves on matters.
                let is_last = is_by_parts && walk.left == 0u;
                places = select(places, 0u, is_last && is_visible);
                var middle = Reading(vec3f(0.0), 1.0);
                var ahead = middle;
                var change = 0.0;
                // Where the places come from, seen from the box's centre.
                var low = vec3f(0.0);
                var high = vec3f(0.0);
                // One loop: compilers draw all formulas into each place that asks for them.
                for (var k = 0u; k < places; k++) {
                    let on_cross = place_on_cross(k);
                    let along = walk.half * select(on_cross, place_on_lattice(k, max(parts, 1u)), is_by_parts);
                    let reading = moved_reading(i, q + to_template_vector(i, along));
                    let origin = along + to_subject_vector(i, reading.moved);
                    if k == 0u {
                        middle = reading;
                        low = origin;
                        high = origin;
                    } else if is_by_parts {
                        low = min(low, origin);
                        high = max(high, origin);
                    } else if (k & 1u) == 1u {
                        ahead = reading;
                    } else {
                        let difference = to_subject_vector(i, 0.5 * (ahead.moved - reading.moved));
                        let axis = k / 2u - 1u;
                        next.side0 += select(vec3f(0.0), difference, axis == 0u);
                        next.side1 += select(vec3f(0.0), difference, axis == 1u);
                        next.side2 += select(vec3f(0.0), difference, axis == 2u);
                        next.spread += abs(to_subject_vector(i, ahead.moved + reading.moved - 2.0 * middle.moved));
                        change += max(
                            abs(ahead.continuity - middle.continuity),
                            abs(reading.continuity - middle.continuity),
                        );
                    }
                    if is_last {
                        // Most boxes with something in them have it in the middle, others at a corner.
                        is_visible = is_visible || meets_visible(walk.at + walk.sum + origin, vec3f(0.0));
                        places = select(places, 0u, is_visible);
                    }
                }
                if is_by_parts {
                    next.sum += 0.5 * (low + high);
                    next.side0 -= vec3f(walk.half.x, 0.0, 0.0);
                    next.side1 -= vec3f(0.0, walk.half.y, 0.0);
                    next.side2 -= vec3f(0.0, 0.0, walk.half.z);
                    let size = high - low;
                    next.spread += 0.5 * size + BEYOND_CORNERS * max(size.x, max(size.y, size.z));
                } else {
                    next.sum += to_subject_vector(i, middle.moved);
                }
                let most = middle.continuity + max(CONTINUITY_SAFETY * change, select(0.0, margin, is_within));
                has_moved = most >= 0.0;
                if is_coarse && job.items[i].material == MATERIAL_RIPPLED {
                    // The map changes within the box, but departs from its differences by a bounded shift.
                    next.spread += to_subject_extent(i, job.items[i].shift_max.xyz);
                    has_moved = true;
                }
            }
            var takes_rest = has_rest;
            has_moved = has_moved || walk.is_rigid;
            if has_moved && has_rest {
                takes_rest = ((choices >> offered) & 1u) == 1u;
                offered++;
            }
            if has_moved && !takes_rest {
                walk = next;
            }
            has_material = has_moved || has_rest;
        }
        if has_material {
            let done = group_done(walk);
            is_visible = is_visible || meets_visible(done.at, done.half);
        }
        ways++;
        // The next combination: the last choice that was not yet turned is turned, those after it start anew.
        let fresh = ~choices & ((1u << min(offered, 31u)) - 1u);
        has_more = fresh != 0u;
        if has_more {
            let last = firstLeadingBit(fresh);
            choices = (choices & ((1u << last) - 1u)) | (1u << last);
        }
        if has_more && ways == MAX_WAYS {
            mask = every;
            is_visible = true;
            has_more = false;
        }
    }
    return vec2u(mask, select(1u, 0u, is_visible));
}

fn is_cell(cell: vec3u) -> bool {
    return all(cell < job.cells.xyz);
}

fn index_of(cell: vec3u) -> u32 {
    return cell.x + job.cells.x * (cell.y + job.cells.y * cell.z);
}

/// First pass: looks at every cell.
@compute @workgroup_size(4, 4, 4)
fn fill(@builtin(global_invocation_id) cell: vec3u) {
    if !is_cell(cell) {
        return;
    }
    let half = 0.5 * job.cell_size.xyz;
    let center = job.origin_min.xyz + (vec3f(cell) + 0.5) * job.cell_size.xyz;
    let seen = look_at(center, half + job.margin);
    cell_masks[index_of(cell)] = seen.x;
    cell_ways[index_of(cell)] = select(0u, job.farthest, seen.y == 1u);
}

/// The way of a cell if the cells along `axis` are taken into account as well.
fn way_along(cell: vec3u, axis: u32) -> u32 {
    var way = cell_ways_before[index_of(cell)];
    let last = vec3i(job.cells.xyz) - 1;
    let unit = select(vec3i(0), vec3i(1), vec3u(0u, 1u, 2u) == vec3u(axis));
    for (var step = 1; step < i32(way); step++) {
        let ahead = vec3u(min(vec3i(cell) + step * unit, last));
        let behind = vec3u(max(vec3i(cell) - step * unit, vec3i(0)));
        let nearest = min(cell_ways_before[index_of(ahead)], cell_ways_before[index_of(behind)]);
        way = min(way, max(nearest, u32(step)));
    }
    return way;
}

/// The mask of a cell with those of the cells next to it along `axis`: a ray that stands in one cell looks for
/// crossings and takes differences a little way into the next, by its own cell's mask.
fn mask_along(cell: vec3u, axis: u32) -> u32 {
    var mask = cell_masks_before[index_of(cell)];
    let last = vec3i(job.cells.xyz) - 1;
    let unit = select(vec3i(0), vec3i(1), vec3u(0u, 1u, 2u) == vec3u(axis));
    for (var step = 1; step <= i32(job.spread); step++) {
        mask |= cell_masks_before[index_of(vec3u(min(vec3i(cell) + step * unit, last)))];
        mask |= cell_masks_before[index_of(vec3u(max(vec3i(cell) - step * unit, vec3i(0))))];
    }
    return mask;
}

/// Second pass: along x.
@compute @workgroup_size(4, 4, 4)
fn spread_x(@builtin(global_invocation_id) cell: vec3u) {
    if is_cell(cell) {
        cell_ways[index_of(cell)] = way_along(cell, 0u);
        cell_masks[index_of(cell)] = mask_along(cell, 0u);
    }
}

/// Third pass: along y.
@compute @workgroup_size(4, 4, 4)
fn spread_y(@builtin(global_invocation_id) cell: vec3u) {
    if is_cell(cell) {
        cell_ways[index_of(cell)] = way_along(cell, 1u);
        cell_masks[index_of(cell)] = mask_along(cell, 1u);
    }
}

/// Last pass: along z, and out.
@compute @workgroup_size(4, 4, 4)
fn spread_z(@builtin(global_invocation_id) cell: vec3u) {
    if is_cell(cell) {
        textureStore(grid_out, cell, vec4u(mask_along(cell, 2u), way_along(cell, 2u), 0u, 0u));
    }
}
