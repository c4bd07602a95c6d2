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
    /// Approximate minimum degree of the symmetric hull of a pattern, neighbours of alike structure in one front.
    fn of(pattern: &SparsityPattern) -> Result<Self, LinalgError> {
        let n = pattern.dimension();
        let nonzeros = (0..n).flat_map(|j| pattern.column(j).map(move |(_, i)| (i, j)));
        let hull = nonzeros.flat_map(|(i, j)| [(i, j), (j, i)]);
        let hull = SparsityPattern::from_positions(n, hull);
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
        .map_err(|error| LinalgError::Factorization {
            dimension: n,
            reason: format!("{error:?}"),
        })?;
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

impl DeterminantAnalysis {
    /// Analyses a pattern.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn new(pattern: &SparsityPattern) -> Result<Self, LinalgError> {
        let order = Order::of(pattern)?;
        let fronts = order.unknowns.iter().zip(&order.ends);
        let fronts = fronts.map(|(unknowns, &end)| Front {
            width: unknowns.partition_point(|&place| place < end),
            size: unknowns.len(),
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
        let place = |unknown: usize| order.places.as_ref().map_or(unknown, |all| all[unknown]);
        for j in 0..pattern.dimension() {
            for (at, i) in pattern.column(j) {
                let (row, column) = (place(i), place(j));
                let front = order.front_of(row.min(column));
                let [row, column] = [row, column].map(|own| order.place_in(front, own));
                let own = [at, row, column].map(|index| index as u32);
                fronts[front].entries.push(own);
            }
        }
        Ok(Self { dimension: pattern.dimension(), fronts })
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
        factor::lu_in_place_scratch::<usize, c64>(width, width, Par::Seq, Default::default())
            .or(faer::perm::permute_rows_in_place_scratch::<usize, c64>(width, right.ncols()));
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
    matmul(rest, Accum::Add, below.as_ref(), right.as_ref(), minus, Par::Seq);
    sum
}

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
