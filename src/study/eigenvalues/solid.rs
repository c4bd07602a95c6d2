//! Eigenvalues of a body of revolution in three dimensions.

use super::StudyError;
use crate::case::Case;
use crate::contact::SteadyFriction;
use crate::fem::{revolved_stress, sector};
use crate::mesh::{ContactRing, SolidSector, SolidSpecification};
use crate::prestress::SolidSliding;
use crate::results::cea::{BaseState, SolidReport};
use crate::study::extent_of;

/// The body with its steady sliding state.
pub struct SolidBody {
    /// What the report shows of it.
    pub report: SolidReport,
}

impl SolidBody {
    /// Generates the body and solves its base state.
    ///
    /// # Errors
    /// A mesh that cannot be built, no state of sliding.
    pub fn new(case: &Case, specification: &SolidSpecification) -> Result<Self, StudyError> {
        let sector = SolidSector::generate(specification)?;
        let elastic = sector::stiffness(&sector, case.materials());
        let law = case.contact.stiffness.base_law();
        let base = SolidSliding::solve(&sector, &elastic, &case.contact.sliding, law, case.mass())?;
        let friction_coefficient = case.contact.sliding.friction_coefficient;
        let displacement = base.displacement(friction_coefficient);
        let stress = revolved_stress(&sector, case.materials(), &displacement);
        Ok(Self { report: SolidReport { sector, stress, base, friction_coefficient } })
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
            extent: extent_of(case),
        }
    }

    /// Friction at the mean radius of the contact, and the mean pressure there, Pa.
    pub fn mean_friction(&self) -> (SteadyFriction, f64) {
        let SolidReport { sector, base, .. } = &self.report;
        let friction = base.friction(self.mean_radius()).1;
        (friction, base.mean_pressure(sector))
    }

    /// The dashpot `mu p / V` of friction across the sliding, Pa s/m, at the mean radius and pressure.
    pub fn dashpot_across(&self, friction_coefficient: f64) -> f64 {
        let SolidReport { sector, base, .. } = &self.report;
        let (speed, friction) = base.friction(self.mean_radius());
        friction_coefficient * friction.drag.abs() * base.mean_pressure(sector) / speed
    }

    /// Mean radius of the contact, m.
    fn mean_radius(&self) -> f64 {
        let rings = || self.report.sector.rings.iter();
        let area: f64 = rings().map(|ring| ring.area).sum();
        let moment: f64 = rings().map(|ring| ring.area * ring.radius).sum();
        moment / area
    }

    /// What an open part of the contact means.
    pub fn note(&self) -> Option<String> {
        let SolidReport { sector, base, .. } = &self.report;
        let rings = sector.rings.iter().zip(&base.is_pressed);
        let pressed = rings.filter(|(_, pressed)| **pressed).map(|(ring, _)| ring);
        let pressed: Vec<_> = pressed.collect();
        let open = sector.rings.len() - pressed.len();
        let is_edge = sector.specification.contact.face().normal_component() == 0;
        let place = |ring: &&ContactRing| if is_edge { ring.height } else { ring.radius };
        let word = if is_edge { "height" } else { "radius" };
        match pressed.as_slice() {
            _ if open == 0 => None,
            [only] => Some(format!(
                "the contact has shrunk to the ring of nodes at {word} {:.6} m, a line. Its \
                 pressure is spread over the width of the mesh, {:.2e} m2 in all, and \
                 contact.normal_stiffness acts on that alone. With contact.base_state = \
                 \"compliant\" the stiffness of the interface gives the contact a width of its own",
                place(only),
                only.area * sector.sector_count() as f64,
            )),
            _ => Some(format!(
                "{open} of {} rings of contact nodes are open; the others lie between {word} {:.6} and {:.6} m",
                sector.rings.len(),
                pressed.iter().map(place).fold(f64::INFINITY, f64::min),
                pressed.iter().map(place).fold(f64::NEG_INFINITY, f64::max),
            )),
        }
    }
}
