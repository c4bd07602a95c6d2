//! Branches of limit cycles over a parameter: frequency and amplitude, statuses and powers.

use super::axis::{Axis, extremes, prefixed};
use super::colour::{
    CONTACT_DISSIPATION, INK, MATERIAL_DISSIPATION, NORMAL_POWER, SERIES, SLIDE_POWER, SLIP, STICK,
    STICK_POWER,
};
use super::legend::{self, Key};
use super::panel::{Marker, Panel};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::sweep::draw_reference_lines;
use super::text::{Anchor, TextStyle};
use super::time_stack::ReferenceFrequency;
use super::{FigureError, expect_length, expect_some};

/// What is known of the stability of a limit cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stability {
    /// Nothing.
    #[default]
    Unknown,
    /// Every small perturbation dies out.
    Stable,
    /// Some perturbation grows.
    Unstable,
}

/// Limit cycles of one family in the order of their branch, along which the parameter may turn back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BranchCurve {
    /// Name in mark-up: `*n* = 2`.
    pub name: String,
    /// Parameter.
    pub values: Vec<f64>,
    /// Main frequency, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitude of the contact edge's tangential displacement, m.
    pub amplitude: Vec<f64>,
    /// Fractions of the contact edge that stick, slip, are open.
    pub status: [Vec<f64>; 3],
    /// Powers relative to the external one: stick, slide, dissipated in the contact, material damping, normal contact.
    pub shares: [Vec<f64>; 5],
    /// Stability of each cycle.
    pub stability: Vec<Stability>,
    /// Parameter values at which the branch turns back, in its order.
    pub folds: Vec<f64>,
    /// Parameter, frequency and amplitude of a cycle to be marked.
    pub marked: Option<[f64; 3]>,
}

/// Branches over one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchCurves {
    /// Title of the parameter's axis in mark-up, with the unit.
    pub parameter_title: String,
    /// The branches.
    pub curves: Vec<BranchCurve>,
    /// Frequencies of the eigenvalue analysis drawn as lines.
    pub references: Vec<ReferenceFrequency>,
}

/// A point of a curve: part `weight` of the way from cycle `before` to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    value: f64,
    before: usize,
    weight: f64,
}

impl Place {
    fn of(&self, ys: &[f64]) -> f64 {
        let next = ys[(self.before + 1).min(ys.len() - 1)];
        ys[self.before] + self.weight * (next - ys[self.before])
    }
}

impl BranchCurve {
    fn check(&self) -> Result<(), FigureError> {
        let count = self.values.len();
        let series = [&self.frequency_hz, &self.amplitude].into_iter();
        for values in series.chain(&self.status).chain(&self.shares) {
            expect_length("branch of limit cycles", values.len(), count)?;
        }
        expect_length("stability of limit cycles", self.stability.len(), count)
    }

    /// Where the folds lie, and whether the curve is seen to turn there: it then meets the same value before and after.
    ///
    /// A branch that turns twice between two cycles goes on as if it had not; its folds are placed on the line.
    fn fold_places(&self) -> Vec<(Place, bool)> {
        let mut left = self.folds.clone();
        let mut places = Vec::new();
        let count = self.values.len();
        for before in 0..count.saturating_sub(1) {
            let value = self.values[before];
            if value != self.values[before + 1] {
                continue;
            }
            let distance = |i: &usize| (left[*i] - value).abs();
            let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(nearest) = nearest {
                let value = left.remove(nearest);
                places.push((
                    Place {
                        value,
                        before,
                        weight: 0.5,
                    },
                    true,
                ));
            }
        }
        for value in left {
            let outside = |i: &usize| {
                let (a, b) = (self.values[*i], self.values[*i + 1]);
                (a.min(b) - value).max(value - a.max(b)).max(0.0)
            };
            let nearest =
                (0..count.saturating_sub(1)).min_by(|a, b| outside(a).total_cmp(&outside(b)));
            if let Some(before) = nearest {
                let (from, to) = (self.values[before], self.values[before + 1]);
                let weight = ((value - from) / (to - from)).clamp(0.0, 1.0);
                places.push((
                    Place {
                        value,
                        before,
                        weight,
                    },
                    false,
                ));
            }
        }
        places
    }

    /// The curve's points, each with the stability of the piece after it.
    fn places(&self) -> Vec<(Place, Stability)> {
        let folds = self.fold_places();
        let mut places = Vec::new();
        for before in 0..self.values.len() {
            let value = self.values[before];
            let stability = self.piece(before);
            places.push((
                Place {
                    value,
                    before,
                    weight: 0.0,
                },
                stability,
            ));
            let turn = folds
                .iter()
                .find(|(place, turns)| *turns && place.before == before);
            places.extend(turn.map(|(place, _)| (*place, stability)));
        }
        places
    }

    /// Stability between a cycle and the next: known where both agree.
    fn piece(&self, before: usize) -> Stability {
        let next = (before + 1).min(self.stability.len() - 1);
        let (a, b) = (self.stability[before], self.stability[next]);
        if a == b { a } else { Stability::Unknown }
    }

    /// Draws one quantity along the branch: stable pieces strong, unstable ones dashed, others plain.
    fn draw(&self, svg: &mut Svg, panel: &Panel, ys: &[f64], factor: f64, colour: &str) {
        let places = self.places();
        let mut start = 0;
        while start + 1 < places.len() {
            let stability = places[start].1;
            let mut end = start + 1;
            while end + 1 < places.len() && places[end].1 == stability {
                end += 1;
            }
            let piece = &places[start..=end];
            let xs: Vec<f64> = piece.iter().map(|(place, _)| place.value).collect();
            let ys: Vec<f64> = piece
                .iter()
                .map(|(place, _)| factor * place.of(ys))
                .collect();
            panel.curve(svg, &xs, &ys, &stroke(stability, colour));
            start = end;
        }
    }

    fn draw_folds(&self, svg: &mut Svg, panel: &Panel, ys: &[f64], factor: f64, colour: &str) {
        let folds = self.fold_places().into_iter();
        let points = folds.map(|(place, _)| (place.value, factor * place.of(ys)));
        panel.points(svg, points, Marker::Diamond, 1.9, colour);
    }
}

fn stroke(stability: Stability, colour: &str) -> Stroke<'_> {
    match stability {
        Stability::Unknown => Stroke::solid(colour, 0.9),
        Stability::Stable => Stroke::solid(colour, 1.6),
        Stability::Unstable => Stroke::dashed(colour, 0.9),
    }
}

fn check(data: &BranchCurves) -> Result<Axis, FigureError> {
    expect_some("branches", data.curves.len())?;
    for curve in &data.curves {
        curve.check()?;
        expect_some(
            "second cycle of a branch",
            curve.values.len().saturating_sub(1),
        )?;
    }
    let values = data
        .curves
        .iter()
        .flat_map(|curve| curve.values.iter().copied());
    let (low, high) = extremes(values);
    // More than a decade shows on a logarithmic axis only.
    Ok(if low > 0.0 && high > 10.0 * low {
        Axis::logarithmic(&data.parameter_title, low * 0.9, high * 1.1)
    } else {
        Axis::around(&data.parameter_title, [low, high])
    })
}

/// Legend entries for what a line's dash and the marks mean, where the branches have them.
fn style_entries(data: &BranchCurves) -> Vec<(Key, String)> {
    let has = |wanted| {
        data.curves
            .iter()
            .any(|curve| curve.stability.contains(&wanted))
    };
    let line = |stability| {
        let Stroke {
            colour,
            width,
            dash,
            ..
        } = stroke(stability, INK);
        Key::Line(colour.into(), width, dash.to_vec())
    };
    let mut entries = Vec::new();
    if has(Stability::Stable) {
        entries.push((line(Stability::Stable), "stable".to_string()));
    }
    if has(Stability::Unstable) {
        entries.push((line(Stability::Unstable), "unstable".into()));
    }
    if data.curves.iter().any(|curve| !curve.folds.is_empty()) {
        entries.push((Key::Point(Marker::Diamond, INK.into()), "fold".into()));
    }
    entries
}

/// Draws main frequency and amplitude of the limit cycles over the parameter, one curve for each family.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_branch_frequencies(data: &BranchCurves) -> Result<String, FigureError> {
    let x = check(data)?;
    let colours = || SERIES.iter().cycle();
    let mut entries: Vec<(Key, String)> = data
        .curves
        .iter()
        .zip(colours())
        .map(|(curve, colour)| (Key::line(colour), curve.name.clone()))
        .collect();
    entries.extend(style_entries(data));
    if data.curves.iter().any(|curve| curve.marked.is_some()) {
        entries.push((
            Key::Point(Marker::Circle, INK.into()),
            "the case's own cycle".into(),
        ));
    }
    if !data.references.is_empty() {
        entries.push((Key::dashed(INK), "onset in the eigenvalue analysis".into()));
    }
    let kilohertz = data.curves.iter().flat_map(|curve| &curve.frequency_hz);
    let lines = data.references.iter().map(|line| &line.frequency_hz);
    let upper = Axis::around(
        "main frequency *f* (kHz)",
        kilohertz.chain(lines).map(|f| f * 1e-3),
    );
    let reach = extremes(
        data.curves
            .iter()
            .flat_map(|curve| curve.amplitude.iter().copied()),
    )
    .1;
    let (factor, unit) = prefixed(reach, "m");
    let lower = Axis::linear(
        &format!("amplitude of *u*_{{θ}} ({unit})"),
        0.0,
        1.06 * reach * factor,
    );
    let mut svg = Svg::new("branch-frequencies", DOUBLE_COLUMN, 100.0);
    let (left, heights) = (44.0, [150.0, 92.0]);
    let width = DOUBLE_COLUMN - left - 112.0;
    let legend_width = DOUBLE_COLUMN - left;
    legend::draw_legend(&mut svg, left, 2.0, legend_width, &entries);
    let top = 16.0 + legend::legend_height(&entries, legend_width);
    let mut panels = [
        Panel::new(Rect::new(left, top, width, heights[0]), x.clone(), upper).without_x_labels(),
        Panel::new(
            Rect::new(left, top + heights[0] + 16.0, width, heights[1]),
            x,
            lower,
        ),
    ];
    for (index, panel) in panels.iter_mut().enumerate() {
        panel.title_distance = Some(33.0);
        panel.draw_ground(&mut svg);
        panel_letter(&mut svg, left, panel.area.y - 4.0, index);
    }
    draw_reference_lines(&mut svg, &panels[0], &data.references);
    for (curve, colour) in data.curves.iter().zip(colours()) {
        for (part, (panel, ys, factor)) in [
            (&panels[0], &curve.frequency_hz, 1e-3),
            (&panels[1], &curve.amplitude, factor),
        ]
        .into_iter()
        .enumerate()
        {
            curve.draw(&mut svg, panel, ys, factor, colour);
            curve.draw_folds(&mut svg, panel, ys, factor, colour);
            let marked = curve
                .marked
                .map(|cycle| (cycle[0], factor * cycle[1 + part]));
            panel.points(&mut svg, marked, Marker::Circle, 2.2, colour);
        }
    }
    for panel in &panels {
        panel.draw_frame(&mut svg);
    }
    svg.set_height(panels[1].area.bottom() + Panel::bottom_margin());
    Ok(svg.finish(
        "Limit cycles over a parameter",
        "Main frequency and amplitude along the branch of each family of limit cycles; dashed lines mark onsets of the \
         eigenvalue analysis.",
    ))
}

/// Draws statuses and power shares of the limit cycles over the parameter, one column for each family.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_branch_shares(data: &BranchCurves) -> Result<String, FigureError> {
    let x = check(data)?;
    let statuses = [("stick", STICK), ("slip", SLIP), ("open", INK)];
    let powers = [
        ("stick", STICK_POWER),
        ("slide", SLIDE_POWER),
        ("dissipated in the contact", CONTACT_DISSIPATION),
        ("material damping", MATERIAL_DISSIPATION),
        ("normal contact", NORMAL_POWER),
    ];
    let columns = data.curves.len().min(3);
    let (left, gap, height) = (44.0, 14.0, 104.0);
    let width =
        ((DOUBLE_COLUMN - left - 8.0 - gap * (columns - 1) as f64) / columns as f64).min(300.0);
    let all = data
        .curves
        .iter()
        .flat_map(|curve| curve.shares.iter().flatten());
    let share_axis = Axis::around(
        "share of external power (%)",
        all.map(|s| 100.0 * s).chain([0.0, 100.0]),
    );
    let mut svg = Svg::new("branch-shares", DOUBLE_COLUMN, 100.0);
    let keys = |named: &[(&str, &str)]| -> Vec<(Key, String)> {
        named
            .iter()
            .map(|(name, colour)| (Key::line(colour), (*name).to_string()))
            .collect()
    };
    let block = 2.0 * (height + 24.0) + Panel::bottom_margin() + 4.0;
    for (index, curve) in data.curves.iter().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let top = 26.0 + row as f64 * block;
        let x_left = left + column as f64 * (width + gap);
        if column == 0 {
            let mut entries = keys(&statuses);
            entries.extend(style_entries(data));
            legend::draw_legend(&mut svg, left, top - 24.0, DOUBLE_COLUMN - left, &entries);
            legend::draw_legend(
                &mut svg,
                left,
                top + height + 6.0,
                DOUBLE_COLUMN - left,
                &keys(&powers),
            );
        }
        let areas = [0.0, height + 30.0].map(|down| Rect::new(x_left, top + down, width, height));
        let axes = [
            Axis::linear("contact nodes (%)", 0.0, 100.0),
            share_axis.clone(),
        ];
        let parts: [Vec<(&Vec<f64>, &str)>; 2] = [
            curve.status.iter().zip(statuses.map(|s| s.1)).collect(),
            curve.shares.iter().zip(powers.map(|p| p.1)).collect(),
        ];
        for (part, ((area, y), series)) in areas.into_iter().zip(axes).zip(parts).enumerate() {
            let mut panel = Panel::new(area, x.clone(), y);
            panel.labels_x = part == 1;
            panel.labels_y = column == 0;
            panel.title_distance = Some(33.0);
            panel.draw_ground(&mut svg);
            for (values, colour) in series {
                curve.draw(&mut svg, &panel, values, 100.0, colour);
                curve.draw_folds(&mut svg, &panel, values, 100.0, colour);
            }
            panel.draw_frame(&mut svg);
            panel_letter(
                &mut svg,
                panel.area.x,
                panel.area.y - 4.0,
                part * data.curves.len() + index,
            );
        }
        let style = TextStyle::new(7.5).anchored(Anchor::Middle);
        svg.text(x_left + 0.5 * width, top - 4.0, &curve.name, &style);
    }
    let rows = data.curves.len().div_ceil(columns);
    svg.set_height(26.0 + rows as f64 * block);
    Ok(svg.finish(
        "Contact status and power shares over a parameter",
        "Shares of sticking, slipping and open contact, and powers relative to the external one, along the branch of each \
         family of limit cycles.",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(values: &[f64], folds: &[f64]) -> BranchCurve {
        BranchCurve {
            values: values.to_vec(),
            folds: folds.to_vec(),
            stability: vec![Stability::Unknown; values.len()],
            ..BranchCurve::default()
        }
    }

    #[test]
    fn a_curve_turns_at_the_fold_beyond_its_last_cycle() {
        let found = curve(&[1.0, 2.0, 2.0, 1.0], &[2.4]).places();
        let values: Vec<f64> = found.iter().map(|(place, _)| place.value).collect();
        assert_eq!(values, [1.0, 2.0, 2.4, 2.0, 1.0]);
        assert_eq!(found[2].0.of(&[0.0, 10.0, 20.0, 30.0]), 15.0);
    }

    #[test]
    fn folds_between_two_cycles_lie_on_the_line_between_them() {
        let found = curve(&[1.0, 2.0, 4.0], &[3.5, 3.0]).fold_places();
        let ordinates: Vec<f64> = found
            .iter()
            .map(|(place, _)| place.of(&[0.0, 10.0, 20.0]))
            .collect();
        assert_eq!(ordinates, [17.5, 15.0]);
        assert!(found.iter().all(|(_, turns)| !turns));
    }

    #[test]
    fn a_piece_is_stable_only_between_two_stable_cycles() {
        let mut curve = curve(&[1.0, 2.0, 3.0], &[]);
        curve.stability = vec![Stability::Stable, Stability::Stable, Stability::Unstable];
        assert_eq!(curve.piece(0), Stability::Stable);
        assert_eq!(curve.piece(1), Stability::Unknown);
    }
}
