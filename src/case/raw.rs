//! The case exactly as its TOML says it: a tree of values that know where they were written.

use super::diagnostic::{CaseErrors, Diagnostic, Location, Source};
use super::overrides;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use toml::de::{DeTable, DeValue};

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
fn quote(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(bare) {
        key.to_owned()
    } else {
        toml::Value::String(key.to_owned()).to_string()
    }
}

/// A parsed, not yet validated case: the file's TOML with the overrides laid over it.
#[derive(Clone, Debug, PartialEq)]
pub struct RawCase {
    /// Name of the case file as the user gave it.
    pub name: String,
    /// Text of the case file.
    pub text: String,
    /// Overrides `KEY=VALUE` in the order given.
    pub overrides: Vec<String>,
    /// The effective tree.
    pub root: RawTable,
}

impl RawCase {
    /// Parses the bytes of a case file and lays the overrides over it.
    ///
    /// An override is one TOML assignment to a dotted key, `contact.friction_coefficient=0.4`; a
    /// value that is not TOML is taken as a string, so that `mesh.element=quad8` needs no quotes.
    /// Nothing is validated here but the syntax.
    ///
    /// # Errors
    /// [`CaseErrors`] with every syntax error of the file and of the overrides.
    pub fn parse(name: &str, bytes: &[u8], overrides: &[String]) -> Result<Self, CaseErrors> {
        let text = String::from_utf8_lossy(bytes).into_owned();
        let mut case = Self {
            name: name.to_owned(),
            text,
            overrides: overrides.to_vec(),
            root: RawTable::new(),
        };
        let mut diagnostics = Vec::new();
        if let Err(error) = std::str::from_utf8(bytes) {
            let start = error.valid_up_to();
            diagnostics.push(Diagnostic::error(
                "the case file is not UTF-8 text".to_owned(),
                "the first byte that is not".to_owned(),
                Location::new(0, start..start + 1),
                Some("save the file as UTF-8".to_owned()),
            ));
        } else {
            case.root = parse_document(&case.text, 0, &mut diagnostics);
        }
        for (index, text) in overrides.iter().enumerate() {
            if let Some((path, item)) = overrides::parse(text, index + 1, &mut diagnostics) {
                overrides::insert(&mut case.root, &path, item);
            }
        }
        if diagnostics.is_empty() {
            Ok(case)
        } else {
            Err(case.errors(diagnostics))
        }
    }

    /// This case with further overrides, as a sweep makes its points.
    ///
    /// # Errors
    /// As [`RawCase::parse`].
    pub fn with_overrides(&self, further: &[String]) -> Result<Self, CaseErrors> {
        let overrides = [self.overrides.as_slice(), further].concat();
        Self::parse(&self.name, self.text.as_bytes(), &overrides)
    }

    /// The point of a parameter study that `overrides` make: a case of its own without `[sweep]`, so
    /// that its hash stays the same when the study gains other points.
    ///
    /// # Errors
    /// As [`RawCase::parse`].
    pub fn sweep_point(&self, overrides: &[String]) -> Result<Self, CaseErrors> {
        let mut point = self.with_overrides(overrides)?;
        point.root.remove("sweep");
        Ok(point)
    }

    /// The effective case as canonical TOML, one `section.key = value` line for each key: comments,
    /// white space and the way a number is written leave no trace.
    pub fn canonical(&self) -> String {
        fn walk(table: &RawTable, prefix: &str, out: &mut String) {
            for (key, entry) in table {
                let path = format!("{prefix}{}", quote(key));
                match &entry.item.value {
                    RawValue::Table(inner) if !inner.is_empty() => {
                        walk(inner, &format!("{path}."), out);
                    }
                    value => {
                        let _ = writeln!(out, "{path} = {value}");
                    }
                }
            }
        }
        let mut out = String::new();
        walk(&self.root, "", &mut out);
        out
    }

    /// SHA-256 of [`RawCase::canonical`] in hexadecimal.
    pub fn hash(&self) -> String {
        let mut hex = String::new();
        for byte in Sha256::digest(self.canonical()) {
            let _ = write!(hex, "{byte:02x}");
        }
        hex
    }

    /// Bundles diagnostics with the texts they point into.
    pub fn errors(&self, diagnostics: Vec<Diagnostic>) -> CaseErrors {
        let mut sources = vec![Source {
            name: self.name.clone(),
            text: self.text.clone(),
        }];
        sources.extend(self.overrides.iter().map(|text| Source {
            name: "--set".to_owned(),
            text: text.clone(),
        }));
        CaseErrors {
            sources,
            diagnostics,
        }
    }

    /// The value of a dotted key, if the case gives it.
    pub fn find(&self, key: &str) -> Option<&RawItem> {
        let mut table = &self.root;
        let mut parts = key.split('.').peekable();
        while let Some(part) = parts.next() {
            let item = &table.get(part)?.item;
            match (&item.value, parts.peek()) {
                (_, None) => return Some(item),
                (RawValue::Table(inner), Some(_)) => table = inner,
                _ => return None,
            }
        }
        None
    }
}

/// Parses a whole document; syntax errors are added to `diagnostics`.
fn parse_document(text: &str, source: usize, diagnostics: &mut Vec<Diagnostic>) -> RawTable {
    let (table, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        diagnostics.push(Diagnostic::error(
            error.message().to_owned(),
            String::new(),
            Location::new(source, error.span().unwrap_or(0..0)),
            None,
        ));
    }
    convert_table(table.get_ref(), source, diagnostics)
}

fn convert_table(table: &DeTable<'_>, source: usize, errors: &mut Vec<Diagnostic>) -> RawTable {
    table
        .iter()
        .map(|(key, value)| {
            let entry = RawEntry {
                key_at: Location::new(source, key.span()),
                item: RawItem {
                    value: convert(value.get_ref(), source, value.span(), errors),
                    at: Location::new(source, value.span()),
                },
            };
            (key.get_ref().to_string(), entry)
        })
        .collect()
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
                errors.push(Diagnostic::error(
                    format!("the integer {integer} does not fit 64 bits"),
                    "out of range".to_owned(),
                    Location::new(source, span),
                    Some("write it with a decimal point if it is meant as a number".to_owned()),
                ));
                RawValue::Integer(0)
            }
        },
        // A float that TOML accepts and Rust does not cannot exist; NaN is refused where it is used.
        DeValue::Float(float) => RawValue::Float(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(value) => RawValue::Boolean(*value),
        DeValue::Datetime(value) => RawValue::Datetime(value.to_string()),
        DeValue::Array(items) => RawValue::Array(
            items
                .iter()
                .map(|item| RawItem {
                    value: convert(item.get_ref(), source, item.span(), errors),
                    at: Location::new(source, item.span()),
                })
                .collect(),
        ),
        DeValue::Table(table) => RawValue::Table(convert_table(table, source, errors)),
    }
}
