//! Mesh files of Gmsh, Abaqus and CalculiX, Nastran and universal files, and matrices in the Matrix Market format.
//!
//! [`FileMesh::read_as`] reads a mesh of any format. It has nodes, elements by their
//! [`ElementKind`], and named curves, surfaces and sets of nodes. What the file says of materials,
//! conditions and contacts is its [`ModelData`].

#[macro_use]
mod deck;

mod abaqus;
mod collection;
mod element;
mod file_mesh;
mod format;
mod gmsh;
mod matrix_market;
mod model_data;
mod modification;
mod nastran;
mod prelude;
mod symmetry;
mod universal;

pub use deck::included_text;
pub use element::{ElementKind, FacePoint, QuadraturePoint, Shape};
pub use file_mesh::{CurveEdge, FileElement, FileMesh, MeshFileError, SurfaceFace};
pub use format::MeshFormat;
pub use matrix_market::{MarketMatrix, MatrixMarketError};
pub use model_data::{
    FileCondition, FileConditionKind, FileContact, FileElasticity, FileMaterial, FileMotion,
    FileTie, LeftOut, MaterialAxes, ModelData,
};
pub use symmetry::CyclicSymmetry;
pub use universal::{universal_fields, universal_node};

/// A sum of displacements that vanishes: nodes with an axis and a coefficient.
pub type Equation = Vec<(u32, usize, f64)>;
