//! The model that the eigenvalue solvers take.

use super::StudyError;
use super::solid::SolidBody;
use crate::case::{Case, Cea, CeaMethod, ModeSelection};
use crate::cea::ModeLimit;
use crate::fem::{assemble_stiffness, nodal_stress};
use crate::mesh::{AnnulusMesh, Counterface, Mesh2d, SectorMesh};
use crate::prestress::{
    SectorTangent, SlidingRange, SlidingTangent, SteadySliding, TangentOptions,
};
use crate::results::cea::{BaseField, BaseState};
use crate::study::{extent_of, tangent_options};
use std::sync::Arc;

/// The eigenvalue solver that a case gets: `auto` uses the rotational symmetry where the body has it.
pub fn method_of(case: &Case, cea: &Cea) -> CeaMethod {
    match cea.method {
        CeaMethod::Auto if case.is_annulus() => CeaMethod::Cyclic,
        CeaMethod::Auto => CeaMethod::Sparse,
        chosen => chosen,
    }
}

/// The model that the solvers take: mesh, base states, and what their tangents are made of.
pub struct SlidingModel {
    /// The mesh.
    pub mesh: Arc<Mesh2d>,
    /// Steady sliding at the friction coefficients that are solved, and last at the case's own.
    pub range: SlidingRange,
    /// How the tangent is taken.
    pub options: TangentOptions,
    /// The body and its base state where it is three-dimensional; there are no plane ones then.
    pub solid: Option<SolidBody>,
}

impl SlidingModel {
    /// Builds the model of a case up to its base states.
    ///
    /// # Errors
    /// A mesh that cannot be built; contact that would open on an annulus; no state of sliding; a method that needs a
    /// symmetry which is not there.
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, StudyError> {
        let options = tangent_options(case, cea.mass);
        let sliding = &case.contact.sliding;
        if cea.method == CeaMethod::Cyclic && !case.is_annulus() {
            return Err(StudyError::Case(case.error_at(
                "cea.method",
                "cea.method = \"cyclic\" needs the symmetry of the built-in annulus".to_owned(),
                "an imported mesh has no sectors".to_owned(),
                Some("use \"auto\" or \"sparse\"".to_owned()),
            )));
        }
        if let Some(specification) = &case.solid {
            let solid = SolidBody::new(case, cea, specification)?;
            let annulus = AnnulusMesh::generate(&solid.plane)?;
            return Ok(Self {
                mesh: Arc::new(annulus.mesh),
                range: SlidingRange::default(),
                options,
                solid: Some(solid),
            });
        }
        if method_of(case, cea) == CeaMethod::Sparse {
            let mesh = case.mesh()?;
            let stiffness = assemble_stiffness(&mesh, case.materials());
            let mut frictions = cea.solved_friction_coefficients();
            frictions.push(sliding.friction_coefficient);
            let range = SlidingRange::solve(&mesh, &stiffness, sliding, &frictions)?;
            return Ok(Self {
                mesh,
                range,
                options,
                solid: None,
            });
        }
        let annulus = AnnulusMesh::generate(&case.annulus)?;
        let sector = SectorMesh::generate(&case.annulus)?;
        let tangent = SectorTangent::linearize(&sector, case.materials(), &options, sliding)?;
        let base = SteadySliding::from_sector(&annulus, &sector, tangent.base());
        Ok(Self {
            mesh: Arc::new(annulus.mesh),
            range: SlidingRange {
                states: vec![base],
                state_of: Vec::new(),
                changes: Vec::new(),
            },
            options,
            solid: None,
        })
    }

    /// The state at the case's own friction coefficient.
    pub fn base(&self) -> &SteadySliding {
        let own = self.range.state_of.last().copied().unwrap_or(0);
        &self.range.states[own]
    }

    /// The tangent of one state over the whole mesh, for the sparse solver.
    pub fn tangent(&self, case: &Case, state: &SteadySliding) -> SlidingTangent {
        let stiffness = assemble_stiffness(&self.mesh, case.materials());
        let options = &self.options;
        SlidingTangent::linearize(&self.mesh, case.materials(), &stiffness, state, options)
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        if let Some(solid) = &self.solid {
            return solid.base_state(case);
        }
        let (base, friction) = (self.base(), case.contact.sliding.friction_coefficient);
        let pressures = base.pressures(friction);
        let smallest = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let traction = base.friction.drag * friction;
        let torque = case.thickness * base.torque(friction);
        let shear = [traction * smallest, traction * largest];
        let open = base
            .is_pressed
            .iter()
            .filter(|is_pressed| !**is_pressed)
            .count();
        let is_plane = matches!(self.mesh.counterface, Counterface::Plane { .. });
        BaseState {
            friction_coefficient: friction,
            slipping: pressures.len() - open,
            sticking: 0,
            open,
            pressure_pa: [smallest, largest],
            shear_pa: [shear[0].min(shear[1]), shear[0].max(shear[1])],
            torque_n_m: (!is_plane).then_some(torque),
            drag_n: is_plane.then_some(torque),
            power_w: torque * case.contact.sliding.rotation_speed,
            extent: extent_of(case),
        }
    }

    /// The base state node by node.
    pub fn base_field(&self, case: &Case) -> BaseField {
        if self.solid.is_some() {
            return BaseField::default();
        }
        let (base, friction) = (self.base(), case.contact.sliding.friction_coefficient);
        let displacement = base.displacement(friction);
        let pressures = base.pressures(friction);
        let traction = base.friction.drag * friction;
        BaseField {
            nodes: base.interface.nodes.clone(),
            angles: base.interface.angles.clone(),
            shears: pressures
                .iter()
                .map(|pressure| traction * pressure)
                .collect(),
            pressures,
            is_pressed: (!case.is_annulus()).then(|| base.is_pressed.clone()),
            stress: nodal_stress(&self.mesh, case.materials(), &displacement),
            displacement,
        }
    }
}

/// The modes that a case asks for.
pub fn mode_limit(cea: &Cea) -> ModeLimit {
    match cea.modes {
        ModeSelection::BelowHz(limit) => ModeLimit::MaxFrequency(limit),
        ModeSelection::Lowest(count) => ModeLimit::Lowest(count),
    }
}

/// The modes of the case's own eigenvalue analysis, else so many of the lowest.
pub fn asked_modes(case: &Case, otherwise: usize) -> ModeLimit {
    let own = case.cea.as_ref().map(mode_limit);
    own.unwrap_or(ModeLimit::Lowest(otherwise))
}
