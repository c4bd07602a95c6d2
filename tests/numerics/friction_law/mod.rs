//! Friction that falls with the slip speed: the law at one node, the classical stick-slip oscillator, the disc in
//! every analysis. Independent checks (closed forms, finite differences, the other half of the program), unless a
//! test says otherwise.

use crate::disc;
use crate::prelude::*;
pub mod block;
mod case;
mod growth;
mod node;
mod spectrum;

/// The paper's cylinder with friction that falls over speeds of the order of its own, 1.31 m/s at 610 rpm.
pub fn falling(rotation_speed_rpm: f64) -> SlidingContact {
    SlidingContact {
        decay: Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.8 }),
        ..disc::contact(rotation_speed_rpm)
    }
}
