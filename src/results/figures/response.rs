//! A frequency response: magnitude and phase.

use super::axis::{Axis, Tick, extremes};
use super::colour::SERIES;
use super::panel::Panel;
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::{FigureError, expect_length, expect_some};
use faer::c64;

/// A frequency response.
#[derive(Clone, Debug)]
pub struct ResponsePlot<'a> {
    /// Frequencies, Hz, rising.
    pub frequencies_hz: &'a [f64],
    /// Complex response at each.
    pub values: &'a [c64],
    /// Its unit, for example `m/s²/N`.
    pub unit: String,
}

/// Draws magnitude, logarithmic, and phase over the frequency.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_response(data: &ResponsePlot) -> Result<String, FigureError> {
    expect_some("response", data.frequencies_hz.len())?;
    expect_length("response", data.values.len(), data.frequencies_hz.len())?;
    let kilohertz: Vec<f64> = data.frequencies_hz.iter().map(|f| f * 1e-3).collect();
    let magnitude: Vec<f64> = data.values.iter().map(|h| h.norm()).collect();
    let phase = unbroken(
        &data
            .values
            .iter()
            .map(|h| h.arg().to_degrees())
            .collect::<Vec<_>>(),
    );
    let (low, high) = extremes(magnitude.iter().copied().filter(|&m| m > 0.0));
    let title = format!("|*H*| ({})", data.unit);
    let (from, to) = extremes(kilohertz.iter().copied());
    let x = Axis::linear("frequency *f* (kHz)", from, to);
    let quarters = [-180, -90, 0, 90, 180].map(|degrees| Tick {
        value: f64::from(degrees),
        label: degrees.to_string().replace('-', "−"),
    });
    let axes = [
        (Axis::logarithmic(&title, low * 0.7, high * 1.5), 150.0),
        (
            Axis::linear("phase (°)", -190.0, 190.0).with_ticks(quarters.to_vec()),
            72.0,
        ),
    ];
    let mut svg = Svg::new("response", DOUBLE_COLUMN, 100.0);
    let (left, mut top) = (47.0, 14.0);
    for (index, ((y, height), values)) in axes.into_iter().zip([&magnitude, &phase]).enumerate() {
        let area = Rect::new(left, top, DOUBLE_COLUMN - left - 10.0, height);
        let mut panel = Panel::new(area, x.clone(), y);
        panel.labels_x = index == 1;
        panel.title_distance = Some(36.0);
        panel.draw_ground(&mut svg);
        svg.begin_clip(&panel.area);
        panel.series(&mut svg, &kilohertz, values, &Stroke::solid(SERIES[0], 0.8));
        svg.end_group();
        panel.draw_frame(&mut svg);
        panel_letter(&mut svg, left, top - 4.0, index);
        top += height + 16.0;
    }
    svg.set_height(top - 16.0 + Panel::bottom_margin());
    Ok(svg.finish(
        "Frequency response",
        "Magnitude on a logarithmic axis and phase of the response over the frequency.",
    ))
}

/// Phases with a gap after each that jumps by a turn to the next: no line is drawn through the whole range.
fn unbroken(phase: &[f64]) -> Vec<f64> {
    let jumps = |i: usize| i + 1 < phase.len() && (phase[i + 1] - phase[i]).abs() > 180.0;
    let kept = (0..phase.len()).map(|i| if jumps(i) { f64::NAN } else { phase[i] });
    kept.collect()
}
