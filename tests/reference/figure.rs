//! The solve of figures, read a second time from the contract alone: dense, from the exported JSON, with other methods
//! (energies are sampled, not differentiated; rounds are plain).

#![allow(
    clippy::needless_range_loop,
    reason = "formulas are read by their indices"
)]

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use serde_json::Value;

/// A point, or a complex number.
pub(crate) type P = [f64; 2];

pub(crate) fn add(a: P, b: P) -> P {
    [a[0] + b[0], a[1] + b[1]]
}
pub(crate) fn sub(a: P, b: P) -> P {
    [a[0] - b[0], a[1] - b[1]]
}
pub(crate) fn times(s: f64, a: P) -> P {
    [s * a[0], s * a[1]]
}
pub(crate) fn dot(a: P, b: P) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
pub(crate) fn mul(a: P, b: P) -> P {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}
pub(crate) fn conj(a: P) -> P {
    [a[0], -a[1]]
}
pub(crate) fn polar(r: f64, t: f64) -> P {
    [r * t.cos(), r * t.sin()]
}

pub(crate) fn point(value: &Value) -> P {
    [value[0].as_f64().expect("x"), value[1].as_f64().expect("y")]
}
pub(crate) fn points(value: &Value) -> Vec<P> {
    value
        .as_array()
        .expect("points")
        .iter()
        .map(point)
        .collect()
}
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("numbers")
        .iter()
        .map(|v| v.as_f64().expect("a number"))
        .collect()
}
pub(crate) fn indices(value: &Value) -> Vec<usize> {
    value
        .as_array()
        .expect("indices")
        .iter()
        .map(|v| v.as_u64().expect("an index") as usize)
        .collect()
}
pub(crate) fn triples(value: &Value) -> Vec<[usize; 3]> {
    value
        .as_array()
        .expect("triples")
        .iter()
        .map(|t| indices(t).try_into().expect("three"))
        .collect()
}

/// A triangle that gives way.
#[derive(Clone)]
pub(crate) struct Tri {
    v: [usize; 3],
    grad: [P; 3],
    area: f64,
    k2: P,
    /// The rigid part whose turn it has.
    part: Option<usize>,
    index: usize,
}

pub(crate) fn gradients(rest: &[P], v: [usize; 3]) -> ([P; 3], f64) {
    let [a, b, c] = v.map(|i| rest[i]);
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let g = |from: P, to: P| [-(to[1] - from[1]) / twice, (to[0] - from[0]) / twice];
    ([g(b, c), g(c, a), g(a, b)], twice / 2.0)
}

/// Gradients of x and of y.
pub(crate) fn jacobian(tri: &Tri, f: &[P]) -> [P; 2] {
    let mut rows = [[0.0; 2]; 2];
    for (v, g) in tri.v.iter().zip(&tri.grad) {
        for m in 0..2 {
            rows[m] = add(rows[m], times(f[*v][m], *g));
        }
    }
    rows
}

/// e^ℓ R B.
pub(crate) fn turned(z: P, b: [P; 2]) -> [P; 2] {
    [
        sub(times(z[0], b[0]), times(z[1], b[1])),
        add(times(z[1], b[0]), times(z[0], b[1])),
    ]
}

pub(crate) fn tri_energy(tri: &Tri, j: [P; 2], w: [P; 2]) -> f64 {
    let (x, y) = (sub(j[0], w[0]), sub(j[1], w[1]));
    tri.area * (tri.k2[0] * dot(x, x) + tri.k2[1] * dot(y, y))
}

/// The angle with the least value of a function that is a trigonometric polynomial of the second degree, from samples.
pub(crate) fn least_angle(f: impl Fn(f64) -> f64) -> f64 {
    let n = 8;
    let (mut c, mut s) = ([0.0; 3], [0.0; 3]);
    for i in 0..n {
        let t = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let value = f(t);
        for k in 1..3 {
            c[k] += value * (k as f64 * t).cos() * 2.0 / f64::from(n);
            s[k] += value * (k as f64 * t).sin() * 2.0 / f64::from(n);
        }
    }
    if c[2].abs() + s[2].abs() < 1e-9 * (c[1].abs() + s[1].abs()) {
        return (-s[1]).atan2(-c[1]);
    }
    let value =
        |t: f64| c[1] * t.cos() + s[1] * t.sin() + c[2] * (2.0 * t).cos() + s[2] * (2.0 * t).sin();
    let start = (0..64)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 64.0)
        .min_by(|a, b| value(*a).total_cmp(&value(*b)));
    let mut t = start.expect("samples");
    for _ in 0..20 {
        let d = -c[1] * t.sin() + s[1] * t.cos() - 2.0 * c[2] * (2.0 * t).sin()
            + 2.0 * s[2] * (2.0 * t).cos();
        let dd = -c[1] * t.cos()
            - s[1] * t.sin()
            - 4.0 * c[2] * (2.0 * t).cos()
            - 4.0 * s[2] * (2.0 * t).sin();
        if dd > 0.0 {
            t -= d / dd;
        }
    }
    t
}

/// Dense Cholesky.
struct Dense(Vec<Vec<f64>>);

impl Dense {
    fn new(mut a: Vec<Vec<f64>>) -> Self {
        let n = a.len();
        for i in 0..n {
            for j in 0..=i {
                let mut sum = a[i][j];
                for k in 0..j {
                    sum -= a[i][k] * a[j][k];
                }
                a[i][j] = if i == j {
                    sum.max(1e-300).sqrt()
                } else {
                    sum / a[j][j]
                };
            }
        }
        Self(a)
    }
    fn solve(&self, mut x: Vec<f64>) -> Vec<f64> {
        let n = x.len();
        for i in 0..n {
            for k in 0..i {
                x[i] -= self.0[i][k] * x[k];
            }
            x[i] /= self.0[i][i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] -= self.0[k][i] * x[k];
            }
            x[i] /= self.0[i][i];
        }
        x
    }
}

/// A grip as the reference has it.
struct Held {
    outside: bool,
    point: bool,
    vertices: Vec<usize>,
    before: P,
    after: P,
    turn: Option<f64>,
    scale: f64,
    aims: Option<(Vec<P>, Vec<f64>, Vec<f64>)>,
}

pub(crate) struct Reference {
    rest: Vec<P>,
    triangles: Vec<[usize; 3]>,
    region: Vec<usize>,
    rigidity: Vec<Option<P>>,
    names: Vec<String>,
    file: Value,
}

/// What turns as a whole.
struct Whole {
    vertices: Vec<usize>,
    pivot: P,
    place: P,
    scale: f64,
    angle: f64,
    part: Option<usize>,
    is_free: bool,
    grip: Option<usize>,
}

impl Reference {
    pub(crate) fn new(file: Value) -> Self {
        let regions = file["regions"].as_array().expect("regions");
        let rigidity = |value: &Value| match value {
            Value::String(_) => None,
            Value::Array(_) => Some(point(value)),
            _ => Some([value.as_f64().expect("k"); 2]),
        };
        Self {
            rest: points(&file["vertices"]),
            triangles: triples(&file["triangles"]),
            region: indices(&file["region"]),
            rigidity: regions.iter().map(|r| rigidity(&r["rigidity"])).collect(),
            names: regions
                .iter()
                .map(|r| r["name"].as_str().expect("a name").to_owned())
                .collect(),
            file,
        }
    }

    fn carried(&self, at: P, places: &[P]) -> P {
        for t in &self.triangles {
            let [a, b, c] = t.map(|v| self.rest[v]);
            let cross =
                |p: P, q: P, r: P| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            let area = cross(a, b, c);
            let w = [
                cross(at, b, c) / area,
                cross(a, at, c) / area,
                cross(a, b, at) / area,
            ];
            if w.iter().all(|w| *w >= -1e-9) {
                return (0..3).fold([0.0; 2], |sum, i| add(sum, times(w[i], places[t[i]])));
            }
        }
        at
    }

    pub(crate) fn solve(&self) -> Vec<P> {
        let contours = self.file["contours"].as_array().expect("contours");
        let context = &self.file["context"];
        let base = if contours.is_empty() && context["like"].is_null() {
            self.rest.clone()
        } else {
            self.shape(contours, context)
        };
        let grips: Vec<Held> = self.file["handles"]
            .as_array()
            .expect("handles")
            .iter()
            .map(|h| self.grip(h, &base))
            .collect();
        let kept = (!context.is_null() && context["keep"] == true).then(|| {
            indices(&context["vertices"])
                .iter()
                .map(|v| base[*v])
                .collect::<Vec<P>>()
        });
        let is_found = self.file["rotations"] == "found";
        self.stage(
            &grips,
            &base,
            kept,
            is_found,
            self.file["reach"].as_f64().expect("reach"),
            &[],
        )
    }

    fn shape(&self, contours: &[Value], context: &Value) -> Vec<P> {
        let grip = |value: &Value| Held {
            outside: false,
            point: false,
            vertices: indices(&value["vertices"]),
            before: [0.0; 2],
            after: [0.0; 2],
            turn: Some(0.0),
            scale: 1.0,
            aims: Some((
                points(&value["to"]),
                numbers(&value["turns"]),
                numbers(&value["scales"]),
            )),
        };
        let grips: Vec<Held> = contours.iter().map(grip).collect();
        let elastic: Vec<usize> = contours
            .iter()
            .map(|c| {
                self.names
                    .iter()
                    .position(|name| name == c["region"].as_str().expect("a region"))
                    .expect("a region")
            })
            .collect();
        let kept = (!context["like"].is_null()).then(|| {
            let p: Vec<P> = indices(&context["vertices"])
                .iter()
                .map(|v| self.rest[*v])
                .collect();
            let like = points(&context["like"]);
            let amount = context["amount"].as_f64().expect("amount");
            let (z, mean_like, mean) = similarity(&like, &p);
            let bring = |(p, q): (&P, &P)| {
                add(
                    times(1.0 - amount, *p),
                    times(amount, add(mean, mul(z, sub(*q, mean_like)))),
                )
            };
            p.iter().zip(&like).map(bring).collect()
        });
        self.stage(&grips, &self.rest, kept, false, 0.0, &elastic)
    }

    fn grip(&self, value: &Value, base: &[P]) -> Held {
        let kind = value["kind"].as_str().expect("a kind");
        let before = self.carried(point(&value["at"]), base);
        let aims = value.get("to").map(|to| {
            (
                points(to),
                numbers(&value["turns"]),
                numbers(&value["scales"]),
            )
        });
        Held {
            outside: kind == "outside",
            point: kind == "point",
            vertices: indices(&value["vertices"]),
            before,
            after: add(before, point(&value["move"])),
            turn: value["turn"].as_f64(),
            scale: value["scale"].as_f64().expect("scale"),
            aims,
        }
    }

    /// Rigid parts: their triangles, and the part that each vertex moves with.
    fn parts(&self, elastic: &[usize]) -> (Vec<Vec<usize>>, Vec<Option<usize>>) {
        let n = self.triangles.len();
        let is_rigid = |t: usize| {
            self.rigidity[self.region[t]].is_none() && !elastic.contains(&self.region[t])
        };
        let mut by_edge: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        let edges = |t: usize| {
            let [a, b, c] = self.triangles[t];
            [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b)))
        };
        for t in 0..n {
            edges(t)
                .into_iter()
                .for_each(|e| by_edge.entry(e).or_default().push(t));
        }
        let mut part: Vec<Option<usize>> = vec![None; n];
        let mut parts: Vec<Vec<usize>> = Vec::new();
        for first in 0..n {
            if !is_rigid(first) || part[first].is_some() {
                continue;
            }
            part[first] = Some(parts.len());
            let mut queue = VecDeque::from([first]);
            let mut list = Vec::new();
            while let Some(t) = queue.pop_front() {
                list.push(t);
                for e in edges(t) {
                    for other in &by_edge[&e] {
                        if part[*other].is_none() && self.region[*other] == self.region[first] {
                            part[*other] = Some(parts.len());
                            queue.push_back(*other);
                        }
                    }
                }
            }
            parts.push(list);
        }
        let mut owner = vec![None; self.rest.len()];
        for (number, list) in parts.iter().enumerate() {
            for v in list.iter().flat_map(|t| self.triangles[*t]) {
                owner[v].get_or_insert(number);
            }
        }
        (parts, owner)
    }

    fn stage(
        &self,
        grips: &[Held],
        base: &[P],
        kept: Option<Vec<P>>,
        is_found: bool,
        reach: f64,
        elastic: &[usize],
    ) -> Vec<P> {
        let n = self.rest.len();
        let (parts, owner) = self.parts(elastic);
        let of_part =
            |p: usize| -> Vec<usize> { (0..n).filter(|v| owner[*v] == Some(p)).collect() };
        let bone = [10.0; 2];
        let k_of = |t: usize| {
            let region = self.region[t];
            if elastic.contains(&region) && self.rigidity[region].is_none() {
                Some(bone)
            } else {
                self.rigidity[region]
            }
        };
        // Who holds what.
        let mut holder: Vec<Option<usize>> = vec![None; n];
        for (number, grip) in grips.iter().enumerate() {
            grip.vertices.iter().for_each(|v| {
                holder[*v].get_or_insert(number);
            });
        }
        let guess = |number: usize| {
            let own = &grips[number];
            let mut sum = [0.0; 2];
            for (i, other) in grips.iter().enumerate() {
                let (a, b) = (sub(other.before, own.before), sub(other.after, own.after));
                if i != number && !other.outside && dot(a, a) > 0.0 {
                    sum = add(sum, times(1.0 / (dot(a, a) * dot(a, a)), mul(conj(a), b)));
                }
            }
            sum[1].atan2(sum[0])
        };
        let mut f = base.to_vec();
        let mut spin = vec![[0.0; 2]; n];
        let mut wholes: Vec<Whole> = Vec::new();
        let mut given: Vec<Option<P>> = vec![None; parts.len()];
        for (number, grip) in grips.iter().enumerate() {
            let held: Vec<usize> = (0..n).filter(|v| holder[*v] == Some(number)).collect();
            if held.is_empty() {
                continue;
            }
            if let Some((to, turns, scales)) = &grip.aims {
                for (i, v) in grip
                    .vertices
                    .iter()
                    .enumerate()
                    .filter(|(_, v)| holder[**v] == Some(number))
                {
                    f[*v] = to[i];
                    spin[*v] = [turns[i], scales[i].ln()];
                }
                continue;
            }
            let part = (0..parts.len()).find(|p| grip.point && of_part(*p) == grip.vertices);
            let pins: Vec<&Held> = match part {
                Some(p) => grips
                    .iter()
                    .filter(|g| g.point && of_part(p) == g.vertices)
                    .collect(),
                None => vec![grip],
            };
            let (before, after, turn);
            if pins.len() > 1 {
                let (from, to): (Vec<P>, Vec<P>) = pins.iter().map(|p| (p.before, p.after)).unzip();
                let (z, mean_from, mean_to) = similarity(&from, &to);
                (before, after, turn) = (mean_from, mean_to, Some(z[1].atan2(z[0])));
            } else {
                (before, after, turn) = (grip.before, grip.after, grip.turn);
            }
            let angle = turn.unwrap_or_else(|| guess(number));
            for v in &held {
                f[*v] = add(after, mul(polar(grip.scale, angle), sub(base[*v], before)));
                spin[*v] = [angle, grip.scale.ln()];
            }
            if turn.is_none() {
                wholes.push(Whole {
                    vertices: held,
                    pivot: before,
                    place: after,
                    scale: grip.scale,
                    angle,
                    part: None,
                    is_free: false,
                    grip: Some(number),
                });
            }
        }
        let spins = self.spread(&spin, &holder, grips.len(), &k_of, reach);
        let mean = |t: usize| {
            let s = self.triangles[t].map(|v| spins[v]);
            times(1.0 / 3.0, add(add(s[0], s[1]), s[2]))
        };
        let mut free = Vec::new();
        for (p, list) in parts.iter().enumerate() {
            let vertices = of_part(p);
            let Some(first) = vertices.first() else {
                continue;
            };
            if holder[*first].is_some() {
                given[p] = Some(polar(spin[*first][1].exp(), spin[*first][0]));
                continue;
            }
            let (mut s, mut total) = ([0.0; 2], 0.0);
            for t in list {
                let area = gradients(&self.rest, self.triangles[*t]).1;
                s = add(s, times(area, mean(*t)));
                total += area;
            }
            let pivot = times(
                1.0 / vertices.len() as f64,
                vertices.iter().fold([0.0; 2], |sum, v| add(sum, base[*v])),
            );
            free.push(Whole {
                vertices,
                pivot,
                place: pivot,
                scale: (s[1] / total).exp(),
                angle: s[0] / total,
                part: Some(p),
                is_free: true,
                grip: None,
            });
        }
        free.extend(wholes);
        let mut wholes = free;
        // The triangles that give way.
        let mut tris = Vec::new();
        for (t, v) in self.triangles.iter().enumerate() {
            let part = parts
                .iter()
                .position(|list| list.contains(&t))
                .filter(|p| !of_part(*p).is_empty());
            let (grad, area) = gradients(&self.rest, *v);
            let k = match part {
                Some(p) if v.iter().all(|v| owner[*v] == Some(p)) => continue,
                Some(_) => [1.0; 2],
                None => k_of(t).unwrap_or([1.0; 2]),
            };
            tris.push(Tri {
                v: *v,
                grad,
                area,
                k2: [k[0] * k[0], k[1] * k[1]],
                part,
                index: t,
            });
        }
        let context = &self.file["context"];
        let sheet: Vec<Tri> = match &kept {
            Some(_) => triples(&context["triangles"])
                .iter()
                .map(|v| {
                    let (grad, area) = gradients(&self.rest, *v);
                    let lambda = context["strength"].as_f64().expect("strength").powi(2);
                    Tri {
                        v: *v,
                        grad,
                        area,
                        k2: [lambda; 2],
                        part: None,
                        index: 0,
                    }
                })
                .collect(),
            None => Vec::new(),
        };
        let ids = if kept.is_some() {
            indices(&context["vertices"])
        } else {
            Vec::new()
        };
        // Unknowns.
        let mut unknown: Vec<Option<usize>> = vec![None; n];
        let mut count = 0;
        for v in 0..n {
            if holder[v].is_none() && owner[v].is_none() {
                unknown[v] = Some(count);
                count += 1;
            }
        }
        for whole in wholes.iter().filter(|w| w.is_free) {
            whole
                .vertices
                .iter()
                .for_each(|v| unknown[*v] = Some(count));
            count += 1;
        }
        let held_somewhere = holder.iter().any(Option::is_some);
        let factor = |m: usize| {
            let mut a = vec![vec![0.0; count]; count];
            for tri in tris.iter().chain(&sheet) {
                for i in 0..3 {
                    for j in 0..3 {
                        if let (Some(r), Some(c)) = (unknown[tri.v[i]], unknown[tri.v[j]]) {
                            a[r][c] += tri.k2[m] * tri.area * dot(tri.grad[i], tri.grad[j]);
                        }
                    }
                }
            }
            if !held_somewhere {
                // Nothing is held: one unknown is, and the whole is shifted afterwards.
                a[0][0] += 1.0;
            }
            Dense::new(a)
        };
        let factors = [factor(0), factor(1)];
        let mut z: Vec<P> = tris
            .iter()
            .map(|tri| polar(mean(tri.index)[1].exp(), mean(tri.index)[0]))
            .collect();
        let scales: Vec<f64> = tris.iter().map(|tri| mean(tri.index)[1].exp()).collect();
        let base_rows: Vec<[P; 2]> = tris.iter().map(|tri| jacobian(tri, base)).collect();
        let place = |f: &mut Vec<P>, w: &Whole| {
            for v in &w.vertices {
                f[*v] = add(
                    w.place,
                    mul(polar(w.scale, w.angle), sub(base[*v], w.pivot)),
                );
            }
        };
        wholes.iter().for_each(|w| place(&mut f, w));
        let part_turn = |p: usize, wholes: &[Whole]| {
            let held = wholes
                .iter()
                .find(|w| w.part == Some(p) || w.grip.is_some() && owner[w.vertices[0]] == Some(p));
            held.map_or_else(|| given[p].expect("a turn"), |w| polar(w.scale, w.angle))
        };
        let g_of = |a: P, kept: &[P]| -> Vec<P> {
            let mut g = vec![[0.0; 2]; n];
            ids.iter().zip(kept).for_each(|(v, p)| g[*v] = mul(a, *p));
            g
        };
        let mut a = [1.0, 0.0];
        for round in 0..60_000 {
            if round > 0 {
                for (i, tri) in tris
                    .iter()
                    .enumerate()
                    .filter(|(_, tri)| tri.part.is_none())
                {
                    let j = jacobian(tri, &f);
                    let angle = least_angle(|t| {
                        tri_energy(tri, j, turned(polar(scales[i], t), base_rows[i]))
                    });
                    z[i] = polar(scales[i], angle);
                }
                for _ in 0..4 {
                    for i in 0..wholes.len() {
                        let touched: Vec<usize> = (0..tris.len())
                            .filter(|k| {
                                let tri = &tris[*k];
                                tri.v.iter().any(|v| wholes[i].vertices.contains(v))
                                    || tri.part.is_some()
                            })
                            .collect();
                        let g = kept.as_ref().map(|kept| g_of(a, kept));
                        let energy = |t: f64| {
                            let mut moved = f.clone();
                            let of = Whole {
                                vertices: wholes[i].vertices.clone(),
                                angle: t,
                                grip: wholes[i].grip,
                                ..wholes[i]
                            };
                            place(&mut moved, &of);
                            let mut sum = 0.0;
                            for k in &touched {
                                let tri = &tris[*k];
                                let own = tri.part.filter(|p| {
                                    wholes[i].part == Some(*p)
                                        || wholes[i].grip.is_some()
                                            && owner[wholes[i].vertices[0]] == Some(*p)
                                });
                                let turn = match (tri.part, own) {
                                    (_, Some(_)) => polar(of.scale, t),
                                    (Some(p), None) => part_turn(p, &wholes),
                                    (None, None) => z[*k],
                                };
                                sum += tri_energy(
                                    tri,
                                    jacobian(tri, &moved),
                                    turned(turn, base_rows[*k]),
                                );
                            }
                            for tri in &sheet {
                                sum += tri_energy(
                                    tri,
                                    jacobian(tri, &moved),
                                    jacobian(tri, g.as_ref().expect("kept")),
                                );
                            }
                            sum
                        };
                        wholes[i].angle = least_angle(energy);
                        let now = &wholes[i];
                        place(&mut f, now);
                    }
                }
            }
            // The solve, with the context's similarity in turn until it is its own answer.
            let before = f.clone();
            for _ in 0..if kept.is_some() { 400 } else { 1 } {
                let g = kept.as_ref().map(|kept| g_of(a, kept));
                for m in 0..2 {
                    let mut side = vec![0.0; count];
                    let mut put = |tri: &Tri, want: [P; 2], f: &[P]| {
                        let lack = sub(want[m], jacobian(tri, f)[m]);
                        for (v, grad) in tri.v.iter().zip(&tri.grad) {
                            if let Some(u) = unknown[*v] {
                                side[u] += tri.k2[m] * tri.area * dot(*grad, lack);
                            }
                        }
                    };
                    for (i, tri) in tris.iter().enumerate() {
                        let turn = tri.part.map_or(z[i], |p| part_turn(p, &wholes));
                        put(tri, turned(turn, base_rows[i]), &f);
                    }
                    for tri in &sheet {
                        put(tri, jacobian(tri, g.as_ref().expect("kept")), &f);
                    }
                    let change = factors[m].solve(side);
                    for (v, u) in unknown.iter().enumerate() {
                        if let Some(u) = u {
                            f[v][m] += change[*u];
                        }
                    }
                    for w in wholes.iter_mut().filter(|w| w.is_free) {
                        w.place[m] += change[unknown[w.vertices[0]].expect("free")];
                    }
                }
                if !held_somewhere {
                    let (mut shift, mut total) = ([0.0; 2], 0.0);
                    for t in &self.triangles {
                        let area = gradients(&self.rest, *t).1;
                        for v in t {
                            shift = add(shift, times(area, sub(base[*v], f[*v])));
                            total += area;
                        }
                    }
                    shift = times(1.0 / total, shift);
                    f.iter_mut().for_each(|p| *p = add(*p, shift));
                    wholes
                        .iter_mut()
                        .for_each(|w| w.place = add(w.place, shift));
                }
                if let Some(kept) = &kept {
                    let next = similarity(kept, &ids.iter().map(|v| f[*v]).collect::<Vec<_>>()).0;
                    let step = sub(next, a);
                    a = next;
                    if dot(step, step).sqrt() < 1e-13 {
                        break;
                    }
                }
            }
            let moved = f
                .iter()
                .zip(&before)
                .map(|(p, q)| dot(sub(*p, *q), sub(*p, *q)).sqrt())
                .fold(0.0, f64::max);
            if !is_found || round > 0 && moved < 1e-9 {
                println!("  reference: {round} rounds");
                return f;
            }
        }
        panic!("the reference does not converge");
    }

    fn spread(
        &self,
        held: &[P],
        holder: &[Option<usize>],
        grips: usize,
        k_of: &dyn Fn(usize) -> Option<P>,
        reach: f64,
    ) -> Vec<P> {
        let n = self.rest.len();
        let kind = self.file["propagation"].as_str().expect("a propagation");
        let mut out = held.to_vec();
        // Shortest ways by Bellman and Ford.
        let mut edges = BTreeSet::new();
        for [a, b, c] in &self.triangles {
            for (p, q) in [(*a, *b), (*b, *c), (*c, *a)] {
                edges.insert((p, q));
                edges.insert((q, p));
            }
        }
        let length = |p: usize, q: usize| {
            dot(
                sub(self.rest[p], self.rest[q]),
                sub(self.rest[p], self.rest[q]),
            )
            .sqrt()
        };
        let ways: Vec<Vec<(f64, usize)>> = (0..grips)
            .map(|j| {
                let start = |v: usize| {
                    if holder[v] == Some(j) {
                        (0.0, v)
                    } else {
                        (f64::INFINITY, v)
                    }
                };
                let mut way: Vec<(f64, usize)> = (0..n).map(start).collect();
                loop {
                    let mut is_changed = false;
                    for (p, q) in &edges {
                        let through = way[*p].0 + length(*p, *q);
                        if through < way[*q].0 {
                            way[*q] = (through, way[*p].1);
                            is_changed = true;
                        }
                    }
                    if !is_changed {
                        return way;
                    }
                }
            })
            .collect();
        let used: Vec<usize> = (0..grips).filter(|j| holder.contains(&Some(*j))).collect();
        let fall = |s: f64| match kind {
            "gaussian" => ((-4.5 * s * s).exp() - (-4.5_f64).exp()) / (1.0 - (-4.5_f64).exp()),
            _ => 1.0 - s,
        };
        let nearest = |v: usize| {
            used.iter()
                .copied()
                .min_by(|a, b| ways[*a][v].0.total_cmp(&ways[*b][v].0))
        };
        if kind == "harmonic" {
            let unknowns: Vec<usize> = (0..n).filter(|v| holder[*v].is_none()).collect();
            if !used.is_empty() {
                let index: BTreeMap<usize, usize> =
                    unknowns.iter().enumerate().map(|(i, v)| (*v, i)).collect();
                let mut a = vec![vec![0.0; unknowns.len()]; unknowns.len()];
                let mut sides = [vec![0.0; unknowns.len()], vec![0.0; unknowns.len()]];
                for (t, v) in self.triangles.iter().enumerate() {
                    let (grad, area) = gradients(&self.rest, *v);
                    let k = k_of(t).unwrap_or([10.0; 2]);
                    let weight = (k[0] * k[0] + k[1] * k[1]) / 2.0 * area;
                    for i in 0..3 {
                        let Some(r) = index.get(&v[i]) else { continue };
                        for j in 0..3 {
                            let entry = weight * dot(grad[i], grad[j]);
                            match index.get(&v[j]) {
                                Some(c) => a[*r][*c] += entry,
                                None => (0..2).for_each(|m| sides[m][*r] -= entry * held[v[j]][m]),
                            }
                        }
                    }
                }
                let dense = Dense::new(a);
                for m in 0..2 {
                    let x = dense.solve(sides[m].clone());
                    unknowns.iter().zip(x).for_each(|(v, x)| out[*v][m] = x);
                }
            }
        } else {
            for v in (0..n).filter(|v| holder[*v].is_none()) {
                let of = |j: usize| held[ways[j][v].1];
                let near = nearest(v).map_or([0.0; 2], of);
                out[v] = near;
                if kind != "nearest" {
                    let (mut sum, mut total) = ([0.0; 2], 0.0);
                    for j in &used {
                        let mut w = 1.0;
                        for i in used.iter().filter(|i| *i != j) {
                            let d = (0..n)
                                .filter(|u| holder[*u] == Some(*i))
                                .map(|u| ways[*j][u].0)
                                .fold(f64::INFINITY, f64::min);
                            let s = (d * d + ways[*j][v].0.powi(2) - ways[*i][v].0.powi(2))
                                / (2.0 * d * d);
                            w *= fall(s.clamp(0.0, 1.0));
                        }
                        sum = add(sum, times(w, of(*j)));
                        total += w;
                    }
                    if total > 0.0 {
                        out[v] = times(1.0 / total, sum);
                    }
                }
            }
        }
        if reach > 0.0 {
            for v in (0..n).filter(|v| holder[*v].is_none()) {
                let part = nearest(v).map_or(f64::INFINITY, |j| ways[j][v].0 / reach);
                let factor = if kind == "nearest" {
                    f64::from(u8::from(part <= 1.0))
                } else {
                    fall(part.min(1.0))
                };
                out[v] = times(factor, out[v]);
            }
        }
        out
    }
}

/// The similarity that brings `from` nearest to `to`, and both means.
pub(crate) fn similarity(from: &[P], to: &[P]) -> (P, P, P) {
    let n = from.len() as f64;
    let mean = |list: &[P]| times(1.0 / n, list.iter().fold([0.0; 2], |sum, p| add(sum, *p)));
    let (mf, mt) = (mean(from), mean(to));
    let (mut product, mut square) = ([0.0; 2], 0.0);
    for (a, b) in from.iter().zip(to) {
        product = add(product, mul(conj(sub(*a, mf)), sub(*b, mt)));
        square += dot(sub(*a, mf), sub(*a, mf));
    }
    (times(1.0 / square, product), mf, mt)
}
