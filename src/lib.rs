//! Friction-induced vibration by finite elements: from a case to a result.
//!
//! Deformable bodies are pressed against each other or against a rigid counterface, and slide. A *case* describes them, in a
//! text file or a string. The shortest way from a case to a result:
//!
//! ```
//! use frictionsim::case::Case;
//! use frictionsim::study::eigenvalues;
//!
//! let text = std::fs::read("cases/polycarbonate-disc.toml")?;
//! // A coarser mesh than the shipped one, as on the command line with `--set`.
//! let coarse = ["mesh.circumferential_elements=24", "mesh.radial_elements=4"].map(String::from);
//! let case = Case::parse("polycarbonate-disc.toml", &text, &coarse)?;
//! // Complex eigenvalues around steady sliding, over the friction coefficients of the case.
//! let sweep = eigenvalues::modes_and_onsets(&case)?;
//! let onsets = sweep.intervals.iter().map(|interval| interval.critical_friction);
//! let critical = onsets.fold(f64::INFINITY, f64::min);
//! assert!((critical - 0.122).abs() < 0.01, "steady sliding is lost at {critical}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The [`guide`] is for users of the program. [`study`] has every analysis as a handful of calls.
//! The rest of this page is for readers of the code.
//!
//! # How a run goes
//!
//! Each step has one module, and its equations stand there.
//!
//! 1. [`case`]: a TOML file becomes a [`case::Case`]. Every key is declared once, every mistake has its line.
//! 2. [`mesh`]: the body as elements, regions and boundaries, built in or read from a file.
//! 3. [`fem`]: `M`, `C = alpha_R M + beta_R K` and `K` of its elements, with supports and pressures.
//! 4. [`contact`]: points with gap, normal and sliding direction; the friction law; pairs of meshes that do not match.
//! 5. [`prestress`]: steady sliding, `K u = G_n^T N + s mu G_t^T N` with `gap >= 0`, `N >= 0`, `gap N = 0`, and the
//!    matrices of small motions around it.
//! 6. [`cea`], [`transient`], [`frf`], [`cycle`]: eigenvalues, the time loop, responses and limit cycles, each for itself.
//! 7. [`study`]: an analysis of a case from beginning to end, and what repeats analyses: sweeps, fits, probabilities.
//! 8. [`results`], [`output`] and [`chart`]: tables, fields, figures, reports. [`app`]: the command line.
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
//! | steady sliding, `u_n = delta`, `T = s mu N` | [`prestress::Assembly`], [`prestress::SectorSliding`] |
//! | small motions around it, `M(mu) q'' + C(mu) q' + K_t(mu) q = 0` | [`prestress::SlidingTangent`], [`prestress::WaveTangent`] |
//! | `(lambda^2 M + lambda C + K_t) phi = 0` | [`cea::sparse`], [`cea::cyclic`] |
//! | `Re lambda(mu) = 0` | [`cea::UnstableInterval`] |
//! | `d lambda / d parameter` | [`study::eigenvalues`] |
//! | (6) forward-increment Lagrange multipliers | [`transient::LagrangeContact`] |
//! | (7) central differences | [`transient::CentralDifference`] |
//! | (8) to (12) energy and powers | [`transient::Sample`] |
//! | rotating wave `u = U(r, n theta + omega t)` | [`cycle::LimitCycle`], [`cycle::CycleSolver`] |
//! | its perturbations `e^{lambda t} e^{i p theta} W(r, n theta + omega t)` | [`cycle::RidingMode`] |
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
//! [`chart`], [`formats`], [`linalg`], [`output`] and [`signal`] are crates of their own in `crates/`, which name nothing of this one:
//! [`output`] knows tables and nothing of friction. So are the physics, from [`mesh`] to [`cycle`],
//! [`case`], [`results`] and [`study`].
//! Each module names only those below it: [`linalg`], [`mesh`]; [`fem`]; [`contact`]; [`prestress`]; [`cea`], [`transient`], [`frf`],
//! [`cycle`]; [`case`], [`results`]; [`study`]; [`app`].

pub mod guide;

pub mod app;

#[doc(inline)]
pub use frictionsim_case as case;
#[doc(inline)]
pub use frictionsim_chart as chart;
#[doc(inline)]
pub use frictionsim_formats as formats;
#[doc(inline)]
pub use frictionsim_output as output;
#[doc(inline)]
pub use frictionsim_physics::{
    cea, contact, cycle, fem, frf, linalg, mesh, order, parallel, prestress, transient,
};
#[doc(inline)]
pub use frictionsim_results as results;
#[doc(inline)]
pub use frictionsim_signal as signal;
#[doc(inline)]
pub use frictionsim_study as study;
