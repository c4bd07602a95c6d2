//! Products of a sparse matrix with blocks of vectors.

use super::SparsityPattern;
use super::dense::{column, column_mut};
use faer::{Mat, MatRef};

/// Vectors multiplied together; their entries are interleaved so that each nonzero is read once and
/// meets contiguous memory.
const LANES: usize = 8;

/// `sum + value * source`, by value: the lanes stay in vector registers.
#[inline(always)]
fn add_multiple(mut sum: [f64; LANES], value: f64, source: [f64; LANES]) -> [f64; LANES] {
    for lane in 0..LANES {
        sum[lane] += value * source[lane];
    }
    sum
}

impl SparsityPattern {
    /// `A x` for each column of `x`, with `A` given by its nonzero `values`.
    pub fn multiply(&self, values: &[f64], x: MatRef<'_, f64>) -> Mat<f64> {
        self.by_lanes(x, |input, output| {
            // By rows, so that sums stay in registers: scattering by columns waits for its own stores.
            for (index, target) in output.iter_mut().enumerate() {
                let mut sum = [0.0; LANES];
                for &(position, column) in self.row(index) {
                    sum = add_multiple(sum, values[position], input[column]);
                }
                *target = sum;
            }
        })
    }

    /// `A^T x` for each column of `x`, with `A` given by its nonzero `values`.
    pub fn multiply_transpose(&self, values: &[f64], x: MatRef<'_, f64>) -> Mat<f64> {
        self.by_lanes(x, |input, output| {
            for (index, target) in output.iter_mut().enumerate() {
                let mut sum = [0.0; LANES];
                for (position, row) in self.column(index) {
                    sum = add_multiple(sum, values[position], input[row]);
                }
                *target = sum;
            }
        })
    }

    /// Applies `kernel(input, output)` to interleaved groups of columns.
    fn by_lanes(
        &self,
        x: MatRef<'_, f64>,
        kernel: impl Fn(&[[f64; LANES]], &mut [[f64; LANES]]),
    ) -> Mat<f64> {
        let n = self.dimension();
        assert_eq!(x.nrows(), n, "vectors and matrix differ in length");
        let mut y = Mat::zeros(n, x.ncols());
        let (mut input, mut output) = (vec![[0.0; LANES]; n], vec![[0.0; LANES]; n]);
        for first in (0..x.ncols()).step_by(LANES) {
            let width = LANES.min(x.ncols() - first);
            for lane in 0..width {
                for (entry, value) in input.iter_mut().zip(column(x, first + lane)) {
                    entry[lane] = *value;
                }
            }
            kernel(&input, &mut output);
            for lane in 0..width {
                for (value, entry) in column_mut(&mut y, first + lane).iter_mut().zip(&output) {
                    *value = entry[lane];
                }
            }
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use crate::linalg::MatrixPolynomial;
    use crate::linalg::dense::{product, random_columns};
    use faer::Mat;

    #[test]
    fn products_agree_with_the_dense_matrix() {
        let n = 30;
        let dense = random_columns(n, n, 3);
        let mut triplets = Vec::new();
        for i in 0..n {
            for j in 0..n {
                if (i * 7 + j * 3) % 4 == 0 {
                    triplets.push((i, j, dense[(i, j)]));
                }
            }
        }
        let mut a = Mat::<f64>::zeros(n, n);
        triplets.iter().for_each(|&(i, j, v)| a[(i, j)] = v);
        let p = MatrixPolynomial::from_triplets(n, &[triplets]);
        // Eleven columns: one full group and a partial one.
        let x = random_columns(n, 11, 4);
        let values = p.evaluate(0.0);
        let y = p.pattern().multiply(&values, x.as_ref());
        assert!((y - product(a.as_ref(), x.as_ref())).norm_max() < 1e-14);
        let yt = p.pattern().multiply_transpose(&values, x.as_ref());
        assert!((yt - product(a.transpose(), x.as_ref())).norm_max() < 1e-14);
    }
}
