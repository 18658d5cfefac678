// Group 2, binding 10: how the segments of a mesh are drawn.
// needs: types.wgsl

/// By segment; not read for volumes.
@group(2) @binding(10) var<uniform> mesh_look: MeshLook;
