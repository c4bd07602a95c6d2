//! Results of a complex eigenvalue analysis: what is printed and what is written.

mod base;
mod branches;
mod feed;
mod figures;
mod files;
mod kept;
mod locus;
mod prestress;
mod reading;
mod sensitivity;
mod shape;
mod summary;
mod tables;

pub use base::{BaseField, BaseState, ContactPlace, ContactState};
pub(super) use base::{NAME, NODES, PLANE, POINTS, RINGS, SPACE, TRACTIONS};
pub(super) use branches::{BRANCH, DIRECTION, HARMONIC, NAMES, NUMBERS, SHORT_NAMES, arrow};
pub use branches::{Branch, ModeName, branch_of, branch_of_mode, mode_name};
pub(super) use feed::FEED;
pub use feed::ModeFeed;
pub use figures::figures;
pub use files::{write_fields, write_universal};
pub use kept::KeptSteps;
pub use locus::NamedDamping;
pub(super) use reading::{CONTRIBUTIONS, COUPLINGS};
pub use reading::{Contribution, Coupling, Reading, Source};
pub(super) use sensitivity::{EIGENVALUES, ROWS};
pub use sensitivity::{OnsetRates, SensitivityReport, SensitivityRow};
pub use summary::{
    CeaSummary, CriticalFriction, ModeSummary, UnstableCount, UnstableMode, summary,
};
pub(super) use summary::{ONSETS, SWEPT_MODES, SWEPT_ONSETS, UNSTABLE};
pub(super) use tables::MODES;
pub use tables::{View, document, page};

use crate::ShownBody;
use frictionsim_physics::cea::{ComplexMode, FrictionPoint, FrictionSweep};

/// What a solver gives back.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// Modes at every friction value, and where branches turn unstable.
    pub sweep: FrictionSweep,
    /// Unknowns of the eigenproblem.
    pub dofs: usize,
    /// Which solver: `cyclic`, of a body made of one sector too that was solved by waves around it, or `sparse`.
    pub method: &'static str,
    /// Derivatives of the eigenvalues at the case's own friction coefficient, where they were asked for.
    pub sensitivities: Option<SensitivityReport>,
    /// Where growth comes from and which modes couple; none without mode shapes.
    pub reading: Option<Reading>,
    /// What it has to say: lost branches, harmonics left out, and why.
    pub notes: Vec<String>,
}

/// Everything a complex eigenvalue analysis reports, but for the fields of its base state.
#[derive(Clone, Debug)]
pub struct CeaReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The body.
    pub body: ShownBody<'a>,
    /// Whether modes have a circumferential harmonic and a direction; else they are named by rank.
    pub has_harmonics: bool,
    /// What was asked for, in words: `"below 17500 Hz"`.
    pub selection: String,
    /// Friction coefficients of the tables, rising. The sweep may hold more, for the shapes.
    pub friction_coefficients: &'a [f64],
    /// The modes.
    pub solution: &'a Solution,
    /// Friction coefficients at which contact nodes open or close, rising: no branch goes on smoothly across them.
    pub contact_changes: &'a [f64],
    /// The state of steady sliding at the case's own friction coefficient.
    pub base: BaseState,
    /// Wall time of the run, s.
    pub wall_s: f64,
}

impl<'a> CeaReport<'a> {
    /// Every mode with its friction coefficient and its number there, by frequency from 1.
    fn modes(&self) -> impl Iterator<Item = (f64, usize, &'a ComplexMode)> {
        self.solution.sweep.points.iter().flat_map(|point| {
            let friction = point.friction_coefficient;
            (1..).zip(&point.modes).map(move |(number, mode)| (friction, number, mode))
        })
    }

    /// The modes at the case's own friction coefficient, where it is one of those solved.
    fn solved_point(&self) -> Option<&'a FrictionPoint> {
        let own = self.base.friction_coefficient;
        self.solution.sweep.points.iter().find(|point| point.friction_coefficient == own)
    }

    /// The modes at the solved friction value nearest to the case's own.
    fn own_point(&self) -> Option<&FrictionPoint> {
        let own = self.base.friction_coefficient;
        let distance = |point: &&FrictionPoint| (point.friction_coefficient - own).abs();
        self.solution.sweep.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Number of a branch's mode at that friction value, by frequency from 1.
    fn mode_number(&self, branch: Branch) -> Option<usize> {
        let modes = &self.own_point()?.modes;
        modes.iter().rposition(|mode| branch_of_mode(mode) == branch).map(|at| at + 1)
    }

    /// A branch as figures and tables name it: by harmonic, rank and sense of travel, or without symmetry by the number
    /// that its mode has at the case's own friction, after its nodal diameters on a body of one sector.
    fn branch_name(&self, branch: Branch) -> String {
        match (self.has_harmonics, self.mode_number(branch)) {
            (true, _) => mode_name(Some(branch.0), branch.1, branch.2),
            (false, Some(number)) => {
                let own = self.own_point().map(|point| &point.modes[number - 1]);
                match own.and_then(|mode| mode.nodal_diameters) {
                    Some(n) => format!("n = {n}, mode {number}"),
                    None => format!("mode {number}"),
                }
            }
            (false, None) => format!("branch {}", branch.1),
        }
    }

    /// The friction values of the tables: those of the sweep, and the case's own.
    pub fn tabulated(&self) -> impl Iterator<Item = &'a FrictionPoint> {
        let own = self.base.friction_coefficient;
        let is_listed =
            move |friction| friction == own || self.friction_coefficients.contains(&friction);
        self.solution.sweep.points.iter().filter(move |point| is_listed(point.friction_coefficient))
    }

    /// Largest relative residual of any eigenpair, that of the quadratic problem.
    pub fn largest_residual(&self) -> f64 {
        self.modes().map(|own| own.2.residual).fold(0.0, f64::max)
    }

    /// Fewest and most modes found at one friction value.
    pub fn mode_counts(&self) -> (usize, usize) {
        let counts = || self.tabulated().map(|point| point.modes.len());
        (counts().min().unwrap_or(0), counts().max().unwrap_or(0))
    }
}

/// Direction in words.
fn direction_name(direction: i8) -> &'static str {
    ["against", "standing", "with"][(direction.signum() + 1) as usize]
}
