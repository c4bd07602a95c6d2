//! Lossy assemblies that slide slowly: friction across the sliding overdamps motions, and losses give these an imaginary part, too.

use super::*;

/// Damping factor below which no mode may be missing.
const LIGHT: f64 = 0.5;

fn holds(all: &[c64], own: &c64) -> bool {
    all.iter().any(|other| (other - own).norm() < 1e-8 * own.norm())
}

/// Independent check: dense complex matrices. What is listed is in their spectrum, and of that nothing is missing below the highest mode
/// listed that is damped by less than half the critical.
#[test]
fn lists_of_lossy_modes_have_no_gaps_however_slow_the_sliding() {
    let mut blocks = stacked(0.0);
    (blocks[0].counts, blocks[1].counts) = ([3, 3, 1], [3, 2, 2]);
    let mesh = mesh_of(&file_of(&blocks, |point| point), &PRESSED);
    for (rotation_speed, loss_factor) in [(10.0, 0.3), (0.3, 0.05), (0.3, 0.3), (0.02, 0.15)] {
        let mut contact = sliding(&mesh, Some(1e14));
        contact.stiffness.loss_factor = loss_factor;
        let motion = Motion { rotation_speed, ..aside(&mesh) };
        let steel = ElasticMaterial { loss_factor: 0.3 * loss_factor, ..STEEL };
        let assembly =
            Assembly::new(&mesh, &steel, (&[], &[contact]), (&[motion], Solved), Consistent)
                .unwrap();
        let options = TangentOptions { damping: rayleigh_damping(100.0, 1e-8), ..OPTIONS };
        let tangent = tangent_at(&assembly, 0.5, &options);
        let exact = dense_eigenvalues(&tangent, 0.5);
        for count in 4..9 {
            let listed = eigenvalues_of(&modes_at(&tangent, 0.5, Lowest(count)));
            let named = format!("{rotation_speed} rad/s, loss factor {loss_factor}, {count} modes");
            assert!(listed.len() >= count, "{named}: {listed:?}");
            assert!(listed.iter().all(|own| holds(&exact, own)), "{named}: {listed:?}");
            let top = listed.iter().fold(0.0_f64, |top, own| top.max(own.im));
            let light = exact.iter().filter(|own| own.im < top && -own.re / own.norm() < LIGHT);
            for own in light {
                assert!(holds(&listed, own), "{named}: {own} is not in {listed:?}");
            }
        }
    }
}
