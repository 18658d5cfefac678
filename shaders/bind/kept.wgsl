// Group 2, bindings 5, 6 and 14: what templates leave alone.
// needs: types.wgsl

/// Sets of kept tissue and who keeps them.
@group(2) @binding(5) var<uniform> kept: Kept;
/// Signed distance to each set, positive outside it, subject units, in slabs (see `Kept`).
@group(2) @binding(6) var distances: texture_3d<f32>;
/// Share of each set at each label voxel, 0 to 1 (pass/shares.wgsl); sets beyond its channels have none.
@group(2) @binding(14) var kept_shares: texture_3d<f32>;
