// What a ray found, whatever the kind of subject.
// needs: -

/// What a ray may meet (spec/surfaces.md, "What the object has at a point, and what a ray meets").
const MET_NOTHING: u32 = 0u;
const MET_SURFACE: u32 = 1u;
const MET_INSIDE: u32 = 2u;
const MET_CUT: u32 = 3u;
const MET_OBJECT: u32 = 4u;
const MET_VOLUME: u32 = 5u;

/// The first thing on a ray after which it is more than half opaque.
struct Event {
    /// Distance from the eye.
    t: f32,
    /// One of the constants above.
    what: u32,
    /// The segment of a mesh, whose triangles know it, or the object: from 1; 0 for none.
    segment: u32,
    /// Unit normal towards the eye, subject space; of a triangle that of its plane.
    normal: vec3f,
    /// Where the material was at rest, rest space.
    rest: vec3f,
    /// Colour before light, linear.
    albedo: vec3f,
}

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
    /// What the ray's surface is, one of the constants above.
    surface_what: u32,
    /// The segment or object there, as in `Event`.
    segment: u32,
    /// Where the ray turns more than half opaque.
    event: Event,
}
