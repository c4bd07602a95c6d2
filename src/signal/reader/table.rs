//! Lines of text to named columns of numbers.

use super::error::{ReadError, ReadProblem};
use super::text::{comment, decode, lines, shortened};

/// How fields are separated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    Semicolon,
    Tab,
    Comma,
    Blanks,
}

/// Numbers in named columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Table {
    /// Lower-case column names with their unit row joined; empty if the file has none.
    pub names: Vec<String>,
    /// Column names as written.
    pub titles: Vec<String>,
    /// Columns of equal length.
    pub columns: Vec<Vec<f64>>,
    /// Line of each row, 1-based.
    pub lines: Vec<usize>,
    /// Character at which each field of each row begins, 1-based, row by row.
    starts: Vec<usize>,
    /// Everything written above the numbers and in comments, lower case.
    pub remarks: String,
}

impl Table {
    /// Character at which a field begins.
    pub fn start(&self, row: usize, column: usize) -> usize {
        self.starts[row * self.columns.len() + column]
    }

    /// The column names for a message.
    pub fn described(&self) -> String {
        if self.titles.is_empty() {
            return format!("{} without names", self.columns.len());
        }
        self.titles
            .iter()
            .map(|t| shortened(t))
            .collect::<Vec<_>>()
            .join(", ")
    }
}

/// A line of data: its number, its text.
type Line<'a> = (usize, &'a str);

/// Reads bytes into a table.
pub(super) fn read_table(bytes: &[u8], source: &str) -> Result<Table, ReadError> {
    let text = decode(bytes);
    let mut remarks = String::new();
    let mut content: Vec<Line> = Vec::new();
    let mut commented_header = None;
    for (number, line) in lines(&text) {
        if line.trim().is_empty() {
            continue;
        }
        match comment(line) {
            Some(words) => {
                remarks.push_str(&words.to_lowercase());
                remarks.push('\n');
                if content.is_empty() {
                    commented_header = Some((number, words));
                }
            }
            None => content.push((number, line)),
        }
    }
    if content.is_empty() {
        return Err(ReadError::whole(source, ReadProblem::Empty));
    }
    let first = first_data_line(&content).ok_or_else(|| {
        // One line of words is a header without data; more is no table at all.
        blame_first_number(&content, source)
    })?;
    let (head, data) = content.split_at(first);
    if let Some(line) = head.last() {
        // A row of numbers with one that cannot be read is no header.
        let fields = split(line.1, separator_of(data));
        let numeric = fields.iter().filter(|(_, f)| parse(f).is_some()).count();
        if numeric * 2 >= fields.len() && numeric > 0 {
            return Err(blame_first_number(&[*line], source));
        }
    }
    for (_, line) in head {
        remarks.push_str(&line.to_lowercase());
        remarks.push('\n');
    }
    let separator = separator_of(data);
    let mut table = numbers(data, separator, head, source)?;
    let mut above: Vec<Line> = head.to_vec();
    if above.is_empty() {
        above.extend(commented_header);
    }
    name_columns(&mut table, &above, separator);
    table.remarks = remarks;
    Ok(table)
}

/// Index of the first line all of whose fields are numbers, under some separator.
fn first_data_line(content: &[Line]) -> Option<usize> {
    const ALL: [Separator; 4] = [
        Separator::Semicolon,
        Separator::Tab,
        Separator::Comma,
        Separator::Blanks,
    ];
    content.iter().position(|(_, line)| {
        ALL.iter().any(|separator| {
            let fields = split(line, *separator);
            !fields.is_empty() && fields.iter().all(|(_, f)| parse(f).is_some())
        })
    })
}

/// No line is all numbers: name the first field that spoils a line which has one.
fn blame_first_number(content: &[Line], source: &str) -> ReadError {
    for (number, line) in content {
        let fields = split(line, separator_of(&[(*number, *line)]));
        let numeric = fields.iter().filter(|(_, f)| parse(f).is_some()).count();
        if numeric * 2 >= fields.len()
            && fields.len() > 1
            && let Some((at, field)) = fields.iter().find(|(_, f)| parse(f).is_none())
        {
            let problem = unreadable(field, "of numbers".to_string());
            return ReadError::at(source, *number, *at, problem);
        }
    }
    ReadError::whole(source, ReadProblem::NoNumbers)
}

/// Why a field is no number.
fn unreadable(field: &str, name: String) -> ReadProblem {
    let field = shortened(field);
    if field.contains(',') && field.contains('.') {
        ReadProblem::MixedDecimals { field }
    } else {
        ReadProblem::NotANumber { field, name }
    }
}

/// The separator of the rows of numbers.
fn separator_of(data: &[Line]) -> Separator {
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

/// Fields with the 1-based character at which each begins; a separator at the end adds none.
fn split(line: &str, separator: Separator) -> Vec<(usize, String)> {
    let is_separator = |c: char| match separator {
        Separator::Semicolon => c == ';',
        Separator::Tab => c == '\t',
        Separator::Comma => c == ',',
        Separator::Blanks => c.is_whitespace(),
    };
    let mut fields: Vec<(usize, String)> = Vec::new();
    let (mut field, mut start, mut quoted) = (String::new(), 1, false);
    for (i, c) in line.chars().enumerate() {
        if c == '"' {
            quoted = !quoted;
        } else if !quoted && is_separator(c) {
            fields.push((start, std::mem::take(&mut field)));
            start = i + 2;
        } else {
            field.push(c);
        }
    }
    fields.push((start, field));
    for (start, field) in &mut fields {
        *start += field.chars().take_while(|c| c.is_whitespace()).count();
        *field = field.trim().to_string();
    }
    if separator == Separator::Blanks {
        fields.retain(|(_, f)| !f.is_empty());
    }
    while fields.len() > 1 && fields.last().is_some_and(|(_, f)| f.is_empty()) {
        fields.pop();
    }
    fields
}

/// A number, with a decimal point or a decimal comma; NaN and infinity included.
fn parse(field: &str) -> Option<f64> {
    let plain = field.replace(['\u{2212}', '\u{2013}'], "-");
    let lower = plain.to_ascii_lowercase();
    if matches!(
        lower.as_str(),
        "1.#ind" | "-1.#ind" | "1.#qnan" | "#n/a" | "na" | "n/a"
    ) {
        return Some(f64::NAN);
    }
    // Fortran writes exponents with d.
    let is_number = lower.chars().any(|c| c.is_ascii_digit());
    let mut text = if is_number {
        lower.replace('d', "e")
    } else {
        lower
    };
    if text.matches(',').count() == 1 && !text.contains('.') {
        text = text.replace(',', ".");
    }
    text.parse().ok()
}

/// Parses every row.
fn numbers(
    data: &[Line],
    separator: Separator,
    head: &[Line],
    source: &str,
) -> Result<Table, ReadError> {
    let expected = split(data[0].1, separator).len();
    refuse_decimal_comma_separators(data[0], separator, head, expected, source)?;
    let names = head
        .last()
        .map(|(_, line)| split(line, separator))
        .filter(|names| names.len() == expected);
    let name = |k: usize| match &names {
        Some(names) => format!("`{}`", shortened(&names[k].1)),
        None => (k + 1).to_string(),
    };
    let mut table = Table {
        columns: vec![Vec::with_capacity(data.len()); expected],
        ..Table::default()
    };
    for (line, text) in data {
        let fields = split(text, separator);
        let spoiled = fields
            .iter()
            .enumerate()
            .find(|(_, (_, f))| parse(f).is_none());
        if let Some((k, (at, field))) = spoiled.filter(|(k, _)| *k < expected) {
            let problem = unreadable(field, name(k));
            return Err(ReadError::at(source, *line, *at, problem));
        }
        if fields.len() != expected {
            let surplus = fields.get(expected).or(fields.last());
            let at = surplus.map_or(1, |(at, _)| *at);
            let problem = ReadProblem::FieldCount {
                found: fields.len(),
                expected,
            };
            return Err(ReadError::at(source, *line, at, problem));
        }
        for (k, (at, field)) in fields.iter().enumerate() {
            let value = parse(field).unwrap_or(f64::NAN);
            if !value.is_finite() {
                let problem = ReadProblem::NotFinite {
                    field: shortened(field),
                    name: name(k),
                };
                return Err(ReadError::at(source, *line, *at, problem));
            }
            table.columns[k].push(value);
            table.starts.push(*at);
        }
        table.lines.push(*line);
    }
    Ok(table)
}

/// `f,re,im` above `10,0,1,5,2,5`: twice as many fields as names.
fn refuse_decimal_comma_separators(
    first: Line,
    separator: Separator,
    head: &[Line],
    found: usize,
    source: &str,
) -> Result<(), ReadError> {
    let Some((_, header)) = head.last() else {
        return Ok(());
    };
    let named = split(header, separator).len();
    if separator == Separator::Comma && named > 1 && found > named {
        let problem = ReadProblem::AmbiguousComma {
            found,
            expected: named,
        };
        return Err(ReadError::at(source, first.0, 1, problem));
    }
    Ok(())
}

/// Names from the line above the numbers, or the one above that if it holds only units.
fn name_columns(table: &mut Table, above: &[Line], separator: Separator) {
    let count = table.columns.len();
    let fields = |line: &str| -> Option<Vec<String>> {
        // A header may be separated otherwise than its numbers; commas never stand in a name.
        [separator, Separator::Comma, Separator::Blanks]
            .iter()
            .map(|s| split(line, *s))
            .find(|fields| fields.len() == count)
            .map(|fields| fields.into_iter().map(|(_, f)| f).collect())
    };
    let rows: Vec<Vec<String>> = above
        .iter()
        .rev()
        .take(2)
        .map_while(|(_, line)| fields(line))
        .collect();
    let Some(last) = rows.first() else {
        return;
    };
    let mut titles = last.clone();
    let are_units = last.iter().all(|f| super::units::is_unit(f));
    if let (true, Some(names)) = (are_units, rows.get(1)) {
        titles = names
            .iter()
            .zip(last)
            .map(|(name, unit)| format!("{name} {unit}").trim().to_string())
            .collect();
    }
    table.names = titles.iter().map(|t| t.to_lowercase()).collect();
    table.titles = titles;
}
