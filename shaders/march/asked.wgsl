// Three ways of asking what the object has at a point when templates leave tissue alone (spec/contract.md, "Meaning" of
// `align`; Correa, eq. 5.9).
//
// Let O0 be the untouched object and Oi the object after template i:
//   Oi(x) = Oi-1(x)        if that is tissue that i keeps                        (it stays)
//         = nothing        if Ti opened a gap at x, or Oi-1(Ti(x)) is tissue that
//                          i keeps                                               (it was taken away, or stands
//                          elsewhere)
//         = Oi-1(Ti(x))    otherwise                                             (it moved)
//
// A direct recursion makes up to 2^n evaluations for n templates, and WGSL has no recursion. Three facts make it short:
// - A template that keeps nothing has one case: the chain of compose.wgsl.
// - Where Ti(x) = x and there is no gap, all three cases agree on Oi-1(x).
// - A run is a row of templates, a to b, that keep the same. Tissue kept by them never moves in the run, and none of it
//   gets to where it was not (by induction: the first case leaves it, the second takes away what would come from it).
//   So the question "does Oi-1(x) have kept tissue" has one answer for every i of the run, that of Oa-1(x): it is asked
//   below the run, at x itself. With one set at the bottom of the list Oa-1 is the object at rest, and the whole
//   document is a chain that tests the label at each point on its way:
//
//     x  kept? -> it stays      p = Tb(x)  kept? -> nothing     p = Tb-1(p)  kept? -> nothing    ...
//
// `align_mode` 1 is one group alone: two questions without a loop. 4 is the same where the group gives way to tissue
// and keeps none: no question. 2 is the chain: one set, nothing below it. 3 is the general case: a stack of open
// questions. A question is open in its first case (what does Oa-1 have at x itself) or in its last (what does Oi-1 have
// at Ti(x)). An `add` group counts as one template and keeps what any of its members keeps.
//
// `Material.path` is the set of templates that moved what was found: the map along that path is smooth where the object
// is, so that Jacobians and gradients of the continuity are taken along it.
//
// Differs from the source: holds for lists of templates.
// needs: types.wgsl bind/templates.wgsl bind/kept.wgsl displace/frame.wgsl displace/compose.wgsl march/kept.wgsl
//   march/constrain.wgsl

/// Open questions at most; a template that would open one more is taken as if it kept nothing. So many alignments that
/// all reach one point and all differ from the one before do not occur.
const MAX_OPEN: u32 = 12u;

/// The templates of a mask that come before the one of this index.
fn below(mask: u32, level: u32) -> u32 {
    return mask & ~(0xffffffffu << level);
}

/// Align modes 1 and 4: the list is one group. Both questions are asked everywhere: devices that run both sides of
/// every branch ask them anyhow, and have no loop to walk.
fn grouped(pos: vec3f, mask: u32) -> Material {
    let item = kept.items[0];
    let moved = group_map(pos, 0u, mask);
    let keeps = align_mode == 1u;
    let stays = mask == 0u || (keeps && is_kept(pos, item.keeps, item.depth));
    let stands_elsewhere = keeps && is_kept(moved.pos, item.keeps, item.depth);
    let continuity = select(moved.continuity, -1.0, stands_elsewhere);
    return Material(select(moved.pos, pos, stays), select(continuity, 1.0, stays), select(mask, 0u, stays));
}

/// Align mode 2: the first templates of the list keep the same, the others keep nothing.
fn chained(pos: vec3f, mask: u32) -> Material {
    var left = mask;
    var at = Material(pos, NO_END, 0u);
    var head = templates.items[firstLeadingBit(max(left, 1u))].group;
    var item = kept.items[head];
    if left != 0u && item.keeps != 0u && is_kept(pos, item.keeps, item.depth) {
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
        // One question serves both: does what moved come from where tissue stands still, and does the next template
        // leave it alone.
        let keeps_too = item.keeps != 0u;
        head = templates.items[firstLeadingBit(max(left, 1u))].group;
        let next = kept.items[head];
        let asks = select(left != 0u && next.keeps != 0u, !is_same, keeps_too);
        if !keeps_too {
            item = next;
        }
        if at.continuity < 0.0 {
            break;
        }
        if asks && is_kept(at.pos, item.keeps, item.depth) {
            at.continuity = select(at.continuity, -1.0, keeps_too);
            break;
        }
    }
    at.continuity = select(at.continuity, 1.0, at.path == 0u);
    return at;
}

/// Align mode 3, the general case: a stack of open questions, as the head of this file explains. `pos` in subject
/// space.
fn asked(pos: vec3f, mask: u32) -> Material {
    // Open questions: the point at which each goes on, and the continuity and the path found on the way so far.
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
            let item = kept.items[head];
            if item.keeps != 0u && !is_same && open < MAX_OPEN {
                open_pos[open] = vec4f(moved.pos, moved.continuity);
                open_continuity[open] = at.continuity;
                open_path[open] = at.path;
                open_bits[open] = bits;
                open_head[open] = head;
                open_is_last[open] = 0u;
                open++;
                left = below(mask, item.run);
            } else {
                at.pos = moved.pos;
                at.continuity = min(at.continuity, moved.continuity);
                at.path |= bits;
                if at.continuity < 0.0 {
                    left = 0u;
                }
            }
        }
        // Carries the answer back up to the questions that wait for it.
        var goes_down = false;
        while open > 0u && !goes_down {
            let top = open - 1u;
            let item = kept.items[open_head[top]];
            let kept = at.continuity >= 0.0 && is_kept(at.pos, item.keeps, item.depth);
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
