//! Sparse symmetric factorization `A = P^T L D L^T P` and the inertia it shows.

use super::dense::{column_blocks, trial_right_side};
use super::{LinalgError, SparsityPattern, interruption};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, supernodal};
use faer::{Conj, Mat, MatMut, Par, Side};
use std::mem::{MaybeUninit, take};
use std::sync::{Arc, Mutex};

/// Right-hand sides solved together, at most: a single one costs as much as five of many.
const BLOCK: usize = 32;

/// Fill-reducing ordering and structure of the symmetric factors of every matrix on one pattern.
#[derive(Clone, Debug)]
pub struct LdlAnalysis {
    pattern: Arc<SparsityPattern>,
    symbolic: Arc<SymbolicCholesky<usize>>,
}

impl LdlAnalysis {
    /// Analyses a pattern; only its upper triangle counts.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn new(pattern: &Arc<SparsityPattern>) -> Result<Self, LinalgError> {
        Ok(Self { pattern: Arc::clone(pattern), symbolic: pattern.symbolic_cholesky()? })
    }

    /// Entries of the factors.
    pub fn entry_count(&self) -> usize {
        self.symbolic.len_val()
    }
}

/// Factors of a symmetric matrix, definite or not.
///
/// There is no pivoting: a matrix whose leading minors come close to zero in the fill-reducing order loses accuracy, which the trial solve
/// of [`SparseLdl::factorize`] detects. A shift moved a little is then the remedy.
#[derive(Debug)]
pub struct SparseLdl {
    analysis: LdlAnalysis,
    factors: Vec<f64>,
    /// Working memory of the last solution: fresh memory would cost a tenth of the next one.
    scratch: Mutex<Vec<MaybeUninit<u8>>>,
}

impl SparseLdl {
    /// Factorizes the symmetric matrix whose upper triangle has nonzero `values` on the pattern.
    ///
    /// # Errors
    /// On a zero pivot, or if the factors fail a trial solve.
    pub fn factorize(analysis: &LdlAnalysis, values: &[f64]) -> Result<Self, LinalgError> {
        interruption::check();
        let symbolic = &analysis.symbolic;
        let mut factors = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        symbolic
            .factorize_numeric_ldlt(
                &mut factors,
                analysis.pattern.matrix(values),
                Side::Upper,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            )
            .map_err(|error| LinalgError::factorization(symbolic.nrows(), error))?;
        let factored = Self { analysis: analysis.clone(), factors, scratch: Mutex::default() };
        factored.check(values)?;
        Ok(factored)
    }

    /// Number of negative eigenvalues (Sylvester's law of inertia: the signs of `D`).
    pub fn negative_count(&self) -> usize {
        let symbolic = match self.analysis.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => symbolic,
            // A matrix without fill: `D` is the first entry of each column.
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                let columns = symbolic.col_ptr()[..symbolic.ncols()].iter();
                return columns.filter(|&&first| self.factors[first] < 0.0).count();
            }
        };
        let factors = supernodal::SupernodalLdltRef::new(symbolic, &self.factors);
        (0..symbolic.n_supernodes())
            .map(|s| {
                let width = symbolic.supernode_end()[s] - symbolic.supernode_begin()[s];
                let block = factors.supernode(s).val();
                (0..width).filter(|&j| block[(j, j)] < 0.0).count()
            })
            .sum()
    }

    /// Solves `A x = b` for each column of `right_sides`, in place.
    pub fn solve_in_place(&self, right_sides: MatMut<'_, f64>) {
        let symbolic = &*self.analysis.symbolic;
        let ldl = LdltRef::new(symbolic, &self.factors);
        let count = right_sides.ncols().max(1);
        let width = count.div_ceil(count.div_ceil(BLOCK));
        let needed = symbolic.solve_in_place_scratch::<f64>(width, Par::Seq);
        // Another thread that solves at the same time finds none.
        let mut memory =
            self.scratch.try_lock().map_or_else(|_| Vec::new(), |mut kept| take(&mut kept));
        let length = needed.unaligned_bytes_required().max(memory.len());
        memory.resize(length, MaybeUninit::uninit());
        for block in column_blocks(right_sides, width) {
            ldl.solve_in_place_with_conj(Conj::No, block, Par::Seq, MemStack::new(&mut memory));
        }
        if let Ok(mut kept) = self.scratch.try_lock() {
            *kept = memory;
        }
    }

    fn check(&self, values: &[f64]) -> Result<(), LinalgError> {
        let pattern = &self.analysis.pattern;
        let n = pattern.dimension();
        let right_side: Vec<f64> = trial_right_side(n).collect();
        let mut x = Mat::from_fn(n, 1, |i, _| right_side[i]);
        self.solve_in_place(x.as_mut());
        let (mut residual, mut row_sums) = (right_side, vec![0.0; n]);
        for column in 0..n {
            for (position, row) in pattern.column(column) {
                let value = values[position];
                if row > column {
                    continue;
                }
                residual[row] -= value * x[(column, 0)];
                row_sums[row] += value.abs();
                if row < column {
                    residual[column] -= value * x[(row, 0)];
                    row_sums[column] += value.abs();
                }
            }
        }
        let largest = |v: &[f64]| v.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
        let backward_error = largest(&residual) / (largest(&row_sums) * x.norm_max());
        let is_finite = residual.iter().all(|r| r.is_finite());
        let backward_error = if is_finite { backward_error } else { f64::NAN };
        LinalgError::check(n, backward_error, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MatrixPolynomial;

    /// Exact: springs to the ground alone, one of which pushes; nothing is coupled.
    #[test]
    fn diagonal_matrices_have_an_inertia_and_solutions() {
        let diagonal = [4.0, -2.0, 8.0, 5.0];
        let triplets = diagonal.iter().enumerate().map(|(i, v)| (i, i, *v));
        let matrix = MatrixPolynomial::from_triplets(4, &[triplets.collect()]);
        let analysis = LdlAnalysis::new(matrix.pattern()).unwrap();
        let ldl = SparseLdl::factorize(&analysis, &matrix.evaluate(0.0)).unwrap();
        assert_eq!(ldl.negative_count(), 1);
        let mut x = Mat::from_fn(4, 1, |i, _| diagonal[i] * (i + 1) as f64);
        ldl.solve_in_place(x.as_mut());
        assert!((0..4).all(|i| (x[(i, 0)] - (i + 1) as f64).abs() < 1e-15));
    }
}
