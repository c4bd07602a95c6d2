//! Coulomb's law over a surface that a node can slide over in two directions.

use super::{ContactStatus, CoulombFriction, Friction, Slipping};

impl CoulombFriction {
    /// The tangential force under the normal force `normal`, N: within the disc of radius `mu(0) N` where the node sticks, on the
    /// circle of radius `mu(v) N` and along the slip velocity where it slips.
    ///
    /// The force of slip has the direction of the mean slip velocity over the step, which is that of the mean without friction:
    ///
    /// ```text
    /// v = (w* + w_-) / 2 - T dt / 2m,   T = mu(|v|) N v / |v|
    /// ```
    ///
    /// so that what it dissipates, `T . v`, is the law's, and a small motion across fast sliding has the dashpot `mu N / V` of the
    /// linearised law to second order in time. Along that direction [`Self::resolve`] has the size; where the slip turns round
    /// within the step, the direction is that of `w*`.
    pub fn resolve_point(&self, point: &Slipping<[f64; 2]>, normal: f64) -> Friction<[f64; 2]> {
        let Slipping { inertia, free_slip: free, slip_before: before } = *point;
        let size = free[0].hypot(free[1]);
        let whole = Slipping {
            inertia,
            free_slip: size,
            slip_before: (before[0] * free[0] + before[1] * free[1]) / size.max(f64::MIN_POSITIVE),
        };
        let end = self.resolve(&whole, normal);
        if end.status == ContactStatus::Slip {
            let mean = [0, 1].map(|c| 0.5 * (free[c] + before[c]));
            let length = mean[0].hypot(mean[1]);
            let [a, b] = if length > 0.0 { mean.map(|c| c / length) } else { [1.0, 0.0] };
            let part = |[x, y]: [f64; 2]| a * x + b * y;
            let node = Slipping { inertia, free_slip: part(free), slip_before: part(before) };
            let found = self.resolve(&node, normal);
            let turns = 2.0 * inertia * length <= found.force.abs();
            if !turns && found.status == ContactStatus::Slip && found.force > 0.0 {
                return found.with([found.force * a, found.force * b]);
            }
        }
        let share = end.force / size.max(f64::MIN_POSITIVE);
        end.with(free.map(|w| share * w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::FrictionDecay;

    const LAW: CoulombFriction = CoulombFriction { friction_coefficient: 0.4, decay: None };

    fn point(free_slip: [f64; 2], slip_before: [f64; 2]) -> Slipping<[f64; 2]> {
        Slipping { inertia: 10.0, free_slip, slip_before }
    }

    #[test]
    fn a_force_within_the_disc_holds_the_node_and_one_beyond_lies_on_the_circle_along_the_slip() {
        // m / dt |w*| against mu N = 4.
        let held = LAW.resolve_point(&point([0.3, -0.2], [0.0; 2]), 10.0);
        assert_eq!(held.status, ContactStatus::Stick);
        assert!((held.force[0] - 3.0).abs() < 1e-15 && (held.force[1] + 2.0).abs() < 1e-15);
        for before in [[0.3, -0.4], [-0.1, 0.5], [0.0; 2], [-3.0, 0.4]] {
            let slips = LAW.resolve_point(&point([0.3, -0.4], before), 10.0);
            assert_eq!(slips.status, ContactStatus::Slip);
            assert!((slips.force[0].hypot(slips.force[1]) - 4.0).abs() < 1e-14);
        }
    }

    /// Theory: with the mean slip of the step `v`, slip obeys `T = N mu(|v|) v / |v|`.
    #[test]
    fn friction_that_falls_with_the_slip_speed_obeys_the_law_in_both_directions() {
        let law = CoulombFriction {
            friction_coefficient: 0.4,
            decay: Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.8 }),
        };
        for (free, before) in [([1.2, 0.3], [1.1, 0.2]), ([2.0, -1.5], [1.9, -1.4])] {
            let found = law.resolve_point(&point(free, before), 10.0);
            let mean = [0, 1].map(|c| 0.5 * (free[c] + before[c]) - found.force[c] / 20.0);
            let speed = mean[0].hypot(mean[1]);
            let size = 4.0 * (1.0 + 0.5 * (-speed / 0.8_f64).exp());
            for c in 0..2 {
                assert!((found.force[c] - size * mean[c] / speed).abs() < 1e-12);
            }
        }
    }

    /// Theory: the linearised law of fast sliding is a dashpot `mu N / V` across it.
    #[test]
    fn a_small_motion_across_fast_sliding_meets_the_dashpot_of_the_linearised_law() {
        let (speed, across) = (2.0, 1e-7);
        let found = LAW.resolve_point(&point([speed, across], [speed, across]), 10.0);
        let mean = [speed - found.force[0] / 20.0, across - found.force[1] / 20.0];
        assert!((found.force[1] / mean[1] - 4.0 / mean[0]).abs() < 1e-12);
    }
}
