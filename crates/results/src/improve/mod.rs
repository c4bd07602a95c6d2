//! Results of `improve`: where a modification silences unstable modes, what it is predicted to do, and what it does.

mod figures;
mod files;
mod tables;

use super::Extent;
use super::finding::finding;
use frictionsim_output::{Column, Described, parted, significant};
use frictionsim_physics::mesh::Mesh;
use serde::Serialize;
use std::sync::Arc;

pub use figures::figures;
pub use files::write;
pub use tables::document;
pub(super) use tables::{CANDIDATES, EFFECTS, VERDICTS};

/// What `improve` finds.
pub struct Improvement {
    /// What there is to say of it.
    pub summary: ImproveSummary,
    /// The mesh of the fields.
    pub mesh: Arc<Mesh>,
    /// Derivatives of each target over the mesh.
    pub fields: Vec<TargetFields>,
}

/// Fields over the mesh of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetFields {
    /// Its mode.
    pub mode: TargetMode,
    /// Derivative of the growth rate by a mass at each node, 1/s for each kg.
    pub mass: Vec<f64>,
    /// By a spring at each node along the direction that helps most, 1/s for each N/m.
    pub spring: Vec<f64>,
    /// By a dashpot alike, 1/s for each N s/m.
    pub dashpot: Vec<f64>,
    /// By taking each element away, 1/s for each m2 of area (m3 of solid bodies).
    pub removal: Vec<f64>,
    /// By stiffness damping of each element, 1/s for each s and m2 (m3).
    pub damping: Vec<f64>,
}

/// `summary.json` of `improve`.
#[derive(Clone, Debug, Described, Serialize)]
pub struct ImproveSummary {
    /// Unknowns of the eigenproblem.
    pub dofs: usize,
    /// The friction coefficient at which modes are to be silenced.
    pub friction_coefficient: f64,
    /// What the case does as it is.
    pub base: State,
    /// The modes that are to be silenced, by frequency.
    pub modes: Vec<TargetMode>,
    /// Sizes of the modifications.
    pub sizes: Sizes,
    /// What masses, stiffnesses and dashpots are of.
    pub extent: Extent,
    /// Modifications, the best first.
    pub candidates: Vec<Candidate>,
    /// What there is to say.
    pub notes: Vec<String>,
}

/// A mode that is to be silenced.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct TargetMode {
    /// Number by frequency, from 1.
    pub mode: usize,
    /// `Im(lambda) / 2 pi`, Hz.
    pub frequency_hz: f64,
    /// `Re(lambda)`, 1/s.
    pub growth_rate_per_s: f64,
}

finding! {
    /// What the modes of the window of frequencies come to.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize)]
    State, STATES {
        growth_rate_per_s: Option<f64> = "growth rate of the fastest mode of the window",
            Always "growth" Significant(4);
        /// Its frequency, Hz.
        frequency_hz: Option<f64>;
        critical_friction: Option<f64>
            = "lowest critical friction of the window, of a run; empty where none is below the case's own",
            Always "critical friction" Fixed(4);
        /// Unstable modes there.
        unstable: usize;
        unstable_beside: usize = "unstable modes at other frequencies";
        /// Frequency of the one of them that grows fastest, Hz.
        beside_hz: Option<f64>;
    }
}

/// Those that a prediction has too.
pub(super) const PREDICTED: &[Column<State>] = parted(STATES, "critical_friction").0;

/// Sizes of the modifications.
#[derive(Clone, Copy, Debug, Described, Serialize)]
pub struct Sizes {
    /// Mass at a node, kg.
    pub mass_kg: f64,
    /// Stiffness of a spring, N/m.
    pub stiffness_n_per_m: f64,
    /// Damping of a dashpot, N s/m.
    pub damping_n_s_per_m: f64,
    /// Radius of a patch, m.
    pub patch_radius_m: f64,
    /// Stiffness coefficient of its damping, s.
    pub patch_damping_s: f64,
    /// Farthest way of the contact curve, m.
    pub offset_m: f64,
}

/// One modification.
#[derive(Clone, Debug, Described, Serialize)]
pub struct Candidate {
    /// Place in the list, from 1.
    pub rank: usize,
    /// What it is.
    pub kind: String,
    /// Number of its node.
    pub node: Option<usize>,
    /// Where it is, m; the way of the hole for an offset.
    pub position_m: [f64; 3],
    /// Direction of a spring or dashpot.
    pub direction: Option<[f64; 3]>,
    /// Mass that it adds, kg; negative where material is taken away.
    pub added_mass_kg: f64,
    /// Largest growth rate of the targets to first order, 1/s.
    pub first_order_growth_rate_per_s: Option<f64>,
    /// What is predicted from all listed modes together.
    pub predicted: State,
    /// What the modified case does.
    pub confirmed: Option<State>,
    /// What that comes to, in words.
    pub verdict: String,
    /// Case keys that make it.
    pub keys: Vec<String>,
}

impl Candidate {
    /// Where it is, in words.
    pub fn place(&self) -> String {
        // No minus sign before a zero.
        let [x, y, z] = self.position_m.map(|value| (1e5 * value).round() / 1e2 + 0.0);
        let depth = if z == 0.0 { String::new() } else { format!(", {z:.2}") };
        match (self.kind.as_str(), self.node) {
            ("offset", _) => format!("hole moved by ({x:.2}, {y:.2}) mm"),
            (_, Some(node)) => format!("node {node} at ({x:.2}, {y:.2}{depth}) mm"),
            _ => format!("about ({x:.2}, {y:.2}{depth}) mm"),
        }
    }
}

/// A critical friction coefficient for people: none up to that of the case.
pub(super) fn critical(value: Option<f64>, friction: f64) -> String {
    value.map_or_else(|| format!("> {friction}"), |value| format!("{value:.4}"))
}

impl ImproveSummary {
    /// The first candidate that silences the window when it is run again, else the first that does what was predicted.
    pub fn best(&self) -> Option<&Candidate> {
        let of_verdict = |verdict: &str| self.candidates.iter().find(|own| own.verdict == verdict);
        of_verdict("silenced").or_else(|| of_verdict("confirmed"))
    }

    /// What was found, in a sentence.
    pub fn answer(&self) -> String {
        let friction = self.friction_coefficient;
        let onset = |state: State| critical(state.critical_friction, friction);
        let place = |own: &Candidate| format!("{} ({})", own.kind, own.place());
        match (self.best(), self.candidates.first()) {
            (Some(own), _) => {
                let [from, to] = [self.base, own.confirmed.unwrap_or_default()].map(onset);
                let change = format!("{}: critical friction {from} -> {to}", place(own));
                format!("{change}, run again and {}", own.verdict)
            }
            (None, Some(own)) if own.confirmed.is_none() => {
                let growth = significant(own.predicted.growth_rate_per_s.unwrap_or(0.0), 4);
                format!("{}: growth {growth} 1/s predicted; none was run again", place(own))
            }
            (None, Some(_)) => "none of the candidates that were run again holds".to_owned(),
            (None, None) => "no modification of these sizes helps".to_owned(),
        }
    }
}
