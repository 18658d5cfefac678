// Group 3, in programs that draw with the baked map: the map as a texture.
// needs: types.wgsl

/// Where the texture lies.
@group(3) @binding(0) var<uniform> baked: Baked;
/// xyz: from a point of the deformed object to where it was, subject units; w: the composed continuity, -1 to 1.
@group(3) @binding(1) var baked_map: texture_3d<f32>;
