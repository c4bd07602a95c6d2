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

/// Declares objects of JSON, each a struct: `key: type = "meaning";` is a field, its key and what the reference says of
/// it; `key?: type` is absent where there is none. With a name of columns, `Name, COLUMNS`, each key is a column of
/// files as well and, with a label as in `Always "label" Fixed(2)`, one that people see; without a meaning it is a field
/// alone. Attributes may stand before an object and before a key.
macro_rules! keys {
    (@ $(#[$($meta:tt)+])* $name:ident {
        $($(#[$($own:tt)+])* $key:ident $(?: $option:ty)? $(: $type:ty)? $(= $meaning:literal
            $(, $when:ident $label:literal $format:expr)?)?;)+
    }) => {
        $(#[$($meta)+])*
        #[derive(Clone, Debug, PartialEq, frictionsim_output::Described, serde::Serialize)]
        pub struct $name {$(
            $(#[doc = $meaning])?
            $(#[$($own)+])*
            $(#[serde(skip_serializing_if = "Option::is_none")] #[cfg_attr(any(), key($option))])?
            pub $key: $($type)? $(Option<$option>)?,
        )+}
    };
    (@ $(#[$($meta:tt)+])* $name:ident, $columns:ident {
        $($(#[$($own:tt)+])* $key:ident $(?: $option:ty)? $(: $type:ty)? $(= $meaning:literal
            $(, $when:ident $label:literal $format:expr)?)?;)+
    }) => {
        $crate::finding::keys! { @ $(#[$($meta)+])* $name {
            $($(#[$($own)+])* $key $(?: $option)? $(: $type)? $(= $meaning)?;)+
        }}

        frictionsim_output::columns! {
            pub(crate) $columns: own as $name;
            $($($key: $meaning = own.$key.to_owned() $(, $when $label $format)?;)?)+
        }
    };
    ($($(#[$($meta:tt)+])* $name:ident $(, $columns:ident)? { $($keys:tt)+ })+) => {$(
        $crate::finding::keys! { @ $(#[$($meta)+])* $name $(, $columns)? { $($keys)+ } }
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
