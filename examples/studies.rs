//! Studies in a handful of calls: the limit cycle of a shipped case without time stepping, which of two waves wins, and how
//! likely squeal is, each on a coarse mesh.
//!
//! `cargo run --release --example studies`

use frictionsim::case::Case;
use frictionsim::fem::operator::SimdLevel;
use frictionsim::study::basin::boundary;
use frictionsim::study::cycle::CycleStudy;
use frictionsim::study::uncertainty::{BLOCK, Sampler, summarize};
use std::error::Error;

/// A shipped case with other values for some keys.
fn case(text: &str, values: &[&str]) -> Result<Case, Box<dyn Error>> {
    let overrides: Vec<String> = values.iter().map(|value| value.to_string()).collect();
    Ok(Case::parse("case.toml", text.as_bytes(), &overrides)?)
}

fn limit_cycle(simd: SimdLevel) -> Result<(), Box<dyn Error>> {
    let coarse = ["mesh.circumferential_elements=90", "mesh.radial_elements=18"];
    let alone = ["cycle.harmonics=[2]", "cycle.stability=\"none\""];
    let at_once = ["cycle.continuation.count=2", "cycle.confirmation_periods=0"];
    let near = ["cycle.continuation.from=600", "cycle.continuation.to=620"];
    let text = include_str!("../cases/limit-cycle.toml");
    let case = case(text, &[coarse, alone, at_once, near].concat())?;
    let found = CycleStudy::new(&case, simd)?.run(0, &|| {});
    let cycle = &found[0].outcome.as_ref().map_err(|absence| absence.reason.clone())?.cycle;
    let [stick, slip, open] = cycle.fractions;
    println!(
        "a wave of 2 nodal diameters at {:.0} Hz: stick {stick:.2}, slip {slip:.2}, open {open:.2}",
        cycle.frequency_hz()
    );
    // The energy that friction brings is dissipated within a period.
    assert!(cycle.powers.balance_residual() < 1e-10);
    Ok(())
}

fn basin(simd: SimdLevel) -> Result<(), Box<dyn Error>> {
    let coarse = ["mesh.circumferential_elements=48", "mesh.radial_elements=9"];
    let contested = [
        "basin.tolerance=3.0",
        "contact.friction_coefficient=0.4",
        "contact.rotation_speed_rpm=300",
    ];
    let text = include_str!("../cases/basin.toml");
    let found = boundary(&case(text, &[&coarse[..], &contested].concat())?, simd)?;
    let (low, high) = (found.low.ok_or("bounded")?, found.high.ok_or("bounded")?);
    println!("the second wave wins above {high:.2} of the first, the first below {low:.2}");
    assert!(low < high);
    Ok(())
}

fn squeal() -> Result<(), Box<dyn Error>> {
    let coarse = ["mesh.circumferential_elements=36", "mesh.radial_elements=7"];
    let samples = format!("uncertainty.samples={BLOCK}");
    let text = include_str!("../cases/squeal-probability.toml");
    let case = case(text, &[&coarse[..], &[&samples]].concat())?;
    let found = summarize(&case, &Sampler::new(&case)?.block(1));
    let p = found.probability_unstable;
    println!("squeal has the probability {:.2} ({:.2} to {:.2})", p.value, p.low, p.high);
    // Nothing grows without friction, and more friction makes squeal no rarer.
    let over = &found.probability_over_friction;
    assert!(over[0][1] == 0.0 && over.last().is_some_and(|end| end[1] >= p.value));
    Ok(())
}

/// Solves and prints.
pub fn main() -> Result<(), Box<dyn Error>> {
    let simd = SimdLevel::detect();
    limit_cycle(simd)?;
    basin(simd)?;
    squeal()
}
