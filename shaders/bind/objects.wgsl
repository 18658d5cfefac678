// Group 2, bindings 11 and 12: the objects of the scene.
// needs: types.wgsl

/// Where they lie and how they look.
@group(2) @binding(11) var<uniform> objects: SceneObjects;
/// Trees and triangles of their meshes as in `mesh_texels`, one mesh behind the other.
@group(2) @binding(12) var object_texels: texture_2d<u32>;
