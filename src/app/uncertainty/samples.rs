//! Samples, block by block.

use crate::app::Failure;
use crate::case::{Case, Uncertainty};
use crate::results::Manifest;
use crate::results::sweep::{Found, PointClock, PointRecord, SweepFolder};
use crate::results::uncertainty::{Onset, Sample};
use crate::study::eigenvalues;
use crate::study::uncertainty::SamplePlan;
use rayon::prelude::*;
use serde_json::{Map, Value};
use std::time::Instant;

/// Samples of one block: one file, whose first sample proves which harmonics hold modes.
pub const BLOCK: usize = 64;

/// Harmonics looked at above the highest that holds modes in the first sample of a block.
const FURTHER_HARMONICS: usize = 3;

/// Name of the samples in the file of a block.
const SAMPLES: &str = "samples";

/// Solves samples.
pub struct Sampler<'a> {
    case: &'a Case,
    uncertainty: &'a Uncertainty,
    plan: SamplePlan<'a>,
}

/// Friction coefficient up to which onsets are sought.
pub fn largest_friction(case: &Case) -> f64 {
    let range = case.cea.iter().flat_map(|cea| &cea.friction_coefficients);
    let largest = range.fold(0.0_f64, |largest, mu| largest.max(*mu));
    if largest > 0.0 {
        largest
    } else {
        case.contact.sliding.friction_coefficient
    }
}

/// The samples of a finished block.
pub fn block_samples(record: &PointRecord) -> serde_json::Result<Vec<Sample>> {
    let samples = record.summaries.get(SAMPLES).cloned().unwrap_or_default();
    serde_json::from_value(samples)
}

impl<'a> Sampler<'a> {
    /// The samples of a case.
    ///
    /// # Errors
    /// A case without uncertain parameters, or that has no onsets to look for as it is written.
    pub fn new(case: &'a Case) -> Result<Self, Failure> {
        let uncertainty = case.require_uncertainty()?;
        let sampler = Self {
            case,
            uncertainty,
            plan: SamplePlan::new(uncertainty),
        };
        case.require_cea()?;
        Ok(sampler)
    }

    /// Keys of the uncertain parameters.
    pub fn keys(&self) -> Vec<String> {
        let parameters = self.uncertainty.parameters.iter();
        parameters
            .map(|parameter| parameter.parameter.key.clone())
            .collect()
    }

    /// The case of a point, after further overrides.
    fn case_at(&self, case: &Case, values: &[f64]) -> Result<Case, String> {
        let parameters = self.uncertainty.parameters.iter().map(|p| &p.parameter);
        case.with_parameters(parameters.zip(values.iter().copied()))
    }

    /// Friction coefficient and onsets at a point, and the harmonics that hold modes where all were looked at.
    fn onsets(
        &self,
        case: &Case,
        values: &[f64],
        harmonics: Option<&[usize]>,
    ) -> Result<(f64, Vec<Onset>, Vec<usize>), String> {
        let case = self.case_at(case, values)?;
        let own = case.contact.sliding.friction_coefficient;
        let mut frictions = vec![own, largest_friction(self.case)];
        frictions.sort_by(f64::total_cmp);
        frictions.dedup();
        let found = eigenvalues::unstable_intervals(&case, &frictions, harmonics);
        let (intervals, followed) = found.map_err(|failure| failure.messages().join("; "))?;
        let onset = |interval: &crate::cea::UnstableInterval| Onset {
            harmonic: interval.harmonic,
            branch: interval.branch,
            direction: interval.direction,
            critical_friction: interval.critical_friction,
            restabilized: interval.restabilized.map(|end| end.0),
            frequency_hz: interval.frequency_hz,
        };
        Ok((own, intervals.iter().map(onset).collect(), followed))
    }

    /// One sample without what the indices need of it.
    pub fn sample(
        &self,
        case: &Case,
        index: usize,
        harmonics: Option<&[usize]>,
    ) -> (Sample, Vec<usize>) {
        let values = self.plan.values(index);
        let mut sample = Sample {
            number: index + 1,
            values: values.clone(),
            friction_coefficient: case.contact.sliding.friction_coefficient,
            onsets: Vec::new(),
            error: None,
            mixed: Vec::new(),
        };
        match self.onsets(case, &values, harmonics) {
            Ok((own, onsets, followed)) => {
                sample.friction_coefficient = own;
                sample.onsets = onsets;
                (sample, followed)
            }
            Err(error) => {
                sample.error = Some(crate::study::one_line(&error));
                (sample, Vec::new())
            }
        }
    }

    /// Harmonics to look at beside a sample that holds modes in `followed`.
    pub fn harmonics(&self, followed: &[usize]) -> Option<Vec<usize>> {
        let highest = followed.iter().max()?;
        let most = self.case.annulus.circumferential_elements / 2;
        Some((0..=(highest + FURTHER_HARMONICS).min(most)).collect())
    }

    /// Runs one block and keeps it, unless it is finished or another process has it.
    ///
    /// # Errors
    /// Those of the folder.
    pub fn run_block(
        &self,
        folder: &SweepFolder,
        manifest: &Manifest,
        block: usize,
    ) -> Result<(), Failure> {
        let is_finished = || Ok::<_, Failure>(matches!(folder.read(block)?, Found::Point(_)));
        if is_finished()? {
            return Ok(());
        }
        let Some(_claim) = folder.claim(block)? else {
            return Ok(());
        };
        // Another process may have finished it between the look and the claim.
        if is_finished()? {
            return Ok(());
        }
        let start = Instant::now();
        let first = (block - 1) * BLOCK;
        let last = (first + BLOCK).min(self.uncertainty.samples);
        let (leading, followed) = self.sample(self.case, first, None);
        let harmonics = self.harmonics(&followed);
        let others = (first + 1..last).into_par_iter();
        let others = others.map(|index| self.sample(self.case, index, harmonics.as_deref()).0);
        let mut samples = vec![leading];
        samples.extend(others.collect::<Vec<_>>());
        self.mix(&mut samples);
        let mut summaries = Map::new();
        let value: Value = serde_json::to_value(&samples).map_err(Failure::run)?;
        summaries.insert(SAMPLES.to_owned(), value);
        let record = PointRecord {
            point: block,
            swept: Map::new(),
            error: None,
            summaries,
            case_hash: manifest.case_hash.clone(),
            sweep_hash: manifest.case_hash.clone(),
            version: manifest.version.clone(),
            simd: manifest.simd.clone(),
        };
        let clock = PointClock {
            wall_s: start.elapsed().as_secs_f64(),
            ..PointClock::default()
        };
        Ok(folder.write_point(&record, &clock)?)
    }

    /// Solves the further points of the indices, in the harmonics in which some sample of the block has an onset.
    fn mix(&self, samples: &mut [Sample]) {
        let onsets = samples.iter().flat_map(|sample| &sample.onsets);
        let mut harmonics: Vec<usize> = onsets.map(|onset| onset.harmonic).collect();
        harmonics.sort_unstable();
        harmonics.dedup();
        let harmonics = (!harmonics.is_empty()).then_some(harmonics);
        let most = largest_friction(self.case);
        let lowest = |values: &Vec<f64>| {
            let (_, onsets, _) = self.onsets(self.case, values, harmonics.as_deref())?;
            let within = onsets.iter().map(|onset| onset.critical_friction);
            let lowest = within.fold(f64::INFINITY, f64::min);
            Ok::<_, String>((lowest <= most).then_some(lowest))
        };
        samples
            .par_iter_mut()
            .filter(|sample| sample.error.is_none())
            .for_each(|sample| {
                let points = self.plan.mixed(sample.number - 1);
                // A sample whose points cannot all be solved is none that the indices rest on.
                sample.mixed = points
                    .iter()
                    .map(lowest)
                    .collect::<Result<_, _>>()
                    .unwrap_or_default();
            });
    }
}
