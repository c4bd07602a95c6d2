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

    /// Sums the entries of one place, in their order; then they are in the order of rows and columns.
    pub fn merge(&mut self) {
        // Rows by counting, columns within each by sorting.
        let rows = self.entries.iter().map(|entry| entry.0 + 1).max();
        let mut ends = vec![0_usize; rows.unwrap_or(0) + 1];
        self.entries.iter().for_each(|entry| ends[entry.0 + 1] += 1);
        for row in 1..ends.len() {
            ends[row] += ends[row - 1];
        }
        let mut next = ends.clone();
        let mut sorted = vec![(0_u32, 0.0); self.entries.len()];
        for &(row, column, value) in &self.entries {
            // A mesh has fewer dofs than 2^32.
            sorted[next[row]] = (column as u32, value);
            next[row] += 1;
        }
        self.entries.clear();
        for row in 0..ends.len() - 1 {
            let own = &mut sorted[ends[row]..ends[row + 1]];
            own.sort_by_key(|entry| entry.0);
            for same in own.chunk_by(|one, other| one.0 == other.0) {
                let sum = same.iter().map(|entry| entry.1).sum();
                self.entries.push((row, same[0].0 as usize, sum));
            }
        }
        self.entries.shrink_to_fit();
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
}
