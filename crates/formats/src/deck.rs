//! Lines of a text file with their places, the files that it includes among them.

use super::file_mesh::MeshFileError;

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
}

/// Text that stands in the place of the line that included it; `comment` begins comments of the format.
pub fn included_text(comment: &str, name: &str, text: &str) -> String {
    let newline = if text.ends_with('\n') { "" } else { "\n" };
    format!("{comment}{BEGIN}{name}\n{text}{newline}{comment}{END}\n")
}

impl<'a> Deck<'a> {
    /// Splits a text into lines; `comment` begins comments of the format.
    pub fn new(text: &'a str, comment: &str) -> Self {
        let mut deck = Self { lines: Vec::new(), names: vec![""] };
        let mut stack = Vec::new();
        let mut place = Place { file: 0, line: 0 };
        for line in text.lines() {
            let mark = line.strip_prefix(comment);
            match (mark.and_then(|mark| mark.strip_prefix(BEGIN)), mark) {
                (Some(name), _) => {
                    place.line += 1;
                    stack.push(place);
                    let file = deck.names.len() as u32;
                    deck.names.push(name);
                    place = Place { file, line: 0 };
                }
                (None, Some(mark)) if mark == END && !stack.is_empty() => {
                    place = stack.pop().unwrap_or_default();
                }
                _ => {
                    place.line += 1;
                    deck.lines.push((place, line));
                }
            }
        }
        deck
    }

    /// A place in words.
    pub fn name(&self, place: Place) -> String {
        match self.names.get(place.file as usize) {
            Some(&name) if !name.is_empty() => format!("{name}, line {}", place.line),
            _ => format!("line {}", place.line),
        }
    }

    /// An error at a place.
    pub fn error(&self, place: Place, message: impl Into<String>) -> MeshFileError {
        MeshFileError { place: self.name(place), message: message.into() }
    }

    /// The place of the last line.
    pub fn end(&self) -> Place {
        self.lines.last().map_or(Place { file: 0, line: 1 }, |l| l.0)
    }
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
