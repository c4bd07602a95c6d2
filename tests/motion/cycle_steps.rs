//! Limit cycles of bodies without symmetry: the same from every time step, each named once.
//!
//! Independent: the frequency of a transient. The others hold the search to itself.

use crate::prelude::*;

/// A plane block of a size and so many squares, held at its back by springs `[normal, tangential]` (Pa/m) and pressed on a moving
/// plane, with its damping by stiffness, the speed and the interference.
struct PlaneBlock([f64; 2], [usize; 2], [f64; 2], [f64; 3]);

impl PlaneBlock {
    fn cycles(&self, overrides: &[&str]) -> Vec<PeriodicResult> {
        let Self(size, counts, [normal, tangential], [damping, speed, interference]) = *self;
        let mesh = plane_block(size, counts, ["face", "back", "block"]);
        let own = format!(
            "boundaries.back.normal_stiffness={normal:?} ; \
             boundaries.back.tangential_stiffness={tangential:?} ; \
             damping.stiffness_coefficient={damping:?} ; contact.speed={speed:?} ; \
             contact.interference={interference:?}"
        );
        let text = include_str!("../cases/plane-block-on-springs.toml");
        cycles(&mesh, text, &[&[own.as_str()], overrides].concat())
    }
}

fn cycles(mesh: &[u8], text: &str, overrides: &[&str]) -> Vec<PeriodicResult> {
    let folder = folder();
    fs::write(folder.path().join("body.msh"), mesh).unwrap();
    crate::oscillator::cycles(&case_of(folder.path().join("case.toml"), text, overrides))
}

fn frequency(results: &[PeriodicResult], mode: usize) -> f64 {
    let own = results.iter().find(|result| result.name.mode.mode == mode).unwrap();
    own.outcome.as_ref().unwrap().motion.frequency_hz
}

/// Mode 8 grows into the cycle of mode 5, in steps of its own.
#[test]
fn a_motion_that_two_modes_lead_to_is_listed_once_at_every_time_step() {
    let springs = [154_441_363_118.673_68, 77_087_331_589.532_04];
    let block = PlaneBlock([0.2, 0.08], [17, 7], springs, [1e-6, 1.0, 3e-5]);
    let steps: [&[&str]; 3] = [&[], &["transient.time_step=2e-6"], &["transient.time_step=1e-6"]];
    for step in steps {
        let results = block.cycles(step);
        let listed = results.iter().map(|own| (own.name.mode.mode, own.name.same_as));
        assert!(listed.eq([(5, None), (8, Some(5)), (11, None)]), "{step:?}");
    }
}

/// After no time at all every motion repeats itself: mode 11 ended at 2.8e10 Hz.
#[test]
fn a_period_of_no_time_is_no_limit_cycle() {
    let springs = [438_689_779_033.696_66, 697_676_614_630.444_1];
    let block = PlaneBlock([0.3, 0.2], [20, 13], springs, [4.5e-7, 0.5, 1e-5]);
    for result in block.cycles(&[]) {
        let found = result.outcome.unwrap().motion.frequency_hz;
        let ratio = found / result.name.mode.mode_frequency_hz;
        assert!((0.25..4.0).contains(&ratio), "{}: {ratio}", result.name.mode);
    }
}

/// The automatic step led mode 5 to 7404 Hz, the cycle of mode 6; finer ones to 10,065 Hz.
#[test]
fn the_cycle_of_a_mode_does_not_depend_on_the_time_step() {
    let springs = [214_913_034_420.552_76, 116_363_535_283.640_61];
    let block = PlaneBlock([0.3, 0.08], [20, 5], springs, [1e-7, 0.3, 1e-5]);
    let [automatic, fine]: [Vec<_>; 2] =
        [&[][..], &["transient.time_step=1e-6"]].map(|step| block.cycles(step));
    for mode in [5, 6] {
        near(frequency(&automatic, mode), frequency(&fine, mode), 2e-3);
    }
}

/// The transient of 0.1 s in steps of 1e-6 s from noise settles at 7037.17 Hz.
#[test]
fn a_cycle_under_falling_friction_is_found_at_the_automatic_step_where_the_transient_has_it() {
    let block = brick("block", [0.0; 3], [0.06, 0.04, 0.02], [6, 2, 2]);
    let text = include_str!("../cases/block-under-falling-friction.toml");
    near(frequency(&cycles(&file_of(&[block], |point| point), text, &[]), 2), 7037.17, 1e-3);
}
