//! From a validated case to its complex modes: which solver runs, and what it says.

use crate::app::Failure;
use crate::case::{Case, Cea, CeaMethod, ModeSelection};
use crate::cea::FrictionSweep;
use crate::cea::cyclic::{self, Coverage, CyclicError, ModeLimit, SweepRequest};
use crate::fem::nodal_stress;
use crate::mesh::AnnulusMesh;
use crate::prestress::{DampingModel, SectorTangent, TangentOptions};
use crate::results::cea::{BaseField, BaseState};

/// The outcome of a complex eigenvalue analysis.
pub struct CeaRun {
    /// The mesh.
    pub annulus: AnnulusMesh,
    /// Modes at every friction value, and where branches turn unstable.
    pub sweep: FrictionSweep,
    /// Unknowns of the eigenproblem.
    pub dofs: usize,
    /// Which solver.
    pub method: &'static str,
    /// What it has to say.
    pub notes: Vec<String>,
    /// Contact of the base state.
    pub contact: ContactTractions,
    /// Displacement of the base state at the case's friction coefficient, nodal frames, m.
    pub displacement: Vec<f64>,
}

/// Contact of the base state, in the order of the mesh's inner edge.
pub struct ContactTractions {
    /// Pressure at each contact node, Pa.
    pub pressures: Vec<f64>,
    /// Friction traction for each unit of friction coefficient, Pa.
    pub shears_per_friction: Vec<f64>,
    /// Torque for each unit of friction coefficient and of thickness, N.
    pub torque_per_friction: f64,
}

/// How the case wants its tangent taken.
pub fn tangent_options(case: &Case, cea: &Cea) -> TangentOptions {
    TangentOptions {
        mass: cea.mass,
        geometric_stiffness: cea.geometric_stiffness,
        damping: case.damping.rayleigh,
        damping_model: if case.damping.include_contact {
            DampingModel::WholeTangent
        } else {
            DampingModel::BodyOnly
        },
        contact: case.contact.stiffness,
    }
}

/// Runs the complex eigenvalue analysis of a case.
///
/// # Errors
/// A mesh that cannot be built, contact that would open, a solver that fails.
pub fn analyse(case: &Case, cea: &Cea) -> Result<CeaRun, Failure> {
    match cea.method {
        // Every mesh that a case can describe is a uniform annulus.
        CeaMethod::Auto | CeaMethod::Cyclic => analyse_cyclic(case, cea),
        CeaMethod::Sparse => Err(Failure::usage(
            "cea.method = \"sparse\" is not part of this build: use \"auto\"",
        )),
    }
}

fn analyse_cyclic(case: &Case, cea: &Cea) -> Result<CeaRun, Failure> {
    let request = SweepRequest {
        friction_coefficients: &cea.solved_friction_coefficients(),
        limit: match cea.modes {
            ModeSelection::BelowHz(limit) => ModeLimit::MaxFrequency(limit),
            ModeSelection::Lowest(count) => ModeLimit::Lowest(count),
        },
        shapes_at: &cea.shapes_at,
    };
    let found = cyclic::sweep(
        &case.annulus,
        &case.material,
        &tangent_options(case, cea),
        &case.contact.sliding,
        &request,
    )
    .map_err(|error| cyclic_failure(case, error))?;
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    let friction = case.contact.sliding.friction_coefficient;
    Ok(CeaRun {
        contact: sector_tractions(&found.tangent),
        displacement: sector_displacement(&found.tangent, friction),
        dofs: found.tangent.dimension() * annulus.sector_count(),
        method: "cyclic",
        notes: vec![describe(&found.coverage)],
        sweep: found.sweep,
        annulus,
    })
}

fn cyclic_failure(case: &Case, error: CyclicError) -> Failure {
    let message = error.to_string();
    match error {
        CyclicError::Mesh(error) => Failure::usage(error),
        CyclicError::Prestress(error) => error.into(),
        CyclicError::TooManyModes { total, .. } => {
            Failure::Case(case.error_at("cea.modes", message, format!("at most {total}"), None))
        }
        CyclicError::Friction { .. } | CyclicError::NoFriction => {
            Failure::Case(case.error_at("cea.friction_coefficients", message, String::new(), None))
        }
        _ => Failure::run(message),
    }
}

/// Which harmonics were solved, and why no other.
fn describe(coverage: &Coverage) -> String {
    let followed = &coverage.followed;
    let range = match (followed.first(), followed.last()) {
        (Some(first), Some(last)) if last - first + 1 == followed.len() && last > first => {
            format!("{first} to {last}")
        }
        _ => {
            let names: Vec<String> = followed.iter().map(usize::to_string).collect();
            names.join(", ")
        }
    };
    format!(
        "complete: harmonics {range} followed; inertia counts no mode of the others, up to {}, below \
         {:.0} Hz at friction 0",
        coverage.largest_harmonic, coverage.margin_hz
    )
}

/// Contact tractions of every node from those of one sector.
fn sector_tractions(tangent: &SectorTangent) -> ContactTractions {
    let (sector, base) = (tangent.sector(), tangent.base());
    let lengths = sector.tributary_lengths();
    let pairs = base.normal_forces.iter().zip(lengths);
    let one: Vec<f64> = pairs.map(|(force, length)| force / length).collect();
    let count = sector.sector_count();
    let pressures = one.repeat(count);
    let normal: f64 = base.normal_forces.iter().sum::<f64>() * count as f64;
    let shears = pressures.iter().map(|p| base.sliding_direction * p);
    ContactTractions {
        shears_per_friction: shears.collect(),
        torque_per_friction: base.sliding_direction * sector.specification.inner_radius * normal,
        pressures,
    }
}

/// Displacement of every node from that of one sector.
fn sector_displacement(tangent: &SectorTangent, friction: f64) -> Vec<f64> {
    let (sector, base) = (tangent.sector(), tangent.base());
    let mut one = vec![0.0; 2 * sector.node_count()];
    for (dof, pressed) in base.pressed_displacement.iter().enumerate() {
        let place = sector.numbering[dof / 2];
        one[2 * place + dof % 2] = pressed + friction * base.sheared_displacement[dof];
    }
    one.repeat(sector.sector_count())
}

impl CeaRun {
    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let friction = case.contact.sliding.friction_coefficient;
        let range = |values: &[f64], factor: f64| {
            let scaled = values.iter().map(|value| factor * value);
            let low = scaled.clone().fold(f64::INFINITY, f64::min);
            [low, scaled.fold(f64::NEG_INFINITY, f64::max)]
        };
        let torque = case.thickness * friction * self.contact.torque_per_friction;
        BaseState {
            friction_coefficient: friction,
            // The state is that of full sliding; one where a node would open does not exist.
            slipping: self.contact.pressures.len(),
            sticking: 0,
            open: 0,
            pressure_pa: range(&self.contact.pressures, 1.0),
            shear_pa: range(&self.contact.shears_per_friction, friction),
            torque_n_m: torque,
            power_w: torque * case.contact.sliding.rotation_speed,
        }
    }

    /// The base state node by node.
    pub fn base_field(&self, case: &Case) -> BaseField {
        let friction = case.contact.sliding.friction_coefficient;
        let mesh = &self.annulus.mesh;
        let edge = &mesh.inner_edge.nodes;
        let shears = self.contact.shears_per_friction.iter();
        BaseField {
            nodes: edge.clone(),
            angles: edge
                .iter()
                .map(|&n| mesh.frame_angles[n as usize])
                .collect(),
            pressures: self.contact.pressures.clone(),
            shears: shears.map(|shear| friction * shear).collect(),
            displacement: self.displacement.clone(),
            stress: nodal_stress(mesh, &case.material, &self.displacement),
        }
    }
}
