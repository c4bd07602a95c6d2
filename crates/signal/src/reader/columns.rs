//! The columns of a table that make a frequency response.

use super::error::ReadError;
use super::table::Table;
use super::units::{level_reference, words};

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

/// The columns that make a response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Layout {
    /// A column of complex numbers.
    Whole(usize),
    /// Columns of real and imaginary parts.
    Complex(usize, usize),
    Polar {
        magnitude: usize,
        /// The reference of a level in decibel.
        level_reference: Option<f64>,
        /// Column and factor to radians.
        phase: Option<(usize, f64)>,
    },
}

impl Layout {
    pub(super) fn has_phase(self) -> bool {
        !matches!(self, Layout::Polar { phase: None, .. })
    }
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

/// Every response of a table with its name.
pub(super) fn layouts(
    table: &Table,
    frequency: usize,
    notes: &mut Vec<String>,
) -> Result<Vec<(String, Layout)>, ReadError> {
    let whole: Vec<usize> =
        (0..table.columns.len()).filter(|k| table.columns[*k].imaginary.is_some()).collect();
    if table.names.is_empty() && whole.is_empty() {
        return Ok(vec![("response".to_string(), unnamed_layout(table)?)]);
    }
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
    let found: Vec<(usize, Layout)> = if !whole.is_empty() {
        whole.iter().map(|k| (*k, Layout::Whole(*k))).collect()
    } else if !real.is_empty() {
        let pairs = real.iter().zip(paired(table, &real, imaginary));
        pairs.map(|(re, im)| (*re, Layout::Complex(*re, im))).collect()
    } else {
        polar(table, &columns, notes)
    };
    if found.is_empty() {
        return missing(
            "response",
            "name the columns `real` and `imaginary`, or `magnitude` or `magnitude_db` and `phase_deg`",
        );
    }
    Ok(one_estimator(named(table, found), notes))
}

/// The `others` in the order of the columns that they go with: by their names where each has one, else as they stand.
fn paired(table: &Table, columns: &[usize], others: Vec<usize>) -> Vec<usize> {
    let name = |k: usize| named(table, vec![(k, Layout::Whole(k))]).remove(0).0;
    let partner = |&k: &usize| {
        let mut same = others.iter().copied().filter(|&other| name(other) == name(k));
        same.next().filter(|_| same.next().is_none())
    };
    columns.iter().map(partner).collect::<Option<_>>().unwrap_or(others)
}

/// Magnitudes with their phases: as many as magnitudes in degrees or radians, or none.
fn polar(
    table: &Table,
    columns: &dyn Fn(Part) -> Vec<usize>,
    notes: &mut Vec<String>,
) -> Vec<(usize, Layout)> {
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
            let phase = phases.get(i).map(|&k| (k, factor(k)));
            (magnitude, Layout::Polar { magnitude, level_reference, phase })
        })
        .collect()
}

/// Each response by the title of its first column without the words for its parts.
fn named(table: &Table, found: Vec<(usize, Layout)>) -> Vec<(String, Layout)> {
    let count = found.len();
    let numbered = found.into_iter().enumerate();
    numbered
        .map(|(i, (column, layout))| {
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
            let kept: Vec<&str> = title.split(between).filter(is_name).collect();
            let name = match (kept.is_empty(), count) {
                (true, 1) => "response".to_string(),
                (true, _) => format!("response {}", i + 1),
                (false, _) => kept.join(" "),
            };
            (name, layout)
        })
        .collect()
}

/// H1 and H2 are two estimates of one response: the first is kept.
fn one_estimator(
    mut found: Vec<(String, Layout)>,
    notes: &mut Vec<String>,
) -> Vec<(String, Layout)> {
    let has = |name: &str, word: &str| words(&name.to_lowercase()).contains(&word);
    if ["h1", "h2"].iter().all(|word| found.iter().any(|(name, _)| has(name, word))) {
        found.retain(|(name, _)| !has(name, "h2"));
        notes.push("H1 and H2 are two estimates of one response: H1 is used".to_string());
    }
    found
}

/// Columns without names, where the numbers leave no doubt.
fn unnamed_layout(table: &Table) -> Result<Layout, ReadError> {
    let column = |k: usize| table.columns[k].real.iter().copied();
    let least = |k: usize| column(k).fold(f64::INFINITY, f64::min);
    let most = |k: usize| column(k).fold(f64::NEG_INFINITY, f64::max);
    let size = |k: usize| most(k).max(-least(k));
    let changes_sign = |k: usize| least(k) < 0.0 && most(k) > 0.0;
    match table.columns.len() {
        2 if least(1) >= 0.0 => {
            Ok(Layout::Polar { magnitude: 1, level_reference: None, phase: None })
        }
        // Decibels beside degrees are of another size than two parts of one number.
        3 if changes_sign(1)
            && changes_sign(2)
            && size(1) < 20.0 * size(2)
            && size(2) < 20.0 * size(1)
            && size(2) < 90.0 =>
        {
            Ok(Layout::Complex(1, 2))
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
