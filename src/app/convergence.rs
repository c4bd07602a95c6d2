//! `frictionsim convergence`: a case on several meshes and with several time steps.

use super::profile::Profile;
use super::{Failure, RunOptions, Session, cycle, terminal};
use crate::case::Analysis;
use crate::results::convergence::ConvergenceSummary;
use crate::results::{Finding, declared};
use crate::study::convergence::{Levels, levels, solve};
use clap::Args;

/// Show that results have converged over mesh and time step
///
/// Runs the analyses of a case on refined meshes, and its transient with shorter time steps. Reads the observed order off the
/// three finest runs, extrapolates after Richardson, and marks what does not converge. Needs a section `[convergence]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

/// What the rest of the program asks of this command.
pub const PROFILE: Profile = Profile {
    files: &[("convergence.csv", "one row for each quantity on each level")],
    examples: &[("frictionsim convergence disc.toml", "observed orders and extrapolated values")],
};

/// Runs the subcommand.
///
/// # Errors
/// A bad case (exit code 2); a level that cannot be solved (1).
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("convergence", &arguments.options)?;
    let case = &session.case;
    let levels = levels(case, session.simd)?;
    session.check_memory(levels.iter().map(Levels::memory_bytes).sum())?;
    let cycles = levels.iter().filter(|of| of.analysis == Analysis::Cycle);
    for case in cycles.flat_map(|of| &of.cases) {
        cycle::check_memory(case)?;
    }
    let folder = session.open_folder(false)?;
    terminal::catch_signals(terminal::NOTHING_KEPT);

    let count = levels.iter().map(|of| of.cases.len() as u64).sum();
    let bar = terminal::progress(session.options.output.is_quiet(), count, "levels");
    let series = solve(case, &levels, &session.manifest, &|| bar.inc(1));
    bar.finish_and_clear();
    let summary = ConvergenceSummary {
        command: "convergence".to_owned(),
        title: case.title.clone(),
        series: series?,
        wall_s: session.wall_seconds(),
        manifest: folder.manifest().clone(),
    };
    let output = &session.options.output;
    let text = summary.told(output.verbose > 0).to_text();
    let figures = || declared(summary.figures());
    output.finish_result(folder, &text, summary.document(), &summary, figures)
}
