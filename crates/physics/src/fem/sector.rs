//! Matrices of one sector of a body of equal sectors, in the plane and in space: stiffness, mass, geometric stiffness.
//! They are those of the strip of its elements, as of any mesh, whose nodes are images of the sector's.
//!
//! Dofs are `d k + c`, component `c` (radial, tangential, axial) of sector node `k`; for their order see [`SectorMesh`].

use super::assembly::assemble_congruent;
use super::fold::{SectorMatrix, WaveDofs};
use super::solid::{FaceRule, WHOLE_ELEMENT, face_points};
use super::{
    MassKind, MaterialField, RayleighDamping, Triplets, assemble_extra_damping,
    assemble_geometric_stiffness, assemble_support, element_mass, element_stiffness,
};
use crate::mesh::{Boundary, BoundaryCondition, Mesh, SectorMesh, SolidFace, SolidSector};
use nalgebra::DMatrix;

/// One sector of a body of equal sectors.
pub trait Sectored {
    /// Its elements, with the nodes of the sector and of the next one, in equal order.
    fn strip(&self) -> &Mesh;

    /// Sector node of a node of the strip, and its angle in halves of a sector.
    fn place(&self, node: usize) -> (usize, usize);

    /// Dofs of the sector.
    fn dofs(&self) -> usize;

    /// The dofs that nothing holds.
    fn wave_dofs(&self) -> WaveDofs;

    /// Each supported boundary. Linear bricks carry springs at their nodes where the mass is lumped, as in a time step.
    fn supports(&self, mass: MassKind) -> Vec<SectorSupport>;
}

/// A supported boundary of a sector.
#[derive(Clone, Debug)]
pub struct SectorSupport {
    /// Its name.
    pub name: String,
    /// Springs and dashpots: N/m and N s/m, in the plane Pa and Pa s.
    pub terms: [SectorMatrix; 2],
    /// Structural damping of the springs.
    pub loss_factor: f64,
}

impl Sectored for SectorMesh {
    fn strip(&self) -> &Mesh {
        &self.strip
    }

    fn place(&self, node: usize) -> (usize, usize) {
        (self.sector_node_of[node], self.half_steps[node])
    }

    fn dofs(&self) -> usize {
        2 * self.node_count()
    }

    fn wave_dofs(&self) -> WaveDofs {
        let free = 2 * self.free_node_count();
        let of_one_body = if self.specification.element.is_quadratic() { 9 } else { 3 };
        // Room for the contact of two bodies, in which a node of the shaft takes part in the motion of the pair.
        let pair = self.specification.shaft.map_or(0, |_| 2 * self.contact_count);
        let half_bandwidth = of_one_body + pair;
        WaveDofs::new(self.dofs(), |dof| dof >= free, half_bandwidth, self.sector_count())
    }

    fn supports(&self, _: MassKind) -> Vec<SectorSupport> {
        let of = |own: &Boundary| {
            let (terms, loss_factor) = assemble_support(&self.strip, own)?;
            let terms = terms.map(|own| folded(self, &own));
            Some(SectorSupport { name: own.name.clone(), terms, loss_factor })
        };
        self.strip.boundaries.iter().filter_map(of).collect()
    }
}

impl Sectored for SolidSector {
    fn strip(&self) -> &Mesh {
        &self.strip
    }

    fn place(&self, node: usize) -> (usize, usize) {
        let (sector, node) = (node / self.node_count(), node % self.node_count());
        (node, 2 * sector + self.nodes[node].half_step)
    }

    fn dofs(&self) -> usize {
        3 * self.node_count()
    }

    fn wave_dofs(&self) -> WaveDofs {
        let half_bandwidth = 3 * self.node_bandwidth() + 2;
        let is_held = |dof| self.is_held(dof);
        WaveDofs::new(self.dofs(), is_held, half_bandwidth, self.sector_count())
    }

    fn supports(&self, mass: MassKind) -> Vec<SectorSupport> {
        supported_faces(self, mass)
    }
}

/// What a matrix of the strip is over the dofs of the sector, whose images its nodes are.
fn folded<S: Sectored>(sector: &S, matrix: &Triplets) -> SectorMatrix {
    let components = sector.strip().dimension;
    placed(sector, matrix, |dof| {
        let (node, half) = sector.place(dof / components);
        (components * node + dof % components, half as isize)
    })
}

/// A matrix over places, each of which is a dof of the sector with an angle in halves of a sector.
fn placed<S: Sectored>(
    sector: &S,
    matrix: &Triplets,
    place: impl Fn(usize) -> (usize, isize),
) -> SectorMatrix {
    let entries = matrix.entries.iter().map(|&(row, column, value)| {
        let ((row, here), (column, there)) = (place(row), place(column));
        (row, column, there - here, value)
    });
    SectorMatrix::of_entries(sector.strip().dimension, entries)
}

/// The matrix of products of rows, see [`dof_ahead`](super::fold::dof_ahead).
pub fn at_places<S: Sectored>(sector: &S, products: &Triplets) -> SectorMatrix {
    let dofs = sector.dofs();
    placed(sector, products, |place| (place % dofs, (place / dofs) as isize))
}

/// Stiffness over all dofs, springs included, that motions which are the same in every sector see.
pub fn stiffness_alike<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    mass: MassKind,
) -> Triplets {
    let [springs, _] = supports(sector, mass);
    SectorMatrix::alike_in_all(&[&stiffness(sector, material, None), &springs])
}

/// Springs and dashpots of all supports of a sector together.
pub fn supports<S: Sectored>(sector: &S, mass: MassKind) -> [SectorMatrix; 2] {
    let all = sector.supports(mass);
    [0, 1].map(|part| {
        let own = all.iter().map(|own| &own.terms[part]);
        own.fold(SectorMatrix::default(), |sum, own| sum.plus(own))
    })
}

/// Sums element matrices of a region, or of all.
fn assemble<S: Sectored>(
    sector: &S,
    region: Option<usize>,
    compute: impl Fn(&Mesh, usize) -> DMatrix<f64>,
) -> SectorMatrix {
    let strip = sector.strip();
    let is_own = |e: usize| region.is_none_or(|region| strip.region(e) == region);
    folded(sector, &assemble_congruent(strip, &is_own, |e| compute(strip, e)))
}

/// Elastic stiffness `K_e` of one sector without its supports, or of one of its regions: N/m, in the plane Pa.
pub fn stiffness<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, region, |strip, e| element_stiffness(strip, material, e))
}

/// Mass of one sector or of one of its regions, consistent or lumped: kg, in the plane kg/m.
pub fn mass<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, region, |strip, e| element_mass(strip, material, kind, e))
}

/// Damping that regions have in place of the `common` one,
/// `sum_r (alpha_r - alpha) M_r + (beta_r - beta) K_r`: N s/m, in the plane Pa s.
pub fn extra_damping<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    common: RayleighDamping,
) -> SectorMatrix {
    folded(sector, &assemble_extra_damping(sector.strip(), material, kind, common))
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
    let strip = sector.strip();
    let nodes = (0..strip.node_count()).map(|node| strip.dimension * sector.place(node).0);
    let base = nodes.flat_map(|dof| &displacement[dof..dof + strip.dimension]).copied();
    let base: Vec<f64> = base.collect();
    folded(sector, &assemble_geometric_stiffness(strip, material, &base, Some(region)))
}

/// Each supported face.
fn supported_faces(sector: &SolidSector, mass: MassKind) -> Vec<SectorSupport> {
    let rule = match mass {
        MassKind::Consistent => FaceRule::Integrated,
        MassKind::Lumped => FaceRule::Nodal,
    };
    let conditions = SolidFace::ALL.into_iter().zip(&sector.specification.conditions);
    let supported = conditions.filter_map(|(face, condition)| {
        let BoundaryCondition::Support(own) = condition else {
            return None;
        };
        let elements = sector.face_elements(face).into_iter();
        // Across, a face is tangential like around; a cylinder has its own word for it.
        let [axial, axial_damping] = match (face.normal_component(), own.axial_stiffness) {
            (0, Some(axial)) => [axial, 0.0],
            _ => [own.tangential_stiffness, own.tangential_damping],
        };
        let laws = [
            (face.normal_component(), [own.normal_stiffness, own.normal_damping]),
            (1, [own.tangential_stiffness, own.tangential_damping]),
            (face.across_component(), [axial, axial_damping]),
        ];
        let mut terms = <[Triplets; 2]>::default();
        for point in elements.flat_map(|own| face_points(sector, &own, WHOLE_ELEMENT, rule)) {
            for (component, values) in laws {
                let row = &point.rows[component];
                for (sum, value) in terms.iter_mut().zip(values) {
                    sum.push_product(point.area * value, row, row);
                }
            }
        }
        let (name, terms) = (face.name().to_owned(), terms.map(|own| at_places(sector, &own)));
        Some(SectorSupport { name, terms, loss_factor: own.loss_factor })
    });
    supported.collect()
}
