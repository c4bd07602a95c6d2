//! Bodies from a mesh of one of their sectors, solved by waves around them, against their whole mesh.

use crate::prelude::*;
use frictionsim::results::Page;
use frictionsim::results::cea::{self, View};
use frictionsim::study::eigenvalues::{self, Solution};
use frictionsim::study::uncertainty::Sampler;

/// One of `count` sectors of a disc in MSH 2.2: bent cut faces, uneven elements, and a hole, the boundary "screw", off the middle;
/// with an ear of one element at a cut face where it has ears.
fn disc_sector(count: usize, [around, radial]: [usize; 2], eared: bool) -> Vec<u8> {
    let [columns, layers] = [around, radial].map(|count| count as f64);
    let place = |mut t: f64, mut r: f64| {
        if 0.0 < r && r < layers && 0.0 < t && t < columns {
            t += 0.15 * (7.0 * t + 3.0 * r).sin();
            r += 0.15 * (5.0 * t - 2.0 * r).cos();
        }
        let share = r / layers;
        let angle = TAU / count as f64 * (t / columns + 0.15 * share * share);
        let radius = 0.0205 + 0.07 * share;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let is_missing = |i: usize, j: usize| {
        let [t, r] = [1.0 - (i as f64 + 0.5) / columns, (j as f64 + 0.5) / layers];
        let is_beside_ear = eared && j + 1 == radial && i > 0;
        is_beside_ear || (0.3..0.55).contains(&t) && (0.6..0.8).contains(&r)
    };
    let region = |layer: usize| if eared && layer + 1 == radial { "ear" } else { "disc" };
    // Clockwise, so that elements are counter-clockwise.
    let lines = [even(columns, around).into_iter().rev().collect(), even(layers, radial)];
    let whole = Grid::of(lines, ["inner", ""], &region);
    grids(&[Grid { is_missing: &is_missing, hole: "screw", place: &place, ..whole }])
}

fn read(name: &str, mesh: &[u8], text: &str, method: &str) -> Case {
    let (name, method) = (format!("sectors-{name}"), format!("cea.method={method}"));
    case_beside(&name, &[("sector.msh", mesh)], text, &[method])
}

/// A disc of so many sectors, with more of its contact, and further sections.
fn screwed_disc(sectors: usize, more: &str) -> String {
    let text = include_str!("../cases/screwed-disc.toml");
    text.replace("sectors = 3", &format!("sectors = {sectors}")) + more
}

fn solved(name: &str, mesh: &[u8], text: &str, method: &str) -> Solution {
    solution(&read(name, mesh, text, method)).1
}

/// Largest error of as many modes.
fn distance(found: &[ComplexMode], expected: &[ComplexMode]) -> f64 {
    assert_eq!(found.len(), expected.len());
    largest_error(&eigenvalues_of(found), &eigenvalues_of(expected))
}

/// Eigenvalues at every friction value and critical frictions are those of the whole mesh. Estimates of the mesh's error, which stand on
/// right and left vectors over the whole body, are so to the accuracy of left vectors, corrected in two different bases.
fn assert_same(name: &str, mesh: &[u8], text: &str) {
    let [waves, whole] = ["cyclic", "sparse"].map(|method| solved(name, mesh, text, method));
    assert_eq!([waves.method, whole.method], ["cyclic", "sparse"]);
    let mut worst = [0.0_f64; 3];
    for (a, b) in waves.sweep.points.iter().zip(&whole.sweep.points) {
        worst[0] = worst[0].max(distance(&a.modes, &b.modes));
        // Pairs without friction have no vectors of their own.
        let modes = a.modes.iter().zip(&b.modes).filter(|_| a.friction_coefficient > 0.0);
        for (one, other) in modes {
            assert_eq!(one.mesh_error.is_some(), other.mesh_error.is_some());
            let errors = one.mesh_error.zip(other.mesh_error);
            let distance = errors.map_or(0.0, |(own, other)| (own - other).abs() / other.abs());
            worst[2] = worst[2].max(distance);
        }
    }
    let is_made = |own: &&FrictionPoint| own.modes.iter().all(|mode| mode.mesh_error.is_some());
    assert_eq!(waves.sweep.points.iter().filter(is_made).count(), 1);
    let [waves, whole] = [&waves, &whole].map(|own| &own.sweep.intervals);
    assert_eq!(waves.len(), whole.len());
    for (a, b) in waves.iter().zip(whole) {
        assert!(a.nodal_diameters.is_some() && b.nodal_diameters.is_none());
        worst[1] = worst[1].max((a.critical_friction - b.critical_friction).abs());
    }
    assert!(worst[0] < 1e-9 && worst[1] < 5e-9 && worst[2] < 0.2, "{worst:?}");
}

/// Consistency check: waves around the body against its whole mesh, with rigid and springy contact, of odd and even numbers of sectors.
#[test]
fn waves_around_a_plane_body_have_the_spectrum_of_its_whole_mesh() {
    let analysis = "[cea]\nmodes = 20\nfriction_coefficients = [0.0, 0.2, 0.4, 0.6]\n";
    let ears = "[materials.ear]\nyoung_modulus = 7e10\npoisson_ratio = 0.3\ndensity = 2700.0\n";
    let cases = [
        (3, String::new(), [20, 8]),
        (4, "normal_stiffness = 7.4e12\n".to_owned(), [14, 8]),
        (5, ears.to_owned(), [10, 8]),
    ];
    for (count, contact, size) in cases {
        let mesh = disc_sector(count, size, contact.contains("ear"));
        let text = screwed_disc(count, &format!("{contact}{analysis}"));
        assert_same(&format!("disc-{count}"), &mesh, &text);
    }
}

/// The same of solid bodies: a ring between two rings of lining, cut along bent faces, pressed by a load that the base state solves
/// and whose stress acts on small motions. The linings may be cut where the ring is not.
#[test]
fn waves_around_solid_bodies_have_the_spectrum_of_their_whole_mesh() {
    let mesh = |[across, around, high]: [usize; 3], further: f64| {
        let block = |name, z: [f64; 2], (from, layers)| {
            let size = [0.05, TAU / 6.0, z[1] - z[0]];
            brick(name, [0.07, from, z[0]], size, [across, around, layers])
        };
        let blocks = [
            block("below", [-0.02, -0.008], (-further, 1)),
            block("ring", [-0.008, 0.008], (0.0, high)),
            block("above", [0.008, 0.02], (further, 1)),
        ];
        file_of(&blocks, |[r, t, z]| polar([r, t + 0.1 * (60.0 * (r - 0.07)).sin(), z]))
    };
    let text = include_str!("../cases/ring-between-linings.toml");
    for (name, further) in [("ring", 0.0), ("staggered-ring", 0.4)] {
        assert_same(name, &mesh(sized([2, 2, 1], [3, 4, 2]), further), text);
    }
    // Pressed a hundred times as much, motions damped by friction across the sliding lie among the modes, two of which are at one
    // frequency: all that are asked for converge. More come into range as others cease to oscillate: three of them grow by then, and
    // have the onsets that waves around the body have.
    let (size, onsets) = sized(
        ([2, 3, 1], [(0.141304, 8914.23), (0.279520, 9550.55), (0.284175, 9904.08)]),
        ([3, 4, 2], [(0.198758, 8742.75), (0.265936, 9289.07), (0.279959, 9571.03)]),
    );
    let text = text.replace("pressure = 1e6", "pressure = 1e8");
    let pressed = solved("pressed-ring", &mesh(size, 0.0), &text, "sparse").sweep;
    assert!(pressed.unconverged.is_empty(), "{:?}", pressed.unconverged);
    assert!(pressed.points.iter().all(|point| point.modes.len() >= 16));
    assert!(pressed.intervals.iter().all(UnstableInterval::is_located), "{:?}", pressed.intervals);
    for (critical, frequency_hz) in onsets {
        let is_near = |own: &&UnstableInterval| (own.critical_friction - critical).abs() < 1e-6;
        let found = pressed.intervals.iter().find(is_near).expect("an onset of waves");
        assert!((found.frequency_hz - frequency_hz).abs() < 0.01, "{found:?}");
    }
}

/// Split elements are not numbered by sectors: a finer mesh is solved as a whole, whatever the case asks for.
#[test]
fn a_refined_body_of_sectors_is_solved_as_a_whole() {
    let analysis = "[cea]\nmodes = 6\nfriction_coefficients = [0.3]\n";
    let case =
        read("refined", &disc_sector(3, [8, 4], false), &screwed_disc(3, analysis), "cyclic");
    let [coarse, fine] = [1.0, 2.0].map(|factor| solution(&case.refined(factor).unwrap()).1);
    assert_eq!([coarse.method, fine.method], ["cyclic", "sparse"]);
    let [coarse, fine] = [&coarse, &fine].map(|own| eigenvalues_of(&own.sweep.points[0].modes));
    assert!((1e-6..0.1).contains(&largest_error(&coarse, &fine)), "{coarse:?} {fine:?}");
}

/// Contact that stiffens, over a narrow range of friction: high powers of it, which are round-off, tell no sector from the others.
#[test]
fn sectors_are_alike_whatever_round_off_is_in_high_powers_of_friction() {
    let (mesh, text) =
        (include_bytes!("meshes/stacked-rings.msh"), include_str!("../cases/stacked-rings.toml"));
    assert_eq!(solved("stacked-rings", mesh, text, "auto").method, "cyclic");
}

/// The same of a ring that turns with the inertia of its rotation, in both frames.
#[test]
fn waves_around_a_turning_ring_have_the_spectrum_of_its_whole_mesh() {
    let ring = brick("ring", [0.05, 0.0, -0.005], [0.1, TAU / 20.0, 0.01], [3, 2, 1]);
    let mesh = file_of(&[ring], polar);
    let text = include_str!("../cases/turning-ring.toml");
    for frame in ["rest", "turning"] {
        let [waves, whole] = ["cyclic", "sparse"].map(|method| {
            let text = text.replace("\"rest\"", &format!("{frame:?}"));
            solved(&format!("turning-{frame}"), &mesh, &text, method).sweep.points[0].modes.clone()
        });
        assert!(distance(&waves, &whole) < 1e-9, "{waves:?} {whole:?}");
    }
}

#[test]
fn a_body_with_one_mass_is_solved_whole() {
    let more = "[cea]\nmodes = 6\nfriction_coefficients = [0.0, 0.4]\n[modifications.lump]\nat = { x = 0.0905, y = 0.0 }\nmass = 0.5\n";
    let mesh = disc_sector(3, [14, 6], false);
    let text = screwed_disc(3, more);
    let [auto, whole] = ["auto", "sparse"].map(|method| solved("mass", &mesh, &text, method));
    assert_eq!(auto.sweep, whole.sweep);
    assert_eq!(auto.method, "sparse");
    let note = auto.notes.iter().find(|note| note.contains("whole mesh"));
    assert!(note.unwrap().contains("mass of sector"), "{note:?}");
}

/// A body of sectors says its nodal diameters in every table; its samples have the onset of the analysis, above which is its friction.
#[test]
fn every_table_of_a_body_of_sectors_has_its_nodal_diameters_and_samples_have_its_onsets() {
    let more = "[cea]\nmodes = 8\nfriction_coefficients = [0.0, 0.2, 0.4]\n[uncertainty]\nsamples = 2\nindex_samples = 0\n\
        [uncertainty.distributions]\n\"material.density\" = { uniform = [1227.999999, 1228.000001] }\n";
    let case = read("tables", &disc_sector(4, [8, 5], false), &screwed_disc(4, more), "auto");
    let (model, solution) = solution(&case);
    let cea = case.cea.as_ref().unwrap();
    let report = eigenvalues::report(&case, cea, &model, &solution, 0.0);
    let manifest = Manifest::new("cea");
    let told = cea::summary(&report);
    let own = |modes: &[ComplexMode]| modes.iter().map(|m| m.nodal_diameters).collect::<Vec<_>>();
    let listed: Vec<_> = told.modes_at_friction.unwrap().iter().map(|mode| mode.harmonic).collect();
    assert_eq!(listed, own(&solution.sweep.points[2].modes));
    assert!(listed.iter().all(Option::is_some));
    let onsets: Vec<_> = told.critical_frictions.iter().map(|onset| onset.harmonic).collect();
    let intervals = &solution.sweep.intervals;
    assert_eq!(onsets, intervals.iter().map(|own| own.nodal_diameters).collect::<Vec<_>>());
    assert!(!onsets.is_empty() && told.unstable_modes.iter().all(|mode| mode.harmonic.is_some()));
    let reading = solution.reading.as_ref().unwrap();
    assert!(reading.contributions.iter().all(|row| row.mode.harmonic.is_some()));
    // The page says what the terminal says.
    let page = Page::new(cea::document(&report, View::Page), Vec::new(), &manifest).to_html(&[]);
    assert_eq!(page.matches(">n</th>").count(), 2, "{page}");
    // Samples.
    let lowest = intervals.iter().map(|own| (own.critical_friction, own.nodal_diameters));
    let (critical, diameters) = lowest.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    assert!(critical < 0.4);
    for sample in Sampler::new(&case).unwrap().block(1) {
        let onset = sample.lowest(0.4).unwrap();
        near(onset.critical_friction, critical, 1e-6);
        assert_eq!((onset.harmonic, onset.unstable_from_start), (diameters, false));
        assert!(sample.is_unstable(0.4));
    }
}

/// A built-in disc of 20 bricks around under a ring on the whole of its top face, clamped at its bore, with some changes.
fn under_a_ring(files: &[(&str, &[u8])], changes: &[&str]) -> Solution {
    let text = include_str!("../commands/refused/disc-under-a-ring.toml");
    solution(&case_beside("sectors-disc", files, text, changes)).1
}

/// Equal eigenvalues: each has one of the other list beside it.
fn assert_equal(a: &Solution, b: &Solution, tolerance: f64) {
    for (a, b) in a.sweep.points.iter().zip(&b.sweep.points) {
        below(distance(&a.modes, &b.modes), tolerance, "eigenvalues");
    }
}

/// Friction knows the relative speed alone: a disc that turns under a ring at rest is one at rest under a ring that turns the other
/// way. The first goes by nodal diameters, the second by its whole mesh at once.
#[test]
fn a_disc_that_turns_under_a_ring_at_rest_is_one_under_a_ring_that_turns() {
    let turns = "contact.rotation_speed_rpm=0.0 ; \
                 motion.disc={ axis = [0.0, 0.0, 1.0], rotation_speed_rpm = -300.0 }";
    let turning = under_a_ring(&[], &[turns]);
    let at_rest = under_a_ring(&[], &["cea.method=sparse"]);
    assert_equal(&turning, &at_rest, 1e-9);
}

/// The same disc as a mesh file of one sector: rotation, friction and damping together.
#[test]
fn a_built_in_disc_that_turns_is_the_one_of_a_mesh_of_its_sector() {
    let motion = "motion.disc={ axis = [0.0, 0.0, 1.0], rotation_speed_rpm = 6000.0, \
                  rotation_terms = true, frame = \"turning\" }";
    let [own, still] = [&[motion][..], &[]].map(|set| under_a_ring(&[], set));
    let block = brick("disc", [0.05, 0.0, 0.0], [0.1, TAU / 20.0, 0.01], [3, 1, 1]);
    let mesh = file_of(&[block], polar);
    let built_in = ["geometry", "mesh", "boundaries", "contact.base_state"].map(unset);
    let file = "mesh={ file = \"disc.msh\", sectors = 20 } ; contact.counterface=plane ; \
                contact.boundary=disc_z1 ; boundaries.disc_x0={ condition = \"clamped\" } ; \
                cea.method=cyclic";
    let changes = built_in.iter().map(String::as_str).chain([file, motion]);
    let of_file = under_a_ring(&[("disc.msh", &mesh)], &changes.collect::<Vec<_>>());
    assert_equal(&own, &of_file, 1e-9);
    let [turning, still] = [&own, &still].map(|own| own.sweep.points[0].modes[0].frequency_hz());
    assert!((turning / still - 1.0).abs() > 1e-4, "rotation matters: {turning} {still}");
}

/// Cross-method: a disc whose face is pressed all over has the spectrum of its whole mesh. Linear
/// bricks have the same contact, on the face that their nodes span.
#[test]
fn a_disc_of_linear_bricks_has_the_contact_of_its_whole_mesh() {
    let guided = "boundaries.bottom={ condition = \"guide\" }";
    let [waves, whole] = METHODS.map(|method| under_a_ring(&[], &[guided, method]));
    assert_equal(&waves, &whole, 1e-6);
}

/// Cross-method: where the disc bends away from the ring, waves end the pressed part within an
/// element, the whole mesh at points of it. They are as near each other as the mesh is fine.
#[test]
fn a_disc_that_bends_away_from_its_ring_is_the_same_by_waves_and_as_a_whole() {
    for ([around, radial], tolerance) in [([20, 3], 0.02), ([40, 6], 0.01)] {
        let set = format!("mesh.circumferential_elements={around} ; mesh.radial_elements={radial}");
        let [waves, whole] = METHODS.map(|method| under_a_ring(&[], &[&set, method]).sweep);
        let [own, other] = [&waves, &whole].map(|sweep| -> Vec<f64> {
            sweep.points[1].modes.iter().map(ComplexMode::frequency_hz).collect()
        });
        near_each(&own, &other, tolerance);
        let [own, other] = [&waves, &whole]
            .map(|sweep| criticals(&sweep.intervals).into_iter().fold(f64::INFINITY, f64::min));
        near(own, other, tolerance);
    }
}

/// Independent check: a finer mesh. On stiff springs corners and middles of sides give way by very different parts of a small approach,
/// and each has the friction of its own.
#[test]
fn points_of_stiff_springs_have_the_force_of_their_own_approach() {
    let growth = |sectors: usize| {
        let sectors = format!("mesh.circumferential_elements={sectors}");
        let springs = "contact.base_state=compliant ; contact.normal_stiffness=1e14";
        let few = "cea.mass=consistent ; mesh.element=quad8 ; mesh.radial_elements=8 ; \
                   cea.modes=6 ; cea.shapes_at=[] ; cea.friction_coefficients=[0.4]";
        let text = include_str!("../../cases/ring-on-layer.toml");
        let found = solution(&case_beside("ring-on-layer", &[], text, &[springs, few, &sectors])).1;
        let mut modes = found.sweep.points.last().unwrap().modes.iter();
        modes.find(|mode| (mode.frequency_hz() - 7571.0).abs() < 4.0).unwrap().growth_rate()
    };
    near(growth(24), growth(72), 3e-3);
}

/// A disc on a cylinder that turns, without friction, with some changes.
fn on_a_cylinder(name: &str, change: &str, method: &str) -> Solution {
    let still = "cea.friction_coefficients=[0.0] ; contact.friction_coefficient=0.0";
    let sets = [change, still, method];
    let text = include_str!("../cases/solid-disc.toml");
    solution(&case_beside(&format!("sectors-{name}"), &[], text, &sets)).1
}

/// Cross-method: what a support of the outer face has around the axis, its dashpot too, does not act along it. There it has a stiffness
/// of its own. A flat face has all of it along both tangents. A pressure on the outer face acts on the face that the nodes span, and with
/// its stress on the modes.
#[test]
fn a_disc_on_supports_and_under_pressure_is_its_whole_mesh() {
    let outer = "boundaries.outer={ condition = \"support\", normal_stiffness = 5e10, \
                 tangential_stiffness = 3e10, axial_stiffness = 2e10, normal_damping = 2e4, \
                 tangential_damping = 1e4 }";
    let bottom = "boundaries.bottom={ condition = \"support\", normal_stiffness = 1e10, \
                  tangential_stiffness = 3e10, normal_damping = 1e4, tangential_damping = 2e4 }";
    let lumped = format!("cea.mass=lumped ; {outer}");
    let pressure = "boundaries.outer={ condition = \"pressure\", pressure = 2e7 } ; \
                    boundaries.bottom={ condition = \"clamped\" } ; cea.geometric_stiffness=true";
    // The small space that a harmonic is solved in leaves out 2e-7 of what dashpots of the first do to its modes.
    let all = [(outer, 2e-6), (bottom, 1e-9), (&lumped, 2e-6), (pressure, 1e-9)];
    for (support, tolerance) in all {
        let [waves, whole] = METHODS.map(|method| on_a_cylinder("support", support, method));
        assert_equal(&waves, &whole, tolerance);
    }
}

/// A face that is held along the axis, or across it, is so in every sector; one that is held along x alone makes the sectors differ.
#[test]
fn a_disc_with_a_face_held_along_some_axes_is_its_whole_mesh() {
    for held in ["\"z\"", "\"x\", \"y\"", "\"x\""] {
        let set = format!("boundaries.bottom={{ condition = \"fixed\", directions = [{held}] }}");
        let [own, whole] =
            ["cea.method=auto", METHODS[1]].map(|by| on_a_cylinder("held", &set, by));
        let method = if held == "\"x\"" { "sparse" } else { "cyclic" };
        assert_eq!([own.method, whole.method], [method, "sparse"]);
        assert_equal(&own, &whole, 1e-9);
    }
}
