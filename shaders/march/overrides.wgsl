// What a pipeline is made for: whatever a picture does not use is compiled away.
// needs: -

/// 1 if the subject has labels.
override has_labels: u32 = 1u;
/// 1 if there is a skip grid to leap with.
override has_grid: u32 = 1u;
/// 1 if opacity follows the gradient.
override has_edges: u32 = 0u;
/// 1 if tissue is drawn as a ghost.
override has_ghost: u32 = 0u;
/// 1 if the edges of a mesh's triangles are drawn.
override has_wires: u32 = 0u;
/// 1 if a segment of meshes is a shell.
override has_shells: u32 = 1u;
/// 1 if the key light is a lamp of some width.
override has_lamp: u32 = 0u;
/// 1 if segments are drawn as bodies of their own.
override has_bodies: u32 = 0u;
/// 1 if objects stand in the scene.
override has_objects: u32 = 0u;
/// TEXTURES_ALONE or TEXTURES_REDUCED if meshes have pictures on their triangles.
override has_textures: u32 = 0u;
/// Pictures are taken as they are.
const TEXTURES_ALONE: u32 = 1u;
/// Where a pixel covers much of a picture, a smaller copy is taken.
const TEXTURES_REDUCED: u32 = 2u;
/// Taps of ambient occlusion, once per ray. More are smoother and cost a map and two texture reads each.
override occlusion_taps: u32 = 8u;
/// Taps towards the key light, once per ray.
override shadow_taps: u32 = 10u;
