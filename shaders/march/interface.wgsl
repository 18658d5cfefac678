// The names that march/plain.wgsl, march/align.wgsl and march/baked.wgsl have in common. A program holds one of these
// three files.
//   KEEPS_TISSUE                       true if both sides of the surface of kept tissue take their normal from it
//   map_step()                         offset of finite differences of the map, subject units
//   object_from_subject(pos, mask)     where the material at a point was at rest; continuity below 0: no material
//   material_at(pos, mask)             as object_from_subject, with the templates that moved the material (the path)
//   map_along(pos, path)               the map by the templates of a path: smooth wherever material took that path
//   kept_surface(rest, path, jacobian, to_eye)    how a surface of kept tissue shows in material next to it
// needs: -

/// How the nearest surface of kept tissue shows in material next to that surface.
struct KeptSurface {
    /// Normal of the surface of the kept tissue, subject space, unit length.
    normal: vec3f,
    /// How much `normal` counts against the material's own normal, 0 (not at all) to 1 (alone).
    weight: f32,
    /// From the material away from the surface, so far that the label there is surely that of this side; rest space.
    inwards: vec3f,
}
