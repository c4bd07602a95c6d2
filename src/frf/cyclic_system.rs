//! Harmonics of a body of equal sectors in the state that is excited.

use super::harmonic::{Damping, Harmonic, held_harmonic};
use super::{Direction, FrfError, Terminal};
use crate::fem::fold::{MirrorParity, SectorMatrix, WaveDofs};
use crate::fem::{ElasticMaterial, MassKind, RayleighDamping, sector, solid};
use crate::mesh::{BoundaryCondition, SectorMesh, SolidSector};
use crate::prestress::{MovingHarmonic, WaveTangent, supports};

/// [`super::FrfSystem`] of an annulus or of a body of revolution, as the matrices of its circumferential harmonics.
#[derive(Clone, Debug)]
pub struct CyclicSystem {
    /// Sector node of each node of a sector, in the order of the mesh, and its angle in halves of a sector.
    nodes: Vec<(usize, usize)>,
    /// Components of a displacement: 2 in the plane, 3 in space.
    components: usize,
    state: State,
    /// Dofs of the sector that can be excited and observed.
    dofs: WaveDofs,
}

#[derive(Clone, Debug)]
enum State {
    Body(Box<Body>),
    /// Small motions around steady sliding at a friction coefficient.
    Sliding(Box<WaveTangent>, f64),
}

/// A body without contact and prestress.
#[derive(Clone, Debug)]
struct Body {
    mass: SectorMatrix,
    stiffness: SectorMatrix,
    supports: [SectorMatrix; 2],
    damping: RayleighDamping,
}

/// Where a terminal lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub unknown: usize,
    /// Angle in halves of a sector.
    pub half_steps: usize,
    pub is_tangential: bool,
}

impl CyclicSystem {
    /// The body without contact and prestress, free or with its outer edge clamped, `C = alpha_R M +
    /// beta_R K`.
    pub fn body(
        sector: &SectorMesh,
        material: &ElasticMaterial,
        mass: MassKind,
        damping: RayleighDamping,
        is_clamped: bool,
    ) -> Self {
        let mut sector = sector.clone();
        if !is_clamped {
            sector = sector.with_free_outer_edge();
        }
        let body = Body {
            mass: sector::mass(&sector, material, mass),
            stiffness: sector::stiffness(&sector, material),
            supports: sector::supports(&sector),
            damping,
        };
        Self::of_annulus(&sector, State::Body(Box::new(body)), sector::wave_dofs(&sector))
    }

    /// Small motions around steady sliding at a friction coefficient, in space the dashpot `mu p_0 / V` across the sliding
    /// included.
    ///
    /// In rigid contact the motion along the normal of pressed nodes is no unknown; the force of excitation acts on the
    /// body, not through the contact. A distance between two bodies is no place to strike or to observe.
    pub fn sliding(tangent: &WaveTangent, friction_coefficient: f64) -> Self {
        Self {
            nodes: tangent.nodes.clone(),
            components: tangent.components,
            dofs: tangent.places(),
            state: State::Sliding(Box::new(tangent.clone()), friction_coefficient),
        }
    }

    fn of_annulus(sector: &SectorMesh, state: State, dofs: WaveDofs) -> Self {
        let nodes = sector.sector_node_of.iter().take(sector.node_count());
        let nodes = nodes.map(|&k| (k, sector.half_step(k))).collect();
        Self { nodes, components: 2, state, dofs }
    }

    /// A body of revolution without contact and prestress, all of it free or held by the conditions of its faces,
    /// `C = alpha_R M + beta_R K` and the dashpots of its supports.
    pub fn solid_body(
        sector: &SolidSector,
        material: &ElasticMaterial,
        mass: MassKind,
        damping: RayleighDamping,
        is_clamped: bool,
    ) -> Self {
        let mut sector = sector.clone();
        if !is_clamped {
            sector.specification.conditions = [BoundaryCondition::Free; 4];
        }
        let body = Body {
            mass: solid::mass(&sector, material, mass),
            stiffness: solid::stiffness(&sector, material),
            supports: supports(&sector),
            damping,
        };
        Self::of_revolution(&sector, State::Body(Box::new(body)), solid::wave_dofs(&sector))
    }

    fn of_revolution(sector: &SolidSector, state: State, dofs: WaveDofs) -> Self {
        let half_steps = sector.nodes.iter().map(|node| node.half_step);
        Self { nodes: half_steps.enumerate().collect(), components: 3, state, dofs }
    }

    /// Number of unknowns of the annulus.
    pub fn dimension(&self) -> usize {
        self.dofs.count * self.sector_count()
    }

    /// Checks that a terminal can move; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::NoNode`], or [`FrfError::Constrained`] where the boundary holds it.
    pub fn check(&self, terminal: Terminal, key: &'static str) -> Result<(), FrfError> {
        self.place(terminal, key).map(|_| ())
    }

    /// Number of unknowns of one harmonic.
    pub(super) fn harmonic_dimension(&self) -> usize {
        self.dofs.count
    }

    pub(super) fn sector_count(&self) -> usize {
        self.dofs.sectors
    }

    /// How many harmonics are held at a time: at most `count`, and few where their bands have many entries.
    pub(super) fn harmonics_at_once(&self, count: usize, entries: usize) -> usize {
        let width = 2 * self.dofs.half_bandwidth + 1;
        (entries / (self.dofs.count * width).max(1)).clamp(1, count)
    }

    /// Place of a terminal; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::NoNode`], or [`FrfError::Constrained`] where the boundary holds it.
    pub(super) fn place(&self, terminal: Terminal, key: &'static str) -> Result<Place, FrfError> {
        let per_sector = self.nodes.len();
        let count = per_sector * self.sector_count();
        let node = terminal.node + 1;
        if node > count {
            return Err(FrfError::NoNode { key, node, count });
        }
        let component = terminal.direction.component();
        let component =
            component.ok_or(FrfError::NoAxes { key, direction: terminal.direction.name() })?;
        if component >= self.components {
            return Err(FrfError::in_plane(terminal, key));
        }
        let (sector, position) = (terminal.node / per_sector, terminal.node % per_sector);
        let (sector_node, half_step) = self.nodes[position];
        let unknown = self.dofs.unknown_of[self.components * sector_node + component];
        Ok(Place {
            unknown: unknown.ok_or_else(|| FrfError::constrained(terminal, key))?,
            half_steps: 2 * sector + half_step,
            is_tangential: terminal.direction == Direction::Tangential,
        })
    }

    /// Matrices of harmonic `n`.
    pub(super) fn harmonic(&self, n: usize) -> Harmonic {
        let is_standing = n == 0 || 2 * n == self.sector_count();
        match &self.state {
            State::Body(body) => {
                let fold = |matrix| self.dofs.fold(n, MirrorParity::Even, &[matrix]);
                let is_supported = body.supports.iter().any(|matrix| !matrix.is_empty());
                let supports = is_supported.then(|| body.supports.each_ref().map(fold));
                let matrices = [&body.mass, &body.stiffness].map(fold);
                held_harmonic(matrices, supports, body.damping, is_standing)
            }
            State::Sliding(tangent, friction) => {
                let harmonic = tangent.harmonic(n);
                let MovingHarmonic { half_bandwidth, mass, damping, stiffness } =
                    harmonic.at(*friction);
                let damping = match harmonic.damping {
                    Some(_) => Damping::Band(damping),
                    None => Damping::Proportional(harmonic.rayleigh),
                };
                Harmonic { half_bandwidth, mass, stiffness, damping, is_standing }
            }
        }
    }
}
