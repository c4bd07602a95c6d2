//! Mass, damping and stiffness of the body in the state that is excited.

use super::{Axis, Direction, FrfError, Port, Terminal};
use crate::contact::Row;
use crate::fem::{DofMap, MassKind, MaterialField, RayleighDamping};
use crate::linalg::{SparsityPattern, c64};
use crate::mesh::Mesh;
use crate::prestress::{
    ContactDofs, Elimination, MotionMatrices, SlidingTangent, TangentOptions, Terms,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Share of a direction that is the round-off of a frame.
const NO_SHARE: f64 = 1e-12;

/// Backward error `|f - A x| / (|A| |x|)` above which a line is solved again: with pivoting, or by a factorization of its own.
pub(super) const BACKWARD_ERROR_BOUND: f64 = 1e-14;
/// `|A| |x| / |f|` above which a matrix has no inverse in double precision.
pub(super) const GROWTH_BOUND: f64 = 1e15;

/// `M`, `C`, `K` over the unknowns, on one sparsity pattern.
#[derive(Clone, Debug)]
pub struct FrfSystem {
    /// The pattern of all matrices.
    pub(super) pattern: Arc<SparsityPattern>,
    /// Their nonzeros.
    pub(super) matrices: MotionMatrices<Vec<f64>>,
    /// Coefficients of `C = alpha_R M + beta_R K`; `None` for any other damping.
    pub(super) proportional: Option<RayleighDamping>,
    unknowns: DofMap,
    /// Dofs that are combinations of the unknowns, as full dofs.
    followers: Vec<(usize, Row)>,
}

impl FrfSystem {
    /// The body without contact and prestress, free or with its outer edge clamped, `C = alpha_R M + beta_R K`.
    pub fn body(
        mesh: &Mesh,
        material: &dyn MaterialField,
        mass: MassKind,
        damping: RayleighDamping,
        is_clamped: bool,
    ) -> Self {
        let options = TangentOptions::of_free(mass, damping);
        let terms = Terms::of_mesh((mesh, material), !is_clamped, &options);
        let held = mesh.held_dofs().filter(|_| is_clamped);
        let basis = Elimination::holding(mesh.dof_count(), held);
        let none = ContactDofs::default();
        let tangent = SlidingTangent::assemble(terms, &[], basis, none, &options);
        Self::sliding(&tangent.expect("bodies without contact are held once"), 0.0)
    }

    /// Small motions around steady sliding at a friction coefficient.
    ///
    /// With rigid contact the normal displacement of the contact nodes is no unknown; the force of
    /// excitation acts on the body, not through the contact.
    pub fn sliding(tangent: &SlidingTangent, friction_coefficient: f64) -> Self {
        Self {
            pattern: Arc::clone(tangent.stiffness.pattern()),
            matrices: MotionMatrices::of(tangent, |own| own.evaluate(friction_coefficient)),
            proportional: tangent.proportional,
            unknowns: tangent.unknowns.clone(),
            followers: tangent.distances.clone(),
        }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.unknowns.len()
    }

    /// Port of a terminal on the system's mesh, its direction about `axis`; `key` is the case key of its node.
    ///
    /// A node of a tied or sliding surface that follows another one can be observed, not excited: a force there would act on
    /// the other surface too, and through friction.
    ///
    /// # Errors
    /// [`FrfError::Node`].
    pub fn port(
        &self,
        mesh: &Mesh,
        axis: Option<Axis>,
        terminal: Terminal,
        key: &'static str,
    ) -> Result<Port, FrfError> {
        if terminal.node >= mesh.node_count() {
            return Err(terminal.missing(key, mesh.node_count()));
        }
        if matches!(terminal.direction, Direction::Axial | Direction::Z) && mesh.dimension == 2 {
            return Err(terminal.in_plane(key));
        }
        let local = terminal.direction.at(mesh, terminal.node, axis).ok_or_else(|| {
            let own = terminal.direction.name();
            let fault = format!(
                "lies on the axis, where {own} has no direction: use \"x\", \"y\" or \"z\", or another node"
            );
            terminal.refused(key, &fault)
        })?;
        let mut shares = Row::new();
        for component in (0..mesh.dimension).filter(|&k| local[k].abs() > NO_SHARE) {
            let (dof, share) = (mesh.dimension * terminal.node + component, local[component]);
            let follower = self.followers.iter().find(|(own, _)| *own == dof);
            let row = follower.map_or_else(|| vec![(dof, 1.0)], |(_, row)| row.clone());
            // A separation from a rigid counterface is the node's own.
            let is_own = matches!(row[..], [(other, _)] if other == dof);
            let is_excited = key == "force_node";
            if is_excited && !is_own {
                let fault = "lies on a surface that is tied to or slides on another, and follows it. Apply the force to a node \
                             beside the surface";
                return Err(terminal.refused(key, fault));
            }
            let unknown_of = &self.unknowns.unknown_of;
            let free =
                row.iter().filter_map(|&(other, part)| Some((unknown_of[other]?, part * share)));
            let free: Row = free.collect();
            if free.is_empty() && (is_excited || follower.is_none()) {
                return Err(terminal.constrained(key));
            }
            shares.extend(free);
        }
        Ok(Port(shares))
    }

    /// `|e_force - A x|` and `|A| |x|` for `A = K + i H + i omega C - omega^2 M`, in the largest norm.
    pub(super) fn residual(&self, frequency_hz: f64, x: &[c64], force: &Port) -> (f64, f64) {
        let matrix = self.dynamic_stiffness(frequency_hz);
        let mut residual = force.complex_force(x.len());
        let mut row_sums = vec![0.0; x.len()];
        for (column, x) in x.iter().enumerate() {
            for (k, row) in self.pattern.column(column) {
                let value = matrix[k];
                residual[row] -= value * x;
                row_sums[row] += value.re.abs() + value.im.abs();
            }
        }
        let largest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(0.0, f64::max);
        let norm = largest(&mut row_sums.iter().copied());
        let size = norm * largest(&mut x.iter().map(|v| v.norm()));
        let is_finite = residual.iter().all(|r| r.re.is_finite() && r.im.is_finite());
        let residual = largest(&mut residual.iter().map(|r| r.norm()));
        (if is_finite { residual } else { f64::INFINITY }, size)
    }

    /// Nonzeros of `K + i H + i omega C - omega^2 M`, with what tables add at that frequency.
    pub(super) fn dynamic_stiffness(&self, frequency_hz: f64) -> Vec<c64> {
        self.matrices.at(c64::new(0.0, TAU * frequency_hz))
    }

    /// `(2 omega M - i C) x + M w` from the last two terms `[w, x]` of a series, or the same with `M^T` and `C^T`.
    pub(super) fn slope(&self, omega: f64, terms: &[Vec<c64>], is_transposed: bool) -> Vec<c64> {
        let (MotionMatrices { mass, damping, .. }, w, x) = (&self.matrices, &terms[0], &terms[1]);
        let mut y = vec![c64::ZERO; x.len()];
        for column in 0..x.len() {
            for (k, row) in self.pattern.column(column) {
                let [from, to] = if is_transposed { [row, column] } else { [column, row] };
                let turned = c64::new(x[from].im, -x[from].re);
                y[to] += (x[from] * (2.0 * omega) + w[from]) * mass[k] + turned * damping[k];
            }
        }
        y
    }

    /// Nonzeros of `K - omega^2 M`.
    pub(super) fn undamped_stiffness(&self, frequency_hz: f64) -> Vec<f64> {
        let omega = TAU * frequency_hz;
        let pairs = self.matrices.stiffness.iter().zip(&self.matrices.mass);
        pairs.map(|(k, m)| k - omega * omega * m).collect()
    }

    /// `y = A x` for one of the matrices.
    pub(super) fn multiply(&self, values: &[f64], x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for (column, x) in x.iter().enumerate() {
            self.pattern.column(column).for_each(|(k, row)| y[row] += values[k] * x);
        }
        y
    }
}

/// Checks that every frequency is positive.
pub(super) fn check_frequencies(frequencies_hz: &[f64]) -> Result<(), FrfError> {
    match frequencies_hz.iter().find(|f| !(**f > 0.0 && f.is_finite())) {
        Some(value) => Err(FrfError::Frequency(*value)),
        None => Ok(()),
    }
}
