//! The eigenvalues in the complex plane, and where they are unstable.

use super::branches::{Branch, branch_of, branches, interval_rows, pieces};
use super::{CeaReport, direction_name};
use crate::common::*;
use frictionsim_chart::{Steps, significant};
use frictionsim_physics::fem::RayleighDamping;

/// Damping that regions of a body have, with the mark-up that names it.
pub type NamedDamping = (String, RayleighDamping);

/// How much further to the left than the right end, or than where nine tenths of the eigenvalues begin, the plane is
/// shown.
const LEFT_SHARE: f64 = 3.0;

/// The ends of the real axis, Hz, and how many eigenvalues lie left of them: a few strongly damped ones must not push
/// all others together.
fn real_ends(reals: &[f64]) -> (f64, f64, usize) {
    let mut sorted: Vec<f64> = reals.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else { return (-1.0, 1.0, 0) };
    let usual = sorted[sorted.len() / 10];
    let furthest = -LEFT_SHARE * high.max(-usual).max(f64::MIN_POSITIVE);
    let left = low.max(furthest).min(0.0);
    let right = high.max(0.0);
    let room = 0.06 * (right - left).max(f64::MIN_POSITIVE);
    let hidden = sorted.partition_point(|&v| v < left - room);
    (left - room, right + room, hidden)
}

/// The curves on which modes without friction lie, one for each damping: (5) of the paper, with the undamped frequency
/// as parameter.
fn damping_curves(dampings: &[NamedDamping], highest_hz: f64) -> Vec<Line> {
    let curve = |(index, (name, damping)): (usize, &NamedDamping)| {
        let undamped = (1..=400).map(|step| TAU * 1.05 * highest_hz * f64::from(step) / 400.0);
        let points = undamped.filter_map(|omega| {
            let factor = damping.damping_factor(omega);
            let root = (factor < 1.0).then(|| (1.0 - factor * factor).sqrt())?;
            Some((-factor * omega / TAU, omega * root / TAU))
        });
        let stroke = match index {
            0 => Stroke::dashed(INK, 0.8),
            _ => Stroke::dotted(look(index + 1).0, 0.9),
        };
        Line::through(points).stroke(stroke).name(name.clone())
    };
    dampings.iter().enumerate().map(curve).collect()
}

/// The eigenvalues in the complex plane as friction rises, with the curves of Rayleigh damping on which they start, and
/// beside it the friction intervals in which each branch grows.
pub(super) fn locus(report: &CeaReport<'_>, dampings: &[NamedDamping]) -> Figure {
    let sweep = &report.solution.sweep;
    let place = |mode: &ComplexMode| (mode.real_hz(), mode.frequency_hz());
    let reals: Vec<f64> = report.modes().map(|(.., mode)| mode.real_hz()).collect();
    let (left, right, hidden) = real_ends(&reals);
    let (lowest, highest) = extremes(report.modes().map(|(.., mode)| mode.frequency_hz()));
    let points = sweep.points.iter();
    let first = points.clone().map(|p| p.friction_coefficient).fold(f64::INFINITY, f64::min);

    // Branches with their numbers at the ends of those that turn unstable.
    let unstable: BTreeSet<Branch> = sweep.intervals.iter().map(branch_of).collect();
    let all_branches = branches(sweep);
    let curves = all_branches.iter().flat_map(|(branch, points)| {
        let turns = unstable.contains(branch) && points.len() > 2;
        let pieces = pieces(points, sweep, report.contact_changes).into_iter();
        pieces.filter(|piece| piece.len() > 1).map(move |piece| {
            let line = Line::through(piece.iter().map(|(_, mode)| place(mode)));
            let line = line.solid("#b5b5b5", 0.5).arrows(2 * usize::from(turns));
            line.name("branch; with arrows: turns unstable as *μ* rises")
        })
    });
    let labels = unstable.iter().filter_map(|branch| {
        let (_, mode) = all_branches.get(branch)?.last()?;
        let style = TextStyle::new(7.0).bold().with_halo();
        Some(Label::new(place(mode), report.mode_number(*branch)?.to_string()).style(style))
    });

    // The eigenvalues, each with what it is.
    let marked = |is_own: &dyn Fn(f64, &ComplexMode) -> bool| {
        let own = || report.modes().filter(|(mu, _, mode)| is_own(*mu, mode));
        let tips = own().map(|(mu, _, mode)| tip(report, mu, mode));
        Points::new(own().map(|(.., mode)| place(mode))).tips(tips.collect())
    };
    let imaginary = Axis::new("Im(*λ*) / 2π", "kHz").times(1e-3);
    let plane = Panel::new(
        Axis::new("Re(*λ*) / 2π", "Hz").between(left, right),
        imaginary.between(0.85 * lowest.min(0.9 * highest), 1.04 * highest),
    )
    .height(250f64.max(30.0 + 13.0 * interval_rows(sweep).len() as f64))
    .layer(Rule::vertical(0.0).stroke(Stroke::solid(INK, 0.6)))
    .layers(damping_curves(dampings, highest))
    .layers(curves)
    .layer(marked(&|_, mode| !mode.is_unstable()).marker(Marker::Disc, 0.9, STABLE).name("stable"))
    .layer(
        marked(&|_, mode| mode.is_unstable())
            .marker(Marker::Diamond, 1.15, UNSTABLE)
            .name("unstable, Re(*λ*) > 0"),
    )
    .layer(
        marked(&|mu, _| mu == first && points.len() > 1)
            .marker(Marker::Circle, 1.7, MUTED)
            .name(format!("lowest friction, *μ* = {}", signed(first, 2))),
    )
    .layers(labels);
    with_notes(figure_of(report, plane).steps(steps(report)), report, hidden)
}

/// The plane, and beside it the bars of instability where there are any.
fn figure_of(report: &CeaReport<'_>, plane: Panel) -> Figure {
    if report.solution.sweep.intervals.is_empty() {
        let caption =
            "Eigenvalues in the complex plane as friction rises; no branch turns unstable.";
        return Figure::new("locus", caption).panel(plane);
    }
    let caption = "Eigenvalues in the complex plane as friction rises (a); branches that turn unstable have the number \
        of their mode. The friction interval in which each of them is unstable, from its critical friction (b).";
    Figure::new("locus", caption).weighted(&[1.35, 1.0]).panel(plane).panel(stability_bars(report))
}

fn with_notes(figure: Figure, report: &CeaReport<'_>, hidden: usize) -> Figure {
    let own = report.own_point().map_or(f64::NAN, |point| point.friction_coefficient);
    let mut figure =
        figure.note(format!("mode numbers: order of frequency at *μ* = {}", signed(own, 2)));
    if !report.contact_changes.is_empty() {
        figure = figure.note("curves end where contact nodes open or close");
    }
    let words = [
        "eigenvalue of a strongly damped mode lies further left",
        "eigenvalues of strongly damped modes lie further left",
    ];
    if hidden > 0 { figure.note(plural(hidden, words)) } else { figure }
}

/// A mode in words: its name, friction, stability.
fn tip(report: &CeaReport<'_>, friction: f64, mode: &ComplexMode) -> String {
    let name = wave(report, mode).unwrap_or_else(|| format!("branch {}", mode.branch));
    let rate = TAU * mode.real_hz();
    let verb = if mode.is_unstable() { "grows" } else { "decays" };
    format!(
        "{name}, friction {}, {verb} at {} 1/s",
        significant(friction, 4),
        significant(rate.abs(), 4)
    )
}

/// A wave and how it travels, in words; none on a body without harmonics.
fn wave(report: &CeaReport<'_>, mode: &ComplexMode) -> Option<String> {
    let way = match mode.direction {
        0 => "standing".to_owned(),
        direction => format!("{} the rotor", direction_name(direction)),
    };
    let name = || format!("n = {}, branch {}, {way}", mode.harmonic, mode.branch);
    report.has_harmonics.then(name)
}

/// The eigenvalues at each friction value, for a reader who moves it.
fn steps(report: &CeaReport<'_>) -> Steps {
    let mark = |mode: &ComplexMode| {
        let branch = wave(report, mode).map_or(String::new(), |wave| wave + ", ");
        let (frequency, rate) = (mode.frequency_hz(), TAU * mode.real_hz());
        let verb = if rate > 0.0 { "grows" } else { "decays" };
        Mark {
            place: (mode.real_hz(), frequency),
            name: format!("{branch}{frequency:.1} Hz, {verb} at {:.1} 1/s", rate.abs()),
            is_listed: mode.is_unstable(),
        }
    };
    let points = &report.solution.sweep.points;
    let marks = points.iter().map(|point| point.modes.iter().map(mark).collect());
    Steps {
        quantity: "friction coefficient".into(),
        values: points.iter().map(|point| point.friction_coefficient).collect(),
        marks: marks.collect(),
    }
}

fn stability_bars(report: &CeaReport<'_>) -> Panel {
    let sweep = &report.solution.sweep;
    let solved = sweep.points.iter().map(|p| p.friction_coefficient);
    // An onset may lie below the values asked for.
    let onsets = sweep.intervals.iter().map(|own| own.critical_friction);
    let (low, high) = extremes(solved.chain(onsets));
    let rows = interval_rows(sweep);
    let names = rows.iter().enumerate().map(|(row, (branch, intervals))| {
        let number = report.mode_number(*branch);
        let number = number.map_or(String::new(), |number| format!("{number}: "));
        let frequency = signed(intervals[0].frequency_hz * 1e-3, 2);
        let n = if report.has_harmonics { format!(", *n* = {}", branch.0) } else { String::new() };
        (row as f64 + 0.5, format!("{number}{frequency} kHz{n}"))
    });
    let y = Axis::new("", "").between(0.0, rows.len().max(1) as f64).ticks(names);
    let bars = rows.iter().enumerate().flat_map(|(row, (_, intervals))| {
        intervals.iter().map(move |interval| {
            let end = interval.restabilized.map_or(high, |(friction, _)| friction);
            let from = signed(interval.critical_friction, 3);
            let label = if interval.is_located() { from } else { format!("≤ {from}") };
            (interval.critical_friction, end, row as f64 + 0.5, label)
        })
    });
    Panel::new(Axis::friction().between(low, high), y)
        .caption("unstable from critical *μ*")
        .layer(Bars::new(bars.collect(), UNSTABLE))
}
