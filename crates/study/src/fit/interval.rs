//! Intervals and correlations of fitted parameters, and the direction that the data do not see.

use super::FitError;
use super::levenberg_marquardt::{Squares, Trial};
use frictionsim_case::{FitParameter, find_key};
use frictionsim_results::fit::FittedParameter;
use frictionsim_signal::student_95;
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// Least ratio of singular values of what the data see.
const BLIND: f64 = 1e-6;

/// The parameters by their keys, and their correlations by key and key.
type Estimates = (BTreeMap<String, FittedParameter>, BTreeMap<String, BTreeMap<String, f64>>);

/// Values, intervals and correlations from the derivatives at the minimum. A value on a bound has no interval, nor
/// has any where no data are left to tell the scatter; one on its bound has no correlations.
pub fn estimates(
    squares: &Squares<'_>,
    best: &Trial,
    most_degrees: f64,
) -> Result<Result<Estimates, FitError>, String> {
    let (problem, parameters) = (squares.problem, &squares.problem.wanted.parameters);
    let is_on_bound = |place: f64| place == 0.0 || place == 1.0;
    let free: Vec<usize> =
        (0..parameters.len()).filter(|&k| !is_on_bound(best.places[k])).collect();
    let jacobian = squares.jacobian(best)?.select_columns(&free);
    if let Some(direction) = blind_direction(&jacobian, parameters, &free, best) {
        return Ok(Err(FitError::Blind(direction)));
    }
    let covariance = (jacobian.transpose() * &jacobian).try_inverse();
    let degrees = problem.data_count() as f64 - free.len() as f64;
    let variance = squares.residuals(best).iter().map(|r| r * r).sum::<f64>() / degrees.max(1.0);
    let half_width = |k: usize| {
        let covariance = covariance.as_ref().filter(|_| degrees >= 1.0)?;
        let quantile = student_95(degrees.min(most_degrees));
        Some(quantile * (variance * covariance[(k, k)]).sqrt())
    };
    let at_place = |(parameter, &place): (&FitParameter, &f64)| FittedParameter {
        value: parameter.value(place),
        bounds: [parameter.from, parameter.to],
        at_bound: is_on_bound(place).then(|| parameter.value(place)),
        also: parameter.parameter.also.clone(),
        unit: find_key(&parameter.parameter.key).map_or("", |known| known.unit).to_owned(),
        ..FittedParameter::default()
    };
    let mut all: Vec<FittedParameter> = parameters.iter().zip(&best.places).map(at_place).collect();
    let mut correlations = vec![vec![0.0; parameters.len()]; parameters.len()];
    for k in 0..parameters.len() {
        correlations[k][k] = 1.0;
    }
    for (i, &k) in free.iter().enumerate() {
        let (place, parameter) = (best.places[k], &parameters[k]);
        let half = half_width(i);
        all[k].low = half.map(|half| parameter.value(place - half));
        all[k].high = half.map(|half| parameter.value(place + half));
        for (j, &l) in free.iter().enumerate() {
            let of = |c: &DMatrix<f64>| c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt();
            correlations[k][l] = covariance.as_ref().map_or(0.0, of);
        }
    }
    let correlations = correlations.into_iter().map(|row| problem.by_key(row));
    Ok(Ok((problem.by_key(all), problem.by_key(correlations))))
}

/// The direction in which no measured number changes, in words.
fn blind_direction(
    jacobian: &DMatrix<f64>,
    parameters: &[FitParameter],
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
    let named = named.map(|(k, change)| {
        format!("{} {:+.2} %", parameters[*k].parameter.key, sign * change / largest)
    });
    Some(named.collect::<Vec<_>>().join(", "))
}
