//! `frictionsim frf`: frequency response of the model between two nodes.

use super::{Failure, RunOptions, Session, terminal};
use crate::case::{Case, Frf};
use crate::frf::Terminal;
use crate::results::{ResponseSummary, response_figure, write_response, write_universal_response};
use crate::signal::FrequencyResponse;
use crate::study::response::{FrequencyStudy, Response};

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
    write_response(&folder, frf.quantity, &frf.frequencies_hz, &values)?;
    if case.output.universal {
        write_universal_response(&folder, frf.quantity, &frf.frequencies_hz, &values)?;
    }
    let summary = ResponseSummary {
        description: described(case, frf, &computed),
        dofs: computed.dofs,
        lines: frf.frequencies_hz.len(),
        method: computed.method.to_owned(),
        largest_error: computed.largest_error,
        basis_vectors: computed.vectors,
        backward_error: computed.backward_error,
        quantity: frf.quantity.name().to_owned(),
        noise: frf.noise,
    };
    let response = FrequencyResponse::new(frf.frequencies_hz.clone(), values, frf.quantity);
    // A few lines are numbers, but no curve.
    let figures = || response.iter().map(response_figure).collect();
    session.finish_result(folder, summary.document(), &summary, figures)
}

/// What was computed, in a sentence.
fn described(case: &Case, frf: &Frf, computed: &Response) -> String {
    let place = |t: Terminal| {
        let direction = t.direction.name();
        format!("node {} {direction}", case.body.node_label(t.node))
    };
    let error = match (computed.largest_error, computed.vectors, computed.backward_error) {
        (Some(error), Some(vectors), _) => {
            format!(" ({vectors} vectors, largest relative error at the check lines {error:.1e})")
        }
        (_, _, Some(error)) => format!(" (largest backward error {error:.1e})"),
        _ => String::new(),
    };
    format!(
        "{} from {} to {}: {} lines, {} unknowns, {}{error}",
        frf.quantity.name(),
        place(frf.force),
        place(frf.response),
        frf.frequencies_hz.len(),
        computed.dofs,
        computed.method,
    )
}
