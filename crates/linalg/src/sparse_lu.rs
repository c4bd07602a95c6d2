//! Sparse LU factors by elimination front by front: one symbolic analysis for all values of a pattern, real or complex.
//!
//! Unknowns of alike neighbours make a front. It is a dense matrix `F` of those that are eliminated
//! in it (1) and those that they leave coupled (2). With the pivots chosen within a front,
//!
//! ```text
//! P F11 = L U,    right = L^-1 P F12,    below = F21 U^-1,    F22 - below right,
//! ```
//!
//! and the last goes to the front that eliminates the first of its unknowns. Source: I. S. Duff and J. K. Reid, The multifrontal solution
//! of unsymmetric sets of linear equations, SIAM J. Sci. Stat. Comput. 5 (1984).

use super::dense::{column, column_blocks, trial_right_side};
use super::{LinalgError, SparsityPattern, interruption};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
    solve_unit_upper_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::perm::permute_rows_in_place;
use faer::prelude::ReborrowMut;
use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;
use faer::traits::ComplexField;
use faer::traits::math_utils::{abs, imag, real};
use faer::{Accum, Mat, MatMut, MatRef, Par, c64};
use std::f64::consts::PI;
use std::sync::Arc;

/// Right-hand sides solved together: enough to stream the factors once for many of them, few enough that a block of them stays in cache.
const BLOCK: usize = 16;

/// Order of elimination and fronts of every matrix on one pattern, symmetric in structure or not.
#[derive(Clone, Debug)]
pub struct LuAnalysis {
    pattern: Arc<SparsityPattern>,
    fronts: Arc<Vec<Front>>,
}

/// Unknowns that are eliminated together, and those that they leave coupled.
#[derive(Clone, Debug)]
struct Front {
    /// Unknowns of the matrix, those that are eliminated here first.
    unknowns: Vec<usize>,
    /// How many are eliminated here.
    width: usize,
    /// Nonzeros of the matrix: index among them, row and column here.
    entries: Vec<[u32; 3]>,
    /// Fronts whose remainder this one takes up.
    children: Vec<usize>,
    /// Places in the parent of the unknowns that remain.
    places: Vec<usize>,
}

/// Which unknowns are eliminated together.
struct Order {
    /// Unknowns of each front by their place in the order of elimination, rising.
    unknowns: Vec<Vec<usize>>,
    /// Place after the last one that each front eliminates.
    ends: Vec<usize>,
    /// Place of each unknown of the matrix; all in their own order without.
    places: Option<Vec<usize>>,
}

impl Order {
    /// That of the Cholesky factors of the symmetric hull of a pattern, neighbours of alike structure in one front.
    fn of(pattern: &SparsityPattern) -> Result<Self, LinalgError> {
        let n = pattern.dimension();
        let nonzeros = (0..n).flat_map(|j| pattern.column(j).map(move |(_, i)| (i, j)));
        let hull = nonzeros.flat_map(|(i, j)| [(i, j), (j, i)]);
        let symbolic = match pattern.is_symmetric() {
            true => pattern.symbolic_cholesky()?,
            false => SparsityPattern::from_positions(n, hull).symbolic_cholesky()?,
        };
        let places = symbolic.perm().map(|perm| perm.arrays().1.to_vec());
        let SymbolicCholeskyRaw::Supernodal(blocks) = symbolic.raw() else {
            // A diagonal matrix, where nothing is to be eliminated.
            return Ok(Self {
                unknowns: (0..n).map(|place| vec![place]).collect(),
                ends: (1..=n).collect(),
                places,
            });
        };
        let (begins, ends) = (blocks.supernode_begin(), blocks.supernode_end());
        let unknowns = (0..blocks.n_supernodes()).map(|s| {
            let mut own: Vec<usize> = (begins[s]..ends[s]).collect();
            own.extend_from_slice(blocks.supernode(s).pattern());
            own.sort_unstable();
            own
        });
        Ok(Self { unknowns: unknowns.collect(), ends: ends.to_vec(), places })
    }

    /// The front that eliminates what has a place.
    fn front_of(&self, place: usize) -> usize {
        self.ends.partition_point(|&end| end <= place)
    }

    fn place_in(&self, front: usize, place: usize) -> usize {
        let found = self.unknowns[front].binary_search(&place);
        found.expect("a front holds all unknowns that those before it leave coupled")
    }
}

impl LuAnalysis {
    /// Analyses a pattern.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn new(pattern: &Arc<SparsityPattern>) -> Result<Self, LinalgError> {
        let order = Order::of(pattern)?;
        let place = |unknown: usize| order.places.as_ref().map_or(unknown, |all| all[unknown]);
        let mut unknown_at = vec![0; pattern.dimension()];
        (0..pattern.dimension()).for_each(|unknown| unknown_at[place(unknown)] = unknown);
        let fronts = order.unknowns.iter().zip(&order.ends);
        let fronts = fronts.map(|(places, &end)| Front {
            unknowns: places.iter().map(|&place| unknown_at[place]).collect(),
            width: places.partition_point(|&place| place < end),
            entries: Vec::new(),
            children: Vec::new(),
            places: Vec::new(),
        });
        let mut fronts: Vec<Front> = fronts.collect();

        // What a front leaves goes to the one that eliminates the first of it.
        for s in 0..fronts.len() {
            let left = &order.unknowns[s][fronts[s].width..];
            let Some(&next) = left.first() else { continue };
            let parent = order.front_of(next);
            let places = left.iter().map(|&place| order.place_in(parent, place));
            fronts[s].places = places.collect();
            fronts[parent].children.push(s);
        }

        // Each nonzero belongs where the first of its two unknowns is eliminated.
        for j in 0..pattern.dimension() {
            for (at, i) in pattern.column(j) {
                let (row, column) = (place(i), place(j));
                let front = order.front_of(row.min(column));
                let [row, column] = [row, column].map(|own| order.place_in(front, own));
                fronts[front].entries.push([at, row, column].map(|index| index as u32));
            }
        }
        Ok(Self { pattern: Arc::clone(pattern), fronts: Arc::new(fronts) })
    }

    /// `ln det A` of the matrix with nonzeros `all` on the pattern analysed, its imaginary part up to multiples of `2 pi`; no factors are
    /// kept. It is the product of all pivots with the signs of the exchanges; the order of elimination moves rows and columns alike.
    ///
    /// # Errors
    /// [`LinalgError::Singular`] on a pivot of zero, or where entries grow so much that rounding would tell.
    pub fn ln_determinant<T: ComplexField<Real = f64>>(
        &self,
        all: &[T],
    ) -> Result<c64, LinalgError> {
        let mut sum = c64::new(0.0, 0.0);
        let growth = self.eliminate(all, |own: Eliminated<T>| {
            let pivots = (0..own.exchanges.len()).map(|i| &own.columns[(i, i)]);
            let diagonal = pivots.map(|pivot| c64::new(real(pivot), imag(pivot)).ln());
            sum = diagonal.fold(sum, |sum, ln| sum + ln) + c64::new(0.0, PI * own.parity);
        });
        let is_regular = sum.re.is_finite() && sum.im.is_finite();
        let condition = if is_regular { 1.0 } else { f64::INFINITY };
        LinalgError::check(self.pattern.dimension(), f64::EPSILON * growth, condition)?;
        Ok(sum)
    }

    /// Eliminates front by front and hands each one on; how much the entries grow.
    fn eliminate<T: ComplexField<Real = f64>>(
        &self,
        values: &[T],
        mut take: impl FnMut(Eliminated<T>),
    ) -> f64 {
        interruption::check();
        let mut left: Vec<Option<Mat<T>>> = vec![None; self.fronts.len()];
        let given = values.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(T::abs1_impl(v)));
        let mut largest = given;
        for (k, front) in self.fronts.iter().enumerate() {
            // The front: entries of the matrix and what its children leave.
            let size = front.unknowns.len();
            let mut matrix = Mat::<T>::zeros(size, size);
            for &[at, row, column] in &front.entries {
                matrix[(row as usize, column as usize)] = values[at as usize].clone();
            }
            for &child in &front.children {
                let places = &self.fronts[child].places;
                let update = left[child].take().expect("a front comes after those it takes up");
                for (j, &column) in places.iter().enumerate() {
                    for (i, &row) in places.iter().enumerate() {
                        matrix[(row, column)] = &matrix[(row, column)] + &update[(i, j)];
                    }
                }
            }
            let (own, rest) = Eliminated::of(matrix, front.width);
            // The library's norm takes the root of each entry, which is more than the elimination costs.
            let entries = rest.col_iter().flat_map(|own| own.iter().map(T::abs1_impl));
            largest = entries.fold(largest, f64::max);
            left[k] = (!front.places.is_empty()).then_some(rest);
            take(own);
        }
        largest / given
    }
}

/// What is kept of a front.
#[derive(Clone, Debug)]
struct Eliminated<T> {
    /// `L U` with `below` beneath.
    columns: Mat<T>,
    /// `right`.
    right: Mat<T>,
    /// Rows of `F11` in the order of `P F11`.
    exchanges: Vec<usize>,
    /// 1 where their number is odd.
    parity: f64,
}

impl<T: ComplexField<Real = f64>> Eliminated<T> {
    /// Eliminates the first `width` unknowns of a front; what it leaves of the others.
    fn of(mut matrix: Mat<T>, width: usize) -> (Self, Mat<T>) {
        let (mut pivots, mut right, mut below, mut rest) =
            matrix.as_mut().split_at_mut(width, width);
        let (mut forward, mut inverse) = (vec![0_usize; width], vec![0_usize; width]);
        let scratch =
            factor::lu_in_place_scratch::<usize, T>(width, width, Par::Seq, Default::default())
                .or(faer::perm::permute_rows_in_place_scratch::<usize, T>(width, right.ncols()));
        let mut memory = MemBuffer::new(scratch);
        let (info, rows) = factor::lu_in_place(
            pivots.rb_mut(),
            &mut forward,
            &mut inverse,
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        let parity = (info.transposition_count % 2) as f64;
        let pivots = pivots.as_ref();
        permute_rows_in_place(right.rb_mut(), rows, MemStack::new(&mut memory));
        solve_unit_lower_triangular_in_place(pivots, right.rb_mut(), Par::Seq);
        let across = below.rb_mut().transpose_mut();
        solve_lower_triangular_in_place(pivots.transpose(), across, Par::Seq);
        let (minus, below, right) = (-T::one_impl(), below.as_ref(), right.as_ref());
        matmul(rest.rb_mut(), Accum::Add, below, right, minus, Par::Seq);
        let (right, rest) = (right.to_owned(), rest.to_owned());
        let columns = matrix.get(.., ..width).to_owned();
        (Self { columns, right, exchanges: forward, parity }, rest)
    }
}

/// Some rows of a block, in memory that serves for one front after the other.
fn gathered<'a, T: Copy>(
    x: &MatMut<'_, T>,
    rows: impl ExactSizeIterator<Item = usize> + Clone,
    memory: &'a mut Vec<T>,
) -> MatMut<'a, T> {
    memory.clear();
    for j in 0..x.ncols() {
        let own = column(x.as_ref(), j);
        memory.extend(rows.clone().map(|row| own[row]));
    }
    MatMut::from_column_major_slice_mut(memory, rows.len(), x.ncols())
}

/// Puts rows of a block in place.
fn scatter<T: Copy>(
    x: &mut MatMut<'_, T>,
    rows: impl Iterator<Item = usize> + Clone,
    own: MatRef<'_, T>,
) {
    for j in 0..own.ncols() {
        rows.clone().zip(column(own, j)).for_each(|(row, value)| x[(row, j)] = *value);
    }
}

/// Takes the product `a y` from rows of a block.
fn subtract<T: ComplexField + Copy>(
    x: &mut MatMut<'_, T>,
    rows: &[usize],
    a: MatRef<'_, T>,
    y: MatRef<'_, T>,
    memory: &mut Vec<T>,
) {
    memory.clear();
    memory.resize(a.nrows() * y.ncols(), T::zero_impl());
    let mut change = MatMut::from_column_major_slice_mut(memory, a.nrows(), y.ncols());
    matmul(change.as_mut(), Accum::Replace, a, y, T::one_impl(), Par::Seq);
    for j in 0..change.ncols() {
        let changes = rows.iter().zip(column(change.as_ref(), j));
        changes.for_each(|(&row, change)| x[(row, j)] -= *change);
    }
}

macro_rules! sparse_lu {
    ($(#[$doc:meta])* $name:ident, $scalar:ty) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name {
            analysis: LuAnalysis,
            fronts: Vec<Eliminated<$scalar>>,
            values: Vec<$scalar>,
        }

        impl $name {
            /// Factorizes the matrix with nonzero `values` on the analysed pattern.
            ///
            /// # Errors
            /// If the factors are not finite or fail a trial solve: singular to working precision.
            pub fn factorize(
                analysis: &LuAnalysis,
                values: Vec<$scalar>,
            ) -> Result<Self, LinalgError> {
                let mut fronts = Vec::with_capacity(analysis.fronts.len());
                analysis.eliminate(&values, |own| fronts.push(own));
                let lu = Self { analysis: analysis.clone(), fronts, values };
                lu.check()?;
                Ok(lu)
            }

            /// Number of unknowns.
            pub fn dimension(&self) -> usize {
                self.analysis.pattern.dimension()
            }

            /// Solves `A x = b` for each column of `right_sides`, in place.
            pub fn solve_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                column_blocks(right_sides, BLOCK).for_each(|block| self.solve_block(block, false));
            }

            /// Solves `A^T x = b` for each column of `right_sides`, in place.
            pub fn solve_transpose_in_place(&self, right_sides: MatMut<'_, $scalar>) {
                column_blocks(right_sides, BLOCK).for_each(|block| self.solve_block(block, true));
            }

            /// Solves `A x = b` with one step of iterative refinement.
            pub fn solve_refined(&self, right_side: &[$scalar]) -> Vec<$scalar> {
                let n = right_side.len();
                let mut x = Mat::from_fn(n, 1, |i, _| right_side[i]);
                self.solve_in_place(x.as_mut());
                let mut r = self.residual(&x, right_side);
                self.solve_in_place(r.as_mut());
                (0..n).map(|i| x[(i, 0)] + r[(i, 0)]).collect()
            }

            /// `y = L^-1 P b`, then `x = U^-1 (y - right x)`; transposed `y = U^-T b`, then `x = P^T L^-T (y - below^T x)`.
            fn solve_block(&self, mut x: MatMut<'_, $scalar>, is_transposed: bool) {
                let [memory, other] = &mut [Vec::new(), Vec::new()];
                for (front, own) in self.analysis.fronts.iter().zip(&self.fronts) {
                    let (eliminated, others) = front.unknowns.split_at(front.width);
                    let (pivots, below) = own.columns.as_ref().split_at_row(front.width);
                    let row = |i: usize| eliminated[if is_transposed { i } else { own.exchanges[i] }];
                    let mut y = gathered(&x, (0..front.width).map(row), memory);
                    let beyond = match is_transposed {
                        true => {
                            solve_lower_triangular_in_place(pivots.transpose(), y.as_mut(), Par::Seq);
                            own.right.transpose()
                        }
                        false => {
                            solve_unit_lower_triangular_in_place(pivots, y.as_mut(), Par::Seq);
                            below
                        }
                    };
                    scatter(&mut x, eliminated.iter().copied(), y.as_ref());
                    subtract(&mut x, others, beyond, y.as_ref(), other);
                }
                for (front, own) in self.analysis.fronts.iter().zip(&self.fronts).rev() {
                    let (eliminated, others) = front.unknowns.split_at(front.width);
                    let (pivots, below) = own.columns.as_ref().split_at_row(front.width);
                    let beyond = if is_transposed { below.transpose() } else { own.right.as_ref() };
                    let known = gathered(&x, others.iter().copied(), memory);
                    subtract(&mut x, eliminated, beyond, known.as_ref(), other);
                    let mut y = gathered(&x, eliminated.iter().copied(), memory);
                    match is_transposed {
                        true => solve_unit_upper_triangular_in_place(pivots.transpose(), y.as_mut(), Par::Seq),
                        false => solve_upper_triangular_in_place(pivots, y.as_mut(), Par::Seq),
                    }
                    let row = |i: usize| eliminated[if is_transposed { own.exchanges[i] } else { i }];
                    scatter(&mut x, (0..front.width).map(row), y.as_ref());
                }
            }

            /// `b - A x`.
            fn residual(&self, x: &Mat<$scalar>, right_side: &[$scalar]) -> Mat<$scalar> {
                let pattern = &self.analysis.pattern;
                let mut r = Mat::from_fn(right_side.len(), 1, |i, _| right_side[i]);
                for column in 0..pattern.dimension() {
                    for (position, row) in pattern.column(column) {
                        r[(row, 0)] -= self.values[position] * x[(column, 0)];
                    }
                }
                r
            }

            /// The factorization itself reports no numerical singularity: a trial solve does.
            fn check(&self) -> Result<(), LinalgError> {
                let n = self.analysis.pattern.dimension();
                let right_side: Vec<$scalar> = trial_right_side(n).map(<$scalar>::from).collect();
                let mut x = Mat::from_fn(n, 1, |i, _| right_side[i]);
                self.solve_in_place(x.as_mut());
                let largest = x.norm_max();
                let scale = self.norm() * largest;
                let backward_error = self.residual(&x, &right_side).norm_max() / scale;
                // A large solution says that the matrix has no inverse in double precision.
                LinalgError::check(n, backward_error, scale / 2.0)
            }

            /// Largest row sum of absolute values.
            fn norm(&self) -> f64 {
                let pattern = &self.analysis.pattern;
                let mut sums = vec![0.0; pattern.dimension()];
                for (&row, value) in pattern.row_indices().iter().zip(&self.values) {
                    sums[row] += abs(value);
                }
                sums.into_iter().fold(0.0, f64::max)
            }
        }
    };
}

sparse_lu!(
    /// LU factors of a real sparse matrix.
    SparseLu,
    f64
);
sparse_lu!(
    /// LU factors of a complex sparse matrix, on the analysis that also serves real ones.
    ComplexSparseLu,
    c64
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::random_columns;
    use std::f64::consts::TAU;

    /// Exact: the determinant of a matrix without symmetry, in structure or in values, is that of dense elimination.
    #[test]
    fn determinants_are_those_of_dense_elimination() {
        for n in [1, 2, 37, 150] {
            let random = random_columns(n, 6, 7);
            let far = |i: usize, j: usize| ((random[(i, j)].abs() * 1e4) as usize * 7 + i) % n;
            let off = (0..n).flat_map(|i| [(i, far(i, 0)), (far(i, 1), i), (i, (i + 1) % n)]);
            let all = off.chain((0..n).map(|i| (i, i)));
            let pattern = Arc::new(SparsityPattern::from_positions(n, all));
            let value = |at: usize| {
                let at = (at % n, at / n);
                c64::new(random[(at.0, 2 + at.1 % 2)], random[(at.0, 4 + at.1 % 2)])
            };
            let values: Vec<c64> = (0..pattern.nonzero_count()).map(value).collect();
            let mut dense = Mat::<c64>::zeros(n, n);
            for column in 0..n {
                for (at, row) in pattern.column(column) {
                    dense[(row, column)] = values[at];
                }
            }
            let exact = dense.determinant();
            let analysis = LuAnalysis::new(&pattern).unwrap();
            let found = analysis.ln_determinant(&values).unwrap();
            assert!((found.re - exact.norm().ln()).abs() < 1e-9, "{n}");
            let turns = (found.im - exact.arg()) / TAU;
            assert!((turns - turns.round()).abs() < 1e-9, "{n} {turns}");
        }
    }

    /// A matrix without inverse has no logarithm.
    #[test]
    fn singular_matrix_is_refused() {
        let pattern = SparsityPattern::from_positions(2, [(0, 0), (0, 1), (1, 0), (1, 1)]);
        let analysis = LuAnalysis::new(&Arc::new(pattern)).unwrap();
        let one = c64::new(1.0, 0.0);
        let refused = analysis.ln_determinant(&[one; 4]).unwrap_err().to_string();
        assert!(
            refused.ends_with("its condition number is at least inf, the bound is 1e15"),
            "{refused}"
        );
    }
}
