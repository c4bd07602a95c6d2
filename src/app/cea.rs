//! `frictionsim cea`: complex eigenvalues of steady sliding over friction, or of a superelement that stands free.

use super::prelude::*;
use super::{limits::STANDARD_INPUT, start_threads};
use crate::case::{FreeSystem, RawCase};
use crate::cea::{SweepProgress, SweepStage};
use crate::results::cea::{
    KeptSteps, View, document, figures, page, summary, write_fields, write_universal,
};
use crate::study::eigenvalues::{self, Solved, Solver, refuse_no_modes};
use crate::study::matrices::free_spectrum;
use frictionsim_bounds::CASE;

/// What an interrupted run leaves.
const KEPT: &str = "friction values that are done are kept: the same command with --resume goes on";

pub(super) fn run(asked: &ResumedRun) -> Result<(), Failure> {
    let options = &asked.options;
    if let Some(system) = described_system(&options.case, &options.changes.overrides())? {
        return run_free(options, &system);
    }
    run_on_mesh(asked)
}

fn run_on_mesh(arguments: &ResumedRun) -> Result<(), Failure> {
    let session = Session::start("cea", &arguments.options)?;
    let case = &session.case;
    let cea = case.require_cea()?;
    let solver = Solver::of_analysis(case, cea)?;
    session.check_memory(case.memory("cea").0)?;
    let folder = session.open_folder(arguments.resume)?;
    let bar = terminal::progress(session.options.output.is_quiet(), 0, "modes at rest");
    let heard = |progress: SweepProgress| {
        bar.set_message(match progress.stage {
            SweepStage::Blocks => "blocks of modes",
            SweepStage::Values => "friction values",
            SweepStage::Diameters => "nodal diameters",
        });
        bar.set_length(progress.total as u64);
        bar.set_position(progress.solved as u64);
    };
    let steps = KeptSteps::new(&folder, arguments.resume, &heard)?;
    terminal::catch_signals(match solver {
        Solver::WholeMesh => KEPT,
        Solver::Waves => terminal::NOTHING_KEPT,
    });

    let Solved { case, model, solution } = eigenvalues::solved(case, cea, Some(&steps))?;
    let case = &*case;
    refuse_no_modes(case, cea, &solution.sweep)?;

    bar.finish_and_clear();
    let field = model.base_field(case);
    let wall_s = session.wall_seconds();
    let report = eigenvalues::report(case, cea, &model, &solution, wall_s);
    write_fields(&folder, &report, &field)?;
    if case.output.universal {
        write_universal(&folder, &report)?;
    }
    let output = &session.options.output;
    let view = if output.verbose > 0 { View::Whole } else { View::Short };
    let told = Told {
        text: document(&report, view).to_text(),
        ..Told::of(Head::of(report.title, wall_s), page(&report, &field))
    };
    let drawn = || figures(&report, &field, &eigenvalues::dampings(case, &model));
    let (text, object) = output.write_result(&folder, told, &summary(&report), drawn)?;
    steps.discard()?;
    output.finish(folder, &text, &object)
}

/// The superelement that a case describes, where it describes no body. Its files are relative to the case, so it cannot
/// come from standard input.
///
/// # Errors
/// A case that cannot be read; matrices that are none.
pub fn described_system(case: &Path, overrides: &[String]) -> Result<Option<FreeSystem>, Failure> {
    if case == Path::new(STANDARD_INPUT) {
        return Ok(None);
    }
    let raw = RawCase::parse(&input_name(case), &read_input(case, CASE)?, overrides)?;
    if FreeSystem::is_described_by(&raw) { Ok(Some(FreeSystem::read(raw)?)) } else { Ok(None) }
}

/// Solves it and writes the eigenvalues.
///
/// # Errors
/// Matrices that are singular together, an output folder that cannot be written.
fn run_free(options: &RunOptions, system: &FreeSystem) -> Result<(), Failure> {
    let start = Instant::now();
    terminal::start_log(options.output.quiet, options.output.verbose);
    let manifest = Manifest {
        case_file: options.case.display().to_string(),
        case_text: system.raw.text.clone(),
        case_hash: system.hash.clone(),
        overrides: system.raw.overrides.clone(),
        threads: start_threads(options.threads),
        ..Manifest::new("cea")
    };
    let folder = options.output.open_folder(&manifest, false)?;
    let spectrum = free_spectrum(system)?;
    let summary = spectrum.write(&folder, start.elapsed().as_secs_f64())?;
    options.output.finish(folder, &spectrum.print(), &summary)
}
