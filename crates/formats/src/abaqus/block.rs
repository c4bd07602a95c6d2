//! Keyword lines of an input file, each with its data lines.

use crate::deck::{Deck, Place, quoted, real};
use crate::file_mesh::{MeshFileError, Result};

/// A keyword with its parameters and its data.
pub(super) struct Block<'a> {
    pub deck: &'a Deck<'a>,
    /// In capitals, single blanks between words.
    pub keyword: String,
    /// Names in capitals; values as written, without quotes, empty where there is none.
    pub parameters: Vec<(String, String)>,
    pub data: Vec<(Place, &'a str)>,
    pub place: Place,
}

impl Block<'_> {
    /// The value of a parameter.
    pub fn parameter(&self, name: &str) -> Option<&str> {
        self.parameters.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// Whether a parameter is given.
    pub fn has(&self, name: &str) -> bool {
        self.parameter(name).is_some()
    }

    /// Whether a parameter has a value, in any case of letters.
    pub fn is(&self, name: &str, value: &str) -> bool {
        self.parameter(name).is_some_and(|known| known.eq_ignore_ascii_case(value))
    }

    /// An error at its keyword.
    pub fn error(&self, message: impl Into<String>) -> MeshFileError {
        self.deck.error(self.place, message)
    }

    /// The value of a parameter that must be there.
    pub fn required(&self, name: &str) -> Result<&str> {
        let found = self.parameter(name).filter(|value| !value.is_empty());
        found.ok_or_else(|| fault!(self; "*{} needs {name}=", self.keyword))
    }

    /// The numbers of the first data lines, at most so many; empty fields are 0.
    pub fn numbers(&self, lines: usize) -> Result<Vec<f64>> {
        let lines = self.data.iter().take(lines);
        let all = lines.flat_map(|&(place, line)| fields(line).map(move |field| (place, field)));
        let numbers = all.map(|(place, field)| match field {
            "" => Ok(0.0),
            field => real(field).ok_or_else(|| {
                let found = quoted(field);
                fault!(self.deck, place; "a number of *{} expected, found {found}", self.keyword)
            }),
        });
        numbers.collect()
    }
}

/// Fields of a data line; a comma at its end begins none.
pub(super) fn fields(line: &str) -> impl Iterator<Item = &str> {
    let line = line.trim_end();
    line.strip_suffix(',').unwrap_or(line).split(',').map(str::trim)
}

/// Splits a keyword line at commas outside quotes.
fn parts(line: &str) -> Vec<&str> {
    let mut is_quoted = false;
    let is_border = |c: char| {
        is_quoted ^= c == '"';
        c == ',' && !is_quoted
    };
    line.split(is_border).map(str::trim).collect()
}

/// All keywords of an input file.
pub(super) fn blocks<'a>(deck: &'a Deck<'a>) -> Result<Vec<Block<'a>>> {
    let mut blocks: Vec<Block<'a>> = Vec::new();
    let is_comment = |line: &str| line.starts_with("**");
    let lines = deck.lines.iter();
    let mut lines = lines.filter(|(_, line)| !is_comment(line) && !line.trim().is_empty());
    while let Some(&(place, line)) = lines.next() {
        let Some(head) = line.trim().strip_prefix('*') else {
            let Some(block) = blocks.last_mut() else {
                let found = quoted(line);
                refuse!(deck, place; "a keyword such as *NODE expected, found {found}");
            };
            block.data.push((place, line));
            continue;
        };
        // A comma at the end of a keyword line says that it goes on.
        let mut head = head.to_owned();
        while head.ends_with(',') {
            let Some((_, more)) = lines.next() else { break };
            head.push_str(more.trim());
        }
        let mut words = parts(&head).into_iter();
        let keyword: Vec<&str> = words.next().unwrap_or_default().split_whitespace().collect();
        let parameters = words.filter(|word| !word.is_empty()).map(|word| {
            let (name, value) = word.split_once('=').unwrap_or((word, ""));
            (name.trim().to_uppercase(), value.trim().trim_matches('"').to_owned())
        });
        blocks.push(Block {
            deck,
            keyword: keyword.join(" ").to_uppercase(),
            parameters: parameters.collect(),
            data: Vec::new(),
            place,
        });
    }
    Ok(blocks)
}
