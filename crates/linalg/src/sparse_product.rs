//! Products of a sparse matrix with blocks of vectors.

use super::SparsityPattern;
use super::dense::{column, column_mut};
use faer::{Mat, MatRef};
use std::cell::Cell;

/// Vectors multiplied together; their entries are interleaved so that each nonzero is read once and
/// meets contiguous memory.
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
    #[inline]
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
        self.by_lanes(x, |input, index| {
            let places = self.row_range(index);
            let nonzeros = places.map(|place| (place, self.row_columns()[place] as usize));
            lane_sums(values, input, nonzeros)
        })
    }

    /// `A^T x` for each column of `x` and each of several matrices, given by their nonzeros in the order of the pattern.
    #[inline]
    pub fn multiply_transpose_each<const N: usize>(
        &self,
        values: [&[f64]; N],
        x: MatRef<'_, f64>,
    ) -> [Mat<f64>; N] {
        self.by_lanes(x, |input, index| lane_sums(values, input, self.column(index)))
    }

    /// `A x + B y` for each pair of columns, with `A` and `B` given by their nonzeros sorted by rows
    /// ([`Self::by_rows`]); for few columns, of which [`Self::multiply`] would interleave empty ones.
    #[inline]
    pub fn multiply_sum(&self, values: [&[f64]; 2], [x, y]: [MatRef<'_, f64>; 2]) -> Mat<f64> {
        let mut image = Mat::zeros(self.dimension(), x.ncols());
        for j in 0..x.ncols() {
            let (x, y) = (column(x, j), column(y, j));
            for (row, value) in column_mut(&mut image, j).iter_mut().enumerate() {
                let places = self.row_range(row);
                let columns = &self.row_columns()[places.clone()];
                let [a, b] = values.map(|values| &values[places.clone()]);
                let pairs = columns.iter().zip(a.iter().zip(b));
                *value = pairs.map(|(&j, (a, b))| a * x[j as usize] + b * y[j as usize]).sum();
            }
        }
        image
    }

    /// `A^T x` for each column of `x`, with `A` given by its nonzero `values`.
    #[inline]
    pub fn multiply_transpose(&self, values: &[f64], x: MatRef<'_, f64>) -> Mat<f64> {
        let [y] = self.multiply_transpose_each([values], x);
        y
    }

    /// Applies `kernel(input, index)`, the entries `index` of the results, to interleaved groups of columns.
    fn by_lanes<const N: usize>(
        &self,
        x: MatRef<'_, f64>,
        kernel: impl Fn(&[[f64; LANES]], usize) -> [[f64; LANES]; N],
    ) -> [Mat<f64>; N] {
        let n = self.dimension();
        assert_eq!(x.nrows(), n, "vectors and matrix differ in length");
        let mut results = [(); N].map(|()| Mat::zeros(n, x.ncols()));
        let mut input = INTERLEAVED.take();
        input.clear();
        input.resize(n, [0.0; LANES]);
        let mut strips = [[[0.0; LANES]; STRIP]; N];
        for first in (0..x.ncols()).step_by(LANES) {
            let width = LANES.min(x.ncols() - first);
            for lane in 0..width {
                for (entry, value) in input.iter_mut().zip(column(x, first + lane)) {
                    entry[lane] = *value;
                }
            }
            for start in (0..n).step_by(STRIP) {
                let rows = start..n.min(start + STRIP);
                for index in rows.clone() {
                    let sums = kernel(&input, index);
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
        INTERLEAVED.set(input);
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
