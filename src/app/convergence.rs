//! `frictionsim convergence`: a case on several meshes and with several time steps.

use super::{Failure, Run, RunOptions, Session, Told, terminal};
use crate::results::convergence::ConvergenceSummary;
use crate::results::{Finding, declared};
use crate::study::convergence::{levels, solve};
use clap::Args;

/// Show that results have converged over mesh and time step
///
/// Runs the analyses of a case on refined meshes, and its transient with shorter time steps. Reads the observed order
/// off the three finest runs, extrapolates after Richardson, and marks what does not converge. Needs a section
/// `[convergence]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

impl Run for Arguments {
    fn run(&self) -> Result<(), Failure> {
        let session = Session::start("convergence", &self.options)?;
        let case = &session.case;
        let levels = levels(case, session.simd)?;
        let folder = session.begin()?;

        let count = levels.iter().map(|of| of.cases.len() as u64).sum();
        let bar = terminal::progress(session.options.output.is_quiet(), count, "levels");
        let series = solve(case, &levels, &session.manifest, &|| bar.inc(1));
        bar.finish_and_clear();
        let summary = ConvergenceSummary { series: series? };
        let output = &session.options.output;
        let text = summary.told(output.verbose > 0).titled(&case.title).to_text();
        let told = Told { text, ..Told::of(session.head(), summary.document()) };
        output.finish_result(folder, told, &summary, || declared(summary.figures()))
    }
}
