//! Stability along a branch of limit cycles.

use frictionsim_physics::cycle::{
    LimitCycle, MeshStepping, Parameter, StabilityChange, SteppedCycle, Verdict, differing,
};

/// Cycles whose exponents are found one after the other, each from its neighbour's; the groups run in parallel.
const GROUP: usize = 8;

/// Stability of every cycle of a branch, settled in the transient. Where a wave only scales from one cycle to the next,
/// its stability is the same. The cycles stay what they are: their powers are those of the wave, whose balance is
/// exact, while the few periods of a transient that settles still lose or gain some energy.
pub fn along(
    stepping: &MeshStepping<'_>,
    cycles: &[LimitCycle],
) -> Vec<Result<SteppedCycle, String>> {
    let is_scaled = |a: &LimitCycle, b: &LimitCycle| {
        let drift = a.state.frequency() / b.state.frequency() - 1.0;
        a.state.contact == b.state.contact && drift.abs() < 1e-9
    };
    let settled: Vec<Vec<Result<SteppedCycle, String>>> =
        frictionsim_physics::parallel::map(cycles.chunks(GROUP), |group| {
            let mut done: Vec<Result<SteppedCycle, String>> = Vec::new();
            let mut before: Option<(&LimitCycle, SteppedCycle)> = None;
            for cycle in group {
                let found = match &before {
                    Some((own, settled)) if is_scaled(own, cycle) => Ok(settled.scaled_to(cycle)),
                    _ => {
                        let neighbour = before.as_ref().map(|(_, settled)| settled);
                        stepping.settle(cycle, neighbour).map_err(|error| error.to_string())
                    }
                };
                if let Ok(settled) = &found {
                    before = Some((cycle, settled.clone()));
                }
                done.push(found);
            }
            done
        });
    settled.into_iter().flatten().collect()
}

/// Where neighbours along a branch differ in stability for sure.
pub fn changes(
    stepping: &MeshStepping<'_>,
    parameter: Parameter,
    settled: &[Result<SteppedCycle, String>],
) -> Vec<StabilityChange> {
    let known = settled.iter().flatten();
    let pairs = differing(known.map(|own| (own.stability.verdict().is_stable(), own)));
    let found: Vec<_> = frictionsim_physics::parallel::map(pairs, |[first, second]| {
        let is_first = first.stability.verdict() == Verdict::Stable;
        let (stable, unstable) = if is_first { (first, second) } else { (second, first) };
        stepping.stability_change(parameter, stable, unstable).ok()
    });
    found.into_iter().flatten().collect()
}
