//! Growth of the harmonics of the contact edge, beside the rates of the eigenvalue analysis.

use super::axis::{Axis, extremes, significant};
use super::colour::{INK, MUTED, SERIES};
use super::legend::{self, Key};
use super::svg::{DOUBLE_COLUMN, Stroke, Svg};
use super::text::TextStyle;
use super::time_stack::{TimeStack, scaled, span};
use super::{FigureError, expect_length, expect_some};

/// Rate that the eigenvalue analysis predicts for one harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedGrowth {
    /// Harmonic.
    pub harmonic: usize,
    /// Growth rate, 1/s.
    pub rate_per_s: f64,
    /// Part of the run, s, where the prediction is laid through the amplitude.
    pub window: (f64, f64),
}

/// Amplitude of each harmonic over time.
#[derive(Clone, Debug)]
pub struct HarmonicGrowth<'a> {
    /// Times, s.
    pub times: &'a [f64],
    /// Harmonic and its amplitude at each time, m.
    pub amplitudes: Vec<(usize, &'a [f64])>,
    /// Predictions drawn as dashed lines.
    pub predictions: Vec<PredictedGrowth>,
    /// Time of the first status other than slip, s.
    pub first_nonlinearity: Option<f64>,
}

/// Decades below the largest amplitude that are shown at most.
const DECADES: i32 = 9;

/// Lengths of the linear stage that are shown: behind it nothing grows for long.
const SHOWN_STAGES: f64 = 3.0;

/// Draws the amplitudes on a logarithmic axis.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_harmonic_growth(data: &HarmonicGrowth) -> Result<String, FigureError> {
    let mut range = span(data.times)?;
    if let Some(time) = data.first_nonlinearity {
        range.1 = range.1.min(range.0 + SHOWN_STAGES * (time - range.0));
    }
    expect_some("harmonics", data.amplitudes.len())?;
    for (harmonic, amplitude) in &data.amplitudes {
        let what = format!("amplitude of harmonic {harmonic}");
        expect_length(&what, amplitude.len(), data.times.len())?;
    }
    let mut svg = Svg::new("harmonic-growth", DOUBLE_COLUMN, 100.0);
    let (left, width) = (50.0, DOUBLE_COLUMN - 62.0);
    let mut entries: Vec<(Key, String)> = data
        .amplitudes
        .iter()
        .enumerate()
        .map(|(index, (harmonic, _))| {
            let (colour, dash) = line_style(index);
            let key = Key::Line(colour.into(), 1.1, dash.to_vec());
            (key, format!("*n* = {harmonic}"))
        })
        .collect();
    let axis = amplitude_axis(data);
    let lines: Vec<(PredictedGrowth, f64)> = data
        .predictions
        .iter()
        .filter_map(|&prediction| Some((prediction, offset(data, &prediction)?)))
        .filter(|&(prediction, offset)| {
            (offset + prediction.rate_per_s * prediction.window.1).exp() > axis.low
        })
        .collect();
    if !lines.is_empty() {
        let rates = lines.iter().map(|(prediction, _)| {
            let rate = significant(prediction.rate_per_s, 4);
            format!("*n* = {}: {rate} s^{{−1}}", prediction.harmonic)
        });
        let rates = rates.collect::<Vec<_>>().join(", ");
        let text = format!("rate of the eigenvalue analysis, {rates}");
        entries.push((Key::dashed(INK), text));
    }
    legend::draw_legend(&mut svg, left, 2.0, width, &entries);
    let top = 6.0 + legend::legend_height(&entries, width);
    let mut stack = TimeStack::new(left, width, top, range);
    let panel = stack.push(axis, 190.0, true);
    panel.draw_ground(&mut svg);
    svg.begin_clip(&panel.area);
    let times = scaled(data.times, stack.factor);
    for (index, (_, amplitude)) in data.amplitudes.iter().enumerate() {
        let (colour, dash) = line_style(index);
        let stroke = Stroke {
            dash,
            ..Stroke::solid(colour, 0.8)
        };
        panel.series(&mut svg, &times, amplitude, &stroke);
    }
    svg.end_group();
    svg.begin_clip(&panel.area);
    for (prediction, offset) in &lines {
        let (from, to) = prediction.window;
        let at = |t: f64| (offset + prediction.rate_per_s * t).exp();
        let line = [from, to].map(|t| (panel.at_x(t * stack.factor), panel.at_y(at(t))));
        svg.line(line[0], line[1], &Stroke::dashed(INK, 1.1));
    }
    svg.end_group();
    if let Some(time) = data.first_nonlinearity {
        let stroke = Stroke {
            dash: &[1.0, 1.6],
            ..Stroke::solid(MUTED, 0.7)
        };
        panel.vertical(&mut svg, time * stack.factor, &stroke);
        let style = TextStyle::new(6.75).rotated(-90.0).with_halo();
        let x = panel.at_x(time * stack.factor) - 2.5;
        let y = panel.area.bottom() - 5.0;
        svg.text(x, y, "first stick or separation", &style);
    }
    panel.draw_frame(&mut svg);
    svg.set_height(stack.bottom());
    Ok(svg.finish(
        "Growth of the harmonics of the contact edge",
        "Amplitude of each circumferential harmonic of the tangential displacement over time, with \
         the growth rates of the eigenvalue analysis as dashed lines.",
    ))
}

fn line_style(index: usize) -> (&'static str, &'static [f64]) {
    let dash: &[f64] = if index < SERIES.len() {
        &[]
    } else {
        &[1.2, 1.2]
    };
    (SERIES[index % SERIES.len()], dash)
}

fn amplitude_axis(data: &HarmonicGrowth) -> Axis {
    let all = data.amplitudes.iter().flat_map(|(_, a)| a.iter().copied());
    let (low, high) = extremes(all.filter(|&a| a > 0.0));
    let top = 10f64.powf(high.max(1e-300).log10() + 0.3);
    let floor = (low * 0.5).max(top * 10f64.powi(-DECADES));
    Axis::logarithmic("amplitude of *u*_{θ} (m)", floor, top)
}

/// Logarithm of the amplitude that a prediction has at time zero, laid through its harmonic's amplitude
/// over its window; `None` without amplitude there.
fn offset(data: &HarmonicGrowth, prediction: &PredictedGrowth) -> Option<f64> {
    let own = |(harmonic, _): &&(usize, &[f64])| *harmonic == prediction.harmonic;
    let (_, amplitude) = data.amplitudes.iter().find(own)?;
    let (from, to) = prediction.window;
    let offsets: Vec<f64> = data
        .times
        .iter()
        .zip(*amplitude)
        .filter(|&(&t, &a)| (from..=to).contains(&t) && a > 0.0)
        .map(|(&t, &a)| a.ln() - prediction.rate_per_s * t)
        .collect();
    (!offsets.is_empty()).then(|| offsets.iter().sum::<f64>() / offsets.len() as f64)
}
