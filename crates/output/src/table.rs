//! Columns and tables, declared once.

use super::csv;
use super::number::{Format, unit_of};
use serde::{Deserialize, Serialize};
use std::{borrow::Borrow, io};

/// What stands in one place of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Cell {
    /// Nothing: it does not apply.
    None,
    /// A whole number.
    Count(i64),
    /// A number; one that is not finite is nothing.
    Number(f64),
    /// Yes or no.
    Flag(bool),
    /// Words.
    Text(String),
}

impl Cell {
    /// As it stands in CSV: numbers in the shortest form that reads back as the same bits.
    pub fn csv(&self) -> String {
        match self {
            Self::None => String::new(),
            Self::Count(count) => count.to_string(),
            Self::Number(value) => csv::format_number(*value),
            Self::Flag(flag) => flag.to_string(),
            Self::Text(text) => text.clone(),
        }
    }

    /// The number that it is, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Count(count) => Some(*count as f64),
            Self::None | Self::Flag(_) | Self::Text(_) => None,
        }
    }

    /// As people read it.
    pub fn text(&self, format: Format) -> String {
        match self {
            Self::Number(value) => format.number(*value),
            Self::Flag(true) => "yes".to_owned(),
            Self::Flag(false) => "no".to_owned(),
            other => other.csv(),
        }
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::None, Into::into)
    }
}

macro_rules! cells {
    ($($kind:ty: $value:ident => $cell:expr;)+) => {$(
        impl From<$kind> for Cell {
            fn from($value: $kind) -> Self {
                $cell
            }
        }
    )+};
}

cells! {
    f64: value => Self::Number(value);
    bool: flag => Self::Flag(flag);
    u8: count => Self::Count(i64::from(count));
    i8: count => Self::Count(i64::from(count));
    usize: count => Self::Count(count as i64);
    &str: text => Self::Text(text.to_owned());
    &String: text => Self::Text(text.clone());
    String: text => Self::Text(text);
}

/// Whether people see a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shown {
    /// In every table.
    Always,
    /// Where some row has something there.
    IfAny,
}

/// One column of a table of `T`s.
pub struct Column<T> {
    /// Name in CSV.
    pub key: &'static str,
    /// What it means, in a line.
    pub meaning: &'static str,
    /// When people see it, what stands above it, without the unit, and its digits; none where it is in files only.
    pub look: Option<(Shown, &'static str, Format)>,
    /// Its cell of a row.
    pub cell: fn(&T) -> Cell,
}

impl<T> Column<T> {
    /// What stands above it, with the unit; its name where it is in files only.
    pub fn heading(&self) -> String {
        let look = self.look.map(|(when, label, format)| (when, label.to_owned(), format));
        Head { key: self.key.to_owned(), look }.label()
    }
}

/// Declares tables of columns, each behind its comment: `NAME: row as Type; key: "meaning" = cell, Always "label"
/// Fixed(2); ...`; a constant may stand for a meaning, and columns that no file has need none.
#[macro_export]
macro_rules! columns {
    ($($(#[$meta:meta])+ $vis:vis $name:ident: $row:ident as $type:ty;
     $($key:ident $(: $meaning:tt)? = $cell:expr $(, $when:ident $label:literal $format:expr)?;)+)+) => {$(
        $(#[$meta])+
        $vis const $name: &[$crate::Column<$type>] = {
            #[allow(unused_imports)]
            use $crate::Format::*;
            &[$($crate::Column {
                key: stringify!($key),
                meaning: [$($meaning,)? ""][0],
                look: [$(Some(($crate::Shown::$when, $label, $format)),)? None][0],
                cell: |#[allow(unused_variables)] $row: &$type| $crate::Cell::from($cell),
            }),+]
        };
    )+};
}

/// The columns before the one of this name, and those from it on: two tables of one row share a part of its columns.
/// Of a constant the parts are constants too, and a name that no column has does not compile.
///
/// # Panics
/// Where no column has that name.
pub const fn parted<T>(
    columns: &'static [Column<T>],
    name: &str,
) -> (&'static [Column<T>], &'static [Column<T>]) {
    let mut at = 0;
    while !is_same(columns[at].key.as_bytes(), name.as_bytes()) {
        at += 1;
    }
    columns.split_at(at)
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    match (a, b) {
        ([], []) => true,
        ([a, rest @ ..], [b, others @ ..]) => *a == *b && is_same(rest, others),
        _ => false,
    }
}

/// Writes a table of declared columns as its rows are made.
pub fn write_rows<T>(
    out: impl io::Write,
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|column| column.key).collect();
    let cells = |row: T| columns.iter().map(move |column| (column.cell)(&row).csv());
    csv::write(out, &names, rows.into_iter().map(cells))
}

/// A column of a file or a key of JSON in the reference, with what it means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name, of a key its path from the root.
    pub key: String,
    /// What it means.
    pub meaning: String,
}

impl Entry {
    /// A name and what it means.
    pub fn new(key: impl Into<String>, meaning: &str) -> Self {
        Self { key: key.into(), meaning: meaning.to_owned() }
    }
}

/// The entries of declared columns, behind a prefix.
pub fn entries<T>(prefix: &str, columns: &[Column<T>]) -> Vec<Entry> {
    columns.iter().map(|own| Entry::new(format!("{prefix}{}", own.key), own.meaning)).collect()
}

/// The head of a column in a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// Name in CSV.
    pub key: String,
    /// How people see it.
    pub look: Option<(Shown, String, Format)>,
}

impl Head {
    /// Label and unit.
    fn label(&self) -> String {
        let Some((_, label, format)) = &self.look else { return self.key.clone() };
        let is_share = matches!(format, Format::Percent(_));
        let unit = if is_share { "%" } else { unit_of(&self.key).1 };
        if unit.is_empty() { label.clone() } else { format!("{label} ({unit})") }
    }
}

/// A table of cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Its file, if it is one.
    pub file: String,
    /// What it shows, in a line.
    pub caption: String,
    heads: Vec<Head>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table; without a name of a file it is none.
    pub fn new(file: impl Into<String>, caption: impl Into<String>) -> Self {
        Self { file: file.into(), caption: caption.into(), ..Self::default() }
    }

    /// The same with further columns, a row for each item.
    #[must_use]
    pub fn columns<T, R: Borrow<T>>(
        self,
        columns: &[Column<T>],
        rows: impl IntoIterator<Item = R>,
    ) -> Self {
        self.group("", "", columns, rows.into_iter().map(Some))
    }

    /// The same with further columns behind a prefix of their names and one of their labels; nothing where an item is
    /// none.
    #[must_use]
    pub fn group<T, R: Borrow<T>>(
        mut self,
        prefix: &str,
        label: &str,
        columns: &[Column<T>],
        rows: impl IntoIterator<Item = Option<R>>,
    ) -> Self {
        self.heads.extend(columns.iter().map(|column| Head {
            key: format!("{prefix}{}", column.key),
            look: column.look.map(|(when, own, format)| (when, format!("{label}{own}"), format)),
        }));
        let cell = |column: &Column<T>, row: &Option<R>| {
            row.as_ref().map_or(Cell::None, |row| (column.cell)(row.borrow()))
        };
        for (at, row) in rows.into_iter().enumerate() {
            self.row(at).extend(columns.iter().map(|column| cell(column, &row)));
        }
        self
    }

    /// The same with powers for each metre of thickness; of a table for people, as names in files stay what they are.
    #[must_use]
    pub fn for_each_metre(mut self) -> Self {
        let powers = self.heads.iter_mut().filter(|head| head.key.ends_with("_w"));
        powers.for_each(|head| head.key += "_per_m");
        self
    }

    /// The same with one column that people see where it has something, and files do not have.
    #[must_use]
    pub fn shown_column<C: Into<Cell>>(
        self,
        label: &str,
        cells: impl IntoIterator<Item = C>,
    ) -> Self {
        let look = Some((Shown::IfAny, label.to_owned(), Format::Plain));
        self.one(Head { key: String::new(), look }, cells)
    }

    /// The same with one column that the case decides.
    #[must_use]
    pub fn column<C: Into<Cell>>(
        self,
        key: &str,
        look: Option<(&str, Format)>,
        cells: impl IntoIterator<Item = C>,
    ) -> Self {
        let look = look.map(|(label, format)| (Shown::Always, label.to_owned(), format));
        self.one(Head { key: key.to_owned(), look }, cells)
    }

    fn one<C: Into<Cell>>(mut self, head: Head, cells: impl IntoIterator<Item = C>) -> Self {
        self.heads.push(head);
        for (at, cell) in cells.into_iter().enumerate() {
            self.row(at).push(cell.into());
        }
        self
    }

    /// The same without a column in which no row has anything.
    #[must_use]
    pub fn without_empty(mut self, key: &str) -> Self {
        let Some(at) = self.heads.iter().position(|head| head.key == key) else { return self };
        if self.is_empty_at(at) {
            self.heads.remove(at);
            self.rows.iter_mut().for_each(|row| drop(row.remove(at)));
        }
        self
    }

    fn row(&mut self, at: usize) -> &mut Vec<Cell> {
        self.rows.resize(self.rows.len().max(at + 1), Vec::new());
        &mut self.rows[at]
    }

    /// Whether every row has a cell for each column.
    pub fn is_whole(&self) -> bool {
        self.rows.iter().all(|row| row.len() == self.heads.len())
    }

    fn is_empty_at(&self, column: usize) -> bool {
        self.rows.iter().all(|row| matches!(row[column], Cell::None))
    }

    /// Writes it as CSV, all columns.
    pub fn write_csv(&self, out: impl io::Write) -> io::Result<()> {
        let written = self.heads.iter().enumerate().filter(|(_, head)| !head.key.is_empty());
        let (places, names): (Vec<usize>, Vec<&str>) =
            written.map(|(at, head)| (at, head.key.as_str())).unzip();
        csv::write(out, &names, self.rows.iter().map(|row| places.iter().map(|&at| row[at].csv())))
    }

    /// Labels with units, and the cells of each row, of the columns that people see; no row where they see none.
    pub fn shown(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let is_shown = |at: &usize| match self.heads[*at].look {
            Some((Shown::Always, ..)) => true,
            Some((Shown::IfAny, ..)) => !self.is_empty_at(*at),
            None => false,
        };
        let shown: Vec<usize> = (0..self.heads.len()).filter(is_shown).collect();
        let cell = |row: &Vec<Cell>, at: usize| {
            let format = self.heads[at].look.as_ref().map_or(Format::Plain, |look| look.2);
            row[at].text(format)
        };
        let rows = self.rows.iter().filter(|_| !shown.is_empty());
        let rows = rows.map(|row| shown.iter().map(|&at| cell(row, at)).collect());
        (shown.iter().map(|&at| self.heads[at].label()).collect(), rows.collect())
    }

    /// As aligned text: numbers to the right, words to the left; nothing where people see no column or no row.
    pub fn text(&self) -> String {
        let (labels, rows) = self.shown();
        if rows.is_empty() {
            return String::new();
        }
        let width = |at: usize| {
            let cells = rows.iter().map(|row| row[at].chars().count());
            cells.chain([labels[at].chars().count()]).max().unwrap_or(0)
        };
        let is_number = |cell: &str| ["", "-"].contains(&cell) || cell.parse::<f64>().is_ok();
        let are_numbers = |at: usize| rows.iter().all(|row| is_number(&row[at]));
        let looks: Vec<_> = (0..labels.len()).map(|at| (width(at), are_numbers(at))).collect();
        let mut out = String::new();
        for row in std::iter::once(&labels).chain(&rows) {
            let mut line = String::new();
            for (cell, &(width, is_number)) in row.iter().zip(&looks) {
                let right = if is_number { width } else { 0 };
                line += &format!("  {:<width$}", format!("{cell:>right$}"));
            }
            out.extend([line.trim_end(), "\n"]);
        }
        out
    }
}
