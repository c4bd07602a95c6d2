//! The course of a run: acceleration, spectrograms and contact status on one time axis.

use super::axis::{Axis, extremes, prefixed, significant};
use super::colour::{ColourMap, SERIES};
use super::contact_status::{StatusHistory, draw_status_map, status_keys};
use super::legend;
use super::panel::Panel;
use super::prestress::angle_axis;
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg};
use super::time_stack::{
    Loudness, ReferenceFrequency, SpectrogramMap, Stage, TimeStack, draw_references,
    draw_spectrogram, draw_stages, scaled, span,
};
use super::{FigureError, expect_length};

/// Decibels shown below the maximum.
const DEPTH: u32 = 80;

/// What the overview of a run shows; parts that are `None` are left out.
#[derive(Clone, Debug)]
pub struct TransientOverview<'a> {
    /// What the signal is, in mark-up without unit: `node 1641, radial acceleration`.
    pub signal_name: String,
    /// Unit of the signal; empty where it is not known.
    pub signal_unit: String,
    /// Sample times of the signal, s.
    pub times: &'a [f64],
    /// The signal.
    pub signal: &'a [f64],
    /// Its spectrogram.
    pub spectrogram: Option<SpectrogramMap<'a>>,
    /// Highest frequency shown, Hz.
    pub max_frequency_hz: f64,
    /// Modes drawn across the spectrogram.
    pub references: Vec<ReferenceFrequency>,
    /// Contact status over time.
    pub status: Option<StatusHistory<'a>>,
    /// Stages of the run, in order.
    pub stages: Vec<Stage>,
    /// Length of the enlarged end of the run, s; zero for none.
    pub enlarged: f64,
}

/// Draws the overview.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_transient_overview(data: &TransientOverview) -> Result<String, FigureError> {
    expect_length("signal", data.signal.len(), data.times.len())?;
    let range = span(data.times)?;
    let (left, width) = (47.0, 306.0);
    let mut svg = Svg::new("transient-overview", DOUBLE_COLUMN, 100.0);
    let mut stack = TimeStack::new(left, width, 14.0, range);
    draw_signal(&mut svg, &mut stack, data)?;
    if let Some(map) = &data.spectrogram {
        let last = data.status.is_none();
        draw_loudness(&mut svg, &mut stack, data, map, Loudness::Normalized, false)?;
        draw_loudness(
            &mut svg,
            &mut stack,
            data,
            map,
            Loudness::Decibels(DEPTH),
            last,
        )?;
    }
    if let Some(history) = &data.status {
        draw_status(&mut svg, &mut stack, data, history)?;
    }
    svg.set_height(stack.bottom() + 2.0);
    Ok(svg.finish(
        "Course of the run",
        "Signal, spectrograms with the frequencies of the eigenvalue analysis, and contact status, \
         over time.",
    ))
}

fn signal_axis(data: &TransientOverview) -> (f64, Axis) {
    let reach = extremes(data.signal.iter().map(|v| v.abs())).1;
    if data.signal_unit.is_empty() {
        return (1.0, Axis::symmetric("signal", [reach]));
    }
    let (factor, unit) = prefixed(reach, &data.signal_unit);
    // "km/s²" is no unit anyone uses: accelerations stay in m/s² and let the axis take the power.
    let (factor, unit) = if data.signal_unit.contains('/') {
        (1.0, data.signal_unit.clone())
    } else {
        (factor, unit)
    };
    let symbol = if data.signal_unit == "m/s²" {
        "*a*"
    } else {
        "signal"
    };
    (
        factor,
        Axis::symmetric(&format!("{symbol} ({unit})"), [reach * factor]),
    )
}

/// Panel beside the main one that shows the end of the run enlarged.
fn enlarged_panel(data: &TransientOverview, main: &Panel, stack: &TimeStack) -> Option<Panel> {
    let end = main.x.high;
    let length = data.enlarged * stack.factor;
    if !(length > 0.0 && length < end - main.x.low) {
        return None;
    }
    let area = Rect::new(
        main.area.right() + 16.0,
        main.area.y,
        DOUBLE_COLUMN - main.area.right() - 29.0,
        main.area.height,
    );
    let x = Axis::linear(&main.x.title, end - length, end);
    let mut panel = Panel::new(area, x, main.y.clone()).without_y_labels();
    panel.labels_x = main.labels_x;
    Some(panel)
}

fn draw_signal(
    svg: &mut Svg,
    stack: &mut TimeStack,
    data: &TransientOverview,
) -> Result<(), FigureError> {
    let (factor, y) = signal_axis(data);
    let last = data.spectrogram.is_none() && data.status.is_none();
    let panel = stack.push(y, 78.0, last);
    let times = scaled(data.times, stack.factor);
    let values = scaled(data.signal, factor);
    let enlarged = enlarged_panel(data, &panel, stack);
    let captions = [data.signal_name.as_str(), "end of the run"];
    for (index, panel) in [Some(panel), enlarged].iter().flatten().enumerate() {
        panel.draw_ground(svg);
        svg.begin_clip(&panel.area);
        let weight = if index == 0 { 0.45 } else { 0.9 };
        panel.series(svg, &times, &values, &Stroke::solid(SERIES[0], weight));
        svg.end_group();
        if index == 0 {
            draw_stages(svg, panel, &data.stages, stack.factor);
        }
        panel.draw_frame(svg);
        stack.caption(svg, panel, captions[index]);
    }
    Ok(())
}

fn draw_loudness(
    svg: &mut Svg,
    stack: &mut TimeStack,
    data: &TransientOverview,
    map: &SpectrogramMap,
    loudness: Loudness,
    last: bool,
) -> Result<(), FigureError> {
    let y = Axis::linear("frequency *f* (kHz)", 0.0, data.max_frequency_hz * 1e-3);
    let panel = stack.push(y, 92.0, last).without_grid();
    // Half a window at either end has no spectrum.
    svg.rectangle(&panel.area, super::colour::GRID, None);
    draw_spectrogram(svg, &panel, map, loudness, stack.factor)?;
    draw_references(svg, &panel, &data.references);
    panel.draw_frame(svg);
    let (caption, axis) = match loudness {
        Loudness::Normalized => (
            "spectrogram, each window relative to its own maximum",
            Axis::linear("amplitude / max (–)", 0.0, 1.0),
        ),
        Loudness::Decibels(depth) => (
            "spectrogram, relative to the maximum of the run",
            Axis::linear("level (dB)", -f64::from(depth), 0.0),
        ),
    };
    stack.caption(svg, &panel, caption);
    let x = DOUBLE_COLUMN - 42.0;
    let bar = Rect::new(x, panel.area.y, 6.0, panel.area.height);
    legend::draw_colour_bar(svg, &bar, &axis, ColourMap::Inferno);
    Ok(())
}

fn draw_status(
    svg: &mut Svg,
    stack: &mut TimeStack,
    data: &TransientOverview,
    history: &StatusHistory,
) -> Result<(), FigureError> {
    let panel = stack
        .push(angle_axis("angle *θ* (°)"), 92.0, true)
        .without_grid();
    let enlarged = enlarged_panel(data, &panel, stack);
    for (index, panel) in [Some(panel.clone()), enlarged].iter().flatten().enumerate() {
        let strobe = draw_status_map(svg, panel, history, stack.factor)?;
        panel.draw_frame(svg);
        let caption = match (index, strobe) {
            (0, None) => "contact status".into(),
            (0, Some(interval)) => {
                let interval = significant(interval * 1e3, 3);
                format!("contact status, strobed every {interval} ms")
            }
            _ => "end of the run".to_string(),
        };
        stack.caption(svg, panel, &caption);
    }
    let keys = status_keys();
    let x = panel.area.right() - 122.0;
    legend::draw_legend(svg, x, panel.area.y - 11.5, 140.0, &keys);
    Ok(())
}
