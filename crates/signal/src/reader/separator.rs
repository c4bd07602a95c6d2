//! Lines to fields.

use super::field::parse;

/// How fields are separated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Separator {
    Semicolon,
    Tab,
    Comma,
    #[default]
    Blanks,
}

/// A line of data: its number, its text.
pub(super) type Line<'a> = (usize, &'a str);

/// The separator of the rows of numbers.
pub(super) fn separator_of(data: &[Line]) -> Separator {
    let sample = || data.iter().take(50).map(|(_, line)| *line);
    if sample().any(|l| l.contains(';')) {
        Separator::Semicolon
    } else if sample().any(|l| l.trim().contains('\t')) {
        Separator::Tab
    } else if sample().all(|l| l.split_whitespace().all(|f| parse(f).is_some()))
        && sample().any(|l| l.split_whitespace().count() > 1)
    {
        // `1,5 2,5`: every word is a number by itself, which `1.5, 2.5` is not.
        Separator::Blanks
    } else if sample().any(|l| l.contains(',')) {
        Separator::Comma
    } else {
        Separator::Blanks
    }
}

/// Fields of a line, without blanks and quotes around them; a separator at the end adds none.
pub(super) fn fields(line: &str, separator: Separator) -> impl Iterator<Item = &str> {
    let is_separator = move |c: char| match separator {
        Separator::Semicolon => c == ';',
        Separator::Tab => c == '\t',
        Separator::Comma => c == ',',
        Separator::Blanks => c.is_whitespace(),
    };
    let mut quoted = false;
    let whole = line.trim_end_matches(|c: char| c.is_whitespace() || is_separator(c));
    // A line of separators alone keeps its one empty field.
    let whole = if whole.is_empty() { &line[..0] } else { whole };
    whole
        .split(move |c: char| {
            quoted ^= c == '"';
            !quoted && is_separator(c)
        })
        .map(|field| field.trim().trim_matches('"').trim())
        .filter(move |field| separator != Separator::Blanks || !field.is_empty())
}

/// 1-based character at which a field begins that is part of a line.
pub(super) fn character(line: &str, field: &str) -> usize {
    let start = (field.as_ptr() as usize).saturating_sub(line.as_ptr() as usize);
    1 + line.get(..start).map_or(0, |before| before.chars().count())
}

/// Fields that are numbers, and all of them.
pub(super) fn numeric_fields(line: &str, separator: Separator) -> (usize, usize) {
    let values = fields(line, separator).map(|f| parse(f).is_some());
    values.fold((0, 0), |(numeric, all), is| (numeric + usize::from(is), all + 1))
}
