//! The case of a folder of results.

use super::Failure;
use crate::case::{Case, MeshBytes, RawCase, RawValue, TableBytes};
use crate::results::{MESH, Manifest};
use frictionsim_bounds::{RESULT, read_file};
use std::path::Path;

/// The case that the manifest of a folder records, overrides included, with the mesh file that the folder holds.
///
/// # Errors
/// Those of the case, if the manifest was edited.
pub fn recorded_case(folder: &Path, manifest: &Manifest) -> Result<Case, Failure> {
    let text = manifest.case_text.as_bytes();
    let mut raw = RawCase::parse(&manifest.case_file, text, &manifest.overrides)?;
    let file = raw.find("mesh.file").map(|item| &item.value);
    if let (Some(RawValue::String(file)), Ok(bytes)) = (file, read_file(&folder.join(MESH), RESULT))
    {
        raw.mesh = Some(MeshBytes::new(file.clone(), bytes));
    }
    for (name, file) in raw.table_files() {
        if let Ok(bytes) = read_file(&folder.join(&name), RESULT) {
            let bytes = bytes.into();
            raw.tables.push(TableBytes { file, bytes });
        }
    }
    Ok(Case::from_raw(raw)?)
}
