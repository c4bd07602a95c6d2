//! Results of an explicit transient: what is printed and what is written.

mod checkpoint;
mod contact;
mod energy;
mod figures;
mod files;
mod record;
mod run;
mod signals;
mod solid;
mod stages;
mod summary;
mod tables;

pub use checkpoint::{CHECKPOINT, Checkpoint, CheckpointError, read_checkpoint, write_checkpoint};
pub use figures::draw_run;
pub use files::write;
pub(super) use files::{ENERGY, STATUS};
pub use run::RunFigures;
pub use summary::{TransientSummary, summary};
pub use tables::{PredictedGrowth, document, draw};

use crate::fem::MaterialField;
use crate::mesh::{Mesh, SolidSector};
use crate::results::extent::Extent;
use crate::transient::{Perturbation, Recorder, StepPlan, TransientAnalysis};

/// Everything a transient reports. Forces, powers and energies of the record are for one metre of thickness;
/// tables and summary scale them by the thickness.
#[derive(Clone, Debug)]
pub struct TransientReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The mesh, for the snapshots.
    pub mesh: &'a Mesh,
    /// One sector of a body in three dimensions, of which `mesh` is the section across the axis.
    pub solid: Option<&'a SolidSector>,
    /// Contact nodes in the order of the record, counted from 0.
    pub contact_nodes: Vec<u32>,
    /// Its material, for the stresses.
    pub material: &'a dyn MaterialField,
    /// Whether its vibrations have circumferential harmonics: it has the symmetry of the built-in annulus.
    pub has_harmonics: bool,
    /// Thickness, m; 1 in three dimensions, where records are of the whole body.
    pub thickness: f64,
    /// What forces, powers and energies are of.
    pub extent: Extent,
    /// Friction coefficient, for the snapshots.
    pub friction_coefficient: f64,
    /// State at the start: `"rest"` or `"steady-sliding"`.
    pub initial: &'a str,
    /// Initial velocity.
    pub perturbation: &'a Perturbation,
    /// Probes that were asked for by their place: node, counted from 0, and place, m.
    pub places: Vec<(usize, [f64; 2])>,
    /// Name of the operator.
    pub operator: &'a str,
    /// Time step and samples.
    pub plan: StepPlan,
    /// What was recorded.
    pub record: &'a Recorder,
    /// What it says.
    pub analysis: &'a TransientAnalysis,
    /// Steps done since the start, those before a resume included.
    pub steps: u64,
    /// Steps done by this process.
    pub steps_timed: u64,
    /// Wall time of those steps, s.
    pub stepping_s: f64,
    /// Wall time of the run, s.
    pub wall_s: f64,
    /// Whether the run reached its end.
    pub is_finished: bool,
    /// What to know before its numbers are used.
    pub notes: Vec<String>,
}

impl TransientReport<'_> {
    /// Elements times steps for each second of stepping.
    pub fn element_steps_per_second(&self) -> f64 {
        let layers = self.solid.map_or(1, |sector| sector.divisions()[1]);
        let elements = (layers * self.mesh.element_count()) as f64;
        elements * self.steps_timed as f64 / self.stepping_s.max(f64::MIN_POSITIVE)
    }

    /// Where a node is in the plane across the axis, m.
    fn place(&self, node: usize) -> [f64; 2] {
        let Some(sector) = self.solid else {
            return self.mesh.plane_node(node);
        };
        let per_sector = sector.node_count();
        let (radius, angle) = (
            sector.nodes[node % per_sector].radius,
            sector.angle(node % per_sector, node / per_sector),
        );
        [radius * angle.cos(), radius * angle.sin()]
    }

    /// Sine and cosine of the angle of a probe's axes, of a plane body that is no annulus about the origin.
    fn turn_of_probe(&self, probe: usize) -> Option<(f64, f64)> {
        let is_plane = self.solid.is_none() && self.mesh.dimension == 2;
        let has_axes = is_plane && !self.mesh.is_cyclic;
        let node = self.record.probes[probe] - 1;
        has_axes.then(|| self.mesh.frame_angles()[node].sin_cos())
    }

    /// Number of a probe as the user knows it.
    fn probe_label(&self, probe: usize) -> usize {
        self.mesh.node_label(self.record.probes[probe] - 1)
    }
}
