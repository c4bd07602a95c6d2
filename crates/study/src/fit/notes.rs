//! What a reader of fitted numbers must know.

use frictionsim_case::{Case, Fit};
use frictionsim_results::fit::{FitSummary, LineSummary, ModeSummary};

/// Share of its frequency within which an unmeasured mode is said to lie beside a line.
const BESIDE: f64 = 0.05;

/// What a reader of the numbers must know.
pub fn notes(case: &Case, wanted: &Fit, found: &FitSummary) -> Vec<String> {
    let mut notes = Vec::new();
    let keys = wanted.parameters.iter().map(|own| &own.parameter.key);
    let estimates = keys.filter_map(|key| Some((key, found.parameters.get(key)?)));
    for (key, estimate) in estimates {
        let [from, to] = estimate.bounds;
        if estimate.at_bound.is_some() {
            notes.push(format!(
                "{key} is at its bound {:e}: the data favour a value outside; widen the bounds if that is plausible",
                estimate.value
            ));
        }
        let interval = estimate.low.zip(estimate.high);
        if interval.is_some_and(|(low, high)| low <= from && high >= to) {
            notes.push(format!(
                "the data do not determine {key}: its 95 % interval holds all values between its bounds"
            ));
        }
    }
    if !found.other_minima.is_empty() {
        notes.push(format!(
            "{} at other values of the parameters fit the data as well: see other_minima",
            match found.other_minima.len() {
                1 => "another minimum".to_owned(),
                count => format!("{count} other minima"),
            }
        ));
    }
    let has_harmonic = |line: &LineSummary| line.harmonic.is_some();
    if !case.body.has_sectors() && found.residuals.iter().any(has_harmonic) {
        notes.push("modes of an imported body have no harmonic: the column is not used".to_owned());
    }
    if found.residuals.iter().any(|line| line.unstable) {
        let eigenvalue = |mode: &ModeSummary| (mode.real_hz, mode.frequency_hz);
        let is_heard = |mode: &ModeSummary| {
            found.residuals.iter().any(|line| eigenvalue(&line.mode) == eigenvalue(mode))
        };
        let unheard = found.modes.iter().filter(|mode| mode.is_unstable() && !is_heard(mode));
        notes.extend(unheard.map(|mode| {
            let is_beside = |line: &&LineSummary| {
                (mode.frequency_hz - line.frequency_hz).abs() <= BESIDE * line.frequency_hz
            };
            let beside = found.residuals.iter().find(is_beside).map_or(String::new(), |line| {
                format!(", beside the line at {:.0} Hz", line.frequency_hz)
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
