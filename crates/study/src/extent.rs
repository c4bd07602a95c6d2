//! What the forces of a case are of.

use frictionsim_case::Case;
use frictionsim_results::Extent;

/// Whether forces, torques, powers and energies of a case are of its whole body, or for each metre of a plane body's
/// thickness, which the case does not give.
pub fn extent_of(case: &Case) -> Extent {
    let is_whole = case.body.dimension() == 3 || case.raw.find("geometry.thickness").is_some();
    if is_whole { Extent::WholeBody } else { Extent::MetreOfThickness }
}
