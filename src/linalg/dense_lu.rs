//! Dense LU factorization with partial pivoting, sequential, for `f64` and `c64`.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::lu::partial_pivoting::solve::{solve_in_place, solve_in_place_scratch};
use faer::{Mat, MatMut, Par, c64};

/// Solves `A x = b` in place of `b`; `false` if the solution is not finite, as for a singular matrix.
pub fn solve(mut a: Mat<f64>, b: &mut [f64]) -> bool {
    let n = a.nrows();
    let mut forward = vec![0_usize; n];
    let mut backward = vec![0_usize; n];
    let scratch = lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
    let (_, permutation) = lu_in_place(
        a.as_mut(),
        &mut forward,
        &mut backward,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    );
    let scratch = solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
    solve_in_place(
        a.as_ref(),
        a.as_ref(),
        permutation,
        MatMut::from_column_major_slice_mut(b, n, 1),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
    );
    b.iter().all(|value| value.is_finite())
}

/// `det A / |det A|`; zero for a singular matrix.
pub fn determinant_phase(mut a: Mat<c64>) -> c64 {
    let n = a.nrows();
    let mut forward = vec![0_usize; n];
    let mut backward = vec![0_usize; n];
    let scratch = lu_in_place_scratch::<usize, c64>(n, n, Par::Seq, Default::default());
    let (info, _) = lu_in_place(
        a.as_mut(),
        &mut forward,
        &mut backward,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    );
    let mut phase = c64::new(
        if info.transposition_count.is_multiple_of(2) {
            1.0
        } else {
            -1.0
        },
        0.0,
    );
    for i in 0..n {
        let pivot = a[(i, i)];
        let size = pivot.norm();
        if !(size > 0.0) {
            return c64::new(0.0, 0.0);
        }
        phase *= pivot / size;
    }
    phase
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::dense::random_columns;

    #[test]
    fn solution_of_a_random_system_has_no_residual() {
        let a = random_columns(60, 60, 3);
        let x = random_columns(60, 1, 4);
        let b = crate::linalg::dense::product(a.as_ref(), x.as_ref());
        let mut y: Vec<f64> = (0..60).map(|i| b[(i, 0)]).collect();
        assert!(solve(a, &mut y));
        for i in 0..60 {
            assert!((y[i] - x[(i, 0)]).abs() < 1e-11);
        }
    }

    #[test]
    fn phase_of_a_determinant_follows_row_swaps_and_scaling() {
        let i = c64::new(0.0, 1.0);
        let mut a = Mat::<c64>::zeros(2, 2);
        a[(0, 1)] = i * 3.0;
        a[(1, 0)] = c64::new(2.0, 0.0);
        assert!((determinant_phase(a) + i).norm() < 1e-15);
        assert_eq!(determinant_phase(Mat::zeros(2, 2)).norm(), 0.0);
    }
}
