//! The eigenvalues in the complex plane, and where they are unstable.

use super::branches::{Branch, branch_of, branches, interval_rows};
use super::{CeaReport, direction_name};
use crate::cea::{ComplexMode, FrictionSweep};
use crate::chart::{
    Axis, Bars, Figure, INK, Label, Line, MUTED, Mark, Marker, Panel, Points, Rule, Steps, Stroke,
    TextStyle, extremes, signed,
};
use crate::fem::RayleighDamping;
use crate::results::charts::palette::{STABLE, UNSTABLE};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Number of each branch's mode in the table at the friction value next to the case's own.
fn mode_numbers(report: &CeaReport<'_>) -> BTreeMap<Branch, usize> {
    let distance = |mu: f64| (mu - report.base.friction_coefficient).abs();
    let nearest = report.sweep.points.iter().min_by(|a, b| {
        distance(a.friction_coefficient).total_cmp(&distance(b.friction_coefficient))
    });
    let modes = nearest
        .into_iter()
        .flat_map(|point| &point.modes)
        .enumerate();
    let of = |mode: &ComplexMode| (mode.harmonic, mode.branch, mode.direction);
    modes.map(|(index, mode)| (of(mode), index + 1)).collect()
}

/// The eigenvalues in the complex plane as friction rises, with the curve of Rayleigh damping on which they start, and beside
/// it the friction intervals in which each branch grows.
pub(super) fn locus(report: &CeaReport<'_>, damping: RayleighDamping) -> Figure {
    let sweep = report.sweep;
    let place = |mode: &ComplexMode| (mode.real_hz(), mode.frequency_hz());
    let all = || sweep.points.iter().flat_map(|point| &point.modes);
    let highest = extremes(all().map(ComplexMode::frequency_hz)).1;
    let first = sweep
        .points
        .iter()
        .map(|p| p.friction_coefficient)
        .fold(f64::INFINITY, f64::min);
    let start = sweep
        .points
        .iter()
        .filter(|point| point.friction_coefficient == first);
    let numbers = mode_numbers(report);
    let unstable: Vec<Branch> = sweep.intervals.iter().map(branch_of).collect();
    let all_branches = branches(sweep);
    let curves = all_branches.iter().map(|(branch, points)| {
        let arrows = 2 * usize::from(unstable.contains(branch) && points.len() > 2);
        let line = Line::through(points.iter().map(|(_, mode)| place(mode))).arrows(arrows);
        let line = line.solid("#b5b5b5", 0.5);
        if arrows > 0 {
            line.name("branch that turns unstable, *μ* rising along the arrow")
        } else {
            line
        }
    });
    let labels = unstable.iter().filter_map(|branch| {
        let (_, mode) = all_branches.get(branch)?.last()?;
        let style = TextStyle::new(7.0).bold().with_halo();
        Some(Label::new(place(mode), numbers.get(branch)?.to_string()).style(style))
    });
    let undamped = (1..=400).map(|step| TAU * 1.05 * highest * f64::from(step) / 400.0);
    let rayleigh = undamped.filter_map(|omega| {
        // (5): the curve through (3) and (4), with the undamped frequency as parameter.
        let factor = damping.damping_factor(omega);
        let root = (factor < 1.0).then(|| (1.0 - factor * factor).sqrt())?;
        Some((-factor * omega / TAU, omega * root / TAU))
    });
    let lowest = extremes(all().map(ComplexMode::frequency_hz)).0;
    let real = Axis::new("Re(*λ*) / 2π", "Hz").room(0.06).including(0.0);
    let imaginary = Axis::new("Im(*λ*) / 2π", "kHz").times(1e-3);
    let plane = Panel::new(
        real,
        imaginary.between(0.85 * lowest.min(0.9 * highest), 1.04 * highest),
    )
    .height(250f64.max(30.0 + 13.0 * interval_rows(sweep).len() as f64))
    .layer(Rule::vertical(0.0).stroke(Stroke::solid(INK, 0.6)))
    .layer(
        Line::through(rayleigh)
            .stroke(Stroke::dashed(INK, 0.8))
            .name("damping *ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2"),
    )
    .layers(curves)
    .layer(
        Points::new(all().filter(|m| !m.is_unstable()).map(place))
            .marker(Marker::Disc, 0.9, STABLE)
            .name("stable"),
    )
    .layer(
        Points::new(all().filter(|m| m.is_unstable()).map(place))
            .marker(Marker::Diamond, 1.15, UNSTABLE)
            .name("unstable, Re(*λ*) > 0"),
    )
    .layer(
        Points::new(start.flat_map(|p| &p.modes).map(place))
            .marker(Marker::Circle, 1.7, MUTED)
            .name(format!("lowest friction, *μ* = {}", signed(first, 2))),
    )
    .layers(labels);
    Figure::new(
        "locus",
        "Eigenvalues in the complex plane as friction rises (a), branches that turn unstable with the number of their mode, and \
         the friction interval in which each of them is unstable, with its critical friction (b).",
    )
    .weighted(&[1.35, 1.0])
    .panel(plane)
    .panel(stability_bars(sweep, &numbers))
    .steps(steps(report))
    .note(format!("mode numbers: order of frequency at *μ* = {}", signed(report.base.friction_coefficient, 2)))
}

/// The eigenvalues at each friction value, for a reader who moves it.
fn steps(report: &CeaReport<'_>) -> Steps {
    let mark = |mode: &ComplexMode| {
        let branch = match report.has_harmonics {
            true => format!(
                "n = {}, branch {}, {} the rotor, ",
                mode.harmonic,
                mode.branch,
                direction_name(mode.direction)
            ),
            false => String::new(),
        };
        let (frequency, rate) = (mode.frequency_hz(), TAU * mode.real_hz());
        Mark {
            place: (mode.real_hz(), frequency),
            name: match rate > 0.0 {
                true => format!("{branch}{frequency:.1} Hz, grows at {rate:.1} 1/s"),
                false => format!("{branch}{frequency:.1} Hz, decays at {:.1} 1/s", rate.abs()),
            },
            is_listed: mode.is_unstable(),
        }
    };
    let points = &report.sweep.points;
    let marks = points
        .iter()
        .map(|point| point.modes.iter().map(mark).collect());
    Steps {
        quantity: "friction coefficient".into(),
        values: points
            .iter()
            .map(|point| point.friction_coefficient)
            .collect(),
        marks: marks.collect(),
    }
}

fn stability_bars(sweep: &FrictionSweep, numbers: &BTreeMap<Branch, usize>) -> Panel {
    let (low, high) = extremes(sweep.points.iter().map(|p| p.friction_coefficient));
    let rows = interval_rows(sweep);
    let names = rows.iter().enumerate().map(|(row, (branch, intervals))| {
        let number = numbers
            .get(branch)
            .map_or(String::new(), |number| format!("{number}: "));
        let frequency = signed(intervals[0].frequency_hz * 1e-3, 2);
        (
            row as f64 + 0.5,
            format!("{number}{frequency} kHz, *n* = {}", branch.0),
        )
    });
    let y = Axis::new("", "")
        .between(0.0, rows.len().max(1) as f64)
        .ticks(names.collect::<Vec<_>>());
    let bars = rows.iter().enumerate().flat_map(|(row, (_, intervals))| {
        intervals.iter().map(move |interval| {
            let end = interval.restabilized.map_or(high, |(friction, _)| friction);
            let from = signed(interval.critical_friction, 3);
            let label = if interval.unstable_from_start {
                format!("≤ {from}")
            } else {
                from
            };
            (interval.critical_friction, end, row as f64 + 0.5, label)
        })
    });
    let caption = if rows.is_empty() {
        "no branch turns unstable"
    } else {
        "unstable from critical *μ*"
    };
    Panel::new(Axis::friction().between(low, high), y)
        .caption(caption)
        .layer(Bars::new(bars.collect(), UNSTABLE))
}
