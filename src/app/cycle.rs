//! `frictionsim cycle`: limit cycles found directly, and followed over a parameter.

use super::prelude::*;
use crate::results::ShownBody;
use crate::results::cea::KeptSteps;
use crate::results::cycle::{CycleSummary, SoughtCycle};
use crate::study::cycle::{CycleStudy, PeriodicStudy, refuse_nothing};

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
    let found = study.report(results, two_waves);
    let (text, object) = written(session, &folder, &study.shown(), &found)?;
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
        for own in study.report(vec![result.clone()]).cycles {
            let kept = folder
                .write(&kept_name(&own), |out| Ok(serde_json::to_writer_pretty(&mut *out, &own)?));
            if let Err(error) = kept {
                tracing::warn!("{error}");
            }
        }
    })?;
    bar.finish_and_clear();
    let found = study.report(results);
    let (text, object) = written(session, &folder, &study.shown(), &found)?;
    found.cycles.iter().try_for_each(|own| folder.discard(&kept_name(own)))?;
    steps.discard()?;
    session.options.output.finish(folder, &text, &object)
}

/// Writes and draws what was found; gives what is printed of it, for people and as an object.
fn written(
    session: &Session,
    folder: &OutputFolder,
    body: &ShownBody<'_>,
    found: &CycleSummary,
) -> Result<(String, Value), Failure> {
    let told = Told::of(session.head(), found.document());
    refuse_nothing(found)?;
    for doubt in found.doubts() {
        tracing::warn!("{doubt}");
    }
    found.write(folder, body)?;
    session.options.output.write_result(folder, told, found, || {
        let surfaces = session.case.body.assembly().into_iter().flat_map(|body| &body.contacts);
        let surfaces = surfaces.map(|own| (own.name.clone(), own.surface)).collect();
        found.figures(body, surfaces, session.case.materials())
    })
}
