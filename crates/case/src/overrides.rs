//! `--set KEY=VALUE` and `--unset KEY`: assignments laid over the case, keys taken away.

use super::value::{convert, cut};
use super::{Diagnostic, Location, RawItem, RawTable, RawValue, Source, keys, suggestion::Scope};
use toml::de::{DeTable, DeValue};

/// A part of the path of an override, with its place.
type Part = (String, Location);

/// What is wrong with an override.
type Laid<T> = Result<T, Vec<Diagnostic>>;

/// How an override begins that takes a key away.
const UNSET: &str = "unset ";

/// The override that takes a key away, as `--unset KEY` asks for.
pub fn unset(key: &str) -> String {
    format!("{UNSET}{key}")
}

/// The text that errors of an override point into.
pub(super) fn source(text: &str) -> Source {
    let (name, text) = text.strip_prefix(UNSET).map_or(("--set", text), |key| ("--unset", key));
    Source { name: name.to_owned(), text: text.to_owned() }
}

/// An override as a title quotes it.
pub(super) fn shown(text: &str) -> String {
    cut(match (text.strip_prefix(UNSET), text.split_once('=')) {
        (Some(key), _) => format!("no {key}"),
        (None, Some((key, value))) => format!("{} = {}", key.trim(), value.trim()),
        (None, None) => text.to_owned(),
    })
}

/// Lays one override over a case: `KEY=VALUE`, or what [`unset`] gives.
pub(super) fn lay(root: &mut RawTable, text: &str, source: usize) -> Laid<()> {
    if let Some(key) = text.strip_prefix(UNSET) {
        return remove(root, &path(key, source, "--unset needs a dotted key")?, source);
    }
    let (path, item) = parse(text, source)?;
    insert(root, &path, item)
}

/// Parses a dotted key.
fn path(text: &str, source: usize, help: &str) -> Laid<Vec<Part>> {
    // The key alone tells how deep the path goes; an inline table as value is not part of it.
    match DeTable::parse(&format!("{}=0", keys::dotted(text))) {
        Ok(table) if table.get_ref().len() == 1 => Ok(key_path(table.get_ref(), source)),
        _ => Err(vec![placed!(Location::new(source, 0..text.len()),
            "`{text}` is not a key"; "expected a dotted key"; "{help}")]),
    }
}

/// Takes a key, or a whole section, away; one that the case does not have may go, too.
fn remove(root: &mut RawTable, path: &[Part], source: usize) -> Laid<()> {
    let parts: Vec<&str> = path.iter().map(|part| part.0.as_str()).collect();
    let mut table = Some(&mut *root);
    for part in &parts[..parts.len() - 1] {
        table = table.and_then(|table| table.get_mut(*part)?.value.table_mut());
    }
    let taken = table.and_then(|table| table.remove(parts[parts.len() - 1]));
    let name = parts.join(".");
    if taken.is_some() || keys::find(&name).is_some() || keys::is_section(&name) {
        return Ok(());
    }
    let (at, hint) = (Location::new(source, 0..name.len()), Scope::of(root).hint(&name, |_| true));
    let message = format!("unknown key `{name}`");
    Err(vec![Diagnostic::error(message, "nothing to remove", at, hint)])
}

/// Parses one `KEY=VALUE`.
fn parse(text: &str, source: usize) -> Laid<(Vec<Part>, RawItem)> {
    let help = "an override is KEY=VALUE with a dotted key and a TOML value, \
                for example --set contact.friction_coefficient=0.4";
    let Some(equals) = assignment(text) else {
        return Err(vec![placed!(Location::new(source, 0..text.len()),
            "the override has no `=`"; "expected KEY=VALUE"; "{help}")]);
    };
    let path = path(&text[..equals], source, help)?;
    let value_text = &text[equals + 1..];
    let value_at = Location::new(source, equals + 1..text.len());
    let mut errors = Vec::new();
    let value = match DeValue::parse(value_text.trim()) {
        Ok(value) => convert(value.get_ref(), source, value_at.span.clone(), &mut errors),
        Err(error) if value_text.trim_start().starts_with(['[', '{', '"', '\'']) => {
            return Err(vec![placed!(value_at, "the value is not TOML: {}", error.message(); "";
                "{help}")]);
        }
        Err(_) => RawValue::String(value_text.trim().to_owned()),
    };
    // Values inside an override are short: every part of one points at the whole value.
    errors.iter_mut().for_each(|error| error.at = value_at.clone());
    if errors.is_empty() { Ok((path, RawItem::at(value, &value_at))) } else { Err(errors) }
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

fn key_path(table: &DeTable<'_>, source: usize) -> Vec<Part> {
    let mut path = Vec::new();
    let mut table = table;
    while let Some((key, value)) = table.iter().next() {
        path.push((key.get_ref().to_string(), Location::new(source, key.span())));
        let DeValue::Table(inner) = value.get_ref() else { break };
        table = inner;
    }
    path
}

/// Puts a value at a path, making the tables on the way.
fn insert(table: &mut RawTable, path: &[Part], item: RawItem) -> Laid<()> {
    let Some(((key, key_at), rest)) = path.split_first() else { return Ok(()) };
    if rest.is_empty() {
        table.insert(key.clone(), RawItem { key_at: key_at.clone(), ..item });
        return Ok(());
    }
    let empty = || RawItem::at(RawValue::Table(RawTable::new()), key_at);
    let entry = table.entry(key.clone()).or_insert_with(empty);
    if let (RawValue::Array(items), [(part, _)]) = (&mut entry.value, rest)
        && let Some(place) = keys::list_place(part)
    {
        let count = items.len();
        let slot = items.get_mut(place).ok_or_else(|| {
            vec![placed!(item.at.clone(),
                "{key}[{part}] is beyond the {count} numbers of the case's {key}";
                "no such place in the list"; "places are counted from 1: [1] to [{count}]")]
        })?;
        *slot = item;
        return Ok(());
    }
    if !matches!(entry.value, RawValue::Table(_)) {
        // A path through a plain value: the reader of that key reports the table it then finds.
        (entry.value, entry.at) = (RawValue::Table(RawTable::new()), key_at.clone());
    }
    entry.value.table_mut().map_or(Ok(()), |inner| insert(inner, rest, item))
}
