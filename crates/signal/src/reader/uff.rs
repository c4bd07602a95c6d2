//! Universal files: functions at nodes, dataset 58 in text and 58b in binary.
//!
//! Source: SDRC, "Universal file datasets", number 58, and the University of Cincinnati's description of the
//! binary form.

use super::super::{FrequencyResponse, ResponseQuantity};
use super::error::{NO_RATE, ReadError};
use super::response::{NamedResponse, ResponseFile};
use super::time_signal::{Channel, SignalFile};
use super::{mat::whole, text::first_of, units::response_unit};
use faer::c64;
use frictionsim_formats::universal_fields;
use std::collections::BTreeSet;

/// Function types: time response, frequency response, coherence.
pub(super) const TIME: u32 = 1;
pub(super) const FREQUENCY_RESPONSE: u32 = 4;
const COHERENCE: u32 = 6;
/// Type of an abscissa in time.
pub(super) const TIME_AXIS: u32 = 17;
/// Types of the ordinate of a response to a force, in the order of the quantities.
pub(super) const ORDINATES: [(u32, ResponseQuantity); 3] = [
    (8, ResponseQuantity::Receptance),
    (11, ResponseQuantity::Mobility),
    (12, ResponseQuantity::Accelerance),
];

/// One function.
struct Function {
    name: String,
    kind: u32,
    /// Types of abscissa, ordinate and what it is divided by.
    axis: u32,
    ordinate: u32,
    divided_by: u32,
    /// Factor to SI of a response by its unit, NaN of one that is not known; none where no unit is written.
    scale: Option<f64>,
    abscissae: Vec<f64>,
    values: Vec<c64>,
    is_complex: bool,
    step: f64,
}

/// Whether bytes that begin with `-1` are a universal file: the second line is the number of a dataset.
pub(super) fn is_universal(bytes: &[u8]) -> bool {
    let mut lines = Lines::of(bytes);
    let [mut before, second] = [(); 2].map(|()| lines.next().unwrap_or_default());
    let number = second.split_whitespace().next().unwrap_or_default();
    let number = number.trim_end_matches(['b', 'B']).parse::<u32>();
    let begins = before.trim() == "-1" && number.is_ok();
    let mut all = std::iter::once(second).chain(std::iter::from_fn(|| lines.next()));
    begins
        && all.any(|line| {
            let last = std::mem::replace(&mut before, line);
            last.trim() == "-1" && before.trim_start().starts_with("58")
        })
}

/// Lines of bytes that may turn binary.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Lines read so far.
    pub count: usize,
}

impl<'a> Lines<'a> {
    pub fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, count: 0 }
    }

    /// Words of the header of the next dataset, lower case.
    pub fn dataset(&mut self) -> Option<Vec<String>> {
        while self.next()?.trim() != "-1" {}
        Some(self.next()?.split_whitespace().map(str::to_lowercase).collect())
    }

    /// The lines up to the one that closes a dataset.
    pub fn body(&mut self) -> Vec<String> {
        std::iter::from_fn(|| self.next()).take_while(|line| line.trim() != "-1").collect()
    }

    fn next(&mut self) -> Option<String> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let end = rest.iter().position(|b| *b == b'\n');
        self.at += end.map_or(rest.len(), |end| end + 1);
        self.count += 1;
        let line = &rest[..end.unwrap_or(rest.len())];
        Some(line.iter().map(|b| char::from(*b)).filter(|c| *c != '\r').collect())
    }
}

/// All functions of a file, and the factor to SI of responses in its units.
fn functions(bytes: &[u8]) -> Result<(Vec<Function>, f64), ReadError> {
    let mut lines = Lines::of(bytes);
    let (mut found, mut system) = (Vec::new(), 1.0);
    while let Some(words) = lines.dataset() {
        let number = found.len() + 1;
        let damaged = |reason: &str| {
            let reason = format!("dataset 58 number {number}: {reason}");
            ReadError::damaged("universal file", reason)
        };
        match words.first().map(String::as_str) {
            Some("58") => found.push(function(&mut lines, None).map_err(damaged)?),
            // SI are the numbers of the file over these factors, of lengths and of forces.
            Some("164") => match lines.body().get(1).map(|line| numbers(line)).as_deref() {
                Some([length, force, ..]) if *length > 0.0 && *force > 0.0 => {
                    system = force / length;
                }
                _ => {}
            },
            Some("58b") => {
                let word = |k: usize| words.get(k).and_then(|w| w.parse::<usize>().ok());
                let is_big = word(1) == Some(2);
                if word(2).is_some_and(|form| form != 2) {
                    return Err(damaged("numbers that are not IEEE 754; export them as such"));
                }
                let length = word(4).ok_or_else(|| damaged("its length is not stated"))?;
                found.push(function(&mut lines, Some((length, is_big))).map_err(damaged)?);
            }
            Some(_) => drop(lines.body()),
            None => {}
        }
    }
    Ok((found, system))
}

/// One dataset: eleven records of text, then numbers; the length and byte order of binary ones is given.
fn function(lines: &mut Lines, binary: Option<(usize, bool)>) -> Result<Function, &'static str> {
    let mut records = Vec::new();
    for _ in 0..11 {
        records.push(lines.next().ok_or("it ends within its header")?);
    }
    let word =
        |record: usize, k: usize| numbers(&records[record - 1]).get(k).copied().unwrap_or(0.0);
    let part = |record: usize, from: usize, to: usize| {
        let part = records[record - 1].chars().skip(from).take(to - from);
        part.collect::<String>().trim().to_string()
    };
    // Records 7 to 9: form and count of the numbers, abscissa, ordinate.
    let (form, count) = (word(7, 0) as u32, word(7, 1));
    if !matches!(form, 2 | 4 | 5 | 6) || !(count >= 0.0) {
        return Err("its seventh record has no known form of numbers");
    }
    let (is_complex, is_double) = (form >= 5, form == 4 || form == 6);
    let (is_even, first, step) = (word(7, 2) == 1.0, word(7, 3), word(7, 4));
    // Each row has its abscissa, unless these are even, and one or two numbers more.
    let (lead, parts) = (usize::from(!is_even), 1 + usize::from(is_complex));
    let raw = match binary {
        Some((length, is_big)) => {
            let widths = [vec![4; lead], vec![if is_double { 8 } else { 4 }; parts]].concat();
            let raw = binary_numbers(lines, length, is_big, &widths)?;
            // What closes it would open the next one.
            lines.body();
            raw
        }
        None => lines.body().iter().flat_map(|line| numbers(line)).collect(),
    };
    let rows: Vec<&[f64]> = raw.chunks_exact(lead + parts).take(count as usize).collect();
    if (rows.len() as f64) < count {
        return Err("it has fewer numbers than its seventh record says; export it again");
    }
    let value = |row: &[f64]| c64::new(row[lead], row.get(lead + 1).copied().unwrap_or(0.0));
    let abscissa = |(i, row): (usize, &&[f64])| {
        if is_even { first + i as f64 * step } else { row[0] }
    };
    let [motion, force] = [9, 10].map(|record| part(record, 47, 67).replace("NONE", ""));
    let force = if force.is_empty() { "N" } else { &force };
    let unit = response_unit(&motion).or_else(|| response_unit(&format!("{motion}/{force}")));
    Ok(Function {
        name: name_of(&part),
        kind: word(6, 0) as u32,
        axis: word(8, 0) as u32,
        ordinate: word(9, 0) as u32,
        divided_by: word(10, 0) as u32,
        scale: (!motion.is_empty()).then_some(unit.map_or(f64::NAN, |unit| unit.0)),
        abscissae: rows.iter().enumerate().map(abscissa).collect(),
        values: rows.iter().map(|row| value(row)).collect(),
        is_complex,
        step,
    })
}

/// Record 6: where it was measured and driven, by name, node and direction; else the first record.
fn name_of(part: &dyn Fn(usize, usize, usize) -> String) -> String {
    let place = |from: usize| {
        let (name, node) = (part(6, from, from + 10), part(6, from + 10, from + 20));
        let direction = part(6, from + 20, from + 24);
        let name = if name == "NONE" { String::new() } else { name };
        let is_none = name.is_empty() && matches!(node.as_str(), "" | "0");
        (!is_none).then(|| format!("{name}{node}:{direction}"))
    };
    match (place(31), place(56)) {
        (None, _) => part(1, 0, 80),
        (Some(response), None) => response,
        (Some(response), Some(reference)) => format!("{response}/{reference}"),
    }
}

/// Numbers of a record, also where a sign is all that separates them.
pub(super) fn numbers(line: &str) -> Vec<f64> {
    universal_fields(line).split_whitespace().map_while(|word| word.parse().ok()).collect()
}

/// The numbers of a binary dataset, each of so many bytes in turn: 4 in single precision, 8 in double.
fn binary_numbers(
    lines: &mut Lines,
    length: usize,
    is_big: bool,
    widths: &[usize],
) -> Result<Vec<f64>, &'static str> {
    let end = lines.at.checked_add(length).filter(|end| *end <= lines.bytes.len());
    let end = end.ok_or("the file ends within its numbers")?;
    let mut rest = &lines.bytes[lines.at..end];
    lines.at = end;
    let mut out = Vec::with_capacity(length / 4);
    for width in widths.iter().cycle() {
        let Some((head, tail)) = rest.split_at_checked(*width) else { break };
        let bits = whole(head, is_big);
        out.push(match width {
            8 => f64::from_bits(bits),
            _ => f64::from(f32::from_bits(bits as u32)),
        });
        rest = tail;
    }
    Ok(out)
}

/// Frequency responses of a universal file, each with its coherence where the file has one of its name.
pub(super) fn read_responses(
    bytes: &[u8],
    quantity: Option<ResponseQuantity>,
) -> Result<ResponseFile, ReadError> {
    let (all, system) = functions(bytes)?;
    let (mut notes, mut responses) = (Vec::new(), Vec::new());
    let is_response = |f: &&Function| f.kind == FREQUENCY_RESPONSE || (f.kind == 0 && f.is_complex);
    for f in all.iter().filter(is_response) {
        let name = &f.name;
        if ORDINATES.iter().any(|(kind, _)| *kind == f.divided_by) {
            notes.push(format!("left out: {name} is a motion over a motion, not over a force"));
            continue;
        }
        let stated = ORDINATES.iter().find(|(kind, _)| *kind == f.ordinate);
        let known = quantity.or(stated.map(|(_, quantity)| *quantity));
        let taken = known.unwrap_or(ResponseQuantity::Accelerance);
        if known.is_none() {
            notes.push(format!("{name}: the file does not say what it holds: accelerance assumed"));
        }
        let mut scale = f.scale.unwrap_or(system);
        if scale.is_nan() {
            notes.push(format!("{name}: its unit is not known, it is taken as SI"));
            scale = 1.0;
        }
        let values = f.values.iter().map(|z| z * scale).collect();
        let response =
            FrequencyResponse::measured(f.abscissae.clone(), values, taken, f.is_complex);
        let mut response = response.map_err(ReadError::whole)?;
        let same = |c: &&Function| {
            c.kind == COHERENCE && c.name == f.name && c.values.len() == f.values.len()
        };
        if let Some(coherence) = all.iter().find(same) {
            let values: Vec<f64> = coherence.values.iter().map(|z| z.re).collect();
            response = response.with_coherence(&values);
        }
        responses.push(NamedResponse { name: f.name.clone(), response });
    }
    if responses.is_empty() {
        return Err(without("frequency response to a force (function type 4)", &all));
    }
    Ok(ResponseFile { responses, notes })
}

/// Time signals of a universal file.
pub(super) fn read_signals(bytes: &[u8]) -> Result<SignalFile, ReadError> {
    let (all, _) = functions(bytes)?;
    let is_signal = |f: &&Function| f.kind == TIME || (f.kind == 0 && f.axis == TIME_AXIS);
    let signals: Vec<&Function> = all.iter().filter(is_signal).collect();
    let Some(first) = signals.first() else {
        return Err(without("time response (function type 1)", &all));
    };
    let count = first.abscissae.len();
    let step = match first.step {
        step if step > 0.0 => step,
        _ if count > 1 => (first.abscissae[count - 1] - first.abscissae[0]) / (count - 1) as f64,
        _ => 0.0,
    };
    if !(step > 0.0 && step.is_finite() && (1.0 / step).is_finite()) {
        return Err(ReadError::whole(NO_RATE));
    }
    let (fit, others): (Vec<&Function>, Vec<&Function>) = signals
        .iter()
        .partition(|f| f.values.len() == count && (f.step - first.step).abs() <= 1e-6 * step);
    let mut notes = Vec::new();
    if !others.is_empty() {
        let names = first_of(others.iter().map(|f| &f.name));
        notes.push(format!("left out, for another length or rate than the first: {names}"));
    }
    let samples = |f: &Function| f.values.iter().map(|z| z.re).collect();
    let channel = |f: &&Function| Channel { name: f.name.clone(), samples: samples(f) };
    let (sampling_rate, channels) = (1.0 / step, fit.iter().map(channel).collect());
    let start = first.abscissae.first().copied().unwrap_or(0.0);
    Ok(SignalFile { sampling_rate, start, channels, notes })
}

fn without(wanted: &str, all: &[Function]) -> ReadError {
    let kinds: BTreeSet<u32> = all.iter().map(|f| f.kind).collect();
    let kinds = first_of(kinds.iter().map(ToString::to_string));
    let reason = format!("no {wanted} in it (function types: {kinds})");
    ReadError::damaged("universal file", reason)
}
