// Group 2, bindings 0 and 7: the templates. compose.wgsl reads it as a global, since 32 templates cannot go by value.
// needs: types.wgsl

/// Templates of the document, in order.
@group(2) @binding(0) var<uniform> templates: Templates;
/// Sampled displacements of all fields, one behind the other along z: xyz displacement (template space), w continuity.
@group(2) @binding(7) var fields: texture_3d<f32>;
