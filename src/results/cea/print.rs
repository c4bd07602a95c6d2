//! The table that a person reads.

use super::branches::branch_of;
use super::{CeaReport, MeshError, direction_name};
use crate::cea::{ComplexMode, FrictionPoint, UnstableInterval};
use std::fmt::Write as _;

/// Longest table of the modes at one friction value.
const MOST_MODES: usize = 40;

/// The report as text: one line for each mode at the case's own friction, totals, and last the critical frictions.
/// With `is_whole` also the unstable modes of every friction value.
pub fn print(report: &CeaReport<'_>, is_whole: bool) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    let _ = writeln!(
        out,
        "complex eigenvalues, {}, {} unknowns, {} method\n",
        report.selection, report.dofs, report.method
    );
    if is_whole {
        unstable_modes(&mut out, report);
    } else {
        own_modes(&mut out, report);
    }
    totals(&mut out, report);
    mesh_errors(&mut out, report);
    critical_frictions(&mut out, report);
    out
}

/// The modes at the case's own friction, or at the solved value nearest to it; of many only the unstable ones.
fn own_modes(out: &mut String, report: &CeaReport<'_>) {
    let own = report.base.friction_coefficient;
    let distance = |point: &&FrictionPoint| (point.friction_coefficient - own).abs();
    let mut points: Vec<&FrictionPoint> = report.sweep.points.iter().collect();
    points.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let Some(point) = points.first() else {
        return;
    };
    let unstable = point.modes.iter().filter(|mode| mode.is_unstable()).count();
    let is_short = point.modes.len() <= MOST_MODES;
    let _ = writeln!(
        out,
        "friction {}: {} modes, {unstable} unstable{}",
        point.friction_coefficient,
        point.modes.len(),
        if is_short { "" } else { " (listed; --verbose lists those of every friction value)" },
    );
    head(out, "", Names::of(report));
    for (index, mode) in point.modes.iter().enumerate() {
        if is_short || mode.is_unstable() {
            let mark = if mode.is_unstable() { "unstable" } else { "" };
            mode_line(out, mark, index, mode, Names::of(report));
        }
    }
}

/// What modes of a body are named by.
#[derive(Clone, Copy)]
enum Names {
    /// Harmonic, rank within it and sense of travel.
    Harmonics,
    /// Number of nodal diameters, and rank among all.
    Diameters,
    /// Rank alone.
    Ranks,
}

impl Names {
    fn of(report: &CeaReport<'_>) -> Self {
        let mut modes = report.sweep.points.iter().flat_map(|point| &point.modes);
        match report.has_harmonics {
            true => Self::Harmonics,
            false if modes.any(|mode| mode.nodal_diameters.is_some()) => Self::Diameters,
            false => Self::Ranks,
        }
    }
}

/// The head of a table of modes; without symmetry they have neither harmonic nor sense of travel.
fn head(out: &mut String, first: &str, names: Names) {
    let [names, units] = match names {
        Names::Harmonics => {
            [format!("{:>3} {:>6}  {:<8} ", "n", "branch", "travels"), " ".repeat(21)]
        }
        Names::Diameters => [format!("{:>3} {:>6} ", "n", "branch"), " ".repeat(11)],
        Names::Ranks => [format!("{:>6} ", "branch"), " ".repeat(7)],
    };
    let _ = writeln!(
        out,
        "{first:>9}  {:>4}  {names}{:>12} {:>12} {:>11}",
        "mode", "frequency", "growth rate", "damping"
    );
    let _ =
        writeln!(out, "{:>9}  {:>4}  {units}{:>12} {:>12} {:>11}", "", "", "Hz", "1/s", "factor");
}

fn mode_line(out: &mut String, first: &str, index: usize, mode: &ComplexMode, names: Names) {
    let name = match names {
        Names::Harmonics => format!(
            "{:>3} {:>6}  {:<8} ",
            mode.harmonic,
            mode.branch,
            direction_name(mode.direction)
        ),
        Names::Diameters => {
            let diameters = mode.nodal_diameters.unwrap_or(0);
            format!("{diameters:>3} {:>6} ", mode.branch)
        }
        Names::Ranks => format!("{:>6} ", mode.branch),
    };
    let _ = writeln!(
        out,
        "{first:>9}  {:>4}  {name}{:>12.2} {:>12.2} {:>11.3e}",
        index + 1,
        mode.frequency_hz(),
        mode.growth_rate(),
        mode.damping_factor(),
    );
}

/// One block for each friction value; neighbouring values without instability share a line.
fn unstable_modes(out: &mut String, report: &CeaReport<'_>) {
    head(out, "friction", Names::of(report));
    let mut stable: Option<(f64, f64)> = None;
    for point in report.tabulated() {
        if point.modes.iter().any(|mode| mode.is_unstable()) {
            stable_line(out, stable.take());
            unstable_lines(out, point, Names::of(report));
        } else {
            let friction = point.friction_coefficient;
            stable = Some((stable.map_or(friction, |range| range.0), friction));
        }
    }
    stable_line(out, stable);
}

fn stable_line(out: &mut String, range: Option<(f64, f64)>) {
    let _ = match range {
        Some((first, last)) if first == last => writeln!(out, "{first:>9}  stable"),
        Some((first, last)) => writeln!(out, "{first:>9}  stable up to {last}"),
        None => return,
    };
}

fn unstable_lines(out: &mut String, point: &FrictionPoint, names: Names) {
    let mut friction = point.friction_coefficient.to_string();
    for (index, mode) in point.modes.iter().enumerate() {
        if !mode.is_unstable() {
            continue;
        }
        mode_line(out, &friction, index, mode, names);
        friction.clear();
    }
}

fn critical_frictions(out: &mut String, report: &CeaReport<'_>) {
    let intervals = &report.sweep.intervals;
    if intervals.is_empty() {
        let first = report.friction_coefficients.first().copied().unwrap_or(0.0);
        let last = report.friction_coefficients.last().copied().unwrap_or(0.0);
        let _ = writeln!(out, "\nno mode turns unstable for friction from {first} to {last}");
        return;
    }
    let values = report.friction_coefficients.iter().copied();
    let lowest = values.fold(f64::INFINITY, f64::min);
    let numbers = report.mode_numbers();
    let names = Names::of(report);
    let name = |interval: &UnstableInterval| {
        let branch = branch_of(interval);
        let number = numbers.get(&branch).map_or("-".into(), usize::to_string);
        match names {
            Names::Harmonics => {
                format!("{:>3} {:>6}  {:<8}", branch.0, branch.1, direction_name(branch.2))
            }
            Names::Diameters => {
                let diameters = interval.nodal_diameters.unwrap_or(0);
                format!("{number:>4} {diameters:>3} {:>6}", branch.1)
            }
            Names::Ranks => format!("{number:>4} {:>6}", branch.1),
        }
    };
    let names = match names {
        Names::Harmonics => format!("{:>3} {:>6}  {:<8}", "n", "branch", "travels"),
        Names::Diameters => format!("{:>4} {:>3} {:>6}", "mode", "n", "branch"),
        Names::Ranks => format!("{:>4} {:>6}", "mode", "branch"),
    };
    let _ = writeln!(out, "\ncritical friction");
    let _ = writeln!(out, "{:>10}  {names} {:>12}  stable again at", "unstable >", "frequency Hz");
    for interval in intervals {
        let again = match interval.restabilized {
            Some((friction, frequency)) => format!("{friction:.6} ({frequency:.2} Hz)"),
            None => "-".to_owned(),
        };
        let critical = match (interval.unstable_from_start, interval.critical_friction) {
            (true, friction) if friction <= lowest => "start".to_owned(),
            // A branch with a new number, which was not followed to there.
            (true, friction) => format!("<={friction:.6}"),
            (false, friction) => format!("{friction:.6}"),
        };
        let _ = writeln!(
            out,
            "{critical:>10}  {} {:>12.2}  {again}",
            name(interval),
            interval.frequency_hz,
        );
    }
}

/// Estimated relative error of a frequency above which a mesh is too coarse for the estimate.
const COARSE: f64 = 0.05;

/// The largest error of the mesh in a frequency, and that of the lowest critical friction, where they were estimated.
fn mesh_errors(out: &mut String, report: &CeaReport<'_>) {
    let Some(reading) = &report.reading else {
        return;
    };
    let share = |own: &&MeshError| (own.frequency_hz / own.of_hz).abs();
    let all = reading.mesh_errors.iter();
    let Some(worst) = all.max_by(|a, b| share(a).total_cmp(&share(b))) else {
        return;
    };
    let _ = write!(
        out,
        "error of the mesh, estimated: frequencies up to {:+.2} Hz ({:.2} %, mode {} at friction {})",
        worst.frequency_hz,
        100.0 * share(&worst),
        worst.mode,
        worst.friction_coefficient,
    );
    if share(&worst) > COARSE {
        let _ = writeln!(out, ": too coarse for more than an order of magnitude of it");
        return;
    }
    let first = report.sweep.intervals.iter().zip(&reading.onset_errors);
    let mut first = first.filter_map(|(interval, error)| Some((interval, (*error)?)));
    let _ = match first.next() {
        Some((interval, error)) => {
            writeln!(out, ", critical friction {error:+.1e} of {:.6}", interval.critical_friction)
        }
        None => writeln!(out),
    };
}

/// So many friction values, in words.
pub(super) fn friction_values(count: usize) -> String {
    match count {
        1 => "1 friction value".to_owned(),
        count => format!("{count} friction values"),
    }
}

fn totals(out: &mut String, report: &CeaReport<'_>) {
    let (fewest, most) = report.mode_counts();
    let modes = if fewest == most { most.to_string() } else { format!("{fewest} to {most}") };
    let _ = writeln!(
        out,
        "\n{modes} modes ({}) at {}, largest residual {:.1e}",
        report.selection,
        friction_values(report.friction_coefficients.len()),
        report.largest_residual(),
    );
    let base = &report.base;
    let _ = write!(
        out,
        "steady sliding at friction {}: {} contact {} slipping, {} sticking, {} open; ",
        base.friction_coefficient,
        base.slipping,
        // Solid bodies touch at points between their nodes.
        if report.assembly.is_some() { "points" } else { "nodes" },
        base.sticking,
        base.open,
    );
    let _ = match report.assembly {
        Some(assembly) if assembly.is_free_of_stress() => writeln!(out, "free of stress"),
        _ => writeln!(
            out,
            "pressure {} to {} MPa; {}, {}",
            megapascal(base.pressure_pa[0]),
            megapascal(base.pressure_pa[1]),
            base.drive(),
            base.power(),
        ),
    };
    if let Some(note) = base.extent.note() {
        let _ = writeln!(out, "{note}");
    }
    if let Some(sensitivities) = report.sensitivities {
        let _ = writeln!(out, "{}", sensitivities.print());
    }
    let friction = report.base.friction_coefficient;
    let reading = report.reading.iter();
    for sentence in reading.flat_map(|reading| reading.sentences(friction, 1)) {
        let _ = writeln!(out, "{sentence}");
    }
    if let Some(map) = report.map {
        let _ = writeln!(out, "{}", map.print());
    }
    for note in &report.notes {
        let _ = writeln!(out, "{note}");
    }
    let _ = writeln!(out, "{:.3} s", report.wall_s);
}

fn megapascal(pressure: f64) -> String {
    format!("{:.4}", pressure * 1e-6)
}
