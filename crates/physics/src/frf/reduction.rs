//! Response of a projected model.

use super::driven::{BESIDE, Driven};
use super::system::check_frequencies;
use super::{FrfError, FrfSystem, Port};
use crate::linalg::dense::{join_columns, orthonormalize, transpose_product};
use crate::linalg::{ComplexDenseLu, Mat, MatMut, c64};
use crate::order::range;
use crate::prestress::MotionMatrices;
use std::f64::consts::TAU;

/// Terms of each series about a shift, for force and response each.
const MOMENTS: usize = 3;
/// A vector that keeps less than this share of its length adds nothing.
const DROP: f64 = 1e-10;

/// Largest relative error, and how many times that at the check lines it may be between them.
const TOLERANCE: f64 = 1e-6;
const BETWEEN: f64 = 10.0;
/// Shifts to begin with, and at most.
const SHIFTS: usize = 3;
const MOST_SHIFTS: usize = 12;

/// A response of a reduced model and its error.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReducedResponse {
    /// Receptance for each frequency, m/N for each metre of thickness.
    pub receptance: Vec<c64>,
    /// Largest `|h_reduced - h_direct| / |h_direct|` at the check lines.
    pub largest_error: f64,
    /// Frequencies of the check lines, Hz, solved directly: between the shifts, at both ends, and at the largest response.
    pub checked_hz: Vec<f64>,
    /// Vectors in the basis.
    pub vectors: usize,
}

/// Receptance between two ports, by a reduction that interpolates it, whatever the damping.
///
/// At shifts `omega_j` over the range one basis `V` collects real and imaginary parts of three terms of the series of `x(omega)`, and of
/// that of the transposed system from `e_response`: `A x_0 = e_force`, `A x_k = (2 omega_j M - i C) x_{k-1} + M x_{k-2}`, where
/// `A = K + i omega_j C - omega_j^2 M`. The response is that of `V^T M V, V^T C V, V^T K V`. Direct solutions at check lines measure its
/// error; where it is above the tolerance, the worst line becomes a shift. One that hits an undamped resonance is moved a little.
///
/// # Errors
/// [`FrfError::NotReduced`] if the most shifts do not reach the tolerance; those of [`super::direct_response`].
///
/// Source: C. Beattie and S. Gugercin, Interpolatory projection methods for structure-preserving model reduction, Systems & Control
/// Letters 58 (2009).
pub fn reduced_response(
    system: &FrfSystem,
    force: &Port,
    response: &Port,
    frequencies_hz: &[f64],
) -> Result<ReducedResponse, FrfError> {
    check_frequencies(frequencies_hz)?;
    let [low, high] = range(frequencies_hz.iter().copied());
    if frequencies_hz.is_empty() {
        return Ok(ReducedResponse::default());
    }
    // Shifts spread over the range, and the basis that interpolates there.
    let driven = Driven::of(system, [force, response], low)?;
    let mut shifts: Vec<f64> =
        (0..SHIFTS).map(|j| low + (high - low) * (j as f64 + 0.5) / SHIFTS as f64).collect();
    let mut basis = Mat::<f64>::zeros(system.dimension(), 0);
    for shift in &shifts {
        basis = extended(&driven, basis, *shift)?;
    }
    let mut checks: Vec<(f64, c64)> = Vec::new();
    loop {
        let model = ReducedModel::project(&driven, &basis);
        let receptance: Vec<c64> = frequencies_hz.iter().map(|f| model.receptance(*f)).collect();
        // What it misses at check lines, each solved directly once.
        for f in check_lines(frequencies_hz, &receptance, &shifts) {
            if checks.iter().all(|(known, _)| *known != f) {
                checks.push((f, driven.factorized(f)?));
            }
        }
        // A response that nothing leads over is zero in both.
        let error = |(f, h): &(f64, c64)| match model.receptance(*f) - h {
            c64::ZERO => 0.0,
            off => off.norm() / h.norm(),
        };
        let worst = checks.iter().max_by(|a, b| error(a).total_cmp(&error(b)));
        let worst = worst.expect("both ends of the range are checked");
        let largest_error = error(worst);
        let vectors = basis.ncols();
        if BETWEEN * largest_error <= TOLERANCE {
            let mut checked_hz: Vec<f64> = checks.iter().map(|(f, _)| *f).collect();
            checked_hz.sort_by(f64::total_cmp);
            return Ok(ReducedResponse { receptance, largest_error, checked_hz, vectors });
        }
        if shifts.len() >= MOST_SHIFTS {
            return Err(FrfError::NotReduced(format!(
                "the reduced model still errs by {largest_error:.1e} (bound {:.0e}) with {vectors} vectors: use \
                 frf.method = \"auto\", which solves line by line then, or \"direct\"",
                TOLERANCE / BETWEEN
            )));
        }
        shifts.push(worst.0); // The worst line becomes a shift.
        basis = extended(&driven, basis, worst.0)?;
    }
}

/// Lines at which the reduction is checked: both ends, midway between neighbouring shifts, and the largest response.
fn check_lines(frequencies_hz: &[f64], receptance: &[c64], shifts: &[f64]) -> Vec<f64> {
    let [low, high] = range(frequencies_hz.iter().copied());
    let mut sorted = shifts.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut lines = vec![low, high];
    lines.extend(sorted.windows(2).map(|w| 0.5 * (w[0] + w[1])));
    let size = |k: usize| receptance[k].norm() * frequencies_hz[k].powi(2);
    let top = (0..receptance.len()).max_by(|&i, &j| size(i).total_cmp(&size(j)));
    lines.extend(top.map(|k| frequencies_hz[k]));
    lines
}

/// The basis with the vectors of one more shift.
fn extended(driven: &Driven<'_>, mut basis: Mat<f64>, shift_hz: f64) -> Result<Mat<f64>, FrfError> {
    let n = driven.system.dimension();
    let factors = driven.factors(shift_hz).or_else(|_| driven.factors(BESIDE[1] * shift_hz))?;
    for (start, is_transposed) in [(driven.force, false), (driven.response, true)] {
        let mut right = start.complex_force(n);
        let mut series: Vec<Vec<c64>> = vec![vec![c64::ZERO; n]];
        for moment in 1..=MOMENTS {
            let column = MatMut::from_column_major_slice_mut(&mut right, n, 1);
            match is_transposed {
                true => factors.solve_transpose_in_place(column),
                false => factors.solve_in_place(column),
            }
            series.push(right);
            right = driven.system.slope(TAU * shift_hz, &series[moment - 1..], is_transposed);
        }
        let part = |i: usize, j: usize| [series[j / 2 + 1][i].re, series[j / 2 + 1][i].im][j % 2];
        let parts = Mat::from_fn(n, 2 * MOMENTS, part);
        let new = orthonormalize(basis.as_ref(), parts, DROP).columns;
        basis = join_columns(basis.as_ref(), new.as_ref());
    }
    Ok(basis)
}

/// The projected system.
struct ReducedModel {
    matrices: MotionMatrices<Mat<f64>>,
    force: Vec<f64>,
    response: Vec<f64>,
}

impl ReducedModel {
    fn project(driven: &Driven<'_>, basis: &Mat<f64>) -> Self {
        let matrices = driven.system.matrices.map(|values| {
            let image = driven.system.pattern.multiply(values, basis.as_ref());
            transpose_product(basis.as_ref(), image.as_ref())
        });
        Self {
            matrices,
            force: driven.force.row_of(basis.as_ref()),
            response: driven.response.row_of(basis.as_ref()),
        }
    }

    fn receptance(&self, frequency_hz: f64) -> c64 {
        let terms = self.matrices.terms(c64::new(0.0, TAU * frequency_hz)); // K + i omega C - omega^2 M.
        let n = self.force.len();
        let entry =
            |i: usize, j: usize| terms.iter().map(|(factor, own)| factor * own[(i, j)]).sum();
        let mut x = Mat::from_fn(n, 1, |i, _| c64::new(self.force[i], 0.0));
        ComplexDenseLu::factorize(Mat::<c64>::from_fn(n, n, entry)).solve_in_place(x.as_mut());
        (0..n).map(|i| x[(i, 0)] * self.response[i]).sum()
    }
}
