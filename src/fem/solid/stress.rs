//! Geometric stiffness of bricks.

use super::SolidMatrix;
use super::element::geometry;
use crate::fem::ElasticMaterial;
use crate::fem::element::{ElementGeometry, StressPart};
use crate::mesh::SolidSector;
use nalgebra::{DMatrix, DVector};

/// A part of the stress: a law on the strain of nodal displacements and of the incompatible modes that come with them.
struct Strained<'a> {
    law: &'a ElasticMaterial,
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
    let recovered = recoveries(sector, |geometry| geometry.stiffness(material).recovered);
    let part = Strained {
        law: material,
        displacement,
        internal: amplitudes(sector, &recovered, displacement),
    };
    of_stress(sector, &[part])
}

/// Derivative of [`geometric_stiffness`] where the displacement changes at `displacement.1` and the elasticity, with
/// `Some(rate)`, at that of another material's.
pub fn geometric_stiffness_rate(
    sector: &SolidSector,
    material: &ElasticMaterial,
    rate: Option<&ElasticMaterial>,
    (displacement, displacement_rate): (&[f64], &[f64]),
) -> SolidMatrix {
    let recovered = recoveries(sector, |geometry| geometry.stiffness(material).recovered);
    let mut moved = Strained {
        law: material,
        displacement: displacement_rate,
        internal: amplitudes(sector, &recovered, displacement_rate),
    };
    let Some(rate) = rate else {
        return of_stress(sector, &[moved]);
    };
    let changed = recoveries(sector, |geometry| geometry.stiffness_rate(material, rate).recovered);
    let added = amplitudes(sector, &changed, displacement);
    for (sum, added) in moved.internal.iter_mut().zip(added) {
        if let (Some(sum), Some(added)) = (sum, added) {
            *sum += added;
        }
    }
    let stiffened = Strained {
        law: rate,
        displacement,
        internal: amplitudes(sector, &recovered, displacement),
    };
    of_stress(sector, &[moved, stiffened])
}

/// What gives the amplitudes of the incompatible modes, of each element along a radius: layers are alike.
fn recoveries(
    sector: &SolidSector,
    of: impl Fn(&ElementGeometry) -> Option<DMatrix<f64>>,
) -> Vec<Option<DMatrix<f64>>> {
    let [radial, _] = sector.divisions();
    let own = |e: usize| match sector.is_quadratic() {
        true => None,
        false => of(&geometry(sector, e)),
    };
    (0..radial).map(own).collect()
}

/// Displacements of an element's nodes.
fn local(nodes: &[(usize, usize)], displacement: &[f64]) -> DVector<f64> {
    let values = nodes.iter().flat_map(|(node, _)| [0, 1, 2].map(|c| displacement[3 * node + c]));
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
        let values: Vec<DVector<f64>> =
            parts.iter().map(|part| local(nodes, part.displacement)).collect();
        let pairs = parts.iter().zip(&values);
        let stresses: Vec<StressPart<'_>> = pairs
            .map(|(part, values)| StressPart {
                material: part.law,
                values: values.as_slice(),
                internal: part.internal[e].clone(),
            })
            .collect();
        let stiffness = geometry(sector, e).geometric_stiffness(&stresses);
        matrix.matrices.push(stiffness);
        matrix.places.push((e, nodes.clone()));
    }
    matrix
}
