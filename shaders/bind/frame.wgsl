// Group 0: what changes with every picture.
// needs: types.wgsl

/// Camera, sampling and light of the picture that is drawn.
@group(0) @binding(0) var<uniform> frame: Frame;
