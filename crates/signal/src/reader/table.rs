//! Lines of text to named columns of numbers.

use super::error::{EMPTY, ReadError, not_finite, unreadable};
use super::field::{Value, parse, time_stamp};
use super::separator::{Line, Separator, character, fields, numeric_fields, separator_of};
use super::text::{comment, decode, first_of, lines, shortened};

/// Largest magnitude of a measured number.
const LARGEST: f64 = 1e100;

/// Numbers of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Column {
    /// Values, or their real parts; seconds of time stamps since the first.
    pub real: Vec<f64>,
    /// Imaginary parts of a column of complex numbers.
    pub imaginary: Option<Vec<f64>>,
    /// Whether it holds time stamps.
    pub is_time: bool,
}

impl Column {
    /// Takes the next value; `first_day` is the day of the first time stamp of the table. Whether it is finite.
    fn push(&mut self, value: Value, first_day: &mut Option<i64>) -> bool {
        let (real, imaginary) = match value {
            Value::Real(value) => (value, 0.0),
            Value::Complex(re, im) => {
                // The rows before were real.
                let rows = self.real.len();
                self.imaginary.get_or_insert_with(|| vec![0.0; rows]);
                (re, im)
            }
            Value::Time(day, seconds) => {
                self.is_time = true;
                // A time of day alone has day 0.
                let days = if day == 0 { 0 } else { day - *first_day.get_or_insert(day) };
                (86_400.0 * days as f64 + seconds, 0.0)
            }
        };
        self.real.push(real);
        if let Some(parts) = &mut self.imaginary {
            parts.push(imaginary);
        }
        // Squares and sums of squares of samples must be finite, too.
        real.abs() <= LARGEST && imaginary.abs() <= LARGEST
    }
}

/// Numbers in named columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Table {
    /// Lower-case column names with their unit row joined; empty if the file has none.
    pub names: Vec<String>,
    /// Column names as written.
    pub titles: Vec<String>,
    /// Columns of equal length.
    pub columns: Vec<Column>,
    /// Everything written above the numbers and in comments, lower case.
    pub remarks: String,
    /// Line of each row, 1-based; empty for what was no text.
    lines: Vec<usize>,
    text: String,
    separator: Separator,
}

impl Table {
    /// A table that was no text.
    pub fn of_columns(titles: Vec<String>, columns: Vec<Column>, remarks: String) -> Self {
        Self {
            names: titles.iter().map(|t| t.to_lowercase()).collect(),
            titles,
            columns,
            remarks,
            ..Self::default()
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.real.len())
    }

    /// Line of a row, or its number where there are no lines.
    pub fn line(&self, row: usize) -> usize {
        self.lines.get(row).copied().unwrap_or(row + 1)
    }

    /// An error at a field.
    pub fn error(&self, row: usize, column: usize, problem: String) -> ReadError {
        let Some(line) = self.lines.get(row) else {
            return ReadError::whole(problem);
        };
        let text = lines(&self.text).nth(line - 1).map_or("", |(_, text)| text);
        let at = fields(text, self.separator).nth(column);
        ReadError::at(*line, at.map_or(1, |f| character(text, f)), problem)
    }

    /// That it lacks a column.
    pub fn missing(&self, wanted: &str, remedy: &str) -> ReadError {
        let columns = match self.titles.len() {
            0 => format!("{} without names", self.columns.len()),
            _ => first_of(&self.titles),
        };
        ReadError::missing(wanted, &columns, remedy)
    }
}

/// Reads bytes into a table; `given` are names that take the place of the file's own.
pub(super) fn read_table(bytes: &[u8], given: &[String]) -> Result<Table, ReadError> {
    let text = decode(bytes);
    // Comments and titles are remarks; what is left is a head of words and rows of numbers.
    let mut remarks = String::new();
    let mut content: Vec<Line> = Vec::new();
    let mut commented: Vec<Line> = Vec::new();
    for (number, line) in lines(&text).filter(|(_, line)| !line.trim().is_empty()) {
        match comment(line) {
            Some(words) => {
                remarks += &(words.to_lowercase() + "\n");
                commented.extend(content.is_empty().then_some((number, words)));
            }
            None => content.push((number, line)),
        }
    }
    if content.is_empty() {
        return Err(ReadError::whole(EMPTY));
    }
    let (data, separator, own) = if remarks.contains("post26") {
        let own = take_page_headers(&mut content)?;
        (&content[..], Separator::Blanks, own)
    } else {
        let first = first_data_line(&content).ok_or_else(|| blame_first_number(&content))?;
        let (head, data) = content.split_at(first);
        let separator = separator_of(data);
        if let Some(line) = head.last() {
            // A row of numbers with one that cannot be read is no header.
            let (numeric, all) = numeric_fields(line.1, separator);
            if numeric * 2 >= all && numeric > 0 {
                return Err(blame_first_number(&[*line]));
            }
        }
        for (_, line) in head {
            remarks += &(line.to_lowercase() + "\n");
        }
        let count = fields(data[0].1, separator).count();
        if given.is_empty() {
            refuse_decimal_comma_separators(data[0], separator, head, count)?;
        }
        // Names are those above the numbers, or those of a comment.
        let above = if head.is_empty() { &commented[..] } else { head };
        (data, separator, titles(above, separator, count))
    };
    let titles = given_or(own, given, fields(data[0].1, separator).count())?;
    let columns = numbers(data, separator, &titles)?;
    let lines = data.iter().map(|(line, _)| *line).collect();
    Ok(Table { lines, separator, text, ..Table::of_columns(titles, columns, remarks) })
}

/// The names of so many columns that are given, or else a file's own.
pub(super) fn given_or(
    own: Vec<String>,
    given: &[String],
    count: usize,
) -> Result<Vec<String>, ReadError> {
    match given.len() {
        0 => Ok(own),
        names if names == count => Ok(given.to_vec()),
        names => Err(ReadError::whole(format!(
            "--columns names {names} columns, the table has {count}; write `-` for one to skip"
        ))),
    }
}

/// Leaves the rows of numbers of a listing of the time-history post-processor of ANSYS: pages that repeat a header of
/// several lines, of which the words real, imaginary, amplitude and phase name the columns.
fn take_page_headers(content: &mut Vec<Line>) -> Result<Vec<String>, ReadError> {
    let is_data = |line: &Line| {
        let (numeric, all) = numeric_fields(line.1, Separator::Blanks);
        numeric == all && all > 1
    };
    let first = content.iter().position(is_data).ok_or_else(ReadError::no_numbers)?;
    let count = content[first].1.split_whitespace().count();
    let head = content[..first].iter().flat_map(|(_, line)| line.split_whitespace());
    let words: Vec<String> = head.map(str::to_lowercase).collect();
    content.retain(is_data);
    let is_time = words.iter().any(|w| w == "time");
    let is_part = |w: &str| matches!(w, "real" | "imaginary" | "amplitude" | "phase");
    let kinds: [&dyn Fn(&str) -> bool; 2] = [&is_part, &|w| w.contains('_')];
    let all = kinds.map(|is| words.iter().filter(|w| is(w)).cloned().collect::<Vec<_>>());
    let numbered = || (1..count).map(|k| format!("variable {}", k + 1)).collect();
    let named = all.into_iter().find(|names| names.len() + 1 == count).unwrap_or_else(numbered);
    Ok([vec![if is_time { "time" } else { "freq" }.to_string()], named].concat())
}

/// Index of the first line all of whose fields are numbers under some separator, time stamps not alone.
fn first_data_line(content: &[Line]) -> Option<usize> {
    const ALL: [Separator; 4] =
        [Separator::Semicolon, Separator::Tab, Separator::Comma, Separator::Blanks];
    content.iter().position(|(_, line)| {
        ALL.iter().any(|separator| {
            let mut values = fields(line, *separator).map(parse);
            let mut has_number = false;
            let is_data = values.all(|value| {
                has_number |= !matches!(value, Some(Value::Time(..)));
                value.is_some()
            });
            is_data && has_number
        })
    })
}

/// No line is all numbers: name the first field that spoils a line which has one.
fn blame_first_number(content: &[Line]) -> ReadError {
    for (line, text) in content {
        let separator = separator_of(&[(*line, *text)]);
        let (numeric, all) = numeric_fields(text, separator);
        let mut spoils = fields(text, separator).enumerate();
        let spoils = spoils.find(|(_, f)| parse(f).is_none());
        if let Some((k, field)) = spoils.filter(|_| numeric * 2 >= all && all > 1) {
            let problem = unreadable(field, &(k + 1).to_string());
            return ReadError::at(*line, character(text, field), problem);
        }
    }
    ReadError::no_numbers()
}

/// Parses every row.
fn numbers(
    data: &[Line],
    separator: Separator,
    titles: &[String],
) -> Result<Vec<Column>, ReadError> {
    let expected = fields(data[0].1, separator).count();
    let name = |k: usize| match titles.get(k) {
        Some(title) => format!("`{}`", shortened(title)),
        None => (k + 1).to_string(),
    };
    let column = |_| Column { real: Vec::with_capacity(data.len()), ..Column::default() };
    let mut columns: Vec<Column> = (0..expected).map(column).collect();
    let mut first_day = None;
    for (line, text) in data {
        let fail =
            |field: &str, problem| Err(ReadError::at(*line, character(text, field), problem));
        let mut found = 0;
        for (k, field) in fields(text, separator).enumerate() {
            found = k + 1;
            let Some(column) = columns.get_mut(k) else {
                // The surplus is to blame where it begins, however much there is.
                let found = fields(text, separator).count();
                return fail(field, field_count(found, expected));
            };
            let Some(value) = parse(field) else { return fail(field, unreadable(field, &name(k))) };
            if !column.push(value, &mut first_day) {
                return fail(field, not_finite(&shortened(field), &name(k)));
            }
        }
        if found != expected {
            let last = fields(text, separator).last().unwrap_or("");
            return fail(last, field_count(found, expected));
        }
    }
    join_time_stamps(&mut columns, data, separator);
    Ok(columns)
}

/// A row has another number of fields than the first.
fn field_count(found: usize, expected: usize) -> String {
    format!("{found} fields where the rows before have {expected}; complete or remove the row")
}

/// A date in one column and the time of day in the next are one time.
fn join_time_stamps(columns: &mut [Column], data: &[Line], separator: Separator) {
    let mut first = fields(data[0].1, separator).map(time_stamp);
    let is_date = matches!(first.next(), Some(Some((day, seconds))) if day != 0 && seconds == 0.0);
    let is_time_of_day = matches!(first.next(), Some(Some((0, _))));
    if is_date && is_time_of_day {
        let (dates, times) = columns.split_at_mut(1);
        for (date, time) in dates[0].real.iter_mut().zip(&times[0].real) {
            *date += time;
        }
    }
}

/// `f,re,im` above `10,0,1,5,2,5`: twice as many fields as names.
fn refuse_decimal_comma_separators(
    first: Line,
    separator: Separator,
    head: &[Line],
    found: usize,
) -> Result<(), ReadError> {
    let named = head.last().map_or(0, |(_, header)| fields(header, separator).count());
    if separator == Separator::Comma && named > 1 && found > named {
        let problem = format!(
            "{found} fields separated by commas where the header names {named}: the comma seems to be both separator \
             and decimal sign. Export with decimal points or separate by semicolons"
        );
        return Err(ReadError::at(first.0, 1, problem));
    }
    Ok(())
}

/// Names of the line above the numbers, joined with a row of units between; none where they are not as many.
fn titles(above: &[Line], separator: Separator, count: usize) -> Vec<String> {
    let split = |line: &str| -> Option<Vec<String>> {
        // A header may be separated otherwise than its numbers; commas never stand in a name.
        [separator, Separator::Comma, Separator::Blanks]
            .iter()
            .map(|s| fields(line, *s).map(str::to_string).collect::<Vec<_>>())
            .find(|fields| fields.len() == count)
    };
    let mut rows = above.iter().rev().take(2).map_while(|(_, line)| split(line));
    let (last, before) = (rows.next().unwrap_or_default(), rows.next());
    match before {
        Some(names) if last.iter().all(|field| super::units::is_unit(field)) => names
            .iter()
            .zip(&last)
            .map(|(name, unit)| format!("{name} {unit}").trim().to_string())
            .collect(),
        _ => last,
    }
}
