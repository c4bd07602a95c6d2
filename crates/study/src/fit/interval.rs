//! Intervals and correlations of fitted parameters, and the direction that the data do not see.

use super::levenberg_marquardt::{Squares, Trial};
use super::{BoundedParameter, FitError};
use frictionsim_signal::student_95;
use nalgebra::DMatrix;

/// Least ratio of singular values of what the data see.
const BLIND: f64 = 1e-6;

/// One parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Its value.
    pub value: f64,
    /// 95 % interval; `None` where the value lies on a bound, or no data are left to tell the scatter.
    pub interval: Option<[f64; 2]>,
    /// The bound that it lies on.
    pub at_bound: Option<f64>,
}

type Estimates = (Vec<Estimate>, Vec<Vec<f64>>);

/// Values, intervals and correlations from the derivatives at the minimum.
pub fn estimates(
    squares: &Squares<'_>,
    best: &Trial,
    most_degrees: f64,
) -> Result<Result<Estimates, FitError>, String> {
    let (problem, parameters) = (squares.problem, squares.problem.parameters);
    let is_on_bound = |place: f64| place == 0.0 || place == 1.0;
    let free: Vec<usize> =
        (0..parameters.len()).filter(|&k| !is_on_bound(best.places[k])).collect();
    let jacobian = squares.jacobian(best)?.select_columns(&free);
    if let Some(direction) = blind_direction(&jacobian, parameters, &free, best) {
        return Ok(Err(FitError::Blind(direction)));
    }
    let covariance = (jacobian.transpose() * &jacobian).try_inverse();
    let degrees = problem.data_count() as f64 - free.len() as f64;
    let residuals = squares.residuals(best);
    let variance = residuals.iter().map(|r| r * r).sum::<f64>() / degrees.max(1.0);
    let half_width = |k: usize| {
        let covariance = covariance.as_ref().filter(|_| degrees >= 1.0)?;
        let quantile = student_95(degrees.min(most_degrees));
        Some(quantile * (variance * covariance[(k, k)]).sqrt())
    };
    let mut all: Vec<Estimate> = parameters
        .iter()
        .zip(&best.places)
        .map(|(parameter, &place)| Estimate {
            value: parameter.value(place),
            interval: None,
            at_bound: is_on_bound(place).then(|| parameter.value(place)),
        })
        .collect();
    let mut correlations = vec![vec![0.0; parameters.len()]; parameters.len()];
    for k in 0..parameters.len() {
        correlations[k][k] = 1.0;
    }
    for (i, &k) in free.iter().enumerate() {
        let (place, parameter) = (best.places[k], &parameters[k]);
        all[k].interval =
            half_width(i).map(|half| [place - half, place + half].map(|p| parameter.value(p)));
        for (j, &l) in free.iter().enumerate() {
            let of = |c: &DMatrix<f64>| c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt();
            correlations[k][l] = covariance.as_ref().map_or(0.0, of);
        }
    }
    Ok(Ok((all, correlations)))
}

/// The direction in which no measured number changes, in words.
fn blind_direction(
    jacobian: &DMatrix<f64>,
    parameters: &[BoundedParameter],
    free: &[usize],
    best: &Trial,
) -> Option<String> {
    if free.is_empty() {
        return None;
    }
    let (values, vectors) = {
        let eigen = (jacobian.transpose() * jacobian).symmetric_eigen();
        (eigen.eigenvalues, eigen.eigenvectors)
    };
    let least = values.imin();
    if values[least] > (BLIND * BLIND) * values.max() && values.max() > 0.0 {
        return None;
    }
    // Relative changes, the largest of them one per cent.
    let direction = vectors.column(least);
    let relative: Vec<(usize, f64)> = free
        .iter()
        .enumerate()
        .map(|(i, &k)| {
            let parameter = &parameters[k];
            let place = best.places[k];
            (k, direction[i] * parameter.slope(place) / parameter.value(place))
        })
        .collect();
    let largest = relative.iter().fold(0.0_f64, |m, (_, change)| m.max(change.abs()));
    let sign = relative.iter().find(|(_, c)| c.abs() == largest).map_or(1.0, |(_, c)| c.signum());
    let named = relative.iter().filter(|(_, change)| change.abs() > 0.02 * largest);
    let named = named
        .map(|(k, change)| format!("{} {:+.2} %", parameters[*k].name, sign * change / largest));
    Some(named.collect::<Vec<_>>().join(", "))
}
