//! `frictionsim frf`: frequency response of the model between two nodes.

use super::prelude::*;
use crate::results::{response_figure, write_response};
use crate::{frf::Terminal, signal::FrequencyResponse, study::response::FrequencyStudy};

pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
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
