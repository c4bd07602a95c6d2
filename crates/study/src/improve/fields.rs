//! Derivatives of eigenvalues by a mass, a spring, a dashpot at each node, by damping and by removal of each element.
//!
//! ```text
//! d lambda = - w^T (lambda^2 dM + lambda dC + dK) x,    w^T (2 lambda M + C) x = 1
//! ```
//!
//! with `w` over all dofs, see [`frictionsim_physics::prestress::SlidingTangent::left_displacement`].
//! The base state is kept as it is.
//!
//! Source: H. M. Adelman, R. T. Haftka, Sensitivity analysis of discrete structural systems, AIAA Journal 24 (1986).

use super::base::{Base, PairedMode};
use crate::*;
use frictionsim_physics::fem::element::{ElementGeometry, nodal_values};
use frictionsim_physics::fem::element_matrices;

/// Derivatives of one eigenvalue.
pub(super) struct Derivatives {
    /// Its mode in the list of the base.
    pub eigenvalue: c64,
    /// `w_a x_b` at each node over the global axes.
    pub nodes: Vec<[[c64; 3]; 3]>,
    /// By taking each element away, rad/s.
    pub removal: Vec<c64>,
    /// By stiffness damping of each element, rad/s2.
    pub damping: Vec<c64>,
}

impl Derivatives {
    /// Of a target of a base.
    pub fn of(base: &Base<'_>, mode: &PairedMode) -> Self {
        let nodes = 0..base.mesh.node_count();
        let elements = 0..base.mesh.element_count();
        let (removal, damping): (Vec<c64>, Vec<c64>) = parallel::map(elements, |element| {
            let [mass, damping, stiffness] = element_terms(base, element);
            let dofs: Vec<usize> = base.mesh.element_dofs(element).collect();
            let [m, c, k] = [&mass, &damping, &stiffness].map(|p| form(mode, &dofs, p));
            let [_, elastic] = matrices(base, element);
            let lambda = mode.eigenvalue();
            let taken = lambda * (lambda * m + c) + k;
            (taken, -lambda * form(mode, &dofs, &elastic))
        });
        Self {
            eigenvalue: mode.eigenvalue(),
            nodes: nodes.map(|node| product(base, mode, node)).collect(),
            removal,
            damping,
        }
    }

    /// `d lambda / d m` by a mass at a node, rad/s for each kg (in the plane for each kg/m).
    pub fn by_mass(&self, node: usize, base: &Base<'_>) -> c64 {
        let (own, lambda, [coriolis, centrifugal]) =
            (&self.nodes[node], self.eigenvalue, base.turning);
        let inertia = lambda * (lambda + base.options.damping.mass_coefficient);
        let turning = (0..9).map(|k| (k / 3, k % 3));
        let turning = turning.map(|at| own[at.0][at.1] * (lambda * coriolis[at] + centrifugal[at]));
        -inertia * (own[0][0] + own[1][1] + own[2][2]) - turning.sum::<c64>()
    }

    /// The symmetric matrix `S` with `d lambda = d^T S d` by a spring or a dashpot along a unit vector `d`, real parts.
    pub fn by_link(&self, kind: ModificationKind, node: usize) -> Matrix3<f64> {
        let own = &self.nodes[node];
        let factor = match kind {
            ModificationKind::Spring => c64::new(-1.0, 0.0),
            _ => -self.eigenvalue,
        };
        let entry = |i: usize, j: usize| (factor * own[i][j]).re;
        Matrix3::from_fn(|i, j| 0.5 * (entry(i, j) + entry(j, i)))
    }
}

/// `w_a x_b` over the global axes.
fn product(base: &Base<'_>, mode: &PairedMode, node: usize) -> [[c64; 3]; 3] {
    let d = base.mesh.dimension;
    let frame = base.mesh.frame(node);
    let global = |values: &[c64]| {
        let part = |axis: usize| {
            let own = (0..d).map(|k| values[d * node + k] * frame[(axis, k)]);
            own.fold(c64::ZERO, |sum, value| sum + value)
        };
        [0, 1, 2].map(|axis| if axis < d { part(axis) } else { c64::ZERO })
    };
    let (left, right) = (global(&mode.left), global(&mode.right));
    left.map(|w| right.map(|x| w * x))
}

/// `w^T P x` over some dofs.
fn form(mode: &PairedMode, dofs: &[usize], matrix: &DMatrix<f64>) -> c64 {
    let mut sum = c64::ZERO;
    for (j, &column) in dofs.iter().enumerate() {
        let along = dofs.iter().enumerate().map(|(i, &row)| mode.left[row] * matrix[(i, j)]);
        sum += along.fold(c64::ZERO, |sum, value| sum + value) * mode.right[column];
    }
    sum
}

/// Mass and elastic stiffness of an element.
pub(super) fn matrices(base: &Base<'_>, element: usize) -> [DMatrix<f64>; 2] {
    element_matrices(&base.mesh, base.case.materials(), base.options.mass, element)
}

/// What an element and the supports on its faces add to `M`, `C` and `K` of the tangent.
pub(super) fn element_terms(base: &Base<'_>, element: usize) -> [DMatrix<f64>; 3] {
    let materials = base.case.materials();
    let region = base.mesh.region(element);
    let [mass, mut stiffness] = matrices(base, element);
    let common = base.options.damping;
    let own = materials.own_damping(region).unwrap_or(common);
    let (alpha, beta) = (own.mass_coefficient, own.stiffness_coefficient);
    let mut damping = &mass * alpha + &stiffness * beta;
    if let Some(displacement) = &base.displacement {
        let elastic = materials.of(region);
        let values = nodal_values(&base.mesh, element, displacement);
        let geometry = ElementGeometry::new(&base.mesh, element);
        let geometric = geometry.geometric_stiffnesses(elastic, &[values]).swap_remove(0);
        if base.options.damping_model == DampingModel::WholeTangent {
            damping += &geometric * common.stiffness_coefficient;
        }
        stiffness += geometric;
    }
    if let Some([springs, dashpots]) = base.supports.get(&(element as u32)) {
        let dofs: Vec<usize> = base.mesh.element_dofs(element).collect();
        let place = |dof: usize| dofs.iter().position(|own| *own == dof);
        for (sum, own) in [(&mut stiffness, springs), (&mut damping, dashpots)] {
            for &(row, column, value) in &own.entries {
                if let (Some(i), Some(j)) = (place(row), place(column)) {
                    sum[(i, j)] += value;
                }
            }
        }
    }
    [mass, damping, stiffness]
}
