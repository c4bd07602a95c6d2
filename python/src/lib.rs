//! The compiled part of the Python package `frictionsim`: commands on threads of their own, cases, tables.
//!
//! What users see is in `frictionsim/*.py`; this module is private to it.

mod case;
mod failure;
mod run;
mod table;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    case::add_to(module)?;
    module.add_function(wrap_pyfunction!(run::run, module)?)?;
    module.add_function(wrap_pyfunction!(run::command_line, module)?)?;
    module.add_function(wrap_pyfunction!(run::wait_for_stopped, module)?)?;
    module.add_function(wrap_pyfunction!(table::read_table, module)?)?;
    module.add("__version__", case::version())
}
