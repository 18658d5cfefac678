//! Systems of linear equations with right sides in space.

use glam::DVec3;

/// A square matrix in parts that make solving cheap: by Gauss, each row scaled by its largest number, the largest pivot
/// of each column taken. Made once per matrix; costs n³/3 products.
#[derive(Debug)]
pub(crate) struct Solver<'a> {
    matrix: &'a [f64],
    /// Factors below the diagonal, the triangle on and above it, by rows.
    parts: Vec<f64>,
    /// Which row of the matrix stands at each row of the parts.
    order: Vec<usize>,
}

impl<'a> Solver<'a> {
    /// The parts of a matrix of `n` rows; `None` if its rows are not independent.
    pub(crate) fn new(matrix: &'a [f64], n: usize) -> Option<Self> {
        let mut parts = matrix.to_vec();
        let mut order: Vec<usize> = (0..n).collect();
        let largest = |row: &[f64]| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let scales: Vec<f64> = matrix.chunks_exact(n).map(largest).collect();
        for column in 0..n {
            let weight = |row: usize| {
                parts[row * n + column].abs() / scales[order[row]].max(f64::MIN_POSITIVE)
            };
            let best = (column..n).max_by(|a, b| weight(*a).total_cmp(&weight(*b)))?;
            let is_pivot = weight(best) > 1e-300;
            if !is_pivot {
                return None;
            }
            if best != column {
                for k in 0..n {
                    parts.swap(best * n + k, column * n + k);
                }
                order.swap(best, column);
            }
            for row in column + 1..n {
                let factor = parts[row * n + column] / parts[column * n + column];
                parts[row * n + column] = factor;
                if factor != 0.0 {
                    for k in column + 1..n {
                        parts[row * n + k] -= factor * parts[column * n + k];
                    }
                }
            }
        }
        Some(Self {
            matrix,
            parts,
            order,
        })
    }

    /// The solution for a right side, refined twice by what it leaves over.
    pub(crate) fn solve(&self, right: &[DVec3]) -> Vec<DVec3> {
        let n = right.len();
        let mut found = self.once(right);
        for _ in 0..2 {
            let rows = self.matrix.chunks_exact(n).zip(right);
            let left_over: Vec<DVec3> = rows
                .map(|(row, wanted)| {
                    let products = row.iter().zip(&found).map(|(a, x)| *a * *x);
                    *wanted - products.sum::<DVec3>()
                })
                .collect();
            let more = self.once(&left_over);
            found.iter_mut().zip(more).for_each(|(x, more)| *x += more);
        }
        found
    }

    fn once(&self, right: &[DVec3]) -> Vec<DVec3> {
        let n = right.len();
        let mut x: Vec<DVec3> = self.order.iter().map(|row| right[*row]).collect();
        for row in 0..n {
            for k in 0..row {
                let known = x[k];
                x[row] -= self.parts[row * n + k] * known;
            }
        }
        for row in (0..n).rev() {
            for k in row + 1..n {
                let known = x[k];
                x[row] -= self.parts[row * n + k] * known;
            }
            x[row] /= self.parts[row * n + row];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_times_its_solution_is_the_right_side() {
        // Rows of very different size, and none of them in the order of its pivot.
        let matrix = [
            0.0, 2.0, 1.0, 1e-9, 3e-9, -1e-9, 4e7, 1e7, 3e7, //
        ];
        let wanted = [DVec3::X, DVec3::new(1e-9, 0.0, 2e-9), DVec3::splat(1e7)];
        let solver = Solver::new(&matrix, 3).expect("independent rows");
        let x = solver.solve(&wanted);
        for (row, wanted) in matrix.chunks_exact(3).zip(wanted) {
            let got: DVec3 = row.iter().zip(&x).map(|(a, x)| *a * *x).sum();
            assert!((got - wanted).length() < 1e-12 * wanted.length(), "{got}");
        }
        let dependent = [1.0, 2.0, 2.0, 4.0];
        assert!(Solver::new(&dependent, 2).is_none());
    }
}
