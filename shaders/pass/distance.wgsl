// Signed Euclidean distances to sets of kept tissue, and to the outside of the object. Compute only; computed anew when
// a document names other sets or another subject is shown.
//
//   fine voxels of one line          along x          along y            along z
//   . . # # # . . . #        -->   two sweeps   -->  outward search -->  outward search   -->  smoothing, texture
//    s   s   s   s   s  coarse     nearest # and     squares added       the same; signed
//                       samples    nearest . of a
//                                  line, each s
//
// Exact: the squared distance is the smallest sum of squares along the three axes, taken axis by axis (Felzenszwalb and
// Huttenlocher 2012, with a search that ends as soon as nothing nearer can come in place of the envelope of parabolas:
// near a surface, where distances are used most, the search ends after a few steps). Distances are measured to fine
// voxels and stored at samples, which are even along the three axes: coarser than the voxels of a large scan, several
// in the height of a thick slice. The signed distance is the way to the set outside, less the way out of it inside; its
// zero lies on the faces of voxels. A voxel is its box, whatever its sides, and half of each side is taken off along
// its axis. Cubes are balls of half a side where nothing gives way to the set: so they were measured before other
// voxels counted, and pictures keep the shape that they have.
// Axes are perpendicular: the voxels of a sheared grid (a tilted gantry) are read by their nearest voxel on a grid that
// is not (`label_from_voxel`).
//
// Source of the use: Correa, sections 5.4.2 and 5.7 (distance field after a background segmentation).
// The outside of the object: voxels below a threshold that belong to no segment and are connected with a side face of
// the grid. Connections with the faces at the head and foot ends of a scan do not count: a windpipe that ends there
// would let the outside into the lungs.
// needs: types.wgsl affine.wgsl bind/subject.wgsl bind/distance_job.wgsl subject/member.wgsl

/// Per coarse x, fine y, slice of the part: way to the nearest voxel of the set, and to the nearest outside it, along
/// x.
@group(3) @binding(1) var<storage, read_write> line_ways: array<vec2f>;
/// Per coarse x, coarse y, fine z: squares of these two ways in the plane of x and y.
@group(3) @binding(2) var<storage, read_write> plane_squares: array<vec2f>;
/// Per channel and coarse voxel: signed distance.
@group(3) @binding(3) var<storage, read_write> fields: array<f32>;
/// Per coarse voxel: between two passes of a smoothing.
@group(3) @binding(4) var<storage, read_write> smoothed: array<f32>;
/// Per coarse voxel: FILLED, OPEN (nothing in it) or OUTSIDE (open and connected with a side of the grid). While
/// distances to connected parts are taken, the rank of its part (pass/parts.wgsl).
@group(3) @binding(5) var<storage, read_write> flood: array<u32>;
/// The distances, four channels, in slabs (see `Kept`).
@group(3) @binding(6) var distance_out: texture_storage_3d<rgba16float, write>;

/// Bits of label voxels that belong to each set, by their labels or as its crumbs, as pass/shares.wgsl leaves them.
@group(3) @binding(7) var<storage, read_write> members: array<u32>;
/// Per line of fine voxels of the part, 32 voxels in a word: 1 for members. What the way there found, for the way back.
@group(3) @binding(8) var<storage, read_write> line_bits: array<u32>;

/// Stands for "none on this line"; its square is still finite.
const FAR: f32 = 1e4;
const FILLED: u32 = 0u;
const OPEN: u32 = 1u;
const OUTSIDE: u32 = 2u;
/// Channel of the signed distance to the outside of the object, after the four sets.
const CHANNEL_OUTSIDE: u32 = 4u;

/// Normalised value at a fine voxel; below every threshold beyond the volume.
fn texel_of(voxel: vec3i) -> f32 {
    let uvw = apply_affine(job.volume_from_voxel, vec3f(voxel));
    let is_inside = all(uvw >= vec3f(0.0)) && all(uvw <= vec3f(1.0));
    return select(-1.0, texel_at(uvw), is_inside);
}

/// True if there is nothing in a fine voxel.
fn is_open(voxel: vec3i) -> bool {
    if job.reads_labels != 0u && label_of(voxel) != 0u {
        return false;
    }
    return texel_of(voxel) < job.threshold;
}

/// Rank of the connected part that a fine voxel of the set lies in, by this label: that of the nearest sample around,
/// of connected ones if there are. What is too small to have a rank goes with the largest part.
fn part_of(voxel: vec3i, label: u32) -> u32 {
    let block = vec3i(floor((vec3f(voxel) + 0.5) / job.ratio.xyz));
    let last = vec3i(job.coarse.xyz) - 1;
    if all(job.ratio.xyz <= vec3f(1.0)) {
        return max(flood[coarse_index(vec3u(clamp(block, vec3i(0), last)))], 1u);
    }
    var least = 4.0 * FAR;
    var part = 1u;
    for (var i = 0; i < 27; i++) {
        let at = vec3u(clamp(block + vec3i(i % 3, (i / 3) % 3, i / 9) - 1, vec3i(0), last));
        let rank = flood[coarse_index(at)];
        if rank != 0u {
            let way = length(((vec3f(at) + 0.5) * job.ratio.xyz - 0.5 - vec3f(voxel)) * job.spacing.xyz);
            let apart = select(way + FAR, way, is_joined(voxel, voxel_of(at), label));
            part = select(part, rank, apart < least);
            least = min(least, apart);
        }
    }
    return part;
}

/// True if the bits of the set that is worked on tell a fine voxel as its member.
fn is_marked(voxel: vec3i) -> bool {
    let size = textureDimensions(labels);
    let at = label_voxel_of(voxel);
    if any(at < vec3i(0)) || any(at >= vec3i(size)) {
        return false;
    }
    let row = u32(at.y) + size.y * (u32(at.z) + size.z * job.channel);
    return (members[(u32(at.x) >> 5u) + job.member_words * row] & (1u << (u32(at.x) & 31u))) != 0u;
}

/// True if a fine voxel belongs to what distances are taken to.
fn is_member(voxel: vec3i) -> bool {
    if job.channel < CHANNEL_OUTSIDE {
        if job.part == 0u && job.member_words != 0u {
            return is_marked(voxel) || member_beside(voxel) != NO_LABEL;
        }
        let label = member_label(voxel);
        if label == NO_LABEL || job.part == 0u {
            return label != NO_LABEL;
        }
        return part_of(voxel, label) == job.part;
    }
    if !is_open(voxel) {
        return false;
    }
    // Its coarse voxel may be filled in part; then the ones around tell.
    let block = vec3i(floor((vec3f(voxel) + 0.5) / job.ratio.xyz));
    let last = vec3i(job.coarse.xyz) - 1;
    var found = false;
    for (var i = 0; i < 27; i++) {
        let around = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let at = clamp(block + around, vec3i(0), last);
        found = found || flood[coarse_index(vec3u(at))] == OUTSIDE;
    }
    return found;
}

/// Where a coarse sample lies among the fine voxels of an axis (0 to 2).
fn fine_position(coarse: u32, axis: u32) -> f32 {
    return (f32(coarse) + 0.5) * job.ratio[axis] - 0.5;
}

/// Ways along an axis, in fine voxels, from centre to centre to ways to the voxels' faces.
fn to_face(ways: vec2f) -> vec2f {
    return max(ways - job.half_box, vec2f(0.0));
}

/// First: which coarse voxels hold nothing, and which of them lie at a side of the grid. `job.axis` runs from
/// foot to head (3: none).
@compute @workgroup_size(4, 4, 4)
fn open_blocks(@builtin(global_invocation_id) at: vec3u) {
    if any(at >= job.coarse.xyz) {
        return;
    }
    // The voxels that share more than a hair with it.
    let low = vec3u(floor(vec3f(at) * job.ratio.xyz + 1e-3));
    let high = min(vec3u(ceil(vec3f(at + 1u) * job.ratio.xyz - 1e-3)), job.fine.xyz);
    var open = true;
    for (var z = low.z; z < high.z && open; z++) {
        for (var y = low.y; y < high.y && open; y++) {
            for (var x = low.x; x < high.x && open; x++) {
                open = is_open(vec3i(vec3u(x, y, z)));
            }
        }
    }
    let is_end = (at == vec3u(0u)) | (at + 1u == job.coarse.xyz);
    let is_side = any(is_end & (vec3u(0u, 1u, 2u) != vec3u(job.axis)));
    flood[coarse_index(at)] = select(FILLED, select(OPEN, OUTSIDE, is_side), open);
}

/// Spreads the outside along one axis (`job.axis`), both ways; one line for each invocation.
@compute @workgroup_size(8, 8, 1)
fn sweep(@builtin(global_invocation_id) id: vec3u) {
    let line = line_at(id.xy);
    var is_out = false;
    for (var i = 0u; i < line.count; i++) {
        let state = flood[line.first + i * line.stride];
        is_out = state == OUTSIDE || (is_out && state == OPEN);
        if is_out && state == OPEN {
            flood[line.first + i * line.stride] = OUTSIDE;
        }
    }
    is_out = false;
    for (var k = 0u; k < line.count; k++) {
        let i = line.count - 1u - k;
        let state = flood[line.first + i * line.stride];
        is_out = state == OUTSIDE || (is_out && state == OPEN);
        if is_out && state == OPEN {
            flood[line.first + i * line.stride] = OUTSIDE;
        }
    }
}

/// True if a fine voxel of the line whose bits begin at `row_of_bits` was found a member.
fn is_in_line(row_of_bits: u32, x: u32) -> bool {
    return (line_bits[row_of_bits + (x >> 5u)] & (1u << (x & 31u))) != 0u;
}

/// Along x: one line of fine voxels for each invocation (y, slice of the part), swept there and back.
@compute @workgroup_size(8, 8, 1)
fn along_x(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= job.fine.y || id.y >= job.slice_count {
        return;
    }
    let z = job.first_slice + id.y;
    let row = job.coarse.x * (id.x + job.fine.y * id.y);
    let count = i32(job.fine.x);
    let words = (job.fine.x + 31u) / 32u;
    let row_of_bits = words * (id.x + job.fine.y * id.y);
    let are_told = job.are_members_told != 0u && job.channel < CHANNEL_OUTSIDE && job.part == 0u;
    for (var w = 0u; w < words; w++) {
        var bits = 0u;
        if are_told {
            bits = members[w + words * (id.x + job.fine.y * (z + job.fine.z * job.channel))];
        } else {
            for (var i = 0u; i < min(32u, job.fine.x - 32u * w); i++) {
                bits |= select(0u, 1u << i, is_member(vec3i(i32(32u * w + i), i32(id.x), i32(z))));
            }
        }
        line_bits[row_of_bits + w] = bits;
    }
    // Positions of the last member and the last other passed.
    var last = vec2f(-FAR);
    var x = 0;
    for (var c = 0u; c < job.coarse.x; c++) {
        let at = fine_position(c, 0u);
        while x < count && f32(x) <= at {
            let member = is_in_line(row_of_bits, u32(x));
            last = select(last, vec2f(f32(x)), vec2<bool>(member, !member));
            x++;
        }
        line_ways[row + c] = to_face(vec2f(at) - last);
    }
    last = vec2f(FAR + f32(count));
    x = count - 1;
    for (var k = 0u; k < job.coarse.x; k++) {
        let c = job.coarse.x - 1u - k;
        let at = fine_position(c, 0u);
        while x >= 0 && f32(x) >= at {
            let member = is_in_line(row_of_bits, u32(x));
            last = select(last, vec2f(f32(x)), vec2<bool>(member, !member));
            x--;
        }
        line_ways[row + c] = min(min(line_ways[row + c], to_face(last - vec2f(at))), vec2f(FAR)) * job.spacing.x;
    }
}

/// Distances in planes of x and y, from those along x: one thread for each coarse x and y of a slice.
@compute @workgroup_size(8, 8, 1)
fn along_y(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= job.coarse.xy) || id.z >= job.slice_count {
        return;
    }
    let at = fine_position(id.y, 1u);
    let count = i32(job.fine.y);
    var best = vec2f(FAR * FAR);
    // Outwards in both directions at once; `below` is the nearest voxel not above the sample.
    let below = i32(floor(at));
    for (var step = 0; step < count; step++) {
        let low = below - step;
        let high = below + 1 + step;
        // The nearer of the two may still win against the worse of the two ways.
        let least = max(min(at - f32(low), f32(high) - at) - job.half_box, 0.0) * job.spacing.y;
        if least * least >= max(best.x, best.y) || (low < 0 && high >= count) {
            break;
        }
        if low >= 0 {
            let way = line_ways[id.x + job.coarse.x * (u32(low) + job.fine.y * id.z)];
            let off = max(at - f32(low) - job.half_box, 0.0) * job.spacing.y;
            best = min(best, way * way + vec2f(off * off));
        }
        if high < count {
            let way = line_ways[id.x + job.coarse.x * (u32(high) + job.fine.y * id.z)];
            let off = max(f32(high) - at - job.half_box, 0.0) * job.spacing.y;
            best = min(best, way * way + vec2f(off * off));
        }
    }
    plane_squares[id.x + job.coarse.x * (id.y + job.coarse.y * (job.first_slice + id.z))] = best;
}

/// Along z, and the sign. The depth under the outer surface is the distance to the outside, positive in the object.
@compute @workgroup_size(8, 8, 1)
fn along_z(@builtin(global_invocation_id) id: vec3u) {
    if any(id >= job.coarse.xyz) {
        return;
    }
    let at = fine_position(id.z, 2u);
    let count = i32(job.fine.z);
    var best = vec2f(FAR * FAR);
    let below = i32(floor(at));
    for (var step = 0; step < count; step++) {
        let low = below - step;
        let high = below + 1 + step;
        let least = max(min(at - f32(low), f32(high) - at) - job.half_box, 0.0) * job.spacing.z;
        if least * least >= max(best.x, best.y) || (low < 0 && high >= count) {
            break;
        }
        if low >= 0 {
            let square = plane_squares[id.x + job.coarse.x * (id.y + job.coarse.y * u32(low))];
            let off = max(at - f32(low) - job.half_box, 0.0) * job.spacing.z;
            best = min(best, square + vec2f(off * off));
        }
        if high < count {
            let square = plane_squares[id.x + job.coarse.x * (id.y + job.coarse.y * u32(high))];
            let off = max(f32(high) - at - job.half_box, 0.0) * job.spacing.z;
            best = min(best, square + vec2f(off * off));
        }
    }
    let ways = max(sqrt(best) - job.half_ball, vec2f(0.0));
    let volume_size = job.coarse.x * job.coarse.y * job.coarse.z;
    // Where there is nothing of the set at all, or nothing else, a distance that no subject has.
    let signed = clamp(ways.x - ways.y, -8.0, 8.0);
    fields[job.channel * volume_size + coarse_index(id)] = signed;
}

/// What the smoothing reads: the field the first time, then what the pass before left. Binomial weights 1 4 6 4 1, a
/// Gaussian of one coarse voxel: takes the stairs off a surface of voxels (section 5.4.3, a mask that is a smooth
/// scalar field).
fn weighed(at: vec3u, from_field: bool) -> f32 {
    let unit = select(vec3i(0), vec3i(1), vec3u(0u, 1u, 2u) == vec3u(job.axis));
    let last = vec3i(job.coarse.xyz) - 1;
    let volume_size = job.coarse.x * job.coarse.y * job.coarse.z;
    var sum = 0.0;
    for (var i = -2; i <= 2; i++) {
        let index = coarse_index(vec3u(clamp(vec3i(at) + i * unit, vec3i(0), last)));
        let weight = select(select(0.375, 0.25, abs(i) == 1), 0.0625, abs(i) == 2);
        if from_field {
            sum += weight * fields[job.channel * volume_size + index];
        } else {
            sum += weight * smoothed[index];
        }
    }
    return sum;
}

/// From the field to `smoothed`.
@compute @workgroup_size(4, 4, 4)
fn smooth_out(@builtin(global_invocation_id) at: vec3u) {
    if all(at < job.coarse.xyz) {
        smoothed[coarse_index(at)] = weighed(at, true);
    }
}

/// From `smoothed` to the field.
@compute @workgroup_size(4, 4, 4)
fn smooth_back(@builtin(global_invocation_id) at: vec3u) {
    if all(at < job.coarse.xyz) {
        let volume_size = job.coarse.x * job.coarse.y * job.coarse.z;
        fields[job.channel * volume_size + coarse_index(at)] = weighed(at, false);
    }
}

/// Into a slab of the texture.
@compute @workgroup_size(4, 4, 4)
fn write_texture(@builtin(global_invocation_id) at: vec3u) {
    if any(at >= job.coarse.xyz) {
        return;
    }
    let volume_size = job.coarse.x * job.coarse.y * job.coarse.z;
    var texel = vec4f(0.0);
    if job.set_count != 0u {
        for (var channel = 0u; channel < job.set_count; channel++) {
            texel[channel] = fields[channel * volume_size + coarse_index(at)];
        }
    } else {
        texel.x = fields[CHANNEL_OUTSIDE * volume_size + coarse_index(at)];
    }
    textureStore(distance_out, vec3u(at.xy, at.z + job.slab * job.coarse.z), texel);
}
