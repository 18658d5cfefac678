// Follow: finds where points of rest space are in the deformed object, for captions, which are fastened to tissue. The
// map leads from the deformed object to rest space and jumps at cuts. So the deformed object is first searched on a
// lattice; from the nearest cell of each block, Newton's method follows the map along the path of that cell, where the
// map is smooth. The best of all results counts.
//
//   search   one invocation per cell of the lattice: for each point and block of cells, the cell whose material lay
//   nearest at rest
//   settle   one workgroup per point: Newton from the best cell of each block
// needs: types.wgsl displace/frame.wgsl displace/compose.wgsl march/align.wgsl

/// Blocks of cells along each axis.
const BLOCKS: u32 = 6u;
/// Bits of a candidate that are its cell.
const CELL_BITS: u32 = 17u;
/// Distances from cells are counted in such parts of a cell's side.
const PARTS: f32 = 256.0;
/// Cells that a start may be away at rest, in sides: of a thin layer not every cell has a part.
const FARTHEST: f32 = 8.0;

/// The lattice that is searched, and the number of points that are followed.
@group(3) @binding(0) var<uniform> lattice: Lattice;
/// xyz: the points of tissue that are followed, rest space.
@group(3) @binding(1) var<storage, read> followed: array<vec4f>;
/// For each point and block: the distance at rest and the cell, packed; all ones where the block has no material.
@group(3) @binding(2) var<storage, read_write> nearest: array<atomic<u32>>;
/// xyz: subject space; w: how far from the point the material there lay at rest.
@group(3) @binding(3) var<storage, read_write> places: array<vec4f>;

var<workgroup> ends: array<vec4f, 64>;

/// Which of its row, column and layer a cell is.
fn cell_at(cell: u32) -> vec3u {
    let n = lattice.cells;
    return vec3u(cell % n.x, (cell / n.x) % n.y, cell / (n.x * n.y));
}

fn cell_center(cell: u32) -> vec3f {
    return lattice.corner.xyz + (vec3f(cell_at(cell)) + 0.5) * lattice.side;
}

@compute @workgroup_size(64)
fn search(@builtin(global_invocation_id) id: vec3u) {
    let n = lattice.cells;
    let cell = id.x;
    if cell >= n.x * n.y * n.z {
        return;
    }
    let found = material_at(cell_center(cell), 0xffffffffu);
    if found.continuity < 0.0 {
        return;
    }
    let in_blocks = cell_at(cell) * BLOCKS / n.xyz;
    let block = in_blocks.x + BLOCKS * (in_blocks.y + BLOCKS * in_blocks.z);
    for (var i = 0u; i < lattice.count; i++) {
        let away = distance(found.pos, followed[i].xyz) / lattice.side;
        if away < FARTHEST {
            atomicMin(&nearest[i * BLOCKS * BLOCKS * BLOCKS + block], (u32(away * PARTS) << CELL_BITS) | cell);
        }
    }
}

/// Newton's method from a start: where it came nearest, and how far that lay from the point at rest.
fn settled(start: vec3f, wanted: vec3f) -> vec4f {
    var pos = start;
    var found = material_at(pos, 0xffffffffu);
    var off = wanted - found.pos;
    var best = vec4f(pos, select(NO_END, length(off), found.continuity >= 0.0));
    for (var turn = 0u; turn < 16u; turn++) {
        if dot(off, off) < 1e-11 {
            break;
        }
        // What stayed where it was has no path: there the map is the identity.
        var columns = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
        let h = map_step();
        var here = pos;
        for (var place = 0u; place < 4u; place++) {
            let along = select(vec3f(0.0), vec3f(h), vec3u(1u, 2u, 3u) == vec3u(place));
            let there = map_along(pos + along, found.path).pos;
            if place == 0u {
                here = there;
            } else {
                columns[place - 1u] = (there - here) / h;
            }
        }
        // The inverse, transposed; the identity where the map is flat.
        var inverse = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
        let volume = determinant(columns);
        if abs(volume) > 1e-4 {
            inverse = mat3x3f(
                cross(columns[1], columns[2]),
                cross(columns[2], columns[0]),
                cross(columns[0], columns[1]),
            ) * (1.0 / volume);
        }
        let whole = off * inverse;
        var step = whole * min(1.0, 4.0 * lattice.side / max(length(whole), 1e-9));
        // Only onto material, and only nearer: at rest, or by the step that would be left. The latter is Deuflhard's
        // natural monotonicity test (Newton Methods for Nonlinear Problems, section 3.3): a strong shear bends the way
        // on which the distance at rest falls so much that steps along it become small.
        var has_moved = false;
        for (var half = 0u; half < 6u && !has_moved; half++) {
            let next = material_at(pos + step, 0xffffffffu);
            let rest = wanted - next.pos;
            let left = rest * inverse;
            if next.continuity >= 0.0 && (dot(rest, rest) < dot(off, off) || dot(left, left) < dot(whole, whole)) {
                pos += step;
                found = next;
                off = rest;
                has_moved = true;
            }
            step *= 0.5;
        }
        if !has_moved {
            break;
        }
        if length(off) < best.w {
            best = vec4f(pos, length(off));
        }
    }
    return best;
}

@compute @workgroup_size(64)
fn settle(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let point = group.x;
    let wanted = followed[point].xyz;
    var best = vec4f(wanted, NO_END);
    // The first start is the place at rest, since most tissue stays where it was; then there is one for each block.
    for (var turn = lane; turn < 64u + BLOCKS * BLOCKS * BLOCKS; turn += 64u) {
        var start = wanted;
        var is_start = turn == 0u;
        if turn >= 64u {
            let candidate = atomicLoad(&nearest[point * BLOCKS * BLOCKS * BLOCKS + turn - 64u]);
            start = cell_center(candidate & ((1u << CELL_BITS) - 1u));
            is_start = candidate != 0xffffffffu;
        }
        if is_start {
            let end = settled(start, wanted);
            if end.w < best.w {
                best = end;
            }
        }
    }
    ends[lane] = best;
    workgroupBarrier();
    if lane == 0u {
        for (var i = 1u; i < 64u; i++) {
            // Where several are as good, the first: what stayed.
            if ends[i].w < best.w - 1e-5 {
                best = ends[i];
            }
        }
        places[point] = best;
    }
}
