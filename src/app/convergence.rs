//! `frictionsim convergence`: a case on several meshes and with several time steps.

use super::prelude::*;
use crate::results::convergence::ConvergenceSummary;
use crate::results::{Finding, declared};
use crate::study::convergence::{levels, solve};

pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("convergence", options)?;
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
