//! Consistency check: what `check` says of a case is what its runs say.

use super::RUN;
use crate::prelude::*;
use frictionsim::case::Analysis;
use frictionsim::study::{StudyError, preflight, summarize};

/// Values for keys, good and bad ones.
const POOL: &[(&str, &[&str])] = &[
    ("mesh.circumferential_elements", &["3", "5", "24", "60"]),
    ("mesh.radial_elements", &["1", "2", "9"]),
    ("mesh.radial_grading", &["0.5", "3.0", "1e9"]),
    ("mesh.element", &["quad4", "quad8"]),
    ("material.poisson_ratio", &["-0.9", "0.0", "0.4999", "0.5"]),
    ("material.formulation", &["plane-stress"]),
    ("contact.friction_coefficient", &["0", "0.9", "1000"]),
    ("contact.interference", &["1e-12", "1e-3", "1"]),
    ("contact.rotation_speed_rpm", &["0", "-610", "1e7"]),
    ("contact.normal_stiffness", &["1", "7e12", "1e40", "rigid"]),
    ("damping.mass_coefficient", &["0", "1e9"]),
    ("damping.stiffness_coefficient", &["0", "1e-5"]),
    ("cea.max_frequency_hz", &["1", "100", "1e5"]),
    ("cea.modes", &["1", "40", "100000"]),
    ("cea.method", &["cyclic", "sparse"]),
    ("cea.mass", &["consistent"]),
    ("transient.time_step", &["auto", "1e-8", "2e-6", "1e-5", "1e-3"]),
    ("transient.duration", &["1e-7", "1e-5", "1e-4"]),
    ("transient.expansion_time", &["0", "2e-5", "1"]),
    ("transient.initial", &["steady-sliding"]),
    ("transient.operator", &["sparse", "cyclic"]),
    ("transient.perturbation.harmonics", &["[0]", "[2, 12]", "[13]"]),
    ("output.probes", &["[1, 120]", "[121]", "[100000]"]),
    ("output.sample_interval", &["1e-9", "1e-5", "1e-3"]),
    ("output.snapshots", &["[0]", "[1e-5, 2e-5]", "[1]"]),
];

fn overrides(seed: u64) -> Vec<String> {
    let small =
        ["mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; transient.duration=4e-5 ; \
         transient.expansion_time=1e-5 ; output.probes=[1] ; output.snapshots=[]"];
    // Marsaglia's xorshift.
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = |count: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as usize % count
    };
    let mut all: Vec<String> =
        small.iter().flat_map(|text| text.split(" ; ")).map(str::to_owned).collect();
    for _ in 0..1 + random(3) {
        let (key, values) = POOL[random(POOL.len())];
        all.push(format!("{key}={}", values[random(values.len())]));
    }
    all
}

/// Whether a command refuses its case, which is exit code 2.
fn is_refused<T>(outcome: Result<T, StudyError>) -> bool {
    outcome.is_err_and(|error| error.is_usage())
}

#[test]
fn check_refuses_what_a_run_refuses_and_nothing_else() {
    let simd = frictionsim::fem::operator::SimdLevel::detect();
    let manifest = Manifest { simd: simd.to_string(), ..Manifest::new("transient") };
    let mut counts = [0, 0];
    for seed in 1..=160 {
        let overrides = overrides(seed);
        // A case that cannot be read is refused by every command alike.
        let Ok(case) = Case::parse("case.toml", RUN.as_bytes(), &overrides) else {
            continue;
        };
        let checked = is_refused(preflight(&case, f64::INFINITY));
        // Elements that the transient cannot run are a warning of the case.
        let runs = case.require_transient().is_ok();
        let run = (runs && is_refused(summarize(&case, Analysis::Transient, &manifest)))
            || is_refused(summarize(&case, Analysis::Cea, &manifest));
        assert_eq!(checked, run, "seed {seed}: {overrides:?}");
        counts[usize::from(run)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

/// What the run of a body refuses for a reason that its case has, `check` refuses in the same words.
#[test]
fn check_knows_what_runs_of_rings_blocks_and_pads_refuse() {
    let folder = tempfile::tempdir().unwrap();
    let block = brick("pad", [0.0; 3], [0.03, 0.02, 0.01], [2, 2, 1]);
    std::fs::write(folder.path().join("pad.msh"), file_of(&[block], |point| point)).unwrap();
    let path = folder.path().join("case.toml");
    let steel = "young_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";
    let pad = format!(
        "[mesh]\nfile = \"pad.msh\"\n[material]\n{steel}[boundaries.pad_z1]\ncondition = \"clamped\"\n\
         [contact]\nboundary = \"pad_z0\"\ncounterface = \"plane\"\ndirection = [1.0, 0.0, 0.0]\nspeed = 1.5\n\
         friction_coefficient = 0.3\n"
    );
    let ring = format!(
        "[geometry]\ninner_radius = 0.02\nouter_radius = 0.06\nthickness = 0.009\n\
         [mesh]\ncircumferential_elements = 12\nradial_elements = 2\naxial_elements = 1\n\
         [material]\nformulation = \"three-dimensional\"\n{steel}\
         [contact]\nboundary = \"top\"\nring_inner_radius = 0.03\nring_outer_radius = 0.05\ninterference = 5e-6\n\
         rotation_speed_rpm = 60.0\nfriction_coefficient = 0.3\n[boundaries.bottom]\ncondition = \"guide\"\n"
    );
    let cea = "[cea]\nmodes = 2\nfriction_coefficients = [0.3]\n";
    let frf = "[frf]\nforce_node = 1\nboundary = \"sliding\"\nfrequencies_hz = [100.0]\nforce_direction = \"z\"\n\
               response_direction = \"z\"\n";
    // Nothing but the contact holds the upper block up.
    let upper = |z| [0.0, 0.0, z];
    let pair = [("lower", 0.0, 3), ("upper", 0.01, 2)]
        .map(|(name, z, count)| brick(name, upper(z), [0.03, 0.02, 0.01], [count, count, 1]));
    std::fs::write(folder.path().join("pair.msh"), file_of(&pair, |point| point)).unwrap();
    let floating = format!(
        "[mesh]\nfile = \"pair.msh\"\n[material]\n{steel}[boundaries.lower_z0]\ncondition = \"clamped\"\n\
         [boundaries.lower_x1]\ncondition = \"pressure\"\npressure = 1e6\n\
         [boundaries.upper_z1]\ncondition = \"fixed\"\ndirections = [\"x\", \"y\"]\n\
         [contacts.pads]\nsurface = \"lower_z1\"\ncounter = \"upper_z0\"\nfriction_coefficient = 0.3\n\
         [motion.upper]\naxis = [0.0, 0.0, 1.0]\nrotation_speed_rpm = 60.0\n"
    );
    let along = pad.replace("[1.0, 0.0, 0.0]", "[0.0, 0.0, 1.0]");
    // The nodes of the first brick the other way round.
    let good = std::fs::read_to_string(folder.path().join("pad.msh")).unwrap();
    let is_brick = |line: &&str| line.split(' ').count() == 13 && line.contains(" 5 2 ");
    let brick: Vec<&str> = good.lines().find(is_brick).unwrap().split(' ').collect();
    let turned = [&brick[..5], &brick[9..], &brick[5..9]].concat().join(" ");
    let inverted = good.replacen(&brick.join(" "), &turned, 1);
    std::fs::write(folder.path().join("inverted.msh"), inverted).unwrap();
    let inverted = format!("{pad}interference = 1e-6\n{cea}").replace("pad.msh", "inverted.msh");
    let errors = Case::parse(path.to_str().unwrap(), inverted.as_bytes(), &[]).unwrap_err();
    let said = errors.to_string();
    assert!(said.contains("is inverted") && !said.contains("help: `mesh.file`"), "{said}");
    let lossy = pad.replace("density", "loss_factor = 0.01\ndensity");
    for (text, reason) in [
        (format!("{pad}interference = 0.0\n{cea}"), "nothing presses the contact"),
        (format!("{floating}{cea}"), "nothing presses the two sides of contacts.pads"),
        (format!("{along}interference = 1e-6\n{cea}"), "would move along it"),
        (format!("{ring}{cea}"), "none of them lies under the ring alone"),
        (format!("{pad}interference = 1e-6\n{frf}"), "cannot move in z direction"),
        (
            format!("{lossy}interference = 1e-6\n{cea}[improve]\nmass = 0.01\n"),
            "improve takes derivatives",
        ),
    ] {
        let case = Case::parse(path.to_str().unwrap(), text.as_bytes(), &[]);
        let case = case.unwrap_or_else(|errors| panic!("{errors}"));
        let refused = preflight(&case, f64::INFINITY).unwrap_err();
        assert!(refused.is_usage() && refused.to_string().contains(reason), "{refused}");
    }
}
