//! Contact on a face of a body in three dimensions: friction is a vector.

use super::{ContactPowers, LagrangeContact, StatusCounts};
use crate::contact::{ContactInterface, ContactStatus, SlippingPoint};
use crate::fem::operator::{MotionFields, StepCoefficients, StiffnessOperator};
use crate::prestress::SolidSliding;
use crate::transient::SolidTransientModel;
use crate::transient::compliance::CompliantContact;

/// What a face has beside the normal and the circumferential dof of each node.
#[derive(Clone, Debug)]
pub(super) struct FaceSliding {
    /// Place of the dof across both.
    across: Vec<usize>,
    /// Whether that may move.
    is_free: Vec<bool>,
    /// Speed of the counterface `Omega r`, m/s.
    speeds: Vec<f64>,
    /// Friction across the sliding, N.
    forces: Vec<f64>,
    /// Velocity and elastic acceleration across before the step.
    before: Vec<[f64; 2]>,
}

impl FaceSliding {
    /// Speed of the counterface at a node, m/s.
    pub(super) fn speed(&self, i: usize) -> f64 {
        self.speeds[i]
    }
}

impl LagrangeContact {
    /// All nodes of `interface` on a face of `model` open; `base` is the state of steady sliding that compliant contact needs.
    ///
    /// The normal multiplier is that of an edge. The tangential one is a vector along `e_theta` and across it, projected on the
    /// disc of Coulomb's law: [`crate::contact::CoulombFriction::resolve_point`].
    pub(in crate::transient) fn on_face(
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
        model: &SolidTransientModel<'_>,
        base: Option<&SolidSliding>,
    ) -> Self {
        let sector = model.sector;
        let face = sector.specification.contact.face();
        let places = |component: usize| -> Vec<usize> {
            let nodes = interface.nodes.iter();
            nodes.map(|&node| operator.position(3 * node as usize + component)).collect()
        };
        let (normal, across) = (places(face.normal_component()), places(face.across_component()));
        let (count, areas) = (interface.len(), &interface.tributary_lengths);
        let local = |node: &u32| *node as usize % sector.node_count();
        let force = |node: &u32| {
            let forces = base.map_or(&[][..], |base| &base.normal_forces).iter();
            let mut own = forces.filter(|(own, _)| *own == local(node));
            own.next().map_or(0.0, |(_, force)| *force)
        };
        let stiffness = &model.stiffness;
        let forces: Vec<f64> = interface.nodes.iter().map(force).collect();
        // What the springs of a compliant base state have given way already is in its displacement.
        let approach = |node: &u32| {
            base.map_or(0.0, |base| {
                let normal = base.pressed_displacement[3 * local(node) + face.normal_component()];
                model.contact.interference - face.inward_sign() * normal
            })
        };
        let compliance = stiffness.normal_stiffness.map(|normal_stiffness| {
            let given_way: Vec<f64> = match base.is_some_and(|base| base.law.is_some()) {
                true => interface.nodes.iter().map(approach).collect(),
                false => vec![0.0; count],
            };
            if let Some(law) = stiffness.law {
                let damping = given_way.iter().zip(areas).map(|(g, area)| {
                    let spring = law.stiffness(g.max(0.0));
                    area * (stiffness.normal_damping + stiffness.law_damping * spring)
                });
                return CompliantContact::stiffening(law, areas, damping.collect());
            }
            let law = [normal_stiffness, stiffness.normal_damping];
            CompliantContact::of(law, areas, &forces).beyond(&given_way)
        });
        let dashpots = areas.iter().map(|area| stiffness.tangential_damping * area);
        let speed = |node: &u32| model.contact.rotation_speed * sector.nodes[local(node)].radius;
        Self {
            masses: normal.iter().map(|&k| operator.masses()[k]).collect(),
            tangential: places(1),
            gaps: interface.gaps.clone(),
            interference: model.contact.interference,
            compliance,
            dashpots: dashpots.filter(|c| *c != 0.0).collect(),
            law: model.contact.law(),
            surface_speed: 0.0,
            normal_force: vec![0.0; count],
            tangential_force: vec![0.0; count],
            status: vec![ContactStatus::Open; count],
            before: vec![[0.0; 4]; count],
            ambiguous: 0,
            unconverged_steps: 0,
            opposite: None,
            inward: face.inward_sign(),
            points: None,
            face: Some(FaceSliding {
                is_free: across.iter().map(|&k| operator.masses()[k] > 0.0).collect(),
                across,
                speeds: interface.nodes.iter().map(speed).collect(),
                forces: vec![0.0; count],
                before: vec![[0.0; 2]; count],
            }),
            normal,
        }
    }

    /// Friction across the sliding of each node, N; none on an edge.
    pub(in crate::transient) fn across_force(&self) -> &[f64] {
        let on_face = self.face.as_ref().map(|face| face.forces.as_slice());
        on_face.unwrap_or_else(|| self.across_at_points())
    }

    /// [`Self::apply`] on a face.
    pub(super) fn apply_on_face(
        &mut self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) {
        let Some(mut face) = self.face.take() else {
            return;
        };
        let dt = coefficients.time_step;
        let (alpha, beta) = (coefficients.mass_coefficient, coefficients.stiffness_coefficient);
        let expansion = self.interference * shares[2];
        self.ambiguous = 0;
        for i in 0..self.normal.len() {
            let places = [self.normal[i], self.tangential[i], face.across[i]];
            let mass = self.masses[i];
            let v = places.map(|k| fields.velocity[k]);
            let q = places.map(|k| fields.elastic[k]);
            let z = places.map(|k| fields.elastic_rate[k]);
            self.before[i] = [v[0], v[1], q[0], q[1]];
            face.before[i] = [v[2], q[2]];
            let trial = [0, 1, 2].map(|c| v[c] - dt * (q[c] + (alpha * v[c] + beta * z[c])));
            let inward = self.inward;
            let displacement = inward * fields.displacement[places[0]];
            let penetration = expansion - self.gaps[i] - (displacement + inward * dt * trial[0]);
            let mut normal = 0.0;
            if self.compliance.is_some() {
                let motion = [displacement, inward * v[0], inward * trial[0]];
                normal = self.compress(i, mass, motion, shares, dt);
            } else if penetration > 0.0 {
                // (6), node by node.
                normal = mass * penetration / (dt * dt);
            }
            self.status[i] = ContactStatus::Open;
            let mut force = [0.0; 2];
            if normal > 0.0 {
                // Half of a dashpot on the mean velocity is inertia.
                let half = 0.5 * self.dashpots.get(i).copied().unwrap_or(0.0);
                let (inertia, speed) = (mass / dt, [face.speeds[i], 0.0]);
                let damped = inertia + half;
                let free = [1, 2].map(|c| (inertia * trial[c] - half * v[c]) / damped);
                let mut point = SlippingPoint {
                    inertia: damped,
                    free_slip: [0, 1].map(|c| speed[c] - free[c]),
                    slip_before: [0, 1].map(|c| speed[c] - v[c + 1]),
                };
                if !face.is_free[i] {
                    (point.free_slip[1], point.slip_before[1]) = (0.0, 0.0);
                }
                let friction = self.law.resolve_point(&point, normal);
                force = friction.force;
                self.status[i] = friction.status;
                self.ambiguous += u64::from(friction.is_ambiguous);
                fields.elastic[places[0]] = q[0] - inward * normal / mass;
                for c in 0..2 {
                    let after = free[c] + force[c] / damped;
                    let whole = force[c] - half * (v[c + 1] + after);
                    fields.elastic[places[c + 1]] = q[c + 1] - whole / mass;
                }
            }
            self.normal_force[i] = normal;
            [self.tangential_force[i], face.forces[i]] = force;
        }
        self.face = Some(face);
    }

    /// [`Self::settle`] on a face: powers have the parts of both directions.
    pub(super) fn settle_on_face(
        &self,
        fields: &mut MotionFields,
        coefficients: &StepCoefficients,
        shares: [f64; 3],
    ) -> (ContactPowers, StatusCounts) {
        let dt = coefficients.time_step;
        let mut powers = ContactPowers::default();
        let mut counts = StatusCounts { ambiguous: self.ambiguous, ..StatusCounts::default() };
        let Some(face) = &self.face else {
            return (powers, counts);
        };
        for i in 0..self.normal.len() {
            if let Some(law) = &self.compliance {
                powers.damping += law.dissipation[i];
            }
            if self.status[i] == ContactStatus::Open {
                counts.open += 1;
                continue;
            }
            let [v_n, v_t, q_n, q_t] = self.before[i];
            let [v_a, q_a] = face.before[i];
            let places = [self.normal[i], self.tangential[i], face.across[i]];
            let before = [(v_n, q_n), (v_t, q_t), (v_a, q_a)];
            let mut means = [0.0; 3];
            for ((mean, place), (v, q)) in means.iter_mut().zip(places).zip(before) {
                fields.elastic[place] = q + dt * fields.elastic_rate[place];
                *mean = 0.5 * (v + fields.velocity[place]);
            }
            let [mean_n, mean_t, mean_a] = means;
            let tangential = self.tangential_force[i];
            let power = tangential * mean_t + face.forces[i] * mean_a;
            if self.status[i] == ContactStatus::Stick {
                counts.stick += 1;
                powers.stick += power;
            } else {
                counts.slip += 1;
                powers.slide += power;
            }
            // (9) and (10).
            let external = tangential * face.speeds[i];
            powers.external += external;
            powers.contact_dissipated += external - power;
            powers.normal += self.normal_force[i]
                * match &self.compliance {
                    None => self.inward * mean_n,
                    Some(_) => 0.5 * (self.pushed(i, shares[2]) - self.pushed(i, shares[0])) / dt,
                };
            if let Some(dashpot) = self.dashpots.get(i) {
                powers.damping += dashpot * (mean_t * mean_t + mean_a * mean_a);
            }
        }
        (powers, counts)
    }
}
