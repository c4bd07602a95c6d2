//! Typed, bounded access to the raw tree that collects every error instead of stopping at one.

mod lists;

use super::diagnostic::{Diagnostic, Location};
use super::keys;
use super::raw::{RawEntry, RawItem, RawTable, RawValue};
use std::cell::RefCell;

/// Where a number must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Bound {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Strictly between two values.
    Between(f64, f64),
    /// Any finite number.
    Finite,
}

impl Bound {
    fn admits(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Between(low, high) => value > low && value < high,
                Self::Finite => true,
            }
    }

    fn text(self) -> String {
        match self {
            Self::Positive => "must be positive and finite".to_owned(),
            Self::NotNegative => "must be zero or positive, and finite".to_owned(),
            Self::Between(low, high) => format!("must lie strictly between {low} and {high}"),
            Self::Finite => "must be finite".to_owned(),
        }
    }
}

/// Errors found so far.
#[derive(Debug, Default)]
pub(super) struct Findings {
    errors: RefCell<Vec<Diagnostic>>,
}

impl Findings {
    /// Adds an error.
    pub fn push(&self, message: String, label: String, at: Location, help: Option<String>) {
        self.errors
            .borrow_mut()
            .push(Diagnostic::error(message, label, at, help));
    }

    /// All errors, in the order found.
    pub fn into_errors(self) -> Vec<Diagnostic> {
        self.errors.into_inner()
    }
}

/// One section of the case. Getters record what is wrong and then return a harmless value (NaN or
/// zero), which later comparisons must not mistake for input: they ask in the form that NaN fails.
pub(super) struct Section<'a> {
    findings: &'a Findings,
    path: String,
    table: Option<&'a RawTable>,
    at: Location,
    asked: RefCell<Vec<&'static str>>,
}

impl<'a> Section<'a> {
    /// The whole document; `at` is where missing sections are reported.
    pub fn root(findings: &'a Findings, table: &'a RawTable, at: Location) -> Self {
        Self {
            findings,
            path: String::new(),
            table: Some(table),
            at,
            asked: RefCell::default(),
        }
    }

    /// Whether the case has this section.
    pub fn is_given(&self) -> bool {
        self.table.is_some()
    }

    /// Full dotted name of a key.
    pub fn name(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }

    fn item(&self, key: &'static str) -> Option<&'a RawItem> {
        self.asked.borrow_mut().push(key);
        self.table?.get(key).map(|entry| &entry.item)
    }

    /// Where a key's value is written; the section's head where it is not.
    pub fn place(&self, key: &str) -> Location {
        self.table
            .and_then(|table| table.get(key))
            .map_or_else(|| self.at.clone(), |entry| entry.item.at.clone())
    }

    /// Whether a key's value comes from an override.
    pub fn is_overridden(&self, key: &str) -> bool {
        self.place(key).source > 0
    }

    /// Whether the case gives a key.
    pub fn has(&self, key: &str) -> bool {
        self.table.is_some_and(|table| table.contains_key(key))
    }

    /// Reports an error at a key, with the key's meaning as remedy unless another is given.
    pub fn reject(&self, key: &str, message: String, label: String, help: Option<String>) {
        let help = help.or_else(|| keys::usage(&self.name(key)));
        self.findings.push(message, label, self.place(key), help);
    }

    /// Reports an error at a place of its own.
    pub fn reject_there(&self, at: &Location, message: String, label: String, help: &str) {
        self.findings
            .push(message, label, at.clone(), Some(help.to_owned()));
    }

    /// Whether a key is given as an empty list.
    pub fn is_empty_list(&self, key: &str) -> bool {
        matches!(self.given(key), Some(RawValue::Array(items)) if items.is_empty())
    }

    /// Whether a key is given as this word.
    pub fn is_text(&self, key: &str, word: &str) -> bool {
        matches!(self.given(key), Some(RawValue::String(text)) if text == word)
    }

    /// Whether a key is given as a string.
    pub fn is_some_text(&self, key: &str) -> bool {
        matches!(self.given(key), Some(RawValue::String(_)))
    }

    fn given(&self, key: &str) -> Option<&'a RawValue> {
        self.table?.get(key).map(|entry| &entry.item.value)
    }

    fn reject_at(&self, item: &RawItem, key: &str, bound: &str) {
        self.findings.push(
            format!("{} = {} {bound}", self.name(key), item.value),
            bound.to_owned(),
            item.at.clone(),
            keys::usage(&self.name(key)),
        );
    }

    fn missing(&self, key: &str) {
        // A missing section is reported once, where it is opened.
        if self.is_given() {
            self.findings.push(
                format!("missing key `{}`", self.name(key)),
                format!("`{key}` belongs in this section"),
                self.at.clone(),
                keys::usage(&self.name(key)),
            );
        }
    }

    /// A subsection; `required` ones are reported where absent.
    pub fn section(&self, key: &'static str, required: bool) -> Section<'a> {
        let path = self.name(key);
        self.asked.borrow_mut().push(key);
        let entry = self.table.and_then(|table| table.get(key));
        let mut section = Section {
            findings: self.findings,
            path,
            table: None,
            at: self.at.clone(),
            asked: RefCell::default(),
        };
        match entry {
            Some(entry) => {
                section.at = entry.key_at.clone();
                match &entry.item.value {
                    RawValue::Table(table) => section.table = Some(table),
                    other => self.findings.push(
                        format!("`{}` is {}, not a section", section.path, other.kind()),
                        "expected a section".to_owned(),
                        entry.item.at.clone(),
                        Some(format!("write its keys below [{}]", section.path)),
                    ),
                }
            }
            None if required => self.findings.push(
                format!("missing section [{}]", section.path),
                "the case ends without it".to_owned(),
                self.at.clone(),
                Some("`frictionsim init` writes a complete case to start from".to_owned()),
            ),
            None => {}
        }
        section
    }

    /// Reports every key that nobody asked for.
    pub fn close(self) {
        let asked = self.asked.borrow();
        for (key, entry) in self.table.into_iter().flatten() {
            if asked.contains(&key.as_str()) {
                continue;
            }
            let place = if self.path.is_empty() {
                "the case has no such section or key".to_owned()
            } else {
                format!("not a key of [{}]", self.path)
            };
            self.findings.push(
                format!("unknown key `{}`", self.name(key)),
                place,
                entry.key_at.clone(),
                keys::suggest(&self.path, key, &asked),
            );
        }
    }

    /// Every entry of the section that has not been asked for, as swept keys.
    pub fn remaining(&self) -> Vec<(&'a str, &'a RawEntry)> {
        let asked = self.asked.borrow();
        let entries = self.table.into_iter().flatten();
        entries
            .filter(|(key, _)| !asked.contains(&key.as_str()))
            .map(|(key, entry)| (key.as_str(), entry))
            .collect()
    }

    fn read_number(&self, key: &str, item: &RawItem, bound: Bound) -> Option<f64> {
        let value = match item.value {
            RawValue::Integer(value) => value as f64,
            RawValue::Float(value) => value,
            ref other => {
                self.reject_at(
                    item,
                    key,
                    &format!("must be a number, not {}", other.kind()),
                );
                return None;
            }
        };
        if bound.admits(value) {
            Some(value)
        } else {
            self.reject_at(item, key, &bound.text());
            None
        }
    }

    /// A number that may be left out.
    pub fn optional_number(&self, key: &'static str, bound: Bound) -> Option<f64> {
        let item = self.item(key)?;
        Some(self.read_number(key, item, bound).unwrap_or(f64::NAN))
    }

    /// A number with a default.
    pub fn number_or(&self, key: &'static str, bound: Bound, default: f64) -> f64 {
        self.optional_number(key, bound).unwrap_or(default)
    }

    /// A number that must be there.
    pub fn number(&self, key: &'static str, bound: Bound) -> f64 {
        self.optional_number(key, bound).unwrap_or_else(|| {
            self.missing(key);
            f64::NAN
        })
    }

    /// A number or one word that stands for its absence.
    pub fn number_or_word(&self, key: &'static str, bound: Bound, word: &str) -> Option<f64> {
        match self.item(key) {
            Some(RawItem {
                value: RawValue::String(text),
                ..
            }) if text == word => None,
            Some(item) if matches!(item.value, RawValue::String(_)) => {
                self.reject_at(item, key, &format!("must be a number or \"{word}\""));
                None
            }
            Some(item) => self.read_number(key, item, bound),
            None => None,
        }
    }

    fn read_count(&self, key: &str, item: &RawItem, least: usize) -> Option<usize> {
        let value = match item.value {
            RawValue::Integer(value) => value,
            // Ranges produce numbers: a whole one is a count.
            RawValue::Float(value) if value.fract() == 0.0 && value.abs() < 9e15 => value as i64,
            ref other => {
                let kind = other.kind();
                self.reject_at(item, key, &format!("must be an integer, not {kind}"));
                return None;
            }
        };
        match usize::try_from(value) {
            Ok(value) if value >= least => Some(value),
            _ => {
                self.reject_at(item, key, &format!("must be {least} or more"));
                None
            }
        }
    }

    /// A whole number of at least `least` that may be left out.
    pub fn optional_count(&self, key: &'static str, least: usize) -> Option<usize> {
        let item = self.item(key)?;
        Some(self.read_count(key, item, least).unwrap_or(0))
    }

    /// A whole number of at least `least` that must be there; 0 where it is not.
    pub fn count(&self, key: &'static str, least: usize) -> usize {
        self.optional_count(key, least).unwrap_or_else(|| {
            self.missing(key);
            0
        })
    }

    /// True or false.
    pub fn flag_or(&self, key: &'static str, default: bool) -> bool {
        match self.item(key) {
            None => default,
            Some(RawItem {
                value: RawValue::Boolean(value),
                ..
            }) => *value,
            Some(item) => {
                self.reject_at(item, key, "must be true or false");
                default
            }
        }
    }

    /// Free text.
    pub fn text_or(&self, key: &'static str, default: &str) -> String {
        match self.item(key) {
            None => default.to_owned(),
            Some(RawItem {
                value: RawValue::String(text),
                ..
            }) => text.clone(),
            Some(item) => {
                self.reject_at(item, key, "must be a string");
                default.to_owned()
            }
        }
    }

    /// Text that must be there.
    pub fn text(&self, key: &'static str) -> String {
        if !self.has(key) {
            self.missing(key);
        }
        self.text_or(key, "")
    }

    /// One of a few words; the first is the default.
    pub fn choice<T: Copy>(&self, key: &'static str, choices: &[(&str, T)]) -> T {
        match self.item(key) {
            None => choices[0].1,
            Some(item) => self.read_choice(key, item, choices).unwrap_or(choices[0].1),
        }
    }

    fn read_choice<T: Copy>(&self, key: &str, item: &RawItem, choices: &[(&str, T)]) -> Option<T> {
        let words: Vec<&str> = choices.iter().map(|choice| choice.0).collect();
        if let RawValue::String(text) = &item.value {
            if let Some(choice) = choices.iter().find(|choice| choice.0 == text) {
                return Some(choice.1);
            }
            if let Some(near) = keys::nearest(text, words.iter().copied()) {
                self.findings.push(
                    format!("{} = \"{text}\" is not one of its values", self.name(key)),
                    format!("must be one of \"{}\"", words.join("\", \"")),
                    item.at.clone(),
                    Some(format!("did you mean \"{near}\"?")),
                );
                return None;
            }
        }
        let bound = format!("must be one of \"{}\"", words.join("\", \""));
        self.reject_at(item, key, &bound);
        None
    }
}
