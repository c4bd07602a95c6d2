//! `frictionsim convergence`: a case on several meshes and with several time steps.

use super::{Failure, RunOptions, Session, basin, cycle, terminal, transient};
use crate::case::{Analysis, Case, Convergence, StabilityChoice, TimeStep};
use crate::cea::FrictionSweep;
use crate::results::convergence::{
    ConvergenceReport, Quantity, Refinement, Series, draw, print, write,
};
use crate::results::summary::PointSummary;
use crate::results::{DrawingOptions, Manifest, OutputFolder, read_record};
use crate::study::convergence as quantities;
use crate::study::eigenvalues;
use clap::Args;
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::Value;
use std::f64::consts::TAU;
use std::time::Instant;

/// Convergence over mesh and time step
///
/// Runs the eigenvalue analysis, the transient and the limit cycles of a case on refined meshes, and the
/// transient with shorter time steps; reads the observed order off the three finest, extrapolates after Richardson, and
/// says where a quantity does not converge. Needs a [convergence] section in the case.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

/// Levels of one series: the same case refined.
struct Study {
    analysis: Analysis,
    refinement: Refinement,
    /// One case for each level, coarsest first.
    cases: Vec<Case>,
}

/// What one level gave.
enum Outcome {
    Cea(FrictionSweep),
    Summary(Box<PointSummary>),
}

/// A level done, and its wall time, s.
type Timed = (Outcome, f64);

/// Runs the subcommand.
///
/// # Errors
/// A bad case (exit code 2); a level that cannot be solved (1).
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("convergence", &arguments.options)?;
    let case = &session.case;
    let convergence = case.require_convergence()?;
    let studies = studies(case, convergence, &session.manifest)?;
    session.check_memory(studies.iter().map(memory_bytes).sum())?;
    let folder = session.open_folder()?;
    terminal::catch_signals(terminal::NOTHING_KEPT);

    let mut all = Vec::new();
    let levels = studies.iter().map(|study| study.cases.len() as u64).sum();
    let bar = terminal::progress(session.options.output.is_quiet(), levels, "levels");
    let solved = solve(&studies, &session.manifest, &bar);
    bar.finish_and_clear();
    for (outcomes, study) in solved?.into_iter().zip(&studies) {
        all.extend(series(case, study, outcomes)?);
    }
    let report = ConvergenceReport {
        title: case.title.clone(),
        series: all,
        wall_s: session.wall_seconds(),
    };
    let summary = write(&folder, &report)?;
    if !session.options.output.no_figures {
        draw(&folder, &report, &session.options.output.figures.drawing())?;
    }
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&print(&report), &summary, &path)
}

/// Draws the figures of a folder again, from its `record.bin`.
///
/// # Errors
/// A folder without a whole record; those of the drawing and of the folder.
pub fn redraw(folder: &OutputFolder, options: &DrawingOptions) -> Result<(), Failure> {
    let report: ConvergenceReport = read_record(folder.path())?;
    draw(folder, &report, options)?;
    Ok(())
}

/// The levels that a case asks for.
fn studies(
    case: &Case,
    convergence: &Convergence,
    manifest: &Manifest,
) -> Result<Vec<Study>, Failure> {
    let meshes: Result<Vec<Case>, Failure> = convergence
        .factors
        .iter()
        .map(|&factor| case.refined(factor).map_err(Failure::Case))
        .collect();
    let meshes = meshes?;
    let over_meshes = convergence.analyses.iter().map(|&analysis| Study {
        analysis,
        refinement: Refinement::Mesh,
        cases: meshes.clone(),
    });
    let mut studies: Vec<Study> = over_meshes.collect();
    if !convergence.time_step_factors.is_empty() {
        let step = transient::time_step(case, manifest)?;
        let factors = convergence.time_step_factors.iter();
        studies.push(Study {
            analysis: Analysis::Transient,
            refinement: Refinement::TimeStep,
            cases: factors.map(|&f| with_time_step(case, f * step)).collect(),
        });
    }
    Ok(studies)
}

fn with_time_step(case: &Case, step: f64) -> Case {
    let mut case = case.clone();
    if let Some(transient) = &mut case.transient {
        transient.time_step = TimeStep::Seconds(step);
    }
    case
}

/// Memory of all levels of a study at once: they run side by side.
fn memory_bytes(study: &Study) -> f64 {
    let bytes = study.cases.iter().map(|case| {
        let cost = case.cost();
        cost.mesh_memory_bytes
            + match study.analysis {
                Analysis::Cea => cost.cea.map_or(0.0, |cea| cea.memory_bytes),
                Analysis::Transient => cost.transient.map_or(0.0, |run| run.memory_bytes),
                // Receptances of one sector at a few hundred phases.
                Analysis::Cycle | Analysis::Basin => 0.0,
            }
    });
    bytes.sum()
}

/// Solves every level of every study, side by side, the costliest first.
fn solve(
    studies: &[Study],
    manifest: &Manifest,
    bar: &ProgressBar,
) -> Result<Vec<Vec<Timed>>, Failure> {
    let jobs = studies.iter().flat_map(|study| {
        let cases = study.cases.iter();
        cases.map(|case| (study.analysis, case))
    });
    // Finest meshes and shortest steps stand last in each study.
    let jobs: Vec<(Analysis, &Case)> = jobs.collect();
    let solved: Vec<Result<Timed, Failure>> = jobs
        .par_iter()
        .with_max_len(1)
        .rev()
        .map(|(analysis, case)| {
            let start = Instant::now();
            let outcome = match analysis {
                Analysis::Cea => Outcome::Cea(eigenvalues::modes_and_onsets(case)?),
                Analysis::Transient => summarized(&transient::summarize(case, manifest)?)?,
                Analysis::Basin => summarized(&basin::summarize(case, manifest)?)?,
                Analysis::Cycle => summarized(&cycle::attempt(&own_cycles(case), manifest)?)?,
            };
            bar.inc(1);
            Ok((outcome, start.elapsed().as_secs_f64()))
        })
        .collect();
    // The first level that failed speaks, whichever thread was first.
    let mut solved = solved.into_iter().rev();
    studies
        .iter()
        .map(|study| solved.by_ref().take(study.cases.len()).collect())
        .collect()
}

fn summarized(summary: &Value) -> Result<Outcome, Failure> {
    let read = PointSummary::read(summary).map_err(Failure::run)?;
    Ok(Outcome::Summary(Box::new(read)))
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
fn series(case: &Case, study: &Study, outcomes: Vec<Timed>) -> Result<Vec<Series>, Failure> {
    let (outcomes, wall_s): (Vec<Outcome>, Vec<f64>) = outcomes.into_iter().unzip();
    let (mut sweeps, mut summaries) = (Vec::new(), Vec::new());
    for outcome in outcomes {
        match outcome {
            Outcome::Cea(sweep) => sweeps.push(sweep),
            Outcome::Summary(summary) => summaries.push(*summary),
        }
    }
    let steps = summaries
        .iter()
        .filter_map(|s: &PointSummary| s.time_step_s);
    let steps: Vec<f64> = steps.collect();
    let (sizes, levels): (Vec<f64>, Vec<String>) = match study.refinement {
        Refinement::Mesh => study.cases.iter().map(mesh_level).unzip(),
        Refinement::TimeStep => steps.iter().map(|&s| (s, format!("{s:.4e}"))).unzip(),
    };
    if sizes.windows(2).any(|pair| pair[1] >= pair[0]) {
        return Err(Failure::Case(case.error_at(
            "convergence.time_step_factors",
            format!(
                "convergence.time_step_factors gives the time steps {} s: two are the same, as a step \
                 divides output.sample_interval",
                levels.join(", ")
            ),
            "factors further apart".to_owned(),
            None,
        )));
    }
    let of = |analysis: &str, quantities: Vec<Quantity>, notes: Vec<String>| Series {
        analysis: analysis.to_owned(),
        refinement: study.refinement,
        levels: levels.clone(),
        sizes: sizes.clone(),
        quantities,
        wall_s: wall_s.clone(),
        notes,
    };
    Ok(match study.analysis {
        Analysis::Cea => {
            let (quantities, notes) = quantities::of_sweeps(case, &sizes, &sweeps);
            vec![of("cea", quantities, notes)]
        }
        Analysis::Transient => {
            let steps: Vec<String> = steps.iter().map(|step| format!("{step:.4e}")).collect();
            let notes = match study.refinement {
                Refinement::Mesh => vec![format!("time steps {} s", steps.join(", "))],
                Refinement::TimeStep => Vec::new(),
            };
            let quantities = quantities::of_transients(&sizes, &summaries);
            vec![of("transient", quantities, notes)]
        }
        Analysis::Basin => vec![of("basin", Vec::new(), Vec::new())],
        Analysis::Cycle => quantities::by_family(&summaries)
            .into_iter()
            .map(|(family, cycles)| {
                let phases = cycles.iter().map(|cycle| match cycle.phases {
                    Some(phases) => phases.to_string(),
                    None => "no".to_owned(),
                });
                let mut notes = vec![format!("{} phases", phases.collect::<Vec<_>>().join(", "))];
                for (level, cycle) in levels.iter().zip(&cycles) {
                    let error = cycle.error.as_ref();
                    notes.extend(error.map(|error| format!("{level}: {error}")));
                    if cycle.confirmation.and_then(|said| said.agrees) == Some(false) {
                        notes.push(format!(
                            "{level}: NOT CONFIRMED: a transient does not stay on the cycle found: take a finer mesh"
                        ));
                    }
                }
                let quantities = quantities::of_limit_cycles(&sizes, &cycles);
                of(&format!("cycle-{}", family.tag()), quantities, notes)
            })
            .collect(),
    })
}

/// Element size and name of a mesh: the size is the side of a square of the mean element area, m.
fn mesh_level(case: &Case) -> (f64, String) {
    if let Some(body) = &case.body {
        let (mesh, count) = (&body.mesh, body.mesh.element_count());
        return (
            (mesh.area() / count as f64).sqrt(),
            format!("{count} elements"),
        );
    }
    let annulus = &case.annulus;
    let area = 0.5 * TAU * (annulus.outer_radius.powi(2) - annulus.inner_radius.powi(2));
    let (around, radial) = (annulus.circumferential_elements, annulus.radial_elements);
    let size = (area / (around as f64 * radial as f64)).sqrt();
    let layers = case
        .solid
        .map(|solid| format!(" x {}", solid.axial_elements));
    (
        size,
        format!("{around} x {radial}{}", layers.unwrap_or_default()),
    )
}
