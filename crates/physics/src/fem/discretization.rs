//! What the mesh leaves out of a bilinear form of two vectors.

use super::element::{ElementGeometry, IntegrationPoint};
use super::recovery::{Degree, Recovery};
use super::{ElasticMaterial, MaterialField};
use crate::linalg::c64;
use crate::mesh::Mesh;
use nalgebra::DMatrix;

/// Pairs of vectors whose strains are held at a time, at least; of a small mesh as many as have so many values: the operators of an
/// element are made once for all of them.
const PAIRS_AT_A_TIME: usize = 16;
const VALUES_AT_A_TIME: usize = 8_000_000;
/// Real columns of a pair: real and imaginary part of both.
const COLUMNS: usize = 4;

/// Estimate of the elastic energy that the errors of two finite-element solutions have in common, by patch recovery of their strains
/// (Zienkiewicz and Zhu 1992; goal-oriented as in Oden and Prudhomme 2001),
///
/// ```text
/// a(e_w, e_x) = int (R eps(w) - eps(w))^T D (R eps(x) - eps(x)) dV
/// ```
///
/// with `eps` the strain of the elements and `R eps` the recovered one: of linear polynomials over a patch for linear elements, of
/// quadratic ones for quadratic elements, so that it is of higher order. Strains jump between regions, each has its own recovery.
pub struct DiscretizationError<'a> {
    mesh: &'a Mesh,
    materials: &'a dyn MaterialField,
    recovery: Recovery,
}

impl<'a> DiscretizationError<'a> {
    /// Prepares the recovery of a mesh.
    pub fn new(mesh: &'a Mesh, materials: &'a dyn MaterialField) -> Self {
        let mut kinds = (0..mesh.element_count()).map(|e| mesh.element_kind(e));
        let degree = match kinds.any(|kind| kind.is_quadratic()) {
            true => Degree::Quadratic,
            false => Degree::Linear,
        };
        Self { mesh, materials, recovery: Recovery::new(mesh, degree, true) }
    }

    /// `a(e_w, e_x)` of each pair `[w, x]` over all dofs (m), region by region, J without conjugation.
    pub fn forms(&self, pairs: &[[&[c64]; 2]]) -> Vec<Vec<c64>> {
        let values = self.recovery.first_sample.last().unwrap_or(&0) * self.components() * COLUMNS;
        let groups = pairs.chunks(PAIRS_AT_A_TIME.max(VALUES_AT_A_TIME / values.max(1)));
        groups.flat_map(|group| self.forms_of(group)).collect()
    }

    fn forms_of(&self, pairs: &[[&[c64]; 2]]) -> Vec<Vec<c64>> {
        let elements: Vec<usize> = (0..self.mesh.element_count()).collect();
        // Strains at the samples of the recovery, a row each component, element by element.
        let sampled: Vec<DMatrix<f64>> = crate::parallel::map(&elements, |&e| {
            let geometry = ElementGeometry::new(self.mesh, e);
            let places = self.recovery.places(e).iter();
            let points: Vec<IntegrationPoint> =
                places.map(|place| geometry.at((*place, 1.0))).collect();
            geometry.strain_operator(self.material(e), &points) * self.nodal(e, pairs)
        });
        let recovered = self.recovered(&sampled);
        // The error of each element's strain at the points of its stiffness, and its energy.
        let energies: Vec<Vec<c64>> =
            crate::parallel::map(&elements, |&e| self.element_energies(e, pairs, &recovered));
        let regions = self.mesh.regions.len().max(1);
        let mut forms = vec![vec![c64::new(0.0, 0.0); regions]; pairs.len()];
        for (e, energy) in energies.iter().enumerate() {
            for (form, energy) in forms.iter_mut().zip(energy) {
                form[self.mesh.region(e)] += energy;
            }
        }
        forms
    }

    /// The recovered strain of every node, in each region that meets there.
    fn recovered(&self, sampled: &[DMatrix<f64>]) -> Vec<Vec<(usize, DMatrix<f64>)>> {
        let first = &self.recovery.first_sample;
        let elements = 0..self.mesh.element_count();
        let element_of: Vec<usize> =
            elements.flat_map(|e| std::iter::repeat_n(e, first[e + 1] - first[e])).collect();
        let (rows, width) = (self.components(), sampled.first().map_or(0, DMatrix::ncols));
        let at_node = |node: usize| {
            let regions = self.recovery.at(node);
            let of_region = |(region, weights): (usize, &[(usize, f64)])| {
                let mut sum = DMatrix::zeros(rows, width);
                for &(sample, weight) in weights {
                    let e = element_of[sample];
                    let own = sampled[e].rows(rows * (sample - first[e]), rows);
                    sum.zip_apply(&own, |sum, value| *sum += weight * value);
                }
                (region, sum)
            };
            regions.map(of_region).collect()
        };
        crate::parallel::map(0..self.mesh.node_count(), at_node)
    }

    /// `int (R eps(w) - eps(w))^T D (R eps(x) - eps(x)) dV` over an element, of each pair.
    fn element_energies(
        &self,
        e: usize,
        pairs: &[[&[c64]; 2]],
        recovered: &[Vec<(usize, DMatrix<f64>)>],
    ) -> Vec<c64> {
        let geometry = ElementGeometry::new(self.mesh, e);
        let (points, region) = (geometry.stiffness_points(), self.mesh.region(e));
        let own = geometry.strain_operator(self.material(e), &points) * self.nodal(e, pairs);
        let nodes = self.mesh.element_nodes(e).iter().map(|&node| {
            let at_node = recovered[node as usize].iter();
            at_node.filter(|(own, _)| *own == region).map(|(_, strain)| strain)
        });
        let nodes: Vec<&DMatrix<f64>> = nodes.flatten().collect();
        let rows = self.components();
        let mut energies = vec![c64::new(0.0, 0.0); pairs.len()];
        for (k, point) in points.iter().enumerate() {
            let mut error = -own.rows(rows * k, rows);
            for (&value, nodal) in point.values.iter().zip(&nodes) {
                error.zip_apply(*nodal, |sum, recovered| *sum += value * recovered);
            }
            let stress = geometry.elasticity(self.material(e), point) * &error * point.measure;
            let work = |a: usize, b: usize| error.column(a).dot(&stress.column(b));
            for (pair, energy) in energies.iter_mut().enumerate() {
                let [w, x] = [COLUMNS * pair, COLUMNS * pair + 2];
                let re = work(w, x) - work(w + 1, x + 1);
                *energy += c64::new(re, work(w, x + 1) + work(w + 1, x));
            }
        }
        energies
    }

    /// Components of a strain: 3 in the plane, 6 in space.
    fn components(&self) -> usize {
        [0, 1, 3, 6][self.mesh.dimension]
    }

    fn material(&self, element: usize) -> &ElasticMaterial {
        self.materials.of(self.mesh.region(element))
    }

    /// The values of an element's nodes, four columns a pair.
    fn nodal(&self, element: usize, pairs: &[[&[c64]; 2]]) -> DMatrix<f64> {
        let d = self.mesh.dimension;
        let nodes = self.mesh.element_nodes(element);
        DMatrix::from_fn(d * nodes.len(), COLUMNS * pairs.len(), |row, column| {
            let dof = d * nodes[row / d] as usize + row % d;
            let value = pairs[column / COLUMNS][column % COLUMNS / 2][dof];
            match column % 2 {
                0 => value.re,
                _ => value.im,
            }
        })
    }
}
