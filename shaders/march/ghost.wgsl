// Tissue drawn as a ghost: clear where it faces the eye and inside, so that what it surrounds is seen in its place,
// while its rims stay (context-preserving, after Bruckner et al. 2006, with the angle alone). What templates keep and
// segments that are drawn as bodies of their own stay as they are: they are what is shown.
// needs: types.wgsl bind/look.wgsl march/overrides.wgsl

/// The part of its opacity that a ghost keeps. `surfaceness`: 0 inside, 1 on a surface, whose normal is meant.
fn ghost_keeps(surfaceness: f32, normal: vec3f, to_eye: vec3f) -> f32 {
    let facing = clamp(dot(normal, to_eye), 0.0, 1.0);
    return mix(1.0, look.ghost, mix(1.0, facing, surfaceness));
}
