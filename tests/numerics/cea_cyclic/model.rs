//! Sweeps of the paper's disc.

use crate::prelude::*;
use frictionsim::cea::cyclic::sweep;

pub fn paper_options() -> TangentOptions {
    TangentOptions {
        geometric_stiffness: true,
        contact: ContactStiffness { normal_stiffness: Some(7.4e12), ..RIGID },
        ..TANGENT
    }
}

pub fn run(
    specification: &AnnulusSpecification,
    options: &TangentOptions,
    frictions: &[f64],
    limit: ModeLimit,
) -> WaveSweep {
    let request = sweep_request(frictions, limit);
    sweep(specification, &POLYCARBONATE, options, &contact(610.0), &request).unwrap()
}
