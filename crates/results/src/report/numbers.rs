//! The numbers of a page, packed: one list of arrays, each kept once, behind each other in one compressed block.

use base64::prelude::{BASE64_STANDARD, Engine};
use flate2::{Compression, write::DeflateEncoder};
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
            Some((first, step)) => self.add(json!(["p", values.len(), first, step]), &[]),
            None => {
                let narrow: Vec<[u8; 4]> =
                    values.iter().map(|&v| (v as f32).to_le_bytes()).collect();
                self.add(json!(["f", values.len()]), &planes(&narrow))
            }
        }
    }

    /// Values as one of 65,535 levels between the smallest and the largest; what is not finite is the level beyond.
    pub fn levels(&mut self, values: &[f64]) -> usize {
        let (low, high) = frictionsim_chart::extremes(values.iter().copied());
        let scale = f64::from(u16::MAX - 1) / (high - low).max(f64::MIN_POSITIVE);
        let level = |v: f64| match v.is_finite() {
            true => ((v - low) * scale).round() as u16,
            false => u16::MAX,
        };
        let narrow: Vec<[u8; 2]> = values.iter().map(|&v| level(v).to_le_bytes()).collect();
        self.add(json!(["l", values.len(), low, high]), &planes(&narrow))
    }

    /// Values as one of 255 parts of the largest, for motion that is only looked at.
    pub fn parts(&mut self, values: &[f64], largest: f64) -> usize {
        let part = |v: f64| ((127.0 * v / largest).round() as i8).to_le_bytes();
        let narrow: Vec<[u8; 1]> = values.iter().map(|&v| part(v)).collect();
        self.add(json!(["b", values.len(), largest]), &planes(&narrow))
    }

    /// Whole numbers.
    pub fn indices(&mut self, values: impl IntoIterator<Item = u32>) -> usize {
        let narrow: Vec<[u8; 4]> = values.into_iter().map(u32::to_le_bytes).collect();
        self.add(json!(["i", narrow.len()]), &planes(&narrow))
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

/// All first bytes, all second bytes, and so on: neighbours are alike, which compresses well.
fn planes<const N: usize>(values: &[[u8; N]]) -> Vec<u8> {
    (0..N).flat_map(|plane| values.iter().map(move |value| value[plane])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::DeflateDecoder;
    use std::io::Read;

    /// The arrays again, from what [`Numbers::finish`] gave; nothing where they do not fit together.
    fn read(entries: &[Value], block: &str) -> Option<Vec<Vec<f64>>> {
        let deflated = BASE64_STANDARD.decode(block).ok()?;
        let mut bytes = Vec::new();
        DeflateDecoder::new(deflated.as_slice()).read_to_end(&mut bytes).ok()?;
        let mut start = 0_usize;
        let mut array = |entry: &Value| {
            let (kind, count) = (entry[0].as_str()?, entry[1].as_u64()? as usize);
            let width = match kind {
                "p" => 0,
                "b" => 1,
                "l" => 2,
                _ => 4,
            };
            let planes = bytes.get(start..start.checked_add(count.checked_mul(width)?)?)?;
            start += planes.len();
            let word = |i: usize| {
                (0..width).fold(0, |word, plane| {
                    word | u32::from(planes[plane * count + i]) << (8 * plane)
                })
            };
            let [first, second] = [2, 3].map(|at| entry[at].as_f64().unwrap_or(f64::NAN));
            let value = |i: usize| match kind {
                "p" => first + i as f64 * second,
                "b" => f64::from(word(i) as u8 as i8) / 127.0 * first,
                "l" if word(i) == u32::from(u16::MAX) => f64::NAN,
                "l" => first + f64::from(word(i)) / f64::from(u16::MAX - 1) * (second - first),
                "i" => f64::from(word(i)),
                _ => f64::from(f32::from_bits(word(i))),
            };
            // An edited page must not ask for more than it holds.
            (count <= 1 << 28).then(|| (0..count).map(value).collect())
        };
        entries.iter().map(&mut array).collect()
    }

    #[test]
    fn packed_numbers_come_back() {
        let mut numbers = Numbers::default();
        let times: Vec<f64> = (0..100).map(|i| 2e-6 * f64::from(i)).collect();
        let wave: Vec<f64> = times.iter().map(|t| 3e5 * (6e4 * t).sin()).collect();
        let gaps = [1.5, f64::NAN, -2.0];
        let indices = [
            numbers.floats(&times),
            numbers.floats(&wave),
            numbers.levels(&gaps),
            numbers.parts(&[-1.0, 0.5], 2.0),
            numbers.indices([7, 70_000]),
        ];
        assert_eq!(numbers.floats(&wave), indices[1], "each array is kept once");
        let (entries, block) = numbers.finish();
        let back = read(entries.as_array().unwrap(), &block).unwrap();
        let near = |own: &[f64], other: &[f64], tolerance: f64| {
            own.len() == other.len()
                && own.iter().zip(other).all(|(a, b)| (a - b).abs() <= tolerance)
        };
        assert!(near(&back[0], &times, 1e-17));
        // Single precision.
        assert!(near(&back[1], &wave, 3e5 * 6e-8));
        assert!(back[2][1].is_nan() && near(&[back[2][0], back[2][2]], &[1.5, -2.0], 1e-12));
        assert!(near(&back[3], &[-1.0, 0.5], 1.0 / 127.0));
        assert_eq!(back[4], [7.0, 70_000.0]);
        assert_eq!(read(entries.as_array().unwrap(), &block[..8]), None);
    }
}
