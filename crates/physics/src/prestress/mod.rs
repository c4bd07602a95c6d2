//! Steady sliding equilibrium and the tangent around it.
//!
//! [`PressedState`] is the base state: the counterface pushed in by `delta`, every pressed contact node slipping, the others open.
//! [`SlidingTangent`] holds the matrices of small motions around it, `M(mu) q'' + C(mu) q' + K_t(mu) q = 0`, as polynomials in the friction
//! coefficient. Both stand on contact points with rows: [`Pressing`] finds the base state by complementarity, [`Elimination`] takes held
//! dofs, ties and rigid contact out, and [`SlidingTangent::assemble`] sums the [`Terms`] up. [`Assembly`] is the bodies of one mesh, plane
//! or solid, that slide on a counterface or on each other. [`WaveTangent`] is the same of a body of equal sectors from one of them,
//! harmonic by harmonic: of a plane annulus around [`SectorSliding`], of a body of revolution around [`SolidSliding`].

mod assembly;
mod complementarity;
mod contact_system;
mod elimination;
mod error;
mod face;
mod joined_points;
mod joint;
mod motion_matrices;
mod options;
mod polynomials;
mod pressed_range;
mod pressed_state;
mod pressing;
mod rotation;
mod tangent;
mod terms;
mod wave_harmonic;
mod wave_tangent;
mod waves;

pub use crate::contact::PressedState;
pub use crate::fem::{LossGain, TabledGain};
pub use assembly::{Assembly, Joined};
pub use elimination::{Elimination, RigidFriction};
pub use error::PrestressError;
use error::Result;
pub(crate) use face::node_point;
pub use face::{FaceRule, SolidSliding};
pub use joint::{BaseChoice, SlidingSurfaces, TiedSurfaces};
pub use motion_matrices::MotionMatrices;
pub use options::{DampingModel, TangentOptions};
pub use pressed_range::PressedRange;
pub use pressed_state::{Pressing, SectorSliding};
pub use tangent::{ContactDofs, ContactPart, SlidingTangent};
pub use terms::{Kind, Part, PartForms, PartLaw, Term, Terms};
pub use wave_harmonic::{FrictionPolynomial, HarmonicTangent, MovingHarmonic, evaluate};
pub use wave_tangent::{WaveContact, WaveTangent};

/// Entry `k` of a vector that has no symmetry, between -0.5 and 0.5.
pub(crate) fn without_symmetry(k: usize) -> f64 {
    (1.0 + k as f64).sqrt().fract() - 0.5 // Fractions of roots repeat nowhere.
}
