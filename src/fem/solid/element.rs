//! Element matrices of bricks in nodal frames.

use super::SolidMatrix;
use crate::fem::{ElasticMaterial, MassKind};
use crate::mesh::{SolidSector, brick_quadrature, brick_shapes};
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3, Vector6};

/// Geometry of one element of sector 0.
pub(super) struct Geometry {
    is_quadratic: bool,
    pub nodes: Vec<Vector3<f64>>,
    /// `e_r`, `e_theta`, `e_z` at each node, as columns.
    pub frames: Vec<Matrix3<f64>>,
}

/// Shape functions, their gradients and the volume that belongs to a Gauss point.
pub(super) struct Point {
    at: [f64; 3],
    values: Vec<f64>,
    pub gradients: Vec<Vector3<f64>>,
    pub measure: f64,
}

impl Geometry {
    pub fn new(sector: &SolidSector, element: usize) -> Self {
        let (mut nodes, mut frames) = (Vec::new(), Vec::new());
        for &(node, half) in &sector.elements[element] {
            let place = &sector.nodes[node];
            let (sin, cos) = (sector.half_angle() * half as f64).sin_cos();
            nodes.push(Vector3::new(
                place.radius * cos,
                place.radius * sin,
                place.height,
            ));
            frames.push(Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0));
        }
        Self {
            is_quadratic: sector.is_quadratic(),
            nodes,
            frames,
        }
    }

    /// `dx / dxi` at a point, one column for each parent coordinate.
    fn jacobian(&self, at: [f64; 3]) -> Matrix3<f64> {
        let shapes = brick_shapes(self.is_quadratic, at);
        let mut jacobian = Matrix3::zeros();
        for (node, (_, slope)) in self.nodes.iter().zip(&shapes) {
            for (axis, value) in slope.iter().enumerate() {
                let column = jacobian.column(axis) + node * *value;
                jacobian.set_column(axis, &column);
            }
        }
        jacobian
    }

    pub fn points(&self) -> Vec<Point> {
        let points = brick_quadrature(self.is_quadratic).into_iter();
        points
            .map(|(at, weight)| {
                let shapes = brick_shapes(self.is_quadratic, at);
                let jacobian = self.jacobian(at);
                let inverse = jacobian
                    .try_inverse()
                    .unwrap_or_else(Matrix3::zeros)
                    .transpose();
                let gradient = |s: &[f64; 3]| inverse * Vector3::from_row_slice(s);
                Point {
                    at,
                    gradients: shapes.iter().map(|(_, slope)| gradient(slope)).collect(),
                    values: shapes.into_iter().map(|(value, _)| value).collect(),
                    measure: weight * jacobian.determinant().abs(),
                }
            })
            .collect()
    }

    /// Gradients of the three incompatible modes `1 - xi_k^2` at a point, scaled so that a constant stress does no work on
    /// them (Taylor, Beresford and Wilson 1976).
    pub fn incompatible(
        &self,
        point: &Point,
        center: &(Matrix3<f64>, f64),
        weight: f64,
    ) -> [Vector3<f64>; 3] {
        let scale = center.1 * weight / point.measure;
        std::array::from_fn(|k| center.0.column(k) * (-2.0 * point.at[k] * scale))
    }

    /// Inverse transpose of the Jacobian at the centre, and its determinant.
    pub fn center(&self) -> (Matrix3<f64>, f64) {
        let jacobian = self.jacobian([0.0; 3]);
        let inverse = jacobian.try_inverse().unwrap_or_else(Matrix3::zeros);
        (inverse.transpose(), jacobian.determinant().abs())
    }
}

/// Strain `(xx, yy, zz, 2 xy, 2 yz, 2 zx)` of a displacement along `e` with the gradient `g` of its size.
pub(super) fn strain(g: &Vector3<f64>, e: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(
        g.x * e.x,
        g.y * e.y,
        g.z * e.z,
        g.x * e.y + g.y * e.x,
        g.y * e.z + g.z * e.y,
        g.z * e.x + g.x * e.z,
    )
}

pub(super) fn elasticity(material: &ElasticMaterial) -> SMatrix<f64, 6, 6> {
    let [lambda, shear] = material.solid_lame_constants();
    let mut matrix = SMatrix::<f64, 6, 6>::zeros();
    for i in 0..3 {
        for j in 0..3 {
            matrix[(i, j)] = lambda;
        }
        matrix[(i, i)] += 2.0 * shear;
        matrix[(i + 3, i + 3)] = shear;
    }
    matrix
}

/// Stiffness of an element over its nodes and, for 8 nodes, the amplitudes of the incompatible modes; linear in Lamé's constants.
fn full_stiffness(geometry: &Geometry, material: &ElasticMaterial) -> DMatrix<f64> {
    let count = geometry.nodes.len();
    let internal = if geometry.is_quadratic { 0 } else { 9 };
    let size = 3 * count + internal;
    let law = elasticity(material);
    let center = geometry.center();
    let mut full = DMatrix::<f64>::zeros(size, size);
    for point in geometry.points() {
        let mut strains: Vec<Vector6<f64>> = Vec::with_capacity(size);
        for (gradient, frame) in point.gradients.iter().zip(&geometry.frames) {
            strains.extend((0..3).map(|c| strain(gradient, &frame.column(c).into())));
        }
        if internal > 0 {
            // All weights of the 2 x 2 x 2 rule are one.
            for gradient in geometry.incompatible(&point, &center, 1.0) {
                strains.extend((0..3).map(|c| strain(&gradient, &Vector3::ith(c, 1.0))));
            }
        }
        for column in 0..size {
            let stress = law * strains[column] * point.measure;
            for row in 0..=column {
                full[(row, column)] += strains[row].dot(&stress);
            }
        }
    }
    full.fill_lower_triangle_with_upper_triangle();
    full
}

/// An element's stiffness over its nodes, or its derivative.
pub(super) struct Condensed {
    stiffness: DMatrix<f64>,
    /// What the amplitudes of the incompatible modes are for each nodal displacement, `alpha = R u`, `R = -K_ii^-1 K_iu`.
    pub recovered: Option<DMatrix<f64>>,
}

pub(super) fn element_stiffness(geometry: &Geometry, material: &ElasticMaterial) -> Condensed {
    let full = full_stiffness(geometry, material);
    let nodal = 3 * geometry.nodes.len();
    let internal = full.nrows() - nodal;
    if internal == 0 {
        return Condensed {
            stiffness: full,
            recovered: None,
        };
    }
    let coupling = full.view((nodal, 0), (internal, nodal)).into_owned();
    let inner = full.view((nodal, nodal), (internal, internal)).into_owned();
    let recovered = inner.cholesky().map(|factor| -factor.solve(&coupling));
    let recovered = recovered.unwrap_or_else(|| DMatrix::zeros(internal, nodal));
    let mut condensed = full.view((0, 0), (nodal, nodal)) + coupling.transpose() * &recovered;
    // Exactly symmetric.
    condensed.fill_lower_triangle_with_upper_triangle();
    Condensed {
        stiffness: condensed,
        recovered: Some(recovered),
    }
}

/// Derivative of [`element_stiffness`] where Lamé's constants change at the `rate` of another material's:
///
/// ```text
/// dK = [1; R]^T dK_full [1; R],   dR = -K_ii^-1 (dK_iu + dK_ii R)
/// ```
pub(super) fn element_stiffness_rate(
    geometry: &Geometry,
    material: &ElasticMaterial,
    rate: &ElasticMaterial,
) -> Condensed {
    let change = full_stiffness(geometry, rate);
    let nodal = 3 * geometry.nodes.len();
    let internal = change.nrows() - nodal;
    let Some(recovered) = element_stiffness(geometry, material).recovered else {
        return Condensed {
            stiffness: change,
            recovered: None,
        };
    };
    let mut follows = DMatrix::<f64>::identity(nodal + internal, nodal);
    follows
        .view_mut((nodal, 0), (internal, nodal))
        .copy_from(&recovered);
    let image = &change * &follows;
    let mut stiffness = follows.transpose() * &image;
    stiffness.fill_lower_triangle_with_upper_triangle();
    let full = full_stiffness(geometry, material);
    let inner = full.view((nodal, nodal), (internal, internal)).into_owned();
    let load = image.view((nodal, 0), (internal, nodal)).into_owned();
    Condensed {
        stiffness,
        recovered: inner.cholesky().map(|factor| -factor.solve(&load)),
    }
}

/// A matrix that is the same in every layer, from the elements of the first.
fn layered(sector: &SolidSector, compute: impl FnMut(usize) -> DMatrix<f64>) -> SolidMatrix {
    let [radial, _] = sector.divisions();
    let places = sector.elements.iter().enumerate();
    SolidMatrix {
        matrices: (0..radial).map(compute).collect(),
        places: places
            .map(|(e, nodes)| (e % radial, nodes.clone()))
            .collect(),
    }
}

/// Elastic stiffness `∫ B^T D B dV`, N/m: full integration for 20 nodes, incompatible modes for 8, which do not lock in bending.
pub fn stiffness(sector: &SolidSector, material: &ElasticMaterial) -> SolidMatrix {
    layered(sector, |e| {
        element_stiffness(&Geometry::new(sector, e), material).stiffness
    })
}

/// Derivative of [`stiffness`] where Lamé's constants change at the `rate` of another material's, N/m for each unit.
pub fn stiffness_rate(
    sector: &SolidSector,
    material: &ElasticMaterial,
    rate: &ElasticMaterial,
) -> SolidMatrix {
    layered(sector, |e| {
        element_stiffness_rate(&Geometry::new(sector, e), material, rate).stiffness
    })
}

/// Mass, kg: consistent `∫ rho N_I N_J dV`, or lumped by row sums (8 nodes) or the scaled diagonal (20 nodes; Hinton, Rock and
/// Zienkiewicz 1976).
pub fn mass(sector: &SolidSector, material: &ElasticMaterial, kind: MassKind) -> SolidMatrix {
    layered(sector, |e| {
        let geometry = Geometry::new(sector, e);
        let count = geometry.nodes.len();
        let mut scalar = DMatrix::<f64>::zeros(count, count);
        for point in geometry.points() {
            let values = nalgebra::DVector::from_vec(point.values);
            scalar.ger(material.density * point.measure, &values, &values, 1.0);
        }
        if kind == MassKind::Lumped {
            let diagonal = match geometry.is_quadratic {
                false => scalar.column_sum(),
                true => scalar.diagonal() * (scalar.sum() / scalar.trace()),
            };
            scalar = DMatrix::from_diagonal(&diagonal);
        }
        rotated(&geometry, &scalar)
    })
}

/// `s_IJ F_I^T F_J`, `F_I` node I's frame.
pub(super) fn rotated(geometry: &Geometry, scalar: &DMatrix<f64>) -> DMatrix<f64> {
    let count = scalar.nrows();
    let mut matrix = DMatrix::zeros(3 * count, 3 * count);
    for column in 0..count {
        for row in 0..count {
            let block =
                geometry.frames[row].transpose() * geometry.frames[column] * scalar[(row, column)];
            matrix
                .fixed_view_mut::<3, 3>(3 * row, 3 * column)
                .copy_from(&block);
        }
    }
    matrix
}
