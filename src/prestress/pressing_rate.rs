//! Derivative of the steady sliding of a body of revolution by its stiffness, its springs and its friction law.

use super::face_conditions::supports;
use super::pressing::{
    System, approaches, distance, pressed_span, pressed_span_rate, pushed, springs,
};
use super::{Parameter, PrestressError, SolidSliding};
use crate::contact::SteadyFriction;
use crate::fem::solid::{FaceTerm, MovingSpan, SolidMatrix, face_matrix_rate};
use crate::mesh::SolidSector;

/// Steps of the derivative of a pressed part that moves, and the change relative to the largest at which they are given up; each
/// is smaller than the last by what the springs' Newton steps leave, the difference between a ring's mean and its nodes.
const STEPS: usize = 60;
const SETTLED: f64 = 1e-14;

/// What changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct SolidChange<'a> {
    /// Elastic stiffness, for each unit of the parameter.
    pub elastic: Option<&'a SolidMatrix>,
    /// Stiffness of the springs that carry the base state, for each unit of the parameter.
    pub normal_stiffness: f64,
    /// The parameter, which may be one of the friction law.
    pub parameter: Parameter,
}

/// Derivative of a [`SolidSliding`] with respect to a parameter: the implicit function theorem on its equilibrium, with the rings
/// pressed that are.
#[derive(Clone, Debug)]
pub(super) struct SolidSlidingRate {
    pub pressed_displacement: Vec<f64>,
    pub sheared_displacement: Vec<f64>,
    /// In the order of [`SolidSliding::normal_forces`].
    pub normal_forces: Vec<f64>,
    pub pressures: Vec<f64>,
    pub approaches: Vec<f64>,
    pub normal_stiffness: f64,
    parameter: Parameter,
}

impl SolidSlidingRate {
    /// The derivative for a body of this elastic stiffness.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] as for the state itself.
    pub fn new(
        base: &SolidSliding,
        sector: &SolidSector,
        elastic: &SolidMatrix,
        change: &SolidChange<'_>,
    ) -> Result<Self, PrestressError> {
        let rings = sector.rings.len();
        let dofs = 3 * sector.node_count();
        let mut rate = Self {
            pressed_displacement: vec![0.0; dofs],
            sheared_displacement: vec![0.0; dofs],
            normal_forces: vec![0.0; base.normal_forces.len()],
            pressures: vec![0.0; rings],
            approaches: vec![0.0; rings],
            normal_stiffness: change.normal_stiffness,
            parameter: change.parameter,
        };
        let [springs, _] = supports(sector);
        let system = System::new(sector, &[elastic, &springs]);
        let changed = System::new(sector, change.elastic.as_slice());
        if change.elastic.is_some() || change.normal_stiffness != 0.0 {
            match base.normal_stiffness {
                None => rate.press_rigidly(base, sector, [&system, &changed])?,
                Some(_) => rate.press_on_springs(base, sector, [&system, &changed])?,
            }
        }
        rate.shear(base, sector, [&system, &changed])?;
        Ok(rate)
    }

    /// Derivative of the friction of steady sliding at a radius.
    pub fn friction(&self, base: &SolidSliding, radius: f64) -> SteadyFriction {
        let speed = base.contact.rotation_speed.abs() * radius;
        let rates = base.contact.decay.map(|decay| decay.rates(speed));
        let [share, slope] = match (rates, self.parameter) {
            (Some([by_ratio, _]), Parameter::StaticFrictionRatio) => by_ratio,
            (Some([_, by_speed]), Parameter::DecaySpeed) => by_speed,
            _ => [0.0; 2],
        };
        SteadyFriction {
            drag: base.sliding_direction * share,
            slope,
        }
    }

    /// `K u' = -K' u` with pressed rings where they are.
    fn press_rigidly(
        &mut self,
        base: &SolidSliding,
        sector: &SolidSector,
        [system, changed]: [&System; 2],
    ) -> Result<(), PrestressError> {
        let face = sector.specification.contact.face();
        let (inward, component) = (face.inward_sign(), face.normal_component());
        let mut prescribed = vec![None; system.dofs];
        for (node, _) in &base.normal_forces {
            prescribed[3 * node + component] = Some(0.0);
        }
        let added = changed.stiffness.multiply(&base.pressed_displacement);
        let load: Vec<f64> = added.iter().map(|force| -force).collect();
        self.pressed_displacement = system.solve(&load, &prescribed)?;
        let held = system.stiffness.multiply(&self.pressed_displacement);
        let force = |node: usize| {
            let dof = 3 * node + component;
            inward * (held[dof] + added[dof])
        };
        self.normal_forces = base.normal_forces.iter().map(|(n, _)| force(*n)).collect();
        self.approaches = approaches(sector, 0.0, &self.pressed_displacement);
        for (k, ring) in sector.rings.iter().enumerate() {
            if base.is_pressed[k] {
                let forces = ring.nodes.iter().map(|node| force(*node));
                self.pressures[k] = forces.sum::<f64>() / ring.area;
            }
        }
        Ok(())
    }

    /// `(K + S) u' = -K' u + S' (delta n - u)`, where `S'` has the change of the springs and the motion of the ends of the pressed
    /// part, which follows `u'`.
    fn press_on_springs(
        &mut self,
        base: &SolidSliding,
        sector: &SolidSector,
        [system, changed]: [&System; 2],
    ) -> Result<(), PrestressError> {
        let face = sector.specification.contact.face();
        let (inward, component) = (face.inward_sign(), face.normal_component());
        let stiffness = base.normal_stiffness.unwrap_or(0.0);
        let pressed = springs(sector, stiffness, &base.approaches);
        let spring = System::new(sector, &[&pressed]);
        let mut whole = System::new(sector, &[]);
        whole.stiffness.add_scaled(1.0, &system.stiffness);
        whole.stiffness.add_scaled(1.0, &spring.stiffness);
        let fit = pushed(sector, base.contact.interference);
        let left = distance(sector, &fit, &base.pressed_displacement);
        let stiffer = self.normal_stiffness / stiffness;
        let mut push = spring.stiffness.multiply(&left);
        push.iter_mut().for_each(|force| *force *= stiffer);
        let added = changed.stiffness.multiply(&base.pressed_displacement);
        let mut moved = vec![0.0; system.dofs];
        for _ in 0..STEPS {
            let forces = push.iter().zip(&moved).zip(&added);
            let load: Vec<f64> = forces.map(|((push, moved), a)| push + moved - a).collect();
            self.pressed_displacement = whole.solve(&load, &vec![None; system.dofs])?;
            self.approaches = approaches(sector, 0.0, &self.pressed_displacement);
            let rates = self.spring_motion(base, sector, stiffness);
            let next = System::new(sector, &[&rates]).stiffness.multiply(&left);
            let changes = next.iter().zip(&moved).map(|(a, b)| (a - b).abs());
            let change = changes.fold(0.0, f64::max);
            let scale = load.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            moved = next;
            if change <= SETTLED * scale {
                break;
            }
        }
        let zero = vec![0.0; system.dofs];
        let back = distance(sector, &zero, &self.pressed_displacement);
        let back = spring.stiffness.multiply(&back);
        let nodes = base.normal_forces.iter().map(|(node, _)| {
            let dof = 3 * node + component;
            inward * (push[dof] + moved[dof] + back[dof])
        });
        self.normal_forces = nodes.collect();
        let rings = base.approaches.iter().zip(&self.approaches);
        let pressure = |(own, rate): (&f64, &f64)| match *own > 0.0 {
            true => self.normal_stiffness * own + stiffness * rate,
            false => 0.0,
        };
        self.pressures = rings.map(pressure).collect();
        Ok(())
    }

    /// What the motion of the ends of the pressed part does to the springs.
    fn spring_motion(
        &self,
        base: &SolidSliding,
        sector: &SolidSector,
        stiffness: f64,
    ) -> SolidMatrix {
        let component = sector.specification.contact.face().normal_component();
        let term = FaceTerm {
            row: component,
            column: component,
            weight: &|_, _, _| stiffness,
            span: &|element| pressed_span(sector, &base.approaches, element),
        };
        let moving = MovingSpan {
            rate: &|element| {
                pressed_span_rate(sector, (&base.approaches, &self.approaches), element)
            },
            weight_slope: &|_, _, _| 0.0,
        };
        face_matrix_rate(sector, &sector.contact_elements(), &term, &moving)
    }

    /// The displacement that friction causes.
    fn shear(
        &mut self,
        base: &SolidSliding,
        sector: &SolidSector,
        [system, changed]: [&System; 2],
    ) -> Result<(), PrestressError> {
        let added = changed.stiffness.multiply(&base.sheared_displacement);
        let mut load: Vec<f64> = added.iter().map(|force| -force).collect();
        for ((node, force), rate) in base.normal_forces.iter().zip(&self.normal_forces) {
            let radius = sector.nodes[*node].radius;
            let (_, friction) = base.friction(radius);
            let changed = self.friction(base, radius);
            load[3 * node + 1] += friction.drag * rate + changed.drag * force;
        }
        self.sheared_displacement = system.torsion(&load, &vec![None; system.dofs])?;
        Ok(())
    }
}
