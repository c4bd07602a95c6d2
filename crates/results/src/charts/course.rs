//! The course of a signal: samples, spectrograms, spectrum.

use super::palette::{UNSTABLE, centred};
use crate::prelude::*;
use frictionsim_chart::GRID;
use frictionsim_signal::{Spectrogram, top_of};

/// A mode of the eigenvalue analysis, drawn as a line over what a signal contains.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeLine {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Name in mark-up, for example `mode 5, *n* = 2`.
    pub label: String,
}

/// Start of a named stage of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// A letter and what it stands for, as `A: rest`.
    pub meaning: &'static str,
    /// Start, s.
    pub start: f64,
}

/// Decibels shown below the maximum of a spectrogram.
const DEPTH: f64 = 80.0;
/// Windows that are this much weaker than the loudest hold round-off, and are left blank where each is shown relative
/// to its own maximum.
const SILENCE: f64 = 1e-10;

/// First and last of rising times; 0 and 1 where there is none.
pub fn ends(times: &[f64]) -> (f64, f64) {
    extremes([times.first(), times.last()].into_iter().flatten().copied())
}

/// The time axis of a run up to the round number just above its last sample, if only a sample is missing.
pub fn run_axis(times: &[f64]) -> Axis {
    let (low, high) = ends(times);
    let unit = 10f64.powf(high.abs().max(1e-300).log10().floor() - 1.0);
    let round = (high / unit).round() * unit;
    let is_near = round > high && round - high < 1e-3 * high;
    Axis::time().between(low, if is_near { round } else { high })
}

/// The samples over time; a unit that is no unit shows none.
pub fn signal_panel(
    time: Axis,
    times: &[f64],
    signal: &[f64],
    (symbol, unit): (&str, &str),
    width: f64,
) -> Panel {
    // "km/s²" is no unit anyone uses: accelerations stay in m/s² and let the axis take the power.
    let y = Axis::new(symbol, unit).including(0.0).room(0.06);
    Panel::new(time, y).height(78.0).layer(Line::new(times, signal).solid(SERIES[0], width).whole())
}

/// Lines at the starts of stages, and their letters in the middle of each along the top of a panel.
pub fn with_stages(panel: Panel, stages: &[Stage], (start, end): (f64, f64), top: f64) -> Panel {
    let ends = stages.iter().skip(1).map(|next| next.start).chain([end]);
    let names = stages.iter().zip(ends).map(|(stage, end)| {
        let middle = 0.5 * (stage.start.max(start) + end);
        Label::new((middle, top), &stage.meaning[..1]).style(centred(7.5).bold()).moved(0.0, 9.0)
    });
    let starts = stages.iter().filter(|stage| stage.start > start);
    panel
        .layers(starts.map(|stage| Rule::vertical(stage.start).stroke(Stroke::dotted(MUTED, 0.6))))
        .layers(names)
}

/// The spectrogram with each window relative to its own maximum, and in decibels relative to the maximum of the whole.
pub fn spectrogram_panels(
    time: &Axis,
    map: &Spectrogram,
    start: f64,
    highest_hz: f64,
    modes: &[ModeLine],
) -> Vec<Panel> {
    let (windows, lines) = (map.times.len(), map.frequencies_hz.len());
    if windows < 2 || lines < 2 {
        return Vec::new();
    }
    let columns = windows.min(700);
    let row = |column: usize| {
        let window = (2 * column + 1) * windows / (2 * columns);
        &map.magnitudes[window * lines..(window + 1) * lines]
    };
    let maxima: Vec<f64> =
        (0..columns).map(|column| extremes(row(column).iter().copied()).1).collect();
    let loudest = extremes(map.magnitudes.iter().copied()).1.max(1e-300);
    let relative = |column: usize, line: usize| match maxima[column] > SILENCE * loudest {
        true => row(column)[line] / maxima[column],
        false => f64::NAN,
    };
    let decibels =
        |column: usize, line: usize| 20.0 * (row(column)[line] / loudest).max(1e-30).log10();
    let hop = (map.times[windows - 1] - map.times[0]) / (windows - 1) as f64;
    let spacing = map.frequencies_hz[1] - map.frequencies_hz[0];
    let x = (start + map.times[0] - 0.5 * hop, start + map.times[windows - 1] + 0.5 * hop);
    let y = (map.frequencies_hz[0] - 0.5 * spacing, map.frequencies_hz[lines - 1] + 0.5 * spacing);
    let panel = |caption: &str, heat: Heat| {
        let rules = modes.iter().map(|mode| {
            let text = format!("{:.2} kHz, {}", mode.frequency_hz * 1e-3, mode.label);
            Rule::horizontal(mode.frequency_hz).stroke(Stroke::dashed("#7fd3ff", 0.6)).at_rim(text)
        });
        // Half a window at either end has no spectrum.
        let ground = Shapes::bands(vec![(f64::MIN, f64::MAX, GRID)]);
        Panel::new(time.clone(), Axis::kilohertz().between(0.0, highest_hz))
            .plain()
            .height(92.0)
            .caption(caption)
            .layer(ground)
            .layer(heat)
            .layers(rules)
            .colour_bar(Side::Right)
    };
    let heat = |axis: Axis, value: &dyn Fn(usize, usize) -> f64| {
        Heat::of_values((x, columns), (y, lines), (axis, ColourMap::Inferno), value)
    };
    let amplitude = heat(Axis::new("amplitude / max", "–").between(0.0, 1.0), &relative);
    let level = heat(Axis::new("level", "dB").between(-DEPTH, 0.0), &decibels);
    vec![
        panel("spectrogram, each window relative to its own maximum", amplitude),
        panel("spectrogram, relative to the maximum of the whole signal", level),
    ]
}

/// Spectra of several components on one logarithmic axis, with the modes named above, and the main frequency of the
/// first component (its strongest where none is given) and its multiples marked where they stand out.
pub fn spectrum_panel(
    spectra: &[(&str, &AmplitudeSpectrum)],
    unit: &str,
    (highest_hz, main_hz): (f64, Option<f64>),
    modes: &[ModeLine],
) -> Panel {
    let rules = modes.iter().map(|mode| {
        let name = mode.label.split(',').next().unwrap_or_default();
        let stroke = Stroke::dashed(UNSTABLE, 0.7);
        Rule::vertical(mode.frequency_hz)
            .stroke(stroke)
            .at_rim(name)
            .name("mode of the eigenvalue analysis")
    });
    let lines = spectra.iter().enumerate().rev().map(|(index, (name, spectrum))| {
        let line = Line::new(&spectrum.frequencies_hz, &spectrum.amplitudes).name(*name);
        line.solid(SERIES[index], if index == 0 { 0.8 } else { 0.5 })
    });
    let panel = Panel::new(
        Axis::kilohertz().between(0.0, highest_hz),
        Axis::new("amplitude", unit).room(0.05).decades(6.0),
    );
    let peaks = spectra.first().map(|first| multiples(first.1, highest_hz, main_hz));
    panel.height(150.0).layers(rules).layers(lines).layers(peaks.unwrap_or_default())
}

/// Labels at a main frequency and at its whole multiples, where they stand out of what lies around them: at the tops of
/// the lines, with the frequency given, or with that of the strongest line between the values of the spectrum.
fn multiples(spectrum: &AmplitudeSpectrum, highest_hz: f64, main_hz: Option<f64>) -> Vec<Label> {
    let (frequencies, amplitudes) = (&spectrum.frequencies_hz, &spectrum.amplitudes);
    let count = frequencies.partition_point(|&f| f <= highest_hz).min(amplitudes.len());
    let (frequencies, amplitudes) = (&frequencies[..count], &amplitudes[..count]);
    let largest = |from: usize, to: usize| {
        let range = from.min(count)..to.min(count);
        range.max_by(|&a, &b| amplitudes[a].total_cmp(&amplitudes[b]))
    };
    let strongest = || {
        let peak = largest(1, count).filter(|&peak| amplitudes[peak] > 0.0)?;
        let near = amplitudes.get(peak - 1..peak + 2).and_then(|near| near.try_into().ok());
        let shift = near.map_or(0.0, |near| top_of(near).0);
        Some(frequencies[peak] + shift * (frequencies[peak] - frequencies[peak - 1]))
    };
    let Some(main) = main_hz.or_else(strongest).filter(|main| *main > 0.0) else {
        return Vec::new();
    };
    let place = |hz: f64| frequencies.partition_point(|&f| f < hz);
    let mut labels = Vec::new();
    for multiple in 1..=6 {
        let centre = f64::from(multiple) * main;
        // A line lies within a few values of the spectrum, and within a twentieth of the main frequency, of its place.
        let (from, to) = (place(centre - 0.05 * main), place(centre + 0.05 * main) + 1);
        let Some(peak) = largest(from, to).filter(|_| centre <= highest_hz) else { break };
        let (from, to) = (place(centre - 0.5 * main), place(centre + 0.5 * main));
        let mut around: Vec<f64> = amplitudes[from..to.max(from)].to_vec();
        around.sort_by(f64::total_cmp);
        let median = around.get(around.len() / 2);
        if median.is_some_and(|median| amplitudes[peak] > 5.0 * median) {
            let name = match multiple {
                1 => format!("*f* = {:.3} kHz", main * 1e-3),
                _ => format!("{multiple}*f*"),
            };
            labels.push(Label::new((frequencies[peak], amplitudes[peak]), name).above());
        }
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_chart::Figure;
    use frictionsim_signal::{Window, averaged_spectrum};

    /// Main frequency that a drawn spectrum names, kHz.
    fn named(samples: &[f64], rate: f64, main_hz: Option<f64>) -> f64 {
        let count = samples.len();
        let spectrum = averaged_spectrum(samples, rate, Window::Hann, count, 2).unwrap();
        let panel = spectrum_panel(&[("signal", &spectrum)], "", (3e4, main_hz), &[]);
        let svg = Figure::new("spectrum", "Spectrum.").panel(panel).to_svg(None).unwrap();
        svg.split(" = ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap()
    }

    #[test]
    fn a_spectrum_names_the_frequency_and_not_the_value_beside_it() {
        // Values of the spectrum are 250 Hz apart: 9.5 kHz lies beside 9433 Hz.
        let (rate, main) = (5e5, 9433.0);
        let time = |i: usize| i as f64 / rate;
        let wave = |t: f64, f: f64| (std::f64::consts::TAU * f * t).sin();
        let tone: Vec<f64> = (0..1000).map(|i| wave(time(i), main)).collect();
        assert!((named(&tone, rate, None) - 9.433).abs() < 0.002);
        assert_eq!(named(&tone, rate, Some(main)), 9.433);
        // The second harmonic is the strongest line; the main frequency is known all the same.
        let both: Vec<f64> =
            (0..1000).map(|i| wave(time(i), main) + 3.0 * wave(time(i), 2.0 * main)).collect();
        assert_eq!(named(&both, rate, Some(main)), 9.433);
    }
}
