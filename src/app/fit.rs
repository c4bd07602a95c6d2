//! `frictionsim fit`: parameters of a case from measured modes.

use super::prelude::*;
use crate::results::fit::{BLOCK, FitSummary};
use crate::signal::reader::{read_modes, read_shapes};
use crate::study::fit::{fit_case, refuse_too_few};
use crate::study::mac::MeasuredShapes;
use frictionsim_bounds::MEASUREMENT;

/// Find parameters of a case from measured modes or squeal frequencies
///
/// Fits the keys of fit.parameters, each between its bounds, to a table of frequencies, real parts or damping factors.
/// Gives the confidence interval of each value, the mode of each line, and the parameters that the data cannot tell
/// apart. Needs a section `[fit]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Measured modes: frequency_hz and, where known, real_hz or damping_factor, harmonic, sigma_hz, unstable (1:
    /// heard)
    #[arg(value_name = "MODES.csv", value_hint = ValueHint::FilePath)]
    modes: PathBuf,
    /// Measured shapes of some of these modes, found by their frequency: universal file (dataset 55) or table, as of
    /// mac
    #[arg(long, value_name = "SHAPES", value_hint = ValueHint::FilePath)]
    shapes: Option<PathBuf>,
    /// Factor that takes the coordinates of the shapes to metres
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, requires = "shapes")]
    scale: f64,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut session = Session::start("fit", &asked.options)?;
    session.case.require_fit()?;
    let bytes = read_input(&asked.modes, MEASUREMENT)?;
    let lines = read_modes(&bytes, &input_name(&asked.modes))?;
    depend_on(&mut session.manifest, asked.modes.display().to_string(), Some(&bytes));
    let of_shapes =
        |path: &PathBuf| measured_shapes(path, ("--shapes ", asked.scale), &mut session);
    let shapes = asked.shapes.as_ref().map(of_shapes).transpose()?;
    refuse_too_few(&session.case, &lines)?;
    let folder = session.begin()?;

    let found = fit_case(&session.case, &lines, shapes.as_ref())?;
    let found = FitSummary { measurement: input_name(&asked.modes), ..found };
    for note in &found.notes {
        tracing::warn!("{note}");
    }
    folder.write(BLOCK, |out| out.write_all(found.block().as_bytes()))?;
    session.finish_finding(folder, &found)
}

/// Measured shapes, named by an option or none; results belong to them and their scale too.
pub(super) fn measured_shapes(
    path: &Path,
    (option, scale): (&str, f64),
    session: &mut Session,
) -> Result<MeasuredShapes, Failure> {
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(Failure::usage(format!("--scale {scale} must be positive and finite")));
    }
    let bytes = read_input(path, MEASUREMENT)?;
    depend_on(&mut session.manifest, format!("{option}{}", path.display()), Some(&bytes));
    if scale != 1.0 {
        depend_on(&mut session.manifest, format!("--scale {scale}"), None);
    }
    Ok(MeasuredShapes { shapes: read_shapes(&bytes, &input_name(path))?, scale })
}
