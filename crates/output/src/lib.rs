//! Findings as documents: columns and tables that are declared once, and what is made of them.
//!
//! A [`Column`] says how a value is called, what it means, its digits, and where it stands in a row. A [`Table`] of
//! such columns is a CSV file, a table of the terminal and one of the page. A [`Document`] holds the tables and
//! sentences of a result. Nothing here knows what the findings are about.

pub mod csv;
mod described;
mod document;
mod number;
mod table;

pub use frictionsim_described::Described;

pub use described::{Described, describe_field, keys_of};
pub use document::{Document, Section};
pub use number::{Format, fixed, rounded, significant, unit_of};
pub use table::{Cell, Column, Entry, Head, Shown, Table, entries, parted, write_rows};
