// The composed inverse map of a document. The map applies the templates from the last to the first, each template in
// its own space (spec/templates.md, "Several templates").
//
//   rest  <-- T1 <-- T2 <-- T3 (add to T2) <-- T4  <-- subject (deformed, what the viewer shows)
//             |      '------.------'           |
//             |      one group: both at the    |
//             |      same point, D summed      |
//             '--- A = the smallest of all ----'
//
// D is the displacement of a template, A the continuity of the composed map.
//
// This file is an exception to the rule that library files read no globals. 32 templates cannot be passed by value, so
// the pass declares `templates: Templates` (group 2, binding 0) and this file reads that variable.
//
// `drawn_kinds` saves time on devices that run both sides of every branch, as software rasterisers do: the pipeline of
// a document leaves out the kinds that the document does not use. All ones, the default, serves every document. The
// text of such a program has no formulas of other kinds either (`without_formula`, src/displace/constants.rs), since
// compilers draw a formula into each place that asks the map before they see that its branch is never taken.
// needs: types.wgsl affine.wgsl kinds.wgsl bind/templates.wgsl displace/frame.wgsl displace/curve.wgsl
//   displace/poke.wgsl displace/twist.wgsl displace/wave.wgsl displace/bend.wgsl displace/squeeze.wgsl
//   displace/dilate.wgsl displace/peel.wgsl displace/flap.wgsl displace/split.wgsl displace/slices.wgsl
//   displace/retractor.wgsl displace/cutquad.wgsl displace/peeler.wgsl displace/pull.wgsl displace/cut.wgsl
//   displace/hole.wgsl displace/lens.wgsl displace/move.wgsl displace/rbf.wgsl displace/field.wgsl
//   displace/crack.wgsl displace/carve.wgsl displace/sweep.wgsl

/// Pipeline constant. Bit k is set if the document has a template of kind k; bit 0 is set if a template lies along a
/// curve.
override drawn_kinds: u32 = 0xffffffffu;

/// Where a point of the deformed object came from.
struct Mapped {
    /// Where the material was at rest, rest space.
    pos: vec3f,
    /// The smallest continuity of all templates, not capped; 1 without templates.
    continuity: f32,
}

/// The material that the composed map finds at a point of the deformed object.
struct Material {
    /// Where the material was at rest, rest space.
    pos: vec3f,
    /// Continuity of the composed map; below 0: there is no material.
    continuity: f32,
    /// In a document that keeps tissue, bit i is set if template i moved the material, and all bits are 0 if the
    /// material stayed where it was. In other documents, bit i is set if template i may have moved the material.
    path: u32,
}

/// Inverse displacement of one template, in the space of that template. `kind` is one of the KIND_ constants; a
/// template of an unknown kind leaves the point `q` where it is.
fn displace(kind: u32, q: vec3f, size: vec3f, p0: vec4f, p1: vec4f, held: u32) -> Displaced {
    var d = at_rest(q);
    switch kind {
        case KIND_POKE: {
            if (drawn_kinds & DRAWN_POKE) != 0u {
                d = displace_poke(q, size, p0, p1);
            }
        }
        case KIND_TWIST: {
            if (drawn_kinds & DRAWN_TWIST) != 0u {
                d = displace_twist(q, size, p0, p1);
            }
        }
        case KIND_WAVE: {
            if (drawn_kinds & DRAWN_WAVE) != 0u {
                d = displace_wave(q, size, p0, p1);
            }
        }
        case KIND_BEND: {
            if (drawn_kinds & DRAWN_BEND) != 0u {
                d = displace_bend(q, size, p0, p1);
            }
        }
        case KIND_SQUEEZE: {
            if (drawn_kinds & DRAWN_SQUEEZE) != 0u {
                d = displace_squeeze(q, size, p0, p1);
            }
        }
        case KIND_DILATE: {
            if (drawn_kinds & DRAWN_DILATE) != 0u {
                d = displace_dilate(q, size, p0, p1);
            }
        }
        case KIND_PEEL: {
            if (drawn_kinds & DRAWN_PEEL) != 0u {
                d = displace_peel(q, size, p0, p1);
            }
        }
        case KIND_FLAP: {
            if (drawn_kinds & DRAWN_FLAP) != 0u {
                d = displace_flap(q, size, p0, p1);
            }
        }
        case KIND_SPLIT: {
            if (drawn_kinds & DRAWN_SPLIT) != 0u {
                d = displace_split(q, size, p0, p1);
            }
        }
        case KIND_SLICES: {
            if (drawn_kinds & DRAWN_SLICES) != 0u {
                d = displace_slices(q, size, p0, p1);
            }
        }
        case KIND_RETRACTOR: {
            if (drawn_kinds & DRAWN_RETRACTOR) != 0u {
                d = displace_retractor(q, size, p0, p1);
            }
        }
        case KIND_CUTQUAD: {
            if (drawn_kinds & DRAWN_CUTQUAD) != 0u {
                d = displace_cutquad(q, size, p0, p1);
            }
        }
        case KIND_PEELER: {
            if (drawn_kinds & DRAWN_PEELER) != 0u {
                d = displace_peeler(q, size, p0, p1);
            }
        }
        case KIND_PULL: {
            if (drawn_kinds & DRAWN_PULL) != 0u {
                d = displace_pull(q, size, p0, p1);
            }
        }
        case KIND_CUT: {
            if (drawn_kinds & DRAWN_CUT) != 0u {
                d = displace_cut(q, size, p0, p1);
            }
        }
        case KIND_HOLE: {
            if (drawn_kinds & DRAWN_HOLE) != 0u {
                d = displace_hole(q, size, p0, p1);
            }
        }
        case KIND_LENS: {
            if (drawn_kinds & DRAWN_LENS) != 0u {
                d = displace_lens(q, size, p0, p1);
            }
        }
        case KIND_MOVE: {
            if (drawn_kinds & DRAWN_MOVE) != 0u {
                d = displace_move(q, size, p0, p1);
            }
        }
        case KIND_RBF: {
            if (drawn_kinds & DRAWN_RBF) != 0u {
                d = displace_rbf(q, size, p0, p1, held);
            }
        }
        case KIND_FIELD: {
            if (drawn_kinds & DRAWN_FIELD) != 0u {
                d = displace_field(q, size, p0, p1, held);
            }
        }
        case KIND_CRACK: {
            if (drawn_kinds & DRAWN_CRACK) != 0u {
                d = displace_crack(q, size, p0, p1);
            }
        }
        case KIND_CARVE: {
            if (drawn_kinds & DRAWN_CARVE) != 0u {
                d = displace_carve(q, size, p0, p1, held);
            }
        }
        case KIND_SWEEP: {
            if (drawn_kinds & DRAWN_SWEEP) != 0u {
                d = displace_sweep(q, size, p0, p1, held);
            }
        }
        default: {}
    }
    return d;
}

/// Displacement and continuity of template i at a point `q` of the template's straight box. The member `source` of the
/// result holds the displacement: the place that the material came from, less `q`.
fn shifted(i: u32, q: vec3f, p0: vec4f) -> Displaced {
    let kind = templates.items[i].kind;
    let size = templates.items[i].size.xyz;
    let p1 = templates.items[i].params1;
    let held = templates.items[i].held;
    let first = templates.items[i].curve;
    var own = vec4f(q, 1.0);
    if (drawn_kinds & DRAWN_CURVES) != 0u {
        if first != 0u {
            own = unbend(first, size, q);
        }
    }
    // The only call: compilers draw all formulas into each place that asks for them.
    let d = displace(kind, own.xyz, size, p0, p1, held);
    if (drawn_kinds & DRAWN_CURVES) != 0u {
        if first != 0u {
            // If the template does not displace the point, the result is exactly 0, without the rounding of `bend`.
            let is_moved = own.w > 0.5 && any(d.source != own.xyz);
            let by = bend(first, size, d.source) - q;
            return Displaced(select(vec3f(0.0), by, is_moved), select(1.0, d.continuity, own.w > 0.5));
        }
    }
    return Displaced(d.source - q, d.continuity);
}

/// Maps a point of subject space to rest space. Bit i of `mask` is set if template i may reach the point; templates
/// whose bit is 0 are not evaluated. Without a skip grid, all bits are 1. Bits past the last template are ignored.
fn rest_from_subject(pos: vec3f, mask: u32) -> Mapped {
    let count = min(templates.count, 32u);
    // WGSL does not define a shift by 32 bits. So the shift is taken modulo 32, and `select` treats a document without
    // templates.
    var left = select(0u, mask & (0xffffffffu >> ((32u - count) & 31u)), count > 0u);
    var at = pos;
    var sum = vec3f(0.0);
    var continuity = NO_END;
    var group = 0xffffffffu;
    while left != 0u {
        let i = firstLeadingBit(left);
        left &= ~(1u << i);
        let head = templates.items[i].group;
        // The loop runs from the last template to the first. All templates of a group start from the same point: the
        // point to which the later groups of the list led.
        if head != group {
            at += sum;
            sum = vec3f(0.0);
            group = head;
        }
        let q = apply_affine(templates.items[i].template_from_subject, at);
        let d = shifted(i, q, templates.items[i].params0);
        // Only the displacement is transformed back to subject space, not the point. So a template that displaces
        // nothing leaves the point exactly unchanged, wherever the template is placed.
        let moved = d.source;
        sum += apply_linear(templates.items[i].subject_from_template, moved);
        continuity = min(continuity, d.continuity);
    }
    return Mapped(at + sum, select(continuity, 1.0, group == 0xffffffffu));
}
