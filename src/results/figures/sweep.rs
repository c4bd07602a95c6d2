//! Figures over rotation speed: main frequency and contact status of the limit cycle.

use super::axis::{Axis, extremes, signed};
use super::colour::{INK, OPEN, SERIES, SLIP, STICK};
use super::contact_status::status_keys;
use super::legend::{self, Key};
use super::panel::{MARKERS, Panel};
use super::svg::{DOUBLE_COLUMN, Path, Rect, Stroke, Svg, panel_letter};
use super::text::{Anchor, TextStyle};
use super::time_stack::{ReferenceFrequency, spread};
use super::{FigureError, expect_length, expect_some};

/// Limit cycles over speed at one friction coefficient; `NaN` where a point failed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedSeries {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Rotation speeds, rpm, rising.
    pub speeds_rpm: Vec<f64>,
    /// Main frequency at each speed, Hz.
    pub main_frequency_hz: Vec<f64>,
    /// Fraction of nodes that stick at each speed.
    pub stick: Vec<f64>,
    /// Fraction of nodes that slip.
    pub slip: Vec<f64>,
    /// Fraction of nodes that are open.
    pub open: Vec<f64>,
}

/// Limit cycles over speed for several friction coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedSweep {
    /// One entry for each friction coefficient.
    pub series: Vec<SpeedSeries>,
    /// Unstable modes drawn as lines.
    pub references: Vec<ReferenceFrequency>,
}

fn check(data: &SpeedSweep) -> Result<(f64, f64), FigureError> {
    expect_some("sweep", data.series.len())?;
    for series in &data.series {
        let count = series.speeds_rpm.len();
        expect_some("speeds", count)?;
        expect_length("main frequencies", series.main_frequency_hz.len(), count)?;
        for fraction in [&series.stick, &series.slip, &series.open] {
            expect_length("status fractions", fraction.len(), count)?;
        }
    }
    let speeds = || {
        data.series
            .iter()
            .flat_map(|s| s.speeds_rpm.iter().copied())
    };
    let (low, high) = extremes(speeds().filter(|&v| v > 0.0));
    // A single speed still makes an axis.
    Ok(if low < high {
        (low, high)
    } else {
        (0.5 * low, 2.0 * high)
    })
}

/// Draws the main frequency of the limit cycle over speed, one line for each friction coefficient.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_speed_frequencies(data: &SpeedSweep) -> Result<String, FigureError> {
    let (low, high) = check(data)?;
    let mut svg = Svg::new("sweep-frequencies", DOUBLE_COLUMN, 100.0);
    let entries: Vec<(Key, String)> = data
        .series
        .iter()
        .enumerate()
        .map(|(index, series)| {
            let key = Key::Point(MARKERS[index % 4], SERIES[index % 7].into());
            (
                key,
                format!("*μ* = {}", signed(series.friction_coefficient, 2)),
            )
        })
        .chain((!data.references.is_empty()).then(|| {
            (
                Key::dashed(INK),
                "unstable mode of the eigenvalue analysis".to_string(),
            )
        }))
        .collect();
    let frequencies = || {
        let found = data.series.iter().flat_map(|s| &s.main_frequency_hz);
        let lines = data.references.iter().map(|r| &r.frequency_hz);
        found.chain(lines).map(|f| f * 1e-3)
    };
    let y = Axis::around("main frequency *f* (kHz)", frequencies());
    let height = 180.0;
    let left = Panel::left_margin(&y, height);
    let width = DOUBLE_COLUMN - left - 96.0;
    legend::draw_legend(&mut svg, left, 2.0, DOUBLE_COLUMN - left, &entries);
    let area = Rect::new(left, 16.0, width, height);
    let x = Axis::logarithmic("rotation speed *Ω* (rpm)", low * 0.9, high * 1.1);
    let panel = Panel::new(area, x, y);
    panel.draw_ground(&mut svg);
    let dashed = Stroke::dashed(INK, 0.8);
    draw_reference_lines(&mut svg, &panel, &data.references, &dashed);
    for (index, series) in data.series.iter().enumerate() {
        let values: Vec<f64> = series.main_frequency_hz.iter().map(|f| f * 1e-3).collect();
        let colour = SERIES[index % 7];
        panel.series(
            &mut svg,
            &series.speeds_rpm,
            &values,
            &Stroke::solid(colour, 0.9),
        );
        let points = series.speeds_rpm.iter().copied().zip(values);
        panel.points(&mut svg, points, MARKERS[index % 4], 2.0, colour);
    }
    panel.draw_frame(&mut svg);
    svg.set_height(16.0 + height + Panel::bottom_margin());
    Ok(svg.finish(
        "Main frequency of the limit cycle over rotation speed",
        "One line for each friction coefficient; dashed lines mark unstable modes of the eigenvalue \
         analysis.",
    ))
}

/// Lines at the frequencies, named at the right of the panel.
pub(super) fn draw_reference_lines(
    svg: &mut Svg,
    panel: &Panel,
    references: &[ReferenceFrequency],
    stroke: &Stroke,
) {
    let mut sorted: Vec<&ReferenceFrequency> = references.iter().collect();
    sorted.sort_by(|a, b| b.frequency_hz.total_cmp(&a.frequency_hz));
    let wanted: Vec<f64> = sorted
        .iter()
        .map(|r| panel.at_y(r.frequency_hz * 1e-3))
        .collect();
    let places = spread(&wanted, 8.5, panel.area.y, panel.area.bottom());
    for ((reference, &y), &label_y) in sorted.iter().zip(&wanted).zip(&places) {
        panel.horizontal(svg, reference.frequency_hz * 1e-3, stroke);
        let right = panel.area.right();
        svg.line((right, y), (right + 6.0, label_y), &Stroke::solid(INK, 0.4));
        let text = format!(
            "{} kHz, {}",
            signed(reference.frequency_hz * 1e-3, 2),
            reference.label
        );
        svg.text(right + 8.0, label_y + 2.4, &text, &TextStyle::new(6.5));
    }
}

/// Draws the shares of stick, slip and open of the limit cycle over speed as stacked areas, one
/// panel for each friction coefficient.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_speed_status(data: &SpeedSweep) -> Result<String, FigureError> {
    let (low, high) = check(data)?;
    let columns = data.series.len().min(3);
    let (left, gap, height) = (38.0, 14.0, 120.0);
    let mut width = (DOUBLE_COLUMN - left - 10.0 - gap * (columns - 1) as f64) / columns as f64;
    width = width.min(260.0);
    let mut svg = Svg::new("sweep-status", DOUBLE_COLUMN, 100.0);
    legend::draw_legend(&mut svg, left, 2.0, 200.0, &status_keys());
    let row_height = height + Panel::bottom_margin() + 16.0;
    for (index, series) in data.series.iter().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let area = Rect::new(
            left + column as f64 * (width + gap),
            30.0 + row as f64 * row_height,
            width,
            height,
        );
        let x = Axis::logarithmic("rotation speed *Ω* (rpm)", low, high);
        let y = Axis::linear("contact nodes (%)", 0.0, 100.0);
        let mut panel = Panel::new(area, x, y).without_grid();
        panel.labels_y = column == 0;
        draw_shares(&mut svg, &panel, series);
        panel.draw_frame(&mut svg);
        panel_letter(&mut svg, area.x, area.y - 4.0, index);
        let label = format!("*μ* = {}", signed(series.friction_coefficient, 2));
        let style = TextStyle::new(7.5).anchored(Anchor::Middle);
        svg.text(area.x + 0.5 * width, area.y - 4.0, &label, &style);
    }
    let rows = data.series.len().div_ceil(columns);
    svg.set_height(30.0 + rows as f64 * row_height - 16.0);
    Ok(svg.finish(
        "Contact status of the limit cycle over rotation speed",
        "Shares of sticking, slipping and open contact nodes, one panel for each friction coefficient.",
    ))
}

fn draw_shares(svg: &mut Svg, panel: &Panel, series: &SpeedSeries) {
    let known: Vec<usize> = (0..series.speeds_rpm.len())
        .filter(|&i| series.stick[i].is_finite() && series.slip[i].is_finite())
        .collect();
    let pick = |values: &dyn Fn(usize) -> f64| known.iter().map(|&i| values(i)).collect();
    let speeds: Vec<f64> = pick(&|i| series.speeds_rpm[i]);
    let stick: Vec<f64> = pick(&|i| 100.0 * series.stick[i]);
    let slip: Vec<f64> = pick(&|i| 100.0 * (series.stick[i] + series.slip[i]));
    let top: Vec<f64> = pick(&|i| 100.0 * (series.stick[i] + series.slip[i] + series.open[i]));
    svg.begin_clip(&panel.area);
    for (values, colour) in [(&top, OPEN), (&slip, SLIP), (&stick, STICK)] {
        panel.fill_to(svg, &speeds, values, 0.0, colour, 1.0);
    }
    // The speeds computed, as marks along the boundaries between the shares.
    let mut marks = Path::new();
    for (&speed, &value) in speeds.iter().zip(&stick).chain(speeds.iter().zip(&slip)) {
        let (x, y) = (panel.at_x(speed), panel.at_y(value));
        super::panel::outline_marker(&mut marks, super::panel::Marker::Disc, x, y, 1.1);
    }
    svg.fill_path(&marks, INK, 1.0);
    svg.end_group();
}
