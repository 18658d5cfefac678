// The material at a point of the object in documents that keep no tissue: every template moves all tissue, so the
// composed map alone determines the material. This file defines the same functions as march/align.wgsl and replaces
// that file in the programs for such documents.
// needs: types.wgsl displace/compose.wgsl march/interface.wgsl subject/label.wgsl

/// True if both sides of the surface of kept tissue take their normal from that surface.
const KEEPS_TISSUE: bool = false;

/// Offset of finite differences of the map, subject units: much smaller than any bend of the map, much larger than the
/// rounding error of f32.
fn map_step() -> f32 {
    return 0.0005;
}

/// Where the material at a point of subject space was at rest; a continuity below 0 if there is no material.
fn object_from_subject(pos: vec3f, mask: u32) -> Mapped {
    return rest_from_subject(pos, mask);
}

/// As `object_from_subject`; the path holds all templates of `mask`.
fn material_at(pos: vec3f, mask: u32) -> Material {
    let mapped = object_from_subject(pos, mask);
    return Material(mapped.pos, mapped.continuity, mask);
}

/// True if a template keeps the material that was at a point of rest space.
fn is_kept_by_any(_rest: vec3f) -> bool {
    return false;
}

/// The map by the templates of `path` alone. This map is smooth wherever exactly these templates moved the material.
fn map_along(pos: vec3f, path: u32) -> Mapped {
    return rest_from_subject(pos, path);
}

/// Returns weight 0, since no document of this program has a surface of kept tissue.
fn kept_surface(_rest: vec3f, _path: u32, _jacobian: mat3x3f, to_eye: vec3f) -> KeptSurface {
    return KeptSurface(to_eye, 0.0, vec3f(0.0));
}

/// Returns 0, since no document of this program has a surface of kept tissue.
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
