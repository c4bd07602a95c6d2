//! Results on disk that know whether they are whole: folder, manifest, records.

mod error;
pub(crate) mod folder;
pub(crate) mod framed;
pub(crate) mod lock;
pub(crate) mod manifest;
pub(crate) mod record;
pub(crate) mod reopening;

pub use error::FolderError;
pub use folder::{MESH, OutputFolder, Replace};
pub use manifest::Manifest;
pub use record::{Record, read_record};
pub use reopening::{is_result, read_manifest};
