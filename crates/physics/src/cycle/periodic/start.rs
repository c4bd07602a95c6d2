//! Where the search for a periodic motion starts: on a mode that grows.

use super::map::{PeriodMap, PeriodicState};
use crate::cycle::vector::{difference, norm};
use crate::fem::operator::scatter;
use crate::linalg::c64;
use std::f64::consts::TAU;

/// Doublings of the amplitude that are tried.
const DOUBLINGS: usize = 8;
/// Halvings, of the logarithm, of the interval in which growth ends.
const BISECTIONS: usize = 3;

/// A mode that grows from steady sliding.
#[derive(Clone, Copy, Debug)]
pub struct GrowingMode<'a> {
    /// `lambda`, 1/s and rad/s.
    pub eigenvalue: c64,
    /// Its shape over all dofs in nodal frames.
    pub shape: &'a [c64],
    /// Displacement of steady sliding over all dofs, m.
    pub base: &'a [f64],
}

impl GrowingMode<'_> {
    /// The state of steady sliding with the mode at an amplitude (m where its shape has one).
    pub fn state(&self, map: &PeriodMap<'_>, amplitude: f64) -> PeriodicState {
        let (lambda, period) = (self.eigenvalue, TAU / self.eigenvalue.im);
        let earlier = lambda * (lambda * (-0.5 * period / map.steps() as f64)).exp();
        let pairs = || self.base.iter().zip(self.shape);
        let displacement = pairs().map(|(base, shape)| base + amplitude * shape.re);
        let velocity = pairs().map(|(_, shape)| amplitude * (shape * earlier).re);
        let [displacement, velocity]: [Vec<f64>; 2] = [displacement.collect(), velocity.collect()];
        map.state(&displacement, &velocity, period)
    }

    /// Slip of every contact node in its shape.
    pub fn slips(&self, map: &PeriodMap<'_>) -> Vec<c64> {
        let (interface, law, operator) =
            (map.run.interface(), map.run.contact(), map.run.operator());
        let part = |of: fn(&c64) -> f64| -> Vec<f64> { self.shape.iter().map(of).collect() };
        let [real, imaginary] = [part(|u| u.re), part(|u| u.im)].map(|u| scatter(operator, &u));
        let slip = |i: usize| match map.run.model().components() {
            2 => interface.slip(i).iter().map(|&(dof, along)| self.shape[dof] * along).sum(),
            _ => c64::new(law.slip(i, &real), law.slip(i, &imaginary)),
        };
        (0..interface.len()).map(slip).collect()
    }

    /// The amplitude at which the mode brings the first contact node to the speed of its counterface.
    pub fn sticking_amplitude(&self, map: &PeriodMap<'_>) -> f64 {
        let law = map.run.contact();
        let amplitudes = self.slips(map).into_iter().enumerate().map(|(i, slip)| {
            let speed = (slip * self.eigenvalue).norm();
            law.counterface_speed(i).abs() / speed.max(f64::MIN_POSITIVE)
        });
        amplitudes.fold(f64::INFINITY, f64::min)
    }
}

/// The mode at the amplitude at which it neither grows nor decays over its first period: there friction feeds as much as the
/// body, stick and impacts take. Where no amplitude within a factor of 256 does so, the one at which a node first sticks.
pub fn balanced_start(map: &mut PeriodMap<'_>, mode: &GrowingMode<'_>) -> PeriodicState {
    let reference = mode.sticking_amplitude(map);
    let rest = mode.state(map, 0.0);
    map.fit(rest.period);
    let grows = |map: &mut PeriodMap<'_>, amplitude: f64| {
        let start = mode.state(map, amplitude);
        let image = map.image(&start);
        let size = |motion: &[f64]| norm(&difference(motion, &rest.motion));
        size(&image.motion) > size(&start.motion)
    };

    // Up where the mode still grows, down where it does not.
    let is_growing = grows(map, reference);
    let factor = if is_growing { 2.0 } else { 0.5 };
    let [mut inner, mut outer] = [reference; 2];
    let has_crossed = (0..DOUBLINGS).any(|_| {
        (inner, outer) = (outer, factor * outer);
        grows(map, outer) != is_growing
    });
    if !has_crossed {
        return mode.state(map, reference);
    }
    for _ in 0..BISECTIONS {
        let middle = (inner * outer).sqrt();
        if grows(map, middle) == is_growing { inner = middle } else { outer = middle }
    }
    mode.state(map, (inner * outer).sqrt())
}
