//! `[frf]`: a frequency response of the model.

use super::{FrfMethod, reader::declared};
use crate::*;
use frictionsim_physics::frf::{Direction, Terminal};

declared! {
    /// `[frf]`.
    Frf {
        boundary: FrfBoundary = choice, "How the body is held.";
        quantity: ResponseQuantity = choice, "What is observed.";
        method: FrfMethod = choice, "How it is computed.";
        mass: MassKind = choice, "Which mass matrix.";
        noise: f64 = number, "Standard deviation of the noise on each part, relative to the magnitude.";
        noise_seed: usize = count, "Seed of the noise.";
    } with {
        force: Terminal, "Where and in which direction the force acts.";
        response: Terminal, "Where and in which direction the motion is observed.";
        frequencies_hz: Vec<f64>, "Frequencies, Hz, rising.";
    }
}

pub(super) fn read(section: &Section<'_>, body: Option<&Body>) -> Frf {
    let named = ["force_node", "response_node"].map(|key| {
        let named = section.node(key)?;
        body?.find_node(section, key, &named).map(|found| found.0)
    });
    section.needs("force_node");
    let force_node = named[0].unwrap_or(0);
    let response_node = named[1].unwrap_or(force_node);
    let mut frequencies_hz = section.numbers("frequencies_hz").unwrap_or_default();
    // What is wrong with a range has been said.
    let key = "frequencies_hz";
    refuse_if!(!section.has(key) || section.list_length(key) == Some(0); section, key,
        "frf.frequencies_hz is missing or empty"; "at least one frequency");
    frequencies_hz.sort_by(f64::total_cmp);
    frequencies_hz.dedup();
    let direction = |key| {
        let direction: Direction = section.choice(key);
        let is_along = matches!(direction, Direction::Axial | Direction::Z);
        if is_along && body.is_some_and(|body| body.dimension() == 2) {
            let name = direction.name();
            refuse!(section, key,
                "frf.{key} = \"{name}\": a plane body does not move along its axis";
                "the body is plane"; "use \"radial\" or \"tangential\"");
        }
        direction
    };
    let force = Terminal { node: force_node, direction: direction("force_direction") };
    let key = "response_direction";
    let along = if section.has(key) { direction(key) } else { force.direction };
    let response = Terminal { node: response_node, direction: along };
    let frf = Frf::declared(section, force, response, frequencies_hz);
    caution_if!(section.has("noise_seed") && frf.noise == 0.0; section, "noise_seed",
        "frf.noise_seed is not used: frf.noise is 0"; "no noise");
    frf
}
