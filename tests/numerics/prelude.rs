//! What most of these tests name.

pub use crate::common::prelude::*;
pub use crate::shaft::model::AnnulusMaterials;
pub use crate::solids::model::{SolidModel, solid_sweep};
pub use frictionsim::cea::cyclic::WaveSweep;
pub use frictionsim::cea::sparse::sweep;
pub use frictionsim::linalg::dense::random_columns;
