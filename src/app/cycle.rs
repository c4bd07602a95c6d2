//! `frictionsim cycle`: limit cycles found directly, and followed over a parameter.

use super::session::{available_memory, gibibytes};
use super::{Failure, ResumedRun, Session, terminal};
use crate::case::{Case, refusal};
use crate::results::OutputFolder;
use crate::results::cea::KeptSteps;
use crate::results::cycle::{CycleReport, SoughtCycle};
use crate::study::cycle::{CycleStudy, PeriodicStudy, refuse_nothing};
use serde_json::Value;

/// What an interrupted search for motions of two frequencies leaves.
const KEPT_PAIRS: &str =
    "motions of two frequencies that are done are kept: the same command with --resume goes on";

/// What an interrupted search for motions of the whole mesh leaves.
const KEPT: &str = "cycles and points of branches that are done are kept (done-modeK.json: a mode \
    that is done). The same command with --resume goes on";

pub(super) fn run(asked: &ResumedRun) -> Result<(), Failure> {
    let session = Session::start("cycle", &asked.options)?;
    let case = &session.case;
    case.require_cycle()?;
    session.check_memory(case.memory("cycle").0)?;
    match case.has_rotating_waves() {
        true => waves(&session, asked.resume),
        false => motions(&session, asked.resume),
    }
}

/// Searches for rotating waves.
fn waves(session: &Session, is_continued: bool) -> Result<(), Failure> {
    check_memory(&session.case)?;
    let study = CycleStudy::new(&session.case, session.simd)?;
    let folder = session.open_folder(is_continued)?;
    let families = study.solvers.len() as u64;
    let bar = terminal::progress(session.options.output.is_quiet(), families, "families");
    let steps = KeptSteps::new(&folder, is_continued, &|_| {})?;
    terminal::catch_signals(match study.choices.two_frequencies {
        true => KEPT_PAIRS,
        false => terminal::NOTHING_KEPT,
    });
    let results = study.run(study.choices.frames, &|| bar.inc(1));
    bar.finish_and_clear();
    let two_waves = study.two_waves(&results, &steps);
    let report = study.report(results, two_waves, session.wall_seconds());
    let (text, object) = written(session, &folder, &report)?;
    steps.discard()?;
    session.options.output.finish(folder, &text, &object)
}

/// Searches for motions of the whole mesh.
fn motions(session: &Session, is_continued: bool) -> Result<(), Failure> {
    let study = PeriodicStudy::new(&session.case, session.simd)?;
    let folder = session.open_folder(is_continued)?;
    let steps = KeptSteps::new(&folder, is_continued, &|_| {})?;
    let sought = study.sought.len() as u64;
    let bar = terminal::progress(session.options.output.is_quiet(), sought, "modes");
    terminal::catch_signals(KEPT);
    let kept_name = |own: &SoughtCycle| format!("done-{}.json", own.name.tag());
    let results = study.run(study.choices.frames, &steps, &|result| {
        bar.inc(1);
        for own in study.report(vec![result.clone()], 0.0).cycles {
            let kept = folder
                .write(&kept_name(&own), |out| Ok(serde_json::to_writer_pretty(&mut *out, &own)?));
            if let Err(error) = kept {
                tracing::warn!("{error}");
            }
        }
    })?;
    bar.finish_and_clear();
    let report = study.report(results, session.wall_seconds());
    let kept: Vec<String> = report.cycles.iter().map(kept_name).collect();
    let (text, object) = written(session, &folder, &report)?;
    kept.iter().try_for_each(|name| folder.discard(name))?;
    steps.discard()?;
    session.options.output.finish(folder, &text, &object)
}

/// Writes and draws what was found; gives what is printed of it, for people and as an object.
fn written(
    session: &Session,
    folder: &OutputFolder,
    report: &CycleReport<'_>,
) -> Result<(String, Value), Failure> {
    refuse_nothing(report)?;
    for doubt in report.doubts() {
        tracing::warn!("{doubt}");
    }
    let (summary, object) = report.write(folder)?;
    if let Some(drawing) = session.options.output.drawing() {
        let bodies = session.case.body.assembly().into_iter();
        let surfaces = bodies.flat_map(|body| &body.contacts);
        let surfaces = surfaces.map(|own| (own.name.clone(), own.surface)).collect();
        report.draw(folder, surfaces, session.case.materials(), &drawing)?;
    }
    Ok((summary.document().titled(report.title).to_text(), object))
}

/// Refuses phases whose dense matrices do not fit the machine's memory.
///
/// # Errors
/// [`Failure::Case`] at `cycle.phases`.
pub fn check_memory(case: &Case) -> Result<(), Failure> {
    let bytes = case.cost().cycle.map_or(0.0, |cycle| cycle.run.memory_bytes);
    let available = available_memory().unwrap_or(f64::INFINITY);
    if bytes <= available {
        return Ok(());
    }
    if !case.has_rotating_waves() {
        return Err(Failure::Case(case.memory_error("cycle", bytes, available)));
    }
    Err(Failure::Case(refusal!(case, "cycle.phases",
        "the search for limit cycles needs about {:.1} GiB of memory, {:.1} GiB are \
         available", gibibytes(bytes), gibibytes(available);
        "too many phases for this machine"; "lower cycle.phases, or leave it out")))
}
