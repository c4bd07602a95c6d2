//! Steady sliding, reported beside the modes of an eigenvalue analysis.

use super::StudyError;
use super::model::Model;
use super::solid;
use super::whole::Sliding;
use crate::extent_of;
use frictionsim_case::{Annulus, AssemblyBody, Body, Case, Cea, Revolution, refusal};
use frictionsim_physics::fem::{nodal_stress, sector};
use frictionsim_physics::mesh::{AnnulusMesh, Mesh, SectorMesh};
use frictionsim_physics::order::range;
use frictionsim_physics::prestress::{BaseChoice, SectorSliding, SteadySliding, TangentOptions};
use frictionsim_results::cea::{AssemblyReport, BaseField, BaseState, SolidReport};
use std::sync::Arc;

/// Share of the modulus below which a contact pressure is round-off.
const NO_PRESSURE: f64 = 1e-13;

/// Steady sliding at the case's own friction coefficient.
pub enum SteadyState {
    /// Of a plane body.
    Plane(Box<SteadySliding>),
    /// Of a body of revolution in three dimensions.
    Solid(Box<SolidReport>),
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
            let solid = solid::solved(case, specification)?;
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
            Model::Whole(whole) => {
                let state = match &whole.sliding {
                    Sliding::Edge(base) => SteadyState::Plane(base.clone()),
                    Sliding::Bodies(joined) => SteadyState::Assembly(whole.report(case, joined)),
                };
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
    pub fn solid(&self) -> Option<&SolidReport> {
        if let SteadyState::Solid(own) = &self.state { Some(own) } else { None }
    }

    /// The base state of solid bodies that slide on each other, if they are some.
    pub fn assembly(&self) -> Option<&AssemblyReport> {
        if let SteadyState::Assembly(own) = &self.state { Some(own) } else { None }
    }

    /// Friction coefficients at which contact nodes open or close, rising.
    pub fn contact_changes(&self) -> &[f64] {
        match &self.model {
            Model::Whole(whole) => &whole.range.changes,
            Model::Waves(_) => &[],
        }
    }

    /// What the report says of the base state, scaled to the case's thickness.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let friction = case.contact.sliding.friction_coefficient;
        let speed = case.contact.sliding.rotation_speed;
        match &self.state {
            SteadyState::Solid(solid) => {
                let torque = solid.base.torque(&solid.sector, friction);
                let tractions =
                    [range(solid.base.pressures.iter().copied()), range(solid.shears())];
                base_state(case, solid::node_counts(solid), tractions, [torque, torque * speed])
            }
            SteadyState::Assembly(report) => {
                let points = || report.points.iter();
                let closed = points().filter(|point| point.is_closed).count();
                let power: f64 = points().map(|point| point.shear * point.area * point.speed).sum();
                let drive = if speed == 0.0 { 0.0 } else { power / speed };
                let tractions =
                    [range(points().map(|own| own.pressure)), range(points().map(|own| own.shear))];
                let counts = [closed, report.points.len() - closed];
                base_state(case, counts, tractions, [drive, power])
            }
            SteadyState::Plane(base) => {
                let pressures = range(base.pressures(friction));
                let traction = base.friction.drag * friction;
                let shears = range(pressures.map(|pressure| traction * pressure));
                let torque = case.thickness * base.torque(friction);
                let open = base.is_pressed.iter().filter(|is_pressed| !**is_pressed).count();
                let counts = [base.is_pressed.len() - open, open];
                base_state(case, counts, [pressures, shears], [torque, torque * speed])
            }
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

/// The base state with so many contact nodes that slip and that are open, the range of pressure and of shear, and
/// torque or drag with its power.
fn base_state(
    case: &Case,
    [slipping, open]: [usize; 2],
    [pressure_pa, shear_pa]: [[f64; 2]; 2],
    [drive, power_w]: [f64; 2],
) -> BaseState {
    let is_straight = case.body.slides_straight();
    BaseState {
        friction_coefficient: case.contact.sliding.friction_coefficient,
        slipping,
        sticking: 0,
        open,
        pressure_pa,
        shear_pa,
        torque_n_m: (!is_straight).then_some(drive),
        drag_n: is_straight.then_some(drive),
        power_w,
        extent: extent_of(case),
    }
}
