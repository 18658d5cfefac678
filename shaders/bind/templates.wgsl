// Group 2, bindings 0, 7, 13 and 15: the templates. compose.wgsl reads them as globals, since 32 templates cannot go by
// value.
// needs: types.wgsl

/// Templates of the document, in order.
@group(2) @binding(0) var<uniform> templates: Templates;
/// Sampled displacements of all fields, one behind the other along z: xyz displacement (template space), w continuity.
@group(2) @binding(7) var fields: texture_3d<f32>;
/// Grids of all objects that carve, one node behind the other (data/surface/carver.rs): in the upper 20 bits the
/// distance, in the lower 12 how far tissue may be pushed.
@group(2) @binding(13) var carvers: texture_2d<u32>;
/// Grids of tools (displace/tools.wgsl), then the steps of all sweeps, one behind the other (displace/sweep.wgsl).
@group(2) @binding(15) var sweeps: texture_2d<f32>;
