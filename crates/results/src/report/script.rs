//! Data of the report's scripts: the figures as JSON, and their numbers packed, one list of arrays, each kept once,
//! behind each other in one compressed block.

use crate::prelude::*;
use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::write::DeflateEncoder;
use frictionsim_chart::{Ruler, Series, Steps, common_length, keep_extremes, levels, steps};
use std::collections::HashMap;

/// Charts with axes and zoom, under the MIT licence.
const LIBRARY: &str = include_str!("vendor/uPlot.iife.min.js");
const LIBRARY_STYLE: &str = include_str!("vendor/uPlot.min.css");
const SCRIPTS: [&str; 3] =
    [include_str!("report.js"), include_str!("solid.js"), include_str!("motion.js")];

/// Columns that a curve over rising abscissae is thinned to, at most four points in each.
const COLUMNS: usize = 400;
/// Most points of any other curve.
const MOST_POINTS: usize = 4000;

/// The last level of what is read ...
const FINE: u32 = u16::MAX as u32 - 1;
/// ... and of motion that is only looked at.
const COARSE: u32 = u8::MAX as u32 - 1;

/// Most samples of a signal that can be heard, every second, third ... of a longer one: a page is to be mailed.
const LONGEST_SIGNAL: usize = 1 << 14;
/// Longest signal that is kept for the ear.
const LONGEST_HEARD: usize = 1 << 16;

/// Writes the numbers of the figures and the scripts.
pub fn write<'a>(out: &mut String, figures: impl Iterator<Item = &'a Figure>) {
    let mut numbers = Numbers::default();
    let figures: Vec<Value> = figures.map(|figure| of_figure(figure, &mut numbers)).collect();
    let library = numbers.texts([LIBRARY]);
    let (arrays, block) = numbers.finish();
    let data = json!({ "arrays": arrays, "figures": figures, "library": library });
    // No text of a user ends the element.
    let data = data.to_string().replace('<', "\\u003c");
    let _ = write!(
        out,
        "<script type=\"application/json\" id=\"data\">{data}</script>\n\
         <script type=\"text/plain\" id=\"block\">{block}</script>\n\
         <style>{LIBRARY_STYLE}</style>\n<script>\n\"use strict\";\n"
    );
    SCRIPTS.iter().for_each(|script| out.push_str(script));
    out.push_str("</script>\n");
}

fn of_figure(figure: &Figure, numbers: &mut Numbers) -> Value {
    let shown = figure.numbers();
    let panels: Vec<Value> = shown.iter().map(|panel| of_panel(panel, numbers)).collect();
    let steps = figure.steps.as_ref().zip(shown.first());
    json!({
        "name": figure.name,
        "panels": panels,
        "motion": figure.motion.as_ref().map(|motion| of_motion(motion, numbers)),
        "steps": steps.map(|(steps, panel)| of_steps(steps, &panel.axes, numbers)),
    })
}

fn of_panel(panel: &PanelData, numbers: &mut Numbers) -> Value {
    let axis = |ruler: &Ruler| {
        let is_logarithmic = ruler.scale == Scale::Logarithmic;
        let ends = [ruler.low, ruler.high];
        json!({ "title": plain(&ruler.title), "log": is_logarithmic, "ends": ends })
    };
    let series: Vec<Value> = panel.series.iter().map(|series| of_series(series, numbers)).collect();
    let [x, y] = &panel.axes;
    let rules: Vec<_> = panel.rules.iter().filter(|rule| rule.1.is_finite()).collect();
    let labels: Vec<_> =
        panel.labels.iter().filter(|label| (label.0 + label.1).is_finite()).collect();
    json!({
        "caption": panel.caption,
        "x": axis(x),
        "y": axis(y),
        "series": series,
        "rules": rules,
        "labels": labels,
    })
}

fn of_series(series: &Series, numbers: &mut Numbers) -> Value {
    if let Some((name, values)) = &series.values {
        let [x, y, values] =
            [&series.xs, &series.ys, values].map(|values| numbers.levels(values, FINE, 1));
        return json!({ "name": name, "kind": series.kind, "x": x, "y": y, "value": values });
    }
    let ((xs, ys), is_even) = thinned(series);
    let mut out = json!({
        "name": series.name,
        "kind": series.kind,
        "colour": series.colour.to_string(),
        "x": numbers.floats(&xs),
        "y": numbers.floats(&ys),
        "of": series.xs.len(),
    });
    if is_even {
        out["even"] = true.into();
    }
    // Of a signal too long for a page the end is kept for the ear.
    if series.is_whole && series.kind == SeriesKind::Line && series.ys.len() > LONGEST_HEARD {
        let end = &series.ys[series.ys.len() - LONGEST_SIGNAL..];
        out["heard"] = numbers.floats(end).into();
    }
    if !series.rows.is_empty() {
        out["rows"] = series.rows.clone().into();
    }
    if !series.tips.is_empty() {
        out["tips"] = numbers.texts(series.tips.iter().map(String::as_str)).into();
    }
    out
}

/// A curve with no more points than a screen shows, and whether these are samples at equal distances; of a signal to be
/// heard they are.
fn thinned(series: &Series) -> ((Vec<f64>, Vec<f64>), bool) {
    let (xs, ys) = (&series.xs, &series.ys);
    let count = xs.len().min(ys.len());
    let strided = |stride: usize| (0..count).step_by(stride).map(|i| (xs[i], ys[i])).unzip();
    if count <= 4 * COLUMNS {
        return (strided(1), series.is_whole);
    }
    if series.is_whole && count <= LONGEST_HEARD {
        return (strided(count.div_ceil(LONGEST_SIGNAL)), true);
    }
    if xs.is_sorted() {
        let width = (xs[count - 1] - xs[0]).max(f64::MIN_POSITIVE);
        let column = |x: f64| (x - xs[0]) / width * COLUMNS as f64;
        return (keep_extremes(xs, ys, column).into_iter().unzip(), false);
    }
    (strided(count.div_ceil(MOST_POINTS)), false)
}

fn of_steps(steps: &Steps, [x, y]: &[Ruler; 2], numbers: &mut Numbers) -> Value {
    let marks: Vec<&Mark> = steps.marks.iter().flatten().collect();
    let floats = |of: &dyn Fn(&Mark) -> f64| -> Vec<f64> { marks.iter().map(|m| of(m)).collect() };
    let listed = marks.iter().filter(|mark| mark.is_listed);
    json!({
        "quantity": steps.quantity,
        "values": steps.values,
        "counts": numbers.indices(steps.marks.iter().map(|marks| marks.len() as u32), 1),
        "x": numbers.floats(&floats(&|mark| x.shown(mark.place.0))),
        "y": numbers.floats(&floats(&|mark| y.shown(mark.place.1))),
        "listed": numbers.indices(marks.iter().map(|mark| u32::from(mark.is_listed)), 1),
        "names": numbers.texts(listed.map(|mark| mark.name.as_str())),
    })
}

fn of_motion(motion: &Motion, numbers: &mut Numbers) -> Value {
    let dimension = motion.dimension.clamp(1, 3);
    let levels = |places: &[[f64; 3]], last: u32, numbers: &mut Numbers| {
        let flat = places.iter().flat_map(|place| &place[..dimension]).copied();
        numbers.levels(&flat.collect::<Vec<f64>>(), last, dimension)
    };
    let sizes: Vec<usize> = motion.cells.iter().map(Vec::len).collect();
    let cells = motion.cells.iter().flatten().copied();
    let cells = numbers.indices(cells, common_length(&sizes));
    let sizes = numbers.indices(sizes.into_iter().map(|size| size as u32), 1);
    let edge = numbers.indices(motion.edge.iter().copied(), 1);
    let positions = levels(&motion.positions, FINE, numbers);
    let states = motion.states.iter().map(|state| {
        let mut out = json!({ "name": state.name, "hz": state.frequency_hz });
        match &state.kind {
            MotionKind::Harmonic { real, imaginary } => {
                out["real"] = levels(real, COARSE, numbers).into();
                out["imaginary"] = levels(imaginary, COARSE, numbers).into();
            }
            MotionKind::Turning { displacement, turn, status } => {
                out["displacement"] = levels(displacement, FINE, numbers).into();
                out["turn"] = (*turn).into();
                let status = status.iter().map(|&code| u32::from(code));
                out["status"] = numbers.indices(status, 1).into();
            }
            MotionKind::Parts { part_of, parts } => {
                out["partOf"] = numbers.indices(part_of.iter().copied(), 1).into();
                out["parts"] =
                    parts.iter().map(|part| json!([part.0.to_string(), part.1])).collect();
            }
        }
        out
    });
    let states: Vec<Value> = states.collect();
    let lines = numbers.indices(motion.lines.as_flattened().iter().copied(), 2);
    json!({
        "dimension": dimension,
        "positions": positions,
        "sizes": sizes,
        "cells": cells,
        "edge": edge,
        "lines": lines,
        "states": states,
    })
}

/// Arrays in the order in which they were first asked for.
#[derive(Default)]
pub struct Numbers {
    /// How each array is to be read.
    entries: Vec<Value>,
    /// Bytes of all arrays that are not said by their entry alone.
    bytes: Vec<u8>,
    known: HashMap<(Vec<u8>, String), usize>,
}

impl Numbers {
    /// Values in single precision, or first value, step and count where they rise evenly; what is not finite is a gap.
    pub fn floats(&mut self, values: &[f64]) -> usize {
        match progression(values) {
            Some((first, step)) => self.add(json!(["p", 0, values.len(), first, step]), &[]),
            None => {
                let narrow = values.iter().map(|&v| (v as f32).to_le_bytes());
                self.add(json!(["f", 4, values.len()]), &planes(4, narrow))
            }
        }
    }

    /// Values as levels up to a last one, so many of each place.
    pub fn levels(&mut self, values: &[f64], last: u32, components: usize) -> usize {
        let ((low, high), levels) = levels(values, last);
        let width = 4 - last.leading_zeros() as usize / 8;
        let bytes = planes(width, steps(&levels, components).into_iter().map(i32::to_le_bytes));
        self.add(json!(["l", width, levels.len(), components, low, high]), &bytes)
    }

    /// Whole numbers, so many of each thing.
    pub fn indices(&mut self, values: impl IntoIterator<Item = u32>, components: usize) -> usize {
        let values: Vec<u32> = values.into_iter().collect();
        let bytes = planes(4, steps(&values, components).into_iter().map(i32::to_le_bytes));
        self.add(json!(["i", 4, values.len(), components]), &bytes)
    }

    /// A list of texts.
    pub fn texts<'a>(&mut self, texts: impl IntoIterator<Item = &'a str>) -> usize {
        let list = Value::from_iter(texts).to_string();
        self.add(json!(["t", 1, list.len()]), list.as_bytes())
    }

    fn add(&mut self, entry: Value, bytes: &[u8]) -> usize {
        let next = self.entries.len();
        let key = (bytes.to_vec(), entry.to_string());
        let index = *self.known.entry(key).or_insert(next);
        if index == next {
            self.entries.push(entry);
            self.bytes.extend(bytes);
        }
        index
    }

    /// The entries, and the bytes of all arrays, deflated and in base 64.
    pub fn finish(self) -> (Value, String) {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        // Writing to memory does not fail.
        let _ = encoder.write_all(&self.bytes);
        let deflated = encoder.finish().unwrap_or_default();
        (Value::from(self.entries), BASE64_STANDARD.encode(deflated))
    }
}

/// First value and step of values that rise evenly, but for what single precision cannot tell.
fn progression(values: &[f64]) -> Option<(f64, f64)> {
    let (&first, &last) = (values.first()?, values.last()?);
    let step = (last - first) / values.len().checked_sub(1).filter(|&n| n > 1)? as f64;
    let is_near = |(i, v): (usize, &f64)| (first + i as f64 * step - v).abs() <= 1e-6 * step;
    values.iter().enumerate().all(is_near).then_some((first, step))
}

/// So many bytes of each value, all first ones before all second ones: neighbours are alike, which compresses well.
fn planes(width: usize, values: impl Iterator<Item = [u8; 4]> + Clone) -> Vec<u8> {
    (0..width).flat_map(|plane| values.clone().map(move |value| value[plane])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::DeflateDecoder;
    use frictionsim_chart::INK;
    use std::io::Read;

    /// A signal of so many samples, 2 µs apart.
    fn signal(count: usize) -> Value {
        let series = Series {
            name: "acceleration".into(),
            kind: SeriesKind::Line,
            colour: INK.into(),
            xs: (0..count).map(|i| 2e-6 * i as f64).collect(),
            ys: (0..count).map(|i| (0.1 * i as f64).sin()).collect(),
            values: None,
            rows: Vec::new(),
            tips: Vec::new(),
            is_whole: true,
        };
        of_series(&series, &mut Numbers::default())
    }

    #[test]
    fn signals_of_every_length_can_be_heard() {
        // The length of the shipped transients, and that of a second of a measurement.
        assert_eq!(signal(25_001)["even"], true);
        let long = signal(500_000);
        assert!(long.get("even").is_none() && long["heard"].is_u64());
    }

    /// The bytes of the arrays again, from what [`Numbers::finish`] gave, as their entries share them.
    fn read(entries: &[Value], block: &str) -> Vec<Vec<u8>> {
        let deflated = BASE64_STANDARD.decode(block).unwrap();
        let mut bytes = Vec::new();
        DeflateDecoder::new(deflated.as_slice()).read_to_end(&mut bytes).unwrap();
        let size =
            |entry: &Value| (entry[1].as_u64().unwrap() * entry[2].as_u64().unwrap()) as usize;
        entries.iter().map(|entry| bytes.drain(..size(entry)).collect()).collect()
    }

    #[test]
    fn packed_numbers_come_back() {
        let mut numbers = Numbers::default();
        let times: Vec<f64> = (0..100).map(|i| 2e-6 * f64::from(i)).collect();
        let wave: Vec<f64> = times.iter().map(|t| 3e5 * (6e4 * t).sin()).collect();
        let indices = [
            numbers.floats(&times),
            numbers.floats(&wave),
            numbers.levels(&[1.5, f64::NAN, -2.0], 65_534, 1),
            numbers.indices([7, 70_000, 3], 1),
            numbers.texts(["<é"]),
        ];
        assert_eq!(numbers.floats(&wave), indices[1], "each array is kept once");
        let (entries, block) = numbers.finish();
        let entries = entries.as_array().unwrap();
        let back = read(entries, &block);
        assert_eq!(entries[0], json!(["p", 0, 100, 0.0, 2e-6]));
        let wave_at = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|k| back[1][100 * k + i]));
        assert!((0..100).all(|i| wave_at(i) == wave[i] as f32));
        // Levels 65534, 65535 and 0 as twice their differences.
        assert_eq!(entries[2], json!(["l", 2, 3, 1, -2.0, 1.5]));
        assert_eq!(back[2], [0xfe, 0x03, 0x00, 0xff, 0x00, 0x00].map(|byte: u8| byte));
        assert_eq!(back[3].len(), 12);
        assert_eq!(back[4], "[\"<é\"]".as_bytes());
    }
}
