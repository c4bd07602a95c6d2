//! A recorded run as its files, its report and its figures see it.

use super::SolvedTransient;
use crate::charts::Stage;
use crate::common::*;
use frictionsim_physics::transient::TransientSettings;

/// What came of a run, the body that it is of, and what its figures show besides. Forces, powers and energies of the
/// record are for one metre of thickness; tables and summary scale them by the thickness.
#[derive(Clone, Debug)]
pub struct RecordedRun<'a> {
    /// Title of the case, and wall time of the run.
    pub head: Head<'a>,
    /// Record, analysis and steps.
    pub solved: &'a SolvedTransient,
    /// Choices of the run.
    pub settings: &'a TransientSettings,
    /// Friction coefficient, for the snapshots.
    pub friction_coefficient: f64,
    /// Probes that were asked for by their place: node, counted from 0, and place, m.
    pub places: Vec<(usize, [f64; 2])>,
    /// What to know before its numbers are used.
    pub notes: Vec<String>,
    /// The body.
    pub body: ShownBody<'a>,
    /// The contact nodes, in the order of the record.
    pub interface: ContactInterface,
    /// Its material, for the stresses.
    pub material: &'a dyn MaterialField,
    /// Whether its vibrations have circumferential harmonics: it has the symmetry of the built-in annulus.
    pub has_harmonics: bool,
    /// Thickness, m; 1 in three dimensions, where records are of the whole body.
    pub thickness: f64,
    /// What forces, powers and energies are of.
    pub extent: Extent,
    /// Peripheral speed of the cylinder, m/s.
    pub peripheral_speed: f64,
    /// What the eigenvalue analysis makes of its linear stage; nothing where it was not asked.
    pub stage: LinearStage,
}

/// Unstable modes of steady sliding as the time loop has it: the same mesh and contact, lumped mass, small
/// displacements.
#[derive(Clone, Debug, Default)]
pub struct LinearStage {
    /// Frequencies, numbered among all modes by frequency, for the lines across spectrograms and spectra.
    pub references: Vec<ModeLine>,
    /// Largest growth rate of each unstable harmonic, 1/s, harmonics rising; none for a body without symmetry.
    pub growth_rates: Vec<(usize, f64)>,
    /// Frequency (Hz) and growth rate (1/s) of each unstable mode.
    pub mode_rates: Vec<(f64, f64)>,
}

impl RecordedRun<'_> {
    /// Elements times steps for each second of stepping.
    pub(super) fn element_steps_per_second(&self) -> f64 {
        let (body, solved) = (&self.body, self.solved);
        let layers = body.sector.map_or(1, |sector| sector.specification.divisions()[1]);
        let elements = (layers * body.mesh.element_count()) as f64;
        let stepping_s = solved.stepping_s.max(f64::MIN_POSITIVE);
        elements * solved.steps_timed as f64 / stepping_s
    }

    /// Number of a probe as the user knows it.
    pub(super) fn probe_label(&self, probe: usize) -> usize {
        self.body.mesh.node_label(self.solved.record.probes[probe] - 1)
    }

    /// Names and symbols of what the components of a probe are along: nothing is radial about a plane.
    pub(super) fn directions(&self) -> [[&'static str; 2]; 3] {
        match (self.body.is_assembly(), self.body.mesh.counterface) {
            (true, _) => [["x", "x"], ["y", "y"], ["z", "z"]],
            (_, Counterface::Plane { .. }) => {
                [["normal", "n"], ["tangential", "t"], ["axial", "z"]]
            }
            _ => [["radial", "r"], ["tangential", "θ"], ["axial", "z"]],
        }
    }

    /// Times of all samples, s.
    pub(super) fn times(&self) -> Vec<f64> {
        self.solved.record.rows.iter().map(|row| row.time).collect()
    }

    /// Time between samples, s; zero for fewer than two.
    pub(super) fn interval(&self) -> f64 {
        let rows = &self.solved.record.rows;
        match (rows.first(), rows.last(), rows.len()) {
            (Some(first), Some(last), 2..) => (last.time - first.time) / (rows.len() - 1) as f64,
            _ => 0.0,
        }
    }

    /// Which component of a probe is shown: the tangential one, which friction drives and over which runs are compared;
    /// of solid bodies of a mesh, which may lie anyhow, the strongest.
    pub(super) fn shown_component(&self, probe: usize) -> usize {
        if !self.body.is_assembly() {
            return 1;
        }
        let size = |component: usize| -> f64 {
            self.component(probe, component).iter().map(|a| a * a).sum()
        };
        (0..3).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(1)
    }

    /// Acceleration of a probe along one of its directions.
    pub(super) fn component(&self, probe: usize, component: usize) -> Vec<f64> {
        match component {
            2 => self.solved.record.axial_rows[probe].iter().map(|row| row[2]).collect(),
            _ => {
                self.solved.record.probe_rows[probe].iter().map(|row| row[4 + component]).collect()
            }
        }
    }

    /// The acceleration of a probe that is shown.
    pub(super) fn acceleration(&self, probe: usize) -> Vec<f64> {
        self.component(probe, self.shown_component(probe))
    }

    /// Frequency (Hz) and growth rate (1/s) of the unstable mode nearest to the vibration that grows on a body without
    /// symmetry, if one lies within 3 % of it.
    pub(super) fn growing_mode(&self) -> Option<(f64, f64)> {
        let growth = self.solved.analysis.growth.first()?;
        let frequency = growth.stage.as_ref().ok()?.frequency_hz.value.abs();
        let distance = |mode: &&(f64, f64)| (mode.0 / frequency - 1.0).abs();
        let nearest =
            self.stage.mode_rates.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        (distance(&nearest) < 0.03).then_some(*nearest)
    }

    /// Highest frequency shown: three superharmonics, or all modes drawn.
    pub(super) fn highest_frequency(&self) -> f64 {
        let main = self.solved.analysis.last_fifth.main_frequency_hz.unwrap_or(0.0);
        let modes = self.stage.references.iter().map(|mode| mode.frequency_hz);
        let wanted = modes.fold(3.4 * main, |top, f| top.max(1.1 * f));
        let nyquist = 0.5 / self.interval().max(1e-12);
        if wanted > 0.0 { wanted.min(nyquist) } else { nyquist.min(35e3) }
    }
}

/// Part of a run below which a stage is none, as the instant before the first node of pressed pads sticks.
const SHORTEST: f64 = 2e-3;

/// The stages of a run as figure 8 of the paper letters them: A vibrations of the start die out, B exponential growth,
/// C stick and separation set in, D limit cycle.
///
/// B begins where the strongest harmonic other than zero overtakes the vibration of harmonic zero (half its range over
/// 0.5 ms), D where it stays within 2 % of its last value for good. A run that ends before a stage has the letters up
/// to it; one without growth has none.
pub(super) fn stages(run: &SolvedTransient) -> Vec<Stage> {
    let (rows, analysis) = (&run.record.rows, &run.analysis);
    let size = |row: &SampleRow, n: usize| row.harmonics[n][0].hypot(row.harmonics[n][1]);
    let Some(last) = rows.last() else { return Vec::new() };
    let strongest =
        (1..last.harmonics.len()).max_by(|&a, &b| size(last, a).total_cmp(&size(last, b)));
    let Some(main) = strongest else { return Vec::new() };
    let linear_end = analysis.first_nonlinearity.unwrap_or(last.time);
    let window = rows.partition_point(|row| row.time < rows[0].time + 5e-4).max(2);
    let linear = rows.partition_point(|row| row.time < linear_end);
    // The last half millisecond of the linear stage in which harmonic zero still moves more than the wave.
    let overtaken = (0..linear / window).rfind(|&block| {
        let block = &rows[block * window..(block + 1) * window];
        let (low, high) = extremes(block.iter().map(|row| row.harmonics[0][0]));
        let wave = block.iter().map(|row| size(row, main)).sum::<f64>() / window as f64;
        wave < 0.5 * (high - low)
    });
    let after = |index: Option<usize>| {
        index.and_then(|i| rows.get(i + 1)).map_or(rows[0].time, |row| row.time)
    };
    let growth = after(overtaken.map(|block| (block + 1) * window - 1));
    let is_far = |row| (size(row, main) - size(last, main)).abs() > 0.02 * size(last, main);
    let settled = rows.iter().rposition(is_far);
    let (nonlinear, cycle) = match analysis.first_nonlinearity {
        Some(time) if analysis.settling.state == EndState::LimitCycle => {
            (time, after(settled).max(time))
        }
        Some(time) => (time, last.time),
        None => (last.time, last.time),
    };
    if growth >= last.time {
        return Vec::new();
    }
    let spans = [
        ("A: vibrations of the start die out", rows[0].time, growth),
        ("B: exponential growth", growth, nonlinear),
        ("C: stick and separation set in", nonlinear, cycle),
        ("D: limit cycle", cycle, last.time),
    ];
    let shortest = SHORTEST * (last.time - rows[0].time);
    let present = spans.into_iter().filter(|(_, start, end)| end - start > shortest);
    present.map(|(meaning, start, _)| Stage { meaning, start }).collect()
}
