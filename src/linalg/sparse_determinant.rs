//! Determinant of a sparse matrix by elimination front by front, which keeps no factors.

use super::{LinalgError, SparsityPattern, interruption};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::perm::permute_rows_in_place;
use faer::prelude::ReborrowMut;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Accum, Mat, Par, Side, c64};
use std::f64::consts::PI;

/// Growth of the entries, times the rounding error, above which a determinant is not trusted.
const BACKWARD_ERROR_BOUND: f64 = 1e-9;

/// Order of elimination and fronts of every matrix on one pattern, symmetric in structure or not.
#[derive(Clone, Debug)]
pub struct DeterminantAnalysis {
    dimension: usize,
    fronts: Vec<Front>,
}

/// Unknowns that are eliminated together, and those that they leave coupled.
#[derive(Clone, Debug)]
struct Front {
    /// How many are eliminated here.
    width: usize,
    /// How many there are.
    size: usize,
    /// Nonzeros of the matrix: index among them, row and column here.
    entries: Vec<[u32; 3]>,
    /// Fronts whose remainder this one takes up.
    children: Vec<usize>,
    /// Places in the parent of the unknowns that remain.
    places: Vec<usize>,
}

impl DeterminantAnalysis {
    /// Analyses a pattern (approximate minimum degree of its symmetric hull).
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn new(pattern: &SparsityPattern) -> Result<Self, LinalgError> {
        let n = pattern.dimension();
        let failure = |reason: String| LinalgError::Factorization {
            dimension: n,
            reason,
        };
        let nonzeros = || (0..n).flat_map(|j| pattern.column(j).map(move |(at, i)| (at, i, j)));
        let both = nonzeros().flat_map(|(_, i, j)| [(i, j), (j, i)]);
        let hull = SparsityPattern::from_positions(n, both);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(
            hull.symbolic(),
            Side::Upper,
            SymmetricOrdering::Amd,
            parameters,
        )
        .map_err(|error| failure(format!("{error:?}")))?;
        let SymbolicCholeskyRaw::Supernodal(blocks) = symbolic.raw() else {
            unreachable!("the analysis forces supernodes");
        };

        // Unknowns of each front by their place in the order of elimination, rising.
        let ends = blocks.supernode_end();
        let unknowns: Vec<Vec<usize>> = (0..blocks.n_supernodes())
            .map(|s| {
                let mut own: Vec<usize> = (blocks.supernode_begin()[s]..ends[s]).collect();
                let first = own.len();
                own.extend_from_slice(blocks.supernode(s).pattern());
                own[first..].sort_unstable();
                own
            })
            .collect();
        let front_of = |place: usize| ends.partition_point(|&end| end <= place);
        let place_in = |front: usize, place: usize| {
            let found = unknowns[front].binary_search(&place);
            found.map_err(|_| failure("a front lacks an unknown".to_owned()))
        };
        let mut fronts: Vec<Front> = (0..unknowns.len())
            .map(|s| Front {
                width: ends[s] - blocks.supernode_begin()[s],
                size: unknowns[s].len(),
                entries: Vec::new(),
                children: Vec::new(),
                places: Vec::new(),
            })
            .collect();
        for s in 0..fronts.len() {
            let left = &unknowns[s][fronts[s].width..];
            let Some(&next) = left.first() else { continue };
            let parent = front_of(next);
            let places: Result<_, _> = left.iter().map(|&place| place_in(parent, place)).collect();
            fronts[s].places = places?;
            fronts[parent].children.push(s);
        }

        // Each nonzero belongs where the first of its two unknowns is eliminated.
        let order = symbolic.perm().map(|perm| perm.arrays().1);
        let place = |unknown: usize| order.map_or(unknown, |order| order[unknown]);
        for (at, i, j) in nonzeros() {
            let (row, column) = (place(i), place(j));
            let front = front_of(row.min(column));
            let own = [at, place_in(front, row)?, place_in(front, column)?];
            fronts[front].entries.push(own.map(|index| index as u32));
        }
        Ok(Self {
            dimension: n,
            fronts,
        })
    }

    /// `ln det A` of the matrix with nonzero `values` on the pattern analysed, its imaginary part up to multiples of `2 pi`.
    ///
    /// Pivots are chosen within a front: `F11 = P^T L U`, and `F22 - F21 F11^-1 F12` goes to the next one. The determinant is the
    /// product of all pivots with the signs of the exchanges; the order of elimination moves rows and columns alike.
    ///
    /// # Errors
    /// [`LinalgError::Singular`] on a pivot of zero, or where entries grow so much that rounding would tell.
    ///
    /// Source: I. S. Duff and J. K. Reid, The multifrontal solution of unsymmetric sets of linear equations, SIAM J. Sci. Stat.
    /// Comput. 5 (1984).
    pub fn ln_determinant(&self, values: &[c64]) -> Result<c64, LinalgError> {
        interruption::check();
        let mut left: Vec<Option<Mat<c64>>> = vec![None; self.fronts.len()];
        let mut sum = c64::new(0.0, 0.0);
        let (mut largest, given) = (0.0_f64, largest(values.iter()));
        for (k, front) in self.fronts.iter().enumerate() {
            let mut matrix = Mat::<c64>::zeros(front.size, front.size);
            for &[at, row, column] in &front.entries {
                matrix[(row as usize, column as usize)] = values[at as usize];
            }
            for &child in &front.children {
                let places = &self.fronts[child].places;
                let update = left[child].take();
                let update = update.expect("a front comes after those that it takes up");
                for (j, &column) in places.iter().enumerate() {
                    for (i, &row) in places.iter().enumerate() {
                        matrix[(row, column)] += update[(i, j)];
                    }
                }
            }
            sum += eliminate(&mut matrix, front.width);
            let rest = matrix.get(front.width.., front.width..).to_owned();
            largest = largest.max(rest.norm_max());
            left[k] = (!front.places.is_empty()).then_some(rest);
        }
        let backward_error = f64::EPSILON * largest / given;
        let is_sound = sum.re.is_finite() && sum.im.is_finite();
        if self.dimension > 0 && !(is_sound && backward_error <= BACKWARD_ERROR_BOUND) {
            return Err(LinalgError::Singular {
                dimension: self.dimension,
                backward_error,
                bound: BACKWARD_ERROR_BOUND,
            });
        }
        Ok(sum)
    }
}

fn largest<'a>(values: impl Iterator<Item = &'a c64>) -> f64 {
    values.fold(0.0, |m, v| m.max(v.norm()))
}

/// Eliminates the first `width` unknowns of a front in place; the logarithm of the determinant of their block.
fn eliminate(matrix: &mut Mat<c64>, width: usize) -> c64 {
    let (mut pivots, mut right, mut below, rest) = matrix.as_mut().split_at_mut(width, width);
    let (mut forward, mut inverse) = (vec![0_usize; width], vec![0_usize; width]);
    let scratch =
        factor::lu_in_place_scratch::<usize, c64>(width, width, Par::Seq, Default::default()).or(
            faer::perm::permute_rows_in_place_scratch::<usize, c64>(width, right.ncols()),
        );
    let mut memory = MemBuffer::new(scratch);
    let (info, rows) = factor::lu_in_place(
        pivots.rb_mut(),
        &mut forward,
        &mut inverse,
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    );
    let turns = PI * (info.transposition_count % 2) as f64;
    let diagonal = (0..width).map(|i| pivots[(i, i)].ln());
    let sum = diagonal.fold(c64::new(0.0, turns), |sum, ln| sum + ln);

    // F22 - (F21 U^-1) (L^-1 P F12).
    let pivots = pivots.as_ref();
    permute_rows_in_place(right.rb_mut(), rows, MemStack::new(&mut memory));
    solve_unit_lower_triangular_in_place(pivots, right.rb_mut(), Par::Seq);
    solve_lower_triangular_in_place(pivots.transpose(), below.rb_mut().transpose_mut(), Par::Seq);
    let minus = c64::new(-1.0, 0.0);
    matmul(
        rest,
        Accum::Add,
        below.as_ref(),
        right.as_ref(),
        minus,
        Par::Seq,
    );
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::dense::random_columns;
    use std::f64::consts::TAU;

    /// Exact: the determinant of a matrix without symmetry, in structure or in values, is that of dense elimination.
    #[test]
    fn determinants_are_those_of_dense_elimination() {
        for n in [1, 2, 37, 150] {
            let random = random_columns(n, 6, 7);
            let far = |i: usize, j: usize| ((random[(i, j)].abs() * 1e4) as usize * 7 + i) % n;
            let off = (0..n).flat_map(|i| [(i, far(i, 0)), (far(i, 1), i), (i, (i + 1) % n)]);
            let all = off.chain((0..n).map(|i| (i, i)));
            let pattern = SparsityPattern::from_positions(n, all);
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
            let analysis = DeterminantAnalysis::new(&pattern).unwrap();
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
        let analysis = DeterminantAnalysis::new(&pattern).unwrap();
        let one = c64::new(1.0, 0.0);
        assert!(analysis.ln_determinant(&[one; 4]).is_err());
    }
}
