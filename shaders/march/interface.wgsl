// The names that march/plain.wgsl, march/align.wgsl and march/baked.wgsl have in common. A program holds one of these
// three files.
//   KEEPS_TISSUE                       true if both sides of a surface of kept tissue take that surface's normal
//   map_step()                         offset of finite differences of the map, subject units
//   object_from_subject(pos, mask)     where the material at a point was at rest; continuity below 0: no material
//   material_at(pos, mask)             as object_from_subject, with the templates that moved the material (the path)
//   map_along(pos, path)               the map by the templates of a path; smooth where these moved the material
//   kept_surface(rest, path, jacobian, to_eye)    the normal that a surface of kept tissue gives to material beside it
//   side_at(rest)                      the side of surfaces of kept tissue that a point lies on
//   is_on_side(label, side)            true if a segment lies on that side
// needs: -

/// How the nearest surface of kept tissue changes the shading of material next to that surface.
struct KeptSurface {
    /// Normal of the surface of the kept tissue, subject space, unit length.
    normal: vec3f,
    /// How much `normal` counts against the material's own normal, 0 (not at all) to 1 (alone).
    weight: f32,
    /// Offset from a point of the material away from the surface, rest space. The offset is long enough that the label
    /// at its end belongs to the side of the surface on which the point lies.
    inwards: vec3f,
}
