//! Results of `improve`: where a modification silences unstable modes, what it is predicted to do, and what it does.

mod figures;
mod files;
mod tables;

use super::Extent;
use super::finding::keys;
use frictionsim_output::{Column, parted, significant};
use frictionsim_physics::mesh::Mesh;
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

keys! {
    /// `summary.json` of `improve`.
    ImproveSummary {
        dofs: usize = "unknowns of the eigenproblem";
        friction_coefficient: f64 = "the friction coefficient at which modes are to be silenced";
        base: State = "what the case does as it is";
        modes: Vec<TargetMode> = "the modes that are to be silenced, by frequency";
        sizes: Sizes = "sizes of the modifications";
        extent: Extent = "what masses, stiffnesses and dashpots are of";
        candidates: Vec<Candidate> = "modifications, the best first";
        notes: Vec<String> = "what there is to say";
    }

    /// A mode that is to be silenced.
    #[derive(Copy)]
    TargetMode {
        mode: usize = "number by frequency, from 1";
        frequency_hz: f64 = "`Im(lambda) / 2 pi`, Hz";
        growth_rate_per_s: f64 = "`Re(lambda)`, 1/s";
    }

    /// What the modes of the window of frequencies come to.
    #[derive(Copy, Default)]
    State, STATES {
        growth_rate_per_s: Option<f64> = "growth rate of the fastest mode of the window",
            Always "growth" Significant(4);
        /// Its frequency, Hz.
        frequency_hz: Option<f64>;
        critical_friction: Option<f64> = "lowest critical friction of the window, of a run; empty \
            where none is below the case's own", Always "critical friction" Fixed(4);
        /// Unstable modes there.
        unstable: usize;
        unstable_beside: usize = "unstable modes at other frequencies";
        /// Frequency of the one of them that grows fastest, Hz.
        beside_hz: Option<f64>;
    }
}

/// Those that a prediction has too.
pub(super) const PREDICTED: &[Column<State>] = parted(STATES, "critical_friction").0;

keys! {
    /// Sizes of the modifications.
    #[derive(Copy)]
    Sizes {
        mass_kg: f64 = "mass at a node, kg";
        stiffness_n_per_m: f64 = "stiffness of a spring, N/m";
        damping_n_s_per_m: f64 = "damping of a dashpot, N s/m";
        patch_radius_m: f64 = "radius of a patch, m";
        patch_damping_s: f64 = "stiffness coefficient of its damping, s";
        offset_m: f64 = "farthest way of the contact curve, m";
    }

    /// One modification.
    Candidate {
        rank: usize = "place in the list, from 1";
        kind: String = "what it is";
        node: Option<usize> = "number of its node";
        position_m: [f64; 3] = "where it is, m; the way of the hole for an offset";
        direction: Option<[f64; 3]> = "direction of a spring or dashpot";
        added_mass_kg: f64 = "mass that it adds, kg; negative where material is taken away";
        first_order_growth_rate_per_s: Option<f64>
            = "largest growth rate of the targets to first order, 1/s";
        predicted: State = "what is predicted from all listed modes together";
        confirmed: Option<State> = "what the modified case does";
        verdict: String = "what that comes to, in words";
        keys: Vec<String> = "case keys that make it";
    }
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
