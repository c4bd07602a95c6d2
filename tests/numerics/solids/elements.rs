//! Bricks: constant strain, objectivity, bending.

use super::*;
use frictionsim::fem::DofMap;
use frictionsim::fem::fold::WaveDofs;

/// Independent check: strains `xx`, `zx`, `zz` constant over the body cost no force inside. In waves around,
/// `u_x = x` is `(r, r, 0) / 2` at n = 2, `u_z = x` is `(0, 0, r)` and `u_x = z` is `(z, z, 0)` at n = 1, and `u_z = z` is n = 0.
#[test]
fn bricks_hold_every_constant_strain() {
    type Field = fn(&SheetNode) -> [f64; 3];
    let fields: [(usize, Field); 4] = [
        (2, |node| [node.radius, node.radius, 0.0]),
        (1, |node| [0.0, 0.0, node.radius]),
        (1, |node| [node.height, node.height, 0.0]),
        (0, |node| [0.0, 0.0, node.height]),
    ];
    for element in [Quad4, Quad8] {
        let model = disc(element, [12, 3, 3]);
        let sector = SolidSector::generate(&model.specification).unwrap();
        let strip = &sector.strip;
        let elastic = strip.folded(&assemble_stiffness(&strip.mesh, &model.material));
        let dofs = 3 * sector.node_count();
        let own = strip.wave_dofs();
        let all = WaveDofs::new(DofMap::excluding(dofs, []), own.half_bandwidth, own.sectors);
        for (n, field) in fields {
            let matrix = all.fold(n, 0, &elastic);
            let displacement: Vec<f64> = sector.nodes.iter().flat_map(field).collect();
            let force = matrix.multiply(&displacement);
            let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let [nr, nz] = sector.specification.divisions();
            for (k, node) in sector.nodes.iter().enumerate() {
                let [i, j] = node.place;
                let own = force[3 * k..3 * k + 3].iter().fold(0.0_f64, |m, f| m.max(f.abs()));
                let is_inside = i > 0 && i < 2 * nr && j > 0 && j < 2 * nz;
                // Rounding of a hundred terms.
                assert!(!is_inside || own < 1e-11 * largest, "{element:?} n = {n} {node:?}");
            }
        }
    }
}

/// Independent check (objectivity): a rigid rotation costs no force, with prestress and contact forces that turn with the body.
#[test]
fn rigid_rotation_leaves_the_prestressed_body_in_balance() {
    let edge = SolidContact::Inner;
    let ring = SolidContact::Ring { inner_radius: 0.04, outer_radius: 0.07 };
    for (element, contact) in [(Quad4, edge), (Quad4, ring), (Quad8, edge), (Quad8, ring)] {
        let mut model = disc(element, [12, 6, 2]);
        model.specification.contact = contact;
        let sector = SolidSector::generate(&model.specification).unwrap();
        let of = |geometric_stiffness| {
            let options = TangentOptions { geometric_stiffness, ..model.options };
            let (material, contact) = (&model.material, &model.contact);
            WaveTangent::of_revolution(&sector, material, &options, contact).unwrap()
        };
        let [with, without] = [true, false].map(of);
        let unknowns = with.dofs.unknown_of.iter().enumerate();
        let unknowns: Vec<_> = unknowns.filter_map(|(k, u)| Some((k, (*u)?))).collect();
        let mut rotation = vec![0.0; with.harmonic(0).stiffness[0].dimension()];
        for &(dof, unknown) in unknowns.iter().filter(|own| own.0 % 3 == 1) {
            rotation[unknown] = sector.nodes[dof / 3].radius;
        }
        // Neighbours of the clamped edge feel that it does not turn.
        let inner = |own: &&(usize, usize)| sector.nodes[own.0 / 3].place[0] + 2 < 12;
        let [with, without] = [with, without].map(|own| own.harmonic(0).stiffness);
        for (after, before) in with.iter().zip(&without) {
            let pairs = after.multiply(&rotation).into_iter().zip(before.multiply(&rotation));
            let change: Vec<f64> = pairs.map(|(a, b)| a - b).collect();
            let mut difference = after.clone();
            difference.add_scaled(-1.0, before);
            let scale = difference.values().iter().fold(0.0_f64, |m, v| m.max(v.abs())) * 0.09;
            for &(dof, unknown) in unknowns.iter().filter(inner) {
                // Each row sums a hundred terms of that size.
                assert!(change[unknown].abs() < 1e-10 * scale, "{element:?} {contact:?} {dof}");
            }
        }
    }
}

/// Independent check: plate theory (Leissa, Vibration of Plates, NASA SP-160, 1969: clamped outside, free inside, radii 1 : 2,
/// Poisson's ratio 1/3) gives `omega b^2 sqrt(rho h / D) = 17.715` for n = 0 and 22.015 for n = 1.
#[test]
fn bricks_of_8_and_20_nodes_bend_like_a_thin_plate() {
    for (element, divisions) in [(Quad4, [48, 16, 1]), (Quad8, [36, 14, 1])] {
        let mut model = disc(element, divisions);
        let (outer, thickness) = (0.1, 0.001);
        model.specification.annulus.inner_radius = 0.5 * outer;
        model.specification.annulus.outer_radius = outer;
        model.specification.thickness = thickness;
        model.material.poisson_ratio = 1.0 / 3.0;
        // As good as free.
        model.options.contact = ContactStiffness { normal_stiffness: Some(1.0), ..RIGID };
        let e = model.material.young_modulus;
        let rigidity = e * thickness.powi(3) / (12.0 * (1.0 - 1.0 / 9.0));
        let unit = (rigidity / (model.material.density * thickness)).sqrt() / (outer * outer) / TAU;
        let found = modes(&model, 0.0, 40.0 * unit);
        for (harmonic, factor) in [(0, 17.715), (1, 22.015)] {
            let mode = found.iter().find(|mode| mode.harmonic == harmonic).unwrap();
            near(mode.frequency_hz(), factor * unit, 0.01);
        }
    }
}

/// Theory: a frequency of a smooth motion converges with the fourth order of the element's size on bricks of 20 nodes, with the
/// second on those of 8. The twist `u_theta(r)` of a disc that is clamped outside and free of shear inside has the wave number
/// `k` of `J_2(ka) Y_1(kb) = Y_2(ka) J_1(kb)`.
#[test]
fn frequencies_converge_with_the_order_of_the_bricks() {
    let base = disc(Quad8, [12, 2, 1]);
    let [a, b] = [base.specification.annulus.inner_radius, base.specification.annulus.outer_radius];
    let residual =
        |k: f64| libm::jn(2, k * a) * libm::yn(1, k * b) - libm::yn(2, k * a) * libm::jn(1, k * b);
    let (mut low, mut high) = (3.0 / b, 5.0 / b);
    assert!(residual(low) * residual(high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_below = residual(low) * residual(middle) > 0.0;
        (low, high) = if is_below { (middle, high) } else { (low, middle) };
    }
    let modulus = base.material.young_modulus / (2.0 * (1.0 + base.material.poisson_ratio));
    let exact = low * (modulus / base.material.density).sqrt() / TAU;
    assert!((exact - 5855.0).abs() < 5.0, "{exact}");
    for (element, order) in [(Quad8, 4.0), (Quad4, 2.0)] {
        let errors = [1, 2, 4].map(|refined| {
            let mut model = disc(element, [12 * refined, 2 * refined, 1]);
            model.options.damping = RayleighDamping::default();
            let found = modes(&model, 0.0, 1.15 * exact);
            let distance = |mode: &&ComplexMode| (mode.frequency_hz() - exact).abs();
            let twists =
                found.iter().filter(|own| own.harmonic == 0 && own.axial_share < Some(1e-6));
            distance(&nearest_by(twists, distance)) / exact
        });
        let orders = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
        // Terms of the next order are a twentieth of the error on the finer pair.
        assert!(orders[1] > order - 0.2, "{element:?}: {errors:?}, {orders:?}");
    }
}
