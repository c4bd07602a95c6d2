//! What to know of a run before its numbers are used.

use super::TransientStudy;
use crate::*;
use frictionsim_physics::prestress::PrestressError;
use frictionsim_physics::transient::{InitialState, Recorder, TransientAnalysis};

/// Largest displacement of the contact relative to the size of the body that is small.
const SMALL_DISPLACEMENT: f64 = 0.02;

/// Largest mean strain that is small.
const SMALL_STRAIN: f64 = 0.01;

/// Error of the period by the time step above which it is said.
const STEP_ERROR: f64 = 1e-3;

impl TransientStudy<'_> {
    /// What leaves the theory, the eigenvalue analysis or the accuracy that numbers are expected to have.
    pub(super) fn notes(
        &self,
        record: &Recorder,
        analysis: &TransientAnalysis,
        time_step: f64,
    ) -> Vec<String> {
        let found = [
            self.no_sliding(),
            self.large_motion(record),
            self.beyond_modes(analysis),
            coarse_step(record, analysis, time_step),
        ];
        found.into_iter().flatten().chain(self.chains()).collect()
    }

    /// What stands in time for stiffness that belongs to frequencies.
    fn chains(&self) -> Vec<String> {
        let relaxed = self.case.relaxed.iter().flatten().enumerate();
        let chains = relaxed.filter_map(|(region, own)| Some((region, own.chain.as_ref()?)));
        let said = chains.map(|(region, chain)| {
            let name = match self.stepped.mesh.regions.get(region) {
                Some(name) => format!("region {name}"),
                None => "the body".to_owned(),
            };
            let ([low, high], count) = (chain.band_hz, chain.elements.len());
            let (error, at_rest) = (100.0 * chain.largest_error, chain.at_rest);
            let at_once = at_rest * chain.glassy();
            format!(
                "{name}: a Maxwell chain of {count} elements has its modulus and loss factor from \
                 {low:.4} to {high:.4} Hz, within {error:.2} % of the complex modulus. At rest it has \
                 {at_rest:.4} times the modulus that the case gives, at once {at_once:.4} times"
            )
        });
        said.collect()
    }

    /// That the body has no state of steady sliding, so that it jams or jumps.
    fn no_sliding(&self) -> Option<String> {
        let case = self.case;
        let starts_at_rest = self.transient.settings.initial == InitialState::Rest;
        let jams = |error: PrestressError| match error {
            PrestressError::NoState { .. } => Some(format!("the body jams: {error}")),
            // A gap closes as the run moves the body, and other faults stop the run itself.
            _ => None,
        };
        let (contact, stiffness) = (&case.contact.sliding, case.contact.stiffness);
        let state = |body: &Assembly<'_>| body.state(contact.friction_coefficient);
        let (mesh, materials) = (&self.stepped.mesh, case.materials_in_time());
        let base = match &self.stepped.assembly {
            Some(assembly) => state(assembly),
            None if !starts_at_rest || case.body.has_sectors() || contact.rotation_speed == 0.0 => {
                return None;
            }
            None => Assembly::of_edge(mesh, materials, contact, stiffness).and_then(|b| state(&b)),
        };
        base.err().and_then(jams)
    }

    /// That displacements or strains are not small.
    fn large_motion(&self, record: &Recorder) -> Option<String> {
        let mesh = &self.stepped.mesh;
        let extent = |axis: usize| {
            let [low, high] = order::range(mesh.nodes.iter().map(|node| node[axis]));
            high - low
        };
        let size = extent(0).hypot(extent(1));
        let displacement = record.largest_motion(0..record.rows.len());

        // From the strain energy U: the uniform strain that the body would store it with, U = 1/2 (sum E A) strain^2.
        let materials = self.case.materials();
        let sizes = mesh.region_measures().into_iter().enumerate();
        let stiffness: f64 =
            sizes.map(|(region, size)| size * materials.of(region).young_modulus).sum();
        let depth = self.stepped.sector.as_ref().map_or(1.0, |_| self.case.thickness);
        let energy = record.rows.iter().map(|row| row.strain_energy).fold(0.0, f64::max);
        let strain = (2.0 * energy / (stiffness * depth)).sqrt();
        if displacement < SMALL_DISPLACEMENT * size && strain < SMALL_STRAIN {
            return None;
        }
        Some(format!(
            "the motion leaves the theory of small displacements: the contact moves by up to {:.3} \
             mm, {:.1} % of the size of the body. The mean strain reaches {:.2} %",
            1e3 * displacement,
            100.0 * displacement / size,
            100.0 * strain,
        ))
    }

    /// That the run vibrates at a frequency that the eigenvalue analysis of the case does not look at.
    fn beyond_modes(&self, analysis: &TransientAnalysis) -> Option<String> {
        let ModeLimit::MaxFrequency(limit) = self.case.cea.as_ref()?.modes else { return None };
        let frequency = analysis.last_fifth.main_frequency_hz?;
        (frequency > limit).then(|| {
            format!(
                "the main frequency of {frequency:.1} Hz is above cea.max_frequency_hz = {limit}: `cea` on this case \
                does not find the mode behind it"
            )
        })
    }
}

/// That the time step costs accuracy.
///
/// Central differences vibrate a little too fast, and nodes that come to rest or leave it do so at whole steps. Where
/// the nodes of a wave do so one after the other that averages out; where many do at once, the period may be too short
/// by up to a step.
fn coarse_step(record: &Recorder, analysis: &TransientAnalysis, time_step: f64) -> Option<String> {
    let frequency = analysis.last_fifth.main_frequency_hz?;
    let start = record.rows.len() - record.rows.len().div_ceil(5);
    let shares = record.rows[start..].iter().map(|row| row.counts.fractions()[0]);
    let [low, high] =
        shares.fold([1.0_f64, 0.0_f64], |[low, high], share| [low.min(share), high.max(share)]);
    let error = (high - low) * frequency * time_step;
    let [from, to, percent] = [low, high, error].map(|share| 100.0 * share);
    (error > STEP_ERROR).then(|| {
        format!(
            "between {from:.0} and {to:.0} % of the contact nodes stick, so the time step may shorten the \
             period by up to {percent:.2} %. A smaller transient.time_step is more accurate"
        )
    })
}
