//! Failures of a run as Python sees them: one exception that carries what it is in JSON; the package turns it into its own.

use frictionsim::app::Failure;
use frictionsim::case::{CaseErrors, Diagnostic, Location, Source};
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

create_exception!(_native, NativeFailure, PyException);

/// The exception of a failure: `args[0]` is JSON.
pub fn exception(failure: &Failure) -> PyErr {
    NativeFailure::new_err(description(failure).to_string())
}

/// The exception of bad input.
pub fn case_exception(errors: &CaseErrors) -> PyErr {
    NativeFailure::new_err(case_description(errors).to_string())
}

/// Any other exception, in words.
pub fn usage_exception(message: impl std::fmt::Display) -> PyErr {
    NativeFailure::new_err(json!({ "kind": "usage", "text": message.to_string() }).to_string())
}

/// What went wrong.
pub fn description(failure: &Failure) -> Value {
    let (kind, text) = match failure {
        Failure::Case(errors) => return case_description(errors),
        Failure::Usage(error) => ("usage", error.to_string()),
        Failure::Run(error) => ("run", error.to_string()),
        Failure::Interrupted(text) => ("interrupted", text.clone()),
        Failure::Panic(text) => ("internal", text.clone()),
        Failure::DryRun => ("nothing", String::new()),
        Failure::BrokenPipe => ("run", "the output stream is closed".to_owned()),
    };
    json!({ "kind": kind, "text": text })
}

fn case_description(errors: &CaseErrors) -> Value {
    let problem = |found: &Diagnostic| problem(found, errors.sources.get(found.at.source));
    let problems: Vec<Value> = errors.diagnostics.iter().map(problem).collect();
    json!({ "kind": "case", "text": errors.render(false), "problems": problems })
}

fn problem(found: &Diagnostic, source: Option<&Source>) -> Value {
    let place = source.map(|source| place(source, &found.at));
    let key = source.and_then(|source| key_at(source, &found.at));
    json!({
        "message": found.message,
        "suggestion": found.help,
        "file": source.map(|source| &source.name),
        "line": place.map(|place| place[0]),
        "column": place.map(|place| place[1]),
        "key": key,
    })
}

/// Line and column of a place, counted from 1, the column in characters.
fn place(source: &Source, at: &Location) -> [usize; 2] {
    let text = &source.text;
    let mut end = at.span.start.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.matches('\n').count() + 1;
    [line, before[line_start..].chars().count() + 1]
}

/// The dotted key that is written at a place: of an override its key, of a case the innermost one around it.
fn key_at(source: &Source, at: &Location) -> Option<String> {
    if at.source > 0 {
        let key = source.text.split_once('=').map_or(&*source.text, |p| p.0);
        return Some(key.trim().to_owned());
    }
    let table = DeTable::parse(&source.text).ok()?;
    let mut found = None;
    find_key(table.get_ref(), "", &at.span, &mut found);
    found.map(|(key, _)| key)
}

/// The key with the smallest span of its own or of its value that holds a place.
fn find_key(
    table: &DeTable<'_>,
    prefix: &str,
    place: &Range<usize>,
    found: &mut Option<(String, usize)>,
) {
    for (key, value) in table {
        let name = format!("{prefix}{}", key.get_ref());
        for span in [key.span(), value.span()] {
            let holds = span.start <= place.start && place.start < span.end;
            let is_smaller = |found: &(String, usize)| span.len() <= found.1;
            if holds && found.as_ref().is_none_or(is_smaller) {
                *found = Some((name.clone(), span.len()));
            }
        }
        if let DeValue::Table(inner) = value.get_ref() {
            find_key(inner, &format!("{name}."), place, found);
        }
    }
}
