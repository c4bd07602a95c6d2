//! The summary of one analysis of a case, as its command prints it, without a file written: what a sweep's point holds.

use super::cycle::{CycleStudy, PeriodicStudy, refuse_nothing};
use super::eigenvalues::{self, Solved};
use super::{basin, transient::TransientStudy};
use crate::*;
use frictionsim_results::cycle::CycleSummary;
use frictionsim_results::{self, Head, object};

/// Runs an analysis of a case and gives its summary; nothing is kept that would only go to files.
///
/// # Errors
/// A case without the section of the analysis, and those of the analysis.
pub fn summarize(
    case: &Case,
    analysis: Analysis,
    manifest: &Manifest,
) -> Result<Value, StudyError> {
    let start = Instant::now();
    let head = || Head::of(&case.title, start.elapsed().as_secs_f64());
    Ok(match analysis {
        // Mode shapes are not computed.
        Analysis::Cea => {
            let cea = Cea { shapes_at: Vec::new(), ..case.require_cea()?.clone() };
            let Solved { case, model, solution } = eigenvalues::solved(case, &cea, None)?;
            eigenvalues::refuse_no_modes(&case, &cea, &solution.sweep)?;
            let wall_s = start.elapsed().as_secs_f64();
            let report = eigenvalues::report(&case, &cea, &model, &solution, wall_s);
            object("cea", head(), &frictionsim_results::cea::summary(&report))?
        }
        Analysis::Transient => {
            let study = TransientStudy::new(case, SimdLevel::choose(&manifest.simd)?)?;
            let solved = study.solve()?;
            let report = study.report(&solved, start.elapsed().as_secs_f64());
            object("transient", head(), &frictionsim_results::transient::summary(&report))?
        }
        Analysis::Basin => {
            let found = basin::summary(case, manifest)?;
            object("basin", head(), &found)?
        }
        Analysis::Cycle => cycle(case, manifest, refuse_nothing)?,
    })
}

/// The limit cycles with their branches as `curves`, of which the command itself writes tables; `judge` may refuse what
/// was found.
pub(super) fn cycle(
    case: &Case,
    manifest: &Manifest,
    judge: impl Fn(&CycleSummary) -> Result<(), StudyError>,
) -> Result<Value, StudyError> {
    let start = Instant::now();
    let simd = SimdLevel::choose(&manifest.simd)?;
    let found = if case.has_rotating_waves() {
        let study = CycleStudy::new(case, simd)?;
        study.report(study.run(0, &|| {}), Vec::new())
    } else {
        let study = PeriodicStudy::new(case, simd)?;
        study.report(study.run(0, &Unwatched, &|_| {})?)
    };
    let head = Head::of(&case.title, start.elapsed().as_secs_f64());
    judge(&found)?;
    let curves = Some(found.families());
    Ok(object("cycle", head, &CycleSummary { curves, ..found })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_solved_at_the_friction_of_the_case_beside_those_that_it_lists() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/polycarbonate-disc.toml");
        let sets = [
            "mesh.circumferential_elements=12",
            "mesh.radial_elements=3",
            "mesh.element=\"quad4\"",
            "cea.friction_coefficients=[0.0, 0.05]",
            "cea.max_frequency_hz=9847",
            "contact.friction_coefficient=0.3",
        ];
        let case = Case::parse("disc", &std::fs::read(path).unwrap(), &sets.map(str::to_owned));
        let found = summarize(&case.unwrap(), Analysis::Cea, &Manifest::new("cea")).unwrap();
        let counts = found["unstable_counts"].as_array().unwrap();
        let frictions = counts.iter().map(|own| own["friction_coefficient"].as_f64().unwrap());
        assert_eq!(frictions.collect::<Vec<_>>(), [0.0, 0.05, 0.3]);
    }
}
