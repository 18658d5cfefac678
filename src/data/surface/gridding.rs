//! The making of grids of distances ([`DistanceGrid`]).
//!
//! The same triangles give the same grid on every machine: its numbers are sums, products and square roots, and what
//! decides about inside is far from its limit wherever a surface is closed.

use std::sync::Arc;

use glam::{UVec3, Vec3};
use half::f16;

use super::grid::{DistanceGrid, MARGIN, NODES};
use super::tree::{Tree, in_order};
use super::triangle::Triangle;
use super::whole::{Surface, SurfaceError};
use super::winding::Winding;
use crate::math::Aabb;

impl DistanceGrid {
    /// The grid of the triangles of a surface, without its lids. What is open of it has no inside. `go_on` is told how
    /// far it is, 0 to 1; false stops it, and gives `None`.
    pub fn of(surface: &Surface, go_on: &mut dyn FnMut(f32) -> bool) -> Option<Self> {
        let own = |segment: Option<usize>| -> Vec<Triangle> {
            let all = surface.triangles.iter().enumerate();
            let own = all.filter(|(i, _)| {
                !surface.is_lid(*i) && segment.is_none_or(|k| surface.segment_of(*i) == k)
            });
            own.map(|(_, triangle)| *triangle).collect()
        };
        let segments = surface.segments.iter().enumerate();
        let closed: Vec<usize> = segments
            .filter(|(_, s)| s.is_closed)
            .map(|(k, _)| k)
            .collect();
        let insides = closed.iter().map(|k| Winding::new(&own(Some(*k))));
        let is_open = closed.len() < surface.segments.len();
        Self::measured(&own(None), &insides.collect::<Vec<_>>(), is_open, go_on)
    }

    /// As [`DistanceGrid::of`], of a mesh in one piece, closed or not.
    pub fn of_mesh(
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        is_closed: bool,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Option<Self> {
        let corner = |index: u32| positions.get(index as usize).copied().unwrap_or_default();
        let triangles = triangles.iter().map(|of| Triangle(of.map(corner)));
        let triangles: Vec<Triangle> = triangles.collect();
        let inside: Vec<Winding> = is_closed
            .then(|| Winding::new(&triangles))
            .into_iter()
            .collect();
        Self::measured(&triangles, &inside, !is_closed, go_on)
    }

    /// The grid of triangles; inside is what is inside of any of `insides`.
    fn measured(
        triangles: &[Triangle],
        insides: &[Winding],
        is_open: bool,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Option<Self> {
        let bounds = Aabb::from_points(triangles.iter().flat_map(|triangle| triangle.0));
        let longest = bounds.size().max_element();
        if triangles.is_empty() || longest <= 0.0 || !longest.is_finite() {
            return None;
        }
        let sides = bounds.size().as_dvec3() / f64::from(longest) + 2.0 * MARGIN;
        // Rounding adds no row.
        let cells = (sides / Self::CELL - 1e-4).ceil().as_uvec3();
        let nodes = (cells + 1).min(UVec3::splat(NODES));
        let tree = Tree::new(triangles);
        let triangles = in_order(&tree.order, triangles);
        let cell = Self::CELL as f32 * longest;
        let first = bounds.center() - 0.5 * cell * (nodes - 1).as_vec3();
        let is_inside = |place: Vec3| {
            let holds =
                |part: &Winding| part.bounds().contains(place) && part.at(place).abs() >= 0.5;
            insides.iter().any(holds)
        };
        let mut found: Vec<(f32, bool)> = Vec::with_capacity(nodes.element_product() as usize);
        let (row, slice) = (nodes.x as usize, (nodes.x * nodes.y) as usize);
        for z in 0..nodes.z {
            if !go_on(z as f32 / nodes.z as f32) {
                return None;
            }
            for y in 0..nodes.y {
                for x in 0..nodes.x {
                    let place = first + cell * UVec3::new(x, y, z).as_vec3();
                    let before = [(x, 1), (y, row), (z, slice)].into_iter();
                    let before = before.filter(|(at, _)| *at > 0);
                    let beside: Vec<(f32, bool)> =
                        before.map(|(_, step)| found[found.len() - step]).collect();
                    let least = beside.iter().map(|(far, _)| far + 1.001 * cell);
                    let within = least.fold(f32::INFINITY, f32::min);
                    let nearest = tree
                        .nearest(&triangles, place, within, |_| true)
                        .or_else(|| tree.nearest(&triangles, place, f32::INFINITY, |_| true))?;
                    // No surface lies between two nodes if it is farther from one of them.
                    let known = beside.iter().find(|(far, _)| *far > 1.001 * cell);
                    let inside = known.map_or_else(|| is_inside(place), |(_, inside)| *inside);
                    found.push((nearest.distance, inside));
                }
            }
        }
        let rounded = |(far, inside): &(f32, bool)| match inside {
            true => 0.0,
            false => f16::from_f32(far / longest).to_f32(),
        };
        Self::from_parts(nodes, found.iter().map(rounded).collect(), is_open)
    }
}

impl Surface {
    /// This surface with its grid of distances, for a tool. `go_on` as in [`Surface::new`].
    ///
    /// # Errors
    /// [`SurfaceError::Stopped`].
    pub fn sweeping(self, go_on: &mut dyn FnMut(f32) -> bool) -> Result<Self, SurfaceError> {
        let grid = DistanceGrid::of(&self, go_on).ok_or(SurfaceError::Stopped)?;
        Ok(Self {
            grids: vec![(0, Arc::new(grid))],
            ..self
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::mesh::testing::{cube, in_one_part};
    use crate::data::surface::testing::Random;
    use glam::DVec3;

    /// A ball of radius 1, by halving the edges of an octahedron.
    fn ball() -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut corners: Vec<[Vec3; 3]> = Vec::new();
        for i in 0..8 {
            let sign = |bit: u32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let of = [Vec3::X * sign(0), Vec3::Y * sign(1), Vec3::Z * sign(2)];
            let is_even = sign(0) * sign(1) * sign(2) > 0.0;
            corners.push(if is_even { of } else { [of[0], of[2], of[1]] });
        }
        for _ in 0..5 {
            let halved = corners.iter().flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [(a + b), (b + c), (c + a)].map(Vec3::normalize);
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            });
            corners = halved.collect();
        }
        let triangles = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        let triangles = triangles.collect();
        (corners.concat(), triangles)
    }

    fn grid_of((positions, triangles): &(Vec<Vec3>, Vec<[u32; 3]>)) -> DistanceGrid {
        DistanceGrid::of_mesh(positions, triangles, true, &mut |_| true).expect("not stopped")
    }

    fn surface(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Surface {
        let mesh = in_one_part(positions, triangles);
        Surface::new(&mesh, None, &mut |_| true).expect("it has a size")
    }

    /// Distance to a box about the origin.
    fn of_box(q: DVec3, half: DVec3) -> f64 {
        (q.abs() - half).max(DVec3::ZERO).length()
    }

    #[test]
    fn a_ball_and_a_box_are_kept_within_half_a_cell() {
        let (positions, triangles) = cube();
        let stretched = positions
            .iter()
            .map(|p| *p * Vec3::new(2.0, 1.0, 0.1) + 7.0);
        let plate = (stretched.collect(), triangles);
        let half = DVec3::new(0.5, 0.25, 0.025);
        let [round, flat] = [grid_of(&ball()), grid_of(&plate)];
        assert_eq!(round.nodes(), UVec3::splat(48));
        assert!(
            flat.nodes().x == 48 && flat.nodes().z < 24,
            "{}",
            flat.nodes()
        );
        let mut random = Random(5);
        for _ in 0..2000 {
            let q = random.place().as_dvec3() * 0.74;
            let exact = (q.length() - 0.5).max(0.0);
            let away = (round.distance(q) - exact).abs();
            assert!(away < 0.5 * DistanceGrid::CELL, "{q}: {away}");
            if q.abs().cmple(half + 0.25).all() {
                let away = (flat.distance(q) - of_box(q, half)).abs();
                assert!(away < 0.5 * DistanceGrid::CELL, "{q}: {away}");
            }
        }
        assert_eq!(round.distance(DVec3::new(0.2, -0.3, 0.1)), 0.0);
        for value in round.values() {
            assert_eq!(*value, f16::from_f32(*value).to_f32());
        }
    }

    #[test]
    fn beyond_the_grid_the_way_to_it_is_added() {
        let grid = grid_of(&ball());
        for (q, c) in [
            (DVec3::new(3.0, 0.0, 0.0), DVec3::new(0.75, 0.0, 0.0)),
            (DVec3::new(2.0, -2.0, 0.1), DVec3::new(0.75, -0.75, 0.1)),
        ] {
            let expected = grid.distance(c) + q.distance(c);
            assert!((grid.distance(q) - expected).abs() < 1e-9, "{q}");
        }
        let far = grid.distance(DVec3::splat(1e300));
        assert!(far > 1e299, "{far}");
    }

    #[test]
    fn the_gradient_is_a_difference_over_a_cell() {
        let grid = grid_of(&ball());
        let mut random = Random(11);
        for _ in 0..500 {
            let q = random.place().as_dvec3();
            let (distance, gradient) = grid.distance_and_gradient(q);
            assert_eq!(distance, grid.distance(q));
            let is_near = q.length() < 0.5 + 2.0 * DistanceGrid::CELL;
            if !is_near && q.abs().max_element() < 0.7 {
                assert!(gradient.distance(q.normalize()) < 0.1, "{q}: {gradient}");
            }
            assert!(gradient.length() < 1.8, "{q}: {gradient}");
        }
        assert_eq!(grid.distance_and_gradient(DVec3::ZERO), (0.0, DVec3::ZERO));
    }

    #[test]
    fn what_is_open_is_a_sheet() {
        let (positions, mut triangles) = cube();
        // The top is taken off.
        triangles.drain(2..4);
        let open = surface(positions.clone(), triangles);
        let grid = DistanceGrid::of(&open, &mut |_| true).expect("not stopped");
        assert!(grid.is_open());
        assert!((grid.distance(DVec3::ZERO) - 0.5).abs() < 0.5 * DistanceGrid::CELL);
        // No lid is met either.
        assert!((grid.distance(DVec3::new(0.0, 0.0, 0.5)) - 0.5).abs() < 0.5 * DistanceGrid::CELL);
        let (_, triangles) = cube();
        let closed = surface(positions, triangles).sweeping(&mut |_| true);
        let closed = closed.expect("not stopped");
        let (_, grid) = &closed.grids[0];
        assert!(!grid.is_open());
        assert_eq!(grid.distance(DVec3::splat(0.4)), 0.0);
        assert!((grid.distance(DVec3::X) - 0.5).abs() < 0.5 * DistanceGrid::CELL);
    }

    #[test]
    fn what_has_no_size_or_is_stopped_gives_no_grid() {
        let none = |positions: &[Vec3], triangles: &[[u32; 3]]| {
            DistanceGrid::of_mesh(positions, triangles, true, &mut |_| true)
        };
        assert_eq!(none(&[], &[]), None);
        assert_eq!(none(&[Vec3::ONE], &[[0, 0, 0]]), None);
        let (positions, triangles) = cube();
        assert!(none(&positions, &triangles).is_some());
        let stopped = DistanceGrid::of_mesh(&positions, &triangles, true, &mut |part| part < 0.5);
        assert_eq!(stopped, None);
    }

    #[test]
    fn a_texel_holds_four_nodes() {
        let grid = grid_of(&cube());
        let texels: Vec<[f32; 4]> = grid.texels().collect();
        assert_eq!(texels.len(), grid.texel_count());
        let (x, y, z) = (5, 7, 11);
        let value = |x: usize, y: usize| grid.values()[x + 48 * (y + 48 * z)];
        let expected = [
            value(x, y),
            value(x + 1, y),
            value(x, y + 1),
            value(x + 1, y + 1),
        ];
        assert_eq!(texels[x + 47 * (y + 47 * z)], expected);
    }
}
