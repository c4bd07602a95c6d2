//! What most of these tests name.

pub use crate::block::{SOLIDS, block};
pub use crate::bricks::{Block, brick, file_of};
pub use crate::cases::{AS_IT_IS, case_of, kept, read_case, shipped_case};
pub use crate::disc::{
    DAMPING, POLYCARBONATE, RIGID, TANGENT, annulus, compliant, contact, elastic, falling, goes_on,
    grows_as, linearized, modes_at, modulus_table, on_shaft, recorded, ring, sliding_at, springs,
    stiffening, sweep_request, transient_settings,
};
pub use crate::mesh_text::{even, mesh_text, quadrilaterals};
pub use crate::msh::{CYLINDER, FORMS, plane_body, write_msh};
pub use crate::program::{Answer, Run, folder, folder_with, has, names_in, shipped};
pub use crate::shaft::model::AnnulusMaterials;
pub use crate::solids::model::{SolidModel, solid_sweep};
pub use crate::spectra::{assert_same, eigenvalues_of, largest_error, on_threads};
pub use crate::table_1::TABLE_1;
pub use crate::tier::sized;
pub use crate::triangles::body;
pub use faer::{Mat, c64};
pub use frictionsim::case::Case;
pub use frictionsim::cea::cyclic::WaveSweep;
pub use frictionsim::cea::sparse::sweep;
pub use frictionsim::cea::{
    ComplexMode, FrictionSweep, ModeLimit, SweepRequest, UnstableInterval, cyclic, sparse,
};
pub use frictionsim::contact::{
    ContactInterface, ContactStatus, ContactStiffness, Counterpart, FrictionDecay, Motion,
    NormalLaw, PairFriction, SlidingContact,
};
pub use frictionsim::fem::operator::SimdLevel;
pub use frictionsim::fem::{
    DofMap, ElasticMaterial, MassKind, PlaneFormulation, RayleighDamping, RegionMaterial, Triplets,
    assemble_mass, assemble_stiffness,
};
pub use frictionsim::frf::{
    CyclicSystem, Direction, FrfError, FrfSystem, NodeFault, Terminal, cyclic_response,
    direct_response,
};
pub use frictionsim::linalg::dense::random_columns;
pub use frictionsim::linalg::{ComplexDenseLu, MatrixPolynomial};
pub use frictionsim::mesh::{
    AnnulusMesh, AnnulusSpecification, BodySpecification, BoundaryCondition,
    CounterfaceSpecification, ElasticSupport, ElementKind, FileMesh, Mesh, SectorMesh,
    SolidContact, SolidSector,
};
pub use frictionsim::prestress::{
    Assembly, BaseChoice, DampingModel, PrestressError, SlidingSurfaces, SlidingTangent,
    SolidSliding, SteadySliding, TangentOptions, TiedSurfaces, WaveTangent,
};
pub use frictionsim::study::eigenvalues::modes_and_onsets;
pub use frictionsim::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    SteppedBody, TransientAnalysis, TransientModel, TransientSettings,
};
pub use nalgebra::DMatrix;
pub use std::collections::BTreeMap;
pub use std::f64::consts::{PI, TAU};
pub use std::fs;
pub use std::path::{Path, PathBuf};
pub use std::sync::Arc;
pub use tempfile::TempDir;
