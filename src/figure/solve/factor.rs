use glam::DVec2;

use super::order::dissection;

/// No unknown: it is held.
pub(crate) const NONE: u32 = u32::MAX;

/// A symmetric positive matrix while it is put together: entries that are added up.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    n: usize,
    /// Row, column and value, rows not above columns; several of one place are added.
    entries: Vec<(u32, u32, f64)>,
}

impl Matrix {
    /// A matrix of zeros for this many unknowns.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n,
            entries: Vec::new(),
        }
    }

    /// Adds a triangle's products of gradients, times `weight`, to the unknowns of its corners.
    pub(crate) fn add(&mut self, unknowns: [u32; 3], gradients: &[DVec2; 3], weight: f64) {
        for i in 0..3 {
            for j in 0..3 {
                let (row, column) = (unknowns[i], unknowns[j]);
                if row != NONE && column != NONE && row <= column {
                    self.entries
                        .push((row, column, weight * gradients[i].dot(gradients[j])));
                }
            }
        }
    }

    /// Factors it. `places` says where unknowns lie, for their order.
    pub(crate) fn factor(mut self, places: &[Option<DVec2>]) -> Factor {
        // Stable: what is added in one place keeps its order, and so its bits.
        self.entries.sort_by_key(|entry| (entry.0, entry.1));
        self.entries.dedup_by(|next, first| {
            let is_same = (next.0, next.1) == (first.0, first.1);
            if is_same {
                first.2 += next.2;
            }
            is_same
        });
        let mut neighbours = vec![Vec::new(); self.n];
        for (row, column, _) in &self.entries {
            if row != column {
                neighbours[*row as usize].push(*column);
                neighbours[*column as usize].push(*row);
            }
        }
        let order = dissection(places, &neighbours);
        Factor::new(&self, &order)
    }
}

/// L and D of a matrix LDLᵀ, made once and used for many right sides. Unknowns are in the order of elimination.
#[derive(Clone, Debug)]
pub(crate) struct Factor {
    /// Position of each unknown in the order of elimination.
    position: Vec<u32>,
    /// Where columns of L begin; one more than there are.
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    inverse_diagonal: Vec<f64>,
}

impl Factor {
    /// Up-looking: row by row (Davis, *Direct Methods for Sparse Linear Systems*, 2006, section 4.8).
    fn new(matrix: &Matrix, order: &[u32]) -> Self {
        let n = matrix.n;
        let mut position = vec![0_u32; n];
        for (unknown, at) in order.iter().zip(0..) {
            position[*unknown as usize] = at;
        }
        // The columns of the upper half in the new order.
        let mut counts = vec![0_u32; n + 1];
        let placed = |row: u32, column: u32| {
            let (a, b) = (position[row as usize], position[column as usize]);
            (a.min(b), a.max(b))
        };
        for (row, column, _) in &matrix.entries {
            counts[placed(*row, *column).1 as usize + 1] += 1;
        }
        for column in 0..n {
            counts[column + 1] += counts[column];
        }
        let mut next = counts.clone();
        let mut upper = vec![(0_u32, 0.0); matrix.entries.len()];
        for (row, column, value) in &matrix.entries {
            let (row, column) = placed(*row, *column);
            upper[next[column as usize] as usize] = (row, *value);
            next[column as usize] += 1;
        }
        let column = |k: usize| &upper[counts[k] as usize..counts[k + 1] as usize];
        let (parent, lengths) = tree(n, column);
        let mut starts = vec![0_u32; n + 1];
        for k in 0..n {
            starts[k + 1] = starts[k] + lengths[k];
        }
        let mut factor = Self {
            position,
            rows: vec![0; starts[n] as usize],
            values: vec![0.0; starts[n] as usize],
            inverse_diagonal: vec![0.0; n],
            starts,
        };
        factor.fill(n, column, &parent);
        factor
    }

    /// Computes the entries, row after row.
    fn fill<'a>(&mut self, n: usize, column: impl Fn(usize) -> &'a [(u32, f64)], parent: &[u32]) {
        let mut ends: Vec<u32> = self.starts[..n].to_vec();
        let mut row_values = vec![0.0; n];
        let mut seen = vec![NONE; n];
        let (mut pattern, mut path) = (Vec::<u32>::new(), Vec::<u32>::new());
        let mut diagonal = vec![0.0; n];
        for k in 0..n {
            pattern.clear();
            seen[k] = k as u32;
            let mut pivot = 0.0;
            for (row, value) in column(k) {
                if *row as usize == k {
                    pivot += value;
                    continue;
                }
                row_values[*row as usize] += value;
                path.clear();
                let mut at = *row;
                while seen[at as usize] != k as u32 {
                    seen[at as usize] = k as u32;
                    path.push(at);
                    at = parent[at as usize];
                }
                // The pattern is read from its end; children come before their parents there.
                pattern.extend(path.iter().rev());
            }
            let largest = pivot;
            while let Some(i) = pattern.pop() {
                let i = i as usize;
                let value = std::mem::take(&mut row_values[i]);
                let (first, end) = (self.starts[i] as usize, ends[i] as usize);
                for (row, entry) in self.rows[first..end].iter().zip(&self.values[first..end]) {
                    row_values[*row as usize] -= entry * value;
                }
                let entry = value * self.inverse_diagonal[i];
                pivot -= entry * value;
                self.rows[end] = k as u32;
                self.values[end] = entry;
                ends[i] += 1;
            }
            diagonal[k] = pivot;
            // What hangs on nothing is left where it is.
            self.inverse_diagonal[k] = if pivot > 1e-14 * largest {
                1.0 / pivot
            } else {
                0.0
            };
        }
    }

    /// Number of unknowns.
    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Entries of the factor, its diagonal included.
    pub(crate) fn entry_count(&self) -> usize {
        self.values.len() + self.len()
    }

    /// Memory of the factor, bytes.
    pub(crate) fn byte_len(&self) -> usize {
        12 * self.values.len() + 16 * self.len()
    }

    /// Solves for `N` right sides at once; they become the solutions.
    pub(crate) fn solve<const N: usize>(&self, sides: &mut [[f64; N]]) {
        let n = self.len();
        let mut x = vec![[0.0; N]; n];
        for (side, position) in sides.iter().zip(&self.position) {
            x[*position as usize] = *side;
        }
        for k in 0..n {
            let value = x[k];
            for (row, entry) in self.column(k) {
                let below = &mut x[row as usize];
                for i in 0..N {
                    below[i] -= entry * value[i];
                }
            }
        }
        for (value, inverse) in x.iter_mut().zip(&self.inverse_diagonal) {
            for part in value {
                *part *= inverse;
            }
        }
        for k in (0..n).rev() {
            let mut value = x[k];
            for (row, entry) in self.column(k) {
                let below = x[row as usize];
                for i in 0..N {
                    value[i] -= entry * below[i];
                }
            }
            x[k] = value;
        }
        for (side, position) in sides.iter_mut().zip(&self.position) {
            *side = x[*position as usize];
        }
    }

    fn column(&self, k: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        let range = self.starts[k] as usize..self.starts[k + 1] as usize;
        self.rows[range.clone()]
            .iter()
            .copied()
            .zip(self.values[range].iter().copied())
    }
}

/// The elimination tree (each unknown's parent) and the number of entries in each column of L.
fn tree<'a>(n: usize, column: impl Fn(usize) -> &'a [(u32, f64)]) -> (Vec<u32>, Vec<u32>) {
    let mut parent = vec![NONE; n];
    let mut seen = vec![NONE; n];
    let mut lengths = vec![0_u32; n];
    for k in 0..n {
        seen[k] = k as u32;
        for (row, _) in column(k) {
            let mut at = *row as usize;
            while seen[at] != k as u32 {
                if parent[at] == NONE {
                    parent[at] = k as u32;
                }
                lengths[at] += 1;
                seen[at] = k as u32;
                at = parent[at] as usize;
            }
        }
    }
    (parent, lengths)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of `side` × `side` points in triangles of equal legs; the first point is held.
    fn square(side: usize) -> (Matrix, Vec<Option<DVec2>>) {
        let n = side * side - 1;
        let mut matrix = Matrix::new(n);
        let unknown = |i: usize, j: usize| ((j * side + i) as u32).wrapping_sub(1);
        let lower = [
            DVec2::new(-1.0, 0.0),
            DVec2::new(1.0, -1.0),
            DVec2::new(0.0, 1.0),
        ];
        let upper = [
            DVec2::new(0.0, -1.0),
            DVec2::new(1.0, 0.0),
            DVec2::new(-1.0, 1.0),
        ];
        for j in 0..side - 1 {
            for i in 0..side - 1 {
                matrix.add(
                    [unknown(i, j), unknown(i + 1, j), unknown(i + 1, j + 1)],
                    &lower,
                    0.5,
                );
                matrix.add(
                    [unknown(i, j), unknown(i + 1, j + 1), unknown(i, j + 1)],
                    &upper,
                    0.5,
                );
            }
        }
        let place = |k: usize| Some(DVec2::new(((k + 1) % side) as f64, ((k + 1) / side) as f64));
        (matrix, (0..n).map(place).collect())
    }

    #[test]
    fn solutions_fit_their_right_sides() {
        let (matrix, places) = square(40);
        let entries = matrix.entries.clone();
        let n = matrix.n;
        let wanted: Vec<[f64; 2]> = (0..n)
            .map(|i| [(i as f64).sin(), (i * i % 17) as f64])
            .collect();
        let mut sides = vec![[0.0; 2]; n];
        for (row, column, value) in entries {
            let (row, column) = (row as usize, column as usize);
            for k in 0..2 {
                sides[row][k] += value * wanted[column][k];
                if row != column {
                    sides[column][k] += value * wanted[row][k];
                }
            }
        }
        let factor = matrix.factor(&places);
        factor.solve(&mut sides);
        let error = sides
            .iter()
            .zip(&wanted)
            .flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]])
            .map(f64::abs)
            .fold(0.0, f64::max);
        assert!(error < 1e-9, "{error}");
    }

    #[test]
    fn factors_stay_sparse() {
        let (matrix, places) = square(100);
        let factor = matrix.factor(&places);
        let per_unknown = factor.entry_count() as f64 / factor.len() as f64;
        assert!(per_unknown <= 45.0, "{per_unknown} entries an unknown");
    }
}
