//! Chapter 8 and section 7.5.2: deformed surfaces. Vertices that are moved against triangles that stay, and searches
//! along a ray against the true crossing.

use super::layered::{Layered, first_part};
use crate::gpu::gpu;
use crate::reference::{self, Placed, as_reference};
use crate::scatter::Random;
use fabrica::data::{Mesh, MeshPart, Subject, Surface, SurfaceField, Triangle};
use fabrica::document::{Illustration, ParamValue, PlacedTemplate};
use fabrica::render::{Studio, View};
use glam::{DAffine3, DVec3, UVec3, Vec2, Vec3};
use std::sync::Arc;

/// A closed surface of rings: `at(u, v)` is a place for both from 0 to 1, `v` around. Its first and last ring are
/// either one place each (a ball) or the same ring (a torus).
fn rings(count: [u32; 2], at: impl Fn(f32, f32) -> Vec3) -> Arc<Surface> {
    let [along, around] = count;
    let place = |i: u32, j: u32| at(i as f32 / along as f32, (j % around) as f32 / around as f32);
    let index = |i: u32, j: u32| i * around + j % around;
    let positions: Vec<Vec3> = (0..=along)
        .flat_map(|i| (0..around).map(move |j| (i, j)))
        .map(|(i, j)| 100.0 * place(i, j))
        .collect();
    let triangles: Vec<[u32; 3]> = (0..along)
        .flat_map(|i| (0..around).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| index(i, j));
            [[a, b, c], [a, c, d]]
        })
        .filter(|triangle| {
            let [a, b, c] = triangle.map(|i| positions[i as usize]);
            (b - a).cross(c - a).length() > 1e-6
        })
        .collect();
    let parts = vec![MeshPart {
        name: "body".to_owned(),
        triangles: 0..triangles.len(),
    }];
    let mesh = Mesh {
        positions,
        triangles,
        parts,
        ..Mesh::default()
    };
    Arc::new(Surface::new(&mesh, Some(60.0), &mut |_| true).expect("it has a size"))
}

/// An egg, so many triangles around; longest along z.
pub(crate) fn egg(around: u32) -> Arc<Surface> {
    rings([around / 2, around], |u, v| {
        let (turn, polar) = (std::f32::consts::TAU * v, std::f32::consts::PI * u);
        let ring = polar.sin();
        Vec3::new(
            0.34 * ring * turn.cos(),
            0.34 * ring * turn.sin(),
            -0.5 * polar.cos(),
        )
    })
}

/// A torus about the y axis: no depth map sees all of it.
pub(crate) fn torus(around: u32) -> Arc<Surface> {
    rings([around, around / 2], |u, v| {
        let [turn, tube] = [u, v].map(|part| std::f32::consts::TAU * part);
        let ring = 0.36 + 0.14 * tube.cos();
        Vec3::new(ring * turn.cos(), 0.14 * tube.sin(), ring * turn.sin())
    })
}

/// A vase with a wall 0.03 to 0.07 thick, wider inside than its mouth at the top.
pub(crate) fn vase(around: u32) -> Arc<Surface> {
    rings([2 * around, around], |u, v| {
        let (turn, is_outside) = (std::f32::consts::TAU * v, u <= 0.5);
        let up = if is_outside { 2.0 * u } else { 2.0 - 2.0 * u };
        let belly = (0.86 * std::f32::consts::PI * up).sin();
        let (ring, z) = if is_outside {
            (0.42 * belly, up - 0.5)
        } else {
            (0.36 * belly, 0.93 * up - 0.43)
        };
        Vec3::new(ring * turn.cos(), ring * turn.sin(), z)
    })
}

/// The list that puts back what a list of twists moved: a twist keeps the radius and the height that its angle
/// depends on, so the opposite angle inverts it exactly.
pub(crate) fn untwisted(list: &[PlacedTemplate]) -> Vec<Placed> {
    let opposite = list.iter().rev().map(|template| {
        let mut template = template.clone();
        if let Some(ParamValue::Number(angle)) = template.params.first_mut() {
            *angle = -*angle;
        }
        template
    });
    as_reference(&opposite.collect::<Vec<_>>())
}

/// How far what is shown lies from the true deformed surface.
#[derive(Debug)]
pub(crate) struct ShapeError {
    /// Mean and greatest distance, measured where the material was at rest, subject units.
    pub(crate) mean: f64,
    pub(crate) worst: f64,
    /// Share of the triangles, by area, whose front looks to the wrong side.
    pub(crate) turned: f64,
}

fn error_at_rest(surface: &Surface, list: &[Placed], place: DVec3) -> f64 {
    let rest = reference::map(list, place).0.as_vec3();
    f64::from(surface.distance_to(0, rest))
}

/// The mesh with its vertices moved, as modelling programs do it.
pub(crate) fn moved(surface: &Surface, forward: &[Placed]) -> Vec<Triangle> {
    let place = |corner: Vec3| reference::map(forward, corner.as_dvec3()).0.as_vec3();
    surface
        .triangles
        .iter()
        .map(|t| Triangle(t.0.map(place)))
        .collect()
}

/// What moved vertices make of a surface under twists.
pub(crate) fn error_of_moved(
    surface: &Surface,
    list: &[PlacedTemplate],
    samples: usize,
) -> ShapeError {
    let (inverse, forward) = (as_reference(list), untwisted(list));
    let triangles = moved(surface, &forward);
    let mut random = Random(7);
    let areas: Vec<f64> = (surface.triangles.iter())
        .map(|t| f64::from(t.area_normal().length()))
        .collect();
    let area: f64 = areas.iter().sum();
    let mut error = ShapeError {
        mean: 0.0,
        worst: 0.0,
        turned: 0.0,
    };
    let (mut passed, mut next, mut count) = (0.0, 0.0, 0);
    for (i, Triangle([a, b, c])) in triangles.iter().enumerate() {
        // So many places on each triangle as its area at rest asks for.
        passed += areas[i];
        while next < passed {
            next += area / samples as f64;
            let (mut u, mut v) = (random.unit(), random.unit());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let place = (*a + (*b - *a) * u + (*c - *a) * v).as_dvec3();
            let off = error_at_rest(surface, &inverse, place);
            error.mean += off;
            error.worst = error.worst.max(off);
            count += 1;
        }
        let at_rest = surface.triangles[i];
        let middle = at_rest.0.iter().sum::<Vec3>() / 3.0;
        let there = reference::map(&forward, middle.as_dvec3()).0;
        let jacobian = super::bench::jacobian(&inverse, there);
        let right = jacobian.transpose() * at_rest.area_normal().as_dvec3();
        if Triangle([*a, *b, *c]).area_normal().as_dvec3().dot(right) < 0.0 {
            error.turned += areas[i] / area;
        }
    }
    error.mean /= f64::from(count.max(1));
    error
}

/// The document of a list, seen from `turn` about z and a little from above.
pub(crate) fn scene(list: &[PlacedTemplate], turn: f32) -> Illustration {
    let mut scene = Illustration::document_default();
    scene.templates = list.to_vec();
    scene.camera.rotate = glam::Quat::from_rotation_z(turn) * glam::Quat::from_rotation_x(-0.2);
    scene.camera.distance = 2.1;
    scene
}

/// A surface on the device.
pub(crate) fn studio(surface: &Arc<Surface>) -> Studio {
    Studio::new(gpu(), &Subject::from(Arc::clone(surface)), true).expect("the mesh fits")
}

/// Rays from the eye of a scene towards random places in a cube about `middle`.
pub(crate) fn rays(
    scene: &Illustration,
    (middle, half): (Vec3, f32),
    count: usize,
) -> Vec<(Vec3, Vec3)> {
    let eye = View::new(&scene.camera, [300, 300])
        .ray(Vec2::splat(150.0))
        .0;
    let mut random = Random(23);
    (0..count)
        .map(|_| (eye, (middle + random.vector(-half, half) - eye).normalize()))
        .collect()
}

/// What the program's rays make of a surface: nothing is moved, so nothing is turned.
pub(crate) fn error_of_rays(
    surface: &Arc<Surface>,
    list: &[PlacedTemplate],
    count: usize,
) -> ShapeError {
    let scene = scene(list, 0.4);
    let rays = rays(&scene, (Vec3::ZERO, 0.3), count);
    let events = pollster::block_on(studio(surface).events(&scene, &rays)).expect("events");
    let inverse = as_reference(list);
    let mut error = ShapeError {
        mean: 0.0,
        worst: 0.0,
        turned: 0.0,
    };
    let mut met = 0;
    for (event, (eye, dir)) in events.iter().zip(&rays) {
        let Some(event) = event else { continue };
        let place = eye.as_dvec3() + dir.as_dvec3() * f64::from(event.distance);
        let off = error_at_rest(surface, &inverse, place);
        error.mean += off;
        error.worst = error.worst.max(off);
        met += 1;
    }
    assert!(met * 4 > count, "{met} of {count} rays meet the surface");
    error.mean /= met as f64;
    error
}

/// A way to look along a ray for the deformed surface.
#[derive(Clone, Copy)]
pub(crate) enum Search {
    /// The sign of a layered representation at even steps, with halving: "linear search with binary refinement".
    Signs(f64),
    /// The same with steps that are even in the undeformed space (equation 7.5).
    Jacobian(f64),
    /// Even steps, and each chord at rest against the triangles.
    Chords(f64),
}

/// Where a ray first meets the deformed surface by a search, and how many samples it took.
fn found(
    search: Search,
    layered: &Layered,
    surface: &Surface,
    list: &[Placed],
    ray: (Vec3, Vec3),
) -> (Option<f64>, usize) {
    let (eye, dir) = (ray.0.as_dvec3(), ray.1.as_dvec3());
    let rest = |t: f64| reference::map(list, eye + dir * t).0;
    let (mut t, end, mut samples) = (1.0, 3.2, 0);
    let mut before = rest(t);
    while t < end {
        let step = match search {
            Search::Signs(step) | Search::Chords(step) => step,
            Search::Jacobian(step) => {
                let speed = (rest(t + 1e-5) - rest(t - 1e-5)).length() / 2e-5;
                samples += 2;
                step / speed.max(0.25)
            }
        };
        let next = t + step;
        let here = rest(next);
        samples += 1;
        match search {
            Search::Chords(_) => {
                if let Some(part) = first_part(surface, before.as_vec3(), here.as_vec3()) {
                    return (Some(t + step * f64::from(part)), samples);
                }
            }
            Search::Signs(_) | Search::Jacobian(_) => {
                if layered.value(here.as_vec3()) > 0.0 {
                    let (mut low, mut high) = (t, next);
                    for _ in 0..10 {
                        let middle = 0.5 * (low + high);
                        samples += 1;
                        if layered.value(rest(middle).as_vec3()) > 0.0 {
                            high = middle;
                        } else {
                            low = middle;
                        }
                    }
                    return (Some(high), samples);
                }
            }
        }
        (t, before) = (next, here);
    }
    (None, samples)
}

/// How far apart two crossings are one, subject units: what the signs of a sampled field are off by.
const NEAR: f64 = 0.02;
/// Parallels at this distance tell whether a ray is steady (spec/surfaces.md, "Exactness").
const ASIDE: f32 = 0.002;

/// Rays of a scene with the true crossing of each, in double precision by chords of 1/4096; only steady ones.
pub(crate) struct Truth {
    pub(crate) rays: Vec<(Vec3, Vec3)>,
    crossings: Vec<Option<f64>>,
}

impl Truth {
    pub(crate) fn new(surface: &Surface, list: &[PlacedTemplate], rays: Vec<(Vec3, Vec3)>) -> Self {
        let (list, none) = (
            as_reference(list),
            Layered::Maps {
                n: 2,
                maps: Vec::new(),
            },
        );
        let exact = |ray, step| found(Search::Chords(step), &none, surface, &list, ray).0;
        let mut truth = Self {
            rays: Vec::new(),
            crossings: Vec::new(),
        };
        for (eye, dir) in rays {
            let crossing = exact((eye, dir), 1.0 / 4096.0);
            let side = dir.any_orthonormal_vector();
            let parallels = [side, -side, dir.cross(side), -dir.cross(side)];
            let is_steady = parallels
                .iter()
                .all(|aside| is_near(exact((eye + *aside * ASIDE, dir), 1.0 / 1024.0), crossing));
            if is_steady {
                truth.rays.push((eye, dir));
                truth.crossings.push(crossing);
            }
        }
        truth
    }

    /// How many rays meet the surface.
    pub(crate) fn met(&self) -> usize {
        self.crossings.iter().flatten().count()
    }

    /// How many rays a search gets wrong, and its samples per ray.
    pub(crate) fn wrong_of(
        &self,
        search: Search,
        layered: &Layered,
        surface: &Surface,
        list: &[PlacedTemplate],
    ) -> (usize, f64) {
        let list = as_reference(list);
        let (mut wrong, mut samples) = (0, 0);
        for (&ray, &crossing) in self.rays.iter().zip(&self.crossings) {
            let (t, count) = found(search, layered, surface, &list, ray);
            wrong += usize::from(!is_near(t, crossing));
            samples += count;
        }
        (wrong, samples as f64 / self.rays.len() as f64)
    }

    /// How many rays the program's picture gets wrong.
    pub(crate) fn wrong_of_picture(&self, surface: &Arc<Surface>, scene: &Illustration) -> usize {
        let events = pollster::block_on(studio(surface).events(scene, &self.rays)).expect("events");
        events
            .iter()
            .zip(&self.crossings)
            .filter(|(event, crossing)| {
                let t = event.as_ref().map(|event| f64::from(event.distance));
                !is_near(t, **crossing)
            })
            .count()
    }
}

fn is_near(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() < NEAR,
        (None, None) => true,
        _ => false,
    }
}

/// The same surface with a field of another fineness: `n` voxels along its longest side, exact everywhere.
pub(crate) fn with_field(surface: &Surface, n: u32) -> Arc<Surface> {
    let scale = f64::from(n) / f64::from(fabrica::data::FIELD_VOXELS);
    let old = &surface.segmentation.grid;
    let inner = (old.dims.as_dvec3() * scale)
        .round()
        .max(DVec3::ONE)
        .as_uvec3();
    let margin = fabrica::data::FIELD_MARGIN;
    let size = surface.frame.bounds.size().as_dvec3();
    let spacing = size / inner.as_dvec3();
    let first = surface.frame.bounds.min.as_dvec3() + spacing * 0.5;
    let rest_from_inner = DAffine3::from_translation(first) * DAffine3::from_scale(spacing);
    let rest_from_voxel =
        rest_from_inner * DAffine3::from_translation(DVec3::splat(-f64::from(margin)));
    let dims = inner + 2 * margin;
    let place = |i: u32| {
        let voxel = UVec3::new(i % dims.x, i / dims.x % dims.y, i / dims.x / dims.y);
        rest_from_voxel.transform_point3(voxel.as_dvec3()).as_vec3()
    };
    let count = dims.element_product();
    let depths: Vec<f32> = (0..count).map(|i| surface.depth_at(place(i))).collect();
    // One segment: its set is the second one.
    let fills: Vec<u8> = depths.iter().map(|&depth| u8::from(depth > 0.0)).collect();
    let field = SurfaceField {
        dims,
        rest_from_voxel,
        depths,
        fills,
        sets: surface.field.sets.clone(),
    };
    let mut other = surface.clone();
    let world_from_rest = old.world_from_voxel * surface.field.rest_from_inner_voxel().inverse();
    other.segmentation.grid.world_from_voxel = world_from_rest * rest_from_inner;
    other.segmentation.grid.dims = inner;
    let is_inner = |i: u32| {
        let voxel = UVec3::new(i % dims.x, i / dims.x % dims.y, i / dims.x / dims.y);
        voxel.cmpge(UVec3::splat(margin)).all() && voxel.cmplt(inner + margin).all()
    };
    other.segmentation.labels = (0..count)
        .filter(|&i| is_inner(i))
        .map(|i| field.fills[i as usize])
        .collect();
    other.frame.detail = spacing.min_element() as f32;
    other.field = field;
    Arc::new(other)
}
