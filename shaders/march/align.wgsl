// What the object has at a point where templates leave tissue alone or give way to it. Stands in for march/plain.wgsl,
// function by function. Four ideas, a file each: what is kept (kept.wgsl), how displacements give way (constrain.wgsl),
// the ways of asking (asked.wgsl), the surfaces of kept tissue (kept_surface.wgsl).
// needs: types.wgsl bind/templates.wgsl displace/frame.wgsl displace/compose.wgsl march/kept.wgsl march/constrain.wgsl
//   march/asked.wgsl march/kept_surface.wgsl

/// True if both sides of the surface of kept tissue take their normal from that surface.
const KEEPS_TISSUE: bool = true;

/// Offset of finite differences of the map, subject units: small against every bend, large against the rounding of f32.
fn map_step() -> f32 {
    return 0.0005;
}

/// True if a template keeps the material that was at a point of rest space.
fn is_kept_by_any(rest: vec3f) -> bool {
    var keeps = 0u;
    var depth = 1e4;
    for (var i = 0u; i < min(templates.count, MAX_TEMPLATES); i++) {
        keeps |= kept.items[i].keeps;
        let is_deep = (kept.items[i].keeps & KEEPS_DEEP) != 0u;
        depth = select(depth, min(depth, kept.items[i].depth), is_deep);
    }
    return is_kept(rest, keeps, depth);
}

/// What the object has at a point of subject space. Bit i of `mask`: template i may reach it.
fn material_at(pos: vec3f, mask: u32) -> Material {
    let count = min(templates.count, 32u);
    let every = select(0u, 0xffffffffu >> ((32u - count) & 31u), count > 0u);
    if align_mode == 1u || align_mode == 4u {
        return grouped(pos, mask & every);
    }
    if align_mode == 2u {
        return chained(pos, mask & every);
    }
    if align_mode == 3u {
        return asked(pos, mask & every);
    }
    let mapped = rest_from_subject(pos, mask);
    return Material(mapped.pos, mapped.continuity, mask & every);
}

/// What the object has at a point of subject space: where it was at rest; a continuity below 0 where there is nothing.
fn object_from_subject(pos: vec3f, mask: u32) -> Mapped {
    let found = material_at(pos, mask);
    return Mapped(found.pos, found.continuity);
}

/// The map along a path that was found: smooth wherever material follows that path. What stayed where it was has none.
fn map_along(pos: vec3f, path: u32) -> Mapped {
    if has_constraints == 0u {
        return rest_from_subject(pos, path);
    }
    var left = path;
    var at = Mapped(pos, NO_END);
    while left != 0u {
        let head = templates.items[firstLeadingBit(left)].group;
        let bits = left & (0xffffffffu << head);
        left &= ~bits;
        let moved = group_map(at.pos, head, bits);
        at = Mapped(moved.pos, min(at.continuity, moved.continuity));
    }
    return Mapped(at.pos, select(at.continuity, 1.0, path == 0u));
}
