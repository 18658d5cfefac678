//! The light of splines: `rounds_splines` (shaders/displace/curve.wgsl) asked by a kernel of its own (splines.wgsl).

use crate::gpu::gpu;
use crate::scatter::{Random, defaults, placed};
use fabrica::data::Resources;
use fabrica::document::{
    ControlPoint, ControlPoints, Curve, PlacedTemplate, TemplateData, TemplateKind,
};
use fabrica::math::Placement;
use fabrica::render::gpu_types::Templates;
use fabrica::render::programs::{SubjectShader, files_of};
use fabrica::render::{result_buffer, storage_buffer, submit_and_read, uniform_buffer};
use glam::{DVec3, Quat, Vec2, Vec3};

/// The kernel, compiled once for all templates.
struct Lit {
    pipeline: wgpu::ComputePipeline,
    fields: wgpu::TextureView,
    carvers: wgpu::TextureView,
    sweeps: wgpu::TextureView,
}

impl Lit {
    fn new() -> Self {
        let gpu = gpu();
        let files = files_of("displace/compose.wgsl", &SubjectShader::Volume.paths());
        let mut text: String = files
            .iter()
            .map(|file| format!("{}\n", file.source))
            .collect();
        text += include_str!("splines.wgsl");
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("splines"),
                source: wgpu::ShaderSource::Wgsl(text.into()),
            });
        let descriptor = wgpu::ComputePipelineDescriptor {
            label: Some("splines"),
            layout: None,
            module: &module,
            entry_point: Some("ask"),
            compilation_options: Default::default(),
            cache: None,
        };
        let texel = |format, dimension| {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("texel"),
                size: wgpu::Extent3d::default(),
                mip_level_count: 1,
                sample_count: 1,
                dimension,
                format,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        Self {
            pipeline: gpu.device.create_compute_pipeline(&descriptor),
            fields: texel(wgpu::TextureFormat::Rgba16Float, wgpu::TextureDimension::D3),
            carvers: texel(wgpu::TextureFormat::R32Uint, wgpu::TextureDimension::D2),
            sweeps: texel(wgpu::TextureFormat::Rgba32Float, wgpu::TextureDimension::D2),
        }
    }

    /// Source of each point, and how far `bend` is from taking back `unbend` there.
    fn ask(&self, template: &PlacedTemplate, points: &[Vec3], is_lit: bool) -> Vec<(DVec3, f64)> {
        let gpu = gpu();
        let list = std::slice::from_ref(template);
        let packed = Templates::pack(list, &Resources::default());
        let templates = uniform_buffer(gpu, "templates", &packed);
        let w = f32::from(u8::from(is_lit));
        let padded: Vec<[f32; 4]> = points.iter().map(|p| [p.x, p.y, p.z, w]).collect();
        let input = storage_buffer(gpu, "points", &padded);
        let output = result_buffer(gpu, "results", 16 * points.len() as u64);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let view = wgpu::BindingResource::TextureView;
        let held = [
            entry(0, templates.as_entire_binding()),
            entry(7, view(&self.fields)),
            entry(13, view(&self.carvers)),
            entry(15, view(&self.sweeps)),
        ];
        let own = [
            entry(0, input.as_entire_binding()),
            entry(1, output.as_entire_binding()),
        ];
        let groups = [(2, &held[..]), (3, &own[..])];
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        for (index, entries) in groups {
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("splines"),
                layout: &self.pipeline.get_bind_group_layout(index),
                entries,
            });
            pass.set_bind_group(index, &group, &[]);
        }
        pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
        drop(pass);
        let bytes = pollster::block_on(submit_and_read(gpu, encoder, &output)).expect("results");
        let faults = gpu.take_errors();
        assert_eq!(faults, Vec::<String>::new(), "the device refused something");
        let answers = bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes).into_iter();
        answers
            .map(|[x, y, z, w]| (Vec3::new(x, y, z).as_dvec3(), f64::from(w)))
            .collect()
    }
}

/// How far the templates here bring tissue along the line and off it, template units.
const SHIFT: Vec3 = Vec3::new(0.017, 0.0, 0.03);

/// A template that brings its whole box along a random spline through so many places, in a box of one unit. The shift
/// itself is the same everywhere, so that the curve alone bends it.
fn along_spline(random: &mut Random, places: usize) -> PlacedTemplate {
    let placement = Placement {
        at: Vec3::ZERO,
        rotate: Quat::IDENTITY,
        size: Vec3::ONE,
    };
    let mut template = placed(TemplateKind::Rbf, placement, defaults(TemplateKind::Rbf));
    let corners = [
        [0.2, 0.2, 0.2],
        [0.8, 0.2, 0.3],
        [0.3, 0.8, 0.4],
        [0.6, 0.5, 0.9],
    ];
    let points = corners.map(|at| ControlPoint {
        at: Vec3::from_array(at),
        shift: SHIFT,
    });
    template.data = TemplateData::Points(ControlPoints {
        points: points.to_vec(),
        cut: Vec::new(),
    });
    let spans = (places - 1) as f32;
    let line = (0..places).map(|i| {
        let along = 0.1 + 0.8 * i as f32 / spans;
        // So gentle that there is room beside it, wherever the spots are.
        Vec2::new(along, 0.8 + random.between(-0.3, 0.3) / (spans * spans))
    });
    template.curve = Some(Curve::spline(line.collect()));
    template
}

/// A place of the map where its slope is looked at: the point, and a small step along the line.
struct Spot {
    at: Vec3,
    step: Vec3,
}

impl Spot {
    /// Square to the line, in the plane in which it is bent.
    fn across(&self) -> DVec3 {
        self.step.cross(Vec3::Y).as_dvec3().normalize()
    }
}

/// Spots over the borders of the pieces, and spots inside of them where neither the place nor its source is near a
/// border, at these distances from the line.
fn spots(template: &PlacedTemplate, heights: &[f32]) -> [Vec<Spot>; 2] {
    let bent = template.bent().expect("it is bent");
    let rows = bent.rows();
    let joints: Vec<(Vec2, Vec2)> = rows[1..]
        .iter()
        .map(|[x, z, mx, mz]| (Vec2::new(*x, *z), Vec2::new(*mx, *mz)))
        .collect();
    let shift = SHIFT.x * bent.size().x;
    let mut found = [Vec::new(), Vec::new()];
    let spot = |at: Vec2, step: Vec2| Spot {
        at: template
            .placement
            .subject_from_template(Vec3::new(at.x, 0.4, at.y)),
        step: Vec3::new(step.x, 0.0, step.y),
    };
    for &t in heights {
        for (i, pair) in joints.windows(2).enumerate() {
            let length = pair[0].0.distance(pair[1].0);
            let [from, to] = [0, 1].map(|k| pair[k].0 + t * pair[k].1);
            let step = 0.05 * (to - from);
            for part in [0.15, 0.3, 0.45, 0.85] {
                // Where the source passes a border.
                let border = 1.0 - shift / length;
                if (part - border).abs() > 0.07 {
                    found[1].push(spot(from.lerp(to, part), step));
                }
            }
            if i > 0 {
                // Square to the mitre, between both pieces.
                let mitre = pair[0].1.normalize();
                found[0].push(spot(from, Vec2::new(mitre.y, -mitre.x) * step.length()));
            }
        }
    }
    found
}

/// By how much the slope of the map turns over each spot: what the slopes of both sides differ by across the line.
/// Layers along the line would show facets there. How much the map stretches along the line is not looked at: off the
/// line it differs from piece to piece where the curvature does.
fn kinks(lit: &Lit, template: &PlacedTemplate, spots: &[Spot], is_lit: bool) -> Vec<f64> {
    let points: Vec<Vec3> = spots
        .iter()
        .flat_map(|spot| [-1.0, 0.0, 1.0].map(|k| spot.at + k * spot.step))
        .collect();
    let got = lit.ask(template, &points, is_lit);
    let each = got.chunks_exact(3).zip(points.chunks_exact(3)).zip(spots);
    each.map(|((got, at), spot)| {
        let [a, b, c] = [0, 1, 2].map(|k| got[k].0 - at[k].as_dvec3());
        (a + c - 2.0 * b).dot(spot.across()).abs() / f64::from(spot.step.length())
    })
    .collect()
}

/// Light sees no border between the pieces of a spline: its map turns hardly more over one than inside of a piece. Its
/// places are those of the straight pieces, which turn by the angle between them.
#[test]
fn light_is_smooth_over_the_pieces_of_a_spline() {
    let lit = Lit::new();
    let mut random = Random(0x0b01_71d0);
    for places in [3, 5, 7] {
        let (mut over, mut inside, mut straight) = (0.0_f64, 0.0_f64, 0.0_f64);
        let (mut untaken, mut apart) = (0.0_f64, 0.0_f64);
        for _ in 0..12 {
            let template = along_spline(&mut random, places);
            let [borders, inner] = spots(&template, &[-0.15, -0.08, -0.03]);
            let most = |of: Vec<f64>| of.into_iter().fold(0.0, f64::max);
            over = over.max(most(kinks(&lit, &template, &borders, true)));
            inside = inside.max(most(kinks(&lit, &template, &inner, true)));
            straight = straight.max(most(kinks(&lit, &template, &borders, false)));
            let at: Vec<Vec3> = inner.iter().chain(&borders).map(|spot| spot.at).collect();
            let [round, plain] = [true, false].map(|is_lit| lit.ask(&template, &at, is_lit));
            for (round, plain) in round.iter().zip(&plain) {
                assert!(round.1 >= 0.0 && plain.1 >= 0.0, "there is room");
                untaken = untaken.max(round.1);
                apart = apart.max(round.0.distance(plain.0));
            }
        }
        println!(
            "{places} places: the slope turns by {over:.1e} over borders, {inside:.1e} inside, {straight:.1e} where pieces \
             are straight; bend takes unbend back to {untaken:.1e}; places are {apart:.1e} apart"
        );
        // What the numbers of 32 bits are off by over such a step is 2e-4.
        assert!(
            over < 2.0 * inside + 2e-4,
            "{places}: {over} over borders, {inside} inside"
        );
        assert!(
            straight > 5.0 * over,
            "{places}: {straight} where pieces are straight"
        );
        assert!(
            untaken < 1e-5,
            "{places}: bend is no inverse of unbend by {untaken}"
        );
        assert!(
            apart < 2e-3,
            "{places}: light is {apart} from what it lights"
        );
    }
}
