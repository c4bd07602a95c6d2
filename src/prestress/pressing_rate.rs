//! Derivative of the steady sliding of a body of revolution by its stiffness, its springs and its friction law.

use super::face_conditions::supports;
use super::pressing::{
    Springs, System, along_element, approaches, distance, field, pressed_span_rate, slope_along,
};
use super::{Parameter, PrestressError, SolidSliding};
use crate::contact::{LawParameter, NormalLaw, SteadyFriction};
use crate::fem::solid::{MovingSpan, SolidMatrix, face_matrix, face_matrix_rate};
use crate::mesh::{FaceElement, SolidSector};

/// Steps of the derivative of a pressed part that moves, and the change relative to the largest at which they are given up; each
/// is smaller than the last by what the springs' Newton steps leave, the difference between a ring's mean and its nodes.
const STEPS: usize = 60;
const SETTLED: f64 = 1e-14;

/// What changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct SolidChange<'a> {
    /// Elastic stiffness, for each unit of the parameter.
    pub elastic: Option<&'a SolidMatrix>,
    /// The number of the springs' law that the parameter is, where they carry the base state.
    pub law_parameter: Option<LawParameter>,
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
    law_parameter: Option<LawParameter>,
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
            law_parameter: change.law_parameter,
            parameter: change.parameter,
        };
        let [springs, _] = supports(sector);
        let system = System::new(sector, &[elastic, &springs]);
        let changed = System::new(sector, change.elastic.as_slice());
        if change.elastic.is_some() || change.law_parameter.is_some() {
            match base.law {
                None => rate.press_rigidly(base, sector, [&system, &changed])?,
                Some(law) => rate.press_on_springs(base, sector, law, [&system, &changed])?,
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
        SteadyFriction { drag: base.sliding_direction * share, slope }
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

    /// `(K + S) u' = -K' u + P' g n + (P - S) g' n + S' (delta n - u - g n)` with the secant stiffness `P` and the tangent `S` of the
    /// springs, whose changes are those of the law, of the approach, and of the ends of the pressed part; the last two follow `u'`.
    fn press_on_springs(
        &mut self,
        base: &SolidSliding,
        sector: &SolidSector,
        law: NormalLaw,
        [system, changed]: [&System; 2],
    ) -> Result<(), PrestressError> {
        let face = sector.specification.contact.face();
        let (inward, component) = (face.inward_sign(), face.normal_component());
        let rings = base.approaches.len();
        let springs = Springs { sector, law, approaches: &base.approaches };
        let spring = System::new(sector, &[&springs.tangent()]);
        let mut whole = System::new(sector, &[]);
        whole.stiffness.add_scaled(1.0, &system.stiffness);
        whole.stiffness.add_scaled(1.0, &spring.stiffness);
        let fit = field(sector, &vec![base.contact.interference; rings]);
        let left = distance(sector, &fit, &base.pressed_displacement);
        let left = distance(sector, &left, &field(sector, &base.approaches));
        let own = field(sector, &base.approaches);
        let secant = System::new(sector, &[&springs.secant()]);
        let added = changed.stiffness.multiply(&base.pressed_displacement);
        let mut moved = vec![0.0; system.dofs];
        for _ in 0..STEPS {
            let forces = moved.iter().zip(&added);
            let load: Vec<f64> = forces.map(|(moved, a)| moved - a).collect();
            self.pressed_displacement = whole.solve(&load, &vec![None; system.dofs])?;
            self.approaches = approaches(sector, 0.0, &self.pressed_displacement);
            let [pushes, stiffer] = self.spring_rates(&springs);
            let pushes = System::new(sector, &[&pushes]).stiffness.multiply(&own);
            let stiffer = System::new(sector, &[&stiffer]).stiffness.multiply(&left);
            let nearer = field(sector, &self.approaches);
            let [along, back] = [&secant, &spring].map(|of| of.stiffness.multiply(&nearer));
            let next: Vec<f64> = (0..system.dofs)
                .map(|dof| pushes[dof] + stiffer[dof] + (along[dof] - back[dof]))
                .collect();
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
            inward * (moved[dof] + back[dof])
        });
        self.normal_forces = nodes.collect();
        let rings = base.approaches.iter().zip(&self.approaches);
        let pressure = |(own, rate): (&f64, &f64)| match *own > 0.0 {
            true => self.by_law(law, *own)[0] + law.stiffness(*own) * rate,
            false => 0.0,
        };
        self.pressures = rings.map(pressure).collect();
        Ok(())
    }

    /// What the parameter does to pressure and stiffness of the law at the same approach.
    pub fn by_law(&self, law: NormalLaw, approach: f64) -> [f64; 2] {
        let rates = self.law_parameter.and_then(|own| law.rates(own, approach));
        rates.unwrap_or_default()
    }

    /// Changes of the secant and of the tangent stiffness of the springs: by the law's numbers, the approach, and the motion of the
    /// ends of the pressed part.
    fn spring_rates(&self, springs: &Springs<'_>) -> [SolidMatrix; 2] {
        let (sector, law) = (springs.sector, springs.law);
        let faces = sector.contact_elements();
        let span = |element: &FaceElement| springs.span(element);
        let ends = (springs.approaches, self.approaches.as_slice());
        let ends = |element: &FaceElement| pressed_span_rate(sector, ends, element);
        let matrix = |rate: &dyn Fn(f64, f64) -> f64, value: &dyn Fn(f64) -> [f64; 2]| {
            let rate = |element: &FaceElement, _: f64, along: f64| {
                let moved = along_element(sector, &self.approaches, element, along);
                rate(springs.approach(element, along), moved)
            };
            let at = |element: &FaceElement, along: f64| value(springs.approach(element, along));
            let own = |element: &FaceElement, _: f64, along: f64| at(element, along)[0];
            let slope = |element: &FaceElement, _: f64, along: f64| {
                at(element, along)[1] * slope_along(sector, springs.approaches, element, along)
            };
            let moving = MovingSpan { rate: &ends, weight_slope: &slope };
            let mut sum = face_matrix(sector, &faces, &springs.term(&rate, &span));
            let term = springs.term(&own, &span);
            sum.extend(face_matrix_rate(sector, &faces, &term, &moving));
            sum
        };
        [
            matrix(
                &|g, moved| {
                    let closed = g.max(f64::MIN_POSITIVE);
                    self.by_law(law, closed)[0] / closed + law.secant(g)[1] * moved
                },
                &|g| law.secant(g),
            ),
            matrix(&|g, moved| self.by_law(law, g)[1] + law.curvature(g) * moved, &|g| {
                [law.stiffness(g), law.curvature(g)]
            }),
        ]
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
