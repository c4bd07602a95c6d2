//! Cases: their values, their errors, what they cost, and how they are written.

use crate::failure::{self, case_exception, usage_exception};
use crate::run::start;
use frictionsim::app::check::examine;
use frictionsim::app::embedded::EmbeddedRun;
use frictionsim::app::shipped::{ShippedCase, all_cases, all_files};
use frictionsim::case::{Case, KEYS, RawCase, RawTable, RawValue, reference, unset};
use frictionsim::results::reference::objects;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::borrow::Cow;
use std::path::PathBuf;
use toml_edit::{DocumentMut, Item, Key, Table, Value};

/// The effective values of a case text under overrides, sections as dictionaries.
#[pyfunction]
pub fn values<'py>(
    py: Python<'py>,
    name: &str,
    text: &[u8],
    overrides: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let raw = RawCase::parse(name, text, &overrides);
    let raw = raw.map_err(|errors| case_exception(&errors))?;
    dictionary(py, &raw.root)
}

fn dictionary<'py>(py: Python<'py>, table: &RawTable) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (key, entry) in table {
        found.set_item(key, object(py, &entry.value)?)?;
    }
    Ok(found)
}

fn object(py: Python<'_>, value: &RawValue) -> PyResult<Py<PyAny>> {
    match value {
        RawValue::String(text) | RawValue::Datetime(text) => text.into_py_any(py),
        RawValue::Integer(number) => number.into_py_any(py),
        RawValue::Float(number) => number.into_py_any(py),
        RawValue::Boolean(flag) => flag.into_py_any(py),
        RawValue::Array(items) => {
            let items = items.iter().map(|item| object(py, &item.value));
            let items = items.collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_py_any(py)
        }
        RawValue::Table(table) => dictionary(py, table)?.into_py_any(py),
    }
}

/// Validates a case text, whose files are looked for beside `name`: its warnings.
#[pyfunction]
pub fn validate(name: &str, text: &[u8], overrides: Vec<String>) -> PyResult<Vec<String>> {
    let case = Case::parse(name, text, &overrides);
    let case = case.map_err(|errors| case_exception(&errors))?;
    Ok(case.warnings.iter().map(ToString::to_string).collect())
}

/// Examines a case file as `frictionsim check` does, in JSON.
#[pyfunction]
pub fn check(py: Python<'_>, path: PathBuf, overrides: Vec<String>) -> PyResult<String> {
    let run = EmbeddedRun::default();
    let own = run.clone();
    let found = start(py, &run, None, move || own.enclose(0, || examine(&path, &overrides)))?;
    Ok(found.to_string())
}

/// Every key of a case, in JSON.
#[pyfunction]
pub fn keys() -> String {
    serde_json::Value::from_iter(KEYS.iter().map(reference::object)).to_string()
}

/// Columns of tables and keys of summaries that a word finds, in JSON.
#[pyfunction]
pub fn columns(word: &str) -> String {
    serde_json::Value::from(objects(word)).to_string()
}

/// The text of a case that lies beside a mesh file.
#[pyfunction]
pub fn case_from(mesh: PathBuf) -> PyResult<String> {
    let name = mesh.file_name().unwrap_or_default().to_string_lossy();
    frictionsim::case::case_from(&mesh, &name).map_err(usage_exception)
}

/// The override that takes a key away.
#[pyfunction]
pub fn without(key: &str) -> String {
    unset(key)
}

/// A case text with overrides written into it, its comments left where they are.
#[pyfunction]
pub fn edited(text: &[u8], overrides: Vec<String>) -> PyResult<String> {
    let text = std::str::from_utf8(text).map_err(usage_exception)?;
    let mut document: DocumentMut = text.parse().map_err(usage_exception)?;
    let unset = without("");
    for change in &overrides {
        if let Some(key) = change.strip_prefix(&unset) {
            remove(&mut document, key)?;
        } else if let Some((key, value)) = change.split_once('=') {
            insert(&mut document, key, value)?;
        }
    }
    Ok(document.to_string())
}

/// The sections of a dotted key, and its last part.
fn parts(key: &str) -> PyResult<(Vec<Key>, Key)> {
    let mut path = Key::parse(key).map_err(usage_exception)?;
    let last = path.pop();
    let last = last.ok_or_else(|| usage_exception("an empty key"))?;
    Ok((path, last))
}

fn insert(document: &mut DocumentMut, key: &str, value: &str) -> PyResult<()> {
    let (sections, last) = parts(key)?;
    let parsed = value.trim().parse::<Value>();
    let mut value = parsed.unwrap_or_else(|_| Value::from(value.trim()));
    let mut place: &mut dyn toml_edit::TableLike = document.as_table_mut();
    for section in sections {
        let inner = place.entry(section.get()).or_insert_with(|| {
            let mut table = Table::new();
            table.set_implicit(false);
            Item::Table(table)
        });
        let found = inner.as_table_like_mut();
        place = found.ok_or_else(|| usage_exception(format!("{key}: not a section")))?;
    }
    // A comment behind the value stays.
    if let Some(old) = place.get(last.get()).and_then(Item::as_value) {
        *value.decor_mut() = old.decor().clone();
    }
    match place.get_mut(last.get()) {
        Some(item) => *item = Item::Value(value),
        None => drop(place.insert(last.get(), Item::Value(value))),
    }
    Ok(())
}

fn remove(document: &mut DocumentMut, key: &str) -> PyResult<()> {
    let (sections, last) = parts(key)?;
    let mut place: Option<&mut dyn toml_edit::TableLike> = Some(document.as_table_mut());
    for section in sections {
        place = place.and_then(|table| table.get_mut(section.get())?.as_table_like_mut());
    }
    if let Some(table) = place {
        table.remove(last.get());
    }
    Ok(())
}

/// Name and title of every shipped case.
#[pyfunction]
pub fn shipped_cases() -> Vec<(&'static str, &'static str)> {
    let cases = all_cases().into_iter();
    cases.map(|case| (case.name(), case.title())).collect()
}

/// A shipped case and the files that it reads, or every shipped file: relative paths and bytes.
#[pyfunction]
#[pyo3(signature = (name=None))]
pub fn shipped_files(name: Option<&str>) -> PyResult<Vec<(String, Cow<'static, [u8]>)>> {
    let Some(name) = name else {
        let all = all_files().into_iter();
        return Ok(all.map(|(path, bytes)| (path.to_owned(), bytes.into())).collect());
    };
    let found = all_cases().into_iter().find(|case| case.name() == name).ok_or_else(|| {
        let names: Vec<&str> = all_cases().iter().map(ShippedCase::name).collect();
        let names = names.join(", ");
        usage_exception(format!("no shipped case \"{name}\": there are {names}"))
    })?;
    let own = found.named(found.file).into_bytes();
    let beside = found.files().into_iter();
    let beside = beside.map(|(path, bytes)| (path.to_owned(), bytes.into()));
    Ok(std::iter::once((found.file.to_owned(), own.into())).chain(beside).collect())
}

/// Version of the program.
pub fn version() -> String {
    frictionsim::results::Manifest::new("").version
}

/// Adds the functions of this file to the module.
pub fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(values, module)?)?;
    module.add_function(wrap_pyfunction!(validate, module)?)?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(keys, module)?)?;
    module.add_function(wrap_pyfunction!(columns, module)?)?;
    module.add_function(wrap_pyfunction!(case_from, module)?)?;
    module.add_function(wrap_pyfunction!(without, module)?)?;
    module.add_function(wrap_pyfunction!(edited, module)?)?;
    module.add_function(wrap_pyfunction!(shipped_cases, module)?)?;
    module.add_function(wrap_pyfunction!(shipped_files, module)?)?;
    module.add("NativeFailure", module.py().get_type::<failure::NativeFailure>())
}
