//! `improve.vtu` and `improved.toml`.

use super::{ImproveSummary, TargetFields};
use crate::mesh::Mesh;
use crate::results::vtu::{EncodedMesh, Field, write_vtu};
use crate::results::{FolderError, OutputFolder};

/// Writes the fields over the mesh, and the keys of the best candidate.
pub fn write(
    folder: &OutputFolder,
    summary: &ImproveSummary,
    mesh: &Mesh,
    fields: &[TargetFields],
) -> Result<(), FolderError> {
    write_fields(folder, mesh, fields)?;
    let best = summary
        .candidates
        .iter()
        .find(|own| ["silenced", "confirmed"].contains(&own.verdict.as_str()));
    if let Some(best) = best {
        folder.write("improved.toml", |out| {
            writeln!(out, "# {}", best.place())?;
            best.keys.iter().try_for_each(|key| writeln!(out, "{}", key.replacen('=', " = ", 1)))
        })?;
    }
    Ok(())
}

/// Writes the derivatives of each target as fields.
fn write_fields(
    folder: &OutputFolder,
    mesh: &Mesh,
    targets: &[TargetFields],
) -> Result<(), FolderError> {
    let power = if mesh.dimension == 2 { "m2" } else { "m3" };
    let (mut nodal, mut in_elements) = (Vec::new(), Vec::new());
    for own in targets {
        let name = |what: &str, unit: &str| format!("mode_{}_growth_by_{what}_{unit}", own.mode);
        let fields = [
            (name("mass", "1_per_s_kg"), &own.mass),
            (name("spring", "m_per_n_s"), &own.spring),
            (name("dashpot", "m_per_n_s2"), &own.dashpot),
        ];
        nodal.extend(fields.map(|(name, values)| Field::scalars(&name, values.clone())));
        let fields = [
            (name("removal", &format!("1_per_s_{power}")), &own.removal),
            (name("damping", &format!("1_per_s2_{power}")), &own.damping),
        ];
        in_elements.extend(fields.map(|(name, values)| Field::scalars(&name, values.clone())));
    }
    folder.write_bulk("improve.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &nodal, &in_elements)
    })
}
