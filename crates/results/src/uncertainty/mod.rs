//! Results of an uncertainty analysis: samples, table, figures, report.

mod figures;
mod report;
mod summary;

pub use report::samples_table;
pub(super) use report::{ERRORS, SAMPLES};
pub use summary::{
    CriticalFriction, DesignCurve, FamilySummary, Index, RobustSummary, UncertaintySummary,
};

use super::finding::keys;
use serde::{Deserialize, Serialize};

keys! {
    /// A branch that turns unstable in a sample.
    #[derive(Deserialize)]
    Onset, ONSETS {
        critical_friction: f64 = "lowest critical friction of the sample";
        harmonic: Option<usize> = "nodal diameters of its mode; none without symmetry";
        branch: usize = "rank within the harmonic, else among all, from 1";
        direction: i8 = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        frequency_hz: f64 = "frequency at the onset";
        /// Friction coefficient from which on it is stable again.
        restabilized: Option<f64>;
        /// Absent in points of earlier versions.
        #[serde(default)]
        unstable_from_start: bool = "whether it is unstable at the lowest friction already, or \
            was lost below its onset";
    }
}

impl Onset {
    /// Whether the branch is unstable at a friction coefficient.
    pub fn holds(&self, friction: f64) -> bool {
        let ends = self.restabilized.unwrap_or(f64::INFINITY);
        self.critical_friction <= friction && friction < ends
    }
}

/// What came out of one sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number from 1.
    pub number: usize,
    /// Values of the uncertain parameters, in the order of their keys.
    pub values: Vec<f64>,
    /// Its own friction coefficient.
    pub friction_coefficient: f64,
    /// Its onsets, by rising friction.
    pub onsets: Vec<Onset>,
    /// Harmonic (0 of a body without) and branch of its modes below the frequency limit; absent in points of earlier
    /// versions.
    #[serde(default)]
    pub within: Vec<(usize, usize)>,
    /// Why it has none, where it could not be solved.
    pub error: Option<String>,
    /// Lowest critical friction with other values: those of a second sample, then its own with the second's value of
    /// one parameter, parameter by parameter; empty for a sample that no index rests on. `None` is no onset.
    pub mixed: Vec<Option<f64>>,
}

impl Sample {
    /// The lowest onset up to a friction coefficient.
    pub fn lowest(&self, most: f64) -> Option<&Onset> {
        let within = self.onsets.iter().filter(|onset| onset.critical_friction <= most);
        within.min_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction))
    }

    /// Whether a branch has no mode below the frequency limit, so that nothing is known of it.
    pub fn is_beyond(&self, harmonic: Option<usize>, branch: usize) -> bool {
        !self.within.is_empty() && !self.within.contains(&(harmonic.unwrap_or(0), branch))
    }

    /// Whether it squeals at a friction coefficient.
    pub fn is_unstable(&self, friction: f64) -> bool {
        self.onsets.iter().any(|onset| onset.holds(friction))
    }
}
