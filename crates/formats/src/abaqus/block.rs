//! Keyword lines of an input file, each with its data lines.

use crate::deck::{Deck, Place, quoted, real};
use crate::file_mesh::MeshFileError;

/// A keyword with its parameters and its data.
#[derive(Debug)]
pub(super) struct Block<'a> {
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
        let found = self.parameters.iter().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Whether a parameter is given.
    pub fn has(&self, name: &str) -> bool {
        self.parameter(name).is_some()
    }

    /// Whether a parameter has a value, in any case of letters.
    pub fn is(&self, name: &str, value: &str) -> bool {
        self.parameter(name).is_some_and(|known| known.eq_ignore_ascii_case(value))
    }

    /// The value of a parameter that must be there.
    pub fn required(&self, deck: &Deck<'_>, name: &str) -> Result<&str, MeshFileError> {
        let found = self.parameter(name).filter(|value| !value.is_empty());
        found.ok_or_else(|| {
            let keyword = &self.keyword;
            deck.error(self.place, format!("*{keyword} needs {name}="))
        })
    }

    /// The numbers of all data lines; empty fields are 0.
    pub fn numbers(&self, deck: &Deck<'_>) -> Result<Vec<f64>, MeshFileError> {
        let mut numbers = Vec::new();
        for &(place, line) in &self.data {
            numbers.extend(line_numbers(deck, place, line, &self.keyword)?);
        }
        Ok(numbers)
    }

    /// The numbers of the first data line.
    pub fn first_numbers(&self, deck: &Deck<'_>) -> Result<Vec<f64>, MeshFileError> {
        match self.data.first() {
            Some(&(place, line)) => line_numbers(deck, place, line, &self.keyword),
            None => Ok(Vec::new()),
        }
    }
}

fn line_numbers(
    deck: &Deck<'_>,
    place: Place,
    line: &str,
    keyword: &str,
) -> Result<Vec<f64>, MeshFileError> {
    let parsed = fields(line).map(|field| match field {
        "" => Ok(0.0),
        field => real(field).ok_or_else(|| {
            fault!(deck, place;
            "a number of *{keyword} expected, found {}", quoted(field))
        }),
    });
    parsed.collect()
}

/// Fields of a data line; a comma at its end begins none.
pub(super) fn fields(line: &str) -> impl Iterator<Item = &str> {
    let line = line.trim_end();
    let line = line.strip_suffix(',').unwrap_or(line);
    line.split(',').map(str::trim)
}

/// A name without its quotes.
fn unquoted(text: &str) -> &str {
    text.trim().trim_matches('"')
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
pub(super) fn blocks<'a>(deck: &Deck<'a>) -> Result<Vec<Block<'a>>, MeshFileError> {
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
        let keyword = words.next().unwrap_or_default();
        let keyword: Vec<&str> = keyword.split_whitespace().collect();
        let parameters = words.filter(|word| !word.is_empty()).map(|word| {
            let (name, value) = word.split_once('=').unwrap_or((word, ""));
            (name.trim().to_uppercase(), unquoted(value).to_owned())
        });
        blocks.push(Block {
            keyword: keyword.join(" ").to_uppercase(),
            parameters: parameters.collect(),
            data: Vec::new(),
            place,
        });
    }
    Ok(blocks)
}
