// What the constraints of a document ask of the map as a whole, computed anew with every change of a template.
//
// Rigid segments: for each set of a group whose constraint lets tissue move as a whole, the rigid motion that comes
// nearest to what the group would do to that tissue (Correa, section 5.7.2, second part: "the displacement should be
// the same for all points in that region").
//
// One workgroup per group and set. A lattice over the deformed space asks where material comes from; the box of the
// cells that may hold some of the segment gets a lattice of its own, until it is close about the segment:
//
//   +--+--+--+--+        +--+--+--+--+
//   |  |  |  |  |        |##|##|##|  |        ##  the material there is near enough to the segment at rest
//   |  |##|##|  |   ->   |##|##|##|  |   ->   ...  a last, finer lattice is summed over
//   |  |  |##|  |        |  |##|##|##|
//
// There a place and its source are a pair, as heavy as the tissue at rest that it stands for: the determinant of the
// map, faded over a cell at the surface of the segment, so that the sums change evenly when a parameter does. The
// rotation that best takes places to sources (least squares) is found by turning it towards the pairs' moments until it
// stays (Müller, Bender, Chentanez, Macklin 2016, "A robust method to extract the rotational part of deformations"),
// from four starts, since from half a turn away no side is nearer.
//
// Constraints by coordinate: the longest displacement of any material of the subject, found on lattices about each
// template and about the subject, then climbed from the longest of each lane.
//
// Differs from the source: there a template's coordinate is held still over the region, kind by kind; this asks nothing
// of the kind.
// needs: types.wgsl affine.wgsl bind/templates.wgsl bind/kept.wgsl displace/compose.wgsl march/kept.wgsl

/// What is found, as the end of `Kept` has it.
struct Fitted {
    /// Per group and set (four for each, at the index of its head) the motion, subject space to rest space. Of a group
    /// that gives way by its coordinate, the longest displacement in the first number of its first.
    motions: array<Affine, 128>,
    /// Per group and set how far around the segment other tissue goes with it.
    seams: array<array<f32, 4>, 32>,
}

/// Written whole, entry by entry.
@group(3) @binding(0) var<storage, read_write> found: Fitted;
/// The box of the deformed object: a corner, and cells of one side.
@group(3) @binding(1) var<uniform> lattice: Lattice;

/// Cells along each side of a lattice that looks for the segment, and how often it is looked for.
const SEEK_SIDE: u32 = 24u;
const SEEK_TURNS: u32 = 4u;
/// Cells along each side of the lattice that is summed over.
const SIDE: u32 = 48u;
/// How many times as long as a way in the deformed space the way at rest may be: cells are kept so far from the
/// segment.
const STRETCH: f32 = 3.0;
/// Heavier than this many times its own volume no place is.
const MOST_WEIGHT: f32 = 8.0;
/// How far around a segment tissue goes with it: so many times what its motion misses in the mean, so that the seam is
/// stretched twofold and not more, within limits (subject units).
const SEAM: f32 = 4.0;
const LEAST_SEAM: f32 = 0.02;
const MOST_SEAM: f32 = 0.25;
/// Turns at most; each is a Newton step, a dozen settle a right angle.
const TURNS: u32 = 40u;
/// Cells along each side of a lattice that looks for the longest displacement, and steps of a climb.
const LONGEST_SIDE: u32 = 32u;
const CLIMBS: u32 = 14u;

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

fn matrix_of(q: vec4f) -> mat3x3f {
    return mat3x3f(
        1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y),
        2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + q.w * q.x),
        2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y),
    );
}

/// The rotation nearest to a matrix, from a start (unit quaternion).
fn turned_to(a: mat3x3f, start: vec4f) -> mat3x3f {
    var q = start;
    for (var turn = 0u; turn < TURNS; turn++) {
        let r = matrix_of(q);
        let hold = abs(dot(r[0], a[0]) + dot(r[1], a[1]) + dot(r[2], a[2])) + 1e-12;
        let way = (cross(r[0], a[0]) + cross(r[1], a[1]) + cross(r[2], a[2])) / hold;
        let angle = length(way);
        if angle < 1e-7 {
            break;
        }
        let axis = way / angle * sin(0.5 * angle);
        let c = cos(0.5 * angle);
        q = normalize(vec4f(c * q.xyz + q.w * axis + cross(axis, q.xyz), c * q.w - dot(axis, q.xyz)));
    }
    return matrix_of(q);
}

/// The rotation nearest to a matrix; none where the matrix tells none.
fn nearest_rotation(given: mat3x3f) -> mat3x3f {
    let size = sqrt(dot(given[0], given[0]) + dot(given[1], given[1]) + dot(given[2], given[2]));
    var best = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    if size < 1e-14 {
        return best;
    }
    let a = given * (1.0 / size);
    var most = -NO_END;
    for (var start = 0u; start < 4u; start++) {
        // The identity, then half a turn about each axis.
        let first = select(vec4f(0.0), vec4f(1.0), vec4u(1u, 2u, 3u, 0u) == vec4u(start));
        let r = turned_to(a, first);
        let likeness = dot(r[0], a[0]) + dot(r[1], a[1]) + dot(r[2], a[2]);
        if likeness > most + 1e-6 {
            most = likeness;
            best = r;
        }
    }
    return best;
}

/// Where what the templates before an index have at a point was at rest.
fn at_rest_before(pos: vec3f, before: u32) -> vec3f {
    if before == 0u {
        return pos;
    }
    return rest_from_subject(pos, ~(0xffffffffu << before)).pos;
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

/// The longest displacement of any material by the templates of a mask; known to the first lane. 0 if it is not asked.
fn longest_way(bits: u32, is_asked: bool, lane: u32) -> f32 {
    let count = LONGEST_SIDE * LONGEST_SIDE * LONGEST_SIDE;
    var left = bits;
    var best = vec4f(0.0, 0.0, 0.0, -1.0);
    let all = vec3f(lattice.cells.xyz) * lattice.side;
    var step = vec3f(max(all.x, max(all.y, all.z)) / f32(LONGEST_SIDE));
    // The whole box, then about each template, twice as far as its box reaches on every side. One loop for both, and so
    // one place that asks the map: compilers draw the map into each.
    loop {
        let i = firstLeadingBit(max(left, 1u));
        let is_whole = left == bits && best.w < 0.0;
        for (var k = select(count, lane, is_asked); k < count; k += 64u) {
            let part = (cell_of(k, LONGEST_SIDE) + 0.5) / f32(LONGEST_SIDE);
            let about = apply_affine(templates.items[i].subject_from_template, part * 3.0 - 1.0);
            let pos = select(about, lattice.corner.xyz + part * all, is_whole);
            let way = length_of_way(pos, bits);
            best = select(best, vec4f(pos, way), way > best.w);
        }
        if is_whole {
            best.w = max(best.w, 0.0);
            continue;
        }
        left &= ~(1u << i);
        if left == 0u {
            break;
        }
    }
    // Uphill, by steps that are halved where none of six goes higher.
    for (var climb = select(CLIMBS * 4u, 0u, is_asked); climb < CLIMBS * 4u; climb++) {
        var has_climbed = false;
        for (var k = 0u; k < 6u; k++) {
            let way = select(vec3f(0.0), step, vec3u(0u, 1u, 2u) == vec3u(k >> 1u)) * select(1.0, -1.0, (k & 1u) == 1u);
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
    var most = 0.0;
    for (var k = 0u; k < 64u; k++) {
        most = max(most, sources[k].w);
    }
    workgroupBarrier();
    return most;
}

@compute @workgroup_size(64)
fn fit(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let head = group.x >> 2u;
    let sets = 1u << (group.x & 3u);
    let item = kept.items[head];
    let bits = bits_of(head);
    let is_asked = item.constraint == CONSTRAIN_RIGID && (item.gives_way_to & sets) != 0u && bits != 0u;
    let asks_longest = item.constraint == CONSTRAIN_COORDINATE && sets == 1u && bits != 0u;
    let longest = longest_way(bits, asks_longest, lane);
    let exact = kept.exact_slab;
    var low = lattice.corner.xyz;
    var high = low + vec3f(lattice.cells.xyz) * lattice.side;
    var origin = vec3f(0.0);
    for (var turn = 0u; turn < SEEK_TURNS; turn++) {
        let cell = (high - low) / f32(SEEK_SIDE);
        let reach = 0.5 * STRETCH * length(cell) + kept.distance_dims.w;
        var own_low = vec3f(NO_END);
        var own_high = vec3f(-NO_END);
        var near = vec4f(0.0);
        let count = SEEK_SIDE * SEEK_SIDE * SEEK_SIDE;
        for (var k = select(count, lane, is_asked); k < count; k += 64u) {
            let corner = low + cell_of(k, SEEK_SIDE) * cell;
            let mapped = rest_from_subject(corner + 0.5 * cell, bits);
            // A gap has a source too, and nothing there: cells well inside of one do not count.
            let is_there = mapped.continuity >= -length(cell);
            if is_there && distance_to_kept(at_rest_before(mapped.pos, item.before), sets, 0.0, exact) <= reach {
                own_low = min(own_low, corner);
                own_high = max(own_high, corner + cell);
                near += vec4f(mapped.pos, 1.0);
            }
        }
        lows[lane] = vec4f(own_low, 0.0);
        highs[lane] = vec4f(own_high, 0.0);
        sources[lane] = near;
        workgroupBarrier();
        for (var k = 0u; k < 64u; k++) {
            own_low = min(own_low, lows[k].xyz);
            own_high = max(own_high, highs[k].xyz);
        }
        near = vec4f(0.0);
        for (var k = 0u; k < 64u; k++) {
            near += sources[k];
        }
        if near.w > 0.0 {
            low = own_low;
            high = own_high;
            origin = near.xyz / near.w;
        }
        workgroupBarrier();
    }

    let middle = 0.5 * (low + high);
    let cell = (high - low) / f32(SIDE);
    let fade = 0.5 * length(cell);
    let h = 0.25 * min(cell.x, min(cell.y, cell.z));
    var n = 0.0;
    var place = vec3f(0.0);
    var source = vec3f(0.0);
    var row_x = vec3f(0.0);
    var row_y = vec3f(0.0);
    var row_z = vec3f(0.0);
    var squares = 0.0;
    let count = SIDE * SIDE * SIDE;
    for (var k = select(count, lane, is_asked); k < count; k += 64u) {
        let pos = low + (cell_of(k, SIDE) + 0.5) * cell;
        let mapped = rest_from_subject(pos, bits);
        let away = distance_to_kept(at_rest_before(mapped.pos, item.before), sets, 0.0, exact);
        let share = clamp(0.5 - 0.5 * away / fade, 0.0, 1.0);
        if mapped.continuity >= 0.0 && share > 0.0 {
            var columns = mat3x3f();
            for (var axis = 0u; axis < 3u; axis++) {
                let along = select(vec3f(0.0), vec3f(h), vec3u(0u, 1u, 2u) == vec3u(axis));
                columns[axis] = (rest_from_subject(pos + along, bits).pos - mapped.pos) / h;
            }
            let weight = share * min(abs(determinant(columns)), MOST_WEIGHT);
            let at = pos - middle;
            let from_origin = (mapped.pos - origin) * weight;
            n += weight;
            place += at * weight;
            source += from_origin;
            row_x += from_origin.x * at;
            row_y += from_origin.y * at;
            row_z += from_origin.z * at;
            squares += weight * dot(at, at) + dot(from_origin, mapped.pos - origin);
        }
    }
    places[lane] = vec4f(place, n);
    sources[lane] = vec4f(source, squares);
    products_x[lane] = vec4f(row_x, 0.0);
    products_y[lane] = vec4f(row_y, 0.0);
    products_z[lane] = vec4f(row_z, 0.0);
    workgroupBarrier();
    if asks_longest && lane == 0u {
        found.motions[group.x] = Affine(vec4f(longest, 0.0, 0.0, 0.0), vec4f(0.0), vec4f(0.0));
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
