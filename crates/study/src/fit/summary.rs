//! A fit in the words of its results.

use super::{Estimate, Fitted, LineFit, ModelMode};
use frictionsim_case::{Case, Fit, find_key};
use frictionsim_physics::cea::ComplexMode;
use frictionsim_results::fit::{
    FitSummary, FittedParameter, LineSummary, ModeSummary, SearchSummary,
};
use std::collections::BTreeMap;

/// Share of its frequency within which an unmeasured mode is said to lie beside a line.
const BESIDE: f64 = 0.05;

/// The summary of a fit, without its source.
pub fn of(case: &Case, wanted: &Fit, fitted: &Fitted, before: &[ComplexMode]) -> FitSummary {
    let keys: Vec<&String> = wanted.parameters.iter().map(|p| &p.parameter.key).collect();
    let by_key = |values: &[f64]| -> BTreeMap<String, f64> {
        keys.iter().map(|key| (*key).clone()).zip(values.iter().copied()).collect()
    };
    let parameters = wanted.parameters.iter().zip(&fitted.parameters);
    let residuals: Vec<LineSummary> = fitted.lines.iter().map(line).collect();
    let worst = residuals.iter().map(|line| line.difference_percent.abs());
    let [starts, searches, arrived] = fitted.searches;
    FitSummary {
        measurement: String::new(),
        friction_coefficient: case.contact.sliding.friction_coefficient,
        parameters: parameters
            .map(|(wanted, estimate)| (wanted.parameter.key.clone(), parameter(wanted, estimate)))
            .collect(),
        correlations: keys
            .iter()
            .zip(&fitted.correlations)
            .map(|(key, row)| ((*key).clone(), by_key(row)))
            .collect(),
        worst_percent: worst.fold(0.0, f64::max),
        residuals,
        frequency_scatter: fitted.scatter[0],
        real_scatter: fitted.scatter[1],
        other_minima: fitted.others.iter().map(|values| by_key(values)).collect(),
        search: SearchSummary { starts, searches, arrived },
        modes: fitted.modes.iter().map(model_mode).collect(),
        modes_of_case: before
            .iter()
            .map(|mode| model_mode(&ModelMode::of(mode, case.has_sectors())))
            .collect(),
        notes: notes(case, wanted, fitted),
    }
}

fn parameter(wanted: &frictionsim_case::FitParameter, estimate: &Estimate) -> FittedParameter {
    let key = &wanted.parameter.key;
    let declared = find_key(key);
    FittedParameter {
        value: estimate.value,
        low: estimate.interval.map(|[low, _]| low),
        high: estimate.interval.map(|[_, high]| high),
        bounds: [wanted.from, wanted.to],
        at_bound: estimate.at_bound,
        also: wanted.parameter.also.clone(),
        unit: declared.map_or(String::new(), |known| known.unit.to_owned()),
    }
}

fn model_mode(mode: &ModelMode) -> ModeSummary {
    ModeSummary {
        harmonic: mode.harmonic,
        branch: mode.branch,
        direction: mode.direction,
        frequency_hz: mode.frequency_hz(),
        real_hz: mode.real_hz(),
    }
}

fn line(fit: &LineFit) -> LineSummary {
    let (measured, mode) = (&fit.measured, model_mode(&fit.mode));
    let difference_hz = mode.frequency_hz - measured.frequency_hz;
    LineSummary {
        line: measured.line,
        frequency_hz: measured.frequency_hz,
        real_hz: measured.real_hz,
        harmonic: measured.harmonic,
        unstable: measured.is_unstable,
        difference_hz,
        difference_percent: 100.0 * difference_hz / measured.frequency_hz,
        real_difference_hz: measured.real_hz.map(|real| mode.real_hz - real),
        mac: fit.assurance,
        mode,
    }
}

/// What a reader of the numbers must know.
fn notes(case: &Case, wanted: &Fit, fitted: &Fitted) -> Vec<String> {
    let mut notes = Vec::new();
    for (wanted, estimate) in wanted.parameters.iter().zip(&fitted.parameters) {
        let (key, from, to) = (&wanted.parameter.key, wanted.from, wanted.to);
        if estimate.at_bound.is_some() {
            notes.push(format!(
                "{key} is at its bound {:e}: the data favour a value outside; widen the bounds if that is plausible",
                estimate.value
            ));
        }
        if estimate.interval.is_some_and(|[low, high]| low <= from && high >= to) {
            notes.push(format!(
                "the data do not determine {key}: its 95 % interval holds all values between its bounds"
            ));
        }
    }
    if !fitted.others.is_empty() {
        notes.push(format!(
            "{} at other values of the parameters fit the data as well: see other_minima",
            match fitted.others.len() {
                1 => "another minimum".to_owned(),
                count => format!("{count} other minima"),
            }
        ));
    }
    let has_harmonic = |line: &LineFit| line.measured.harmonic.is_some();
    if !case.has_sectors() && fitted.lines.iter().any(has_harmonic) {
        notes.push("modes of an imported body have no harmonic: the column is not used".to_owned());
    }
    let unheard = fitted.modes.iter().filter(|mode| {
        let is_line = |line: &LineFit| line.mode.eigenvalue == mode.eigenvalue;
        mode.eigenvalue.re > 0.0 && !fitted.lines.iter().any(is_line)
    });
    if fitted.lines.iter().any(|line| line.measured.is_unstable) {
        notes.extend(unheard.map(|mode| {
            let mode = model_mode(mode);
            let is_beside = |line: &&LineFit| {
                let measured = line.measured.frequency_hz;
                (mode.frequency_hz - measured).abs() <= BESIDE * measured
            };
            let beside = fitted.lines.iter().find(is_beside).map_or(String::new(), |line| {
                format!(", beside the line at {:.0} Hz", line.measured.frequency_hz)
            });
            format!(
                "unstable but not measured: {} at {:.0} Hz, growth {:+.1} Hz{beside}",
                mode.name(),
                mode.frequency_hz,
                mode.real_hz
            )
        }));
    }
    notes
}
