//! Harmonics of a body of equal sectors in the state that is excited.

use super::{Direction, FrfError, NodeFault, Terminal};
use crate::fem::fold::WaveDofs;
use crate::fem::{MassKind, MaterialField, RayleighDamping};
use crate::mesh::Strip;
use crate::prestress::{MovingHarmonic, WaveTangent};

/// [`super::FrfSystem`] of an annulus or of a body of revolution, as the matrices of its circumferential harmonics.
#[derive(Clone, Debug)]
pub struct CyclicSystem {
    pub(super) tangent: WaveTangent,
    friction_coefficient: f64,
    /// Dofs of the sector that can be excited and observed.
    pub(super) dofs: WaveDofs,
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
    /// The body without contact and prestress, held by its supports or all of it free, `C = alpha_R M + beta_R K` and the dashpots of
    /// its supports.
    pub fn body(
        strip: &Strip,
        material: &dyn MaterialField,
        mass: MassKind,
        damping: RayleighDamping,
        is_held: bool,
    ) -> Self {
        let tangent = WaveTangent::of_free(strip, material, mass, damping, is_held);
        Self::sliding(&tangent, 0.0)
    }

    /// Small motions around steady sliding at a friction coefficient, in space the dashpot `mu p_0 / V` across the sliding included.
    ///
    /// In rigid contact the motion along the normal of pressed nodes is no unknown; the force of excitation acts on the
    /// body, not through the contact. A distance between two bodies is no place to strike or to observe.
    pub fn sliding(tangent: &WaveTangent, friction_coefficient: f64) -> Self {
        Self { tangent: tangent.clone(), friction_coefficient, dofs: tangent.places() }
    }

    /// Number of unknowns of the annulus.
    pub fn dimension(&self) -> usize {
        self.dofs.count * self.dofs.sectors
    }

    /// Checks that a terminal can move; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::Node`], [`FrfError::NoAxes`].
    pub fn check(&self, terminal: Terminal, key: &'static str) -> Result<(), FrfError> {
        self.place(terminal, key).map(|_| ())
    }

    /// How many harmonics are held at a time: at most `count`, and few where their bands have many entries.
    pub(super) fn harmonics_at_once(&self, count: usize, entries: usize) -> usize {
        let width = 2 * self.dofs.half_bandwidth + 1;
        (entries / (self.dofs.count * width).max(1)).clamp(1, count)
    }

    /// Place of a terminal; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::Node`], [`FrfError::NoAxes`].
    pub(super) fn place(&self, terminal: Terminal, key: &'static str) -> Result<Place, FrfError> {
        let per_sector = self.tangent.halves.len();
        let count = per_sector * self.dofs.sectors;
        if terminal.node >= count {
            return Err(terminal.refused(key, NodeFault::Missing(count)));
        }
        let component = terminal.direction.component();
        let component =
            component.ok_or(FrfError::NoAxes { key, direction: terminal.direction.name() })?;
        if component >= self.tangent.components {
            return Err(terminal.refused(key, NodeFault::InPlane));
        }
        let (sector, node) = (terminal.node / per_sector, terminal.node % per_sector);
        let unknown = self.dofs.unknown_of[self.tangent.components * node + component];
        Ok(Place {
            unknown: unknown.ok_or_else(|| terminal.constrained(key))?,
            half_steps: 2 * sector + self.tangent.halves[node],
            is_tangential: terminal.direction == Direction::Tangential,
        })
    }

    /// Matrices of harmonic `n`, and the coefficients of proportional damping.
    pub(super) fn harmonic(&self, n: usize) -> (MovingHarmonic, Option<RayleighDamping>) {
        let harmonic = self.tangent.harmonic(n);
        let proportional = harmonic.damping.is_none().then_some(harmonic.rayleigh);
        (harmonic.at(self.friction_coefficient), proportional)
    }
}
