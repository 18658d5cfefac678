// Carve: cut by the surface of an object, and push aside what was there. Template space; the cube has the middle of the
// object's box in its middle, and the box's longest side is 1.
// Source: Correa, section 7.5.1, eq. 7.4, with the formula of spec/surfaces.md.
//
//        reach                          d: distance to the surface, below 0 inside; m: its gradient
//   |----------->|                      room: h of the spec, how far tissue may be pushed in from the surface; 0 at
//   +-----+   m                         sharp edges
//   | obj | --->  . p   source of p: towards the object, at the wall by `push` (at most `room`) deeper, farther away
//   |     |  <- .       by less, at `reach` by nothing
//   +-----+             A = d: what lies in the object now is a gap
//
// Differs from the source: never past the middle of the object (room), since with one depth for all the map folds at
// sharp edges. m fades where the surface is equally near on two sides, so that the map does not jump within a cell.
//
// d and room lie on grids, each twice as coarse as the one inside it (data/surface/carver.rs). Each is read by a
// quadratic B-spline, whose slopes are the differences over a cell; towards the end of a grid the next one fades in.
// Room is read in the finest one alone, beyond it at the nearest point of the surface: where coarse slopes lead to, and
// from there along the surface to where its normal points at the place.
// `templates.pool[held]` has the number of grids, the finest cell, the least distance and a step of room; the rows
// behind it have for each grid where its nodes begin, their number along x plus 1024 times that along y, along z, and a
// step of distance.
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl

/// Texels in a row of `carvers`.
const CARVER_ROW: u32 = 4096u;
/// Bits of a texel that hold the room.
const CARVER_ROOM_BITS: u32 = 12u;
/// Nodes at the end of a grid over which the next one fades in.
const CARVER_FADE: f32 = 4.0;
/// Radius of a ball that holds every object's box.
const CARVER_BALL: f32 = 0.87;
/// Tissue closes in by at most this part of the reach.
const CARVE_MOST_CLOSING: f32 = 0.9;
/// Height above the surface at which the way to a nearest point is set right, finest cells: over sharp edges normals
/// turn within a cell at the surface, and evenly there. The finest grid holds it, see CARVER_FADE.
const CARVER_HEIGHT: f32 = 3.0;
/// The longest way along the surface that is taken at once: finest cells, and besides a part of the distance. Slopes
/// are wrong by up to an eighth of a coarse cell beside an edge, and cells are at most half as long as the way there.
const CARVER_ASIDE: f32 = 4.0;
const CARVER_ASTRAY: f32 = 0.0625;
/// How near the nearest point has to be met, finest cells.
const CARVER_MET: f32 = 0.2;
/// Ways along the surface at most.
const CARVER_WAYS: u32 = 4u;

/// What is known of an object at a place, in its own space.
struct Carved {
    /// Gradient of the distance.
    slope: vec3f,
    /// Distance to the surface, below 0 inside.
    distance: f32,
    /// How far tissue may be pushed in from the nearest point of the surface, as far as `near` goes.
    room: f32,
    /// Part of the finest grid in it, 0 to 1.
    near: f32,
}

/// How far a place lies from the end of a grid, nodes; below 0 it cannot be read there. `at` counts nodes.
fn carver_inside(at: vec3f, nodes: vec3f) -> f32 {
    let ends = min(at, nodes - 1.0 - at) - 0.5;
    return min(ends.x, min(ends.y, ends.z));
}

/// Reads one grid. `at` is a place in nodes, which lies in the grid.
fn carver_read(at: vec3f, nodes: vec3u, row: vec4f, cell: f32, least: f32, room_step: f32) -> Carved {
    let middle = clamp(round(at), vec3f(1.0), vec3f(nodes) - 2.0);
    let t = at - middle;
    // Weights of the nodes before, at and behind the place along each axis, and their slopes.
    let before = 0.5 * (0.5 - t) * (0.5 - t);
    let behind = 0.5 * (0.5 + t) * (0.5 + t);
    let weights = array<vec3f, 3>(before, 1.0 - before - behind, behind);
    let slopes = array<vec3f, 3>(t - 0.5, -2.0 * t, t + 0.5);
    let corner = vec3u(middle) - 1u;
    let first = u32(row.x) + corner.x + nodes.x * (corner.y + nodes.y * corner.z);
    var sum = vec4f(0.0);
    var room = 0.0;
    for (var k = 0u; k < 3u; k++) {
        for (var j = 0u; j < 3u; j++) {
            let line = first + nodes.x * (j + nodes.y * k);
            // Distance and its slope along x, room.
            var along = vec3f(0.0);
            for (var i = 0u; i < 3u; i++) {
                let index = line + i;
                let texel = textureLoad(carvers, vec2u(index % CARVER_ROW, index / CARVER_ROW), 0).x;
                let far = f32(texel >> CARVER_ROOM_BITS);
                let deep = f32(texel & ((1u << CARVER_ROOM_BITS) - 1u));
                along += vec3f(slopes[i].x * far, weights[i].x * far, weights[i].x * deep);
            }
            let across = weights[j].y * weights[k].z;
            sum += vec4f(along.x * across, along.y * vec3f(slopes[j].y * weights[k].z, weights[j].y * slopes[k].z, across));
            room += along.z * across;
        }
    }
    return Carved(sum.xyz * (row.w / cell), least + sum.w * row.w, room * room_step, 1.0);
}

/// Nodes of a grid along each axis, by its row of the pool.
fn carver_nodes(row: vec4f) -> vec3u {
    let flat = u32(row.y);
    return vec3u(flat % 1024u, flat / 1024u, u32(row.z));
}

/// A place of the object's space, in nodes of a grid.
fn carver_place(pos: vec3f, nodes: vec3u, cell: f32) -> vec3f {
    return pos / cell + 0.5 * (vec3f(nodes) - 1.0);
}

/// What is known of the object whose grids begin at `held` of the pool. `pos` has the middle of the object's box at 0.
fn carver_at(pos: vec3f, held: u32) -> Carved {
    let head = templates.pool[held];
    let count = u32(head.x);
    var cell = head.y;
    var found = Carved(vec3f(0.0), NO_END, 0.0, 0.0);
    var left = 1.0;
    for (var level = 0u; level < count && left > 0.0; level++) {
        let row = templates.pool[held + 1u + level];
        let nodes = carver_nodes(row);
        let at = carver_place(pos, nodes, cell);
        // The coarsest one is read as it is to its end.
        let inside = carver_inside(at, vec3f(nodes));
        let part = select(clamp(inside / CARVER_FADE, 0.0, 1.0), f32(inside >= 0.0), level + 1u == count);
        if part > 0.0 {
            let read = carver_read(at, nodes, row, cell, head.z, head.w);
            let share = left * part;
            let distance = select(found.distance + share * read.distance, share * read.distance, left == 1.0);
            let is_finest = level == 0u;
            let room = select(found.room, share * read.room, is_finest);
            let near = select(found.near, share, is_finest);
            found = Carved(found.slope + share * read.slope, distance, room, near);
            left -= share;
        }
        cell *= 2.0;
    }
    if left > 0.0 {
        // Beyond all grids it is far from the object, whose box lies in a ball.
        return Carved(found.slope, length(pos) - CARVER_BALL, 0.0, 1.0);
    }
    return found;
}

/// Room at the nearest point of the surface of a place beyond the finest grid. Slopes of coarse grids lead to a point
/// beside it. From there the way goes along the plane of the surface to below the place: on a side of a box at once to
/// the nearest point, at an edge to both sides of it in turn, of which the one with less room is nearer.
fn carver_room(pos: vec3f, found: Carved, held: u32) -> f32 {
    let head = templates.pool[held];
    let row = templates.pool[held + 1u];
    let nodes = carver_nodes(row);
    let cell = head.y;
    // All in nodes.
    let up = carver_place(pos, nodes, cell);
    let last = vec3f(nodes) - 2.0;
    var low = clamp(up - found.slope * (found.distance / cell - CARVER_HEIGHT), vec3f(1.0), last);
    let longest = CARVER_ASIDE + CARVER_ASTRAY * found.distance / cell;
    var room = NO_END;
    for (var way = 0u; way <= CARVER_WAYS; way++) {
        let read = carver_read(low, nodes, row, cell, head.z, head.w);
        let normal = read.slope / max(length(read.slope), 1e-6);
        let aside = (up - low) - normal * dot(up - low, normal);
        let left = length(aside);
        if left < CARVER_MET {
            return read.room;
        }
        // The last ways alone count: the first ones begin beside the nearest point.
        room = select(min(room, read.room), read.room, way + 1u < CARVER_WAYS);
        low = clamp(low + aside * min(1.0, longest / left), vec3f(1.0), last);
    }
    return room;
}

/// p0: push, reach, subject units. `held`: index of the object's grids in `templates.pool`, 0 for none.
fn displace_carve(q: vec3f, size: vec3f, p0: vec4f, p1: vec4f, held: u32) -> Displaced {
    if held == 0u {
        return at_rest(q);
    }
    let carved = carver_at(q - 0.5, held);
    let side = max(size.x, 1e-30);
    let distance = carved.distance * side;
    let reach = max(p0.y, 1e-6);
    let part = clamp(1.0 - max(distance, 0.0) / reach, 0.0, 1.0);
    var push = max(p0.x, -CARVE_MOST_CLOSING * reach);
    if push > 0.0 && part > 0.0 {
        var room = carved.room;
        if carved.near < 1.0 {
            room += (1.0 - carved.near) * carver_room(q - 0.5, carved, held);
        }
        push = min(push, room * side);
    }
    return Displaced(q - carved.slope * (push * part / side), distance);
}
