//! Results of a convergence study.

mod estimate;

use crate::common::*;
pub use estimate::{Verdict, estimate};

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Described, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Refinement {
    /// The mesh; sizes are element sizes, m.
    Mesh,
    /// The time step; sizes are steps, s.
    TimeStep,
}

impl Refinement {
    /// Name in tables.
    fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::TimeStep => "time-step",
        }
    }
}

keys! {
    /// A quantity over the levels of its series.
    Quantity {
        name: String = "name, with the mode it belongs to";
        unit: String = "unit; empty for a pure number";
        values: Vec<Option<f64>> = "one value for each level, where there is one";
        verdict: String = "what the values say";
        order: Option<f64> = "observed order";
        extrapolated: Option<f64> = "value extrapolated after Richardson";
        errors: Option<Vec<Option<f64>>> = "values less that one";
        spread: Option<f64> = "largest less smallest value of the three finest levels";
        is_minor: bool = "whether it is of a mode that does not grow";
    }
}

impl Quantity {
    /// Judges values on levels of these sizes.
    pub fn new(name: String, unit: &str, sizes: &[f64], values: Vec<f64>) -> Self {
        let verdict = estimate(sizes, &values);
        Self::judged(name, unit, &values, verdict)
    }

    /// A whole number on each level, which is the same on the three finest or has not converged.
    pub fn count(name: String, values: Vec<f64>) -> Self {
        let finest = &values[values.len().saturating_sub(3)..];
        let verdict = if !finest.iter().all(|value| value.is_finite()) {
            Verdict::Missing
        } else if finest.windows(2).all(|pair| pair[0] == pair[1]) {
            Verdict::Settled
        } else {
            Verdict::NotConverging
        };
        Self::judged(name, "", &values, verdict)
    }

    fn judged(name: String, unit: &str, values: &[f64], verdict: Verdict) -> Self {
        let less = |limit: f64| values.iter().map(|value| present(value - limit)).collect();
        let finest = values[values.len().saturating_sub(3)..].iter().copied();
        let largest = finest.clone().fold(f64::NEG_INFINITY, f64::max);
        let (order, limit) = match verdict {
            Verdict::Converging { order, limit } => (Some(order), Some(limit)),
            _ => (None, None),
        };
        Self {
            name,
            unit: unit.to_owned(),
            values: less(0.0),
            verdict: verdict.name().to_owned(),
            order,
            extrapolated: limit,
            errors: limit.map(less),
            spread: present(largest - finest.fold(f64::INFINITY, f64::min)),
            is_minor: false,
        }
    }

    fn error(&self, level: usize) -> Option<f64> {
        self.errors.as_ref()?.get(level).copied().flatten()
    }
}

keys! {
    /// One analysis over refinements of one kind.
    Series {
        analysis: String = "analysis, with the family of its limit cycles";
        refinement: Refinement = "`mesh` or `time-step`";
        levels: Vec<String> = "name of each level: `90 x 18`, or the time step";
        sizes: Vec<f64> = "element size, m, or time step, s, of each level, strictly falling";
        wall_s: Vec<f64> = "wall time of each level, s; levels run side by side";
        notes: Vec<String> = "what else there is to say";
        quantities: Vec<Quantity> = "the quantities";
    }

    /// `summary.json` of `frictionsim convergence`.
    ConvergenceSummary {
        series: Vec<Series> = "what was studied";
    }
}

/// A quantity on a level of a series.
pub(super) struct Row {
    series: (String, Refinement, String, f64),
    level: usize,
    own: Quantity,
}

columns! {
    /// A quantity on a level.
    pub(super) ROWS: row as Row;
    analysis: "the analysis, with the family of its limit cycles" = row.series.0.clone();
    refinement: "what is refined: mesh or time-step" = row.series.1.name();
    quantity: "name of the quantity, with the mode it belongs to" = row.own.name.clone();
    unit: "its unit; empty for a pure number" = row.own.unit.clone();
    level: "name of the level: elements along the edges, or the time step" = row.series.2.clone();
    size: "element size, m, or time step, s" = row.series.3;
    value: "value on the level" = row.own.values[row.level];
    error: "value less the extrapolated one" = row.own.error(row.level);
    extrapolated: "value extrapolated after Richardson from the three finest levels" = row.own.extrapolated;
    order: "observed order of convergence" = row.own.order;
    verdict: "what the three finest values say" = row.own.verdict.clone();

    /// What a quantity is.
    NAMES: own as Quantity;
    quantity = own.name.clone(), Always "quantity" Plain;
    unit = Some(own.unit.clone()).filter(|unit| !unit.is_empty()), IfAny "unit" Plain;

    /// What the levels say of a quantity.
    VERDICTS: own as Quantity;
    extrapolated = own.extrapolated, Always "extrapolated" Significant(7);
    order = own.order, Always "order" Fixed(2);
    error = own.error(own.values.len() - 1), IfAny "error" Significant(3);
    spread = own.spread, Always "spread" Significant(4);
    verdict = own.verdict.clone(), Always "verdict" Plain;
}

impl Series {
    fn heading(&self) -> String {
        format!("{} over the {}", self.analysis, self.refinement.name().replace('-', " "))
    }

    fn rows(&self) -> impl Iterator<Item = Row> + '_ {
        let row = |own: &Quantity, level: usize| Row {
            series: (
                self.analysis.clone(),
                self.refinement,
                self.levels[level].clone(),
                self.sizes[level],
            ),
            level,
            own: own.clone(),
        };
        let levels = self.levels.len();
        self.quantities.iter().flat_map(move |own| (0..levels).map(move |level| row(own, level)))
    }

    /// All quantities, or those that matter, and how many are left out.
    fn section(&self, is_whole: bool) -> Section {
        let is_shown = |own: &&Quantity| is_whole || !own.is_minor;
        let (shown, left): (Vec<&Quantity>, Vec<_>) = self.quantities.iter().partition(is_shown);
        let orders = left.iter().filter_map(|own| own.order);
        let (low, high) = frictionsim_chart::extremes(orders);
        let range = (low <= high).then(|| format!(" (orders {low:.2} to {high:.2})"));
        let said = (!left.is_empty()).then(|| {
            format!(
                "{} quantities of modes that do not grow are in convergence.csv; --verbose lists them{}",
                left.len(),
                range.unwrap_or_default()
            )
        });
        let names = shown.iter().copied();
        let mut table = Table::new("", self.heading()).columns(NAMES, names.clone());
        for (at, level) in self.levels.iter().enumerate() {
            let values = names.clone().map(|own| own.values[at]);
            table = table.column(level, Some((level, Format::Significant(7))), values);
        }
        Section::new(self.heading())
            .text(self.notes.iter().cloned())
            .text(said)
            .tables([table.columns(VERDICTS, names)])
    }
}

impl ConvergenceSummary {
    /// All quantities of every series, or those that matter.
    pub fn told(&self, is_whole: bool) -> Document {
        let figure = Section::new("Convergence").figures(["convergence"]);
        let document = Document::new("Convergence").section(figure);
        let series = self.series.iter().map(|own| own.section(is_whole));
        let rows = self.series.iter().flat_map(Series::rows);
        series
            .fold(document, Document::section)
            .file(Table::new("convergence.csv", "").columns(ROWS, rows))
    }
}

impl Finding for ConvergenceSummary {
    fn document(&self) -> Document {
        self.told(true)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(convergence(&self.series)))]
    }
}

/// For each series the change of every quantity from level to level, relative to its size, over the resolution; and the
/// orders that the three finest levels show.
fn convergence(series: &[Series]) -> Figure {
    let panels = series.iter().flat_map(|series| [changes(series), orders(series)]);
    Figure::new(
        "convergence",
        "Relative change of every quantity from each level to the next (left). Observed orders of \
         convergence from the three finest levels (right), for each study.",
    )
    .columns(2)
    .panels(panels)
    .note("dotted: whole orders; a quantity whose changes do not fall has no order, and none is shown")
}

fn changes(series: &Series) -> Panel {
    let groups = groups(series);
    let size = match series.refinement {
        Refinement::Mesh => Axis::new("element size", "m"),
        Refinement::TimeStep => Axis::new("time step", "s"),
    };
    let lines = series.quantities.iter().filter_map(|quantity| {
        let values = quantity.values.iter().map(|value| value.unwrap_or(f64::NAN));
        let values: Vec<f64> = values.collect();
        let largest = values.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let index = groups.iter().position(|group| *group == group_of(quantity))?;
        let pairs = series.sizes.iter().zip(values.windows(2));
        let changes = pairs.map(|(&size, pair)| (size, (pair[1] - pair[0]).abs() / largest));
        let line = Line::through(changes.filter(|(_, change)| *change > 0.0));
        Some(line.solid(look(index).0, 0.6).marked(look(index).1, 1.2).name(groups[index]))
    });
    Panel::new(size.prefixed().logarithmic(), Axis::new("relative change", "–").decades(10.0))
        .height(130.0)
        .caption(series.heading())
        .legend()
        .layers(lines)
}

fn orders(series: &Series) -> Panel {
    let groups = groups(series);
    let count = groups.len();
    let row = |index: usize| (count - index) as f64 - 0.5;
    let names = groups.iter().enumerate().map(|(index, group)| (row(index), (*group).to_owned()));
    let y = Axis::new("", "").between(0.0, count.max(1) as f64).ticks(names);
    let points = groups.iter().enumerate().map(|(index, group)| {
        let all = series.quantities.iter().filter(|q| group_of(q) == *group);
        let own: Vec<f64> = all.filter_map(|q| q.order).collect();
        // Side by side within the row, in the order of the list.
        let place = |k: usize| row(index) + 0.6 * (0.5 - (k as f64 + 0.5) / own.len() as f64);
        let points: Vec<(f64, f64)> =
            own.iter().enumerate().map(|(k, &order)| (order, place(k))).collect();
        Points::new(points).marker(look(index).1, 1.6, look(index).0)
    });
    let rules =
        [1.0, 2.0, 3.0, 4.0].map(|order| Rule::vertical(order).stroke(Stroke::dotted(MUTED, 0.6)));
    Panel::new(Axis::new("observed order", "–").including(0.0).including(2.5), y)
        .height(130.0)
        .layers(rules)
        .layers(points)
}

/// What quantities have in common: the same property of several modes, else the same unit.
fn group_of(quantity: &Quantity) -> &str {
    match (quantity.name.split_once(", "), quantity.unit.as_str()) {
        (Some((property, _)), _) => property,
        (None, "Hz") => "frequency",
        (None, "W" | "W/m") => "power",
        (None, _) => "fractions and shares",
    }
}

fn groups(series: &Series) -> Vec<&str> {
    distinct(series.quantities.iter().map(group_of))
}
