//! A guide for users: from the first run to a design that does not squeal.
//!
//! 1. [`start`]: a first case, its answer, its files.
//! 2. [`bodies`]: the built-in disc, parts and assemblies from mesh files, supports, units.
//! 3. [`contact`]: counterfaces, the base state, interface stiffness, friction laws.
//! 4. [`analyses`]: one paragraph and one command for each.
//! 5. [`results`]: how to read folders, tables and figures.
//! 6. [`measurement`]: from a measured response to a probability of squeal.
//! 7. [`matrices`]: the same problem in another program, reduced matrices of other programs.
//! 8. [`python`]: the module.
//! 9. [`theory`]: the equations in the order in which a run computes them, each with its module.
//! 10. [`extending`]: an element, a law, a figure, a key.
//! 11. [`keys`]: every key of a case.

#[doc = include_str!("start.md")]
pub mod start {}

#[doc = include_str!("bodies.md")]
pub mod bodies {}

#[doc = include_str!("contact.md")]
pub mod contact {}

#[doc = include_str!("analyses.md")]
pub mod analyses {}

#[doc = include_str!("results.md")]
pub mod results {}

#[doc = include_str!("measurement.md")]
pub mod measurement {}

#[doc = include_str!("matrices.md")]
pub mod matrices {}

#[doc = include_str!("python.md")]
pub mod python {}

#[doc = include_str!("theory.md")]
pub mod theory {}

#[doc = include_str!("extending.md")]
pub mod extending {}

#[doc = include_str!("keys.md")]
pub mod keys {}
