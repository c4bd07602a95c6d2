//! The numbers of a page, packed: one list of arrays, each kept once, behind each other in one compressed block.

use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::{Compression, write::DeflateEncoder};
use frictionsim_chart::{levels, steps};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::io::Write;

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
    use std::io::Read;

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
