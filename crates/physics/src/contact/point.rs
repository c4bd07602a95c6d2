//! Contact points as rows over the degrees of freedom of one body or two.

use super::SteadyFriction;
use crate::mesh::Mesh;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Coefficients `(dof, coefficient)` of a linear form of the displacements.
pub type Row = Vec<(usize, f64)>;

/// A row times a factor.
pub fn scaled(row: &[(usize, f64)], factor: f64) -> Row {
    row.iter().map(|&(dof, value)| (dof, factor * value)).collect()
}

/// Coefficients of one dof added up, in the order of the dofs.
pub fn summed(entries: impl IntoIterator<Item = (usize, f64)>) -> Row {
    let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
    entries.into_iter().for_each(|(dof, value)| *sum.entry(dof).or_default() += value);
    sum.into_iter().collect()
}

/// A point of contact: a node of an edge, a mortar point, or a quadrature point of a face.
///
/// With `u_rel = u_A - u_B` (A has the point's surface, B the counterface; one of them may be rigid), `n` the normal into
/// A and `t` the direction in which B moves relative to A,
///
/// ```text
/// separation = normal . u = n . u_rel,   slip = slip . u = t . u_rel,   across . u = (n x t) . u_rel
/// ```
///
/// The contact pushes with `N >= 0` along `normal` and drags with `T = drag mu N` along `slip`. In the plane `t` is the
/// second axis of the node's frame whatever the sense of sliding, `drag` has its sign, and there is no row across.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Its share of the surface `w`: m2; m for each metre of thickness in the plane.
    pub weight: f64,
    /// Distance before deformation, m.
    pub gap: f64,
    /// Row of the separation.
    pub normal: Row,
    /// A displacement that parts the surfaces by one here, and neither parts them elsewhere nor lets them slip: the normal
    /// force is its work. Empty where the point has no dofs of its own.
    pub lift: Row,
    /// Row of the slip along the sliding.
    pub slip: Row,
    /// Row of the slip across the sliding; empty in the plane.
    pub across: Row,
    /// Sliding speed `V`, m/s.
    pub speed: f64,
    /// Friction at that speed for each unit of friction coefficient and normal force.
    pub friction: SteadyFriction,
}

impl Point {
    /// With rows over the first `size` dofs, of which all others are copies.
    pub(crate) fn folded(&self, size: usize) -> Self {
        let [normal, slip] = [&self.normal, &self.slip]
            .map(|row| summed(row.iter().map(|&(dof, value)| (dof % size, value))));
        Self { normal, slip, ..self.clone() }
    }
}

/// `direction . u` at a point of a face, over all dofs.
pub fn row_along(mesh: &Mesh, nodes: &[(u32, f64)], direction: [f64; 3], sign: f64) -> Row {
    let direction = Vector3::from(direction);
    let mut row = Row::new();
    for &(node, value) in nodes {
        let frame = mesh.frame(node as usize);
        for axis in 0..3 {
            let along = sign * value * frame.column(axis).dot(&direction);
            if along.abs() > 1e-15 {
                row.push((mesh.dimension * node as usize + axis, along));
            }
        }
    }
    row
}
