//! From samples to a probability of squeal.

use super::largest_friction;
use crate::*;
use frictionsim_case::Uncertainty;
use frictionsim_results::uncertainty::{
    CriticalFriction, FamilySummary, Index, Onset, Sample, UncertaintySummary,
};
use frictionsim_signal::{Estimate, student_95};

/// Parts of the sequence whose scatter tells how sure a mean is.
const PARTS: usize = 16;

/// Friction coefficients at which the probability of squeal is reported.
const FRICTIONS: usize = 101;

/// 95 % interval of a probability of which `count` trials gave `hits`.
///
/// E. B. Wilson, "Probable inference, the law of succession, and statistical inference", J. Am. Stat. Assoc. 22 (1927)
/// 209. Points of a Sobol sequence scatter less than the random trials that it is made for.
pub fn wilson(hits: usize, count: usize) -> Estimate {
    let (n, z2) = (count.max(1) as f64, 1.959_963_984_540_054_f64.powi(2));
    let value = hits as f64 / n;
    let middle = (value + 0.5 * z2 / n) / (1.0 + z2 / n);
    let half = (z2 * (value * (1.0 - value) + 0.25 * z2 / n) / n).sqrt() / (1.0 + z2 / n);
    Estimate {
        value,
        low: if hits == 0 { 0.0 } else { middle - half },
        high: if hits == count { 1.0 } else { middle + half },
    }
}

/// First-order and total index of each parameter, from values at `A`, `B` and `A` with one column of `B`.
///
/// ```text
/// S_k = 1 - <(f_B - f_ABk)^2> / 2 V,   T_k = <(f_A - f_ABk)^2> / 2 V
/// ```
///
/// A. Saltelli et al., "Variance based sensitivity analysis of model output. Design and estimator for the total
/// sensitivity index", Comput. Phys. Commun. 181 (2010) 259, with M. J. W. Jansen's estimators. Zero without variance.
pub fn indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>]) -> Vec<[f64; 2]> {
    let count = a.len().max(1) as f64;
    let both = || a.iter().chain(b);
    let mean = both().sum::<f64>() / (2.0 * count);
    let variance = both().map(|f| (f - mean).powi(2)).sum::<f64>() / (2.0 * count);
    if !(variance > 0.0) {
        return vec![[0.0; 2]; mixed.len()];
    }
    let distance = |x: &[f64], y: &[f64]| {
        x.iter().zip(y).map(|(x, y)| (x - y).powi(2)).sum::<f64>() / (2.0 * count * variance)
    };
    let of = |column: &Vec<f64>| [1.0 - distance(b, column), distance(a, column)];
    mixed.iter().map(of).collect()
}

/// Whether a key is that of the friction coefficient of a sample, which is the first contact's.
pub(super) fn is_friction(case: &Case, key: &str) -> bool {
    key == "contact.friction_coefficient" || key == case.contact_key("friction_coefficient")
}

/// Relative distance of critical frictions within which they are one: their round-off would have indices.
const SAME: f64 = 1e-9;
/// Resamples that the intervals of indices rest on.
const RESAMPLES: usize = 400;

/// First-order and total index of each parameter with 95 % intervals: percentiles over samples drawn with replacement.
///
/// G. E. B. Archer, A. Saltelli, I. M. Sobol, "Sensitivity measures, ANOVA-like techniques and the use of bootstrap",
/// J. Stat. Comput. Simul. 58 (1997) 99.
pub fn indices_with_intervals(a: &[f64], b: &[f64], mixed: &[Vec<f64>]) -> Vec<Index> {
    let count = a.len();
    // A fixed sequence of numbers: the same samples have the same intervals.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as usize) % count.max(1)
    };
    let resampled: Vec<Vec<[f64; 2]>> = (0..RESAMPLES)
        .map(|_| {
            let drawn: Vec<usize> = (0..count).map(|_| draw()).collect();
            let of = |values: &[f64]| -> Vec<f64> { drawn.iter().map(|&i| values[i]).collect() };
            let columns: Vec<Vec<f64>> = mixed.iter().map(|column| of(column)).collect();
            indices(&of(a), &of(b), &columns)
        })
        .collect();
    let interval = |k: usize, which: usize| {
        let mut values: Vec<f64> = resampled.iter().map(|found| found[k][which]).collect();
        values.sort_by(f64::total_cmp);
        quantile(&values, 0.025).zip(quantile(&values, 0.975))
    };
    let found = indices(a, b, mixed).into_iter().enumerate();
    found
        .map(|(k, [first, total])| Index {
            first,
            total,
            first_interval: interval(k, 0).map(<[f64; 2]>::from),
            total_interval: interval(k, 1).map(<[f64; 2]>::from),
        })
        .collect()
}

/// What the samples of a case say.
pub fn summarize(case: &Case, samples: &[Sample]) -> UncertaintySummary {
    let keys = case.uncertainty.as_ref().map(Uncertainty::keys).unwrap_or_default();
    let largest_friction = largest_friction(case);
    let friction = case.contact.sliding.friction_coefficient;
    let solved: Vec<&Sample> = samples.iter().filter(|sample| sample.error.is_none()).collect();
    let count = solved.len();
    let hits = |friction: &dyn Fn(&Sample) -> f64| {
        solved.iter().filter(|sample| sample.is_unstable(friction(sample))).count()
    };
    let over = (0..FRICTIONS).map(|k| {
        let friction = largest_friction * k as f64 / (FRICTIONS - 1) as f64;
        let p = wilson(hits(&|_| friction), count);
        [friction, p.value, p.low, p.high]
    });
    let (sobol, index_samples) = sobol_of(&keys, &solved, largest_friction);
    // Where no sample turns unstable nothing decides.
    let varying = sobol.iter().filter(|own| own.1.total > 0.0);
    let decisive = varying.max_by(|a, b| a.1.total.total_cmp(&b.1.total));
    // What decides between squeal and none is the critical friction less that of the sample.
    let own = keys.iter().find(|key| is_friction(case, key));
    let decisive = decisive.filter(|_| own.is_none());
    let failed = samples.len() - count;
    let mut notes = Vec::new();
    if let Some(sample) = samples.iter().find(|sample| sample.error.is_some()) {
        notes.push(format!(
            "{failed} samples could not be solved and are left out; the first is sample {}: {}",
            sample.number,
            sample.error.as_deref().unwrap_or_default()
        ));
    }
    if index_samples > 0 && sobol.is_empty() {
        let why = "the lowest critical friction is the same in all samples (the end of the range where none turns \
                   unstable): it has no Sobol indices";
        notes.push(why.to_owned());
    }
    if let Some(key) = own.filter(|_| !sobol.is_empty()) {
        notes.push(format!(
            "the indices are of the critical friction, which {key} does not move: no parameter is called decisive"
        ));
    }
    let families = families(&solved, largest_friction);
    notes.extend(beyond_note(&families));
    UncertaintySummary {
        samples: samples.len(),
        failed,
        index_samples,
        friction_coefficient: solved
            .iter()
            .all(|own| own.friction_coefficient == friction)
            .then_some(friction),
        largest_friction,
        probability_unstable: wilson(hits(&|sample| sample.friction_coefficient), count),
        critical_friction: critical_friction(&solved, largest_friction),
        families,
        decisive: decisive.map(|(key, _)| key.clone()),
        sobol,
        probability_over_friction: over.collect(),
        robust: None,
        notes,
    }
}

/// The indices of the lowest critical friction, which is the end of the range where there is none, and how many samples
/// they rest on; none where it is the same in all.
fn sobol_of(keys: &[String], solved: &[&Sample], most: f64) -> (BTreeMap<String, Index>, usize) {
    let used: Vec<&&Sample> =
        solved.iter().filter(|sample| sample.mixed.len() == keys.len() + 1).collect();
    if used.is_empty() {
        return (BTreeMap::new(), 0);
    }
    let capped = |value: Option<f64>| value.map_or(most, |value| value.min(most));
    let own = |sample: &&&Sample| capped(sample.lowest(most).map(|onset| onset.critical_friction));
    let a: Vec<f64> = used.iter().map(own).collect();
    let column = |k: usize| used.iter().map(|sample| capped(sample.mixed[k])).collect();
    let mixed: Vec<Vec<f64>> = (1..=keys.len()).map(column).collect();
    let all = mixed.iter().flatten().chain(&a).copied();
    let [least, highest] = order::range(all.chain(column(0)));
    if highest - least <= SAME * highest {
        return (BTreeMap::new(), used.len());
    }
    let found = indices_with_intervals(&a, &column(0), &mixed);
    (keys.iter().cloned().zip(found).collect(), used.len())
}

/// A quantile of values that may be beyond all numbers.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    let value = low + (high - low) * place.fract();
    let value = if low == high { low } else { value };
    value.is_finite().then_some(value)
}

fn critical_friction(solved: &[&Sample], most: f64) -> CriticalFriction {
    let of = |sample: &&Sample| sample.lowest(most).map_or(f64::INFINITY, |o| o.critical_friction);
    let all: Vec<f64> = solved.iter().map(of).collect();
    let mean = |values: &[f64]| {
        let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        (!finite.is_empty()).then(|| finite.iter().sum::<f64>() / finite.len() as f64)
    };
    let parts: Vec<f64> = match all.len() / PARTS {
        0 => Vec::new(),
        size => all.chunks_exact(size).take(PARTS).filter_map(mean).collect(),
    };
    let middle = mean(&all);
    let half = middle.filter(|_| parts.len() == PARTS).map(|middle| {
        let n = PARTS as f64;
        let variance = parts.iter().map(|p| (p - middle).powi(2)).sum::<f64>() / (n - 1.0);
        student_95(n - 1.0) * (variance / n).sqrt()
    });
    let beyond = all.iter().filter(|value| value.is_infinite()).count();
    let sorted = sorted(all.iter().copied(), |own| *own);
    CriticalFriction {
        mean: middle,
        mean_low: middle.zip(half).map(|(m, half)| m - half),
        mean_high: middle.zip(half).map(|(m, half)| m + half),
        median: quantile(&sorted, 0.5),
        p05: quantile(&sorted, 0.05),
        p95: quantile(&sorted, 0.95),
        without_onset: beyond as f64 / all.len().max(1) as f64,
    }
}

/// Families that leave the range of frequencies in some samples.
fn beyond_note(families: &[FamilySummary]) -> Option<String> {
    let beyond = families.iter().filter(|family| family.beyond_limit > 0.0);
    let worst = beyond.max_by(|a, b| a.beyond_limit.total_cmp(&b.beyond_limit))?;
    Some(format!(
        "{} lies above the modes that [cea] lists in {:.4} of the samples and counts as stable \
         there. Raise cea.max_frequency_hz (or cea.modes) to follow it in all of them",
        worst.name(),
        worst.beyond_limit
    ))
}

/// Modes followed across samples by harmonic, rank and direction.
fn families(solved: &[&Sample], most: f64) -> Vec<FamilySummary> {
    let name_of = |onset: &Onset| (onset.harmonic, onset.branch, onset.direction);
    let within = solved.iter().flat_map(|sample| &sample.onsets);
    let within = within.filter(|onset| onset.critical_friction <= most);
    let names: BTreeSet<(Option<usize>, usize, i8)> = within.map(name_of).collect();
    let share = |count: usize| count as f64 / solved.len().max(1) as f64;
    let family = |name @ (harmonic, branch, direction)| {
        let is_own = |onset: &&Onset| name_of(onset) == name;
        let is_hit = |sample: &&&Sample| {
            let mut own = sample.onsets.iter().filter(is_own);
            own.any(|onset| onset.holds(sample.friction_coefficient))
        };
        let firsts = solved.iter().filter_map(|sample| sample.onsets.iter().find(is_own));
        let firsts: Vec<&Onset> = firsts.filter(|own| own.critical_friction <= most).collect();
        let frequencies = firsts.iter().map(|onset| onset.frequency_hz).sum::<f64>();
        // Samples without one turn unstable beyond all friction.
        let mut critical = sorted(firsts.iter().map(|own| own.critical_friction), |own| *own);
        critical.resize(solved.len(), f64::INFINITY);
        let is_beyond = |sample: &&&Sample| sample.is_beyond(harmonic, branch);
        FamilySummary {
            harmonic,
            branch,
            direction,
            probability: share(solved.iter().filter(is_hit).count()),
            probability_in_range: share(firsts.len()),
            beyond_limit: share(solved.iter().filter(is_beyond).count()),
            critical_friction_median: quantile(&critical[..firsts.len()], 0.5).unwrap_or(most),
            frequency_hz: frequencies / firsts.len().max(1) as f64,
            critical_friction_percentiles: (1..100)
                .map(|k| quantile(&critical, 0.01 * f64::from(k)))
                .collect(),
        }
    };
    let mut found: Vec<FamilySummary> = names.into_iter().map(family).collect();
    // Equal ones stay in the order of their names.
    found.sort_by(|a, b| {
        let by_range = b.probability_in_range.total_cmp(&a.probability_in_range);
        b.probability.total_cmp(&a.probability).then(by_range)
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ScrambledSobol;
    use std::f64::consts::PI;

    /// Ishigami's function on the unit cube.
    fn ishigami(x: &[f64]) -> f64 {
        let [x1, x2, x3] = [0, 1, 2].map(|i| PI * (2.0 * x[i] - 1.0));
        x1.sin() + 7.0 * x2.sin().powi(2) + 0.1 * x3.powi(4) * x1.sin()
    }

    /// An onset that no parameter moves, but for round-off, and samples without any.
    #[test]
    fn what_is_the_same_in_all_samples_has_no_indices() {
        let onset_at = |critical_friction: f64| Onset { critical_friction, ..Onset::default() };
        let sample = |number: usize, onset: Option<f64>| Sample {
            number,
            onsets: onset.map(onset_at).into_iter().collect(),
            mixed: vec![onset; 2],
            ..Sample::default()
        };
        let keys = ["key".to_owned()];
        for onset in [None, Some(0.2)] {
            let samples: Vec<Sample> =
                (1..=8).map(|k| sample(k, onset.map(|mu| mu + 1e-15 * k as f64))).collect();
            let (found, count) = sobol_of(&keys, &samples.iter().collect::<Vec<_>>(), 0.6);
            assert!(found.is_empty() && count == 8, "{found:?}");
        }
        let samples = [sample(1, Some(0.2)), sample(2, Some(0.3))];
        assert_eq!(sobol_of(&keys, &samples.iter().collect::<Vec<_>>(), 0.6).0.len(), 1);
    }

    #[test]
    fn indices_of_ishigamis_function_are_the_exact_ones_within_a_hundredth() {
        // V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, V13 = b^2 pi^8 (1/18 - 1/50).
        let (v1, v2) = (0.5 * (1.0 + 0.1 * PI.powi(4) / 5.0).powi(2), 49.0 / 8.0);
        let v13 = 0.01 * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
        let v = v1 + v2 + v13;
        let exact = [[v1 / v, (v1 + v13) / v], [v2 / v, v2 / v], [0.0, v13 / v]];
        for seed in 1..=3 {
            let sequence = ScrambledSobol::new(6, seed);
            let (mut a, mut b, mut mixed) = (Vec::new(), Vec::new(), vec![Vec::new(); 3]);
            for i in 0..4096 {
                let point = sequence.point(i);
                a.push(ishigami(&point[..3]));
                b.push(ishigami(&point[3..]));
                for (k, column) in mixed.iter_mut().enumerate() {
                    let mut x = point[..3].to_vec();
                    x[k] = point[3 + k];
                    column.push(ishigami(&x));
                }
            }
            for (found, exact) in indices_with_intervals(&a, &b, &mixed).iter().zip(exact) {
                assert!((found.first - exact[0]).abs() < 0.01, "{seed} {found:?} {exact:?}");
                assert!((found.total - exact[1]).abs() < 0.01, "{seed} {found:?} {exact:?}");
                // Points of a Sobol sequence scatter less than the random ones that resampling stands for.
                for (interval, exact) in
                    [(found.first_interval, exact[0]), (found.total_interval, exact[1])]
                {
                    let [low, high] = interval.expect("an interval");
                    assert!(low <= exact && exact <= high, "{seed} {found:?} {exact}");
                    assert!(high - low < 0.15, "{seed} {found:?}");
                }
            }
        }
    }

    #[test]
    fn wilsons_interval_is_the_published_one() {
        // R. G. Newcombe, Statist. Med. 17 (1998) 857: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
        for (hits, count, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let found = wilson(hits, count);
            assert!((found.low - low).abs() < 6e-5, "{found:?}");
            assert!((found.high - high).abs() < 6e-5, "{found:?}");
        }
    }
}
