//! Lines of a text file with their places, the files that it includes among them.

use crate::prelude::*;
/// What marks the begin and the end of included text, behind the sign of a comment.
const BEGIN: &str = " >>> included: ";
const END: &str = " <<< end of included text";

/// A line of one of the files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place {
    file: u32,
    line: u32,
}

/// Text of a file and of those that it includes.
pub(super) struct Deck<'a> {
    /// All lines but the marks of includes.
    pub lines: Vec<(Place, &'a str)>,
    /// Names of included files; number 0 is the file itself.
    names: Vec<&'a str>,
    /// What may be read yet.
    pub budget: Budget,
}

/// Text that stands in the place of the line that included it; `comment` begins comments of the format.
pub fn included_text(comment: &str, name: &str, text: &str) -> String {
    let newline = if text.ends_with('\n') { "" } else { "\n" };
    format!("{comment}{BEGIN}{name}\n{text}{newline}{comment}{END}\n")
}

impl<'a> Deck<'a> {
    /// Splits a text into lines; `comment` begins comments of the format. Lines without anything are left out where
    /// `keeps_empty` does not keep them.
    ///
    /// # Errors
    /// More lines than may be read.
    pub fn new(text: &'a str, comment: &str, keeps_empty: bool) -> Result<Self> {
        let is_kept = |line: &&str| keeps_empty || !line.trim().is_empty();
        let mut budget = Budget::new(MESH);
        let count = text.lines().filter(is_kept).count();
        budget.take_members(count).map_err(|refusal| MeshFileError {
            place: "the whole file".to_owned(),
            message: refusal.to_string(),
        })?;
        let mut deck = Self { lines: Vec::with_capacity(count), names: vec![""], budget };
        let mut stack = Vec::new();
        let mut place = Place { file: 0, line: 0 };
        for line in text.lines() {
            let mark = line.strip_prefix(comment).unwrap_or_default();
            if mark == END
                && let Some(outer) = stack.pop()
            {
                place = outer;
                continue;
            }
            place.line += 1;
            if let Some(name) = mark.strip_prefix(BEGIN) {
                stack.push(place);
                place = Place { file: deck.names.len() as u32, line: 0 };
                deck.names.push(name);
            } else if is_kept(&line) {
                deck.lines.push((place, line));
            }
        }
        Ok(deck)
    }

    /// A place in words.
    pub fn name(&self, place: Place) -> String {
        let file = self.names.get(place.file as usize).copied().unwrap_or_default();
        let comma = if file.is_empty() { "" } else { ", " };
        format!("{}{comma}line {}", shortened(file, MESSAGE), place.line)
    }

    /// An error at a place.
    pub fn error(&self, place: Place, message: impl Into<String>) -> MeshFileError {
        let message = shortened(&message.into(), MESSAGE);
        MeshFileError { place: self.name(place), message }
    }

    /// The place of the last line.
    pub fn end(&self) -> Place {
        self.lines.last().map_or(Place { file: 0, line: 1 }, |l| l.0)
    }
}

/// The error of a file at a place: `fault!(deck, place; "what is wrong with {}, and what to do", name)`; where a cursor
/// stands `fault!(cursor; ...)`.
macro_rules! fault {
    ($cursor:expr; $($message:tt)+) => { $cursor.error(format!($($message)+)) };
    ($deck:expr, $place:expr; $($message:tt)+) => { $deck.error($place, format!($($message)+)) };
}

/// Returns such an error.
macro_rules! refuse {
    ($($fault:tt)+) => { return Err(fault!($($fault)+)) };
}

/// Returns it where a condition does not hold: `ensure!(is_right; deck, place; "...")`.
macro_rules! ensure {
    ($holds:expr; $($fault:tt)+) => { if !$holds { refuse!($($fault)+) } };
}

/// What an option holds; returns the error of an empty one: `found!(option; deck, place; "...")`.
macro_rules! found {
    ($option:expr; $($fault:tt)+) => {
        match $option {
            Some(value) => value,
            None => refuse!($($fault)+),
        }
    };
}

/// A number as programs in Fortran write it, `1.0D+3` included; finite.
pub(super) fn real(text: &str) -> Option<f64> {
    let text = text.trim();
    let value: f64 = match text.parse() {
        Ok(value) => value,
        Err(_) => text.replace(['d', 'D'], "e").parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// A field as messages quote it.
pub(super) fn quoted(field: &str) -> String {
    let shown: String = field.trim().chars().take(40).collect();
    format!("{shown:?}")
}
