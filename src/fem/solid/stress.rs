//! Geometric stiffness of bricks.

use super::SolidMatrix;
use super::element::{
    Geometry, elasticity, element_stiffness, element_stiffness_rate, rotated, strain,
};
use crate::fem::ElasticMaterial;
use crate::mesh::SolidSector;
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3, Vector6};

/// A part of the stress: a law on the strain of nodal displacements and of the incompatible modes that come with them.
struct Strained<'a> {
    law: SMatrix<f64, 6, 6>,
    displacement: &'a [f64],
    /// Amplitudes of the incompatible modes of each element.
    internal: Vec<Option<DVector<f64>>>,
}

/// Geometric stiffness `∫ (grad N_I . sigma . grad N_J) I dV` of the stress that `displacement`, the same in every sector,
/// causes, N/m.
pub fn geometric_stiffness(
    sector: &SolidSector,
    material: &ElasticMaterial,
    displacement: &[f64],
) -> SolidMatrix {
    let recovered = recoveries(sector, |geometry| {
        element_stiffness(geometry, material).recovered
    });
    let part = Strained {
        law: elasticity(material),
        displacement,
        internal: amplitudes(sector, &recovered, displacement),
    };
    of_stress(sector, &[part])
}

/// Derivative of [`geometric_stiffness`] where the displacement changes at `displacement.1` and Lamé's constants, with
/// `Some(rate)`, at that of another material's.
pub fn geometric_stiffness_rate(
    sector: &SolidSector,
    material: &ElasticMaterial,
    rate: Option<&ElasticMaterial>,
    (displacement, displacement_rate): (&[f64], &[f64]),
) -> SolidMatrix {
    let recovered = recoveries(sector, |geometry| {
        element_stiffness(geometry, material).recovered
    });
    let mut moved = Strained {
        law: elasticity(material),
        displacement: displacement_rate,
        internal: amplitudes(sector, &recovered, displacement_rate),
    };
    let Some(rate) = rate else {
        return of_stress(sector, &[moved]);
    };
    let changed = recoveries(sector, |geometry| {
        element_stiffness_rate(geometry, material, rate).recovered
    });
    let added = amplitudes(sector, &changed, displacement);
    for (sum, added) in moved.internal.iter_mut().zip(added) {
        if let (Some(sum), Some(added)) = (sum, added) {
            *sum += added;
        }
    }
    let stiffened = Strained {
        law: elasticity(rate),
        displacement,
        internal: amplitudes(sector, &recovered, displacement),
    };
    of_stress(sector, &[moved, stiffened])
}

/// What gives the amplitudes of the incompatible modes, of each element along a radius: layers are alike.
fn recoveries(
    sector: &SolidSector,
    of: impl Fn(&Geometry) -> Option<DMatrix<f64>>,
) -> Vec<Option<DMatrix<f64>>> {
    let [radial, _] = sector.divisions();
    let own = |e: usize| match sector.is_quadratic() {
        true => None,
        false => of(&Geometry::new(sector, e)),
    };
    (0..radial).map(own).collect()
}

/// Displacements of an element's nodes.
fn local(nodes: &[(usize, usize)], displacement: &[f64]) -> DVector<f64> {
    let values = nodes
        .iter()
        .flat_map(|(node, _)| [0, 1, 2].map(|c| displacement[3 * node + c]));
    DVector::from_vec(values.collect())
}

fn amplitudes(
    sector: &SolidSector,
    recovered: &[Option<DMatrix<f64>>],
    displacement: &[f64],
) -> Vec<Option<DVector<f64>>> {
    let elements = sector.elements.iter().enumerate();
    let own = |(e, nodes): (usize, &Vec<(usize, usize)>)| {
        let recovered = recovered[e % recovered.len()].as_ref();
        recovered.map(|recovered| recovered * local(nodes, displacement))
    };
    elements.map(own).collect()
}

/// The matrix of a sum of stresses.
fn of_stress(sector: &SolidSector, parts: &[Strained<'_>]) -> SolidMatrix {
    let mut matrix = SolidMatrix::default();
    for (e, nodes) in sector.elements.iter().enumerate() {
        let geometry = Geometry::new(sector, e);
        let locals: Vec<DVector<f64>> = parts
            .iter()
            .map(|part| local(nodes, part.displacement))
            .collect();
        let center = geometry.center();
        let count = geometry.nodes.len();
        let mut scalar = DMatrix::<f64>::zeros(count, count);
        for point in geometry.points() {
            let mut s = Vector6::zeros();
            for (part, local) in parts.iter().zip(&locals) {
                let mut total = Vector6::zeros();
                for (a, (gradient, frame)) in
                    point.gradients.iter().zip(&geometry.frames).enumerate()
                {
                    let u = frame * Vector3::new(local[3 * a], local[3 * a + 1], local[3 * a + 2]);
                    total += strain(gradient, &u);
                }
                if let Some(internal) = &part.internal[e] {
                    let modes = geometry.incompatible(&point, &center, 1.0);
                    for (k, gradient) in modes.iter().enumerate() {
                        let u = Vector3::from_fn(|c, _| internal[3 * k + c]);
                        total += strain(gradient, &u);
                    }
                }
                s += part.law * total * point.measure;
            }
            let stress = Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
            for column in 0..count {
                let flux = stress * point.gradients[column];
                for row in 0..count {
                    scalar[(row, column)] += point.gradients[row].dot(&flux);
                }
            }
        }
        matrix.matrices.push(rotated(&geometry, &scalar));
        matrix.places.push((e, nodes.clone()));
    }
    matrix
}
