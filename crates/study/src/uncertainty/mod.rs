//! Probability of squeal and the parameters that decide it: onsets of samples drawn from the distributions of a case.
//! `cargo run --example studies` runs one.

mod robust;
mod summary;

use crate::eigenvalues::{OnsetSearch, Solver};
use crate::*;
use crate::{ScrambledSobol, eigenvalues, one_line};
use frictionsim_case::Uncertainty;
use frictionsim_results::uncertainty::{Onset, Sample};
pub use robust::{Design, curves};
use summary::is_friction;
pub use summary::{indices, indices_with_intervals, summarize, wilson};

/// Samples of one block, the first of which proves which harmonics hold modes.
pub const BLOCK: usize = 64;

/// Harmonics looked at above the highest that holds modes in the first sample of a block.
const FURTHER_HARMONICS: usize = 3;

/// Solves samples.
///
/// Point `i` of a scrambled Sobol sequence in twice as many dimensions as there are uncertain parameters makes two
/// samples: `A_i` of its first half, which is the sample proper, and `B_i` of its second, which only the indices need.
pub struct Sampler<'a> {
    case: &'a Case,
    uncertainty: &'a Uncertainty,
    sequence: ScrambledSobol,
}

/// Friction coefficient up to which onsets are sought.
pub fn largest_friction(case: &Case) -> f64 {
    let range = case.cea.iter().flat_map(|cea| &cea.friction_coefficients);
    range.fold(case.contact.sliding.friction_coefficient, |largest, mu| largest.max(*mu))
}

impl<'a> Sampler<'a> {
    /// The samples of a case.
    ///
    /// # Errors
    /// A case without uncertain parameters, or that has no onsets to look for as it is written: a method that its body
    /// does not have, a contact at rest.
    pub fn new(case: &'a Case) -> Result<Self, StudyError> {
        let uncertainty = case.require_uncertainty()?;
        Solver::of(case, case.require_cea()?.method)?;
        let dimensions = 2 * uncertainty.parameters.len();
        let sequence = ScrambledSobol::new(dimensions, uncertainty.seed);
        Ok(Self { case, uncertainty, sequence })
    }

    /// Values of `A_i` and of `B_i`.
    fn halves(&self, index: usize) -> [Vec<f64>; 2] {
        let point = self.sequence.point(index as u32);
        let (a, b) = point.split_at(self.uncertainty.parameters.len());
        [a, b].map(|part| {
            let pairs = self.uncertainty.parameters.iter().zip(part);
            pairs.map(|(parameter, p)| parameter.value(*p)).collect()
        })
    }

    /// The further points that the indices need of a sample: `B_i`, then `A_i` with the value of one parameter from
    /// `B_i`, parameter by parameter; none beyond the samples that they rest on.
    fn mixed(&self, index: usize) -> Vec<Vec<f64>> {
        if index >= self.uncertainty.index_samples {
            return Vec::new();
        }
        let [a, b] = self.halves(index);
        let with = |k: usize| {
            let mut values = a.clone();
            values[k] = b[k];
            values
        };
        let mixed: Vec<Vec<f64>> = (0..a.len()).map(with).collect();
        std::iter::once(b).chain(mixed).collect()
    }

    /// Friction coefficient and onsets at a point, and the search that found them.
    fn onsets(
        &self,
        case: &Case,
        values: &[f64],
        harmonics: Option<&[usize]>,
    ) -> Result<(f64, Vec<Onset>, OnsetSearch), String> {
        let parameters = self.uncertainty.parameters.iter().map(|p| &p.parameter);
        let case = case.with_parameters(parameters.zip(values.iter().copied()))?;
        let own = case.contact.sliding.friction_coefficient;
        let mut frictions = vec![own, largest_friction(self.case)];
        frictions.sort_by(f64::total_cmp);
        frictions.dedup();
        let found = eigenvalues::unstable_intervals(&case, &frictions, harmonics);
        let found = found.map_err(|failure| failure.line())?;
        let onset = |interval: &UnstableInterval| Onset {
            harmonic: interval.diameters(case.body.has_sectors()),
            branch: interval.branch,
            // Which way a wave turns is for harmonics.
            direction: if case.body.has_sectors() { interval.direction } else { 0 },
            critical_friction: interval.critical_friction,
            restabilized: interval.restabilized.map(|end| end.0),
            frequency_hz: interval.frequency_hz,
            unstable_from_start: !interval.is_located(),
        };
        Ok((own, found.intervals.iter().map(onset).collect(), found))
    }

    /// One sample without what the indices need of it.
    pub fn sample(
        &self,
        case: &Case,
        index: usize,
        harmonics: Option<&[usize]>,
    ) -> (Sample, Vec<usize>) {
        let [values, _] = self.halves(index);
        let found = self.onsets(case, &values, harmonics);
        let error = found.as_ref().err().map(|error| one_line(error));
        let (friction_coefficient, onsets, found) = found.unwrap_or_else(|_| {
            let place = self.uncertainty.keys().iter().position(|key| is_friction(case, key));
            let own = place.map_or(case.contact.sliding.friction_coefficient, |k| values[k]);
            (own, Vec::new(), OnsetSearch::default())
        });
        let (number, within, mixed) = (index + 1, found.within, Vec::new());
        let sample = Sample { number, values, friction_coefficient, onsets, within, error, mixed };
        (sample, found.followed)
    }

    /// Harmonics to look at beside a sample that holds modes in `followed`.
    pub fn harmonics(&self, followed: &[usize]) -> Option<Vec<usize>> {
        let highest = followed.iter().max()?;
        let most = self.case.body.sector_count()? / 2;
        Some((0..=(highest + FURTHER_HARMONICS).min(most)).collect())
    }

    /// Solves one block of samples, counted from 1.
    pub fn block(&self, block: usize) -> Vec<Sample> {
        let first = (block - 1) * BLOCK;
        let last = (first + BLOCK).min(self.uncertainty.samples);
        let (leading, followed) = self.sample(self.case, first, None);
        let harmonics = self.harmonics(&followed);
        let sample = |index| self.sample(self.case, index, harmonics.as_deref()).0;
        let others: Vec<Sample> = parallel::map(first + 1..last, sample);
        let mut samples = vec![leading];
        samples.extend(others);
        self.mix(&mut samples);
        samples
    }

    /// Solves the further points of the indices, in the harmonics in which some sample of the block has an onset.
    fn mix(&self, samples: &mut [Sample]) {
        let onsets = samples.iter().flat_map(|sample| &sample.onsets);
        let harmonics: BTreeSet<usize> = onsets.filter_map(|onset| onset.harmonic).collect();
        let harmonics = Vec::from_iter(harmonics);
        let harmonics = (!harmonics.is_empty()).then_some(harmonics);
        let most = largest_friction(self.case);
        let lowest = |values: &Vec<f64>| {
            let (_, onsets, _) = self.onsets(self.case, values, harmonics.as_deref())?;
            let within = onsets.iter().map(|onset| onset.critical_friction);
            let lowest = within.fold(f64::INFINITY, f64::min);
            Ok::<_, String>((lowest <= most).then_some(lowest))
        };
        let solved = samples.iter_mut().filter(|sample| sample.error.is_none());
        parallel::map::<_, _, ()>(solved, |sample| {
            let points = self.mixed(sample.number - 1);
            // A sample whose points cannot all be solved is none that the indices rest on.
            sample.mixed = points.iter().map(lowest).collect::<Result<_, _>>().unwrap_or_default();
        });
    }
}
