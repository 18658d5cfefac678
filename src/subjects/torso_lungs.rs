//! What branches within the lungs: bronchi, arteries beside them, veins between. Each tree is grown branch by branch
//! where it has room, so that no tube cuts another and each is of one piece.
//!
//! Millimetres as in `torso`.

use glam::Vec3;

use super::lanes::{LANES, Lanes, Points};
use super::random::Random;
use super::shape::{Places, Shape, capsule};

/// Branchings from a root to the last branches.
const GENERATIONS: u32 = 5;
/// Ways that are tried for a branch; one that finds no room by then is left out.
const TRIES: u32 = 14;
/// Lung between tubes of two trees, and between those of one, mm.
const GAP_MM: f32 = 2.4;
const OWN_GAP_MM: f32 = 0.6;
/// Lung around the tubes, from the roots on, mm.
const COVER_MM: f32 = 3.0;
/// A tube counts at least as thick as it is painted on the grid that is normally shown, mm.
const LEAST_MM: f32 = 1.75;
/// The radius of a branch as a part of that before.
const NARROWER: f32 = 0.78;
/// Where trees enter the right lung, mm.
const HILUM_MM: Vec3 = Vec3::new(48.0, -16.0, 74.0);
/// Room at the end of a branch that weighs as much as so many mm outwards.
const OUTWARDS: f32 = 0.7;

/// Which tree a branch belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tree {
    Bronchi,
    /// Those that carry spent blood, beside the bronchi.
    Arteries,
    Veins,
}

/// Where a tree enters a lung: the start of its first branch, the way of that branch, its length and its radius, mm.
struct Root {
    tree: Tree,
    start: [f32; 3],
    way: [f32; 3],
    length: f32,
    radius: f32,
}

const fn root(tree: Tree, start: [f32; 3], way: [f32; 3], (length, radius): (f32, f32)) -> Root {
    Root {
        tree,
        start,
        way,
        length,
        radius,
    }
}

/// The roots: of the right lung, then of the left one. Bronchi and arteries go to each lobe; they begin within the ends
/// of the main bronchi and of the lung artery, the veins within those of the trunks that lead to the left atrium.
const ROOTS: [Root; 17] = [
    root(
        Tree::Bronchi,
        [38.0, -16.0, 74.0],
        [0.6, -0.2, 1.0],
        (27.0, 4.6),
    ),
    root(
        Tree::Bronchi,
        [40.0, -16.0, 71.0],
        [0.9, 0.9, -0.4],
        (27.0, 4.6),
    ),
    root(
        Tree::Bronchi,
        [39.0, -17.0, 71.0],
        [0.6, -0.6, -1.0],
        (31.0, 4.8),
    ),
    root(
        Tree::Bronchi,
        [-49.0, -24.0, 76.0],
        [-0.4, 0.0, 1.0],
        (27.0, 4.6),
    ),
    root(
        Tree::Bronchi,
        [-50.0, -23.0, 74.0],
        [-0.7, 0.9, -0.3],
        (25.0, 4.4),
    ),
    root(
        Tree::Bronchi,
        [-49.0, -25.0, 73.0],
        [-0.6, -0.4, -1.0],
        (31.0, 4.8),
    ),
    root(
        Tree::Arteries,
        [49.0, -9.0, 75.0],
        [0.5, 0.3, 1.0],
        (25.0, 4.4),
    ),
    root(
        Tree::Arteries,
        [50.0, -9.0, 74.0],
        [0.8, 1.0, 0.1],
        (25.0, 4.4),
    ),
    root(
        Tree::Arteries,
        [50.0, -11.0, 73.0],
        [0.9, -0.3, -0.7],
        (30.0, 4.6),
    ),
    root(
        Tree::Arteries,
        [-57.0, -19.0, 85.0],
        [-0.4, 0.4, 1.0],
        (25.0, 4.4),
    ),
    root(
        Tree::Arteries,
        [-58.0, -19.0, 84.0],
        [-0.7, 1.0, 0.2],
        (24.0, 4.2),
    ),
    root(
        Tree::Arteries,
        [-58.0, -21.0, 83.0],
        [-1.0, -0.6, -0.5],
        (30.0, 4.6),
    ),
    root(
        Tree::Veins,
        [57.0, -14.0, 76.0],
        [0.8, 0.6, 0.8],
        (25.0, 4.2),
    ),
    root(
        Tree::Veins,
        [58.0, -14.0, 75.0],
        [1.0, 0.6, -0.4],
        (24.0, 4.0),
    ),
    root(
        Tree::Veins,
        [59.0, -22.0, 44.0],
        [0.7, -0.2, -0.7],
        (28.0, 4.4),
    ),
    root(
        Tree::Veins,
        [-65.0, -12.0, 79.0],
        [-0.6, 0.8, 0.5],
        (25.0, 4.2),
    ),
    root(
        Tree::Veins,
        [-65.0, -28.0, 46.0],
        [-0.7, -0.2, -0.7],
        (28.0, 4.4),
    ),
];

/// A tube of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    pub(super) tree: Tree,
    pub(super) start: Vec3,
    pub(super) end: Vec3,
    pub(super) radius: f32,
    /// Index of the branch that it leaves; that of itself for a root.
    parent: usize,
}

impl Branch {
    fn middle(&self) -> Vec3 {
        (self.start + self.end) * 0.5
    }

    /// Half its length and its radius, mm.
    fn reach(&self) -> f32 {
        (self.end - self.start).length() * 0.5 + self.radius
    }

    fn shape(&self) -> Shape {
        let (start, end) = (self.start.to_array(), self.end.to_array());
        capsule(start, end, self.radius, self.radius * 0.86)
    }
}

/// The tubes of a tree.
pub(super) fn tubes(branches: &[Branch], tree: Tree) -> Vec<Shape> {
    let own = branches.iter().filter(|branch| branch.tree == tree);
    own.map(Branch::shape).collect()
}

/// Grows the trees, all by one generation after the other. `lung` tells how far outside the lungs places are, mm,
/// negative inside; `taken` how far they are from what else stands in the way of a tree.
pub(super) fn grow(
    lung: &dyn Fn(&Places) -> Lanes,
    taken: &dyn Fn(&Places, Tree) -> Lanes,
) -> Vec<Branch> {
    let mut wood = Wood {
        branches: Vec::new(),
        random: Random(7),
    };
    let mut tips = Vec::new();
    for root in &ROOTS {
        let way = Vec3::from_array(root.way);
        let start = Vec3::from_array(root.start);
        let index = wood.branches.len();
        let end = start + way * (root.length / way.length());
        wood.branches.push(Branch {
            tree: root.tree,
            start,
            end,
            radius: root.radius,
            parent: index,
        });
        tips.push((index, root.length));
    }
    for generation in 0..GENERATIONS {
        let mut next = Vec::new();
        for (parent, length) in tips {
            for sign in [-1.0, 1.0] {
                if let Some(grown) = wood.fork(parent, sign, generation, length, (lung, taken)) {
                    let longer = length * (0.78 + 0.12 * wood.random.next());
                    next.push((wood.branches.len(), longer));
                    wood.branches.push(grown);
                }
            }
        }
        tips = next;
    }
    wood.branches
}

struct Wood {
    branches: Vec<Branch>,
    random: Random,
}

/// Where the lungs are, and what stands in the way of a tree.
type Room<'a> = (
    &'a dyn Fn(&Places) -> Lanes,
    &'a dyn Fn(&Places, Tree) -> Lanes,
);

impl Wood {
    /// A branch to one side of the end of another: of those tried that have room, the one with most room at its end.
    fn fork(
        &mut self,
        parent: usize,
        sign: f32,
        generation: u32,
        length: f32,
        room: Room<'_>,
    ) -> Option<Branch> {
        let from = self.branches[parent];
        let way = (from.end - from.start).normalize();
        // Two planes of branching, crossed from one generation to the next.
        let helper = if way.z.abs() < 0.8 { Vec3::Z } else { Vec3::Y };
        let across = way.cross(helper).normalize();
        let (a, b) = match generation % 2 {
            0 => (across, way.cross(across)),
            _ => (way.cross(across), across),
        };
        let mut best: Option<(f32, Branch)> = None;
        for turn in 0..TRIES {
            let spread = 0.45 + 0.6 * self.random.next();
            let aside = 1.3 * (self.random.next() - 0.5);
            let along = way + a * (sign * spread) + b * aside;
            // Later tries are shorter.
            let length = length * (1.0 - 0.5 * turn as f32 / TRIES as f32);
            let grown = Branch {
                start: from.end,
                end: from.end + along * (length / along.length()),
                radius: from.radius * NARROWER,
                parent,
                ..from
            };
            if !self.has_room(&grown, room) {
                continue;
            }
            // Outwards, or branches curl.
            let hilum = HILUM_MM * Vec3::new(grown.end.x.signum(), 1.0, 1.0);
            let free = self.free_at_end(&grown) + OUTWARDS * (grown.end - hilum).length();
            if best.is_none_or(|(most, _)| free > most) {
                best = Some((free, grown));
            }
        }
        best.map(|(_, grown)| grown)
    }

    /// Distance from the end of a branch to the nearest other end, mm: of an artery that of a bronchus counts with the
    /// other sign, for arteries accompany bronchi.
    fn free_at_end(&self, grown: &Branch) -> f32 {
        let nearest = |is_asked: &dyn Fn(Tree) -> bool| {
            let others = self.branches.iter().filter(|b| is_asked(b.tree));
            others
                .map(|b| (b.end - grown.end).length_squared())
                .fold(1e6, f32::min)
                .sqrt()
        };
        match grown.tree {
            Tree::Arteries => {
                nearest(&|tree| tree == Tree::Arteries).min(18.0)
                    - nearest(&|tree| tree == Tree::Bronchi)
            }
            _ => nearest(&|_| true),
        }
    }

    fn has_room(&self, grown: &Branch, (lung, taken): Room<'_>) -> bool {
        let thick = grown.radius.max(LEAST_MM);
        // Eight places along it.
        let along = |axis: usize| {
            let (start, end) = (grown.start.to_array()[axis], grown.end.to_array()[axis]);
            Lanes::from(std::array::from_fn::<f32, LANES, _>(|i| {
                start + (end - start) * ((i + 1) as f32 / LANES as f32)
            }))
        };
        let places = Places::new(Points {
            x: along(0),
            y: along(1),
            z: along(2),
        });
        if lung(&places).highest() > -(thick + COVER_MM)
            || taken(&places, grown.tree).lowest() < thick + GAP_MM
        {
            return false;
        }
        let (middle, reach) = (grown.middle(), grown.reach());
        self.branches.iter().enumerate().all(|(index, other)| {
            if index == grown.parent || other.parent == grown.parent {
                return true;
            }
            let gap = match other.tree == grown.tree {
                true => OWN_GAP_MM,
                false => GAP_MM,
            };
            let apart = thick + other.radius.max(LEAST_MM) + gap;
            let far = reach + other.reach() + apart;
            (other.middle() - middle).length_squared() > far * far
                || distance_between(grown, other) >= apart
        })
    }
}

/// Distance between the axes of two tubes, mm (Ericson, Real-Time Collision Detection, section 5.1.9).
fn distance_between(one: &Branch, other: &Branch) -> f32 {
    let (d1, d2, r) = (
        one.end - one.start,
        other.end - other.start,
        one.start - other.start,
    );
    let (a, e, b) = (d1.length_squared(), d2.length_squared(), d1.dot(d2));
    let (c, f) = (d1.dot(r), d2.dot(r));
    let spans = a * e - b * b;
    let mut s = match spans > 1e-6 {
        true => ((b * f - c * e) / spans).clamp(0.0, 1.0),
        false => 0.0,
    };
    let t = ((b * s + f) / e.max(1e-6)).clamp(0.0, 1.0);
    s = ((b * t - c) / a.max(1e-6)).clamp(0.0, 1.0);
    (r + d1 * s - d2 * t).length()
}
