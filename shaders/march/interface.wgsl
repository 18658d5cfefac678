// What march/plain.wgsl, march/align.wgsl and march/baked.wgsl answer with. They stand in for each other and have the
// same names:
//   KEEPS_TISSUE                       true where both sides of the surface of kept tissue are lit by it
//   map_step()                         offset of finite differences of the map, subject units
//   object_from_subject(pos, mask)     where a point of the deformed object was at rest; continuity below 0: nothing is
//   there
//   material_at(pos, mask)             that, and the templates on the way
//   map_along(pos, path)               the map by the templates of a path: smooth wherever material follows that path
//   kept_surface(rest, path, jacobian, to_eye)    how the surface of kept tissue shows at a point next to it
// needs: -

/// How the surface of kept tissue shows in a piece of material next to it.
struct KeptSurface {
    /// Subject space, unit.
    normal: vec3f,
    /// 0 to 1.
    weight: f32,
    /// Rest space: from the place to where it is surely this side's tissue.
    inwards: vec3f,
}
