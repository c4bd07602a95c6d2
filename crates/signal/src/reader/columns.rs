//! The columns of a table that make a frequency response.

use super::units::{level_reference, words};
use super::{error::ReadError, table::Table};
use faer::c64;

/// What a column of a response table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Real,
    Imaginary,
    Magnitude,
    Decibel,
    Degrees,
    Radians,
    Coherence,
    Other,
}

/// A response of a table.
pub(super) struct Found {
    pub name: String,
    /// Its first column.
    pub column: usize,
    /// Complex values of each row; real magnitudes where there is no phase.
    pub values: Vec<c64>,
    pub has_phase: bool,
}

/// Each part with the words that name it and the words that its words may begin with; the first that fits is it. A
/// level is told before a real part: `dB re 1 m/s2/N` holds the word `re`.
const PARTS: [(Part, &str, &str); 6] = [
    (Part::Coherence, "", "coh kohärenz cohérence gamma2 γ²"),
    (Part::Decibel, "db decibel dezibel décibel", ""),
    (Part::Imaginary, "im", "imag"),
    (Part::Real, "re", "real réel reel"),
    (Part::Degrees, "arg deg °", "phase angle phi winkel"),
    (
        Part::Magnitude,
        "abs h h1 h2 hv frf |h| gain admittance flexibility",
        "mag ampl modul accelerance inertance mobil recept récept compliance betrag accélérance",
    ),
];

/// What a lower-case column name says.
pub(super) fn part(name: &str) -> Part {
    let words = words(name);
    let has = |list: &str| list.split(' ').any(|known| words.contains(&known));
    let begins =
        |list: &str| list.split_whitespace().any(|l| words.iter().any(|w| w.starts_with(l)));
    match PARTS.iter().find(|(_, whole, begin)| has(whole) || begins(begin)) {
        Some((Part::Degrees, ..)) if has("rad radian radians") => Part::Radians,
        Some((part, ..)) => *part,
        None => Part::Other,
    }
}

/// Every response of a table.
pub(super) fn responses(
    table: &Table,
    frequency: usize,
    notes: &mut Vec<String>,
) -> Result<Vec<Found>, ReadError> {
    let whole: Vec<(usize, &[f64])> = (table.columns.iter().enumerate())
        .filter_map(|(k, column)| Some((k, column.imaginary.as_deref()?)))
        .collect();
    let columns = |wanted: Part| -> Vec<usize> {
        let named = (0..table.names.len()).filter(|k| *k != frequency);
        named.filter(|k| part(&table.names[*k]) == wanted).collect()
    };
    let missing = |wanted, remedy| Err(table.missing(wanted, remedy));
    let (real, imaginary) = (columns(Part::Real), columns(Part::Imaginary));
    if whole.is_empty() && real.len() > imaginary.len() {
        return missing("imaginary part", "name it `imaginary`, or give magnitude and phase");
    }
    if whole.is_empty() && real.len() < imaginary.len() {
        return missing("real part", "name it `real`, or give magnitude and phase");
    }
    // Complex numbers come first, then pairs of parts, then levels, then magnitudes.
    let mut found: Vec<Found> = if !whole.is_empty() {
        whole.iter().map(|(k, imaginary)| complex(table, *k, imaginary)).collect()
    } else if table.names.is_empty() {
        vec![unnamed(table)?]
    } else if !real.is_empty() {
        let pairs = real.iter().zip(paired(table, &real, imaginary));
        pairs.map(|(re, im)| complex(table, *re, &table.columns[im].real)).collect()
    } else {
        all_polar(table, &columns, notes)?
    };
    if found.is_empty() {
        return missing(
            "response",
            "name the columns `real` and `imaginary`, or `magnitude` or `magnitude_db` and `phase_deg`",
        );
    }
    let count = found.len();
    for (i, nameless) in found.iter_mut().enumerate().filter(|(_, own)| own.name.is_empty()) {
        let number = if count == 1 { String::new() } else { format!(" {}", i + 1) };
        nameless.name = format!("response{number}");
    }
    // H1 and H2 are two estimates of one response.
    let has = |own: &Found, word: &str| words(&own.name.to_lowercase()).contains(&word);
    if ["h1", "h2"].iter().all(|word| found.iter().any(|own| has(own, word))) {
        found.retain(|own| !has(own, "h2"));
        notes.push("H1 and H2 are two estimates of one response: H1 is used".to_string());
    }
    Ok(found)
}

/// A response of the real parts in a column and imaginary ones.
fn complex(table: &Table, column: usize, imaginary: &[f64]) -> Found {
    let pairs = table.columns[column].real.iter().zip(imaginary);
    let values = pairs.map(|(re, im)| c64::new(*re, *im)).collect();
    Found { name: name(table, column), column, values, has_phase: true }
}

/// A response of the magnitudes in a column, or levels over a reference in decibel, and the phases in another one, of
/// this factor to radians.
fn polar(
    table: &Table,
    column: usize,
    level_reference: Option<f64>,
    phase: Option<(usize, f64)>,
) -> Result<Found, ReadError> {
    let value = |(i, value): (usize, &f64)| {
        let of_level = |reference| reference * 10f64.powf(value / 20.0);
        let modulus = level_reference.map_or(*value, of_level);
        if modulus < 0.0 {
            let problem = format!(
                "magnitude {value} is negative; if it is in decibels, say so in the header (magnitude_db)"
            );
            return Err(table.error(i, column, problem));
        }
        let angle = phase.map_or(0.0, |(k, factor)| table.columns[k].real[i] * factor);
        Ok(c64::from_polar(modulus, angle))
    };
    let values = table.columns[column].real.iter().enumerate().map(value);
    let (values, has_phase) = (values.collect::<Result<_, _>>()?, phase.is_some());
    Ok(Found { name: name(table, column), column, values, has_phase })
}

/// The `others` in the order of the columns that they go with: by their names where each has one, else as they stand.
fn paired(table: &Table, columns: &[usize], others: Vec<usize>) -> Vec<usize> {
    let partner = |&k: &usize| {
        let mut same = others.iter().copied().filter(|&other| name(table, other) == name(table, k));
        same.next().filter(|_| same.next().is_none())
    };
    columns.iter().map(partner).collect::<Option<_>>().unwrap_or(others)
}

/// Magnitudes with their phases: as many as magnitudes in degrees or radians, or none.
fn all_polar(
    table: &Table,
    columns: &dyn Fn(Part) -> Vec<usize>,
    notes: &mut Vec<String>,
) -> Result<Vec<Found>, ReadError> {
    let decibel = columns(Part::Decibel);
    let is_level = !decibel.is_empty();
    let magnitudes = if is_level { decibel } else { columns(Part::Magnitude) };
    // A phase that turns through a resonance leaves a turn of 6.3 in degrees, not in radians.
    let is_doubtful = |k: &usize| {
        let states_unit = words(&table.names[*k]).iter().any(|w| w.starts_with("deg") || *w == "°");
        !states_unit && table.columns[*k].real.iter().all(|angle| angle.abs() < 6.3)
    };
    let degrees = columns(Part::Degrees);
    if degrees.iter().any(is_doubtful) {
        let remedy = "if they are degrees, name the column `phase_deg`";
        notes.push(format!("phases within 6.3 without a unit are taken as radians; {remedy}"));
    }
    let radians = columns(Part::Radians);
    let is_radians = |k: usize| radians.contains(&k) || is_doubtful(&k);
    let factor = |k: usize| if is_radians(k) { 1.0 } else { std::f64::consts::PI / 180.0 };
    let phases = paired(table, &magnitudes, [degrees, radians.clone()].concat());
    let numbered = magnitudes.iter().enumerate();
    numbered
        .map(|(i, &magnitude)| {
            let level_reference = is_level.then(|| level_reference(&table.names[magnitude]));
            polar(table, magnitude, level_reference, phases.get(i).map(|&k| (k, factor(k))))
        })
        .collect()
}

/// The title of a column without the words for its part, empty where it has no others.
fn name(table: &Table, column: usize) -> String {
    let title = table.titles.get(column).map_or("", |t| t.as_str());
    // What follows `dB` is its reference.
    let level = title.to_ascii_lowercase().find("db");
    let title = &title[..level.unwrap_or(title.len())];
    let between = |c: char| c.is_whitespace() || "_()[],".contains(c);
    let is_name = |word: &&str| {
        use Part::{Decibel, Degrees, Imaginary, Real};
        let lower = word.to_lowercase();
        !word.is_empty()
            && !matches!(part(&lower), Real | Imaginary | Decibel | Degrees)
            && (!super::units::is_unit(&lower) || lower.parse::<u32>().is_ok())
            && !lower.starts_with("mag")
    };
    title.split(between).filter(is_name).collect::<Vec<_>>().join(" ")
}

/// Columns without names, where the numbers leave no doubt.
fn unnamed(table: &Table) -> Result<Found, ReadError> {
    let column = |k: usize| table.columns[k].real.iter().copied();
    let least = |k: usize| column(k).fold(f64::INFINITY, f64::min);
    let most = |k: usize| column(k).fold(f64::NEG_INFINITY, f64::max);
    let size = |k: usize| most(k).max(-least(k));
    let changes_sign = |k: usize| least(k) < 0.0 && most(k) > 0.0;
    match table.columns.len() {
        2 if least(1) >= 0.0 => polar(table, 1, None, None),
        // Decibels beside degrees are of another size than two parts of one number.
        3 if changes_sign(1)
            && changes_sign(2)
            && size(1) < 20.0 * size(2)
            && size(2) < 20.0 * size(1)
            && size(2) < 90.0 =>
        {
            Ok(complex(table, 1, &table.columns[2].real))
        }
        1 => Err(table.missing("response", "frequency and response must stand side by side")),
        count => {
            let problem = format!(
                "{count} columns without names could mean several things; add a first line such \
                 as `f,re,im`, or give the names: --columns f,re,im"
            );
            Err(table.error(0, 0, problem))
        }
    }
}
