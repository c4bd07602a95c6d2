//! Probes, energies, contact, snapshots, summary.

use super::contact::encode_contact;
use super::{TransientReport, summary};
use crate::fem::nodal_stress;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::record::write_record;
use crate::results::table::{Table, format_number};
use crate::results::vtu::{EncodedMesh, Field, PvdEntry, write_pvd, write_vtu};
use crate::transient::{Recorder, SampleRow, Snapshot};
use serde_json::Value;
use std::io::{self, Write};

/// Writes all files of the transient and returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &TransientReport<'_>) -> Result<Value, FolderError> {
    for (probe, rows) in report.record.probes.iter().zip(&report.record.probe_rows) {
        folder.write(&format!("probe-{probe}.csv"), |out| {
            write_probe(out, &report.record.rows, rows)
        })?;
    }
    folder.write("energy.csv", |out| write_energy(out, report))?;
    folder.write("contact.csv", |out| write_contact(out, &report.record.rows))?;
    folder.write("harmonics.csv", |out| write_harmonics(out, report.record))?;
    folder.write("contact.npz", |out| {
        out.write_all(&encode_contact(report.record)?)
    })?;
    write_snapshots(folder, report)?;
    write_record(folder, report.record)?;
    let summary = summary(report, folder.manifest());
    folder.write("summary.json", |out| {
        serde_json::to_writer_pretty(&mut *out, &summary)?;
        out.write_all(b"\n")
    })?;
    Ok(summary)
}

fn write_probe(out: &mut dyn Write, samples: &[SampleRow], rows: &[[f64; 6]]) -> io::Result<()> {
    let columns = [
        "time_s",
        "u_r_m",
        "u_theta_m",
        "v_r_m_per_s",
        "v_theta_m_per_s",
        "a_r_m_per_s2",
        "a_theta_m_per_s2",
    ];
    let mut table = Table::new(out, &columns)?;
    for (sample, row) in samples.iter().zip(rows) {
        let [u_r, u_t, v_r, v_t, a_r, a_t] = *row;
        table.numbers(&[sample.time, u_r, u_t, v_r, v_t, a_r, a_t])?;
    }
    table.finish()
}

fn write_energy(out: &mut dyn Write, report: &TransientReport<'_>) -> io::Result<()> {
    let columns = [
        "time_s",
        "kinetic_j",
        "strain_j",
        "external_w",
        "stick_w",
        "slide_w",
        "contact_dissipated_w",
        "material_damping_w",
        "normal_contact_w",
        "balance_residual",
    ];
    let mut table = Table::new(out, &columns)?;
    for row in &report.record.rows {
        let powers = row.powers.scaled(report.thickness);
        table.numbers(&[
            row.time,
            report.thickness * row.kinetic_energy,
            report.thickness * row.strain_energy,
            powers.external,
            powers.stick,
            powers.slide,
            powers.contact_dissipated,
            report.thickness * row.material_damping,
            powers.normal,
            row.balance_residual,
        ])?;
    }
    table.finish()
}

fn write_contact(out: &mut dyn Write, rows: &[SampleRow]) -> io::Result<()> {
    let mut table = Table::new(out, &["time_s", "stick", "slip", "open"])?;
    for row in rows {
        let [stick, slip, open] = row.counts.fractions();
        table.numbers(&[row.time, stick, slip, open])?;
    }
    table.finish()
}

/// Complex amplitude of each harmonic of the contact edge's tangential displacement: `n = 0..=8`, and of the higher
/// ones those that matter.
fn write_harmonics(out: &mut dyn Write, record: &Recorder) -> io::Result<()> {
    let harmonics = record.significant_harmonics();
    let parts = harmonics
        .iter()
        .flat_map(|n| [format!("n{n}_real_m"), format!("n{n}_imaginary_m")]);
    let columns: Vec<String> = std::iter::once("time_s".to_owned()).chain(parts).collect();
    let names: Vec<&str> = columns.iter().map(String::as_str).collect();
    let mut table = Table::new(out, &names)?;
    for (sample, row) in record.rows.iter().enumerate() {
        let amplitudes = harmonics
            .iter()
            .filter_map(|&n| record.amplitude(sample, n));
        let parts = amplitudes.flatten();
        table.row(std::iter::once(row.time).chain(parts).map(format_number))?;
    }
    table.finish()
}

/// One VTU for each snapshot and `snapshots.pvd` over them.
fn write_snapshots(folder: &OutputFolder, report: &TransientReport<'_>) -> Result<(), FolderError> {
    let snapshots = &report.record.snapshots;
    if snapshots.is_empty() {
        return Ok(());
    }
    let mut encoded = None;
    let mut entries = Vec::new();
    for (index, snapshot) in snapshots.iter().enumerate() {
        let name = format!("snapshots/snapshot-{:03}.vtu", index + 1);
        let fields = snapshot_fields(report, snapshot);
        folder.write(&name, |out| {
            if encoded.is_none() {
                encoded = Some(EncodedMesh::new(report.mesh)?);
            }
            match &encoded {
                Some(mesh) => write_vtu(out, mesh, &fields, &[]),
                None => Ok(()),
            }
        })?;
        entries.push(PvdEntry {
            time: snapshot.time,
            group: String::new(),
            file: name,
        });
    }
    folder.write("snapshots.pvd", |out| write_pvd(out, &entries))?;
    Ok(())
}

fn snapshot_fields(report: &TransientReport<'_>, snapshot: &Snapshot) -> [Field; 7] {
    let stresses = nodal_stress(report.mesh, report.material, &snapshot.displacement);
    let stress = |name: &str, of: fn(&crate::fem::NodalStress) -> f64| {
        Field::scalars(name, stresses.iter().map(of).collect())
    };
    [
        Field::vectors("displacement", report.mesh, &snapshot.displacement),
        Field::vectors("velocity", report.mesh, &snapshot.velocity),
        stress("von_mises_pa", |s| s.von_mises()),
        stress("pressure_pa", |s| s.pressure()),
        stress("stress_rr_pa", |s| s.radial),
        stress("stress_tt_pa", |s| s.hoop),
        stress("stress_rt_pa", |s| s.shear),
    ]
}
