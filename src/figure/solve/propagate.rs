use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::element::Element;
use super::factor::{Factor, Matrix, NONE};
use super::hold::Holding;
use super::rigid::{Parts, Stiffness};
use crate::document::figure::{Propagation, Rigidity};
use crate::figure::mesh::Mesh;

/// How turns and log scales spread from handles over the mesh. It depends on what handles hold; built once for that.
#[derive(Clone, Debug)]
pub(crate) struct Spread {
    propagation: Propagation,
    reach: f64,
    /// Per grip how far its vertices are; only if something asks for distances.
    distances: Vec<Distances>,
    /// Between two grips, `[j][i]`: the smallest distance to j on what i holds.
    between: Vec<Vec<f64>>,
    harmonic: Option<Harmonic>,
}

/// The shortest ways along edges from what a grip holds.
#[derive(Clone, Debug)]
struct Distances {
    /// Per vertex the length; infinite where no way leads.
    length: Vec<f64>,
    /// Per vertex the held vertex at which the way begins.
    from: Vec<u32>,
}

/// What the harmonic propagation solves.
#[derive(Clone, Debug)]
struct Harmonic {
    unknown_of: Vec<u32>,
    factor: Factor,
    /// Square of the rigidity times the area, per triangle.
    weights: Vec<f64>,
}

impl Spread {
    pub(crate) fn new(
        mesh: &Mesh,
        elements: &[Element],
        parts: &Parts,
        holding: &Holding,
        propagation: Propagation,
        reach: f64,
    ) -> Self {
        let mut distances = Vec::new();
        let mut between = Vec::new();
        if propagation != Propagation::Harmonic || reach > 0.0 {
            let edges = edges(mesh);
            let held = holding.held();
            distances = held
                .iter()
                .map(|vertices| Distances::new(mesh, &edges, vertices))
                .collect();
            let least = |of: &Distances, on: &[u32]| {
                on.iter()
                    .map(|v| of.length[*v as usize])
                    .fold(f64::INFINITY, f64::min)
            };
            between = distances
                .iter()
                .map(|of| held.iter().map(|on| least(of, on)).collect())
                .collect();
        }
        let harmonic = (propagation == Propagation::Harmonic)
            .then(|| Harmonic::new(mesh, elements, parts, holding));
        Self {
            propagation,
            reach,
            distances,
            between,
            harmonic,
        }
    }

    /// The factor of the harmonic propagation.
    pub(crate) fn factor(&self) -> Option<&Factor> {
        self.harmonic.as_ref().map(|harmonic| &harmonic.factor)
    }

    /// Turn and log scale of every vertex; `held` are those of held vertices.
    pub(crate) fn spins(
        &self,
        elements: &[Element],
        holding: &Holding,
        held: &[[f64; 2]],
    ) -> Vec<[f64; 2]> {
        let mut spins = match (&self.harmonic, self.propagation) {
            (Some(harmonic), _) => harmonic.spins(elements, held),
            (None, Propagation::Nearest) => {
                (0..held.len()).map(|v| self.nearest(v, held)).collect()
            }
            _ => (0..held.len()).map(|v| self.blended(v, held)).collect(),
        };
        for (vertex, spin) in spins.iter_mut().enumerate() {
            if holding.holder[vertex] != NONE {
                *spin = held[vertex];
            } else if self.reach > 0.0 {
                let factor = self.fade(vertex);
                *spin = spin.map(|part| part * factor);
            }
        }
        spins
    }

    fn shortest(&self, vertex: usize) -> Option<(usize, f64)> {
        let mut found: Option<(usize, f64)> = None;
        for (j, of) in self.distances.iter().enumerate() {
            let length = of.length[vertex];
            if length.is_finite() && found.is_none_or(|(_, least)| length < least) {
                found = Some((j, length));
            }
        }
        found
    }

    fn of_grip(&self, j: usize, vertex: usize, held: &[[f64; 2]]) -> [f64; 2] {
        held[self.distances[j].from[vertex] as usize]
    }

    fn nearest(&self, vertex: usize, held: &[[f64; 2]]) -> [f64; 2] {
        self.shortest(vertex)
            .map_or([0.0; 2], |(j, _)| self.of_grip(j, vertex, held))
    }

    fn blended(&self, vertex: usize, held: &[[f64; 2]]) -> [f64; 2] {
        let (mut sum, mut total) = ([0.0; 2], 0.0);
        for (j, of) in self.distances.iter().enumerate() {
            if !of.length[vertex].is_finite() {
                continue;
            }
            let mut weight = 1.0;
            for (i, other) in self.distances.iter().enumerate() {
                // Nothing comes of it any more: so it is for most of many handles.
                if weight == 0.0 {
                    break;
                }
                if i != j && other.length[vertex].is_finite() {
                    let (square, own, others) = (
                        sq(self.between[j][i]),
                        sq(of.length[vertex]),
                        sq(other.length[vertex]),
                    );
                    weight *= self.fall(((square + own - others) / (2.0 * square)).clamp(0.0, 1.0));
                }
            }
            let spin = self.of_grip(j, vertex, held);
            sum = [sum[0] + weight * spin[0], sum[1] + weight * spin[1]];
            total += weight;
        }
        if total > 0.0 {
            sum.map(|part| part / total)
        } else {
            self.nearest(vertex, held)
        }
    }

    /// The weight of a handle at `s` of the way to another.
    fn fall(&self, s: f64) -> f64 {
        match self.propagation {
            Propagation::Gaussian => {
                let end = libm::exp(-4.5);
                (libm::exp(-4.5 * s * s) - end) / (1.0 - end)
            }
            Propagation::Harmonic | Propagation::Linear => 1.0 - s,
            Propagation::Nearest => 1.0,
        }
    }

    /// What the reach leaves at a vertex, 0 to 1.
    fn fade(&self, vertex: usize) -> f64 {
        let part = self
            .shortest(vertex)
            .map_or(f64::INFINITY, |(_, length)| length / self.reach);
        match self.propagation {
            Propagation::Nearest => f64::from(u8::from(part <= 1.0)),
            _ => self.fall(part.min(1.0)),
        }
    }
}

impl Harmonic {
    fn new(mesh: &Mesh, elements: &[Element], parts: &Parts, holding: &Holding) -> Self {
        // Sheets in which nothing is held stay as they are.
        let n_sheets = mesh
            .sheet_of
            .iter()
            .max()
            .map_or(0, |last| *last as usize + 1);
        let mut is_held = vec![false; n_sheets];
        for (holder, sheet) in holding.holder.iter().zip(&mesh.sheet_of) {
            is_held[*sheet as usize] |= *holder != NONE;
        }
        let mut places = Vec::new();
        let mut unknown_of = vec![NONE; mesh.vertices.len()];
        for (vertex, unknown) in unknown_of.iter_mut().enumerate() {
            if holding.holder[vertex] == NONE && is_held[mesh.sheet_of[vertex] as usize] {
                *unknown = places.len() as u32;
                places.push(Some(mesh.vertices[vertex]));
            }
        }
        let square = |stiffness: &Stiffness| {
            let [kx, ky] = match stiffness {
                Stiffness::Soft(k) => *k,
                Stiffness::Inside(_) | Stiffness::Border(_) => Rigidity::BONE,
            };
            (kx * kx + ky * ky) / 2.0
        };
        let weights: Vec<f64> = elements
            .iter()
            .zip(&parts.stiffness)
            .map(|(e, s)| square(s) * e.area)
            .collect();
        let mut matrix = Matrix::new(places.len());
        for (element, weight) in elements.iter().zip(&weights) {
            matrix.add(
                element.vertices.map(|v| unknown_of[v as usize]),
                &element.gradients,
                *weight,
            );
        }
        Self {
            unknown_of,
            factor: matrix.factor(&places),
            weights,
        }
    }

    fn spins(&self, elements: &[Element], held: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut sides = vec![[0.0; 2]; self.factor.len()];
        for (element, weight) in elements.iter().zip(&self.weights) {
            let unknowns = element.vertices.map(|v| self.unknown_of[v as usize]);
            if unknowns == [NONE; 3] {
                continue;
            }
            let mut slopes = [DVec2::ZERO; 2];
            for (vertex, gradient) in element.vertices.iter().zip(&element.gradients) {
                let spin = held[*vertex as usize];
                slopes = [
                    slopes[0] + spin[0] * *gradient,
                    slopes[1] + spin[1] * *gradient,
                ];
            }
            for (unknown, gradient) in unknowns.iter().zip(&element.gradients) {
                if *unknown != NONE {
                    let side = &mut sides[*unknown as usize];
                    side[0] -= weight * gradient.dot(slopes[0]);
                    side[1] -= weight * gradient.dot(slopes[1]);
                }
            }
        }
        self.factor.solve(&mut sides);
        let of = |(unknown, held): (&u32, &[f64; 2])| {
            if *unknown == NONE {
                *held
            } else {
                sides[*unknown as usize]
            }
        };
        self.unknown_of.iter().zip(held).map(of).collect()
    }
}

/// The vertices beside each vertex.
fn edges(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut edges = vec![Vec::new(); mesh.vertices.len()];
    for [a, b, c] in &mesh.triangles {
        for (one, other) in [(*a, *b), (*b, *c), (*c, *a)] {
            edges[one as usize].push(other);
            edges[other as usize].push(one);
        }
    }
    for beside in &mut edges {
        beside.sort_unstable();
        beside.dedup();
    }
    edges
}

impl Distances {
    /// Dijkstra's shortest ways from all of these vertices.
    fn new(mesh: &Mesh, edges: &[Vec<u32>], vertices: &[u32]) -> Self {
        let n = mesh.vertices.len();
        let mut found = Self {
            length: vec![f64::INFINITY; n],
            from: vec![0; n],
        };
        // Lengths are not negative, so their bits are in the order of their values.
        let mut queue = BinaryHeap::new();
        for vertex in vertices {
            found.length[*vertex as usize] = 0.0;
            found.from[*vertex as usize] = *vertex;
            queue.push(Reverse((0_u64, *vertex)));
        }
        while let Some(Reverse((bits, vertex))) = queue.pop() {
            let length = f64::from_bits(bits);
            if length > found.length[vertex as usize] {
                continue;
            }
            for next in &edges[vertex as usize] {
                let step = mesh.vertices[vertex as usize].distance(mesh.vertices[*next as usize]);
                let reached = &mut found.length[*next as usize];
                if length + step < *reached {
                    *reached = length + step;
                    found.from[*next as usize] = found.from[vertex as usize];
                    queue.push(Reverse(((length + step).to_bits(), *next)));
                }
            }
        }
        found
    }
}

fn sq(value: f64) -> f64 {
    value * value
}
