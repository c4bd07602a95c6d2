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

/// Declares what was found once: `field: type = "meaning", Always "label" Fixed(2);` is a field, a column of files and,
/// with a label, one that people see. Without a meaning it is a field alone.
macro_rules! finding {
    ($(#[$meta:meta])* $name:ident, $columns:ident {
        $($(#[$own:meta])* $field:ident: $type:ty
            $(= $meaning:literal $(, $when:ident $label:literal $format:expr)?)?;)+
    }) => {
        $(#[$meta])*
        pub struct $name {
            $($(#[doc = $meaning])? $(#[$own])* pub $field: $type,)+
        }

        frictionsim_output::columns! {
            pub(crate) $columns: own as $name;
            $($($field: $meaning = own.$field.to_owned() $(, $when $label $format)?;)?)+
        }
    };
}
pub(crate) use finding;

/// Declares objects of JSON, each a struct: `key: type = "meaning";` is a field, its key and what the reference says of
/// it. Attributes may stand before an object and before a key.
macro_rules! keys {
    ($($(#[$meta:meta])* $name:ident {
        $($(#[$($own:tt)+])* $key:ident: $type:ty = $meaning:literal;)+
    })+) => {$(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, frictionsim_output::Described, serde::Serialize)]
        pub struct $name {
            $(#[doc = $meaning] $(#[$($own)+])* pub $key: $type,)+
        }
    )+};
}
pub(crate) use keys;

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
    let page = Page::new(document, figures, folder.manifest());
    write_record(folder, &page)?;
    // What is drawn is what was kept: drawn again, it is the same.
    read_record::<Page>(folder.path())?.draw(folder, options)
}
