//! `[transient]` and `[output]`: the explicit transient and what it writes.

use super::model::node_count;
use super::reader::Section;
use super::rules::{harmonics, rising};
use crate::mesh::AnnulusSpecification;
use crate::transient::{InitialState, OperatorChoice, TimeStep};

/// `[transient.perturbation]`: initial velocity of the body, summed over harmonics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Perturbation {
    /// Circumferential harmonics.
    pub harmonics: Vec<usize>,
    /// Amplitude of each, m/s.
    pub velocity: f64,
}

/// `[transient]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transient {
    /// Simulated time, s.
    pub duration: f64,
    /// Time step.
    pub time_step: TimeStep,
    /// Ramp of the interference, s.
    pub expansion_time: f64,
    /// Initial state.
    pub initial: InitialState,
    /// Operator.
    pub operator: OperatorChoice,
    /// Initial perturbation.
    pub perturbation: Perturbation,
}

/// `[output]`: what a transient writes.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Node ids, counted from 1.
    pub probes: Vec<usize>,
    /// Time between samples, s.
    pub sample_interval: f64,
    /// Times of the field snapshots, s, rising.
    pub snapshots: Vec<f64>,
    /// Wall time between checkpoints, s.
    pub checkpoint_interval: f64,
}

pub(super) fn transient(root: &Section<'_>, annulus: &AnnulusSpecification) -> Option<Transient> {
    let section = root.section("transient", false);
    if !section.is_given() {
        return None;
    }
    let duration = section.number("duration");
    let time_step = match section.optional_number("time_step") {
        Some(step) => TimeStep::Seconds(step),
        None => TimeStep::Auto,
    };
    if let TimeStep::Seconds(step) = time_step
        && step > duration
    {
        section.reject(
            "time_step",
            format!(
                "transient.time_step = {step:?} s is above transient.duration = {duration:?} s"
            ),
            format!("at most {duration:?}"),
            None,
        );
    }
    let initial = initial(&section, annulus);
    let transient = Transient {
        duration,
        time_step,
        expansion_time: section.number("expansion_time"),
        initial,
        operator: section.choice("operator"),
        perturbation: perturbation(&section, annulus),
    };
    section.close();
    Some(transient)
}

/// `initial`, with the harmonic that a limit cycle needs.
fn initial(section: &Section<'_>, annulus: &AnnulusSpecification) -> InitialState {
    let initial = section.choice("initial");
    let keys = ["limit_cycle_harmonic", "limit_cycle_onset"];
    let [given, onset] = keys.map(|key| section.optional_count(key));
    let InitialState::LimitCycle { .. } = initial else {
        for (key, _) in keys
            .iter()
            .zip([given, onset])
            .filter(|pair| pair.1.is_some())
        {
            section.reject(
                key,
                format!("transient.{key} is given, but the run does not start on a limit cycle"),
                "only with initial = \"limit-cycle\"".to_owned(),
                None,
            );
        }
        return initial;
    };
    let harmonic = section.count("limit_cycle_harmonic");
    let highest = annulus.circumferential_elements / 2;
    if harmonic > highest {
        section.reject(
            "limit_cycle_harmonic",
            format!(
                "transient.limit_cycle_harmonic = {harmonic} is above the mesh's highest, {highest}"
            ),
            format!(
                "at most half of {} elements",
                annulus.circumferential_elements
            ),
            None,
        );
    }
    InitialState::LimitCycle {
        harmonic,
        onset: onset.unwrap_or(1),
    }
}

fn perturbation(transient: &Section<'_>, annulus: &AnnulusSpecification) -> Perturbation {
    let section = transient.section("perturbation", false);
    let harmonics = harmonics(&section, annulus).unwrap_or_default();
    let velocity = section.number("velocity");
    section.close();
    Perturbation {
        harmonics,
        velocity,
    }
}

pub(super) fn output(
    root: &Section<'_>,
    annulus: &AnnulusSpecification,
    transient: Option<&Transient>,
) -> Output {
    let section = root.section("output", false);
    let probes = section.counts("probes").unwrap_or_default();
    let nodes = node_count(annulus);
    for (probe, at) in &probes {
        if *probe as u128 > nodes && nodes > 0 {
            section.reject_there(
                at,
                format!("probe {probe} does not exist: the mesh has nodes 1 to {nodes}"),
                format!("must be at most {nodes}"),
                "node ids count radially outwards first: 1 + j (radial_elements + 1) + i",
            );
        }
    }
    let sample_interval = section.number("sample_interval");
    let snapshots = rising(&section, "snapshots").unwrap_or_default();
    if let Some(transient) = transient {
        if let TimeStep::Seconds(step) = transient.time_step
            && sample_interval < step
        {
            section.reject(
                "sample_interval",
                format!(
                    "output.sample_interval = {sample_interval:?} s is below \
                     transient.time_step = {step:?} s"
                ),
                format!("at least {step:?}"),
                None,
            );
        }
        for time in snapshots.iter().filter(|time| **time > transient.duration) {
            section.warn(
                "snapshots",
                format!(
                    "output.snapshots: {time} s lies after the end of the run \
                     (transient.duration = {} s) and is left out",
                    transient.duration
                ),
                "after the end",
            );
        }
    }
    let output = Output {
        probes: probes.into_iter().map(|(probe, _)| probe).collect(),
        sample_interval,
        snapshots,
        checkpoint_interval: section.number("checkpoint_interval"),
    };
    section.close();
    output
}
