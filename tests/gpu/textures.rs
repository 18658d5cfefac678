//! Colours of meshes by rays, against what their files hold (spec/surfaces.md, must-shows of textures and colours).

use std::sync::Arc;

use crate::data::data_folder;
use crate::gpu::gpu;
use crate::picture_files::{jpeg, plate, rgb_png};
use crate::scatter::Random;
use crate::surfaces::{surface_of, surface_of_files};
use fabrica::data::{Mesh, PLAIN_SRGB, Surface};
use fabrica::document::Document;
use fabrica::load::{MemoryFiles, MeshOptions, read_mesh};
use fabrica::math::{linear_from_srgb, srgb_from_linear};
use fabrica::pictures::Picture;
use fabrica::render::{Meeting, Studio};
use glam::{Vec2, Vec3};
use serde_json::json;

/// How far a colour may be off, of 255.
const OFF: i32 = 2;

const UNMOVED: &str = "";
const TWIST: &str = r#"{"kind":"twist","size":[0.9,0.9,0.9],"params":{"angle":1.4}}"#;

struct Shown {
    mesh: Mesh,
    surface: Arc<Surface>,
    studio: Studio,
}

impl Shown {
    /// The first file is the mesh.
    fn of(files: &[(&str, Vec<u8>)]) -> Self {
        let (name, mut memory) = (files[0].0, MemoryFiles::new(files.to_vec()));
        let options = MeshOptions::default();
        let (mesh, _) = read_mesh(&mut memory, name, &options, &mut |_| true).expect("a mesh");
        let surface = surface_of_files(files);
        let studio = Studio::new(gpu(), &Arc::clone(&surface).into(), true).expect("it fits");
        Self {
            mesh,
            surface,
            studio,
        }
    }

    fn rest(&self, mm: Vec3) -> Vec3 {
        let frame = &self.surface.frame;
        (mm - frame.middle_mm.as_vec3()) / frame.mm_per_unit as f32
    }

    /// What rays meet: the colour, and where it was at rest.
    fn colors(&self, templates: &str, rays: &[(Vec3, Vec3)]) -> Vec<Option<([u8; 3], Vec3)>> {
        let text = format!(
            r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"look":{{"body":"hollow"}},"templates":[{templates}]}}"#
        );
        let document = Document::from_json(&text).expect("a good document");
        let events = self.studio.events(document.illustration(), rays);
        let events = pollster::block_on(events).expect("events");
        let one = |event: &fabrica::render::RayEvent| {
            let linear = event.albedo.to_array();
            let srgb = linear.map(|value| srgb_from_linear(f64::from(value)));
            (event.meeting == Meeting::Surface).then_some((srgb, event.pos_in_rest))
        };
        events
            .iter()
            .map(|event| event.as_ref().and_then(one))
            .collect()
    }

    /// The triangle that lies at a place of rest space, and the weights of its corners there.
    fn on_triangle(&self, place: Vec3) -> (usize, [f32; 3]) {
        let far = |triangle: usize| {
            let corners = self.mesh.corners_of(self.mesh.triangles[triangle]);
            let triangle = fabrica::data::Triangle(corners.map(|mm| self.rest(mm)));
            (triangle.nearest_point(place).distance(place), triangle)
        };
        let all = (0..self.mesh.triangles.len()).map(|index| (index, far(index)));
        let (index, (_, triangle)) = all
            .min_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b))
            .expect("a triangle");
        let [a, b, c] = triangle.0;
        let whole = triangle.area_normal();
        let part =
            |p: Vec3, q: Vec3| (p - place).cross(q - place).dot(whole) / whole.length_squared();
        (index, [part(b, c), part(c, a), part(a, b)])
    }

    /// Rays that meet triangles from their fronts, near their middles.
    fn rays_at_middles(&self) -> Vec<(Vec3, Vec3)> {
        let corners = (self.mesh.triangles.iter()).map(|&triangle| self.mesh.corners_of(triangle));
        corners
            .map(|corners| {
                let [a, b, c] = corners.map(|mm| self.rest(mm));
                let normal = (b - a).cross(c - a).normalize();
                ((a + b + c) / 3.0 + 0.01 * normal, -normal)
            })
            .collect()
    }
}

fn linear([r, g, b]: [u8; 3]) -> Vec3 {
    Vec3::new(
        linear_from_srgb(r),
        linear_from_srgb(g),
        linear_from_srgb(b),
    )
}

fn is_near(found: [u8; 3], expected: Vec3, off: i32) -> bool {
    let expected = expected
        .to_array()
        .map(|value| srgb_from_linear(f64::from(value)));
    (0..3).all(|k| (i32::from(found[k]) - i32::from(expected[k])).abs() <= off)
}

/// The picture's colour at a place, bilinear in linear light, repeated.
fn texel(picture: &Picture, uv: Vec2) -> Vec3 {
    let size = Vec2::from(picture.size.map(|side| side as f32));
    let place = uv * size - 0.5;
    let (low, part) = (place.floor(), place - place.floor());
    let at = |x: f32, y: f32| {
        let at = (low + Vec2::new(x, y)).rem_euclid(size).as_uvec2();
        let [r, g, b, _] = picture.pixels[(at.x + picture.size[0] * at.y) as usize];
        linear([r, g, b])
    };
    let row = |y: f32| at(0.0, y).lerp(at(1.0, y), part.x);
    row(0.0).lerp(row(1.0), part.y)
}

fn weighted<const N: usize, T>(values: [T; N], weights: [f32; N]) -> T
where
    T: std::ops::Mul<f32, Output = T> + std::iter::Sum<T>,
{
    values.into_iter().zip(weights).map(|(v, w)| v * w).sum()
}

fn place_in_picture(mesh: &Mesh, triangle: usize, weights: [f32; 3]) -> Vec2 {
    let uvs = mesh.uvs.as_ref().expect("places in the picture");
    weighted(
        [0, 1, 2].map(|corner| uvs.get(triangle, corner).expect("a place")),
        weights,
    )
}

fn data_file(name: &str) -> Option<(&str, Vec<u8>)> {
    let folder = data_folder("colours of meshes by rays")?;
    Some((
        name,
        std::fs::read(folder.join("mesh").join(name)).expect("the mesh"),
    ))
}

#[test]
fn a_texture_has_the_texels_of_its_picture() {
    let Some(file) = data_file("BoxTextured.glb") else {
        return;
    };
    let shown = Shown::of(&[file]);
    let packed = &shown.mesh.textures[0].packed;
    let picture = image::load_from_memory(packed).expect("a PNG").to_rgba8();
    let picture = Picture {
        size: [picture.width(), picture.height()],
        pixels: picture.pixels().map(|pixel| pixel.0).collect(),
        is_of_inks: false,
    };
    let mut random = Random(3);
    let mut rays = shown.rays_at_middles();
    for _ in 0..300 {
        let (at, dir) = rays[(random.between(0.0, 11.99)) as usize];
        let aside = dir.any_orthonormal_vector() * random.between(-0.1, 0.1);
        let more = dir.cross(aside).normalize_or_zero() * random.between(-0.1, 0.1);
        rays.push((at + aside + more, dir));
    }
    let mut wrong_way = 0;
    for (found, (at, dir)) in shown.colors(UNMOVED, &rays).iter().zip(&rays) {
        let (color, rest) = found.expect("a surface");
        assert!(rest.distance(*at + *dir * 0.01) < 1e-4);
        let (triangle, weights) = shown.on_triangle(rest);
        let uv = place_in_picture(&shown.mesh, triangle, weights);
        let expected = texel(&picture, uv);
        assert!(is_near(color, expected, OFF), "{uv}: {color:?} {expected}");
        wrong_way += usize::from(!is_near(
            color,
            texel(&picture, Vec2::new(uv.x, 1.0 - uv.y)),
            OFF,
        ));
    }
    assert!(
        wrong_way > 20,
        "the negative control: {wrong_way} differ upside down"
    );
}

/// Under templates a colour belongs to the place at rest.
#[test]
fn a_texture_sticks_to_its_triangles() {
    let size = [16, 16];
    let color = |x: u32, y: u32| [16 * x as u8, 16 * y as u8, 128];
    let picture = rgb_png(size, color);
    let mut pixels = Vec::new();
    for y in 0..16 {
        pixels.extend((0..16).map(|x| {
            let [r, g, b] = color(x, y);
            [r, g, b, 255]
        }));
    }
    let own = Picture {
        size,
        pixels,
        is_of_inks: false,
    };
    let shown = Shown::of(&[("plate.glb", plate(&picture, "image/png", 1.0, &[]))]);
    let mut random = Random(8);
    // A GLB's plate stands upright, its front to the front of the body.
    let dir = shown.rays_at_middles()[0].1;
    let rays: Vec<(Vec3, Vec3)> = (0..200)
        .map(|_| {
            let right = dir.any_orthonormal_vector();
            let aside =
                right * random.between(-0.4, 0.4) + dir.cross(right) * random.between(-0.4, 0.4);
            (aside - dir * 0.8, dir)
        })
        .collect();
    let (mut met, mut moved) = (0, 0);
    for (found, (at, _)) in shown.colors(TWIST, &rays).iter().zip(&rays) {
        let Some((color, rest)) = found else { continue };
        met += 1;
        let expected = |rest: Vec3| {
            let (triangle, weights) = shown.on_triangle(rest);
            texel(&own, place_in_picture(&shown.mesh, triangle, weights))
        };
        assert!(is_near(*color, expected(*rest), OFF), "{rest}: {color:?}");
        moved += usize::from(!is_near(*color, expected(*at), OFF));
    }
    assert!(
        met > 100 && moved > met / 2,
        "{met} met, {moved} elsewhere than at rest"
    );
}

#[test]
fn vertex_and_material_colours_are_those_of_the_file() {
    for name in ["cubevc.glb", "fuze.ply"] {
        let Some(file) = data_file(name) else {
            return;
        };
        let shown = Shown::of(&[file]);
        let colors = shown.mesh.colors.clone().expect("vertex colours");
        let (mut seen, mut unlike) = (0, 0);
        for found in shown.colors(UNMOVED, &shown.rays_at_middles()) {
            // In the mouth of the bottle other walls stand before some.
            let Some((color, rest)) = found else { continue };
            let (triangle, weights) = shown.on_triangle(rest);
            let corners = [0, 1, 2].map(|corner| colors.get(triangle, corner).expect("a colour"));
            let expected: Vec3 = weighted(corners, weights);
            assert!(
                is_near(color, expected, OFF),
                "{name} {triangle}: {color:?} {expected}"
            );
            seen += 1;
            unlike += usize::from(!is_near(color, linear(PLAIN_SRGB), OFF));
        }
        assert!(seen * 10 > shown.mesh.triangles.len() * 9, "{name}: {seen}");
        assert!(unlike * 2 > seen, "{name}: as without colours");
    }
    let picture = rgb_png([1, 1], |_, _| [255; 3]);
    let pointer = "/materials/0/pbrMetallicRoughness/baseColorFactor";
    let changes = [(pointer, json!([0.5, 0.25, 0.125, 1.0]))];
    let factor = Shown::of(&[("a.glb", plate(&picture, "image/png", 1.0, &changes))]);
    let color = factor.colors(UNMOVED, &factor.rays_at_middles())[0]
        .expect("a surface")
        .0;
    assert!(
        is_near(color, Vec3::new(0.5, 0.25, 0.125), OFF),
        "{color:?}"
    );
    let of_obj = |library: &str, picture: Option<Vec<u8>>| {
        let text = "mtllib C:\\Jane\\a.mtl\nusemtl skin\nv 0 0 0 1 0 0\nv 10 0 0 1 0 0\nv 0 10 0 1 0 0\n\
                    vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
        let mut files = vec![
            ("a.obj", text.as_bytes().to_vec()),
            ("a.mtl", library.as_bytes().to_vec()),
        ];
        files.extend(picture.map(|picture| ("a.png", picture)));
        let shown = Shown::of(&files);
        shown.colors(UNMOVED, &shown.rays_at_middles())[0]
            .expect("a surface")
            .0
    };
    let library = "newmtl skin\nKd 0.2 0.4 0.6\nmap_Kd /home/jane/a.png\n";
    // The first of texture, vertex colour and material colour; v points up, so that a third of the way lies low.
    let halves = rgb_png(
        [4, 4],
        |_, y| if y < 2 { [9, 8, 7] } else { [120, 40, 200] },
    );
    assert!(is_near(
        of_obj(library, Some(halves)),
        linear([120, 40, 200]),
        OFF
    ));
    assert!(is_near(of_obj(library, None), Vec3::X, OFF));
    let text = "mtllib a.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let files = [
        ("a.obj", text.as_bytes().to_vec()),
        ("a.mtl", library.as_bytes().to_vec()),
    ];
    let shown = Shown::of(&files);
    let color = shown.colors(UNMOVED, &shown.rays_at_middles())[0]
        .expect("a surface")
        .0;
    assert!(is_near(color, linear([51, 102, 153]), OFF), "{color:?}");
}

#[test]
fn jpegs_wraps_and_transforms_are_followed() {
    // Blocks of gray by column, then by row.
    let value = |_: usize, x: u16, y: u16| (40 + 60 * x + 100 * y) as u8;
    let gray = jpeg([16, 16], &[1], (0xc0, 8), &[], value);
    let colors = |repeats: f32, changes: &[(&str, serde_json::Value)], places: &[Vec2]| {
        let shown = Shown::of(&[("a.glb", plate(&gray, "image/jpeg", repeats, changes))]);
        let dir = shown.rays_at_middles()[0].1;
        // y up in the file is z up here, and x points left.
        let at = |uv: &Vec2| shown.rest(1000.0 * Vec3::new(-uv.x, 0.0, 1.0 - uv.y));
        let rays: Vec<_> = places.iter().map(|uv| (at(uv) - 0.1 * dir, dir)).collect();
        let found = shown.colors(UNMOVED, &rays);
        found
            .iter()
            .map(|found| found.expect("a surface").0[0])
            .collect::<Vec<_>>()
    };
    let places = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)].map(Vec2::from);
    let near = |found: Vec<u8>, expected: &[i32]| {
        let pairs = found.iter().zip(expected);
        let mut off = pairs.map(|(found, expected)| (i32::from(*found) - expected).abs());
        assert!(off.all(|off| off <= OFF), "{found:?} {expected:?}");
    };
    near(colors(1.0, &[], &places), &[40, 100, 140, 200]);
    // Two pictures along each side: places in the second one.
    let second = [(0.625, 0.125), (0.875, 0.125)].map(Vec2::from);
    near(colors(2.0, &[], &second), &[40, 100]);
    let wrap = |number: u32| vec![("/samplers/0/wrapS", json!(number))];
    near(colors(2.0, &wrap(33_648), &second), &[100, 40]);
    near(colors(2.0, &wrap(33_071), &second), &[100, 100]);
    let transform =
        json!({ "KHR_texture_transform": { "offset": [0.5, 0.0], "scale": [0.5, 0.5] } });
    let moved = [(
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
        transform,
    )];
    near(colors(1.0, &moved, &[Vec2::new(0.5, 0.5)]), &[100]);
}

/// A picture finer than the pixels is drawn by its copies: gray, and as bright as it is in light.
#[test]
fn what_is_finer_than_pixels_is_drawn_by_reduced_copies() {
    let spread_of = |cells: u32, distance: f32| {
        let checks = rgb_png([256, 256], |x, y| {
            let is_white = (x * cells / 256 + y * cells / 256).is_multiple_of(2);
            if is_white { [255; 3] } else { [0; 3] }
        });
        let surface = surface_of("a.glb", plate(&checks, "image/png", 1.0, &[]));
        let studio = Studio::new(gpu(), &surface.into(), true).expect("it fits");
        let document = Document::from_json(&format!(
            r#"{{"fabrica":1,"subject":{{"builtin":"cube"}},"camera":{{"distance":{distance}}}}}"#
        ))
        .expect("a good document");
        let image = pollster::block_on(studio.render_image(document.illustration(), [64, 64], 1));
        let image = image.expect("drawn");
        let middle = (26..38).flat_map(|y| (26..38).map(move |x| (y * 64 + x) as usize));
        let values: Vec<f32> = middle
            .map(|pixel| f32::from(image.rgba[4 * pixel]))
            .collect();
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let off = values.iter().map(|value| (value - mean).abs());
        (mean, off.fold(0.0, f32::max))
    };
    let (mean, spread) = spread_of(128, 2.0);
    println!("fine checks: mean {mean}, spread {spread}");
    assert!(spread < 12.0, "mean {mean}, spread {spread}");
    let (coarse_mean, coarse) = spread_of(8, 2.0);
    println!("coarse checks: mean {coarse_mean}, spread {coarse}");
    assert!(coarse > 60.0, "the negative control: {coarse}");
}
