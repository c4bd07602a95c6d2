//! What most tests name: types of the library, the builders beside this file, and little of the standard library.

pub use super::block::*;
pub use super::bricks::*;
pub use super::cases::*;
pub use super::coarse_block::coarse_block;
pub use super::coarse_disc::{coarse_disc, disc_of};
pub use super::disc::linearized;
pub use super::disc::*;
pub use super::kept::Kept;
pub use super::mesh_text::*;
pub use super::msh::*;
pub use super::program::{
    Answer, Row, Run, files_below, folder, folder_with, has, names_in, repository, rows, shell,
    shipped,
};
pub use super::solids::*;
pub use super::spectra::*;
pub use super::table_1::TABLE_1;
pub use super::tier::sized;
pub use super::triangles::{body, triangles};
pub use faer::{Mat, c64};
pub use frictionsim::case::{Case, CaseErrors, KEYS, unset};
pub use frictionsim::cea::ModeLimit::{Lowest, MaxFrequency};
pub use frictionsim::fem::MassKind::{Consistent, Lumped};
pub use frictionsim::fem::PlaneFormulation::{PlaneStrain, PlaneStress, ThreeDimensional};
pub use frictionsim::fem::operator::SimdLevel;
pub use frictionsim::mesh::BoundaryCondition::{Clamped, Fixed, Free, Guide, Pressure, Support};
pub use frictionsim::mesh::ElementKind::{Hex8, Hex20, Pyramid5, Pyramid13, Quad4, Quad8};
pub use frictionsim::mesh::ElementKind::{Tet4, Tet10, Tri3, Tri6, Wedge6, Wedge15};
pub use frictionsim::prestress::DampingModel::{BodyOnly, WholeTangent};
pub use frictionsim::results::cea::{BaseField, BaseState, CeaReport};
pub use frictionsim::results::cea::{ContactPlace, ContactState};
pub use frictionsim::results::{BodyStress, Extent, Manifest, OutputFolder, Replace, ShownBody};
pub use frictionsim::study::eigenvalues::modes_and_onsets;
pub use frictionsim::{cea::*, contact::*, cycle::*, fem::*, frf::*, linalg::*, mesh::*};
pub use frictionsim::{prestress::*, transient::*};
pub use nalgebra::DMatrix;
pub use serde_json::{Value, json};
pub use std::collections::{BTreeMap, BTreeSet};
pub use std::f64::consts::{PI, TAU};
pub use std::fmt::Write as _;
pub use std::fs;
pub use std::ops::ControlFlow;
pub use std::path::{Path, PathBuf};
pub use std::sync::{Arc, LazyLock};
pub use std::time::{Duration, Instant};
pub use tempfile::TempDir;
