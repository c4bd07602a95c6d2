//! A convergence study as text.

use super::{ConvergenceReport, Quantity, Refinement, Series, Verdict};
use std::fmt::Write as _;

/// The report as text: one table for each series, of all quantities or of those that matter.
pub fn print(report: &ConvergenceReport, is_whole: bool) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    for series in &report.series {
        out.push('\n');
        write_series(&mut out, series, is_whole);
    }
    let _ = writeln!(out, "{:.3} s", report.wall_s);
    out
}

fn write_series(out: &mut String, series: &Series, is_whole: bool) {
    let what = match series.refinement {
        Refinement::Mesh => "mesh",
        Refinement::TimeStep => "time step",
    };
    let _ = writeln!(out, "{} over the {what}", series.analysis);
    let all = series.quantities.iter();
    let (shown, left): (Vec<&Quantity>, Vec<_>) = all.partition(|q| is_whole || !q.is_minor);
    let width = shown.iter().map(|q| heading(q).chars().count());
    let width = width.max().unwrap_or(0).max(8);
    let _ = write!(out, "{:<width$}", "quantity");
    for level in &series.levels {
        let _ = write!(out, " {level:>12}");
    }
    let _ = writeln!(out, " {:>12} {:>6} {:>10}", "extrapolated", "order", "error");
    for quantity in shown {
        write_quantity(out, quantity, width);
    }
    if !left.is_empty() {
        let _ = writeln!(
            out,
            "{} quantities of modes that do not grow are in convergence.csv; --verbose lists them{}",
            left.len(),
            range_of_orders(&left)
        );
    }
    for note in &series.notes {
        let _ = writeln!(out, "{note}");
    }
}

fn write_quantity(out: &mut String, quantity: &Quantity, width: usize) {
    let is_count = quantity.values.iter().all(|value| value.fract() == 0.0);
    let text = |value: f64| match is_count {
        true => format!("{value}"),
        false => significant(value),
    };
    let _ = write!(out, "{:<width$}", heading(quantity));
    for value in &quantity.values {
        let _ = write!(out, " {:>12}", text(*value));
    }
    let _ = match quantity.verdict {
        Verdict::Converging { order, limit } => {
            let error = quantity.errors().last().copied().unwrap_or(f64::NAN);
            let error = crate::results::quantity::significant(error, 3);
            writeln!(out, " {:>12} {order:>6.2} {error:>10}", text(limit))
        }
        Verdict::Settled => writeln!(out, " {}", quantity.verdict.name()),
        other => writeln!(out, " {}, spread {}", other.name(), text(quantity.spread())),
    };
}

/// Between which values the orders of some quantities lie, and how many of them have none.
fn range_of_orders(quantities: &[&Quantity]) -> String {
    let orders = quantities.iter().filter_map(|q| q.verdict.order());
    let orders: Vec<f64> = orders.collect();
    let low = orders.iter().copied().fold(f64::INFINITY, f64::min);
    let high = orders.iter().copied().fold(0.0, f64::max);
    let settled = quantities.iter().filter(|q| q.verdict == Verdict::Settled);
    let without = quantities.len() - orders.len() - settled.count();
    match (orders.is_empty(), without) {
        (true, _) => String::new(),
        (false, 0) => format!(" (orders {low:.2} to {high:.2})"),
        (false, some) => format!(" (orders {low:.2} to {high:.2}, {some} without)"),
    }
}

fn heading(quantity: &Quantity) -> String {
    match quantity.unit.as_str() {
        "" => quantity.name.clone(),
        unit => format!("{} ({unit})", quantity.name),
    }
}

/// Seven digits, without an exponent where there is room.
pub(super) fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let digits = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    match digits {
        -4..=9 => format!("{value:.*}", (6 - digits).clamp(0, 7) as usize),
        _ => format!("{value:.4e}"),
    }
}
