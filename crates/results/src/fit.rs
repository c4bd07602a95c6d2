//! Results of a fit to measured modes: tables, figure, page.

use crate::cea::mode_name;
use crate::common::*;

/// Column of whether a mode grows, and what it means.
pub(super) const GROWS: (&str, &str) = ("unstable", "whether the mode grows");

columns! {
    /// A fitted parameter.
    PARAMETERS: row as (String, FittedParameter);
    parameter = row.0.clone(), Always "parameter" Plain;
    value = row.1.value, Always "value" Significant(6);
    unit = row.1.unit.clone(), Always "unit" Plain;
    low = row.1.low, Always "95 % from" Significant(6);
    high = row.1.high, Always "to" Significant(6);
    from = row.1.bounds[0], Always "sought from" Significant(6);
    to = row.1.bounds[1], Always "to" Significant(6);
}

impl Finding for FitSummary {
    fn document(&self) -> Document {
        let lines = || self.residuals.iter();
        let parameters = Table::new("", "Parameters with their 95 % intervals")
            .columns(PARAMETERS, self.parameters.clone());
        let residuals = Table::new("fit.csv", "Measured lines and their modes")
            .columns(MEASURED, lines())
            .group("model_", "model ", MODES, lines().map(|line| Some(&line.mode)))
            .columns(DIFFERENCES, lines())
            .without_empty("mac");
        let modes = Table::new("modes.csv", "Modes of the fitted model")
            .columns(MODES, &self.modes)
            .column(GROWS.0, None, self.modes.iter().map(ModeSummary::is_unstable));
        let Self { residuals: measured, measurement, friction_coefficient, worst_percent, .. } =
            self;
        let SearchSummary { starts, searches, arrived } = self.search;
        let fitted = format!(
            "Fitted to {} of {measurement} at friction coefficient {friction_coefficient}; the worst frequency \
             differs by {worst_percent:.3} %. {arrived} of {searches} searches, from the best of {starts} points, \
             ended here.",
            plural(measured.len(), ["line", "lines"]),
        );
        let pairs = self.correlations.iter().flat_map(|(a, row)| {
            let later = row.iter().filter(move |(b, _)| a < *b);
            later.map(move |(b, value)| format!("Correlation of {a} and {b}: {value:+.3}."))
        });
        Document::new("Fit to measured modes")
            .section(
                Section::new("Fitted parameters")
                    .text(std::iter::once(fitted).chain(pairs))
                    .aside([self.block()])
                    .tables([parameters])
                    .figures(["fit"]),
            )
            .section(Section::new("Lines and modes").tables([residuals]))
            .file(modes)
            .notes(&self.notes)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(fit(self)))]
    }
}

/// Name of the block of fitted values in its folder.
pub const BLOCK: &str = "fitted.toml";

keys! {
    /// `summary.json` of a fit.
    #[derive(Default)]
    FitSummary {
        measurement: String = "the table of measured modes";
        friction_coefficient: f64 = "friction coefficient at which modes are computed";
        parameters: BTreeMap<String, FittedParameter> = "the fitted parameters by their keys";
        correlations: BTreeMap<String, BTreeMap<String, f64>> = "correlation of the estimates, by key and key";
        residuals: Vec<LineSummary> = "each measured line with its mode";
        frequency_scatter: Option<f64> = "root mean square of the differences of frequencies over the frequency";
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
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry", IfAny "n" Count;
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
        real_hz: Option<f64> = "measured real part of the eigenvalue over 2 pi", IfAny "real part" Fixed(2);
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
pub(super) const MEASURED: &[Column<LineSummary>] = parted(LINES, "difference_hz").0;
/// How far its mode is from it.
pub(super) const DIFFERENCES: &[Column<LineSummary>] = parted(LINES, "difference_hz").1;

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

/// Growth rates of the modes over their frequency, before and after, with the measured lines; differences line by line.
fn fit(summary: &FitSummary) -> Figure {
    let lines = || summary.residuals.iter();
    let points = |modes: &[ModeSummary], unstable: bool| {
        let own = modes.iter().filter(|mode| mode.is_unstable() == unstable);
        Points::new(own.map(|mode| (mode.frequency_hz, mode.real_hz)))
    };
    let rules = lines().filter(|line| line.real_hz.is_none()).map(|line| {
        let rule = Rule::vertical(line.frequency_hz).stroke(Stroke::dashed(INK, 0.8));
        rule.name("measured frequency")
    });
    let complex = Points::new(lines().filter_map(|line| Some((line.frequency_hz, line.real_hz?))));
    let highest = 1.1 * lines().map(|line| line.frequency_hz).fold(0.0_f64, f64::max);
    let lowest = 0.8 * lines().map(|line| line.frequency_hz).fold(highest, f64::min);
    let over_frequency = |y: Axis, height: f64| {
        let zero = Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6));
        let x = Axis::kilohertz().between(lowest, highest);
        Panel::new(x, y).height(height).layer(zero).legend()
    };
    let as_written = points(&summary.modes_of_case, true).marker(Marker::Triangle, 1.7, MUTED);
    let stable = points(&summary.modes, false).marker(Marker::Disc, 1.5, STABLE);
    let unstable = points(&summary.modes, true).marker(Marker::Disc, 2.0, UNSTABLE);
    let plane = over_frequency(Axis::new("growth Re *λ*/2π", "Hz"), 160.0)
        .layers(rules)
        .layer(complex.marker(Marker::Square, 2.6, INK).name("measured"))
        .layer(as_written.name("case as written, unstable"))
        .layer(stable.name("fitted model, stable"))
        .layer(unstable.name("fitted model, unstable"));
    let frequencies = Points::new(lines().map(|line| (line.frequency_hz, line.difference_percent)));
    let frequencies = frequencies.marker(Marker::Disc, 1.8, SERIES[2]);
    let reals = Points::new(lines().filter_map(|line| {
        Some((line.frequency_hz, 100.0 * line.real_difference_hz? / line.frequency_hz))
    }));
    let reals = reals.marker(Marker::Diamond, 1.6, SERIES[3]);
    let differences = over_frequency(Axis::new("model – measured", "% of *f*").symmetric(), 80.0)
        .layer(frequencies.name("frequency"))
        .layer(reals.name("real part"));
    let measured = match lines().any(|line| line.real_hz.is_some()) {
        true => "measured eigenvalues",
        false => "measured frequencies",
    };
    let caption = format!(
        "Modes of the fitted model and {measured}: growth rate over frequency (a), differences line by line (b)."
    );
    Figure::new("fit", caption).panel(plane).panel(differences)
}
