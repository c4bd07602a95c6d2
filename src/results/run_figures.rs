//! The figures of a transient, from its record.

use super::figures::{
    ContactState, ContactTrace, EnergyFlows, FigureError, HarmonicGrowth, PhasePlot,
    PredictedGrowth, ReferenceFrequency, Snapshot, Snapshots, SpectrogramMap, SpectrumPlot, Stage,
    StatusHistory, Trajectories, TransientOverview, draw_contact_state, draw_energy_flows,
    draw_harmonic_growth, draw_snapshots, draw_spectrum, draw_trajectories,
    draw_transient_overview,
};
use super::report::NamedFigure;
use crate::contact::ContactStatus;
use crate::fem::{ElasticMaterial, nodal_stress};
use crate::mesh::Mesh2d;
use crate::signal::{SpectrogramOptions, Window, amplitude_spectrum, spectrogram};
use crate::transient::{ContactFrame, Recorder, SampleRow, TransientAnalysis};
use rayon::prelude::*;

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

type Job<'a> = (
    String,
    String,
    Box<dyn Fn() -> Result<String, FigureError> + Sync + Send + 'a>,
);

/// Draws every figure that the record has data for.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn draw_run(data: &RunFigures<'_>) -> Result<Vec<NamedFigure>, FigureError> {
    let series = Series::of(data);
    let series = &series;
    let mut jobs: Vec<Job<'_>> = Vec::new();
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
    collect(jobs)
}

/// Runs the jobs side by side and keeps what had something to draw, in order.
fn collect(jobs: Vec<Job<'_>>) -> Result<Vec<NamedFigure>, FigureError> {
    let drawn: Vec<_> = jobs
        .into_par_iter()
        .map(|(name, caption, job)| (name, caption, job()))
        .collect();
    let mut figures = Vec::new();
    for (name, caption, drawing) in drawn {
        match drawing {
            Ok(svg) => figures.push(NamedFigure { name, caption, svg }),
            Err(FigureError::Empty { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(figures)
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

/// The stages of a run as figure 8 of the paper letters them: A vibrations of the start die out, B
/// exponential growth, C stick and separation set in, D limit cycle.
///
/// B begins where the strongest harmonic other than zero overtakes the vibration of harmonic zero, D
/// where it stays within 2 % of its last value for good. A run without a linear stage has none.
fn stages(record: &Recorder, analysis: &TransientAnalysis) -> Vec<Stage> {
    let rows = &record.rows;
    let (Some(end), Some(last)) = (analysis.first_nonlinearity, rows.last()) else {
        return Vec::new();
    };
    let size = |row: &SampleRow, n: usize| row.harmonics[n][0].hypot(row.harmonics[n][1]);
    let Some(main) = (1..last.harmonics.len()).max_by(|&a, &b| {
        let [a, b] = [a, b].map(|n| size(last, n));
        a.total_cmp(&b)
    }) else {
        return Vec::new();
    };
    let twist = last.harmonics[0][0];
    let overtaken = rows
        .iter()
        .rposition(|row| row.time < end && size(row, main) < (row.harmonics[0][0] - twist).abs());
    let settled = rows.iter().rposition(|row| {
        let limit = size(last, main);
        (size(row, main) - limit).abs() > 0.02 * limit
    });
    let time_after = |index: Option<usize>| {
        index
            .and_then(|i| rows.get(i + 1))
            .map_or(0.0, |row| row.time)
    };
    let growth = time_after(overtaken);
    let cycle = time_after(settled);
    let mut stages = Vec::new();
    let mut add = |name: &str, start: f64, end: f64| {
        if end > start {
            stages.push(Stage {
                name: name.into(),
                start,
            });
        }
    };
    add("A", rows[0].time, growth);
    add("B", growth.max(rows[0].time), end);
    add("C", end, cycle.max(end));
    add("D", cycle.max(end), last.time);
    stages
}

/// Component of a probe with the larger acceleration over the last fifth: its name and column.
fn component(record: &Recorder, probe: usize) -> (&'static str, usize) {
    let rows = &record.probe_rows[probe];
    let end = &rows[rows.len() - rows.len().div_ceil(5)..];
    let square = |column: usize| end.iter().map(|row| row[column] * row[column]).sum::<f64>();
    if square(4) >= square(5) {
        ("radial", 0)
    } else {
        ("tangential", 1)
    }
}

/// Name and values of the acceleration that a probe is shown by.
fn acceleration(record: &Recorder, probe: usize) -> (String, Vec<f64>) {
    let (name, offset) = component(record, probe);
    let values = record.probe_rows[probe].iter().map(|row| row[4 + offset]);
    let node = record.probes[probe];
    (
        format!("{name} acceleration, node {node}"),
        values.collect(),
    )
}

/// Highest frequency shown: three superharmonics, or all modes drawn.
fn highest_frequency(data: &RunFigures<'_>, interval: f64) -> f64 {
    let main = data.analysis.limit_cycle.main_frequency_hz.unwrap_or(0.0);
    let modes = data.references.iter().map(|mode| mode.frequency_hz);
    let wanted = modes.fold(3.4 * main, |top, f| top.max(1.1 * f));
    let nyquist = 0.5 / interval;
    if wanted > 0.0 {
        wanted.min(nyquist)
    } else {
        nyquist.min(35e3)
    }
}

fn overview(data: &RunFigures<'_>, series: &Series, probe: usize) -> Result<String, FigureError> {
    let (signal_name, signal) = acceleration(data.record, probe);
    let interval = series.interval();
    let top = highest_frequency(data, interval);
    // A run shorter than a window has no spectrogram, and needs none.
    let map = spectrogram(&signal, 1.0 / interval, &SpectrogramOptions::default())
        .ok()
        .map(|map| map.below(1.05 * top))
        .filter(|map| map.times.len() > 1 && map.frequencies_hz.len() > 1);
    let main = data.analysis.limit_cycle.main_frequency_hz;
    draw_transient_overview(&TransientOverview {
        signal_name,
        signal_unit: "m/s²".into(),
        times: &series.times,
        signal: &signal,
        spectrogram: map.as_ref().map(|map| SpectrogramMap {
            times: &map.times,
            frequencies_hz: &map.frequencies_hz,
            amplitude: &map.magnitudes,
        }),
        max_frequency_hz: top,
        references: data.references.clone(),
        status: (series.frame_times.len() > 1).then_some(StatusHistory {
            times: &series.frame_times,
            node_count: data.record.contact_angles.len(),
            status: &series.status,
        }),
        stages: series.stages.clone(),
        enlarged: main.map_or(0.0, |frequency| 4.0 / frequency),
    })
}

fn spectrum(data: &RunFigures<'_>, series: &Series, probe: usize) -> Result<String, FigureError> {
    let (signal_name, signal) = acceleration(data.record, probe);
    let end = &signal[signal.len() - signal.len().div_ceil(5)..];
    let interval = series.interval();
    let spectrum = amplitude_spectrum(end, 1.0 / interval, Window::Hann, 2).map_err(|error| {
        FigureError::Empty {
            what: error.to_string(),
        }
    })?;
    draw_spectrum(&SpectrumPlot {
        signal_name,
        unit: "m/s²".into(),
        frequencies_hz: &spectrum.frequencies_hz,
        amplitude: &spectrum.amplitudes,
        max_frequency_hz: highest_frequency(data, interval),
        references: data.references.clone(),
    })
}

fn growth(data: &RunFigures<'_>, series: &Series) -> Result<String, FigureError> {
    let rows = &data.record.rows;
    let last = series.times.last().copied().unwrap_or(0.0);
    let amplitudes: Vec<Vec<f64>> = (0..=8)
        .map(|n| {
            rows.iter()
                .map(|row| row.harmonics[n][0].hypot(row.harmonics[n][1]))
                .collect()
        })
        .collect();
    let end = data.analysis.first_nonlinearity.unwrap_or(last);
    let predictions = data.growth_rates.iter().map(|&(harmonic, rate_per_s)| {
        // What the start leaves behind has died out by a third of the stage.
        PredictedGrowth {
            harmonic,
            rate_per_s,
            window: (0.35 * end, 0.95 * end),
        }
    });
    draw_harmonic_growth(&HarmonicGrowth {
        times: &series.times,
        amplitudes: amplitudes
            .iter()
            .enumerate()
            .map(|(n, values)| (n, values.as_slice()))
            .collect(),
        predictions: predictions.collect(),
        first_nonlinearity: data.analysis.first_nonlinearity,
    })
}

/// The contact frame nearest to a time.
fn frame_at(record: &Recorder, time: f64) -> Option<&ContactFrame> {
    let distance = |frame: &&ContactFrame| (frame.time - time).abs();
    record
        .frames
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

fn velocity_fields(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let snapshots = || data.record.snapshots.iter().take(FIELD_LIMIT);
    let fields: Vec<Vec<f64>> = snapshots()
        .map(|snapshot| {
            let pairs = snapshot.velocity.chunks_exact(2);
            pairs.map(|v| v[0].hypot(v[1])).collect()
        })
        .collect();
    let status: Vec<Option<Vec<ContactStatus>>> = snapshots()
        .map(|snapshot| frame_at(data.record, snapshot.time).map(statuses))
        .collect();
    let frames = snapshots().zip(fields.iter().zip(&status));
    draw_snapshots(&Snapshots {
        name: "velocity",
        quantity: "velocity modulus |*v*| (m/s)".into(),
        signed: false,
        mesh: data.mesh,
        frames: frames
            .map(|(snapshot, (field, status))| {
                Snapshot::at_time(snapshot.time, field, status.as_deref())
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
    let (edge, position) = probes()
        .find_map(|probe| Some((probe, contact_position(data, probe)?)))
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
    let stride = record.frame_stride as usize;
    let status: Option<Vec<ContactStatus>> = (0..radial.len())
        .map(|sample| {
            let frame = record.frames.get((sample + stride / 2) / stride);
            let frame = frame.or(record.frames.last())?;
            statuses(frame).get(position).copied()
        })
        .collect();
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
            status: status.as_deref(),
        },
        cycle_start: radial.len() - radial.len().div_ceil(5),
    })
}

fn contact_state(data: &RunFigures<'_>) -> Result<String, FigureError> {
    let record = data.record;
    let pair = record
        .snapshots
        .last()
        .and_then(|snapshot| Some((snapshot, frame_at(record, snapshot.time)?)));
    let Some((snapshot, frame)) = pair else {
        return Err(FigureError::Empty {
            what: "snapshots".into(),
        });
    };
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
