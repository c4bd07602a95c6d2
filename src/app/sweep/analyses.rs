//! Analyses at a point of a sweep.

use crate::app::{Failure, cycle};
use crate::case::{Analysis, Case};
use crate::results::Manifest;
use crate::study::{analysis_name, summarize};
use serde_json::{Map, Value};

/// Runs the analyses of one point and gives the summary of each by its name, without the manifest:
/// the sweep's folder has it once.
///
/// # Errors
/// Those of the first analysis that fails.
pub fn run_point(
    case: &Case,
    analyses: &[Analysis],
    manifest: &Manifest,
) -> Result<Map<String, Value>, Failure> {
    let mut summaries = Map::new();
    for &analysis in analyses {
        if analysis == Analysis::Cycle {
            cycle::check_memory(case)?;
        }
        let mut summary = summarize(case, analysis, manifest)?;
        if let Value::Object(entries) = &mut summary {
            entries.shift_remove("manifest");
        }
        summaries.insert(analysis_name(analysis).to_owned(), summary);
    }
    Ok(summaries)
}
