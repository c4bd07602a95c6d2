//! A case on several meshes and with several time steps, and what is compared between them.
//!
//! ```no_run
//! use frictionsim::case::Case;
//! use frictionsim::fem::operator::SimdLevel;
//! use frictionsim::results::Manifest;
//! use frictionsim::study::convergence::{levels, solve};
//!
//! let case = Case::parse("disc", &std::fs::read("cases/convergence.toml")?, &[])?;
//! let levels = levels(&case, SimdLevel::detect())?;
//! for series in solve(&case, &levels, &Manifest::new("convergence"), &|| {})? {
//!     println!("{} over {}", series.analysis, series.levels.join(", "));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod quantities;

use super::{eigenvalues, summarize, summary, transient::TransientStudy};
use crate::*;
use frictionsim_case::TimeStep;
use frictionsim_results::convergence::{Quantity, Refinement, Series};

/// Distance of the finest value from the limit, relative to the largest, from which on order and limit are rough.
const FAR: f64 = 0.05;

/// Levels of one series: the same case refined.
pub struct Levels {
    /// What runs.
    pub analysis: Analysis,
    /// What is refined.
    pub refinement: Refinement,
    /// One case for each level, coarsest first.
    pub cases: Vec<Case>,
}

/// A level done: the modes of `cea`, the summary of any other analysis, and the wall time, s.
type Done = (FrictionSweep, (Value, f64));

/// The levels that a case asks for.
///
/// # Errors
/// [`StudyError::Case`] for a case without `[convergence]`, or that makes no valid case when refined.
pub fn levels(case: &Case, simd: SimdLevel) -> Result<Vec<Levels>, StudyError> {
    let convergence = case.require_convergence()?;
    let meshes = convergence.factors.iter().map(|&factor| case.refined(factor));
    let meshes = meshes.collect::<Result<Vec<Case>, _>>()?;
    let over_meshes = convergence.analyses.iter().map(|&analysis| Levels {
        analysis,
        refinement: Refinement::Mesh,
        cases: match analysis {
            Analysis::Cycle => meshes.iter().map(own_cycles).collect(),
            _ => meshes.clone(),
        },
    });
    let mut all: Vec<Levels> = over_meshes.collect();
    if !convergence.time_step_factors.is_empty() {
        let study = TransientStudy::new(case, simd)?;
        let step = study.plan(study.operator()?.as_ref())?.time_step;
        let factors = convergence.time_step_factors.iter();
        all.push(Levels {
            analysis: Analysis::Transient,
            refinement: Refinement::TimeStep,
            cases: factors.map(|&f| with_time_step(case, f * step)).collect(),
        });
    }
    Ok(all)
}

/// Solves every level, side by side, the costliest first, and compares them; `done` hears of every level.
///
/// # Errors
/// Those of the first level that cannot be solved; time steps that are the same.
pub fn solve(
    case: &Case,
    levels: &[Levels],
    manifest: &Manifest,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Series>, StudyError> {
    let jobs =
        levels.iter().flat_map(|study| study.cases.iter().map(|case| (study.analysis, case)));
    // Finest meshes and shortest steps stand last in each study.
    let jobs: Vec<(Analysis, &Case)> = jobs.collect();
    let solved: Vec<Result<Done, StudyError>> =
        parallel::map(jobs.iter().rev(), |(analysis, case)| {
            let start = Instant::now();
            let (mut sweep, mut summary) = (FrictionSweep::default(), Value::Null);
            match analysis {
                Analysis::Cea => sweep = eigenvalues::modes_and_onsets(case)?,
                // That a level has no cycle is said beside the others.
                Analysis::Cycle => summary = summary::cycle(case, manifest, |_| Ok(()))?,
                other => summary = summarize(case, *other, manifest)?,
            }
            done();
            Ok((sweep, (summary, start.elapsed().as_secs_f64())))
        });
    // The first level that failed speaks, whichever thread was first.
    let mut solved = solved.into_iter().rev().collect::<Result<Vec<Done>, _>>()?.into_iter();
    let of_each = levels.iter().map(|study| {
        let outcomes = solved.by_ref().take(study.cases.len()).collect();
        series(case, study, outcomes)
    });
    Ok(of_each.collect::<Result<Vec<_>, _>>()?.concat())
}

fn with_time_step(case: &Case, step: f64) -> Case {
    let mut case = case.clone();
    if let Some(transient) = &mut case.transient {
        transient.settings.time_step = TimeStep::Seconds(step);
    }
    case
}

/// The case with the limit cycles at its own operating point alone.
fn own_cycles(case: &Case) -> Case {
    let mut case = case.clone();
    if let Some(cycle) = &mut case.cycle {
        cycle.continuation = None;
        cycle.stability = StabilityChoice::None;
    }
    case
}

/// The series of a study: one, or for limit cycles one for each family.
fn series(case: &Case, study: &Levels, done: Vec<Done>) -> Result<Vec<Series>, StudyError> {
    let (sweeps, (summaries, wall_s)): (Vec<_>, (Vec<Value>, Vec<f64>)) = done.into_iter().unzip();
    let steps = summaries.iter().filter_map(|summary| summary["time_step_s"].as_f64());
    let steps: Vec<f64> = steps.collect();
    let (sizes, levels): (Vec<f64>, Vec<String>) = match study.refinement {
        Refinement::Mesh => study.cases.iter().map(mesh_level).unzip(),
        Refinement::TimeStep => steps.iter().map(|&s| (s, format!("{s:.4e}"))).unzip(),
    };
    if sizes.windows(2).any(|pair| pair[1] >= pair[0]) {
        return Err(StudyError::Case(refusal!(case, "convergence.time_step_factors",
            "convergence.time_step_factors gives the time steps {} s: two are the same, as a step \
             divides output.sample_interval", levels.join(", ");
            "factors further apart")));
    }
    let is_graded = case.number("mesh.radial_grading").is_some_and(|own| own != 1.0);
    let grading = (is_graded && study.refinement == Refinement::Mesh).then(|| {
        "mesh.radial_grading is that of the case's own mesh. Each other one has the root or power \
         of it with which the largest element stays as many times the smallest"
            .to_owned()
    });
    let of = |analysis: &str, quantities: Vec<Quantity>, notes: Vec<String>| Series {
        analysis: analysis.to_owned(),
        refinement: study.refinement,
        levels: levels.clone(),
        sizes: sizes.clone(),
        notes: notes.into_iter().chain(grading.clone()).chain(far_note(&quantities)).collect(),
        quantities,
        wall_s: wall_s.clone(),
    };
    Ok(match study.analysis {
        Analysis::Cea => {
            let (quantities, notes) = quantities::of_sweeps((case, &study.cases), &sizes, sweeps)?;
            vec![of("cea", quantities, notes)]
        }
        Analysis::Transient => {
            let steps: Vec<String> = steps.iter().map(|step| format!("{step:.4e}")).collect();
            let is_finer = study.refinement == Refinement::Mesh;
            let notes = is_finer.then(|| format!("time steps {} s", steps.join(", ")));
            let quantities = quantities::of_transients(&sizes, &summaries, extent_of(case));
            vec![of("transient", quantities, notes.into_iter().collect())]
        }
        Analysis::Basin => vec![of("basin", Vec::new(), Vec::new())],
        Analysis::Cycle => quantities::by_family(&summaries)
            .into_iter()
            .map(|(family, cycles)| {
                let phases = cycles.iter().map(|cycle| match cycle["phases"].as_u64() {
                    Some(phases) => phases.to_string(),
                    None => "no".to_owned(),
                });
                let mut notes = vec![format!("{} phases", phases.collect::<Vec<_>>().join(", "))];
                for (level, cycle) in levels.iter().zip(&cycles) {
                    let error = cycle["error"].as_str();
                    notes.extend(error.map(|error| format!("{level}: {error}")));
                    if cycle["confirmation"]["agrees"] == false {
                        notes.push(format!(
                            "{level}: NOT CONFIRMED: a transient does not stay on the cycle found: take a finer mesh"
                        ));
                    }
                }
                let quantities = quantities::of_limit_cycles(&sizes, &cycles, extent_of(case));
                of(&format!("cycle-{}", family.tag()), quantities, notes)
            })
            .collect(),
    })
}

/// Limits that lie far from what the finest level has.
fn far_note(quantities: &[Quantity]) -> Option<String> {
    let away = |own: &Quantity| {
        let (limit, finest) = own.extrapolated.zip(own.values.last().copied().flatten())?;
        let values = own.values.iter().flatten();
        let away = (finest - limit).abs() / values.fold(limit.abs(), |most, v| most.max(v.abs()));
        (away > FAR).then(|| (away, own.name.clone()))
    };
    let far = sorted(quantities.iter().filter_map(away), |own| -own.0);
    let (away, name) = far.first()?;
    let [away, most] = [*away, FAR].map(|share| 100.0 * share);
    Some(format!(
        "{name}: the limit is {away:.0} % of its largest value away from the finest level. More than {most:.0} % ({} \
         here) is an extrapolation of levels too coarse to tell order and error: refine further",
        far.len()
    ))
}

/// Element size and name of a mesh: the size is the side of a square of the mean element area, m.
fn mesh_level(case: &Case) -> (f64, String) {
    let (body, solid) = (&case.body, case.body.revolved());
    let Some(grid) = solid.map(|own| &own.annulus).or(body.grid()) else {
        let count = body.element_count();
        let size = match body.dimension() {
            3 => 2.0 * body.size() / (count as f64).cbrt(),
            _ => (body.area() / count as f64).sqrt(),
        };
        return (size, format!("{count} elements"));
    };
    let (around, radial) = (grid.circumferential_elements, grid.radial_elements);
    let size = (body.area() / (around as f64 * radial as f64)).sqrt();
    let layers = solid.map(|own| format!(" x {}", own.axial_elements));
    (size, format!("{around} x {radial}{}", layers.unwrap_or_default()))
}
