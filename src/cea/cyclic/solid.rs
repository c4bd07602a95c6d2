//! The eigenvalues of a body of revolution in three dimensions, harmonic by harmonic.
//!
//! A harmonic has some thousand unknowns, too many to factorize for every mode at every friction
//! coefficient. Friction acts on the few nodes of the contact. So each harmonic is first reduced to
//! its modes at rest and to what forces and motions of the contact cause ([`reduction`]). The
//! reduced problem is followed over friction like that of the plane annulus. Where friction damps
//! the motion across the sliding strongly, all of its eigenvalues are counted at every friction
//! coefficient ([`damped`]).

mod across;
mod damped;
mod error;
mod modes_below;
mod reduction;
mod refined;
mod rest;
mod sweep;

pub use sweep::{SolidModel, solid_sweep, solid_sweep_with_waves};
