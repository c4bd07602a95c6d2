//! Finite-element stability and transient analysis of frictional contact.
//!
//! A deformable annulus, clamped at its outer edge, is pressed from inside by a rotating rigid
//! cylinder. Three analyses share one model: a prestressed complex eigenvalue analysis
//! ([`cea`]), an explicit contact transient ([`transient`]), and limit cycles found directly
//! ([`cycle`]).
//!
//! The modules are floors; each names only those below it:
//! [`linalg`], [`mesh`], [`signal`] → [`fem`] → [`contact`] → [`prestress`] → [`cea`],
//! [`transient`], [`cycle`] → [`case`], [`results`] → `app`.

pub mod case;
pub mod cea;
pub mod contact;
pub mod cycle;
pub mod fem;
pub mod frf;
pub mod linalg;
pub mod mesh;
pub mod prestress;
pub mod results;
pub mod signal;
pub mod transient;

pub mod app;
