//! Tables, figures and page of an uncertainty analysis.

use super::figures::{indices, robust, uncertainty};
use super::summary::{DesignCurve, FamilySummary, Index, UncertaintySummary};
use super::{ONSETS, Sample};
use crate::drawing::Declaration;
use crate::{Finding, sorted};
use frictionsim_output::{Document, Format, Section, Table, columns};

columns! {
    /// A sample.
    pub(crate) SAMPLES: sample as Sample;
    own_friction_coefficient: "friction coefficient of the sample" = sample.friction_coefficient;
    unstable: "whether some mode is unstable there; empty where the sample could not be solved"
        = sample.error.is_none().then(|| sample.is_unstable(sample.friction_coefficient));
}

columns! {
    /// Why a sample has nothing.
    pub(crate) ERRORS: sample as Sample;
    error: "why the sample could not be solved" = sample.error.clone();
}

columns! {
    /// A family of modes.
    FAMILIES: family as FamilySummary;
    mode = family.name(), Always "mode" Plain;
    probability = family.probability, Always "unstable at that friction" Fixed(4);
    probability_in_range = family.probability_in_range,
        Always "turns unstable in the range" Fixed(4);
    critical_friction_median = family.critical_friction_median,
        Always "median critical friction" Fixed(4);
    frequency_hz = family.frequency_hz, Always "frequency" Fixed(2);
    beyond_limit = (family.beyond_limit > 0.0).then_some(family.beyond_limit),
        IfAny "beyond the frequency limit" Fixed(4);
}

columns! {
    /// Sobol's indices of a parameter.
    INDICES: row as (String, Index);
    parameter = row.0.clone(), Always "parameter" Plain;
    first = row.1.first, Always "first order" Fixed(3);
    first_low = row.1.first_interval.map(|ends| ends[0]), IfAny "from" Fixed(3);
    first_high = row.1.first_interval.map(|ends| ends[1]), IfAny "to" Fixed(3);
    total = row.1.total, Always "total" Fixed(3);
    total_low = row.1.total_interval.map(|ends| ends[0]), IfAny "from" Fixed(3);
    total_high = row.1.total_interval.map(|ends| ends[1]), IfAny "to" Fixed(3);
}

columns! {
    /// The change of a design by one parameter.
    DESIGNS: curve as DesignCurve;
    parameter = curve.key.clone(), Always "parameter" Plain;
    reached_at = curve.reaches_bound_at, Always "reached at" Significant(4);
    change_percent = curve.change_percent, Always "change" Signed(1);
    effect = reach(curve), IfAny "remark" Plain;
}

/// Why a design does not reach the bound.
fn reach(curve: &DesignCurve) -> Option<&'static str> {
    match curve.reaches_bound_at {
        _ if !curve.has_effect => {
            Some("without effect: the onsets of the first sample are the same at all values")
        }
        None => Some("not reached"),
        Some(_) => None,
    }
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
        let mut results = Section::new("Results").facts(facts(self)).tables([Table::new(
            "",
            format!(
                "Families of modes, followed across samples by harmonic and rank, at {friction}"
            ),
        )
        .columns(FAMILIES, &self.families)]);
        if !self.sobol.is_empty() {
            let rows = sorted(self.sobol.clone(), |a| -a.1.total);
            let caption =
                "Sobol's indices of the lowest critical friction: which parameter decides it";
            results = results.tables([Table::new("", caption).columns(INDICES, rows)]);
        }
        if let Some(robust) = &self.robust {
            let bound = robust.bound;
            let caption = format!("Designs: where the probability of squeal falls to {bound}");
            let cheapest = robust.cheapest.as_ref().map(|key| {
                format!(
                    "The smallest relative change that brings the probability of squeal down to \
                     {bound} is that of {key}."
                )
            });
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
    let rows = [
        (
            format!("probability of squeal at {}", summary.friction_text()),
            format!("{} (95 % {} to {})", number(p.value), number(p.low), number(p.high)),
        ),
        ("lowest critical friction, median".into(), text(c.median)),
        ("its mean".into(), text(c.mean)),
        ("5 % of the samples below".into(), text(c.p05)),
        ("5 % of the samples above".into(), text(c.p95)),
        ("samples".into(), (summary.samples - summary.failed).to_string()),
    ];
    let decisive = summary.decisive.iter();
    let decisive = decisive.map(|key| ("decisive parameter".to_owned(), key.clone()));
    rows.into_iter().chain(decisive).collect()
}
