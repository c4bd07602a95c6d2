//! Friction that falls with the slip speed: the law at one node, the classical stick-slip oscillator, the disc at speeds far above.
//! Independent checks (closed forms, finite differences, the other half of the program), unless a test says otherwise.

use crate::prelude::*;
pub mod block;
mod node;

/// Theory: far above the decay speed friction is constant.
#[test]
fn far_above_the_decay_speed_the_spectrum_is_that_of_constant_friction() {
    let decay = Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.03 });
    let fast = SlidingContact { decay, ..falling(610.0) };
    let [fast, constant] = [fast, SlidingContact { decay: None, ..fast }].map(|contact| {
        let mut model = WaveModel { contact, ..paper(Quad4, 36, 6) };
        model.options.contact = RIGID;
        model.swept(&[0.2, 0.4], Lowest(18)).sweep
    });
    assert_same(&fast, &constant, [1e-9, 1e-8], "constant friction");
}
