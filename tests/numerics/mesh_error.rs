//! What the mesh makes of frequencies and of critical friction, against finer meshes.

use crate::prelude::*;

fn shipped(name: &str, modes: usize, frictions: &str) -> Case {
    let own = format!("cea.modes={modes} ; cea.friction_coefficients={frictions}");
    shipped_case(&format!("{name}.toml"), &[own.as_str(), "cea.sensitivities=false"])
}

/// A case of the block `part` in a folder that stays.
fn bricks(name: &str, size: [f64; 3], counts: [usize; 3], text: &str) -> Case {
    let mesh = file_of(&[brick("part", [0.0; 3], size, counts)], |point| point);
    case_beside(name, &[("part.msh", &mesh)], text, AS_IT_IS)
}

/// Frequencies at the last friction value with their estimates, Hz.
fn estimates(solution: &Solution) -> Vec<[f64; 2]> {
    let point = solution.sweep.points.last().unwrap();
    point.modes.iter().map(|mode| [mode.frequency_hz(), mode.mesh_error.unwrap()]).collect()
}

/// What the estimates say of the difference of two meshes, over that difference, by mode.
fn effectivities(coarse: &[[f64; 2]], fine: &[[f64; 2]]) -> Vec<f64> {
    coarse.iter().zip(fine).map(|([a, of_a], [b, of_b])| (of_a - of_b) / (a - b)).collect()
}

/// Independent check: the same body on elements of half the size. Linear bricks in space, quadratic triangles in the plane, with contact,
/// friction and damping; the estimate of every frequency is within a factor of two.
#[test]
fn estimates_of_frequencies_are_within_a_factor_of_two_of_the_error_by_refinement() {
    let lining = |fineness: usize| {
        let counts = sized([6, 5, 3], [10, 8, 6]).map(|count| count * fineness);
        let text = "[mesh]\nfile = \"part.msh\"\n[material]\nyoung_modulus = 8e9\npoisson_ratio = 0.25\n\
                    density = 2500.0\n[cea]\nmodes = 8\n";
        bricks(&format!("mesh-error-{fineness}"), [0.05, 0.04, 0.02], counts, text)
    };
    let disc = {
        let specification = crate::disc::annulus(Quad4, 48, 8);
        let mesh = crate::triangles::triangles(&specification, true);
        let mesh = write_msh(&mesh, FORMS[0], &[], |point| point);
        let shipped = fs::read_to_string(crate::program::shipped("disc-triangles.toml")).unwrap();
        let text = shipped.replace("meshes/disc.msh", "disc.msh").replace("scale = 0.001", "");
        let set = ["cea.modes=6 ; cea.friction_coefficients=[0.3] ; cea.sensitivities=false"];
        case_beside("mesh-error-disc", &[("disc.msh", &mesh)], &text, &set)
    };
    let disc = sized(disc, shipped("disc-triangles", 6, "[0.3]"));
    // The strain of bricks with incompatible modes is better than that of others, and so less is recovered.
    for (name, most, [coarse, fine]) in [
        ("lining", 2.3, [lining(1), lining(2)]),
        ("disc", 2.0, [disc.clone(), disc.refined(2.0).unwrap()]),
    ] {
        let [coarse, fine] = [coarse, fine].map(|case| estimates(&solution(&case).1));
        let found = effectivities(&coarse, &fine);
        assert!(found.iter().all(|e| (0.5..most).contains(e)), "{name}: {found:?}");
        // Both meshes are fine enough for the error to fall as its order says.
        let falls = coarse.iter().zip(&fine).all(|(a, b)| b[1] < 0.4 * a[1]);
        assert!(falls, "{name}: {coarse:?} {fine:?}");
    }
}

/// Independent check: the same plate on bricks of half the size. The strains of a single layer change across it, where the middles of the
/// bricks say nothing: all of the energy of bending was taken for an error. Bricks with incompatible modes do not fit together exactly,
/// so that errors of a thousandth may have either sign.
#[test]
fn estimates_of_one_layer_of_bricks_in_bending_are_of_the_size_of_the_error() {
    let plate = |fineness: usize| {
        let counts = [16 * fineness, 8 * fineness, fineness];
        let text = "[mesh]\nfile = \"part.msh\"\n[material]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\n\
                    density = 7800.0\n[boundaries.part_x0]\ncondition = \"clamped\"\n[cea]\nmodes = 5\n";
        bricks(&format!("plate-{fineness}"), [0.16, 0.08, 0.006], counts, text)
    };
    let [coarse, fine] = [plate(1), plate(2)].map(|case| estimates(&solution(&case).1));
    let found = effectivities(&coarse, &fine);
    for ((found, coarse), fine) in found.iter().zip(&coarse).zip(&fine) {
        let is_large = (coarse[0] / fine[0] - 1.0).abs() > 3e-3;
        assert!(!is_large || (0.5..2.0).contains(found), "{found} {coarse:?} {fine:?}");
        assert!(is_large || coarse[1].abs() < 6e-3 * coarse[0], "{coarse:?} {fine:?}");
    }
}

/// Independent check: the same plate on elements of two thirds the size, quadratic ones of irregular shape in a single layer, as parts are
/// meshed. Samples that hardly tell the curvature of a strain across the plate were taken at their word: 25 to 50 times the error.
#[test]
fn estimates_of_one_layer_of_quadratic_elements_are_of_the_size_of_the_error() {
    // Strains of bricks are better than their order says at the samples, so that more is recovered.
    for (kind, word, most) in [(Tet10, "C3D10", 2.0), (Hex20, "C3D20", 5.0)] {
        let plate = |cells: [usize; 3]| {
            // No two elements are alike.
            let irregular = |[x, y, z]: Place| {
                let shift =
                    |at: f64| 0.05 * at * (1.0 - at) * (9.0 * x + 4.0 * z).sin() * (7.0 * y).cos();
                [0.16 * (x + shift(x)), 0.08 * (y + shift(y)), 0.012 * z]
            };
            let mesh = abaqus_of(&block(kind, cells, irregular), &format!("{word}, ELSET=part"));
            let text = "[mesh]\nfile = \"part.inp\"\n[material]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\n\
                        density = 7800.0\n[cea]\nmodes = 6\nfriction_coefficients = [0.0]\n";
            let name = format!("quadratic-plate-{word}-{}", cells[0]);
            case_beside(&name, &[("part.inp", mesh.as_bytes())], text, AS_IT_IS)
        };
        let plates = [plate([8, 4, 1]), plate([12, 6, 1])];
        let [coarse, fine] = plates.map(|case| estimates(&solution(&case).1));
        let found = effectivities(&coarse, &fine);
        assert!(found.iter().all(|e| (0.5..most).contains(e)), "{kind:?} {found:?}");
    }
}

/// Independent check: the same body on elements of half the size. A critical friction is where a growth rate vanishes, a difference of
/// large parts: errors of 1e-4 and more are estimated within a factor of two on this body.
#[test]
fn estimates_of_critical_friction_follow_the_error_by_refinement() {
    let annulus = [
        "mesh.circumferential_elements=36 ; mesh.radial_elements=6",
        "cea={modes=8,friction_coefficients=[0.1,0.2],method=\"sparse\"}",
    ];
    let coarse =
        sized(shipped_case("limit-cycle.toml", &annulus), shipped("test-bench", 10, "[0.1, 0.2]"));
    let fine = coarse.refined(2.0).unwrap();
    let onsets = |case: &Case| -> Vec<[f64; 2]> {
        let (_, solution) = solution(case);
        let intervals = solution.sweep.intervals.iter();
        intervals.filter_map(|own| Some([own.critical_friction, own.mesh_error?])).collect()
    };
    let [coarse, fine] = [coarse, fine].map(|case| onsets(&case));
    assert_eq!(coarse.len(), 3, "{coarse:?}");
    let found = effectivities(&coarse, &fine);
    assert!(found.iter().all(|e| (0.5..2.0).contains(e)), "{found:?}");
}
