//! Result files: tables, fields, figures, manifest.

pub mod figures;
