// The connected parts of a set of kept tissue, for parts that move each by itself. Compute only; computed anew when
// a document names other sets or another subject is shown.
//
//   samples of the set    numbered        the least of a line    the largest parts, by size
//   . # # . . #           . 2 3 . . 6     . 2 2 . . 6            . 1 1 . . 2
//   . # . . # #     -->   . 8 . . b c --> . 2 . . 6 6      -->   . 1 . . 2 2
//
// Two samples that are neighbours belong together if all voxels on the way between them have the same label: a gap of
// one voxel parts two bones of one segment, and two segments that touch are two parts. Each round takes the least
// number along all lines of the three axes, as far as they are connected.
// needs: types.wgsl bind/distance_job.wgsl subject/member.wgsl

/// Per sample: LINKS, and the number of the sample that its part is called by, from 1; 0 outside of the set. At last
/// the rank of its part, from 1, and 0 where the part has none.
@group(3) @binding(1) var<storage, read_write> owners: array<u32>;
/// Per sample: samples of the part that is called by it; of one that has a rank, the rank and RANKED.
@group(3) @binding(2) var<storage, read_write> sizes: array<atomic<u32>>;

/// The bits that say whether a sample is connected with the next along x, y and z.
const FIRST_LINK: u32 = 29u;
const LINKS: u32 = 7u << FIRST_LINK;
const RANKED: u32 = 0x80000000u;

/// xy: size and number of the largest part that a lane found.
var<workgroup> largest: array<vec2u, 64>;

@compute @workgroup_size(4, 4, 4)
fn mark_parts(@builtin(global_invocation_id) at: vec3u) {
    if any(at >= job.coarse.xyz) {
        return;
    }
    let own = voxel_of(at);
    let label = member_label(own);
    var word = 0u;
    if label != NO_LABEL {
        word = coarse_index(at) + 1u;
        for (var axis = 0u; axis < 3u; axis++) {
            let next = at + select(vec3u(0u), vec3u(1u), vec3u(0u, 1u, 2u) == vec3u(axis));
            if all(next < job.coarse.xyz) && is_joined(own, voxel_of(next), label) {
                word |= 1u << (FIRST_LINK + axis);
            }
        }
    }
    owners[coarse_index(at)] = word;
}

/// Takes the least number along one axis (`job.axis`), both ways; one line for each invocation.
@compute @workgroup_size(8, 8, 1)
fn spread_parts(@builtin(global_invocation_id) id: vec3u) {
    let line = line_at(id.xy);
    let link = 1u << (FIRST_LINK + job.axis);
    // The least number of what is connected so far; 0: nothing is.
    var least = 0u;
    for (var i = 0u; i < line.count; i++) {
        let word = owners[line.first + i * line.stride];
        let own = word & ~LINKS;
        least = select(own, min(own, least), least != 0u);
        owners[line.first + i * line.stride] = (word & LINKS) | least;
        least = select(0u, least, (word & link) != 0u);
    }
    least = 0u;
    for (var k = 0u; k < line.count; k++) {
        let i = line.count - 1u - k;
        let word = owners[line.first + i * line.stride];
        let own = word & ~LINKS;
        least = select(own, min(own, least), least != 0u && (word & link) != 0u);
        owners[line.first + i * line.stride] = (word & LINKS) | least;
    }
}

@compute @workgroup_size(4, 4, 4)
fn count_parts(@builtin(global_invocation_id) at: vec3u) {
    if any(at >= job.coarse.xyz) {
        return;
    }
    let own = owners[coarse_index(at)] & ~LINKS;
    if own != 0u {
        atomicAdd(&sizes[own - 1u], 1u);
    }
}

/// Ranks as many parts as there are sets for them, the largest first; of equal ones the first.
@compute @workgroup_size(64)
fn rank_parts(@builtin(local_invocation_index) lane: u32) {
    let count = job.coarse.x * job.coarse.y * job.coarse.z;
    for (var rank = 1u; rank <= job.part_count; rank++) {
        var best = vec2u(0u);
        for (var i = lane; i < count; i += 64u) {
            let size = atomicLoad(&sizes[i]);
            best = select(best, vec2u(size, i), size > best.x && size < RANKED);
        }
        largest[lane] = best;
        workgroupBarrier();
        if lane == 0u {
            for (var k = 1u; k < 64u; k++) {
                let other = largest[k];
                let is_larger = other.x > best.x || (other.x == best.x && other.y < best.y);
                best = select(best, other, is_larger);
            }
            if best.x > 0u {
                atomicStore(&sizes[best.y], RANKED | rank);
            }
        }
        storageBarrier();
        workgroupBarrier();
    }
}

@compute @workgroup_size(4, 4, 4)
fn name_parts(@builtin(global_invocation_id) at: vec3u) {
    if any(at >= job.coarse.xyz) {
        return;
    }
    let own = owners[coarse_index(at)] & ~LINKS;
    var rank = 0u;
    if own != 0u {
        let size = atomicLoad(&sizes[own - 1u]);
        rank = select(0u, size & ~RANKED, size >= RANKED);
    }
    owners[coarse_index(at)] = rank;
}
