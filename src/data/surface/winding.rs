//! The generalised winding number, by a tree: near triangles exactly, far ones together.
//!
//! Jacobson, Kavan, Sorkine-Hornung 2013 (the number); Barill, Dickson, Schmidt, Levin, Jacobson 2018 (the tree). One
//! dipole stands for a branch that is farther away than [`FAR`] times its radius; the error is far below the ½ that
//! decides.

use glam::{DVec3, Vec3};

use super::tree::Tree;
use super::triangle::Triangle;
use crate::math::Aabb;

/// From how many times its radius on a branch counts as one dipole.
const FAR: f64 = 3.0;
/// The same where the number itself counts.
const VERY_FAR: f64 = 10.0;

/// Triangles, ready to be asked for their winding number.
#[derive(Clone, Debug, Default)]
pub(super) struct Winding {
    tree: Tree,
    /// In the order of the leaves.
    triangles: Vec<Triangle>,
    /// Of each node.
    dipoles: Vec<Dipole>,
}

/// What a branch is from far away.
#[derive(Clone, Copy, Debug, Default)]
struct Dipole {
    /// Mean of the triangles' middles, weighted by area.
    middle: DVec3,
    /// Sum of the fronts' normals times their areas.
    normal: DVec3,
    /// The farthest corner from `middle`.
    radius: f64,
}

impl Winding {
    /// Prepares triangles.
    pub(super) fn new(triangles: &[Triangle]) -> Self {
        let tree = Tree::new(triangles);
        let triangles: Vec<Triangle> = tree.order.iter().map(|&i| triangles[i as usize]).collect();
        let dipoles = dipoles(&tree, &triangles);
        Self {
            tree,
            triangles,
            dipoles,
        }
    }

    /// The box of all triangles.
    pub(super) fn bounds(&self) -> Aabb {
        self.tree
            .nodes
            .first()
            .map_or(Aabb::EMPTY, |root| root.bounds)
    }

    /// The winding number at a place: 1 inside a closed surface, 0 outside, between the two near the hole of an open
    /// one. Exactly on a triangle it is the mean of both sides.
    pub(super) fn at(&self, place: Vec3) -> f64 {
        self.sum(place, FAR)
    }

    /// As [`Winding::at`], within 0.001, where the number itself counts.
    pub(super) fn precisely_at(&self, place: Vec3) -> f64 {
        self.sum(place, VERY_FAR)
    }

    fn sum(&self, place: Vec3, far: f64) -> f64 {
        let place = place.as_dvec3();
        let mut sum = 0.0;
        let mut at = 0;
        while let (Some(node), Some(dipole)) = (self.tree.nodes.get(at), self.dipoles.get(at)) {
            let away = dipole.middle - place;
            let distance = away.length();
            if distance > far * dipole.radius {
                // Half of the solid angle, as for triangles.
                sum += 0.5 * dipole.normal.dot(away) / distance.powi(3);
                at = node.skip as usize;
            } else if node.count == 0 {
                at += 1;
            } else {
                let first = node.first as usize;
                for triangle in &self.triangles[first..first + node.count as usize] {
                    sum += triangle.half_solid_angle(place);
                }
                at = node.skip as usize;
            }
        }
        sum / std::f64::consts::TAU
    }
}

fn dipoles(tree: &Tree, triangles: &[Triangle]) -> Vec<Dipole> {
    // Sums over the triangles of leaves in their order: a branch is a range of them.
    let mut sums = vec![(DVec3::ZERO, DVec3::ZERO, 0.0)];
    for triangle in triangles {
        let normal = 0.5 * triangle.area_normal().as_dvec3();
        let area = normal.length();
        let middle = triangle.0.iter().map(|c| c.as_dvec3()).sum::<DVec3>() / 3.0;
        let (normals, middles, areas) = sums[sums.len() - 1];
        sums.push((normals + normal, middles + middle * area, areas + area));
    }
    let mut ranges = vec![0..0; tree.nodes.len()];
    for (i, node) in tree.nodes.iter().enumerate().rev() {
        ranges[i] = if node.count > 0 {
            node.first as usize..(node.first + node.count) as usize
        } else {
            let second = tree.nodes[i + 1].skip as usize;
            ranges[i + 1].start..ranges[second].end
        };
    }
    let dipole = |(range, node): (&std::ops::Range<usize>, &super::tree::TreeNode)| {
        let (low, high) = (sums[range.start], sums[range.end]);
        let area = high.2 - low.2;
        let middle = if area > 0.0 {
            (high.1 - low.1) / area
        } else {
            node.bounds.center().as_dvec3()
        };
        let far = (node.bounds.max.as_dvec3() - middle).max(middle - node.bounds.min.as_dvec3());
        Dipole {
            middle,
            normal: high.0 - low.0,
            radius: far.length(),
        }
    };
    ranges.iter().zip(&tree.nodes).map(dipole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::surface::testing::{Random, soup};

    #[test]
    fn the_tree_agrees_with_the_sum() {
        let triangles: Vec<Triangle> = soup(400, 5).into_iter().map(Triangle).collect();
        let winding = Winding::new(&triangles);
        let mut random = Random(8);
        for _ in 0..300 {
            let place = random.place() * 2.0;
            let exact = triangles
                .iter()
                .map(|t| t.half_solid_angle(place.as_dvec3()))
                .sum::<f64>()
                / std::f64::consts::TAU;
            assert!((winding.at(place) - exact).abs() < 0.02, "{place}");
            assert!(
                (winding.precisely_at(place) - exact).abs() < 0.001,
                "{place}"
            );
        }
    }
}
