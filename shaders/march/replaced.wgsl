// Where the bodies of meshes take the place of the volume around them (spec/surfaces.md, "What the object has at a
// point"): what fills a place first is what is there.
// This file defines the same functions as march/whole.wgsl.
// needs: bind/mesh_look.wgsl displace/compose.wgsl march/filling.wgsl march/cover.wgsl

/// True where something else is in the volume's place, at a point of rest space.
fn is_replaced(rest: vec3f) -> bool {
    var found = false;
    // A loop, which software rasterisers leave out where they would run a branch.
    for (var turn = mesh_look.has_filled; turn > 0u; turn = 0u) {
        found = filled_at(rest) != 0u;
    }
    return found;
}

/// How much of the light at a place other parts of the subject take, 0 to 1.
fn cover_beside(at: Material) -> f32 {
    return mesh_cover(at);
}
