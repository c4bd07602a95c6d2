//! `frictionsim mac`: modal assurance of measured shapes.

use super::fit::measured_shapes;
use super::prelude::*;
use crate::{results::mac::MacSummary, study::mac::assurance};

/// Compare measured shapes with the modes of a case
///
/// Computes the modal assurance criterion of every measured shape with every mode at the case's friction coefficient,
/// and pairs them. A measured point is compared at its nearest node. Shapes come from a universal file (dataset 55) or
/// a table. Its columns are x, y, z, ux, uy, uz (complex, or ux_re, ux_im ...), mode, frequency_hz.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Measured shapes
    #[arg(value_name = "SHAPES", value_hint = ValueHint::FilePath)]
    shapes: PathBuf,
    /// Factor that takes the coordinates of the shapes to metres
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    scale: f64,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut session = Session::start("mac", &asked.options)?;
    let shapes = measured_shapes(&asked.shapes, ("", asked.scale), &mut session)?;
    session.case.require_cea()?;
    let folder = session.begin()?;
    let found = assurance(&session.case, &shapes)?;
    let summary = MacSummary { measurement: input_name(&asked.shapes), ..found };
    session.finish_finding(folder, &summary)
}
