//! Parts of a body of revolution that have materials of their own.

use crate::prelude::*;

/// A disc on a cylinder, free of prestress in its modes; parts and analysis follow.
pub const SOLID_RING: &str = include_str!("../../cases/solid-ring.toml");

/// Consistency check: a part of the material of the rest changes nothing; one of steel does.
#[test]
fn a_part_of_the_same_material_is_none() {
    let same = "[materials.ring]\nradii = [0.03, 0.04]\nyoung_modulus = 2.5e9\n\
                poisson_ratio = 0.38\ndensity = 1228.0\n";
    // A steel ring within the middle third of the radii, in the lower layer.
    let steel = "[materials.ring]\nradii = [0.03, 0.04]\nheights = [0.0, 0.005]\n\
                 young_modulus = 2e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";
    let [uniform, same, steel] = ["", same, steel].map(|parts| {
        let case = case_of("disc.toml", &format!("{SOLID_RING}{parts}"), AS_IT_IS);
        let points = modes_and_onsets(&case).unwrap().points;
        sorted(points[0].modes.iter().map(|mode| mode.eigenvalue.im))
    });
    near_each(&uniform, &same, 1e-9);
    assert!((steel[0] / uniform[0] - 1.0).abs() > 0.01);
}
