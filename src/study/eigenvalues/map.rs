//! Stability map of a case over a second parameter.

use super::StudyError;
use super::model::{Model, Solver, mode_limit};
use crate::case::{Case, Cea, CeaMap};
use crate::cea::cyclic;
use crate::results::cea::MapReport;
use crate::study::tangent_options;

/// The stability map that a case asks for: every value makes a case of its own, validated like any other, and solved by the
/// solver of its body.
///
/// # Errors
/// A value that makes no valid case; a method that the body does not have.
pub fn map(case: &Case, cea: &Cea, map: &CeaMap) -> Result<MapReport, StudyError> {
    let frictions = cea.friction_coefficients.iter();
    let largest_friction = frictions.fold(0.0_f64, |m, &mu| m.max(mu));
    let point = |value: f64| -> Result<(f64, (Case, Solver)), StudyError> {
        let set = [format!("{}={value:?}", map.key)];
        let point = Case::from_raw(case.raw.with_overrides(&set)?)?;
        let solver = Solver::of(&point, point.require_cea()?.method)?;
        Ok((value, (point, solver)))
    };
    let values = map.values.iter().map(|&value| point(value));
    let points = values.collect::<Result<Vec<_>, StudyError>>()?;
    let limit = mode_limit(cea);
    let points = cyclic::map_of(
        &points,
        limit,
        largest_friction,
        |(point, solver), request| {
            let mass = point.cea.as_ref().map_or(cea.mass, |own| own.mass);
            let options = tangent_options(point, mass);
            let frictions = request.friction_coefficients;
            let model = Model::with_solver(point, *solver, options, frictions)?;
            let found = model.spectrum(point, request, false, &|_| {})?;
            Ok(found.sweep.intervals)
        },
    );
    Ok(MapReport {
        key: map.key.clone(),
        has_harmonics: case.has_sectors(),
        largest_friction,
        points,
    })
}
