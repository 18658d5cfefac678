// Structs that Rust fills in, mirrored in order by src/render/pack/gpu_types.rs (tests/layout.rs compares them).
// No vec3 here: three components take a row of four, whose last is not used. Single numbers have names of their own and
// fill rows together. A struct of numbers alone is aligned to 4 bytes; where it is an element of an array in a uniform
// buffer, its size has to be a multiple of 16.
// needs: affine.wgsl

/// Templates of one document at most (spec/contract.md, "Limits").
const MAX_TEMPLATES: u32 = 32u;

/// One placed template, ready for the shaders: enabled, of a known kind.
struct Template {
    /// Subject space to template space (the unit cube).
    template_from_subject: Affine,
    /// Template space to subject space.
    subject_from_template: Affine,
    /// xyz: side lengths of the box that the template acts in, subject units. Along a curve: of the box laid along it.
    size: vec4f,
    /// Parameters in the order of the catalogue, flags 0 or 1, choices as index.
    params0: vec4f,
    params1: vec4f,
    /// Number of the kind: one of KIND_, see kinds.wgsl.
    kind: u32,
    /// Index of the composing template that heads its `add` group (its own if it composes).
    group: u32,
    /// Index in `Templates.pool` of the curve that the template lies along, 0 if it is straight.
    curve: u32,
    /// Index in `Templates.pool` of what the template holds besides parameters: the points of an rbf, the place of the
    /// samples of a field. 0 for none.
    held: u32,
}

/// All templates that act, in the order in which they act on the object.
struct Templates {
    items: array<Template, 32>,
    /// How many of them count.
    count: u32,
    /// What templates hold besides parameters, see displace/{curve,rbf,field}.wgsl. The first row is 0: nothing held.
    pool: array<vec4f, 2816>,
}

/// One picture's camera and sampling.
struct Frame {
    /// View space to subject space.
    subject_from_view: Affine,
    /// Tangent of half the field of view across width and height.
    lens: vec2f,
    /// Width and height of the whole picture, pixels.
    size_px: vec2f,
    /// Where in the pixel the ray goes through, 0 to 1.
    jitter: vec2f,
    /// Offset of the first step, in steps, 0 to 1.
    first_step: f32,
    /// Turn of the taps of ambient occlusion, radians.
    occlusion_turn: f32,
    /// Box of the deformed object, subject space.
    bounds_min: vec4f,
    bounds_max: vec4f,
    /// Length of a step, subject units.
    step: f32,
    /// Row of the whole picture that the target begins with.
    first_row: f32,
    /// 1 in a finished picture, 0 in a quick one of what moves.
    is_finished: u32,
}

/// Rays that are asked one by one: for each its origin and its unit direction, subject space.
struct AskedRays {
    items: array<vec4f, 512>,
}

/// The uploaded subject: where its values and segments lie and how their texels are read.
struct Subject {
    /// Rest space to texture space of the volume.
    texture_from_rest: Affine,
    /// Rest space to texture space of the segmentation.
    label_from_rest: Affine,
    /// xyz: voxels along each axis.
    dims: vec4f,
    /// xyz: voxels of the segmentation along each axis.
    label_dims: vec4f,
    /// xyz: texture coordinate at which the volume ends (1 unless it was reduced and its last voxel is a part of one).
    texture_end: vec4f,
    /// Value where the texture holds 0.
    value_low: f32,
    /// Values from 0 to 1 in the texture: the value is value_low + value_range * texel.
    value_range: f32,
    /// Length of the subject's finest detail, subject units; of a volume its smallest voxel spacing.
    detail: f32,
    /// 1 if there is a segmentation, else 0.
    has_labels: u32,
    /// Rest space to texture space of the field of the meshes, and to that of the sets that fill its voxels.
    field_from_rest: Affine,
    fill_from_rest: Affine,
    /// xyz: voxels of either along each axis.
    field_dims: vec4f,
    fill_dims: vec4f,
    /// xyz: box of the meshes, rest space.
    mesh_min: vec4f,
    mesh_max: vec4f,
    /// Number of nodes in the tree of the meshes; 0 where there are none.
    node_count: u32,
    /// Texels of `mesh_texels` at which the triangles and the sets of segments begin; the nodes begin at 0.
    triangles_at: u32,
    sets_at: u32,
    /// Texel at which the pictures on triangles begin; 0 if there are none.
    textures_at: u32,
    /// Smallest spacing of the field, subject units.
    field_detail: f32,
    /// Labels before that of the first segment of the meshes: 0 where they are alone, 255 beside a volume.
    labels_before: u32,
}

/// Transfer function, light and opacity.
struct Look {
    /// xyz: towards the key light, view space, unit.
    key_dir: vec4f,
    /// xyz: how far the key light wraps around, for red, green and blue: skin and fat let light through.
    key_wrap: vec4f,
    /// Position in the table = table_scale * texel + table_offset, clamped.
    table_scale: f32,
    table_offset: f32,
    /// How much segments tint, 0 to 1.
    tint: f32,
    /// Strength of the highlight, 0 to 1.
    specular: f32,
    /// How opacity follows the deformation, one of the constants OPACITY_.
    opacity_mode: u32,
    /// How much opacity follows the steepness of the value, 0 to 1.
    edges: f32,
    /// The part of its opacity that tissue keeps where it is a ghost, 0 to 1.
    ghost: f32,
    /// How wide the lamp of the key light is, as a part of its distance.
    lamp: f32,
    /// How much of the key light something opaque takes, near a surface and far from it.
    shade_near: f32,
    shade_far: f32,
    /// How much of the light from everywhere else occlusion takes, 0 to 1.
    contact: f32,
}

/// How one segment of a mesh is drawn (spec/surfaces.md, "What a body is").
struct MeshSegment {
    /// Linear RGB; alpha below 0: the colours of the file.
    color: vec4f,
    /// Linear RGB of back sides, and of cut faces without a layer; alpha below 0: a part of its own colour.
    inside: vec4f,
    /// One of the constants BODY_HOLLOW, BODY_THICK, BODY_FULL.
    kind: u32,
    /// Thickness of a shell, subject units.
    thickness: f32,
    /// Strength of the highlight, 0 to 1.
    gloss: f32,
    /// Opacity of one crossing or cut face, 0 to 1; below 0: that of the file.
    opacity: f32,
    /// Index of its first layer in `MeshLook.layers`, and how many it has.
    first_layer: u32,
    layer_count: u32,
}

/// A layer under the surface of a mesh.
struct MeshLayer {
    /// Linear RGB; alpha below 0: as a cut face without a layer.
    color: vec4f,
    /// Where it begins under the surface, subject units.
    depth: f32,
    /// How much its colour varies, 0 to 0.5.
    grain: f32,
}

/// How the segments of a mesh are drawn.
struct MeshLook {
    segments: array<MeshSegment, 64>,
    /// The layers of all segments; segments with the same layers share them.
    layers: array<MeshLayer, 64>,
    /// 1 if a segment fills any place.
    has_filled: u32,
}

/// An object that stands in the scene and that no template moves (spec/surfaces.md, "objects").
struct SceneObject {
    /// Subject space to the object's own space: the middle of its box is the origin, its longest side 1.
    object_from_subject: Affine,
    /// Linear RGB; alpha below 0: the colours of the file.
    color: vec4f,
    /// Linear RGB of back sides; alpha below 0: a part of its own colour.
    inside: vec4f,
    /// Opacity of one crossing, 0 to 1.
    opacity: f32,
    /// Strength of the highlight, 0 to 1.
    gloss: f32,
    /// Texels of `object_texels` at which its nodes and its triangles begin, and how many nodes it has.
    nodes_at: u32,
    triangles_at: u32,
    node_count: u32,
    /// Texel of `object_texels` at which the pictures on its triangles begin; 0 if there are none.
    textures_at: u32,
}

/// The objects that are drawn.
struct SceneObjects {
    items: array<SceneObject, 16>,
    count: u32,
}

const BODY_HOLLOW: u32 = 0u;
const BODY_THICK: u32 = 1u;
const BODY_FULL: u32 = 2u;

/// Segments drawn as bodies of their own.
struct Bodies {
    /// For each label: linear RGB, and in alpha the opacity (see BODY_LAYER). Alpha below 0: the label is no body and
    /// is drawn by its values.
    items: array<vec4f, 256>,
}

/// A layer so thick is as opaque as a body's opacity says, subject units.
const BODY_LAYER: f32 = 0.05;
/// Opacities from which a body is solid, and below which it is hidden.
const BODY_SOLID: f32 = 0.995;
const BODY_HIDDEN: f32 = 0.005;
/// Voxels along a side of a brick whose shares are made together, and how many bricks a row of the dispatch has.
const BODY_BRICK: u32 = 8u;
const BODY_ROW: u32 = 1024u;
/// In place of the label that fills a brick: more than one, or none that is a body.
const BODY_MIXED: u32 = 256u;
const BODY_NOTHING: u32 = 257u;

/// How opacity follows the deformation.
const OPACITY_CONSTANCY: u32 = 0u;
const OPACITY_MASS: u32 = 1u;
const OPACITY_NONE: u32 = 2u;

/// The skip grid: the grid over the deformed space.
struct Grid {
    /// xyz: lowest corner, subject space.
    origin_min: vec4f,
    /// xyz: side lengths of a cell, subject units.
    cell_size: vec4f,
    /// xyz: cells along each axis.
    cells: vec4u,
    /// 1 if the skip grid is in use; 0: every cell is visible and every template reaches it.
    is_used: u32,
}

/// The baked map: a texture over the deformed space.
struct Baked {
    /// xyz: lowest corner, subject space.
    origin_min: vec4f,
    /// xyz: one over the sides of the whole box, subject units.
    per_unit: vec4f,
    /// xyz: texels along each axis.
    texels: vec4u,
    /// Offset for finite differences of the map, subject units.
    map_step: f32,
    /// The first slab of those that are being made.
    first_slab: u32,
}

/// An illustrator's look, in pixels of the picture that is drawn (pass/style.wgsl).
struct Style {
    /// Linear RGB.
    outline_color: vec4f,
    warm: vec4f,
    cool: vec4f,
    hatch_color: vec4f,
    stipple_color: vec4f,
    /// xyz: the long axis of each segment, rest space, unit; of 0 that of the whole subject.
    /// w: the pattern of its strokes, a whole number: three times the kind, plus how often they turn by 60 degrees.
    axes: array<vec4f, 256>,
    /// Width of outlines, pixels; 0 for none.
    outline_px: f32,
    /// Normals that are turned against each other by more than the angle of this cosine make a crease.
    crease_cosine: f32,
    /// Number of flat tones; 0 for smooth ones.
    levels: f32,
    /// How far the colours of the tissue give way to those of the tone, 0 to 1.
    tone: f32,
    /// Between strokes and their least width, pixels; how much of the tone they make, 0 to 1.
    hatch_spacing_px: f32,
    hatch_width_px: f32,
    hatch: f32,
    /// One of the constants HATCH_.
    hatch_by: u32,
    /// Between dots and their least diameter, pixels; how much of the tone they make, 0 to 1.
    stipple_spacing_px: f32,
    stipple_size_px: f32,
    stipple: f32,
    /// How far tissue far from all templates fades, 0 to 1.
    vignette: f32,
    /// Length of the subject's finest detail, subject units: what is flatter makes no outline.
    detail: f32,
    /// Row of the whole picture that the traced pixels begin with.
    first_row: u32,
}

/// What strokes follow.
const HATCH_CURVATURE: u32 = 0u;
const HATCH_AXIS: u32 = 1u;

/// From the accumulated picture to the one that is shown.
struct Resolve {
    /// From pixel of the output to texture coordinate of the source.
    scale: vec2f,
    /// Largest texture coordinate in use.
    end: vec2f,
    /// Linear RGB of the background; alpha 1 if there is one, 0 transparent.
    background: vec4f,
    /// 1 to write straight alpha instead of premultiplied, texel by texel.
    is_straight: u32,
    /// 1 to leave bright light as it is: of a figure, whose colours no light has changed.
    is_unlit: u32,
}

/// Where the plate of a figure lies (pass/sheet.wgsl).
struct Sheet {
    /// Half of its width and height, subject units.
    half_size: vec2f,
    /// Width and height, texels.
    texels: vec2f,
    /// Width and height of the used part of the target, pixels.
    viewport: vec2f,
    /// The plate and its smaller copies.
    levels: u32,
}

/// A flat cut through the deformed object.
struct Slice {
    /// Pixels of the slice (origin top left, z is not used) to subject space.
    subject_from_pixel: Affine,
    /// Linear RGB where nothing is.
    background: vec4f,
    /// Grey level = grey_scale * texel + grey_offset, clamped.
    grey_scale: f32,
    grey_offset: f32,
    /// Whether grey levels or colours are drawn, one of the constants SLICE_.
    mode: u32,
    /// Samples per pixel along each side.
    samples: u32,
    /// The colour of marked values, linear RGB.
    marked_color: vec3f,
    /// The strength of that colour, 0 to 1; at 0 no values are marked.
    marked_strength: f32,
    /// The lowest and the highest marked value, normalised.
    marked_from: f32,
    marked_to: f32,
}

/// How a slice is shown.
const SLICE_GREY: u32 = 0u;
const SLICE_COLORS: u32 = 1u;
const SLICE_MARKED: u32 = 2u;

/// The lattice on which points of tissue are looked for in the deformed object (pass/follow.wgsl).
struct Lattice {
    /// xyz: lowest corner, subject space.
    corner: vec4f,
    /// xyz: cells along each axis.
    cells: vec4u,
    /// Side of a cell, subject units.
    side: f32,
    /// Points that are followed.
    count: u32,
    /// Number of the dispatch where a program takes several, from 0.
    dispatch: u32,
}

/// What a template reaches, for the making of the skip grid. Template space, of the straight box; a side without an end
/// is at 1e30.
struct GridTemplate {
    /// The first of two boxes in which the template changes something; empty if min > max.
    reach0_min: vec4f,
    reach0_max: vec4f,
    /// The second of these boxes.
    reach1_min: vec4f,
    reach1_max: vec4f,
    /// First box in the template's own space.
    own_min: vec4f,
    own_max: vec4f,
    /// Least shift of material.
    shift_min: vec4f,
    /// Greatest shift, or how far the map departs from its differences (rippled).
    shift_max: vec4f,
    /// Half side of the largest box in which differences tell how the map changes.
    detail: f32,
    /// Greatest ratio of a step's length in the template's own space to that in the straight box; 1 without a curve.
    stretch: f32,
    /// Longest displacement of any material, subject units, if the template lies along a curve; else 0.
    longest: f32,
    /// How the template moves material, one of the constants MATERIAL_.
    material: u32,
    /// 1 if the map jumps at the faces of the first box.
    is_torn: u32,
    /// 0 if differences across a box tell how the map changes in it; else a box is asked by the corners of its parts,
    /// at most so many along each side, and `detail` is half the side of the largest part.
    parts: u32,
}

/// How a template moves material: by a bounded shift, out of the cube, rolled about an axis, by a bounded shift that
/// may change faster than differences tell.
const MATERIAL_SHIFTED: u32 = 0u;
const MATERIAL_WITHIN: u32 = 1u;
const MATERIAL_BENT: u32 = 2u;
const MATERIAL_RIPPLED: u32 = 3u;

/// The job of the passes that make the skip grid.
struct GridJob {
    /// xyz: lowest corner, subject space.
    origin_min: vec4f,
    /// xyz: side lengths of a cell, subject units.
    cell_size: vec4f,
    /// xyz: cells along each axis.
    cells: vec4u,
    /// Rest space to bricks.
    brick_from_rest: Affine,
    /// xyz: bricks along each axis.
    bricks: vec4u,
    /// How far beyond its sides a cell is looked at, subject units.
    margin: f32,
    /// Ways to the nearest visible cell are not followed farther than this, cells.
    farthest: u32,
    /// How many cells a mask spreads.
    spread: u32,
    /// As in `Templates`, in the same order.
    items: array<GridTemplate, 32>,
}

/// What one template leaves alone. Stands at the head of its `add` group and holds for the whole group.
struct KeptGroup {
    /// Sets of tissue that stays, bit k for set k, KEEPS_DEEP for what lies deep under the outer surface; 0 keeps
    /// nothing. Those of alignments, and in lists those that displacements give way to.
    keeps: u32,
    /// Index of the first template of the run of groups that keep the same.
    run: u32,
    /// Sets that the displacement gives way to.
    gives_way_to: u32,
    /// What happens at constrained tissue, one of the constants CONSTRAIN_.
    constraint: u32,
    /// Depth under the outer surface from where on tissue is kept, subject units.
    depth: f32,
    /// Width of the blend of normals, subject units.
    blend: f32,
    /// The longest displacement of the group, subject units.
    longest: f32,
    /// Tissue that gives way is where the templates before this index have brought it; 0: it is at rest.
    before: u32,
    /// Those of `keeps` that an alignment keeps: between them and the tissue that moved there is a surface.
    @size(16) aligned: u32,
}

/// Bit of `KeptGroup.keeps`: what lies deeper than `depth` under the outer surface.
const KEEPS_DEEP: u32 = 16u;
/// How a displacement gives way to kept tissue.
const CONSTRAIN_NOTHING: u32 = 0u;
const CONSTRAIN_DISPLACEMENT: u32 = 1u;
const CONSTRAIN_COORDINATE: u32 = 2u;
const CONSTRAIN_RIGID: u32 = 3u;
/// Bit of the pipeline constant `has_constraints`: a group gives way to tissue that templates before it have moved.
const CONSTRAIN_LATE: u32 = 4u;
/// Bit of the same: a group moves other segments as a whole than set 0 alone.
const CONSTRAIN_MANY: u32 = 5u;

/// Kept tissue of a document.
struct Kept {
    /// Rest space to texture space of the distances.
    distance_from_rest: Affine,
    /// Voxels of the distances along each axis.
    distance_dims: vec3f,
    /// By how much a distance between them may be too long, subject units.
    distance_slack: f32,
    /// Smallest spacing of the distances, subject units.
    spacing: f32,
    /// Slabs in the texture of the distances, one behind the other along z. The first has the sets' distances,
    /// smoothed.
    slab_count: u32,
    /// Which slab has the exact distances, 0 for none.
    exact_slab: u32,
    /// Which slab has the depth under the outer surface in its x, 0 for none.
    depth_slab: u32,
    /// Of each set, four bits for each: the sets that are connected parts of the same segments, itself among them; 0
    /// for one that is whole. A label has all of them, and a place is in the nearest.
    parts: u32,
    /// 1 where a voxel of the distances is larger than one of the segments along some axis, else 0.
    is_coarse: u32,
    /// Sets that end at the smooth surface of their shares, bit k for set k; others at the voxels of their labels.
    shared_sets: u32,
    /// 1 where no label belongs to two of the sets: their shares add up to that of what lies in any of them.
    shares_add: u32,
    /// Half of the longest side of a label voxel, subject units: so far the smooth surface may lie from the labels.
    rim: f32,
    /// Sets of each label, four bits each, eight labels in a word.
    label_sets: array<vec4u, 10>,
    /// As in `Templates`, in the same order; only heads of groups count.
    items: array<KeptGroup, 32>,
    /// Rigid motions (subject space to rest space) of segments that move as a whole, four for each template: those of
    /// the four sets. Of a group that gives way by its coordinate, the longest displacement in the first number of its
    /// first. Only heads of groups count.
    motions: array<Affine, 128>,
    /// How far around each segment that moves as a whole other tissue goes with it, subject units, per head and set.
    seams: array<vec4f, 32>,
}

/// One pass of the making of shares of kept tissue.
struct SharesJob {
    /// xyz: label voxels along each axis.
    dims: vec4u,
    /// Words of bits in a row of them, 32 voxels each.
    words: u32,
    /// Set that is worked on.
    set_index: u32,
    /// Bytes of a voxel in what is written, one for each set from 0 on: 1, 2 or 4.
    channels: u32,
    /// Words in a row of what is written.
    row_words: u32,
    /// First slice of this part, and slices in it.
    first_slice: u32,
    slice_count: u32,
    /// Axis along which a pass goes.
    axis: u32,
    /// Sets of kept tissue that each label belongs to, four bits each; packed as in `Kept`.
    label_sets: array<vec4u, 10>,
}

/// One pass of the making of distances.
struct DistanceJob {
    /// Voxels of the fine grid (the segmentation's, else the volume's) to texture space of the volume.
    volume_from_voxel: Affine,
    /// xyz: fine voxels along each axis.
    fine: vec4u,
    /// xyz: coarse voxels along each axis.
    coarse: vec4u,
    /// xyz: spacing of fine voxels, subject units.
    spacing: vec4f,
    /// xyz: fine voxels from one coarse sample to the next.
    ratio: vec4f,
    /// Fine voxels to voxels of the segmentation.
    label_from_voxel: Affine,
    /// Fine voxels to rest space.
    rest_from_voxel: Affine,
    /// How much of a voxel is taken off a way along each axis, fine voxels: half for boxes, else 0.
    half_box: f32,
    /// How much is taken off a distance, subject units: half a voxel for balls, else 0.
    half_ball: f32,
    /// Channel that is worked on: 0 to 3 for a set, 4 for the outside.
    channel: u32,
    /// Normalised value from which on a voxel is something.
    threshold: f32,
    /// 1 to read the labels, else 0.
    reads_labels: u32,
    /// First fine slice of this part, and slices in it.
    first_slice: u32,
    slice_count: u32,
    /// Axis of a sweep or a smoothing; of `open_blocks` the axis from foot to head, 3 for none.
    axis: u32,
    /// Slab that is written, and the number of sets in it: 0 for the depth.
    slab: u32,
    set_count: u32,
    /// Rank of the connected part that distances are taken to, from 1; 0: the whole set.
    part: u32,
    /// How many parts have a rank.
    part_count: u32,
    /// Words in a row of bits that tell the members of the sets (pass/shares.wgsl); 0: there are none.
    member_words: u32,
    /// 1 where these bits alone tell the members, word for word: fine voxels are label voxels, and no mesh adds any.
    are_members_told: u32,
    /// Sets of kept tissue that each label belongs to, four bits each; packed as in `Kept`.
    label_sets: array<vec4u, 10>,
}
