// Group 3 of slices.
// needs: types.wgsl

/// The plane and how it is shown.
@group(3) @binding(0) var<uniform> slice: Slice;
