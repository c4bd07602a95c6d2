//! Sweeps of the paper's disc.

use crate::disc::{DAMPING, POLYCARBONATE, contact};
use frictionsim::cea::cyclic::{WaveSweep, sweep};
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::contact::ContactStiffness;
use frictionsim::fem::MassKind;
use frictionsim::mesh::AnnulusSpecification;
use frictionsim::prestress::{DampingModel, TangentOptions};

pub fn paper_options() -> TangentOptions {
    TangentOptions {
        mass: MassKind::Consistent,
        geometric_stiffness: true,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness {
            normal_stiffness: Some(7.4e12),
            normal_damping: 0.0,
            tangential_damping: 0.0,
            ..ContactStiffness::default()
        },
    }
}

pub fn run(
    specification: &AnnulusSpecification,
    options: &TangentOptions,
    frictions: &[f64],
    limit: ModeLimit,
) -> WaveSweep {
    let request = SweepRequest {
        friction_coefficients: frictions,
        limit,
        shapes_at: &[],
        lefts_at: &[],
        count_modes: false,
    };
    sweep(specification, &POLYCARBONATE, options, &contact(610.0), &request).unwrap()
}
