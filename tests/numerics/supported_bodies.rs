//! Bodies held in any way: random blocks and cubes on springs from 1e3 to 1e13 Pa/m, held in some directions, or free, a softer block
//! on some of them, of so many modes or below a frequency.
//!
//! Independent check: a dense decomposition of the exported matrices; frequencies may differ by round-off of the stiffest waves.

use crate::prelude::*;
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
    /// Times that a block on top is softer.
    softer: Option<f64>,
    hold: Hold,
    modes: usize,
    /// Whether modes are asked for below the frequency of the last of `modes` and the next one.
    is_limited: bool,
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
    // Cubes have equal frequencies, two and three at a time.
    let edges = [5e-3..0.1, 5e-3..0.1, 5e-3..0.1_f64];
    let size = prop_oneof![3 => edges, 1 => (5e-3..0.1_f64).prop_map(|edge| [edge; 3])];
    let moduli = (7.0..13.0_f64, prop::option::of(0.0..6.0_f64));
    let all = (counts, size, moduli, hold, 1_usize..31, any::<bool>());
    all.prop_map(|(counts, size, (modulus, softer), hold, modes, is_limited)| {
        let young_modulus = 10_f64.powf(modulus);
        let softer = softer.map(|power| 10_f64.powf(power));
        Body { counts, size, young_modulus, softer, hold, modes, is_limited }
    })
}

fn part(body: &Body, (folder, asked): (&str, &str)) -> Case {
    let mut blocks = vec![brick("part", [0.0; 3], body.size, body.counts)];
    let top = [0.0, 0.0, body.size[2]];
    blocks.extend(body.softer.map(|_| brick("top", top, body.size, body.counts)));
    let mesh = welded_file_of(&blocks, 1, |point| point);
    let material = |modulus: f64| {
        format!("young_modulus = {modulus:e}\npoisson_ratio = 0.3\ndensity = 7850.0\n")
    };
    let mut text = format!(
        "[mesh]\nfile = \"part.msh\"\n[cea]\nfriction_coefficients = [0.0]\n{asked}\n[material]\n{}",
        material(body.young_modulus)
    );
    if let Some(softer) = body.softer {
        write!(text, "[materials.top]\n{}", material(body.young_modulus / softer)).unwrap();
    }
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
    let asked = format!("modes = {}", body.modes);
    let case = part(body, (folder, &asked));
    let (expected, count) = (dense(&case), body.modes);
    let Some([last, next]) = expected.get(count - 1..=count).filter(|_| body.is_limited) else {
        return check_case(&case, &expected, count);
    };
    let limit_hz = 0.5 * (last.max(0.0).sqrt() + next.max(0.0).sqrt()) / TAU;
    if last.max(rounding(&expected)) > (1.0 - 1e-6) * next {
        return Err(TestCaseError::reject("equal frequencies, or rigid motions"));
    }
    let asked = format!("max_frequency_hz = {limit_hz:e}");
    match check_case(&part(body, (folder, &asked)), &expected, 0) {
        // Rigid motions alone lie below.
        Err(error) if error.to_string().contains("no mode") => Ok(()),
        outcome => outcome,
    }
}

/// A few roundings of the stiffest wave, on either side.
fn rounding(expected: &[f64]) -> f64 {
    64.0 * f64::EPSILON * expected[expected.len() - 1]
}

fn check_case(case: &Case, expected: &[f64], count: usize) -> Result<(), TestCaseError> {
    let found = modes_and_onsets(case).map_err(|error| TestCaseError::fail(error.to_string()))?;
    let modes = &found.points[0].modes;
    let rounding = rounding(expected);
    // Of what is slower rounding leaves no digit: it may be left out, which is said.
    let told = |square: &f64| *square > 4.0 * rounding;
    let untold = expected.iter().filter(|own| !told(own)).count();
    prop_assert!(modes.len() + untold >= count, "{} modes of {count}", modes.len());
    let listed: Vec<f64> = modes.iter().map(|mode| (TAU * mode.frequency_hz()).powi(2)).collect();
    let is_near = |own: f64, other: f64| (own - other).abs() <= 1e-9 * own + rounding;
    for own in &listed {
        let is_one = expected.iter().any(|other| is_near(*own, *other));
        prop_assert!(is_one, "{own} is none of {expected:?}");
    }
    // Each as often as it is an eigenvalue.
    let top = (1.0 - 1e-6) * listed.iter().copied().fold(0.0, f64::max) - rounding;
    let mut others = listed.iter();
    for own in expected.iter().filter(|own| told(own) && **own < top) {
        let is_listed = others.any(|other| is_near(*own, *other));
        prop_assert!(is_listed, "{own} is not in {listed:?}");
    }
    prop_assert!(modes.iter().all(|mode| mode.residual <= 1e-9));
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
            softer: None,
            hold: Hold::Directions(vec!["y"]),
            modes,
            is_limited: false,
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
        check_case(&case, &dense(&case), 24).unwrap_or_else(|e| panic!("1e{exponent} Pa/m: {e}"));
    }
}
