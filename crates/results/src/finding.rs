//! What a command found: its document and figures become the files of its folder.

use super::drawing::{Declaration, DrawingError, DrawingOptions};
use super::record::{read_record, write_record};
use super::report::Page;
use super::{FolderError, OutputFolder};
use frictionsim_chart::Figure;
use frictionsim_output::{Document, Table};
use serde::Serialize;

/// A summary that says everything: it is `summary.json`, and the tables, the page and the figures are made from it.
pub trait Finding: Serialize {
    /// Its tables and sentences.
    fn document(&self) -> Document;

    /// Its figures.
    fn figures(&self) -> Vec<Declaration<'_>>;
}

/// Writes the tables of a document that are files.
pub fn write_tables(folder: &OutputFolder, document: &Document) -> Result<(), FolderError> {
    document.files().try_for_each(|table| write_table(folder, table))
}

/// Writes a table as its file.
pub fn write_table(folder: &OutputFolder, table: &Table) -> Result<(), FolderError> {
    folder.write(&table.file, |out| table.write_csv(out))
}

/// Writes the page of a document, its figures, and both as data.
pub fn write_page(
    folder: &OutputFolder,
    document: Document,
    figures: Vec<Figure>,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    write_record(folder, &Page::new(document, figures, folder.manifest()))?;
    // What is drawn is what was kept: drawn again, it is the same.
    read_record::<Page>(folder.path())?.draw(folder, options)
}
