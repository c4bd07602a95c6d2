//! `frictionsim cea`: complex eigenvalues of steady sliding over the friction coefficient.

use super::{Failure, RunOptions, Session};
use crate::case::{Case, Cea, ModeSelection};
use crate::cea::FrictionSweep;
use crate::fem::{Triplets, assemble_stiffness};
use crate::mesh::AnnulusMesh;
use crate::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};
use crate::results::cea::{BaseState, CeaReport, print, write};
use clap::Args;

/// Complex eigenvalue sweep over the friction coefficient
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub options: RunOptions,
}

/// The model that the solvers take: mesh, base state, and what its tangent is made of.
pub struct SlidingModel {
    /// The mesh with its sectors.
    pub annulus: AnnulusMesh,
    /// Elastic stiffness over all dofs.
    pub stiffness: Triplets,
    /// Steady sliding.
    pub base: SteadySliding,
    /// How the tangent is taken.
    pub options: TangentOptions,
}

/// What a solver gives back.
pub struct Solution {
    /// Modes at every friction value, and where branches turn unstable.
    pub sweep: FrictionSweep,
    /// Unknowns of the eigenproblem.
    pub dofs: usize,
    /// Which solver.
    pub method: &'static str,
    /// What it has to say.
    pub notes: Vec<String>,
}

impl SlidingModel {
    /// Builds the model of a case up to its base state.
    ///
    /// # Errors
    /// A mesh that cannot be built; contact that would open.
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, Failure> {
        let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
        let stiffness = assemble_stiffness(&annulus.mesh, &case.material);
        let base = SteadySliding::solve(&annulus.mesh, &stiffness, &case.contact.sliding)?;
        let options = TangentOptions {
            mass: cea.mass,
            geometric_stiffness: cea.geometric_stiffness,
            damping: case.damping.rayleigh,
            damping_model: if case.damping.include_contact {
                DampingModel::WholeTangent
            } else {
                DampingModel::BodyOnly
            },
            contact: case.contact.stiffness,
        };
        Ok(Self {
            annulus,
            stiffness,
            base,
            options,
        })
    }

    /// The tangent over the whole mesh, for the sparse solver.
    pub fn tangent(&self, case: &Case) -> SlidingTangent {
        SlidingTangent::linearize(
            &self.annulus.mesh,
            &case.material,
            &self.stiffness,
            &self.base,
            &self.options,
        )
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let friction = case.contact.sliding.friction_coefficient;
        let pressures = self.base.pressures();
        let smallest = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let traction = self.base.sliding_direction * friction;
        let torque = case.thickness * self.base.torque(friction);
        let shear = [traction * smallest, traction * largest];
        BaseState {
            friction_coefficient: friction,
            // The state is that of full sliding; one where a node would open does not exist.
            slipping: pressures.len(),
            sticking: 0,
            open: 0,
            pressure_pa: [smallest, largest],
            shear_pa: [shear[0].min(shear[1]), shear[0].max(shear[1])],
            torque_n_m: torque,
            power_w: torque * case.contact.sliding.rotation_speed,
        }
    }
}

/// Runs the subcommand with a solver.
///
/// # Errors
/// A bad case, contact that opens, a solver that fails, an output folder that cannot be written.
pub fn run_with(
    arguments: &Arguments,
    solve: impl FnOnce(&Session, &Cea, &SlidingModel) -> Result<Solution, Failure>,
) -> Result<(), Failure> {
    let session = Session::start("cea", &arguments.options)?;
    let case = &session.case;
    let cea = case.require_cea()?;
    let cost = case.cost();
    let solver_bytes = cost.cea.map_or(0.0, |cea| cea.memory_bytes);
    session.check_memory(cost.mesh_memory_bytes + solver_bytes)?;
    let folder = session.open_folder()?;

    let model = SlidingModel::new(case, cea)?;
    let solution = solve(&session, cea, &model)?;
    refuse_no_modes(case, cea, &solution.sweep)?;

    let report = CeaReport {
        title: &case.title,
        mesh: &model.annulus.mesh,
        dofs: solution.dofs,
        method: solution.method,
        selection: match cea.modes {
            ModeSelection::BelowHz(limit) => format!("below {limit} Hz"),
            ModeSelection::Lowest(count) => format!("the lowest {count}"),
        },
        friction_coefficients: &cea.friction_coefficients,
        sweep: &solution.sweep,
        base: model.base_state(case),
        notes: solution.notes,
        wall_s: session.wall_seconds(),
    };
    let summary = write(&folder, &report)?;
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&report), &summary, &path)
}

/// A frequency limit below the first mode is an error of the case.
fn refuse_no_modes(case: &Case, cea: &Cea, sweep: &FrictionSweep) -> Result<(), Failure> {
    let ModeSelection::BelowHz(limit) = cea.modes else {
        return Ok(());
    };
    if sweep.points.iter().any(|point| !point.modes.is_empty()) {
        return Ok(());
    }
    Err(Failure::Case(case.error_at(
        "cea.max_frequency_hz",
        format!("cea.max_frequency_hz = {limit}: there are no modes below it"),
        "below the first mode".to_owned(),
        Some("raise it, or ask for the lowest ones with `modes = 10` instead".to_owned()),
    )))
}
