//! Element matrices of isoparametric elements in nodal frames, plane and solid alike.
//!
//! A plane element is integrated as a solid one of unit thickness whose gradients along z vanish. Strains have six components; the material
//! says what they mean ([`ElasticMaterial::elasticity_at`]).

mod strain;

use super::orthotropy::PAIRS;
use super::{ElasticMaterial, PlaneFormulation};
use crate::mesh::{ElementKind, Mesh, QuadraturePoint};
use nalgebra::{DMatrix, Matrix3, Vector3};

/// Strain `(xx, yy, zz, 2 xy, 2 yz, 2 zx)` or stress `(xx, yy, zz, xy, yz, zx)`.
pub type Voigt = [f64; 6];

/// One integration point of one element: shape values, Cartesian gradients, and `w det J`.
pub struct IntegrationPoint {
    /// Its place in the parent element.
    pub place: [f64; 3],
    /// `N_I`.
    pub values: Vec<f64>,
    /// `grad N_I` in global Cartesian axes, 1/m.
    pub gradients: Vec<Vector3<f64>>,
    /// Quadrature weight times Jacobian determinant, m3, in the plane m2.
    pub measure: f64,
}

/// One element, ready to be integrated over.
pub struct ElementGeometry {
    kind: ElementKind,
    /// Coordinates of its nodes, m.
    points: Vec<[f64; 3]>,
    /// Unit vectors of each node's frame as columns.
    frames: Vec<Matrix3<f64>>,
}

/// Inverse of the Jacobian and its determinant.
fn inverse(jacobian: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
    let j = |row: usize, column: usize| jacobian[(row, column)];
    let minor = |a: usize, b: usize, c: usize, d: usize| j(a, c) * j(b, d) - j(a, d) * j(b, c);
    let determinant =
        j(0, 0) * minor(1, 2, 1, 2) - j(1, 0) * minor(0, 2, 1, 2) + j(2, 0) * minor(0, 1, 1, 2);
    #[rustfmt::skip]
    let adjugate = Matrix3::new(
        minor(1, 2, 1, 2), -minor(0, 2, 1, 2), minor(0, 1, 1, 2),
        -minor(1, 2, 0, 2), minor(0, 2, 0, 2), -minor(0, 1, 0, 2),
        minor(1, 2, 0, 1), -minor(0, 2, 0, 1), minor(0, 1, 0, 1),
    );
    (adjugate / determinant, determinant)
}

impl ElementGeometry {
    /// Element `element` of `mesh`.
    pub fn new(mesh: &Mesh, element: usize) -> Self {
        let nodes = mesh.element_nodes(element).iter();
        let nodes: Vec<usize> = nodes.map(|&node| node as usize).collect();
        Self {
            kind: mesh.element_kind(element),
            points: nodes.iter().map(|&node| mesh.nodes[node]).collect(),
            frames: nodes.iter().map(|&node| mesh.frame(node)).collect(),
        }
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.points.len()
    }

    /// Components of a node's displacement.
    pub fn dimension(&self) -> usize {
        self.kind.dimension()
    }

    /// Components of strain that the element has.
    fn components(&self) -> &'static [usize] {
        if self.dimension() == 2 { &[0, 1, 3] } else { &[0, 1, 2, 3, 4, 5] }
    }

    /// [`ElementKind::jacobian`] at a point of the parent element.
    fn jacobian(&self, at: [f64; 3]) -> Matrix3<f64> {
        self.kind.jacobian(at, self.points.iter().copied())
    }

    /// Shape values, gradients and measure at a point of the parent element with its weight.
    pub fn at(&self, (place, weight): QuadraturePoint) -> IntegrationPoint {
        let shapes = self.kind.shape_functions(place);
        let (inverse, determinant) = inverse(&self.jacobian(place));
        IntegrationPoint {
            place,
            values: shapes.iter().map(|shape| shape.0).collect(),
            gradients: shapes.iter().map(|shape| inverse * Vector3::from(shape.1)).collect(),
            measure: weight * determinant,
        }
    }

    /// Every point of the full quadrature rule.
    pub fn integration_points(&self) -> Vec<IntegrationPoint> {
        self.kind.quadrature().into_iter().map(|point| self.at(point)).collect()
    }

    /// Every point of the rule of the stiffness; elements with curved edges take the full rule, which keeps constant strains.
    pub fn stiffness_points(&self) -> Vec<IntegrationPoint> {
        if !self.has_straight_edges() {
            return self.integration_points();
        }
        self.kind.stiffness_quadrature().into_iter().map(|point| self.at(point)).collect()
    }

    /// Whether mid-side nodes lie at the middle of their edges, to 1e-9 of their length.
    fn has_straight_edges(&self) -> bool {
        self.kind.middles().all(|(middle, ends)| {
            let [p, q] = ends.map(|end| Vector3::from(self.points[end]));
            let off = (p + q) * 0.5 - Vector3::from(self.points[middle]);
            off.norm() <= 1e-9 * (p - q).norm()
        })
    }

    /// Where a point is, m.
    pub fn position(&self, point: &IntegrationPoint) -> [f64; 3] {
        let mut position = [0.0; 3];
        for (value, node) in point.values.iter().zip(&self.points) {
            (0..3).for_each(|axis| position[axis] += value * node[axis]);
        }
        position
    }

    /// The columns from the `first` on of the stiffness over the nodes and, where there are incompatible modes, their amplitudes, down to
    /// the diagonal; linear in the elasticity. Of a body that is deformed, with `gradients` of its displacement at the points of the
    /// stiffness, by the strain of Green and Lagrange: `delta E = sym(F^T grad delta u)`, `F = 1 + grad u`.
    fn upper_stiffness(
        &self,
        material: &ElasticMaterial,
        gradients: Option<&[Matrix3<f64>]>,
        first: usize,
    ) -> DMatrix<f64> {
        let size = self.nodal_count() + self.internal_count();
        let components = self.components();
        let material = self.solid_aware(material);
        let points = self.stiffness_points();
        let modes = self.incompatible_gradients(&points);
        let mut matrix = DMatrix::zeros(size, size);
        let mut works = vec![0.0; size];
        for (i, (point, modes)) in points.iter().zip(&modes).enumerate() {
            let law = material.elasticity_at(self.position(point));
            let gradient = gradients.map(|gradients| &gradients[i]);
            let strains = self.strain_columns(point, modes, gradient);
            // Component by component over the rows: such loops run in vector registers.
            let by_component = |&k: &usize| strains.iter().map(|strain| strain[k]).collect();
            let rows: Vec<Vec<f64>> = components.iter().map(by_component).collect();
            for column in first..size {
                let stress = stress_in(components, &law, &strains[column]);
                let works = &mut works[..=column];
                works.fill(0.0);
                for (&k, row) in components.iter().zip(&rows) {
                    let stress = stress[k] * point.measure;
                    works.iter_mut().zip(row).for_each(|(work, strain)| *work += strain * stress);
                }
                let sums = matrix.column_mut(column);
                sums.into_iter().zip(works).for_each(|(sum, work)| *sum += *work);
            }
        }
        matrix
    }

    /// Displacements of its nodes.
    fn nodal_count(&self) -> usize {
        self.dimension() * self.node_count()
    }

    /// Amplitudes of its incompatible modes.
    fn internal_count(&self) -> usize {
        if self.has_incompatible_modes() { 9 } else { 0 }
    }

    /// The material as this element sees it: solid elements take no plane formulation.
    fn solid_aware(&self, material: &ElasticMaterial) -> ElasticMaterial {
        match self.dimension() {
            3 => ElasticMaterial { formulation: PlaneFormulation::ThreeDimensional, ..*material },
            _ => *material,
        }
    }

    /// Element stiffness `K_e = ∫ B^T D B dV` in nodal frames, N/m, in the plane for each metre of thickness; the incompatible
    /// modes of bricks with 8 nodes condensed.
    pub fn stiffness(&self, material: &ElasticMaterial) -> DMatrix<f64> {
        self.condensed(self.upper_stiffness(material, None, 0))
    }

    /// What each of the displacements `values` of the nodes, in their frames, m, adds to [`Self::stiffness`]: the elements stand where these
    /// took them. With [`Self::geometric_stiffnesses`] it is the whole tangent of a stressed body, to the first order in its strain.
    ///
    /// Source: K.-J. Bathe, Finite Element Procedures (1996), 6.3.5: the initial displacement effect.
    pub fn displacement_stiffnesses(
        &self,
        material: &ElasticMaterial,
        values: &[Vec<f64>],
    ) -> Vec<DMatrix<f64>> {
        let points = self.stiffness_points();
        let of = |gradients: Vec<Matrix3<f64>>| {
            let deformed = self.upper_stiffness(material, Some(&gradients), 0);
            self.condensed(deformed) - self.stiffness(material)
        };
        self.displacement_gradients(&points, material, values).into_iter().map(of).collect()
    }

    /// A stiffness, of which the upper triangle is given, without the amplitudes of incompatible modes.
    fn condensed(&self, mut upper: DMatrix<f64>) -> DMatrix<f64> {
        let (nodal, internal) = (self.nodal_count(), self.internal_count());
        if let Some(recovered) = self.recovered_of(&upper) {
            let coupling = upper.view((0, nodal), (nodal, internal));
            upper = upper.view((0, 0), (nodal, nodal)) + coupling * recovered;
        }
        upper.fill_lower_triangle_with_upper_triangle();
        upper
    }

    /// What the amplitudes of the incompatible modes are for each nodal displacement, `alpha = R u`, `R = -K_ii^-1 K_iu`; `None` for
    /// an element without.
    pub fn recovered(&self, material: &ElasticMaterial) -> Option<DMatrix<f64>> {
        self.has_incompatible_modes()
            .then(|| self.upper_stiffness(material, None, self.nodal_count()))
            .and_then(|upper| self.recovered_of(&upper))
    }

    /// The same of the upper triangle of a stiffness with the amplitudes of incompatible modes, if there are any.
    fn recovered_of(&self, upper: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let (nodal, internal) = (self.nodal_count(), self.internal_count());
        if internal == 0 {
            return None;
        }
        let coupling = upper.view((0, nodal), (nodal, internal)).transpose();
        let mut inner = upper.view((nodal, nodal), (internal, internal)).into_owned();
        inner.fill_lower_triangle_with_upper_triangle();
        let factor = inner
            .cholesky()
            .expect("incompatible modes of a sound element have positive stiffness");
        Some(-factor.solve(&coupling))
    }

    /// Element geometric stiffness `K_sigma = ∫ (grad N_I . sigma . grad N_J) I dV` of the stress of nodal displacements, for each of
    /// `values`, in their frames, m, and of the amplitudes of the incompatible modes that come with them: N/m, in the plane for
    /// each metre of thickness.
    ///
    /// It is the stress part of the tangent alone: a pressure that follows its surface adds the follower terms of the contact,
    /// which the caller must include too.
    pub fn geometric_stiffnesses(
        &self,
        material: &ElasticMaterial,
        values: &[Vec<f64>],
    ) -> Vec<DMatrix<f64>> {
        let (count, points, law) =
            (self.node_count(), self.stiffness_points(), self.solid_aware(material));
        let of = |gradients: Vec<Matrix3<f64>>| {
            let mut scalar = DMatrix::<f64>::zeros(count, count);
            for (point, gradient) in points.iter().zip(&gradients) {
                let stress = tensor(&stress_of(&law, gradient, self.position(point)));
                let stress = stress * point.measure;
                for column in 0..count {
                    let flux = stress * point.gradients[column];
                    for row in 0..=column {
                        scalar[(row, column)] += point.gradients[row].dot(&flux);
                    }
                }
            }
            self.rotate_scalar(scalar)
        };
        self.displacement_gradients(&points, material, values).into_iter().map(of).collect()
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

    /// Upper triangle of `∫ rho N_I N_J dV`, kg, in the plane for each metre of thickness.
    pub fn scalar_mass(&self, material: &ElasticMaterial) -> DMatrix<f64> {
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

    /// Expands the upper triangle of `s_IJ` into `s_IJ F_I^T F_J`, `F_I` node I's frame.
    pub fn rotate_scalar(&self, scalar: DMatrix<f64>) -> DMatrix<f64> {
        let (count, dimension) = (scalar.nrows(), self.dimension());
        let mut matrix = DMatrix::zeros(dimension * count, dimension * count);
        for column in 0..count {
            for row in 0..=column {
                let turn = self.frames[row].transpose() * self.frames[column];
                let block = turn * scalar[(row, column)];
                for j in 0..dimension {
                    for i in 0..dimension {
                        matrix[(dimension * row + i, dimension * column + j)] = block[(i, j)];
                    }
                }
            }
        }
        matrix.fill_lower_triangle_with_upper_triangle();
        matrix
    }
}

/// `D epsilon` over some components.
fn stress_in(components: &[usize], law: &[Voigt; 6], strain: &Voigt) -> Voigt {
    let mut stress = [0.0; 6];
    for &row in components {
        let products = components.iter().map(|&k| law[row][k] * strain[k]);
        stress[row] = products.reduce(|sum, product| sum + product).unwrap_or(0.0);
    }
    stress
}

/// Cauchy stress of a displacement gradient at a place, Pa.
pub fn stress_of(material: &ElasticMaterial, gradient: &Matrix3<f64>, place: [f64; 3]) -> Voigt {
    material.stress(&strain_of(|i, j| gradient[(i, j)]), place)
}

/// Strain of a displacement gradient.
#[inline(always)]
fn strain_of(gradient: impl Fn(usize, usize) -> f64) -> Voigt {
    let sum = |(i, j)| if i == j { gradient(i, i) } else { gradient(i, j) + gradient(j, i) };
    PAIRS.map(sum)
}

/// A stress as a symmetric matrix.
pub(super) fn tensor(s: &Voigt) -> Matrix3<f64> {
    Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

/// Values of an element's nodes out of those of all nodes.
pub fn nodal_values(mesh: &Mesh, element: usize, all: &[f64]) -> Vec<f64> {
    mesh.element_dofs(element).map(|dof| all[dof]).collect()
}
