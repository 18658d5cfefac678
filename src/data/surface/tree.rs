//! A tree of boxes over triangles, in the form that shaders read: depth first, each node with the index of the node
//! behind its own branch, so that no stack is needed.

use glam::Vec3;

use super::triangle::{Nearest, Triangle};
use crate::math::Aabb;

/// Triangles in a leaf at most.
const LEAF: usize = 4;

/// Bins along an axis in which the surface area of boxes is weighed.
const BINS: usize = 16;

/// A box over some of the triangles, with what it takes to walk past it or into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeNode {
    /// Box of all its triangles, rest space.
    pub bounds: Aabb,
    /// The node that follows if this one is left out: behind all nodes of its branch.
    pub skip: u32,
    /// Leaves: the first of their triangles; 0 in other nodes.
    pub first: u32,
    /// Leaves: how many triangles they have; 0 in other nodes, whose first child is the next node.
    pub count: u32,
}

/// A tree over triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// The nodes, depth first; none if there is no triangle.
    pub nodes: Vec<TreeNode>,
    /// The triangles in the order of the leaves, by their index before.
    pub order: Vec<u32>,
}

/// A triangle on its way into the tree.
struct Item {
    index: u32,
    bounds: Aabb,
    middle: Vec3,
}

impl Tree {
    /// The tree over triangles, binned by the surface area of its boxes (Wald 2007).
    pub fn new(triangles: &[Triangle]) -> Self {
        let items = triangles.iter().zip(0..).map(|(triangle, index)| {
            let bounds = Aabb::from_points(triangle.0);
            Item {
                index,
                bounds,
                middle: bounds.center(),
            }
        });
        let mut items: Vec<Item> = items.collect();
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            split(&mut items, 0, &mut nodes);
        }
        Self {
            nodes,
            order: items.iter().map(|item| item.index).collect(),
        }
    }

    /// Nodes that a test of their boxes lets through, and the ranges of triangles in leaves among them.
    fn leaves<'t>(
        &'t self,
        mut enters: impl FnMut(&Aabb) -> bool + 't,
    ) -> impl FnMut() -> Option<std::ops::Range<usize>> + 't {
        let mut at = 0;
        move || {
            while let Some(node) = self.nodes.get(at) {
                let is_entered = enters(&node.bounds);
                at = if is_entered && node.count == 0 {
                    at + 1
                } else {
                    node.skip as usize
                };
                if is_entered && node.count > 0 {
                    let first = node.first as usize;
                    return Some(first..first + node.count as usize);
                }
            }
            None
        }
    }

    /// The point of the triangles (in the order of the leaves) that is nearest to a place, if it is nearer than
    /// `within`. Only triangles that `is_meant` count.
    pub fn nearest(
        &self,
        triangles: &[Triangle],
        place: Vec3,
        within: f32,
        is_meant: impl Fn(usize) -> bool,
    ) -> Option<Nearest> {
        let best = std::cell::Cell::new(within * within);
        let mut found = None;
        let mut leaves = self.leaves(|bounds| {
            let away = place.clamp(bounds.min, bounds.max) - place;
            away.length_squared() < best.get()
        });
        while let Some(leaf) = leaves() {
            for index in leaf.filter(|&index| is_meant(index)) {
                let point = triangles[index].nearest_point(place);
                let squared = point.distance_squared(place);
                if squared < best.get() {
                    best.set(squared);
                    found = Some(Nearest {
                        triangle: index,
                        point,
                        distance: squared.sqrt(),
                    });
                }
            }
        }
        found
    }

    /// Calls `each` with every triangle that a segment crosses, where on the way it does (0 to 1), and whether from the
    /// triangle's front.
    pub fn crossings(
        &self,
        triangles: &[Triangle],
        from: Vec3,
        to: Vec3,
        mut each: impl FnMut(usize, f32, bool),
    ) {
        let way = to - from;
        let mut leaves = self.leaves(|bounds| meets(bounds, from, way));
        while let Some(leaf) = leaves() {
            for index in leaf {
                if let Some((part, is_front)) = triangles[index].crossing(from, way) {
                    each(index, part, is_front);
                }
            }
        }
    }
}

/// True if a segment meets a box. The box is a little larger here than it is, against rounding.
fn meets(bounds: &Aabb, from: Vec3, way: Vec3) -> bool {
    let grown = bounds.expanded(1e-6);
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    for axis in 0..3 {
        if way[axis].abs() < 1e-12 {
            if from[axis] < grown.min[axis] || from[axis] > grown.max[axis] {
                return false;
            }
            continue;
        }
        let (a, b) = (
            (grown.min[axis] - from[axis]) / way[axis],
            (grown.max[axis] - from[axis]) / way[axis],
        );
        low = low.max(a.min(b));
        high = high.min(a.max(b));
    }
    low <= high
}

fn area(bounds: &Aabb) -> f32 {
    if bounds.is_empty() {
        return 0.0;
    }
    let side = bounds.size();
    side.x * side.y + side.y * side.z + side.z * side.x
}

/// Writes the nodes of a branch. The items lie at `first` in the order of the leaves.
///
/// The depth is bounded by the halves that are cut where bins give no gain: the larger side of a cut by bins has at
/// most all items but one, so a list of branches that are still to come stands in for recursion.
fn split(items: &mut [Item], first: usize, nodes: &mut Vec<TreeNode>) {
    // Ranges that are still to be written, the next one last; a node whose branch ends is told by its index.
    enum Next {
        Branch(std::ops::Range<usize>),
        End(usize),
    }
    let mut next = vec![Next::Branch(0..items.len())];
    while let Some(step) = next.pop() {
        let range = match step {
            Next::End(node) => {
                nodes[node].skip = nodes.len() as u32;
                continue;
            }
            Next::Branch(range) => range,
        };
        let part = &mut items[range.clone()];
        let bounds = part
            .iter()
            .fold(Aabb::EMPTY, |all, item| all.union(item.bounds));
        let is_leaf = part.len() <= LEAF;
        nodes.push(TreeNode {
            bounds,
            skip: nodes.len() as u32 + 1,
            first: if is_leaf {
                (first + range.start) as u32
            } else {
                0
            },
            count: if is_leaf { part.len() as u32 } else { 0 },
        });
        if !is_leaf {
            let middle = range.start + cut(part);
            next.push(Next::End(nodes.len() - 1));
            next.push(Next::Branch(middle..range.end));
            next.push(Next::Branch(range.start..middle));
        }
    }
}

/// Parts items in two and returns how many lie in the first part, at least one and not all.
fn cut(items: &mut [Item]) -> usize {
    let middles = Aabb::from_points(items.iter().map(|item| item.middle));
    let size = middles.size();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let scale = BINS as f32 / size[axis].max(1e-30);
    let bin =
        |item: &Item| (((item.middle[axis] - middles.min[axis]) * scale) as usize).min(BINS - 1);
    let mut bins = [(Aabb::EMPTY, 0_usize); BINS];
    for item in &*items {
        let (bounds, count) = &mut bins[bin(item)];
        *bounds = bounds.union(item.bounds);
        *count += 1;
    }
    // Cost of cutting behind each bin: areas times counts on both sides.
    let mut behind = [0.0; BINS];
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    for i in (1..BINS).rev() {
        bounds = bounds.union(bins[i].0);
        count += bins[i].1;
        behind[i - 1] = area(&bounds) * count as f32;
    }
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    let mut best = (f32::INFINITY, 0);
    for i in 0..BINS - 1 {
        bounds = bounds.union(bins[i].0);
        count += bins[i].1;
        let cost = area(&bounds) * count as f32 + behind[i];
        if count > 0 && count < items.len() && cost < best.0 {
            best = (cost, i);
        }
    }
    if best.0.is_infinite() {
        // All in one bin: any halves do.
        return items.len() / 2;
    }
    items.sort_by_key(|item| bin(item) > best.1);
    items.partition_point(|item| bin(item) <= best.1)
}

/// The values of triangles in the order of a tree's leaves.
pub(super) fn in_order<T: Copy>(order: &[u32], values: &[T]) -> Vec<T> {
    order.iter().map(|&i| values[i as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::surface::testing::{Random, soup};

    #[test]
    fn the_tree_finds_what_a_search_of_all_finds() {
        for count in [1, 4, 5, 300] {
            let triangles: Vec<Triangle> = soup(count, 7).into_iter().map(Triangle).collect();
            let tree = Tree::new(&triangles);
            let sorted: Vec<Triangle> = tree.order.iter().map(|&i| triangles[i as usize]).collect();
            let mut random = Random(3);
            for _ in 0..200 {
                let [place, other] = [random.place(), random.place()];
                let nearest = sorted
                    .iter()
                    .map(|t| t.nearest_point(place).distance(place))
                    .fold(f32::INFINITY, f32::min);
                let found = tree
                    .nearest(&sorted, place, f32::INFINITY, |_| true)
                    .expect("one");
                assert!((found.distance - nearest).abs() < 1e-6, "{count}");
                let all = sorted
                    .iter()
                    .filter(|t| t.crossing(place, other - place).is_some());
                let mut crossed = 0;
                tree.crossings(&sorted, place, other, |_, _, _| crossed += 1);
                assert_eq!(crossed, all.count(), "{count} triangles");
            }
        }
    }

    #[test]
    fn triangles_at_one_place_end_in_leaves() {
        let tree = Tree::new(&vec![Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]); 100]);
        let in_leaves: u32 = tree.nodes.iter().map(|node| node.count).sum();
        assert_eq!(in_leaves, 100);
        assert!(tree.nodes.iter().all(|node| node.count as usize <= LEAF));
        assert_eq!(tree.nodes[0].skip as usize, tree.nodes.len());
    }

    #[test]
    fn no_triangle_has_no_tree() {
        let tree = Tree::new(&[]);
        assert_eq!(tree.nearest(&[], Vec3::ZERO, 1.0, |_| true), None);
    }
}
