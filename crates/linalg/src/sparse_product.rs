//! Products of a sparse matrix with blocks of vectors.

use super::SparsityPattern;
use super::dense::{column, column_mut};
use faer::{Mat, MatRef};
use std::cell::Cell;

/// Vectors multiplied together; their entries are interleaved so that each nonzero is read once and meets contiguous memory.
const LANES: usize = 8;
/// Rows of results that stay in cache until their columns are written.
const STRIP: usize = 128;

thread_local! {
    /// Interleaved vectors, kept from product to product: fresh memory would cost as much as the product itself.
    static INTERLEAVED: Cell<Vec<[f64; LANES]>> = const { Cell::new(Vec::new()) };
}

/// `sum + value * source`, by value: the lanes stay in vector registers.
#[inline(always)]
fn add_multiple(mut sum: [f64; LANES], value: f64, source: [f64; LANES]) -> [f64; LANES] {
    for lane in 0..LANES {
        sum[lane] += value * source[lane];
    }
    sum
}

/// The sums over nonzeros `(place, source)` of each matrix's value there times the lanes of the source.
#[inline(always)]
fn lane_sums<const N: usize>(
    values: [&[f64]; N],
    input: &[[f64; LANES]],
    nonzeros: impl Iterator<Item = (usize, usize)>,
) -> [[f64; LANES]; N] {
    let mut sums = [[0.0; LANES]; N];
    for (place, source) in nonzeros {
        let source = input[source];
        for (sum, values) in sums.iter_mut().zip(&values) {
            *sum = add_multiple(*sum, values[place], source);
        }
    }
    sums
}

impl SparsityPattern {
    /// `A x` for each column of `x`, with `A` given by its nonzero `values`.
    pub fn multiply(&self, values: &[f64], x: MatRef<'_, f64>) -> Mat<f64> {
        let [y] = self.multiply_sorted([&self.by_rows(values)], x);
        y
    }

    /// `A x` for each column of `x` and each of several matrices, given by their nonzeros sorted by rows ([`Self::by_rows`]); indices
    /// are read once for all matrices.
    pub fn multiply_sorted<const N: usize>(
        &self,
        values: [&[f64]; N],
        x: MatRef<'_, f64>,
    ) -> [Mat<f64>; N] {
        // By rows, so that sums stay in registers: scattering by columns waits for its own stores.
        self.by_lanes([x], |[input], index| {
            let places = self.row_range(index);
            let nonzeros = places.map(|place| (place, self.row_columns()[place] as usize));
            lane_sums(values, input, nonzeros)
        })
    }

    /// `A^T x` for each column of `x` and each of several matrices, given by their nonzeros in the order of the pattern.
    pub fn multiply_transpose_each<const N: usize>(
        &self,
        values: [&[f64]; N],
        x: MatRef<'_, f64>,
    ) -> [Mat<f64>; N] {
        self.by_lanes([x], |[input], index| lane_sums(values, input, self.column(index))) // Columns of A are the rows of A^T.
    }

    /// `A x + B y` for each pair of columns, with `A` and `B` given by their nonzeros sorted by rows ([`Self::by_rows`]).
    pub fn multiply_sum(&self, values: [&[f64]; 2], vectors: [MatRef<'_, f64>; 2]) -> Mat<f64> {
        let [sum] = self.by_lanes(vectors, |[x, y], index| {
            let mut sum = [0.0; LANES];
            for place in self.row_range(index) {
                let source = self.row_columns()[place] as usize;
                sum = add_multiple(sum, values[0][place], x[source]);
                sum = add_multiple(sum, values[1][place], y[source]);
            }
            [sum]
        });
        sum
    }

    /// `A^T x` for each column of `x`, with `A` given by its nonzero `values`.
    pub fn multiply_transpose(&self, values: &[f64], x: MatRef<'_, f64>) -> Mat<f64> {
        let [y] = self.multiply_transpose_each([values], x);
        y
    }

    /// Applies `kernel(inputs, index)`, the entries `index` of the results, to interleaved groups of columns of one or several blocks.
    fn by_lanes<const M: usize, const N: usize>(
        &self,
        blocks: [MatRef<'_, f64>; M],
        kernel: impl Fn([&[[f64; LANES]]; M], usize) -> [[f64; LANES]; N],
    ) -> [Mat<f64>; N] {
        let (n, columns) = (self.dimension(), blocks[0].ncols());
        assert!(blocks.iter().all(|x| x.nrows() == n), "vectors and matrix differ in length");
        let mut results = [(); N].map(|()| Mat::zeros(n, columns));
        let mut inputs = INTERLEAVED.take();
        inputs.clear();
        inputs.resize(M * n, [0.0; LANES]);
        let mut strips = [[[0.0; LANES]; STRIP]; N];
        for first in (0..columns).step_by(LANES) {
            let width = LANES.min(columns - first); // Interleave the entries of so many vectors.
            for (x, input) in blocks.iter().zip(inputs.chunks_exact_mut(n.max(1))) {
                for lane in 0..width {
                    for (entry, value) in input.iter_mut().zip(column(*x, first + lane)) {
                        entry[lane] = *value;
                    }
                }
            }
            let own: [&[[f64; LANES]]; M] = std::array::from_fn(|m| &inputs[m * n..(m + 1) * n]);
            for start in (0..n).step_by(STRIP) {
                let rows = start..n.min(start + STRIP); // A strip of rows of the results, then their columns from it.
                for index in rows.clone() {
                    let sums = kernel(own, index);
                    for (strip, sum) in strips.iter_mut().zip(sums) {
                        strip[index - start] = sum;
                    }
                }
                for (result, strip) in results.iter_mut().zip(&strips) {
                    for lane in 0..width {
                        let target = &mut column_mut(result, first + lane)[rows.clone()];
                        for (value, entry) in target.iter_mut().zip(strip) {
                            *value = entry[lane];
                        }
                    }
                }
            }
        }
        INTERLEAVED.set(inputs); // For the next product.
        results
    }
}

#[cfg(test)]
mod tests {
    use crate::MatrixPolynomial;
    use crate::dense::{product, random_columns};
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
        let halves: Vec<f64> = values.iter().map(|v| 0.5 * v).collect();
        let twice = [x.as_ref(), x.as_ref()];
        let sorted = p.pattern().by_rows(&halves);
        let sum = p.pattern().multiply_sum([&sorted, &sorted], twice);
        assert!((sum - product(a.as_ref(), x.as_ref())).norm_max() < 1e-14);
        let yt = p.pattern().multiply_transpose(&values, x.as_ref());
        assert!((yt - product(a.transpose(), x.as_ref())).norm_max() < 1e-14);
    }
}
