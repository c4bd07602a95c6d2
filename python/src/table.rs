//! Tables of results as columns of numbers.

use crate::failure::usage_exception;
use numpy::PyArray1;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::PathBuf;

/// The cells of one column.
struct Column {
    name: String,
    cells: Vec<String>,
}

impl Column {
    /// Whole numbers, numbers with NaN for empty cells, truth values, else texts; arrays own their numbers.
    fn object(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let whole: Result<Vec<i64>, _> = self.cells.iter().map(|cell| cell.parse()).collect();
        if let Ok(numbers) = whole {
            return PyArray1::from_vec(py, numbers).into_py_any(py);
        }
        let number = |cell: &String| match cell.as_str() {
            "" => Ok(f64::NAN),
            text => text.parse(),
        };
        let numbers: Result<Vec<f64>, _> = self.cells.iter().map(number).collect();
        if let Ok(numbers) = numbers {
            return PyArray1::from_vec(py, numbers).into_py_any(py);
        }
        let flags: Result<Vec<bool>, _> = self.cells.iter().map(|cell| cell.parse()).collect();
        if let Ok(flags) = flags {
            return PyArray1::from_vec(py, flags).into_py_any(py);
        }
        // What the program hides from spreadsheets begins with an apostrophe.
        let shown = |cell: &String| cell.strip_prefix('\'').unwrap_or(cell).to_owned();
        PyList::new(py, self.cells.iter().map(shown))?.into_py_any(py)
    }
}

/// The columns of a table of results by name, in their order.
#[pyfunction]
pub fn read_table(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let columns = py.detach(|| read(&path));
    let columns = columns
        .map_err(|error| usage_exception(format!("cannot read {}: {error}", path.display())))?;
    let found = PyDict::new(py);
    for column in columns {
        found.set_item(&column.name, column.object(py)?)?;
    }
    Ok(found)
}

fn read(path: &std::path::Path) -> Result<Vec<Column>, csv::Error> {
    let mut reader = csv::Reader::from_path(path)?;
    let names = reader.headers()?.clone();
    let mut columns: Vec<Column> =
        names.iter().map(|name| Column { name: name.to_owned(), cells: Vec::new() }).collect();
    for record in reader.records() {
        for (column, cell) in columns.iter_mut().zip(record?.iter()) {
            column.cells.push(cell.to_owned());
        }
    }
    Ok(columns)
}
