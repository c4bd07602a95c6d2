//! Modes of projected matrices whose stiffness depends on frequency, each at its own frequency.

use crate::cea::sparse::*;

/// The modes, by rising frequency, without derivatives and scale: at most as many as `frozen` gives at one frequency in Hz.
///
/// The `i`-th mode of the problem frozen at `f`, in the order of frequencies `f_i(f)`, has a fixed point `f_i(f) = f`, one for each
/// `i` as long as stiffness rises less than with the square of the frequency: as many modes lie below `f` as the frozen problem has
/// below `f`. Each is sought from its vectors at `start_hz` by Rayleigh quotients on the nonlinear problem; where that ends at a
/// mode found already, or not at all, by the fixed point left over. A mode that does not settle is given as it is: its residual tells.
pub(super) fn solve(
    at: &ProjectedMatrices,
    frozen: &(dyn Fn(f64) -> Result<Vec<ReducedMode>, LinalgError> + Sync),
    start_hz: f64,
) -> Result<Vec<ReducedMode>, LinalgError> {
    let start = frozen(start_hz)?;
    let mut found: Vec<Option<ReducedMode>> =
        crate::parallel::map(&start, |mode| at.mode_near(mode));
    for i in 1..found.len() {
        let is_known = |own: &ReducedMode| own.is_among(found[..i].iter().flatten());
        if found[i].as_ref().is_some_and(|own| own.eigenvalue.im <= 0.0 || is_known(own)) {
            found[i] = None; // Two starts may end at one mode.
        }
    }
    for i in 0..found.len() {
        if found[i].is_none() {
            found[i] = fixed_point(at, frozen, (i, &start[i]), &found)?;
        }
    }
    let mut modes: Vec<ReducedMode> = found.into_iter().flatten().collect();
    crate::order::sort_by_number(&mut modes, |p| p.eigenvalue.im);
    Ok(modes)
}

/// A mode that is not found yet, if there is one, sought from one place in the order of frequencies on. Modes pass each other as
/// stiffness rises: the place left over is below one with fewer found modes below it than places, else above.
fn fixed_point(
    at: &ProjectedMatrices,
    frozen: &(dyn Fn(f64) -> Result<Vec<ReducedMode>, LinalgError> + Sync),
    (mut place, start): (usize, &ReducedMode),
    found: &[Option<ReducedMode>],
) -> Result<Option<ReducedMode>, LinalgError> {
    let is_new = |mode: &ReducedMode| !mode.is_among(found.iter().flatten());
    let mut mode = start.clone();
    let mut frequency_hz = mode.eigenvalue.im / TAU;
    for pass in 0..2 * MOST_STEPS {
        let all = frozen(frequency_hz)?;
        let Some(own) = all.get(place) else { break };
        mode = own.clone();
        let mut next = mode.eigenvalue.im / TAU;
        let is_settled = (next - frequency_hz).abs() <= NEAR * next;
        if is_settled && let Some(fine) = at.mode_near(&mode) {
            if is_new(&fine) {
                return Ok(Some(fine));
            }
            let equal = (1.0 - SAME_EIGENVALUE) * fine.eigenvalue.im; // Those of its own frequency are not below it.
            let below = found.iter().flatten().filter(|p| p.eigenvalue.im < equal);
            place = if below.count() < place { place - 1 } else { place + 1 };
            next = all.get(place).map_or(next, |own| own.eigenvalue.im / TAU);
        }
        // Whole steps, then half ones.
        frequency_hz = if pass < MOST_STEPS { next } else { 0.5 * (next + frequency_hz) };
    }
    Ok(Some(mode).filter(is_new))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{Mat, c64};

    /// Starts that pass each other on the way leave a place that is not their own, below or above; a start too many leaves none.
    #[test]
    fn the_mode_that_no_start_leads_to_is_found() {
        let diagonal = |of: [f64; 3]| Mat::from_fn(3, 3, |i, j| if i == j { of[i] } else { 0.0 });
        let at = ProjectedMatrices {
            stiffness: diagonal([1.0, 4.0, 9.0]),
            damping: diagonal([0.01; 3]),
            mass: diagonal([1.0; 3]),
            losses: Vec::new(),
        };
        let mode = |i: usize| {
            let omega = i as f64 + 1.0;
            let own: Vec<c64> =
                (0..3).map(|j| c64::new(f64::from(u8::from(i == j)), 0.0)).collect();
            let zero = c64::new(0.0, 0.0);
            ReducedMode {
                eigenvalue: c64::new(-0.005, (omega * omega - 2.5e-5).sqrt()),
                derivative: zero,
                right: own.clone(),
                left: own,
            }
        };
        for starts in [vec![0, 2, 2], vec![1, 1, 2], vec![0, 0, 1], vec![2, 2, 2], vec![0, 1, 2, 2]]
        {
            let frozen = |frequency_hz: f64| {
                let all = if frequency_hz == 100.0 { starts.clone() } else { vec![0, 1, 2] };
                Ok(all.into_iter().map(mode).collect())
            };
            let found = solve(&at, &frozen, 100.0).unwrap();
            let places: Vec<u32> =
                found.iter().map(|own| own.eigenvalue.im.round() as u32).collect();
            assert_eq!(places, [1, 2, 3], "{starts:?}");
        }
    }
}
