// Group 3, binding 0 of the passes that make distances to kept tissue.
// needs: types.wgsl

/// The job: sizes, sets and axis (see types.wgsl).
@group(3) @binding(0) var<uniform> job: DistanceJob;
