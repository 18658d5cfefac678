// Tissue drawn as a ghost: clear where it faces the eye and inside, so that what it surrounds is seen in its place,
// while its rims stay (context-preserving, after Bruckner et al. 2006, with the angle alone). What templates keep and
// segments that are drawn as bodies of their own stay as they are: they are what is shown.
// needs: types.wgsl bind/look.wgsl march/overrides.wgsl

/// How narrow the rims are that stay.
const RIM_POWER: f32 = 3.0;
/// Steepness of the value (of all values, or of the transfer table if that is wider, per voxel) from which on tissue
/// has a rim, and at which the rim is whole: grain inside has none.
const RIM_NONE: f32 = 0.03;
const RIM_FULL: f32 = 0.12;

/// The part of its opacity that a ghost keeps. `surfaceness`: 0 inside, 1 on a surface, whose normal is meant.
fn ghost_keeps(surfaceness: f32, normal: vec3f, to_eye: vec3f) -> f32 {
    let rim = pow(1.0 - clamp(dot(normal, to_eye), 0.0, 1.0), RIM_POWER);
    return mix(look.ghost, 1.0, rim * surfaceness);
}
