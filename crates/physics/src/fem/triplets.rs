//! Entries of a sparse matrix before they are summed.

use nalgebra::SMatrix;

/// Entries `(row, column, value)` of a sparse matrix; entries at one place add up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triplets {
    /// `(row, column, value)`.
    pub entries: Vec<(usize, usize, f64)>,
}

impl Triplets {
    /// Adds one entry.
    pub fn push(&mut self, row: usize, column: usize, value: f64) {
        self.entries.push((row, column, value));
    }

    /// Adds the entries of a block that are not zero, row by row; its first one stands at `(row, column)`.
    pub fn push_block<const N: usize>(
        &mut self,
        [row, column]: [usize; 2],
        block: &SMatrix<f64, N, N>,
    ) {
        for (i, j) in (0..N * N).map(|k| (k / N, k % N)).filter(|at| block[*at] != 0.0) {
            self.push(row + i, column + j, block[(i, j)]);
        }
    }

    /// Adds `factor row column^T`.
    pub fn push_product(&mut self, factor: f64, row: &[(usize, f64)], column: &[(usize, f64)]) {
        for &(i, along) in row.iter().filter(|_| factor != 0.0) {
            column.iter().for_each(|&(j, across)| self.push(i, j, factor * along * across));
        }
    }

    /// Sums the entries of one place, in their order; then they are in the order of rows, found by counting, and columns.
    pub fn merge(&mut self) {
        let [rows, columns] =
            self.entries.iter().fold([0; 2], |[m, n], own| [m.max(own.0 + 1), n.max(own.1 + 1)]);
        let mut ends = vec![0_usize; rows + 1];
        self.entries.iter().for_each(|entry| ends[entry.0 + 1] += 1);
        (1..ends.len()).for_each(|row| ends[row] += ends[row - 1]);
        let mut next = ends.clone();
        let mut by_row = vec![(0_u32, 0.0); self.entries.len()];
        for &(row, column, value) in &self.entries {
            // A mesh has fewer dofs than 2^32.
            by_row[next[row]] = (column as u32, value);
            next[row] += 1;
        }
        self.entries = Vec::new();
        let of_row = |row: usize| {
            by_row[ends[row]..ends[row + 1]].iter().map(|&(j, value)| (j as usize, value))
        };
        *self = Self::of_rows(columns, (0..rows).map(|row| (row, of_row(row))));
    }

    /// The entries of rows that rise, those of one place summed in their order.
    pub fn of_rows<R: Iterator<Item = (usize, f64)>>(
        columns: usize,
        rows: impl Iterator<Item = (usize, R)>,
    ) -> Self {
        // The sums of a row in a row of all columns, of which those taken are then sorted.
        let (mut sums, mut is_taken) = (vec![0.0; columns], vec![false; columns]);
        let (mut taken, mut entries) = (Vec::new(), Vec::new());
        for (row, own) in rows {
            own.for_each(|(column, value)| {
                if !std::mem::replace(&mut is_taken[column], true) {
                    sums[column] = 0.0;
                    taken.push(column);
                }
                sums[column] += value;
            });
            taken.sort_unstable();
            for column in taken.drain(..) {
                entries.push((row, column, sums[column]));
                is_taken[column] = false;
            }
        }
        entries.shrink_to_fit();
        Self { entries }
    }

    /// `sum weight (A - A_0)`, `A_0` the first matrix: what all have alike leaves nothing.
    pub fn quotient<'a>(sides: &[(f64, &'a Self)]) -> Self {
        let (first, others) = (sides[0].1, &sides[1..]);
        let places = |own: &'a Self| own.entries.iter().map(|entry| (entry.0, entry.1));
        if !others.iter().all(|(_, own)| places(own).eq(places(first))) {
            let all = others.iter().flat_map(|(w, own)| [own.scaled(*w), first.scaled(-w)]);
            return Self { entries: all.flat_map(|own| own.entries).collect() };
        }
        let entries = first.entries.iter().enumerate().map(|(k, &(row, column, value))| {
            let changes = others.iter().map(|(weight, own)| weight * (own.entries[k].2 - value));
            (row, column, changes.sum())
        });
        Self { entries: entries.filter(|own| own.2 != 0.0).collect() }
    }

    /// Multiplies every value.
    pub fn scaled(&self, factor: f64) -> Self {
        let scale = |&(row, column, value): &(usize, usize, f64)| (row, column, factor * value);
        Self { entries: self.entries.iter().map(scale).collect() }
    }

    /// `y = A x` over all entries, `y` of length `rows`.
    pub fn multiply(&self, rows: usize, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; rows];
        self.entries.iter().for_each(|&(row, column, value)| y[row] += value * x[column]);
        y
    }

    /// `b - A x` over all entries, summed in twice the precision.
    pub fn residual(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut left: Vec<[f64; 2]> = b.iter().map(|value| [*value, 0.0]).collect();
        pulp::Arch::new().dispatch(|| {
            for &(row, column, value) in &self.entries {
                let product = -value * x[column];
                let [high, low] = &mut left[row];
                let sum = *high + product;
                let added = sum - *high;
                let lost = (*high - (sum - added)) + (product - added);
                *low += lost + (-value).mul_add(x[column], -product);
                *high = sum;
            }
        });
        left.into_iter().map(|[high, low]| high + low).collect()
    }
}
