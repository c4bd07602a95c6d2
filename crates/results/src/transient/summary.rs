//! `summary.json` of a transient.

use super::RecordedRun;
use crate::common::*;
use frictionsim_physics::transient::{Drift, Growth, Perturbation, TransientAnalysis};

keys! {
    /// `summary.json` of `frictionsim transient`.
    TransientSummary {
        finished: bool = "whether the run reached its end, or stopped because it had settled";
        steps: u64 = "steps done";
        time_step_s: f64 = "time step, s";
        end_time_s: f64 = "time of the last sample, s";
        stability_limit_s: f64 = "largest stable step, s";
        largest_frequency_rad_per_s: f64 = "`omega_max`, rad/s";
        operator: String = "`cyclic` or `sparse`";
        initial: String = "state at the start";
        perturbation: PerturbationSummary = "velocity that was added";
        element_steps_per_s: f64 = "elements times steps for each second of stepping";
        max_balance_residual: f64 = "largest energy balance residual";
        settled: bool = "whether amplitude, frequency and status drift by less than 1 % over the last fifth of the run";
        settled_from_s: Option<f64> = "since when, s";
        end_state: String = "`limit-cycle`, `two-frequency`, `steady-sliding`, `at-rest`, `separated` or `unsettled`";
        frequencies_hz?: [f64; 2] = "both frequencies of a motion of two, the stronger first, Hz; absent otherwise";
        envelope_ratio?: f64 = "largest over smallest envelope of a motion of two \
            frequencies over the last fifth; absent otherwise";
        unsettled_because: Option<String> = "why it is unsettled";
        drift: Option<Drift> = "drift over the last fifth";
        main_frequency_hz: Option<f64> = "main frequency over the last fifth, Hz; absent where nothing vibrates";
        main_harmonic: Option<usize> = "harmonic of that vibration";
        main_amplitude_m: Option<f64> = "its root mean square, tangential displacement of the contact edge, m";
        status: StatusFractions = "fractions of contact nodes over the last fifth";
        power_w: MeanPowers = "mean powers over the last fifth";
        extent: Extent = "what powers, energies and forces are of, in the tables too";
        ambiguous_friction?: f64 = "share of the steps of contact nodes that could have \
            ended in stick and in slip alike; absent where there is none";
        unconverged_steps?: u64 = "steps in which the forces between two bodies had not \
            converged; absent where there is none";
        harmonics: Vec<f64> = "mean amplitudes of the harmonics 0 to 8 of the contact edge's \
            tangential displacement, m; empty for a body without symmetry";
        significant_harmonics_m: BTreeMap<String, f64>
            = "the same of all harmonics `n >= 1` above a thousandth of the largest, by `nN`";
        growth: Vec<GrowthSummary> = "rates in the linear stage of the perturbed harmonics that \
            have one; of a body without symmetry that of its strongest vibration";
        no_growth: BTreeMap<String, String>
            = "why the others have none, by `nN`; `strongest` for a body without symmetry";
        first_nonlinearity_s: Option<f64> = "when the first node sticks or opens after the linear stage, s";
        probes: BTreeMap<String, ProbeSummary> = "motion of the probes over the last fifth, by node";
        contact_interval_s: f64 = "time between the frames of `contact.npz`, s";
        notes: Vec<String> = "what to know before its numbers are used";
    }

    /// The velocity that was added.
    PerturbationSummary {
        harmonics: Vec<usize> = "circumferential harmonics";
        velocity: Value = "amplitude, m/s: one for all harmonics, or one for each";
        phase_deg: Value = "phase, degrees, likewise";
        noise: f64 = "standard deviation of the random part, m/s";
        noise_seed: u64 = "its seed";
        at_s: f64 = "when it was added, s";
    }
}

/// One number for all harmonics, or one for each.
fn one_or_each(values: impl Iterator<Item = f64>) -> Value {
    let values: Vec<f64> = values.collect();
    match values.as_slice() {
        [first, others @ ..] if others.iter().all(|v| v == first) => Value::from(*first),
        _ => Value::from(values),
    }
}

keys! {
    /// Growth of one harmonic, with 95 % intervals.
    #[derive(Copy)]
    GrowthSummary {
        harmonic?: usize = "circumferential harmonic; absent for a body without symmetry";
        rate_per_s: f64 = "rate, 1/s";
        rate_low_per_s: f64 = "low end of its interval, 1/s";
        rate_high_per_s: f64 = "high end, 1/s";
        frequency_hz: f64 = "frequency, Hz";
        direction?: i8 = "+1 with the rotor, -1 against it; absent for a body without symmetry";
    }

    /// Motion of a probe over the last fifth; accelerations are means over the sample interval.
    #[derive(Copy)]
    ProbeSummary {
        place?: PlaceSummary = "where it is, if it was asked for by its place";
        radial?: ProbeMotion = "radially; absent on a plane counterface and of solid bodies of a mesh";
        normal?: ProbeMotion = "along the normal of a plane counterface; absent of other bodies";
        tangential?: ProbeMotion = "tangentially; absent of solid bodies of a mesh";
        axial?: ProbeMotion = "along the axis; absent in the plane and of solid bodies of a mesh";
        x?: ProbeMotion = "along x, of solid bodies of a mesh";
        y?: ProbeMotion = "along y, of solid bodies of a mesh";
        z?: ProbeMotion = "along z, of solid bodies of a mesh";
    }

    /// A place that was asked for, and its nearest node.
    #[derive(Copy)]
    PlaceSummary {
        asked_m: [f64; 2] = "the place, `x` and `y`, m";
        at_m: [f64; 2] = "the node, m";
    }
}

/// The summary of a run.
pub fn summary(run: &RecordedRun<'_>) -> TransientSummary {
    let (solved, plan, analysis) = (run.solved, &run.solved.plan, &run.solved.analysis);
    let (end, settling) = (&analysis.last_fifth, &analysis.settling);
    let body = end.material_damping * run.thickness;
    let damping = Some(run.thickness * end.powers.damping);
    let two = if let EndState::TwoFrequency(two) = settling.state { Some(two) } else { None };
    let significant = end.significant.iter().map(|(n, size)| (format!("n{n}"), *size));
    TransientSummary {
        finished: solved.is_finished,
        steps: solved.steps,
        time_step_s: plan.time_step,
        end_time_s: solved.steps.saturating_sub(1) as f64 * plan.time_step,
        stability_limit_s: plan.limit,
        largest_frequency_rad_per_s: plan.largest_frequency,
        operator: solved.operator.to_owned(),
        initial: run.settings.initial.name().to_owned(),
        perturbation: PerturbationSummary::of(&run.settings.perturbation),
        element_steps_per_s: run.element_steps_per_second(),
        max_balance_residual: analysis.largest_residual,
        settled: settling.is_settled(),
        settled_from_s: settling.from,
        end_state: settling.state.name().to_owned(),
        frequencies_hz: two.map(|two| two.frequencies_hz),
        envelope_ratio: two.and_then(|two| present(two.envelope_ratio)),
        unsettled_because: settling.reason.map(|reason| reason.to_string()),
        drift: settling.drift,
        main_frequency_hz: end.main_frequency_hz,
        main_harmonic: end.main_harmonic,
        main_amplitude_m: end.main_amplitude,
        status: StatusFractions::of(end.status),
        power_w: MeanPowers {
            contact_damping: damping.filter(|_| run.solved.record.has_contact_springs()),
            ..MeanPowers::of(&end.powers.scaled(run.thickness), body)
        },
        extent: run.extent,
        ambiguous_friction: run.solved.record.ambiguous_share(),
        unconverged_steps: Some(run.solved.record.unconverged_steps).filter(|steps| *steps > 0),
        harmonics: if run.has_harmonics { end.harmonics.to_vec() } else { Vec::new() },
        significant_harmonics_m: significant.collect(),
        growth: analysis.growth.iter().filter_map(growth).collect(),
        no_growth: no_growth(analysis),
        first_nonlinearity_s: analysis.first_nonlinearity,
        probes: probes(run),
        contact_interval_s: run.solved.record.frame_stride as f64 * plan.sample_interval,
        notes: run.notes.clone(),
    }
}

fn growth(growth: &Growth) -> Option<GrowthSummary> {
    let stage = growth.stage.as_ref().ok()?;
    Some(GrowthSummary {
        harmonic: growth.harmonic,
        rate_per_s: stage.rate_per_s.value,
        rate_low_per_s: stage.rate_per_s.low,
        rate_high_per_s: stage.rate_per_s.high,
        frequency_hz: stage.frequency_hz.value.abs(),
        direction: growth.harmonic.map(|_| growth.direction()),
    })
}

fn no_growth(analysis: &TransientAnalysis) -> BTreeMap<String, String> {
    let reasons = analysis.growth.iter().filter_map(|growth| {
        let reason = growth.stage.as_ref().err()?;
        let name = growth.harmonic.map_or_else(|| "strongest".to_owned(), |n| format!("n{n}"));
        Some((name, reason.to_string()))
    });
    reasons.collect()
}

fn probes(run: &RecordedRun<'_>) -> BTreeMap<String, ProbeSummary> {
    let motions = run.solved.analysis.last_fifth.probes.iter().enumerate();
    motions
        .map(|(probe, motion)| {
            let node = run.solved.record.probes[probe] - 1;
            let mut places = run.places.iter();
            let place = places.find(|place| place.0 == node).map(|&(_, asked_m)| {
                let [x, y, _] = run.body.position(node);
                PlaceSummary { asked_m, at_m: [x, y] }
            });
            let along = |name: &str| {
                let mut named = run.directions().into_iter().zip(motion);
                named.find(|([own, _], _)| *own == name).map(|(_, own)| *own)
            };
            let summary = ProbeSummary {
                place,
                radial: along("radial"),
                normal: along("normal"),
                tangential: along("tangential"),
                axial: along("axial"),
                x: along("x"),
                y: along("y"),
                z: along("z"),
            };
            (run.probe_label(probe).to_string(), summary)
        })
        .collect()
}

impl PerturbationSummary {
    fn of(perturbation: &Perturbation) -> Self {
        let waves = perturbation.waves.iter();
        Self {
            harmonics: perturbation.harmonics(),
            velocity: one_or_each(waves.clone().map(|wave| wave.velocity)),
            phase_deg: one_or_each(waves.map(|wave| wave.phase.to_degrees())),
            noise: perturbation.noise,
            noise_seed: perturbation.noise_seed,
            at_s: perturbation.time,
        }
    }
}
