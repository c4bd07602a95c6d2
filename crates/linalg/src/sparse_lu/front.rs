//! Elimination within a front.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::lblt::factor as symmetric;
use faer::linalg::lu::partial_pivoting::factor as general;
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{BlockStructure, matmul as triangular_matmul};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::perm::permute_rows_in_place;
use faer::prelude::ReborrowMut;
use faer::traits::ComplexField;
use faer::traits::math_utils::{abs, imag, real, recip};
use faer::{Accum, Mat, MatMut, MatRef, Par, c64};
use std::f64::consts::PI;

/// Rounding errors by which a symmetric matrix may differ from its transpose.
const ROUNDING_ERRORS: f64 = 16.0;

/// Real or complex numbers.
pub trait Scalar: ComplexField<Real = f64> + Copy {}
impl<T: ComplexField<Real = f64> + Copy> Scalar for T {}

/// What a front leaves to another one, of a symmetric one the lower triangle.
#[derive(Debug)]
pub(super) struct Remainder<T> {
    pub matrix: Mat<T>,
    pub is_symmetric: bool,
}

/// Whether the first `width` rows and columns of a front are alike, but for rounding.
pub(super) fn is_symmetric<T: Scalar>(matrix: MatRef<'_, T>, width: usize) -> bool {
    (0..width).all(|j| {
        let pivot = abs(&matrix[(j, j)]);
        (j + 1..matrix.nrows()).all(|i| {
            let (below, right) = (&matrix[(i, j)], &matrix[(j, i)]);
            abs(&(below - right)) <= ROUNDING_ERRORS * f64::EPSILON * (pivot + abs(below))
        })
    })
}

/// What is kept of a front.
#[derive(Clone, Debug)]
pub(super) struct Eliminated<T> {
    /// `L U`, or `L` below the diagonal, with `below` beneath.
    pub columns: Mat<T>,
    /// `right`; nothing of a symmetric front.
    pub right: Mat<T>,
    /// Rows of `F11` in the order of `P F11`.
    pub exchanges: Vec<usize>,
    /// Of a symmetric front `B^-1`: the diagonal, and what stands beside it.
    inverse: Vec<[T; 2]>,
    /// 1 where the number of exchanges is odd.
    parity: f64,
}

impl<T: Scalar> Eliminated<T> {
    /// Eliminates the first `width` unknowns of a front; what it leaves of the others.
    pub fn of(mut matrix: Mat<T>, width: usize, is_symmetric: bool) -> (Self, Remainder<T>) {
        let own = match is_symmetric {
            true => Self::symmetric(matrix.as_mut(), width),
            false => Self::general(matrix.as_mut(), width),
        };
        let columns = matrix.get(.., ..width).to_owned();
        let matrix = matrix.get(width.., width..).to_owned();
        (Self { columns, ..own }, Remainder { matrix, is_symmetric })
    }

    pub fn is_symmetric(&self) -> bool {
        self.inverse.len() == self.exchanges.len() // Only these have B^-1.
    }

    /// Puts `L`, `below` and the lower triangle of what is left in place.
    fn symmetric(matrix: MatMut<'_, T>, width: usize) -> Self {
        let (mut pivots, _, mut below, mut rest) = matrix.split_at_mut(width, width);
        let (mut exchanges, mut back) = (vec![0_usize; width], vec![0_usize; width]);
        let mut beside = vec![T::zero_impl(); width];
        let scratch =
            symmetric::cholesky_in_place_scratch::<usize, T>(width, Par::Seq, Default::default())
                .or(faer::perm::permute_rows_in_place_scratch::<usize, T>(width, below.nrows()));
        let mut memory = MemBuffer::new(scratch);
        let (_, order) = symmetric::cholesky_in_place(
            pivots.rb_mut(),
            DiagMut::from_slice_mut(&mut beside),
            &mut exchanges,
            &mut back,
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        let inverse = inverse_blocks(pivots.as_ref(), &beside);

        // F21 P^T L^-T is B times what is below.
        let mut across = below.rb_mut().transpose_mut();
        permute_rows_in_place(across.rb_mut(), order, MemStack::new(&mut memory));
        solve_unit_lower_triangular_in_place(pivots.as_ref(), across.rb_mut(), Par::Seq);
        let right = across.to_owned(); // B below^T.
        divide(&inverse, across);
        triangular_matmul(
            rest.rb_mut(),
            BlockStructure::TriangularLower,
            Accum::Add,
            below.as_ref(),
            BlockStructure::Rectangular,
            right.as_ref(),
            BlockStructure::Rectangular,
            -T::one_impl(), // F22 - below right.
            Par::Seq,
        );
        let [columns, right] = [(); 2].map(|()| Mat::zeros(0, 0));
        Self { columns, right, exchanges, inverse, parity: 0.0 }
    }

    /// Puts `L U`, `below` and what is left in place.
    fn general(matrix: MatMut<'_, T>, width: usize) -> Self {
        let (mut pivots, mut right, mut below, mut rest) = matrix.split_at_mut(width, width);
        let (mut exchanges, mut back) = (vec![0_usize; width], vec![0_usize; width]);
        let scratch =
            general::lu_in_place_scratch::<usize, T>(width, width, Par::Seq, Default::default())
                .or(faer::perm::permute_rows_in_place_scratch::<usize, T>(width, right.ncols()));
        let mut memory = MemBuffer::new(scratch);
        let (info, rows) = general::lu_in_place(
            pivots.rb_mut(),
            &mut exchanges,
            &mut back,
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        let parity = (info.transposition_count % 2) as f64;
        let pivots = pivots.as_ref();
        permute_rows_in_place(right.rb_mut(), rows, MemStack::new(&mut memory));
        solve_unit_lower_triangular_in_place(pivots, right.rb_mut(), Par::Seq); // right = L^-1 P F12.
        let across = below.rb_mut().transpose_mut();
        solve_lower_triangular_in_place(pivots.transpose(), across, Par::Seq); // below = F21 U^-1.
        let (minus, below, right) = (-T::one_impl(), below.as_ref(), right.as_ref());
        matmul(rest.rb_mut(), Accum::Add, below, right, minus, Par::Seq);
        let right = right.to_owned();
        Self { columns: Mat::zeros(0, 0), right, exchanges, inverse: Vec::new(), parity }
    }

    /// `B^-1 y` in place, of a symmetric front.
    pub fn divide(&self, y: MatMut<'_, T>) {
        divide(&self.inverse, y);
    }

    /// Largest entry of `U`; of a symmetric front 0, as nothing grows there.
    pub fn largest(&self) -> f64 {
        let (mut largest, pivots) = (0.0_f64, self.columns.get(..self.right.nrows(), ..));
        for own in pivots.col_iter().chain(self.right.col_iter()) {
            // The library's norm takes the root of each entry, which is more than the elimination costs.
            largest = own.iter().map(T::abs1_impl).fold(largest, f64::max);
        }
        largest
    }

    /// Of the rows and columns eliminated.
    pub fn ln_determinant(&self) -> c64 {
        let ln = |value: &T| c64::new(real(value), imag(value)).ln();
        if self.is_symmetric() {
            return -blocks(&self.inverse).map(|determinant| ln(&determinant)).sum::<c64>(); // det B = 1 / det B^-1.
        }
        let pivots = (0..self.columns.ncols()).map(|i| ln(&self.columns[(i, i)]));
        pivots.sum::<c64>() + c64::new(0.0, PI * self.parity) // An odd number of exchanges turns the sign.
    }

    /// Negative eigenvalues of what is eliminated in a symmetric front: of a block of two rows, a pivot where one is not large enough,
    /// one is negative.
    pub fn negative_count(&self) -> usize {
        blocks(&self.inverse).filter(|determinant| real(determinant) < 0.0).count()
    }
}

/// `B^-1`, by rows, of a matrix of blocks of one or two rows: its diagonal is that of the `pivots`.
fn inverse_blocks<T: Scalar>(pivots: MatRef<'_, T>, beside: &[T]) -> Vec<[T; 2]> {
    let zero = T::zero_impl();
    let mut inverse = Vec::with_capacity(beside.len());
    while inverse.len() < beside.len() {
        let i = inverse.len();
        let (a, b) = (pivots[(i, i)], beside[i]);
        if b == zero {
            inverse.push([recip(&a), zero]);
            continue;
        }
        let d = pivots[(i + 1, i + 1)];
        // 1 / (a d - b^2), by way of b, which is not small beside the others.
        let scale = recip(&(a * recip(&b) * d - b));
        let factor = scale * recip(&b);
        inverse.extend([[d * factor, -scale], [a * factor, zero]]); // [d -b; -b a] / (a d - b^2).
    }
    inverse
}

/// `B^-1 y` in place, row by row.
fn divide<T: Scalar>(inverse: &[[T; 2]], mut y: MatMut<'_, T>) {
    let mut rows = inverse.iter().enumerate();
    while let Some((i, &[own, beside])) = rows.next() {
        let next = (beside != T::zero_impl()).then(|| rows.next()).flatten();
        for j in 0..y.ncols() {
            let first = y[(i, j)];
            y[(i, j)] = own * first;
            if let Some((k, &[other, _])) = next {
                let second = y[(k, j)];
                y[(i, j)] += beside * second;
                y[(k, j)] = beside * first + other * second;
            }
        }
    }
}

/// Determinants of the blocks of a symmetric matrix.
fn blocks<T: Scalar>(rows: &[[T; 2]]) -> impl Iterator<Item = T> {
    let mut rows = rows.iter();
    std::iter::from_fn(move || {
        let &[a, b] = rows.next()?;
        let is_single = b == T::zero_impl();
        Some(if is_single { a } else { a * rows.next()?[0] - b * b }) // a d - b^2.
    })
}
