//! The laws of normal contact and friction at one point.

use super::{ContactPoint, PointForces, Step, TouchingSurfaces};
use crate::contact::{ContactStatus, Friction, Slipping};
use crate::transient::compliance::CompressedNode;

/// Halvings of the share of the slip that friction leaves: to the last bit.
const HALVINGS: usize = 64;

/// A point before its forces are known.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FreePoint {
    /// Place among the points of its surfaces.
    pub place: usize,
    /// Before the step, m.
    pub separation: f64,
    /// Velocity along the rows before the step, and at its end without forces of its own, m/s.
    pub before: [f64; 3],
    pub free: [f64; 3],
}

impl TouchingSurfaces {
    /// How far the counterface is pushed in at point `place` of these, less its gap, m; a compliant contact gives way by
    /// its compression in the base state.
    pub(super) fn pushed(&self, place: usize, point: &ContactPoint, share: f64) -> f64 {
        let compression = self.springs.as_ref().map_or(0.0, |own| own[place].compression);
        (self.interference + compression) * share - point.gap
    }

    /// The forces that obey both laws at the end of the step.
    #[inline(always)]
    pub(super) fn resolve<const TANGENTS: usize>(
        &mut self,
        point: &ContactPoint,
        free: &FreePoint,
        step: &Step,
    ) -> PointForces {
        let normal = self.press(point, free, step);
        if normal > 0.0 {
            self.drag::<TANGENTS>(point, free, normal, step)
        } else {
            PointForces::default()
        }
    }

    /// The normal force.
    #[inline(always)]
    fn press(&mut self, point: &ContactPoint, free: &FreePoint, step: &Step) -> f64 {
        let (dt, mass) = (step.coefficients.time_step, point.mass[0]);
        if self.springs.is_some() {
            return self.compress(point, free, step);
        }
        let expansion = self.interference * step.shares[2];
        let penetration = expansion - point.gap - (free.separation + dt * free.free[0]);
        // (6): no penetration at the end of the step.
        if penetration > 0.0 { mass * penetration / (dt * dt) } else { 0.0 }
    }

    fn compress(&mut self, point: &ContactPoint, free: &FreePoint, step: &Step) -> f64 {
        let dt = step.coefficients.time_step;
        let [earlier, now, later] = step.shares.map(|share| self.pushed(free.place, point, share));
        let node = CompressedNode {
            mass: point.mass[0],
            before: 0.5 * (earlier + now) - free.separation + 0.5 * dt * free.before[0],
            free: 0.5 * (now + later) - free.separation - 0.5 * dt * free.free[0],
        };
        let springs = self.springs.as_mut();
        springs.map_or(0.0, |springs| springs[free.place].force(&node, dt))
    }

    /// Friction under the `normal` force, and what it makes with the tangential dashpot.
    #[inline(always)]
    fn drag<const TANGENTS: usize>(
        &self,
        point: &ContactPoint,
        free: &FreePoint,
        normal: f64,
        step: &Step,
    ) -> PointForces {
        let (dt, mass) = (step.coefficients.time_step, point.mass[1]);
        let mut forces = PointForces { whole: [normal, 0.0, 0.0], ..PointForces::default() };
        if TANGENTS == 1 && self.is_plain {
            let trial = mass * (point.speed - free.free[1]) / dt;
            let (force, status) = self.law.project(trial, normal);
            forces.whole[1] = force;
            forces.friction[0] = force;
            forces.status = status;
            return forces;
        }
        // The dashpot acts on the mean of both velocities: half of it is inertia.
        let (inertia, half) = (mass / dt, 0.5 * point.dashpot);
        let damped = inertia + half;
        let before = [free.before[1], free.before[2]];
        let reached = [0, 1].map(|c| (inertia * free.free[c + 1] - half * before[c]) / damped);
        let speed = [point.speed, 0.0];
        let free_slip = [0, 1].map(|c| speed[c] - reached[c]);
        let slip_before = [0, 1].map(|c| speed[c] - before[c]);
        let friction = if TANGENTS == 1 {
            let [free_slip, _] = free_slip;
            let node = Slipping { inertia: damped, free_slip, slip_before: slip_before[0] };
            let own = self.law.resolve(&node, normal);
            own.with([own.force, 0.0])
        } else if point.is_led {
            self.lead(point.speed, 0.5 * (free_slip[1] + slip_before[1]), damped, normal)
        } else {
            let node = Slipping { inertia: damped, free_slip, slip_before };
            self.law.resolve_point(&node, normal)
        };
        for c in 0..TANGENTS {
            let after = reached[c] + friction.force[c] / damped;
            forces.whole[c + 1] = friction.force[c] - half * (before[c] + after);
        }
        PointForces {
            friction: friction.force,
            status: friction.status,
            is_ambiguous: friction.is_ambiguous,
            ..forces
        }
    }

    /// Friction of a point that is held along the sliding and slips there at `speed`, across it by `free` in the mean of the step without
    /// friction: `T = mu N v / |v|` with the mean slip `v`.
    fn lead(&self, speed: f64, free: f64, inertia: f64, normal: f64) -> Friction<[f64; 2]> {
        let (mut drag, [mut least, mut most]) = (0.0, [0.0, 1.0]);
        for _ in 0..HALVINGS {
            let share = 0.5 * (least + most);
            let size = speed.hypot(share * free);
            drag = self.law.cone(normal) * self.law.decay.map_or(1.0, |own| own.share(size)) / size;
            let is_less = share * (1.0 + 0.5 * drag / inertia) < 1.0;
            *if is_less { &mut least } else { &mut most } = share;
        }
        let force = [drag * speed, drag * least * free];
        Friction { force, status: ContactStatus::Slip, is_ambiguous: false }
    }
}
