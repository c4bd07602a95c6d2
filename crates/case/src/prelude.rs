//! What most sections of a case are read with of other crates; the face of this one hands it on with its own names.

pub(crate) use frictionsim_bounds::first_of;
pub(crate) use frictionsim_output::rounded;
pub(crate) use frictionsim_physics::{
    contact::{
        Counterpart, Motion, PairFriction, RigidCounterface, RigidMotion, RigidShape,
        SlidingContact,
    },
    fem::{MassKind, ModulusTable, PlaneFormulation, RayleighDamping, RotationFrame},
    frf::FrfBoundary,
    linalg::c64,
    mesh::{
        AnnulusSpecification, BodyError, BodySpecification, BoundaryCondition, Counterface,
        CounterfaceSpecification, FileElasticity, FileMesh, LeftOut, Mesh, SolidContact, SolidFace,
        SolidSector, SolidSpecification,
    },
    prestress::{BaseChoice, SlidingSurfaces},
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
