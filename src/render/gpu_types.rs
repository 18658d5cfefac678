//! Mirrors of the structs in `shaders/types.wgsl`, member by member and in order; `tests/layout.rs` compares them.

use crate::displace::solved_points;
use crate::document::{
    FieldRef, FieldSamples, MAX_FIELDS, MAX_PARAM_FLOATS, PlacedTemplate, TemplateData,
    TemplateMode,
};
use glam::{Affine3A, Mat3A, Vec3A};

/// Format of the transfer table.
pub const TABLE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Templates of one document at most (spec/contract.md, "Limits").
pub const MAX_TEMPLATES: usize = 32;
/// Entries of [`Templates::pool`].
pub const POOL: usize = 640;
/// `Template::mode`: acts on what the ones before left.
pub const MODE_COMPOSE: u32 = 0;
/// `Template::mode`: summed with the one before.
pub const MODE_ADD: u32 = 1;

/// Rows of an affine map as the shaders take it.
pub fn affine_rows(affine: &Affine3A) -> [[f32; 4]; 3] {
    let m = affine.matrix3;
    let t = affine.translation;
    std::array::from_fn(|i| [m.x_axis[i], m.y_axis[i], m.z_axis[i], t[i]])
}

/// One placed template.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Template {
    /// Affine from subject to template space, first row.
    pub template_from_subject_row0: [f32; 4],
    /// Second row.
    pub template_from_subject_row1: [f32; 4],
    /// Third row.
    pub template_from_subject_row2: [f32; 4],
    /// Affine from template to subject space, first row.
    pub subject_from_template_row0: [f32; 4],
    /// Second row.
    pub subject_from_template_row1: [f32; 4],
    /// Third row.
    pub subject_from_template_row2: [f32; 4],
    /// xyz: side lengths of the box that it acts in, subject units; w: along x of the straight box where it lies along a curve.
    pub size: [f32; 4],
    /// Parameters 0 to 3.
    pub params0: [f32; 4],
    /// Parameters 4 to 7.
    pub params1: [f32; 4],
    /// `TemplateKind as u32`.
    pub kind: u32,
    /// [`MODE_COMPOSE`] or [`MODE_ADD`].
    pub mode: u32,
    /// Index of its curve in the pool, 0 if it is straight.
    pub flags: u32,
    /// Index of the composing template that heads its `add` group (its own if it composes).
    pub group: u32,
}

/// All templates that act, in order.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Templates {
    /// The first `count[0]` count.
    pub items: [Template; MAX_TEMPLATES],
    /// x: how many.
    pub count: [u32; 4],
    /// What templates hold besides parameters.
    pub pool: [[f32; 4]; POOL],
}

impl Templates {
    /// No templates: the identity.
    pub const NONE: Self = Self {
        items: [Template {
            template_from_subject_row0: [0.0; 4],
            template_from_subject_row1: [0.0; 4],
            template_from_subject_row2: [0.0; 4],
            subject_from_template_row0: [0.0; 4],
            subject_from_template_row1: [0.0; 4],
            subject_from_template_row2: [0.0; 4],
            size: [0.0; 4],
            params0: [0.0; 4],
            params1: [0.0; 4],
            kind: 0,
            mode: 0,
            flags: 0,
            group: 0,
        }; MAX_TEMPLATES],
        count: [0; 4],
        pool: [[0.0; 4]; POOL],
    };

    /// Packs the enabled templates. An `add` with no enabled one before it composes (spec/templates.md). More than
    /// [`MAX_TEMPLATES`] cannot come from a valid document; what is over is left out.
    pub fn pack(placed: &[PlacedTemplate]) -> Self {
        let mut packed = Self::NONE;
        let acting = placed.iter().map(PlacedTemplate::acting);
        let enabled: Vec<_> = acting.filter(|t| t.enabled).take(MAX_TEMPLATES).collect();
        let (mut count, mut group) = (0, 0);
        // The first entry stays 0: no points, no samples, no curve. Curves come first: there is room for one of every template.
        let (mut used, mut slice) = (1, 0);
        let mut fields = 0;
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
            *slot = Template::pack(template, group, count);
            if let Some(bent) = template.bent()
                && let Some(first) = hold(&bent.rows())
            {
                slot.size = bent.size().extend(slot.size[0]).to_array();
                slot.flags = first as u32;
            }
            count += 1;
        }
        for (slot, template) in packed.items.iter_mut().zip(&enabled) {
            let held = match &template.data {
                TemplateData::Points(_) => solved_points(template),
                TemplateData::Field(field) if fields < MAX_FIELDS => {
                    fields += usize::from(field.samples.is_some());
                    field_place(field, &mut slice)
                }
                TemplateData::Field(_) | TemplateData::None => Vec::new(),
            };
            if let Some(first) = hold(&held) {
                slot.params1[3] = first as f32;
            }
        }
        packed.count[0] = count;
        packed
    }

    /// Bit k: templates of kind k occur; bit 0: some lie along a curve. Pipelines are made for this.
    pub fn drawn_kinds(&self) -> u32 {
        let used = self.items.iter().take(self.count[0] as usize);
        used.fold(0, |bits, t| {
            let kind = 1u32.checked_shl(t.kind).unwrap_or(0);
            bits | kind | u32::from(t.flags != 0)
        })
    }
}

/// Where the samples of a field begin among those of all, as packed into the pool.
fn field_place(field: &FieldRef, slice: &mut u32) -> Vec<[f32; 4]> {
    let Some(FieldSamples(samples)) = &field.samples else {
        return Vec::new();
    };
    let [x, y, z] = samples.dims;
    let place = [x as f32, y as f32, z as f32, *slice as f32];
    *slice += z;
    vec![place]
}

impl Template {
    /// Of one that acts ([`PlacedTemplate::acting`]).
    fn pack(placed: &PlacedTemplate, group: u32, index: u32) -> Self {
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
        let to = affine_rows(&template_from_subject);
        let from = affine_rows(&subject_from_template);
        let mut floats = Vec::with_capacity(MAX_PARAM_FLOATS);
        for value in &placed.params {
            value.pack(&mut floats);
        }
        floats.resize(MAX_PARAM_FLOATS, 0.0);
        let quad = |i: usize| [floats[i], floats[i + 1], floats[i + 2], floats[i + 3]];
        Self {
            template_from_subject_row0: to[0],
            template_from_subject_row1: to[1],
            template_from_subject_row2: to[2],
            subject_from_template_row0: from[0],
            subject_from_template_row1: from[1],
            subject_from_template_row2: from[2],
            size: [p.size.x, p.size.y, p.size.z, 0.0],
            params0: quad(0),
            params1: quad(4),
            kind: placed.kind as u32,
            mode: if group == index {
                MODE_COMPOSE
            } else {
                MODE_ADD
            },
            flags: 0,
            group,
        }
    }
}

/// `FeatureItem::keeps`: what lies deep under the outer surface.
pub const KEEPS_DEEP: u32 = 16;
/// `FeatureItem::keeps`: the displacement gives way to nothing.
pub const CONSTRAIN_NOTHING: u32 = 0;
/// By its length.
pub const CONSTRAIN_DISPLACEMENT: u32 = 1;
/// By the template's main parameter.
pub const CONSTRAIN_COORDINATE: u32 = 2;
/// `FeatureItem::keeps[3]`: moves as a whole.
pub const CONSTRAIN_RIGID: u32 = 3;

/// What one template leaves alone.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FeatureItem {
    /// x: sets kept; y: first template of the run that keeps the same; z: sets given way to; w: `CONSTRAIN_` mode.
    pub keeps: [u32; 4],
    /// x: depth from where on tissue is kept; y: width of the blend; z: longest displacement of the group. Subject units.
    pub lengths: [f32; 4],
}

/// Kept tissue of a document.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Features {
    /// Affine from rest space to texture space of the distances, first row.
    pub distance_from_rest_row0: [f32; 4],
    /// Second row.
    pub distance_from_rest_row1: [f32; 4],
    /// Third row.
    pub distance_from_rest_row2: [f32; 4],
    /// xyz: distance voxels; w: their smallest spacing, subject units.
    pub distance_dims: [f32; 4],
    /// x: slabs; y: slab of exact distances, or 0; z: slab of the depth, or 0.
    pub slabs: [u32; 4],
    /// Sets of each label, four bits each.
    pub label_sets: [[u32; 4]; 8],
    /// As in [`Templates`].
    pub items: [FeatureItem; MAX_TEMPLATES],
    /// Rows of the rigid motions of segments that move as a whole, three per template; only heads of groups count. Written on the GPU.
    pub motions: [[[f32; 4]; 3]; MAX_TEMPLATES],
}

/// One pass of the making of distances.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct DistanceJob {
    /// Affine from fine voxels to texture space of the volume, first row.
    pub volume_from_voxel_row0: [f32; 4],
    /// Second row.
    pub volume_from_voxel_row1: [f32; 4],
    /// Third row.
    pub volume_from_voxel_row2: [f32; 4],
    /// xyz: fine voxels; w: fine voxels along a side of a coarse one.
    pub fine: [u32; 4],
    /// xyz: coarse voxels; w: channel.
    pub coarse: [u32; 4],
    /// xyz: spacing of fine voxels, subject units; w: threshold.
    pub spacing: [f32; 4],
    /// x: first fine slice, or the slab; y: slices, or the sets; z: axis; w: 1 to read the labels.
    pub part: [u32; 4],
    /// As in [`Features`].
    pub label_sets: [[u32; 4]; 8],
}

/// One picture's camera and sampling.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Frame {
    /// Affine from view to subject space, first row.
    pub subject_from_view_row0: [f32; 4],
    /// Second row.
    pub subject_from_view_row1: [f32; 4],
    /// Third row.
    pub subject_from_view_row2: [f32; 4],
    /// Tangents of half the field of view (width, height), size of the picture in pixels.
    pub lens: [f32; 4],
    /// Place in the pixel (x, y), offset of the first step, turn of the occlusion taps.
    pub jitter: [f32; 4],
    /// Box of the deformed object; w: step, subject units.
    pub bounds_min: [f32; 4],
    /// Box of the deformed object.
    pub bounds_max: [f32; 4],
    /// Pick pass only: the pixel.
    pub pick: [f32; 4],
}

/// The uploaded volume.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Subject {
    /// Affine from rest to texture space, first row.
    pub texture_from_rest_row0: [f32; 4],
    /// Second row.
    pub texture_from_rest_row1: [f32; 4],
    /// Third row.
    pub texture_from_rest_row2: [f32; 4],
    /// The same for the label volume.
    pub label_from_rest_row0: [f32; 4],
    /// Second row.
    pub label_from_rest_row1: [f32; 4],
    /// Third row.
    pub label_from_rest_row2: [f32; 4],
    /// Voxels; w: smallest spacing, subject units.
    pub dims: [f32; 4],
    /// Label voxels; w: 1 if there are labels.
    pub label_dims: [f32; 4],
    /// Texture coordinate at which the volume ends.
    pub texture_end: [f32; 4],
    /// x: value of texel 0; y: value range.
    pub value: [f32; 4],
}

/// Transfer function, light and opacity.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Look {
    /// Table position = x · texel + y; z: tint by segment; w: specular strength.
    pub lut: [f32; 4],
    /// x: `OPACITY_…`.
    pub modes: [u32; 4],
    /// x: how much opacity follows the gradient.
    pub edges: [f32; 4],
}

/// Segments drawn as bodies of their own.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Bodies {
    /// Of each label: linear RGB and opacity; w below 0: no body.
    pub items: [[f32; 4]; 256],
}

impl Bodies {
    /// No segment is.
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

/// `Look::modes[0]`: a surface keeps its opacity.
pub const OPACITY_CONSTANCY: u32 = 0;
/// `Look::modes[0]`: particles are conserved.
pub const OPACITY_MASS: u32 = 1;
/// `Look::modes[0]`: no adjustment.
pub const OPACITY_NONE: u32 = 2;

/// The grid over the deformed space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Grid {
    /// Lowest corner, subject space.
    pub origin_min: [f32; 4],
    /// Sides of a cell, subject units.
    pub cell_size: [f32; 4],
    /// Cells along each axis; w: 1 if in use.
    pub cells: [u32; 4],
}

/// The baked map: a texture over the deformed space.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Baked {
    /// Lowest corner, subject space; offset for finite differences of the map, subject units.
    pub origin_min: [f32; 4],
    /// One over the sides of the whole box, subject units.
    pub per_unit: [f32; 4],
    /// Texels along each axis; the first slab of those that are being made.
    pub texels: [u32; 4],
}

/// From the accumulated picture to the one that is shown.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Resolve {
    /// Scale from output pixel to texture coordinate, and the largest one in use.
    pub scale: [f32; 4],
    /// Linear RGB; w: 1 if there is a background.
    pub background: [f32; 4],
    /// x: 1 for straight alpha.
    pub flags: [u32; 4],
}

/// A flat cut through the deformed object.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Slice {
    /// Affine from pixels of the slice to subject space, first row.
    pub subject_from_pixel_row0: [f32; 4],
    /// Second row.
    pub subject_from_pixel_row1: [f32; 4],
    /// Third row.
    pub subject_from_pixel_row2: [f32; 4],
    /// Grey level = x · texel + y.
    pub window: [f32; 4],
    /// Linear RGB where nothing is.
    pub background: [f32; 4],
    /// x: `SLICE_…`; y: samples per pixel along each side.
    pub modes: [u32; 4],
}

/// `Slice::modes[0]`: values as grey, by the window.
pub const SLICE_GREY: u32 = 0;
/// `Slice::modes[0]`: the look's colours.
pub const SLICE_COLORS: u32 = 1;

/// What a template reaches, for the making of the grid.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GridTemplate {
    /// First box, lowest corner; w: trusted half side.
    pub reach0_min: [f32; 4],
    /// First box, highest corner.
    pub reach0_max: [f32; 4],
    /// Second box, lowest corner; w: how much longer a step can be along a curve.
    pub reach1_min: [f32; 4],
    /// Second box, highest corner; w: the longest way along a curve, subject units.
    pub reach1_max: [f32; 4],
    /// First box in the template's own space, lowest corner.
    pub own_min: [f32; 4],
    /// Highest corner.
    pub own_max: [f32; 4],
    /// Least shift; w: how material moves.
    pub shift_min: [f32; 4],
    /// Greatest shift; w: 1 if torn.
    pub shift_max: [f32; 4],
}

/// One making of the grid.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GridJob {
    /// Lowest corner; w: margin of a cell, subject units.
    pub origin_min: [f32; 4],
    /// Sides of a cell, subject units.
    pub cell_size: [f32; 4],
    /// Cells along each axis; w: farthest way.
    pub cells: [u32; 4],
    /// Affine from rest space to bricks, first row.
    pub brick_from_rest_row0: [f32; 4],
    /// Second row.
    pub brick_from_rest_row1: [f32; 4],
    /// Third row.
    pub brick_from_rest_row2: [f32; 4],
    /// Bricks along each axis; w: how many cells a mask spreads.
    pub bricks: [u32; 4],
    /// In the order of [`Templates`].
    pub items: [GridTemplate; MAX_TEMPLATES],
}
