//! How close is the same, how small is nothing, how often is enough: what every solver of eigenvalues works to.

/// Rounding errors of the terms of a sum up to which the sum is none but rounded.
pub(super) const ROUNDING_ERRORS: f64 = 8.0;
/// What a number near 1, or a vector of unit length, has of rounding after some hundred operations: what a vector has beyond a space
/// makes that wider if it is more. A part as short as this along the stiffest waves of a mesh moves the slowest modes, a thousandth as
/// fast, by a relative 1e-9.
pub(super) const ROUND_OFF: f64 = 1e-13;
/// Residual, relative to what it is one of, or length of a correction of a mode of unit length, at which it has converged: below that
/// corrections are round-off.
pub(super) const CONVERGED: f64 = 1e-11;
/// Change of a vector of unit length, of a block of them relative to its longest, or of a critical friction coefficient, below which no
/// more corrections are made. Source: A. Neumaier, SIAM J. Numer. Anal. 22 (1985), residual inverse iteration.
pub(super) const SETTLED: f64 = 1e-10;
/// Relative error that is promised. A pair with a larger residual of the quadratic problem is not listed as converged, and one whose
/// eigenvalue round-off of that residual moves by more is improved. Two frequencies as close are those of a degenerate pair.
pub(super) const RESIDUAL_BOUND: f64 = 1e-9;
/// Error whose square, or what one more step leaves of it, is round-off.
pub(super) const HALF_THE_DIGITS: f64 = 1e-8;
/// Relative distance of eigenvalues up to which they are one multiple eigenvalue, whose vectors are any basis of one space; farther apart
/// each has a vector of its own.
pub(super) const MULTIPLE: f64 = 1e-7;
/// Relative distance of eigenvalues up to which they are one where their vectors are, or where friction moves neither; of a growth rate
/// to zero up to which it crosses there.
pub(super) const SAME_EIGENVALUE: f64 = 1e-6;
/// Relative error whose square is [`HALF_THE_DIGITS`]: that much the overlap of two right vectors lacks to 1 where they are one, a step may
/// be long that stands for a slope, and modes may be wrong that are corrected rather than computed anew.
pub(super) const NEAR: f64 = 1e-4;
/// Relative distance that is far above the errors of an eigenvalue and far below its distance from others: of factors that are regular
/// there, of a prediction that tells it beyond doubt.
pub(super) const BESIDE: f64 = 1e-3;
/// Frequency up to which modes are held or wanted, over the highest one: two that differ in damping change places as they converge, and the
/// one of lower frequency may have the larger eigenvalue. One farther above is above the range beyond doubt.
pub(super) const CHANGE_PLACES: f64 = 1.01;
/// Steps of an iteration for one mode, or for one basis, after which it counts as one that does not converge: ten or fewer do, or three or
/// four by factors at each.
pub(super) const MOST_STEPS: usize = 24;
/// Attempts of one remedy, of which one or two do where it is fit: rounds at one point or crossing, restarts, shifts, samples between two
/// friction values. After more of them another remedy takes over, or what is open is said.
pub(super) const MOST_ATTEMPTS: usize = 8;
