// What the object has at a point where every template moves everything: the map alone. Stands in for march/align.wgsl,
// function by function, in the programs of documents that keep no tissue, which so hold nothing of alignment.
// needs: types.wgsl displace/compose.wgsl march/interface.wgsl

/// True where both sides of the surface of kept tissue are lit by it.
const KEEPS_TISSUE: bool = false;

/// Offset of finite differences of the map, subject units: small against every bend, large against the rounding of f32.
fn map_step() -> f32 {
    return 0.0005;
}

/// What the object has at a point of subject space: where it was at rest; a continuity below 0 where there is nothing.
fn object_from_subject(pos: vec3f, mask: u32) -> Mapped {
    return rest_from_subject(pos, mask);
}

/// The same with the path.
fn material_at(pos: vec3f, mask: u32) -> Material {
    let mapped = object_from_subject(pos, mask);
    return Material(mapped.pos, mapped.continuity, mask);
}

/// The map along a path: smooth wherever material follows that path.
fn map_along(pos: vec3f, path: u32) -> Mapped {
    return rest_from_subject(pos, path);
}

/// None here.
fn kept_surface(_rest: vec3f, _path: u32, _jacobian: mat3x3f, to_eye: vec3f) -> KeptSurface {
    return KeptSurface(to_eye, 0.0, vec3f(0.0));
}
