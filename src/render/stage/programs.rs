use super::baked::BakePrograms;
use super::bodies::BodyProgram;
use super::kept::DistancePrograms;
use super::rigid::RigidPrograms;
use super::skip_grid::GridPrograms;
use crate::render::device::gpu::Gpu;

/// The programs of all stages. Built once per device and shared by its scenes; what not every document needs is
/// compiled when it is first asked for.
#[derive(Debug)]
pub(crate) struct StagePrograms {
    pub grid: GridPrograms,
    pub bake: BakePrograms,
    pub distance: DistancePrograms,
    pub rigid: RigidPrograms,
    pub bodies: BodyProgram,
}

impl StagePrograms {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            grid: GridPrograms::new(gpu),
            bake: BakePrograms::default(),
            distance: DistancePrograms::default(),
            rigid: RigidPrograms::default(),
            bodies: BodyProgram::default(),
        }
    }
}
