//! What most of these tests name.

pub use crate::bricks::{Block, brick, file_of};
pub use crate::cases::{case_of, shipped_case};
pub use crate::coarse_block::coarse_block;
pub use crate::disc::{
    DAMPING, POLYCARBONATE, RIGID, TANGENT, annulus, compliant, contact, elastic, falling, goes_on,
    grows_as, modulus_table, recorded, sliding_at, springs, stiffening, sweep_request,
    transient_settings,
};
pub use crate::kept::Kept;
pub use crate::mesh_text::{even, quadrilaterals};
pub use crate::oscillator::{cycles, near};
pub use crate::tier::sized;
pub use frictionsim::case::Case;
pub use frictionsim::cea::{ModeLimit, SweepWatch, Unwatched};
pub use frictionsim::contact::{
    ContactStatus, ContactStiffness, FrictionDecay, NormalLaw, SlidingContact,
};
pub use frictionsim::cycle::{
    BranchEnd, CycleSolver, Family, LimitCycle, OperatingPoint, Parameter, Verdict,
};
pub use frictionsim::fem::operator::SimdLevel;
pub use frictionsim::fem::{
    ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping, assemble_stiffness, lumped_masses,
};
pub use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind};
pub use frictionsim::prestress::{SteadySliding, TangentOptions};
pub use frictionsim::results::cycle::{FoundCycle, PeriodicResult};
pub use frictionsim::study::cycle::{CycleStudy, PeriodicStudy};
pub use frictionsim::transient::{
    CentralDifference, InitialState, Observer, OperatorChoice, Perturbation, Recorder,
    RecorderSettings, RunEnd, Sample, SteppedBody, TimeStep, TransientAnalysis, TransientError,
    TransientModel, TransientSettings, TransientState,
};
pub use std::f64::consts::TAU;
pub use std::ops::ControlFlow;
pub use std::path::Path;
