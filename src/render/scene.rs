use super::baked::BakedTexture;
use super::bodies::BodyTextures;
use super::feature::{FeatureTextures, KeptTissue};
use super::field::FieldTexture;
use super::gpu_types::{Frame, Templates, affine_rows};
use super::grid::{GridInput, SkipGrid};
use super::look::{TransferTable, background_uniform};
use super::passes::{Passes, RaycastKey, Scene};
use super::subject::SubjectTextures;
use super::{Gpu, View};
use crate::displace::deformed_bounds;
use crate::document::{Illustration, OpacityMode};
use crate::math::Aabb;

/// Step at rest, in voxels of the finest spacing. Crossings are found exactly at any step; this is for thin things and haze.
const STEP_AT_REST: f32 = 0.75;
/// Step while anything moves.
const STEP_MOVING: f32 = 1.25;

/// One formula or two are as fast as a texture.
const LEAST_BAKED_KINDS: u32 = 3;

/// An illustration on the GPU, for one subject. Brought up to date per document edit; says what changed.
#[derive(Debug)]
pub(super) struct Prepared {
    pub scene: Scene,
    pub bounds: Aabb,
    pub background: [f32; 4],
    /// Output texture that a whole picture of this scene was last drawn into.
    pub drawn_generation: u64,
    /// Rises with every change.
    pub revision: u64,
    templates: Templates,
    table: Option<(TransferTable, OpacityMode)>,
    has_labels: bool,
    grid: Option<SkipGrid>,
    features: FeatureTextures,
    fields: FieldTexture,
    bodies: BodyTextures,
    baked: Option<BakedTexture>,
    /// Names that were said to be unknown.
    unknown: Vec<String>,
    notices: Vec<String>,
}

impl Prepared {
    /// Holds nothing until [`Prepared::update`].
    pub(super) fn new(
        gpu: &Gpu,
        passes: &Passes,
        subject: &SubjectTextures,
        wants_grid: bool,
    ) -> Self {
        let grid = wants_grid.then(|| SkipGrid::new(gpu));
        let features = FeatureTextures::new(gpu);
        let fields = FieldTexture::new(gpu);
        let bodies = BodyTextures::new(gpu);
        let cells = grid.as_ref().map(SkipGrid::binding);
        Self {
            scene: Scene::new(gpu, passes, cells, &features, &fields.view, &bodies),
            fields,
            bodies,
            bounds: subject.bounds,
            background: [0.0; 4],
            drawn_generation: 0,
            revision: 0,
            templates: Templates::NONE,
            table: None,
            has_labels: false,
            grid,
            features,
            baked: None,
            unknown: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// What is to be said about the document since the last call.
    pub(super) fn take_notices(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notices)
    }

    /// Says each name that means no segment once.
    fn say_unknown(&mut self, names: &[String], notice: fn(&str) -> String) {
        for name in names {
            if !self.unknown.contains(name) {
                self.notices.push(notice(name));
                self.unknown.push(name.clone());
            }
        }
    }

    /// Takes over what changed. True if the picture changes by it.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        passes: &Passes,
        subject: &SubjectTextures,
        illustration: &Illustration,
    ) -> bool {
        let mut is_changed = false;
        let mut is_grid_stale = false;
        let mut is_bound_anew = false;
        if let Some(fields) = self.fields.update(gpu, &illustration.templates) {
            self.fields = fields;
            is_bound_anew = true;
            is_changed = true;
            is_grid_stale = true;
            self.templates = Templates::NONE;
        }
        let templates = Templates::pack(&illustration.templates);
        if templates != self.templates || self.table.is_none() {
            self.scene.set_templates(gpu, &templates);
            self.templates = templates;
            self.baked = None;
            self.bounds = deformed_bounds(&illustration.templates, subject.bounds);
            is_changed = true;
            is_grid_stale = true;
        }
        let kept = KeptTissue::of(&illustration.templates, &subject.segments, subject.bounds);
        if self.features.kept() != Some(&kept) {
            self.say_unknown(&kept.unknown, kept_notice);
            is_bound_anew |= self.features.update(gpu, passes, subject, kept);
            is_changed = true;
            is_grid_stale = true;
        }
        let mut unknown = Vec::new();
        let looks = &illustration.look.segments;
        let bodies = self
            .bodies
            .update(gpu, passes, subject, looks, &mut unknown);
        self.say_unknown(&unknown, segment_notice);
        is_changed |= bodies.picture;
        if is_bound_anew || bodies.view {
            let fields = &self.fields.view;
            self.scene
                .set_features(gpu, passes, &self.features, fields, &self.bodies);
        }
        if let Some(kept) = self.features.kept().filter(|kept| kept.has_rigid())
            && is_grid_stale
        {
            let farthest = kept.items.iter().map(|i| i.lengths[2]).fold(0.0, f32::max);
            let around = Aabb {
                min: subject.bounds.min - farthest,
                max: subject.bounds.max + farthest,
            };
            self.bounds = self.bounds.union(around);
            let kinds = self.templates.drawn_kinds();
            let (templates, fields) = (&self.scene.templates, &self.fields.view);
            let made = (passes.rigid).make(gpu, kinds, subject, templates, &self.features, fields);
            if let Err(error) = made {
                self.notices.push(error.to_string());
            }
        }
        let table = TransferTable::new(&illustration.look, &illustration.subject, &subject.info);
        let mode = illustration.look.opacity;
        if self
            .table
            .as_ref()
            .is_none_or(|(t, m)| *t != table || *m != mode)
            || bodies.picture
        {
            self.scene.set_look(gpu, &table, mode, &subject.info);
            if let Some(grid) = &mut self.grid {
                grid.set_look(gpu, subject, &table, &self.bodies.visible());
                is_grid_stale = true;
            }
            self.has_labels = subject.info.has_segments && table.tint > 0.0;
            self.table = Some((table, mode));
            is_changed = true;
        }
        if let Some(grid) = &mut self.grid
            && is_grid_stale
        {
            let input = GridInput {
                placed: &illustration.templates,
                packed: &self.templates,
                templates: &self.scene.templates,
                features: &self.features,
                fields: &self.fields.view,
                bounds: self.bounds,
                subject,
                step: longest_step(subject),
            };
            grid.make(gpu, &passes.grid, &input);
        }
        let background = background_uniform(illustration.look.background);
        if background != self.background {
            self.background = background;
            is_changed = true;
        }
        self.revision += u64::from(is_changed);
        is_changed
    }

    /// The grid over the deformed space, read back; `None` without one.
    pub(super) fn grid(&self) -> Option<&SkipGrid> {
        self.grid.as_ref()
    }

    /// Which pipeline draws it.
    pub(super) fn key(&self, is_pick: bool) -> RaycastKey {
        RaycastKey {
            drawn_kinds: self.templates.drawn_kinds(),
            has_labels: self.has_labels,
            has_grid: self.grid.is_some(),
            is_baked: false,
            align_mode: self.features.kept().map_or(0, |kept| kept.align_mode),
            constraints: self.features.kept().map_or(0, |kept| kept.constraints),
            kept_by: self.features.kept().map_or(0, KeptTissue::kept_by),
            has_bodies: self.bodies.is_used(),
            has_edges: self.table.as_ref().is_some_and(|(t, _)| t.gradient > 0.0),
            is_pick,
        }
    }

    /// Sampled displacements.
    pub(super) fn fields(&self) -> &wgpu::TextureView {
        &self.fields.view
    }

    /// True where drawing the map from a texture may be faster: it holds several formulas, and no tissue is kept, which the
    /// texture knows nothing of.
    pub(super) fn may_bake(&self) -> bool {
        self.templates.drawn_kinds().count_ones() >= LEAST_BAKED_KINDS
            && !self.key(false).keeps_tissue()
    }

    /// Bakes about so many texels more of the map, from the start (with so many texels along the longest side, or as many as suit
    /// the device) if there are none of these templates yet. Says how many it handed to the GPU: 0 once all are.
    pub(super) fn bake(
        &mut self,
        gpu: &Gpu,
        passes: &Passes,
        texels_along: Option<u32>,
        most_texels: u32,
    ) -> u32 {
        let baked = self
            .baked
            .get_or_insert_with(|| BakedTexture::new(gpu, &passes.bake, self.bounds, texels_along));
        let drawn_kinds = self.templates.drawn_kinds();
        baked.advance(
            gpu,
            &passes.bake,
            [
                self.scene.templates.as_entire_binding(),
                wgpu::BindingResource::TextureView(&self.fields.view),
            ],
            drawn_kinds,
            most_texels,
        )
    }

    /// The baked map of these templates, if it is whole.
    pub(super) fn baked(&self) -> Option<&BakedTexture> {
        self.baked.as_ref().filter(|baked| baked.is_whole())
    }

    /// The pipeline that draws from the baked map: one for every list of templates.
    pub(super) fn baked_key(&self) -> RaycastKey {
        RaycastKey {
            drawn_kinds: u32::MAX,
            is_baked: true,
            ..self.key(false)
        }
    }

    /// What templates leave alone.
    pub(super) fn features(&self) -> &FeatureTextures {
        &self.features
    }
}

/// Steps are never longer than this, subject units, but for subjects of few voxels: the grid is made for it.
const LONGEST_STEP: f32 = 0.009;

/// The longest step that any ray through this subject takes.
fn longest_step(subject: &SubjectTextures) -> f32 {
    (STEP_MOVING * subject.uniform.dims[3]).max(LONGEST_STEP)
}

/// Uniform of sample `index` of a picture. The same for the same index on every machine: nothing is random.
pub(super) fn frame_of(
    view: &View,
    bounds: Aabb,
    subject: &SubjectTextures,
    index: u32,
    is_moving: bool,
) -> Frame {
    let rows = affine_rows(&view.subject_from_view);
    let voxel = subject.uniform.dims[3];
    let distance = (view.eye() - bounds.center()).length();
    let factor = if is_moving { STEP_MOVING } else { STEP_AT_REST };
    // Finer than a pixel is lost on the picture.
    let step = (voxel * factor)
        .max(0.6 * view.units_per_pixel(distance))
        .min(longest_step(subject));
    let k = index as f32;
    // Rank-1 lattice with the plastic number: the first samples already lie well apart (Roberts 2018).
    let place = |ratio: f32| (0.5 + k * ratio).fract();
    let margin = 1.5 * step;
    let min = bounds.min - margin;
    let max = bounds.max + margin;
    Frame {
        subject_from_view_row0: rows[0],
        subject_from_view_row1: rows[1],
        subject_from_view_row2: rows[2],
        lens: [view.lens.x, view.lens.y, view.size_px.x, view.size_px.y],
        jitter: [
            place(0.754_877_7),
            place(0.569_840_3),
            place(0.618_034),
            k * 2.399_963,
        ],
        bounds_min: [min.x, min.y, min.z, step],
        bounds_max: [max.x, max.y, max.z, 0.0],
        pick: [0.0; 4],
    }
}

/// Says that a name in `look.segments` means nothing here.
fn segment_notice(name: &str) -> String {
    format!("look: the subject has no segment “{name}”")
}

/// Says that a name in `keep` means nothing here.
pub(super) fn kept_notice(name: &str) -> String {
    format!("keep: the subject has no segment “{name}”; nothing is kept for it")
}
