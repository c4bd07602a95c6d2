//! `cea.count_modes` as a user meets it.

use crate::prelude::*;

fn counted(case: &str, sets: &[&str]) -> Answer {
    let block = case == "sliding-block.toml";
    let mesh = block.then(|| coarse_block(&kept("counted-block")));
    let run = Run::of("cea", shipped(case)).out("run").set(mesh.as_slice());
    run.set(&["cea.count_modes=true"]).set(sets).done()
}

/// Bodies without symmetry, damping that is not proportional: every list is complete, in words and in the summary.
#[test]
fn counts_are_printed_and_summed_up() {
    for (case, sets, modes, counts) in [
        ("sliding-block.toml", vec![], 10, 3),
        ("pad-on-disc.toml", vec!["cea.friction_coefficients=[0.0, 0.22, 0.5]"], 11, 4),
    ] {
        let line = format!("counted {modes} modes below");
        let summary = counted(case, &sets).says(&[&line, ": complete"]).summary();
        let found = summary["mode_counts"].as_array().unwrap();
        assert_eq!(found.len(), counts, "{found:?}");
        for count in found {
            assert_eq!(count["is_complete"], true, "{count}");
            assert_eq!(count["counted"], count["known"]);
        }
    }
}

/// Harmonics with losses, and those of a body of revolution.
#[test]
fn harmonics_hold_as_many_modes_as_the_whole_mesh() {
    for (case, sets) in [
        ("polycarbonate-disc.toml", ["mesh.radial_elements=4", "material.loss_factor=0.02"]),
        ("disc-three-dimensions.toml", ["mesh.radial_elements=3", "mesh.axial_elements=1"]),
    ] {
        let common = "mesh.circumferential_elements=12 ; mesh.element=quad4 ; \
            cea.friction_coefficients=[0.0, 0.3] ; cea.max_frequency_hz=12000";
        let sets = [&[common][..], &sets].concat();
        let waves = counted(case, &sets).says(&["that were followed are not", "harmonics 0 to 6"]);
        let whole = [&sets[..], &["cea.method=\"sparse\""]].concat();
        let counts = counted(case, &whole).summary()["mode_counts"].clone();
        assert!(counts[1].is_object() && counts[2].is_null(), "{counts}");
        for count in counts.as_array().unwrap() {
            let friction = count["friction_coefficient"].as_f64().unwrap();
            let rows = waves.rows("eigenvalues.csv").into_iter();
            let keys = ["friction_coefficient", "damping_factor"];
            let listed = rows.map(|row| row.numbers(keys)).filter(|own| own[0] == friction);
            let listed = listed.filter(|own| own[1] < 0.5); // Faster decay is not promised.
            assert_eq!(count["counted"], listed.count(), "{case} {count}");
        }
    }
}

/// An undamped disc on a soft contact: every branch that friction feeds grows by a billionth. With little damping none does.
#[test]
fn branches_that_hardly_grow_are_told_from_squeal() {
    let run = |damping: &str| {
        let sets = "mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; \
            cea.geometric_stiffness=false ; contact.normal_stiffness=1e5 ; \
            damping.stiffness_coefficient=0";
        let run = Run::of("cea", shipped("polycarbonate-disc.toml")).out("run");
        run.set(&[sets, damping]).done().said()
    };
    has(&run("damping.mass_coefficient=0"), &["13 unstable branches hardly grow ("]);
    has(&run("damping.mass_coefficient=1"), &["0 unstable ; !hardly grow"]);
}

/// Squares of 6 mm, an upright of 3 x 7 on the end of a foot of 10 x 2, whose lower edge is `sole` and whose upper end `top`.
fn jaw() -> Vec<u8> {
    let lines = [10, 7].map(|count| even(6.0 * count as f64, count));
    let whole = Grid::of(lines, ["sole", "top"], &|_| "jaw");
    grids(&[Grid { is_missing: &|i, j| i > 2 && j > 1, ..whole }])
}

/// Near jamming the forces of a jaw that stands on its last contact node rise steeply, and the terms of its matrices cancel each other.
/// Modes keep what rounding leaves of them: those of the friction value alone, to the share by which forces are known.
#[test]
fn modes_near_jamming_are_listed_as_far_as_rounding_lets_them() {
    let folder = folder_with(&[("jaw.msh", &jaw())]);
    let case = include_str!("../cases/jaw.toml");
    let frequencies = |values: &str| -> Vec<f64> {
        let run = Run::of_text("cea", folder.path(), case).out(folder.path().join(values));
        let run = run.set(&[format!("cea.friction_coefficients=[{values}]")]);
        run.done().modes("0.33").into_iter().map(|own| own.im / TAU).collect()
    };
    let (alone, beside) = (frequencies("0.33"), frequencies("0.2, 0.33"));
    assert_eq!(beside.len(), alone.len());
    for (beside, alone) in beside.iter().zip(&alone).filter(|(_, alone)| **alone > 2000.0) {
        assert!((beside / alone - 1.0).abs() < 1e-3, "{beside} {alone}");
    }
}

/// Independent: the whole mesh. Friction that falls steeply overdamps the lowest mode; the third comes from far above at rest.
#[test]
fn the_lowest_modes_are_as_many_where_one_stops_oscillating() {
    let folder = folder_with(&[("disc.toml", disc_of([18, 3], "[cea]\nmodes = 3\n").as_bytes())]);
    let steep = "contact.static_friction_ratio=4.0 ; contact.decay_speed=0.4 ; \
         contact.rotation_speed_rpm=200 ; contact.normal_stiffness=1e12 ; \
         boundaries.outer={condition=\"support\",normal_stiffness=2e12,tangential_stiffness=1e7}";
    let [cyclic, sparse] = METHODS.map(|method| {
        let run = Run::of("cea", "disc.toml").within(folder.path()).out("out").args(&["--force"]);
        let set = [steep, "material.loss_factor=0.01", "cea.friction_coefficients=[0.0, 0.3]"];
        let found = run.set(&set).set(&[method]).done().modes("0.3");
        found.into_iter().map(|own| own.im).collect::<Vec<f64>>()
    });
    assert_eq!(cyclic.len(), 3);
    near_each(&cyclic, &sparse, 1e-8);
}
