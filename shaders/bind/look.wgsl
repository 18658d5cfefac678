// Group 2, bindings 1 and 2: the look.
// needs: types.wgsl

/// Transfer function and modes.
@group(2) @binding(1) var<uniform> look: Look;
/// Transfer table: linear RGB, and in alpha the opacity of 0.01 subject units.
@group(2) @binding(2) var lut: texture_2d<f32>;
