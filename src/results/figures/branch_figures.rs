//! Figures of branches of limit cycles: frequency and amplitude, statuses and powers.

use super::FigureError;
use super::axis::{Axis, Scale, extremes, prefixed};
use super::branches::{BranchCurve, BranchCurves, parameter_axis, style_entries};
use super::colour::{
    CONTACT_DISSIPATION, INK, MATERIAL_DISSIPATION, MUTED, NORMAL_POWER, SERIES, SLIDE_POWER, SLIP,
    STICK, STICK_POWER,
};
use super::legend::{self, Key};
use super::panel::{Marker, Panel};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::sweep::draw_reference_lines;
use super::text::{Anchor, TextStyle};

/// Distance of the vertical axes' titles, points.
const TITLE_DISTANCE: f64 = 33.0;
/// Left edge of the data, points.
const LEFT: f64 = 44.0;
/// Room for the names of the reference lines at the right, points.
const RIGHT: f64 = 112.0;
/// Height of the panels of shares, points.
const SHARE_HEIGHT: f64 = 104.0;

/// Name and colour of a curve.
type Named = (&'static str, &'static str);

/// One quantity along a branch.
type Column = fn(&BranchCurve) -> &Vec<f64>;

/// Open contact is drawn darker than its areas are.
const STATUSES: [Named; 3] = [("stick", STICK), ("slip", SLIP), ("open", INK)];

const POWERS: [Named; 5] = [
    ("stick", STICK_POWER),
    ("slide", SLIDE_POWER),
    ("dissipated in the contact", CONTACT_DISSIPATION),
    ("material damping", MATERIAL_DISSIPATION),
    ("normal contact", NORMAL_POWER),
];

/// Draws main frequency and amplitude of the limit cycles over the parameter, one curve for each family.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_branch_frequencies(data: &BranchCurves) -> Result<String, FigureError> {
    let x = parameter_axis(data)?;
    let mut svg = Svg::new("branch-frequencies", DOUBLE_COLUMN, 100.0);
    let entries = family_entries(data);
    legend::draw_legend(&mut svg, LEFT, 2.0, DOUBLE_COLUMN - LEFT, &entries);
    let top = 16.0 + legend::legend_height(&entries, DOUBLE_COLUMN - LEFT);
    let width = DOUBLE_COLUMN - LEFT - RIGHT;
    let upper = Rect::new(LEFT, top, width, 150.0);
    let lower = Rect::new(LEFT, upper.bottom() + 16.0, width, 92.0);
    let (metre, amplitude) = amplitude_axis(data, x.scale);
    let frequency = Panel::new(upper, x.clone(), frequency_axis(data)).without_x_labels();
    let amplitude = Panel::new(lower, x, amplitude);
    let quantities: [(Panel, Column, f64); 2] = [
        (frequency, |curve| &curve.frequency_hz, 1e-3),
        (amplitude, |curve| &curve.amplitude, metre),
    ];
    for (index, (mut panel, quantity, factor)) in quantities.into_iter().enumerate() {
        panel.title_distance = Some(TITLE_DISTANCE);
        panel.draw_ground(&mut svg);
        panel_letter(&mut svg, LEFT, panel.area.y - 4.0, index);
        if index == 0 {
            draw_reference_lines(&mut svg, &panel, &data.references, &dotted());
        }
        for (curve, colour) in data.curves.iter().zip(SERIES.iter().cycle()) {
            let values = quantity(curve);
            curve.draw(&mut svg, &panel, values, factor, colour);
            curve.draw_folds(&mut svg, &panel, values, factor, colour);
            let marked = curve.marked.map(|own| (own[0], factor * own[1 + index]));
            panel.points(&mut svg, marked, Marker::Circle, 2.2, colour);
        }
        panel.draw_frame(&mut svg);
    }
    svg.set_height(lower.bottom() + Panel::bottom_margin());
    Ok(svg.finish(
        "Limit cycles over a parameter",
        "Main frequency and amplitude along the branch of each family of limit cycles; dotted lines mark the onset of \
         each family.",
    ))
}

fn family_entries(data: &BranchCurves) -> Vec<(Key, String)> {
    let families = data.curves.iter().zip(SERIES.iter().cycle());
    let mut entries: Vec<(Key, String)> = families
        .map(|(curve, colour)| (Key::line(colour), curve.name.clone()))
        .collect();
    entries.extend(style_entries(data, Key::Point(Marker::Diamond, INK.into())));
    if data.curves.iter().any(|curve| curve.marked.is_some()) {
        let key = Key::Point(Marker::Circle, INK.into());
        entries.push((key, "the case's own cycle".into()));
    }
    if !data.references.is_empty() {
        let name = "onset of the instability, linear theory";
        entries.push((key_of(&dotted()), name.into()));
    }
    entries
}

fn frequency_axis(data: &BranchCurves) -> Axis {
    let found = data.curves.iter().flat_map(|curve| &curve.frequency_hz);
    let lines = data.references.iter().map(|line| &line.frequency_hz);
    Axis::around(
        "main frequency *f* (kHz)",
        found.chain(lines).map(|f| f * 1e-3),
    )
}

/// Factor to the unit of the axis, and the axis: with logarithmic steps where the parameter has them.
fn amplitude_axis(data: &BranchCurves, scale: Scale) -> (f64, Axis) {
    let all = data
        .curves
        .iter()
        .flat_map(|curve| curve.amplitude.iter().copied());
    let (low, high) = extremes(all);
    let (factor, unit) = prefixed(high, "m");
    let title = format!("amplitude of *u*_{{θ}} ({unit})");
    let axis = match scale {
        Scale::Logarithmic => Axis::logarithmic(&title, 0.8 * low * factor, 1.3 * high * factor),
        Scale::Linear => Axis::linear(&title, 0.0, 1.06 * high * factor),
    };
    (factor, axis)
}

/// Draws statuses and power shares of the limit cycles over the parameter, one column for each family.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_branch_shares(data: &BranchCurves) -> Result<String, FigureError> {
    let x = parameter_axis(data)?;
    let columns = data.curves.len().min(3);
    let gap = 14.0;
    let free = DOUBLE_COLUMN - LEFT - 8.0 - gap * (columns - 1) as f64;
    let width = (free / columns as f64).min(300.0);
    let all = data
        .curves
        .iter()
        .flat_map(|curve| curve.shares.iter().flatten());
    let percent = all.map(|share| 100.0 * share).chain([0.0, 100.0]);
    let axes = [
        Axis::linear("contact nodes (%)", 0.0, 100.0),
        Axis::around("share of external power (%)", percent),
    ];
    let mut svg = Svg::new("branch-shares", DOUBLE_COLUMN, 100.0);
    let block = 2.0 * SHARE_HEIGHT + 56.0 + Panel::bottom_margin();
    for (index, curve) in data.curves.iter().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let corner = (
            LEFT + column as f64 * (width + gap),
            26.0 + row as f64 * block,
        );
        if column == 0 {
            draw_share_legends(&mut svg, corner.1, data);
        }
        let style = TextStyle::new(7.5).anchored(Anchor::Middle);
        svg.text(corner.0 + 0.5 * width, corner.1 - 4.0, &curve.name, &style);
        for (part, y) in axes.iter().enumerate() {
            let top = corner.1 + part as f64 * (SHARE_HEIGHT + 30.0);
            let area = Rect::new(corner.0, top, width, SHARE_HEIGHT);
            let mut panel = Panel::new(area, x.clone(), y.clone());
            panel.labels_x = part == 1;
            panel.labels_y = column == 0;
            panel.title_distance = Some(TITLE_DISTANCE);
            draw_shares(&mut svg, &panel, curve, part);
            let letter =
                2 * row * columns + part * columns.min(data.curves.len() - row * columns) + column;
            panel_letter(&mut svg, area.x, area.y - 4.0, letter);
        }
    }
    let rows = data.curves.len().div_ceil(columns);
    svg.set_height(rows as f64 * block);
    Ok(svg.finish(
        "Contact status and power shares over a parameter",
        "Shares of sticking, slipping and open contact, and powers relative to the external one, along the branch of each \
         family of limit cycles.",
    ))
}

/// What is no curve of a branch: dashes there mean unstable cycles.
fn dotted() -> Stroke<'static> {
    Stroke {
        dash: &[0.8, 1.4],
        ..Stroke::solid(MUTED, 0.8)
    }
}

fn key_of(stroke: &Stroke<'_>) -> Key {
    Key::Line(stroke.colour.into(), stroke.width, stroke.dash.to_vec())
}

/// One legend above the statuses, one above the powers.
fn draw_share_legends(svg: &mut Svg, top: f64, data: &BranchCurves) {
    let keys = |named: &[Named]| -> Vec<(Key, String)> {
        let pairs = named.iter();
        pairs
            .map(|(name, colour)| (Key::line(colour), (*name).to_string()))
            .collect()
    };
    let mut entries = keys(&STATUSES);
    entries.extend(style_entries(data, key_of(&dotted())));
    let room = DOUBLE_COLUMN - LEFT;
    legend::draw_legend(svg, LEFT, top - 24.0, room, &entries);
    legend::draw_legend(svg, LEFT, top + SHARE_HEIGHT + 6.0, room, &keys(&POWERS));
}

/// The statuses (`part` 0) or the powers (1) of a branch; dotted lines where it is seen to turn back.
fn draw_shares(svg: &mut Svg, panel: &Panel, curve: &BranchCurve, part: usize) {
    let (series, named): (&[Vec<f64>], &[Named]) = match part {
        0 => (&curve.status, &STATUSES),
        _ => (&curve.shares, &POWERS),
    };
    panel.draw_ground(svg);
    for fold in curve.visible_folds() {
        panel.vertical(svg, fold, &dotted());
    }
    for (values, (_, colour)) in series.iter().zip(named) {
        curve.draw(svg, panel, values, 100.0, colour);
    }
    panel.draw_frame(svg);
}
