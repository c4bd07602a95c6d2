//! Tables of a frequency response.

use super::super::{FrequencyResponse, ResponseQuantity};
use super::error::{ReadError, ReadProblem};
use super::table::{Table, read_table};
use super::units::{hertz, words};
use faer::c64;

/// A frequency response and what the reader had to decide.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// The response.
    pub response: FrequencyResponse,
    /// Decisions a user should know of: rows sorted, repeated rows dropped, quantity assumed.
    pub notes: Vec<String>,
}

/// What a column of a response table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Real,
    Imaginary,
    Magnitude,
    Decibel,
    Degrees,
    Radians,
    Other,
}

/// The columns that make a response.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Layout {
    Complex(usize, usize),
    Polar {
        magnitude: usize,
        in_decibel: bool,
        phase: Option<(usize, f64)>,
    },
}

/// Reads a frequency response: frequency with real and imaginary part, or with magnitude (linear or
/// in decibel, 20 log10) and phase (degrees or radians), or with magnitude alone.
///
/// Columns are found by name; without names, two columns are frequency and magnitude, and three are
/// frequency, real and imaginary part if both change sign. `quantity` overrides what names and
/// comments say (accelerance or inertance, mobility, receptance or compliance, or units such as
/// `m/s2/N`); where nothing says it, accelerance is assumed and noted. Rows out of order are sorted;
/// a frequency repeated with the same values counts once. Of several responses in one table the first
/// is read. Values in `g/N` become m/s2/N; other units are taken as SI.
///
/// # Errors
/// [`ReadError`] with source name, line and column.
pub fn read_response(
    bytes: &[u8],
    source: &str,
    quantity: Option<ResponseQuantity>,
) -> Result<ResponseFile, ReadError> {
    let table = read_table(bytes, source)?;
    let mut notes = Vec::new();
    let (frequency, factor) = frequency_column(&table, source)?;
    let layout = layout(&table, frequency, source)?;
    let values = values(&table, layout, source)?;
    let rows = ordered(&table, frequency, factor, &values, source, &mut notes)?;
    let stated = stated_quantity(&table);
    let quantity = match (quantity, stated) {
        (Some(given), Some(found)) if given != found => {
            notes.push(format!(
                "the table says {}, the option {}: the option holds",
                found.name(),
                given.name()
            ));
            given
        }
        (Some(given), _) => given,
        (None, Some(found)) => found,
        (None, None) => {
            notes.push(
                "the table does not say what it holds: accelerance (acceleration over force) assumed"
                    .to_string(),
            );
            ResponseQuantity::Accelerance
        }
    };
    let gravity = if names_standard_gravity(&table) {
        9.806_65
    } else {
        1.0
    };
    let frequencies: Vec<f64> = rows.iter().map(|r| r.0).collect();
    let values: Vec<c64> = rows.iter().map(|r| values[r.1] * gravity).collect();
    let has_phase = !matches!(layout, Layout::Polar { phase: None, .. });
    let response = if has_phase {
        FrequencyResponse::new(frequencies, values, quantity)
    } else {
        let moduli: Vec<f64> = values.iter().map(|z| z.re).collect();
        FrequencyResponse::from_magnitudes(frequencies, &moduli, quantity)
    };
    let response = response.map_err(|e| ReadError::whole(source, ReadProblem::Signal(e)))?;
    Ok(ResponseFile { response, notes })
}

/// The frequency column and its factor to Hz.
fn frequency_column(table: &Table, source: &str) -> Result<(usize, f64), ReadError> {
    if table.names.is_empty() {
        return Ok((0, 1.0));
    }
    let missing = ReadProblem::MissingColumn {
        wanted: "frequency",
        columns: table.described(),
        remedy: "name it `frequency_hz`",
    };
    (0..table.names.len())
        .filter(|&k| part(&table.names[k]) == Part::Other)
        .find_map(|k| Some((k, hertz(&table.names[k])?)))
        .ok_or_else(|| ReadError::whole(source, missing))
}

/// What a lower-case column name says.
fn part(name: &str) -> Part {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|w| list.contains(w));
    let begins = |list: &[&str]| words.iter().any(|w| list.iter().any(|l| w.starts_with(l)));
    if has(&["re"]) || begins(&["real"]) {
        Part::Real
    } else if has(&["im"]) || begins(&["imag"]) {
        Part::Imaginary
    } else if has(&["arg"]) || begins(&["phase", "angle", "phi"]) {
        if has(&["rad", "radian", "radians"]) {
            Part::Radians
        } else {
            Part::Degrees
        }
    } else if has(&["db", "decibel"]) || name.contains("(db") || name.contains("[db") {
        Part::Decibel
    } else if has(&["abs", "h", "frf", "|h|", "gain"])
        || begins(&[
            "mag",
            "ampl",
            "modul",
            "accelerance",
            "inertance",
            "mobility",
            "receptance",
        ])
        || begins(&["compliance", "admittance", "betrag"])
    {
        Part::Magnitude
    } else {
        Part::Other
    }
}

/// Which columns make the response.
fn layout(table: &Table, frequency: usize, source: &str) -> Result<Layout, ReadError> {
    if table.names.is_empty() {
        return unnamed_layout(table, source);
    }
    let parts: Vec<Part> = table.names.iter().map(|n| part(n)).collect();
    let find = |wanted: Part| (0..parts.len()).find(|&k| k != frequency && parts[k] == wanted);
    if let (Some(re), Some(im)) = (find(Part::Real), find(Part::Imaginary)) {
        return Ok(Layout::Complex(re, im));
    }
    let missing = |wanted, remedy| {
        let problem = ReadProblem::MissingColumn {
            wanted,
            columns: table.described(),
            remedy,
        };
        ReadError::whole(source, problem)
    };
    if find(Part::Real).is_some() {
        return Err(missing(
            "imaginary part",
            "name it `imaginary`, or give magnitude and phase",
        ));
    }
    if find(Part::Imaginary).is_some() {
        return Err(missing(
            "real part",
            "name it `real`, or give magnitude and phase",
        ));
    }
    let phase = find(Part::Degrees)
        .map(|k| (k, std::f64::consts::PI / 180.0))
        .or_else(|| find(Part::Radians).map(|k| (k, 1.0)));
    let decibel = find(Part::Decibel);
    match decibel.or_else(|| find(Part::Magnitude)) {
        Some(magnitude) => Ok(Layout::Polar {
            magnitude,
            in_decibel: decibel.is_some(),
            phase,
        }),
        None => Err(missing(
            "response",
            "name the columns `real` and `imaginary`, or `magnitude` or `magnitude_db` and `phase_deg`",
        )),
    }
}

/// Columns without names, where the numbers leave no doubt.
fn unnamed_layout(table: &Table, source: &str) -> Result<Layout, ReadError> {
    let columns = &table.columns;
    let least = |k: usize| columns[k].iter().copied().fold(f64::INFINITY, f64::min);
    let most = |k: usize| columns[k].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = |k: usize| most(k).max(-least(k));
    match columns.len() {
        2 if least(1) >= 0.0 => Ok(Layout::Polar {
            magnitude: 1,
            in_decibel: false,
            phase: None,
        }),
        3 if least(1) < 0.0
            && most(1) > 0.0
            && least(2) < 0.0
            && most(2) > 0.0
            // Decibels beside degrees are of another size than two parts of one number.
            && size(1) < 20.0 * size(2)
            && size(2) < 20.0 * size(1)
            && size(2) < 90.0 =>
        {
            Ok(Layout::Complex(1, 2))
        }
        1 => Err(ReadError::whole(
            source,
            ReadProblem::MissingColumn {
                wanted: "response",
                columns: table.described(),
                remedy: "frequency and response must stand side by side",
            },
        )),
        count => Err(ReadError::at(
            source,
            table.lines[0],
            1,
            ReadProblem::Unnamed {
                count,
                example: "frequency_hz,real,imaginary",
            },
        )),
    }
}

/// Complex values of each row; real magnitudes where there is no phase.
fn values(table: &Table, layout: Layout, source: &str) -> Result<Vec<c64>, ReadError> {
    let rows = table.lines.len();
    match layout {
        Layout::Complex(re, im) => Ok((0..rows)
            .map(|i| c64::new(table.columns[re][i], table.columns[im][i]))
            .collect()),
        Layout::Polar {
            magnitude,
            in_decibel,
            phase,
        } => (0..rows)
            .map(|i| {
                let value = table.columns[magnitude][i];
                let modulus = if in_decibel {
                    10f64.powf(value / 20.0)
                } else {
                    value
                };
                if modulus < 0.0 {
                    let (line, at) = (table.lines[i], table.start(i, magnitude));
                    let problem = ReadProblem::NegativeMagnitude { value };
                    return Err(ReadError::at(source, line, at, problem));
                }
                let angle = phase.map_or(0.0, |(k, factor)| table.columns[k][i] * factor);
                Ok(c64::from_polar(modulus, angle))
            })
            .collect(),
    }
}

/// Frequencies in rising order, each once, with the row they come from.
fn ordered(
    table: &Table,
    column: usize,
    factor: f64,
    values: &[c64],
    source: &str,
    notes: &mut Vec<String>,
) -> Result<Vec<(f64, usize)>, ReadError> {
    let raw = &table.columns[column];
    let place = |i: usize| (table.lines[i], table.start(i, column));
    if let Some(i) = raw.iter().position(|f| *f < 0.0) {
        let (line, at) = place(i);
        let problem = ReadProblem::NegativeFrequency { value: raw[i] };
        return Err(ReadError::at(source, line, at, problem));
    }
    let mut rows: Vec<(f64, usize)> = raw
        .iter()
        .enumerate()
        .map(|(i, f)| (f * factor, i))
        .collect();
    if raw.windows(2).any(|w| w[1] < w[0]) {
        rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        notes.push("the frequencies were out of order: rows sorted".to_string());
    }
    let mut kept: Vec<(f64, usize)> = Vec::with_capacity(rows.len());
    let mut dropped = 0;
    for row in rows {
        match kept.last() {
            Some(last) if last.0 == row.0 => {
                if values[last.1] != values[row.1] {
                    let (line, at) = place(row.1);
                    let problem = ReadProblem::DuplicateFrequency {
                        value: row.0,
                        first_line: table.lines[last.1],
                    };
                    return Err(ReadError::at(source, line, at, problem));
                }
                dropped += 1;
            }
            _ => kept.push(row),
        }
    }
    if dropped > 0 {
        notes.push(format!(
            "{dropped} repeated row(s) with equal values dropped"
        ));
    }
    Ok(kept)
}

/// Receptance, mobility or accelerance, from names, units and remarks.
fn stated_quantity(table: &Table) -> Option<ResponseQuantity> {
    let text = format!("{}\n{}", table.names.join(" "), table.remarks);
    let compact: String = text
        .chars()
        .filter(|c| !matches!(c, ' ' | '(' | ')' | '*' | '·'))
        .collect();
    let has = |list: &[&str]| list.iter().any(|w| compact.contains(w));
    if has(&[
        "accelerance",
        "inertance",
        "m/s2/n",
        "m/s^2/n",
        "m/s²/n",
        "g/n",
        "m_per_s2_per_n",
    ]) {
        Some(ResponseQuantity::Accelerance)
    } else if has(&["mobility", "m/s/n", "m/ns", "m_per_s_per_n", "admittance"]) {
        Some(ResponseQuantity::Mobility)
    } else if has(&["receptance", "compliance", "m/n", "m_per_n", "flexibility"]) {
        Some(ResponseQuantity::Receptance)
    } else {
        None
    }
}

/// Whether the response is in multiples of standard gravity.
fn names_standard_gravity(table: &Table) -> bool {
    let stated = format!("{} {}", table.names.join(" "), table.remarks);
    words(&stated).contains(&"g/n")
}
