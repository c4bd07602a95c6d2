//! The amplitude spectrum of a signal beside the frequencies of the eigenvalue analysis.

use super::axis::{Axis, extremes};
use super::colour::{EIGENVALUE, SERIES};
use super::legend::{self, Key};
use super::panel::Panel;
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg};
use super::text::{self, TextStyle};
use super::time_stack::{ReferenceFrequency, spread};
use super::{FigureError, expect_length, expect_some};

/// An amplitude spectrum.
#[derive(Clone, Debug)]
pub struct SpectrumPlot<'a> {
    /// What the signal is, in mark-up.
    pub signal_name: String,
    /// Unit of the amplitude; empty where it is not known.
    pub unit: String,
    /// Frequencies, Hz, rising.
    pub frequencies_hz: &'a [f64],
    /// Amplitude at each frequency.
    pub amplitude: &'a [f64],
    /// Highest frequency shown, Hz.
    pub max_frequency_hz: f64,
    /// Modes drawn as vertical lines.
    pub references: Vec<ReferenceFrequency>,
}

/// Decades below the maximum that are shown at most.
const DECADES: i32 = 6;

/// Draws the spectrum on a logarithmic amplitude axis.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_spectrum(data: &SpectrumPlot) -> Result<String, FigureError> {
    expect_some("spectrum", data.amplitude.len())?;
    expect_length("amplitude", data.amplitude.len(), data.frequencies_hz.len())?;
    let count = data
        .frequencies_hz
        .partition_point(|&f| f <= data.max_frequency_hz);
    let kilohertz: Vec<f64> = data.frequencies_hz[..count]
        .iter()
        .map(|f| f * 1e-3)
        .collect();
    let shown = &data.amplitude[..count];
    let (low, high) = extremes(shown.iter().copied().filter(|&a| a > 0.0));
    let floor = (0.7 * low).max(high * 10f64.powi(-DECADES));
    let title = match data.unit.as_str() {
        "" => "amplitude".to_owned(),
        unit => format!("amplitude ({unit})"),
    };
    let y = Axis::logarithmic(&title, floor, 2.5 * high);
    let x = Axis::linear("frequency *f* (kHz)", 0.0, data.max_frequency_hz * 1e-3);
    let names = data
        .references
        .iter()
        .map(|reference| text::width(&reference.label, NAME_SIZE, false))
        .fold(0.0, f64::max);
    let top = if names > 0.0 { names + 24.0 } else { 16.0 };
    let (left, height) = (50.0, 150.0);
    let mut svg = Svg::new("spectrum", DOUBLE_COLUMN, 100.0);
    let entries = [
        (Key::line(SERIES[0]), data.signal_name.clone()),
        (
            Key::dashed(EIGENVALUE),
            "mode of the eigenvalue analysis".into(),
        ),
    ];
    let entries = &entries[..if data.references.is_empty() { 1 } else { 2 }];
    legend::draw_legend(&mut svg, left, 2.0, DOUBLE_COLUMN - left, entries);
    let area = Rect::new(left, top, DOUBLE_COLUMN - left - 12.0, height);
    let panel = Panel::new(area, x, y);
    panel.draw_ground(&mut svg);
    draw_lines(&mut svg, &panel, &data.references);
    svg.begin_clip(&panel.area);
    panel.series(&mut svg, &kilohertz, shown, &Stroke::solid(SERIES[0], 0.8));
    svg.end_group();
    panel.draw_frame(&mut svg);
    svg.set_height(area.bottom() + Panel::bottom_margin());
    Ok(svg.finish(
        &format!("Spectrum of {}", data.signal_name),
        "Amplitude over frequency, with the frequencies of the eigenvalue analysis as dashed lines.",
    ))
}

/// Size of the names above the panel, points.
const NAME_SIZE: f64 = 6.0;

/// Vertical lines with upright names above the panel.
fn draw_lines(svg: &mut Svg, panel: &Panel, references: &[ReferenceFrequency]) {
    let mut sorted: Vec<&ReferenceFrequency> = references
        .iter()
        .filter(|r| (0.0..=1.0).contains(&panel.x.fraction(r.frequency_hz * 1e-3)))
        .collect();
    sorted.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    let wanted: Vec<f64> = sorted
        .iter()
        .map(|r| panel.at_x(r.frequency_hz * 1e-3))
        .collect();
    let places = spread(&wanted, 8.0, panel.area.x + 4.0, panel.area.right());
    let top = panel.area.y;
    for ((reference, &x), &label_x) in sorted.iter().zip(&wanted).zip(&places) {
        panel.vertical(
            svg,
            reference.frequency_hz * 1e-3,
            &Stroke::dashed(EIGENVALUE, 0.7),
        );
        svg.line(
            (x, top),
            (label_x, top - 5.0),
            &Stroke::solid(EIGENVALUE, 0.4),
        );
        let style = TextStyle::new(NAME_SIZE).rotated(-90.0);
        svg.text(label_x + 2.1, top - 6.5, &reference.label, &style);
    }
}
