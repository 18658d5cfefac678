/// Rounds whose differences are mixed.
const MEMORY: usize = 6;

/// Anderson's mixing of the rounds of a fixed-point iteration (Walker and Ni 2011): the combination of the last rounds
/// whose change would be least, if changes were linear.
#[derive(Clone, Debug, Default)]
pub(crate) struct Anderson {
    /// Change and result of the last round.
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Differences of changes and results between rounds, the oldest first.
    differences: Vec<(Vec<f64>, Vec<f64>)>,
    /// Products of the differences of changes.
    products: Vec<Vec<f64>>,
}

impl Anderson {
    /// Forgets all rounds.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    /// What to begin the next round with, after one that led from `start` to `end`; none after the first.
    pub(crate) fn mixed(&mut self, start: &[f64], end: &[f64]) -> Option<Vec<f64>> {
        let change = difference(end, start);
        if let Some((last_change, last_end)) = self.last.take() {
            self.push(
                difference(&change, &last_change),
                difference(end, &last_end),
            );
        }
        let mixed = (!self.differences.is_empty()).then(|| {
            let sides: Vec<f64> = self
                .differences
                .iter()
                .map(|(of_change, _)| dot(of_change, &change))
                .collect();
            let mut mixed = end.to_vec();
            for (weight, (_, of_end)) in
                solved(&self.products, &sides).iter().zip(&self.differences)
            {
                mixed
                    .iter_mut()
                    .zip(of_end)
                    .for_each(|(value, difference)| *value -= weight * difference);
            }
            mixed
        });
        self.last = Some((change, end.to_vec()));
        mixed
    }

    fn push(&mut self, of_change: Vec<f64>, of_end: Vec<f64>) {
        if self.differences.len() == MEMORY {
            self.differences.remove(0);
            self.products.remove(0);
            for row in &mut self.products {
                row.remove(0);
            }
        }
        let mut row: Vec<f64> = self
            .differences
            .iter()
            .map(|(other, _)| dot(other, &of_change))
            .collect();
        self.products
            .iter_mut()
            .zip(&row)
            .for_each(|(other, product)| other.push(*product));
        row.push(dot(&of_change, &of_change));
        self.products.push(row);
        self.differences.push((of_change, of_end));
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four sums, so that they need not wait for each other.
    let mut sums = [0.0; 4];
    let (chunks_a, chunks_b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = chunks_a
        .remainder()
        .iter()
        .zip(chunks_b.remainder())
        .map(|(a, b)| a * b)
        .sum::<f64>();
    for (a, b) in chunks_a.zip(chunks_b) {
        for i in 0..4 {
            sums[i] += a[i] * b[i];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Solves normal equations by Cholesky's method, the newest difference first; those that depend on newer ones are left
/// out.
fn solved(products: &[Vec<f64>], sides: &[f64]) -> Vec<f64> {
    let n = sides.len();
    let newest = |i: usize| n - 1 - i;
    let mut lower = vec![vec![0.0; n]; n];
    let mut is_used = vec![false; n];
    let mut y = vec![0.0; n];
    for i in 0..n {
        let mut pivot = products[newest(i)][newest(i)];
        for j in (0..i).filter(|j| is_used[*j]) {
            let before: f64 = (0..j)
                .filter(|k| is_used[*k])
                .map(|k| lower[i][k] * lower[j][k])
                .sum();
            lower[i][j] = (products[newest(i)][newest(j)] - before) / lower[j][j];
            pivot -= lower[i][j] * lower[i][j];
        }
        is_used[i] = pivot > 1e-12 * products[newest(i)][newest(i)] && pivot > 0.0;
        if is_used[i] {
            lower[i][i] = pivot.sqrt();
            let before: f64 = (0..i)
                .filter(|k| is_used[*k])
                .map(|k| lower[i][k] * y[k])
                .sum();
            y[i] = (sides[newest(i)] - before) / lower[i][i];
        }
    }
    let mut weights = vec![0.0; n];
    for i in (0..n).rev().filter(|i| is_used[*i]) {
        let after: f64 = (i + 1..n)
            .filter(|k| is_used[*k])
            .map(|k| lower[k][i] * weights[newest(k)])
            .sum();
        weights[newest(i)] = (y[i] - after) / lower[i][i];
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_iteration_ends_after_as_many_rounds_as_it_has_directions() {
        // x → A x + b with A diagonal: plain rounds shrink the slowest direction by 0.99 each.
        let round = |x: &[f64]| vec![0.99 * x[0] + 1.0, 0.5 * x[1] - 2.0, -0.7 * x[2] + 3.0];
        let mut x = vec![0.0; 3];
        let mut anderson = Anderson::default();
        for _ in 0..6 {
            let end = round(&x);
            x = anderson.mixed(&x, &end).unwrap_or(end);
        }
        for (value, wanted) in x.iter().zip([100.0, -4.0, 3.0 / 1.7]) {
            assert!((value - wanted).abs() < 1e-6, "{value} {wanted}");
        }
    }
}
