//! Result files: tables, fields, figures, manifest.

pub mod cea;
pub mod cycle;
mod drawing;
pub mod figures;
mod folder;
mod manifest;
mod mesh;
pub mod sweep;
mod table;
mod vtu;

pub use drawing::{DrawingError, Figure, render, write_figure};
pub use folder::{FolderError, OutputFolder, Replace};
pub use manifest::Manifest;
pub use mesh::{MeshStatistics, write_mesh, write_mesh_picture};
pub use table::{Table, format_number};
pub use vtu::{EncodedMesh, Field, PvdEntry, cartesian_vectors, write_pvd, write_vtu};
