//! Result files: tables, fields, figures, manifest.

pub mod basin;
pub mod cea;
pub mod charts;
mod common;
pub mod compare;
pub mod convergence;
pub mod cycle;
mod distinct;
mod drawing;
pub mod fit;
pub mod identification;
pub mod improve;
mod keys;
pub mod mac;
pub mod matrices;
pub mod mesh;
mod npz;
mod parameter;
mod prelude;
pub mod reference;
mod report;
mod response;
mod shown_body;
pub mod signal;
mod store;
pub mod summary;
pub mod sweep;
pub mod transient;
pub mod uncertainty;
mod universal;
mod vtu;

use distinct::distinct;
use store::{folder, framed, manifest, record, reopening};

pub use distinct::{grouped, number_ranges, plural, sorted};
pub use drawing::{DOTS_PER_INCH, Declaration, DrawingError, DrawingOptions, Format, declared};
pub use report::{Finding, Page, write_page, write_table, write_tables};
pub use response::{ResponseSummary, response_figure, write_response};
pub use shown_body::{BodyStress, ShownBody};
pub use store::{
    FolderError, MESH, Manifest, OutputFolder, Record, Replace, is_result, read_manifest,
    read_record,
};
pub use summary::{Extent, Head, object, read_summary, summary_of, write_summary};
pub use universal::{write_universal_mesh, write_universal_mode};
pub use vtu::{EncodedMesh, Field, PvdEntry, cartesian_vectors, write_pvd, write_vtu};
