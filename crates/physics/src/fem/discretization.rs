//! What the mesh leaves out of a bilinear form of two vectors.

use super::MaterialField;
use super::element::{ElementGeometry, IntegrationPoint};
use super::recovery::{Degree, Recovery, Weights};
use crate::linalg::c64;
use crate::mesh::Mesh;
use nalgebra::DMatrix;

/// Pairs of vectors whose strains are held at a time: the operators of an element are made once for them.
const PAIRS_AT_A_TIME: usize = 32;
/// What a complex vector may have beside a multiple of a real one, relative to its largest entry, to count as one.
const ROUNDED: f64 = 1e-13;

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
        let is_quadratic = kinds.any(|kind| kind.is_quadratic());
        let degree = if is_quadratic { Degree::Quadratic } else { Degree::Linear };
        Self { mesh, materials, recovery: Recovery::new(mesh, degree, true) }
    }

    /// `a(e_w, e_x)` of each pair `[w, x]` over all dofs (m), region by region, J without conjugation.
    pub fn forms(&self, pairs: &[[&[c64]; 2]]) -> Vec<Vec<c64>> {
        pairs.chunks(PAIRS_AT_A_TIME).flat_map(|group| self.forms_of(group)).collect()
    }

    fn forms_of(&self, pairs: &[[&[c64]; 2]]) -> Vec<Vec<c64>> {
        let mut rows = Vec::new();
        let own: Vec<[Parts; 2]> =
            pairs.iter().map(|pair| pair.map(|own| parts(own, &mut rows))).collect();
        let dofs = rows.first().map_or(0, Vec::len);
        let columns = DMatrix::from_fn(rows.len(), dofs, |row, dof| rows[row][dof]);
        // Strains at the samples of the recovery, a column each component, element by element.
        let elements = 0..self.mesh.element_count();
        let sampled: Vec<DMatrix<f64>> = crate::parallel::map(elements.clone(), |e| {
            let geometry = ElementGeometry::new(self.mesh, e);
            let places = self.recovery.places(e).iter();
            let points: Vec<_> = places.map(|place| geometry.at((*place, 1.0))).collect();
            self.strains((e, &geometry), &points, &columns)
        });
        let recovered = self.recovered(&sampled);
        // The error of each element's strain at the points of its stiffness, and its energy.
        let energies: Vec<Vec<c64>> =
            crate::parallel::map(elements, |e| self.energies((e, &own), &columns, &recovered));
        let regions = self.mesh.regions.len().max(1);
        let mut forms = vec![vec![c64::ZERO; regions]; pairs.len()];
        for (e, energy) in energies.iter().enumerate() {
            for (form, energy) in forms.iter_mut().zip(energy) {
                form[self.mesh.region(e)] += energy;
            }
        }
        forms
    }

    /// Strains of an element at some points: a column each component, point by point.
    fn strains(
        &self,
        (e, geometry): (usize, &ElementGeometry),
        points: &[IntegrationPoint],
        columns: &DMatrix<f64>,
    ) -> DMatrix<f64> {
        let dofs: Vec<usize> = self.mesh.element_dofs(e).collect();
        let operator = geometry.strain_operator(self.materials.of(self.mesh.region(e)), points);
        columns.select_columns(&dofs) * operator.transpose()
    }

    /// The recovered strain of every node, in each region that meets there.
    fn recovered(&self, sampled: &[DMatrix<f64>]) -> Vec<Vec<(usize, DMatrix<f64>)>> {
        let first = &self.recovery.first_sample;
        let elements = 0..self.mesh.element_count();
        let element_of: Vec<usize> =
            elements.flat_map(|e| std::iter::repeat_n(e, first[e + 1] - first[e])).collect();
        let (count, width) = (self.components(), sampled.first().map_or(0, DMatrix::nrows));
        let of_region = |(region, weights): &(usize, Weights)| {
            let terms = weights.iter().map(|&(sample, weight)| {
                let e = element_of[sample];
                (weight, at_point(&sampled[e], sample - first[e], count))
            });
            (*region, combination((width, count), terms))
        };
        let nodes = 0..self.mesh.node_count();
        crate::parallel::map(nodes, |node| self.recovery.at(node).iter().map(of_region).collect())
    }

    /// `int (R eps(w) - eps(w))^T D (R eps(x) - eps(x)) dV` over an element, of each pair.
    fn energies(
        &self,
        (e, pairs): (usize, &[[Parts; 2]]),
        columns: &DMatrix<f64>,
        recovered: &[Vec<(usize, DMatrix<f64>)>],
    ) -> Vec<c64> {
        let geometry = ElementGeometry::new(self.mesh, e);
        let (points, region) = (geometry.stiffness_points(), self.mesh.region(e));
        let own = self.strains((e, &geometry), &points, columns);
        let nodes = self.mesh.element_nodes(e).iter().map(|&node| {
            let at_node = recovered[node as usize].iter();
            at_node.filter(|(own, _)| *own == region).map(|(_, strain)| strain.as_slice())
        });
        let nodes: Vec<&[f64]> = nodes.flatten().collect();
        let (count, width) = (self.components(), columns.nrows());
        let mut energies = vec![c64::ZERO; pairs.len()];
        for (k, point) in points.iter().enumerate() {
            let terms = point.values.iter().copied().zip(nodes.iter().copied());
            let terms = std::iter::once((-1.0, at_point(&own, k, count))).chain(terms);
            let error = combination((width, count), terms);
            let stress =
                &error * geometry.elasticity(self.materials.of(region), point) * point.measure;
            for (error, stress) in error.column_iter().zip(stress.column_iter()) {
                for (energy, [w, x]) in energies.iter_mut().zip(pairs) {
                    let value = |parts: &Parts, own: &[f64]| -> c64 {
                        parts.iter().map(|(factor, row)| factor * own[*row]).sum()
                    };
                    *energy += value(w, error.as_slice()) * value(x, stress.as_slice());
                }
            }
        }
        energies
    }

    /// Components of a strain: 3 in the plane, 6 in space.
    fn components(&self) -> usize {
        [0, 1, 3, 6][self.mesh.dimension]
    }
}

/// A complex vector as factors of real ones, by their number.
type Parts = Vec<(c64, usize)>;

/// Adds to `rows` the real vector that a vector is a multiple of, or else its real and its imaginary part.
fn parts(vector: &[c64], rows: &mut Vec<Vec<f64>>) -> Parts {
    let largest = vector.iter().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
    let largest = largest.copied().unwrap_or_default();
    let turn = if largest == c64::ZERO { c64::ONE } else { largest / largest.norm() };
    let turned = || vector.iter().map(|own| own * turn.conj());
    let first = rows.len();
    if turned().all(|own| own.im.abs() <= ROUNDED * largest.norm()) {
        rows.push(turned().map(|own| own.re).collect());
        return vec![(turn, first)];
    }
    rows.push(vector.iter().map(|own| own.re).collect());
    rows.push(vector.iter().map(|own| own.im).collect());
    vec![(c64::ONE, first), (c64::I, first + 1)]
}

/// The columns of one of several points with `count` components each.
fn at_point(strains: &DMatrix<f64>, point: usize, count: usize) -> &[f64] {
    let length = count * strains.nrows();
    &strains.as_slice()[length * point..length * (point + 1)]
}

/// The sum of factors times values, with the instructions that the machine has for it.
fn combination<'a>(
    (rows, columns): (usize, usize),
    terms: impl Iterator<Item = (f64, &'a [f64])>,
) -> DMatrix<f64> {
    let (mut sum, arch) = (DMatrix::zeros(rows, columns), pulp::Arch::new());
    // A term at a time: a closure that is small is compiled for them, a larger one called.
    for (factor, values) in terms {
        let pairs = sum.as_mut_slice().iter_mut().zip(values);
        arch.dispatch(|| pairs.for_each(|(sum, own)| *sum += factor * own));
    }
    sum
}
