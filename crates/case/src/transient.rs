//! `[transient]` and `[output]`: the explicit transient and what it writes.

use super::{PlacedNode, reader::declared};
use crate::*;
use frictionsim_physics::transient::{
    InitialState, Perturbation, RecorderSettings, StandingWave, TimeStep, TransientSettings,
    whole_intervals,
};

/// Snapshots after the end of a run that are named one by one.
const MOST_NAMED: usize = 4;

/// `[transient]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transient {
    /// Times, start and perturbation of the run; the time between samples is that of `[output]`.
    pub settings: TransientSettings,
    /// Operator.
    pub operator: OperatorChoice,
    /// For the recorder of `[output]`, which is read later.
    stop_when_settled: bool,
}

declared! {
    /// `[output]`: what a transient writes.
    Output {
        checkpoint_interval: f64 = number, "Wall time between checkpoints, s.";
        universal: bool = flag, "Whether meshes, shapes and responses are written as universal files, too.";
    } with {
        recorder: RecorderSettings, "What a run keeps; its snapshots rise.";
        placed_probes: Vec<PlacedNode>, "Those of its probes that were asked for by their place.";
        sample_interval: f64, "Time between samples, s.";
    }
}

impl Case {
    /// The explicit transient.
    ///
    /// # Errors
    /// A case without `[transient]`, and one of Quad8 elements, which the transient cannot run.
    pub fn require_transient(&self) -> Result<&Transient, CaseErrors> {
        self.refuse_losses_without_chain()?;
        self.require_steps(
            "the transient needs \"quad4\"",
            "the transient needs bricks of 8 nodes, \"quad4\": it lumps the mass",
        )?;
        // What no section would help against comes first.
        let remedy = "[transient]\nduration = 0.05";
        let transient = self.required(&self.transient, "transient", "transient", remedy)?;
        if let InitialState::LimitCycle { .. } = transient.settings.initial {
            self.refuse_losses_in_time("the search for the limit cycle that the run starts on")?;
            self.require_annulus()?;
        }
        Ok(transient)
    }
}

pub(super) fn transient(
    section: &Section<'_>,
    body: Option<&Body>,
    sliding: &SlidingContact,
) -> Transient {
    let duration = section.number("duration");
    let step = section.optional_number("time_step");
    let time_step = step.unwrap_or(duration);
    refuse_if!(time_step > duration; section, "time_step" =>
        "= {time_step:?} s is above transient.duration = {duration:?} s"; "at most {duration:?}");
    let initial = initial(section, body);
    let expansion_time = section.number("expansion_time");
    if initial == InitialState::Rest && expansion_time > duration {
        let default = if section.has("expansion_time") { "" } else { ", the default," };
        refuse!(section, "expansion_time" =>
            "= {expansion_time:?} s{default} is above transient.duration = {duration:?} s: the \
             cylinder would never be fully expanded"; "at most the duration");
    }
    caution_if!(initial != InitialState::Rest && section.has("expansion_time"); section,
        "expansion_time",
        "transient.expansion_time is not used: the run starts with the cylinder fully expanded";
        "only with initial = \"rest\"");
    Transient {
        operator: section.choice("operator"),
        stop_when_settled: section.flag("stop_when_settled"),
        settings: TransientSettings {
            duration,
            time_step: step.map_or(TimeStep::Auto, TimeStep::Seconds),
            // Until `[output]` is read.
            sample_interval: f64::NAN,
            expansion_time,
            initial,
            perturbation: section
                .section("perturbation", false)
                .closed(|own| perturbation(own, body, sliding, duration)),
        },
    }
}

/// `initial`, with the harmonic that a limit cycle needs.
fn initial(section: &Section<'_>, body: Option<&Body>) -> InitialState {
    let initial = section.choice("initial");
    let InitialState::LimitCycle { .. } = initial else {
        refuse_each!(section, "limit_cycle_harmonic limit_cycle_onset"; key,
            "transient.{key} is given, but the run does not start on a limit cycle";
            "only with initial = \"limit-cycle\"");
        return initial;
    };
    let harmonic = section.count("limit_cycle_harmonic");
    let sectors = body.and_then(Body::sector_count);
    if let Some(sectors) = sectors.filter(|sectors| harmonic > sectors / 2) {
        let highest = sectors / 2;
        refuse!(section, "limit_cycle_harmonic",
            "transient.limit_cycle_harmonic = {harmonic} is above the mesh's highest, {highest}";
            "at most half of {sectors} elements");
    }
    InitialState::LimitCycle { harmonic, onset: section.count("limit_cycle_onset") }
}

/// `[transient.perturbation]`: the velocity that is added to the body's.
fn perturbation(
    section: &Section<'_>,
    body: Option<&Body>,
    sliding: &SlidingContact,
    duration: f64,
) -> Perturbation {
    let harmonics = section.harmonics(body.and_then(Body::sector_count)).unwrap_or_default();
    let relative = section.flag("relative").then(|| body.map(|body| slip_speed(body, sliding)));
    let unit = relative.flatten().unwrap_or(1.0);
    refuse_if!(unit == 0.0; section, "relative" =>
        "= true, but contact.rotation_speed_rpm = 0: there is no slip speed";
        "needs a cylinder that turns");
    let velocities = one_for_each(section, "velocity", &harmonics);
    let phases = one_for_each(section, "phase_deg", &harmonics);
    refuse_if!(harmonics.is_empty() && section.has("phase_deg"); section, "phase_deg" =>
        "is given without harmonics"; "needs transient.perturbation.harmonics");
    let noise = section.number("noise");
    let noise_seed = section.count("noise_seed");
    refuse_if!(section.has("noise_seed") && noise == 0.0; section, "noise_seed" =>
        "is given without noise"; "needs transient.perturbation.noise");
    caution_if!(harmonics.is_empty() && section.has("velocity"); section, "velocity" =>
        "is not used: there are no harmonics"; "no effect");
    caution_if!(harmonics.is_empty() && noise == 0.0 && section.flag("relative"); section,
        "relative" => "is not used: there is no velocity to add"; "no effect");
    let time = section.number("at");
    refuse_if!(time > duration; section, "at" =>
        "= {time:?} s is after the end of the run, transient.duration = {duration:?} s";
        "must be within the run");
    refuse_if!(time > 0.0 && harmonics.is_empty() && noise == 0.0; section, "at" =>
        "is given, but there is no velocity to add"; "needs harmonics or noise");
    let waves = harmonics.iter().zip(velocities.iter().zip(&phases));
    Perturbation {
        waves: waves
            .map(|(&harmonic, (velocity, phase))| StandingWave {
                harmonic,
                velocity: unit * velocity,
                phase: phase.to_radians(),
            })
            .collect(),
        noise: unit * noise,
        noise_seed: noise_seed as u64,
        time,
    }
}

/// `|Omega| a`, under a ring `|Omega|` times its mean radius, on a plane its speed, m/s.
fn slip_speed(body: &Body, sliding: &SlidingContact) -> f64 {
    // On a plane what turns is a speed, m/s; of solid bodies that turn it differs from point to point.
    let radius = body.contact_radii().map_or(1.0, |[inner, outer]| 0.5 * (inner + outer));
    sliding.rotation_speed.abs() * radius
}

/// One number for all harmonics or one for each.
fn one_for_each(section: &Section<'_>, key: &'static str, harmonics: &[usize]) -> Vec<f64> {
    let values = section.numbers(key).unwrap_or_default();
    match values.as_slice() {
        [value] => vec![*value; harmonics.len()],
        _ if values.len() == harmonics.len() => values,
        // An item that is no number has been reported.
        _ if section.list_length(key) == Some(harmonics.len()) => values,
        _ => {
            refuse!(section, key => "has {} values, transient.perturbation.harmonics has {}",
                values.len(), harmonics.len(); "one for all, or one for each harmonic");
            Vec::new()
        }
    }
}

pub(super) fn output(
    section: &Section<'_>,
    body: Option<&Body>,
    mut transient: Option<&mut Transient>,
) -> Output {
    let (probes, placed_probes) = probes(section, body);
    let sample_interval = section.number("sample_interval");
    let mut snapshots = section.rising("snapshots").unwrap_or_default();
    if let Some(transient) = &mut transient {
        let duration = transient.settings.duration;
        transient.settings.sample_interval = sample_interval;
        let last = whole_intervals(duration, sample_interval) as f64;
        // They rise: those after the end stand last.
        let is_inside = |time: &f64| (time / sample_interval).round() <= last;
        let left_out = snapshots.split_off(snapshots.partition_point(is_inside));
        let further = left_out.len().saturating_sub(MOST_NAMED);
        for time in left_out.iter().take(MOST_NAMED) {
            caution!(section, "snapshots",
                "output.snapshots: {time} s lies after the end of the run (transient.duration = \
                 {duration} s) and is left out"; "after the end");
        }
        caution_if!(further > 0; section, "snapshots",
            "output.snapshots: {further} later times are left out, too"; "after the end");
        refuse_if!(sample_interval > duration; section, "sample_interval" =>
            "= {sample_interval:?} s is above transient.duration = {duration:?} s";
            "a run has two samples at least");
    }
    let contact_interval = section.optional_number("contact_interval");
    let interval = contact_interval.unwrap_or(sample_interval);
    refuse_if!(interval < sample_interval; section, "contact_interval" =>
        "= {interval:?} s is below output.sample_interval = {sample_interval:?} s";
        "at least the sample interval");
    let recorder = RecorderSettings {
        probes,
        snapshots,
        contact_interval,
        raw_acceleration: section.flag("raw_acceleration"),
        stop_when_settled: transient.is_some_and(|own| own.stop_when_settled),
    };
    Output::declared(section, recorder, placed_probes, sample_interval)
}

/// The probes, counted from 1, and those of them that were asked for by their place.
fn probes(section: &Section<'_>, body: Option<&Body>) -> (Vec<usize>, Vec<PlacedNode>) {
    let (mut probes, mut placed) = (Vec::new(), Vec::new());
    for named in section.nodes("probes") {
        let found = body.and_then(|body| body.find_node(section, "probes", &named));
        let (Some(body), Some((node, place))) = (body, found) else { continue };
        if probes.contains(&(node + 1)) {
            refuse_at!(section, &named.1, "output.probes names node {} twice", body.node_label(node);
                "must not be listed twice"; "leave one of them out");
        }
        probes.push(node + 1);
        placed.extend(place);
    }
    (probes, placed)
}
