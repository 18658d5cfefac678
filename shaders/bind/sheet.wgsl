// Group 3 of the pass that draws a figure: where its plate lies, and the plate.
// needs: types.wgsl

/// The plate, and the target that is drawn into.
@group(3) @binding(0) var<uniform> sheet: Sheet;
/// The plate's pixels and its smaller copies: straight sRGB with alpha. Where a sample is laid down: that sample.
@group(3) @binding(1) var plate: texture_2d<f32>;
