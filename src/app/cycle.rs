//! `frictionsim cycle`: limit cycles found directly, and followed over a parameter.

mod figures;
mod periodic;

use super::profile::{Profile, Redraw};
use super::session::{available_memory, gibibytes};
use super::{Failure, RunOptions, Session, terminal};
use crate::case::Case;
use crate::results::cea::KeptSteps;
use crate::results::cycle::{doubt, print, write};
use crate::study::cycle::CycleStudy;
use clap::Args;

/// The vibration that each unstable mode saturates to
///
/// Finds limit cycles without time stepping. On the built-in disc a limit cycle is a rotating wave, solved along its phase. On
/// any other body it is the periodic motion that a growing mode saturates to, solved over one period of the transient.
/// cycle.continuation follows it over a parameter. Its stability is computed, and a short transient confirms it. Ctrl-C
/// keeps finished cycles and branch points; --resume continues. Needs a section `[cycle]`.
#[derive(Args)]
pub struct Arguments {
    /// The case and how to run it.
    #[command(flatten)]
    pub options: RunOptions,
    /// Continue from what an interrupted run has finished, or start from the beginning
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
}

/// What an interrupted search for motions of two frequencies leaves.
const KEPT: &str =
    "motions of two frequencies that are done are kept: the same command with --resume goes on";

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[
        ("cycle-nN.csv", "contact and motion of the edge along the phase"),
        ("branch-nN.csv", "one row for each cycle of a branch"),
        ("stability-nN.csv", "exponents of perturbations"),
        (
            "two-waves-nN-nM.csv, .vtu",
            "one row for each motion of two frequencies; its field over one period of the first wave",
        ),
        ("cycles.pvd, cycle-nN.vtu", "fields over one period"),
        (
            "cycle-modeK.csv, contact-modeK.csv, .npz, harmonics-modeK.csv",
            "of a body without symmetry: the contact over one period, its nodes, harmonics in time",
        ),
        ("record.bin", "what the figures are drawn from"),
    ],
    examples: &[
        ("frictionsim cycle disc.toml", "the limit cycles of a case, without time stepping"),
        (
            "frictionsim cycle block.toml --resume",
            "go on where a search on any other body was interrupted",
        ),
    ],
    redraw: Redraw::OfCase(figures::redraw),
};

/// Runs the subcommand.
///
/// # Errors
/// A bad case, a search that finds no cycle at all, an output folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("cycle", &arguments.options)?;
    let case = &session.case;
    case.require_cycle()?;
    if !case.has_rotating_waves() {
        return periodic::run(&session, arguments.resume);
    }
    session.check_memory(case.memory("cycle").0)?;
    check_memory(case)?;
    let study = CycleStudy::new(case, session.simd)?;
    let folder = match arguments.resume {
        true => session.reopen_folder()?,
        false => session.open_folder()?,
    };
    let families = study.family_count() as u64;
    let bar = terminal::progress(session.options.output.is_quiet(), families, "families");
    let steps = KeptSteps::new(&folder, arguments.resume, &|_| {})?;
    terminal::catch_signals(match study.choices.two_frequencies {
        true => KEPT,
        false => terminal::NOTHING_KEPT,
    });
    let results = study.run(study.choices.frames, &|| bar.inc(1));
    bar.finish_and_clear();
    let two_waves = study.two_waves(&results, &steps);
    let mut report = study.report(results, session.wall_seconds());
    report.two_waves = two_waves;
    CycleStudy::refuse_nothing(&report)?;
    for result in &report.results {
        if let Some(doubt) = doubt(&report, result) {
            tracing::warn!("{doubt}");
        }
    }
    let summary = write(&folder, &report)?;
    if let Some(drawing) = session.options.output.drawing() {
        figures::draw_record(&folder, case, &summary, &drawing)?;
    }
    steps.discard()?;
    session.options.output.finish(folder, &print(&report), &summary)
}

/// Refuses phases whose dense matrices do not fit the machine's memory.
///
/// # Errors
/// [`Failure::Case`] at `cycle.phases`.
pub fn check_memory(case: &Case) -> Result<(), Failure> {
    let bytes = case.cost().cycle.map_or(0.0, |cycle| cycle.memory_bytes);
    let available = available_memory().unwrap_or(f64::INFINITY);
    if bytes <= available {
        return Ok(());
    }
    if !case.has_rotating_waves() {
        return Err(Failure::Case(case.memory_error("cycle", bytes, available)));
    }
    Err(Failure::Case(case.error_at(
        "cycle.phases",
        format!(
            "the search for limit cycles needs about {:.1} GiB of memory, {:.1} GiB are available",
            gibibytes(bytes),
            gibibytes(available)
        ),
        "too many phases for this machine",
        "lower cycle.phases, or leave it out",
    )))
}
