//! Derivatives of the branches of bodies that are solved harmonic by harmonic.

use crate::prelude::*;
use frictionsim::cea::cyclic::{Beside, WavePair, wave_pairs, wave_responses};

/// Step of a parameter relative to its value.
pub const STEP: f64 = 1e-3;

/// The eigenpairs of the branches that oscillate at a friction coefficient.
pub fn pairs(tangent: &WaveTangent, branches: &[ModeBranch], friction: f64) -> Vec<WavePair> {
    let there = branches.iter().filter(|branch| branch.interpolate(friction).is_some());
    let wanted: Vec<_> = there.map(|branch| (branch, friction)).collect();
    wave_pairs(tangent, &wanted).into_iter().map(Option::unwrap).collect()
}

/// Their derivatives by a parameter, of which `at` has the model where it is so much more.
pub fn rates(pairs: &[WavePair], step: f64, at: &dyn Fn(f64) -> WaveTangent) -> Vec<c64> {
    let weights = [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)];
    let sides = weights.map(|(steps, weight)| Beside {
        weight: weight / (12.0 * step),
        tangent: at(steps * step),
        friction_shift: 0.0,
    });
    wave_responses(&pairs.iter().collect::<Vec<_>>(), &sides).unwrap()
}

/// Whether a branch is that of a pair.
pub fn is_of(pair: &WavePair) -> impl Fn(&&ModeBranch) -> bool {
    let name = (pair.harmonic, pair.branch, pair.direction);
    move |branch| (branch.harmonic, branch.branch, branch.direction) == name
}
