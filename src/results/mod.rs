//! Result files: tables, fields, figures, manifest.

pub mod cea;
pub mod charts;
pub mod convergence;
pub mod cycle;
pub mod cycle_confirmation;
pub mod cycle_fields;
pub mod cycle_figures;
pub mod cycle_stability;
mod drawing;
pub mod figures;
mod folder;
mod framed;
pub mod identification;
mod manifest;
mod mesh;
mod npz;
mod parameter;
mod record;
mod reopening;
pub mod report;
mod response;
pub mod run_figures;
pub mod signal;
pub mod sweep;
pub mod sweep_figures;
mod table;
pub mod transient;
mod vtu;

pub use drawing::{
    DOTS_PER_INCH, DrawingError, DrawingOptions, FigureFile, Format, figure_files, write_figures,
    write_report,
};
pub use folder::{FolderError, OutputFolder, Replace};
pub use manifest::Manifest;
pub use mesh::{MeshStatistics, write_mesh, write_mesh_picture};
pub use record::{Record, read_record, write_record};
pub use reopening::{read_manifest, read_summary};
pub use response::{RESPONSE_TABLE, draw_response_report, write_response};
pub use table::{Table, format_number};
pub use vtu::{EncodedMesh, Field, PvdEntry, cartesian_vectors, write_pvd, write_vtu};
