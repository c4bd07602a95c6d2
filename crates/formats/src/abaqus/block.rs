//! Keyword lines of an input file, each with its data lines.

use crate::prelude::*;
use std::ops::Deref;

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

impl<'a> Block<'a> {
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
        let value = self.parameter(name).filter(|value| !value.is_empty());
        Ok(found!(value; self; "*{} needs {name}=", self.keyword))
    }

    /// Its data lines.
    pub fn lines(&self, scope: usize) -> impl Iterator<Item = Row<'a>> + use<'_, 'a> {
        let deck = self.deck;
        self.data.iter().map(move |&(place, line)| Row { deck, scope, place, line })
    }

    /// The numbers of the first data lines, at most so many; empty fields are 0.
    pub fn numbers(&self, lines: usize) -> Result<Vec<f64>> {
        let what = format!("a number of *{}", self.keyword);
        let entries = self.lines(0).take(lines).flat_map(Row::entries);
        entries.map(|(row, field)| row.number(field, &what)).collect()
    }
}

/// A block as a scope has it.
#[derive(Clone, Copy)]
pub(super) struct Scoped<'b, 'a> {
    pub scope: usize,
    pub block: &'b Block<'a>,
}

impl<'a> Deref for Scoped<'_, 'a> {
    type Target = Block<'a>;

    fn deref(&self) -> &Block<'a> {
        self.block
    }
}

impl<'b, 'a> Scoped<'b, 'a> {
    /// Its data lines.
    pub fn rows(self) -> impl Iterator<Item = Row<'a>> + use<'b, 'a> {
        self.block.lines(self.scope)
    }
}

/// A data line as a scope has it.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    pub deck: &'a Deck<'a>,
    pub scope: usize,
    pub place: Place,
    pub line: &'a str,
}

impl<'a> Row<'a> {
    /// An error there.
    pub fn error(self, message: impl Into<String>) -> MeshFileError {
        self.deck.error(self.place, message)
    }

    /// Its fields; a comma at the end begins none.
    pub fn fields(self) -> impl Iterator<Item = &'a str> {
        let line = self.line.trim_end();
        line.strip_suffix(',').unwrap_or(line).split(',').map(str::trim)
    }

    /// A field, empty where the line ends before it.
    pub fn field(self, number: usize) -> &'a str {
        self.fields().nth(number).unwrap_or_default()
    }

    /// Its fields, each with the line.
    pub fn entries(self) -> impl Iterator<Item = (Self, &'a str)> {
        self.fields().map(move |field| (self, field))
    }

    /// The fields from one on, if they are so many numbers.
    pub fn all_numbers<const N: usize>(self, first: usize) -> Option<[f64; N]> {
        let numbers: Option<Vec<f64>> = self.fields().skip(first).map(real).collect();
        numbers?.try_into().ok()
    }

    /// The number of a field, 0 of an empty one.
    pub fn number(self, field: &str, what: &str) -> Result<f64> {
        let number = if field.is_empty() { Some(0.0) } else { real(field) };
        Ok(found!(number; self; "{what} expected, found {}", quoted(field)))
    }

    /// The number of a node or an element in a field.
    pub fn label(self, field: &str, what: &str) -> Result<usize> {
        let label = field.trim().parse::<usize>().ok().filter(|&number| number > 0);
        Ok(found!(label; self; "{what} expected, found {}", quoted(field)))
    }
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
            let block = found!(blocks.last_mut(); deck, place;
                "a keyword such as *NODE expected, found {}", quoted(line));
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
