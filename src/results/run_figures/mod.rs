//! The figures of a transient, from its record.

mod signals;

use super::drawing::{FigureJob, draw_figures};
use super::figures::axis::extremes;
use super::figures::{
    ContactState, ContactTrace, EnergyFlows, FigureError, PhasePlot, ReferenceFrequency, Snapshot,
    Snapshots, Stage, Trajectories, draw_contact_state, draw_energy_flows, draw_snapshots,
    draw_trajectories,
};
use super::report::NamedFigure;
use crate::contact::ContactStatus;
use crate::fem::{ElasticMaterial, nodal_stress};
use crate::mesh::Mesh2d;
use crate::transient::{ContactFrame, EndState, Recorder, SampleRow, TransientAnalysis};
use signals::{acceleration, component, growth, overview, spectrum, stages};

/// Whole-field pictures of one kind, at most.
const FIELD_LIMIT: usize = 8;

/// A run and what its figures show besides.
#[derive(Clone, Debug)]
pub struct RunFigures<'a> {
    /// The record.
    pub record: &'a Recorder,
    /// What was read from it.
    pub analysis: &'a TransientAnalysis,
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// The material, for the stress fields.
    pub material: &'a ElasticMaterial,
    /// Thickness, m: the record is for each metre.
    pub thickness: f64,
    /// Peripheral speed of the cylinder, m/s.
    pub peripheral_speed: f64,
    /// Modes of the eigenvalue analysis drawn across spectrograms and spectra.
    pub references: Vec<ReferenceFrequency>,
    /// Harmonic and growth rate (1/s) of its unstable modes.
    pub growth_rates: Vec<(usize, f64)>,
}

/// Draws every figure that the record has data for.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_run(data: &RunFigures<'_>) -> Result<Vec<NamedFigure>, FigureError> {
    let series = Series::of(data);
    let series = &series;
    let mut jobs: Vec<FigureJob<'_>> = Vec::new();
    for (index, node) in data.record.probes.iter().enumerate() {
        jobs.push((
            format!("overview-{node}"),
            format!(
                "Course of the run at node {node}: acceleration, spectrograms with the frequencies of \
                 the eigenvalue analysis, contact status; at the right the end of the run."
            ),
            Box::new(move || overview(data, series, index)),
        ));
        jobs.push((
            format!("spectrum-{node}"),
            format!("Spectrum of the acceleration of node {node} over the last fifth of the run."),
            Box::new(move || spectrum(data, series, index)),
        ));
    }
    jobs.push((
        "growth".into(),
        "Growth of the harmonics of the tangential displacement of the contact edge, with the rates \
         of the eigenvalue analysis."
            .into(),
        Box::new(move || growth(data, series)),
    ));
    jobs.push((
        "velocity".into(),
        "Velocity modulus and contact status at the snapshot times.".into(),
        Box::new(move || velocity_fields(data)),
    ));
    jobs.push((
        "shear-stress".into(),
        "Shear stress at the snapshot times.".into(),
        Box::new(move || stress_fields(data)),
    ));
    jobs.push((
        "trajectories".into(),
        "Phase plot of an internal node (a) and path of a contact node (b).".into(),
        Box::new(move || trajectories(data)),
    ));
    jobs.push((
        "contact".into(),
        "Contact at the last snapshot: status around the circle (a), tractions (b), velocity (c)."
            .into(),
        Box::new(move || contact_state(data)),
    ));
    jobs.push((
        "energy".into(),
        "Energy flows: acceleration, status, external power and its parts, power balance of the \
         body, stored energy, residual of the balance."
            .into(),
        Box::new(move || energy(data, series)),
    ));
    draw_figures(jobs)
}

/// Columns of the record that several figures share.
struct Series {
    times: Vec<f64>,
    frame_times: Vec<f64>,
    status: Vec<ContactStatus>,
    stages: Vec<Stage>,
}

impl Series {
    fn of(data: &RunFigures<'_>) -> Self {
        let record = data.record;
        let status = |frame: &ContactFrame| statuses(frame);
        Self {
            times: record.rows.iter().map(|row| row.time).collect(),
            frame_times: record.frames.iter().map(|frame| frame.time).collect(),
            status: record.frames.iter().flat_map(status).collect(),
            stages: stages(record, data.analysis),
        }
    }

    /// Time between samples, s; zero for fewer than two.
    fn interval(&self) -> f64 {
        match self.times.len() {
            0 | 1 => 0.0,
            count => (self.times[count - 1] - self.times[0]) / (count - 1) as f64,
        }
    }
}

fn statuses(frame: &ContactFrame) -> Vec<ContactStatus> {
    let named = |&code: &u8| match code {
        1 => ContactStatus::Stick,
        2 => ContactStatus::Slip,
        _ => ContactStatus::Open,
    };
    frame.status.iter().map(named).collect()
}

fn velocity_fields(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let snapshots = || data.record.snapshots.iter().take(FIELD_LIMIT);
    // What is that much slower than the cylinder is round-off of a body at rest.
    let rest = 1e-9 * data.peripheral_speed.abs();
    let modulus = |v: &[f64]| Some(v[0].hypot(v[1])).filter(|&speed| speed > rest);
    let fields: Vec<Vec<f64>> = snapshots()
        .map(|snapshot| {
            let pairs = snapshot.velocity.chunks_exact(2);
            pairs.map(|v| modulus(v).unwrap_or(0.0)).collect()
        })
        .collect();
    let status: Vec<Vec<ContactStatus>> = snapshots()
        .map(|snapshot| statuses(&snapshot.contact))
        .collect();
    let frames = snapshots().zip(fields.iter().zip(&status));
    draw_snapshots(&Snapshots {
        name: "velocity",
        quantity: "velocity modulus |*v*| (m/s)".into(),
        signed: false,
        mesh: data.mesh,
        frames: frames
            .map(|(snapshot, (field, status))| {
                Snapshot::at_time(snapshot.time, field, Some(status))
            })
            .collect(),
    })
}

fn stress_fields(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let snapshots = || data.record.snapshots.iter().take(FIELD_LIMIT);
    let fields: Vec<Vec<f64>> = snapshots()
        .map(|snapshot| {
            let stress = nodal_stress(data.mesh, data.material, &snapshot.displacement);
            stress.iter().map(|node| node.shear * 1e-6).collect()
        })
        .collect();
    draw_snapshots(&Snapshots {
        name: "shear-stress",
        quantity: "shear stress *τ*_{rθ} (MPa)".into(),
        signed: true,
        mesh: data.mesh,
        frames: snapshots()
            .zip(&fields)
            .map(|(snapshot, field)| Snapshot::at_time(snapshot.time, field, None))
            .collect(),
    })
}

/// Position of a probe on the contact edge.
fn contact_position(data: &RunFigures<'_>, probe: usize) -> Option<usize> {
    let node = data.record.probes[probe] - 1;
    let mut edge = data.mesh.inner_edge.nodes.iter();
    edge.position(|&other| other as usize == node)
}

fn trajectories(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let record = data.record;
    let nothing = |what: &str| FigureError::Empty { what: what.into() };
    let probes = || 0..record.probes.len();
    let inside = probes()
        .find(|&probe| contact_position(data, probe).is_none())
        .ok_or_else(|| nothing("probe inside the body"))?;
    let edge = probes()
        .find(|&probe| contact_position(data, probe).is_some())
        .ok_or_else(|| nothing("probe on the contact edge"))?;
    let column = |probe: usize, column: usize| -> Vec<f64> {
        record.probe_rows[probe]
            .iter()
            .map(|row| row[column])
            .collect()
    };
    let (name, offset) = component(record, inside);
    let (displacement, velocity) = (column(inside, offset), column(inside, 2 + offset));
    let (radial, tangential) = (column(edge, 0), column(edge, 1));
    let cycle_start = radial.len() - radial.len().div_ceil(5);
    let status = traced_status(&record.probe_rows[edge], cycle_start, data.peripheral_speed);
    draw_trajectories(&Trajectories {
        phase: PhasePlot {
            name: format!("node {}, {name}", record.probes[inside]),
            displacement: &displacement,
            velocity: &velocity,
        },
        trace: ContactTrace {
            name: format!("contact node {}", record.probes[edge]),
            tangential: &tangential,
            radial: &radial,
            status: Some(&status),
        },
        cycle_start,
        end_name: match data.analysis.settling.state {
            EndState::LimitCycle => "limit cycle",
            _ => "last fifth of the run",
        },
    })
}

/// Status of a contact node at every sample, from its motion: off the cylinder it is open, with the
/// cylinder's velocity it sticks. Finer in time than the contact frames; from `cycle_start` on, where the
/// node touches the cylinder at its smallest radial displacement.
fn traced_status(
    rows: &[[f64; 6]],
    cycle_start: usize,
    peripheral_speed: f64,
) -> Vec<ContactStatus> {
    let (low, high) = extremes(rows[cycle_start..].iter().map(|row| row[0]));
    let distance = 1e-6 * low.abs().max(high.abs());
    let slowness = 1e-6 * peripheral_speed.abs().max(f64::MIN_POSITIVE);
    rows.iter()
        .map(|row| {
            if row[0] - low > distance {
                ContactStatus::Open
            } else if (row[3] - peripheral_speed).abs() <= slowness {
                ContactStatus::Stick
            } else {
                ContactStatus::Slip
            }
        })
        .collect()
}

fn contact_state(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let record = data.record;
    let Some(snapshot) = record.snapshots.last() else {
        return Err(FigureError::Empty {
            what: "snapshots".into(),
        });
    };
    let frame = &snapshot.contact;
    let wide = |values: &[f32]| values.iter().map(|&v| f64::from(v)).collect::<Vec<f64>>();
    let edge = data.mesh.inner_edge.nodes.iter();
    let velocity: Vec<f64> = edge
        .map(|&node| snapshot.velocity[2 * node as usize + 1])
        .collect();
    draw_contact_state(&ContactState {
        name: format!("*t* = {:.3} ms", snapshot.time * 1e3),
        angles: &record.contact_angles,
        status: &statuses(frame),
        pressure: &wide(&frame.pressure),
        shear: &wide(&frame.shear),
        tangential_velocity: &velocity,
        peripheral_speed: data.peripheral_speed,
    })
}

fn energy(data: &RunFigures<'_>, series: &Series) -> Result<String, FigureError> {
    let (rows, thickness) = (&data.record.rows, data.thickness);
    let column = |of: &dyn Fn(&SampleRow) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let scaled = |of: &dyn Fn(&SampleRow) -> f64| column(&|row| thickness * of(row));
    let [stick, slip, open] = [0, 1, 2].map(|which| column(&|row| row.counts.fractions()[which]));
    let (signal_name, acceleration) = match data.record.probes.len() {
        0 => (String::new(), vec![0.0; rows.len()]),
        count => {
            let inside = (0..count).find(|&probe| contact_position(data, probe).is_none());
            acceleration(data.record, inside.unwrap_or(0))
        }
    };
    draw_energy_flows(&EnergyFlows {
        times: &series.times,
        external: &scaled(&|row| row.powers.external),
        stick: &scaled(&|row| row.powers.stick),
        slide: &scaled(&|row| row.powers.slide),
        contact_dissipated: &scaled(&|row| row.powers.contact_dissipated),
        material_damping: &scaled(&|row| row.material_damping),
        normal_contact: &scaled(&|row| row.powers.normal),
        kinetic: &scaled(&|row| row.kinetic_energy),
        strain: &scaled(&|row| row.strain_energy),
        balance_residual: &column(&|row| row.balance_residual),
        status: [&stick, &slip, &open],
        signal_name,
        signal_times: &series.times,
        acceleration: &acceleration,
        averaging_time: 5e-4,
    })
}
