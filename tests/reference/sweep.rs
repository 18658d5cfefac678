//! A plain f64 reading of `sweep` (spec/sweepers.md, A), from the JSON of a document and in the words of that page:
//! exponential and logarithm of 4 × 4 matrices by their series, and an integrator that chooses its own steps.

use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};
use serde_json::{Value, json};

/// Error of one step of the integrator, subject units.
const TOLERANCE: f64 = 1e-9;

/// Distance to a mesh in its own space, its longest side 1.
pub(crate) type Measured = Arc<dyn Fn(DVec3) -> f64>;

/// One tool with its mirror sign, in metric coordinates of the box.
struct Tool {
    shape: Value,
    /// Shortest side of the box.
    unit: f64,
    coat: f64,
    mirror: DVec3,
    /// Of a tool that is a mesh.
    mesh: Option<Measured>,
    poses: Vec<DMat4>,
    logs: Vec<DMat4>,
}

/// A template `sweep` of a document.
pub(crate) struct Sweep {
    at: DVec3,
    rotate: DQuat,
    progress: f64,
    is_added: bool,
    tools: Vec<Tool>,
    /// Changes the sign of one screw: what the comparison has to notice.
    pub(crate) is_wrong: bool,
}

fn numbers<const N: usize>(value: &Value, default: [f64; N]) -> [f64; N] {
    match value.as_array() {
        Some(list) => std::array::from_fn(|i| list[i].as_f64().expect("a number")),
        None => default,
    }
}

fn number(value: &Value, default: f64) -> f64 {
    value.as_f64().unwrap_or(default)
}

fn vector(value: &Value, default: [f64; 3]) -> DVec3 {
    DVec3::from_array(numbers(value, default))
}

/// e^L by its power series, of a small part that is squared up again.
fn exp(l: DMat4) -> DMat4 {
    const HALVINGS: i32 = 12;
    let part = l * 0.5_f64.powi(HALVINGS);
    let mut sum = DMat4::IDENTITY;
    let mut term = DMat4::IDENTITY;
    for n in 1..12 {
        term *= part * (1.0 / f64::from(n));
        sum += term;
    }
    (0..HALVINGS).fold(sum, |m, _| m * m)
}

/// The principal square root, by the iteration of Denman and Beavers.
fn root(m: DMat4) -> DMat4 {
    let (mut y, mut z) = (m, DMat4::IDENTITY);
    for _ in 0..60 {
        let next = (y + z.inverse()) * 0.5;
        z = (z + y.inverse()) * 0.5;
        y = next;
    }
    y
}

/// log M by the series of a root that is near 1.
fn log(m: DMat4) -> DMat4 {
    const ROOTS: i32 = 8;
    let near = (0..ROOTS).fold(m, |m, _| root(m));
    let less = near - DMat4::IDENTITY;
    let mut sum = DMat4::ZERO;
    let mut power = DMat4::IDENTITY;
    for n in 1..24 {
        power *= less;
        sum += power * (if n % 2 == 1 { 1.0 } else { -1.0 } / f64::from(n));
    }
    sum * 2.0_f64.powi(ROOTS)
}

fn mu(x: f64) -> f64 {
    match x {
        x if x <= 0.0 => 1.0,
        x if x >= 1.0 => 0.0,
        x => 1.0 + x * x * x * (x * (15.0 - 6.0 * x) - 10.0),
    }
}

/// Distance to a shape, lengths in units of `unit`; 0 inside.
fn distance(shape: &Value, unit: f64, p: DVec3) -> f64 {
    let p = p / unit;
    let radius = |default| number(&shape["radius"], default);
    let away = match shape["shape"].as_str().unwrap_or("ball") {
        "ball" => p.length() - radius(0.15),
        "ellipsoid" => {
            let a = vector(&shape["radii"], [0.2, 0.15, 0.1]);
            if (p / a).length_squared() <= 1.0 {
                return 0.0;
            }
            let over = |t: f64| (a * p / (a * a + t)).length_squared() - 1.0;
            let (mut low, mut high) = (0.0, 4.0 * (p.length() + 2.0).powi(2));
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if over(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let on = a * a * p / (a * a + low);
            (p - on).length()
        }
        "capsule" => {
            let half = 0.5 * number(&shape["length"], 0.4);
            p.distance(DVec3::Z * p.z.clamp(-half, half)) - radius(0.08)
        }
        "box" => {
            let half = vector(&shape["half"], [0.15; 3]);
            let round = number(&shape["round"], 0.02).min(half.min_element());
            let core = half - round;
            p.distance(p.clamp(-core, core)) - round
        }
        "torus" => {
            let ring = p.truncate().normalize_or_zero() * number(&shape["ring"], 0.2);
            p.distance(ring.extend(0.0)) - radius(0.05)
        }
        "curve" => {
            let none = json!([[0, 0, -0.2], [0, 0, 0.2]]);
            let points = shape
                .get("points")
                .unwrap_or(&none)
                .as_array()
                .expect("a list");
            let points: Vec<DVec3> = points.iter().map(|p| vector(p, [0.0; 3])).collect();
            let piece = |pair: &[DVec3]| {
                let along = pair[1] - pair[0];
                let part = (p - pair[0]).dot(along) / along.length_squared().max(1e-30);
                p.distance(pair[0] + along * part.clamp(0.0, 1.0))
            };
            points.windows(2).map(piece).fold(f64::INFINITY, f64::min) - radius(0.05)
        }
        other => panic!("no shape {other}"),
    };
    away.max(0.0) * unit
}

/// Scale, unit quaternion and place of a key.
type Key = (f64, DQuat, DVec3);

fn key(value: &Value, size: DVec3) -> Key {
    let (at, rotate, scale) = match value.is_array() {
        true => (vector(value, [0.5; 3]), [0.0, 0.0, 0.0, 1.0], 1.0),
        false => (
            vector(&value["at"], [0.5; 3]),
            numbers(&value["rotate"], [0.0, 0.0, 0.0, 1.0]),
            number(&value["scale"], 1.0),
        ),
    };
    let turn = DQuat::from_array(rotate).normalize();
    (scale, turn, size * (at - 0.5))
}

fn matrix((scale, turn, place): Key) -> DMat4 {
    DMat4::from_scale_rotation_translation(DVec3::splat(scale), turn, place)
}

/// A Catmull-Rom curve through four points, between the middle two, as Barry and Goldman have it.
fn between(p: [DVec3; 4], t: f64) -> DVec3 {
    let mix = |a: DVec3, b: DVec3, from: f64| a.lerp(b, t - from);
    let a = [
        mix(p[0], p[1], -1.0),
        mix(p[1], p[2], 0.0),
        mix(p[2], p[3], 1.0),
    ];
    let half = |a: DVec3, b: DVec3, from: f64| a.lerp(b, (t - from) / 2.0);
    let b = [half(a[0], a[1], -1.0), half(a[1], a[2], 0.0)];
    b[0].lerp(b[1], t)
}

fn poses(tool: &Value, size: DVec3) -> Vec<DMat4> {
    let press = json!([[0.5, 0.5, 1.15], [0.5, 0.5, 0.65]]);
    let path = tool
        .get("path")
        .unwrap_or(&press)
        .as_array()
        .expect("a list");
    let keys: Vec<Key> = path.iter().map(|k| key(k, size)).collect();
    if tool["spline"] != json!(true) || keys.len() < 3 {
        return keys.into_iter().map(matrix).collect();
    }
    let last = keys.len() - 1;
    let mut poses = vec![matrix(keys[0])];
    for i in 0..last {
        let near = [i.saturating_sub(1), i, i + 1, (i + 2).min(last)].map(|k| keys[k].2);
        for quarter in 1..=4 {
            let t = f64::from(quarter) / 4.0;
            let (a, b) = (keys[i], keys[i + 1]);
            let scale = a.0.powf(1.0 - t) * b.0.powf(t);
            poses.push(matrix((scale, a.1.slerp(b.1, t), between(near, t))));
        }
    }
    poses
}

impl Tool {
    /// Field and velocity.
    fn act(&self, time: f64, p: DVec3, is_wrong: bool) -> (f64, DVec3) {
        let p = self.mirror * p;
        let pieces = self.logs.len();
        let piece = ((time * pieces as f64).floor() as usize).min(pieces.max(1) - 1);
        let log = self.logs.get(piece).copied().unwrap_or(DMat4::ZERO);
        let since = time * pieces as f64 - piece as f64;
        let pose = exp(log * since) * self.poses[piece];
        let scale = pose.determinant().cbrt();
        let own = pose.inverse().transform_point3(p);
        let away = match &self.mesh {
            Some(measured) => {
                let longest = number(&self.shape["longest"], 0.4) * self.unit;
                measured(own / longest) * longest
            }
            None => distance(&self.shape, self.unit, own),
        };
        let field = mu(scale * away / self.coat);
        let mut velocity = log * (pieces as f64) * p.extend(1.0);
        if is_wrong {
            velocity = -velocity;
        }
        (field, self.mirror * velocity.truncate())
    }
}

impl Sweep {
    fn new(template: &Value) -> Self {
        let size = vector(&template["size"], [0.5; 3]);
        let params = &template["params"];
        let letters = params["mirror"].as_str().unwrap_or("");
        let mut mirrors = vec![DVec3::ONE];
        for (axis, letter) in "xyz".chars().enumerate() {
            if letters.contains(letter) {
                let sign =
                    DVec3::from_array(std::array::from_fn(|i| if i == axis { -1.0 } else { 1.0 }));
                mirrors.extend(mirrors.clone().into_iter().map(|m| m * sign));
            }
        }
        let one = json!([{}]);
        let list = params
            .get("tools")
            .unwrap_or(&one)
            .as_array()
            .expect("a list");
        let unit = size.min_element();
        let mut tools = Vec::new();
        for tool in list {
            for mirror in &mirrors {
                let poses = poses(tool, size);
                let logs = poses.windows(2).map(|p| log(p[1] * p[0].inverse()));
                tools.push(Tool {
                    shape: tool.clone(),
                    unit,
                    coat: number(&tool["coat"], 0.25) * unit,
                    mirror: *mirror,
                    mesh: None,
                    logs: logs.collect(),
                    poses,
                });
            }
        }
        Self {
            at: vector(&template["at"], [0.0; 3]),
            rotate: DQuat::from_array(numbers(&template["rotate"], [0.0, 0.0, 0.0, 1.0]))
                .normalize(),
            progress: number(&params["progress"], 1.0) * number(&template["amount"], 1.0),
            is_added: template["mode"] == json!("add"),
            tools,
            is_wrong: false,
        }
    }

    /// This one with the distance to the mesh of its tools that are meshes.
    pub(crate) fn with_mesh(mut self, mesh: &Measured) -> Self {
        let meshes = self
            .tools
            .iter_mut()
            .filter(|tool| tool.shape["shape"] == json!("mesh"));
        for tool in meshes {
            tool.mesh = Some(Arc::clone(mesh));
        }
        self
    }

    /// The sweeps of a document.
    pub(crate) fn all(document: &Value) -> Vec<Self> {
        let templates = document["templates"].as_array().expect("templates");
        templates.iter().map(Self::new).collect()
    }

    fn velocity(&self, time: f64, p: DVec3) -> DVec3 {
        let (mut fields, mut left, mut driven) = (0.0, 1.0, DVec3::ZERO);
        for (i, tool) in self.tools.iter().enumerate() {
            let (field, velocity) = tool.act(time, p, self.is_wrong && i == 0);
            fields += field;
            left *= 1.0 - field;
            driven += field * velocity;
        }
        if fields > 0.0 {
            driven * ((1.0 - left) / fields)
        } else {
            DVec3::ZERO
        }
    }

    /// From one time to another within one piece of every tool, by steps whose error Heun's and a third-order formula
    /// tell (Bogacki and Shampine).
    fn flow(&self, from: f64, to: f64, mut p: DVec3) -> DVec3 {
        // Times stay off the very ends, where the next piece begins.
        let inside = |t: f64| {
            let [low, high] = [from.min(to), from.max(to)];
            t.clamp(low + 1e-12, high - 1e-12)
        };
        let v = |t: f64, p: DVec3| self.velocity(inside(t), p);
        let (mut t, mut h) = (from, (to - from) * 0.02);
        while (to - t).abs() > 1e-14 {
            if (to - t).abs() < h.abs() {
                h = to - t;
            }
            let k1 = v(t, p);
            let k2 = v(t + h / 2.0, p + k1 * (h / 2.0));
            let k3 = v(t + 0.75 * h, p + k2 * (0.75 * h));
            let next = p + (k1 * 2.0 + k2 * 3.0 + k3 * 4.0) * (h / 9.0);
            let k4 = v(t + h, next);
            let error = (k1 * (-5.0 / 72.0) + k2 / 12.0 + k3 / 9.0 - k4 / 8.0).length() * h.abs();
            // A step of nothing may have passed over the tool: never long.
            let longest = 0.01;
            if error < TOLERANCE && h.abs() <= longest * 1.0001 {
                (t, p) = (t + h, next);
            }
            let factor = (0.8 * (TOLERANCE / error.max(1e-300)).cbrt()).clamp(0.2, 2.0);
            h = (h * factor).clamp(-longest, longest);
        }
        p
    }

    fn breaks(&self) -> Vec<f64> {
        let mut breaks = vec![0.0, self.progress];
        for tool in &self.tools {
            let pieces = tool.logs.len();
            breaks.extend((1..pieces).map(|k| k as f64 / pieces as f64));
        }
        breaks.retain(|t| *t <= self.progress);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| (*a - *b).abs() < 1e-10);
        breaks
    }

    fn moved(&self, pos: DVec3, is_forwards: bool) -> DVec3 {
        let local = self.rotate.inverse() * (pos - self.at);
        let breaks = self.breaks();
        let mut p = local;
        if is_forwards {
            for pair in breaks.windows(2) {
                p = self.flow(pair[0], pair[1], p);
            }
        } else {
            for pair in breaks.windows(2).rev() {
                p = self.flow(pair[1], pair[0], p);
            }
        }
        if p == local {
            pos
        } else {
            self.rotate * p + self.at
        }
    }
}

/// Where what is at a point came from.
pub(crate) fn source(sweeps: &[Sweep], pos: DVec3) -> DVec3 {
    let mut p = pos;
    let mut last = sweeps.len();
    while last > 0 {
        let head = (0..last).rev().find(|i| !sweeps[*i].is_added).unwrap_or(0);
        let group = &sweeps[head..last];
        let sum: DVec3 = group.iter().map(|s| s.moved(p, false) - p).sum();
        p += sum;
        last = head;
    }
    p
}

/// Where what was at a point goes; of composed sweeps only.
pub(crate) fn target(sweeps: &[Sweep], pos: DVec3) -> DVec3 {
    assert!(
        sweeps.iter().skip(1).all(|s| !s.is_added),
        "sums have no inverse"
    );
    sweeps.iter().fold(pos, |p, sweep| sweep.moved(p, true))
}
