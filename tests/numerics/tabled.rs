//! Modulus and loss factor over frequency: every mode at its own frequency, against dense matrices frozen there.

use crate::prelude::*;
use crate::structural_damping::{eigenvalues, follow_differences, two_unknowns};

/// A modulus that rises fivefold over the modes of the disc, with much damping.
fn rubber(scale: f64) -> Vec<[f64; 3]> {
    let rows = [[100.0, 1.0, 0.05], [2e3, 1.6, 0.3], [5e3, 2.8, 0.5], [9e3, 4.0, 0.4]];
    rows.into_iter().chain([[3e4, 5.5, 0.2]]).map(|[f, e, eta]| [f, scale * e, eta]).collect()
}

/// The disc, whose modulus depends on frequency, on a deformable shaft of steel.
fn tangent(rows: Vec<[f64; 3]>, stiffness: ContactStiffness) -> SlidingTangent {
    let specification = on_shaft(annulus(Quad4, 16, 3), 1);
    let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
    let steel = ElasticMaterial { loss_factor: 0.002, ..crate::shaft::STEEL };
    let table = ModulusTable::new("materials.disc.table", "rubber.csv", rows);
    let disc = ElasticMaterial { young_modulus: table.static_modulus(), ..POLYCARBONATE };
    let disc = RegionMaterial { table: Some(Arc::new(table)), ..disc.into() };
    let materials = vec![disc, steel.into()];
    let damping = rayleigh_damping(20.0, 1e-7);
    let options =
        TangentOptions { geometric_stiffness: true, damping, contact: stiffness, ..TANGENT };
    linearized(&mesh, &materials, &contact(610.0), &options)
}

/// Independent check: dense companion matrices with the stiffness frozen at a found eigenvalue's own frequency have that eigenvalue,
/// and frozen at the limit as many below it as were found; at the critical friction there is no growth.
#[test]
fn every_mode_has_the_stiffness_of_its_own_frequency() {
    let springs = ContactStiffness { normal_stiffness: Some(2e12), loss_factor: 0.05, ..RIGID };
    for contact_stiffness in [ContactStiffness::default(), springs] {
        let tangent = tangent(rubber(1e9), contact_stiffness);
        let (frictions, limit_hz) = ([0.0, 0.3, 0.6, 0.9], 11000.0);
        let found = swept(&tangent, &frictions, MaxFrequency(limit_hz));
        for (point, &mu) in frictions.iter().enumerate() {
            let own = eigenvalues(&found, point);
            for lambda in &own {
                let frozen = tangent.at_frequency(lambda.im / TAU);
                // An eigenvalue is as good as the product of the errors of its vectors.
                below(largest_error(&dense_eigenvalues(&frozen, mu), &[*lambda]), 1e-8, mu);
            }
            let at_limit = dense_eigenvalues(&tangent.at_frequency(limit_hz), mu);
            let expected = at_limit.iter().filter(|v| v.im < TAU * limit_hz).count();
            assert_eq!(own.len(), expected, "{mu}");
        }
        for interval in &found.intervals {
            let omega = TAU * interval.frequency_hz;
            let frozen = tangent.at_frequency(interval.frequency_hz);
            let onset = dense_eigenvalues(&frozen, interval.critical_friction);
            below(largest_error(&onset, &[c64::new(0.0, omega)]), 1e-7, "onset");
        }
    }
}

/// Consistency check: derivatives by friction and by the modulus are differences of whole solutions, the stiffness following.
#[test]
fn derivatives_follow_the_frequency_of_the_mode() {
    let springs = ContactStiffness { normal_stiffness: Some(2e12), ..RIGID };
    let with = |more: f64| tangent(rubber(1e9 * (1.0 + more)), springs);
    // Central differences: the third derivative times the square of the step.
    let by_modulus = |_: f64, slope: f64| 1e-3 * slope;
    follow_differences(&with, 1e-3, [by_modulus, |value, slope| 1e-3 * slope + 1e-7 * value]);
}

/// Theory: the response at a line is that of the matrices frozen there.
#[test]
fn a_line_of_the_response_has_the_stiffness_of_its_frequency() {
    let tangent = tangent(rubber(1e9), ContactStiffness::default());
    let system = FrfSystem::sliding(&tangent, 0.3);
    let [(_, force), (_, response)] = two_unknowns(&system, &tangent);
    let lines = [500.0, 4000.0, 4001.0, 9000.0];
    let found = direct_response(&system, &force, &response, &lines, &|_| {}).unwrap();
    for (line, own) in lines.iter().zip(found) {
        let frozen = FrfSystem::sliding(&tangent.at_frequency(*line), 0.3);
        let expected = direct_response(&frozen, &force, &response, &[*line], &|_| {}).unwrap();
        // Round-off of two factorizations times the condition of the matrix.
        near_each(&[own], &expected, 1e-8);
    }
}

/// Theory (D. Ross, E. E. Ungar, E. M. Kerwin, in: Structural Damping, ASME 1959): a simply supported beam of two elastic faces `h` on
/// a viscoelastic core `c`, which shears alone,
///
/// ```text
/// -lambda^2 m = B (n pi / L)^4,   B = E h^3 / 6 + E h d^2 / 2 * g / (1 + g),   g = 2 G(f) (1 + i eta(f)) / (E h c (n pi / L)^2)
/// ```
///
/// with `d = h + c`, at the frequency of the mode itself.
#[test]
fn a_sandwich_beam_loses_what_ross_kerwin_and_ungar_say() {
    const LENGTH: f64 = 0.4;
    const FACE: f64 = 0.002;
    const CORE: f64 = 0.001;
    let rows = "1 4e6 0.3 ; 50 9e6 0.6 ; 200 16e6 0.8 ; 1000 30e6 0.9 ; 5000 60e6 0.7";
    let table = ModulusTable::new("materials.core.table", "core.csv", rows_of(rows));
    // Three layers of 20-node bricks; faces without Poisson's contraction are a beam.
    let mut file = block(Hex20, [40, 1, 3], |[x, y, z]| {
        let layers = [0.0, FACE, FACE + CORE, 2.0 * FACE + CORE];
        let (layer, share) = ((3.0 * z) as usize, (3.0 * z).fract());
        let top = layers[(layer + 1).min(3)];
        [LENGTH * x, 0.02 * y, layers[layer] + share * (top - layers[layer])]
    });
    for element in &mut file.elements {
        let middle: f64 = element.nodes.iter().map(|&n| file.points[n as usize][2]).sum();
        let middle = middle / element.nodes.len() as f64;
        let is_core = middle > FACE && middle < FACE + CORE;
        element.region = if is_core { "core" } else { "faces" }.into();
    }
    let sides = [("x0", true), ("x1", true), ("y0", false), ("y1", false)];
    let sides = sides.map(|(side, is_end)| (side, Fixed([false, !is_end, is_end])));
    // Nothing else holds the beam along itself: at 70 Hz it moves as a whole.
    let soft = support([0.0, 2e6, 0.0], [0.0, 0.0]);
    let held = [&sides[..], &[("z1", soft)]].concat();
    let mesh = solids_of(&file, &held);
    let solid = |e: f64, nu: f64, density: f64| elastic(e, nu, density, ThreeDimensional);
    let poisson_ratio = 0.3;
    let core = RegionMaterial {
        table: Some(Arc::new(table.clone())),
        ..solid(table.static_modulus(), poisson_ratio, 1000.0).into()
    };
    let face: RegionMaterial = solid(7e10, 0.0, 2700.0).into();
    let own = |name: &String| if name == "core" { core.clone() } else { face.clone() };
    let materials: Vec<RegionMaterial> = mesh.regions.iter().map(own).collect();
    let closed = BaseChoice::Closed;
    let assembly = Assembly::new(&mesh, &materials, (&[], &[]), (&[], closed), Consistent).unwrap();
    let options = TangentOptions { damping: RayleighDamping::default(), ..TANGENT };
    let tangent = crate::assemblies::tangent_at(&assembly, 0.0, &options);
    let found = eigenvalues_of(&modes_at(&tangent, 0.0, Lowest(5)));
    let mass = 2.0 * FACE * 2700.0 + CORE * 1000.0;
    for n in 1..=3 {
        let wave = f64::from(n) * PI / LENGTH;
        let rigidity = |frequency_hz: f64| {
            let [modulus, loss_factor] = table.at(frequency_hz);
            let shear = c64::new(1.0, loss_factor) * (modulus / (2.0 * (1.0 + poisson_ratio)));
            let stretch = 7e10 * FACE;
            let g = shear * 2.0 / (stretch * CORE * wave * wave);
            let apart = FACE + CORE;
            7e10 * FACE.powi(3) / 6.0 + g / (g + 1.0) * (0.5 * stretch * apart * apart)
        };
        let mut lambda = c64::new(0.0, TAU * 50.0);
        for _ in 0..100 {
            lambda = c64::I * (rigidity(lambda.im / TAU) * (wave.powi(4) / mass)).sqrt();
        }
        let own = *nearest_by(&found, |own| (**own - lambda).norm());
        let [found, expected] = [own, lambda].map(|value| {
            let square = value * value;
            [value.im, square.im.abs() / square.re.abs()]
        });
        // The theory leaves out shear of the faces, rotatory inertia and stretch of the core.
        near_each(&found, &expected, 0.01);
    }
}

const RUBBER: &str = include_str!("../commands/refused/rubber.csv");

/// A block of steel on one of rubber that stands on the ground; both move along z alone.
fn mount(name: &str, table: &str) -> Case {
    let block = |name, z: f64, high| brick(name, [0.0, 0.0, z], [0.02, 0.02, high], [2, 2, 2]);
    let mesh = file_of(&[block("rubber", 0.0, 0.01), block("mass", 0.01, 0.02)], |point| point);
    let files = [("mount.msh", &mesh[..]), ("rubber.csv", table.as_bytes())];
    case_beside(name, &files, include_str!("../commands/refused/mount.toml"), AS_IT_IS)
}

/// Closed form: `lambda^2 m + k(f) (1 + i eta(f)) = 0`, `k = E A / h` and a third of the rubber's mass; the file's hash follows it.
#[test]
fn a_rubber_mounted_mass_moves_at_the_modulus_of_its_own_frequency() {
    let case = mount("mount", RUBBER);
    assert!(case.warnings.is_empty(), "{:?}", case.warnings);
    let found = modes_and_onsets(&case).unwrap().points[0].modes[0].eigenvalue;
    let table = case.materials().table(case.body.materials.len() - 1);
    let table = table.or_else(|| case.materials().table(0)).unwrap();
    let area = 0.02_f64.powi(2);
    let mass = 7850.0 * area * 0.02 + 25.0 * area * 0.01 / 3.0;
    let mut lambda = c64::new(0.0, 1e3);
    for _ in 0..200 {
        let [modulus, loss_factor] = table.at(lambda.im / TAU);
        let stiffness = c64::new(1.0, loss_factor) * (modulus * area / 0.01);
        lambda = c64::new(0.0, 1.0) * (stiffness / mass).sqrt();
    }
    // The steel gives way by a ten-thousandth.
    assert!((found - lambda).norm() < 2e-4 * lambda.norm(), "{found} {lambda}");
    assert_ne!(case.raw.hash(), mount("another-mount", &RUBBER.replace("0.45", "0.46")).raw.hash());
}
