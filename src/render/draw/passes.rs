use super::follow::Follower;
use super::object::ObjectProbes;
use super::raycast::RaycastPasses;
use super::resolve::ResolvePass;
use super::sheet::SheetPass;
use super::slice::SlicePasses;
use super::style::StylePass;
use crate::data::Resources;
use crate::document::Illustration;
use crate::render::device::gpu::Gpu;
use crate::render::device::layouts::Layouts;
use crate::render::scene::Scene;
use crate::render::stage::programs::StagePrograms;
use crate::render::subject::textures::SubjectTextures;
use std::sync::Arc;

/// Layouts and programs. Built once per device and shared by everything that draws on it.
#[derive(Debug)]
pub(crate) struct Passes {
    pub layouts: Layouts,
    pub stages: StagePrograms,
    pub raycast: RaycastPasses,
    pub style: StylePass,
    pub sheet: SheetPass,
    pub resolve: ResolvePass,
    pub slices: SlicePasses,
    pub follower: Follower,
    pub probes: ObjectProbes,
}

impl Passes {
    /// The passes of a device.
    pub(crate) fn of(gpu: &Gpu) -> Arc<Self> {
        gpu.shared(|| Arc::new(Self::new(gpu)))
    }

    fn new(gpu: &Gpu) -> Self {
        let layouts = Layouts::new(gpu);
        Self {
            stages: StagePrograms::new(gpu),
            raycast: RaycastPasses::new(gpu, &layouts),
            style: StylePass::default(),
            sheet: SheetPass::default(),
            resolve: ResolvePass::new(gpu, &layouts),
            slices: SlicePasses::new(gpu, &layouts),
            follower: Follower::default(),
            probes: ObjectProbes::default(),
            layouts,
        }
    }

    /// A scene of an illustration and the data of its files on a subject. `wants_grid` false draws without the skip
    /// grid.
    pub(crate) fn scene(
        &self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        shown: (&Illustration, &Resources),
        wants_grid: bool,
    ) -> Scene {
        let mut scene = Scene::new(gpu, &self.layouts, wants_grid);
        self.update(gpu, &mut scene, subject, shown);
        scene
    }

    /// Brings a scene up to date. True if the picture changes by it.
    pub(crate) fn update(
        &self,
        gpu: &Gpu,
        scene: &mut Scene,
        subject: &SubjectTextures,
        shown: (&Illustration, &Resources),
    ) -> bool {
        scene.update(gpu, &self.layouts, &self.stages, subject, shown)
    }

    /// Bakes about so many texels more of a scene's map; see [`Scene::bake`].
    pub(crate) fn bake(
        &self,
        gpu: &Gpu,
        scene: &mut Scene,
        texels_along: Option<u32>,
        most_texels: u32,
    ) -> u32 {
        scene.bake(gpu, &self.layouts, &self.stages, texels_along, most_texels)
    }
}
