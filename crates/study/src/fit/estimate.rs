//! The search from several points, and what is known of its result: intervals, correlations, and the direction that the
//! data do not see.

use super::levenberg_marquardt::{KINDS, Squares, Trial};
use super::matching::{Weights, differences};
use super::{FitError, FitProblem, MeasuredMode, ModelMode};
use crate::ScrambledSobol;
use crate::*;
use frictionsim_case::{FitParameter, find_key};
use frictionsim_results::fit::{
    FitSummary, FittedParameter, LineSummary, ModeSummary, SearchSummary,
};
use frictionsim_signal::student_95;

/// Starting points from which the search goes on.
const DESCENTS: usize = 4;

/// Measured numbers of a kind from which its scatter is estimated by itself.
const OWN_SCATTER: usize = 8;

/// Difference, as a share of its frequency, beyond which a mode is not that line.
const LARGEST_DIFFERENCE: f64 = 0.25;

/// Distance of two minima, in units of the bounds, from which on they are two.
const DISTINCT: f64 = 0.02;

/// Fits the parameters. What only a case can tell (its friction, modes as it is written, notes) is left out.
///
/// Without `sigma_hz` differences weigh as shares of the frequency; frequencies and real parts scatter each by their
/// own measure where there are eight of each or more, so that the weight between the two is the data's own. Intervals
/// are those of the linearised model with the scatter of the differences (Student's t).
pub fn fit(problem: &FitProblem<'_>) -> Result<FitSummary, FitError> {
    let (data, count) = (problem.data_count(), problem.wanted.parameters.len());
    if data < count {
        return Err(FitError::too_few_data(count, data));
    }
    let mut squares = Squares { problem, weights: weights(problem) };
    let points = starting_points(problem);
    let failed = |reason| {
        let points = points.len();
        FitError::Model(format!(
            "the model has no modes to compare at any of {points} points within the bounds: {reason}"
        ))
    };
    let mut reason = String::new();
    let looked = parallel::map(&points, |places| squares.trial(places, false));
    let mut starts = by_squares(looked, &mut reason);
    starts.truncate(DESCENTS);
    let searched = starts.len();
    let found = parallel::map(starts, |start| squares.descend(start));
    let minima = by_squares(found, &mut reason);
    let Some(first) = minima.first() else { return Err(failed(reason)) };
    let (best, degrees) = reweighted(&mut squares, first.clone()).map_err(failed)?;
    refuse_unmatched(problem, &best)?;
    let (parameters, correlations) = estimates(&squares, &best, degrees).map_err(failed)??;
    let is_here = |trial: &&Trial| distance(&trial.places, &first.places) <= DISTINCT;
    let here = minima.iter().filter(is_here).count();
    let [frequency_scatter, real_scatter] = scatter(problem, &best);
    let residuals = lines(problem, &best);
    let worst = residuals.iter().map(|line| line.difference_percent.abs());
    Ok(FitSummary {
        parameters,
        correlations,
        worst_percent: worst.fold(0.0, f64::max),
        residuals,
        frequency_scatter,
        real_scatter,
        other_minima: other_minima(problem, &minima),
        search: SearchSummary { starts: points.len(), searches: searched, arrived: here },
        modes: best.modes.iter().map(|mode| mode.told.clone()).collect(),
        ..FitSummary::default()
    })
}

/// The trials that the model has modes for, the best first; the reason of the last that has none.
fn by_squares(trials: Vec<Result<Trial, String>>, reason: &mut String) -> Vec<Trial> {
    let mut solved = Vec::new();
    for trial in trials {
        match trial {
            Ok(trial) => solved.push(trial),
            Err(error) => *reason = error,
        }
    }
    order::sort_by_number(&mut solved, |a| a.chi_square);
    solved
}

/// The case's own values where they lie within the bounds, then points that fill the bounds evenly.
fn starting_points(problem: &FitProblem<'_>) -> Vec<Vec<f64>> {
    let count = problem.wanted.parameters.len();
    let own = problem.own.iter().map(|values| {
        let pairs = problem.wanted.parameters.iter().zip(values);
        pairs.map(|(parameter, value)| parameter.place(*value)).collect::<Vec<f64>>()
    });
    let inside = |places: &Vec<f64>| places.iter().all(|p| (0.0..=1.0).contains(p));
    let mut points: Vec<Vec<f64>> = own.filter(inside).collect();
    let sequence = ScrambledSobol::new(count.min(ScrambledSobol::LARGEST_DIMENSION), 1);
    let further = problem.wanted.starts.saturating_sub(points.len());
    points.extend((0..further as u32).map(|i| {
        let mut point = sequence.point(i);
        point.resize(count, 0.5);
        point
    }));
    points
}

/// Equal shares of the frequency, or the standard deviations given; a line without one takes the largest relative one.
fn weights(problem: &FitProblem<'_>) -> Vec<Weights> {
    let lines = problem.lines;
    let relative = lines.iter().filter_map(|line| Some(line.sigma_hz? / line.frequency_hz));
    let largest = relative.fold(0.0_f64, f64::max);
    let fallback = if largest > 0.0 { largest } else { 1.0 };
    let of = |(line, shape): (&MeasuredMode, &Option<usize>)| {
        let weight = 1.0 / line.sigma_hz.unwrap_or(fallback * line.frequency_hz);
        Weights {
            frequency: weight,
            real: if line.real_hz.is_some() { weight } else { 0.0 },
            shape: shape
                .map(|shape| (shape, problem.wanted.shape_weight * weight * line.frequency_hz)),
        }
    };
    lines.iter().zip(&problem.shape_of).map(of).collect()
}

/// The minimum under weights by which frequencies and real parts scatter alike, and the degrees of freedom left of the
/// kind that has fewer.
fn reweighted(squares: &mut Squares<'_>, mut best: Trial) -> Result<(Trial, f64), String> {
    let lines = squares.problem.lines;
    let all = squares.problem.data_count() as f64 - squares.problem.wanted.parameters.len() as f64;
    let reals = lines.iter().filter(|line| line.real_hz.is_some()).count();
    if reals < OWN_SCATTER || lines.len() < OWN_SCATTER {
        return Ok((best, all));
    }
    let mut degrees = all;
    for _ in 0..4 {
        let residuals = squares.residuals(&best);
        let left = degrees_left(squares, &best, [lines.len(), reals])?;
        degrees = left[0].min(left[1]).max(1.0);
        let variance = [0, 1].map(|part| {
            let own = residuals.iter().skip(part).step_by(KINDS);
            own.map(|r| r * r).sum::<f64>() / left[part].max(1.0)
        });
        if !(variance[0] > 0.0 && variance[1] > 0.0) {
            break;
        }
        // One kind a thousand times better than the other is not believed to be.
        let ratio = (variance[0] / variance[1]).sqrt().clamp(1e-3, 1e3);
        for weights in &mut squares.weights {
            weights.real *= ratio;
        }
        best = squares.trial(&best.places, false)?;
        best = squares.descend(best)?;
        if (ratio - 1.0).abs() < 1e-3 {
            break;
        }
    }
    Ok((best, degrees))
}

/// Measured numbers of each kind less the share of the parameters that they determine (their leverages).
fn degrees_left(
    squares: &Squares<'_>,
    best: &Trial,
    counts: [usize; 2],
) -> Result<[f64; 2], String> {
    let free: Vec<usize> =
        (0..best.places.len()).filter(|&k| best.places[k] > 0.0 && best.places[k] < 1.0).collect();
    let jacobian = squares.jacobian(best)?.select_columns(&free);
    let Some(inverse) = (jacobian.transpose() * &jacobian).try_inverse() else {
        return Ok(counts.map(|count| count as f64));
    };
    let leverage = |row: usize| {
        let row = jacobian.row(row);
        (row * &inverse * row.transpose())[(0, 0)]
    };
    Ok([0, 1].map(|part| {
        let rows = (part..jacobian.nrows()).step_by(KINDS);
        counts[part] as f64 - rows.map(leverage).sum::<f64>()
    }))
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Minima whose sum of squares lies within the joint 95 % region of the best one, each once.
fn other_minima(problem: &FitProblem<'_>, minima: &[Trial]) -> Vec<BTreeMap<String, f64>> {
    let count = problem.wanted.parameters.len() as f64;
    let degrees = problem.data_count() as f64 - count;
    if degrees < 1.0 || minima.is_empty() {
        return Vec::new();
    }
    let limit = minima[0].chi_square * (1.0 + count / degrees * student_95(degrees).powi(2));
    let mut kept = vec![&minima[0]];
    for trial in minima.iter().filter(|trial| trial.chi_square <= limit) {
        if kept.iter().all(|known| distance(&known.places, &trial.places) > DISTINCT) {
            kept.push(trial);
        }
    }
    kept[1..].iter().map(|trial| problem.by_key(problem.values(&trial.places))).collect()
}

fn refuse_unmatched(problem: &FitProblem<'_>, best: &Trial) -> Result<(), FitError> {
    for (line, mode) in problem.lines.iter().zip(best.of_lines()) {
        let fits = |mode: &&ModelMode| {
            let is_near = (mode.told.frequency_hz - line.frequency_hz).abs()
                <= LARGEST_DIFFERENCE * line.frequency_hz;
            let is_heard = !line.is_unstable || mode.eigenvalue.re > 0.0;
            is_near && is_heard && mode.may_be(line)
        };
        if mode.filter(fits).is_some() {
            continue;
        }
        let mut wanted = line.harmonic.map_or(String::new(), |n| format!(", n = {n}"));
        wanted += if line.is_unstable { ", unstable" } else { "" };
        let nearest = mode.map_or("none is left".to_owned(), |ModelMode { told, .. }| {
            let harmonic = told.harmonic.map_or(String::new(), |n| format!("n = {n}, "));
            let ModeSummary { frequency_hz, real_hz, .. } = told;
            format!("{harmonic}{frequency_hz:.0} Hz, growth {real_hz:+.1} Hz comes nearest")
        });
        return Err(FitError::Model(format!(
            "line {} of the table ({} Hz{wanted}) is matched by no mode within the bounds: \
             {nearest}. Widen the bounds of fit.parameters, or take the line out",
            line.line, line.frequency_hz
        )));
    }
    Ok(())
}

/// Each line with its mode.
fn lines(problem: &FitProblem<'_>, best: &Trial) -> Vec<LineSummary> {
    let lines = problem.lines.iter().zip(best.of_lines()).zip(&problem.shape_of);
    let matched = lines.filter_map(|((measured, mode), shape)| {
        let own = mode?.told.clone();
        let difference_hz = own.frequency_hz - measured.frequency_hz;
        Some(LineSummary {
            line: measured.line,
            frequency_hz: measured.frequency_hz,
            real_hz: measured.real_hz,
            harmonic: measured.harmonic,
            unstable: measured.is_unstable,
            difference_hz,
            difference_percent: 100.0 * difference_hz / measured.frequency_hz,
            real_difference_hz: measured.real_hz.map(|real| own.real_hz - real),
            mac: shape.and_then(|shape| mode?.assurances.get(shape).copied()),
            mode: own,
        })
    });
    matched.collect()
}

fn scatter(problem: &FitProblem<'_>, best: &Trial) -> [Option<f64>; 2] {
    [0, 1].map(|part| {
        let pairs = problem.lines.iter().zip(best.of_lines());
        let pairs = pairs.filter(|(line, _)| part == 0 || line.real_hz.is_some());
        let squares = pairs.filter_map(|(line, mode)| {
            Some((differences(line, mode?)[part] / line.frequency_hz).powi(2))
        });
        let squares: Vec<f64> = squares.collect();
        let count = squares.len() as f64;
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / count).sqrt())
    })
}

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
