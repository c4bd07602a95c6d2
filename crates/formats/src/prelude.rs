//! What readers of mesh files are made of; what one format has alone is named where it is used.

pub(crate) use crate::{
    CyclicSymmetry, ElementKind, Equation, FileCondition, FileConditionKind, FileContact,
    FileElasticity, FileMaterial, FileMotion, FileTie, MaterialAxes, ModelData,
    collection::{dimension, edge_of, finished, free_faces, outer_faces, sorted, used_nodes},
    deck::{Deck, Place, quoted, real},
    file_mesh::{CurveEdge, FileElement, FileMesh, MeshFileError, Result, SurfaceFace},
};
pub(crate) use frictionsim_bounds::{Budget, LARGEST_COORDINATE, MESH, MESSAGE, shortened};
pub(crate) use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet, HashMap, HashSet},
    sync::Arc,
};
