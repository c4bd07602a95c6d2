//! Values of a case as its TOML says them, each with its place.

use super::diagnostic::Location;
use std::collections::BTreeMap;

/// A TOML value with the place it was written at.
#[derive(Clone, Debug, PartialEq)]
pub struct RawItem {
    /// The value.
    pub value: RawValue,
    /// Where it was written.
    pub at: Location,
}

/// One `key = value` of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct RawEntry {
    /// Where the key was written.
    pub key_at: Location,
    /// Its value.
    pub item: RawItem,
}

/// A TOML table in the order of its keys.
pub type RawTable = BTreeMap<String, RawEntry>;

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
}

impl RawValue {
    /// How many values it holds, those that ranges stand for included.
    pub(super) fn length(&self) -> usize {
        match self {
            Self::Array(items) => items.iter().map(|item| item.value.length()).sum(),
            Self::Table(table) => {
                let count = match table.get("count").map(|entry| &entry.item.value) {
                    Some(Self::Integer(count)) => usize::try_from(*count).unwrap_or(0),
                    _ => 0,
                };
                let lengths = table.values().map(|entry| entry.item.value.length());
                lengths.fold(count, usize::saturating_add)
            }
            _ => 1,
        }
    }

    /// The value as messages quote it: no longer than a line.
    pub(super) fn shortened(&self) -> String {
        const LONGEST: usize = 60;
        // A long list is not written out to be cut off.
        let text = match self {
            Self::Array(items) if items.len() > LONGEST => {
                let first = items.iter().take(4).map(|item| item.value.shortened());
                let first: Vec<String> = first.collect();
                format!("[{}, ... ({} values)]", first.join(", "), items.len())
            }
            value => value.to_string(),
        };
        match text.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{}...", &text[..end]),
            None => text,
        }
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
                write!(f, "[")?;
                for (i, item) in items.iter().enumerate() {
                    write!(f, "{}{}", if i > 0 { ", " } else { "" }, item.value)?;
                }
                write!(f, "]")
            }
            Self::Table(table) => {
                write!(f, "{{ ")?;
                for (i, (key, entry)) in table.iter().enumerate() {
                    let separator = if i > 0 { ", " } else { "" };
                    write!(f, "{separator}{} = {}", quote(key), entry.item.value)?;
                }
                write!(f, " }}")
            }
        }
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
