//! Steady sliding, reported beside the modes of an eigenvalue analysis.

use super::StudyError;
use super::assembly::base_state;
use super::model::Model;
use super::solid::SolidBody;
use crate::case::{Annulus, AssemblyBody, Body, Case, Cea, Revolution, refusal};
use crate::fem::{nodal_stress, sector};
use crate::mesh::{AnnulusMesh, Mesh, SectorMesh};
use crate::prestress::{BaseChoice, SectorSliding, SteadySliding, TangentOptions};
use crate::results::cea::{AssemblyReport, BaseField, BaseState};
use crate::study::extent_of;
use std::sync::Arc;

/// Share of the modulus below which a contact pressure is round-off.
const NO_PRESSURE: f64 = 1e-13;

/// Steady sliding at the case's own friction coefficient.
pub enum SteadyState {
    /// Of a plane body.
    Plane(Box<SteadySliding>),
    /// Of a body of revolution in three dimensions.
    Solid(Box<SolidBody>),
    /// Of solid bodies that slide on each other.
    Assembly(AssemblyReport),
}

/// A model with its mesh and its steady sliding.
pub struct SlidingModel {
    /// The mesh, of a body in three dimensions that of its section across the axis.
    pub mesh: Arc<Mesh>,
    /// What the solver takes.
    pub model: Model,
    /// Its base state.
    pub state: SteadyState,
}

/// The mesh and the base state of a body of equal sectors, from one of them.
fn sliding_sector(
    case: &Case,
    options: &TangentOptions,
) -> Result<(Arc<Mesh>, SteadyState), StudyError> {
    let sliding = &case.contact.sliding;
    Ok(match &case.body {
        Body::Annulus(Annulus { specification, materials }) => {
            let mesh = AnnulusMesh::generate(specification)?;
            let sector = SectorMesh::generate(specification)?;
            let stiffness = sector::stiffness(&sector, materials);
            let base = SectorSliding::solve(&sector, &stiffness, sliding, options.contact.law)?;
            let base = SteadySliding::from_sector(&mesh, &sector, &base, sliding);
            (Arc::new(mesh.mesh), SteadyState::Plane(Box::new(base)))
        }
        Body::Revolution(Revolution { specification, .. }) => {
            let solid = SolidBody::new(case, specification)?;
            let mut mesh = AnnulusMesh::generate(&specification.plane())?.mesh;
            mesh.regions = specification.region_names();
            (Arc::new(mesh), SteadyState::Solid(Box::new(solid)))
        }
        Body::Imported(_) | Body::Assembly(_) => unreachable!("a body of equal sectors has waves"),
    })
}

impl SlidingModel {
    /// Builds the model of a case up to its base states.
    ///
    /// # Errors
    /// A mesh that cannot be built; contact that would open on an annulus; no state of sliding; a method that needs a
    /// symmetry which is not there.
    pub fn new(case: &Case, cea: &Cea) -> Result<Self, StudyError> {
        let model = Model::new(case, cea)?;
        let (mesh, state) = match &model {
            Model::Assembly(assembly) => {
                let report = assembly.report(case);
                let mesh = Arc::clone(&assembly.body.mesh);
                (mesh, SteadyState::Assembly(report))
            }
            Model::Whole(whole) => {
                let state = SteadyState::Plane(Box::new(whole.base().clone()));
                (Arc::clone(&whole.mesh), state)
            }
            Model::Waves(options) => sliding_sector(case, options)?,
        };
        let model = Self { mesh, model, state };
        model.refuse_no_pressure(case)?;
        Ok(model)
    }

    /// Refuses a contact that nothing presses: friction does nothing there, and critical frictions would be those of no
    /// contact.
    fn refuse_no_pressure(&self, case: &Case) -> Result<(), StudyError> {
        let assembly = case.body.assembly();
        let is_free =
            |body: &AssemblyBody| body.base == BaseChoice::Closed || body.contacts.is_empty();
        let largest = self.base_state(case).pressure_pa[1];
        if largest > NO_PRESSURE * case.material.young_modulus || assembly.is_some_and(is_free) {
            return Ok(());
        }
        let named = assembly.and_then(|body| body.contacts.first());
        let key = match named.filter(|_| case.raw.find("contact").is_none()) {
            Some(contact) => format!("contacts.{}.surface", contact.name),
            None => "contact.interference".to_owned(),
        };
        let friction = case.contact.sliding.friction_coefficient;
        let message = format!(
            "nothing presses the contact: its pressure is zero everywhere at friction {friction}"
        );
        Err(StudyError::Case(refusal!(case, &key, "{message}"; "no pressure";
                "give an interference above zero, or a boundary with condition = \"pressure\"")))
    }

    /// The body in three dimensions and its base state, if it is one.
    pub fn solid(&self) -> Option<&SolidBody> {
        match &self.state {
            SteadyState::Solid(solid) => Some(solid),
            SteadyState::Plane(_) | SteadyState::Assembly(_) => None,
        }
    }

    /// The base state of solid bodies that slide on each other, if they are some.
    pub fn assembly(&self) -> Option<&AssemblyReport> {
        match &self.state {
            SteadyState::Assembly(report) => Some(report),
            SteadyState::Plane(_) | SteadyState::Solid(_) => None,
        }
    }

    /// Friction coefficients at which contact nodes open or close, rising.
    pub fn contact_changes(&self) -> &[f64] {
        match &self.model {
            Model::Whole(whole) => &whole.range.changes,
            Model::Assembly(assembly) => &assembly.range.changes,
            Model::Waves(_) => &[],
        }
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let base = match &self.state {
            SteadyState::Solid(solid) => return solid.base_state(case),
            SteadyState::Assembly(report) => return base_state(case, report),
            SteadyState::Plane(base) => base,
        };
        let friction = case.contact.sliding.friction_coefficient;
        let pressures = base.pressures(friction);
        let smallest = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let traction = base.friction.drag * friction;
        let torque = case.thickness * base.torque(friction);
        let shear = [traction * smallest, traction * largest];
        let open = base.is_pressed.iter().filter(|is_pressed| !**is_pressed).count();
        let is_straight = case.body.slides_straight();
        BaseState {
            friction_coefficient: friction,
            slipping: pressures.len() - open,
            sticking: 0,
            open,
            pressure_pa: [smallest, largest],
            shear_pa: [shear[0].min(shear[1]), shear[0].max(shear[1])],
            torque_n_m: (!is_straight).then_some(torque),
            drag_n: is_straight.then_some(torque),
            power_w: torque * case.contact.sliding.rotation_speed,
            extent: extent_of(case),
        }
    }

    /// The base state node by node.
    pub fn base_field(&self, case: &Case) -> BaseField {
        let SteadyState::Plane(base) = &self.state else {
            return BaseField::default();
        };
        let friction = case.contact.sliding.friction_coefficient;
        let displacement = base.displacement(friction);
        let pressures = base.pressures(friction);
        let traction = base.friction.drag * friction;
        BaseField {
            nodes: base.interface.nodes.clone(),
            angles: base.interface.angles.clone(),
            shears: pressures.iter().map(|pressure| traction * pressure).collect(),
            pressures,
            is_pressed: (!case.has_sectors()).then(|| base.is_pressed.clone()),
            stress: nodal_stress(&self.mesh, case.materials(), &displacement),
            displacement,
        }
    }
}
