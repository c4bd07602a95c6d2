//! Entries of a sparse matrix before they are summed.

use nalgebra::SMatrix;
use std::collections::BTreeMap;

/// `factor row column^T`.
pub type Product<'a> = (f64, &'a [(usize, f64)], &'a [(usize, f64)]);

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
            for &(j, across) in column {
                self.push(i, j, factor * along * across);
            }
        }
    }

    /// Sums the entries of one place, in their order; then they are in the order of rows and columns.
    pub fn merge(&mut self) {
        // Rows by counting; in each the sums of its columns in a row of all columns, of which those taken are then sorted.
        let [rows, columns] =
            self.entries.iter().fold([0; 2], |[m, n], own| [m.max(own.0 + 1), n.max(own.1 + 1)]);
        let mut ends = vec![0_usize; rows + 1];
        self.entries.iter().for_each(|entry| ends[entry.0 + 1] += 1);
        for row in 1..ends.len() {
            ends[row] += ends[row - 1];
        }
        let mut next = ends.clone();
        let mut by_row = vec![(0_u32, 0.0); self.entries.len()];
        for &(row, column, value) in &self.entries {
            // A mesh has fewer dofs than 2^32.
            by_row[next[row]] = (column as u32, value);
            next[row] += 1;
        }
        self.entries.clear();
        let mut sum = RowSum::new(columns);
        for row in 0..rows {
            let own = by_row[ends[row]..ends[row + 1]].iter();
            own.for_each(|&(column, value)| sum.add(column as usize, value));
            sum.move_to(row, &mut self.entries);
        }
        self.entries.shrink_to_fit();
    }

    /// The sum of products, merged.
    pub fn of_products(products: &[Product<'_>]) -> Self {
        let mut by_row: BTreeMap<usize, Vec<(f64, &[(usize, f64)])>> = BTreeMap::new();
        let mut columns = 0;
        for &(factor, row, column) in products.iter().filter(|own| own.0 != 0.0) {
            columns = column.iter().fold(columns, |m, own| m.max(own.0 + 1));
            row.iter().for_each(|&(i, along)| {
                by_row.entry(i).or_default().push((factor * along, column));
            });
        }
        let (mut sum, mut entries) = (RowSum::new(columns), Vec::new());
        for (row, own) in by_row {
            for (factor, column) in own {
                column.iter().for_each(|&(j, across)| sum.add(j, factor * across));
            }
            sum.move_to(row, &mut entries);
        }
        Self { entries }
    }

    /// Multiplies every value.
    pub fn scaled(&self, factor: f64) -> Self {
        let scale = |&(row, column, value): &(usize, usize, f64)| (row, column, factor * value);
        Self { entries: self.entries.iter().map(scale).collect() }
    }

    /// `y = A x` over all entries, `y` of length `rows`.
    pub fn multiply(&self, rows: usize, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; rows];
        for &(row, column, value) in &self.entries {
            y[row] += value * x[column];
        }
        y
    }

    /// `b - A x` over all entries, summed in twice the precision.
    pub fn residual(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut left: Vec<[f64; 2]> = b.iter().map(|value| [*value, 0.0]).collect();
        for &(row, column, value) in &self.entries {
            let product = -value * x[column];
            let [high, low] = &mut left[row];
            let sum = *high + product;
            let added = sum - *high;
            let lost = (*high - (sum - added)) + (product - added);
            *low += lost + (-value).mul_add(x[column], -product);
            *high = sum;
        }
        left.into_iter().map(|[high, low]| high + low).collect()
    }
}

/// The sums of one row in a row of all columns, of which those taken are known.
struct RowSum {
    sums: Vec<f64>,
    is_taken: Vec<bool>,
    taken: Vec<u32>,
}

impl RowSum {
    fn new(columns: usize) -> Self {
        Self { sums: vec![0.0; columns], is_taken: vec![false; columns], taken: Vec::new() }
    }

    #[inline]
    fn add(&mut self, column: usize, value: f64) {
        if self.is_taken[column] {
            self.sums[column] += value;
        } else {
            (self.sums[column], self.is_taken[column]) = (value, true);
            self.taken.push(column as u32);
        }
    }

    /// Appends the row to entries, by rising columns, and begins the next one.
    fn move_to(&mut self, row: usize, entries: &mut Vec<(usize, usize, f64)>) {
        self.taken.sort_unstable();
        for column in self.taken.drain(..).map(|own| own as usize) {
            entries.push((row, column, self.sums[column]));
            self.is_taken[column] = false;
        }
    }
}
