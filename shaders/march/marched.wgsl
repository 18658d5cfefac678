// What a ray found, whatever the kind of subject.
// needs: -

/// What a ray found.
struct Marched {
    /// Linear premultiplied RGBA, 0 to 1.
    color: vec4f,
    /// The ray's surface: distance from the eye, below 0 if there is none.
    surface_t: f32,
    /// Unit normal towards the eye, subject space.
    surface_normal: vec3f,
    /// The tissue at the ray's surface, rest space.
    surface_rest: vec3f,
    /// The segment at the ray's surface, 0 for none; of meshes, whose triangles know it.
    segment: u32,
}
