//! Figures of branches of limit cycles, whose curves may turn back.

use super::branch::{BranchRecord, FamilyRecord};
use super::two_waves::TwoWaveResult;
use crate::chart::{
    Axis, ChartError, Figure, Line, MUTED, Marker, Panel, Points, Rule, SERIES, Scale, Stroke,
};
use crate::cycle::TwoWaveMotion;
use crate::output::significant;
use crate::results::charts::palette::{
    CONTACT_DISSIPATION, MATERIAL_DISSIPATION, NORMAL_POWER, SLIDE_POWER, STATUSES, STICK_POWER,
};
use crate::results::drawing::{Declaration, declared};
use crate::results::extent::Extent;
use crate::results::parameter::parameter_axis;

/// A family with what its name says besides the harmonic.
pub type NamedFamily<'a> = (String, &'a FamilyRecord);

/// Names and colours of the powers in the order of a branch's shares.
const POWERS: [(&str, &str); 5] = [
    ("stick", STICK_POWER),
    ("slide", SLIDE_POWER),
    ("dissipated in the contact", CONTACT_DISSIPATION),
    ("material damping", MATERIAL_DISSIPATION),
    ("normal contact", NORMAL_POWER),
];

/// Draws frequency, amplitude, statuses and powers along the branches of several families.
pub fn draw_branches(
    families: &[NamedFamily<'_>],
    two_waves: &[TwoWaveResult],
) -> Result<Vec<Figure>, ChartError> {
    // A branch of a single cycle is no curve.
    let curves: Vec<Curve<'_>> = families
        .iter()
        .filter_map(|(suffix, family)| {
            Some(Curve { suffix, family, branch: family.branch.as_ref()? })
        })
        .filter(|curve| curve.branch.values.len() > 1)
        .collect();
    let curves = &curves[..];
    let figures: Vec<Declaration<'_>> =
        vec![Box::new(|| frequencies(curves, two_waves)), Box::new(|| shares(curves))];
    declared(figures)
}

/// The branch of one family.
struct Curve<'a> {
    suffix: &'a str,
    family: &'a FamilyRecord,
    branch: &'a BranchRecord,
}

impl Curve<'_> {
    fn name(&self) -> String {
        if let Some(mode) = self.family.mode {
            return format!("mode {mode}{}", self.suffix);
        }
        let family = self.family.family().to_string();
        format!("*{}{}", family.replacen(' ', "* ", 1), self.suffix)
    }
}

/// Logarithmic over more than a decade.
fn axis_of(curves: &[Curve<'_>]) -> (Axis, Scale) {
    let key = curves.first().map_or("", |curve| &curve.branch.key);
    let values = curves.iter().flat_map(|curve| curve.branch.values.iter().copied());
    let scale = Scale::for_values(values, 10.0);
    (parameter_axis(key).scaled(scale), scale)
}

/// What the strokes of the curves mean, where any stability is known.
fn with_strokes(figure: Figure, curves: &[Curve<'_>]) -> Figure {
    let is_known = |curve: &Curve<'_>| curve.branch.stable.iter().any(Option::is_some);
    match curves.iter().any(is_known) {
        true => figure.note("strong lines: stable; dashed: unstable; thin: stability unknown"),
        false => figure,
    }
}

/// Frequencies and amplitudes of two waves.
const OF_BOTH: [fn(&TwoWaveMotion) -> [f64; 2]; 2] =
    [TwoWaveMotion::frequencies_hz, |motion| motion.amplitudes];

/// One quantity along a branch.
type Column = fn(&BranchRecord) -> &Vec<f64>;

/// Main frequency, amplitude and power of the limit cycles over the parameter, one curve for each family.
fn frequencies(curves: &[Curve<'_>], two_waves: &[TwoWaveResult]) -> Result<Figure, ChartError> {
    let (x, scale) = axis_of(curves);
    let amplitude = Axis::new("amplitude along the contact", "m").prefixed();
    let amplitude = if scale == Scale::Logarithmic {
        amplitude.logarithmic()
    } else {
        amplitude.including(0.0)
    };
    let onsets = curves.iter().filter_map(|curve| {
        let [critical, frequency] = *curve.family.onsets.get(curve.family.onset.checked_sub(1)?)?;
        let text = format!(
            "{:.2} kHz, *n* = {} at *μ* = {critical:.3}",
            frequency * 1e-3,
            curve.family.harmonic
        );
        Some((frequency, text))
    });
    let mut onsets: Vec<(f64, String)> = onsets.collect();
    onsets.dedup();
    let rules = onsets.into_iter().map(|(frequency, text)| {
        let rule = Rule::horizontal(frequency).stretching().stroke(Stroke::dotted(MUTED, 0.8));
        rule.at_rim(text).name("onset of the instability, linear theory")
    });
    let sliding = curves.iter().flat_map(|curve| &curve.branch.sliding_onsets);
    let sliding: Vec<Rule> = sliding
        .map(|&onset| {
            let rule = Rule::vertical(onset).stretching().stroke(Stroke::dotted(MUTED, 0.9));
            rule.name("onset: steady sliding loses its stability")
        })
        .collect();
    let extent = curves.first().map_or_else(Extent::default, |curve| curve.branch.extent);
    let panel =
        |y: Axis, height: f64| Panel::new(x.clone(), y).height(height).layers(sliding.clone());
    let frequency = Axis::new("main frequency *f*", "kHz").times(1e-3);
    let quantities: [(Panel, Column, Option<usize>); 3] = [
        (panel(frequency, 150.0).layers(rules), |b| &b.frequency_hz, Some(0)),
        (panel(amplitude, 92.0), |b| &b.amplitude, Some(1)),
        (
            panel(Axis::new("power of the counterface", &extent.unit("W")).prefixed(), 76.0),
            |b| &b.external,
            None,
        ),
    ];
    let panels = quantities.into_iter().map(|(panel, quantity, own)| {
        let of_both = own.map(|own| OF_BOTH[own]);
        let together = two_waves.iter().flat_map(|pair| of_both.map(|own| pair.curves(own)));
        let panel = panel.layers(together.flatten());
        curves.iter().enumerate().fold(panel, |panel, (index, curve)| {
            let (branch, colour) = (curve.branch, SERIES[index % SERIES.len()]);
            let ys = quantity(branch);
            let marked = curve.family.cycle.zip(own);
            let marked = marked.map(|(cycle, own)| (branch.own_value, cycle[own]));
            let threshold = branch.threshold.filter(|_| own == Some(1));
            let folds = Points::new(branch.fold_points(ys)).marker(Marker::Diamond, 1.9, colour);
            panel
                .layers(branch.lines(ys, colour))
                .layer(named_curve(curve, ys, colour))
                .layer(folds.name("fold"))
                .layers(marked.map(|own| {
                    Points::new([own])
                        .marker(Marker::Circle, 2.2, colour)
                        .name("the case's own cycle")
                }))
                .layers(threshold.map(|[amplitude, velocity]| {
                    Points::new([(branch.own_value, amplitude)])
                        .marker(Marker::Square, 2.2, colour)
                        .name(format!("a kick of more than {velocity:.3e} m/s tips sliding"))
                }))
        })
    });
    let both = curves.iter().flat_map(|curve| &curve.branch.coexistence);
    let both: String = both
        .map(|&[from, to]| {
            let [from, to] = [from, to].map(|value| significant(value, 4));
            format!(" Stable sliding and a limit cycle coexist from {from} to {to}.")
        })
        .collect();
    let caption = format!(
        "Main frequency (a), amplitude (b) and power of the counterface (c) of the limit cycles \
         along their branches. Dotted: where linear theory has them begin. Diamonds: folds.{both}"
    );
    let figure = Figure::new("branch-frequencies", caption).shared_x().panels(panels);
    Ok(with_strokes(figure, curves))
}

/// The branch as a thin line that carries its legend entry.
fn named_curve(curve: &Curve<'_>, ys: &[f64], colour: &'static str) -> Line {
    let points = curve.branch.values.iter().copied().zip(ys.iter().copied());
    Line::through(points).solid(colour, 0.3).name(curve.name())
}

/// Statuses and power shares of the limit cycles over the parameter, one column for each family.
fn shares(curves: &[Curve<'_>]) -> Result<Figure, ChartError> {
    let (x, _) = axis_of(curves);
    let percent = |name: &str| Axis::new(name, "%").times(100.0);
    let statuses = STATUSES.map(|(_, name, _, _, colour)| (name, colour));
    let panel = |curve: &Curve<'_>,
                 y: Axis,
                 series: &[Vec<f64>],
                 named: &[(&'static str, &'static str)]| {
        let folds = curve.branch.fold_places();
        let folds = folds.0.iter().chain(&folds.1).map(|place| Rule::vertical(place.value));
        let panel = Panel::new(x.clone(), y).height(104.0);
        let panel = panel.layers(
            folds
                .map(|rule| rule.stroke(Stroke::dotted(MUTED, 0.7)).name("fold"))
                .collect::<Vec<_>>(),
        );
        series.iter().zip(named).fold(panel, |panel, (values, &(name, colour))| {
            let points = curve.branch.values.iter().copied().zip(values.iter().copied());
            let named = Line::through(points).solid(colour, 0.4).name(name);
            panel.layer(named).layers(curve.branch.lines(values, colour))
        })
    };
    let mut figure = Figure::new(
        "branch-shares",
        "Contact status, and powers relative to the external one, along the branch of each family.",
    )
    .columns(curves.len().clamp(1, 3))
    .shared_y();
    for row in curves.chunks(3) {
        let fill = |figure: Figure| {
            (row.len()..curves.len().min(3)).fold(figure, |figure, _| figure.panel_or_gap(None))
        };
        let status = |curve: &Curve<'_>| {
            panel(
                curve,
                percent("contact nodes").between(0.0, 1.0),
                &curve.branch.status,
                &statuses,
            )
            .heading(curve.name())
        };
        let power = |curve: &Curve<'_>| {
            panel(
                curve,
                percent("share of external power").including(0.0).including(1.0),
                &curve.branch.shares,
                &POWERS,
            )
        };
        figure = fill(figure.panels(row.iter().map(status)));
        figure = fill(figure.panels(row.iter().map(power)));
    }
    Ok(with_strokes(figure, curves))
}
