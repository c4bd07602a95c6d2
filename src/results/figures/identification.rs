//! Identification of the damping: response with half-power points, damping factors with their fit.

use super::axis::{Axis, extremes, significant};
use super::colour::{INK, SERIES, UNSTABLE};
use super::legend::{self, Key};
use super::panel::{Marker, Panel};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::{FigureError, expect_length, expect_some};
use std::f64::consts::TAU;

/// One resonance found in a response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// Frequency of the peak, Hz.
    pub frequency_hz: f64,
    /// Lower and upper half-power frequency, Hz.
    pub half_power_hz: (f64, f64),
    /// Damping factor.
    pub damping_factor: f64,
}

/// A response and what was identified from it.
#[derive(Clone, Debug)]
pub struct DampingIdentification<'a> {
    /// Frequencies of the response, Hz, rising.
    pub frequencies_hz: &'a [f64],
    /// Magnitude of the response.
    pub magnitude: &'a [f64],
    /// Unit of the magnitude, for example `m/s²/N`.
    pub magnitude_unit: String,
    /// Resonances.
    pub resonances: Vec<Resonance>,
    /// Fitted `alpha_R`, 1/s.
    pub mass_coefficient: f64,
    /// Fitted `beta_R`, s.
    pub stiffness_coefficient: f64,
    /// Lower and upper bound (95 %) of `alpha_R`, 1/s.
    pub mass_interval: (f64, f64),
    /// Lower and upper bound (95 %) of `beta_R`, s.
    pub stiffness_interval: (f64, f64),
}

/// Draws response and fit side by side.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_damping_identification(data: &DampingIdentification) -> Result<String, FigureError> {
    expect_some("response", data.frequencies_hz.len())?;
    expect_some("resonances", data.resonances.len())?;
    expect_length("magnitude", data.magnitude.len(), data.frequencies_hz.len())?;
    let mut svg = Svg::new("identification", DOUBLE_COLUMN, 100.0);
    let height = 150.0;
    draw_response(&mut svg, height, data);
    draw_fit(&mut svg, height, data);
    let entries = [
        (
            Key::Point(Marker::Disc, INK.into()),
            "peak, identified factor".to_string(),
        ),
        (
            Key::Point(Marker::Diamond, UNSTABLE.into()),
            "half-power points".into(),
        ),
        (
            Key::line(SERIES[0]),
            "*ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2".into(),
        ),
        (
            Key::dashed(SERIES[2]),
            format!(
                "*α*_{{R}} = {} [{}, {}] 1/s",
                significant(data.mass_coefficient, 3),
                significant(data.mass_interval.0, 3),
                significant(data.mass_interval.1, 3)
            ),
        ),
        (
            Key::dashed(SERIES[1]),
            format!(
                "*β*_{{R}} = {} [{}, {}] s",
                significant(data.stiffness_coefficient, 3),
                significant(data.stiffness_interval.0, 3),
                significant(data.stiffness_interval.1, 3)
            ),
        ),
    ];
    let y = 16.0 + height + Panel::bottom_margin() + 2.0;
    legend::draw_legend(&mut svg, 42.0, y, DOUBLE_COLUMN - 46.0, &entries);
    svg.set_height(y + legend::legend_height(&entries, DOUBLE_COLUMN - 46.0) + 2.0);
    Ok(svg.finish(
        "Identification of the Rayleigh coefficients",
        "Frequency response with half-power points, and damping factors with the fitted curve and \
         its two parts.",
    ))
}

fn draw_response(svg: &mut Svg, height: f64, data: &DampingIdentification) {
    let kilohertz: Vec<f64> = data.frequencies_hz.iter().map(|f| f * 1e-3).collect();
    let (low, high) = extremes(data.magnitude.iter().copied().filter(|&m| m > 0.0));
    let title = format!("|*H*| ({})", data.magnitude_unit);
    let y = Axis::logarithmic(&title, low * 0.7, high * 1.6);
    let (from, to) = extremes(kilohertz.iter().copied());
    let x = Axis::linear("frequency *f* (kHz)", from, to);
    let panel = Panel::new(Rect::new(44.0, 16.0, 196.0, height), x, y);
    panel.draw_ground(svg);
    let stroke = Stroke::solid(SERIES[0], 0.7);
    panel.series(svg, &kilohertz, data.magnitude, &stroke);
    let at = |frequency: f64| interpolate(data.frequencies_hz, data.magnitude, frequency);
    let peaks = data.resonances.iter().map(|r| r.frequency_hz);
    let peaks = peaks.map(|f| (f * 1e-3, at(f)));
    let halves = data.resonances.iter().flat_map(|r| {
        // By definition they lie a factor sqrt(2) below the peak.
        let level = at(r.frequency_hz) / std::f64::consts::SQRT_2;
        [r.half_power_hz.0, r.half_power_hz.1].map(|f| (f * 1e-3, level))
    });
    panel.points(svg, halves, Marker::Diamond, 1.3, UNSTABLE);
    panel.points(svg, peaks, Marker::Disc, 1.6, INK);
    panel.draw_frame(svg);
    panel_letter(svg, 44.0, 12.0, 0);
}

fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let after = xs.partition_point(|&v| v < x).min(xs.len() - 1);
    let before = after.saturating_sub(1);
    if xs[after] == xs[before] {
        return ys[after];
    }
    let part = ((x - xs[before]) / (xs[after] - xs[before])).clamp(0.0, 1.0);
    ys[before] + part * (ys[after] - ys[before])
}

fn draw_fit(svg: &mut Svg, height: f64, data: &DampingIdentification) {
    let top = extremes(data.resonances.iter().map(|r| r.damping_factor)).1 * 100.0;
    let last = extremes(data.frequencies_hz.iter().copied()).1 * 1e-3;
    let x = Axis::linear("frequency *f* (kHz)", 0.0, last);
    let y = Axis::linear("damping factor *ζ* (%)", 0.0, top * 1.35);
    let panel = Panel::new(Rect::new(298.0, 16.0, 196.0, height), x, y);
    panel.draw_ground(svg);
    let kilohertz: Vec<f64> = (1..=300).map(|i| last * f64::from(i) / 300.0).collect();
    let part = |mass: f64, stiffness: f64| -> Vec<f64> {
        kilohertz
            .iter()
            .map(|f| {
                let omega = TAU * f * 1e3;
                50.0 * (mass / omega + stiffness * omega)
            })
            .collect()
    };
    let (mass, stiffness) = (data.mass_coefficient, data.stiffness_coefficient);
    svg.begin_clip(&panel.area);
    for (values, stroke) in [
        (part(mass, 0.0), Stroke::dashed(SERIES[2], 0.9)),
        (part(0.0, stiffness), Stroke::dashed(SERIES[1], 0.9)),
        (part(mass, stiffness), Stroke::solid(SERIES[0], 1.2)),
    ] {
        panel.curve(svg, &kilohertz, &values, &stroke);
    }
    let found = data
        .resonances
        .iter()
        .map(|r| (r.frequency_hz * 1e-3, 100.0 * r.damping_factor));
    panel.points(svg, found, Marker::Disc, 2.0, INK);
    svg.end_group();
    panel.draw_frame(svg);
    panel_letter(svg, 298.0, 12.0, 1);
}
