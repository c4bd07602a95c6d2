//! Values of a case as its TOML says them, each with its place.

use crate::*;
use frictionsim_bounds::shortened;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A TOML value with the place it was written at.
#[derive(Clone, Debug, PartialEq)]
pub struct RawItem {
    /// Where its key was written; of an item of a list, where it stands itself.
    pub key_at: Location,
    /// The value.
    pub value: RawValue,
    /// Where it was written.
    pub at: Location,
}

impl RawItem {
    /// A value all of whose parts stand at one place.
    pub(super) fn at(value: RawValue, at: &Location) -> Self {
        let value = match value {
            RawValue::Array(items) => {
                let items = items.into_iter().map(|item| Self::at(item.value, at));
                RawValue::Array(items.collect())
            }
            RawValue::Table(table) => {
                let entries = table.into_iter().map(|(key, own)| (key, Self::at(own.value, at)));
                RawValue::Table(entries.collect())
            }
            other => other,
        };
        Self { key_at: at.clone(), value, at: at.clone() }
    }

    /// The items of a list; anything else is a list of itself alone.
    pub(super) fn listed(&self) -> &[Self] {
        if let RawValue::Array(items) = &self.value { items } else { std::slice::from_ref(self) }
    }
}

/// A TOML table in the order of its keys.
pub type RawTable = BTreeMap<String, RawItem>;

/// The section of a name in a table.
pub(super) fn table_of<'t>(table: &'t RawTable, name: &str) -> Option<&'t RawTable> {
    table.get(name)?.value.table()
}

/// The values below a table that hold no further ones, with their dotted names, whose parts `name` writes.
pub(super) fn leaves(table: &RawTable, name: fn(&str) -> String) -> Vec<(String, &RawValue)> {
    let below = table.iter().flat_map(|(key, item)| match &item.value {
        RawValue::Table(inner) if !inner.is_empty() => {
            let own = leaves(inner, name).into_iter();
            own.map(|(path, value)| (format!("{}.{path}", name(key)), value)).collect()
        }
        value => vec![(name(key), value)],
    });
    below.collect()
}

/// A TOML value.
#[derive(Clone, Debug, PartialEq)]
pub enum RawValue {
    /// A string.
    String(String),
    /// An integer.
    Integer(i64),
    /// A floating-point number.
    Float(f64),
    /// True or false.
    Boolean(bool),
    /// A date or a time, which no key of a case takes.
    Datetime(String),
    /// A list.
    Array(Vec<RawItem>),
    /// A table.
    Table(RawTable),
}

impl RawValue {
    /// What a reader calls this kind of value.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::String(_) => "a string",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a number",
            Self::Boolean(_) => "a boolean",
            Self::Datetime(_) => "a date",
            Self::Array(_) => "a list",
            Self::Table(_) => "a table",
        }
    }

    /// A value alone, in TOML; none if it is not.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let parsed = DeValue::parse(text).ok()?;
        let mut errors = Vec::new();
        let value = convert(parsed.get_ref(), 0, 0..text.len(), &mut errors);
        errors.is_empty().then_some(value)
    }

    /// The table that it is.
    pub(super) fn table(&self) -> Option<&RawTable> {
        if let Self::Table(table) = self { Some(table) } else { None }
    }

    /// The same to be changed.
    pub(super) fn table_mut(&mut self) -> Option<&mut RawTable> {
        if let Self::Table(table) = self { Some(table) } else { None }
    }

    /// The text that it is.
    pub(super) fn text(&self) -> Option<&str> {
        if let Self::String(text) = self { Some(text) } else { None }
    }

    /// The number that it is, integers included.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(value) => Some(*value as f64),
            Self::Float(value) => Some(*value),
            _ => None,
        }
    }

    /// How many values it holds, those that ranges stand for included.
    pub(super) fn length(&self) -> usize {
        match self {
            Self::Array(items) => items.iter().map(|item| item.value.length()).sum(),
            Self::Table(table) => {
                let lengths = table.values().map(|entry| entry.value.length());
                lengths.fold(range_count(table), usize::saturating_add)
            }
            _ => 1,
        }
    }

    /// The value as messages quote it: no longer than a line.
    pub(super) fn shortened(&self) -> String {
        // A long list is not written out to be cut off.
        let text = match self {
            Self::Array(items) if items.len() > LONGEST => {
                let first = items.iter().take(4).map(|item| item.value.shortened());
                let first: Vec<String> = first.collect();
                format!("[{}, ... ({} values)]", first.join(", "), items.len())
            }
            value => value.to_string(),
        };
        cut(text)
    }
}

impl std::fmt::Display for RawValue {
    /// Canonical TOML: tables inline, integers and equal floats alike, keys in order.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::String(text) => write!(f, "{}", toml::Value::String(text.clone())),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Float(value) if value.fract() == 0.0 && value.abs() < 9e15 => {
                write!(f, "{}", *value as i64)
            }
            Self::Float(value) if value.is_nan() => write!(f, "nan"),
            Self::Float(value) => write!(f, "{value:?}"),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Datetime(value) => write!(f, "{value}"),
            Self::Array(items) => {
                let items: Vec<String> = items.iter().map(|item| item.value.to_string()).collect();
                write!(f, "[{}]", items.join(", "))
            }
            Self::Table(table) => {
                let entries = table.iter();
                let entries = entries.map(|(key, own)| format!("{} = {}", quote(key), own.value));
                write!(f, "{{ {} }}", entries.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

/// Longest text that messages and titles quote, characters.
const LONGEST: usize = 60;

/// A text no longer than messages and titles quote it.
pub(super) fn cut(text: String) -> String {
    shortened(&text, LONGEST)
}

/// The number that a text with a decimal comma means, with a point.
pub(super) fn with_point(text: &str) -> Option<String> {
    let number = text.replace(',', ".");
    let is_number = text.matches(',').count() == 1 && number.parse::<f64>().is_ok();
    is_number.then_some(number)
}

/// How many values a table stands for as a range.
pub(super) fn range_count(table: &RawTable) -> usize {
    match table.get("count").map(|entry| &entry.value) {
        Some(RawValue::Integer(count)) => usize::try_from(*count).unwrap_or(0),
        _ => 0,
    }
}

/// A key as TOML needs it written: bare where it can be.
pub(super) fn quote(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        key.to_owned()
    } else {
        toml::Value::String(key.to_owned()).to_string()
    }
}

/// Takes over a table of text `source`.
pub(super) fn convert_table(
    table: &DeTable<'_>,
    source: usize,
    errors: &mut Vec<Diagnostic>,
) -> RawTable {
    let entries = table.iter().map(|(key, value)| {
        let key_at = Location::new(source, key.span());
        (key.get_ref().to_string(), RawItem { key_at, ..item(value, source, errors) })
    });
    entries.collect()
}

/// Takes over one value with its place.
fn item(value: &Spanned<DeValue<'_>>, source: usize, errors: &mut Vec<Diagnostic>) -> RawItem {
    let (at, value) = (Location::new(source, value.span()), value.get_ref());
    RawItem { key_at: at.clone(), value: convert(value, source, at.span.clone(), errors), at }
}

/// Takes over one value, whose place is `span` of text `source`.
pub(super) fn convert(
    value: &DeValue<'_>,
    source: usize,
    span: std::ops::Range<usize>,
    errors: &mut Vec<Diagnostic>,
) -> RawValue {
    match value {
        DeValue::String(text) => RawValue::String(text.to_string()),
        DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(value) => RawValue::Integer(value),
            Err(_) => {
                errors.push(placed!(Location::new(source, span),
                    "the integer {integer} does not fit 64 bits"; "out of range";
                    "write it with a decimal point if it is meant as a number"));
                RawValue::Integer(0)
            }
        },
        // A float that TOML accepts and Rust does not cannot exist; NaN is refused where it is used.
        DeValue::Float(float) => RawValue::Float(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(value) => RawValue::Boolean(*value),
        DeValue::Datetime(value) => RawValue::Datetime(value.to_string()),
        DeValue::Array(items) => {
            RawValue::Array(items.iter().map(|own| item(own, source, errors)).collect())
        }
        DeValue::Table(table) => RawValue::Table(convert_table(table, source, errors)),
    }
}
