//! Tables, arrays and fields of one limit cycle.

use super::{FoundCycle, PeriodicReport};
use crate::contact::{ContactInterface, ContactStatus};
use crate::cycle::periodic::{
    BranchMotion, ContactInstant, FloquetMultiplier, FloquetMultipliers, MotionFrame,
    MotionHarmonic, PeriodicBranch, PeriodicMotion, PeriodicPowers,
};
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::npz::NpzArchive;
use crate::results::pvd::{PvdEntry, write_pvd};
use crate::results::table::{Column, write_rows};
use crate::results::vtu::{EncodedMesh, Field, solid_vectors, write_vtu};
use std::f64::consts::TAU;
use std::io::{self, Write};

/// Writes everything of one cycle under its tag.
///
/// # Errors
/// Those of the folder.
pub fn write(
    folder: &OutputFolder,
    report: &PeriodicReport<'_>,
    tag: &str,
    found: &FoundCycle,
) -> Result<(), FolderError> {
    let motion = &found.motion;
    folder.write(&format!("cycle-{tag}.csv"), |out| write_history(out, motion))?;
    folder.write(&format!("contact-{tag}.csv"), |out| write_contact(out, report, motion))?;
    let archive = |out: &mut dyn Write| out.write_all(&encode_contact(&report.interface, motion)?);
    folder.write_bulk(&format!("contact-{tag}.npz"), archive)?;
    folder.write(&format!("harmonics-{tag}.csv"), |out| {
        write_harmonics(out, motion, found.harmonic_count)
    })?;
    if let Some(Ok(multipliers)) = &found.stability {
        folder.write(&format!("stability-{tag}.csv"), |out| write_multipliers(out, multipliers))?;
    }
    if let Some(branch) = &found.branch {
        folder.write(&format!("branch-{tag}.csv"), |out| {
            write_branch(out, branch, report.thickness)
        })?;
    }
    write_fields(folder, report, tag, motion)
}

/// One row for each cycle of a branch, in its order.
fn write_branch(out: &mut dyn Write, branch: &PeriodicBranch, thickness: f64) -> io::Result<()> {
    type Row<'a> = (&'a BranchMotion, PeriodicPowers);
    let parameter = branch.parameter;
    let columns: &[Column<'_, Row<'_>>] = &[
        (parameter.key(), &|row| parameter.in_key_units(row.0.value).into()),
        ("main_frequency_hz", &|row| row.0.motion.frequency_hz.into()),
        ("stick", &|row| row.0.motion.fractions[0].into()),
        ("slip", &|row| row.0.motion.fractions[1].into()),
        ("open", &|row| row.0.motion.fractions[2].into()),
        ("external_w", &|row| row.1.contact.external.into()),
        ("stick_w", &|row| row.1.contact.stick.into()),
        ("slide_w", &|row| row.1.contact.slide.into()),
        ("contact_dissipated_w", &|row| row.1.contact.contact_dissipated.into()),
        ("material_damping_w", &|row| row.1.material_damping.into()),
        ("normal_contact_w", &|row| row.1.contact.normal.into()),
        ("amplitude_m", &|row| row.0.motion.amplitude.into()),
        ("velocity_level_db", &|row| row.0.motion.velocity_level().into()),
        ("balance_residual", &|row| row.1.balance_residual().into()),
        ("growth_rate_per_s", &|row| row.0.growth_rate().unwrap_or(f64::NAN).into()),
        ("stability", &|row| {
            let known = row.0.stability.as_ref().and_then(|found| found.as_ref().ok());
            known.map_or("", |found| found.verdict().word()).into()
        }),
        ("residual", &|row| row.0.motion.residual.into()),
        ("periods", &|row| row.0.motion.periods.into()),
        ("fold", &|row| row.0.is_fold.into()),
    ];
    let rows = branch.motions.iter();
    let rows = rows.map(|own| (own, own.motion.powers.scaled(thickness)));
    write_rows(out, columns, rows)
}

/// Contact and motion over the period of the contact node that moves most.
fn write_history(out: &mut dyn Write, motion: &PeriodicMotion) -> io::Result<()> {
    let node = motion.node;
    let columns: &[Column<'_, &ContactInstant>] = &[
        ("phase_rad", &|at| (TAU * at.time * motion.frequency_hz).into()),
        ("time_s", &|at| at.time.into()),
        ("status", &|at| at.status[node].name().into()),
        ("pressure_pa", &|at| at.pressure[node].into()),
        ("shear_pa", &|at| at.shear[node].into()),
        ("u_n_m", &|at| at.displacement[node][0].into()),
        ("u_t_m", &|at| at.displacement[node][1].into()),
        ("v_n_m_per_s", &|at| at.velocity[node][0].into()),
        ("v_t_m_per_s", &|at| at.velocity[node][1].into()),
    ];
    write_rows(out, columns, &motion.instants)
}

/// Means and amplitudes of every contact node, in the order of the edge.
fn write_contact(
    out: &mut dyn Write,
    report: &PeriodicReport<'_>,
    motion: &PeriodicMotion,
) -> io::Result<()> {
    let interface = &report.interface;
    let instants = &motion.instants;
    let mean = |values: &dyn Fn(&ContactInstant) -> f64| {
        instants.iter().map(values).sum::<f64>() / instants.len() as f64
    };
    let half_range = |values: &dyn Fn(&ContactInstant) -> f64| {
        let values = instants.iter().map(values);
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = values.fold(ends, |[low, high], v| [low.min(v), high.max(v)]);
        0.5 * (high - low)
    };
    let point = |i: usize| report.position(interface.nodes[i]);
    let columns: &[Column<'_, usize>] = &[
        ("node", &|&i| report.node_label(interface.nodes[i]).into()),
        ("x_m", &|&i| point(i)[0].into()),
        ("y_m", &|&i| point(i)[1].into()),
        ("z_m", &|&i| point(i)[2].into()),
        ("stick", &|&i| motion.shares[i][0].into()),
        ("slip", &|&i| motion.shares[i][1].into()),
        ("open", &|&i| motion.shares[i][2].into()),
        ("mean_pressure_pa", &|&i| mean(&|at| at.pressure[i]).into()),
        ("mean_shear_pa", &|&i| mean(&|at| at.shear[i]).into()),
        ("amplitude_n_m", &|&i| half_range(&|at| at.displacement[i][0]).into()),
        ("amplitude_t_m", &|&i| half_range(&|at| at.displacement[i][1]).into()),
    ];
    let is_written = |column: &&Column<'_, usize>| report.is_solid() || column.0 != "z_m";
    let columns: Vec<_> = columns.iter().filter(is_written).copied().collect();
    write_rows(out, &columns, 0..interface.len())
}

/// The arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)`, `pressure_pa (F, N)`, `shear_pa (F, N)`, `u_n_m (F, N)` and
/// `u_t_m (F, N)` for `F` instants and `N` contact nodes, with the codes of `status`, as in the `contact.npz` of a transient.
fn encode_contact(interface: &ContactInterface, motion: &PeriodicMotion) -> io::Result<Vec<u8>> {
    let instants = &motion.instants;
    let shape = [instants.len(), interface.len()];
    let mut archive = NpzArchive::default();
    archive.array("time_s", &shape[..1], instants.iter().map(|at| at.time))?;
    archive.array("angle_rad", &shape[1..], interface.angles.iter().copied())?;
    let status = instants.iter().flat_map(|at| &at.status);
    archive.array("status", &shape, status.map(|status| *status as u8))?;
    let pressure = instants.iter().flat_map(|at| at.pressure.iter().copied());
    archive.array("pressure_pa", &shape, pressure)?;
    let shear = instants.iter().flat_map(|at| at.shear.iter().copied());
    archive.array("shear_pa", &shape, shear)?;
    for (component, name) in ["u_n_m", "u_t_m"].into_iter().enumerate() {
        let motion = instants.iter().flat_map(|at| &at.displacement);
        archive.array(name, &shape, motion.map(|u| u[component]))?;
    }
    for (name, code) in [
        ("status_open", ContactStatus::Open),
        ("status_stick", ContactStatus::Stick),
        ("status_slip", ContactStatus::Slip),
    ] {
        archive.array(name, &[], std::iter::once(code as u8))?;
    }
    archive.finish()
}

/// The harmonics of the contact nodes, and what they leave.
fn write_harmonics(out: &mut dyn Write, motion: &PeriodicMotion, count: usize) -> io::Result<()> {
    let columns: &[Column<'_, (usize, &MotionHarmonic)>] = &[
        ("harmonic", &|row| row.0.into()),
        ("frequency_hz", &|row| (row.0 as f64 * motion.frequency_hz).into()),
        ("amplitude_n_m", &|row| row.1.amplitude[0].into()),
        ("amplitude_t_m", &|row| row.1.amplitude[1].into()),
        ("remainder", &|row| row.1.remainder.into()),
    ];
    let numbered = motion.harmonics.iter().take(count).enumerate();
    write_rows(out, columns, numbered.map(|(k, harmonic)| (k + 1, harmonic)))
}

/// The leading multipliers, one row each.
fn write_multipliers(out: &mut dyn Write, found: &FloquetMultipliers) -> io::Result<()> {
    let columns: &[Column<'_, &FloquetMultiplier>] = &[
        ("growth_rate_per_s", &|row| row.growth_rate.into()),
        ("beat_hz", &|row| row.beat_hz.into()),
        ("modulus", &|row| row.multiplier.norm().into()),
        ("argument_rad", &|row| row.multiplier.arg().into()),
        ("uncertainty_per_s", &|row| row.uncertainty.into()),
    ];
    write_rows(out, columns, &found.multipliers)
}

/// Each frame as a VTU file and, where there are several, `cycle-TAG.pvd` over the time: motion of all nodes; status, pressure
/// and shear of those of the contact.
fn write_fields(
    folder: &OutputFolder,
    report: &PeriodicReport<'_>,
    tag: &str,
    motion: &PeriodicMotion,
) -> Result<(), FolderError> {
    let mut entries = Vec::new();
    for (i, frame) in motion.frames.iter().enumerate() {
        let name = match i {
            0 => format!("cycle-{tag}.vtu"),
            _ => format!("cycle-{tag}-{i:03}.vtu"),
        };
        folder.write(&name, |out| {
            let whole = [Field::number("time_s", frame.time)];
            let encoded = match report.solid {
                Some(sector) => EncodedMesh::solid(sector)?,
                None => EncodedMesh::new(report.mesh)?,
            };
            write_vtu(out, &encoded, &whole, &frame_fields(report, frame), &[])
        })?;
        entries.push(PvdEntry {
            time: frame.time,
            group: format!("limit cycle of {:.2} Hz", motion.frequency_hz),
            file: name,
        });
    }
    if entries.len() > 1 {
        let name = format!("cycle-{tag}.pvd");
        folder.write(&name, |out| write_pvd(out, &entries))?;
    }
    Ok(())
}

/// The fields of one frame.
fn frame_fields(report: &PeriodicReport<'_>, frame: &MotionFrame) -> [Field; 5] {
    let (nodes, contact) = (&report.interface.nodes, &frame.contact);
    let vectors = |name: &str, values: &[f64]| match report.solid {
        Some(sector) => solid_vectors(name, sector, values),
        None => Field::vectors(name, report.mesh, values),
    };
    let [displacement, velocity] = &frame.fields;
    let count = displacement.len() / report.components();
    let statuses = contact.status.iter().copied();
    [
        vectors("displacement_m", displacement),
        vectors("velocity_m_per_s", velocity),
        Field::status(count, nodes, statuses),
        Field::on_edge("pressure_pa", count, nodes, &contact.pressure),
        Field::on_edge("shear_pa", count, nodes, &contact.shear),
    ]
}
