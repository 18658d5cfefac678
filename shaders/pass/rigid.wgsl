// What the constraints of a document ask of the map as a whole, computed anew with every change of a template.
//
// Rigid segments: for each set of a group whose constraint lets tissue move as a whole, the rigid motion that comes
// nearest to what the group would do to that tissue (Correa, section 5.7.2, second part: "the displacement should be
// the same for all points in that region"): the least-squares motion over all of its voxels. A voxel is a box full of
// tissue and not a point, so that one voxel has a motion too, that of the map about it.
//
// One workgroup per group and set (`lattice.dispatch` is 1).
//
//   rest space                                     deformed space
//   +--+--+--+--+       +--+--+--+--+              +-----+-----+
//   |  |  |  |  |       |##|##|##|  |              |  s  |     |   s  a start: a place whose material is that of the
//   |  |##|##|  |  ->   |##|##|##|  |  each cell   |     |  s  |      segment, one for each block of a lattice
//   |  |  |##|  |       |  |##|##|  |  -------->   +-----+-----+
//   +--+--+--+--+                      its place   |     |     |
//   the box of the segment closes in on it,
//   and is divided along its voxels
//
// The map leads from places to what was there at rest, so the place of a cell is found by Newton's method (Deuflhard,
// Newton Methods for Nonlinear Problems, section 3.3), from the place of the cell before or from the nearest start.
// What a cut has taken away has no place, and no say. The cells are those of the segment at rest whatever the
// parameters are: the motion changes evenly with them.
//
// The rotation is that of the greatest eigenvalue of a matrix of the pairs' moments (Horn 1987, "Closed-form solution
// of absolute orientation using unit quaternions", section 4), by Jacobi's rotations.
//
// Constraints by coordinate: the longest displacement of any material of the subject, looked for on lattices about each
// template and about the subject in a dispatch of its own (`lattice.dispatch` is 0 in it), 64 workgroups a group, then
// climbed to from the longest of each of them. Many lanes with short loops: lavapipe ends all loops of a shader after
// 65,535 turns, and each question along a curve takes a turn for each of its segments.
//
// Differs from the source: there a template's coordinate is held still over the region, kind by kind; this asks nothing
// of the kind.
// needs: types.wgsl affine.wgsl bind/templates.wgsl bind/kept.wgsl displace/curve.wgsl displace/compose.wgsl
//   march/kept.wgsl

/// What is found, as the end of `Kept` has it.
struct Fitted {
    /// Per group and set (four for each, at the index of its head) the motion, subject space to rest space. Of a group
    /// that gives way by its coordinate, the longest displacement in the first number of its first, and in the second
    /// row a place that it leads to, deformed space.
    motions: array<Affine, 128>,
    /// Per group and set how far around the segment other tissue goes with it.
    seams: array<array<f32, 4>, 32>,
}

/// Written whole, entry by entry.
@group(3) @binding(0) var<storage, read_write> found: Fitted;
/// The box of the deformed object: a corner, and cells of one side.
@group(3) @binding(1) var<uniform> lattice: Lattice;
/// Per group (at the index of its head) 64 places from which the climb to the longest displacement begins; w: how long
/// it is there.
@group(3) @binding(2) var<storage, read_write> climb_starts: array<vec4f, 2048>;

/// Cells along each side of a lattice that looks for the segment at rest, and how often it is looked for.
const SEEK_SIDE: u32 = 24u;
const SEEK_TURNS: u32 = 4u;
/// Cells along each side of the box of the segment, at most.
const SIDE: u32 = 32u;
/// Places of a lattice over the deformed space where the longest displacement is looked for, and of the block of it
/// that is a lane's where starts are; blocks along each side.
const PLACES: u32 = 65536u;
const BLOCK_PLACES: u32 = 512u;
const BLOCKS: f32 = 4.0;
/// Starts of each lane: one of the lattice over the object, one of those about templates.
const STARTS: u32 = 2u;
/// From how many starts the place of a cell is looked for: the nearest, then the nearest of those that are moved
/// another way. Where a cut parts the segment all of the nearest may be on the other side of it.
const TRIES: u32 = 4u;
/// Questions to the map at most on the way to a place, and how often a step is halved.
const QUESTIONS: u32 = 48u;
const HALVINGS: u32 = 7u;
/// So near at rest (subject units) a place is that of what is looked for; farther than the second it is not.
const NEAR: f32 = 2e-6;
const FAR: f32 = 2e-5;
/// Offset of finite differences of the map, subject units: as `map_step` of march/align.wgsl.
const MAP_STEP: f32 = 0.0005;
/// The longest step on the way to a place, subject units.
const LONGEST_STEP: f32 = 0.3;
/// Sweeps of Jacobi's rotations; six settle four by four numbers of 32 bits.
const SWEEPS: u32 = 8u;
/// How far around a segment tissue goes with it: so many times what its motion misses in the mean, within limits
/// (subject units). At the surface of a ball the motion misses about twice as much, and more with the distance. With 12
/// times, tissue about it is stretched by a fifth more than by the templates alone at most (99 of 100 places;
/// tests/gpu/rigid.rs), with 4 times it was up to two thirds more. Wider, more of the tissue goes with the body.
const SEAM: f32 = 12.0;
const LEAST_SEAM: f32 = 0.02;
const MOST_SEAM: f32 = 0.5;
/// Halvings of the steps of a climb to the longest displacement, and how many are tried of each length.
const CLIMBS: u32 = 14u;
const TRIED: u32 = 12u;

/// xyz: lowest and highest corner that a lane found.
var<workgroup> lows: array<vec4f, 64>;
var<workgroup> highs: array<vec4f, 64>;
/// xyz: sum of places; w: sum of weights.
var<workgroup> places: array<vec4f, 64>;
/// xyz: sum of sources; w: how many, or the longest displacement of a lane.
var<workgroup> sources: array<vec4f, 64>;
/// Sums of the products of each coordinate of a source with its place.
var<workgroup> products_x: array<vec4f, 64>;
var<workgroup> products_y: array<vec4f, 64>;
var<workgroup> products_z: array<vec4f, 64>;
/// xyz: starts, two of each lane; w: 1 where there is one.
var<workgroup> start_places: array<vec4f, 128>;
/// xyz: what is at a start, rest space.
var<workgroup> start_rests: array<vec4f, 128>;

fn matrix_of(q: vec4f) -> mat3x3f {
    return mat3x3f(
        1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y),
        2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + q.w * q.x),
        2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y),
    );
}

/// The rotation nearest to a matrix, that is, with the greatest sum of products; none where the matrix tells none.
fn nearest_rotation(given: mat3x3f) -> mat3x3f {
    let size = sqrt(dot(given[0], given[0]) + dot(given[1], given[1]) + dot(given[2], given[2]));
    let a = given * (1.0 / max(size, 1e-30));
    // Of quaternions x, y, z, w. The product of a quaternion with this and itself is that sum.
    var n = mat4x4f(
        a[0].x - a[1].y - a[2].z, a[0].y + a[1].x, a[2].x + a[0].z, a[1].z - a[2].y,
        a[0].y + a[1].x, a[1].y - a[0].x - a[2].z, a[1].z + a[2].y, a[2].x - a[0].z,
        a[2].x + a[0].z, a[1].z + a[2].y, a[2].z - a[0].x - a[1].y, a[0].y - a[1].x,
        a[1].z - a[2].y, a[2].x - a[0].z, a[0].y - a[1].x, a[0].x + a[1].y + a[2].z,
    );
    var axes = mat4x4f(
        1.0, 0.0, 0.0, 0.0,
        0.0, 1.0, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
    );
    for (var turn = 0u; turn < SWEEPS * 6u; turn++) {
        // The pairs 0 1, 0 2, 0 3, 1 2, 1 3, 2 3.
        let pair = turn % 6u;
        let p = select(select(2u, 1u, pair < 5u), 0u, pair < 3u);
        let q = select(select(3u, pair - 1u, pair < 5u), pair + 1u, pair < 3u);
        let beside = n[p][q];
        if abs(beside) > 1e-12 {
            let cotangent = 0.5 * (n[q][q] - n[p][p]) / beside;
            let t = select(-1.0, 1.0, cotangent >= 0.0) / (abs(cotangent) + sqrt(1.0 + cotangent * cotangent));
            let c = inverseSqrt(1.0 + t * t);
            let s = t * c;
            let column = n[p];
            n[p] = c * column - s * n[q];
            n[q] = s * column + c * n[q];
            for (var k = 0u; k < 4u; k++) {
                let first = n[k][p];
                n[k][p] = c * first - s * n[k][q];
                n[k][q] = s * first + c * n[k][q];
            }
            let axis = axes[p];
            axes[p] = c * axis - s * axes[q];
            axes[q] = s * axis + c * axes[q];
        }
    }
    // None is that of the last: of equal ones it is taken.
    var best = 3u;
    for (var k = 0u; k < 3u; k++) {
        best = select(best, k, n[k][k] > n[best][best] + 1e-6);
    }
    return matrix_of(normalize(axes[best]));
}

/// Number of a cell along each axis, of a lattice with as many cells along each.
fn cell_of(index: u32, side: u32) -> vec3f {
    return vec3f(vec3u(index % side, (index / side) % side, index / (side * side)));
}

/// Templates of a group.
fn bits_of(head: u32) -> u32 {
    let count = min(templates.count, 32u);
    var bits = 0u;
    for (var i = 0u; i < count; i++) {
        bits |= select(0u, 1u << i, templates.items[i].group == head);
    }
    return bits;
}

/// How far the templates of a mask move the material that they bring to a place; 0 where they bring none of the
/// subject.
fn length_of_way(pos: vec3f, bits: u32) -> f32 {
    let mapped = rest_from_subject(pos, bits);
    let is_there = mapped.continuity >= 0.0 && is_in_subject(texture_from_rest(mapped.pos));
    return select(0.0, length(mapped.pos - pos), is_there);
}

/// Numbers from 0 to 1 that fill a cube evenly, seen from any side: no layer is so thin and so straight that it falls
/// between them, as it may between the rows of a grid (the multiples of three irrational numbers; Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences").
fn evenly(k: u32) -> vec3f {
    return vec3f((vec3u(k) * vec3u(3518319155u, 2882110345u, 2360945575u)) >> vec3u(8u)) / 16777216.0;
}

/// How many lattices there are for a mask of templates: one over the object, two about each.
fn lattice_count(bits: u32) -> u32 {
    return 1u + 2u * countOneBits(bits);
}

/// The template of a mask that a lattice is about; the first of them for the lattice over the object.
fn template_of(turn: u32, bits: u32) -> u32 {
    var left = bits;
    for (var k = 3u; k <= turn; k += 2u) {
        left &= left - 1u;
    }
    return firstTrailingBit(max(left, 1u));
}

/// A place in a lattice over the deformed space, by its part of each side: in the first of the lattices that over the
/// object, then for each template one that reaches as far beyond its box as this is wide, and one of the box, both laid
/// along its curve if it has one.
fn place_in_lattice(part: vec3f, turn: u32, bits: u32) -> vec3f {
    let i = template_of(turn, bits);
    var in_template = select(part * 3.0 - 1.0, part * 1.1 - 0.05, (turn & 1u) == 0u);
    // A box that is laid along a curve may have little in common with the straight one.
    if (drawn_kinds & DRAWN_CURVES) != 0u {
        let curve = templates.items[i].curve;
        if curve != 0u {
            in_template = bend(curve, templates.items[i].size.xyz, in_template);
        }
    }
    let about = apply_affine(templates.items[i].subject_from_template, in_template);
    return select(about, lattice.corner.xyz + part * vec3f(lattice.cells.xyz) * lattice.side, turn == 0u);
}

/// True for kinds whose longest displacement no lattice over the deformed space is sure to meet: slabs may lie far
/// apart, and the walls of a crack are jagged and moved the farthest. Where they bring tissue is known from rest.
fn is_carried(kind: u32) -> bool {
    let is_slices = (drawn_kinds & DRAWN_SLICES) != 0u && kind == KIND_SLICES;
    return is_slices || ((drawn_kinds & DRAWN_CRACK) != 0u && kind == KIND_CRACK);
}

/// A place to which such a template brings tissue, from three numbers from 0 to 1: by slices tissue of anywhere in the
/// subject, also of its corners, which may be all that the last slab has; by a crack that of its walls.
fn place_carried(part: vec3f, i: u32) -> vec3f {
    let size = templates.items[i].size.xyz;
    let p0 = templates.items[i].params0;
    let curve = select(0u, templates.items[i].curve, (drawn_kinds & DRAWN_CURVES) != 0u);
    var q = wall_of_crack(part.y, 3.0 * part.z, part.x < 0.5, size, p0, templates.items[i].params1);
    if templates.items[i].kind == KIND_SLICES {
        let inside = clamp(1.2 * part - 0.1, vec3f(1e-4), vec3f(1.0 - 1e-4));
        let rest = apply_affine(inverse_affine(subject.texture_from_rest), inside * subject.texture_end.xyz);
        q = apply_affine(templates.items[i].template_from_subject, rest);
        if curve != 0u {
            q = unbend(curve, size, q).xyz;
        }
        q = carry_slices(q, p0);
    }
    if curve != 0u {
        q = bend(curve, size, q);
    }
    return apply_affine(templates.items[i].subject_from_template, q);
}

/// Looks for the longest displacement of any material in one of 64 parts of the lattices, and keeps it as a start.
fn seek_longest(head: u32, part: u32, lane: u32) {
    let bits = bits_of(head);
    let is_asked = kept.items[head].constraint == CONSTRAIN_COORDINATE && bits != 0u;
    var best = vec4f(0.0);
    let lattices = lattice_count(bits);
    for (var turn = 0u; turn < lattices + countOneBits(bits); turn++) {
        let is_lattice = turn < lattices;
        let i = template_of(1u + 2u * (turn - min(turn, lattices)), bits);
        let is_due = is_asked && (is_lattice || is_carried(templates.items[i].kind));
        for (var k = select(PLACES, 64u * part + lane, is_due); k < PLACES; k += 4096u) {
            var pos = vec3f(0.0);
            if is_lattice {
                pos = place_in_lattice(evenly(k), turn, bits);
            } else {
                pos = place_carried(evenly(k), i);
            }
            let way = length_of_way(pos, bits);
            best = select(best, vec4f(pos, way), way > best.w);
        }
    }
    sources[lane] = best;
    workgroupBarrier();
    if is_asked && lane == 0u {
        for (var k = 1u; k < 64u; k++) {
            best = select(best, sources[k], sources[k].w > best.w);
        }
        climb_starts[64u * head + part] = best;
    }
}

/// The longest displacement of any material by the templates of a group, in w, and a place of it; known to the first
/// lane. 0 if it is not asked.
fn longest_way(head: u32, bits: u32, is_asked: bool, lane: u32) -> vec4f {
    var best = vec4f(0.0);
    if is_asked {
        best = climb_starts[64u * head + lane];
    }
    let all = vec3f(lattice.cells.xyz) * lattice.side;
    var step = vec3f(max(all.x, max(all.y, all.z)) / 32.0);
    // Uphill, by steps along the axes and in all directions, halved where none of a dozen goes higher: the longest
    // often lies at a side of the subject or in a thin layer.
    for (var climb = select(CLIMBS * 4u, 0u, is_asked); climb < CLIMBS * 4u; climb++) {
        var has_climbed = false;
        for (var k = 0u; k < TRIED; k++) {
            let along = select(vec3f(0.0), vec3f(1.0), vec3u(0u, 1u, 2u) == vec3u(k >> 1u)) * select(1.0, -1.0, (k & 1u) == 1u);
            let askew = 2.0 * evenly(TRIED * (64u * climb + lane) + k) - 1.0;
            let way = step * select(askew, along, k < 6u);
            let there = length_of_way(best.xyz + way, bits);
            if there > best.w {
                best = vec4f(best.xyz + way, there);
                has_climbed = true;
            }
        }
        step = select(0.5 * step, step, has_climbed);
    }
    sources[lane] = best;
    workgroupBarrier();
    for (var k = 0u; k < 64u; k++) {
        best = select(best, sources[k], sources[k].w > best.w);
    }
    workgroupBarrier();
    return best;
}

/// A place, and what is there.
struct Place {
    /// Deformed space, as the group has it.
    pos: vec3f,
    /// Rest space.
    rest: vec3f,
    /// From steps at rest to steps of places, about there.
    inverse: mat3x3f,
    /// True if the inverse is not known yet.
    is_new: bool,
}

/// The place of some material by a mask of templates, from a place and what is there. What is found lies farther off
/// than FAR at rest where there is none.
fn place_of(wanted: vec3f, start: Place, bits: u32) -> Place {
    var best = start;
    var off = wanted - best.rest;
    var step = best.inverse * off;
    var columns = mat3x3f();
    // 0: the next place is asked for; 1 to 3: how the map changes along each axis.
    var column = select(0u, 1u, start.is_new);
    var is_fresh = false;
    var halvings = 0u;
    for (var k = 0u; k < QUESTIONS && dot(off, off) > NEAR * NEAR && halvings < HALVINGS; k++) {
        let along = select(vec3f(0.0), vec3f(MAP_STEP), vec3u(1u, 2u, 3u) == vec3u(column));
        let short = step * min(1.0, LONGEST_STEP / max(length(step), 1e-9));
        let mapped = rest_from_subject(best.pos + select(short, along, column > 0u), bits);
        if column > 0u {
            columns[column - 1u] = (mapped.pos - best.rest) / MAP_STEP;
            column = (column + 1u) & 3u;
            if column == 0u {
                let volume = determinant(columns);
                // Where the map is flat there is no way on.
                halvings = select(0u, HALVINGS, abs(volume) < 1e-5);
                best.inverse = transpose(mat3x3f(
                    cross(columns[1], columns[2]),
                    cross(columns[2], columns[0]),
                    cross(columns[0], columns[1]),
                )) * (1.0 / select(volume, 1.0, abs(volume) < 1e-5));
                best.is_new = false;
                is_fresh = true;
                step = best.inverse * off;
            }
        } else {
            let next = wanted - mapped.pos;
            let left = best.inverse * next;
            let whole = best.inverse * off;
            let is_nearer = dot(next, next) < dot(off, off) || (is_fresh && dot(left, left) < dot(whole, whole));
            if mapped.continuity >= 0.0 && is_nearer {
                // The map changes little from one place to the next: it is asked anew where that is too slow.
                column = select(0u, 1u, dot(next, next) > 0.01 * dot(off, off));
                best.pos += short;
                best.rest = mapped.pos;
                off = next;
                step = left;
                is_fresh = false;
                halvings = 0u;
            } else if is_fresh {
                step = 0.5 * short;
                halvings++;
            } else {
                column = 1u;
            }
        }
    }
    return best;
}

/// True if a place is that of some material.
fn is_place_of(wanted: vec3f, found: Place) -> bool {
    return distance(wanted, found.rest) < FAR;
}

/// True if a rest point lies on the grid of the distances; beyond it they are those of its sides.
fn has_distance(rest: vec3f) -> bool {
    let uvw = apply_affine(kept.distance_from_rest, rest);
    return all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
}

/// The map from samples of distances, counted from a corner of their grid, to rest space.
fn rest_from_sample() -> Affine {
    return inverse_affine(Affine(
        kept.distance_from_rest.row0 * kept.distance_dims.x,
        kept.distance_from_rest.row1 * kept.distance_dims.y,
        kept.distance_from_rest.row2 * kept.distance_dims.z,
    ));
}

@compute @workgroup_size(64)
fn fit(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    if lattice.dispatch == 0u {
        seek_longest(group.x, group.y, lane);
        return;
    }
    let head = group.x >> 2u;
    let sets = 1u << (group.x & 3u);
    let item = kept.items[head];
    let bits = bits_of(head);
    let is_asked = item.constraint == CONSTRAIN_RIGID && (item.gives_way_to & sets) != 0u && bits != 0u;
    let asks_longest = item.constraint == CONSTRAIN_COORDINATE && sets == 1u && bits != 0u;
    let longest = longest_way(head, bits, asks_longest, lane);
    let exact = kept.exact_slab;

    // The box of the segment at rest, in samples.
    let to_rest = rest_from_sample();
    let sides = vec3f(
        length(vec3f(to_rest.row0.x, to_rest.row1.x, to_rest.row2.x)),
        length(vec3f(to_rest.row0.y, to_rest.row1.y, to_rest.row2.y)),
        length(vec3f(to_rest.row0.z, to_rest.row1.z, to_rest.row2.z)),
    );
    var low = vec3f(0.0);
    var high = kept.distance_dims;
    for (var turn = 0u; turn < SEEK_TURNS; turn++) {
        let cell = (high - low) / f32(SEEK_SIDE);
        let reach = 0.5 * length(sides * cell) + kept.distance_slack;
        var own_low = vec3f(NO_END);
        var own_high = vec3f(-NO_END);
        let count = SEEK_SIDE * SEEK_SIDE * SEEK_SIDE;
        for (var k = select(count, lane, is_asked); k < count; k += 64u) {
            let corner = low + cell_of(k, SEEK_SIDE) * cell;
            if distance_to_kept(apply_affine(to_rest, corner + 0.5 * cell), sets, 0.0, exact) <= reach {
                own_low = min(own_low, corner);
                own_high = max(own_high, corner + cell);
            }
        }
        lows[lane] = vec4f(own_low, 0.0);
        highs[lane] = vec4f(own_high, 0.0);
        workgroupBarrier();
        for (var k = 0u; k < 64u; k++) {
            own_low = min(own_low, lows[k].xyz);
            own_high = max(own_high, highs[k].xyz);
        }
        if all(own_low < own_high) {
            low = own_low;
            high = own_high;
        }
        workgroupBarrier();
    }
    low = max(floor(low), vec3f(0.0));
    high = min(ceil(high), kept.distance_dims);
    let samples = max(vec3u(high - low), vec3u(1u));
    let cells = select(vec3u(SIDE), samples * (SIDE / min(samples, vec3u(SIDE))), samples <= vec3u(SIDE));
    let cell = vec3f(samples) / vec3f(cells);
    // Cells within a voxel are in the segment or not, as the voxel is. Of others its labels say what share is.
    let has_shares = kept.is_coarse != 0u || any(samples > vec3u(SIDE));
    let fade = 0.5 * length(sides * cell);

    // The starts: of each block of a lattice the place whose material is nearest to the segment, then the place of the
    // tissue of the segment that is nearest to that.
    let all_bits = bits | select(0u, ~(0xffffffffu << item.before), item.before > 0u);
    let block = vec3f(vec3u(lane & 3u, (lane >> 2u) & 3u, lane >> 4u));
    var still = Place(vec3f(0.0), vec3f(0.0), mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), true);
    for (var slot = 0u; slot < STARTS; slot++) {
        start_places[STARTS * lane + slot] = vec4f(0.0);
    }
    for (var turn = 0u; turn < lattice_count(all_bits); turn++) {
        let slot = STARTS * lane + min(turn, 1u);
        if !is_asked || start_places[slot].w > 0.0 {
            continue;
        }
        var nearest = still;
        var least = NO_END;
        for (var k = 0u; k < BLOCK_PLACES; k++) {
            let pos = place_in_lattice((block + evenly(k)) / BLOCKS, turn, all_bits);
            let mapped = rest_from_subject(pos, all_bits);
            let away = distance_to_kept(mapped.pos, sets, 0.0, exact);
            if mapped.continuity >= 0.0 && has_distance(mapped.pos) && away < least {
                least = away;
                nearest.pos = pos;
                nearest.rest = mapped.pos;
            }
        }
        if least < NO_END {
            // Towards the segment, and half a sample into it.
            var slope = vec3f(0.0);
            for (var axis = 0u; axis < 3u; axis++) {
                let along = select(vec3f(0.0), vec3f(kept.spacing), vec3u(0u, 1u, 2u) == vec3u(axis));
                slope[axis] = distance_to_kept(nearest.rest + along, sets, 0.0, exact)
                    - distance_to_kept(nearest.rest - along, sets, 0.0, exact);
            }
            let way = max(least + 0.5 * kept.spacing, 0.0);
            let wanted = nearest.rest - slope / max(length(slope), 1e-9) * way;
            let there = place_of(wanted, nearest, all_bits);
            // Where distances lead astray, as between two parts of the segment, there is none.
            let is_of_segment = distance_to_kept(wanted, sets, 0.0, exact) <= kept.distance_slack;
            if is_of_segment && is_place_of(wanted, there) {
                start_places[slot] = vec4f(there.pos, 1.0);
                start_rests[slot] = vec4f(there.rest, 0.0);
            }
        }
    }
    workgroupBarrier();
    // Sums are taken about one of the pairs, so that small numbers are summed.
    var middle = vec3f(0.0);
    var origin = vec3f(0.0);
    for (var k = 0u; k < STARTS * 64u; k++) {
        if start_places[k].w > 0.0 {
            middle = start_places[k].xyz;
            origin = start_rests[k].xyz;
            break;
        }
    }

    var n = 0.0;
    var place = vec3f(0.0);
    var source = vec3f(0.0);
    var row_x = vec3f(0.0);
    var row_y = vec3f(0.0);
    var row_z = vec3f(0.0);
    var squares = 0.0;
    let count = cells.x * cells.y * cells.z;
    // Neighbours are a lane's, so that each place is near the one before.
    let own = (count + 63u) / 64u;
    var last = still;
    // The place of another cell, found where `last` led nowhere: as a rule on the other side of a cut.
    var other = still;
    for (var k = select(count, lane * own, is_asked); k < min(count, (lane + 1u) * own); k++) {
        let index = vec3u(k % cells.x, (k / cells.x) % cells.y, k / (cells.x * cells.y));
        let at_sample = low + (vec3f(index) + 0.5) * cell;
        // A place anywhere in a cell of several voxels: a cut would have a whole layer of middles on one side.
        var aside = select(vec3f(0.0), (evenly(k) - 0.5) * cell, has_shares);
        let told = apply_affine(to_rest, select(floor(at_sample) + 0.5, at_sample, has_shares));
        let away = distance_to_kept(told, sets, 0.0, exact);
        var share = select(0.0, 1.0, away < 0.0);
        if has_shares && abs(away) <= fade + kept.distance_slack {
            share = 0.0;
            var middle_of_share = vec3f(0.0);
            for (var eighth = 0u; eighth < 8u; eighth++) {
                let corner = (cell_of(eighth, 2u) - 0.5) * 0.5 * cell;
                let part = select(0.0, 0.125, is_labelled(apply_affine(to_rest, at_sample + corner), sets));
                share += part;
                middle_of_share += part * corner;
            }
            // About the middle of what is in it.
            if share < 1.0 {
                aside = 0.5 * aside + middle_of_share / max(share, 0.125);
            }
        }
        if share <= 0.0 {
            continue;
        }
        let wanted = apply_affine(to_rest, at_sample + aside);
        var there = last;
        var is_found = false;
        var passed = -1.0;
        // How the nearest start is moved, and by how much the others are moved otherwise at most.
        var nearest_way = vec3f(0.0);
        var most_apart = 0.0;
        for (var attempt = select(0u, 2u, last.is_new); attempt < 2u + 2u * TRIES && !is_found; attempt++) {
            if attempt == 1u {
                there = other;
                if other.is_new {
                    continue;
                }
            }
            if attempt > 1u {
                if attempt == 2u + TRIES {
                    passed = -1.0;
                    for (var i = 0u; i < STARTS * 64u; i++) {
                        let apart = distance(start_places[i].xyz - start_rests[i].xyz, nearest_way);
                        most_apart = max(most_apart, select(0.0, apart, start_places[i].w > 0.0));
                    }
                }
                // The nearest start that was not tried yet.
                var least = NO_END;
                for (var i = 0u; i < STARTS * 64u; i++) {
                    let way = distance(start_rests[i].xyz, wanted);
                    let apart = distance(start_places[i].xyz - start_rests[i].xyz, nearest_way);
                    let is_due = start_places[i].w > 0.0 && (attempt < 2u + TRIES || apart > 0.5 * most_apart);
                    if is_due && way > passed && way < least {
                        least = way;
                        there = still;
                        there.pos = start_places[i].xyz;
                        there.rest = start_rests[i].xyz;
                    }
                }
                if attempt == 2u {
                    nearest_way = there.pos - there.rest;
                }
                passed = least;
                if least == NO_END {
                    break;
                }
            }
            there = place_of(wanted, there, all_bits);
            is_found = is_place_of(wanted, there);
            if is_found && attempt > 0u {
                other = last;
            }
        }
        if is_found {
            last = there;
            // What the templates before have there, where they act.
            var before = there.rest;
            if item.before > 0u {
                before = rest_from_subject(there.pos, bits).pos;
            }
            let at = there.pos - middle;
            let from_origin = (before - origin) * share;
            n += share;
            place += at * share;
            source += from_origin;
            row_x += from_origin.x * at;
            row_y += from_origin.y * at;
            row_z += from_origin.z * at;
            squares += share * dot(at, at) + dot(from_origin, before - origin);
        }
    }
    places[lane] = vec4f(place, n);
    sources[lane] = vec4f(source, squares);
    products_x[lane] = vec4f(row_x, 0.0);
    products_y[lane] = vec4f(row_y, 0.0);
    products_z[lane] = vec4f(row_z, 0.0);
    workgroupBarrier();
    if asks_longest && lane == 0u {
        found.motions[group.x] = Affine(vec4f(longest.w, 0.0, 0.0, 0.0), vec4f(longest.xyz, 0.0), vec4f(0.0));
    }
    if lane > 0u || !is_asked {
        return;
    }
    for (var k = 1u; k < 64u; k++) {
        n += places[k].w;
        place += places[k].xyz;
        source += sources[k].xyz;
        row_x += products_x[k].xyz;
        row_y += products_y[k].xyz;
        row_z += products_z[k].xyz;
        squares += sources[k].w;
    }
    var turn = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    var shift = vec3f(0.0);
    var seam = LEAST_SEAM;
    // Where nothing of it is left there is nothing to move.
    if n > 0.0 {
        place /= n;
        source /= n;
        let moments = transpose(mat3x3f(
            row_x / n - source.x * place,
            row_y / n - source.y * place,
            row_z / n - source.z * place,
        ));
        turn = nearest_rotation(moments);
        // The mean square of what the motion misses: of both clouds, less twice what they have in common.
        let shared_part = dot(turn[0], moments[0]) + dot(turn[1], moments[1]) + dot(turn[2], moments[2]);
        let missed = squares / n - dot(place, place) - dot(source, source) - 2.0 * shared_part;
        seam = clamp(SEAM * sqrt(max(missed, 0.0)), LEAST_SEAM, MOST_SEAM);
        shift = source + origin - turn * (place + middle);
    }
    let rows = transpose(turn);
    found.motions[group.x] = Affine(vec4f(rows[0], shift.x), vec4f(rows[1], shift.y), vec4f(rows[2], shift.z));
    found.seams[head][group.x & 3u] = seam;
}
