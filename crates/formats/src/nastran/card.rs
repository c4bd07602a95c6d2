//! Cards of bulk data in small, large and free fields, and the case control before them.

use crate::prelude::*;
/// One card: its name in capitals and its fields behind it, eight for each of its lines.
pub(super) struct Card<'a> {
    deck: &'a Deck<'a>,
    pub name: String,
    pub fields: Vec<&'a str>,
    pub place: Place,
}

/// What is read of a field that may be empty.
type Field<T> = Result<Option<T>>;

/// What stands before and around the bulk data.
#[derive(Debug, Default)]
pub(super) struct Control {
    pub title: Option<String>,
    /// Sets of constraints and of loads that subcases name.
    pub spc: Vec<usize>,
    pub load: Vec<usize>,
    /// Names that preprocessors keep in comments, by number of the property.
    pub property_names: BTreeMap<usize, String>,
}

impl<'a> Card<'a> {
    /// A field, empty where the card ends before it; the one behind the name is number 0.
    pub fn field(&self, number: usize) -> &'a str {
        self.fields.get(number).copied().unwrap_or_default()
    }

    /// An error at the card.
    pub fn error(&self, message: impl Into<String>) -> MeshFileError {
        self.deck.error(self.place, message)
    }

    /// What a field is; none where it is empty.
    fn optional<T>(&self, number: usize, what: &str, parsed: fn(&str) -> Option<T>) -> Field<T> {
        let field = self.field(number);
        let value = parsed(field);
        ensure!(value.is_some() || field.is_empty(); self;
            "{}: {what} expected in field {}, found {}", self.name, number + 2, quoted(field));
        Ok(value)
    }

    /// A whole number; none where the field is empty.
    pub fn optional_int(&self, number: usize) -> Field<i64> {
        self.optional(number, "a whole number", |field| field.parse().ok())
    }

    /// The number of something, above 0.
    pub fn number(&self, field: usize) -> Result<usize> {
        let value = self.optional_int(field)?.and_then(|value| usize::try_from(value).ok());
        let value = value.filter(|&value| value > 0);
        Ok(found!(value; self; "{}: a number above 0 expected in field {}", self.name, field + 2))
    }

    /// The number of a coordinate system, 0 where the field is empty.
    pub fn optional_system(&self, number: usize) -> Field<usize> {
        Ok(self.optional_int(number)?.map(|system| usize::try_from(system).unwrap_or(0)))
    }

    /// A real number; none where the field is empty.
    pub fn optional_real(&self, number: usize) -> Field<f64> {
        self.optional(number, "a number", short_real)
    }

    /// A real number, 0 where the field is empty.
    pub fn real(&self, number: usize) -> Result<f64> {
        Ok(self.optional_real(number)?.unwrap_or(0.0))
    }

    /// Three coordinates, from a field on.
    pub fn point(&self, first: usize) -> Result<[f64; 3]> {
        Ok([self.real(first)?, self.real(first + 1)?, self.real(first + 2)?])
    }
}

/// A number whose exponent may lack its letter, `1.5-3`.
fn short_real(field: &str) -> Option<f64> {
    if let Some(value) = real(field) {
        return Some(value);
    }
    let sign = field.rfind(['+', '-']).filter(|&at| at > 0)?;
    let (digits, exponent) = field.split_at(sign);
    digits.ends_with(|c: char| c.is_ascii_digit() || c == '.').then_some(())?;
    real(&format!("{digits}e{exponent}"))
}

/// The first field of a line, which is a card or the continuation of one, and its others: eight, or four large ones.
fn fields_of(line: &str) -> (&str, Vec<&str>) {
    let is_large = |head: &str| head.ends_with('*') || head.starts_with('*');
    if line.contains(',') {
        let mut fields = line.split(',').map(str::trim);
        let head = fields.next().unwrap_or_default();
        let count = if is_large(head) { 4 } else { 8 };
        return (head, fields.chain(std::iter::repeat("")).take(count).collect());
    }
    let column = |from: usize, to: usize| {
        let to = to.min(line.len());
        line.get(from.min(to)..to).unwrap_or_default().trim()
    };
    let head = column(0, 8);
    let width = if is_large(head) { 16 } else { 8 };
    (head, (8..72).step_by(width).map(|from| column(from, from + width)).collect())
}

/// Text with blanks in place of its tabs, each up to the next field of eight characters.
pub(super) fn without_tabs(text: &str) -> String {
    let mut column = 0;
    let wide = |c: char| {
        let (c, width) = if c == '\t' { (' ', 8 - column % 8) } else { (c, 1) };
        column = if c == '\n' { 0 } else { column + width };
        std::iter::repeat_n(c, width)
    };
    text.chars().flat_map(wide).collect()
}

/// The cards of a file and its case control.
pub(super) fn cards<'a>(deck: &'a Deck<'a>) -> Result<(Vec<Card<'a>>, Control)> {
    let is_bulk = |line: &str| {
        let start = line.trim_start().get(..10);
        start.is_some_and(|start| start.eq_ignore_ascii_case("BEGIN BULK"))
    };
    let begin = deck.lines.iter().position(|(_, line)| is_bulk(line));
    let mut control = Control::default();
    let (before, bulk) = deck.lines.split_at(begin.map_or(0, |begin| begin + 1));
    before.iter().for_each(|(_, line)| control.line(line));
    let mut cards: Vec<Card<'a>> = Vec::new();
    for &(place, line) in bulk {
        if let Some(comment) = line.strip_prefix('$') {
            control.comment(comment);
            continue;
        }
        let line = line.split('$').next().unwrap_or_default().trim_end();
        if line.is_empty() {
            continue;
        }
        let (head, fields) = fields_of(line);
        if head.eq_ignore_ascii_case("ENDDATA") {
            break;
        }
        if head.is_empty() || head.starts_with(['+', '*']) {
            found!(cards.last_mut(); deck, place; "this line continues no card")
                .fields
                .extend(fields);
            continue;
        }
        let name = head.trim_end_matches('*').to_uppercase();
        ensure!(name.starts_with(|c: char| c.is_ascii_alphabetic()); deck, place;
            "the name of a card expected, found {}", quoted(head));
        cards.push(Card { deck, name, fields, place });
    }
    Ok((cards, control))
}

impl Control {
    /// A line of the case control.
    fn line(&mut self, line: &str) {
        let Some((name, value)) = line.split_once('=') else { return };
        let value = value.trim();
        let number = value.parse::<usize>().ok();
        match name.trim().to_uppercase().as_str() {
            "TITLE" => self.title = Some(value.to_owned()),
            "SPC" => self.spc.extend(number),
            "LOAD" => self.load.extend(number),
            _ => {}
        }
    }

    /// Names of properties that HyperMesh and ANSA keep in comments.
    fn comment(&mut self, comment: &str) {
        let named = if let Some(rest) = comment.strip_prefix("HMNAME PROP") {
            let mut parts = rest.splitn(3, '"');
            parts.next().zip(parts.next())
        } else {
            let rest = comment.strip_prefix("ANSA_NAME_COMMENT;").unwrap_or_default();
            let mut parts = rest.split(';');
            match (parts.next(), parts.next(), parts.next()) {
                (Some(number), Some("PSOLID" | "PSHELL"), Some(name)) => Some((number, name)),
                _ => None,
            }
        };
        let Some((number, name)) = named else { return };
        if let (Ok(number), false) = (number.trim().parse(), name.trim().is_empty()) {
            self.property_names.insert(number, name.trim().to_owned());
        }
    }
}
