// Group 0: what changes with every picture.
// needs: types.wgsl

/// Camera and sampling.
@group(0) @binding(0) var<uniform> frame: Frame;
