//! `frictionsim matrices`: the matrices of a case, for other programs.

use super::prelude::*;
use crate::results::matrices::{MatricesSummary, print, write_matrices};
use crate::results::{write_summary, write_universal_mesh};
use crate::study::matrices::matrices;

/// Export the matrices of a case to other programs
///
/// Writes what the eigenvalue analysis solves, as Matrix Market and as NPZ for scipy.sparse.load_npz. These are M, C
/// and K at the friction coefficient of the case, and the coefficients by which they change with it. The contact rows
/// stand beside. The file matrices.json lists what multiplies what, unknowns.csv the node and direction of each
/// unknown. Needs a section `[cea]`.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
    /// Write M.mtx, C.mtx and K.mtx at this friction coefficient, and nothing else (and H.mtx of a lossy body)
    #[arg(long, value_name = "MU", value_parser = friction_coefficient)]
    friction: Option<f64>,
}

fn friction_coefficient(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match value.is_finite() && value >= 0.0 {
        true => Ok(value),
        false => Err("a friction coefficient is zero or positive".to_owned()),
    }
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let mut session = Session::start("matrices", &asked.options)?;
    if let Some(friction) = asked.friction {
        depend_on(&mut session.manifest, format!("--friction {friction}"), None);
    }
    let case = &*session.case.on_whole_mesh()?;
    let folder = session.begin()?;
    let system = matrices(case, asked.friction)?;
    let system = if asked.friction.is_some() { system.at_one_friction() } else { system };
    let (summary, head) = (MatricesSummary::new(&system), session.head());
    write_matrices(&folder, &system, head, &summary)?;
    if case.output.universal {
        let mesh = case.body.mesh().map_err(Failure::run)?;
        folder.write_bulk("mesh.unv", |out| write_universal_mesh(out, &mesh))?;
    }
    let object = write_summary(&folder, head, &summary)?;
    session.options.output.finish(folder, &print(&summary), &object)
}
