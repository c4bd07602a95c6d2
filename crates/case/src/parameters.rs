//! Tables whose keys are dotted case keys of the model: what is fitted, what is uncertain.

use super::{Bound, keys, value::leaves};
use crate::*;

/// Sections that make the model.
const MODEL: &str = "geometry, mesh, boundaries, material, materials, damping, contact, contacts, \
                     motion, modifications";

/// Whether a dotted name is one of those sections.
fn is_of_model(name: &str) -> bool {
    let section = name.split('.').next().unwrap_or_default();
    MODEL.split(", ").any(|own| own == section)
}

/// A key that a study varies, and the keys that take the same value.
#[derive(Clone, Debug, PartialEq)]
pub struct VariedKey {
    /// Dotted case key; a continuous parameter of the model where it is fitted or uncertain.
    pub key: String,
    /// Further keys that are given the same value.
    pub also: Vec<String>,
    /// Where it is named, or its values are given.
    pub at: Location,
}

impl VariedKey {
    /// The key and those that go with it.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        std::iter::once(&self.key).chain(&self.also)
    }

    /// The overrides that give it a value, in TOML.
    pub(super) fn overrides(&self, value: &str) -> Vec<String> {
        self.names().map(|name| format!("{name}={value}")).collect()
    }

    /// Where the value of a continuous parameter may lie.
    pub(super) fn bound(&self) -> Bound {
        keys::find(&self.key).and_then(CaseKey::continuous).unwrap_or(Bound::FINITE)
    }
}

/// A case key; else what is meant, of those that may be.
pub(super) fn known(
    section: &Section<'_>,
    name: &str,
    may_be: fn(&CaseKey) -> bool,
) -> Result<&'static CaseKey, String> {
    keys::find(name).ok_or_else(|| {
        let near = section.findings.scope.hint(name, may_be);
        near.unwrap_or_else(|| "must be a dotted case key in quotes".to_owned())
    })
}

/// Whether a key is a continuous parameter of the model; else why not.
fn check(section: &Section<'_>, name: &str) -> Result<(), String> {
    let key = known(section, name, CaseKey::is_numeric)?;
    match key.continuous() {
        Some(_) if is_of_model(name) => Ok(()),
        Some(_) => Err(format!("it is no parameter of the model, which has {MODEL}")),
        None => Err(format!("its values are {}: what varies must be continuous", key.values())),
    }
}

/// What is read of each entry of a table of a section; refuses keys that two of them set, and a table without any.
pub(super) fn read_all<T>(
    section: &Section<'_>,
    key: &str,
    read: impl Fn(&Section<'_>, VariedKey, &RawItem) -> T,
    parameter_of: impl Fn(&T) -> &VariedKey,
) -> Vec<T> {
    let table = section.section(key, true);
    let entries = collect(&table, check).into_iter();
    let found: Vec<T> = entries.map(|(own, entry)| read(&table, own, entry)).collect();
    refuse_twice(&table, found.iter().map(parameter_of));
    refuse_if!(table.is_given() && table.remaining().is_empty(); section, key => "is empty";
        "at least one parameter");
    found
}

/// Whether a key may be varied; else why not.
type Check = fn(&Section<'_>, &str) -> Result<(), String>;

/// The keys that the entries of a section name; a table that is no entry is dotted keys written without quotes.
pub(super) fn collect<'a>(section: &Section<'a>, check: Check) -> Vec<(VariedKey, &'a RawItem)> {
    let mut found = Vec::new();
    let given = section.remaining().into_iter().rev();
    let mut rest: Vec<(String, &RawItem)> = given.map(|(key, own)| (key.to_owned(), own)).collect();
    while let Some((key, entry)) = rest.pop() {
        match (&entry.value, check(section, &key)) {
            (_, Ok(())) => {
                let also = also(section, &key, entry, check);
                found.push((VariedKey { key, also, at: entry.key_at.clone() }, entry));
            }
            (RawValue::Table(inner), Err(_)) if keys::is_section(&key) && !inner.is_empty() => {
                let inner = inner.iter().rev();
                rest.extend(inner.map(|(name, entry)| (format!("{key}.{name}"), entry)));
            }
            (_, Err(reason)) => refuse_at!(section, &entry.key_at,
                "\"{key}\" in {} cannot be varied", section.name("").trim_end_matches('.');
                "not a key to vary"; "{reason}"),
        }
    }
    found
}

/// The keys that `also` names.
fn also(section: &Section<'_>, name: &str, entry: &RawItem, check: Check) -> Vec<String> {
    let given = entry.value.table().and_then(|table| table.get("also"));
    let mut keys = Vec::new();
    for item in given.into_iter().flat_map(RawItem::listed) {
        let refuse = |message: String, help: &str| {
            refuse_at!(section, &item.at, "{message}"; "not a key to tie"; "{help}");
        };
        match &item.value {
            RawValue::String(key) => match check(section, key) {
                Ok(()) => keys.push(key.clone()),
                Err(reason) => refuse(format!("{name} also sets \"{key}\""), &reason),
            },
            other => refuse(
                format!("`also` of {name} is {}", other.kind()),
                "give one key, or a list of keys, that take the same value",
            ),
        }
    }
    keys
}

/// A number of an entry; an error where it is missing or none.
pub(super) fn number(section: &Section<'_>, entry: &RawItem, given: Option<&RawItem>) -> f64 {
    let value = given.map(|given| &given.value);
    value.and_then(RawValue::number).filter(|v| v.is_finite()).unwrap_or_else(|| {
        let found = value.map_or("missing".to_owned(), |v| format!("{} is given", v.shortened()));
        refuse_at!(section, &entry.at, "a finite number is needed: {found}"; "not a number";
            "write numbers in SI units");
        f64::NAN
    })
}

/// Reports the keys of an entry that it does not take.
pub(super) fn only(section: &Section<'_>, table: &RawTable, known: &[&str]) {
    for (key, entry) in table.iter().filter(|(key, _)| !known.contains(&key.as_str())) {
        refuse_at!(section, &entry.key_at, "unknown key `{key}`"; "not known here"; "it takes {}",
            known.join(", "));
    }
}

/// Reports keys that two entries set.
pub(super) fn refuse_twice<'a>(section: &Section<'_>, varied: impl Iterator<Item = &'a VariedKey>) {
    let mut seen: Vec<&str> = Vec::new();
    for (key, own) in varied.flat_map(|own| own.names().map(move |key| (key, own))) {
        if seen.contains(&key.as_str()) {
            refuse_at!(section, &own.at, "{key} is set twice"; "set by another entry already";
                "vary each key once");
        }
        seen.push(key);
    }
}

impl super::Case {
    /// The case with parameters of the model at other values, and without what is studied of it.
    ///
    /// # Errors
    /// Values that do not go together, in one line.
    pub fn with_parameters<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a VariedKey, f64)>,
    ) -> Result<Self, String> {
        let values = values.into_iter();
        let overrides: Vec<String> =
            values.flat_map(|(own, value)| own.overrides(&format!("{value:?}"))).collect();
        self.with_keys(&overrides).map_err(|errors| errors.line())
    }

    /// The case with overrides, and without what is studied of it.
    ///
    /// # Errors
    /// Overrides that are none, and values that do not go together.
    pub fn with_keys(&self, overrides: &[String]) -> Result<Self, CaseErrors> {
        let mut raw = self.raw.with_overrides(overrides)?;
        for study in ["sweep", "fit", "uncertainty", "convergence"] {
            raw.root.remove(study);
        }
        Self::read(raw)
    }

    /// The continuous parameters of the model that the case gives as numbers, with these, by key, `KEY[2]` in a list.
    /// The friction coefficient of `[contact]`, which sweeps vary, and the thickness of a plane body, which scales
    /// results alone, are left out.
    pub fn model_numbers(&self) -> Vec<(String, f64)> {
        let leaves = leaves(&self.raw.root, str::to_owned).into_iter();
        let is_left_out = |key: &str| {
            key == "contact.friction_coefficient"
                || (key == "geometry.thickness" && self.body.dimension() == 2)
        };
        let entries = leaves.flat_map(|(key, value)| match value {
            RawValue::Array(items) => (1..)
                .zip(items)
                .map(|(place, item)| (format!("{key}[{place}]"), &item.value))
                .collect(),
            value => vec![(key, value)],
        });
        let numbers = entries.filter_map(|(key, value)| {
            keys::find(&key)?.continuous()?;
            let is_varied = is_of_model(&key) && !is_left_out(&key);
            value.number().filter(|_| is_varied).map(|number| (key, number))
        });
        numbers.collect()
    }

    /// The number that the case, or its mesh file, gives a key, if one does.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.raw.find(key).and_then(|item| item.value.number()).or_else(|| self.taken.number(key))
    }
}
