//! What most studies name of other crates; what is of this one is named where it is used.

pub(crate) use frictionsim_case::{
    AssemblyBody, BodyKind, Case, CaseErrors, Cea, CeaMethod, refusal,
};
pub(crate) use frictionsim_physics::{
    cea::{
        CeaError, ComplexMode, FrictionPoint, FrictionSweep, SweepRequest, UnstableInterval,
        Unwatched, cyclic::WaveSweep,
    },
    cycle::{CycleError, Family},
    fem::{MassKind, Triplets, operator::SimdLevel},
    linalg::{Mat, c64},
    mesh::{Mesh, SolidSector},
    prestress::{Assembly, SlidingTangent, TangentOptions},
};
pub(crate) use frictionsim_results::{ShownBody, sorted};
pub(crate) use nalgebra::DMatrix;
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
    sync::Arc,
};
