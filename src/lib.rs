//! Finite-element stability and transient analysis of frictional contact.
//!
//! A deformable annulus, clamped at its outer edge, is pressed from inside by a rotating rigid
//! cylinder. Three analyses share one model: a prestressed complex eigenvalue analysis
//! ([`cea`]), an explicit contact transient ([`transient`]), and limit cycles found directly
//! ([`cycle`]).
//!
//! # From equation to item
//!
//! Equation numbers are those of J. Brunetti, F. Massi, A. Saulot, M. Renouf, W. D'Ambrogio, "System dynamic
//! instabilities induced by sliding contact: a numerical analysis with experimental validation".
//!
//! | equation | item |
//! |---|---|
//! | (1) `M x'' + C x' + K x = 0` | [`fem::assemble_mass`], [`fem::assemble_stiffness`] |
//! | (2), (3) Rayleigh damping, `zeta = (alpha_R/omega + beta_R omega)/2` | [`fem::RayleighDamping`] |
//! | (4) `lambda = -zeta omega ± i omega sqrt(1 - zeta^2)` | [`cea::ComplexMode::damping_factor`] |
//! | steady sliding, `u_n = delta`, `T = s mu N` | [`prestress::SteadySliding`], [`prestress::SectorSliding`] |
//! | small motions around it, `M(mu) q'' + C(mu) q' + K_t(mu) q = 0` | [`prestress::SlidingTangent`], [`prestress::SectorTangent`] |
//! | `(lambda^2 M + lambda C + K_t) phi = 0` | [`cea::sparse`], [`cea::cyclic`] |
//! | `Re lambda(mu) = 0` | [`cea::UnstableInterval`] |
//! | `d lambda / d parameter` | [`cea::cyclic::Sensitivity`] |
//! | (6) forward-increment Lagrange multipliers | [`transient::LagrangeContact`] |
//! | (7) central differences | [`transient::CentralDifference`] |
//! | (8) to (12) energy and powers | [`transient::Sample`] |
//! | rotating wave `u = U(r, n theta + omega t)` | [`cycle::LimitCycle`], [`cycle::CycleSolver`] |
//! | its perturbations `e^{lambda t} e^{i p theta} W(r, n theta + omega t)` | [`cycle::FloquetExponent`] |
//! | frequency response `(K + i omega C - omega^2 M) u = f` | [`frf`] |
//! | half-power damping, fit of equation (3) | [`signal`] |
//!
//! Equation (5) is misprinted: the denominator should read
//! `alpha^2 - 2 (2 - alpha beta) omega^2 + beta^2 omega^4`. The curve it describes is drawn from (3) and (4).
//!
//! # Conventions
//!
//! SI units, for each metre of thickness below the case files. Vectors over the nodes are written in nodal
//! frames, on the annulus `(e_r, e_theta)`. The cylinder turns counter-clockwise for `Omega > 0`. Eigenvalues are
//! in rad/s; "Hz" in a name says `/ 2 pi`.
//!
//! # Floors
//!
//! Each module names only those below it: [`linalg`], [`mesh`], [`signal`], [`chart`]; [`fem`]; [`contact`]; [`prestress`];
//! [`cea`], [`transient`], [`frf`], [`cycle`]; [`case`], [`results`]; [`study`]; [`app`].

pub mod case;
pub mod cea;
pub mod chart;
pub mod contact;
pub mod cycle;
pub mod fem;
pub mod frf;
pub mod linalg;
pub mod mesh;
pub mod prestress;
pub mod results;
pub mod signal;
pub mod study;
pub mod transient;

pub mod app;
