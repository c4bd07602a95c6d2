//! The table for people.

use super::summary::{GrowthSummary, TransientSummary};
use crate::results::extent::Extent;
use crate::results::quantity::fixed;
use crate::results::summary::MeanPowers;
use crate::transient::EndState;
use std::fmt::Write as _;

/// Periods of the main vibration between two contact frames beyond which they do not show it.
const COARSE_FRAMES: f64 = 0.25;

/// What the run did, in a few lines.
pub fn print(summary: &TransientSummary, state: EndState) -> String {
    let mut out = String::new();
    if !summary.title.is_empty() {
        let _ = writeln!(out, "{}", summary.title);
    }
    let _ = writeln!(
        out,
        "{} steps of {:.4e} s ({} operator), {} million element-steps a second",
        summary.steps,
        summary.time_step_s,
        summary.operator,
        fixed(1e-6 * summary.element_steps_per_s, 1),
    );
    let _ = writeln!(out, "largest energy balance residual {:.1e}", summary.max_balance_residual);
    summary.growth.iter().for_each(|stage| growth(&mut out, stage));
    for (vibration, reason) in &summary.no_growth {
        let of = match vibration.strip_prefix('n') {
            Some(harmonic) => format!(" of harmonic {harmonic}"),
            None => String::new(),
        };
        let _ = writeln!(out, "linear stage: no growth rate{of}: {reason}");
    }
    if let Some(time) = summary.first_nonlinearity_s {
        let _ = writeln!(out, "first node that sticks or opens at {time:.6} s");
    }
    let _ = writeln!(out, "{}", ending(summary, state));
    let _ = writeln!(out, "over the last fifth of the run:");
    match (summary.main_frequency_hz, summary.main_harmonic) {
        (Some(frequency), harmonic) => {
            let diameters = match harmonic {
                None => String::new(),
                Some(1) => ", 1 nodal diameter".to_owned(),
                Some(n) => format!(", {n} nodal diameters"),
            };
            let frequency = fixed(frequency, 1);
            let _ = writeln!(out, "  main frequency {frequency} Hz{diameters}");
        }
        (None, _) => out.push_str("  no vibration\n"),
    }
    let status = &summary.status;
    let _ = writeln!(
        out,
        "  contact nodes: stick {}, slip {}, open {}",
        optional(status.stick, 3),
        optional(status.slip, 3),
        optional(status.open, 3)
    );
    powers(&mut out, &summary.power_w, summary.extent);
    if let Some(share) = summary.ambiguous_friction {
        let _ = writeln!(
            out,
            "  in {} % of the contact-node steps the friction law is too steep for the time step, and nodes jump between \
             stick and slip: reduce transient.time_step or raise contact.decay_speed",
            fixed(100.0 * share, 3)
        );
    }
    if let Some(steps) = summary.unconverged_steps {
        let _ = writeln!(
            out,
            "  forces between the bodies had not converged in {steps} of {} steps: there they are approximate, though the \
             energy closes; many contact nodes meet one node of the other body: exchange the two sides of the contact, or \
             refine the other body",
            summary.steps
        );
    }
    for (node, probe) in &summary.probes {
        if let Some(place) = probe.place {
            let [[x, y], [p, q]] =
                [place.asked_m, place.at_m].map(|at| at.map(|c| fixed(1e3 * c, 3)));
            let _ = writeln!(out, "  probe at ({x}, {y}) mm: node {node} at ({p}, {q}) mm");
        }
    }
    let periods = summary.main_frequency_hz.map(|f| f * summary.contact_interval_s);
    if periods.is_some_and(|periods| periods > COARSE_FRAMES) {
        let _ = writeln!(
            out,
            "contact.npz has a frame every {:.2e} s, too few for a wave of that frequency: set output.contact_interval",
            summary.contact_interval_s
        );
    }
    for note in &summary.notes {
        let _ = writeln!(out, "note: {note}");
    }
    out
}

/// Where the run has come to, as a sentence.
pub fn ending(summary: &TransientSummary, state: EndState) -> String {
    let end = format!("the run ends {}", state.phrase());
    let end = match (summary.frequencies_hz, summary.envelope_ratio) {
        (Some([first, second]), Some(ratio)) => format!(
            "{end}: {} and {} Hz, its envelope swings by a factor of {}",
            fixed(first, 1),
            fixed(second, 1),
            fixed(ratio, 2)
        ),
        _ => end,
    };
    match (summary.settled_from_s, &summary.unsettled_because) {
        (Some(from), _) => format!("{end}, settled from {from:.6} s on"),
        (None, Some(reason)) => format!("{end}: {reason}"),
        (None, None) => end,
    }
}

fn growth(out: &mut String, stage: &GrowthSummary) {
    let (low, high) = (stage.rate_low_per_s, stage.rate_high_per_s);
    let verb = match stage.rate_per_s {
        _ if low <= 0.0 && high >= 0.0 => "neither grows nor decays:",
        rate if rate > 0.0 => "grows at",
        _ => "decays at",
    };
    let vibration = match stage.harmonic {
        Some(harmonic) => format!("harmonic {harmonic}"),
        None => "the strongest vibration".to_owned(),
    };
    let way = match stage.direction {
        None => "",
        Some(1..) => ", travelling with the rotor",
        Some(_) => ", travelling against the rotor",
    };
    let _ = writeln!(
        out,
        "linear stage: {vibration} {verb} {} 1/s ({} to {}), {} Hz{way}",
        fixed(stage.rate_per_s, 1),
        fixed(low, 1),
        fixed(high, 1),
        fixed(stage.frequency_hz, 1),
    );
}

/// A number, or a dash where there is none.
fn optional(value: Option<f64>, decimals: usize) -> String {
    fixed(value.unwrap_or(f64::NAN), decimals)
}

fn powers(out: &mut String, powers: &MeanPowers, extent: Extent) {
    let unit = extent.unit("W");
    match powers.external.filter(|power| *power != 0.0) {
        None => out.push_str("  no external power: nothing slides\n"),
        Some(external) => {
            let share = |power: Option<f64>| optional(power.map(|p| 100.0 * p / external), 1);
            let _ = writeln!(
                out,
                "  external power {} {unit}: stick {} %, slide {} %, dissipated in the contact {} %",
                fixed(external, 2),
                share(powers.stick),
                share(powers.slide),
                share(powers.contact_dissipated),
            );
        }
    }
    let _ = writeln!(
        out,
        "  dissipated in the body {} {unit}, normal contact {} {unit}",
        optional(powers.material_damping, 2),
        optional(powers.normal_contact, 2),
    );
    if let Some(power) = powers.contact_damping {
        let _ = writeln!(out, "  dissipated in dashpots of the contact {} {unit}", fixed(power, 2));
    }
    if let Some(note) = extent.note() {
        let _ = writeln!(out, "  {note}");
    }
}
