//! The table for people.

use super::TransientReport;
use std::fmt::Write as _;

/// What the run did, in a few lines.
pub fn print(report: &TransientReport<'_>) -> String {
    let mut out = String::new();
    let cycle = &report.analysis.limit_cycle;
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    let _ = writeln!(
        out,
        "{} steps of {:.4e} s ({} operator), {:.1} million element-steps a second",
        report.steps,
        report.plan.time_step,
        report.operator,
        1e-6 * report.element_steps_per_second(),
    );
    let _ = writeln!(
        out,
        "largest energy balance residual {:.1e}",
        report.analysis.largest_residual
    );
    for growth in &report.analysis.growth {
        let _ = writeln!(
            out,
            "linear stage: harmonic {} {} at {:.1} 1/s, {:.1} Hz, travelling {} the rotor",
            growth.harmonic,
            if growth.rate > 0.0 { "grows" } else { "decays" },
            growth.rate.abs(),
            growth.frequency_hz,
            if growth.direction > 0 {
                "with"
            } else {
                "against"
            },
        );
    }
    if let Some(time) = report.analysis.first_nonlinearity {
        let _ = writeln!(out, "first node that sticks or opens at {time:.6} s");
    }
    let _ = writeln!(out, "over the last fifth of the run:");
    match (cycle.main_frequency_hz, cycle.main_harmonic) {
        (Some(frequency), Some(harmonic)) => {
            let _ = writeln!(
                out,
                "  main frequency {frequency:.1} Hz, {harmonic} nodal diameters"
            );
        }
        _ => out.push_str("  no vibration\n"),
    }
    let [stick, slip, open] = cycle.status;
    let _ = writeln!(
        out,
        "  contact nodes: stick {stick:.3}, slip {slip:.3}, open {open:.3}"
    );
    powers(&mut out, report);
    out
}

fn powers(out: &mut String, report: &TransientReport<'_>) {
    let cycle = &report.analysis.limit_cycle;
    let powers = &cycle.powers;
    let _ = writeln!(
        out,
        "  external power {:.2} W: stick {:.1} %, slide {:.1} %, dissipated in the contact {:.1} %",
        report.thickness * powers.external,
        100.0 * powers.stick / powers.external,
        100.0 * powers.slide / powers.external,
        100.0 * powers.contact_dissipated / powers.external,
    );
    let _ = writeln!(
        out,
        "  dissipated in the body {:.2} W, normal contact {:.2} W",
        report.thickness * cycle.material_damping,
        report.thickness * powers.normal,
    );
}
