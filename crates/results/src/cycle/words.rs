//! Limit cycles in words.

use super::branch::{BranchSummary, StabilityChangeSummary};
use super::record::{ModeSummary, OnsetSummary, SteppedMotion};
use super::summary::{CycleSummary, Origin, SoughtCycle};
use super::verdicts::{ConfirmationSummary, StabilitySummary};
use crate::{Extent, plural};
use frictionsim_output::significant;
use frictionsim_physics::cycle::periodic::ASTRAY;

const DIAMETERS: [&str; 2] = ["nodal diameter", "nodal diameters"];

/// Values in words, with five digits.
fn listed(values: &[f64]) -> Vec<String> {
    values.iter().map(|&value| significant(value, 5)).collect()
}

impl CycleSummary {
    /// Where the cycles come from, or that steady sliding is stable, and what powers are of.
    pub(super) fn said(&self) -> Vec<String> {
        let critical = self.critical_value.as_ref().filter(|_| !self.has_nothing());
        let critical = critical.map(|at| format!("Steady sliding loses its stability at {at}."));
        [Some(self.origin()), critical, self.extent.sentence()].into_iter().flatten().collect()
    }

    fn origin(&self) -> String {
        match &self.origin {
            Origin::Waves { lowest_onset } => self.of_waves(lowest_onset.as_ref()),
            Origin::Modes { modes, least_stable, highest_hz, start, .. } => {
                self.of_modes((*modes, *highest_hz), least_stable.as_ref(), *start)
            }
        }
    }

    /// Whether nothing was sought since steady sliding is stable.
    fn has_nothing(&self) -> bool {
        self.steady_sliding_stable
            && match &self.origin {
                Origin::Waves { .. } => true,
                Origin::Modes { .. } => self.cycles.is_empty(),
            }
    }

    fn of_waves(&self, lowest_onset: Option<&OnsetSummary>) -> String {
        let friction = self.friction_coefficient;
        if !self.steady_sliding_stable {
            return "Waves that turn against the rotor without changing their shape.".to_owned();
        }
        let Some(onset) = lowest_onset else {
            return format!(
                "steady sliding is stable at contact.friction_coefficient = {friction}"
            );
        };
        let critical = onset.critical_friction;
        let advice = match &self.critical_value {
            Some(at) => format!("sliding loses its stability at {at}"),
            None => format!("raise contact.friction_coefficient above {critical:.4}"),
        };
        format!(
            "{friction} < {critical:.4}: steady sliding is stable, so no limit cycle is sought. \
             The first wave to grow has {} nodal diameters and {:.2} Hz ({advice})",
            onset.harmonic, onset.frequency_hz,
        )
    }

    fn of_modes(
        &self,
        (modes, highest_hz): (usize, f64),
        least_stable: Option<&ModeSummary>,
        start: Option<(&'static str, f64)>,
    ) -> String {
        if !self.has_nothing() {
            let start = start.map_or_else(
                || format!("friction {}", self.friction_coefficient),
                |(key, value)| format!("{key} = {value}, since none grows at the case's own"),
            );
            return format!(
                "Limit cycles as periodic motions of the whole mesh, from {} of {} modes that grow at {start}.",
                self.cycles.len(),
                modes,
            );
        }
        let slowest = least_stable.map_or_else(String::new, |mode| {
            let (frequency, rate) = (mode.mode_frequency_hz, mode.growth_rate_per_s);
            format!("; the slowest to decay is {mode}, {frequency:.2} Hz, at {rate:.1} 1/s")
        });
        let advice = self.critical_value.as_ref().map_or_else(
            || {
                "raise the friction coefficient, or cea.modes; `cea` over cea.friction_coefficients finds the onsets"
                    .to_owned()
            },
            |critical| format!("it loses its stability at {critical}"),
        );
        format!(
            "steady sliding is stable at friction {} as far as {} modes up to {:.0} Hz tell, so no \
             limit cycle is sought. None of them grows{slowest} ({advice})",
            self.friction_coefficient, modes, highest_hz,
        )
    }

    /// Why results should not be trusted, if so.
    pub fn doubts(&self) -> Vec<String> {
        let remedy = match &self.origin {
            Origin::Waves { .. } => {
                "refine the mesh (mesh.circumferential_elements and radial_elements), or trust the transient"
            }
            Origin::Modes { .. } => {
                "trust the transient, or give it more periods (cycle.confirmation_periods): a slow \
                perturbation may take them"
            }
        };
        let coarse = self.cycles.iter().filter_map(SoughtCycle::coarse_sentence);
        let doubted = self.cycles.iter().filter(|own| own.agrees() == Some(false) && !own.leaves());
        let said = doubted.filter_map(|own| {
            Some(format!("{}: {}; {remedy}", own.name, own.confirmation_sentence(self.extent)?))
        });
        coarse.chain(said).collect()
    }
}

impl SoughtCycle {
    /// That the harmonics in which it is told leave too much.
    fn coarse_sentence(&self) -> Option<String> {
        let own = self.cycle.as_ref()?.stepped.as_ref()?;
        (own.harmonic_count < own.harmonics_needed).then(|| {
            format!(
                "{}: {} harmonics leave {:.1e} of the motion of the contact: {} leave less than a \
                thousandth (raise cycle.harmonic_count, or leave it out)",
                self.name, own.harmonic_count, own.harmonic_remainder, own.harmonics_needed,
            )
        })
    }

    /// Whether a transient is expected to leave the cycle.
    fn leaves(&self) -> bool {
        self.known().is_some_and(|known| known.is_stable == Some(false))
    }

    /// How it was found, what a transient and small perturbations say of it.
    pub(super) fn sentences(&self, extent: Extent) -> Vec<String> {
        let found = [self.motion_sentence(), self.astray_sentence(), self.sound_sentence()];
        let known = [self.confirmation_sentence(extent), self.stability_sentence()];
        let all = found.into_iter().chain(known).flatten();
        all.map(|text| format!("{}: {text}", self.name)).collect()
    }

    fn motion_sentence(&self) -> Option<String> {
        let cycle = self.cycle.as_ref()?;
        let SteppedMotion { residual, periods, steps, harmonic_count, harmonic_remainder, .. } =
            cycle.stepped.as_ref()?;
        let (balance, amplitude) = (cycle.balance_residual, cycle.amplitude_m?);
        Some(format!(
            "repeats itself to {residual:.1e} after {periods} periods of {steps} steps, energy balance {balance:.1e}. \
             {harmonic_count} harmonics leave {harmonic_remainder:.1e} of the motion of the contact, whose amplitude \
             is {amplitude:.3e} m",
        ))
    }

    /// That its frequency is far off that of its mode.
    fn astray_sentence(&self) -> Option<String> {
        let mode = &self.name.mode()?.mode;
        let off = self.cycle.as_ref()?.main_frequency_hz / mode.mode_frequency_hz - 1.0;
        let side = if off > 0.0 { "above" } else { "below" };
        (off.abs() > ASTRAY).then(|| {
            format!(
                "the frequency of this cycle is {:.1} % {side} that of the mode: what grows from \
                 it may end in the motion of another",
                100.0 * off.abs(),
            )
        })
    }

    fn sound_sentence(&self) -> Option<String> {
        let sound = self.cycle.as_ref()?.stepped.as_ref()?.sound.as_ref()?;
        Some(format!(
            "sound power {:.1} dB over 1e-12 W, an estimate by the Rayleigh integral over {:.4} m2 of flat faces. Each \
             is in an infinite rigid baffle, and harmonics count up to 20 kHz",
            sound.level_db, sound.area_m2,
        ))
    }

    /// What a transient says of the cycle; nothing where none was asked for.
    fn confirmation_sentence(&self, extent: Extent) -> Option<String> {
        let run = match self.confirmation.as_ref()? {
            ConfirmationSummary::Ran(run) => run,
            ConfirmationSummary::Failed { error, .. } => {
                return Some(format!("no transient can start on the cycle: {error}"));
            }
        };
        let verdict = match (run.agrees, self.leaves()) {
            (true, false) => "a transient stays on it".to_owned(),
            (true, true) => format!(
                "a transient is still on it, in a time in which the leading perturbation makes \
                 {:.1} e-folds: too few to tell",
                run.e_folds
            ),
            (false, true) => "a transient leaves it, as its leading perturbation says".to_owned(),
            (false, false) => "NOT CONFIRMED: a transient does not stay on it".to_owned(),
        };
        let [stick, slip, open] =
            [run.status.stick, run.status.slip, run.status.open].map(|own| own.unwrap_or(0.0));
        let (periods, hz) = (run.periods, run.main_frequency_hz.unwrap_or(0.0));
        let (power, unit) = (run.power_w.external.unwrap_or(0.0), extent.unit("W"));
        let contact = format!("stick {stick:.3}, slip {slip:.3}, open {open:.3}");
        Some(format!(
            "{verdict}: after {periods} periods {hz:.2} Hz, {contact}, power {power:.2} {unit}"
        ))
    }

    /// Whether small perturbations grow.
    fn stability_sentence(&self) -> Option<String> {
        let known = match self.stability.as_ref()? {
            StabilitySummary::Known(known) => known,
            StabilitySummary::Failed { error } => return Some(error.clone()),
        };
        let Some(leading) = &known.leading else {
            return Some("stable; every perturbation decays fast".to_owned());
        };
        let verdict = match known.verdict.as_str() {
            "unstable" => "UNSTABLE",
            verdict => verdict,
        };
        let what = match (leading.harmonic, leading.frequency_hz, leading.beat_hz) {
            (Some(n), Some(frequency), _) => {
                format!("{} at {frequency:.0} Hz", plural(n, DIAMETERS))
            }
            (.., Some(beat)) => format!("{beat:.0} Hz from a harmonic"),
            _ => String::new(),
        };
        let leads = leading.leads_to.as_ref().map_or_else(String::new, |kind| format!(" ({kind})"));
        Some(format!(
            "{verdict}; the leading perturbation, {what}, {} at {:.0} +- {:.0} 1/s{leads}",
            if leading.growth_rate_per_s > 0.0 { "grows" } else { "decays" },
            leading.growth_rate_per_s.abs(),
            leading.uncertainty_per_s.unwrap_or(f64::NAN),
        ))
    }

    /// Its branch: values and ends, where it turns back, changes its stability, stops sticking, where sliding loses its
    /// stability and lives beside it, and the kick between both. Nothing without a branch.
    pub(super) fn branch_sentence(&self) -> Option<String> {
        let branch = self.branch.as_ref()?;
        let (name, key, [first, last]) = (&self.name, &branch.key, &branch.ends);
        let Some([low, high]) = branch.range else {
            return Some(format!(
                "{name}: no cycle at the values of {key} that were asked for ({last})"
            ));
        };
        let kick = self.cycle.as_ref().and_then(|cycle| cycle.stepped.as_ref()?.kick_velocity);
        let kick = kick.map(|velocity| {
            format!(
                ". At the case's own {key} a kick of more than {velocity:.3e} m/s tips sliding \
                 into it. That is 2 pi f times the amplitude of the unstable cycle between both"
            )
        });
        let ends = match first == last {
            true => format!("at both ends because {first}"),
            false => format!("at one end because {first}, at the other because {last}"),
        };
        let [low, high] = [low, high].map(|value| significant(value, 5));
        let (cycles, events, kick) = (branch.cycles, branch.events(), kick.unwrap_or_default());
        let over = format!("{cycles} cycles over {key} from {low} to {high}");
        Some(format!("{name}: {over} (it stops {ends}){events}{kick}"))
    }
}

impl BranchSummary {
    /// What happens along it.
    fn events(&self) -> String {
        let said = |what: &str, values: Vec<String>| match values.is_empty() {
            true => String::new(),
            false => format!("; {what} {}", values.join(", ")),
        };
        let folds = listed(&self.folds);
        let folds = match folds.len() {
            0 => "; no fold".to_owned(),
            1 => said("a fold at", folds),
            many => said(&format!("{many} folds at"), folds),
        };
        let saturation = self.waves.as_ref().and_then(|waves| waves.saturation_speed_rpm);
        let saturation = saturation.map(|speed| format!("; no point sticks above {speed:.1} rpm"));
        let changes = self.stability_changes.iter().map(|change| match change {
            StabilityChangeSummary::At(value) => significant(*value, 5),
            StabilityChangeSummary::By(mode) => {
                let what = if mode.to_two_frequencies { ", to two frequencies" } else { "" };
                format!("{} ({}{what})", significant(mode.at, 5), plural(mode.harmonic, DIAMETERS))
            }
        });
        let motions = self.motions.as_ref();
        let onsets = motions.map_or(Vec::new(), |own| listed(&own.onsets));
        let both = motions.into_iter().flat_map(|own| &own.coexistence).map(|ends| {
            let [from, to] = ends.map(|value| significant(value, 5));
            format!("; stable sliding and a limit cycle coexist from {} = {from} to {to}", self.key)
        });
        [
            folds,
            saturation.unwrap_or_default(),
            said("stability changes at", changes.collect()),
            said("steady sliding loses its stability at", onsets),
            both.collect(),
        ]
        .concat()
    }
}
