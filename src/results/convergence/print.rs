//! A convergence study as text.

use super::{ConvergenceReport, Quantity, Refinement, Series, Verdict};
use std::fmt::Write as _;

/// The report as text: one table for each series.
pub fn print(report: &ConvergenceReport) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    for series in &report.series {
        out.push('\n');
        write_series(&mut out, series);
    }
    let _ = writeln!(out, "{:.3} s", report.wall_s);
    out
}

fn write_series(out: &mut String, series: &Series) {
    let what = match series.refinement {
        Refinement::Mesh => "mesh",
        Refinement::TimeStep => "time step",
    };
    let _ = writeln!(out, "{} over the {what}", series.analysis);
    let width = series.quantities.iter().map(|q| heading(q).chars().count());
    let width = width.max().unwrap_or(0).max(8);
    let _ = write!(out, "{:<width$}", "quantity");
    for level in &series.levels {
        let _ = write!(out, " {level:>12}");
    }
    let _ = writeln!(
        out,
        " {:>12} {:>6} {:>10}",
        "extrapolated", "order", "error"
    );
    for quantity in &series.quantities {
        let _ = write!(out, "{:<width$}", heading(quantity));
        for value in &quantity.values {
            let _ = write!(out, " {:>12}", significant(*value));
        }
        let _ = match quantity.verdict {
            Verdict::Converging { order, limit } => {
                let error = quantity.errors().last().copied().unwrap_or(f64::NAN);
                writeln!(
                    out,
                    " {:>12} {order:>6.2} {error:>10.2e}",
                    significant(limit)
                )
            }
            other => writeln!(
                out,
                " {}, spread {}",
                other.name(),
                significant(quantity.spread())
            ),
        };
    }
    for note in &series.notes {
        let _ = writeln!(out, "{note}");
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
    let digits = if value == 0.0 {
        0
    } else {
        value.abs().log10().floor() as i32
    };
    match digits {
        -4..=9 => format!("{value:.*}", (6 - digits).clamp(0, 7) as usize),
        _ => format!("{value:.4e}"),
    }
}
