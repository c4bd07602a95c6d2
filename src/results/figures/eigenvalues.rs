//! Eigenvalues over friction: the locus with its stability bars, and the pairs that turn unstable.

use super::axis::{Axis, Tick, extremes, signed};
use super::colour::{INK, MUTED, STABLE, UNSTABLE};
use super::legend::{self, Key};
use super::panel::{LABEL_SIZE, Marker, Panel};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::text::{self, Anchor, TextStyle};
use super::{FigureError, expect_some};
use crate::cea::{ComplexMode, FrictionSweep, UnstableInterval};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The eigenvalue locus over friction.
#[derive(Clone, Copy, Debug)]
pub struct EigenvalueLocus<'a> {
    /// The sweep.
    pub sweep: &'a FrictionSweep,
    /// Rayleigh coefficient `alpha_R`, 1/s.
    pub mass_coefficient: f64,
    /// Rayleigh coefficient `beta_R`, s.
    pub stiffness_coefficient: f64,
}

/// The pairs of a sweep that turn unstable.
#[derive(Clone, Copy, Debug)]
pub struct PairSweep<'a> {
    /// The sweep.
    pub sweep: &'a FrictionSweep,
}

/// Harmonic, branch and direction: what identifies a mode over friction.
type Branch = (usize, usize, i8);

/// Points of each branch over friction: (friction coefficient, mode).
fn branches(sweep: &FrictionSweep) -> BTreeMap<Branch, Vec<(f64, &ComplexMode)>> {
    let mut out: BTreeMap<Branch, Vec<(f64, &ComplexMode)>> = BTreeMap::new();
    for point in &sweep.points {
        for mode in &point.modes {
            out.entry((mode.harmonic, mode.branch, mode.direction))
                .or_default()
                .push((point.friction_coefficient, mode));
        }
    }
    // Where a pair is degenerate its modes have no direction and stand at the start of both waves.
    let standing: Vec<(Branch, f64, &ComplexMode)> = out
        .iter()
        .filter(|((harmonic, _, direction), _)| *harmonic > 0 && *direction == 0)
        .flat_map(|(&branch, points)| points.iter().map(move |&(mu, mode)| (branch, mu, mode)))
        .collect();
    for ((harmonic, number, _), friction, mode) in standing {
        for direction in [-1, 1] {
            if let Some(points) = out.get_mut(&(harmonic, number, direction))
                && points.iter().all(|&(mu, _)| mu != friction)
            {
                points.push((friction, mode));
            }
        }
    }
    for points in out.values_mut() {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    out
}

/// Draws the eigenvalues in the complex plane as friction rises, the Rayleigh curve on which they
/// start (equations 3 and 4), and beside it the friction intervals in which each branch grows.
///
/// # Errors
/// [`FigureError::Empty`] if the sweep has no mode.
pub fn draw_eigenvalue_locus(data: &EigenvalueLocus) -> Result<String, FigureError> {
    let modes = || data.sweep.points.iter().flat_map(|point| &point.modes);
    expect_some("eigenvalues", modes().count())?;
    let (frictions, rows) = (friction_range(data.sweep), interval_rows(data.sweep));
    let height = 250f64.max(40.0 + 13.0 * rows.len() as f64);
    let top = 18.0;
    let mut svg = Svg::new(
        "eigenvalue-locus",
        DOUBLE_COLUMN,
        top + height + Panel::bottom_margin() + 16.0,
    );
    let real = extremes(modes().map(ComplexMode::real_hz).chain([0.0]));
    let room = 0.06 * (real.1 - real.0);
    let highest = extremes(modes().map(ComplexMode::frequency_hz)).1 * 1.04e-3;
    let x = Axis::linear("Re(*λ*) / 2π (Hz)", real.0 - room, real.1 + room);
    let y = Axis::linear("Im(*λ*) / 2π (kHz)", 0.0, highest);
    let left = Panel::left_margin(&y, height);
    let panel = Panel::new(Rect::new(left, top, 260.0, height), x, y);
    panel.draw_ground(&mut svg);
    svg.begin_clip(&panel.area);
    draw_locus(&mut svg, &panel, data);
    svg.end_group();
    panel.draw_frame(&mut svg);
    panel_letter(&mut svg, panel.area.x, top - 6.0, 0);
    draw_bars(&mut svg, &panel, frictions, &rows);
    let entries = [
        (Key::Point(Marker::Disc, STABLE.into()), "stable".into()),
        (
            Key::Point(Marker::Diamond, UNSTABLE.into()),
            "unstable, Re(*λ*) > 0".into(),
        ),
        (Key::dashed(INK), "Rayleigh damping, eqs. 3 and 4".into()),
        (
            Key::Point(Marker::Circle, MUTED.into()),
            format!("lowest friction, *μ* = {}", signed(frictions.0, 2)),
        ),
    ];
    let y = top + height + Panel::bottom_margin() + 2.0;
    legend::draw_legend(&mut svg, left, y, DOUBLE_COLUMN - left, &entries);
    Ok(svg.finish(
        "Eigenvalues in the complex plane over the friction coefficient",
        "Locus of the eigenvalues with the curve of Rayleigh damping; unstable points marked; \
         beside it the friction interval in which each branch is unstable.",
    ))
}

fn friction_range(sweep: &FrictionSweep) -> (f64, f64) {
    extremes(sweep.points.iter().map(|p| p.friction_coefficient))
}

fn draw_locus(svg: &mut Svg, panel: &Panel, data: &EigenvalueLocus) {
    panel.vertical(svg, 0.0, &Stroke::solid(INK, 0.6));
    let (mass, stiffness) = (data.mass_coefficient, data.stiffness_coefficient);
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for step in 1..=400 {
        // Equations 3 and 4, with the undamped frequency as parameter.
        let omega = TAU * panel.y.high * 1.02e3 * f64::from(step) / 400.0;
        let factor = 0.5 * (mass / omega + stiffness * omega);
        if factor < 1.0 {
            xs.push(-factor * omega / TAU);
            ys.push(omega * (1.0 - factor * factor).sqrt() / TAU * 1e-3);
        }
    }
    for points in branches(data.sweep).values() {
        let (re, im): (Vec<f64>, Vec<f64>) = points
            .iter()
            .map(|(_, mode)| (mode.real_hz(), mode.frequency_hz() * 1e-3))
            .unzip();
        panel.curve(svg, &re, &im, &Stroke::solid("#b5b5b5", 0.5));
    }
    let position = |mode: &ComplexMode| (mode.real_hz(), mode.frequency_hz() * 1e-3);
    let all = || data.sweep.points.iter().flat_map(|p| &p.modes);
    let stable = all().filter(|m| !m.is_unstable()).map(position);
    panel.points(svg, stable, Marker::Disc, 0.9, STABLE);
    let unstable = all().filter(|m| m.is_unstable()).map(position);
    panel.points(svg, unstable, Marker::Diamond, 1.15, UNSTABLE);
    let lowest = friction_range(data.sweep).0;
    let start = data
        .sweep
        .points
        .iter()
        .filter(|p| p.friction_coefficient == lowest)
        .flat_map(|p| &p.modes)
        .map(position);
    panel.points(svg, start, Marker::Circle, 1.7, MUTED);
    panel.curve(svg, &xs, &ys, &Stroke::dashed(INK, 0.8));
}

/// Unstable intervals by branch, highest frequency first, as the frequency axis has it.
fn interval_rows(sweep: &FrictionSweep) -> Vec<(Branch, Vec<&UnstableInterval>)> {
    let mut rows: BTreeMap<Branch, Vec<&UnstableInterval>> = BTreeMap::new();
    for interval in &sweep.intervals {
        rows.entry((interval.harmonic, interval.branch, interval.direction))
            .or_default()
            .push(interval);
    }
    let mut rows: Vec<_> = rows.into_iter().collect();
    rows.sort_by(|a, b| b.1[0].frequency_hz.total_cmp(&a.1[0].frequency_hz));
    rows
}

fn draw_bars(
    svg: &mut Svg,
    locus: &Panel,
    frictions: (f64, f64),
    rows: &[(Branch, Vec<&UnstableInterval>)],
) {
    let labels: Vec<Tick> = rows
        .iter()
        .enumerate()
        .map(|(row, ((harmonic, _, _), intervals))| Tick {
            value: (rows.len() - row) as f64 - 0.5,
            label: format!(
                "{} kHz, *n* = {harmonic}",
                signed(intervals[0].frequency_hz * 1e-3, 2)
            ),
        })
        .collect();
    let y = Axis::linear("", 0.0, rows.len().max(1) as f64).with_ticks(labels);
    let labels_width = rows
        .iter()
        .zip(y.ticks(0))
        .map(|(_, tick)| text::width(&tick.label, LABEL_SIZE, false))
        .fold(40.0, f64::max);
    let left = locus.area.right() + labels_width + 16.0;
    let width = DOUBLE_COLUMN - left - 10.0;
    let x = Axis::linear("friction coefficient *μ* (–)", frictions.0, frictions.1);
    let area = Rect::new(left, locus.area.y, width, locus.area.height);
    let panel = Panel::new(area, x, y);
    panel.draw_ground(svg);
    for (row, (_, intervals)) in rows.iter().enumerate() {
        let middle = (rows.len() - row) as f64 - 0.5;
        for interval in intervals {
            draw_bar(svg, &panel, middle, interval);
        }
    }
    if rows.is_empty() {
        svg.text(
            left + 0.5 * width,
            area.y + 0.5 * area.height,
            "no branch turns unstable",
            &TextStyle::new(7.5).anchored(Anchor::Middle),
        );
    }
    panel.draw_frame(svg);
    panel_letter(svg, left, locus.area.y - 6.0, 1);
    svg.text(
        left + 18.0,
        locus.area.y - 6.0,
        "unstable from critical *μ*",
        &TextStyle::new(LABEL_SIZE),
    );
}

fn draw_bar(svg: &mut Svg, panel: &Panel, middle: f64, interval: &UnstableInterval) {
    let half = 5.5;
    let y = panel.at_y(middle);
    let end = interval.restabilized.map_or(panel.x.high, |(mu, _)| mu);
    let (from, to) = (panel.at_x(interval.critical_friction), panel.at_x(end));
    let bar = Rect::new(from, y - half, (to - from).max(1.0), 2.0 * half);
    svg.rectangle(&bar, UNSTABLE, None);
    let label = if interval.unstable_from_start {
        format!("≤ {}", signed(interval.critical_friction, 3))
    } else {
        signed(interval.critical_friction, 3)
    };
    let width = text::width(&label, LABEL_SIZE, false) + 6.0;
    let baseline = y + 0.36 * LABEL_SIZE;
    // Inside the bar where it fits, else at the side that has room.
    let (x, anchor, colour) = if bar.width > width {
        (from + 3.0, Anchor::Start, "#ffffff")
    } else if from - width > panel.area.x {
        (from - 3.0, Anchor::End, INK)
    } else {
        (to + 3.0, Anchor::Start, INK)
    };
    let style = TextStyle::new(LABEL_SIZE).anchored(anchor).coloured(colour);
    svg.text(x, baseline, &label, &style);
}

/// Draws frequency and damping factor over friction of each pair that turns unstable: one row for
/// each pair, the wave with the rotor and the wave against it as two lines.
///
/// # Errors
/// [`FigureError::Empty`] if no pair turns unstable, or the sweep has fewer than two friction values.
pub fn draw_pair_sweep(data: &PairSweep) -> Result<String, FigureError> {
    let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
    for interval in &data.sweep.intervals {
        let known = |p: &(usize, usize, f64)| (p.0, p.1) == (interval.harmonic, interval.branch);
        if !pairs.iter().any(known) {
            pairs.push((interval.harmonic, interval.branch, interval.frequency_hz));
        }
    }
    pairs.sort_by(|a, b| a.2.total_cmp(&b.2));
    expect_some("pairs that turn unstable", pairs.len())?;
    expect_some(
        "second friction value",
        data.sweep.points.len().saturating_sub(1),
    )?;
    let all = branches(data.sweep);
    let top = 26.0;
    let pitch = (680.0 / pairs.len() as f64).min(104.0);
    let height = pitch - 12.0;
    let mut svg = Svg::new("pair-sweep", DOUBLE_COLUMN, 100.0);
    let entries = [
        (Key::line(STABLE), "against the rotor ↻".to_string()),
        (Key::dashed(INK), "with the rotor ↺".to_string()),
        (
            Key::Point(Marker::Disc, UNSTABLE.into()),
            "unstable, *ζ* < 0".to_string(),
        ),
    ];
    legend::draw_legend(&mut svg, 40.0, 2.0, DOUBLE_COLUMN - 40.0, &entries);
    for (row, &(harmonic, branch, _)) in pairs.iter().enumerate() {
        let waves = [-1i8, 1].map(|direction| {
            all.get(&(harmonic, branch, direction))
                .cloned()
                .unwrap_or_default()
        });
        let y = top + row as f64 * pitch;
        let last = row + 1 == pairs.len();
        draw_pair_row(&mut svg, (y, height), last, data.sweep, &waves, row);
        svg.text(
            70.0,
            y - 3.0,
            &format!("*n* = {harmonic}, branch {branch}"),
            &TextStyle::new(LABEL_SIZE),
        );
    }
    let bottom = top + pairs.len() as f64 * pitch - 12.0;
    svg.set_height(bottom + Panel::bottom_margin());
    Ok(svg.finish(
        "Frequency and damping factor over friction of the pairs that turn unstable",
        "One row for each pair of waves: frequency at the left, damping factor at the right.",
    ))
}

fn draw_pair_row(
    svg: &mut Svg,
    (top, height): (f64, f64),
    last: bool,
    sweep: &FrictionSweep,
    waves: &[Vec<(f64, &ComplexMode)>; 2],
    row: usize,
) {
    let frictions = friction_range(sweep);
    type Quantity = fn(&ComplexMode) -> f64;
    let columns: [(&str, Quantity); 2] = [
        ("frequency *f* (kHz)", |mode| mode.frequency_hz() * 1e-3),
        ("damping factor *ζ* (%)", |mode| {
            mode.damping_factor() * 100.0
        }),
    ];
    for (column, (title, quantity)) in columns.into_iter().enumerate() {
        let values = waves.iter().flatten().map(|(_, mode)| quantity(mode));
        let y = Axis::around(title, values);
        let x = Axis::linear("friction coefficient *μ* (–)", frictions.0, frictions.1);
        let left = 48.0 + column as f64 * 250.0;
        let area = Rect::new(left, top, 196.0, height);
        let mut panel = Panel::new(area, x, y);
        panel.labels_x = last;
        panel.title_distance = Some(37.0);
        panel.draw_ground(svg);
        if column == 1 {
            panel.horizontal(svg, 0.0, &Stroke::solid(INK, 0.6));
        }
        for (wave, points) in waves.iter().enumerate() {
            let (mu, value): (Vec<f64>, Vec<f64>) = points
                .iter()
                .map(|&(mu, mode)| (mu, quantity(mode)))
                .unzip();
            let stroke = if wave == 0 {
                Stroke::solid(STABLE, 1.1)
            } else {
                Stroke::dashed(INK, 0.9)
            };
            panel.curve(svg, &mu, &value, &stroke);
            let unstable = points
                .iter()
                .filter(|(_, mode)| mode.is_unstable())
                .map(|&(mu, mode)| (mu, quantity(mode)));
            panel.points(svg, unstable, Marker::Disc, 1.5, UNSTABLE);
        }
        panel.draw_frame(svg);
        panel_letter(svg, left, top - 3.0, 2 * row + column);
    }
}
