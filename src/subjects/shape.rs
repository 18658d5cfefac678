//! Modelling with signed distances: shapes, and fields that join, carve and brush them like clay.
//!
//! A field is a list of steps. For a block of voxels only the steps that can matter there are kept ([`Field::near`]): a
//! step whose shape is farther away than the distance that is asked for changes nothing that is looked at.

use glam::{Mat3, Vec3};

use super::lanes::{Lanes, Points};
use super::paint::Block;

/// Rounds the ridge that mirroring would leave at the middle, mm.
const MIRROR_ROUND: f32 = 1.6;

/// A shape in mm.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    form: Form,
    mirrored: bool,
}

#[derive(Clone, Debug)]
enum Form {
    /// Rows of `local` turn and scale a point into the unit ball.
    Ellipsoid {
        center: Vec3,
        turn: Mat3,
        radii: Vec3,
    },
    /// A capsule whose radius changes along it.
    Capsule {
        start: Vec3,
        along: Vec3,
        inv_length2: f32,
        r0: f32,
        dr: f32,
    },
    /// A capsule flattened along `normal` to `flat` times its radius.
    Strap {
        start: Vec3,
        along: Vec3,
        inv_length2: f32,
        r0: f32,
        dr: f32,
        normal: Vec3,
        flat: f32,
    },
    Cuboid {
        center: Vec3,
        turn: Mat3,
        half: Vec3,
        round: f32,
    },
    Disc {
        center: Vec3,
        turn: Mat3,
        radius: f32,
        half: f32,
        round: f32,
    },
}

/// A disc that lies flat, with a rounded edge.
pub(super) fn disc(center: [f32; 3], radius: f32, half: f32, round: f32) -> Shape {
    Shape {
        form: Form::Disc {
            center: at(center),
            turn: Mat3::IDENTITY,
            radius: radius - round,
            half: half - round,
            round,
        },
        mirrored: false,
    }
}

/// A rotation about x, then y, then z, degrees.
pub(super) fn turn_deg(x: f32, y: f32, z: f32) -> Mat3 {
    let sin_cos = |deg: f32| {
        let angle = f64::from(deg) * (std::f64::consts::PI / 180.0);
        (libm::sin(angle) as f32, libm::cos(angle) as f32)
    };
    let ((sx, cx), (sy, cy), (sz, cz)) = (sin_cos(x), sin_cos(y), sin_cos(z));
    let about_x = Mat3::from_cols(Vec3::X, Vec3::new(0.0, cx, sx), Vec3::new(0.0, -sx, cx));
    let about_y = Mat3::from_cols(Vec3::new(cy, 0.0, -sy), Vec3::Y, Vec3::new(sy, 0.0, cy));
    let about_z = Mat3::from_cols(Vec3::new(cz, sz, 0.0), Vec3::new(-sz, cz, 0.0), Vec3::Z);
    about_z * (about_y * about_x)
}

/// A point from an array, for tables.
pub(super) const fn at(p: [f32; 3]) -> Vec3 {
    Vec3::new(p[0], p[1], p[2])
}

/// A ball of this centre and radius, mm.
pub(super) fn ball(center: [f32; 3], radius: f32) -> Shape {
    ellipsoid(center, [radius; 3])
}

/// An ellipsoid with its axes along x, y, z.
pub(super) fn ellipsoid(center: [f32; 3], radii: [f32; 3]) -> Shape {
    Shape {
        form: Form::Ellipsoid {
            center: at(center),
            turn: Mat3::IDENTITY,
            radii: at(radii),
        },
        mirrored: false,
    }
}

/// A capsule of two radii.
pub(super) fn capsule(start: [f32; 3], end: [f32; 3], r0: f32, r1: f32) -> Shape {
    let along = at(end) - at(start);
    Shape {
        form: Form::Capsule {
            start: at(start),
            along,
            inv_length2: 1.0 / along.length_squared().max(1e-6),
            r0,
            dr: r1 - r0,
        },
        mirrored: false,
    }
}

/// A capsule of two radii, flattened along `normal` to `flat` times the radius.
pub(super) fn strap(
    start: [f32; 3],
    end: [f32; 3],
    r0: f32,
    r1: f32,
    normal: [f32; 3],
    flat: f32,
) -> Shape {
    let along = at(end) - at(start);
    let inv_length2 = 1.0 / along.length_squared().max(1e-6);
    let across = at(normal) - along * (at(normal).dot(along) * inv_length2);
    Shape {
        form: Form::Strap {
            start: at(start),
            along,
            inv_length2,
            r0,
            dr: r1 - r0,
            normal: across / across.length().max(1e-6),
            flat,
        },
        mirrored: false,
    }
}

/// A box with rounded edges.
pub(super) fn cuboid(center: [f32; 3], half: [f32; 3], round: f32) -> Shape {
    Shape {
        form: Form::Cuboid {
            center: at(center),
            turn: Mat3::IDENTITY,
            half: at(half) - Vec3::splat(round),
            round,
        },
        mirrored: false,
    }
}

impl Shape {
    /// On both sides of x = 0.
    pub(super) fn both(mut self) -> Self {
        self.mirrored = true;
        self
    }

    /// Moved by so many mm.
    pub(super) fn moved(mut self, by: [f32; 3]) -> Self {
        match &mut self.form {
            Form::Ellipsoid { center, .. }
            | Form::Cuboid { center, .. }
            | Form::Disc { center, .. } => *center += at(by),
            Form::Capsule { start, .. } | Form::Strap { start, .. } => *start += at(by),
        }
        self
    }

    /// Turned about its centre, about x, then y, then z, degrees. For ellipsoids and boxes.
    pub(super) fn turned(self, x: f32, y: f32, z: f32) -> Self {
        self.oriented(turn_deg(x, y, z))
    }

    /// Turned about its centre so that its axes lie along the columns of `frame`. For ellipsoids and boxes.
    pub(super) fn oriented(mut self, frame: Mat3) -> Self {
        if let Form::Ellipsoid { turn, .. } | Form::Cuboid { turn, .. } | Form::Disc { turn, .. } =
            &mut self.form
        {
            *turn = frame.transpose();
        }
        self
    }

    /// A capsule that holds the shape: (start, along, radius).
    fn hull(&self) -> (Vec3, Vec3, f32) {
        match self.form {
            Form::Ellipsoid { center, radii, .. } => (center, Vec3::ZERO, radii.max_element()),
            Form::Capsule {
                start,
                along,
                r0,
                dr,
                ..
            } => (start, along, r0.max(r0 + dr)),
            Form::Strap {
                start,
                along,
                r0,
                dr,
                flat,
                ..
            } => (start, along, r0.max(r0 + dr) * flat.max(1.0)),
            Form::Cuboid {
                center,
                half,
                round,
                ..
            } => (center, Vec3::ZERO, half.length() + round),
            Form::Disc {
                center,
                radius,
                half,
                round,
                ..
            } => (center, Vec3::ZERO, radius + half + round),
        }
    }

    /// A lower bound of the distance from anywhere in a ball, mm.
    fn clearance(&self, mut center: Vec3, mut radius: f32) -> f32 {
        let (start, along, hull) = self.hull();
        if self.mirrored {
            center.x = center.x.abs();
            radius += MIRROR_ROUND;
        }
        let from = center - start;
        let t = (from.dot(along) / along.length_squared().max(1e-6)).clamp(0.0, 1.0);
        (from - along * t).length() - hull - radius
    }

    /// Signed distance, mm, close to exact near the surface and never less than the distance to the hull. Capsules are
    /// at least `least` mm thick, which is 0 or more.
    #[inline(always)]
    fn distance(&self, p: &Places, least: f32) -> Lanes {
        let p = if self.mirrored { &p.folded } else { &p.plain };
        match &self.form {
            Form::Ellipsoid {
                center,
                turn,
                radii,
            } => {
                let (x, y, z) = into_frame(p, *center, turn);
                let inv = radii.recip();
                let (ux, uy, uz) = (x * inv.x, y * inv.y, z * inv.z);
                let (vx, vy, vz) = (ux * inv.x, uy * inv.y, uz * inv.z);
                let k0 = (ux * ux + uy * uy + uz * uz).sqrt() + 1e-4;
                let k1 = (vx * vx + vy * vy + vz * vz).sqrt() + 1e-4 / radii.min_element();
                let d = k0 * (k0 - 1.0) / k1;
                let far = (x * x + y * y + z * z).sqrt() - radii.max_element();
                d.max(far)
            }
            Form::Capsule {
                start,
                along,
                inv_length2,
                r0,
                dr,
            } => {
                let (ex, ey, ez, t) = off_axis(p, *start, *along, *inv_length2);
                let off = (ex * ex + ey * ey + ez * ez).sqrt();
                if least > 0.0 {
                    return off - (t * *dr + *r0).max(Lanes::splat(least));
                }
                off - t * *dr - *r0
            }
            Form::Strap {
                start,
                along,
                inv_length2,
                r0,
                dr,
                normal,
                flat,
            } => {
                let (ex, ey, ez, t) = off_axis(p, *start, *along, *inv_length2);
                let across = ex * normal.x + ey * normal.y + ez * normal.z;
                let across2 = across * across;
                let beside2 = (ex * ex + ey * ey + ez * ez - across2).max(Lanes::splat(0.0));
                let r = t * *dr + *r0;
                let inv = Lanes::splat(1.0) / (r * r);
                let inv_flat = 1.0 / (flat * flat);
                let k0 = ((beside2 + across2 * inv_flat) * inv).sqrt() + 1e-4;
                let k1 = ((beside2 + across2 * (inv_flat * inv_flat)) * inv * inv).sqrt()
                    + Lanes::splat(1e-4) / (r * flat.min(1.0));
                k0 * (k0 - 1.0) / k1
            }
            Form::Cuboid {
                center,
                turn,
                half,
                round,
            } => {
                let zero = Lanes::splat(0.0);
                let (x, y, z) = into_frame(p, *center, turn);
                let (x, y, z) = (x.abs() - half.x, y.abs() - half.y, z.abs() - half.z);
                let (ox, oy, oz) = (x.max(zero), y.max(zero), z.max(zero));
                (ox * ox + oy * oy + oz * oz).sqrt() + x.max(y).max(z).min(zero) - *round
            }
            Form::Disc {
                center,
                turn,
                radius,
                half,
                round,
            } => {
                let zero = Lanes::splat(0.0);
                let (x, y, z) = into_frame(p, *center, turn);
                let (r, z) = ((x * x + y * y).sqrt() - *radius, z.abs() - *half);
                let (outside_r, outside_z) = (r.max(zero), z.max(zero));
                (outside_r * outside_r + outside_z * outside_z).sqrt() + r.max(z).min(zero) - *round
            }
        }
    }

    /// 1 in the middle of the shape, falling smoothly to 0 at its surface.
    #[inline(always)]
    fn weight(&self, p: &Places) -> Lanes {
        let p = if self.mirrored { &p.folded } else { &p.plain };
        let q2 = match &self.form {
            Form::Ellipsoid {
                center,
                turn,
                radii,
            } => {
                let (x, y, z) = into_frame(p, *center, turn);
                let (x, y, z) = (x / radii.x, y / radii.y, z / radii.z);
                x * x + y * y + z * z
            }
            Form::Capsule {
                start,
                along,
                inv_length2,
                r0,
                dr,
            }
            | Form::Strap {
                start,
                along,
                inv_length2,
                r0,
                dr,
                ..
            } => {
                let (ex, ey, ez, t) = off_axis(p, *start, *along, *inv_length2);
                let r = t * *dr + *r0;
                (ex * ex + ey * ey + ez * ez) / (r * r)
            }
            Form::Cuboid { .. } | Form::Disc { .. } => Lanes::splat(1.0),
        };
        let w = (Lanes::splat(1.0) - q2).max(Lanes::splat(0.0));
        w * w
    }
}

#[inline(always)]
fn into_frame(p: &Points, center: Vec3, turn: &Mat3) -> (Lanes, Lanes, Lanes) {
    let (x, y, z) = (p.x - center.x, p.y - center.y, p.z - center.z);
    if *turn == Mat3::IDENTITY {
        return (x, y, z);
    }
    let row = |i: usize| {
        x * turn.x_axis.to_array()[i]
            + y * turn.y_axis.to_array()[i]
            + z * turn.z_axis.to_array()[i]
    };
    (row(0), row(1), row(2))
}

#[inline(always)]
fn off_axis(
    p: &Points,
    start: Vec3,
    along: Vec3,
    inv_length2: f32,
) -> (Lanes, Lanes, Lanes, Lanes) {
    let (x, y, z) = (p.x - start.x, p.y - start.y, p.z - start.z);
    let t = ((x * along.x + y * along.y + z * along.z) * inv_length2).clamp(0.0, 1.0);
    (x - t * along.x, y - t * along.y, z - t * along.z, t)
}

/// Eight points, and the same folded over to the right side.
pub(super) struct Places {
    pub(super) plain: Points,
    pub(super) folded: Points,
}

impl Places {
    /// Keeps the points and folds them over to the right side.
    #[inline(always)]
    pub(super) fn new(plain: Points) -> Self {
        let folded = Points {
            x: (plain.x * plain.x + MIRROR_ROUND * MIRROR_ROUND).sqrt(),
            ..plain
        };
        Self { plain, folded }
    }
}

#[derive(Clone, Copy, Debug)]
enum Op {
    /// Smooth union over so many mm.
    Join(f32),
    /// Smooth difference over so many mm.
    Carve(f32),
    /// Moves the surface outwards by so many mm where the shape is, most in its middle.
    Raise(f32),
}

/// Clay: a list of steps, each of which changes the signed distance that the ones before left. A step's shapes act as
/// one: their plain union.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    steps: Vec<(Op, Vec<Shape>)>,
    /// Per step the largest rounding of it and all later ones: so far does what it left still count.
    rounding: Vec<f32>,
}

/// Distance that stands for “nowhere near”, mm.
pub(super) const FAR: f32 = 1e3;

/// A point and the radius there, mm.
pub(super) type Knot = ([f32; 3], f32);

/// Capsules along a smooth curve through the knots (Catmull and Rom's), on one side.
pub(super) fn curve(knots: &[Knot]) -> Vec<Shape> {
    chain(&along_curve(knots))
}

/// Points along a smooth curve through the knots (Catmull and Rom's), four to each piece.
pub(super) fn along_curve(knots: &[Knot]) -> Vec<Knot> {
    const PIECES: usize = 4;
    let knot = |i: isize| {
        let i = i.clamp(0, knots.len() as isize - 1) as usize;
        at(knots[i].0).extend(knots[i].1)
    };
    let mut points = Vec::new();
    for i in 0..knots.len() as isize - 1 {
        let (a, b, c, d) = (knot(i - 1), knot(i), knot(i + 1), knot(i + 2));
        for piece in 0..PIECES {
            let t = piece as f32 / PIECES as f32;
            let (t2, t3) = (t * t, t * t * t);
            points.push(
                (b * 2.0
                    + (c - a) * t
                    + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2
                    + (b * 3.0 - a - c * 3.0 + d) * t3)
                    * 0.5,
            );
        }
    }
    points.push(knot(knots.len() as isize - 1));
    let knots = points.into_iter();
    knots
        .map(|point| (point.truncate().to_array(), point.w))
        .collect()
}

/// Capsules from each knot to the next.
pub(super) fn chain(knots: &[Knot]) -> Vec<Shape> {
    knots
        .windows(2)
        .map(|pair| capsule(pair[0].0, pair[1].0, pair[0].1.max(0.1), pair[1].1.max(0.1)))
        .collect()
}

/// Every shape on both sides of x = 0.
pub(super) fn both(shapes: Vec<Shape>) -> Vec<Shape> {
    shapes.into_iter().map(Shape::both).collect()
}

impl Field {
    fn push(&mut self, step: (Op, Vec<Shape>)) {
        let own = match step.0 {
            Op::Join(k) | Op::Carve(k) => k,
            Op::Raise(_) => 0.0,
        };
        self.steps.push(step);
        self.rounding.push(0.0);
        for later in &mut self.rounding {
            *later = later.max(own);
        }
    }

    /// Adds a shape, its edge rounded over `smooth` mm.
    pub(super) fn join(&mut self, smooth: f32, shape: Shape) {
        self.push((Op::Join(smooth), vec![shape]));
    }

    /// Adds several shapes that are one among themselves.
    pub(super) fn join_all(&mut self, smooth: f32, shapes: Vec<Shape>) {
        self.push((Op::Join(smooth), shapes));
    }

    /// Adds what another field adds, its first step rounded over `smooth` mm.
    pub(super) fn append(&mut self, other: Field, smooth: f32) {
        for (index, (op, shapes)) in other.steps.into_iter().enumerate() {
            let op = if index == 0 { Op::Join(smooth) } else { op };
            self.push((op, shapes));
        }
    }

    /// Takes a shape away.
    pub(super) fn carve(&mut self, smooth: f32, shape: Shape) {
        self.push((Op::Carve(smooth), vec![shape]));
    }

    /// Takes several shapes away that are one among themselves.
    pub(super) fn carve_all(&mut self, smooth: f32, shapes: Vec<Shape>) {
        self.push((Op::Carve(smooth), shapes));
    }

    /// Raises (or, negative, presses in) the surface by `mm` within a shape.
    pub(super) fn raise(&mut self, mm: f32, shape: Shape) {
        self.push((Op::Raise(mm), vec![shape]));
    }

    /// As [`Field::raise`] within several shapes; where they overlap the surface is raised once.
    pub(super) fn raise_all(&mut self, mm: f32, shapes: Vec<Shape>) {
        self.push((Op::Raise(mm), shapes));
    }

    /// Moves a point along the field's slope to where its distance is `target` mm.
    pub(super) fn pull(&self, point: [f32; 3], target: f32) -> [f32; 3] {
        let near = self.everywhere();
        let mut pos = at(point);
        for _ in 0..4 {
            // The point itself and three neighbours in the lanes.
            let offsets = |axis: usize| {
                let mut lanes = [pos.to_array()[axis]; super::lanes::LANES];
                lanes[axis + 1] += 0.5;
                Lanes::from(lanes)
            };
            let d = near.distance(&Places::new(Points {
                x: offsets(0),
                y: offsets(1),
                z: offsets(2),
            }));
            let slope = (Vec3::new(d[1], d[2], d[3]) - Vec3::splat(d[0])) / 0.5;
            pos += slope * ((target - d[0]) / slope.length_squared().max(0.3));
        }
        pos.to_array()
    }

    /// The distance at a point, mm.
    pub(super) fn at(&self, point: [f32; 3]) -> f32 {
        let [x, y, z] = point.map(Lanes::splat);
        self.everywhere().distance(&Places::new(Points { x, y, z }))[0]
    }

    /// All steps, for points anywhere.
    pub(super) fn everywhere(&self) -> Near<'_> {
        Near {
            least: 0.0,
            steps: self.steps.iter().map(|(op, s)| (*op, s.len())).collect(),
            shapes: self.steps.iter().flat_map(|(_, s)| s).collect(),
        }
    }

    /// As [`Field::near`], with capsules that are at least `least` mm thick.
    pub(super) fn near_thick<'a>(
        &'a self,
        block: &Block,
        band: f32,
        least: f32,
        near: &mut Near<'a>,
    ) {
        self.near(block, band + least, near);
        near.least = least;
    }

    /// The steps that can matter in a block for distances up to `band` mm; empty if nothing is there.
    pub(super) fn near<'a>(&'a self, block: &Block, band: f32, near: &mut Near<'a>) {
        if !self.gather(block, band, near) {
            near.steps.clear();
        }
    }

    /// As [`Field::near`], for a field that changes a distance from elsewhere ([`Near::onto`]), even if it only dents.
    pub(super) fn near_onto<'a>(&'a self, block: &Block, band: f32) -> Near<'a> {
        let mut near = Near::default();
        self.gather(block, band, &mut near);
        near
    }

    /// Keeps the steps that can matter; true if one of them adds something.
    fn gather<'a>(&'a self, block: &Block, band: f32, near: &mut Near<'a>) -> bool {
        near.steps.clear();
        near.shapes.clear();
        near.least = 0.0;
        let (center, radius) = (block.center(), block.radius());
        let mut any = false;
        for ((op, shapes), later) in self.steps.iter().zip(&self.rounding) {
            let reach = match op {
                Op::Join(_) | Op::Carve(_) => band + later,
                Op::Raise(_) => 0.0,
            };
            let first = near.shapes.len();
            near.shapes.extend(
                shapes
                    .iter()
                    .filter(|shape| shape.clearance(center, radius) <= reach),
            );
            if near.shapes.len() > first {
                any |= matches!(op, Op::Join(_));
                near.steps.push((*op, near.shapes.len() - first));
            }
        }
        any
    }
}

/// The steps of a field that matter in one block; kept between blocks to spare the allocation.
#[derive(Default)]
pub(super) struct Near<'a> {
    /// An operation, and the number of the next shapes that it takes.
    steps: Vec<(Op, usize)>,
    shapes: Vec<&'a Shape>,
    /// Capsules are at least so thick, mm.
    least: f32,
}

impl Near<'_> {
    /// True if the field is nowhere near the block.
    pub(super) fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Distances to the nearest and the second nearest of the fields' steps, as if each stood alone, mm: where they are
    /// about equal, two bodies touch.
    #[inline]
    pub(super) fn two_nearest(&self, p: &Places) -> (Lanes, Lanes) {
        let (mut first, mut second) = (Lanes::splat(FAR), Lanes::splat(FAR));
        let mut rest = self.shapes.as_slice();
        for (_, count) in &self.steps {
            let (shapes, later) = rest.split_at(*count);
            rest = later;
            let mut d = shapes[0].distance(p, self.least);
            for shape in &shapes[1..] {
                d = d.min(shape.distance(p, self.least));
            }
            second = second.min(first.max(d));
            first = first.min(d);
        }
        (first, second)
    }

    /// Signed distance of each point, mm; below 0 inside.
    #[inline]
    pub(super) fn distance(&self, p: &Places) -> Lanes {
        self.onto(p, Lanes::splat(FAR))
    }

    /// What the steps make of a distance from elsewhere, mm.
    #[inline]
    pub(super) fn onto(&self, p: &Places, mut d: Lanes) -> Lanes {
        let mut rest = self.shapes.as_slice();
        for (op, count) in &self.steps {
            let (shapes, later) = rest.split_at(*count);
            rest = later;
            if let Op::Raise(mm) = *op {
                let mut weight = shapes[0].weight(p);
                for shape in &shapes[1..] {
                    weight = weight.max(shape.weight(p));
                }
                d = d - weight * mm;
                continue;
            }
            let mut e = shapes[0].distance(p, self.least);
            for shape in &shapes[1..] {
                e = e.min(shape.distance(p, self.least));
            }
            d = match *op {
                Op::Join(k) => smooth_min(d, e, k),
                Op::Carve(k) => -smooth_min(-d, e, k),
                Op::Raise(_) => d,
            };
        }
        d
    }
}

/// The smaller of two distances, rounded where they are within `k` mm of each other.
#[inline(always)]
pub(super) fn smooth_min(a: Lanes, b: Lanes, k: f32) -> Lanes {
    let low = a.min(b);
    if k <= 0.0 {
        return low;
    }
    let h = (Lanes::splat(k) - (a - b).abs()).max(Lanes::splat(0.0));
    low - h * h * (0.25 / k)
}
