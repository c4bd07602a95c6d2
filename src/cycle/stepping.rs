//! Limit cycles in the mesh's own time stepping: what one period of the explicit transient does to a cycle, and to small
//! perturbations of it.

use super::{CycleError, CycleSolver, LimitCycle};
use crate::contact::ContactStatus;
use crate::fem::operator::{
    MotionFields, AlignedVector, SimdLevel, StepCoefficients, StiffnessOperator, largest_frequency,
};
use crate::linalg::BlockOperator;
use crate::mesh::AnnulusMesh;
use crate::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, TimeStep, TransientModel,
    TransientSettings, build_operator, stable_step_limit,
};
use faer::{Mat, MatRef};
use std::f64::consts::TAU;

/// Share of the stability limit that a step takes.
const SAFETY: f64 = 0.95;

/// The time stepping of a mesh, shared by all its cycles.
pub struct MeshStepping {
    annulus: AnnulusMesh,
    operator: Box<dyn StiffnessOperator>,
    largest_frequency: f64,
}

/// Contact of one node during one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NodeContact {
    Open,
    Stick,
    /// Dragged forward, `T = +mu N`.
    Forward,
    /// Held back, `T = -mu N`.
    Backward,
}

/// One period of the transient, and the linear map that its contact makes of perturbations.
pub struct Period<'a> {
    stepping: &'a MeshStepping,
    coefficients: StepCoefficients,
    steps: usize,
    friction_coefficient: f64,
    normal: Vec<usize>,
    tangential: Vec<usize>,
    /// Contact of each node at each step.
    contact: Vec<NodeContact>,
    /// Places of the moving dofs, with the root of their mass.
    dofs: Vec<(usize, f64)>,
    /// Length of the period, s.
    pub duration: f64,
    /// Mean external power over the period, W/m.
    pub external_power: f64,
    /// Displacement and velocity at the start, places of the operator.
    pub start: [Vec<f64>; 2],
    pub end: [Vec<f64>; 2],
}

impl MeshStepping {
    /// The stepping of a solver's mesh.
    pub fn new(solver: &CycleSolver, point: &super::OperatingPoint, simd: SimdLevel) -> Result<Self, CycleError> {
        let annulus = AnnulusMesh::generate(&solver.specification)?;
        let model = TransientModel {
            annulus: &annulus,
            material: solver.material,
            damping: point.damping,
            contact: point.contact,
        };
        let operator = build_operator(&model, OperatorChoice::Auto, simd).unwrap();
        let largest_frequency = largest_frequency(operator.as_ref());
        Ok(Self { annulus, operator, largest_frequency })
    }

    /// A period of the transient that starts on a cycle, after `settling` others.
    pub fn period(&self, solver: &CycleSolver, cycle: &LimitCycle, settling: usize) -> Period<'_> {
        let point = &cycle.state.point;
        let duration = TAU / cycle.state.frequency;
        let limit = stable_step_limit(self.largest_frequency, &point.damping);
        let steps = (duration / (SAFETY * limit)).ceil() as usize;
        let time_step = duration / steps as f64;
        let model = TransientModel {
            annulus: &self.annulus,
            material: solver.material,
            damping: point.damping,
            contact: point.contact,
        };
        let settings = TransientSettings {
            duration,
            time_step: TimeStep::Seconds(time_step),
            sample_interval: duration,
            expansion_time: 0.0,
            initial: InitialState::LimitCycle { harmonic: cycle.harmonic, onset: 1 },
            perturbation: Perturbation::default(),
        };
        let [displacement, _] = solver.field(cycle, 0.0);
        let [_, velocity] = solver.field(cycle, -0.5 * time_step);
        let operator = self.operator.as_ref();
        let mut run = CentralDifference::start_from(model, operator, &settings, &displacement, velocity).unwrap();
        for _ in 0..settling * steps {
            run.advance();
        }
        let state = |run: &CentralDifference| [run.fields().displacement.to_vec(), run.fields().velocity.to_vec()];
        let start = state(&run);
        let mut contact = Vec::new();
        let mut external = 0.0;
        let surface_speed = point.contact.rotation_speed * solver.specification.inner_radius;
        for _ in 0..steps {
            run.advance();
            let law = run.contact();
            for (i, status) in law.status.iter().enumerate() {
                contact.push(match status {
                    ContactStatus::Open => NodeContact::Open,
                    ContactStatus::Stick => NodeContact::Stick,
                    ContactStatus::Slip if law.tangential_force[i] > 0.0 => NodeContact::Forward,
                    ContactStatus::Slip => NodeContact::Backward,
                });
                external += law.tangential_force[i] * surface_speed;
            }
        }
        let masses = operator.masses();
        let places = (0..operator.dof_count()).map(|dof| operator.position(dof));
        Period {
            stepping: self,
            coefficients: StepCoefficients {
                time_step,
                mass_coefficient: point.damping.mass_coefficient,
                stiffness_coefficient: point.damping.stiffness_coefficient,
            },
            steps,
            friction_coefficient: point.contact.friction_coefficient,
            normal: run.contact().normal_places().to_vec(),
            tangential: run.contact().tangential_places().to_vec(),
            contact,
            dofs: places.filter(|&k| masses[k] > 0.0).map(|k| (k, masses[k].sqrt())).collect(),
            duration,
            external_power: external / steps as f64,
            end: state(&run),
            start,
        }
    }
}

impl Period<'_> {
    pub fn pack(&self, u: &[f64], v: &[f64]) -> Vec<f64> {
        let omega = TAU / self.duration;
        let a = self.dofs.iter().map(|&(k, root)| omega * root * u[k]);
        let b = self.dofs.iter().map(|&(k, root)| root * v[k]);
        a.chain(b).collect()
    }
    fn advance(&self, fields: &mut MotionFields, step: usize, before: &mut [[f64; 2]]) {
        let StepCoefficients { time_step: dt, mass_coefficient: alpha, stiffness_coefficient: beta } = self.coefficients;
        let count = self.normal.len();
        let contact = &self.contact[step * count..(step + 1) * count];
        for i in 0..count {
            if contact[i] == NodeContact::Open {
                continue;
            }
            let (n, t) = (self.normal[i], self.tangential[i]);
            let (q_n, q_t) = (fields.elastic[n], fields.elastic[t]);
            before[i] = [q_n, q_t];
            let (v_n, v_t) = (fields.velocity[n], fields.velocity[t]);
            let trial_n = v_n - dt * (q_n + (alpha * v_n + beta * fields.elastic_rate[n]));
            let normal = -(fields.displacement[n] + dt * trial_n) / (dt * dt);
            let tangential = match contact[i] {
                NodeContact::Stick => {
                    let trial_t = v_t - dt * (q_t + (alpha * v_t + beta * fields.elastic_rate[t]));
                    -trial_t / dt
                }
                NodeContact::Forward => self.friction_coefficient * normal,
                _ => -self.friction_coefficient * normal,
            };
            fields.elastic[n] = q_n - normal;
            fields.elastic[t] = q_t - tangential;
        }
        self.stepping.operator.advance(fields, &self.coefficients);
        for i in 0..count {
            if contact[i] != NodeContact::Open {
                let (n, t) = (self.normal[i], self.tangential[i]);
                fields.elastic[n] = before[i][0] + dt * fields.elastic_rate[n];
                fields.elastic[t] = before[i][1] + dt * fields.elastic_rate[t];
            }
        }
    }
}

impl BlockOperator for Period<'_> {
    fn dimension(&self) -> usize {
        2 * self.dofs.len()
    }

    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let operator = self.stepping.operator.as_ref();
        let omega = TAU / self.duration;
        let half = self.dofs.len();
        let zeros = || AlignedVector::zeros(operator.field_length());
        let mut result = Mat::zeros(x.nrows(), x.ncols());
        for column in 0..x.ncols() {
            let mut fields = MotionFields { displacement: zeros(), velocity: zeros(), elastic: zeros(), elastic_rate: zeros() };
            for (i, &(k, root)) in self.dofs.iter().enumerate() {
                fields.displacement[k] = x[(i, column)] / (omega * root);
                fields.velocity[k] = x[(half + i, column)] / root;
            }
            operator.multiply(&mut fields.displacement, &mut fields.elastic);
            operator.multiply(&mut fields.velocity, &mut fields.elastic_rate);
            let mut before = vec![[0.0; 2]; self.normal.len()];
            for step in 0..self.steps {
                self.advance(&mut fields, step, &mut before);
            }
            for (i, &(k, root)) in self.dofs.iter().enumerate() {
                result[(i, column)] = fields.displacement[k] * omega * root;
                result[(half + i, column)] = fields.velocity[k] * root;
            }
        }
        result
    }
}
