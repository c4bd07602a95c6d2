//! Sparse solution of the whole mesh at each frequency.

use super::driven::Driven;
use super::system::check_frequencies;
use super::{FrfError, FrfSystem, Port};
use crate::linalg::c64;

/// Lines that share one real factorization ...
const LINES_AT_ONCE: usize = 8;
/// ... and one complex factorization, which costs several times as much.
const GENERAL_LINES_AT_ONCE: usize = 16;

/// Receptance `u / f` for each frequency, m/N for each metre of thickness, between two ports:
/// `h = e_response^T (K + i omega C - omega^2 M)^{-1} e_force`.
///
/// Neighbouring lines share one sparse factorization, real with proportional damping and complex with any other, and each is solved from it
/// in a Krylov space until its own backward error is that of round-off (`1e-14`); a line that does not get there has a sparse complex LU
/// factorization of its own, with one step of refinement. Frequencies in parallel, the result independent of the number of threads. For a
/// body of thickness `b` divide by `b`.
///
/// `done` hears how many lines are solved, a few at a time, from any thread.
///
/// # Errors
/// [`FrfError::Frequency`]; [`FrfError::Factorization`] where an undamped system is at resonance.
pub fn direct_response(
    system: &FrfSystem,
    force: &Port,
    response: &Port,
    frequencies_hz: &[f64],
    done: &(dyn Fn(usize) + Sync),
) -> Result<Vec<c64>, FrfError> {
    check_frequencies(frequencies_hz)?;
    let first = frequencies_hz.first().copied().unwrap_or(0.0);
    let driven = Driven::of(system, [force, response], first)?;
    let at_once = match system.proportional {
        Some(_) => LINES_AT_ONCE,
        None => GENERAL_LINES_AT_ONCE,
    };
    let solved =
        crate::parallel::map::<_, _, Result<Vec<_>, _>>(frequencies_hz.chunks(at_once), |lines| {
            // A stiffness of each line's own leaves nothing to share.
            let shared = match system.matrices.is_tabled() {
                true => vec![None; lines.len()],
                false => driven.solve_together(lines),
            };
            let solve =
                |(f, known): (&f64, Option<c64>)| known.map_or_else(|| driven.factorized(*f), Ok);
            let solved = lines.iter().zip(shared).map(solve).collect::<Result<Vec<c64>, _>>();
            done(lines.len());
            solved
        });
    Ok(solved?.concat())
}
