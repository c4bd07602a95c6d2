//! Mass of an element.

use super::ElementGeometry;
use crate::fem::ElasticMaterial;
use nalgebra::DMatrix;

impl ElementGeometry {
    /// Element consistent mass `M_e = ∫ rho N_I N_J I dV` in nodal frames, kg, in the plane for each metre of thickness.
    pub fn consistent_mass(&self, material: &ElasticMaterial) -> DMatrix<f64> {
        self.rotate_scalar(self.scalar_mass(material))
    }

    /// Element lumped mass of each node, kg, in the plane for each metre of thickness: row sums for linear kinds; for quadratic ones, whose
    /// row sums are not positive at the corners, the diagonal scaled to the element's mass (Hinton, Rock and Zienkiewicz 1976).
    pub fn lumped_mass(&self, material: &ElasticMaterial) -> Vec<f64> {
        let mut full = self.scalar_mass(material);
        full.fill_lower_triangle_with_upper_triangle();
        if !self.kind.is_quadratic() {
            return full.row_iter().map(|row| row.sum()).collect();
        }
        let scale = full.sum() / full.diagonal().sum();
        full.diagonal().iter().map(|value| value * scale).collect()
    }

    /// Upper triangle of `∫ rho N_I N_J dV`.
    fn scalar_mass(&self, material: &ElasticMaterial) -> DMatrix<f64> {
        let count = self.node_count();
        let mut scalar = DMatrix::zeros(count, count);
        for point in self.integration_points() {
            for column in 0..count {
                let weighted = material.density * point.measure * point.values[column];
                (0..=column).for_each(|row| scalar[(row, column)] += point.values[row] * weighted);
            }
        }
        scalar
    }
}
