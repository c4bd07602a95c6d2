//! Branches of limit cycles over a parameter: rows, and figures of curves that may turn back.

use super::two_waves::TwoWaveRecord;
use crate::chart::{
    Axis, ChartError, Figure, INK, Line, MUTED, Marker, Panel, Points, Rule, SERIES, Scale, Stroke,
};
use crate::cycle::{Family, Verdict};
use crate::output::{Described, columns, significant};
use crate::results::charts::palette::{
    CONTACT_DISSIPATION, MATERIAL_DISSIPATION, NORMAL_POWER, SLIDE_POWER, STATUSES, STICK_POWER,
};
use crate::results::drawing::{Declaration, declared};
use crate::results::extent::Extent;
use crate::results::parameter::parameter_axis;
use crate::results::summary::MeanPowers;
use serde::{Deserialize, Serialize};

/// A cycle of a branch.
#[derive(Clone, Debug)]
pub(in crate::results) struct BranchRow {
    /// The parameter, in units of its key.
    pub value: f64,
    /// Circumferential harmonic of a wave.
    pub harmonic: Option<usize>,
    pub main_frequency_hz: f64,
    /// Fractions that stick, slip, are open.
    pub fractions: [f64; 3],
    pub powers: MeanPowers,
    pub amplitude_m: f64,
    pub balance_residual: f64,
    /// Growth rate of the leading perturbation, 1/s, where it is known.
    pub growth_rate: Option<f64>,
    pub verdict: Option<Verdict>,
    pub stepped: Option<SteppedRow>,
}

/// What else there is to a motion that was stepped in time.
#[derive(Clone, Copy, Debug)]
pub(in crate::results) struct SteppedRow {
    pub velocity_level_db: f64,
    pub residual: f64,
    pub periods: usize,
    pub fold: bool,
}

columns! {
    /// A cycle of a branch, behind the parameter.
    pub(in crate::results) BRANCH: row as BranchRow;
    harmonic: "circumferential harmonic of a wave" = row.harmonic;
    main_frequency_hz: "frequency" = row.main_frequency_hz;
    stick: "fraction of the contact that sticks" = row.fractions[0];
    slip: "fraction that slips" = row.fractions[1];
    open: "fraction that is open" = row.fractions[2];
    external_w: "power of the counterface" = row.powers.external;
    stick_w: "power given to the body by nodes that stick" = row.powers.stick;
    slide_w: "power given to the body by nodes that slide" = row.powers.slide;
    contact_dissipated_w: "power lost to friction" = row.powers.contact_dissipated;
    material_damping_w: "power lost in the body" = row.powers.material_damping;
    normal_contact_w: "power of the normal contact forces" = row.powers.normal_contact;
    amplitude_m: "amplitude along the counterface" = row.amplitude_m;
    velocity_level_db: "level of the velocity over 5e-8 m/s, of motions of the whole mesh"
        = row.stepped.map(|own| own.velocity_level_db);
    balance_residual: "residual of the energy balance, relative to the external power"
        = row.balance_residual;
    growth_rate_per_s: "growth rate of the leading perturbation, where it was asked for"
        = row.growth_rate;
    stability: "stable, unstable or undecided, where it was asked for"
        = row.verdict.map(Verdict::word);
    residual: "what the motion misses its start by, of motions of the whole mesh"
        = row.stepped.map(|own| own.residual);
    periods: "periods stepped to find it, of motions of the whole mesh"
        = row.stepped.map(|own| own.periods);
    fold: "whether the branch turns back here, of motions of the whole mesh"
        = row.stepped.map(|own| own.fold);
}

/// The limit cycles of one harmonic or mode.
#[derive(Clone, Debug, PartialEq, Described, Serialize, Deserialize)]
pub struct FamilyRecord {
    /// Circumferential harmonic; 0 of a body without rotating waves, whose cycles have a mode.
    pub harmonic: usize,
    /// Onset of that harmonic at which the cycles are born, from 1.
    pub onset: usize,
    /// The mode that leads to the cycles of a body without rotating waves.
    #[serde(default)]
    pub mode: Option<usize>,
    /// Critical friction and frequency (Hz) of every onset.
    pub onsets: Vec<[f64; 2]>,
    /// Frequency (Hz) and amplitude (m) of the cycle at the case's own operating point.
    pub cycle: Option<[f64; 2]>,
    /// Its branch.
    pub branch: Option<BranchRecord>,
}

/// Cycles along a branch, in its order.
#[derive(Clone, Debug, Default, PartialEq, Described, Serialize, Deserialize)]
pub struct BranchRecord {
    /// Case key of the parameter.
    pub key: String,
    /// The parameter at each cycle, in units of the key.
    pub values: Vec<f64>,
    /// The case's own value.
    pub own_value: f64,
    /// Main frequency, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitude along the counterface, m.
    pub amplitude: Vec<f64>,
    /// Fractions that stick, slip, are open.
    pub status: [Vec<f64>; 3],
    /// Powers relative to the external one: stick, slide, dissipated in the contact, material damping, normal contact.
    pub shares: [Vec<f64>; 5],
    /// What powers are of.
    #[serde(default)]
    pub extent: Extent,
    /// Power of the counterface, W or W/m.
    #[serde(default)]
    pub external: Vec<f64>,
    /// Whether the cycle is stable, where that is known.
    pub stable: Vec<Option<bool>>,
    /// Growth rate of its leading perturbation, 1/s, where it is known.
    pub growth_rate: Vec<Option<f64>>,
    /// Parameter values at which the branch turns back.
    pub folds: Vec<f64>,
    /// Values at which steady sliding loses its stability, where these were looked for.
    #[serde(default)]
    pub sliding_onsets: Vec<f64>,
    /// Where cycles live beside stable sliding.
    #[serde(default)]
    pub coexistence: Vec<[f64; 2]>,
    /// Amplitude (m) and velocity of the kick (m/s) of the unstable cycle between stable sliding and the case's own.
    #[serde(default)]
    pub threshold: Option<[f64; 2]>,
}

impl FamilyRecord {
    /// Which limit cycles.
    pub fn family(&self) -> Family {
        Family { harmonic: self.harmonic, onset: self.onset }
    }
}

impl BranchRecord {
    /// The columns of a branch.
    pub(super) fn of(key: &str, extent: Extent, rows: &[BranchRow]) -> Self {
        let column = |of: &dyn Fn(&BranchRow) -> f64| -> Vec<f64> { rows.iter().map(of).collect() };
        let power =
            |of: fn(&MeanPowers) -> Option<f64>| column(&|row| of(&row.powers).unwrap_or(f64::NAN));
        let external = power(|powers| powers.external);
        let share = |of: fn(&MeanPowers) -> Option<f64>| {
            power(of).iter().zip(&external).map(|(own, all)| own / all).collect()
        };
        Self {
            key: key.to_owned(),
            values: column(&|row| row.value),
            frequency_hz: column(&|row| row.main_frequency_hz),
            amplitude: column(&|row| row.amplitude_m),
            status: [0, 1, 2].map(|i| column(&|row| row.fractions[i])),
            shares: [
                share(|powers| powers.stick),
                share(|powers| powers.slide),
                share(|powers| powers.contact_dissipated),
                share(|powers| powers.material_damping),
                share(|powers| powers.normal_contact),
            ],
            stable: rows.iter().map(|row| row.verdict?.is_stable()).collect(),
            growth_rate: rows.iter().map(|row| row.growth_rate).collect(),
            external,
            extent,
            ..Self::default()
        }
    }
}

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
    two_waves: &[TwoWaveRecord],
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

/// One quantity along a branch.
type Column = fn(&BranchRecord) -> &Vec<f64>;

/// Main frequency, amplitude and power of the limit cycles over the parameter, one curve for each family.
fn frequencies(curves: &[Curve<'_>], two_waves: &[TwoWaveRecord]) -> Result<Figure, ChartError> {
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
        let together = two_waves.iter().flat_map(|pair| {
            let columns = own.map(|own| [&pair.frequency_hz, &pair.amplitude][own]);
            columns.into_iter().flatten().map(|ys| {
                let points = pair.values.iter().copied().zip(ys.iter().copied());
                let [first, second] = pair.harmonics;
                Line::through(points)
                    .stroke(Stroke::dotted(INK, 1.1))
                    .name(format!("*n* = {first} and {second} together"))
            })
        });
        let panel = panel.layers(together.collect::<Vec<_>>());
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
    let figure =
        Figure::new("branch-frequencies", caption).shared_x().panels(panels.collect::<Vec<_>>());
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
