//! The probability of squeal over design parameters.

use super::{Sampler, wilson};
use crate::*;
use frictionsim_results::uncertainty::{DesignCurve, Onset, RobustSummary};
use std::str::FromStr;

/// Samples at each design, at most.
const SAMPLES: usize = 256;

/// A design parameter and its values, in text `KEY=FROM:TO` or `KEY=FROM:TO:COUNT`.
#[derive(Clone, Debug)]
pub struct Design {
    /// Case key.
    pub key: String,
    /// Its values.
    pub values: Vec<f64>,
}

impl FromStr for Design {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let hint = "a design is KEY=FROM:TO or KEY=FROM:TO:COUNT, for example contact.normal_stiffness=1e12:1e13:9";
        let (key, range) = text.split_once('=').ok_or(hint)?;
        let parts: Vec<&str> = range.split(':').collect();
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        let (from, to, count) = match parts.as_slice() {
            [from, to] => (number(from), number(to), Some(9)),
            [from, to, count] => (number(from), number(to), count.trim().parse::<usize>().ok()),
            _ => return Err(hint.to_owned()),
        };
        let (from, to) = (from.ok_or(hint)?, to.ok_or(hint)?);
        let count = count.filter(|count| (2..=1000).contains(count)).ok_or(hint)?;
        if from >= to {
            return Err(format!("{hint}; FROM must be less than TO"));
        }
        let values = (0..count).map(|k| from + (to - from) * k as f64 / (count - 1) as f64);
        Ok(Self { key: key.trim().to_owned(), values: values.collect() })
    }
}

impl Design {
    /// The case with a value of the design parameter, without what is studied of it.
    ///
    /// # Errors
    /// A value that makes no valid case.
    pub fn case(&self, case: &Case, value: f64) -> Result<Case, CaseErrors> {
        case.with_keys(&[format!("{}={value:?}", self.key)])
    }
}

/// The probability of squeal over each design, the same samples at all of them.
///
/// # Errors
/// A design whose first sample cannot be solved.
pub fn curves(
    case: &Case,
    sampler: &Sampler<'_>,
    designs: &[Design],
    bound: f64,
) -> Result<RobustSummary, StudyError> {
    let samples = case.require_uncertainty()?.samples.min(SAMPLES);
    let curves = designs.iter().map(|design| {
        let values = design.values.iter();
        let solved = values
            .map(|&value| probability(case, sampler, design, value, samples))
            .collect::<Result<Vec<_>, StudyError>>()?;
        let (points, onsets): (Vec<[f64; 4]>, Vec<Vec<Onset>>) = solved.into_iter().unzip();
        let own = case.number(&design.key);
        let moves_onsets = onsets.windows(2).any(|pair| !are_same(&pair[0], &pair[1]));
        let has_effect = moves_onsets || points.windows(2).any(|pair| pair[0][1] != pair[1][1]);
        let reached = reaches(&points, own, bound).filter(|_| has_effect);
        Ok(DesignCurve {
            key: design.key.clone(),
            own,
            reaches_bound_at: reached,
            change_percent: reached.zip(own).map(|(value, own)| 100.0 * (value / own - 1.0)),
            has_effect,
            points,
        })
    });
    let curves = curves.collect::<Result<Vec<DesignCurve>, StudyError>>()?;
    let change = |curve: &DesignCurve| curve.change_percent.map_or(f64::INFINITY, f64::abs);
    let cheapest = curves.iter().filter(|curve| change(curve).is_finite());
    let cheapest = cheapest.min_by(|a, b| change(a).total_cmp(&change(b)));
    Ok(RobustSummary { bound, samples, cheapest: cheapest.map(|curve| curve.key.clone()), curves })
}

/// Relative difference of critical frictions and frequencies that is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Whether two models have the same onsets.
fn are_same(a: &[Onset], b: &[Onset]) -> bool {
    let is_near = |a: f64, b: f64| (a - b).abs() <= ROUND_OFF * a.abs();
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            is_near(a.critical_friction, b.critical_friction)
                && is_near(a.frequency_hz, b.frequency_hz)
        })
}

/// A design, its probability of squeal and the ends of its interval; beside it the onsets of the first sample.
fn probability(
    case: &Case,
    sampler: &Sampler<'_>,
    design: &Design,
    value: f64,
    samples: usize,
) -> Result<([f64; 4], Vec<Onset>), StudyError> {
    let designed = design.case(case, value)?;
    let (leading, followed) = sampler.sample(&designed, 0, None);
    if let Some(error) = leading.error {
        return Err(StudyError::Failed(format!("{} = {value}: {error}", design.key)));
    }
    let harmonics = sampler.harmonics(&followed);
    let outcomes: Vec<Option<bool>> = parallel::map(0..samples, |index| {
        let (sample, _) = sampler.sample(&designed, index, harmonics.as_deref());
        let is_unstable = sample.is_unstable(sample.friction_coefficient);
        sample.error.is_none().then_some(is_unstable)
    });
    let solved = outcomes.iter().flatten().count();
    let hits = outcomes.iter().flatten().filter(|hit| **hit).count();
    let p = wilson(hits, solved);
    Ok(([value, p.value, p.low, p.high], leading.onsets))
}

/// The value nearest to the case's own at which the probability is no higher than the bound, by linear interpolation.
fn reaches(points: &[[f64; 4]], own: Option<f64>, bound: f64) -> Option<f64> {
    let mut found: Vec<f64> = points.iter().filter(|p| p[1] <= bound).map(|p| p[0]).collect();
    for pair in points.windows(2) {
        let ([x, p, ..], [y, q, ..]) = (pair[0], pair[1]);
        if (p <= bound) != (q <= bound) {
            found.push(x + (y - x) * (bound - p) / (q - p));
        }
    }
    let distance = |value: f64| own.map_or(0.0, |own| (value - own).abs());
    found.into_iter().min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_reached_where_the_curve_crosses_it_nearest_to_the_case() {
        let points = [[1.0, 0.0], [2.0, 0.1], [3.0, 0.9], [4.0, 0.0]].map(|[x, p]| [x, p, p, p]);
        for (own, bound, crossing) in [(2.9, 0.5, 2.5), (3.9, 0.05, 4.0 - 0.05 / 0.9)] {
            let found = reaches(&points, Some(own), bound).unwrap();
            assert!((found - crossing).abs() < 1e-14, "{found}");
        }
        assert_eq!(reaches(&points[2..3], Some(3.0), 0.05), None);
    }

    #[test]
    fn designs_are_read_or_refused_with_a_hint() {
        let design: Design = "contact.interference=1e-5:3e-5:3".parse().unwrap();
        let errors = design.values.iter().zip([1e-5, 2e-5, 3e-5]);
        assert!(errors.map(|(a, b)| (a / b - 1.0).abs()).all(|e| e < 1e-15));
        assert_eq!(design.values.len(), 3);
        for text in ["a", "a=1", "a=1:1", "a=1:2:1", "a=x:2"] {
            assert!(text.parse::<Design>().is_err(), "{text}");
        }
    }
}
