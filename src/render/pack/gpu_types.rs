//! Mirrors of the structs in `shaders/types.wgsl`, member by member and in order; `tests/layout.rs` compares them.

use std::sync::Arc;

use super::laid::Laid;
use crate::data::{Carver, FieldSamples, Resources};
use crate::document::{
    MAX_FIELDS, MAX_OBJECTS, MAX_PARAM_FLOATS, PlacedTemplate, TemplateData, TemplateKind,
    TemplateMode,
};
use crate::placed::{drawn_in_sweep, solved_points, sweep_rows, sweep_texels};
use glam::{Affine3A, Mat3A, Vec3A};

/// Format of the transfer table.
pub const TABLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Templates of one document at most (spec/contract.md, "Limits").
pub const MAX_TEMPLATES: usize = 32;
/// Entries of [`Templates::pool`], for what all templates hold together: curves, control points, tools of sweeps.
pub const POOL: usize = 2816;

/// An affine map, by the rows of its matrix: three factors and the offset of each coordinate of the result.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Affine {
    /// Factors of x, y, z and offset of the result's x.
    pub row0: [f32; 4],
    /// Factors of x, y, z and offset of the result's y.
    pub row1: [f32; 4],
    /// Factors of x, y, z and offset of the result's z.
    pub row2: [f32; 4],
}

impl Affine {
    const ZERO: Self = Self {
        row0: [0.0; 4],
        row1: [0.0; 4],
        row2: [0.0; 4],
    };
}

impl From<Affine3A> for Affine {
    fn from(affine: Affine3A) -> Self {
        let m = affine.matrix3;
        let t = affine.translation;
        let row = |i: usize| [m.x_axis[i], m.y_axis[i], m.z_axis[i], t[i]];
        Self {
            row0: row(0),
            row1: row(1),
            row2: row(2),
        }
    }
}

/// One placed template: where it lies, its parameters, and the group that it belongs to.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Template {
    /// Subject space to template space.
    pub template_from_subject: Affine,
    /// Template space to subject space.
    pub subject_from_template: Affine,
    /// xyz: side lengths of the box that it acts in, subject units; along a curve, of the box laid along it.
    pub size: [f32; 4],
    /// Parameters 0 to 3.
    pub params0: [f32; 4],
    /// Parameters 4 to 7.
    pub params1: [f32; 4],
    /// Kind of the template, as `TemplateKind as u32`.
    pub kind: u32,
    /// Index of the composing template that heads its `add` group (its own if it composes).
    pub group: u32,
    /// Index of its curve in the pool, 0 if it is straight.
    pub curve: u32,
    /// Index in the pool of what it holds besides parameters, 0 for none.
    pub held: u32,
}

/// All templates that act, in order.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Templates {
    /// The first `count` count.
    pub items: [Template; MAX_TEMPLATES],
    /// Number of templates in `items`.
    pub count: u32,
    /// To the next row of four.
    pub padding: [u32; 3],
    /// What templates hold besides parameters.
    pub pool: [[f32; 4]; POOL],
}

impl Templates {
    /// No templates: the identity.
    pub const NONE: Self = Self {
        items: [Template {
            template_from_subject: Affine::ZERO,
            subject_from_template: Affine::ZERO,
            size: [0.0; 4],
            params0: [0.0; 4],
            params1: [0.0; 4],
            kind: 0,
            group: 0,
            curve: 0,
            held: 0,
        }; MAX_TEMPLATES],
        count: 0,
        padding: [0; 3],
        pool: [[0.0; 4]; POOL],
    };

    /// Packs the enabled templates; a field acts as soon as its samples have arrived. An `add` with no enabled template
    /// before it composes (spec/templates.md). A valid document has at most [`MAX_TEMPLATES`]; further ones are left
    /// out.
    pub fn pack(placed: &[PlacedTemplate], resources: &Resources) -> Self {
        let mut packed = Self::NONE;
        let acting = placed.iter().map(|t| resources.acting(t));
        let enabled: Vec<_> = acting.filter(|t| t.enabled).take(MAX_TEMPLATES).collect();
        let carvers = acting_carvers(placed, resources);
        let (mut count, mut group) = (0, 0);
        // The first entry stays 0: no points, no samples, no curve. Curves come first: there is room for one of every
        // template.
        let (mut used, mut slice) = (1, 0);
        let grids = Laid::of(placed, resources);
        let (mut fields, mut steps) = (0, grids.texels());
        let mut hold = |rows: &[[f32; 4]]| {
            let free = packed.pool.get_mut(used..used + rows.len())?;
            free.copy_from_slice(rows);
            used += rows.len();
            (!rows.is_empty()).then_some(used - rows.len())
        };
        for (slot, template) in packed.items.iter_mut().zip(&enabled) {
            if count == 0 || template.mode == TemplateMode::Compose {
                group = count;
            }
            *slot = Template::pack(template, group);
            if let Some(bent) = template.bent()
                && let Some(first) = hold(&bent.rows())
            {
                slot.size = bent.size().extend(0.0).to_array();
                slot.curve = first as u32;
            }
            count += 1;
        }
        for (slot, template) in packed.items.iter_mut().zip(&enabled) {
            let held = match &template.data {
                TemplateData::Points(_) => solved_points(template),
                TemplateData::Field(_) => match resources.field(template) {
                    Some(samples) if fields < MAX_FIELDS => {
                        fields += 1;
                        vec![field_place(samples, &mut slice)]
                    }
                    _ => Vec::new(),
                },
                TemplateData::Object(_) => carver_rows(template, resources, &carvers),
                TemplateData::Tools(_) => {
                    sweep_rows(template, &mut steps, &|file| grids.place(file))
                }
                TemplateData::None => Vec::new(),
            };
            if let Some(first) = hold(&held) {
                slot.held = first as u32;
            }
        }
        packed.count = count;
        packed
    }

    /// Bit k: templates of kind k occur; bit 0: some lie along a curve; [`DRAWN_OF_SWEEPS`]: what sweeps have.
    /// Pipelines are made for this.
    ///
    /// [`DRAWN_OF_SWEEPS`]: crate::displace::DRAWN_OF_SWEEPS
    pub fn drawn_kinds(&self) -> u32 {
        let used = self.items.iter().take(self.count as usize);
        used.fold(0, |bits, t| {
            let kind = 1u32.checked_shl(t.kind).unwrap_or(0);
            bits | kind | u32::from(t.curve != 0) | self.drawn_in_sweep(t)
        })
    }

    /// What a sweep has; nothing of other kinds.
    fn drawn_in_sweep(&self, template: &Template) -> u32 {
        if template.kind != TemplateKind::Sweep as u32 || template.held == 0 {
            return 0;
        }
        let held = self.pool.get(template.held as usize..).unwrap_or(&[]);
        drawn_in_sweep(held)
    }
}

/// What each of the objects that carve has for it, in the order in which their nodes lie behind each other.
pub(crate) fn acting_carvers(placed: &[PlacedTemplate], resources: &Resources) -> Vec<Arc<Carver>> {
    let mut carvers: Vec<Arc<Carver>> = Vec::new();
    for template in placed.iter().filter(|t| resources.acting(t).enabled) {
        if let Some(carver) = resources.carver(template)
            && !carvers.iter().any(|known| Arc::ptr_eq(known, carver))
        {
            carvers.push(Arc::clone(carver));
        }
    }
    carvers
}

/// The steps of the sweeps that act, one behind the other.
pub(crate) fn acting_sweeps(placed: &[PlacedTemplate], resources: &Resources) -> Vec<[f32; 4]> {
    let acting = placed.iter().map(|t| resources.acting(t));
    let enabled = acting.filter(|t| t.enabled).take(MAX_TEMPLATES);
    enabled
        .flat_map(|template| sweep_texels(&template))
        .collect()
}

/// So far from an object that carves its distance is read from its grids, subject units, where it does nothing too.
const FAR_FROM_OBJECT: f32 = 4.0;

/// Where the nodes of an object lie among those of all, as packed into the pool: as many levels as the template reads.
fn carver_rows(
    template: &PlacedTemplate,
    resources: &Resources,
    carvers: &[Arc<Carver>],
) -> Vec<[f32; 4]> {
    let Some(carver) = resources.carver(template) else {
        return Vec::new();
    };
    let before = carvers
        .iter()
        .take_while(|known| !Arc::ptr_eq(known, carver));
    let begin: usize = before.map(|known| known.texels.len()).sum();
    let reach = template.number("reach").max(FAR_FROM_OBJECT);
    let count = carver.levels_within(reach / template.placement.size.x);
    let most_room = ((1 << Carver::ROOM_BITS) - 1) as f32;
    let mut rows = vec![[
        count as f32,
        carver.cell,
        carver.least,
        carver.room / most_room,
    ]];
    rows.extend(carver.levels.iter().take(count).map(|level| {
        let [x, y, z] = level.nodes.to_array();
        // Whole numbers below 2 to the 24th, which floats hold.
        let first = begin as u32 + level.first;
        [first as f32, (x + 1024 * y) as f32, z as f32, level.step]
    }));
    rows
}

/// Where the samples of a field begin among those of all, as packed into the pool.
fn field_place(FieldSamples(samples): &FieldSamples, slice: &mut u32) -> [f32; 4] {
    let [x, y, z] = samples.dims;
    let place = [x as f32, y as f32, z as f32, *slice as f32];
    *slice += z;
    place
}

impl Template {
    /// Packs a template that acts ([`PlacedTemplate::acting`]).
    fn pack(placed: &PlacedTemplate, group: u32) -> Self {
        let p = &placed.placement;
        let rotate = Mat3A::from_quat(p.rotate);
        let size = Vec3A::from(p.size);
        let scaled = Mat3A::from_cols(
            rotate.x_axis * size.x,
            rotate.y_axis * size.y,
            rotate.z_axis * size.z,
        );
        let subject_from_template = Affine3A {
            matrix3: scaled,
            translation: Vec3A::from(p.at) - scaled * Vec3A::splat(0.5),
        };
        // From the parts, not by inverting: exact for every size that a document may hold.
        let unscale = Mat3A::from_diagonal(p.size.recip()) * rotate.transpose();
        let template_from_subject = Affine3A {
            matrix3: unscale,
            translation: Vec3A::splat(0.5) - unscale * Vec3A::from(p.at),
        };
        let mut floats = Vec::with_capacity(MAX_PARAM_FLOATS);
        for value in &placed.params {
            value.pack(&mut floats);
        }
        floats.resize(MAX_PARAM_FLOATS, 0.0);
        let quad = |i: usize| [floats[i], floats[i + 1], floats[i + 2], floats[i + 3]];
        Self {
            template_from_subject: template_from_subject.into(),
            subject_from_template: subject_from_template.into(),
            size: p.size.extend(0.0).to_array(),
            params0: quad(0),
            params1: quad(4),
            kind: placed.kind as u32,
            group,
            curve: 0,
            held: 0,
        }
    }
}

/// Bit of [`KeptGroup::keeps`]: what lies deep under the outer surface.
pub const KEEPS_DEEP: u32 = 16;
/// [`KeptGroup::constraint`]: the displacement gives way to nothing.
pub const CONSTRAIN_NOTHING: u32 = 0;
/// [`KeptGroup::constraint`]: the displacement's length gives way.
pub const CONSTRAIN_DISPLACEMENT: u32 = 1;
/// [`KeptGroup::constraint`]: the template's main parameter gives way.
pub const CONSTRAIN_COORDINATE: u32 = 2;
/// [`KeptGroup::constraint`]: tissue moves as a whole.
pub const CONSTRAIN_RIGID: u32 = 3;
/// Bit of [`KeptTissue::constraints`](super::kept::KeptTissue::constraints): a group gives way to tissue that templates
/// before it have moved.
pub const CONSTRAIN_LATE: u32 = 4;
/// Bit of the same: a group moves other segments as a whole than set 0 alone.
pub const CONSTRAIN_MANY: u32 = 5;

/// What one template leaves alone.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct KeptGroup {
    /// Sets whose tissue stays, bit k for set k, and [`KEEPS_DEEP`]; 0 keeps nothing.
    pub keeps: u32,
    /// First template of the run of groups that keep the same.
    pub run: u32,
    /// Sets that the displacement gives way to.
    pub gives_way_to: u32,
    /// What happens at constrained tissue, one of the constants `CONSTRAIN_`.
    pub constraint: u32,
    /// Depth under the outer surface from where on tissue is kept, subject units.
    pub depth: f32,
    /// Width of the blend of normals, subject units.
    pub blend: f32,
    /// Longest displacement of the group, subject units.
    pub longest: f32,
    /// Tissue that gives way is where the templates before this index have brought it; 0: it is at rest.
    pub before: u32,
    /// Those of `keeps` that an alignment keeps.
    pub aligned: u32,
    /// To the next row of four.
    pub padding: [u32; 3],
}

/// Motions of the segments that move as a whole: four sets for each template.
pub const MAX_MOTIONS: usize = 4 * MAX_TEMPLATES;

/// Kept tissue of a document.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Kept {
    /// Rest space to texture space of the distances.
    pub distance_from_rest: Affine,
    /// Voxels of the distances along each axis.
    pub distance_dims: [f32; 3],
    /// By how much a distance between them may be too long, subject units.
    pub distance_slack: f32,
    /// Their smallest spacing, subject units.
    pub spacing: f32,
    /// Slabs of the distances.
    pub slab_count: u32,
    /// Slab of exact distances, or 0.
    pub exact_slab: u32,
    /// Slab of the depth, or 0.
    pub depth_slab: u32,
    /// Of each set, four bits for each: the sets that are connected parts of the same segments; 0 for one that is
    /// whole.
    pub parts: u32,
    /// 1 where a voxel of the distances is larger than one of the segments.
    pub is_coarse: u32,
    /// Sets that end at the smooth surface of their shares, bit k for set k.
    pub shared_sets: u32,
    /// 1 where no label belongs to two of the sets.
    pub shares_add: u32,
    /// Half of the longest side of a label voxel, subject units.
    pub rim: f32,
    /// To the next row of four.
    pub padding: [u32; 3],
    /// Sets of each label, four bits each.
    pub label_sets: LabelSets,
    /// What each template keeps, in the order of [`Templates::items`].
    pub items: [KeptGroup; MAX_TEMPLATES],
    /// Rigid motions (subject space to rest space) of segments that move as a whole, four for each template: those of
    /// the four sets. Of a group that gives way by its coordinate, the longest displacement in the first number of its
    /// first. Only heads of groups count. Written on the GPU.
    pub motions: [Affine; MAX_MOTIONS],
    /// How far around each segment that moves as a whole other tissue goes with it, subject units, per head and set.
    /// Written on the GPU.
    pub seams: [[f32; 4]; MAX_TEMPLATES],
}

impl Kept {
    /// Nothing is kept.
    pub const NONE: Self = Self {
        distance_from_rest: Affine::ZERO,
        distance_dims: [0.0; 3],
        distance_slack: 0.0,
        spacing: 0.0,
        slab_count: 0,
        exact_slab: 0,
        depth_slab: 0,
        parts: 0,
        is_coarse: 0,
        shared_sets: 0,
        shares_add: 0,
        rim: 0.0,
        padding: [0; 3],
        label_sets: [[0; 4]; 10],
        items: [KeptGroup {
            keeps: 0,
            run: 0,
            gives_way_to: 0,
            constraint: CONSTRAIN_NOTHING,
            depth: 0.0,
            blend: 0.0,
            longest: 0.0,
            before: 0,
            aligned: 0,
            padding: [0; 3],
        }; MAX_TEMPLATES],
        motions: [Affine::ZERO; MAX_MOTIONS],
        seams: [[0.0; 4]; MAX_TEMPLATES],
    };
}

/// Sets of kept tissue that each label belongs to, four bits each, eight labels in a word: of the labels of a volume,
/// and behind them of the segments of meshes beside it.
pub type LabelSets = [[u32; 4]; 10];

/// One pass of the making of shares of kept tissue.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SharesJob {
    /// xyz: label voxels along each axis.
    pub dims: [u32; 4],
    /// Words of bits in a row of them.
    pub words: u32,
    /// Set that is worked on.
    pub set_index: u32,
    /// Bytes of a voxel in what is written, one for each set: 1, 2 or 4.
    pub channels: u32,
    /// Words in a row of what is written.
    pub row_words: u32,
    /// First slice of this part.
    pub first_slice: u32,
    /// Slices in the part.
    pub slice_count: u32,
    /// Axis along which a pass goes.
    pub axis: u32,
    /// To the next row of four.
    pub padding: u32,
    /// Sets of kept tissue that each label belongs to, packed as in [`Kept`].
    pub label_sets: LabelSets,
}

/// One pass of the making of distances.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct DistanceJob {
    /// Fine voxels to texture space of the volume.
    pub volume_from_voxel: Affine,
    /// xyz: number of fine voxels.
    pub fine: [u32; 4],
    /// xyz: number of coarse voxels.
    pub coarse: [u32; 4],
    /// xyz: spacing of fine voxels, subject units.
    pub spacing: [f32; 4],
    /// xyz: fine voxels from one coarse sample to the next.
    pub ratio: [f32; 4],
    /// Fine voxels to voxels of the segmentation.
    pub label_from_voxel: Affine,
    /// Fine voxels to rest space.
    pub rest_from_voxel: Affine,
    /// Half a voxel where voxels count as boxes, fine voxels; else 0.
    pub half_box: f32,
    /// Half a voxel where voxels count as balls, subject units; else 0.
    pub half_ball: f32,
    /// Channel that is worked on.
    pub channel: u32,
    /// Normalised value from which on a voxel is something.
    pub threshold: f32,
    /// 1 to read the labels.
    pub reads_labels: u32,
    /// First fine slice of the part.
    pub first_slice: u32,
    /// Slices in the part.
    pub slice_count: u32,
    /// Axis of a sweep or a smoothing; the axis from foot to head, 3 for none.
    pub axis: u32,
    /// Slab that is written.
    pub slab: u32,
    /// Sets in that slab, 0 for the depth.
    pub set_count: u32,
    /// Rank of the connected part that distances are taken to, from 1; 0: the whole set.
    pub part: u32,
    /// How many parts have a rank.
    pub part_count: u32,
    /// Words in a row of bits that tell the members of the sets; 0: there are none.
    pub member_words: u32,
    /// 1 where these bits alone tell the members, word for word.
    pub are_members_told: u32,
    /// To the next row of four.
    pub padding: [u32; 2],
    /// Sets of kept tissue that each label belongs to, packed as in [`Kept`].
    pub label_sets: LabelSets,
}

/// One picture's camera and sampling.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Frame {
    /// View space to subject space.
    pub subject_from_view: Affine,
    /// Tangents of half the field of view (width, height).
    pub lens: [f32; 2],
    /// Width and height of the whole picture, pixels.
    pub size_px: [f32; 2],
    /// Place in the pixel, 0 to 1.
    pub jitter: [f32; 2],
    /// Offset of the first step, in steps.
    pub first_step: f32,
    /// Turn of the occlusion taps, radians.
    pub occlusion_turn: f32,
    /// Box of the deformed object, lowest corner.
    pub bounds_min: [f32; 4],
    /// Box of the deformed object, highest corner.
    pub bounds_max: [f32; 4],
    /// Length of a step, subject units.
    pub step: f32,
    /// Row of the whole picture that the target begins with.
    pub first_row: f32,
    /// 1 in a finished picture, 0 in a quick one of what moves.
    pub is_finished: u32,
    /// To the end of the row.
    pub padding: u32,
}

/// How many rays one uniform buffer holds.
pub const MAX_ASKED_RAYS: usize = 256;

/// Rays that are asked one by one.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct AskedRays {
    /// Origin and unit direction of each, subject space.
    pub items: [[f32; 4]; 2 * MAX_ASKED_RAYS],
}

/// The uploaded subject: where its values and segments lie and how their texels are read.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Subject {
    /// Rest space to texture space of the volume.
    pub texture_from_rest: Affine,
    /// Rest space to texture space of the segmentation.
    pub label_from_rest: Affine,
    /// xyz: number of voxels of the volume.
    pub dims: [f32; 4],
    /// xyz: voxels of the segmentation.
    pub label_dims: [f32; 4],
    /// xyz: texture coordinate at which the volume ends.
    pub texture_end: [f32; 4],
    /// Value of texel 0.
    pub value_low: f32,
    /// Values from texel 0 to texel 1.
    pub value_range: f32,
    /// Length of the finest detail, subject units; of a volume its smallest voxel spacing.
    pub detail: f32,
    /// 1 if there is a segmentation.
    pub has_labels: u32,
    /// Rest space to texture space of the field of the meshes.
    pub field_from_rest: Affine,
    /// Rest space to texture space of the sets that fill the voxels of that field.
    pub fill_from_rest: Affine,
    /// xyz: voxels of the field.
    pub field_dims: [f32; 4],
    /// xyz: voxels that have sets.
    pub fill_dims: [f32; 4],
    /// xyz: lowest corner of the box of the meshes, rest space.
    pub mesh_min: [f32; 4],
    /// xyz: highest corner of the box of the meshes, rest space.
    pub mesh_max: [f32; 4],
    /// Number of nodes in the tree of the meshes; 0 where there are none.
    pub node_count: u32,
    /// Texel at which their triangles begin.
    pub triangles_at: u32,
    /// Texel at which the sets of segments begin.
    pub sets_at: u32,
    /// Texel at which the pictures on triangles begin; 0 if there are none.
    pub textures_at: u32,
    /// Smallest spacing of the field, subject units.
    pub field_detail: f32,
    /// Labels before that of their first segment.
    pub labels_before: u32,
    /// To the next row of four.
    pub padding: [u32; 2],
}

/// Segments of a mesh at most, and layers of all of them together.
pub const MESH_SEGMENTS: usize = 64;
/// Layers of all segments of a mesh at most; segments with the same layers share them.
pub const MESH_LAYERS: usize = 64;

/// How one segment of a mesh is drawn.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MeshSegment {
    /// Linear RGB; alpha below 0: the colours of the file.
    pub color: [f32; 4],
    /// Linear RGB of back sides and of cut faces without a layer; alpha below 0: a part of its own colour.
    pub inside: [f32; 4],
    /// One of the constants `BODY_`.
    pub kind: u32,
    /// Thickness of a shell, subject units.
    pub thickness: f32,
    /// Strength of the highlight, 0 to 1.
    pub gloss: f32,
    /// Opacity of one crossing or cut face, 0 to 1; below 0: that of the file.
    pub opacity: f32,
    /// Index of its first layer.
    pub first_layer: u32,
    /// How many layers it has.
    pub layer_count: u32,
    /// To the next row of four.
    pub padding: [u32; 2],
}

/// A layer under the surface of a mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MeshLayer {
    /// Linear RGB; alpha below 0: as a cut face without a layer.
    pub color: [f32; 4],
    /// Where it begins under the surface, subject units.
    pub depth: f32,
    /// How much its colour varies, 0 to 0.5.
    pub grain: f32,
    /// To the next row of four.
    pub padding: [u32; 2],
}

/// How the segments of a mesh are drawn.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MeshLook {
    /// By segment.
    pub segments: [MeshSegment; MESH_SEGMENTS],
    /// The layers of all segments.
    pub layers: [MeshLayer; MESH_LAYERS],
    /// 1 if a segment fills any place.
    pub has_filled: u32,
    /// To the next row of four.
    pub padding: [u32; 3],
}

impl Default for MeshLook {
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}

/// An object that stands in the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SceneObject {
    /// Subject space to the object's own space.
    pub object_from_subject: Affine,
    /// Linear RGB; alpha below 0: the colours of the file.
    pub color: [f32; 4],
    /// Linear RGB of back sides; alpha below 0: a part of its own colour.
    pub inside: [f32; 4],
    /// Opacity of one crossing, 0 to 1.
    pub opacity: f32,
    /// Strength of the highlight, 0 to 1.
    pub gloss: f32,
    /// Texel at which its nodes begin.
    pub nodes_at: u32,
    /// Texel at which its triangles begin.
    pub triangles_at: u32,
    /// How many nodes it has.
    pub node_count: u32,
    /// Texel at which the pictures on its triangles begin; 0 if there are none.
    pub textures_at: u32,
    /// To the next row of four.
    pub padding: [u32; 2],
}

/// The objects that are drawn.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SceneObjects {
    /// In the order of the document.
    pub items: [SceneObject; MAX_OBJECTS],
    /// How many of them count.
    pub count: u32,
    /// To the next row of four.
    pub padding: [u32; 3],
}

/// [`MeshSegment::kind`]: the surface alone.
pub const BODY_HOLLOW: u32 = 0;
/// [`MeshSegment::kind`]: a shell.
pub const BODY_THICK: u32 = 1;
/// [`MeshSegment::kind`]: full.
pub const BODY_FULL: u32 = 2;

/// Transfer function, light and opacity.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Look {
    /// xyz: towards the key light, view space, unit.
    pub key_dir: [f32; 4],
    /// xyz: how far the key light wraps around, for red, green and blue.
    pub key_wrap: [f32; 4],
    /// Table position = `table_scale` · texel + `table_offset`.
    pub table_scale: f32,
    /// Table position of a texel of 0.
    pub table_offset: f32,
    /// Tint by segment, 0 to 1.
    pub tint: f32,
    /// Strength of the highlight, 0 to 1.
    pub specular: f32,
    /// How opacity follows the deformation, one of the constants `OPACITY_`.
    pub opacity_mode: u32,
    /// How much opacity follows the gradient, 0 to 1.
    pub edges: f32,
    /// The part of its opacity that tissue keeps where it is a ghost, 0 to 1.
    pub ghost: f32,
    /// How wide the lamp of the key light is, as a part of its distance.
    pub lamp: f32,
    /// How much of the key light something opaque takes near a surface.
    pub shade_near: f32,
    /// How much of the key light something opaque takes far from a surface.
    pub shade_far: f32,
    /// How much of the light from everywhere else occlusion takes, 0 to 1.
    pub contact: f32,
    /// To the end of the row.
    pub padding: u32,
}

/// Segments drawn as bodies of their own.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Bodies {
    /// For each label: linear RGB and opacity; w below 0: no body.
    pub items: [[f32; 4]; 256],
}

impl Bodies {
    /// No segment is drawn as a body.
    pub const NONE: Self = Self {
        items: [[0.0, 0.0, 0.0, -1.0]; 256],
    };
}

/// A layer so thick is as opaque as a body's opacity says, subject units.
pub const BODY_LAYER: f32 = crate::document::SegmentLook::LAYER;
/// Opacity from which a body is solid.
pub const BODY_SOLID: f32 = 0.995;
/// Opacity below which a body is hidden.
pub const BODY_HIDDEN: f32 = 0.005;
/// Voxels along a side of a brick whose shares of bodies are made together.
pub const BODY_BRICK: u32 = 8;
/// Bricks in a row of the dispatch that makes shares of bodies.
pub const BODY_ROW: u32 = 1024;
/// In place of the label that fills a brick: more than one.
pub const BODY_MIXED: u32 = 256;
/// In place of the label that fills a brick: none that is a body.
pub const BODY_NOTHING: u32 = 257;

/// [`Look::opacity_mode`]: a surface keeps its opacity.
pub const OPACITY_CONSTANCY: u32 = 0;
/// [`Look::opacity_mode`]: particles are conserved.
pub const OPACITY_MASS: u32 = 1;
/// [`Look::opacity_mode`]: opacity is not adjusted.
pub const OPACITY_NONE: u32 = 2;

/// The skip grid: the grid over the deformed space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Grid {
    /// Lowest corner, subject space.
    pub origin_min: [f32; 4],
    /// Sides of a cell, subject units.
    pub cell_size: [f32; 4],
    /// Cells along each axis.
    pub cells: [u32; 4],
    /// 1 if in use.
    pub is_used: u32,
    /// To the end of the row.
    pub padding: [u32; 3],
}

/// The baked map: a texture over the deformed space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Baked {
    /// Lowest corner, subject space.
    pub origin_min: [f32; 4],
    /// One over the sides of the whole box, subject units.
    pub per_unit: [f32; 4],
    /// Texels along each axis.
    pub texels: [u32; 4],
    /// Offset for finite differences of the map, subject units.
    pub map_step: f32,
    /// The first slab of those that are being made.
    pub first_slab: u32,
    /// To the end of the row.
    pub padding: [u32; 2],
}

/// An illustrator's look, in pixels of the picture that is drawn.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Style {
    /// Linear RGB, as the next four.
    pub outline_color: [f32; 4],
    /// Colour in the light.
    pub warm: [f32; 4],
    /// Colour in the shade.
    pub cool: [f32; 4],
    /// Colour of strokes.
    pub hatch_color: [f32; 4],
    /// Colour of dots.
    pub stipple_color: [f32; 4],
    /// xyz: the long axis of each segment, rest space, unit; of 0 that of the whole subject.
    /// w: the pattern of its strokes, a whole number: three times the kind, plus how often they turn by 60 degrees.
    pub axes: [[f32; 4]; 256],
    /// Width of outlines, pixels; 0 for none.
    pub outline_px: f32,
    /// Normals that are turned against each other by more than the angle of this cosine make a crease.
    pub crease_cosine: f32,
    /// Number of flat tones; 0 for smooth ones.
    pub levels: f32,
    /// How far the colours of the tissue give way to those of the tone, 0 to 1.
    pub tone: f32,
    /// Between strokes, pixels.
    pub hatch_spacing_px: f32,
    /// Least width of strokes, pixels.
    pub hatch_width_px: f32,
    /// How much of the tone strokes make, 0 to 1.
    pub hatch: f32,
    /// One of the constants `HATCH_`.
    pub hatch_by: u32,
    /// Between dots, pixels.
    pub stipple_spacing_px: f32,
    /// Least diameter of dots, pixels.
    pub stipple_size_px: f32,
    /// How much of the tone dots make, 0 to 1.
    pub stipple: f32,
    /// How far tissue far from all templates fades, 0 to 1.
    pub vignette: f32,
    /// Length of the subject's finest detail, subject units: what is flatter makes no outline.
    pub detail: f32,
    /// Row of the whole picture that the traced pixels begin with.
    pub first_row: u32,
    /// To the end of the row.
    pub padding: [u32; 2],
}

/// Strokes follow the direction in which the surface bends most.
pub const HATCH_CURVATURE: u32 = 0;
/// Strokes follow the long axis of the segment.
pub const HATCH_AXIS: u32 = 1;

/// From the accumulated picture to the one that is shown.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Resolve {
    /// From output pixel to texture coordinate.
    pub scale: [f32; 2],
    /// Largest texture coordinate in use.
    pub end: [f32; 2],
    /// Linear RGB; alpha 1 if there is a background.
    pub background: [f32; 4],
    /// 1 for straight alpha.
    pub is_straight: u32,
    /// 1 to leave bright light as it is.
    pub is_unlit: u32,
    /// To the end of the row.
    pub padding: [u32; 2],
}

/// Where the plate of a figure lies.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Sheet {
    /// Half of its width and height, subject units.
    pub half_size: [f32; 2],
    /// Width and height, texels.
    pub texels: [f32; 2],
    /// Width and height of the used part of the target, pixels.
    pub viewport: [f32; 2],
    /// The plate and its smaller copies.
    pub levels: u32,
    /// To the end of the row.
    pub padding: u32,
}

/// A corner of a figure's triangles, as the vertex shader reads it: each of the three has the whole triangle.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct SheetCorner {
    /// Where the triangle's corners are, subject space.
    pub places: [[f32; 2]; 3],
    /// Where the first of them is at rest, subject space.
    pub rest: [f32; 2],
    /// Columns of the map from directions in the bent triangle to those at rest.
    pub rest_from_place: [[f32; 2]; 2],
    /// Straight linear colour in place of the plate's; alpha 0: the plate's.
    pub color: [f32; 4],
}

/// A flat cut through the deformed object.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Slice {
    /// Pixels of the slice to subject space.
    pub subject_from_pixel: Affine,
    /// Linear RGB where nothing is.
    pub background: [f32; 4],
    /// Grey level = `grey_scale` · texel + `grey_offset`.
    pub grey_scale: f32,
    /// Grey level of a texel of 0.
    pub grey_offset: f32,
    /// Whether grey levels or colours are drawn, one of the constants `SLICE_`.
    pub mode: u32,
    /// Samples per pixel along each side.
    pub samples: u32,
    /// The colour of marked values, linear RGB.
    pub marked_color: [f32; 3],
    /// The strength of that colour, 0 to 1; at 0 no values are marked.
    pub marked_strength: f32,
    /// The lowest marked value, normalised.
    pub marked_from: f32,
    /// The highest marked value, normalised.
    pub marked_to: f32,
    /// The end of the row.
    pub padding: [u32; 2],
}

/// [`Slice::mode`]: values as grey, by the window.
pub const SLICE_GREY: u32 = 0;
/// [`Slice::mode`]: the look's colours.
pub const SLICE_COLORS: u32 = 1;
/// [`Slice::mode`]: as `SLICE_GREY`, with bodies over it in their colours.
pub const SLICE_MARKED: u32 = 2;

/// The lattice on which points of tissue are looked for in the deformed object.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Lattice {
    /// Lowest corner, subject space.
    pub corner: [f32; 4],
    /// Cells along each axis.
    pub cells: [u32; 4],
    /// Side of a cell, subject units.
    pub side: f32,
    /// Points that are followed.
    pub count: u32,
    /// Number of the dispatch where a program takes several, from 0.
    pub dispatch: u32,
    /// To the end of the row.
    pub padding: u32,
}

/// What a template reaches, for the making of the skip grid.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GridTemplate {
    /// First box, lowest corner.
    pub reach0_min: [f32; 4],
    /// First box, highest corner.
    pub reach0_max: [f32; 4],
    /// Second box, lowest corner.
    pub reach1_min: [f32; 4],
    /// Second box, highest corner.
    pub reach1_max: [f32; 4],
    /// First box in the template's own space, lowest corner.
    pub own_min: [f32; 4],
    /// First box in the template's own space, highest corner.
    pub own_max: [f32; 4],
    /// Least shift of material along each axis of the template.
    pub shift_min: [f32; 4],
    /// Greatest shift of material along each axis, or how far the map departs from its differences (rippled).
    pub shift_max: [f32; 4],
    /// Half side of the largest box in which differences tell how the map changes.
    pub detail: f32,
    /// Greatest ratio of a step's length in the template's own space to that in the straight box; 1 without a curve.
    pub stretch: f32,
    /// Longest displacement of any material, subject units, if the template lies along a curve; else 0.
    pub longest: f32,
    /// How the template moves material, one of the constants `MATERIAL_`.
    pub material: u32,
    /// 1 if the map jumps at the faces of the first box.
    pub is_torn: u32,
    /// 0 if differences across a box tell how the map changes in it; else the most parts along each side by whose
    /// corners a box is asked, and `detail` is half the side of the largest part.
    pub parts: u32,
    /// To the end of the row.
    pub padding: [u32; 2],
}

/// [`GridTemplate::material`]: moved by a bounded shift.
pub const MATERIAL_SHIFTED: u32 = 0;
/// [`GridTemplate::material`]: taken out of the cube.
pub const MATERIAL_WITHIN: u32 = 1;
/// [`GridTemplate::material`]: rolled about an axis.
pub const MATERIAL_BENT: u32 = 2;
/// [`GridTemplate::material`]: moved by a bounded shift that may change faster than differences tell.
pub const MATERIAL_RIPPLED: u32 = 3;

/// The job of the passes that make the skip grid.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GridJob {
    /// Lowest corner, subject space.
    pub origin_min: [f32; 4],
    /// Sides of a cell, subject units.
    pub cell_size: [f32; 4],
    /// Cells along each axis.
    pub cells: [u32; 4],
    /// Rest space to bricks.
    pub brick_from_rest: Affine,
    /// Bricks along each axis.
    pub bricks: [u32; 4],
    /// How far beyond its sides a cell is looked at, subject units.
    pub margin: f32,
    /// Ways are not followed farther than this, cells.
    pub farthest: u32,
    /// How many cells a mask spreads.
    pub spread: u32,
    /// To the next row of four.
    pub padding: u32,
    /// In the order of [`Templates`].
    pub items: [GridTemplate; MAX_TEMPLATES],
}
