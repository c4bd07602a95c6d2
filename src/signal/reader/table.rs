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
        if numeric * 2 >= fields.len() && fields.len() > 1 {
            if let Some((at, field)) = fields.iter().find(|(_, f)| parse(f).is_none()) {
                let problem = unreadable(field, "of numbers".to_string());
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
