//! Which of two motions wins on a body without symmetry.
//!
//! Independent: the unstable cycle between stable sliding and a stable cycle; waves of the annulus, read by their harmonics.

use crate::cycle_branch::over_speed;
use crate::prelude::*;
use frictionsim::study::basin::{boundary, boundary_of_modes};

fn cycle(case: &Case) -> FoundCycle {
    cycles(case).remove(0).outcome.unwrap()
}

fn bounds(found: &BasinBoundary) -> [f64; 2] {
    [found.low.unwrap(), found.high.unwrap()]
}

/// The kick that tips stable sliding into its cycle has the amplitude of the unstable cycle between both, to a tenth: a mode of
/// steady sliding is its start, and the motion on the edge has a shape of its own.
#[test]
fn a_kick_tips_sliding_into_its_cycle_at_the_amplitude_of_the_unstable_cycle() {
    let folder = folder();
    let whole = cycle(&over_speed(folder.path(), "none", 3.0, &[]));
    let [onset, fold] = whole.branch.unwrap().coexistence()[0];
    let speed = 0.5 * (onset + fold);
    let own = format!("contact.speed={speed}");
    let basin = "basin={ seed_ratio_from = 0.05, seed_ratio_to = 3.0, tolerance = 1.02 }";
    let case = over_speed(folder.path(), "none", 3.0, &[&own, basin]);
    let cycle = cycle(&case);
    let unstable = cycle.branch.as_ref().unwrap().threshold().unwrap();
    let found = boundary(&case, SimdLevel::detect()).unwrap();
    let [low, high] = bounds(&found);
    assert!(high / low < 1.02 && found.runs.iter().all(|run| run.is_settled));
    // In units of the amplitude at which a contact node sticks.
    let expected = unstable.amplitude * TAU * cycle.motion.frequency_hz / speed;
    assert!(low < 1.1 * expected && high > 0.9 * expected, "{low} {high} {expected}");
}

/// Two waves of the annulus, seeded and told apart by harmonics or by modes: the ratio at which the first node sticks decides in both.
#[test]
fn modes_of_an_annulus_compete_as_its_waves_do() {
    let coarse = "mesh.circumferential_elements=48 ; mesh.radial_elements=10 ; \
                  cea={ modes = 8, geometric_stiffness = false }";
    let case = shipped_case("basin.toml", &[coarse]);
    let simd = SimdLevel::detect();
    let waves = bounds(&boundary(&case, simd).unwrap());
    // The first to be the faster one, of one nodal diameter.
    let mut request = BasinRequest { periods: 10, ..case.require_basin().unwrap().clone() };
    let (mut rivals, _) = boundary_of_modes(&case, &request, simd).unwrap();
    rivals.sort_unstable_by(|a, b| b.cmp(a));
    request.modes = Some(rivals.to_vec());
    request.periods = 2000;
    let (numbers, found) = boundary_of_modes(&case, &request, simd).unwrap();
    assert_eq!(numbers, rivals);
    let modes = bounds(&found);
    // Each is known to the factor of its search.
    let factor = request.tolerance;
    assert!(modes[0] < waves[1] * factor && waves[0] < modes[1] * factor, "{waves:?} {modes:?}");
}
