//! `summary.json` of an uncertainty analysis.

use crate::cea::arrow;
use crate::finding::keys;
use frictionsim_signal::Estimate;
use serde::Deserialize;
use std::collections::BTreeMap;

keys! {
    /// `summary.json` of an uncertainty analysis.
    UncertaintySummary {
        samples: usize = "samples";
        failed: usize = "samples that could not be solved; nothing below counts them";
        index_samples: usize = "samples that the indices rest on";
        friction_coefficient: Option<f64> = "friction coefficient of the case; none where it is \
            uncertain, and each sample has its own";
        largest_friction: f64 = "friction coefficients up to which onsets are sought";
        probability_unstable: Estimate = "probability that some mode is unstable, with Wilson's 95 \
            % interval: at the case's friction coefficient, or at a sample's own";
        critical_friction: CriticalFriction = "distribution of the lowest critical friction";
        families: Vec<FamilySummary>
            = "the modes that turn unstable in some sample, the most probable first";
        sobol: BTreeMap<String, Index>
            = "indices of the lowest critical friction after Sobol, by key";
        decisive: Option<String> = "the parameter with the largest total index";
        probability_over_friction: Vec<[f64; 4]>
            = "friction coefficient, probability of squeal there, and its interval";
        robust: Option<RobustSummary> = "designs, where they were asked for";
        notes: Vec<String> = "what is to be said";
    }

    /// Distribution of the lowest critical friction; absent where that lies beyond the range.
    #[derive(Copy, Deserialize)]
    CriticalFriction {
        mean: Option<f64> = "mean of the samples that have an onset";
        mean_low: Option<f64>
            = "95 % interval of that mean, from its scatter between 16 parts of the sequence";
        mean_high: Option<f64> = "upper end";
        median: Option<f64> = "median of all samples";
        p05: Option<f64> = "five in a hundred lie below";
        p95: Option<f64> = "five in a hundred lie above";
        without_onset: f64 = "share of the samples without an onset in the range";
    }

    /// A mode that turns unstable in some sample.
    FamilySummary {
        harmonic: Option<usize> = "circumferential harmonic, of a body that has them";
        branch: usize = "branch within the harmonic, else among all";
        direction: i8 = "+1 with the rotor, -1 against it, 0 standing";
        probability: f64
            = "probability that it is unstable at the friction coefficient of the case";
        probability_in_range: f64 = "probability that it turns unstable in the range";
        beyond_limit: f64 = "share of the samples in which it lies beyond the frequency limit, \
            where it is not followed";
        critical_friction_median: f64
            = "median of its critical friction, of the samples in which it has one";
        frequency_hz: f64 = "mean frequency at its onset, Hz";
        critical_friction_percentiles: Vec<Option<f64>> = "its critical friction at the quantiles \
            1, 2, ... 99 % of all samples, where it has one";
    }

    /// Sobol's indices of one parameter.
    #[derive(Copy)]
    Index {
        first: f64 = "share of the variance that goes if the parameter is known";
        total: f64 = "share that stays if all others are known";
        first_interval: Option<[f64; 2]> = "ends of the 95 % interval of the first, from \
            resampling; absent in summaries of earlier versions";
        total_interval: Option<[f64; 2]> = "the same of the second";
    }

    /// Probability of squeal over designs.
    RobustSummary {
        bound: f64 = "probability that is to be reached";
        samples: usize = "samples at each design";
        curves: Vec<DesignCurve> = "one curve for each design parameter";
        cheapest: Option<String> = "the parameter whose smallest relative change reaches the bound";
    }

    /// Probability of squeal over one design parameter.
    DesignCurve {
        key: String = "dotted case key";
        own: Option<f64> = "its value in the case";
        points: Vec<[f64; 4]> = "value, probability and its interval";
        reaches_bound_at: Option<f64> = "the value nearest to the case's at which the bound is \
            reached, by linear interpolation";
        change_percent: Option<f64> = "the change that takes, per cent";
        has_effect: bool = "whether the onsets of the first sample depend on the parameter at all";
    }
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
