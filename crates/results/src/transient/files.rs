//! Probes, energies, contact, snapshots, summary.

use super::{RecordedRun, TransientSummary, summary};
use crate::common::*;
use crate::{charts::palette::status_of_code, npz::NpzArchive, record::write_record};
use frictionsim_output::csv::{self, format_number};

/// Writes all files of the transient and gives the summary, as it is and as an object.
pub fn write(
    folder: &OutputFolder,
    run: &RecordedRun<'_>,
) -> Result<(TransientSummary, Value), FolderError> {
    let record = &run.solved.record;
    for probe in 0..record.probe_rows.len() {
        let name = format!("probe-{}.csv", run.probe_label(probe));
        folder.write(&name, |out| write_probe(out, run, probe))?;
    }
    folder.write("energy.csv", |out| write_energy(out, run))?;
    folder.write("contact.csv", |out| write_rows(out, STATUS, record.rows.iter().copied()))?;
    if run.has_harmonics {
        folder.write("harmonics.csv", |out| write_harmonics(out, record))?;
    }
    folder.write("contact.npz", |out| out.write_all(&encode_contact(record)?))?;
    write_snapshots(folder, run)?;
    write_record(folder, record)?;
    let summary = summary(run);
    let object = write_summary(folder, run.head, &summary)?;
    Ok((summary, object))
}

/// Names of columns, and their numbers at a sample.
type Group<'a> = (Vec<String>, Box<dyn Fn(usize) -> Vec<f64> + 'a>);

/// Motion of a probe; the accelerations are means since the last sample, those of the sampled step alone come behind
/// them where they are kept, and motions along `x` and `y` last.
fn write_probe(out: &mut dyn io::Write, run: &RecordedRun<'_>, probe: usize) -> io::Result<()> {
    let record = &run.solved.record;
    let (rows, axial) = (&record.probe_rows[probe], record.axial_rows.get(probe));
    let motions = |axes: &[&str]| -> Vec<String> {
        let kinds = [("u", "m"), ("v", "m_per_s"), ("a", "m_per_s2")].iter();
        kinds
            .flat_map(|(kind, unit)| axes.iter().map(move |axis| format!("{kind}_{axis}_{unit}")))
            .collect()
    };
    let axes = if run.body.is_assembly() { ["x", "y"] } else { ["r", "theta"] };
    let mut groups: Vec<Group<'_>> = vec![
        (vec!["time_s".to_owned()], Box::new(|i| vec![record.rows[i].time])),
        (motions(&axes), Box::new(|i| rows[i].to_vec())),
    ];
    if let Some(axial) = axial {
        groups.push((motions(&["z"]), Box::new(|i| axial[i][..3].to_vec())));
    }
    if let Some(raw) = &record.raw_accelerations {
        let axes = axes.into_iter().chain(axial.map(|_| "z"));
        let names = axes.map(|axis| format!("a_{axis}_step_m_per_s2")).collect();
        let step = move |i: usize| raw[probe][i].into_iter().chain(axial.map(|rows| rows[i][3]));
        groups.push((names, Box::new(move |i| step(i).collect())));
    }
    // Of a plane body that is no annulus about the origin.
    if !run.body.is_solid() && !run.body.mesh.is_cyclic {
        let (sin, cos) = run.body.mesh.frame_angles()[record.probes[probe] - 1].sin_cos();
        let along = move |i: usize, k: usize| {
            let [own, other] = [rows[i][k], rows[i][k + 1]];
            [cos * own - sin * other, sin * own + cos * other]
        };
        let turned = move |i: usize| [0, 2, 4].map(|k| along(i, k)).as_flattened().to_vec();
        groups.push((motions(&["x", "y"]), Box::new(turned)));
    }
    let names: Vec<&str> = groups.iter().flat_map(|own| &own.0).map(String::as_str).collect();
    let cells = |i: usize| groups.iter().flat_map(move |own| own.1(i)).map(format_number);
    csv::write(out, &names, (0..rows.len()).map(cells))
}

columns! {
    /// Energies (J) and powers (W) of a sample; the last three of contacts with springs or dashpots, or under pressure.
    pub(crate) ENERGY: row as SampleRow;
    time_s: "time" = row.time;
    kinetic_j: "kinetic energy" = row.kinetic_energy;
    strain_j: "strain energy" = row.strain_energy;
    external_w: "power of the drive, mean over the sample interval, as the others" = row.powers.external;
    stick_w: "power given to the body by nodes that stick" = row.powers.stick;
    slide_w: "power given to the body by nodes that slide" = row.powers.slide;
    contact_dissipated_w: "power lost to friction" = row.powers.contact_dissipated;
    material_damping_w: "power lost in the body" = row.material_damping;
    normal_contact_w: "power of the normal contact forces" = row.powers.normal;
    balance_residual: "residual of the energy balance, relative to the largest energy or work so far"
        = row.balance_residual;
    contact_j: "energy in the springs of the contact" = row.contact_energy;
    contact_damping_w: "power lost in the dashpots of the contact" = row.powers.damping;
    pressure_w: "power of the pressures on boundaries" = row.powers.pressure;

    /// The contact at a sample.
    pub(crate) STATUS: row as SampleRow;
    time_s: "time" = row.time;
    stick: "fraction of the contact nodes that stick" = row.counts.fractions()[0];
    slip: "fraction that slips" = row.counts.fractions()[1];
    open: "fraction that is open" = row.counts.fractions()[2];
}

fn write_energy(out: &mut dyn io::Write, run: &RecordedRun<'_>) -> io::Result<()> {
    let (record, thickness) = (&run.solved.record, run.thickness);
    let of_whole_thickness = |row: &SampleRow| SampleRow {
        kinetic_energy: thickness * row.kinetic_energy,
        strain_energy: thickness * row.strain_energy,
        contact_energy: thickness * row.contact_energy,
        powers: row.powers.scaled(thickness),
        material_damping: thickness * row.material_damping,
        ..*row
    };
    let columns = match (record.has_pressures(), record.has_contact_springs()) {
        (true, _) => ENERGY,
        (false, true) => const { parted(ENERGY, "pressure_w").0 },
        (false, false) => const { parted(ENERGY, "contact_j").0 },
    };
    write_rows(out, columns, record.rows.iter().map(of_whole_thickness))
}

/// Complex amplitude of each harmonic of the contact edge's tangential displacement: `n = 0..=8`, and of the higher
/// ones those that matter.
fn write_harmonics(out: &mut dyn io::Write, record: &Recorder) -> io::Result<()> {
    let harmonics = record.significant_harmonics();
    let parts =
        harmonics.iter().flat_map(|n| [format!("n{n}_real_m"), format!("n{n}_imaginary_m")]);
    let columns: Vec<String> = std::iter::once("time_s".to_owned()).chain(parts).collect();
    let names: Vec<&str> = columns.iter().map(String::as_str).collect();
    let cells = |(sample, row): (usize, &SampleRow)| {
        let parts = harmonics.iter().flat_map(|&n| {
            let parts = record.amplitude(sample, n).into_iter().flatten();
            parts.map(move |part| match n < row.harmonics.len() {
                true => format_number(part),
                // The higher ones are kept in single precision.
                false => format!("{:?}", part as f32 + 0.0),
            })
        });
        std::iter::once(format_number(row.time)).chain(parts).collect::<Vec<_>>()
    };
    csv::write(out, &names, record.rows.iter().enumerate().map(cells))
}

/// `contact.npz`, the contact edge over time, node by node: the arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)`,
/// `pressure_pa (F, N)` and `shear_pa (F, N)` for `F` frames and `N` contact nodes, as NumPy reads them; the numbers
/// `interval_s` between frames, and `status_open` (0), `status_stick` (1), `status_slip` (2), which say what the codes
/// of `status` mean. A body in three dimensions has `shear_across_pa (F, N)` too, along `e_z` on its inner edge and
/// `e_r` on its top.
///
/// A frame is the state of one step; frames may lie several samples apart.
fn encode_contact(record: &Recorder) -> io::Result<Vec<u8>> {
    let mut archive = NpzArchive::default();
    let frames = &record.frames;
    let shape = [frames.len(), record.contact_angles.len()];
    archive.array("time_s", &shape[..1], frames.iter().map(|f| f.time))?;
    archive.array("angle_rad", &shape[1..], record.contact_angles.iter().copied())?;
    archive.array("status", &shape, frames.iter().flat_map(|f| f.status.iter().copied()))?;
    archive.array("pressure_pa", &shape, frames.iter().flat_map(|f| f.pressure.iter().copied()))?;
    archive.array("shear_pa", &shape, frames.iter().flat_map(|f| f.shear().iter().copied()))?;
    if frames.iter().any(|frame| !frame.shear_across().is_empty()) {
        let across = frames.iter().flat_map(|f| f.shear_across().iter().copied());
        archive.array("shear_across_pa", &shape, across)?;
    }
    let interval = record.frame_stride as f64 * record.sample_interval;
    archive.array("interval_s", &[], std::iter::once(interval))?;
    archive.status_codes()?;
    archive.finish()
}

/// One VTU for each snapshot and `snapshots.pvd` over them.
fn write_snapshots(folder: &OutputFolder, run: &RecordedRun<'_>) -> Result<(), FolderError> {
    let snapshots = &run.solved.record.snapshots;
    if snapshots.is_empty() {
        return Ok(());
    }
    let mesh = run.body.encoded();
    let mesh = mesh.map_err(|error| FolderError::io("write", folder.path(), error))?;
    let mut entries = Vec::new();
    for (index, snapshot) in snapshots.iter().enumerate() {
        let file = format!("snapshots/snapshot-{:03}.vtu", index + 1);
        let fields = snapshot_fields(run, snapshot);
        let whole = [("time_s", snapshot.time), ("friction_coefficient", run.friction_coefficient)];
        folder.write(&file, |out| write_vtu(out, &mesh, &whole, &fields, &[]))?;
        entries.push(PvdEntry { time: snapshot.time, group: String::new(), file });
    }
    folder.write("snapshots.pvd", |out| write_pvd(out, &entries))
}

/// Motion and stress of all nodes, and the contact at the same step: status (0 open, 1 stick, 2 slip; -1 off the
/// contact edge), pressure, shear and gap (zero off the contact edge).
fn snapshot_fields(run: &RecordedRun<'_>, snapshot: &Snapshot) -> Vec<Field> {
    let (body, displacement) = (&run.body, &snapshot.displacement);
    let mut fields = vec![
        body.vectors("displacement_m", displacement),
        body.vectors("velocity_m_per_s", &snapshot.velocity),
    ];
    fields.extend(body.stress_fields(&body.stress(run.material, displacement)));
    let (count, contact) = (displacement.len() / body.dimension(), &snapshot.contact);
    let edge = || run.interface.nodes.iter().copied();
    let states = edge().zip(&contact.status).zip(contact.pressure.iter().zip(contact.shear()));
    fields.extend(Field::contact(
        count,
        states.map(|((node, &code), (&pressure, &shear))| {
            (node, status_of_code(code), [pressure, shear].map(f64::from))
        }),
    ));
    // In three dimensions friction may act across the sliding too.
    if !contact.shear_across().is_empty() {
        let across = contact.shear_across().iter().copied().map(f64::from);
        fields.push(Field::on_edge("shear_across_pa", count, edge().zip(across)));
    }
    fields.push(Field::on_edge("gap_m", count, edge().zip(snapshot.gap.iter().copied())));
    fields
}
