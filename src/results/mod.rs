//! Result files: tables, fields, figures, manifest.
