//! `candidates.csv`, `improve.vtu` and `improved.toml`.

use super::front::write_front;
use super::{Candidate, ImproveSummary, State, TargetFields};
use crate::mesh::Mesh;
use crate::results::table::{Cell, Column, write_rows};
use crate::results::vtu::{EncodedMesh, Field, write_vtu};
use crate::results::{FolderError, OutputFolder};

/// Writes the table of candidates, the fields over the mesh, and the keys of the best candidate.
///
/// # Errors
/// Those of the folder.
pub fn write(
    folder: &OutputFolder,
    summary: &ImproveSummary,
    mesh: &Mesh,
    fields: &[TargetFields],
) -> Result<(), FolderError> {
    folder.write("candidates.csv", |out| {
        let of = |state: Option<State>, value: fn(&State) -> Option<f64>| -> Cell {
            state.as_ref().and_then(value).into()
        };
        let growth: fn(&State) -> Option<f64> = |state| state.growth_rate_per_s;
        let critical: fn(&State) -> Option<f64> = |state| state.critical_friction;
        let beside: fn(&State) -> Option<f64> = |state| Some(state.unstable_beside as f64);
        let along = |own: &Candidate, axis: usize| own.direction.map(|d| d[axis]);
        let columns: &[Column<'_, &Candidate>] = &[
            ("rank", &|own| own.rank.into()),
            ("kind", &|own| own.kind.clone().into()),
            ("node", &|own| own.node.into()),
            ("x_m", &|own| own.position_m[0].into()),
            ("y_m", &|own| own.position_m[1].into()),
            ("z_m", &|own| own.position_m[2].into()),
            ("direction_x", &|own| along(own, 0).into()),
            ("direction_y", &|own| along(own, 1).into()),
            ("direction_z", &|own| along(own, 2).into()),
            ("added_mass_kg", &|own| own.added_mass_kg.into()),
            ("first_order_growth_rate_per_s", &|own| own.first_order_growth_rate_per_s.into()),
            ("predicted_growth_rate_per_s", &|own| of(Some(own.predicted), growth)),
            ("predicted_critical_friction", &|own| of(Some(own.predicted), critical)),
            ("confirmed_growth_rate_per_s", &|own| of(own.confirmed, growth)),
            ("confirmed_critical_friction", &|own| of(own.confirmed, critical)),
            ("confirmed_unstable_beside", &|own| of(own.confirmed, beside)),
            ("verdict", &|own| own.verdict.clone().into()),
            ("keys", &|own| own.keys.join("; ").into()),
        ];
        write_rows(out, columns, &summary.candidates)
    })?;
    if !summary.front.is_empty() {
        folder.write("front.csv", |out| write_front(out, &summary.front))?;
    }
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
    })?;
    Ok(())
}
