//! Bodies held in any way: random blocks on springs from 1e3 to 1e13 Pa/m, held in some directions, or free.
//!
//! Independent check: a dense decomposition of the exported matrices; frequencies may differ by round-off of the stiffest waves.

use crate::prelude::*;
use crate::sliding_bodies::{holds_for_all, sums};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Hold {
    Springs { normal: f64, tangential: f64 },
    Directions(Vec<&'static str>),
    Nothing,
}

#[derive(Clone, Debug)]
struct Body {
    counts: [usize; 3],
    size: [f64; 3],
    young_modulus: f64,
    hold: Hold,
    modes: usize,
}

fn bodies() -> impl Strategy<Value = Body> {
    let springs = (3.0..13.0_f64, -3.0..0.0_f64).prop_map(|(normal, ratio)| {
        let normal = 10_f64.powf(normal);
        Hold::Springs { normal, tangential: normal * 10_f64.powf(ratio) }
    });
    let directions = prop::sample::subsequence(vec!["x", "y", "z"], 1..=2);
    let hold = prop_oneof![
        6 => springs,
        2 => directions.prop_map(Hold::Directions),
        1 => Just(Hold::Nothing),
    ];
    let counts = [2_usize..4, 2..4, 2..4];
    let size = [5e-3..0.1, 5e-3..0.1, 5e-3..0.1];
    let all = (counts, size, 7.0..13.0_f64, hold, 1_usize..24);
    all.prop_map(|(counts, size, modulus, hold, modes)| {
        let young_modulus = 10_f64.powf(modulus);
        Body { counts, size, young_modulus, hold, modes }
    })
}

fn part(body: &Body, folder: &str) -> Case {
    let mesh = file_of(&[brick("part", [0.0; 3], body.size, body.counts)], |point| point);
    let mut text = format!(
        "[mesh]\nfile = \"part.msh\"\n[material]\nyoung_modulus = {:e}\npoisson_ratio = 0.3\ndensity = 7850.0\n\
         [cea]\nfriction_coefficients = [0.0]\nmodes = {}\n",
        body.young_modulus, body.modes
    );
    match &body.hold {
        Hold::Springs { normal, tangential } => write!(
            text,
            "[boundaries.part_z0]\ncondition = \"support\"\nnormal_stiffness = {normal:e}\n\
             tangential_stiffness = {tangential:e}\n"
        ),
        Hold::Directions(held) => {
            write!(text, "[boundaries.part_z0]\ncondition = \"fixed\"\ndirections = {held:?}\n")
        }
        Hold::Nothing => Ok(()),
    }
    .unwrap();
    case_beside(folder, &[("part.msh", &mesh)], &text, AS_IT_IS)
}

/// Squares of all angular frequencies by a dense decomposition of the exported matrices, ascending.
pub fn dense(case: &Case) -> Vec<f64> {
    let [mass, _, stiffness, _] = sums(&matrices(case, None).unwrap());
    let full = |own: Mat<f64>| DMatrix::from_fn(own.nrows(), own.nrows(), |i, j| own[(i, j)]);
    let (squares, _) = pencil_modes(&full(stiffness), &full(mass));
    sorted(squares.as_slice().to_vec())
}

fn check(body: &Body, folder: &str) -> Result<(), TestCaseError> {
    check_case(&part(body, folder), body.modes)
}

fn check_case(case: &Case, count: usize) -> Result<(), TestCaseError> {
    let expected = dense(case);
    let found = modes_and_onsets(case).map_err(|error| TestCaseError::fail(error.to_string()))?;
    let modes = &found.points[0].modes;
    prop_assert!(modes.len() >= count, "{} modes of {count}", modes.len());
    // A few roundings of the stiffest wave, on either side.
    let rounding = 64.0 * f64::EPSILON * expected[expected.len() - 1];
    for (mode, square) in modes.iter().zip(&expected[found.rigid_motions..]) {
        let own = (TAU * mode.frequency_hz()).powi(2);
        prop_assert!((own - square).abs() <= 1e-9 * square + rounding, "{own} {square}");
        prop_assert!(mode.residual <= 1e-9);
    }
    for square in &expected[..found.rigid_motions] {
        prop_assert!(square.abs() <= rounding, "{square} is no rigid motion");
    }
    Ok(())
}

#[test]
fn bodies_held_in_any_way_have_the_modes_of_a_dense_decomposition() {
    holds_for_all(7, &bodies(), |body| check(&body, "supported-body"));
}

#[test]
fn rigid_motions_take_no_places_of_modes_however_many_are_asked_for() {
    for modes in [12, 14, 16] {
        // Of its four rigid motions one turns about a line of the face that is held.
        let body = Body {
            counts: [2; 3],
            size: [0.038298984935644646, 0.049993373959247626, 0.04118067718271797],
            young_modulus: 1e7,
            hold: Hold::Directions(vec!["y"]),
            modes,
        };
        check(&body, "rigid-motions").unwrap_or_else(|error| panic!("{modes} modes: {error}"));
    }
}

/// A ring of 80 to 120 mm, 20 mm thick: pairs of equal frequencies, and rigid motions of any stiffness between soft and stiff.
#[test]
fn a_ring_on_springs_at_its_rim_has_its_modes_at_every_stiffness() {
    let ring = brick("ring", [0.08, 0.0, 0.0], [0.04, TAU, 0.02], [2, 16, 1]);
    let ring = welded_file_of(&[ring], 1, polar);
    for exponent in 2..14 {
        let text = format!(
            "[mesh]\nfile = \"ring.msh\"\n[material]\nyoung_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n\
             [boundaries.ring_x1]\ncondition = \"support\"\nnormal_stiffness = 1e{exponent}\n\
             [cea]\nfriction_coefficients = [0.0]\nmodes = 24\n"
        );
        let case = case_beside("supported-ring", &[("ring.msh", &ring)], &text, AS_IT_IS);
        check_case(&case, 24).unwrap_or_else(|error| panic!("1e{exponent} Pa/m: {error}"));
    }
}
