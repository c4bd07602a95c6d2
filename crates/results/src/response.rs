//! Table, figure and report of a computed frequency response.

use super::identification::response_unit;
use crate::common::*;
use frictionsim_signal::reader::{self, Place};
use frictionsim_signal::{ResponseQuantity, prominence};

keys! {
    /// `summary.json` of `frictionsim frf`.
    #[derive(Default)]
    ResponseSummary {
        description: String = "what was computed, in a sentence";
        dofs: usize = "unknowns";
        lines: usize = "frequencies";
        method: String = "method: `cyclic`, `direct` or `reduced`";
        largest_error: Option<f64> = "largest relative error at the check lines of a reduction";
        basis_vectors: Option<usize> = "vectors of a reduction";
        backward_error: Option<f64> = "largest backward error of a cyclic solution";
        quantity: String = "accelerance, mobility or receptance";
        noise: f64 = "relative standard deviation of the noise added";
        peak: BTreeMap<String, f64> = "largest magnitude, by its quantity: accelerance in m/s²/N, mobility in m/s/N, \
            receptance in m/N";
        peak_frequency_hz: Option<f64> = "frequency of that; none of a response that is zero";
    }
}

/// Writes frequency, real and imaginary part as `frf.csv`, which `frictionsim identify` reads; as a `universal` file
/// (dataset 58), too, where the places of motion and force are given for it.
pub fn write_response(
    folder: &OutputFolder,
    quantity: ResponseQuantity,
    frequencies_hz: &[f64],
    values: &[c64],
    universal: Option<[Place; 2]>,
) -> Result<(), FolderError> {
    let name = quantity.name();
    let table = Table::new("frf.csv", "")
        .column("frequency_hz", None, frequencies_hz.iter().copied())
        .column(&format!("{name}_real"), None, values.iter().map(|h| h.re))
        .column(&format!("{name}_imaginary"), None, values.iter().map(|h| h.im));
    write_table(folder, &table)?;
    let Some(places) = universal else { return Ok(()) };
    folder.write("frf.unv", |out| {
        let lines = (frequencies_hz, values);
        out.write_all(reader::write_response(name, quantity, lines, places).as_bytes())
    })
}

impl ResponseSummary {
    /// What was computed, and its figure.
    pub fn document(&self) -> Document {
        let peak = self.peak.iter().zip(self.peak_frequency_hz).map(|((name, size), at)| {
            let size = format!("{} {}", significant(*size, 5), response_unit(name));
            ("largest magnitude", format!("{size} at {at:.2} Hz"))
        });
        let section = Section::new("Frequency response")
            .text([self.description.clone()])
            .facts(peak)
            .figures(["response"]);
        Document::new("Frequency response").section(section)
    }
}

/// Degrees beyond half a turn up to which the phase goes on before it is drawn a turn away: noise about half a turn is
/// no jump.
const PHASE_MARGIN: f64 = 25.0;
/// Least rise of a maximum over its surroundings, as a natural logarithm (3 dB), and in units of the noise.
const PROMINENCE: (f64, f64) = (0.345, 12.0);
/// Most maxima that are marked.
const MOST_MAXIMA: usize = 40;

/// The phase, degrees, followed from value to value and drawn a whole number of turns away only where it leaves the
/// axis; there the line breaks off at one edge and goes on from the other.
fn followed_phase(frequencies: &[f64], values: &[c64]) -> Vec<(f64, f64)> {
    let limit = 180.0 + PHASE_MARGIN;
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(values.len());
    let mut last: Option<f64> = None;
    for (&frequency, value) in frequencies.iter().zip(values) {
        let own = value.arg().to_degrees();
        let near = last.map_or(own, |last| own + 360.0 * ((last - own) / 360.0).round());
        let shown = if near.abs() > limit { own } else { near };
        if let Some((from, start)) = points.last().copied().filter(|_| shown != near) {
            // Out through one edge and in through the other, so that a value alone between two breaks is seen.
            let edge = limit.copysign(near);
            let crossed = from + (frequency - from) * (edge - start) / (near - start);
            points.extend([(crossed, edge), (f64::NAN, f64::NAN), (crossed, edge + shown - near)]);
        }
        points.push((frequency, shown));
        last = Some(shown).filter(|phase| phase.is_finite()).or(last);
    }
    points
}

/// Places of the maxima that rise out of their surroundings by more than the noise does, highest rise first.
///
/// The rise of a maximum is its [`prominence`]. The noise is the median distance of neighbouring logarithms over 0.95,
/// which of independent normal values is their standard deviation.
fn maxima(magnitude: &[f64]) -> Vec<usize> {
    let logs: Vec<f64> = magnitude.iter().map(|m| m.max(1e-300).ln()).collect();
    let steps = sorted(logs.windows(2).map(|pair| (pair[1] - pair[0]).abs()), |own| *own);
    let noise = steps.get(steps.len() / 2).copied().unwrap_or(0.0) / 0.95;
    let least = PROMINENCE.0.max(PROMINENCE.1 * noise);
    let peaks = (1..logs.len().saturating_sub(1))
        .filter(|&i| logs[i] > logs[i - 1] && logs[i] >= logs[i + 1]);
    // A look at the nearest values spares most of the noise the long way.
    let is_high = |i: &usize| {
        let near = &logs[i.saturating_sub(3)..(i + 4).min(logs.len())];
        near.iter().all(|value| *value <= logs[*i])
    };
    let found = peaks.filter(is_high).map(|i| (prominence(magnitude, i), i));
    let mut found = sorted(found.filter(|(rise, _)| *rise > least), |own| -own.0);
    found.truncate(MOST_MAXIMA);
    found.into_iter().map(|(_, place)| place).collect()
}

/// Magnitude and phase of a response over the frequency.
pub fn response_figure(response: &FrequencyResponse) -> Figure {
    let (frequencies, values) = (response.frequencies_hz(), response.values());
    let magnitude: Vec<f64> = values.iter().map(|h| h.norm()).collect();
    let limit = 180.0 + PHASE_MARGIN;
    let phase = Line::through(followed_phase(frequencies, values)).solid(SERIES[0], 0.8);
    let quarters =
        [-180, -90, 0, 90, 180].map(|d: i32| (f64::from(d), d.to_string().replace('-', "−")));
    let over = |y: Axis, height: f64, line: Line| {
        Panel::new(Axis::kilohertz().tight(), y).height(height).layer(line)
    };
    let size = Line::new(frequencies, &magnitude).solid(SERIES[0], 0.8);
    let places = maxima(&magnitude);
    let tips = places.iter().map(|&i| format!("maximum at {:.1} Hz", frequencies[i])).collect();
    let peaks = Points::new(places.iter().map(|&i| (frequencies[i], magnitude[i])));
    let peaks = peaks.marker(Marker::Disc, 1.6, INK).tips(tips).name("maximum");
    let modulus = Axis::new("|*H*|", response_unit(response.quantity().name())).logarithmic();
    let degrees = Axis::new("phase", "°").between(-limit, limit).ticks(quarters);
    let caption = "Frequency response of the model: magnitude (a), with the maxima that stand out \
                   of the noise, and phase (b).";
    Figure::new("response", caption)
        .shared_x()
        .panel(over(modulus, 150.0, size).layer(peaks))
        .panel(over(degrees, 72.0, phase))
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_physics::linalg::GaussianNoise;

    #[test]
    fn maxima_are_the_resonances_and_none_of_the_noise() {
        let mut noise = GaussianNoise::new(7);
        let lines = 20_000;
        let modes = [2000.0, 5000.0, 11_000.0];
        let values: Vec<c64> = (0..lines)
            .map(|i| {
                let f = i as f64;
                let one = |f0: f64| c64::new(1.0, 0.0) / c64::new(f0 * f0 - f * f, 0.02 * f0 * f);
                let sum = modes.iter().map(|&f0| one(f0)).fold(c64::new(0.0, 0.0), |a, b| a + b);
                sum * (c64::new(1.0, 0.0) + noise.draw() * 0.07)
            })
            .collect();
        let magnitude: Vec<f64> = values.iter().map(|h| h.norm()).collect();
        let mut found = maxima(&magnitude);
        found.sort_unstable();
        assert_eq!(found.len(), modes.len(), "{found:?}");
        for (place, mode) in found.iter().zip(modes) {
            assert!((*place as f64 / mode - 1.0).abs() < 0.02, "{found:?}");
        }
        // The phase breaks where it leaves the axis, not at every value of the noise about half a turn.
        let frequencies: Vec<f64> = (0..lines).map(|i| i as f64).collect();
        let phase = followed_phase(&frequencies, &values);
        let breaks = phase.iter().filter(|point| point.0.is_nan()).count();
        assert!(breaks < 6, "{breaks}");
        // A value alone between two breaks has a line to either edge.
        let turned =
            [170.0_f64, -100.0, 130.0].map(|phase| c64::from_polar(1.0, phase.to_radians()));
        let found = followed_phase(&[0.0, 1.0, 2.0], &turned);
        let pieces: Vec<&[(f64, f64)]> = found.split(|point| point.0.is_nan()).collect();
        assert_eq!(
            pieces.iter().map(|piece| piece.len()).collect::<Vec<_>>(),
            [2, 3, 2],
            "{found:?}"
        );
        assert!(found.iter().all(|point| point.0.is_nan() || point.1.abs() <= 205.0), "{found:?}");
    }
}
