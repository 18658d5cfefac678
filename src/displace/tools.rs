//! What a `sweep` holds: its tools, their shapes and their paths.

use glam::{Quat, Vec3};
use std::f32::consts::TAU;

use crate::math::Aabb;

/// Most tools of a `sweep`.
pub const MAX_TOOLS: usize = 4;
/// Most tools of a `sweep` with their mirror images.
pub const MAX_IMAGES: usize = 8;
/// Most keys of a tool's path.
pub const MAX_KEYS: usize = 64;
/// Most different meshes that the tools of a document are made of.
pub const MAX_GRIDS: usize = 16;
/// Most points of a tool that is a curve.
pub const MAX_TOOL_POINTS: usize = 32;
/// Most pieces of paths in all sweeps of a document, images not counted.
pub const MAX_PIECES: usize = 256;
/// Most steps in all sweeps of a document, as its limit counts them.
pub const MAX_SWEEP_STEPS: usize = 1024;
/// Most steps that all sweeps of a document are done in: a thin coating in the way of a wide one asks for more than the
/// limit counts.
pub const MOST_STEPS: usize = 4096;

/// Ranges of lengths of tools in documents, fractions of the shortest side of the box: of what has to be solid, of
/// what may be without extent, of the straight part of a capsule.
pub(crate) const SOLID: [f64; 2] = [0.005, 2.0];
pub(crate) const ROUND: [f64; 2] = [0.0, 2.0];
pub(crate) const LONG: [f64; 2] = [0.0, 4.0];
/// Range of the longest side of a tool that is a grid of distances.
pub(crate) const LONGEST: [f64; 2] = [0.01, 4.0];
/// Ranges of the width of a coating and of the scale of a pose.
pub(crate) const COAT: [f64; 2] = [0.01, 2.0];
pub(crate) const SCALE: [f64; 2] = [0.05, 20.0];

/// Greatest coordinate of a key, template units.
pub(crate) const FARTHEST: f32 = 10.0;

/// What moves in a `sweep`, all at once.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepTools {
    /// For x, y and z: every tool has an image beyond the middle plane of the box.
    pub mirror: [bool; 3],
    /// The tools, at most [`MAX_TOOLS`].
    pub tools: Vec<SweepTool>,
    /// True if the document has more pieces or steps before it than are drawn.
    pub is_left_out: bool,
    /// Its share of [`MOST_STEPS`].
    pub most_steps: usize,
}

impl Default for SweepTools {
    /// One tool of the default shape, without images.
    fn default() -> Self {
        Self {
            mirror: [false; 3],
            tools: vec![SweepTool::default()],
            is_left_out: false,
            most_steps: MOST_STEPS,
        }
    }
}

impl SweepTools {
    /// Images of every tool, itself counted.
    pub fn images(&self) -> usize {
        1 << self.mirror.iter().filter(|is_on| **is_on).count()
    }

    /// The tools that act: those of a known shape whose images all fit.
    pub fn acting(&self) -> impl Iterator<Item = &SweepTool> {
        let known = self.tools.iter().filter(|tool| tool.shape.is_some());
        let fit = if self.is_left_out {
            0
        } else {
            (MAX_IMAGES / self.images()).min(MAX_TOOLS)
        };
        known.take(fit)
    }

    /// True if they have an image in a mirror that a document can tell: a mesh has none.
    pub fn can_be_mirrored(&self) -> bool {
        let mut shapes = self.tools.iter().filter_map(|tool| tool.shape.as_ref());
        shapes.all(|shape| shape.file().is_none())
    }

    /// The tools as they are in a mirror whose plane is the middle plane of the box across x.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut other = self.clone();
        for tool in &mut other.tools {
            if let Some(ToolShape::Curve { points, .. }) = &mut tool.shape {
                points.iter_mut().for_each(|point| point.x = -point.x);
            }
            for key in &mut tool.path {
                key.at.x = 1.0 - key.at.x;
                let [x, y, z, w] = key.rotate.to_array();
                key.rotate = Quat::from_xyzw(x, -y, -z, w);
            }
        }
        other
    }

    /// The tools on the way from others to these. What another list has more or fewer of, another shape or path, is as
    /// it is here.
    #[must_use]
    pub fn blended(&self, from: &Self, part: f32) -> Self {
        let mut out = self.clone();
        if from.tools.len() == out.tools.len() {
            for (from, to) in from.tools.iter().zip(&mut out.tools) {
                to.blend(from, part);
            }
        }
        out
    }
}

/// A set of points that moves, with a coating in which its motion fades.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepTool {
    /// Its form; `None` for one that this version does not draw.
    pub shape: Option<ToolShape>,
    /// Width of its coating, fractions of the shortest side of the box.
    pub coat: f32,
    /// True: places are joined by a smooth curve.
    pub spline: bool,
    /// Its poses, at least one.
    pub path: Vec<PathKey>,
    /// Its entry in the document's list; beyond the list for one that is new.
    pub index: usize,
}

impl Default for SweepTool {
    /// A ball that presses from above.
    fn default() -> Self {
        Self {
            shape: Some(ToolShape::Ball { radius: 0.15 }),
            coat: 0.25,
            spline: false,
            path: PathKey::PRESS.to_vec(),
            index: 0,
        }
    }
}

impl SweepTool {
    fn blend(&mut self, from: &Self, part: f32) {
        let mix = |a: f32, b: f32| a + (b - a) * part;
        self.coat = mix(from.coat, self.coat);
        if let (Some(from), Some(to)) = (&from.shape, &mut self.shape)
            && from.is_like(to)
        {
            let before = from.numbers();
            for (to, from) in to.numbers_mut().into_iter().zip(before) {
                *to = mix(from, *to);
            }
        }
        if from.path.len() != self.path.len() {
            return;
        }
        for (from, to) in from.path.iter().zip(&mut self.path) {
            to.at = from.at.lerp(to.at, part);
            to.rotate = from.rotate.slerp(to.rotate, part);
            // Geometrically, as along a path.
            let grown = libm::powf(to.scale / from.scale, part);
            to.scale = from.scale * grown;
        }
    }
}

/// A pose on the path of a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathKey {
    /// Place of the tool's origin, template space.
    pub at: Vec3,
    /// Turn about its origin.
    pub rotate: Quat,
    /// Scale about its origin.
    pub scale: f32,
}

impl PathKey {
    /// The path of a tool that presses from above.
    pub const PRESS: [Self; 2] = [
        Self::at(Vec3::new(0.5, 0.5, 1.15)),
        Self::at(Vec3::new(0.5, 0.5, 0.65)),
    ];

    /// A place without a turn.
    pub const fn at(at: Vec3) -> Self {
        Self {
            at,
            rotate: Quat::IDENTITY,
            scale: 1.0,
        }
    }
}

/// The form of a tool in its own frame; lengths are fractions of the shortest side of the box.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    missing_docs,
    reason = "spec/sweepers.md, A.4, says what each number is"
)]
pub enum ToolShape {
    Ball { radius: f32 },
    Ellipsoid { radii: Vec3 },
    Capsule { radius: f32, length: f32 },
    Box { half: Vec3, round: f32 },
    Torus { ring: f32, radius: f32 },
    Curve { points: Vec<Vec3>, radius: f32 },
    Mesh { file: ToolFile, longest: f32 },
    Clay { strokes: u32, longest: f32 },
}

/// The file of a tool that is a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolFile {
    /// The address of the file, relative to the document or absolute; without one the reader supplies the file.
    pub src: Option<String>,
    /// SHA-256 of its bytes, lower-case hex, if given.
    pub sha256: Option<String>,
    /// The author's name for it, or empty.
    pub name: String,
    /// True if the document has more different meshes before it than are drawn.
    pub is_left_out: bool,
}

impl ToolFile {
    /// The key that tells this file from other files: its hash, else its address. `None` where none is named or drawn.
    pub fn key(&self) -> Option<&str> {
        let key = self.sha256.as_deref().or(self.src.as_deref());
        key.filter(|_| !self.is_left_out)
    }
}

impl ToolShape {
    /// Names in documents of all forms that the tools of a clay may have, by their numbers.
    pub const OF_CLAYS: [&'static str; 8] = [
        "ball",
        "ellipsoid",
        "capsule",
        "box",
        "torus",
        "curve",
        "mesh",
        "clay",
    ];
    /// Those of all forms that tools of a sweep may have, in the order of the numbers that the shaders know them by.
    pub const OF_SWEEPS: [&'static str; 7] = Self::first_names();
    /// Those of the forms that numbers alone describe.
    pub const NAMES: [&'static str; 6] = Self::first_names();
    /// The number of a mesh.
    pub const MESH: usize = 6;
    /// [`ToolShape::number`] of an ellipsoid.
    pub const ELLIPSOID: usize = 1;
    /// [`ToolShape::number`] of a curve.
    pub const CURVE: usize = 5;
    /// Longest side of what is a grid of distances, where nothing is said of it.
    pub const LONGEST: f32 = 0.4;

    const fn first_names<const N: usize>() -> [&'static str; N] {
        let mut names = [""; N];
        let mut i = 0;
        while i < N {
            names[i] = Self::OF_CLAYS[i];
            i += 1;
        }
        names
    }

    /// The default of the shape of a name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "ball" => Self::Ball { radius: 0.15 },
            "ellipsoid" => Self::Ellipsoid {
                radii: Vec3::new(0.2, 0.15, 0.1),
            },
            "capsule" => Self::Capsule {
                radius: 0.08,
                length: 0.4,
            },
            "box" => Self::Box {
                half: Vec3::splat(0.15),
                round: 0.02,
            },
            "torus" => Self::Torus {
                ring: 0.2,
                radius: 0.05,
            },
            "curve" => Self::Curve {
                points: vec![Vec3::new(0.0, 0.0, -0.2), Vec3::new(0.0, 0.0, 0.2)],
                radius: 0.05,
            },
            "mesh" => Self::Mesh {
                file: ToolFile::default(),
                longest: Self::LONGEST,
            },
            "clay" => Self::Clay {
                strokes: 0,
                longest: Self::LONGEST,
            },
            _ => return None,
        })
    }

    /// Its place among [`ToolShape::OF_CLAYS`].
    pub fn number(&self) -> usize {
        match self {
            Self::Ball { .. } => 0,
            Self::Ellipsoid { .. } => Self::ELLIPSOID,
            Self::Capsule { .. } => 2,
            Self::Box { .. } => 3,
            Self::Torus { .. } => 4,
            Self::Curve { .. } => Self::CURVE,
            Self::Mesh { .. } => Self::MESH,
            Self::Clay { .. } => 7,
        }
    }

    /// Its name in documents.
    pub fn name(&self) -> &'static str {
        Self::OF_CLAYS[self.number()]
    }

    /// Its points, if it is a curve.
    pub fn points(&self) -> &[Vec3] {
        match self {
            Self::Curve { points, .. } => points,
            _ => &[],
        }
    }

    /// Its file, if it is a mesh.
    pub fn file(&self) -> Option<&ToolFile> {
        match self {
            Self::Mesh { file, .. } => Some(file),
            _ => None,
        }
    }

    fn count(&self) -> usize {
        self.points().len()
    }

    /// True if both differ in numbers alone, so that there are forms between them.
    pub fn is_like(&self, other: &Self) -> bool {
        let is_same = match (self, other) {
            (Self::Mesh { file, .. }, Self::Mesh { file: own, .. }) => file == own,
            (Self::Clay { strokes, .. }, Self::Clay { strokes: own, .. }) => strokes == own,
            _ => self.number() == other.number(),
        };
        is_same && self.count() == other.count()
    }

    /// Half of its longest side, in the lengths of its numbers.
    pub fn half_side(&self) -> f32 {
        match self {
            Self::Box { half, .. } => half.max_element(),
            Self::Curve { points, radius } => {
                let sides = Aabb::from_points(points.iter().copied()).size();
                0.5 * sides.max_element() + radius
            }
            Self::Mesh { longest, .. } | Self::Clay { longest, .. } => 0.5 * longest,
            Self::Ball { .. }
            | Self::Ellipsoid { .. }
            | Self::Capsule { .. }
            | Self::Torus { .. } => self.farthest(),
        }
    }

    /// True if both are the same mesh, the same clay, or curves of the same form, in any size.
    pub fn has_form_of(&self, other: &Self) -> bool {
        let sizes = [self, other].map(Self::half_side);
        let [own, others] = [self, other].map(Self::numbers);
        let is_near = |(a, b): (&f32, &f32)| (a / sizes[0] - b / sizes[1]).abs() < 0.02;
        self.is_like(other) && own.iter().zip(&others).all(is_near)
    }

    /// The same form, so many times as large.
    #[must_use]
    pub fn scaled(&self, by: f32) -> Self {
        let mut other = self.clone();
        other
            .numbers_mut()
            .into_iter()
            .for_each(|number| *number *= by);
        other
    }

    /// All of its numbers, in the order in which the document names them.
    pub fn numbers(&self) -> Vec<f32> {
        let mut own = self.clone();
        own.numbers_mut().into_iter().map(|x| *x).collect()
    }

    /// All of its numbers, to be changed.
    pub fn numbers_mut(&mut self) -> Vec<&mut f32> {
        match self {
            Self::Ball { radius } => vec![radius],
            Self::Ellipsoid { radii } => parts(radii).into(),
            Self::Capsule { radius, length } => vec![radius, length],
            Self::Box { half, round } => {
                let [x, y, z] = parts(half);
                vec![x, y, z, round]
            }
            Self::Torus { ring, radius } => vec![ring, radius],
            Self::Curve { points, radius } => {
                let mut all: Vec<&mut f32> = points.iter_mut().flat_map(parts).collect();
                all.push(radius);
                all
            }
            Self::Mesh { longest, .. } | Self::Clay { longest, .. } => vec![longest],
        }
    }

    /// True if a document may hold it with these numbers.
    pub(crate) fn is_in_range(&self) -> bool {
        let (all, points) = (self.numbers(), 3 * self.count());
        let is_within = |(i, x): (usize, &f32)| {
            let [low, high] = match self {
                Self::Ball { .. } | Self::Ellipsoid { .. } => SOLID,
                Self::Capsule { .. } => [ROUND, LONG][i],
                Self::Box { .. } => [SOLID, ROUND][i / 3],
                Self::Torus { .. } => [SOLID, ROUND][i],
                Self::Curve { .. } if i < points => [-LONG[1], LONG[1]],
                Self::Curve { .. } => ROUND,
                Self::Mesh { .. } | Self::Clay { .. } => LONGEST,
            };
            low <= f64::from(*x) && f64::from(*x) <= high
        };
        all.iter().enumerate().all(is_within)
    }

    /// Distance of its farthest point from its origin; of a mesh, that of a corner of the cube that holds it.
    pub fn farthest(&self) -> f32 {
        match self {
            Self::Ball { radius } => *radius,
            Self::Ellipsoid { radii } => radii.max_element(),
            Self::Capsule { radius, length } => 0.5 * length + radius,
            Self::Box { half, round } => {
                let round = round.min(half.min_element());
                (*half - round).length() + round
            }
            Self::Torus { ring, radius } => ring + radius,
            Self::Curve { points, radius } => {
                let far = points.iter().map(|point| point.length());
                far.fold(0.0, f32::max) + radius
            }
            Self::Mesh { longest, .. } | Self::Clay { longest, .. } => {
                Vec3::splat(0.5 * longest).length()
            }
        }
    }
}

/// Corners of a circle that is drawn.
const CORNERS: u16 = 32;

/// An ellipse by its half axes, closed.
fn ellipse(middle: Vec3, u: Vec3, v: Vec3) -> Vec<Vec3> {
    let corner = |i: u16| {
        let (sin, cos) = libm::sincosf(TAU * f32::from(i % CORNERS) / f32::from(CORNERS));
        middle + cos * u + sin * v
    };
    (0..=CORNERS).map(corner).collect()
}

/// The edges of a box about the origin.
fn edges(half: Vec3) -> Vec<Vec<Vec3>> {
    let corner = |i: usize| {
        let signs = [i, i >> 1, i >> 2].map(|bit| if bit & 1 == 1 { 1.0 } else { -1.0 });
        Vec3::from_array(signs) * half
    };
    let mut lines = vec![
        [0, 1, 3, 2, 0].map(corner).to_vec(),
        [4, 5, 7, 6, 4].map(corner).to_vec(),
    ];
    lines.extend((0..4).map(|i| vec![corner(i), corner(i + 4)]));
    lines
}

impl ToolShape {
    /// Lines that show its form, in its own frame; fractions of the shortest side of the box.
    pub fn outline(&self) -> Vec<Vec<Vec3>> {
        let [x, y, z] = Vec3::AXES;
        let round = |radii: Vec3| {
            let [x, y, z] = [radii * x, radii * y, radii * z];
            [[x, y], [y, z], [z, x]].map(|[u, v]| ellipse(Vec3::ZERO, u, v))
        };
        match self {
            Self::Ball { radius } => round(Vec3::splat(*radius)).into(),
            Self::Ellipsoid { radii } => round(*radii).into(),
            Self::Capsule { radius, length } => {
                let end = 0.5 * length * z;
                let [across, aside, along] = [x, y, z].map(|axis| *radius * axis);
                let mut lines = vec![ellipse(end, across, aside), ellipse(-end, across, aside)];
                lines.extend([across, aside].map(|side| {
                    let whole = ellipse(Vec3::ZERO, side, along);
                    // Half of it about either end.
                    let mut line: Vec<Vec3> = whole[..usize::from(CORNERS)]
                        .iter()
                        .map(|p| *p + if p.z < -1e-6 * radius { -end } else { end })
                        .collect();
                    line.insert(usize::from(CORNERS) / 2 + 1, -side - end);
                    line.extend([side - end, side + end]);
                    line
                }));
                lines
            }
            Self::Box { half, .. } => edges(*half),
            // The cube that holds it: its own sides are not known here.
            Self::Mesh { longest, .. } | Self::Clay { longest, .. } => {
                edges(Vec3::splat(0.5 * longest))
            }
            Self::Torus { ring, radius } => {
                let rims =
                    [ring - radius, ring + radius].map(|r| ellipse(Vec3::ZERO, r * x, r * y));
                let tubes =
                    [x, -x, y, -y].map(|out| ellipse(*ring * out, *radius * out, *radius * z));
                rims.into_iter().chain(tubes).collect()
            }
            Self::Curve { points, radius } => {
                let ends = points.iter().map(|p| ellipse(*p, *radius * x, *radius * y));
                std::iter::once(points.clone()).chain(ends).collect()
            }
        }
    }
}

/// The three numbers of a vector.
fn parts(v: &mut Vec3) -> [&mut f32; 3] {
    let Vec3 { x, y, z } = v;
    [x, y, z]
}
