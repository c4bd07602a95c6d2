//! `summary.json` of a fit.

use crate::cea::mode_name;
use crate::finding::finding;
use frictionsim_output::{Column, Described, parted, rounded};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Name of the block of fitted values in its folder.
pub const BLOCK: &str = "fitted.toml";

/// `summary.json` of a fit.
#[derive(Clone, Debug, Default, Described, Serialize)]
pub struct FitSummary {
    /// The table of measured modes.
    pub measurement: String,
    /// Friction coefficient at which modes are computed.
    pub friction_coefficient: f64,
    /// The fitted parameters by their keys.
    pub parameters: BTreeMap<String, FittedParameter>,
    /// Correlation of the estimates, by key and key.
    pub correlations: BTreeMap<String, BTreeMap<String, f64>>,
    /// Each measured line with its mode.
    pub residuals: Vec<LineSummary>,
    /// Root mean square of the differences of frequencies over the frequency.
    pub frequency_scatter: Option<f64>,
    /// The same of real parts.
    pub real_scatter: Option<f64>,
    /// Largest difference of a frequency, per cent.
    pub worst_percent: f64,
    /// Parameter values of other minima that the data cannot tell from this one.
    pub other_minima: Vec<BTreeMap<String, f64>>,
    /// How it was found.
    pub search: SearchSummary,
    /// Modes of the fitted model, by frequency.
    pub modes: Vec<ModeSummary>,
    /// Modes of the case as it is written.
    pub modes_of_case: Vec<ModeSummary>,
    /// What is to be said.
    pub notes: Vec<String>,
}

/// One fitted parameter.
#[derive(Clone, Debug, Default, Described, Serialize)]
pub struct FittedParameter {
    /// Its value.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Bounds between which it was sought.
    pub bounds: [f64; 2],
    /// The bound that it lies on, if it does.
    pub at_bound: Option<f64>,
    /// Keys that have the same value.
    pub also: Vec<String>,
    /// Its unit.
    pub unit: String,
}

finding! {
    /// One mode of the model.
    #[derive(Clone, Debug, PartialEq, Described, Serialize)]
    ModeSummary, MODES {
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry",
            IfAny "n" Count;
        branch: usize = "rank within the harmonic, else among all, from 1", Always "branch" Count;
        direction: i8 = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        frequency_hz: f64 = "frequency of the mode", Always "frequency" Fixed(2);
        real_hz: f64 = "real part of the eigenvalue over 2 pi", Always "real part" Fixed(2);
    }
}

impl ModeSummary {
    /// Whether it grows.
    pub fn is_unstable(&self) -> bool {
        self.real_hz > 0.0
    }

    /// Harmonic and branch in words.
    pub fn name(&self) -> String {
        mode_name(self.harmonic, self.branch, self.direction)
    }
}

finding! {
    /// One measured line and its mode.
    #[derive(Clone, Debug, Described, Serialize)]
    LineSummary, LINES {
        line: usize = "line of the table of measurements";
        frequency_hz: f64 = "measured frequency", Always "measured" Fixed(2);
        real_hz: Option<f64> = "measured real part of the eigenvalue over 2 pi",
            IfAny "real part" Fixed(2);
        harmonic: Option<usize> = "measured number of nodal diameters";
        /// Whether it was heard.
        unstable: bool;
        /// Its mode.
        mode: ModeSummary;
        difference_hz: f64 = "frequency of the model less measured";
        difference_percent: f64 = "the same over the measured one", Always "difference" Signed(3);
        real_difference_hz: Option<f64> = "real part of the model less measured";
        #[serde(skip_serializing_if = "Option::is_none")]
        mac: Option<f64> = "modal assurance criterion of measured shape and mode; where shapes \
            were measured", IfAny "MAC" Fixed(3);
    }
}

/// What was measured of a line.
pub(crate) const MEASURED: &[Column<LineSummary>] = parted(LINES, "difference_hz").0;
/// How far its mode is from it.
pub(crate) const DIFFERENCES: &[Column<LineSummary>] = parted(LINES, "difference_hz").1;

/// How a minimum was found.
#[derive(Clone, Copy, Debug, Default, Described, Serialize)]
pub struct SearchSummary {
    /// Points looked at.
    pub starts: usize,
    /// Searches from the best of them.
    pub searches: usize,
    /// Searches that ended at this minimum.
    pub arrived: usize,
}

impl FitSummary {
    /// The fitted values as sections to paste into the case.
    pub fn block(&self) -> String {
        let mut sections: BTreeMap<&str, String> = BTreeMap::new();
        for (key, fitted) in &self.parameters {
            let interval = match (fitted.low, fitted.high) {
                (Some(low), Some(high)) => format!("95 %: {low:.5e} to {high:.5e}"),
                _ if fitted.at_bound.is_some() => "on its bound".to_owned(),
                _ => "no interval".to_owned(),
            };
            for key in std::iter::once(key).chain(&fitted.also) {
                let (section, name) = key.rsplit_once('.').unwrap_or(("", key));
                let lines = sections.entry(section).or_default();
                // Digits beyond these are round-off of the search.
                let value = rounded(fitted.value, 8);
                let _ = writeln!(lines, "{name} = {value:?}  # {interval}");
            }
        }
        let head = format!("# fitted to {}\n", self.measurement);
        let blocks = sections.iter().map(|(name, lines)| format!("[{name}]\n{lines}"));
        head + &blocks.collect::<Vec<_>>().join("\n")
    }
}
