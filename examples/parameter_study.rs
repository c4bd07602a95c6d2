//! A study in a handful of calls: the modes of a shipped case that grow, at two interferences and two friction
//! coefficients.
//!
//! `cargo run --release --example parameter_study`

use frictionsim::case::Case;
use frictionsim::cea::ModeLimit;
use frictionsim::fem::MassKind;
use frictionsim::study::{SweepPlan, modes_at_own_friction, tangent_options};
use std::error::Error;

const SWEEP: &str = "
[sweep]
\"contact.interference\" = [20e-6, 30e-6]
\"contact.friction_coefficient\" = [0.1, 0.3]
";

/// Solves and prints.
pub fn main() -> Result<(), Box<dyn Error>> {
    let disc = include_str!("../cases/polycarbonate-disc.toml");
    let coarse = ["mesh.circumferential_elements=60", "mesh.radial_elements=12"];
    let text = format!("{disc}{SWEEP}");
    let case = Case::parse("study.toml", text.as_bytes(), &coarse.map(str::to_owned))?;
    let plan = SweepPlan::new(&case)?;
    let mut growing = Vec::new();
    for point in 1..=plan.count() {
        let case = plan.point_case(point)?;
        let options = tangent_options(&case, MassKind::Consistent);
        let modes = modes_at_own_friction(&case, &options, ModeLimit::MaxFrequency(11_000.0))?;
        let unstable = modes.iter().filter(|mode| mode.is_unstable());
        growing.push(unstable.clone().count());
        for mode in unstable {
            println!(
                "{:?}: n = {} at {:.0} Hz grows at {:.0} 1/s",
                plan.swept(point),
                mode.harmonic,
                mode.frequency_hz(),
                mode.growth_rate()
            );
        }
    }
    // Friction makes them grow, from 0.12 on; the interference hardly matters.
    // The last key in alphabetical order, the interference, runs fastest.
    let [low, also_low, high, also_high] = growing[..] else {
        return Err("four points".into());
    };
    assert!(low == 0 && also_low == 0 && high > 0 && high == also_high);
    Ok(())
}
