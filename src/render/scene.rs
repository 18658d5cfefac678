//! Everything that is ready to be drawn: an illustration on a subject, on the GPU.

use crate::data::{Resources, Sheet};
use crate::displace::DRAWN_OF_SWEEPS;
use crate::document::{Illustration, Style};
use crate::math::Aabb;
use crate::placed::least_coat;
use crate::render::device::bindings::entry;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::device::programs::SubjectShader;
use crate::render::pack::frame::longest_step;
use crate::render::pack::notice::RenderNotice;
use crate::render::pack::raycast_key::{Finds, RaycastKey};
use crate::render::pack::stamps::MadeFrom;
use crate::render::stage::baked::BakedTexture;
use crate::render::stage::bodies::BodyTextures;
use crate::render::stage::held::HeldTextures;
use crate::render::stage::inputs::Inputs;
use crate::render::stage::kept::KeptTextures;
use crate::render::stage::look::LookTable;
use crate::render::stage::objects::ObjectTextures;
use crate::render::stage::programs::StagePrograms;
use crate::render::stage::rigid::RigidMotions;
use crate::render::stage::sheet::SheetBuffers;
use crate::render::stage::skip_grid::{GridInput, SkipGrid};
use crate::render::stage::templates::TemplateBuffer;
use crate::render::subject::textures::SubjectTextures;

/// Kinds of templates from which on the baked map is used: one formula or two are as fast as a texture.
const LEAST_BAKED_KINDS: u32 = 3;
/// Texels that the smallest coating of a sweep has in the baked map at least (spec/sweepers.md, A.3): with fewer,
/// tissue is drawn more than a texel beside its place.
const TEXELS_A_COAT: f32 = 8.0;
/// Texels along the longest side that are made for the sake of a coating at most: 56 MiB. Thinner ones are drawn by
/// their formula while things move too.
const MOST_COAT_TEXELS: u32 = 192;

/// An illustration on the GPU, for one subject. Brought up to date after each edit of the document.
///
/// Each stage compares the stamps of its inputs with the stamps from its last update, and updates itself if they
/// differ.
#[derive(Debug)]
pub(crate) struct Scene {
    /// Bind group 2: templates, look and kept tissue.
    pub bindings: wgpu::BindGroup,
    /// Output texture that a whole picture of this scene was last drawn into.
    pub drawn_generation: u64,
    /// Grows with every change.
    pub revision: u64,
    inputs: Inputs,
    subject: SubjectShader,
    has_segments: bool,
    /// Pictures lie on the subject's triangles.
    has_textures: bool,
    templates: TemplateBuffer,
    held: HeldTextures,
    kept_textures: KeptTextures,
    motions: RigidMotions,
    bodies: BodyTextures,
    look: LookTable,
    objects: ObjectTextures,
    /// The bent figure, if the subject is one.
    sheet: Option<SheetBuffers>,
    grid: Option<SkipGrid>,
    /// Bound where there is no skip grid.
    no_grid: (wgpu::Buffer, wgpu::TextureView),
    /// The smallest coating of the sweeps that act, or less of one that is sheared, subject units.
    least_coat: Option<f32>,
    baked: Option<BakedTexture>,
    baked_from: MadeFrom<3>,
    bound_from: MadeFrom<4>,
}

impl Drop for Scene {
    /// Gives its memory back to the device. A browser would do so late, when it collects what nobody holds.
    fn drop(&mut self) {
        let views = [
            &self.kept_textures.view,
            &self.kept_textures.shares.view,
            &self.bodies.view,
            &self.look.view,
            &self.objects.view,
            &self.no_grid.1,
        ];
        for view in views {
            view.texture().destroy();
        }
        let buffers = [
            &self.templates.uniform,
            &self.kept_textures.uniform,
            &self.bodies.uniform,
            &self.look.uniform,
            &self.look.mesh_uniform,
            &self.objects.uniform,
            &self.no_grid.0,
        ];
        for buffer in buffers {
            buffer.destroy();
        }
        self.held.destroy();
        if let Some(sheet) = &self.sheet {
            sheet.destroy();
        }
        if let Some(grid) = &self.grid {
            grid.destroy();
        }
        if let Some(baked) = &self.baked {
            baked.destroy();
        }
    }
}

impl Scene {
    /// Holds nothing until [`Scene::update`].
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, wants_grid: bool) -> Self {
        let templates = TemplateBuffer::new(gpu);
        let held = HeldTextures::new(gpu);
        let kept_textures = KeptTextures::new(gpu);
        let bodies = BodyTextures::new(gpu);
        let look = LookTable::new(gpu);
        let objects = ObjectTextures::new(gpu);
        let grid = wants_grid.then(|| SkipGrid::new(gpu));
        let no_grid = SkipGrid::none(gpu);
        let bindings = Bound {
            templates: &templates,
            look: &look,
            grid: grid
                .as_ref()
                .map_or((&no_grid.0, &no_grid.1), SkipGrid::binding),
            kept_textures: &kept_textures,
            held: &held,
            bodies: &bodies,
            objects: &objects,
        }
        .group(gpu, layouts);
        Self {
            bindings,
            drawn_generation: 0,
            revision: 0,
            inputs: Inputs::new(),
            subject: SubjectShader::Volume,
            has_segments: false,
            has_textures: false,
            templates,
            held,
            kept_textures,
            motions: RigidMotions::default(),
            bodies,
            look,
            objects,
            sheet: None,
            grid,
            no_grid,
            least_coat: None,
            baked: None,
            baked_from: MadeFrom::default(),
            bound_from: MadeFrom::default(),
        }
    }

    /// Notices about the document since the last call.
    pub(crate) fn take_notices(&mut self) -> Vec<RenderNotice> {
        self.inputs.take_notices()
    }

    /// Takes over what changed. True if the picture changes by it.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        programs: &StagePrograms,
        subject: &SubjectTextures,
        (illustration, resources): (&Illustration, &Resources),
    ) -> bool {
        let flat;
        let illustration = match subject.plate {
            Some(_) => {
                flat = illustration.flat();
                &flat
            }
            None => illustration,
        };
        self.inputs.update(illustration, resources, subject);
        let acting = illustration.templates.iter().map(|t| resources.acting(t));
        let coats = acting.filter(|t| t.enabled).filter_map(|t| least_coat(&t));
        self.least_coat = coats.reduce(f32::min);
        let has_other_sheet = self.update_sheet(gpu, subject, resources);
        self.has_segments = subject.info.has_segments;
        self.has_textures = subject.texture_bytes() > 0;
        self.subject = subject.shader;
        let inputs = &self.inputs;
        self.templates.update(gpu, &inputs.templates);
        self.held.update(gpu, &inputs.held);
        self.kept_textures
            .update(gpu, &programs.distance, subject, &inputs.kept);
        let textures = (&self.kept_textures, &self.held);
        let templates = &self.templates.uniform;
        self.motions
            .update(gpu, &programs.rigid, inputs, subject, templates, textures);
        self.bodies
            .update(gpu, &programs.bodies, subject, &inputs.bodies);
        self.look.update(gpu, subject, &inputs.look);
        self.look.update_mesh(gpu, &inputs.mesh_look);
        self.objects.update(gpu, &inputs.objects);
        if let Some(grid) = &mut self.grid {
            let input = GridInput {
                inputs,
                placed: &illustration.templates,
                resources,
                templates,
                kept_textures: &self.kept_textures,
                held: &self.held,
                subject,
                step: longest_step(subject.frame.detail),
            };
            grid.update(gpu, &programs.grid, &input);
        }
        let map_from = [
            inputs.templates.stamp(),
            inputs.held.stamp(),
            inputs.bounds.stamp(),
        ];
        if self.baked_from.is_stale(map_from) {
            self.baked = None;
        }
        let textures = [
            self.held.stamp,
            self.kept_textures.stamp,
            self.bodies.stamp,
            self.objects.stamp,
        ];
        if self.bound_from.is_stale(textures) {
            self.bindings = self.bound().group(gpu, layouts);
        }
        let revision = self.inputs.revision();
        let is_other = std::mem::replace(&mut self.revision, revision) != revision;
        is_other || has_other_sheet
    }

    /// Takes over a figure that is bent in another way. True if it is.
    fn update_sheet(
        &mut self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        resources: &Resources,
    ) -> bool {
        let wanted = resources.sheet.as_ref().filter(|_| subject.plate.is_some());
        let there = self.sheet.as_ref().map(|there| &there.sheet);
        if Sheet::are_same(there, wanted) {
            return false;
        }
        if let Some(there) = self.sheet.take() {
            there.destroy();
        }
        self.sheet = wanted.map(|sheet| SheetBuffers::new(gpu, sheet));
        true
    }

    /// The bent figure, if the subject is one and the way in which it is bent is known.
    pub(crate) fn sheet(&self) -> Option<&SheetBuffers> {
        self.sheet.as_ref()
    }

    fn bound(&self) -> Bound<'_> {
        let no_grid = (&self.no_grid.0, &self.no_grid.1);
        Bound {
            templates: &self.templates,
            look: &self.look,
            grid: self.grid.as_ref().map_or(no_grid, SkipGrid::binding),
            kept_textures: &self.kept_textures,
            held: &self.held,
            bodies: &self.bodies,
            objects: &self.objects,
        }
    }

    /// The skip grid; `None` for a scene that draws without one.
    pub(crate) fn grid(&self) -> Option<&SkipGrid> {
        self.grid.as_ref()
    }

    /// Which pipeline draws it.
    pub(crate) fn key(&self) -> RaycastKey {
        let (kept, table) = (self.inputs.kept(), self.inputs.table());
        RaycastKey {
            subject: self.subject,
            drawn_kinds: self.inputs.templates.get().drawn_kinds(),
            has_labels: self.has_segments && table.is_some_and(|table| table.tint > 0.0),
            has_grid: self.grid.is_some(),
            is_baked: false,
            align_mode: kept.map_or(0, |kept| kept.align_mode),
            constraints: kept.map_or(0, |kept| kept.constraints),
            kept_by: kept.map_or(0, |kept| self.kept_textures.kept_by(kept)),
            has_bodies: self.inputs.bodies.get().is_any(),
            has_objects: self.inputs.objects.get().items.count > 0,
            has_textures: self.has_textures || self.inputs.objects.get().has_textures(),
            has_lamp: table
                .and_then(|table| table.light)
                .is_some_and(|light| light.soft > 0.0),
            has_ghost: table.is_some_and(|table| table.ghost < 1.0),
            has_shells: self.inputs.mesh_look.get().has_shells(),
            has_wires: table.is_some_and(|table| table.has_wires),
            has_edges: table.is_some_and(|table| table.gradient > 0.0),
            finds: match self.style() {
                Some(_) => Finds::Traced,
                None => Finds::Picture,
            },
        }
    }

    /// Which pipeline finds this of each ray.
    pub(crate) fn key_for(&self, finds: Finds) -> RaycastKey {
        RaycastKey {
            finds,
            ..self.key()
        }
    }

    /// Box of the deformed object, subject space.
    pub(crate) fn bounds(&self) -> Aabb {
        match &self.sheet {
            Some(sheet) => sheet.sheet.bounds(),
            None => *self.inputs.bounds.get(),
        }
    }

    /// Linear RGB; w: 1 if there is a background.
    pub(crate) fn background(&self) -> [f32; 4] {
        *self.inputs.background.get()
    }

    /// The illustrator's look, if there is one to draw.
    pub(crate) fn style(&self) -> Option<&Style> {
        Some(self.inputs.style.get()).filter(|style| !style.is_plain())
    }

    /// The uniform of the templates.
    pub(crate) fn templates(&self) -> &wgpu::Buffer {
        &self.templates.uniform
    }

    /// What templates hold besides numbers.
    pub(crate) fn held(&self) -> &HeldTextures {
        &self.held
    }

    /// True where drawing the map from a texture may be faster: it holds several formulas, or a sweep whose coatings
    /// are wide enough, and no tissue is kept, which the texture knows nothing of.
    pub(crate) fn may_bake(&self) -> bool {
        let kinds = self.inputs.templates.get().drawn_kinds() & !DRAWN_OF_SWEEPS;
        let kinds = kinds.count_ones();
        (kinds >= LEAST_BAKED_KINDS || self.least_coat.is_some())
            && self
                .texels_for_coat()
                .is_none_or(|texels| texels <= MOST_COAT_TEXELS)
            && !self.key().keeps_tissue()
    }

    /// Texels along the longest side that the smallest coating asks for; `None` if nothing is swept.
    fn texels_for_coat(&self) -> Option<u32> {
        let longest = self.bounds().size().max_element();
        let texels = TEXELS_A_COAT * longest / self.least_coat?;
        Some(texels.ceil().clamp(1.0, 1e6) as u32)
    }

    /// Bakes about so many texels more of the map, from the start (with so many texels along the longest side, or as
    /// many as suit the device) if there are none of these templates yet. Says how many it handed to the GPU: 0 once
    /// all are.
    pub(crate) fn bake(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        programs: &StagePrograms,
        texels_along: Option<u32>,
        most_texels: u32,
    ) -> u32 {
        let bounds = self.bounds();
        let least = self.texels_for_coat();
        let baked = self.baked.get_or_insert_with(|| {
            BakedTexture::new(gpu, layouts, bounds, texels_along, least.unwrap_or(0))
        });
        let drawn_kinds = self.inputs.templates.get().drawn_kinds();
        baked.advance(
            gpu,
            &programs.bake,
            (&self.templates.uniform, &self.held),
            drawn_kinds,
            most_texels,
        )
    }

    /// The baked map of these templates, if it is whole.
    pub(crate) fn baked(&self) -> Option<&BakedTexture> {
        self.baked.as_ref().filter(|baked| baked.is_whole())
    }

    /// The pipeline that draws from the baked map: one for every list of templates.
    pub(crate) fn baked_key(&self) -> RaycastKey {
        RaycastKey {
            drawn_kinds: u32::MAX,
            is_baked: true,
            ..self.key()
        }
    }

    /// Index in the document's list of an object that a ray met, from 0.
    pub(crate) fn objects_drawn(&self) -> &[usize] {
        &self.inputs.objects.get().indices
    }

    /// What templates leave alone.
    pub(crate) fn kept_textures(&self) -> &KeptTextures {
        &self.kept_textures
    }
}

/// What group 2 binds.
struct Bound<'a> {
    templates: &'a TemplateBuffer,
    look: &'a LookTable,
    grid: (&'a wgpu::Buffer, &'a wgpu::TextureView),
    kept_textures: &'a KeptTextures,
    held: &'a HeldTextures,
    bodies: &'a BodyTextures,
    objects: &'a ObjectTextures,
}

impl Bound<'_> {
    fn group(&self, gpu: &Gpu, layouts: &Layouts) -> wgpu::BindGroup {
        let view = wgpu::BindingResource::TextureView;
        let [fields, carvers, sweeps] = self.held.entries();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layouts.scene,
            entries: &[
                entry(0, self.templates.uniform.as_entire_binding()),
                entry(1, self.look.uniform.as_entire_binding()),
                entry(2, view(&self.look.view)),
                entry(3, self.grid.0.as_entire_binding()),
                entry(4, view(self.grid.1)),
                entry(5, self.kept_textures.uniform.as_entire_binding()),
                entry(6, view(&self.kept_textures.view)),
                fields,
                entry(8, self.bodies.uniform.as_entire_binding()),
                entry(9, view(&self.bodies.view)),
                entry(10, self.look.mesh_uniform.as_entire_binding()),
                entry(11, self.objects.uniform.as_entire_binding()),
                entry(12, view(&self.objects.view)),
                carvers,
                entry(14, view(&self.kept_textures.shares.view)),
                sweeps,
            ],
        })
    }
}
