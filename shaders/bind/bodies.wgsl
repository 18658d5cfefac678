// Group 2, bindings 8 and 9: segments that are drawn as bodies of their own.
// needs: types.wgsl

/// How each segment is drawn.
@group(2) @binding(8) var<uniform> bodies: Bodies;
/// How much of a place belongs to bodies (x), the same times their opacity (y), to solid ones (z), to hidden ones (w).
/// Over the box of the labels, smoothed over a voxel.
@group(2) @binding(9) var body_shares: texture_3d<f32>;
