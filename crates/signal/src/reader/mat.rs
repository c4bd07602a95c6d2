//! MATLAB files of versions 5 to 7: numeric arrays, also within structures and cells.
//!
//! Source: The MathWorks, "MAT-file format", version 5.

use super::error::ReadError;
use super::table::{Column, Table, given_or};
use flate2::read::ZlibDecoder;
use std::io::Read;

/// Most bytes that the compressed variables of a file inflate to.
const MOST_BYTES: u64 = 1 << 30;
/// Most numbers that are kept of a file: 512 MiB.
const MOST_VALUES: usize = 1 << 26;
/// Most characters of a text that may be a remark.
const LONGEST_TEXT: usize = 4096;
/// Most structures within structures.
const DEEPEST: usize = 8;
/// Fewest values of what is called a column.
const FEWEST: usize = 8;

/// Data types of elements.
const COMPRESSED: u32 = 15;
const MATRIX: u32 = 14;

/// A numeric array, column by column.
struct Array {
    name: String,
    rows: usize,
    real: Vec<f64>,
    imaginary: Option<Vec<f64>>,
}

/// What a file holds: arrays, and texts and single numbers as remarks.
#[derive(Default)]
struct Content {
    arrays: Vec<Array>,
    remarks: String,
    /// Numbers in the arrays, of which there may be [`MOST_VALUES`].
    values: usize,
}

/// Reads the arrays of one length, the longest, as the columns of a table; `columns` are names that take the
/// place of the file's own. Single numbers named `fs`, `dt` or alike state the sampling rate.
pub(super) fn read_table(bytes: &[u8], columns: &[String]) -> Result<Table, ReadError> {
    let damaged = |reason: &str| ReadError::damaged("MATLAB file", reason);
    let is_big = bytes.get(126..128) == Some(b"MI");
    let mut content = Content::default();
    let mut elements = Elements { rest: bytes.get(128..).unwrap_or_default(), is_big };
    let too_large = format!(
        "it holds more than {} million numbers, the limit; save only the channels that are needed",
        MOST_VALUES / 1_000_000
    );
    let mut inflated = 0;
    while let Some((kind, data)) = elements.next() {
        if kind == COMPRESSED {
            let mut plain = Vec::new();
            let limited =
                ZlibDecoder::new(data).take(MOST_BYTES - inflated + 1).read_to_end(&mut plain);
            limited.map_err(|_| damaged("a compressed variable is damaged; save it again"))?;
            inflated += plain.len() as u64;
            if inflated > MOST_BYTES {
                return Err(damaged(&too_large));
            }
            let mut inner = Elements { rest: &plain, is_big };
            if let Some((MATRIX, data)) = inner.next() {
                content.matrix(data, is_big, "", 0);
            }
        } else if kind == MATRIX {
            content.matrix(data, is_big, "", 0);
        }
        if content.values > MOST_VALUES {
            return Err(damaged(&too_large));
        }
    }
    let (own, found) = content.arrays_of_one_length().map_err(damaged)?;
    Ok(Table::of_columns(given_or(own, columns, found.len())?, found, content.remarks))
}

/// Elements one after the other: type and data.
struct Elements<'a> {
    rest: &'a [u8],
    is_big: bool,
}

impl<'a> Elements<'a> {
    fn next(&mut self) -> Option<(u32, &'a [u8])> {
        let word = |at: usize| Some(whole(self.rest.get(at..at + 4)?, self.is_big) as u32);
        let first = word(0)?;
        // Up to four bytes stand within the tag.
        let (kind, from, length): (u32, usize, usize) = match first >> 16 {
            0 => (first, 8, word(4)? as usize),
            length => (first & 0xffff, 4, length as usize),
        };
        let end = from.checked_add(length)?;
        let data = self.rest.get(from..end)?;
        // Elements begin at multiples of eight bytes, but for compressed ones.
        let next = match (from, kind) {
            (4, _) => 8,
            (_, COMPRESSED) => end,
            _ => end.next_multiple_of(8),
        };
        self.rest = self.rest.get(next..).unwrap_or_default();
        Some((kind, data))
    }

    /// The numbers of the next element, which has few.
    fn few_numbers(&mut self) -> Option<Vec<f64>> {
        let (kind, data) = self.next()?;
        numbers(kind, &data[..data.len().min(8 * LONGEST_TEXT)], self.is_big)
    }

    /// The characters of the next element.
    fn text(&mut self) -> Option<String> {
        let characters = self.few_numbers()?.into_iter();
        let characters = characters.filter_map(|c| char::from_u32(c as u32));
        Some(characters.filter(|c| *c != '\0').collect())
    }
}

/// The whole number of at most eight bytes, the highest first or last.
pub(super) fn whole(bytes: &[u8], is_big: bool) -> u64 {
    let mut eight = [0; 8];
    let own = &mut eight[..bytes.len()];
    own.copy_from_slice(bytes);
    if is_big {
        own.reverse();
    }
    u64::from_le_bytes(eight)
}

/// The number that bits stand for.
type Decoded = fn(u64) -> f64;

/// Bytes of a number of a numeric type, and the number that they are, read as a whole one.
fn numeric_type(kind: u32) -> Option<(usize, Decoded)> {
    Some(match kind {
        1 => (1, |bits| f64::from(bits as i8)),
        2 | 16 => (1, |bits| f64::from(bits as u8)),
        3 => (2, |bits| f64::from(bits as i16)),
        4 | 17 => (2, |bits| f64::from(bits as u16)),
        5 => (4, |bits| f64::from(bits as i32)),
        6 | 18 => (4, |bits| f64::from(bits as u32)),
        7 => (4, |bits| f64::from(f32::from_bits(bits as u32))),
        9 => (8, f64::from_bits),
        12 => (8, |bits| bits as i64 as f64),
        13 => (8, |bits| bits as f64),
        _ => return None,
    })
}

/// Numbers of an element of any numeric type.
fn numbers(kind: u32, data: &[u8], is_big: bool) -> Option<Vec<f64>> {
    let (width, number) = numeric_type(kind)?;
    Some(data.chunks_exact(width).map(|bytes| number(whole(bytes, is_big))).collect())
}

impl Content {
    /// One variable, or a member of one named `parent`; what is not understood is passed over.
    fn matrix(&mut self, data: &[u8], is_big: bool, parent: &str, depth: usize) -> Option<()> {
        let mut parts = Elements { rest: data, is_big };
        let flags = *parts.few_numbers()?.first()? as u32;
        let (class, is_complex) = (flags & 0xff, flags & 0x800 != 0);
        let sizes = parts.few_numbers()?;
        let own = parts.text()?;
        let name = match (parent.is_empty(), own.is_empty()) {
            (true, _) => own,
            (false, true) => parent.to_string(),
            (false, false) => format!("{parent}.{own}"),
        };
        if depth > DEEPEST {
            return None;
        }
        match class {
            // Cells: one matrix after the other.
            1 => {
                while let Some((MATRIX, inner)) = parts.next() {
                    self.matrix(inner, is_big, &name, depth + 1);
                }
            }
            // Structures: the length of a name, the names, a matrix for each.
            2 => {
                let length = *parts.few_numbers()?.first()? as usize;
                let (_, names) = parts.next()?;
                let field = |bytes: &[u8]| -> String {
                    bytes.iter().take_while(|b| **b != 0).map(|b| char::from(*b)).collect()
                };
                let names: Vec<String> = names.chunks(length.max(1)).map(field).collect();
                for field in names.iter().cycle() {
                    let Some((MATRIX, inner)) = parts.next() else { break };
                    self.matrix(inner, is_big, &format!("{name}.{field}"), depth + 1);
                }
            }
            4 => {
                let text = parts.text()?;
                self.remarks.push_str(&format!("{name}: {text}\n").to_lowercase());
            }
            6..=15 => {
                let real = self.numbers(&mut parts)?;
                let imaginary = if is_complex { Some(self.numbers(&mut parts)?) } else { None };
                self.array(name, &sizes, real, imaginary);
            }
            _ => {}
        }
        Some(())
    }

    /// The numbers of the next element, if there is room for them.
    fn numbers(&mut self, parts: &mut Elements<'_>) -> Option<Vec<f64>> {
        let (kind, data) = parts.next()?;
        self.values += data.len() / numeric_type(kind)?.0;
        if self.values > MOST_VALUES { None } else { numbers(kind, data, parts.is_big) }
    }

    fn array(&mut self, name: String, sizes: &[f64], real: Vec<f64>, imaginary: Option<Vec<f64>>) {
        let rows = sizes.first().map_or(0, |rows| *rows as usize);
        if let [value] = real[..] {
            let last = name.rsplit('.').next().unwrap_or_default().to_lowercase();
            let is_step =
                ["dt", "ts", "delta_t", "increment", "tinterval"].contains(&last.as_str());
            self.remarks += &match is_step && value > 0.0 {
                true => format!("fs: {}\n", 1.0 / value),
                false => format!("{last}: {value}\n"),
            };
        } else if real.len() >= FEWEST
            && rows > 0
            && real.len().is_multiple_of(rows)
            && imaginary.as_ref().is_none_or(|parts| parts.len() == real.len())
        {
            self.arrays.push(Array { name, rows, real, imaginary });
        }
    }

    /// The arrays that have the longest side in common, as columns with their names.
    fn arrays_of_one_length(&mut self) -> Result<(Vec<String>, Vec<Column>), &'static str> {
        let longest = |a: &Array| a.rows.max(a.real.len() / a.rows);
        let count = self.arrays.iter().map(longest).max();
        let count =
            count.ok_or("no numeric array of 8 values or more in it; save vectors, with -v7")?;
        let mut fitting = std::mem::take(&mut self.arrays);
        fitting.retain(|array| longest(array) == count);
        let arrays = fitting.len();
        let (mut titles, mut columns) = (Vec::new(), Vec::new());
        for array in fitting {
            let width = array.real.len() / count;
            for k in 0..width {
                // A matrix stands column by column; a lying one is turned.
                let at = |i: usize| {
                    if array.rows == count { k * count + i } else { i * width + k }
                };
                let part = |values: &Vec<f64>| (0..count).map(|i| values[at(i)]).collect();
                columns.push(Column {
                    real: part(&array.real),
                    imaginary: array.imaginary.as_ref().map(part),
                    is_time: false,
                });
                let number = if width > 1 { format!(" {}", k + 1) } else { String::new() };
                titles.push(format!("{}{number}", array.name));
            }
        }
        let finite =
            |c: &Column| c.real.iter().chain(c.imaginary.iter().flatten()).all(|v| v.is_finite());
        if !columns.iter().all(finite) {
            return Err("it holds NaN or infinite values; remove them before saving");
        }
        // One matrix alone is a table without names.
        if arrays == 1 && columns.len() > 1 {
            titles.clear();
        }
        Ok((titles, columns))
    }
}
