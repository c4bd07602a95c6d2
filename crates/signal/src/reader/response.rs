//! Frequency responses of a table.

use super::super::{FrequencyResponse, ResponseQuantity};
use super::columns::{self, Found, Part, part};
use super::text::{first_of, shortened};
use super::uff::ORDINATES;
use super::uff_writing::{Place, write_response};
use super::units::{hertz, response_unit};
use super::{Format, selected, uff};
use super::{error::ReadError, table::Table};

/// A response and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedResponse {
    /// Name of its column without the words for real and imaginary part, or `response k`.
    pub name: String,
    /// The response.
    pub response: FrequencyResponse,
}

impl NamedResponse {
    /// As [`super::write_response`].
    pub fn written(&self, places: [Place; 2]) -> String {
        let lines = (self.response.frequencies_hz(), self.response.values());
        write_response(&self.name, self.response.quantity(), lines, places)
    }
}

/// Frequency responses and what the reader had to decide.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFile {
    /// The responses, at least one.
    pub responses: Vec<NamedResponse>,
    /// Decisions a user should know of: rows sorted, repeated rows dropped, quantity assumed.
    pub notes: Vec<String>,
}

/// What the header of a response does not say, or says wrongly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResponseOptions {
    /// Accelerance, mobility or receptance; overrides names and units.
    pub quantity: Option<ResponseQuantity>,
    /// Names that take the place of the table's own, one for each column, in the words of headers: `f`
    /// (`f_khz`, `omega`), `re`, `im`, `mag`, `db`, `phase` (degrees), `phase_rad`, `coherence`, `-` to skip.
    pub columns: Vec<String>,
    /// The responses to use, by name or number; empty: all.
    pub channels: Vec<String>,
}

/// Reads frequency responses: frequency with real and imaginary part, complex numbers, magnitude (linear or
/// in decibel, 20 log10 over a reference) and phase (degrees or radians), or magnitude alone; each of them
/// any number of times; a universal file of datasets 58; a MATLAB file of such columns.
///
/// Columns are found by name; without names, two columns are frequency and magnitude, and three are frequency, real and
/// imaginary part if both change sign. Where nothing says the quantity (accelerance or inertance, mobility, receptance
/// or compliance, or units such as `m/s2/N`), accelerance is assumed and noted. Rows out of order are sorted; a
/// frequency repeated with the same values counts once. A response whose phase rises through its resonances is of the
/// convention `exp(-i omega t)`: it is conjugated. A column of coherence becomes the weight of its response. Units of
/// motion over force, such as `g/N` or `mm/s2/lbf`, become SI; others are taken as SI.
pub fn read_response(
    bytes: &[u8],
    source: &str,
    options: &ResponseOptions,
) -> Result<ResponseFile, ReadError> {
    responses(bytes, options).map_err(|error| error.of(source))
}

fn responses(bytes: &[u8], options: &ResponseOptions) -> Result<ResponseFile, ReadError> {
    let mut file = match Format::of(bytes) {
        Format::Universal => uff::read_responses(bytes, options.quantity)?,
        Format::Wave => {
            let found = "a WAV file, which holds time signals: give it to `frictionsim signal`";
            return Err(ReadError::foreign(found));
        }
        other => from_table(&other.table(bytes, &options.columns)?, options)?,
    };
    file.responses = selected(file.responses, |one| &one.name, &options.channels)?;
    let mut turned = Vec::new();
    for named in file.responses.iter_mut().filter(|named| named.response.turns_backwards()) {
        named.response.conjugate();
        turned.push(named.name.clone());
    }
    if !turned.is_empty() {
        file.notes.push(format!(
            "the phase rises through the resonances, as under exp(-i omega t): conjugated ({})",
            first_of(&turned)
        ));
    }
    Ok(file)
}

fn from_table(table: &Table, options: &ResponseOptions) -> Result<ResponseFile, ReadError> {
    let mut notes = Vec::new();
    let (frequency, factor, states_unit) = frequency_column(table)?;
    let found = columns::responses(table, frequency, &mut notes)?;
    let quantity = quantity(table, options.quantity, &mut notes);
    // One order of the rows for all responses.
    let rows = ordered(table, frequency, factor, &found, &mut notes)?;
    let frequencies: Vec<f64> = rows.iter().map(|row| row.0).collect();
    let highest = frequencies.last().copied().unwrap_or(0.0);
    if !states_unit && highest < 50.0 {
        notes.push(format!(
            "frequencies up to {highest} without a unit are taken as Hz; if they are kHz, name the column \
             `frequency_khz` (or --columns f_khz,...)"
        ));
    }
    let coherences: Vec<usize> =
        (0..table.names.len()).filter(|k| part(&table.names[*k]) == Part::Coherence).collect();
    let said = "lines whose coherence is below the median count less in the fit, by (1 - c) / c";
    notes.extend((!coherences.is_empty()).then(|| said.to_owned()));
    let mut responses = Vec::new();
    for (k, Found { name, column, values, has_phase }) in found.into_iter().enumerate() {
        let scale = scale(table, column, &mut notes);
        let values = rows.iter().map(|row| values[row.1] * scale).collect();
        let all = frequencies.clone();
        let response = FrequencyResponse::measured(all, values, quantity, has_phase);
        let mut response = response.map_err(ReadError::whole)?;
        // One coherence for each response, or one for all.
        if let Some(column) = coherences.get(k).or(coherences.first()) {
            let all = &table.columns[*column].real;
            let coherence: Vec<f64> = rows.iter().map(|row| all[row.1]).collect();
            response = response.with_coherence(&coherence);
        }
        responses.push(NamedResponse { name, response });
    }
    Ok(ResponseFile { responses, notes })
}

/// The frequency column, its factor to Hz, and whether its name states the unit.
fn frequency_column(table: &Table) -> Result<(usize, f64, bool), ReadError> {
    if table.names.is_empty() {
        return Ok((0, 1.0, false));
    }
    let remedy = "name it `frequency_hz`, or name all columns: --columns f,re,im";
    (0..table.names.len())
        .filter(|&k| part(&table.names[k]) == Part::Other && table.columns[k].imaginary.is_none())
        .find_map(|k| hertz(&table.names[k]).map(|(factor, stated)| (k, factor, stated)))
        .ok_or_else(|| table.missing("frequency", remedy))
}

/// Frequencies in rising order, each once, with the row they come from.
fn ordered(
    table: &Table,
    column: usize,
    factor: f64,
    found: &[Found],
    notes: &mut Vec<String>,
) -> Result<Vec<(f64, usize)>, ReadError> {
    let raw = &table.columns[column].real;
    if let Some(i) = raw.iter().position(|f| *f < 0.0) {
        let problem = format!("frequency {} is negative; export the one-sided response", raw[i]);
        return Err(table.error(i, column, problem));
    }
    let numbered = raw.iter().enumerate();
    let mut rows: Vec<(f64, usize)> = numbered.map(|(i, f)| (f * factor, i)).collect();
    if raw.windows(2).any(|w| w[1] < w[0]) {
        rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        notes.push("the frequencies were out of order: rows sorted".to_string());
    }
    let mut kept: Vec<(f64, usize)> = Vec::with_capacity(rows.len());
    let mut dropped = 0;
    for row in rows {
        match kept.last() {
            Some(last) if last.0 == row.0 => {
                if found.iter().any(|own| own.values[last.1] != own.values[row.1]) {
                    let (value, first) = (row.0, table.line(last.1));
                    let problem = format!(
                        "frequency {value} Hz is already in line {first} with another value; keep one of the rows"
                    );
                    return Err(table.error(row.1, column, problem));
                }
                dropped += 1;
            }
            _ => kept.push(row),
        }
    }
    if dropped > 0 {
        notes.push(format!("{dropped} repeated row(s) with equal values dropped"));
    }
    Ok(kept)
}

/// The quantity given, else stated, else assumed.
fn quantity(
    table: &Table,
    given: Option<ResponseQuantity>,
    notes: &mut Vec<String>,
) -> ResponseQuantity {
    const UNSAID: &str =
        "the table does not say what it holds: accelerance (acceleration over force) assumed";
    let stated = stated_quantity(table);
    match [given, stated].map(|own| own.map(ResponseQuantity::name)) {
        [Some(given), Some(found)] if given != found => {
            notes.push(format!("the table says {found}, the option {given}: the option is used"));
        }
        [None, None] => notes.push(UNSAID.to_owned()),
        _ => {}
    }
    given.or(stated).unwrap_or(ResponseQuantity::Accelerance)
}

/// Words of each quantity.
const QUANTITIES: [(ResponseQuantity, &str); 3] = [
    (ResponseQuantity::Accelerance, "accelerance inertance accélérance"),
    (ResponseQuantity::Mobility, "mobility mobilité admittance"),
    (ResponseQuantity::Receptance, "receptance réceptance compliance flexibility"),
];

/// Receptance, mobility or accelerance, from names, remarks and units.
fn stated_quantity(table: &Table) -> Option<ResponseQuantity> {
    let text = format!("{}\n{}", table.titles.join("\n"), table.remarks).to_lowercase();
    let has = |list: &str| list.split(' ').any(|word| text.contains(word));
    let named = QUANTITIES.iter().find(|(_, words)| has(words)).map(|(quantity, _)| *quantity);
    let unit = || ORDINATES.get(text.lines().find_map(response_unit)?.1);
    named.or_else(|| unit().map(|(_, quantity)| *quantity))
}

/// Factor to SI of a response by the unit in its heading, else by one in the remarks.
fn scale(table: &Table, column: usize, notes: &mut Vec<String>) -> f64 {
    let title = table.titles.get(column).map_or("", String::as_str);
    let unit = response_unit(title).or_else(|| table.remarks.lines().find_map(response_unit));
    let volts = title.split([' ', '(', ')', '[', ']']).find(|word| word.contains("V/"));
    if let Some(unit) = volts.filter(|_| unit.is_none()) {
        notes.push(format!("`{}` is no unit of motion over force: taken as SI", shortened(unit)));
    }
    unit.map_or(1.0, |(scale, _)| scale)
}
