// Group 1: the uploaded subject.
// needs: types.wgsl

/// Where the textures lie and what their numbers mean.
@group(1) @binding(0) var<uniform> subject: Subject;
/// Scalars, r16float, normalised by the value range; of meshes depths under the surface, subject units.
@group(1) @binding(1) var volume: texture_3d<f32>;
/// Linear, clamped to the edge.
@group(1) @binding(2) var linear_sampler: sampler;
/// Segment numbers, r8uint; one voxel of 0 if there are none.
@group(1) @binding(3) var labels: texture_3d<u32>;
/// Colour of each of the 256 segments, linear when read; alpha 0 where none is known.
@group(1) @binding(4) var palette: texture_2d<f32>;
/// Tree, triangles and sets of segments of meshes, rgba32uint, in rows of 4096 texels; one texel of 0 where there are
/// none.
@group(1) @binding(5) var mesh_texels: texture_2d<u32>;
/// Depths under the surface of meshes, r16float, subject units; of meshes alone the same as `volume`.
@group(1) @binding(6) var mesh_depths: texture_3d<f32>;
/// Which set of segments fills a voxel of that field, its margin left out, r8uint.
@group(1) @binding(7) var mesh_fills: texture_3d<u32>;
