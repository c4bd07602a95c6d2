//! What the forces of a case are of.

use crate::case::Case;
use crate::results::Extent;

/// Whether forces, torques, powers and energies of a case are of its whole body, or for each metre of a plane body's thickness,
/// which the case does not give.
pub fn extent_of(case: &Case) -> Extent {
    if case.body.dimension() == 3 {
        return Extent::WholeBody;
    }
    match case.raw.find("geometry.thickness") {
        Some(_) => Extent::WholeBody,
        None => Extent::MetreOfThickness,
    }
}
