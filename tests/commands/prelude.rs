//! What most of these tests name.

pub use crate::bricks::{Block, brick, file_of};
pub use crate::cases::{AS_IT_IS, case_of, read_case, shipped_case};
pub use crate::coarse_block::coarse_block;
pub use crate::coarse_disc::{coarse_disc, disc_of};
pub use crate::program::{Answer, Run, folder, folder_with, has, names_in, shipped};
pub use crate::tier::sized;
pub use faer::c64;
pub use frictionsim::case::{Case, KEYS};
pub use frictionsim::cea::{FrictionSweep, UnstableInterval};
pub use frictionsim::fem::{NodalStress, RayleighDamping};
pub use frictionsim::mesh::{AnnulusMesh, ElementKind};
pub use frictionsim::results::cea::{BaseField, BaseState, CeaReport};
pub use frictionsim::results::{Extent, Manifest, OutputFolder, Replace};
pub use serde_json::{Value, json};
pub use std::collections::BTreeMap;
pub use std::f64::consts::TAU;
pub use std::fs;
pub use std::path::{Path, PathBuf};
pub use std::time::{Duration, Instant};
pub use tempfile::TempDir;
