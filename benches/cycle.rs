//! Cost of limit cycles on the mesh of 180 x 35 elements, and along a parameter on a body without rotating waves.
//!
//! `cargo bench cycle`. Prints, for one and two nodal diameters, the time to find the cycle at 610 rpm from its
//! birth, the time from a cycle to a neighbour at a speed 2 % higher or 20 % lower (fastest of several), that of its
//! stability, and the time of the branch over 61 speeds from 10 to 6000 rpm. Then 60 cycles of the shipped case on 300 x 13
//! elements (8,400 unknowns, 300 contact nodes), where friction falls with speed, over friction and over speed. Without `--bench`
//! (as `cargo test --benches` calls it) meshes are coarse, branches have three values, and everything is done once.

use crate::is_measured;
use crate::prelude::*;
use frictionsim::study::cycle::PeriodicStudy;

/// A count where something is measured, else a small one.
fn counted(full: usize, small: usize) -> usize {
    if is_measured() { full } else { small }
}

pub fn run() {
    let specification = annulus(Quad4, counted(180, 90), counted(35, 18));
    let point = OperatingPoint { contact: contact(610.0), damping: DAMPING };
    let model = DiscModel { specification, material: POLYCARBONATE, damping: DAMPING };
    println!("n  from birth  +2 %  -20 %  stability  61 speeds  factorizations");
    for harmonic in [1, 2] {
        let family = Family::lowest(harmonic);
        let onset = model.onset_of(family, ModeLimit::Lowest(MODES)).expect("an onset");
        let solver = CycleSolver::born_at(&model, family, &onset, None).expect("a valid mesh");
        let start = Instant::now();
        let cycle = solver.find(&point).expect("a limit cycle");
        let birth = start.elapsed();
        let neighbour = |factor: f64| {
            let speed = factor * point.contact.rotation_speed;
            fastest(|| {
                solver.continue_to(&cycle, Parameter::RotationSpeed, speed).expect("a neighbour");
            })
        };
        let (near, far) = (neighbour(1.02), neighbour(0.8));
        let stability = fastest(|| {
            let stepping =
                solver.stepping(SimdLevel::detect()).expect("a mesh of one element kind");
            stepping.settle(&cycle, None).expect("exponents");
        });
        let speeds: Vec<f64> = (61 - counted(61, 3)..61)
            .map(|i| 10.0 * 600f64.powf(i as f64 / 60.0) * TAU / 60.0)
            .collect();
        let start = Instant::now();
        let branch = solver.follow(&cycle, Parameter::RotationSpeed, &speeds);
        println!(
            "{harmonic}  {birth:.2?}  {near:.2?}  {far:.2?}  {stability:.2?}  {:.2?}  {}",
            start.elapsed(),
            branch.factorizations
        );
    }
    whole_mesh("contact.friction_coefficient", [0.2, 0.4]);
    whole_mesh("contact.rotation_speed_rpm", [300.0, 1200.0]);
}

/// 60 cycles as motions of the whole mesh along a key.
fn whole_mesh(key: &str, range: [f64; 2]) {
    let ([from, to], count) = (range, counted(60, 3));
    let overrides = [
        format!("mesh.circumferential_elements={}", counted(300, 72)),
        format!("mesh.radial_elements={}", counted(13, 5)),
        "contact.static_friction_ratio=1.3".to_owned(),
        "contact.decay_speed=0.5".to_owned(),
        "cycle.stability=\"none\"".to_owned(),
        "cycle.confirmation_periods=0".to_owned(),
        format!("cycle.continuation={{ key=\"{key}\", from={from}, to={to}, count={count} }}"),
    ];
    let text = fs::read_to_string(shipped("limit-cycle.toml")).expect("a shipped case");
    let case = case_of("disc", &text.replace("harmonics = [1, 2]", ""), &overrides);
    let start = Instant::now();
    let study = PeriodicStudy::new(&case, SimdLevel::detect()).expect("a body");
    let results = study.run(0, &Unwatched, &|_| {}).expect("a search");
    for result in &results {
        let branch = result.outcome.as_ref().expect("a cycle").branch.as_ref().expect("a branch");
        let periods = branch.motions.iter().map(|own| own.motion.periods);
        println!(
            "{key}: {} cycles in {:.1?}, {} periods along the branch",
            branch.motions.len(),
            start.elapsed(),
            periods.sum::<usize>()
        );
    }
}

fn fastest(mut work: impl FnMut()) -> Duration {
    let times = (0..counted(5, 1)).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed()
    });
    times.min().unwrap_or_default()
}
