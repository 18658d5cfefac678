// How much of each place belongs to each set of kept tissue, from the labels. Compute only; computed anew when a
// document names other sets or another subject is shown.
//
//   labels            members                   shares of #
//   # # # . .         # # # . .                 1.0  1.0  .75  .28  0.0
//   # . # . .   -->   # # # . .           -->   1.0  1.0  .75  .28  0.0
//   # # # . .         # # # . .                 1.0  1.0  .75  .28  0.0
//
// Crumbs are pieces of the rest of at most CRUMB label voxels that hang together by faces: they count as kept, so that
// none is torn off at a rim. A voxel in a box of 4 x 4 x 2 voxels of the rest is in no crumb, nor is one that hangs
// together with such a box, which is found for 32 voxels at a time; from the others the piece is followed until it is
// too large.
//
// The share of a label at a voxel is its weight among the 27 voxels around, 1 2 1 along each axis. That of the voxel's
// own label is HELD at least, and those of the others have the rest of 1 in proportion. So what is one voxel thin is
// not lost, what hangs together by faces goes on doing so, and shares of sets that exclude each other add up to 1.
// needs: types.wgsl bind/subject.wgsl

/// The job: sizes and sets (see types.wgsl).
@group(3) @binding(0) var<uniform> job: SharesJob;
/// Bits of label voxels, 32 of a row in a word, rows behind rows, slices behind slices, sets behind sets: 1 where the
/// label is not in the set.
@group(3) @binding(1) var<storage, read_write> rest: array<u32>;
/// In the same order: 1 where the voxel belongs to the set, by its label or as a crumb.
@group(3) @binding(2) var<storage, read_write> members: array<u32>;
/// In the same order, of one set: 1 where a box of the rest begins.
@group(3) @binding(3) var<storage, read_write> boxes: array<u32>;
/// In the same order, of one set: 1 for voxels of such boxes, and for others of the rest that hang together with them.
@group(3) @binding(4) var<storage, read_write> large: array<u32>;
/// Shares of some slices, a byte for each channel, rows of `job.row_words` words.
@group(3) @binding(5) var<storage, read_write> shares_out: array<u32>;

/// Voxels of a crumb at most.
const CRUMB: u32 = 27u;
/// The least share of a voxel's own label.
const HELD: f32 = 0.65;

/// Index of a word of bits in the planes of a set.
fn word_at(set_index: u32, at: vec3u) -> u32 {
    return at.x + job.words * (at.y + job.dims.y * (at.z + job.dims.z * set_index));
}

/// True if there is no word at this place.
fn is_beyond(at: vec3u) -> bool {
    return any(at >= vec3u(job.words, job.dims.yz));
}

/// True if a label belongs to a set.
fn is_in_set(label: u32, set_index: u32) -> bool {
    let word = job.label_sets[label >> 5u][(label >> 3u) & 3u];
    return ((word >> (4u * (label & 7u))) & (1u << set_index)) != 0u;
}

/// Marks the rest of `job.set_index`.
@compute @workgroup_size(4, 4, 4)
fn mark_rest(@builtin(global_invocation_id) at: vec3u) {
    if is_beyond(at) {
        return;
    }
    var bits = 0u;
    let count = min(32u, job.dims.x - 32u * at.x);
    for (var i = 0u; i < count; i++) {
        let label = textureLoad(labels, vec3u(32u * at.x + i, at.yz), 0).x;
        bits |= select(1u << i, 0u, is_in_set(label, job.set_index));
    }
    rest[word_at(job.set_index, at)] = bits;
}

/// Finds where boxes of the rest begin.
@compute @workgroup_size(4, 4, 4)
fn find_boxes(@builtin(global_invocation_id) at: vec3u) {
    if is_beyond(at) {
        return;
    }
    var bits = 0xffffffffu;
    if at.y + 3u >= job.dims.y || at.z + 1u >= job.dims.z {
        bits = 0u;
    }
    for (var k = 0u; k < 8u && bits != 0u; k++) {
        let row = at + vec3u(0u, k & 3u, k >> 2u);
        let here = rest[word_at(job.set_index, row)];
        var next = 0u;
        if at.x + 1u < job.words {
            next = rest[word_at(job.set_index, row + vec3u(1u, 0u, 0u))];
        }
        bits &= here & ((here >> 1u) | (next << 31u)) & ((here >> 2u) | (next << 30u)) & ((here >> 3u) | (next << 29u));
    }
    boxes[word_at(0u, at)] = bits;
}

/// Marks the voxels of the boxes.
@compute @workgroup_size(4, 4, 4)
fn fill_boxes(@builtin(global_invocation_id) at: vec3u) {
    if is_beyond(at) {
        return;
    }
    var bits = 0u;
    for (var k = 0u; k < 8u; k++) {
        let back = vec3u(0u, k & 3u, k >> 2u);
        if any(back > at) {
            continue;
        }
        let here = boxes[word_at(0u, at - back)];
        var before = 0u;
        if at.x > 0u {
            before = boxes[word_at(0u, at - back - vec3u(1u, 0u, 0u))];
        }
        bits |= here | (here << 1u) | (before >> 31u) | (here << 2u) | (before >> 30u) | (here << 3u) | (before >> 29u);
    }
    large[word_at(0u, at)] = bits;
}

/// The bits of `pass_bits` that hang together, to higher bits, with bits of `seed`, which are among them.
fn filled_up(seed: u32, pass_bits: u32) -> u32 {
    var found = seed;
    var open = pass_bits;
    for (var step = 1u; step < 32u; step *= 2u) {
        found |= open & (found << step);
        open &= open << step;
    }
    return found;
}

/// The same to lower bits.
fn filled_down(seed: u32, pass_bits: u32) -> u32 {
    return reverseBits(filled_up(reverseBits(seed), reverseBits(pass_bits)));
}

/// Spreads what is large through the rest along one axis (`job.axis`), both ways; one line of words for each
/// invocation. A few rounds find nearly all; what they leave is followed voxel by voxel.
@compute @workgroup_size(8, 8, 1)
fn spread_large(@builtin(global_invocation_id) id: vec3u) {
    let size = vec3u(job.words, job.dims.yz);
    let axis = job.axis;
    let sides = select(select(size.xy, size.xz, axis == 1u), size.yz, axis == 0u);
    if any(id.xy >= sides) {
        return;
    }
    let first = select(select(vec3u(id.xy, 0u), vec3u(id.x, 0u, id.y), axis == 1u), vec3u(0u, id.xy), axis == 0u);
    let along = vec3u(vec3u(axis) == vec3u(0u, 1u, 2u));
    let count = size[axis];
    var before = 0u;
    for (var i = 0u; i < count; i++) {
        let at = first + i * along;
        let open = rest[word_at(job.set_index, at)];
        var found = large[word_at(0u, at)];
        if axis == 0u {
            found = filled_up(found | ((before >> 31u) & open), open);
        } else {
            found |= before & open;
        }
        large[word_at(0u, at)] = found;
        before = found;
    }
    before = 0u;
    for (var k = 0u; k < count; k++) {
        let at = first + (count - 1u - k) * along;
        let open = rest[word_at(job.set_index, at)];
        var found = large[word_at(0u, at)];
        if axis == 0u {
            found = filled_down(found | ((before << 31u) & open), open);
        } else {
            found |= before & open;
        }
        large[word_at(0u, at)] = found;
        before = found;
    }
}

/// Bit of a label voxel in its word.
fn bit_of(at: vec3i) -> u32 {
    return 1u << (u32(at.x) & 31u);
}

/// True if a label voxel belongs to the rest of `job.set_index`.
fn is_rest(at: vec3i) -> bool {
    if any(at < vec3i(0)) || any(at >= vec3i(job.dims.xyz)) {
        return false;
    }
    return (rest[word_at(job.set_index, vec3u(at) / vec3u(32u, 1u, 1u))] & bit_of(at)) != 0u;
}

/// True if the piece of the rest that a voxel belongs to is a crumb.
fn is_in_crumb(start: vec3i) -> bool {
    var piece: array<vec3i, 27>;
    piece[0] = start;
    var count = 1u;
    for (var next = 0u; next < count; next++) {
        for (var side = 0u; side < 6u; side++) {
            let along = select(vec3i(0), vec3i(select(-1, 1, side < 3u)), vec3u(side % 3u) == vec3u(0u, 1u, 2u));
            let at = piece[next] + along;
            if !is_rest(at) {
                continue;
            }
            if (large[word_at(0u, vec3u(at) / vec3u(32u, 1u, 1u))] & bit_of(at)) != 0u {
                return false;
            }
            var is_known = false;
            for (var k = 0u; k < count; k++) {
                is_known = is_known || all(piece[k] == at);
            }
            if is_known {
                continue;
            }
            if count == CRUMB {
                return false;
            }
            piece[count] = at;
            count++;
        }
    }
    return true;
}

/// The bits of a word that stand for voxels of its row.
fn bits_of_row(word: u32) -> u32 {
    return 0xffffffffu >> (32u - min(job.dims.x - 32u * word, 32u));
}

/// Finds the members of `job.set_index`.
@compute @workgroup_size(4, 4, 4)
fn find_members(@builtin(global_invocation_id) at: vec3u) {
    if is_beyond(at) {
        return;
    }
    var found = 0u;
    var left = rest[word_at(job.set_index, at)] & ~large[word_at(0u, at)];
    while left != 0u {
        let i = firstTrailingBit(left);
        left &= left - 1u;
        if is_in_crumb(vec3i(i32(32u * at.x + i), vec2i(at.yz))) {
            found |= 1u << i;
        }
    }
    members[word_at(job.set_index, at)] = (~rest[word_at(job.set_index, at)] | found) & bits_of_row(at.x);
}

/// Bits of the members of a set from voxel x - 1 of a row on; those beyond the row are 0.
fn members_from(set_index: u32, x: u32, y: u32, z: u32) -> u32 {
    let first = i32(x) - 1;
    let low = first >> 5u;
    var words = vec2u(0u);
    for (var k = 0; k < 2; k++) {
        if low + k >= 0 && low + k < i32(job.words) {
            words[k] = members[word_at(set_index, vec3u(u32(low + k), y, z))];
        }
    }
    let shift = u32(first) & 31u;
    return (words.x >> shift) | select(words.y << (32u - shift), 0u, shift == 0u);
}

/// Share of a set at a voxel, where `weight` of what is around belongs to the set and `is_member` tells the voxel.
fn share_at(at: vec3i, set_index: u32, weight: f32, is_member: bool) -> f32 {
    let last = vec3i(job.dims.xyz) - 1;
    let own = textureLoad(labels, at, 0).x;
    // A crumb is of the set, and not of its label.
    let is_crumb = is_member && !is_in_set(own, set_index);
    var own_share = 0.0;
    for (var i = 0; i < 27; i++) {
        let aside = vec3i(i % 3, (i / 3) % 3, i / 9) - 1;
        let label = textureLoad(labels, clamp(at + aside, vec3i(0), last), 0).x;
        own_share += select(0.0, 1.0 / f32(8u << u32(dot(abs(aside), vec3i(1)))), label == own);
    }
    if is_crumb {
        own_share = weight;
    }
    let held = max(own_share, HELD);
    let part = select((1.0 - held) / max(1.0 - own_share, 1e-6), 1.0, own_share >= HELD);
    let others = max(weight - select(0.0, own_share, is_member), 0.0);
    return select(0.0, held, is_member) + others * part;
}

/// Shares of a set at the voxels from x on that one word of what is written holds.
fn shares_from(x: u32, y: u32, z: u32, set_index: u32) -> vec4f {
    let per_word = 4u / job.channels;
    let last = vec2i(job.dims.yz) - 1;
    // Of the rows around: bits of the voxel before, of those of the word, and of the one behind.
    var rows: array<u32, 9>;
    var some = 0u;
    var all = 0xffffffffu;
    for (var row = 0; row < 9; row++) {
        let at = vec2u(clamp(vec2i(i32(y), i32(z)) + vec2i(row % 3, row / 3) - 1, vec2i(0), last));
        var bits = members_from(set_index, x, at.x, at.y);
        bits |= select(0u, (bits >> 1u) & 1u, x == 0u);
        let end = job.dims.x - x;
        bits |= select(0u, ((bits >> end) & 1u) << (end + 1u), end <= per_word);
        rows[row] = bits;
        some |= bits;
        all &= bits;
    }
    let window = (4u << per_word) - 1u;
    if (some & window) == 0u || (all & window) == window {
        return vec4f(select(1.0, 0.0, (some & window) == 0u));
    }
    var weights = vec4f(0.0);
    for (var i = 0u; i < per_word; i++) {
        for (var row = 0; row < 9; row++) {
            let bits = rows[row] >> i;
            let part = 1.0 / f32(4u << u32(abs(row % 3 - 1) + abs(row / 3 - 1)));
            weights[i] += part * (0.5 * f32((bits >> 1u) & 1u) + 0.25 * f32(bits & 1u) + 0.25 * f32((bits >> 2u) & 1u));
        }
        let share = weights[i];
        if share > 0.0 && share < 1.0 && x + i < job.dims.x {
            let is_member = (rows[4] & (2u << i)) != 0u;
            weights[i] = share_at(vec3i(vec3u(x + i, y, z)), set_index, share, is_member);
        }
    }
    return weights;
}

/// Writes the shares of some slices, a word for each invocation: four voxels of one channel, two of two, one of four.
@compute @workgroup_size(8, 8, 1)
fn write_shares(@builtin(global_invocation_id) id: vec3u) {
    if any(id >= vec3u(job.row_words, job.dims.y, job.slice_count)) {
        return;
    }
    let per_word = 4u / job.channels;
    let x = per_word * id.x;
    var word = 0u;
    for (var k = 0u; k < select(0u, job.channels, x < job.dims.x); k++) {
        let shares = shares_from(x, id.y, job.first_slice + id.z, k);
        for (var i = 0u; i < per_word; i++) {
            word |= u32(255.0 * shares[i] + 0.5) << (8u * (i * job.channels + k));
        }
    }
    shares_out[id.x + job.row_words * (id.y + job.dims.y * id.z)] = word;
}
