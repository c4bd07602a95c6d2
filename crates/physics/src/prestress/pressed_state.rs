//! Bodies pressed together at their contact points, and the state of these.

use super::PrestressError;
use super::elimination::Elimination;
use crate::contact::{NormalLaw, Point, PressedState, Turning};
use crate::fem::Triplets;
use std::ops::Range;

/// What presses bodies together.
#[derive(Clone, Debug)]
pub struct Pressing<'a> {
    /// Stiffness over all dofs, supports included.
    pub stiffness: &'a Triplets,
    /// Load on all dofs, N (N/m in the plane).
    pub load: Vec<f64>,
    /// Held dofs and ties.
    pub elimination: Elimination,
    /// The contact points.
    pub points: &'a [Point],
    /// Numbers of points that touch together or not at all; empty where each is by itself.
    pub together: Vec<usize>,
    /// Section and name of each contact and its number of points, in their order; empty for one sector.
    pub contacts: Vec<(String, usize)>,
    /// How far the counterface is pushed in at each, `delta_i - g_i`, m.
    pub pushed: Vec<f64>,
    /// Law of the contact of each; `None` is rigid contact.
    pub laws: Vec<Option<NormalLaw>>,
}

impl Pressing<'_> {
    /// The points that touch together with one of them.
    pub(super) fn together_with(&self, point: usize) -> Range<usize> {
        let mut first = 0;
        for count in &self.together {
            if point < first + count {
                return first..first + count;
            }
            first += count;
        }
        point..point + 1
    }

    pub(super) fn gap_everywhere(&self) -> PrestressError {
        let distances = self.pushed.iter().map(|pushed| -pushed);
        let gaps = self.points.iter().zip(&self.pushed);
        let distance = distances.fold(f64::INFINITY, f64::min).max(0.0); // The least g_i - delta.
        let interference = gaps.map(|(point, pushed)| pushed + point.gap).fold(0.0, f64::max); // p_i + g_i = delta.
        PrestressError::gap_everywhere(self.points.len(), [distance, interference])
    }
}

/// Separations and normal forces of the points under one set of pressed points.
#[derive(Clone)]
pub(super) struct ContactState {
    pub separations: Vec<f64>,
    pub normal_forces: Vec<f64>,
    /// Stiffness of each point, N/m, where contact stiffens.
    pub stiffnesses: Option<Vec<f64>>,
}

/// The state of steady sliding of a body of equal sectors, the same in each, whose normal forces do not depend on friction.
///
/// It is the state of [`super::Assembly::of_edge`] for the annulus: harmonic zero of the stiffness, whose radial and tangential
/// parts do not mix. Per metre of thickness in the plane; vectors are over the dofs of the sector.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorSliding {
    /// Displacement, normal forces and springs of the contact nodes of the sector.
    pub state: PressedState,
    /// The contact nodes of the sector as contact points.
    pub points: Vec<Point>,
    /// How these turn.
    pub turnings: Vec<Turning>,
    /// The points at which the law of the contact acts, with their state, where they are others than the nodes.
    pub on_face: Option<(Vec<Point>, PressedState)>,
    /// Nodes of each place of the contact, a node or a ring of them, the other body's behind its own.
    pub places: Vec<Vec<usize>>,
    /// Whether each of these is pressed.
    pub is_pressed: Vec<bool>,
}

impl SectorSliding {
    /// The state of the whole body of `count` sectors: the same in the polar frames of each.
    pub fn repeated(&self, count: usize) -> PressedState {
        let points: Vec<usize> = (0..self.points.len()).collect();
        self.state.repeated(count, &points.repeat(count))
    }
}

impl PressedState {
    /// That of a body of `count` sectors alike, from this one of a sector; of each point of the body its copy in the sector.
    pub(super) fn repeated(&self, count: usize, copy_of: &[usize]) -> Self {
        let of_points = |powers: &[Vec<f64>]| -> Vec<Vec<f64>> {
            powers.iter().map(|own| copy_of.iter().map(|&i| own[i]).collect()).collect()
        };
        Self {
            displacements: self.displacements.iter().map(|own| own.repeat(count)).collect(),
            normal_forces: of_points(&self.normal_forces),
            stiffnesses: of_points(&self.stiffnesses),
            is_pressed: copy_of.iter().map(|&i| self.is_pressed[i]).collect(),
            frozen_below: self.frozen_below,
        }
    }
}
