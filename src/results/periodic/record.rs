//! Record of a search for the limit cycles of a body without symmetry, from which its figures are drawn again.

use super::{FoundCycle, PeriodicReport, PeriodicResult};
use crate::contact::ContactStatus;
use crate::cycle::periodic::{BranchMotion, ContactInstant, PeriodicBranch, PeriodicMotion};
use crate::results::charts::palette::status_of_code;
use crate::results::extent::Extent;
use crate::results::record::Record;
use serde::{Deserialize, Serialize};

/// More instants and nodes than any cycle has.
const MOST_CELLS: usize = 100_000_000;

/// Everything that the figures show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeriodicRecord {
    /// One entry for each cycle.
    pub cycles: Vec<MotionRecord>,
    /// Nodes of the contact, counted from 0.
    pub nodes: Vec<u32>,
    /// Their angles, rad.
    pub angles: Vec<f64>,
}

/// One limit cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionRecord {
    /// Number of the mode that leads to it.
    pub mode: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Times, s.
    pub times: Vec<f64>,
    /// Statuses of all contact nodes, instant by instant: 0 open, 1 stick, 2 slip.
    pub status: Vec<u8>,
    /// Contact node that moves most, among those of the edge.
    pub node: usize,
    /// Speed of the counterface there, m/s.
    pub counterface_speed: f64,
    /// Friction coefficient there; none where it falls with the slip speed.
    pub friction_coefficient: Option<f64>,
    /// Its pressure over time, Pa.
    pub pressure: Vec<f64>,
    /// Its shear, Pa.
    pub shear: Vec<f64>,
    /// Its displacement along the normal and along the counterface, m.
    pub displacement: [Vec<f64>; 2],
    /// Its velocity, m/s.
    pub velocity: [Vec<f64>; 2],
    /// Pressure (Pa), shear (Pa) and velocity along the counterface (m/s) of all contact nodes at time zero.
    pub edge: [Vec<f64>; 3],
    /// Amplitudes of the harmonics along the normal and along the counterface, m.
    pub harmonics: [Vec<f64>; 2],
    /// Displacement of every dof in nodal frames at time zero, m.
    pub displacement_field: Vec<f64>,
    /// Velocity, m/s.
    pub velocity_field: Vec<f64>,
    /// Its branch over the parameter of the case.
    pub branch: Option<CurveRecord>,
}

/// Cycles along a parameter, in the order of the branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveRecord {
    /// Case key of the parameter.
    pub key: String,
    /// The parameter (in units of the key), frequency (Hz) and amplitude (m) of the case's own cycle.
    pub own: [f64; 3],
    /// Amplitude (m) and velocity of the kick (m/s) of the unstable cycle between stable sliding and the case's own.
    pub threshold: Option<[f64; 2]>,
    /// The parameter at each cycle, in units of the key.
    pub values: Vec<f64>,
    /// Frequency, Hz.
    pub frequency_hz: Vec<f64>,
    /// Half the range of the displacement of the node that moves most along the counterface, m.
    pub amplitude: Vec<f64>,
    /// Fractions that stick, slip, are open.
    pub status: [Vec<f64>; 3],
    /// What powers are of.
    pub extent: Extent,
    /// Power of the counterface, W or W/m.
    pub external: Vec<f64>,
    /// Whether the cycle is stable, where that is known.
    pub stable: Vec<Option<bool>>,
    /// Places, among the cycles, of folds.
    pub folds: Vec<u64>,
    /// Values at which steady sliding loses its stability, in units of the key.
    pub onsets: Vec<f64>,
    /// Where cycles live beside stable sliding.
    pub coexistence: Vec<[f64; 2]>,
}

impl Record for PeriodicRecord {
    const MAGIC: [u8; 8] = *b"FRICSIMP";
    const VERSION: u32 = 4;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = self.angles.len() == self.nodes.len()
            && self.cycles.iter().all(|own| own.nodes() == self.nodes.len() && own.is_whole());
        (!is_whole).then_some("its instants, nodes and harmonics do not fit together")
    }
}

impl PeriodicRecord {
    /// What the figures show of a report.
    pub fn of(report: &PeriodicReport<'_>) -> Self {
        let cycles = report.results.iter();
        let cycles =
            cycles.filter_map(|result| Some(MotionRecord::of(result, result.own()?, report)));
        Self {
            cycles: cycles.collect(),
            nodes: report.interface.nodes.clone(),
            angles: report.interface.angles.clone(),
        }
    }
}

impl CurveRecord {
    fn of(branch: &PeriodicBranch, own: &PeriodicMotion, report: &PeriodicReport<'_>) -> Self {
        let thickness = report.thickness;
        let column = |of: &dyn Fn(&BranchMotion) -> f64| branch.motions.iter().map(of).collect();
        let external = |own: &BranchMotion| thickness * own.motion.powers.contact.external;
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let folds = branch.motions.iter().enumerate();
        let folds = folds.filter(|(_, own)| own.is_fold);
        Self {
            key: branch.parameter.key().to_owned(),
            own: [in_units(branch.own), own.frequency_hz, own.amplitude],
            threshold: branch.threshold().map(|own| [own.amplitude, own.kick_velocity()]),
            values: column(&|own| in_units(own.value)),
            frequency_hz: column(&|own| own.motion.frequency_hz),
            amplitude: column(&|own| own.motion.amplitude),
            status: [0, 1, 2].map(|i| column(&|own| own.motion.fractions[i])),
            extent: report.extent,
            external: column(&external),
            stable: branch.motions.iter().map(BranchMotion::is_stable).collect(),
            folds: folds.map(|(i, _)| i as u64).collect(),
            onsets: branch.onsets.iter().map(|&at| in_units(at)).collect(),
            coexistence: branch.coexistence().into_iter().map(|ends| ends.map(in_units)).collect(),
        }
    }

    fn is_whole(&self) -> bool {
        let count = self.values.len();
        let columns = [&self.frequency_hz, &self.amplitude, &self.external];
        let mut columns = columns.into_iter().chain(&self.status);
        columns.all(|column| column.len() == count)
            && self.stable.len() == count
            && self.folds.iter().all(|&place| (place as usize) < count)
    }
}

impl MotionRecord {
    fn of(result: &PeriodicResult, found: &FoundCycle, report: &PeriodicReport<'_>) -> Self {
        let motion = &found.motion;
        let (instants, node) = (&motion.instants, motion.node);
        let over_time = |of: &dyn Fn(&ContactInstant) -> f64| instants.iter().map(of).collect();
        let told = &motion.harmonics[..found.harmonic_count];
        let first = instants.first();
        let along = first.map_or_else(Vec::new, |at| at.velocity.iter().map(|v| v[1]).collect());
        let [displacement_field, velocity_field] = match motion.frames.first() {
            Some(frame) => frame.fields.clone(),
            None => [Vec::new(), Vec::new()],
        };
        let codes = instants.iter().flat_map(|at| &at.status);
        Self {
            mode: result.mode.number,
            frequency_hz: motion.frequency_hz,
            times: over_time(&|at| at.time),
            status: codes.map(|status| *status as u8).collect(),
            node,
            counterface_speed: motion.counterface_speed,
            friction_coefficient: motion.friction_coefficient,
            pressure: over_time(&|at| at.pressure[node]),
            shear: over_time(&|at| at.shear[node]),
            displacement: [0, 1].map(|c| over_time(&|at| at.displacement[node][c])),
            velocity: [0, 1].map(|c| over_time(&|at| at.velocity[node][c])),
            edge: [
                first.map_or_else(Vec::new, |at| at.pressure.clone()),
                first.map_or_else(Vec::new, |at| at.shear.clone()),
                along,
            ],
            harmonics: [0, 1].map(|c| told.iter().map(|own| own.amplitude[c]).collect()),
            displacement_field,
            velocity_field,
            branch: found.branch.as_ref().map(|branch| CurveRecord::of(branch, motion, report)),
        }
    }

    fn is_whole(&self) -> bool {
        let (count, nodes) = (self.times.len(), self.edge[0].len());
        let columns = [&self.pressure, &self.shear]
            .into_iter()
            .chain(&self.displacement)
            .chain(&self.velocity);
        let mut edges = self.edge.iter();
        count > 0
            && self.node < nodes
            && count.checked_mul(nodes).is_some_and(|cells| cells <= MOST_CELLS)
            && self.status.len() == count * nodes
            && columns.into_iter().all(|column| column.len() == count)
            && edges.all(|edge| edge.len() == nodes)
            && self.harmonics[0].len() == self.harmonics[1].len()
            && self.displacement_field.len() == self.velocity_field.len()
            && self.branch.as_ref().is_none_or(CurveRecord::is_whole)
    }

    /// Part of a file name.
    pub fn tag(&self) -> String {
        format!("mode{}", self.mode)
    }

    /// The frequency in words.
    pub fn hertz(&self) -> String {
        format!("{:.2} Hz", self.frequency_hz)
    }

    /// Number of contact nodes.
    pub fn nodes(&self) -> usize {
        self.edge[0].len()
    }

    /// Status of the node that moves most, over time.
    pub fn node_statuses(&self) -> Vec<ContactStatus> {
        let own = self.status.iter().skip(self.node).step_by(self.nodes());
        own.map(|&code| status_of_code(code)).collect()
    }

    /// Status of all contact nodes at time zero.
    pub fn first_statuses(&self) -> Vec<ContactStatus> {
        let first = self.status.iter().take(self.nodes());
        first.map(|&code| status_of_code(code)).collect()
    }
}
