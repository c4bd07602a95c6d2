//! `summary.json` of an uncertainty analysis.

use crate::cea::arrow;
use frictionsim_output::Described;
use frictionsim_signal::Estimate;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `summary.json` of an uncertainty analysis.
#[derive(Clone, Debug, Described, Serialize)]
pub struct UncertaintySummary {
    /// Samples.
    pub samples: usize,
    /// Samples that could not be solved; nothing below counts them.
    pub failed: usize,
    /// Samples that the indices rest on.
    pub index_samples: usize,
    /// Friction coefficient of the case; none where it is uncertain, and each sample has its own.
    pub friction_coefficient: Option<f64>,
    /// Friction coefficients up to which onsets are sought.
    pub largest_friction: f64,
    /// Probability that some mode is unstable, with Wilson's 95 % interval: at the case's friction coefficient, or at a
    /// sample's own.
    pub probability_unstable: Estimate,
    /// Distribution of the lowest critical friction.
    pub critical_friction: CriticalFriction,
    /// The modes that turn unstable in some sample, the most probable first.
    pub families: Vec<FamilySummary>,
    /// Indices of the lowest critical friction after Sobol, by key.
    pub sobol: BTreeMap<String, Index>,
    /// The parameter with the largest total index.
    pub decisive: Option<String>,
    /// Friction coefficient, probability of squeal there, and its interval.
    pub probability_over_friction: Vec<[f64; 4]>,
    /// Designs, where they were asked for.
    pub robust: Option<RobustSummary>,
    /// What is to be said.
    pub notes: Vec<String>,
}

/// Distribution of the lowest critical friction; absent where that lies beyond the range.
#[derive(Clone, Copy, Debug, Described, Serialize, Deserialize)]
pub struct CriticalFriction {
    /// Mean of the samples that have an onset.
    pub mean: Option<f64>,
    /// 95 % interval of that mean, from its scatter between 16 parts of the sequence.
    pub mean_low: Option<f64>,
    /// Upper end.
    pub mean_high: Option<f64>,
    /// Median of all samples.
    pub median: Option<f64>,
    /// Five in a hundred lie below.
    pub p05: Option<f64>,
    /// Five in a hundred lie above.
    pub p95: Option<f64>,
    /// Share of the samples without an onset in the range.
    pub without_onset: f64,
}

/// A mode that turns unstable in some sample.
#[derive(Clone, Debug, Described, Serialize)]
pub struct FamilySummary {
    /// Circumferential harmonic, of a body that has them.
    pub harmonic: Option<usize>,
    /// Branch within the harmonic, else among all.
    pub branch: usize,
    /// +1 with the rotor, -1 against it, 0 standing.
    pub direction: i8,
    /// Probability that it is unstable at the friction coefficient of the case.
    pub probability: f64,
    /// Probability that it turns unstable in the range.
    pub probability_in_range: f64,
    /// Share of the samples in which it lies beyond the frequency limit, where it is not followed.
    pub beyond_limit: f64,
    /// Median of its critical friction, of the samples in which it has one.
    pub critical_friction_median: f64,
    /// Mean frequency at its onset, Hz.
    pub frequency_hz: f64,
    /// Its critical friction at the quantiles 1, 2, ... 99 % of all samples, where it has one.
    pub critical_friction_percentiles: Vec<Option<f64>>,
}

/// Sobol's indices of one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct Index {
    /// Share of the variance that goes if the parameter is known.
    pub first: f64,
    /// Share that stays if all others are known.
    pub total: f64,
    /// Ends of the 95 % interval of the first, from resampling; absent in summaries of earlier versions.
    pub first_interval: Option<[f64; 2]>,
    /// The same of the second.
    pub total_interval: Option<[f64; 2]>,
}

/// Probability of squeal over designs.
#[derive(Clone, Debug, Described, Serialize)]
pub struct RobustSummary {
    /// Probability that is to be reached.
    pub bound: f64,
    /// Samples at each design.
    pub samples: usize,
    /// One curve for each design parameter.
    pub curves: Vec<DesignCurve>,
    /// The parameter whose smallest relative change reaches the bound.
    pub cheapest: Option<String>,
}

/// Probability of squeal over one design parameter.
#[derive(Clone, Debug, Described, Serialize)]
pub struct DesignCurve {
    /// Dotted case key.
    pub key: String,
    /// Its value in the case.
    pub own: Option<f64>,
    /// Value, probability and its interval.
    pub points: Vec<[f64; 4]>,
    /// The value nearest to the case's at which the bound is reached, by linear interpolation.
    pub reaches_bound_at: Option<f64>,
    /// The change that takes, per cent.
    pub change_percent: Option<f64>,
    /// Whether the onsets of the first sample depend on the parameter at all.
    pub has_effect: bool,
}

impl FamilySummary {
    /// Harmonic, branch, direction in words.
    pub fn name(&self) -> String {
        let harmonic = self.harmonic.map_or(String::new(), |n| format!("n = {n}, "));
        format!("{harmonic}branch {}{}", self.branch, arrow(self.direction))
    }
}

impl UncertaintySummary {
    /// Where the probability of squeal is that of.
    pub(super) fn friction_text(&self) -> String {
        match self.friction_coefficient {
            Some(friction) => format!("friction {friction}"),
            None => "the friction of each sample".to_owned(),
        }
    }
}
