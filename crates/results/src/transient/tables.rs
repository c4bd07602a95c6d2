//! Tables and sentences of a transient.

use super::RecordedRun;
use super::summary::{GrowthSummary, TransientSummary};
use crate::common::*;

/// Periods of the main vibration between two contact frames beyond which they do not show it.
const COARSE_FRAMES: f64 = 0.25;

/// Node, direction and motion of a probe.
type ProbeRow = (String, &'static str, ProbeMotion);
/// A vibration in the linear stage: its harmonic, its growth or why it has none, the rate of the eigenvalue analysis.
type GrowthRow = (String, Result<GrowthSummary, String>, Option<f64>);

columns! {
    /// A probe in one direction.
    PROBES: row as ProbeRow;
    node = row.0.clone(), Always "node" Plain;
    direction = row.1, Always "direction" Plain;
    rms_m_per_s2 = row.2.acceleration_rms_m_per_s2, Always "root mean square" Fixed(0);
    peak_m_per_s2 = row.2.acceleration_peak_m_per_s2, Always "peak" Fixed(0);

    /// A vibration in the linear stage.
    GROWTH: row as GrowthRow;
    vibration = row.0.clone(), Always "vibration" Plain;
    rate_per_s = row.1.as_ref().ok().map(|own| own.rate_per_s), IfAny "rate" Fixed(2);
    low_per_s = row.1.as_ref().ok().map(|own| own.rate_low_per_s), IfAny "95 % from" Fixed(2);
    high_per_s = row.1.as_ref().ok().map(|own| own.rate_high_per_s), IfAny "to" Fixed(2);
    predicted_per_s = row.2, IfAny "rate of the eigenvalue analysis" Fixed(2);
    frequency_hz = row.1.as_ref().ok().map(|own| own.frequency_hz), IfAny "frequency" Fixed(1);
    travels = row.1.as_ref().ok().and_then(|own| own.direction)
            .map(|way| if way > 0 { "with the rotor" } else { "against the rotor" }),
        IfAny "travels" Plain;
    reason = row.1.as_ref().err().cloned(), IfAny "why there is none" Plain;
}

/// Tables and sentences of a run; beside its growth that of the eigenvalue analysis, where there is one.
pub fn document(run: &RecordedRun<'_>, summary: &TransientSummary) -> Document {
    let state = run.solved.analysis.settling.state;
    let heading = match state {
        EndState::LimitCycle => "Limit cycle",
        EndState::TwoFrequency(_) => "Vibration of two frequencies",
        EndState::SteadySliding => "Steady sliding",
        EndState::AtRest | EndState::Separated => "Rest",
        EndState::Unsettled => "End of the run, not settled",
    };
    let end = ending(summary, state);
    let end = format!("{end}. The numbers are means over the last fifth of the run.");
    let extent = summary.extent.sentence();
    Document::new("Transient")
        .section(Section::new("Results").text([end]).text(extent).facts(facts(summary)))
        .section(
            Section::new("Course of the run")
                .text([course(summary)])
                .text(warnings(summary))
                .text(places(summary))
                .figures([""]),
        )
        .section(Section::new(heading).tables([motions(summary, run), growth(summary, run)]))
        .notes(&summary.notes)
}

/// Where the run has come to, as a sentence.
fn ending(summary: &TransientSummary, state: EndState) -> String {
    let end = format!("The run ends {}", state.phrase());
    let end = match (summary.frequencies_hz, summary.envelope_ratio) {
        (Some(pair), Some(ratio)) => {
            let ([first, second], factor) = (pair.map(|hz| fixed(hz, 1)), fixed(ratio, 2));
            format!("{end}: {first} and {second} Hz, its envelope swings by a factor of {factor}")
        }
        _ => end,
    };
    match (summary.settled_from_s, &summary.unsettled_because) {
        (Some(from), _) => format!("{end}, settled from {from:.6} s on"),
        (None, Some(reason)) => format!("{end}; {reason}"),
        (None, None) => end,
    }
}

fn course(summary: &TransientSummary) -> String {
    let end = if summary.finished { "complete" } else { "stopped before its end" };
    let first = match summary.first_nonlinearity_s {
        Some(time) => {
            format!("the first contact node sticks or opens at {} ms", fixed(1e3 * time, 3))
        }
        None => "no contact node sticks or opens".into(),
    };
    let TransientSummary { steps, initial, operator, max_balance_residual, .. } = summary;
    let (ms, step) = (fixed(1e3 * summary.end_time_s, 3), fixed(1e6 * summary.time_step_s, 4));
    format!(
        "{ms} ms in {steps} steps of {step} µs ({end}), from {initial}, {operator} operator; {first}; the energy \
         balance closes to {max_balance_residual:.1e}."
    )
}

/// What makes the numbers doubtful.
fn warnings(summary: &TransientSummary) -> Vec<String> {
    let steep = summary.ambiguous_friction.map(|share| {
        format!(
            "In {} % of the contact-node steps the friction law is too steep for the time step, and nodes jump between \
             stick and slip. Reduce transient.time_step or raise contact.decay_speed.",
            fixed(100.0 * share, 3)
        )
    });
    let open = summary.unconverged_steps.map(|steps| {
        format!(
            "Contact forces had not converged in {steps} of {} steps: there they are approximate, \
             though the energy closes. Where many contact nodes meet one node of another body, \
             exchange the two sides of the contact, or refine that body.",
            summary.steps
        )
    });
    let periods = summary.main_frequency_hz.map(|f| f * summary.contact_interval_s);
    let coarse = periods.is_some_and(|periods| periods > COARSE_FRAMES).then(|| {
        format!(
            "contact.npz has a frame every {:.2e} s, too few for a wave of that frequency: set \
            output.contact_interval.",
            summary.contact_interval_s
        )
    });
    [steep, open, coarse].into_iter().flatten().collect()
}

/// The nodes of probes that were asked for by their place.
fn places(summary: &TransientSummary) -> Vec<String> {
    let places = summary.probes.iter().filter_map(|(node, probe)| {
        let place = probe.place?;
        let [[x, y], [p, q]] = [place.asked_m, place.at_m].map(|at| at.map(|c| fixed(1e3 * c, 3)));
        Some(format!("Probe at ({x}, {y}) mm: node {node} at ({p}, {q}) mm."))
    });
    places.collect()
}

/// What decides, over the last fifth of the run.
fn facts(summary: &TransientSummary) -> Vec<(String, String)> {
    let (status, power) = (&summary.status, &summary.power_w);
    let entry = |name: &str, value: Option<f64>, format: Format, unit: &str| {
        Some((name.to_owned(), format.text(value?, unit)))
    };
    let unit = summary.extent.unit("W");
    let watts = |name: &str, value: Option<f64>| entry(name, value, Format::Fixed(2), &unit);
    let hertz = |name: &str, value: Option<f64>| entry(name, value, Format::Fixed(2), "Hz");
    let share = |name: &str, value: Option<f64>| entry(name, value, Format::Percent(2), "%");
    let settled = match (summary.settled, summary.settled_from_s) {
        (true, Some(time)) => format!("from {} ms on", fixed(1e3 * time, 3)),
        (true, None) => "yes".to_owned(),
        (false, _) => "no".to_owned(),
    };
    let rows = [
        hertz("main frequency", summary.main_frequency_hz),
        summary.main_harmonic.map(|n| ("nodal diameters".to_owned(), n.to_string())),
        hertz("second frequency", summary.frequencies_hz.map(|both| both[1])),
        entry("largest over smallest envelope", summary.envelope_ratio, Format::Fixed(2), ""),
        Some(("settled".to_owned(), settled)),
        share("contact nodes that stick", status.stick),
        share("contact nodes that slip", status.slip),
        share("contact nodes that are open", status.open),
        watts("external power", power.external),
        watts("stick power", power.stick),
        watts("slide power", power.slide),
        watts("dissipated in the contact", power.contact_dissipated),
        watts("dissipated in the body", power.material_damping),
        watts("normal contact power", power.normal_contact),
        watts("dissipated in dashpots of the contact", power.contact_damping),
        watts("power of boundary pressures", power.pressure),
    ];
    rows.into_iter().flatten().collect()
}

/// Accelerations of the probes over the last fifth of the run.
fn motions(summary: &TransientSummary, run: &RecordedRun<'_>) -> Table {
    let rows = summary.probes.iter().flat_map(|(node, own)| {
        let plane = [own.radial, own.normal, own.tangential, own.axial];
        let motions = plane.into_iter().chain([own.x, own.y, own.z]).flatten();
        run.directions().into_iter().zip(motions).map(|(along, own)| (node.clone(), along[0], own))
    });
    let rows: Vec<ProbeRow> = rows.collect();
    Table::new("", "Accelerations over the last fifth of the run").columns(PROBES, &rows)
}

fn growth(summary: &TransientSummary, run: &RecordedRun<'_>) -> Table {
    let rate = |harmonic: Option<usize>| match harmonic {
        Some(n) => run.stage.growth_rates.iter().find(|own| own.0 == n).map(|own| own.1),
        None => run.growing_mode().map(|(_, rate)| rate),
    };
    let fitted = summary.growth.iter().map(|own| {
        let name = own.harmonic.map_or("strongest".to_owned(), |n| format!("n = {n}"));
        (name, Ok(*own), rate(own.harmonic))
    });
    let others = summary.no_growth.iter().map(|(vibration, reason)| {
        let harmonic = vibration.strip_prefix('n').and_then(|n| n.parse().ok());
        let name = harmonic.map_or(vibration.clone(), |n| format!("n = {n}"));
        (name, Err(reason.clone()), harmonic.and_then(|n| rate(Some(n))))
    });
    let rows: Vec<GrowthRow> = fitted.chain(others).collect();
    Table::new("", "Growth in the linear stage").columns(GROWTH, &rows)
}
