//! Commands that a case says everything to: `basin`, `convergence`, `frf`, `improve`.

use super::prelude::*;
use crate::results::convergence::ConvergenceSummary;
use crate::results::{Finding, declared, improve, response_figure, write_response};
use crate::study::{self, response::FrequencyStudy};
use crate::{frf::Terminal, signal::FrequencyResponse};

/// Which of two motions wins.
pub(super) fn basin(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("basin", options)?;
    session.case.require_basin()?;
    let folder = session.begin()?;
    let summary = study::basin::summary(&session.case, &session.manifest)?;
    session.finish_finding(folder, &summary)
}

/// A case on several meshes and with several time steps.
pub(super) fn convergence(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("convergence", options)?;
    let (case, output) = (&session.case, &session.options.output);
    let levels = study::convergence::levels(case, session.simd)?;
    let folder = session.begin()?;
    let count = levels.iter().map(|of| of.cases.len() as u64).sum();
    let bar = terminal::progress(output.is_quiet(), count, "levels");
    let series = study::convergence::solve(case, &levels, &session.manifest, &|| bar.inc(1));
    bar.finish_and_clear();
    let summary = ConvergenceSummary { series: series? };
    let text = summary.told(output.verbose > 0).titled(&case.title).to_text();
    let told = Told { text, ..Told::of(session.head(), summary.document()) };
    output.finish_result(folder, told, &summary, || declared(summary.figures()))
}

/// Frequency response of the model between two nodes.
pub(super) fn frf(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("frf", options)?;
    let case = &session.case;
    let frf = case.require_frf()?;
    let folder = session.begin()?;
    let bar = terminal::progress(session.options.output.is_quiet(), 0, "frequencies");
    let computed = FrequencyStudy::new(case)?.solve(&|lines| {
        bar.set_length(frf.frequencies_hz.len() as u64);
        bar.inc(lines as u64);
    })?;
    bar.finish_and_clear();
    let values = computed.observed(frf);
    let place = |own: Terminal| (case.body.node_label(own.node), own.direction.number());
    let universal = case.output.universal.then(|| [frf.response, frf.force].map(place));
    write_response(&folder, frf.quantity, &frf.frequencies_hz, &values, universal)?;
    let response = FrequencyResponse::new(frf.frequencies_hz.clone(), values, frf.quantity);
    // A few lines are numbers, but no curve.
    let figures = || response.iter().map(response_figure).collect();
    let summary = &computed.summary;
    session.finish_result(folder, summary.document(), summary, figures)
}

/// Where a modification silences unstable modes.
pub(super) fn improve(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("improve", options)?;
    session.case.require_cea()?;
    let folder = session.begin()?;
    let found = study::improve::improve(&session.case)?;
    improve::write(&folder, &found)?;
    let (document, figures) = (improve::document(&found.summary), || improve::figures(&found));
    session.finish_result(folder, document, &found.summary, figures)
}
