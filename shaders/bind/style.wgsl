// Group 3 of the pass that draws a style: the style, and what each pixel shows.
// needs: types.wgsl

/// The style, in pixels of the picture.
@group(3) @binding(0) var<uniform> style: Style;
/// The picture without a style: linear, premultiplied.
@group(3) @binding(1) var traced_color: texture_2d<f32>;
/// xyz: where the tissue was at rest, rest space; w: distance from the eye, below 0 where nothing is.
@group(3) @binding(2) var traced_place: texture_2d<f32>;
/// x: the normal, y: segment and light, both as `surface_words` packs them.
@group(3) @binding(3) var traced_surface: texture_2d<u32>;
