//! Eigenvalues of a body of revolution in three dimensions.

use super::StudyError;
use crate::case::{Case, Cea, CeaMethod};
use crate::cea::cyclic::SolidModel;
use crate::fem::solid;
use crate::mesh::{AnnulusSpecification, BoundaryCondition, SolidSector, SolidSpecification};
use crate::prestress::SolidSliding;
use crate::results::cea::{BaseState, SolidReport};
use crate::study::tangent_options;

/// The body with its steady sliding state.
pub struct SolidBody {
    /// What the report shows of it.
    pub report: SolidReport,
    /// Its plane section across the axis, clamped outside.
    pub plane: AnnulusSpecification,
}

impl SolidBody {
    /// Generates the body and solves its base state.
    ///
    /// # Errors
    /// A mesh that cannot be built, no state of sliding, a method for plane bodies.
    pub fn new(
        case: &Case,
        cea: &Cea,
        specification: &SolidSpecification,
    ) -> Result<Self, StudyError> {
        if cea.method == CeaMethod::Sparse {
            return Err(StudyError::Case(case.error_at(
                "cea.method",
                "cea.method = \"sparse\" is for plane bodies".to_owned(),
                "the body is three-dimensional".to_owned(),
                Some("use \"auto\" or \"cyclic\"".to_owned()),
            )));
        }
        let sector = SolidSector::generate(specification)?;
        let elastic = solid::stiffness(&sector, &case.material);
        let base = SolidSliding::solve(&sector, &elastic, &case.contact.sliding)?;
        let plane = AnnulusSpecification {
            outer: BoundaryCondition::Clamped,
            ..specification.annulus
        };
        let friction_coefficient = case.contact.sliding.friction_coefficient;
        Ok(Self {
            report: SolidReport {
                sector,
                base,
                friction_coefficient,
            },
            plane,
        })
    }

    /// What the report says of the base state.
    pub fn base_state(&self, case: &Case) -> BaseState {
        let SolidReport { sector, base, .. } = &self.report;
        let friction = case.contact.sliding.friction_coefficient;
        let sectors = sector.sector_count();
        let nodes = |is_pressed: bool| -> usize {
            let rings = sector.rings.iter().zip(&base.is_pressed);
            let own = rings.filter(|(_, pressed)| **pressed == is_pressed);
            own.map(|(ring, _)| ring.nodes.len() * sectors).sum()
        };
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            })
        };
        let shears = self.report.shears();
        let torque = base.torque(sector, friction);
        BaseState {
            friction_coefficient: friction,
            slipping: nodes(true),
            sticking: 0,
            open: nodes(false),
            pressure_pa: range(&mut base.pressures.iter().copied()),
            shear_pa: range(&mut shears.into_iter()),
            torque_n_m: Some(torque),
            drag_n: None,
            power_w: torque * case.contact.sliding.rotation_speed,
        }
    }

    /// What an open part of the contact means.
    pub fn note(&self) -> Option<String> {
        let SolidReport { sector, base, .. } = &self.report;
        let open = base.is_pressed.iter().filter(|pressed| !**pressed).count();
        (open > 0).then(|| {
            let pressed = sector.rings.iter().zip(&base.is_pressed).filter(|(_, pressed)| **pressed);
            let places: Vec<f64> = pressed
                .map(|(ring, _)| match sector.specification.contact.face().normal_component() {
                    0 => ring.height,
                    _ => ring.radius,
                })
                .collect();
            format!(
                "{open} of {} rings of contact nodes are open; the others lie at {} between {:.6} and {:.6} m",
                base.is_pressed.len(),
                if sector.specification.contact.face().normal_component() == 0 { "heights" } else { "radii" },
                places.iter().copied().fold(f64::INFINITY, f64::min),
                places.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            )
        })
    }
}

/// Everything that the eigenvalue solver needs.
///
/// # Errors
/// A case without `[cea]`.
pub fn solid_model(case: &Case, cea: &Cea) -> Result<SolidModel, StudyError> {
    let specification = case.solid.ok_or_else(|| {
        StudyError::Case(case.error_at(
            "material.formulation",
            "the case has no three-dimensional body".to_owned(),
            "a plane body".to_owned(),
            Some("set it to \"three-dimensional\", with mesh.axial_elements".to_owned()),
        ))
    })?;
    Ok(SolidModel {
        specification,
        material: case.material,
        options: tangent_options(case, cea.mass),
        contact: case.contact.sliding,
    })
}
