// Places in a slice, and what the deformed object has there.
// needs: types.wgsl affine.wgsl bind/slice.wgsl

/// Half the width of the line of a surface, pixels (spec/surfaces.md, "Alignment, constraints, labels": 1.5 points).
const SLICE_LINE: f32 = 0.75;
/// How much of its colour the line of a surface has.
const SLICE_SURFACE: f32 = 0.3;

/// What the object has at a point.
struct Here {
    /// Where the material was at rest, rest space.
    pos: vec3f,
    /// Normalised value, 0 to 1.
    texel: f32,
    /// As composed; below 0 in a gap.
    continuity: f32,
    /// Number of the segment, 0 for none.
    label: u32,
    /// False in a gap and outside the volume.
    is_there: bool,
}

/// Subject space from a place in the slice (pixels, origin top left).
fn subject_from_pixel(pixel: vec2f) -> vec3f {
    return apply_affine(slice.subject_from_pixel, vec3f(pixel, 0.0));
}
