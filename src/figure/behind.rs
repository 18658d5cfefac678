use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::mesh::{Mesh, Part};
use super::plane::Plane;
use super::solve::{Element, Matrix, NONE};
use crate::math::linear_from_srgb;
use crate::pictures::Picture;

/// How far outside the outline colours are taken, pixels of the map.
const OUTSIDE: f64 = 2.0;

/// Colours of the soft tissue where a cut region lay, interpolated from around it: per vertex red, green and blue, 0 to
/// 1, linear light. On its outline they are means of 3 × 3 pixels two pixels outside, in it they are harmonic
/// (spec/figures.md, "Outlines"). Depends on the mesh and the picture; made once for these.
pub fn smooth_colors(
    mesh: &Mesh,
    plane: &Plane,
    picture: &Picture,
    region: usize,
) -> BTreeMap<u32, [f64; 3]> {
    let triangles: Vec<usize> = (0..mesh.triangle_count())
        .filter(|t| mesh.tissue(*t).part == Part::Behind(region))
        .collect();
    let mut colors = BTreeMap::new();
    for (vertex, normal) in outward(mesh, &triangles) {
        let at = plane.map_from_figure(mesh.vertices[vertex as usize]);
        // y of the map runs down.
        let outside = at + OUTSIDE * DVec2::new(normal.x, -normal.y);
        colors.insert(vertex, mean_color(picture, outside));
    }
    let inner: BTreeSet<u32> = triangles
        .iter()
        .flat_map(|t| mesh.triangles[*t])
        .filter(|vertex| !colors.contains_key(vertex))
        .collect();
    let unknown: BTreeMap<u32, u32> = inner.iter().copied().zip(0..).collect();
    let of = |vertex: u32| unknown.get(&vertex).copied().unwrap_or(NONE);
    let mut matrix = Matrix::new(inner.len());
    let mut sides = vec![[0.0; 3]; inner.len()];
    for t in &triangles {
        let element = Element::new(mesh.triangles[*t], mesh.corners(*t, &mesh.vertices));
        matrix.add(element.vertices.map(of), &element.gradients, element.area);
        let mut slopes = [DVec2::ZERO; 3];
        for (vertex, gradient) in element.vertices.iter().zip(&element.gradients) {
            if let Some(color) = colors.get(vertex) {
                (0..3).for_each(|i| slopes[i] += color[i] * *gradient);
            }
        }
        for (vertex, gradient) in element.vertices.iter().zip(&element.gradients) {
            if let Some(unknown) = unknown.get(vertex) {
                let side = &mut sides[*unknown as usize];
                (0..3).for_each(|i| side[i] -= element.area * gradient.dot(slopes[i]));
            }
        }
    }
    let places: Vec<Option<DVec2>> = inner
        .iter()
        .map(|vertex| Some(mesh.vertices[*vertex as usize]))
        .collect();
    matrix.factor(&places).solve(&mut sides);
    colors.extend(inner.into_iter().zip(sides));
    colors
}

/// The vertices on the outline of some triangles, each with the direction away from them.
fn outward(mesh: &Mesh, triangles: &[usize]) -> BTreeMap<u32, DVec2> {
    let mut edges = BTreeSet::new();
    for [a, b, c] in triangles.iter().map(|t| mesh.triangles[*t]) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if !edges.remove(&(to, from)) {
                edges.insert((from, to));
            }
        }
    }
    let mut normals: BTreeMap<u32, DVec2> = BTreeMap::new();
    for (from, to) in edges {
        // The triangle lies to the left of its edge.
        let along = mesh.vertices[to as usize] - mesh.vertices[from as usize];
        let normal = -along.perp() / along.length();
        *normals.entry(from).or_default() += normal;
        *normals.entry(to).or_default() += normal;
    }
    for normal in normals.values_mut() {
        let length = normal.length();
        if length > 0.0 {
            *normal /= length;
        }
    }
    normals
}

/// The mean colour of the 3 × 3 pixels around a point of the map, linear light, by their opacity; black where all are
/// clear. Pixels outside the picture are those at its edge.
fn mean_color(picture: &Picture, at: DVec2) -> [f64; 3] {
    let [width, height] = picture.size.map(i64::from);
    let (column, row) = (at.x.floor() as i64, at.y.floor() as i64);
    let (mut sum, mut total) = ([0.0; 3], 0.0);
    for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
        let (x, y) = (
            (column + dx).clamp(0, width - 1),
            (row + dy).clamp(0, height - 1),
        );
        let pixel = picture.pixels[(y * width + x) as usize];
        let weight = f64::from(pixel[3]);
        (0..3).for_each(|i| sum[i] += weight * f64::from(linear_from_srgb(pixel[i])));
        total += weight;
    }
    if total > 0.0 {
        sum.map(|part| part / total)
    } else {
        sum
    }
}
