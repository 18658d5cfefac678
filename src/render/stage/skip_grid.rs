//! The skip grid over the deformed space: which templates reach a cell, and whether anything visible may map into it.

use super::held::HeldTextures;
use super::inputs::Inputs;
use super::kept::KeptTextures;
use crate::data::Resources;
use crate::displace::Material;
use crate::document::PlacedTemplate;
use crate::math::Aabb;
use crate::placed::{max_displacement, reach};
use crate::render::device::bindings::{encoder, entry};
use crate::render::device::buffers::uniform_buffer;
use crate::render::device::cases::Cases;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::pipelines::{Pipelines, compute_pipeline};
use crate::render::device::programs::{ProgramId, SubjectShader, module};
use crate::render::device::textures::{read_texture, row_pitch, volume_texture};
use crate::render::pack::gpu_types::{
    Affine, Grid, GridJob, GridTemplate, MATERIAL_BENT, MATERIAL_RIPPLED, MATERIAL_SHIFTED,
    MATERIAL_WITHIN, MAX_TEMPLATES,
};
use crate::render::pack::look::TransferTable;
use crate::render::pack::stamps::MadeFrom;
use crate::render::pack::values::SubjectInfo;
use crate::render::subject::bricks::{BRICK, LabelSet};
use crate::render::subject::textures::SubjectTextures;
use glam::{UVec3, Vec3};
use wgpu::util::DeviceExt as _;

/// Cells along the longest side of the box. With more cells rays leap closer to the surface, and
/// building the grid costs the cube of their number.
const CELLS: u32 = 64;

/// Cells along the longest side on a software GPU, where making the grid slows the dragging of a template.
const CELLS_SOFTWARE: u32 = 48;

/// Cells that one leap clears at most. A larger number makes the grid slower to build; longer ways take a few leaps.
const FARTHEST_WAY: u32 = 10;

/// Opacity of 0.01 units up to which the ray march sees nothing, less the rounding of half floats.
const INVISIBLE: f32 = 0.000_45;

/// Stands for no end in uniforms, where infinity is not safe.
const NO_END: f32 = 1e30;

/// A cell is looked at this far beyond its sides, subject units: differences of the map reach out of it.
const MARGIN: f32 = 0.001;

/// A ray looks for a crossing between a sample and the one before, which may lie this many steps back in another cell.
const LONGEST_STEP: f32 = 1.7;

/// The compute programs. Built once per device.
#[derive(Debug)]
pub(crate) struct GridPrograms {
    spread: [wgpu::ComputePipeline; 3],
    /// By the kinds that occur, and whether tissue is kept: software GPUs run every branch.
    fill: Pipelines<(u32, bool), wgpu::ComputePipeline>,
}

impl GridPrograms {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let module = module(gpu, ProgramId::Grid, Cases::of_kinds(0));
        let spread = ["spread_x", "spread_y", "spread_z"]
            .map(|entry| pipeline(gpu, &module, entry, 0, false));
        Self {
            spread,
            fill: Pipelines::default(),
        }
    }

    fn fill(&self, gpu: &Gpu, drawn_kinds: u32, has_kept: bool) -> wgpu::ComputePipeline {
        self.fill.get((drawn_kinds, has_kept), || {
            let module = module(gpu, ProgramId::Grid, Cases::of_kinds(drawn_kinds));
            pipeline(gpu, &module, "fill", drawn_kinds, has_kept)
        })
    }
}

fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry: &str,
    drawn_kinds: u32,
    has_kept: bool,
) -> wgpu::ComputePipeline {
    let constants = [
        ("drawn_kinds", f64::from(drawn_kinds)),
        ("has_kept", f64::from(u8::from(has_kept))),
    ];
    compute_pipeline(gpu, module, entry, &constants)
}

/// The skip grid of one illustration on one subject. Its texture and uniform stay the same objects; what they hold is
/// made anew when templates, transfer function or subject change.
#[derive(Debug)]
pub(crate) struct SkipGrid {
    uniform: wgpu::Buffer,
    view: wgpu::TextureView,
    texture: wgpu::Texture,
    job: wgpu::Buffer,
    masks: [wgpu::Buffer; 2],
    ways: [wgpu::Buffer; 2],
    /// Summed table of visible bricks, for the look it was made for.
    sums: Option<wgpu::Buffer>,
    sums_from: MadeFrom<3>,
    grid: Grid,
    grid_from: MadeFrom<5>,
}

/// Inputs of the skip grid.
pub(crate) struct GridInput<'a> {
    /// All that has a stamp.
    pub inputs: &'a Inputs,
    /// Templates as placed; the enabled ones are in the order of the packed ones.
    pub placed: &'a [PlacedTemplate],
    /// What has come of the files that they name.
    pub resources: &'a Resources,
    /// The uniform of the templates.
    pub templates: &'a wgpu::Buffer,
    /// What templates leave alone.
    pub kept_textures: &'a KeptTextures,
    /// What templates hold besides numbers.
    pub held: &'a HeldTextures,
    /// The subject on the GPU, with its value ranges by brick.
    pub subject: &'a SubjectTextures,
    /// The largest step of a ray that will read it, subject units.
    pub step: f32,
}

impl SkipGrid {
    /// Gives its memory back to the device.
    pub(crate) fn destroy(&self) {
        self.texture.destroy();
        let [masks, ways] = [&self.masks, &self.ways];
        let buffers = [&self.uniform, &self.job].into_iter();
        for buffer in buffers.chain(masks).chain(ways).chain(&self.sums) {
            buffer.destroy();
        }
    }

    /// Holds nothing until [`SkipGrid::update`].
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let format = wgpu::TextureFormat::Rg32Uint;
        let texture = volume_texture(gpu, "grid cells", UVec3::splat(CELLS), format, usage);
        let per_cell = |label| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: 4 * u64::from(CELLS).pow(3),
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        Self {
            uniform: uniform_buffer(gpu, "grid", &Grid::default()),
            view: texture.create_view(&Default::default()),
            texture,
            job: uniform_buffer(gpu, "grid job", &GridJob::default()),
            masks: [per_cell("grid masks"), per_cell("grid masks before")],
            ways: [per_cell("grid ways"), per_cell("grid ways before")],
            sums: None,
            sums_from: MadeFrom::default(),
            grid: Grid::default(),
            grid_from: MadeFrom::default(),
        }
    }

    /// A buffer and a texture to bind where there is no skip grid.
    pub(crate) fn none(gpu: &Gpu) -> (wgpu::Buffer, wgpu::TextureView) {
        let (format, usage) = (wgpu::TextureFormat::Rg32Uint, wgpu::TextureUsages::empty());
        let cells = volume_texture(gpu, "no grid", UVec3::ONE, format, usage);
        (
            uniform_buffer(gpu, "no grid", &Grid::default()),
            cells.create_view(&Default::default()),
        )
    }

    /// Bindings 3 and 4 of the scene.
    pub(crate) fn binding(&self) -> (&wgpu::Buffer, &wgpu::TextureView) {
        (&self.uniform, &self.view)
    }

    /// Updates the table of visible bricks and the grid if their inputs changed. The work is submitted when this
    /// returns; nothing is read back.
    pub(crate) fn update(&mut self, gpu: &Gpu, programs: &GridPrograms, input: &GridInput<'_>) {
        let inputs = input.inputs;
        let bricks_from = [inputs.subject, inputs.look.stamp(), inputs.bodies.stamp()];
        let has_other_bricks = self.sums_from.is_stale(bricks_from);
        if has_other_bricks && let Some(table) = inputs.table() {
            self.set_visible(gpu, input.subject, table, &inputs.bodies.get().visible());
        }
        let has_other_map = self.grid_from.is_stale([
            inputs.subject,
            inputs.templates.stamp(),
            inputs.held.stamp(),
            inputs.kept.stamp(),
            inputs.bounds.stamp(),
        ]);
        if has_other_bricks || has_other_map {
            self.make(gpu, programs, input);
        }
    }

    /// Says which bricks can be seen. `bodies` are the labels that are seen whatever their values are.
    fn set_visible(
        &mut self,
        gpu: &Gpu,
        subject: &SubjectTextures,
        table: &TransferTable,
        bodies: &LabelSet,
    ) {
        let visible = VisibleValues::new(table, &subject.info);
        let has_body = bricks_of_bodies(subject, bodies);
        let bricks = subject.bricks.dims;
        let has_values = |i: usize| {
            let ranges = &subject.bricks.ranges;
            has_body.get(i).is_some_and(|&has| has)
                || ranges.get(i).is_some_and(|range| visible.any_in(*range))
        };
        let sums = match (&subject.meshes, &subject.wide_bricks) {
            (None, _) => summed(bricks, has_values),
            (Some(meshes), _) if subject.shader == SubjectShader::Mesh => summed(bricks, |i| {
                meshes.seen_bricks.get(i).is_none_or(|&seen| seen)
            }),
            (Some(_), Some(wide)) => summed(wide.dims, |i| {
                wide.has_mesh[i] || wide.of_volume(i, bricks).is_some_and(has_values)
            }),
            // Meshes reach too far out for bricks: something may be seen everywhere, in the one brick that there is.
            (Some(_), None) => summed(UVec3::ONE, |_| true),
        };
        let buffer = gpu
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("visible bricks"),
                contents: bytemuck::cast_slice(&sums),
                usage: wgpu::BufferUsages::STORAGE,
            });
        self.sums = Some(buffer);
    }

    fn make(&mut self, gpu: &Gpu, programs: &GridPrograms, input: &GridInput<'_>) {
        let Some(sums) = &self.sums else { return };
        let along = if gpu.is_software() {
            CELLS_SOFTWARE
        } else {
            CELLS
        };
        let (grid, job) = plan(input, along);
        self.grid = grid;
        gpu.queue
            .write_buffer(&self.uniform, 0, bytemuck::bytes_of(&grid));
        gpu.queue
            .write_buffer(&self.job, 0, bytemuck::bytes_of(&job));
        let drawn_kinds = input.inputs.templates.get().drawn_kinds();
        let has_kept = (input.inputs.kept()).is_some_and(|kept| !kept.is_nothing());
        let fill = programs.fill(gpu, drawn_kinds, has_kept);
        let mut encoder = encoder(gpu);
        let groups = UVec3::from_slice(&grid.cells[..3]).map(|n| n.div_ceil(4));
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("grid"),
                timestamp_writes: None,
            });
            let bind = |pipeline: &wgpu::ComputePipeline,
                        group: u32,
                        entries: &[wgpu::BindGroupEntry<'_>]| {
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("grid"),
                    layout: &pipeline.get_bind_group_layout(group),
                    entries,
                })
            };
            let job = || entry(0, self.job.as_entire_binding());
            // Masks and ways go back and forth between two buffers each.
            let along = |i: usize, to: usize| {
                let pipeline = &programs.spread[i];
                let from = 1 - to;
                let mut entries = vec![
                    job(),
                    entry(4, self.ways[from].as_entire_binding()),
                    entry(6, self.masks[from].as_entire_binding()),
                ];
                if i == 2 {
                    entries.push(entry(5, wgpu::BindingResource::TextureView(&self.view)));
                } else {
                    entries.push(entry(2, self.masks[to].as_entire_binding()));
                    entries.push(entry(3, self.ways[to].as_entire_binding()));
                }
                (pipeline, bind(pipeline, 3, &entries))
            };
            pass.set_pipeline(&fill);
            let fill_group = bind(
                &fill,
                3,
                &[
                    job(),
                    entry(1, sums.as_entire_binding()),
                    entry(2, self.masks[0].as_entire_binding()),
                    entry(3, self.ways[0].as_entire_binding()),
                ],
            );
            let mut entries = vec![
                entry(0, input.templates.as_entire_binding()),
                entry(5, input.kept_textures.uniform.as_entire_binding()),
                entry(
                    6,
                    wgpu::BindingResource::TextureView(&input.kept_textures.view),
                ),
            ];
            entries.extend(input.held.entries());
            let templates = bind(&fill, 2, &entries);
            pass.set_bind_group(2, &templates, &[]);
            pass.set_bind_group(3, &fill_group, &[]);
            pass.dispatch_workgroups(groups.x, groups.y, groups.z);
            for (pipeline, group) in [along(0, 1), along(1, 0), along(2, 1)] {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(3, &group, &[]);
                pass.dispatch_workgroups(groups.x, groups.y, groups.z);
            }
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Reads the cells back, as made.
    pub(crate) async fn read(&self, gpu: &Gpu) -> Result<GridCells, RenderError> {
        let pitch = row_pitch(8 * CELLS);
        let bytes = read_texture(gpu, encoder(gpu), &self.texture, pitch).await?;
        let all: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&bytes);
        let [x, y, z, _] = self.grid.cells;
        let used = (0..z)
            .flat_map(|z| (0..y).map(move |y| (z * CELLS + y) * CELLS))
            .flat_map(|row| all.iter().skip(row as usize).take(x as usize));
        Ok(GridCells {
            bounds_min: Vec3::from_slice(&self.grid.origin_min[..3]),
            cell_size: Vec3::from_slice(&self.grid.cell_size[..3]),
            count: UVec3::new(x, y, z),
            cells: used.copied().collect(),
        })
    }
}

/// The skip grid as the ray march reads it, in main memory; for tests and inspection.
#[derive(Clone, Debug)]
pub struct GridCells {
    /// Lowest corner, subject space.
    pub bounds_min: Vec3,
    /// Sides of a cell, subject units.
    pub cell_size: Vec3,
    /// Cells along each axis.
    pub count: UVec3,
    /// Mask of the templates that may reach it, and 0 if something visible may be there or else how many cells around
    /// are empty; x fastest.
    pub cells: Vec<[u32; 2]>,
}

impl GridCells {
    /// Mask and emptiness of the cell that a point lies in; `None` outside.
    pub fn at(&self, pos: Vec3) -> Option<[u32; 2]> {
        let cell = ((pos - self.bounds_min) / self.cell_size).floor();
        let is_inside = cell.cmpge(Vec3::ZERO).all() && cell.cmplt(self.count.as_vec3()).all();
        let cell = cell.as_uvec3();
        let index = cell.x + self.count.x * (cell.y + self.count.y * cell.z);
        self.cells
            .get(index as usize)
            .copied()
            .filter(|_| is_inside)
    }
}

/// The uniforms: where the skip grid lies, and the job of the passes that make it.
fn plan(input: &GridInput<'_>, along: u32) -> (Grid, GridJob) {
    // No smaller than what a ray marches through: outside there are no cells to leap from.
    let bounds = input
        .inputs
        .bounds
        .get()
        .expanded(LONGEST_STEP * input.step);
    let size = bounds.size();
    // Cubes, as far as whole numbers allow.
    let edge = size.max_element() / along as f32;
    let cells = (size / edge)
        .ceil()
        .clamp(Vec3::ONE, Vec3::splat(along as f32));
    let cell_size = size / cells;
    let cells = cells.as_uvec3();
    let spread = (LONGEST_STEP * input.step / cell_size.min_element()).ceil() as u32;
    let mut items = [GridTemplate::default(); MAX_TEMPLATES];
    let acting = input.placed.iter().map(|t| input.resources.acting(t));
    let enabled = acting.filter(|t| t.enabled);
    for (slot, template) in items.iter_mut().zip(enabled) {
        *slot = item(&template, input.resources, bounds);
    }
    let subject = &input.subject.uniform;
    // Texture space times voxels per axis are voxels from the grid's edge; a brick is so many of them.
    let scale = |i: usize| subject.dims[i] / BRICK as f32;
    let (bricks, before) = match (input.subject.shader, &input.subject.wide_bricks) {
        (SubjectShader::Both, Some(wide)) => (wide.dims, wide.before),
        (SubjectShader::Both, None) => (UVec3::ONE, UVec3::ZERO),
        _ => (input.subject.bricks.dims, UVec3::ZERO),
    };
    let is_everywhere = input.subject.shader == SubjectShader::Both && bricks == UVec3::ONE;
    let row = |row: [f32; 4], i: usize| {
        if is_everywhere {
            return [0.0, 0.0, 0.0, 0.5];
        }
        let [x, y, z, at] = row.map(|v| v * scale(i));
        [x, y, z, at + before[i] as f32]
    };
    let map = subject.texture_from_rest;
    let grid = Grid {
        origin_min: bounds.min.extend(0.0).to_array(),
        cell_size: cell_size.extend(0.0).to_array(),
        cells: cells.extend(0).to_array(),
        is_used: 1,
        padding: [0; 3],
    };
    let job = GridJob {
        origin_min: grid.origin_min,
        cell_size: grid.cell_size,
        cells: grid.cells,
        brick_from_rest: Affine {
            row0: row(map.row0, 0),
            row1: row(map.row1, 1),
            row2: row(map.row2, 2),
        },
        bricks: bricks.extend(0).to_array(),
        margin: MARGIN,
        farthest: FARTHEST_WAY,
        spread,
        padding: 0,
        items,
    };
    (grid, job)
}

fn item(template: &PlacedTemplate, resources: &Resources, bounds: Aabb) -> GridTemplate {
    let reach = reach(template, resources);
    let (mut boxes, mut detail, mut stretch, mut longest) = (reach.boxes, reach.detail, 1.0, 0.0);
    if let Some(bent) = template.bent() {
        // Where nothing is changed the curve does nothing either.
        let reached = boxes.iter().filter(|part| !part.is_empty());
        let heights = reached.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], part| {
            [low.min(part.min.z), high.max(part.max.z)]
        });
        stretch = bent.stretch(heights);
        longest = max_displacement(template, resources, bounds.expanded(0.5));
        boxes = boxes.map(|part| bent.bent_box(part));
        detail *= (bent.size().x / template.placement.size.x).min(1.0) / stretch;
    }
    let corner = |v: Vec3| {
        v.clamp(Vec3::splat(-NO_END), Vec3::splat(NO_END))
            .extend(0.0)
            .to_array()
    };
    let (material, shift) = match (reach.ripple, reach.material) {
        (Some(ripple), _) => (
            MATERIAL_RIPPLED,
            Aabb {
                min: -ripple,
                max: ripple,
            },
        ),
        (None, Material::Stays) => (
            MATERIAL_SHIFTED,
            Aabb {
                min: Vec3::ZERO,
                max: Vec3::ZERO,
            },
        ),
        (None, Material::Shifted(shift)) => (MATERIAL_SHIFTED, shift),
        (None, Material::Within(_)) => (MATERIAL_WITHIN, Aabb::UNIT),
        (None, Material::Bent(_)) => (MATERIAL_BENT, Aabb::UNIT),
    };
    GridTemplate {
        reach0_min: corner(boxes[0].min),
        reach0_max: corner(boxes[0].max),
        reach1_min: corner(boxes[1].min),
        reach1_max: corner(boxes[1].max),
        own_min: corner(reach.boxes[0].min),
        own_max: corner(reach.boxes[0].max),
        shift_min: corner(shift.min),
        shift_max: corner(shift.max),
        detail: detail.min(NO_END),
        stretch,
        longest,
        material,
        is_torn: u32::from(reach.is_torn),
        parts: reach.parts,
        padding: [0; 2],
    }
}

/// Which normalised values have any opacity.
struct VisibleValues {
    /// Table entries below each index that can be seen.
    before: Vec<u32>,
    /// Table position = normalised value · x + y.
    position: [f32; 2],
}

impl VisibleValues {
    fn new(table: &TransferTable, info: &SubjectInfo) -> Self {
        let mut before = vec![0];
        let mut count = 0;
        for entry in &table.entries {
            count += u32::from(entry[3] > INVISIBLE);
            before.push(count);
        }
        let [low, high] = table.domain;
        let [value_low, value_high] = info.value_range;
        let range = if value_high > value_low {
            value_high - value_low
        } else {
            1.0
        };
        let per_value = (table.entries.len() as f32 - 1.0) / (high - low);
        Self {
            before,
            position: [range * per_value, (value_low - low) * per_value],
        }
    }

    /// True if any value from `low` to `high` can be seen.
    fn any_in(&self, [low, high]: [f32; 2]) -> bool {
        let last = self.before.len().saturating_sub(2);
        // One entry more on both sides: the shader interpolates, with its own rounding.
        let at = |value: f32| value * self.position[0] + self.position[1];
        let first = ((at(low).floor() - 1.0).max(0.0) as usize).min(last);
        let end = ((at(high).ceil() + 1.0).max(0.0) as usize).min(last) + 1;
        match (self.before.get(first), self.before.get(end)) {
            (Some(a), Some(b)) => b > a,
            _ => true,
        }
    }
}

/// Bricks that hold any of these labels, or border on one that does (a body's smooth border reaches out of its
/// voxels). All, where it is not known; none is empty.
fn bricks_of_bodies(subject: &SubjectTextures, wanted: &LabelSet) -> Vec<bool> {
    if *wanted == [0; 8] {
        return Vec::new();
    }
    let dims = subject.bricks.dims.as_usizevec3();
    let Some(sets) = &subject.label_bricks else {
        return vec![true; dims.element_product()];
    };
    let is_any = |set: &LabelSet| set.iter().zip(wanted).any(|(a, b)| a & b != 0);
    let mut has: Vec<bool> = sets.iter().map(is_any).collect();
    for (stride, side) in [(1, dims.x), (dims.x, dims.y), (dims.x * dims.y, dims.z)] {
        let before = has.clone();
        for (i, has) in has.iter_mut().enumerate() {
            let place = i / stride % side;
            *has |= (place > 0 && before[i - stride])
                || (place + 1 < side && before.get(i + stride).is_some_and(|&b| b));
        }
    }
    has
}

/// Summed table: entry (x, y, z) counts the bricks below x, y, z that are visible; one more entry than bricks on each
/// axis.
fn summed(bricks: UVec3, is_visible: impl Fn(usize) -> bool) -> Vec<u32> {
    let n = bricks.as_usizevec3();
    let (nx, ny) = (n.x + 1, n.y + 1);
    let mut sums = vec![0u32; nx * ny * (n.z + 1)];
    let mut brick = 0;
    for z in 1..=n.z {
        for y in 1..=n.y {
            let mut row = 0;
            for x in 1..=n.x {
                row += u32::from(is_visible(brick));
                brick += 1;
                let at = |y: usize, z: usize| x + nx * (y + ny * z);
                let sum = row + sums[at(y - 1, z)] + sums[at(y, z - 1)] - sums[at(y - 1, z - 1)];
                sums[at(y, z)] = sum;
            }
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_count_boxes() {
        let bricks = UVec3::new(5, 4, 3);
        let visible = |i: usize| (i * 7) % 5 < 2;
        let sums = summed(bricks, visible);
        let at = |p: UVec3| sums[(p.x + 6 * (p.y + 5 * p.z)) as usize] as i64;
        for (low, high) in [
            (UVec3::ZERO, bricks),
            (UVec3::new(1, 2, 0), UVec3::new(4, 3, 2)),
            (UVec3::new(2, 0, 1), UVec3::new(3, 4, 3)),
        ] {
            let mut expected = 0;
            for z in low.z..high.z {
                for y in low.y..high.y {
                    for x in low.x..high.x {
                        expected += i64::from(visible((x + 5 * (y + 4 * z)) as usize));
                    }
                }
            }
            let mut counted = 0;
            for corner in 0..8u32 {
                let pick = |bit: u32, axis: usize| {
                    if corner & bit == 0 {
                        low[axis]
                    } else {
                        high[axis]
                    }
                };
                let sign = if corner.count_ones() % 2 == 1 { 1 } else { -1 };
                counted += sign * at(UVec3::new(pick(1, 0), pick(2, 1), pick(4, 2)));
            }
            assert_eq!(counted, expected, "{low} to {high}");
        }
    }
}
