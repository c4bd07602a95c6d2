//! `improve.vtu` and `improved.toml`.

use super::Improvement;
use crate::vtu::{EncodedMesh, Field, write_vtu};
use crate::{FolderError, OutputFolder};

/// Writes the fields over the mesh, and the keys of the best candidate.
pub fn write(folder: &OutputFolder, found: &Improvement) -> Result<(), FolderError> {
    write_fields(folder, found)?;
    if let Some(best) = found.summary.best() {
        folder.write("improved.toml", |out| {
            writeln!(out, "# {}", best.place())?;
            best.keys.iter().try_for_each(|key| writeln!(out, "{}", key.replacen('=', " = ", 1)))
        })?;
    }
    Ok(())
}

/// Writes the derivatives of each target as fields.
fn write_fields(folder: &OutputFolder, found: &Improvement) -> Result<(), FolderError> {
    let power = if found.mesh.dimension == 2 { "m2" } else { "m3" };
    let (mut nodal, mut in_elements) = (Vec::new(), Vec::new());
    for own in &found.fields {
        let field = |what: &str, unit: &str, values: &[f64]| {
            let name = format!("mode_{}_growth_by_{what}_{unit}", own.mode.mode);
            Field::scalars(&name, values.to_vec())
        };
        nodal.extend([
            field("mass", "1_per_s_kg", &own.mass),
            field("spring", "m_per_n_s", &own.spring),
            field("dashpot", "m_per_n_s2", &own.dashpot),
        ]);
        in_elements.extend([
            field("removal", &format!("1_per_s_{power}"), &own.removal),
            field("damping", &format!("1_per_s2_{power}"), &own.damping),
        ]);
    }
    folder.write_bulk("improve.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(&found.mesh)?, &[], &nodal, &in_elements)
    })
}
