//! `summary.json` of a transient.

use super::RecordedRun;
use crate::extent::Extent;
use crate::summary::{MeanPowers, StatusFractions, present};
use frictionsim_output::Described;
use frictionsim_physics::transient::{
    Drift, EndState, Growth, Perturbation, ProbeMotion, TransientAnalysis,
};
use serde::Serialize;
use std::collections::BTreeMap;

/// `summary.json` of `frictionsim transient`.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct TransientSummary {
    /// Whether the run reached its end, or stopped because it had settled.
    pub finished: bool,
    /// Steps done.
    pub steps: u64,
    /// Time step, s.
    pub time_step_s: f64,
    /// Time of the last sample, s.
    pub end_time_s: f64,
    /// Largest stable step, s.
    pub stability_limit_s: f64,
    /// `omega_max`, rad/s.
    pub largest_frequency_rad_per_s: f64,
    /// `cyclic` or `sparse`.
    pub operator: String,
    /// State at the start.
    pub initial: String,
    /// Velocity that was added.
    pub perturbation: PerturbationSummary,
    /// Elements times steps for each second of stepping.
    pub element_steps_per_s: f64,
    /// Largest energy balance residual.
    pub max_balance_residual: f64,
    /// Whether amplitude, frequency and status drift by less than 1 % over the last fifth of the run.
    pub settled: bool,
    /// Since when, s.
    pub settled_from_s: Option<f64>,
    /// `limit-cycle`, `two-frequency`, `steady-sliding`, `at-rest`, `separated` or `unsettled`.
    pub end_state: String,
    /// Both frequencies of a motion of two, the stronger first, Hz; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequencies_hz: Option<[f64; 2]>,
    /// Largest over smallest envelope of a motion of two frequencies over the last fifth; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub envelope_ratio: Option<f64>,
    /// Why it is unsettled.
    pub unsettled_because: Option<String>,
    /// Drift over the last fifth.
    pub drift: Option<Drift>,
    /// Main frequency over the last fifth, Hz; absent where nothing vibrates.
    pub main_frequency_hz: Option<f64>,
    /// Harmonic of that vibration.
    pub main_harmonic: Option<usize>,
    /// Its root mean square, tangential displacement of the contact edge, m.
    pub main_amplitude_m: Option<f64>,
    /// Fractions of contact nodes over the last fifth.
    pub status: StatusFractions,
    /// Mean powers over the last fifth.
    pub power_w: MeanPowers,
    /// What powers, energies and forces are of, in the tables too.
    pub extent: Extent,
    /// Share of the steps of contact nodes that could have ended in stick and in slip alike; absent where there is
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ambiguous_friction: Option<f64>,
    /// Steps in which the forces between two bodies had not converged; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unconverged_steps: Option<u64>,
    /// Mean amplitudes of the harmonics 0 to 8 of the contact edge's tangential displacement, m; empty for a body
    /// without symmetry.
    pub harmonics: Vec<f64>,
    /// The same of all harmonics `n >= 1` above a thousandth of the largest, by `nN`.
    pub significant_harmonics_m: BTreeMap<String, f64>,
    /// Rates in the linear stage of the perturbed harmonics that have one; of a body without symmetry that of its
    /// strongest vibration.
    pub growth: Vec<GrowthSummary>,
    /// Why the others have none, by `nN`; `strongest` for a body without symmetry.
    pub no_growth: BTreeMap<String, String>,
    /// When the first node sticks or opens after the linear stage, s.
    pub first_nonlinearity_s: Option<f64>,
    /// Motion of the probes over the last fifth, by node.
    pub probes: BTreeMap<String, ProbeSummary>,
    /// Time between the frames of `contact.npz`, s.
    pub contact_interval_s: f64,
    /// What to know before its numbers are used.
    pub notes: Vec<String>,
}

/// The velocity that was added.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct PerturbationSummary {
    /// Circumferential harmonics.
    pub harmonics: Vec<usize>,
    /// Amplitude, m/s.
    pub velocity: OneOrEach,
    /// Phase, degrees.
    pub phase_deg: OneOrEach,
    /// Standard deviation of the random part, m/s.
    pub noise: f64,
    /// Its seed.
    pub noise_seed: u64,
    /// When it was added, s.
    pub at_s: f64,
}

/// One number for all harmonics, or one for each.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum OneOrEach {
    /// For all.
    One(f64),
    /// For each.
    Each(Vec<f64>),
}

impl OneOrEach {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        match values.as_slice() {
            [first, others @ ..] if others.iter().all(|v| v == first) => Self::One(*first),
            _ => Self::Each(values),
        }
    }
}

/// Growth of one harmonic, with 95 % intervals.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct GrowthSummary {
    /// Circumferential harmonic; absent for a body without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub harmonic: Option<usize>,
    /// Rate, 1/s.
    pub rate_per_s: f64,
    /// Low end of its interval, 1/s.
    pub rate_low_per_s: f64,
    /// High end, 1/s.
    pub rate_high_per_s: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// +1 with the rotor, -1 against it; absent for a body without symmetry.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<i8>,
}

/// Motion of a probe over the last fifth; accelerations are means over the sample interval.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct ProbeSummary {
    /// Where it is, if it was asked for by its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<PlaceSummary>,
    /// Radially; absent on a plane counterface and of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radial: Option<ProbeMotion>,
    /// Along the normal of a plane counterface; absent of other bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<ProbeMotion>,
    /// Tangentially; absent of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential: Option<ProbeMotion>,
    /// Along the axis; absent in the plane and of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial: Option<ProbeMotion>,
    /// Along x, of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<ProbeMotion>,
    /// Along y, of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<ProbeMotion>,
    /// Along z, of solid bodies of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<ProbeMotion>,
}

/// A place that was asked for, and its nearest node.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct PlaceSummary {
    /// The place, `x` and `y`, m.
    pub asked_m: [f64; 2],
    /// The node, m.
    pub at_m: [f64; 2],
}

/// The summary of a run.
pub fn summary(run: &RecordedRun<'_>) -> TransientSummary {
    let (solved, plan, analysis) = (run.solved, &run.solved.plan, &run.solved.analysis);
    let (end, settling) = (&analysis.last_fifth, &analysis.settling);
    let body = end.material_damping * run.thickness;
    let damping = Some(run.thickness * end.powers.damping);
    let two = match settling.state {
        EndState::TwoFrequency(two) => Some(two),
        _ => None,
    };
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
            velocity: OneOrEach::of(waves.clone().map(|wave| wave.velocity)),
            phase_deg: OneOrEach::of(waves.map(|wave| wave.phase.to_degrees())),
            noise: perturbation.noise,
            noise_seed: perturbation.noise_seed,
            at_s: perturbation.time,
        }
    }
}
