// Group 2, binding 0: the templates. compose.wgsl reads it as a global, since 32 templates cannot go by value.
// needs: types.wgsl

/// Templates of the document, in order.
@group(2) @binding(0) var<uniform> templates: Templates;
