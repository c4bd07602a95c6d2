//! Entries of a sparse matrix before they are summed.

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

    /// Multiplies every value.
    pub fn scaled(&self, factor: f64) -> Self {
        let scale = |&(row, column, value): &(usize, usize, f64)| (row, column, factor * value);
        Self {
            entries: self.entries.iter().map(scale).collect(),
        }
    }

    /// `y = A x` over all entries, `y` of length `rows`.
    pub fn multiply(&self, rows: usize, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; rows];
        for &(row, column, value) in &self.entries {
            y[row] += value * x[column];
        }
        y
    }
}
