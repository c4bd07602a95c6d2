//! `--set KEY=VALUE`: one TOML assignment laid over the case.

use super::diagnostic::{Diagnostic, Location};
use super::raw::{RawEntry, RawItem, RawTable, RawValue, convert};
use toml::de::{DeTable, DeValue};

/// Path of an override: each key with its place.
pub(super) type KeyPath = Vec<(String, Location)>;

/// Parses one `KEY=VALUE`.
pub(super) fn parse(
    text: &str,
    source: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(KeyPath, RawItem)> {
    let whole = Location::new(source, 0..text.len());
    let help = Some(
        "an override is KEY=VALUE with a dotted key and a TOML value, \
         for example --set contact.friction_coefficient=0.4"
            .to_owned(),
    );
    let Some(equals) = assignment(text) else {
        diagnostics.push(Diagnostic::error(
            "the override has no `=`".to_owned(),
            "expected KEY=VALUE".to_owned(),
            whole,
            help,
        ));
        return None;
    };
    // The key alone tells how deep the path goes; an inline table as value is not part of it.
    let key_text = format!("{}=0", &text[..equals]);
    let path = match DeTable::parse(&key_text) {
        Ok(table) if table.get_ref().len() == 1 => key_path(table.get_ref(), source),
        _ => {
            diagnostics.push(Diagnostic::error(
                format!("`{}` is not a key", &text[..equals]),
                "expected a dotted key".to_owned(),
                Location::new(source, 0..equals),
                help,
            ));
            return None;
        }
    };
    let value_text = &text[equals + 1..];
    let value_at = Location::new(source, equals + 1..text.len());
    let mut errors = Vec::new();
    let value = match DeValue::parse(value_text.trim()) {
        Ok(value) => convert(value.get_ref(), source, value_at.span.clone(), &mut errors),
        Err(error) if value_text.trim_start().starts_with(['[', '{', '"', '\'']) => {
            errors.push(Diagnostic::error(
                format!("the value is not TOML: {}", error.message()),
                String::new(),
                value_at.clone(),
                help,
            ));
            RawValue::Boolean(false)
        }
        Err(_) => RawValue::String(value_text.trim().to_owned()),
    };
    place_within(&value_at, &mut errors);
    diagnostics.append(&mut errors);
    let mut item = RawItem {
        value,
        at: value_at.clone(),
    };
    relocate(&mut item, &value_at);
    Some((path, item))
}

/// Position of the `=` between key and value: the first one outside quotes.
fn assignment(text: &str) -> Option<usize> {
    let mut quote = None;
    for (index, c) in text.char_indices() {
        match (quote, c) {
            (None, '=') => return Some(index),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
    }
    None
}

fn key_path(table: &DeTable<'_>, source: usize) -> KeyPath {
    let mut path = KeyPath::new();
    let mut table = table;
    while let Some((key, value)) = table.iter().next() {
        path.push((key.get_ref().to_string(), Location::new(source, key.span())));
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => break,
        }
    }
    path
}

/// Values inside an override are short: every part of one points at the whole value.
fn relocate(item: &mut RawItem, at: &Location) {
    item.at = at.clone();
    match &mut item.value {
        RawValue::Array(items) => items.iter_mut().for_each(|item| relocate(item, at)),
        RawValue::Table(table) => {
            for entry in table.values_mut() {
                entry.key_at = at.clone();
                relocate(&mut entry.item, at);
            }
        }
        _ => {}
    }
}

fn place_within(at: &Location, errors: &mut [Diagnostic]) {
    for error in errors {
        error.at = at.clone();
    }
}

/// Puts a value at a path, making the tables on the way.
pub(super) fn insert(table: &mut RawTable, path: &[(String, Location)], item: RawItem) {
    let Some(((key, key_at), rest)) = path.split_first() else {
        return;
    };
    if rest.is_empty() {
        let key_at = key_at.clone();
        table.insert(key.clone(), RawEntry { key_at, item });
        return;
    }
    let entry = table.entry(key.clone()).or_insert_with(|| RawEntry {
        key_at: key_at.clone(),
        item: RawItem {
            value: RawValue::Table(RawTable::new()),
            at: key_at.clone(),
        },
    });
    if !matches!(entry.item.value, RawValue::Table(_)) {
        // A path through a plain value: the reader of that key reports the table it then finds.
        entry.item = RawItem {
            value: RawValue::Table(RawTable::new()),
            at: key_at.clone(),
        };
    }
    if let RawValue::Table(inner) = &mut entry.item.value {
        insert(inner, rest, item);
    }
}
