//! What most sections of a case are read with; what one of them has alone is named where it is used.

pub(crate) use crate::{
    Body, BodyKind, Case, CaseErrors, CaseKey, Choice, Diagnostic, Location, RawCase, RawItem,
    RawTable, RawValue, Section,
};
pub(crate) use frictionsim_bounds::first_of;
pub(crate) use frictionsim_output::rounded;
pub(crate) use frictionsim_physics::{
    contact::{
        Counterpart, Motion, PairFriction, RigidCounterface, RigidMotion, RigidShape,
        SlidingContact,
    },
    fem::{
        ElasticMaterial, MassKind, MaterialField, ModulusTable, PlaneFormulation, RayleighDamping,
        RegionMaterial, RotationFrame,
    },
    frf::FrfBoundary,
    linalg::c64,
    mesh::{
        AnnulusSpecification, BodyError, BodySpecification, BoundaryCondition, Counterface,
        CounterfaceSpecification, FileElasticity, FileMesh, LeftOut, Mesh, SolidContact, SolidFace,
        SolidSector, SolidSpecification,
    },
    prestress::{BaseChoice, SlidingSurfaces},
    transient::OperatorChoice,
};
pub(crate) use frictionsim_signal::ResponseQuantity;
pub(crate) use nalgebra::Vector3;
pub(crate) use std::{
    borrow::Cow,
    cell::RefCell,
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
    fmt::Write as _,
    path::Path,
    sync::Arc,
};
