// Structs that Rust fills in, mirrored in order by src/render/gpu_types.rs (tests/layout.rs compares them).
// No vec3 here: rows of four.
// needs: -

/// Templates of one document at most (spec/contract.md, "Limits").
const MAX_TEMPLATES: u32 = 32u;

/// How a template joins the list.
const MODE_COMPOSE: u32 = 0u;
const MODE_ADD: u32 = 1u;

/// One placed template, ready for the shaders: enabled, of a known kind.
struct Template {
    /// Rows of the affine that takes subject space to template space (the unit cube).
    template_from_subject_row0: vec4f,
    template_from_subject_row1: vec4f,
    template_from_subject_row2: vec4f,
    /// Rows of the affine that takes template space to subject space.
    subject_from_template_row0: vec4f,
    subject_from_template_row1: vec4f,
    subject_from_template_row2: vec4f,
    /// xyz: side lengths, subject units, of the box that the template acts in; w: along x of the straight box where it lies along a curve.
    size: vec4f,
    /// Parameters in the order of the catalogue, flags 0 or 1, choices as index. The last is an index in the pool for kinds that use it.
    params0: vec4f,
    params1: vec4f,
    /// Number of the kind (TemplateKind).
    kind: u32,
    /// MODE_COMPOSE or MODE_ADD; the first of the list always composes.
    mode: u32,
    /// Index of its curve in the pool, 0 if it is straight.
    flags: u32,
    /// Index of the composing template that heads its `add` group (its own if it composes).
    group: u32,
}

/// All templates that act, in the order in which they act on the object.
struct Templates {
    items: array<Template, 32>,
    /// x: how many of them count.
    count: vec4u,
    /// What templates hold besides parameters (displace/rbf.wgsl, displace/field.wgsl, displace/curve.wgsl).
    pool: array<vec4f, 640>,
}

/// One picture's camera and sampling.
struct Frame {
    /// Rows of the affine that takes view space to subject space.
    subject_from_view_row0: vec4f,
    subject_from_view_row1: vec4f,
    subject_from_view_row2: vec4f,
    /// xy: tangent of half the field of view across width and height; zw: width and height of the whole picture, pixels.
    lens: vec4f,
    /// xy: where in the pixel the ray goes through (0 to 1); z: offset of the first step, in steps (0 to 1); w: turn of the
    /// ambient occlusion taps, radians.
    jitter: vec4f,
    /// Box of the deformed object, subject space; w: step, subject units.
    bounds_min: vec4f,
    /// w: reserved.
    bounds_max: vec4f,
    /// Pick pass only: xy is the pixel asked for.
    pick: vec4f,
}

/// The uploaded volume.
struct Subject {
    /// Rows of the affine that takes rest space to texture space of the volume.
    texture_from_rest_row0: vec4f,
    texture_from_rest_row1: vec4f,
    texture_from_rest_row2: vec4f,
    /// Rows of the affine that takes rest space to texture space of the label volume.
    label_from_rest_row0: vec4f,
    label_from_rest_row1: vec4f,
    label_from_rest_row2: vec4f,
    /// xyz: voxels along each axis; w: smallest voxel spacing, subject units.
    dims: vec4f,
    /// xyz: label voxels along each axis; w: 1 if there are labels.
    label_dims: vec4f,
    /// xyz: texture coordinate at which the volume ends (1 unless it was reduced and its last voxel is a part of one).
    texture_end: vec4f,
    /// x: value where the texture holds 0; y: value range; the value is x + y * texel.
    value: vec4f,
}

/// Transfer function, light and opacity.
struct Look {
    /// Position in the table = x * texel + y (clamped); z: how much segments tint (0 to 1); w: specular strength.
    lut: vec4f,
    /// x: OPACITY_ mode.
    modes: vec4u,
    /// x: how much opacity follows the steepness of the value, 0 to 1.
    edges: vec4f,
}

/// Segments drawn as bodies of their own.
struct Bodies {
    /// Of each label: linear RGB, and the opacity (see BODY_LAYER); w below 0: it is no body, its values say how it looks.
    items: array<vec4f, 256>,
}

/// A layer so thick is as opaque as a body's opacity says, subject units.
const BODY_LAYER: f32 = 0.05;
/// Opacities from which a body is solid, and below which it is hidden.
const BODY_SOLID: f32 = 0.995;
const BODY_HIDDEN: f32 = 0.005;

/// How opacity follows the deformation.
const OPACITY_CONSTANCY: u32 = 0u;
const OPACITY_MASS: u32 = 1u;
const OPACITY_NONE: u32 = 2u;

/// The grid over the deformed space.
struct Grid {
    /// xyz: lowest corner, subject space.
    origin_min: vec4f,
    /// xyz: side lengths of a cell, subject units.
    cell_size: vec4f,
    /// xyz: cells along each axis; w: 1 if in use, 0: every cell is visible and every template reaches it.
    cells: vec4u,
}

/// The baked map: a texture over the deformed space.
struct Baked {
    /// xyz: lowest corner, subject space; w: offset for finite differences of the map, subject units.
    origin_min: vec4f,
    /// xyz: one over the sides of the whole box, subject units.
    per_unit: vec4f,
    /// xyz: texels along each axis; w: the first slab of those that are being made.
    texels: vec4u,
}

/// From the accumulated picture to the one that is shown.
struct Resolve {
    /// xy: scale from pixel of the output to texture coordinate of the source; zw: largest texture coordinate in use.
    scale: vec4f,
    /// Linear RGB of the background; w: 1 if there is one, 0 transparent.
    background: vec4f,
    /// x: 1 to write straight alpha instead of premultiplied.
    flags: vec4u,
}

/// A flat cut through the deformed object.
struct Slice {
    /// Rows of the affine that takes pixels of the slice (origin top left, z is not used) to subject space.
    subject_from_pixel_row0: vec4f,
    subject_from_pixel_row1: vec4f,
    subject_from_pixel_row2: vec4f,
    /// Grey level = x * texel + y.
    window: vec4f,
    /// Linear RGB where nothing is.
    background: vec4f,
    /// x: SLICE_ mode; y: samples per pixel along each side.
    modes: vec4u,
}

/// How a slice is shown.
const SLICE_GREY: u32 = 0u;
const SLICE_COLORS: u32 = 1u;

/// What a template reaches, for the making of the grid. Template space, of the straight box; a side without an end is at 1e30.
struct GridTemplate {
    /// First box; w of its lowest corner: half side of the largest box in which differences tell how the map changes.
    reach0_min: vec4f,
    reach0_max: vec4f,
    /// Second box. Where the template lies along a curve: w of its lowest corner is how much longer a step can be in its own space than
    /// in the straight one, w of its highest the longest way of any material, subject units; else 1 and 0.
    reach1_min: vec4f,
    reach1_max: vec4f,
    /// First box in the template's own space.
    own_min: vec4f,
    own_max: vec4f,
    /// Least shift of material; w: MATERIAL_ (0 shifted, 1 taken out of the cube, 2 bent, 3 rippled).
    shift_min: vec4f,
    /// Greatest shift, or how far the map departs from its differences (rippled); w: 1 if the map jumps at the faces of the first box.
    shift_max: vec4f,
}

/// One making of the grid.
struct GridJob {
    /// xyz: lowest corner, subject space; w: how far beyond its sides a cell is looked at, subject units.
    origin_min: vec4f,
    /// xyz: side lengths of a cell, subject units.
    cell_size: vec4f,
    /// xyz: cells along each axis; w: ways are not followed farther than this.
    cells: vec4u,
    /// Rows of the affine that takes rest space to bricks.
    brick_from_rest_row0: vec4f,
    brick_from_rest_row1: vec4f,
    brick_from_rest_row2: vec4f,
    /// xyz: bricks along each axis; w: how many cells a mask spreads.
    bricks: vec4u,
    /// As in `Templates`, in the same order.
    items: array<GridTemplate, 32>,
}

/// What one template leaves alone. Stands at the head of its `add` group and holds for the whole group.
struct FeatureItem {
    /// x: sets of kept tissue, bit k for set k, KEEPS_DEEP for what lies deep under the outer surface, 0 keeps nothing; y: index of the
    /// first template of the run of groups that keep the same; z: sets that the displacement gives way to; w: CONSTRAIN_ mode.
    keeps: vec4u,
    /// x: depth under the outer surface from where on tissue is kept; y: width of the blend of normals; z: the longest displacement of
    /// the group; w: how far around a segment that moves as a whole other tissue goes with it. Subject units.
    lengths: vec4f,
}

/// Bit of `keeps.x`: what lies deeper than `lengths.x` under the outer surface.
const KEEPS_DEEP: u32 = 16u;
/// How a displacement gives way to kept tissue.
const CONSTRAIN_NOTHING: u32 = 0u;
const CONSTRAIN_DISPLACEMENT: u32 = 1u;
const CONSTRAIN_COORDINATE: u32 = 2u;
const CONSTRAIN_RIGID: u32 = 3u;

/// Kept tissue of a document.
struct Features {
    /// Rows of the affine that takes rest space to texture space of the distances.
    distance_from_rest_row0: vec4f,
    distance_from_rest_row1: vec4f,
    distance_from_rest_row2: vec4f,
    /// xyz: distance voxels along each axis; w: their smallest spacing, subject units.
    distance_dims: vec4f,
    /// Slabs of the distances, one behind the other along z: the first has the sets' distances, smoothed. x: how many there are; y: which
    /// one has the exact distances, 0 for none; z: which one has the depth under the outer surface in its x, 0 for none.
    slabs: vec4u,
    /// Sets of each label, four bits each, eight labels in a word.
    label_sets: array<vec4u, 8>,
    /// As in `Templates`, in the same order; only heads of groups count.
    items: array<FeatureItem, 32>,
    /// Rows of the rigid motions of segments that move as a whole (rest space from subject space), three per template; only heads of groups
    /// count.
    motions: array<vec4f, 96>,
}

/// One pass of the making of distances.
struct DistanceJob {
    /// Rows of the affine that takes voxels of the fine grid (the labels', else the volume's) to texture space of the volume.
    volume_from_voxel_row0: vec4f,
    volume_from_voxel_row1: vec4f,
    volume_from_voxel_row2: vec4f,
    /// xyz: fine voxels along each axis; w: fine voxels along each side of a coarse one.
    fine: vec4u,
    /// xyz: coarse voxels along each axis; w: channel, 0 to 3 for a set, 4 for the outside.
    coarse: vec4u,
    /// xyz: spacing of fine voxels, subject units; w: normalised value from which on a voxel is something.
    spacing: vec4f,
    /// x: first fine slice of this part; y: slices in it; z: axis of a sweep or a smoothing; w: 1 to read the labels.
    part: vec4u,
    /// As in `Features`.
    label_sets: array<vec4u, 8>,
}
