//! Result files: tables, fields, figures, manifest.

pub mod cea;
pub mod figures;
mod folder;
mod gallery;
mod manifest;
mod mesh;
pub mod report;
mod table;
mod vtu;

pub use folder::{FolderError, OutputFolder, Replace};
pub use gallery::{GalleryError, PNG_RESOLUTION, write_figures, write_report};
pub use manifest::Manifest;
pub use mesh::{MeshStatistics, write_mesh, write_mesh_picture};
pub use table::{Table, format_number};
pub use vtu::{EncodedMesh, Field, PvdEntry, cartesian_vectors, write_pvd, write_vtu};
