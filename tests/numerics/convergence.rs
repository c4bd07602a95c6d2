//! The finite elements converge to the exact continuum at their theoretical rate: slope 2 for Quad4,
//! 4 for Quad8, fitted by least squares over three meshes.
//!
//! Independent check: the reference (`continuum`) shares no discretisation with the program, and the
//! eigenvalues here come from a dense solve of one circumferential harmonic at a time, folded out of
//! the assembled sparse matrices, not from the program's own eigenvalue solvers.

mod folded;
pub mod rates;

use crate::continuum::prestress::SteadyState;
use crate::prelude::*;
use folded::{Discretisation, FORWARD, INTERFERENCE, Study, base_states, material};
use rates::{DISC, NORMAL_STIFFNESS, RAYLEIGH, assert_rate, rate, refinements};

const UNDAMPED: Rayleigh = (0.0, 0.0);

impl Study {
    fn assert_rates(&self, element: ElementKind) {
        let meshes = refinements(element)
            .map(|specification| Discretisation::new(&specification, self, FORWARD));
        let mut cancelled = 0;
        for harmonic in 0..=4 {
            let exact = self.annulus.eigenvalues(harmonic, &self.contact, self.rayleigh);
            let computed = [0, 1, 2].map(|level| meshes[level].eigenvalues(harmonic));
            let directions: &[i8] = if harmonic == 0 { &[0] } else { &[1, -1] };
            for (direction, branch) in directions.iter().flat_map(|&d| [(d, 0), (d, 1)]) {
                let pick = |modes: &[Eigenvalue]| {
                    let mut same = modes.iter().filter(|mode| mode.direction == direction);
                    same.nth(branch).expect("enough branches").lambda
                };
                let what = format!("n = {harmonic}, branch {branch}, direction {direction:+}");
                let what = format!("{:?}, {what}", self.contact);
                let errors = [0, 1, 2].map(|level| pick(&computed[level]) - pick(&exact));
                cancelled += self.assert_rates_of_one(element, &what, errors);
            }
        }
        // Of 36 parts; more would mean that the study asserts little.
        assert!(cancelled <= 2, "{cancelled} parts cancelled");
    }

    /// Asserts the rate of `|lambda_h - lambda|`, of the frequency and, with damping, of the real part.
    ///
    /// Where a branch's contributions to one part cancel to less than a hundredth of the whole error on each mesh, the rate of the whole
    /// bounds that part, and its own would be that of the next order. Returns the number of such parts.
    fn assert_rates_of_one(&self, element: ElementKind, what: &str, errors: [c64; 3]) -> usize {
        let whole = errors.map(|error| error.norm());
        assert_rate(element, &format!("eigenvalue, {what}"), whole);
        let mut parts = vec![("frequency", errors.map(|error| error.im))];
        if self.rayleigh != UNDAMPED {
            parts.push(("real part", errors.map(|error| error.re)));
        }
        let mut cancelled = 0;
        for (part, errors) in parts {
            if errors.iter().zip(&whole).all(|(e, w)| e.abs() < 0.01 * w) {
                println!("{element:?} {part}, {what}: cancels, errors {errors:.3?}");
                cancelled += 1;
            } else {
                assert_rate(element, &format!("{part}, {what}"), errors);
            }
        }
        cancelled
    }
}

fn with_prestress(contact: Contact) -> Contact {
    Contact { prestress_interference: Some(INTERFERENCE), ..contact }
}

/// Without friction, rigid, on a free edge; sliding, rigid and on springs; the same under prestress; plane stress.
fn assert_studies(element: ElementKind) {
    let [rigid, penalty] = [Contact::rigid(0.3), Contact::penalty(0.3, NORMAL_STIFFNESS)];
    for (contact, rayleigh) in [
        (Contact::rigid(0.0), UNDAMPED),
        (Contact::penalty(0.0, 0.0), UNDAMPED),
        (rigid, RAYLEIGH),
        (penalty, RAYLEIGH),
        (with_prestress(rigid), RAYLEIGH),
        (with_prestress(penalty), RAYLEIGH),
    ] {
        Study::of(contact, rayleigh).assert_rates(element);
    }
    let annulus = Annulus { plane_strain: false, ..DISC };
    Study { annulus, ..Study::of(penalty, RAYLEIGH) }.assert_rates(element);
}

#[test]
fn eigenvalues_of_quad4_converge_with_the_square_of_the_mesh_size_whatever_the_mass() {
    assert_studies(Quad4);
    Study { mass: Lumped, ..Study::of(Contact::rigid(0.3), RAYLEIGH) }.assert_rates(Quad4);
}

#[test]
fn eigenvalues_of_quad8_converge_with_the_fourth_power_of_the_mesh_size() {
    assert_studies(Quad8);
}

#[test]
fn the_discrete_model_turns_unstable_where_the_continuum_does() {
    // Modes 7, 5 and 3 of the paper. Quad8, 64 x 16: frequencies are right to 1e-4, so the critical friction is to about ten times that.
    let [specification, ..] = refinements(Quad8);
    for contact in [
        Contact::penalty(0.0, NORMAL_STIFFNESS),
        with_prestress(Contact::penalty(0.0, NORMAL_STIFFNESS)),
        with_prestress(Contact::rigid(0.0)),
    ] {
        let study = Study::of(contact, RAYLEIGH);
        let mut discrete = Discretisation::new(&specification, &study, FORWARD);
        for (harmonic, branch) in [(1, 2), (2, 1), (1, 1)] {
            let critical = DISC.critical_friction(harmonic, branch, &contact, RAYLEIGH, 1.0);
            let critical = critical.expect("an unstable branch");
            let growth = [0.999, 1.001].map(|factor| {
                discrete.friction_coefficient = factor * critical;
                let modes = discrete.eigenvalues(harmonic);
                let mut backward = modes.iter().filter(|mode| mode.direction == -1);
                backward.nth(branch - 1).expect("enough branches").lambda.re
            });
            let turns = growth[0] < 0.0 && growth[1] > 0.0;
            assert!(turns, "n = {harmonic}, branch {branch}, mu_c = {critical}: {growth:?}");
        }
    }
}

#[test]
fn a_reversed_rotor_mirrors_the_spectrum() {
    let [specification, ..] = refinements(Quad8);
    for contact in [Contact::rigid(0.3), Contact::penalty(0.3, NORMAL_STIFFNESS)] {
        let study = Study::of(with_prestress(contact), RAYLEIGH);
        let spectra = [FORWARD, -FORWARD]
            .map(|speed| Discretisation::new(&specification, &study, speed).eigenvalues(2));
        for (forward, reversed) in spectra[0].iter().zip(&spectra[1]).take(8) {
            // Directions are relative to +e_theta here, whichever way the rotor turns.
            assert_eq!(forward.direction, -reversed.direction);
            // Round-off of two different factorizations.
            near_each(&[reversed.lambda], &[forward.lambda], 1e-9);
        }
    }
}

#[test]
fn steady_sliding_converges_to_lame_and_the_shear_field() {
    let exact = DISC.prestress(INTERFERENCE, 0.3);
    const NAMES: [&str; 4] =
        ["radial displacement", "tangential displacement", "mean pressure", "torque"];
    for element in [Quad4, Quad8] {
        let errors = base_states(element).map(|(mesh, base)| {
            let [radial, tangential] = displacement_errors(&mesh, &base.displacement(0.3), &exact);
            let (edge, forces) = (ContactInterface::of(&mesh.mesh), base.normal_forces(0.3));
            let force: f64 = forces.iter().sum();
            let length: f64 = edge.tributary_lengths.iter().sum();
            let sliding = sliding_at(0.3, INTERFERENCE, FORWARD);
            let torque = edge.torque(&sliding, 0.3, &forces) / exact.torque - 1.0;
            let pressure = force / length / exact.pressure - 1.0;
            [radial / INTERFERENCE, tangential / INTERFERENCE, pressure, torque]
        });
        for (i, what) in NAMES.iter().enumerate() {
            assert_rate(element, what, errors.map(|values| 1e6 * values[i]));
        }
    }
}

/// Root mean square of the nodal errors `[radial, tangential]`; one sector stands for all.
fn displacement_errors(mesh: &AnnulusMesh, displacement: &[f64], exact: &SteadyState) -> [f64; 2] {
    let count = mesh.sector_node_count();
    let mut squares = [0.0; 2];
    for node in 0..count {
        let [x, y] = mesh.mesh.plane_node(node);
        let field = exact.displacement(x.hypot(y));
        for (axis, square) in squares.iter_mut().enumerate() {
            *square += (displacement[2 * node + axis] - field[axis]).powi(2);
        }
    }
    squares.map(|sum| (sum / count as f64).sqrt())
}

#[test]
fn nodal_pressure_converges_at_second_order_or_faster() {
    // Corner and mid-side nodes of a Quad8 edge differ in their error, so it falls more slowly than that
    // of the mean, which converges with the fourth power.
    let exact = DISC.prestress(INTERFERENCE, 0.3).pressure;
    // Quad4: of the order of the squared angle of an element, (2 pi / 120)^2 = 2.7e-3.
    for (element, slope, bound) in [(Quad4, 1.9, 2.7e-3), (Quad8, 2.5, 1e-4)] {
        let errors = base_states(element).map(|(mesh, base)| {
            let forces = base.normal_forces(0.3);
            let lengths = ContactInterface::of(&mesh.mesh).tributary_lengths;
            let pressures = forces.iter().zip(&lengths).map(|(force, length)| force / length);
            pressures.map(|p| (p / exact - 1.0).abs()).fold(0.0, f64::max)
        });
        assert!(rate(errors) > slope && errors[0] < bound, "{errors:?}");
    }
}

#[test]
fn recovered_stress_converges_at_second_order_up_to_the_edges() {
    // The largest error over all nodes, the contact edge included.
    let exact = DISC.prestress(INTERFERENCE, 0.3);
    for element in [Quad4, Quad8] {
        let errors = base_states(element).map(|(mesh, base)| {
            let displacement = base.displacement(0.3);
            let recovered = nodal_stress(&mesh.mesh, &material(&DISC), &displacement);
            let mut largest = [0.0_f64; 3];
            for (node, stress) in recovered.iter().enumerate().take(mesh.sector_node_count()) {
                let [x, y] = mesh.mesh.plane_node(node);
                let state = exact.stress(x.hypot(y));
                let found = [stress.radial, stress.hoop, stress.shear];
                let state = [state.radial, state.circumferential, state.shear];
                for (i, worst) in largest.iter_mut().enumerate() {
                    *worst = worst.max((found[i] - state[i]).abs() / exact.pressure);
                }
            }
            largest
        });
        for (i, what) in ["radial", "hoop", "shear"].iter().enumerate() {
            let slope = rate(errors.map(|values| values[i]));
            below((slope - 2.0).abs(), 0.1, format_args!("{element:?} {what}: {errors:?}"));
        }
    }
}
