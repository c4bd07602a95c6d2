//! Stability map of a case over a second parameter.

use super::model::{Model, Solver, mode_limit};
use super::{Progress, StudyError};
use crate::case::{Case, Cea, CeaMap, find_key};
use crate::cea::cyclic;
use crate::cea::{PartWatch, SweepProgress, SweepStage};
use crate::results::cea::MapReport;
use crate::study::tangent_options;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A value's number, its case and the solver of its body.
type Point = (usize, Case, Solver);

/// The stability map that a case asks for: every value makes a case of its own, validated like any other, and solved by the
/// solver of its body. `watch` hears when a point is done and keeps the steps.
///
/// # Errors
/// A value that makes no valid case; a method that the body does not have.
pub fn map(
    case: &Case,
    cea: &Cea,
    map: &CeaMap,
    watch: &Progress<'_>,
) -> Result<MapReport, StudyError> {
    let frictions = cea.friction_coefficients.iter();
    let largest_friction = frictions.fold(0.0_f64, |m, &mu| m.max(mu));
    let point = |(number, &value): (usize, &f64)| -> Result<(f64, Point), StudyError> {
        let set = [format!("{}={value:?}", map.key)];
        let point = Case::read(case.raw.with_overrides(&set)?)?;
        let solver = Solver::of(&point, point.require_cea()?.method)?;
        Ok((value, (number, point, solver)))
    };
    let values = map.values.iter().enumerate().map(point);
    let points = values.collect::<Result<Vec<_>, StudyError>>()?;
    let done = AtomicUsize::new(0);
    let limit = mode_limit(cea);
    let points =
        cyclic::map_of(&points, limit, largest_friction, |(number, point, solver), request| {
            let mass = point.cea.as_ref().map_or(cea.mass, |own| own.mass);
            let options = tangent_options(point, mass);
            let frictions = request.friction_coefficients;
            let model = Model::with_solver(point, solver.clone(), options, frictions)?;
            let own = PartWatch { whole: watch, prefix: format!("map-{number}-"), is_heard: false };
            let found = model.spectrum(point, request, &own)?;
            watch.reached(SweepProgress {
                stage: SweepStage::MapPoints,
                solved: done.fetch_add(1, Ordering::Relaxed) + 1,
                total: map.values.len(),
            });
            Ok(found.sweep.intervals)
        });
    Ok(MapReport {
        key: map.key.clone(),
        unit: find_key(&map.key).map_or("", |key| key.unit).to_owned(),
        has_harmonics: case.has_sectors(),
        largest_friction,
        points,
    })
}
