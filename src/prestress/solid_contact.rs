//! Contact terms in the tangent of a body of revolution.

use super::solid::{SolidSliding, along_element};
use crate::contact::ContactStiffness;
use crate::fem::fold::SectorMatrix;
use crate::fem::solid::{FaceTerm, face_matrix};
use crate::mesh::{FaceElement, SolidSector};

/// Matrices of the contact.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactTerms {
    /// Penalty stiffness at rest and its friction; empty for rigid contact.
    pub penalty: [SectorMatrix; 2],
    /// Contact dashpots at rest and their friction.
    pub dashpots: [SectorMatrix; 2],
    /// `p_0 / V` across the sliding, and `p_0 mu'(V) / mu` along it where friction falls with the speed.
    pub friction_dashpots: SectorMatrix,
}

/// A weight from the element, the radius (m) and the place along the element.
type Weight<'a> = &'a dyn Fn(&FaceElement, f64, f64) -> f64;

/// The matrices of the contact of a state.
pub(super) fn contact_terms(
    base: &SolidSliding,
    sector: &SolidSector,
    contact: &ContactStiffness,
) -> ContactTerms {
    let face = sector.specification.contact.face();
    let (normal, side) = (face.normal_component(), face.across_component());
    let faces = sector.contact_elements();
    let span = |element: &FaceElement| base.pressed_span(sector, element);
    let term = |row, column, is_nodal, weight: Weight<'_>| {
        let term = FaceTerm { row, column, weight, span: &span, is_nodal };
        face_matrix(sector, &faces, &term)
    };
    let pressure = |element: &FaceElement, at| base.pressure_along(sector, element, at);
    let pressed = |row, column, weight: Weight<'_>| {
        term(row, column, true, &|element, r, at| match pressure(element, at) > 0.0 {
            true => weight(element, r, at),
            false => 0.0,
        })
    };

    // What acts along the normal is dragged along by friction.
    let drag = |r: f64| face.inward_sign() * base.friction(r).1.drag;
    let normal_and_drag = |weight: Weight<'_>| {
        let dragged = |element: &FaceElement, r: f64, at: f64| weight(element, r, at) * drag(r);
        [pressed(normal, normal, weight), pressed(1, normal, &dragged)]
    };
    let mut dashpots: [SectorMatrix; 2] = match contact.normal_damping {
        0.0 => Default::default(),
        damping => normal_and_drag(&|_, _, _| damping),
    };
    let tangential = contact.tangential_damping;
    if tangential != 0.0 {
        for component in [1, side] {
            dashpots[0] = dashpots[0].plus(&pressed(component, component, &|_, _, _| tangential));
        }
    }

    // Coulomb's law as a vector, and its slope over the speed.
    let mut friction_dashpots = term(side, side, false, &|element, r, at| {
        let (speed, friction) = base.friction(r);
        pressure(element, at) * friction.drag * base.sliding_direction / speed
    });
    if base.contact.decay.is_some() {
        let slope = |r: f64| base.friction(r).1.slope;
        let along = term(1, 1, false, &|element, r, at| pressure(element, at) * slope(r));
        friction_dashpots = friction_dashpots.plus(&along);
    }
    ContactTerms {
        penalty: match (base.law, contact.normal_stiffness) {
            (Some(law), _) => normal_and_drag(&|element, _, at| {
                law.stiffness(along_element(sector, &base.approaches, element, at).max(0.0))
            }),
            (None, Some(own)) => normal_and_drag(&|_, _, _| own),
            (None, None) => Default::default(),
        },
        dashpots,
        friction_dashpots,
    }
}
