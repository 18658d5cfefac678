//! What the evaluation asks the GPU: the program's own files with `methods.wgsl` behind them, on an analytic object.

use crate::gpu::gpu;
use crate::reference::{self, Placed};
use crate::scatter::Random;
use fabrica::data::Resources;
use fabrica::document::PlacedTemplate;
use fabrica::render::gpu_types::{Subject, Templates};
use fabrica::render::programs::{SubjectShader, files_of};
use fabrica::render::{
    Probe, Sample, WorkDone, result_buffer, storage_buffer, submit_and_read, uniform_buffer,
};
use glam::{Affine3A, DMat3, DVec3, Vec3};
use half::f16;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Direction of the light in methods.wgsl.
pub(crate) const LIGHT: DVec3 = DVec3::new(0.48, -0.64, 0.6);

/// The numbers of methods.wgsl, with the names of table 6.2.
pub(crate) const METHODS: [(u32, &str); 7] = [
    (0, "unlit"),
    (1, "Jacobian"),
    (5, "Jacobian, Sobel at rest"),
    (2, "central differences on the fly"),
    (3, "Sobel on the fly"),
    (4, "dot product"),
    (QUICK, "Jacobian, two reaches at rest"),
];

/// The gradient at rest of a picture: by Sobel's operator.
pub(crate) const FINE: u32 = 1;
/// That of pictures before: the mean of central differences of two reaches.
pub(crate) const QUICK: u32 = 6;

/// The exact map at points, by the program's WGSL.
pub(crate) fn probe(list: &[PlacedTemplate], points: &[Vec3]) -> Vec<Sample> {
    let probe = pollster::block_on(Probe::new(gpu())).expect("the probe program compiles");
    pollster::block_on(probe.samples_of(&Templates::pack(list, &Resources::default()), points))
        .expect("samples")
}

/// Jacobian of the whole map in f64: differences of the closed form over 2e-6, wrong by about 1e-10.
pub(crate) fn jacobian(list: &[Placed], pos: DVec3) -> DMat3 {
    let h = 1e-6;
    let column = |axis: DVec3| {
        let (a, b) = (pos + axis * h, pos - axis * h);
        (reference::map(list, a).0 - reference::map(list, b).0) / (2.0 * h)
    };
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// An object whose surface is known: its signed distance, positive outside, and the gradient of that.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Object {
    /// An ellipsoid of these radii. Its distance is exact to first order at the surface.
    Egg(DVec3),
    /// A box about the origin with these half sides.
    Block(DVec3),
}

impl Object {
    pub(crate) fn distance(self, p: DVec3) -> f64 {
        match self {
            Self::Egg(radii) => {
                let (k, slope) = ((p / radii).length(), (p / (radii * radii)).length());
                k * (k - 1.0) / slope.max(1e-9)
            }
            Self::Block(half) => {
                let d = p.abs() - half;
                d.max(DVec3::ZERO).length() + d.max_element().min(0.0)
            }
        }
    }

    /// Normal of the surface nearest to `p`, outwards, unit length.
    pub(crate) fn normal(self, p: DVec3) -> DVec3 {
        match self {
            Self::Egg(radii) => (p / (radii * radii)).normalize(),
            Self::Block(half) => {
                let d = p.abs() - half;
                let out = d.max(DVec3::ZERO);
                if out.length() > 0.0 {
                    return (out * p.signum()).normalize();
                }
                let largest = d.max_element();
                let axis = d.cmpeq(DVec3::splat(largest));
                DVec3::select(axis, p.signum(), DVec3::ZERO).normalize()
            }
        }
    }
}

/// How softly a scanner sees an edge: value = 1 / (1 + exp(distance / this)), voxels.
const SOFTNESS: f64 = 0.8;

/// How a scanner takes an object into voxels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scanner {
    /// Voxels along x and y.
    pub(crate) n: u32,
    /// How many times as thick as wide a slice is. Its values are means over its thickness.
    pub(crate) thick: u32,
    /// Width of the even noise of values, which are 0 outside and 1 inside.
    pub(crate) noise: f64,
}

/// An analytic object as a scan of the unit cube, on the GPU in the program's own format.
pub(crate) struct Scan {
    uniform: wgpu::Buffer,
    texture: wgpu::TextureView,
    sampler: wgpu::Sampler,
    full_slope: f64,
}

impl Scan {
    /// By cubes of voxels, without noise.
    pub(crate) fn new(object: Object, n: u32) -> Self {
        let (thick, noise) = (1, 0.0);
        Self::by(object, Scanner { n, thick, noise })
    }

    pub(crate) fn by(object: Object, scanner: Scanner) -> Self {
        let gpu = gpu();
        let n = scanner.n;
        let slices = n / scanner.thick;
        let spacing = 1.0 / f64::from(n);
        let centre = |i: u32| (f64::from(i) + 0.5) * spacing - 0.5;
        let value = |at: DVec3| 1.0 / (1.0 + (object.distance(at) / spacing / SOFTNESS).exp());
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let mut voxels = Vec::with_capacity((n * n * slices) as usize);
        for i in 0..n * n * slices {
            let column = (centre(i % n), centre(i / n % n));
            let first = i / n / n * scanner.thick;
            let layers = first..first + scanner.thick;
            let sum: f64 = layers
                .map(|layer| value(DVec3::new(column.0, column.1, centre(layer))))
                .sum();
            let noise = scanner.noise * (f64::from(random.unit()) - 0.5);
            let mean = sum / f64::from(scanner.thick);
            voxels.push(f16::from_f64(mean + noise).to_bits());
        }
        let dims = [n, n, slices];
        let texture = texture(
            wgpu::TextureFormat::R16Float,
            wgpu::TextureDimension::D3,
            dims,
        );
        gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(&voxels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(2 * n),
                rows_per_image: Some(n),
            },
            texture.size(),
        );
        let uniform = Subject {
            texture_from_rest: Affine3A::from_translation(Vec3::splat(0.5)).into(),
            dims: [n as f32, n as f32, slices as f32, 0.0],
            texture_end: [1.0; 4],
            value_range: 1.0,
            detail: spacing as f32,
            ..Subject::default()
        };
        Self {
            uniform: uniform_buffer(gpu, "analytic scan", &uniform),
            texture: texture.create_view(&Default::default()),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            full_slope: 0.25 / SOFTNESS,
        }
    }
}

/// A texture of so many texels.
fn texture(
    format: wgpu::TextureFormat,
    dimension: wgpu::TextureDimension,
    [width, height, depth_or_array_layers]: [u32; 3],
) -> wgpu::Texture {
    gpu().device.create_texture(&wgpu::TextureDescriptor {
        label: Some("texels"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// A method on a deformed scan, ready to run.
pub(crate) struct Method<'a> {
    scan: &'a Scan,
    pipeline: wgpu::ComputePipeline,
    templates: wgpu::Buffer,
    /// Of a list without fields.
    fields: wgpu::TextureView,
    /// Of a list without objects that carve.
    carvers: wgpu::TextureView,
    sweeps: wgpu::TextureView,
}

fn source() -> String {
    let mut text = String::new();
    let mut known = BTreeSet::new();
    for path in [
        "displace/compose.wgsl",
        "march/ray.wgsl",
        "march/value.wgsl",
    ] {
        for file in files_of(path, &SubjectShader::Volume.paths()) {
            if known.insert(file.path) {
                let _ = writeln!(text, "{}", file.source);
            }
        }
    }
    text + include_str!("methods.wgsl")
}

impl<'a> Method<'a> {
    pub(crate) fn new(scan: &'a Scan, list: &[PlacedTemplate], entry: &str, method: u32) -> Self {
        let gpu = gpu();
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("methods"),
                source: wgpu::ShaderSource::Wgsl(source().into()),
            });
        let packed = Templates::pack(list, &Resources::default());
        let constants = [
            ("method", f64::from(method)),
            ("full_slope", scan.full_slope),
            ("drawn_kinds", f64::from(packed.drawn_kinds())),
        ];
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("methods"),
                layout: None,
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            });
        Self {
            scan,
            pipeline,
            templates: uniform_buffer(gpu, "templates", &packed),
            fields: texture(
                wgpu::TextureFormat::Rgba16Float,
                wgpu::TextureDimension::D3,
                [1; 3],
            )
            .create_view(&Default::default()),
            carvers: texture(
                wgpu::TextureFormat::R32Uint,
                wgpu::TextureDimension::D2,
                [1; 3],
            )
            .create_view(&Default::default()),
            sweeps: texture(
                wgpu::TextureFormat::Rgba32Float,
                wgpu::TextureDimension::D2,
                [1; 3],
            )
            .create_view(&Default::default()),
        }
    }

    /// Normal and light at each point.
    pub(crate) fn run(&self, points: &[Vec3]) -> Vec<(DVec3, f64)> {
        let gpu = gpu();
        let padded: Vec<[f32; 4]> = points.iter().map(|p| [p.x, p.y, p.z, 0.0]).collect();
        let input = storage_buffer(gpu, "points", &padded);
        let output = result_buffer(gpu, "results", 16 * points.len() as u64);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let group = |index, entries: &[wgpu::BindGroupEntry<'_>]| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("methods"),
                layout: &self.pipeline.get_bind_group_layout(index),
                entries,
            })
        };
        let groups = [
            (
                1,
                group(
                    1,
                    &[
                        entry(0, self.scan.uniform.as_entire_binding()),
                        entry(1, wgpu::BindingResource::TextureView(&self.scan.texture)),
                        entry(2, wgpu::BindingResource::Sampler(&self.scan.sampler)),
                    ],
                ),
            ),
            (
                2,
                group(
                    2,
                    &[
                        entry(0, self.templates.as_entire_binding()),
                        entry(7, wgpu::BindingResource::TextureView(&self.fields)),
                        entry(13, wgpu::BindingResource::TextureView(&self.carvers)),
                        entry(15, wgpu::BindingResource::TextureView(&self.sweeps)),
                    ],
                ),
            ),
            (
                3,
                group(
                    3,
                    &[
                        entry(0, input.as_entire_binding()),
                        entry(1, output.as_entire_binding()),
                    ],
                ),
            ),
        ];
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline);
            for (index, group) in &groups {
                pass.set_bind_group(*index, group, &[]);
            }
            pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
        }
        let bytes = pollster::block_on(submit_and_read(gpu, encoder, &output)).expect("results");
        assert_eq!(
            gpu.take_errors(),
            Vec::<String>::new(),
            "the device refused something"
        );
        bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes)
            .into_iter()
            .map(|[x, y, z, w]| (Vec3::new(x, y, z).as_dvec3(), f64::from(w)))
            .collect()
    }
}

/// Seconds of the fastest of some runs, after one that warms up: what disturbs a run only makes it longer.
pub(crate) fn seconds(repeats: usize, mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for turn in 0..=repeats {
        let start = std::time::Instant::now();
        run();
        pollster::block_on(WorkDone::start(gpu())).expect("done");
        if turn > 0 {
            best = best.min(start.elapsed().as_secs_f64());
        }
    }
    best
}
