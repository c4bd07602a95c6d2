//! Harmonics of the annulus in the state that is excited.

use super::cyclic_solid::SolidState;
use super::harmonic::{Damping, Harmonic, evaluate, held_harmonic};
use super::{Direction, FrfError, Terminal};
use crate::fem::sector::{self, SectorMatrix};
use crate::fem::{ElasticMaterial, MassKind, RayleighDamping};
use crate::mesh::{SectorMesh, SolidSector};
use crate::prestress::{SectorTangent, SolidTangent};

/// [`super::FrfSystem`] of an annulus or of a body of revolution, as the matrices of its circumferential harmonics.
#[derive(Clone, Debug)]
pub struct CyclicSystem {
    sector_count: usize,
    /// Sector node of each node of a sector, in the order of the mesh, and its angle in halves of a sector.
    nodes: Vec<(usize, usize)>,
    /// Components of a displacement: 2 in the plane, 3 in space.
    components: usize,
    state: State,
    /// Unknown of each dof of the sector.
    unknown_of: Vec<Option<usize>>,
    dimension: usize,
}

#[derive(Clone, Debug)]
enum State {
    Body {
        mass: SectorMatrix,
        stiffness: SectorMatrix,
        supports: Option<[SectorMatrix; 2]>,
        damping: RayleighDamping,
    },
    Sliding {
        tangent: Box<SectorTangent>,
        friction_coefficient: f64,
    },
    Solid(SolidState),
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
        let state = State::Body {
            mass: sector::mass(&sector, material, mass),
            stiffness: sector::stiffness(&sector, material),
            supports: sector::supports(&sector),
            damping,
        };
        let unknowns: Vec<usize> = (0..2 * sector.free_node_count()).collect();
        Self::new(&sector, state, &unknowns)
    }

    /// Small motions around steady sliding at a friction coefficient.
    pub fn sliding(tangent: &SectorTangent, friction_coefficient: f64) -> Self {
        let state = State::Sliding { tangent: Box::new(tangent.clone()), friction_coefficient };
        let mut system = Self::new(tangent.sector(), state, &tangent.unknowns());
        let sector = tangent.sector();
        for node in sector.contact_nodes() {
            // A distance between two bodies is no place to strike or to observe.
            if sector.opposite(node).is_some() {
                system.unknown_of[2 * node] = None;
            }
        }
        system
    }

    fn new(sector: &SectorMesh, state: State, unknowns: &[usize]) -> Self {
        let mut unknown_of = vec![None; 2 * sector.node_count()];
        for (unknown, &dof) in unknowns.iter().enumerate() {
            unknown_of[dof] = Some(unknown);
        }
        let nodes = sector.sector_node_of.iter().take(sector.node_count());
        Self {
            sector_count: sector.sector_count(),
            nodes: nodes.map(|&k| (k, sector.half_step(k))).collect(),
            components: 2,
            state,
            unknown_of,
            dimension: unknowns.len(),
        }
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
        Self::of_solid(SolidState::body(sector, material, mass, damping, is_clamped))
    }

    /// Small motions of a body of revolution around steady sliding at a friction coefficient, the dashpot `mu p_0 / V`
    /// across the sliding included.
    ///
    /// In rigid contact the motion along the normal of pressed nodes is no unknown; the force of excitation acts on the
    /// body, not through the contact.
    pub fn solid_sliding(tangent: &SolidTangent, friction_coefficient: f64) -> Self {
        let tangent = Box::new(tangent.clone());
        Self::of_solid(SolidState::Sliding { tangent, friction_coefficient })
    }

    fn of_solid(state: SolidState) -> Self {
        let unknown_of = state.unknown_of();
        let sector = state.sector();
        let half_steps = sector.nodes.iter().map(|node| node.half_step);
        Self {
            sector_count: sector.sector_count(),
            nodes: half_steps.enumerate().collect(),
            components: 3,
            dimension: unknown_of.iter().flatten().count(),
            unknown_of,
            state: State::Solid(state),
        }
    }

    /// Number of unknowns of the annulus.
    pub fn dimension(&self) -> usize {
        self.dimension * self.sector_count()
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
        self.dimension
    }

    pub(super) fn sector_count(&self) -> usize {
        self.sector_count
    }

    /// How many harmonics are held at a time: at most `count`, and few where their bands have many entries.
    pub(super) fn harmonics_at_once(&self, count: usize, entries: usize) -> usize {
        let width = match &self.state {
            State::Solid(state) => 2 * state.half_bandwidth() + 1,
            // Bands of plane harmonics are narrow.
            State::Body { .. } | State::Sliding { .. } => return count,
        };
        (entries / (self.dimension * width).max(1)).clamp(1, count)
    }

    /// Place of a terminal; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::NoNode`], or [`FrfError::Constrained`] where the boundary holds it.
    pub(super) fn place(&self, terminal: Terminal, key: &'static str) -> Result<Place, FrfError> {
        let per_sector = self.nodes.len();
        let count = per_sector * self.sector_count;
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
        let unknown = self.unknown_of[self.components * sector_node + component];
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
            State::Body { mass, stiffness, supports, damping } => {
                let supports = supports
                    .as_ref()
                    .map(|matrices| matrices.each_ref().map(|matrix| matrix.harmonic(n)));
                let matrices = [mass.harmonic(n), stiffness.harmonic(n)];
                held_harmonic(matrices, supports, *damping, is_standing)
            }
            State::Sliding { tangent, friction_coefficient } => {
                sliding_harmonic(tangent, *friction_coefficient, (n, is_standing))
            }
            State::Solid(state) => state.harmonic(n, is_standing),
        }
    }
}

/// Small motions around steady sliding in the plane.
fn sliding_harmonic(
    tangent: &SectorTangent,
    friction_coefficient: f64,
    (n, is_standing): (usize, bool),
) -> Harmonic {
    let mu = friction_coefficient;
    let harmonic = tangent.harmonic(n);
    Harmonic {
        half_bandwidth: harmonic.mass[0].half_bandwidth(),
        mass: evaluate(&harmonic.mass, mu),
        stiffness: evaluate(&harmonic.stiffness, mu),
        damping: match &harmonic.damping {
            Some(damping) => {
                let mut band = evaluate(damping, mu);
                let dashpots = harmonic.friction_dashpots.iter();
                let values = dashpots.flat_map(|dashpots| evaluate(dashpots, mu));
                band.iter_mut().zip(values).for_each(|(c, v)| *c += v * mu);
                Damping::Band(band)
            }
            None => Damping::Proportional(harmonic.rayleigh),
        },
        is_standing,
    }
}
