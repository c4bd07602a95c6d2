//! What a case that is right key by key asks for in vain, and what of it is hardly meant.

mod contact;
mod material;
mod mesh;
mod motion;

use super::KEYS;
use crate::*;
use frictionsim_signal::FrequencyResponse;
pub(super) use material::material_key;

/// A value beyond what is plausible.
struct Limit {
    /// Whether a run could do with it all the same.
    is_possible: bool,
    /// What is said of it.
    said: Diagnostic,
}

/// Values with a limit of what is plausible and one of what is possible.
const LIMITED: [fn(&Case) -> Option<Limit>; 4] =
    [material::wave_speed, motion::seeds, contact::friction, contact::stiffness];

/// What cannot run.
const IMPOSSIBLE: [fn(&Case) -> Option<Diagnostic>; 5] =
    [motion::time_step, motion::duration, motion::start, unwritten_response, unwritten_mesh];

/// What hardly anybody means.
const DOUBTFUL: [fn(&Case) -> Option<Diagnostic>; 11] = [
    mesh::lengths,
    mesh::unmerged_nodes,
    mesh::element_shape,
    material::density,
    contact::speed,
    material::poisson_ratio,
    contact::interference,
    contact::overlap,
    motion::unresolved_springs,
    motion::steep_friction,
    material::overdamping,
];

/// A response that a universal file does not take.
fn unwritten_response(case: &Case) -> Option<Diagnostic> {
    let lines = case.frf.as_ref().filter(|_| case.output.universal)?.frequencies_hz.clone();
    let values = vec![c64::ZERO; lines.len()];
    let error = FrequencyResponse::new(lines, values, ResponseQuantity::Receptance).err()?;
    let key = "frf.frequencies_hz";
    Some(diagnosis!(case, key, "{key} with output.universal: {error}"; "cannot be written"))
}

/// A mesh that universal files have no elements for, of what writes it: `cea` and `matrices`.
fn unwritten_mesh(case: &Case) -> Option<Diagnostic> {
    let mesh = case.body.whole_mesh().filter(|_| case.output.universal && case.cea.is_some())?;
    let kind = mesh.element_kinds.iter().find(|kind| kind.universal(&[]).is_none())?;
    Some(diagnosis!(case, "output.universal", "output.universal: the mesh has elements {}, which \
        universal files do not have", kind.name(); "cannot be written"; "leave it out: mode shapes \
        are in the .vtu files, too; or mesh with tetrahedra, bricks and wedges alone"))
}

/// What is said of values on one side of what is possible.
fn limited(case: &Case, is_possible: bool) -> impl Iterator<Item = Diagnostic> {
    let found = LIMITED.into_iter().filter_map(move |limited| limited(case));
    found.filter(move |limit| limit.is_possible == is_possible).map(|limit| limit.said)
}

/// What a case asks for in vain.
pub(super) fn infeasible(case: &Case) -> Vec<Diagnostic> {
    IMPOSSIBLE.iter().filter_map(|check| check(case)).chain(limited(case, false)).collect()
}

/// What of a case is hardly meant.
pub(super) fn implausible(case: &Case) -> Vec<Diagnostic> {
    DOUBTFUL.iter().filter_map(|check| check(case)).chain(limited(case, true)).collect()
}

impl Case {
    /// Keys that the case gives and that an analysis of a command does not use, each with the reason.
    pub fn ignored_by(&self, command: &str) -> Vec<Diagnostic> {
        let has = [("cycle", self.cycle.is_some()), ("basin", self.basin.is_some())];
        let analyses = has.into_iter().filter(|(analysis, is_here)| {
            *analysis == command || (*is_here && ["sweep", "convergence"].contains(&command))
        });
        let ignored = analyses.filter(|_| self.has_rotating_waves()).flat_map(|(analysis, _)| {
            let given = |key: &&CaseKey| {
                let item = self.raw.find(key.name);
                item.is_some_and(|item| !key.is_default(&item.value))
            };
            let keys = KEYS.iter().filter(|key| !key.of_waves.is_empty());
            keys.filter(given).map(move |key| (analysis, key))
        });
        let say = |(analysis, key): (&str, &CaseKey)| {
            let CaseKey { name, of_waves, .. } = key;
            diagnosis!(self, name, "{name} is not used by {analysis}: {of_waves}"; "not used")
        };
        let mut said: Vec<Diagnostic> = ignored.map(say).collect();
        // A search for periodic motions of a whole body knows no circumferential harmonics.
        let harmonics = self.cycle.as_ref().and_then(|own| own.harmonics.as_ref());
        if command == "cycle" && !self.has_rotating_waves() && harmonics.is_some() {
            let key = "cycle.harmonics";
            said.push(diagnosis!(self, key,
                "{key} is not used: the limit cycles of this body are no rotating waves. They are \
                 motions of the whole mesh, one for each mode that grows"; "not used"));
        }
        said
    }
}
