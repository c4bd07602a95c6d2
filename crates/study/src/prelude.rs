//! What most studies name of other crates; the face of this one hands it on with its own names.

pub(crate) use frictionsim_case::{
    Analysis, AssemblyBody, BodyKind, Case, CaseErrors, Cea, CeaMethod, Choice, ModificationKind,
    StabilityChoice, refusal,
};
pub(crate) use frictionsim_output::rounded;
pub(crate) use frictionsim_physics::{
    cea::{
        CeaError, ComplexMode, FrictionPoint, FrictionSweep, ModeLimit, PartWatch, SweepRequest,
        SweepWatch, UnstableInterval, Unwatched, cyclic::WaveSweep,
    },
    contact::{ContactInterface, ContactSurface},
    cycle::{CycleError, Family, Parameter},
    fem::{MassKind, Triplets, operator::SimdLevel},
    linalg::{Mat, c64},
    mesh::{AnnulusMesh, Mesh, SolidSector, Strip},
    order, parallel,
    prestress::{
        Assembly, BaseChoice, DampingModel, SlidingSurfaces, SlidingTangent, TangentOptions,
        WaveTangent,
    },
    transient::TransientModel,
};
pub(crate) use frictionsim_results::{Manifest, ShownBody, number_ranges, sorted};
pub(crate) use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
pub(crate) use serde_json::Value;
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
    sync::Arc,
    time::Instant,
};
