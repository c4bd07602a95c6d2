//! Element matrices of isoparametric elements in nodal frames.

use super::ElasticMaterial;
use crate::mesh::{ElementKind, Mesh2d};
use nalgebra::{DMatrix, Matrix2, Matrix3, Vector2, Vector3};

/// One integration point of one element: shape values, Cartesian gradients, and `w det J`.
pub struct IntegrationPoint {
    /// `N_I`.
    pub values: Vec<f64>,
    /// `grad N_I` in global Cartesian axes, 1/m.
    pub gradients: Vec<Vector2<f64>>,
    /// Quadrature weight times Jacobian determinant, m2.
    pub measure: f64,
}

/// One element of a mesh, ready to be integrated over.
pub struct ElementGeometry<'a> {
    mesh: &'a Mesh2d,
    kind: ElementKind,
    nodes: &'a [u32],
}

impl<'a> ElementGeometry<'a> {
    /// Element `element` of `mesh`.
    pub fn new(mesh: &'a Mesh2d, element: usize) -> Self {
        Self {
            mesh,
            kind: mesh.element_kind(element),
            nodes: mesh.element_nodes(element),
        }
    }

    /// Shape values, gradients and measure at parent point `(xi, eta)` of weight `weight`.
    pub fn at(&self, xi: f64, eta: f64, weight: f64) -> IntegrationPoint {
        let shapes = self.kind.shape_functions(xi, eta);
        let shapes: Vec<_> = shapes
            .into_iter()
            .map(|(value, [a, b])| (value, Vector2::new(a, b)))
            .collect();
        let mut jacobian = Matrix2::zeros();
        for (&(_, gradient), &node) in shapes.iter().zip(self.nodes) {
            let [x, y] = self.mesh.nodes[node as usize];
            jacobian += gradient * Vector2::new(x, y).transpose();
        }
        let determinant = jacobian.determinant();
        let inverse = Matrix2::new(
            jacobian[(1, 1)],
            -jacobian[(0, 1)],
            -jacobian[(1, 0)],
            jacobian[(0, 0)],
        ) / determinant;
        IntegrationPoint {
            values: shapes.iter().map(|s| s.0).collect(),
            gradients: shapes.iter().map(|s| inverse * s.1).collect(),
            measure: weight * determinant,
        }
    }

    /// Every point of the full quadrature rule.
    pub fn integration_points(&self) -> Vec<IntegrationPoint> {
        self.kind
            .quadrature()
            .into_iter()
            .map(|(xi, eta, weight)| self.at(xi, eta, weight))
            .collect()
    }

    /// Unit vectors of node `local`'s frame as columns, `[e_1 e_2]`.
    pub fn frame(&self, local: usize) -> Matrix2<f64> {
        let (sin, cos) = self.mesh.frame_angles[self.nodes[local] as usize].sin_cos();
        Matrix2::new(cos, -sin, sin, cos)
    }

    /// Displacement gradient `du_i / dx_j` at a point, from nodal values in nodal frames.
    pub fn displacement_gradient(
        &self,
        point: &IntegrationPoint,
        displacement: &[f64],
    ) -> Matrix2<f64> {
        let mut gradient = Matrix2::zeros();
        for (local, &node) in self.nodes.iter().enumerate() {
            let dof = 2 * node as usize;
            let u = self.frame(local) * Vector2::new(displacement[dof], displacement[dof + 1]);
            gradient += u * point.gradients[local].transpose();
        }
        gradient
    }
}

/// In-plane Cauchy stress of a displacement gradient, Pa.
pub fn stress_of(material: &ElasticMaterial, gradient: &Matrix2<f64>) -> Matrix2<f64> {
    let [lambda, shear_modulus] = material.lame_constants();
    let strain = 0.5 * (gradient + gradient.transpose());
    Matrix2::identity() * (lambda * strain.trace()) + 2.0 * shear_modulus * strain
}

/// Element stiffness `K_e = ∫ B^T D B dA` in nodal frames, N/m for each metre of thickness.
///
/// Shape `(2 m, 2 m)` for `m` nodes, dof order `(node 1: e_1, e_2, node 2: ...)`.
pub fn stiffness(mesh: &Mesh2d, element: usize, material: &ElasticMaterial) -> DMatrix<f64> {
    let geometry = ElementGeometry::new(mesh, element);
    let elasticity = material.elasticity();
    let elasticity = Matrix3::from_fn(|i, j| elasticity[i][j]);
    let count = geometry.nodes.len();
    let mut matrix = DMatrix::zeros(2 * count, 2 * count);
    for point in geometry.integration_points() {
        let strains: Vec<[Vector3<f64>; 2]> = (0..count)
            .map(|local| {
                let (gradient, frame) = (point.gradients[local], geometry.frame(local));
                [0, 1].map(|axis| {
                    let e = frame.column(axis);
                    Vector3::new(
                        gradient.x * e.x,
                        gradient.y * e.y,
                        gradient.y * e.x + gradient.x * e.y,
                    )
                })
            })
            .collect();
        let strains: Vec<Vector3<f64>> = strains.into_iter().flatten().collect();
        for column in 0..2 * count {
            let stress = elasticity * strains[column] * point.measure;
            for row in 0..=column {
                matrix[(row, column)] += strains[row].dot(&stress);
            }
        }
    }
    mirror_upper_triangle(&mut matrix);
    matrix
}

/// Element geometric stiffness `K_sigma = ∫ (grad N_I . sigma . grad N_J) I dA` of the stress that
/// the nodal displacements `base` cause, in nodal frames, N/m for each metre of thickness.
///
/// It is the stress part of the tangent alone: a pressure that follows its edge adds the follower
/// terms of the contact, which the caller must include too.
pub fn geometric_stiffness(
    mesh: &Mesh2d,
    element: usize,
    material: &ElasticMaterial,
    base: &[f64],
) -> DMatrix<f64> {
    let geometry = ElementGeometry::new(mesh, element);
    let count = geometry.nodes.len();
    let mut scalar = DMatrix::<f64>::zeros(count, count);
    for point in geometry.integration_points() {
        let gradient = geometry.displacement_gradient(&point, base);
        let stress = stress_of(material, &gradient) * point.measure;
        for column in 0..count {
            let flux = stress * point.gradients[column];
            for row in 0..=column {
                scalar[(row, column)] += point.gradients[row].dot(&flux);
            }
        }
    }
    rotate_scalar(&geometry, scalar)
}

/// Element consistent mass `M_e = ∫ rho N_I N_J I dA` in nodal frames, kg for each metre of
/// thickness.
pub fn consistent_mass(mesh: &Mesh2d, element: usize, material: &ElasticMaterial) -> DMatrix<f64> {
    let geometry = ElementGeometry::new(mesh, element);
    rotate_scalar(&geometry, scalar_mass(&geometry, material))
}

/// Element lumped mass of each node, kg for each metre of thickness: row sums for linear
/// shapes; for quadratic ones, whose row sums are not positive at the corners, the diagonal scaled to the
/// element's mass (Hinton, Rock and Zienkiewicz 1976).
pub fn lumped_mass(mesh: &Mesh2d, element: usize, material: &ElasticMaterial) -> Vec<f64> {
    let geometry = ElementGeometry::new(mesh, element);
    let scalar = scalar_mass(&geometry, material);
    let full = DMatrix::from_fn(scalar.nrows(), scalar.ncols(), |row, column| {
        scalar[(row.min(column), row.max(column))]
    });
    if !geometry.kind.is_quadratic() {
        return full.row_iter().map(|row| row.sum()).collect();
    }
    let scale = full.sum() / full.diagonal().sum();
    full.diagonal().iter().map(|value| value * scale).collect()
}

/// Upper triangle of `∫ rho N_I N_J dA`.
fn scalar_mass(geometry: &ElementGeometry<'_>, material: &ElasticMaterial) -> DMatrix<f64> {
    let count = geometry.nodes.len();
    let mut scalar = DMatrix::zeros(count, count);
    for point in geometry.integration_points() {
        for column in 0..count {
            let weighted = material.density * point.measure * point.values[column];
            for row in 0..=column {
                scalar[(row, column)] += point.values[row] * weighted;
            }
        }
    }
    scalar
}

/// Expands the upper triangle of `s_IJ` into `s_IJ F_I^T F_J`, `F_I` node I's frame.
fn rotate_scalar(geometry: &ElementGeometry<'_>, scalar: DMatrix<f64>) -> DMatrix<f64> {
    let count = scalar.nrows();
    let frames: Vec<_> = (0..count).map(|local| geometry.frame(local)).collect();
    let mut matrix = DMatrix::zeros(2 * count, 2 * count);
    for column in 0..count {
        for row in 0..=column {
            let block = frames[row].transpose() * frames[column] * scalar[(row, column)];
            matrix
                .fixed_view_mut::<2, 2>(2 * row, 2 * column)
                .copy_from(&block);
        }
    }
    mirror_upper_triangle(&mut matrix);
    matrix
}

/// Makes a matrix whose upper triangle was filled exactly symmetric.
fn mirror_upper_triangle(matrix: &mut DMatrix<f64>) {
    for column in 0..matrix.ncols() {
        for row in 0..column {
            matrix[(column, row)] = matrix[(row, column)];
        }
    }
}
