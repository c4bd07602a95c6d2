//! Figures of the probes' signals and of the harmonics of the contact edge.

use super::run::{RecordedRun, stages};
use crate::charts::{
    ends, place_axis, run_axis, signal_panel, spectrogram_panels, spectrum_panel, status_map,
    with_stages,
};
use crate::common::*;
use frictionsim_chart::significant;
use frictionsim_signal::{USUAL_WINDOW, Window, averaged_spectrum};

/// Decades of amplitudes below the largest that show growth.
const GROWTH_DECADES: f64 = 7.0;
/// Harmonics that stay this much smaller than the largest are left out.
const SMALL_HARMONIC: f64 = 1e-3;
/// Lengths of the linear stage over which growth is shown: behind it nothing grows for long.
const SHOWN_STAGES: f64 = 3.0;

impl RecordedRun<'_> {
    /// Acceleration, spectrograms and contact status on one time axis, with the end of the run enlarged at the right.
    pub(super) fn overview(&self, probe: usize) -> Figure {
        let (node, times, signal) =
            (self.probe_label(probe), self.times(), self.acceleration(probe));
        let (start, end) = ends(&times);
        let periods =
            self.solved.analysis.last_fifth.main_frequency_hz.map(|frequency| 4.0 / frequency);
        let enlarged =
            periods.filter(|length| *length < end - start).map(|length| (end - length, end));
        let axis = run_axis(&times);
        let top = self.highest_frequency();
        let component = self.shown_component(probe);
        let [along, symbol] = self.directions()[component];
        let unit = (&format!("*a*_{{{symbol}}}")[..], "m/s²");
        let stages = stages(self.solved);
        let largest = extremes(signal.iter().copied()).1;
        let whole = signal_panel(axis.clone(), &times, &signal, unit, 0.45);
        let whole = whole.caption(format!("{along} acceleration, node {node}"));
        let whole = with_stages(whole, &stages, (start, end), largest);
        let detail = enlarged.map(|(from, to)| {
            let first = times.partition_point(|&t| t < from);
            let axis = Axis::time().between(from, to);
            let panel = signal_panel(axis, &times[first..], &signal[first..], unit, 0.9);
            panel.caption("end of the run")
        });
        // A window holds a few periods of the vibration, however slow it is.
        let few = periods.unwrap_or(0.0).min(0.25 * (end - start));
        let (window, rate) = (few.max(USUAL_WINDOW), 1.0 / self.interval().max(1e-12));
        // A run shorter than a window has no spectrogram, and needs none.
        let map = spectrogram(&signal, rate, window, 1.05 * top).ok();
        let spectrograms = map.map_or(Vec::new(), |map| {
            spectrogram_panels(&axis, &map, start, top, &self.stage.references)
        });
        let caption = format!(
            "Course of the run at node {node}: acceleration, spectrograms with the frequencies of \
             the eigenvalue analysis, contact status. At the right the end of the run."
        );
        let mut figure = Figure::new(format!("overview-{node}"), caption)
            .weighted(&[3.0, 1.0])
            .shared_x()
            .shared_y()
            .panel(whole)
            .panel_or_gap(detail);
        if !stages.is_empty() {
            let meanings: Vec<&str> = stages.iter().map(|stage| stage.meaning).collect();
            figure = figure.note(meanings.join("; "));
        }
        for panel in spectrograms {
            figure = figure.panel(panel).panel_or_gap(None);
        }
        let Some(whole) = self.status_panel(axis, (start, end), "contact status") else {
            return figure;
        };
        let detail = enlarged.and_then(|(from, to)| {
            self.status_panel(Axis::time().between(from, to), (from, to), "end of the run")
        });
        figure.panel(whole).panel_or_gap(detail)
    }

    /// The status of all contact nodes over time; a map of some instants says so.
    fn status_panel(&self, time: Axis, range: (f64, f64), caption: &str) -> Option<Panel> {
        let (body, record) = (&self.body, &self.solved.record);
        if body.is_assembly() {
            // Nodes of surfaces have no order along an edge.
            return None;
        }
        let times: Vec<f64> = record.frames.iter().map(|frame| frame.time).collect();
        let codes = record.frames.iter().flat_map(|frame| body.shown(&frame.status));
        let codes: Vec<u8> = codes.collect();
        let nodes = codes.len() / times.len().max(1);
        let (map, apart) = status_map(&times, nodes, &codes, range)?;
        let apart = apart.map(|interval| {
            let (factor, unit) = prefixed(interval, "s");
            format!(" at instants {} {unit} apart", significant(factor * interval, 3))
        });
        let panel = Panel::new(time, place_axis(body.mesh.has_round_contact())).plain();
        let caption = format!("{caption}{}", apart.unwrap_or_default());
        Some(panel.height(92.0).caption(caption).layer(map))
    }

    /// Spectra of both components over the last fifth of the run.
    pub(super) fn spectrum(&self, probe: usize) -> Figure {
        let node = self.probe_label(probe);
        let spectrum_of = |component: usize| {
            let signal = self.component(probe, component);
            let end = &signal[signal.len() - signal.len().div_ceil(5)..];
            let rate = 1.0 / self.interval().max(1e-12);
            let own = averaged_spectrum(end, rate, Window::Hann, end.len(), 2).unwrap_or_default();
            (format!("{} acceleration", self.directions()[component][0]), own)
        };
        let axial = self.solved.record.axial_rows.get(probe).map(|_| 2);
        let spectra: Vec<_> = [1, 0].into_iter().chain(axial).map(spectrum_of).collect();
        let spectra: Vec<_> = spectra.iter().map(|(name, own)| (&name[..], own)).collect();
        let caption =
            format!("Spectra of the accelerations of node {node} over the last fifth of the run.");
        let frequencies =
            (self.highest_frequency(), self.solved.analysis.last_fifth.main_frequency_hz);
        let panel = spectrum_panel(&spectra, "m/s²", frequencies, &self.stage.references);
        Figure::new(format!("spectrum-{node}"), caption)
            .panel(panel.caption(format!("accelerations of node {node}")))
    }

    /// Growth of the contact edge's vibration, all of it, beside the rate of the mode at its frequency; about the mean
    /// over the linear stage, which is steady sliding, or over the end of the run where there is none.
    fn growth_of_edge(&self, times: &[f64], stage: Option<f64>, window: (f64, f64)) -> Vec<Line> {
        let (record, count) = (&self.solved.record, times.len());
        let linear = match stage {
            Some(stage) => 0..times.partition_point(|&t| t <= stage).max(1),
            None => count - count.div_ceil(5)..count,
        };
        let mut squares = vec![0.0; count];
        for n in record.followed_harmonics() {
            let parts: Vec<[f64; 2]> =
                (0..count).map(|sample| record.amplitude(sample, n).unwrap_or_default()).collect();
            for c in 0..2 {
                let own = &parts[linear.clone()];
                let mean = own.iter().map(|p| p[c]).sum::<f64>() / own.len() as f64;
                for (square, part) in squares.iter_mut().zip(&parts) {
                    *square += (part[c] - mean).powi(2);
                }
            }
        }
        let sizes: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
        let edge = Line::new(times, &sizes).solid(SERIES[0], 0.8).name("contact edge");
        let rate = self.growing_mode().and_then(|(frequency, rate)| {
            let of = format!("{} kHz", significant(frequency * 1e-3, 4));
            predicted((times, &sizes), window, rate, &of)
        });
        std::iter::once(edge).chain(rate).collect()
    }

    /// Growth of the harmonics of the contact edge, beside the rates of the eigenvalue analysis.
    fn growth_of_harmonics(&self, times: &[f64], window: (f64, f64)) -> Vec<Line> {
        let record = &self.solved.record;
        let amplitude = |n: usize| -> Vec<f64> {
            let parts = (0..times.len()).map(|sample| record.amplitude(sample, n));
            parts.map(|parts| parts.map_or(f64::NAN, |[a, b]| a.hypot(b))).collect()
        };
        let mut shown: BTreeMap<usize, Vec<f64>> =
            record.followed_harmonics().map(|n| (n, amplitude(n))).collect();
        let largest = extremes(shown.values().flatten().copied()).1;
        shown.retain(|_, own| extremes(own.iter().copied()).1 > SMALL_HARMONIC * largest);
        let lines = shown.iter().map(|(&n, own)| {
            let stroke = Stroke::solid(look(n).0, 0.8).dashes(look(n).2);
            Line::new(times, own).stroke(stroke).name(format!("*n* = {n}"))
        });
        let rates = self.stage.growth_rates.iter().filter_map(|&(n, rate)| {
            predicted((times, shown.get(&n)?), window, rate, &format!("*n* = {n}"))
        });
        lines.chain(rates).collect()
    }

    /// Growth of the vibration of the contact edge over the linear stage; the whole run where there is none.
    pub(super) fn growth(&self) -> Figure {
        let (times, has_harmonics) = (self.times(), self.has_harmonics);
        let (start, last) = ends(&times);
        let has_stage =
            has_harmonics || self.solved.analysis.growth.iter().any(|own| own.stage.is_ok());
        let linear_end = self.solved.analysis.first_nonlinearity.filter(|_| has_stage);
        let end = linear_end.map_or(last, |end| last.min(start + SHOWN_STAGES * (end - start)));
        let stage = linear_end.unwrap_or(last);
        // What the start leaves behind has died out by a third of the stage.
        let window = (0.35 * stage, 0.95 * stage);
        let (quantity, lines) = match has_harmonics {
            true => ("amplitude of *u*_{θ}", self.growth_of_harmonics(&times, window)),
            false => {
                let lines = self.growth_of_edge(&times, has_stage.then_some(stage), window);
                ("vibration of the contact edge", lines)
            }
        };
        let caption = match (has_harmonics, has_stage) {
            (true, _) => {
                "Growth of the harmonics of the tangential displacement of the contact edge, with \
                 the rates of the eigenvalue analysis."
            }
            (false, true) => {
                "Growth of the tangential vibration of the contact edge, with the rate of the eigenvalue analysis."
            }
            (false, false) => {
                "Vibration of the contact edge about its final mean; there is no linear stage."
            }
        };
        let amplitude = Axis::new(quantity, "m").decades(GROWTH_DECADES).room(0.02);
        let panel = Panel::new(Axis::time().between(start, end), amplitude)
            .height(190.0)
            .layers(lines)
            .layers(linear_end.map(|time| {
                let rule = Rule::vertical(time).stroke(Stroke::dotted(MUTED, 0.7));
                rule.beside("first stick or separation")
            }));
        let figure = Figure::new("growth", caption).panel(panel);
        let note = format!("the run goes on to {} ms", significant(last * 1e3, 3));
        if end < last { figure.note(note) } else { figure }
    }
}

/// What a rate of the eigenvalue analysis makes of a vibration over a window; none where nothing vibrates there.
fn predicted(
    (times, sizes): (&[f64], &[f64]),
    window: (f64, f64),
    rate: f64,
    of: &str,
) -> Option<Line> {
    let inside = times.iter().zip(sizes);
    let inside = inside.filter(|(t, a)| (window.0..=window.1).contains(*t) && **a > 0.0);
    let (sum, count) =
        inside.fold((0.0, 0.0), |(sum, count), (t, a)| (sum + a.ln() - rate * t, count + 1.0));
    let at = |t: f64| (t, (sum / count + rate * t).exp());
    let name = format!("rate of the eigenvalue analysis, {of}: {} s^{{−1}}", significant(rate, 4));
    let line = || Line::through([at(window.0), at(window.1)]).stroke(Stroke::dashed(INK, 1.1));
    (count > 0.0).then(|| line().name(name))
}
