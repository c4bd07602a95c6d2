//! A guide for users: from the first run to a design that does not squeal.
//!
//! 1. [`start`]: a first case, its answer, its files.
//! 2. [`part`]: your first own part: from a plane drawing to an answer.
//! 3. [`brake`]: a brake from an Abaqus file, from beginning to end.
//! 4. [`results`]: how to read folders, tables and figures.
//! 5. [`analyses`]: each command, with an example.
//! 6. [`bodies`]: the built-in disc, parts and assemblies from mesh files, supports, units.
//! 7. [`contact`]: counterfaces, the base state, interface stiffness, friction laws.
//! 8. [`measurement`]: from a measured response to a probability of squeal.
//! 9. [`matrices`]: the same problem in another program, reduced matrices of other programs.
//! 10. [`python`]: the module.
//! 11. [`limits`]: what it does not do, by command.
//! 12. [`theory`]: the equations in the order in which a run computes them, each with its module.
//! 13. [`verification`]: closed forms that the program is held against.
//! 14. [`glossary`]: what the words mean.
//! 15. [`extending`]: a key, an element, a friction law, a figure, a command.
//! 16. [`keys`]: every key of a case.
//! 17. [`columns`]: every declared column and key of results.

#[doc = include_str!("start.md")]
pub mod start {}

#[doc = include_str!("part.md")]
pub mod part {}

#[doc = include_str!("brake.md")]
pub mod brake {}

#[doc = include_str!("results.md")]
pub mod results {}

#[doc = include_str!("analyses.md")]
pub mod analyses {}

#[doc = include_str!("bodies.md")]
pub mod bodies {}

#[doc = include_str!("contact.md")]
pub mod contact {}

#[doc = include_str!("measurement.md")]
pub mod measurement {}

#[doc = include_str!("matrices.md")]
pub mod matrices {}

#[doc = include_str!("python.md")]
pub mod python {}

#[doc = include_str!("limits.md")]
pub mod limits {}

#[doc = include_str!("theory.md")]
pub mod theory {}

#[doc = include_str!("verification.md")]
pub mod verification {}

#[doc = include_str!("glossary.md")]
pub mod glossary {}

#[doc = include_str!("extending.md")]
pub mod extending {}

#[doc = include_str!("keys.md")]
pub mod keys {}

#[doc = include_str!("columns.md")]
pub mod columns {}
