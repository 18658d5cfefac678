use super::object::{object_groups, object_pipeline};
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::{
    result_buffer, storage_buffer, submit_and_read, uniform_buffer,
};
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::Pipelines;
use crate::render::device::programs::{ProgramId, SubjectShader, module_for};
use crate::render::device::readback::Answer;
use crate::render::pack::gpu_types::Lattice;
use crate::render::pack::raycast_key::RaycastKey;
use crate::render::scene::Scene;
use crate::render::subject::textures::SubjectTextures;
use glam::Vec3;

/// Cells along the longest side of the lattice. Even a lattice with this many cells along each side has fewer cells
/// than the 2^17 that the program can number.
const CELLS: f32 = 48.0;

/// Number of blocks that the lattice is divided into; pass/follow.wgsl uses the same number.
const BLOCKS: usize = 6 * 6 * 6;

/// Largest error of a place that was found: the distance at rest, in subject units, between the wanted point and the
/// material at the place. If the error is larger, the tissue of the point counts as cut away.
const FOUND: f32 = 0.5 / 256.0;

/// Finds where points of rest space are in the deformed object. The follower compiles its programs at the first use for
/// each key of a scene, for example for templates of another kind. Built once per device.
#[derive(Debug, Default)]
pub(crate) struct Follower(Pipelines<RaycastKey, [wgpu::ComputePipeline; 2]>);

/// Places that the GPU has yet to return. Each item is the place of one point in the deformed object, subject space, or
/// `None` if the tissue of that point is cut away.
pub type PendingPlaces = Answer<Vec<Option<Vec3>>>;

fn read(bytes: &[u8]) -> Vec<Option<Vec3>> {
    let places: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(bytes);
    places
        .into_iter()
        .map(|[x, y, z, off]| (off <= FOUND).then_some(Vec3::new(x, y, z)))
        .collect()
}

impl Follower {
    /// Starts to look for points (rest space) in the deformed object of a scene. There has to be at least one point.
    pub(crate) fn find(
        &self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        scene: &Scene,
        points: &[Vec3],
    ) -> PendingPlaces {
        if subject.plate.is_some() {
            let sheet = scene.sheet().map(|buffers| &buffers.sheet);
            let place = |point: &Vec3| sheet.and_then(|sheet| sheet.seen(*point));
            return Answer::known(points.iter().map(place).collect());
        }
        let key = scene.key();
        let made = || pipelines(gpu, &key, subject.shader);
        let [search, settle] = self.0.get(key, made);
        let bounds = scene.bounds();
        let side = bounds.size().max_element() / CELLS;
        let cells = (bounds.size() / side).ceil().max(Vec3::ONE).as_uvec3();
        let lattice = Lattice {
            corner: bounds.min.extend(0.0).to_array(),
            cells: cells.extend(0).to_array(),
            side,
            count: points.len() as u32,
            dispatch: 0,
            padding: 0,
        };
        let padded: Vec<[f32; 4]> = points.iter().map(|p| [p.x, p.y, p.z, 0.0]).collect();
        let lattice_buffer = uniform_buffer(gpu, "lattice", &lattice);
        let followed = storage_buffer(gpu, "followed points", &padded);
        let nearest = storage_buffer(gpu, "nearest cells", &vec![u32::MAX; BLOCKS * points.len()]);
        let places = result_buffer(gpu, "places", 16 * points.len() as u64);
        let mut encoder = encoder(gpu);
        let mut encode = |pipeline: &wgpu::ComputePipeline, groups: u32, has_places: bool| {
            let object = object_groups(gpu, pipeline, subject, scene);
            let point_entries = [
                entry(0, lattice_buffer.as_entire_binding()),
                entry(1, followed.as_entire_binding()),
                entry(2, nearest.as_entire_binding()),
                entry(3, places.as_entire_binding()),
            ];
            let point_entries = &point_entries[..if has_places { 4 } else { 3 }];
            let points = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("followed points"),
                layout: &pipeline.get_bind_group_layout(3),
                entries: point_entries,
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("follow"),
                timestamp_writes: None,
            });
            pass.set_pipeline(pipeline);
            for (index, group) in (1..).zip(object.iter().chain([&points])) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.dispatch_workgroups(groups, 1, 1);
        };
        encode(&search, cells.element_product().div_ceil(64), false);
        encode(&settle, points.len() as u32, true);
        Answer::new(submit_and_read(gpu, encoder, &places), read)
    }
}

fn pipelines(gpu: &Gpu, key: &RaycastKey, subject: SubjectShader) -> [wgpu::ComputePipeline; 2] {
    let module = module_for(gpu, ProgramId::Follow, subject, key.cases());
    ["search", "settle"].map(|name| object_pipeline(gpu, &module, name, key))
}
