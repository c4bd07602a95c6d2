//! Contact of plane bodies that stiffens with pressure.

use crate::friction_law::block::{MASS, STEEL, WIDTH, block};
use crate::prelude::*;

pub const LAWS: [NormalLaw; 2] = [exponential(2e5, 4e-6), cubic(2e11, 1e22)];

/// Closed form: disc and interface share the interference, so that the pressure is that of rigid contact in the share of the
/// disc, `p(g) = p_0 (delta - g) / delta`.
#[test]
fn disc_and_interface_share_the_interference() {
    let specification = annulus(Quad4, 48, 12);
    let sector = Strip::of_annulus(&specification).unwrap();
    let sliding = contact(610.0);
    let elastic = sector.stiffness_alike(&POLYCARBONATE);
    let rigid = SectorSliding::solve(&sector, &elastic, &sliding, None).unwrap();
    let width = sector.mesh.contact_edge().tributary_lengths[0];
    for law in LAWS {
        let own = SectorSliding::solve(&sector, &elastic, &sliding, Some(law)).unwrap();
        let pressure = own.state.normal_forces[0][0] / width;
        let share = 1.0 - law.approach(pressure) / sliding.interference;
        assert!(share > 0.05 && share < 0.95, "{law:?}: {share}");
        near(pressure, share * rigid.state.normal_forces[0][0] / width, 1e-12);
        let spring = own.state.stiffnesses[0][0] / width;
        near(spring, law.stiffness(law.approach(pressure)), 1e-12);
    }
}

/// Closed form: a rigid block of mass m on the springs under it, `omega^2 = dp/dg A / m` at the pressure that presses it, that is
/// `(p + p_r) A / (h m)` of the exponential law.
#[test]
fn the_frequency_of_a_block_follows_the_pressure_on_it() {
    let law = exponential(1e5, 5e-4);
    for pressure in [1e4, 1e5, 1e6] {
        let mesh = block(pressure);
        let sliding = sliding_at(0.0, 0.0, 1.0);
        let body = Assembly::of_edge(&mesh, &STEEL, &sliding, stiffening(law)).unwrap();
        let base = body.state(0.0).unwrap();
        for (force, point) in base.normal_forces(0.0).iter().zip(&body.contacts()[0].1.points) {
            near(force / point.weight, pressure, 2e-3);
        }
        let (damping, contact) = (RayleighDamping::default(), stiffening(law));
        let options = TangentOptions { damping, contact, ..TANGENT };
        let tangent = body.tangent(&base, &options).unwrap();
        let modes = modes_at(&tangent, 0.0, Lowest(3));
        let expected = ((pressure + 1e5) * WIDTH / (5e-4 * MASS)).sqrt();
        let apart = |mode: &ComplexMode| (mode.eigenvalue.im / expected - 1.0).abs();
        let nearest = modes.iter().map(apart).fold(f64::MAX, f64::min);
        // Steel gives way by less than a thousandth of what the springs do.
        assert!(nearest < 1e-3, "{pressure}: {nearest:e}");
    }
}
