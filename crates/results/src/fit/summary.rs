//! `summary.json` of a fit.

use crate::cea::mode_name;
use crate::finding::keys;
use frictionsim_output::{Column, parted, rounded};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Name of the block of fitted values in its folder.
pub const BLOCK: &str = "fitted.toml";

keys! {
    /// `summary.json` of a fit.
    #[derive(Default)]
    FitSummary {
        measurement: String = "the table of measured modes";
        friction_coefficient: f64 = "friction coefficient at which modes are computed";
        parameters: BTreeMap<String, FittedParameter> = "the fitted parameters by their keys";
        correlations: BTreeMap<String, BTreeMap<String, f64>>
            = "correlation of the estimates, by key and key";
        residuals: Vec<LineSummary> = "each measured line with its mode";
        frequency_scatter: Option<f64>
            = "root mean square of the differences of frequencies over the frequency";
        real_scatter: Option<f64> = "the same of real parts";
        worst_percent: f64 = "largest difference of a frequency, per cent";
        other_minima: Vec<BTreeMap<String, f64>>
            = "parameter values of other minima that the data cannot tell from this one";
        search: SearchSummary = "how it was found";
        modes: Vec<ModeSummary> = "modes of the fitted model, by frequency";
        modes_of_case: Vec<ModeSummary> = "modes of the case as it is written";
        notes: Vec<String> = "what is to be said";
    }

    /// One fitted parameter.
    #[derive(Default)]
    FittedParameter {
        value: f64 = "its value";
        low: Option<f64> = "lower end of its 95 % interval";
        high: Option<f64> = "upper end";
        bounds: [f64; 2] = "bounds between which it was sought";
        at_bound: Option<f64> = "the bound that it lies on, if it does";
        also: Vec<String> = "keys that have the same value";
        unit: String = "its unit";
    }

    /// One mode of the model.
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

keys! {
    /// One measured line and its mode.
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
        mac?: f64 = "modal assurance criterion of measured shape and mode; where shapes \
            were measured", IfAny "MAC" Fixed(3);
    }
}

/// What was measured of a line.
pub(crate) const MEASURED: &[Column<LineSummary>] = parted(LINES, "difference_hz").0;
/// How far its mode is from it.
pub(crate) const DIFFERENCES: &[Column<LineSummary>] = parted(LINES, "difference_hz").1;

keys! {
    /// How a minimum was found.
    #[derive(Copy, Default)]
    SearchSummary {
        starts: usize = "points looked at";
        searches: usize = "searches from the best of them";
        arrived: usize = "searches that ended at this minimum";
    }
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
