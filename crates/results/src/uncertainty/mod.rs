//! Results of an uncertainty analysis: samples, table, figures, report.

mod figures;

use crate::cea::arrow;
use crate::common::*;
use figures::{indices, robust, uncertainty};

keys! {
    /// A branch that turns unstable in a sample.
    #[derive(Default, Deserialize)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
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

keys! {
    /// `summary.json` of an uncertainty analysis.
    #[derive(Default)]
    UncertaintySummary {
        samples: usize = "samples";
        failed: usize = "samples that could not be solved; nothing below counts them: the probability is of the others";
        index_samples: usize = "samples that the indices rest on";
        friction_coefficient: Option<f64> = "friction coefficient of the case; none where it is \
            uncertain, and each sample has its own";
        largest_friction: f64 = "friction coefficients up to which onsets are sought";
        probability_unstable: Estimate = "probability that some mode is unstable, with Wilson's 95 \
            % interval: at the case's friction coefficient, or at a sample's own";
        critical_friction: CriticalFriction = "distribution of the lowest critical friction";
        families: Vec<FamilySummary> = "the modes that turn unstable in some sample, the most probable first";
        sobol: BTreeMap<String, Index> = "indices of the lowest critical friction after Sobol, by key";
        decisive: Option<String> = "the parameter with the largest total index";
        probability_over_friction: Vec<[f64; 4]>
            = "friction coefficient, probability of squeal there, and its interval";
        robust: Option<RobustSummary> = "designs, where they were asked for";
        notes: Vec<String> = "what is to be said";
    }

    /// Distribution of the lowest critical friction; absent where that lies beyond the range.
    #[derive(Copy, Default, Deserialize)]
    CriticalFriction {
        mean: Option<f64> = "mean of the samples that have an onset";
        mean_low: Option<f64> = "95 % interval of that mean, from its scatter between 16 parts of the sequence";
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
        probability: f64 = "probability that it is unstable at the friction coefficient of the case";
        probability_in_range: f64 = "probability that it turns unstable in the range";
        beyond_limit: f64 = "share of the samples in which it lies beyond the frequency limit, \
            where it is not followed";
        critical_friction_median: f64 = "median of its critical friction, of the samples in which it has one";
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
        let all = self.friction_coefficient.map(|friction| format!("friction {friction}"));
        let all = all.unwrap_or_else(|| "the friction of each sample".to_owned());
        match self.failed {
            0 => all,
            failed => format!("{all}, of the {} samples that did not fail", self.samples - failed),
        }
    }
}

columns! {
    /// A sample.
    pub(crate) SAMPLES: sample as Sample;
    own_friction_coefficient: "friction coefficient of the sample" = sample.friction_coefficient;
    unstable: "whether some mode is unstable there; empty where the sample could not be solved"
        = sample.error.is_none().then(|| sample.is_unstable(sample.friction_coefficient));

    /// Why a sample has nothing.
    pub(crate) ERRORS: sample as Sample;
    error: "why the sample could not be solved" = sample.error.clone();

    /// A family of modes.
    FAMILIES: family as FamilySummary;
    mode = family.name(), Always "mode" Plain;
    probability = family.probability, Always "unstable at that friction" Fixed(4);
    probability_in_range = family.probability_in_range, Always "turns unstable in the range" Fixed(4);
    critical_friction_median = family.critical_friction_median, Always "median onset there" Fixed(4);
    frequency_hz = family.frequency_hz, Always "frequency" Fixed(2);
    beyond_limit = (family.beyond_limit > 0.0).then_some(family.beyond_limit),
        IfAny "beyond the frequency limit" Fixed(4);

    /// Sobol's indices of a parameter.
    INDICES: row as (String, Index);
    parameter = row.0.clone(), Always "parameter" Plain;
    first = row.1.first, Always "first order" Fixed(3);
    first_low = row.1.first_interval.map(|ends| ends[0]), IfAny "from" Fixed(3);
    first_high = row.1.first_interval.map(|ends| ends[1]), IfAny "to" Fixed(3);
    total = row.1.total, Always "total" Fixed(3);
    total_low = row.1.total_interval.map(|ends| ends[0]), IfAny "from" Fixed(3);
    total_high = row.1.total_interval.map(|ends| ends[1]), IfAny "to" Fixed(3);

    /// The change of a design by one parameter.
    DESIGNS: curve as DesignCurve;
    parameter = curve.key.clone(), Always "parameter" Plain;
    reached_at = curve.reaches_bound_at, Always "reached at" Significant(4);
    change_percent = curve.change_percent, Always "change" Signed(1);
    effect = (!curve.has_effect)
        .then_some("without effect: the onsets of the first sample are the same at all values")
        .or(curve.reaches_bound_at.is_none().then_some("not reached")), IfAny "remark" Plain;
}

/// `samples.csv`: one row for each sample, a column for each uncertain parameter.
pub fn samples_table(keys: &[String], samples: &[Sample], largest_friction: f64) -> Table {
    let mut table =
        Table::new("samples.csv", "").column("sample", None, samples.iter().map(|own| own.number));
    for (at, key) in keys.iter().enumerate() {
        table = table.column(key, None, samples.iter().map(|own| own.values[at]));
    }
    table
        .columns(SAMPLES, samples)
        .group("", "", ONSETS, samples.iter().map(|own| own.lowest(largest_friction)))
        .columns(ERRORS, samples)
}

impl Finding for UncertaintySummary {
    fn document(&self) -> Document {
        let friction = self.friction_text();
        let caption = format!(
            "Families of modes, followed across samples by harmonic and rank, at {friction}"
        );
        let families = Table::new("", caption).columns(FAMILIES, &self.families);
        let mut results = Section::new("Results").facts(facts(self)).tables([families]);
        if !self.sobol.is_empty() {
            let rows = sorted(self.sobol.clone(), |a| -a.1.total);
            let mut caption =
                "Sobol's indices of the lowest critical friction: which parameter decides it"
                    .to_owned();
            if self.critical_friction.without_onset > 0.0 {
                caption += &format!(" (taken as {} where there is none)", self.largest_friction);
            }
            results = results.tables([Table::new("", caption).columns(INDICES, rows)]);
        }
        if let Some(robust) = &self.robust {
            let bound = robust.bound;
            let caption = format!("Designs: where the probability of squeal falls to {bound}");
            let change = "The smallest relative change that brings the probability of squeal down";
            let cheapest = robust.cheapest.iter();
            let cheapest = cheapest.map(|key| format!("{change} to {bound} is that of {key}."));
            results = results
                .tables([Table::new("", caption).columns(DESIGNS, &robust.curves)])
                .text(cheapest);
        }
        Document::new("Probability of squeal")
            .section(results)
            .section(Section::new("Probability of squeal").figures([""]))
            .notes(&self.notes)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![
            Box::new(|| Some(uncertainty(self))),
            Box::new(|| (!self.sobol.is_empty()).then(|| indices(self))),
            Box::new(|| self.robust.as_ref().map(robust)),
        ]
    }
}

/// What decides, name and value.
fn facts(summary: &UncertaintySummary) -> Vec<(String, String)> {
    let (p, c) = (summary.probability_unstable, &summary.critical_friction);
    let number = |value: f64| Format::Fixed(4).number(value);
    let text = |value: Option<f64>| value.map_or("beyond the range".to_owned(), number);
    // Samples without an onset have a place in the order, and no value.
    let of_mean = match c.without_onset > 0.0 {
        true => "mean of the samples that have one",
        false => "its mean",
    };
    let rows = [
        (
            format!("probability of squeal at {}", summary.friction_text()),
            format!("{} (95 % {} to {})", number(p.value), number(p.low), number(p.high)),
        ),
        ("lowest critical friction, median".into(), text(c.median)),
        (of_mean.into(), text(c.mean)),
        ("5 % of the samples below".into(), text(c.p05)),
        ("5 % of the samples above".into(), text(c.p95)),
        ("samples".into(), (summary.samples - summary.failed).to_string()),
    ];
    let decisive = summary.decisive.iter();
    let decisive = decisive.map(|key| ("decisive parameter".to_owned(), key.clone()));
    rows.into_iter().chain(decisive).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probability_is_said_to_be_of_the_samples_that_did_not_fail() {
        let friction_coefficient = Some(0.3);
        let default = UncertaintySummary::default();
        let mut summary =
            UncertaintySummary { samples: 32, failed: 25, friction_coefficient, ..default };
        let said = |own: &UncertaintySummary| facts(own)[0].0.clone();
        let of_all = "probability of squeal at friction 0.3";
        assert_eq!(said(&summary), format!("{of_all}, of the 7 samples that did not fail"));
        summary.failed = 0;
        assert_eq!(said(&summary), of_all);
    }
}
