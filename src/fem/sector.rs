//! Matrices of one sector of a body of equal sectors, in the plane and in space: stiffness, mass, geometric stiffness.
//!
//! Dofs are `d k + c`, component `c` (radial, tangential, axial) of sector node `k`; for their order see [`SectorMesh`].

use super::element::ElementGeometry;
use super::fold::{SectorMatrix, WaveDofs};
use super::{ElasticMaterial, MassKind, MaterialField, RayleighDamping};
use crate::mesh::{SectorMesh, SolidSector};
use nalgebra::{DMatrix, DVector, Matrix3};
use std::collections::BTreeMap;
use std::rc::Rc;

/// One sector of a body of equal sectors, element by element.
pub trait Sectored {
    /// Components of a displacement.
    const COMPONENTS: usize;

    /// Elements of the sector.
    fn element_count(&self) -> usize;

    /// Regions with a material each.
    fn region_count(&self) -> usize;

    /// Region of an element.
    fn region(&self, element: usize) -> usize;

    /// The first element of the region that has the same matrices in the frames of its nodes.
    fn alike(&self, element: usize) -> usize {
        element
    }

    /// Sector nodes of an element with their angles in halves of a sector.
    fn places(&self, element: usize) -> Vec<(usize, usize)>;

    /// Geometry of an element, in the frames of its nodes.
    fn geometry(&self, element: usize) -> ElementGeometry;

    /// The dofs that nothing holds.
    fn wave_dofs(&self) -> WaveDofs;
}

impl Sectored for SectorMesh {
    const COMPONENTS: usize = 2;

    fn element_count(&self) -> usize {
        self.strip.element_count()
    }

    fn region_count(&self) -> usize {
        self.strip.regions.len().max(1)
    }

    fn region(&self, element: usize) -> usize {
        self.strip.region(element)
    }

    fn places(&self, element: usize) -> Vec<(usize, usize)> {
        let nodes = self.strip.element_nodes(element).iter().map(|&node| node as usize);
        nodes.map(|node| (self.sector_node_of[node], self.half_steps[node])).collect()
    }

    fn geometry(&self, element: usize) -> ElementGeometry {
        ElementGeometry::new(&self.strip, element)
    }

    fn wave_dofs(&self) -> WaveDofs {
        let free = 2 * self.free_node_count();
        let of_one_body = if self.specification.element.is_quadratic() { 9 } else { 3 };
        // Room for the contact of two bodies, in which a node of the shaft takes part in the motion of the pair.
        let pair = self.specification.shaft.map_or(0, |_| 2 * self.contact_count);
        let (dofs, sectors) = (2 * self.node_count(), self.sector_count());
        WaveDofs::new(dofs, |dof| dof >= free, of_one_body + pair, sectors)
    }
}

impl Sectored for SolidSector {
    const COMPONENTS: usize = 3;

    fn element_count(&self) -> usize {
        self.elements.len()
    }

    fn region_count(&self) -> usize {
        1 + self.specification.parts.len()
    }

    fn region(&self, element: usize) -> usize {
        self.region(element)
    }

    /// Layers of one material are alike.
    fn alike(&self, element: usize) -> usize {
        let mut layers = (element % self.divisions()[0]..element).step_by(self.divisions()[0]);
        layers.find(|own| self.region(*own) == self.region(element)).unwrap_or(element)
    }

    fn places(&self, element: usize) -> Vec<(usize, usize)> {
        self.elements[element].clone()
    }

    fn geometry(&self, element: usize) -> ElementGeometry {
        let (mut points, mut frames) = (Vec::new(), Vec::new());
        for &(node, half) in &self.elements[element] {
            let place = &self.nodes[node];
            let (sin, cos) = (self.half_angle() * half as f64).sin_cos();
            points.push([place.radius * cos, place.radius * sin, place.height]);
            frames.push(Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0));
        }
        ElementGeometry::of_nodes(self.element_kind(), points, frames)
    }

    fn wave_dofs(&self) -> WaveDofs {
        let half_bandwidth = 3 * self.node_bandwidth() + 2;
        let (dofs, sectors) = (3 * self.node_count(), self.sector_count());
        WaveDofs::new(dofs, |dof| self.is_held(dof), half_bandwidth, sectors)
    }
}

/// Sums the element matrices `compute(e, material)` (nodal frames) of the elements of a region, or of all.
fn assemble<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: Option<usize>,
    compute: impl Fn(&ElementGeometry, &ElasticMaterial) -> DMatrix<f64>,
) -> SectorMatrix {
    let mut known: BTreeMap<usize, Rc<DMatrix<f64>>> = BTreeMap::new();
    let mut matrix_of = |e: usize| {
        let own = sector.alike(e);
        let new = || Rc::new(compute(&sector.geometry(own), material.of(sector.region(own))));
        Rc::clone(known.entry(own).or_insert_with(new))
    };
    let is_own = |e: &usize| region.is_none_or(|region| sector.region(*e) == region);
    let elements = (0..sector.element_count()).filter(is_own);
    SectorMatrix::sum(S::COMPONENTS, elements.map(|e| (sector.places(e), matrix_of(e))))
}

/// Elastic stiffness `K_e` of one sector without its supports, or of one of its regions: N/m, in the plane Pa.
pub fn stiffness_of<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, material, region, |geometry, own| geometry.stiffness(own).stiffness)
}

/// [`stiffness_of`] all regions.
pub fn stiffness<S: Sectored>(sector: &S, material: &dyn MaterialField) -> SectorMatrix {
    stiffness_of(sector, material, None)
}

/// Mass of one sector or of one of its regions, consistent or lumped: kg, in the plane kg/m.
pub fn mass_of<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, material, region, |geometry, own| match kind {
        MassKind::Consistent => geometry.consistent_mass(own),
        MassKind::Lumped => {
            let masses = geometry.lumped_mass(own).into_iter();
            let each = masses.flat_map(|mass| [mass; 3].into_iter().take(S::COMPONENTS));
            DMatrix::from_diagonal(&DVector::from_vec(each.collect()))
        }
    })
}

/// [`mass_of`] all regions.
pub fn mass<S: Sectored>(sector: &S, material: &dyn MaterialField, kind: MassKind) -> SectorMatrix {
    mass_of(sector, material, kind, None)
}

/// Damping that regions have in place of the `common` one,
/// `sum_r (alpha_r - alpha) M_r + (beta_r - beta) K_r`: N s/m, in the plane Pa s.
pub fn extra_damping<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    common: RayleighDamping,
) -> SectorMatrix {
    let regions = 0..sector.region_count();
    let own = regions.filter_map(|r| Some((r, material.own_damping(r)?)).filter(|o| o.1 != common));
    let terms = own.flat_map(|(region, own)| {
        let alpha = own.mass_coefficient - common.mass_coefficient;
        let beta = own.stiffness_coefficient - common.stiffness_coefficient;
        let mass = mass_of(sector, material, kind, Some(region));
        let stiffness = stiffness_of(sector, material, Some(region));
        [mass.scaled(alpha), stiffness.scaled(beta)]
    });
    terms.fold(SectorMatrix::default(), |sum, own| sum.plus(&own))
}

/// Geometric stiffness `∫ (grad N_I . sigma . grad N_J) I dV` of a region for the stress that a displacement, the same in every
/// sector, causes, the amplitudes of the incompatible modes that come with it included: N/m, in the plane Pa.
///
/// `displacement` holds the components of each sector node, m. One without tangential components gives a matrix of even parity, a purely tangential one of odd parity.
pub fn geometric_stiffness<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: usize,
    displacement: &[f64],
) -> SectorMatrix {
    let mut known: BTreeMap<usize, Option<DMatrix<f64>>> = BTreeMap::new();
    let own = material.of(region);
    let elements = (0..sector.element_count()).filter(|e| sector.region(*e) == region);
    let matrices = elements.map(|e| {
        let (nodes, alike) = (sector.places(e), sector.alike(e));
        let dofs = nodes.iter().flat_map(|(node, _)| (0..S::COMPONENTS).map(move |c| (node, c)));
        let values = dofs.map(|(node, c)| displacement[S::COMPONENTS * node + c]);
        let values = DVector::from_iterator(S::COMPONENTS * nodes.len(), values);
        let recovered = known.entry(alike).or_insert_with(|| sector.geometry(alike).recovered(own));
        let internal = recovered.as_ref().map(|recovered| recovered * &values);
        let geometry = sector.geometry(e);
        (nodes, geometry.geometric_stiffness(own, values.as_slice(), internal.as_ref()))
    });
    SectorMatrix::sum(S::COMPONENTS, matrices)
}
