//! The continuum reference against independent knowledge: Bessel functions, rigid rotation, and the published Table 1 (Brunetti, Massi,
//! Saulot, Renouf, D'Ambrogio, "System dynamic instabilities induced by sliding contact").

use crate::continuum;
use crate::continuum::bessel::{determinant, of_real_argument, root_near};
use crate::convergence::rates::{DISC as FITTED, NORMAL_STIFFNESS, RAYLEIGH};
use crate::prelude::*;

/// The disc of the paper with rounded material data; `FITTED` is as it fits Table 1.
const DISC: Annulus = Annulus { poisson_ratio: 0.38, ..FITTED };

/// Radius of the node `i` of the spectral element.
fn radius(i: usize) -> f64 {
    let middle = 0.5 * (DISC.inner_radius + DISC.outer_radius);
    let half = 0.5 * (DISC.outer_radius - DISC.inner_radius);
    middle - half * (PI * i as f64 / continuum::DEGREE as f64).cos()
}

fn table_1_reference(annulus: &Annulus, contact: &Contact) -> Vec<Eigenvalue> {
    let of_row = |&(real, _, harmonic, branch): &(f64, f64, usize, usize)| {
        let is_partner =
            |own: &&(f64, f64, usize, usize)| (own.2, own.3) == (harmonic, branch) && own.0 != real;
        let partner = TABLE_1.iter().find(is_partner);
        let direction = partner.map_or(0, |other| if real > other.0 { -1 } else { 1 });
        annulus.branch(harmonic, branch, direction, contact, RAYLEIGH)
    };
    TABLE_1.iter().map(of_row).collect()
}

#[test]
fn frictionless_frequencies_are_roots_of_the_bessel_determinant() {
    // The determinant changes sign within 1e-10 of every spectral frequency: far above the 1e-13
    // of round-off, far below any discretisation error of the finite elements.
    let stress = Annulus { plane_strain: false, ..DISC };
    for annulus in [DISC, stress] {
        for contact in [
            Contact::rigid(0.0),
            Contact::penalty(0.0, 0.0),
            Contact::penalty(0.0, NORMAL_STIFFNESS),
        ] {
            for harmonic in 0..=6 {
                for kappa in annulus.kappas(harmonic, &contact).iter().take(4) {
                    let hz = kappa.re.sqrt() / TAU;
                    let [below, above] = [-1e-10, 1e-10].map(|shift| {
                        let omega = c64::new(TAU * hz * (1.0 + shift), 0.0);
                        determinant(&annulus, harmonic, &contact, omega, of_real_argument).re
                    });
                    assert!(below * above < 0.0, "n = {harmonic}, {hz} Hz: no root");
                }
            }
        }
    }
}

#[test]
fn eigenvalues_with_friction_are_complex_roots_of_the_bessel_determinant() {
    for contact in [Contact::rigid(0.3), Contact::penalty(0.3, NORMAL_STIFFNESS)] {
        for harmonic in 0..=6 {
            for kappa in FITTED.kappas(harmonic, &contact).iter().take(3) {
                let omega = kappa.sqrt();
                near_each(&[root_near(&FITTED, harmonic, &contact, omega)], &[omega], 1e-9);
            }
        }
    }
}

#[test]
fn eigenvalues_do_not_depend_on_the_polynomial_degree() {
    let contact =
        Contact { prestress_interference: Some(25e-6), ..Contact::penalty(0.3, NORMAL_STIFFNESS) };
    for harmonic in 0..=6 {
        let reference = FITTED.kappas(harmonic, &contact);
        for degree in [20, 30] {
            let other = FITTED.kappas_at_degree(harmonic, &contact, degree);
            near_each(&other[..4], &reference[..4], 1e-10);
        }
    }
}

#[test]
fn the_published_table_is_reproduced() {
    // The fit's own quality with rounded constants: 0.18 % and 0.058 % rms in frequency; 10 Hz in
    // real part for the pair of modes 20 and 21, 5.2 Hz for all others (the paper prints 1 Hz and 0.1 Hz).
    let contact = Contact::penalty(0.3, NORMAL_STIFFNESS);
    let mut squares = 0.0;
    for (row, mode) in table_1_reference(&FITTED, &contact).iter().enumerate() {
        let (real, frequency, ..) = TABLE_1[row];
        let relative = mode.frequency_hz() / frequency - 1.0;
        let difference = mode.real_hz() - real;
        squares += relative * relative;
        let bound = if row == 19 || row == 20 { 10.0 } else { 5.2 };
        assert!(relative.abs() < 1.8e-3, "mode {}: {relative}", row + 1);
        assert!(difference.abs() < bound, "mode {}: {difference}", row + 1);
        // Mode 26 lies on the stability boundary at mu = 0.3: its sign means nothing.
        let is_unstable = [3, 5, 7].contains(&(row + 1));
        assert!(row == 25 || (mode.lambda.re > 0.0) == is_unstable, "mode {}", row + 1);
    }
    let rms = (squares / TABLE_1.len() as f64).sqrt();
    below(rms, 5.8e-4, "rms");
}

#[test]
fn frequency_splits_show_damping_acting_through_friction() {
    // Table 1 prints pair splits of 5, 17 and 23 Hz for modes 2/3, 4/5 and 6/7.
    let contact = Contact::penalty(0.3, NORMAL_STIFFNESS);
    for (harmonic, branch, split) in [(1, 1, 5.0), (2, 1, 17.0), (1, 2, 23.0)] {
        let [forward, backward] = [1, -1].map(|direction| {
            FITTED.branch(harmonic, branch, direction, &contact, RAYLEIGH).frequency_hz()
        });
        // Two frequencies rounded to 1 Hz.
        assert!((backward - forward - split).abs() < 1.0);
    }
}

#[test]
fn critical_frictions_are_those_of_the_continuum_model() {
    let contact = Contact::penalty(0.0, NORMAL_STIFFNESS);
    for (mode, harmonic, branch, expected, digit) in [
        (7, 1, 2, 0.1224, 5e-5),
        (5, 2, 1, 0.1382, 5e-5),
        (3, 1, 1, 0.2121, 5e-5),
        (26, 2, 3, 0.301, 5e-4),
    ] {
        let critical = FITTED.critical_friction(harmonic, branch, &contact, RAYLEIGH, 1.0).unwrap();
        below((critical - expected).abs(), 1.02 * digit, format_args!("mode {mode}"));
    }
}

#[test]
fn steady_sliding_gives_the_known_pressure_and_torque() {
    let state = DISC.prestress(25e-6, 0.3);
    assert!((state.pressure - 2.827e6).abs() < 500.0, "{state:?}");
    assert!((state.torque - 2239.0).abs() < 0.5, "{state:?}");
    // 141 kW/m at 600 rpm.
    within(&[state.torque * 600.0 / 60.0 * TAU], &[141e3], 500.0);
}

#[test]
fn exact_steady_state_is_the_static_solution_of_the_spectral_element() {
    // Ties the signs of the n = 0 stiffness to those of the closed-form field: residual forces at
    // the inner edge are a p and, along e_theta (row W: times -i), a tau.
    let state = DISC.prestress(25e-6, 0.3);
    let degree = continuum::DEGREE;
    let (stiffness, _) = DISC.unconstrained_pencil(0, &Contact::rigid(0.0), degree);
    let field = (0..=degree).map(|i| state.displacement(radius(i)));
    let field: Vec<c64> = field.flat_map(|[u, w]| [c64::new(u, 0.0), c64::new(0.0, -w)]).collect();
    let force = |row: usize| -> c64 {
        (0..field.len()).map(|column| stiffness[(row, column)] * field[column]).sum()
    };
    let scale = DISC.inner_radius * state.pressure;
    for row in 0..2 * degree {
        let expected = match row {
            0 => c64::new(scale, 0.0),
            1 => c64::new(0.0, -DISC.inner_radius * state.shear),
            _ => c64::new(0.0, 0.0),
        };
        // 1/r is no polynomial: its interpolant's slope is off by degree^2 2.8^-degree = 1e-8.
        below((force(row) - expected).norm() / scale, 1e-6, row);
    }
}

#[test]
fn a_rigid_rotation_leaves_the_prestressed_inner_edge_in_balance() {
    // Objectivity: u_theta = r turns body, pressure and traction together; only the rows of the clamped outer edge may see a force. Without
    // the turning of the contact forces the residual would be p itself.
    let contact = Contact { prestress_interference: Some(25e-6), ..Contact::rigid(0.3) };
    let degree = continuum::DEGREE;
    let (stiffness, _) = DISC.unconstrained_pencil(0, &contact, degree);
    let pressure = DISC.prestress(25e-6, 0.3).pressure;
    for row in 0..2 * degree {
        let residual: c64 = (0..=degree).map(|i| stiffness[(row, 2 * i + 1)] * radius(i)).sum();
        // Round-off of entries of size degree^2 G against p a = 6e4.
        below(residual.norm(), 1e-6 * pressure * DISC.inner_radius, row);
    }
}
