//! Tables beside a case: `materials.*.table`, modulus and loss factor over frequency, and `contacts.*.gap`, a measured
//! surface.

use super::TableBytes;
use crate::*;
use frictionsim_bounds::TABLE;
use frictionsim_physics::contact::Topography;
use frictionsim_signal::reader::{ModulusRow, read_gaps, read_moduli};

/// Softest material, Pa: with less the frequencies of a body spread over more decades than a table can follow.
const SOFTEST: f64 = 100.0;
/// A modulus that falls by more than this part of its largest value so far, beyond the scatter of measurements, is none
/// of a passive material.
const FALL: f64 = 0.05;

/// The tables of a case: known already, or files beside it.
pub(super) struct TableFiles<'a> {
    raw: &'a RawCase,
    pub(super) read: RefCell<Vec<TableBytes>>,
}

impl<'a> TableFiles<'a> {
    /// Those of a case, none read yet.
    pub(super) fn of(raw: &'a RawCase) -> Self {
        Self { raw, read: RefCell::default() }
    }

    fn bytes(&self, file: &str) -> Result<Arc<[u8]>, String> {
        let mut read = self.read.borrow_mut();
        let mut known = read.iter().chain(&self.raw.tables).filter(|table| table.file == file);
        let bytes = match known.next() {
            Some(table) => Arc::clone(&table.bytes),
            None => {
                let path = self.raw.beside(file);
                let bytes = frictionsim_bounds::read(&path, TABLE);
                let fail = |why| format!("cannot read the table {}: {why}", path.display());
                bytes.map_err(fail)?.into()
            }
        };
        if !read.iter().any(|table| table.file == file) {
            read.push(TableBytes { file: file.to_owned(), bytes: Arc::clone(&bytes) });
        }
        Ok(bytes)
    }
}

/// The table of `[material]` or of a section of `[materials.*]`, where it has one.
pub(super) fn modulus_table(own: &Section<'_>, all: &TableFiles<'_>) -> Option<Arc<ModulusTable>> {
    let file = own.optional_text("table")?;
    let reject = |message: String, label: &str, help: &str| {
        refuse!(own, "table", "{}: {message}", own.name("table"); "{label}"; "{help}");
    };
    let readable = all.bytes(&file);
    let rows = readable.and_then(|bytes| read_moduli(&bytes, &file).map_err(|e| e.to_string()));
    let columns = "its columns are frequency_hz, young_modulus (Pa) and loss_factor";
    let rows = rows.map_err(|reason| reject(reason, "not a table of moduli", columns)).ok()?;
    if let Err((line, what, help)) = sound(&rows) {
        reject(format!("{file}:{line}: {what}"), "no material is like that", help);
        return None;
    }
    if let Some((line, what)) = falling(&rows) {
        caution!(own, "table",
            "{}: {file}:{line}: {what}; the modulus of a passive material rises with the frequency",
            own.name("table"); "falls with the frequency");
    }
    let rows = rows.iter().map(|row| [row.frequency_hz, row.young_modulus, row.loss_factor]);
    let key = own.name("table");
    Some(Arc::new(ModulusTable::new(&key, &file, rows.collect())))
}

/// The measured surface of a section of `[contacts.*]`, where it has one.
pub(super) fn topography(section: &Section<'_>, files: &TableFiles<'_>) -> Option<Arc<Topography>> {
    let file = section.optional_text("gap")?;
    let readable = files.bytes(&file);
    let points = readable.and_then(|bytes| read_gaps(&bytes, &file).map_err(|e| e.to_string()));
    points
        .map(|points| Arc::new(Topography::new(&file, points)))
        .map_err(|reason| {
            refuse!(section, "gap", "{}: {reason}", section.name("gap"); "not a measured surface";
                "its columns are x, y, z and gap, all in m");
        })
        .ok()
}

/// What no table can hold: line, what is wrong, remedy.
fn sound(rows: &[ModulusRow]) -> Result<(), (usize, String, &'static str)> {
    if let [only] = rows {
        let what = "one row alone covers no range of frequencies".to_owned();
        return Err((only.line, what, "give young_modulus and loss_factor instead, or more rows"));
    }
    let mut before = f64::NEG_INFINITY;
    for row in rows {
        let ModulusRow { line, frequency_hz, young_modulus, loss_factor } = *row;
        let (what, help) = if frequency_hz < 0.0 {
            let what = format!("frequency {frequency_hz} Hz is below zero");
            (what, "frequencies begin at 0 or above it")
        } else if frequency_hz <= before {
            let what =
                format!("frequency {frequency_hz} Hz does not lie above the {before} Hz before it");
            (what, "sort the rows by frequency and leave repeated ones out")
        } else if young_modulus <= 0.0 {
            let what = format!("modulus {young_modulus} Pa is not above zero");
            (what, "a modulus is positive at every frequency")
        } else if young_modulus < SOFTEST {
            let what = format!("modulus {young_modulus} Pa is below that of any solid");
            (what, "at least 100 Pa; a soft gel has 1000. Is it in GPa?")
        } else if loss_factor < 0.0 {
            let what =
                format!("loss factor {loss_factor} is below zero: the material would give energy");
            (what, "a loss factor is zero or positive")
        } else if loss_factor > 1.0 {
            let what = format!(
                "loss factor {loss_factor} is beyond 1, where half of the strain energy is lost in a sixth of a cycle"
            );
            (what, "at most 1; rubber has 0.1 to 1. Is it in percent?")
        } else {
            before = frequency_hz;
            continue;
        };
        return Err((line, format!("the {what}"), help));
    }
    Ok(())
}

/// The first row whose modulus lies well below that of one before: line and what it says.
fn falling(rows: &[ModulusRow]) -> Option<(usize, String)> {
    let mut largest = 0.0_f64;
    for row in rows {
        if row.young_modulus < (1.0 - FALL) * largest {
            let what = format!("the modulus falls from {largest:e} to {:e} Pa", row.young_modulus);
            return Some((row.line, what));
        }
        largest = largest.max(row.young_modulus);
    }
    None
}
