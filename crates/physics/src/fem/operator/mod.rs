//! The stiffness operator of an explicit time step: `M^-1 K` with a lumped mass, applied without a factorization.
//!
//! Two implementations stand behind one trait: [`SparseOperator`] for any mesh, [`SectorStencil`]
//! for bodies of equal sectors, a uniform annulus, and a body of revolution in three dimensions.

mod annulus;
mod block_rows;
mod field;
mod kernel;
mod largest_frequency;
mod node_order;
mod simd;
mod solid;
mod sparse;
mod stencil;

use super::RayleighDamping;

pub use field::{AlignedVector, MotionFields};
pub use largest_frequency::{largest_frequency, largest_frequency_of};
pub use simd::{SimdError, SimdLevel};
pub use sparse::SparseOperator;
pub use stencil::SectorStencil;

/// Coefficients of one explicit step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepCoefficients {
    /// Time step `dt`, s.
    pub time_step: f64,
    /// `alpha_R`, 1/s.
    pub mass_coefficient: f64,
    /// `beta_R`, s.
    pub stiffness_coefficient: f64,
}

impl StepCoefficients {
    /// Those of a time step, s.
    pub fn of(damping: &RayleighDamping, time_step: f64) -> Self {
        let RayleighDamping { mass_coefficient, stiffness_coefficient } = *damping;
        Self { time_step, mass_coefficient, stiffness_coefficient }
    }

    /// Velocity `v - dt (q + alpha_R v + beta_R z)` after a step, of one dof.
    #[inline(always)]
    pub fn moved(&self, v: f64, q: f64, z: f64) -> f64 {
        v - self.time_step * (q + (self.mass_coefficient * v + self.stiffness_coefficient * z))
    }
}

/// Why an operator cannot represent a mesh, and which one can.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct OperatorError(pub(crate) String);

impl OperatorError {
    /// A node, counted from 0, without mass.
    fn massless(node: usize, mass: f64) -> Self {
        let node = node + 1;
        Self(format!(
            "node {node} has the lumped mass {mass:e} kg/m; an explicit step needs a positive one"
        ))
    }
}

/// `M^-1 K` with a lumped mass and a clamped outer edge, and the explicit step that uses it.
///
/// Fields are vectors in the operator's own layout of [`Self::field_length`] values: `position(dof)` tells
/// where a dof stands. What else a layout holds (padding, copies beyond the seam) has no mass.
pub trait StiffnessOperator: Send + Sync {
    /// `"sparse"` or `"cyclic"`.
    fn name(&self) -> &'static str;

    /// Number of dofs, clamped ones included.
    fn dof_count(&self) -> usize;

    /// Number of values in a field, a multiple of 8.
    fn field_length(&self) -> usize;

    /// Place of a dof in a field.
    fn position(&self, dof: usize) -> usize;

    /// Lumped mass by place, kg/m; zero for clamped dofs and padding.
    fn masses(&self) -> &[f64];

    /// `y = M^-1 K x`, 1/s2 times the unit of `x`; zero on clamped dofs.
    ///
    /// `x` must vanish on the clamped edge; its padding is overwritten.
    fn multiply(&self, x: &mut [f64], y: &mut [f64]);

    /// One central-difference step of `M du'/dt = -K u - C u'` with `C = alpha_R M + beta_R K`.
    ///
    /// ```text
    /// d = alpha_R v + beta_R z                   damping acceleration, z = M^-1 K v at n - 1/2
    /// v <- v - dt (q + d)                        q = M^-1 K u at n
    /// u <- u + dt v
    /// z <- M^-1 K v,   q <- q + dt z
    /// ```
    ///
    /// Returns the power of damping `sum m d (v_old + v_new) / 2`, W/m, summed in an order that does not depend on the instruction set.
    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64;
}

/// A vector over all dofs from a field.
pub fn gather(operator: &dyn StiffnessOperator, field: &[f64]) -> Vec<f64> {
    (0..operator.dof_count()).map(|dof| field[operator.position(dof)]).collect()
}

/// A field from a vector over all dofs; padding is zero.
pub fn scatter(operator: &dyn StiffnessOperator, vector: &[f64]) -> AlignedVector {
    let mut field = AlignedVector::zeros(operator.field_length());
    vector.iter().enumerate().for_each(|(dof, &value)| field[operator.position(dof)] = value);
    field
}
