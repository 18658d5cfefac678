// What the object has at a point, read from the baked map: one texture read, however many templates there are. Stands
// in for march/plain.wgsl, function by function. Exact but for interpolation where the map is smooth; within a texel of
// a cut or of a rest end it mixes both sides, so it is for pictures that move.
// Source: Correa, section 4.3 (displacement textures) and 6.2 (their error).
// needs: types.wgsl bind/subject.wgsl bind/baked.wgsl displace/compose.wgsl march/interface.wgsl subject/label.wgsl

/// True if both sides of the surface of kept tissue take their normal from that surface.
const KEEPS_TISSUE: bool = false;

/// Offset of finite differences of the map, subject units: about a texel, for between texels it is a straight line.
fn map_step() -> f32 {
    return baked.map_step;
}

/// True if a template keeps the material that was at a point of rest space.
fn is_kept_by_any(_rest: vec3f) -> bool {
    return false;
}

/// What the object has at a point of subject space. Cells that no template reaches are exact.
fn object_from_subject(pos: vec3f, mask: u32) -> Mapped {
    let found = textureSampleLevel(baked_map, linear_sampler, (pos - baked.origin_min.xyz) * baked.per_unit.xyz, 0.0);
    let moved = select(found, vec4f(0.0, 0.0, 0.0, 1.0), mask == 0u);
    return Mapped(pos + moved.xyz, moved.w);
}

/// As `object_from_subject`; the path holds all templates of `mask`.
fn material_at(pos: vec3f, mask: u32) -> Material {
    let mapped = object_from_subject(pos, mask);
    return Material(mapped.pos, mapped.continuity, mask);
}

/// The map along a path.
fn map_along(pos: vec3f, path: u32) -> Mapped {
    return object_from_subject(pos, path);
}

/// No surface of kept tissue: weight 0.
fn kept_surface(_rest: vec3f, _path: u32, _jacobian: mat3x3f, to_eye: vec3f) -> KeptSurface {
    return KeptSurface(to_eye, 0.0, vec3f(0.0));
}

/// Returns 0, since the baked map knows no surface of kept tissue.
fn side_at(_rest: vec3f) -> u32 {
    return 0u;
}

/// True for all segments: all lie on the same side.
fn is_on_side(_label: u32, _side: u32) -> bool {
    return true;
}

/// Label of a point of rest space.
fn label_here(rest: vec3f) -> u32 {
    return nearest_label(rest);
}
