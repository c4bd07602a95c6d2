//! Strains and stresses at the points of an element.

use super::{ElementGeometry, IntegrationPoint, Voigt, inverse, strain_of, stress_of};
use crate::fem::ElasticMaterial;
use crate::mesh::ElementKind;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

impl ElementGeometry {
    /// Whether the element has incompatible modes.
    pub(super) fn has_incompatible_modes(&self) -> bool {
        self.kind == ElementKind::Hex8
    }

    /// Gradients of the three incompatible modes `1 - xi_k^2` at each point, scaled so that a constant stress does no work on
    /// them (Taylor, Beresford and Wilson 1976); none for elements without.
    pub(super) fn incompatible_gradients(
        &self,
        points: &[IntegrationPoint],
    ) -> Vec<Vec<Vector3<f64>>> {
        if !self.has_incompatible_modes() {
            return vec![Vec::new(); points.len()];
        }
        let (inverse, determinant) = inverse(&self.jacobian([0.0; 3]));
        let at_point = |point: &IntegrationPoint| {
            // All weights of the 2 x 2 x 2 rule are one.
            let scale = determinant / point.measure;
            (0..3).map(|k: usize| inverse.column(k) * (-2.0 * point.place[k] * scale)).collect()
        };
        points.iter().map(at_point).collect()
    }

    /// Displacement gradient `du_i / dx_j` at a point, from the values of the element's nodes in their frames.
    fn nodal_gradient(&self, point: &IntegrationPoint, values: &[f64]) -> Matrix3<f64> {
        let mut gradient = Matrix3::zeros();
        let nodes = values.chunks_exact(self.dimension()).zip(&self.frames);
        for ((own, frame), slope) in nodes.zip(&point.gradients) {
            let components = Vector3::from_fn(|axis, _| own.get(axis).copied().unwrap_or(0.0));
            gradient += (frame * components) * slope.transpose();
        }
        gradient
    }

    /// Displacement gradients at some points, from each of several `values` of the element's nodes in their frames and the amplitudes of
    /// the incompatible modes that come with them.
    pub(super) fn displacement_gradients(
        &self,
        points: &[IntegrationPoint],
        material: &ElasticMaterial,
        values: &[Vec<f64>],
    ) -> Vec<Vec<Matrix3<f64>>> {
        let (recovered, modes) = (self.recovered(material), self.incompatible_gradients(points));
        let of = |values: &Vec<f64>| {
            let internal = recovered.as_ref().map(|own| own * DVector::from_column_slice(values));
            let at_point = |(point, modes): (&IntegrationPoint, &Vec<Vector3<f64>>)| {
                let mut gradient = self.nodal_gradient(point, values);
                if let Some(internal) = &internal {
                    for (k, mode) in modes.iter().enumerate() {
                        let amplitude = Vector3::from_fn(|axis, _| internal[3 * k + axis]);
                        gradient += amplitude * mode.transpose();
                    }
                }
                gradient
            };
            points.iter().zip(&modes).map(at_point).collect()
        };
        values.iter().map(of).collect()
    }

    /// Stress at some points, Pa, from the values of the element's nodes in their frames, m.
    pub fn stresses(
        &self,
        points: &[IntegrationPoint],
        material: &ElasticMaterial,
        values: &[f64],
    ) -> Vec<Voigt> {
        let all = self.displacement_gradients(points, material, &[values.to_vec()]);
        let gradients = &all[0];
        let pairs = points.iter().zip(gradients);
        pairs.map(|(point, gradient)| stress_of(material, gradient, self.position(point))).collect()
    }

    /// Strain at a point of each nodal displacement along its axis, and of each amplitude of the incompatible `modes`; of a body that is
    /// deformed, with the gradient of its displacement there, that of Green and Lagrange.
    pub(super) fn strain_columns(
        &self,
        point: &IntegrationPoint,
        modes: &[Vector3<f64>],
        gradient: Option<&Matrix3<f64>>,
    ) -> Vec<Voigt> {
        let deformed = |e: Vector3<f64>| match gradient {
            Some(gradient) => e + gradient.transpose() * e,
            None => e,
        };
        let mut strains = Vec::new();
        for (slope, frame) in point.gradients.iter().zip(&self.frames) {
            let axes = (0..self.dimension()).map(|axis| deformed(frame.column(axis).into_owned()));
            strains.extend(axes.map(|e| strain_of(|i, j| slope[i] * e[j])));
        }
        for slope in modes {
            let axes = (0..3).map(|axis| deformed(Vector3::ith(axis, 1.0)));
            strains.extend(axes.map(|e| strain_of(|i, j| slope[i] * e[j])));
        }
        strains
    }

    /// Matrix from the values of the element's nodes in their frames (m) to the strains at some points, with those of the incompatible
    /// modes that come with the values: three rows `(xx, yy, 2 xy)` a point in the plane, six `(xx, yy, zz, 2 xy, 2 yz, 2 zx)` in space.
    pub fn strain_operator(
        &self,
        material: &ElasticMaterial,
        points: &[IntegrationPoint],
    ) -> DMatrix<f64> {
        let (nodal, recovered) = (self.nodal_count(), self.recovered(material));
        let (components, modes) = (self.components(), self.incompatible_gradients(points));
        let rows = components.len();
        let mut operator = DMatrix::zeros(rows * points.len(), nodal);
        for (k, (point, modes)) in points.iter().zip(&modes).enumerate() {
            let columns = self.strain_columns(point, modes, None);
            let strains = DMatrix::from_fn(rows, columns.len(), |row, column| {
                columns[column][components[row]]
            });
            let mut own = strains.columns(0, nodal).into_owned();
            if let Some(recovered) = &recovered {
                own += strains.columns(nodal, columns.len() - nodal) * recovered;
            }
            operator.rows_mut(rows * k, rows).copy_from(&own);
        }
        operator
    }

    /// Elasticity `D` at a point, Pa, over the rows of [`Self::strain_operator`].
    pub fn elasticity(&self, material: &ElasticMaterial, point: &IntegrationPoint) -> DMatrix<f64> {
        let law = self.solid_aware(material).elasticity_at(self.position(point));
        let components = self.components();
        let count = components.len();
        DMatrix::from_fn(count, count, |row, column| law[components[row]][components[column]])
    }
}
