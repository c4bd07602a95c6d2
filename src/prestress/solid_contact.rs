//! Contact terms in the tangent of a body of revolution, and their derivative by the state of sliding.

use super::SolidSliding;
use super::pressing::{along_element, pressed_span_rate, slope_along};
use super::pressing_rate::SolidSlidingRate;
use crate::contact::{ContactStiffness, NormalLaw};
use crate::fem::solid::{FaceTerm, MovingSpan, SolidMatrix, face_matrix, face_matrix_rate};
use crate::mesh::{FaceElement, SolidSector};

/// Matrices of the contact.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactTerms {
    /// Penalty stiffness at rest and its friction; empty for rigid contact.
    pub penalty: [SolidMatrix; 2],
    /// Contact dashpots at rest and their friction.
    pub dashpots: [SolidMatrix; 2],
    /// `p_0 / V` across the sliding, and `p_0 mu'(V) / mu` along it where friction falls with the speed.
    pub friction_dashpots: SolidMatrix,
}

/// A weight at a point of the face, its derivative with respect to a parameter, and that along the element.
#[derive(Clone, Copy, Debug, Default)]
struct Weight {
    value: f64,
    rate: f64,
    slope: f64,
}

impl Weight {
    fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            rate: self.rate * other.value + self.value * other.rate,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }

    fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            rate: (self.rate - value * other.rate) / other.value,
            slope: (self.slope - value * other.slope) / other.value,
        }
    }
}

/// Pressure and friction along the face.
struct Face<'a> {
    base: &'a SolidSliding,
    sector: &'a SolidSector,
    /// How they change; as they are without.
    rate: Option<&'a SolidSlidingRate>,
}

/// The matrices of the contact of a state.
pub(super) fn contact_terms(
    base: &SolidSliding,
    sector: &SolidSector,
    contact: &ContactStiffness,
) -> ContactTerms {
    let face = Face { base, sector, rate: None };
    face.terms(contact, 0.0)
}

/// Their derivative where the state changes at `rate`, and the stiffness of the interface at `stiffness_rate`.
pub(super) fn contact_term_rates(
    base: &SolidSliding,
    rate: &SolidSlidingRate,
    sector: &SolidSector,
    (contact, stiffness_rate): (&ContactStiffness, f64),
) -> ContactTerms {
    let face = Face { base, sector, rate: Some(rate) };
    face.terms(contact, stiffness_rate)
}

impl Face<'_> {
    fn terms(&self, contact: &ContactStiffness, stiffness_rate: f64) -> ContactTerms {
        let face = self.sector.specification.contact.face();
        let (normal, side) = (face.normal_component(), face.across_component());
        let pressed = |row,
                       column,
                       value: &dyn Fn(&FaceElement, f64) -> Weight,
                       factor: &dyn Fn(&FaceElement, f64) -> Weight| {
            self.term([row, column], true, &|element, radius, along| match self
                .pressure(element, along)
                .value
                > 0.0
            {
                true => value(element, along).times(factor(element, radius)),
                false => Weight::default(),
            })
        };
        let one = |_: &FaceElement, _: f64| constant(1.0, 0.0);
        let inwards = constant(face.inward_sign(), 0.0);
        let drag = |element: &FaceElement, r: f64| inwards.times(self.friction(element, r).0);
        let normal_and_drag = |value: &dyn Fn(&FaceElement, f64) -> Weight| {
            [pressed(normal, normal, value, &one), pressed(1, normal, value, &drag)]
        };
        let dashpot = |value: f64| move |_: &FaceElement, _: f64| constant(value, 0.0);
        let mut dashpots: [SolidMatrix; 2] = match contact.normal_damping {
            0.0 => Default::default(),
            damping => normal_and_drag(&dashpot(damping)),
        };
        let tangential = contact.tangential_damping;
        if tangential != 0.0 {
            for component in [1, side] {
                let term = pressed(component, component, &dashpot(tangential), &one);
                dashpots[0].extend(term);
            }
        }
        let mut friction_dashpots = self.term([side, side], false, &|element, radius, along| {
            let (drag, _) = self.friction(element, radius);
            let size = drag.times(constant(self.base.sliding_direction, 0.0));
            let weight = self.pressure(element, along).times(size);
            weight.over(self.speed(element, radius))
        });
        if self.base.contact.decay.is_some() {
            friction_dashpots.extend(self.term([1, 1], false, &|element, radius, along| {
                let (_, slope) = self.friction(element, radius);
                self.pressure(element, along).times(slope)
            }));
        }
        ContactTerms {
            penalty: match (self.base.law, contact.normal_stiffness) {
                (Some(law), _) => {
                    normal_and_drag(&|element, along| self.spring(law, element, along))
                }
                (None, Some(own)) => normal_and_drag(&|_, _| constant(own, stiffness_rate)),
                (None, None) => Default::default(),
            },
            dashpots,
            friction_dashpots,
        }
    }

    /// The matrix of a term, or its derivative: of the weight where the points are, and of the points that move with the ends of the
    /// pressed part. `is_nodal` as in [`FaceTerm`].
    fn term(
        &self,
        [row, column]: [usize; 2],
        is_nodal: bool,
        weight: &dyn Fn(&FaceElement, f64, f64) -> Weight,
    ) -> SolidMatrix {
        let faces = self.sector.contact_elements();
        let span = |element: &FaceElement| self.base.pressed_span(self.sector, element);
        let of = |weight| FaceTerm { row, column, weight, span: &span, is_nodal };
        let value = |element: &FaceElement, r: f64, at: f64| weight(element, r, at).value;
        let Some(changes) = self.rate else {
            return face_matrix(self.sector, &faces, &of(&value));
        };
        let rate = |element: &FaceElement, r: f64, at: f64| weight(element, r, at).rate;
        let mut result = face_matrix(self.sector, &faces, &of(&rate));
        let moving = MovingSpan {
            rate: &|element| match self.base.law {
                Some(_) => {
                    let approaches = (&self.base.approaches[..], &changes.approaches[..]);
                    pressed_span_rate(self.sector, approaches, element)
                }
                // Rings in rigid contact are pressed or not.
                None => [0.0; 2],
            },
            weight_slope: &|element, r, at| weight(element, r, at).slope,
        };
        result.extend(face_matrix_rate(self.sector, &faces, &of(&value), &moving));
        result
    }

    fn pressure(&self, element: &FaceElement, along: f64) -> Weight {
        let (base, sector) = (self.base, self.sector);
        let value = base.pressure_along(sector, element, along);
        if value <= 0.0 {
            return Weight::default();
        }
        let rate_of = |values: fn(&SolidSlidingRate) -> &Vec<f64>| {
            let own = self.rate.map(values);
            own.map_or(0.0, |values| along_element(sector, values, element, along))
        };
        match base.law {
            Some(law) if sector.is_quadratic() => {
                let approach = along_element(sector, &base.approaches, element, along);
                let stiffness = law.stiffness(approach);
                let [by_law, _] = self.rate.map_or([0.0; 2], |r| r.by_law(law, approach));
                Weight {
                    value,
                    rate: by_law + stiffness * rate_of(|r| &r.approaches),
                    slope: stiffness * slope_along(sector, &base.approaches, element, along),
                }
            }
            _ => Weight {
                value,
                rate: rate_of(|r| &r.pressures),
                slope: slope_along(sector, &base.pressures, element, along),
            },
        }
    }

    /// Stiffness of the springs at a point.
    fn spring(&self, law: NormalLaw, element: &FaceElement, along: f64) -> Weight {
        let (base, sector) = (self.base, self.sector);
        let approach = along_element(sector, &base.approaches, element, along).max(0.0);
        let curvature = law.curvature(approach);
        let rate = self.rate.map_or(0.0, |rate| {
            let moved = along_element(sector, &rate.approaches, element, along);
            rate.by_law(law, approach)[1] + curvature * moved
        });
        Weight {
            value: law.stiffness(approach),
            rate,
            slope: curvature * slope_along(sector, &base.approaches, element, along),
        }
    }

    /// Drag and slope of the friction law at a radius.
    fn friction(&self, element: &FaceElement, radius: f64) -> (Weight, Weight) {
        let (surface_speed, friction) = self.base.friction(radius);
        let speed = self.speed(element, radius).slope;
        let rates = self.rate.map(|rate| rate.friction(self.base, radius));
        let (drag, slope) = rates.map_or((0.0, 0.0), |rate| (rate.drag, rate.slope));
        let decay = self.base.contact.decay;
        let curvature = decay.map_or(0.0, |decay| decay.curvature(surface_speed));
        (
            Weight {
                value: friction.drag,
                rate: drag,
                slope: self.base.sliding_direction * friction.slope * speed,
            },
            Weight { value: friction.slope, rate: slope, slope: curvature * speed },
        )
    }

    /// Slip speed at a radius, m/s.
    fn speed(&self, element: &FaceElement, radius: f64) -> Weight {
        let end = |along: f64| element.radius_at(self.sector, [0.0, along]);
        let speed = self.base.contact.rotation_speed.abs();
        Weight {
            value: self.base.friction(radius).0,
            rate: 0.0,
            slope: speed * 0.5 * (end(1.0) - end(-1.0)),
        }
    }
}

fn constant(value: f64, rate: f64) -> Weight {
    Weight { value, rate, slope: 0.0 }
}
