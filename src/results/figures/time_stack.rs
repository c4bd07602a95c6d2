//! Panels one above the other on one time axis, and maps over time.

use super::axis::{Axis, extremes, prefixed};
use super::colour::{ColourMap, INK, MUTED};
use super::panel::Panel;
use super::raster::{self, FINE, IndexedImage, level_of};
use super::svg::{Rect, Stroke, Svg, panel_letter};
use super::text::{Anchor, TextStyle};
use super::{FigureError, expect_length, expect_some};

/// A mode of the complex eigenvalue analysis, shown as a line across a spectrogram.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceFrequency {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Name in mark-up, for example `mode 5, *n* = 2`.
    pub label: String,
}

/// Start of a named stage of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// A letter or a short word.
    pub name: String,
    /// Start, s.
    pub start: f64,
}

/// Magnitudes of a spectrogram.
#[derive(Clone, Copy, Debug)]
pub struct SpectrogramMap<'a> {
    /// Centre of each window, s, evenly spaced.
    pub times: &'a [f64],
    /// Frequency of each line, Hz, evenly spaced.
    pub frequencies_hz: &'a [f64],
    /// Amplitude, window by window, all lines of one window together.
    pub amplitude: &'a [f64],
}

/// Stacked panels that share a time axis.
#[derive(Clone, Debug)]
pub(super) struct TimeStack {
    time: Axis,
    /// Factor from seconds to the unit of the axis.
    pub factor: f64,
    left: f64,
    width: f64,
    next: f64,
    gap: f64,
    letters: usize,
}

impl TimeStack {
    /// A stack from `top` downwards for times between `range` (s).
    pub fn new(left: f64, width: f64, top: f64, range: (f64, f64)) -> Self {
        let (factor, unit) = prefixed(range.1.abs().max(range.0.abs()) * 0.999, "s");
        let range = (range.0, rounded_end(range.1));
        Self {
            time: Axis::linear(
                &format!("time *t* ({unit})"),
                range.0 * factor,
                range.1 * factor,
            ),
            factor,
            left,
            width,
            next: top,
            gap: 13.0,
            letters: 0,
        }
    }

    /// The next panel; only the last shows the time labels.
    pub fn push(&mut self, y: Axis, height: f64, last: bool) -> Panel {
        let area = Rect::new(self.left, self.next, self.width, height);
        self.next += height + self.gap;
        let mut panel = Panel::new(area, self.time.clone(), y);
        panel.labels_x = last;
        panel.title_distance = Some(self.left - 9.0);
        panel
    }

    /// Letter and caption above a panel.
    pub fn caption(&mut self, svg: &mut Svg, panel: &Panel, caption: &str) {
        let baseline = panel.area.y - 3.2;
        panel_letter(svg, panel.area.x, baseline, self.letters);
        self.letters += 1;
        svg.text(
            panel.area.x + 16.0,
            baseline,
            caption,
            &TextStyle::new(6.75),
        );
    }

    /// Lower end of the drawing once all panels are pushed.
    pub fn bottom(&self) -> f64 {
        self.next - self.gap + Panel::bottom_margin()
    }
}

/// The end of a time axis: the round number just above the last sample, if there is one so near that
/// only a sample is missing.
fn rounded_end(end: f64) -> f64 {
    if end <= 0.0 {
        return end;
    }
    let unit = 10f64.powf(end.log10().floor() - 1.0);
    let round = (end / unit).round() * unit;
    if round > end && round - end < 1e-3 * end {
        round
    } else {
        end
    }
}

/// First and last time of a series.
pub(super) fn span(times: &[f64]) -> Result<(f64, f64), FigureError> {
    expect_some("time series", times.len())?;
    Ok((times[0], times[times.len() - 1]))
}

/// Times in the unit of the axis.
pub(super) fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

/// Lines at the stage boundaries, letters in the middle of each stage along the top.
pub(super) fn draw_stages(svg: &mut Svg, panel: &Panel, stages: &[Stage], factor: f64) {
    let stroke = Stroke {
        dash: &[1.0, 1.6],
        ..Stroke::solid(MUTED, 0.6)
    };
    let style = TextStyle::new(7.5)
        .bold()
        .anchored(Anchor::Middle)
        .with_halo();
    for (index, stage) in stages.iter().enumerate() {
        let start = stage.start * factor;
        let end = stages
            .get(index + 1)
            .map_or(panel.x.high, |next| next.start * factor);
        if start > panel.x.low {
            panel.vertical(svg, start, &stroke);
        }
        let middle = 0.5 * (start.max(panel.x.low) + end.min(panel.x.high));
        svg.text(
            panel.at_x(middle),
            panel.area.y + 9.0,
            &super::text::literal(&stage.name),
            &style,
        );
    }
}

/// How the amplitudes of a spectrogram become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loudness {
    /// Each window relative to its own maximum.
    Normalized,
    /// Decibels below the maximum of all windows, over this many decibels.
    Decibels(u32),
}

/// Windows that are this much weaker than the loudest hold round-off, and are left blank where each is
/// shown relative to its own maximum.
const SILENCE: f64 = 1e-10;

/// Draws a spectrogram into a panel whose axes are time and kilohertz.
pub(super) fn draw_spectrogram(
    svg: &mut Svg,
    panel: &Panel,
    map: &SpectrogramMap,
    loudness: Loudness,
    factor: f64,
) -> Result<(), FigureError> {
    let (windows, lines) = (map.times.len(), map.frequencies_hz.len());
    expect_some("second spectrogram window", windows.saturating_sub(1))?;
    expect_some("second spectrogram line", lines.saturating_sub(1))?;
    expect_length("spectrogram", map.amplitude.len(), windows * lines)?;
    let spacing = map.frequencies_hz[1] - map.frequencies_hz[0];
    let shown = map
        .frequencies_hz
        .iter()
        .take_while(|&&f| (f - 0.5 * spacing) * 1e-3 < panel.y.high)
        .count()
        .max(1);
    let columns = windows.min(700);
    let loudest = extremes(map.amplitude.iter().copied()).1;
    let mut image = IndexedImage {
        width: columns,
        height: shown,
        pixels: vec![0; columns * shown],
    };
    for column in 0..columns {
        let window = (2 * column + 1) * windows / (2 * columns);
        let values = &map.amplitude[window * lines..(window + 1) * lines];
        let own = extremes(values.iter().copied()).1;
        for (line, &value) in values.iter().take(shown).enumerate() {
            let level = match loudness {
                Loudness::Normalized if own <= SILENCE * loudest => {
                    level_of(f64::NAN, 0.0, 1.0, FINE)
                }
                Loudness::Normalized => level_of(value / own.max(1e-300), 0.0, 1.0, FINE),
                Loudness::Decibels(depth) => {
                    let decibels = 20.0 * (value / loudest.max(1e-300)).max(1e-30).log10();
                    level_of(decibels, -f64::from(depth), 0.0, FINE)
                }
            };
            image.pixels[(shown - 1 - line) * columns + column] = level;
        }
    }
    let hop = (map.times[windows - 1] - map.times[0]) / (windows - 1) as f64;
    let left = panel.at_x((map.times[0] - 0.5 * hop) * factor);
    let right = panel.at_x((map.times[windows - 1] + 0.5 * hop) * factor);
    let low = panel.at_y((map.frequencies_hz[0] - 0.5 * spacing) * 1e-3);
    let high = panel.at_y((map.frequencies_hz[shown - 1] + 0.5 * spacing) * 1e-3);
    let rect = Rect::new(left, high, right - left, low - high);
    let png = image.encode(&raster::map_palette(ColourMap::Inferno, FINE))?;
    svg.begin_clip(&panel.area);
    svg.image(&rect, &png, false);
    svg.end_group();
    Ok(())
}

/// Lines at the reference frequencies, their names stacked without overlap at the right of the panel.
pub(super) fn draw_references(svg: &mut Svg, panel: &Panel, references: &[ReferenceFrequency]) {
    const SIZE: f64 = 6.25;
    let mut shown: Vec<&ReferenceFrequency> = references
        .iter()
        .filter(|r| (0.0..=1.0).contains(&panel.y.fraction(r.frequency_hz * 1e-3)))
        .collect();
    shown.sort_by(|a, b| b.frequency_hz.total_cmp(&a.frequency_hz));
    let wanted: Vec<f64> = shown
        .iter()
        .map(|r| panel.at_y(r.frequency_hz * 1e-3))
        .collect();
    let places = spread(
        &wanted,
        SIZE + 1.4,
        panel.area.y + 3.0,
        panel.area.bottom() - 2.0,
    );
    let stroke = Stroke::dashed("#7fd3ff", 0.6);
    let leader = Stroke::solid(INK, 0.4);
    for ((reference, &y), &label_y) in shown.iter().zip(&wanted).zip(&places) {
        svg.line((panel.area.x, y), (panel.area.right(), y), &stroke);
        let right = panel.area.right();
        svg.line((right, y), (right + 6.0, label_y), &leader);
        let text = format!(
            "{} kHz, {}",
            super::axis::signed(reference.frequency_hz * 1e-3, 2),
            reference.label
        );
        svg.text(
            right + 7.5,
            label_y + 0.36 * SIZE,
            &text,
            &TextStyle::new(SIZE),
        );
    }
}

/// Moves rising positions apart to at least `gap`, as little as a forward and a backward pass allow.
pub(super) fn spread(wanted: &[f64], gap: f64, low: f64, high: f64) -> Vec<f64> {
    let mut places = wanted.to_vec();
    // Start from clusters centred on their members.
    let mut clusters: Vec<(f64, usize)> = Vec::new();
    for &position in wanted {
        clusters.push((position, 1));
        while clusters.len() > 1 {
            let (b, count_b) = clusters[clusters.len() - 1];
            let (a, count_a) = clusters[clusters.len() - 2];
            let reach = 0.5 * gap * (count_a + count_b) as f64;
            if b - a >= reach {
                break;
            }
            clusters.truncate(clusters.len() - 2);
            let count = count_a + count_b;
            let centre = (a * count_a as f64 + b * count_b as f64) / count as f64;
            clusters.push((centre, count));
        }
    }
    let mut index = 0;
    for (centre, count) in clusters {
        let half = 0.5 * gap * (count - 1) as f64;
        let first = (centre - half).max(low).min((high - 2.0 * half).max(low));
        for member in 0..count {
            places[index] = first + gap * member as f64;
            index += 1;
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_spread_without_overlap() {
        let places = spread(&[10.0, 10.5, 11.0, 40.0, 80.0], 8.0, 0.0, 100.0);
        for pair in places.windows(2) {
            assert!(pair[1] - pair[0] >= 8.0 - 1e-9, "{places:?}");
        }
        assert_eq!(places[3], 40.0);
        assert!((places[1] - 10.5).abs() < 1e-9);
    }
}
