//! `frictionsim cea`: complex eigenvalues of steady sliding over the friction coefficient.

use super::profile::{Profile, Run};
use super::{Failure, RunOptions, Session, superelement, terminal};
use crate::cea::{SweepProgress, SweepStage};
use crate::results::cea::{KeptSteps, View, document, draw, write, write_universal};
use crate::study::eigenvalues::{self, Solved, Solver, refuse_no_modes};
use clap::Args;
use indicatif::ProgressBar;

/// Which modes turn unstable, at which friction and why
///
/// Solves complex eigenvalues over the friction coefficient. For a body that is solved on its whole mesh, Ctrl-C keeps
/// finished friction values; --resume continues. Needs a section `[cea]`.
#[derive(Args)]
pub struct Arguments {
    /// The case and how to run it.
    #[command(flatten)]
    pub options: RunOptions,
    /// Continue from what an interrupted run has finished, or start from the beginning
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
}

/// What an interrupted run leaves.
const KEPT: &str = "friction values that are done are kept: the same command with --resume goes on";

impl Run for Arguments {
    const PROFILE: Profile = Profile {
        files: &[
            ("eigenvalues.csv", "one row for each mode and friction value"),
            ("stability.csv", "one row for each crossing into instability"),
            ("sensitivities.csv", "derivatives of eigenvalues and onsets by parameters"),
            (
                "contributions.csv, coupling.csv",
                "what each part, support and contact adds to growth; which modes couple",
            ),
            ("feed.csv, feed.vtu", "where on the contact surfaces unstable modes are fed"),
            ("prestress.csv, prestress.vtu", "steady sliding, node by node"),
            ("modes.pvd, modes/*.vtu", "mode shapes, real and imaginary part"),
            ("modes.unv", "mesh and mode shapes as a universal file (output.universal)"),
        ],
        examples: &[
            ("frictionsim cea disc.toml", "critical friction of every branch"),
            (
                "frictionsim cea disc.toml --set contact.interference=30e-6 --json | jq .critical_frictions",
                "for scripts",
            ),
        ],
    };

    fn run(&self) -> Result<(), Failure> {
        let options = &self.options;
        if let Some(system) = superelement::described(&options.case, &options.changes.overrides())?
        {
            return superelement::run(options, &system);
        }
        run_on_mesh(self)
    }
}

/// Shows how far a sweep has come.
fn show(bar: &ProgressBar, progress: SweepProgress) {
    bar.set_message(match progress.stage {
        SweepStage::Blocks => "blocks of modes",
        SweepStage::Values => "friction values",
        SweepStage::Diameters => "nodal diameters",
    });
    bar.set_length(progress.total as u64);
    bar.set_position(progress.solved as u64);
}

fn run_on_mesh(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("cea", &arguments.options)?;
    let case = &session.case;
    let cea = case.require_cea()?;
    let solver = Solver::of_analysis(case, cea)?;
    session.check_memory(case.memory("cea").0)?;
    let folder = session.open_folder(arguments.resume)?;
    let bar = terminal::progress(session.options.output.is_quiet(), 0, "modes at rest");
    let heard = |progress| show(&bar, progress);
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
    let report = eigenvalues::report(case, cea, &model, &solution, &field, wall_s);
    let summary = write(&folder, &report)?;
    if case.output.universal {
        write_universal(&folder, &report)?;
    }
    if let Some(drawing) = session.options.output.drawing() {
        draw(&folder, &report, &eigenvalues::dampings(case, &model), &drawing)?;
    }
    steps.discard()?;
    let view = if session.options.output.verbose > 0 { View::Whole } else { View::Short };
    session.options.output.finish(folder, &document(&report, view).to_text(), &summary)
}
