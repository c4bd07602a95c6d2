//! Eigenvalues of a body of revolution in three dimensions.

use super::StudyError;
use super::contact::SolidState;
use frictionsim_case::Case;
use frictionsim_physics::contact::SteadyFriction;
use frictionsim_physics::mesh::{ContactRing, SolidSector, SolidSpecification};
use frictionsim_physics::order::range;
use frictionsim_physics::prestress::SolidSliding;

/// Generates the body and solves its base state.
///
/// # Errors
/// A mesh that cannot be built, no state of sliding.
pub(super) fn solved(
    case: &Case,
    specification: &SolidSpecification,
) -> Result<SolidState, StudyError> {
    let sector = SolidSector::generate(specification)?;
    let elastic = sector.strip.stiffness_alike(case.materials());
    let (sliding, stiffness) = (&case.contact.sliding, &case.contact.stiffness);
    let base = SolidSliding::solve(&sector, &elastic, sliding, stiffness, case.mass())?;
    Ok(SolidState { sector, base })
}

/// Sliding speed (m/s) and friction at the mean radius of the contact, and the mean pressure there, Pa.
pub(super) fn mean_friction(solid: &SolidState) -> (f64, SteadyFriction, f64) {
    let rings = || solid.sector.rings.iter();
    let area: f64 = rings().map(|ring| ring.area).sum();
    let moment: f64 = rings().map(|ring| ring.area * ring.radius).sum();
    let (speed, friction) = solid.base.friction(moment / area);
    (speed, friction, solid.base.mean_pressure(&solid.sector))
}

/// What an open part of the contact means.
pub(super) fn note(solid: &SolidState) -> Option<String> {
    let SolidState { sector, base } = solid;
    let rings = sector.rings.iter().zip(&base.is_pressed);
    let pressed = rings.filter(|(_, pressed)| **pressed).map(|(ring, _)| ring);
    let pressed: Vec<_> = pressed.collect();
    let open = sector.rings.len() - pressed.len();
    let is_edge = sector.specification.contact.face().normal_component() == 0;
    let place = |ring: &&ContactRing| if is_edge { ring.height } else { ring.radius };
    let word = if is_edge { "height" } else { "radius" };
    match pressed.as_slice() {
        _ if open == 0 => None,
        [only] if base.law.is_none() => Some(format!(
            "the contact has shrunk to the ring of nodes at {word} {:.6} m, a line. Its \
             pressure is spread over the width of the mesh, {:.2e} m2 in all, and \
             contact.normal_stiffness acts on that alone. With contact.base_state = \
             \"compliant\" the stiffness of the interface gives the contact a width of its own",
            place(only),
            only.area * sector.sector_count() as f64,
        )),
        _ => {
            let [low, high] = range(pressed.iter().map(place));
            Some(format!(
                "{open} of {} rings of contact nodes are open; the others lie between {word} \
                 {low:.6} and {high:.6} m",
                sector.rings.len(),
            ))
        }
    }
}
