//! Friction that falls with the slip speed: the law at one node, the classical stick-slip oscillator, the disc at
//! speeds far above. Independent checks (closed forms, finite differences, the other half of the program), unless a
//! test says otherwise.

use crate::prelude::*;
pub mod block;
mod node;

/// Theory: far above the decay speed friction is constant.
#[test]
fn far_above_the_decay_speed_the_spectrum_is_that_of_constant_friction() {
    let specification = annulus(ElementKind::Quad4, 36, 6);
    let decay = Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.03 });
    let fast = SlidingContact { decay, ..falling(610.0) };
    let options = TangentOptions { geometric_stiffness: true, ..TANGENT };
    let request = sweep_request(&[0.2, 0.4], ModeLimit::Lowest(18));
    let [fast, constant] = [fast, SlidingContact { decay: None, ..fast }].map(|contact| {
        let found = cyclic::sweep(&specification, &POLYCARBONATE, &options, &contact, &request);
        found.unwrap().sweep
    });
    assert_same(&fast, &constant, [1e-9, 1e-8], "constant friction");
}
