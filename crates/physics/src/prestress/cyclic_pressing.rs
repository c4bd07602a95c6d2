//! The pressed equilibrium of a body whose sectors are alike, from one of them.

use super::PrestressError;
use super::complementarity::{PressedRange, range};
use super::condensed::CondensedContact;
use super::cyclic::turned_pair;
use super::elimination::Elimination;
use super::penalty::PenaltyContact;
use super::pressed_state::{PressedState, Pressing};
use crate::contact::{Point, Row};
use crate::fem::Triplets;
use crate::mesh::{CyclicSymmetry, Mesh};
use std::collections::BTreeMap;

/// Difference of coefficients of two points' rows, over the largest one, up to which they are copies.
const ALIKE: f64 = 1e-7;
/// Gap, over the root of a point's share of the surface, that is none.
const NO_GAP: f64 = 1e-4;
/// Coefficients of a row, over the largest one, that are round-off.
const ROUND_OFF: f64 = 1e-12;

/// The sector of a pressed body and the copies of its points.
struct SectorPressing {
    stiffness: Triplets,
    load: Vec<f64>,
    elimination: Elimination,
    points: Vec<Point>,
    /// Point of the whole body that each of them is.
    first: Vec<usize>,
    /// Point of the sector that each point of the whole body is a copy of.
    copy_of: Vec<usize>,
    count: usize,
}

impl Pressing<'_> {
    /// The states at every one of `friction_coefficients`, of a body of equal sectors from one of them: its loads and points are the
    /// same in each, and so is its state, in frames that turn with it.
    ///
    /// # Errors
    /// [`PrestressError::MixedContacts`]; [`PrestressError::NoState`] at the first friction coefficient without one;
    /// [`PrestressError::GapEverywhere`]; [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn states(
        &self,
        mesh: &Mesh,
        friction_coefficients: &[f64],
    ) -> Result<PressedRange, PrestressError> {
        let sector = mesh.symmetry.as_ref();
        let Some(sector) = sector.and_then(|own| SectorPressing::of(self, own)) else {
            return self.states_of_all(friction_coefficients);
        };
        let of_first = |values: &[Option<f64>]| sector.first.iter().map(|&i| values[i]).collect();
        let own = Pressing {
            stiffness: &sector.stiffness,
            load: sector.load.clone(),
            elimination: sector.elimination.clone(),
            points: &sector.points,
            contacts: Vec::new(),
            pushed: sector.first.iter().map(|&i| self.pushed[i]).collect(),
            stiffnesses: of_first(&self.stiffnesses),
            laws: sector.first.iter().map(|&i| self.laws[i]).collect(),
        };
        Ok(sector.of_all(own.states_of_all(friction_coefficients)?))
    }

    /// Points on springs leave the matrices sparse; rigid ones need the bodies' response to each.
    fn states_of_all(&self, friction_coefficients: &[f64]) -> Result<PressedRange, PrestressError> {
        match PenaltyContact::new(self)? {
            Some(mut bodies) => range(&mut bodies, friction_coefficients),
            None if self.laws.iter().any(Option::is_some) => Err(PrestressError::MixedContacts),
            None => range(&mut CondensedContact::new(self)?, friction_coefficients),
        }
    }
}

/// A row with the place of each dof in its sector, and the sectors counted from that of the row.
type SectorRow = Vec<([usize; 2], f64)>;

impl SectorPressing {
    /// The sector of a pressed body; `None` where ties or equations join sectors, or loads and points differ from one to another.
    fn of(whole: &Pressing<'_>, symmetry: &CyclicSymmetry) -> Option<Self> {
        let (count, total) = (symmetry.count, whole.load.len());
        let size = total / count;
        if size * count != total || whole.elimination.combinations().next().is_some() {
            return None;
        }
        let load = whole.load[..size].to_vec();
        let largest = load.iter().fold(0.0_f64, |m, force| m.max(force.abs()));
        let mut loads = whole.load.iter().enumerate();
        if !loads.all(|(dof, force)| (force - load[dof % size]).abs() <= ALIKE * largest) {
            return None;
        }
        let unknowns = whole.elimination.unknowns();
        let is_held = |dof: usize| unknowns.unknown_of[dof].is_none();
        if (0..total).any(|dof| is_held(dof) != is_held(dof % size))
            || !turns_with_body(whole.stiffness, size, total)
        {
            return None;
        }
        let (first, copy_of) = copies(whole, size, count)?;
        let folded = |row: &Row| -> Row {
            let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
            for &(dof, value) in row {
                *sum.entry(dof % size).or_default() += value;
            }
            sum.into_iter().collect()
        };
        let points = first.iter().map(|&i| {
            let point = &whole.points[i];
            Point {
                normal: folded(&point.normal),
                lift: folded(&point.lift),
                slip: folded(&point.slip),
                across: folded(&point.across),
                ..point.clone()
            }
        });
        let entries = whole.stiffness.entries.iter().filter(|(row, ..)| *row < size);
        let entries = entries.map(|&(row, column, value)| (row, column % size, value));
        Some(Self {
            stiffness: Triplets { entries: entries.collect() },
            elimination: Elimination::holding(size, (0..size).filter(|&dof| is_held(dof))),
            points: points.collect(),
            load,
            first,
            copy_of,
            count,
        })
    }

    /// The states of the whole body.
    fn of_all(&self, range: PressedRange) -> PressedRange {
        let repeated = |values: Vec<f64>| values.repeat(self.count);
        let spread = |values: Vec<f64>| self.copy_of.iter().map(|&i| values[i]).collect();
        range.map(|state| PressedState {
            displacements: state.displacements.into_iter().map(repeated).collect(),
            normal_forces: state.normal_forces.into_iter().map(spread).collect(),
            stiffnesses: state.stiffnesses.into_iter().map(spread).collect(),
            is_pressed: self.copy_of.iter().map(|&i| state.is_pressed[i]).collect(),
            frozen_below: state.frozen_below,
        })
    }
}

/// A point of contact by the sector in which it lies.
struct PlacedPoint {
    sector: usize,
    point: usize,
    normal: SectorRow,
    slip: SectorRow,
}

/// The points of the first sector, and for every point which of them it is a copy of; `None` where one has none.
fn copies(whole: &Pressing<'_>, size: usize, count: usize) -> Option<(Vec<usize>, Vec<usize>)> {
    // Points that touch the same places of their sectors.
    let mut alike: BTreeMap<Vec<[usize; 2]>, Vec<PlacedPoint>> = BTreeMap::new();
    for (point, own) in whole.points.iter().enumerate() {
        let sector = sector_of(&own.normal, size, count)?;
        let [normal, slip] =
            [&own.normal, &own.slip].map(|row| seen_from(sector, row, size, count));
        let places = normal.iter().map(|entry| entry.0).collect();
        alike.entry(places).or_default().push(PlacedPoint { sector, point, normal, slip });
    }
    let mut firsts: Vec<usize> = Vec::new();
    let mut first_of = vec![usize::MAX; whole.points.len()];
    for group in alike.values() {
        let own: Vec<&PlacedPoint> = group.iter().filter(|p| p.sector == 0).collect();
        if own.len() * count != group.len() {
            return None;
        }
        for placed in group {
            let mut own = own.iter();
            let first = own.find(|first| is_copy(whole, placed, first))?;
            first_of[placed.point] = first.point;
        }
        firsts.extend(own.iter().map(|p| p.point));
    }
    firsts.sort_unstable();
    let place = |i: &usize| firsts.binary_search(i).ok();
    let copy_of = first_of.iter().map(place).collect::<Option<Vec<usize>>>()?;
    Some((firsts, copy_of))
}

/// Whether a point is another one turned: the same share of the surface, the same gap, the same rows.
fn is_copy(whole: &Pressing<'_>, own: &PlacedPoint, first: &PlacedPoint) -> bool {
    let are_same = |a: &SectorRow, b: &SectorRow| {
        let bound = ALIKE * b.iter().fold(0.0_f64, |m, entry| m.max(entry.1.abs()));
        let mut pairs = a.iter().zip(b);
        a.len() == b.len() && pairs.all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= bound)
    };
    let weights = [own, first].map(|p| whole.points[p.point].weight);
    let pushed = [own, first].map(|p| whole.pushed[p.point]);
    // Gaps that vanish are round-off beside the size of a point.
    let size = pushed[1].abs().max(NO_GAP * weights[1].sqrt());
    are_same(&own.normal, &first.normal)
        && are_same(&own.slip, &first.slip)
        && (weights[0] - weights[1]).abs() <= ALIKE * weights[1]
        && (pushed[0] - pushed[1]).abs() <= ALIKE * size
}

/// Entries of a row that are more than round-off.
fn entries(row: &Row) -> impl Iterator<Item = &(usize, f64)> + Clone {
    let largest = row.iter().fold(0.0_f64, |m, entry| m.max(entry.1.abs()));
    row.iter().filter(move |entry| entry.1.abs() > ROUND_OFF * largest)
}

/// The sector of a row, whose dofs lie there and in the next one at most.
fn sector_of(row: &Row, size: usize, count: usize) -> Option<usize> {
    let sectors = entries(row).map(|(dof, _)| dof / size);
    let reaches = |from: &usize| {
        let mut others = sectors.clone();
        others.all(|other| (other + count - from) % count <= 1)
    };
    let sector = sectors.clone().find(reaches)?;
    // Of two sectors each is the next of the other.
    let is_split = sectors.clone().any(|other| other != sector);
    (count > 2 || !is_split).then_some(sector)
}

/// A row with its sectors counted from one of them.
fn seen_from(sector: usize, row: &Row, size: usize, count: usize) -> SectorRow {
    let place = |&(dof, value): &(usize, f64)| {
        let ahead = (dof / size + count - sector) % count;
        ([ahead, dof % size], value)
    };
    let mut row: SectorRow = entries(row).map(place).collect();
    row.sort_by_key(|entry| entry.0);
    row
}

/// Whether a matrix takes a vector that is turned by one sector to what it makes of the vector, turned.
fn turns_with_body(matrix: &Triplets, size: usize, total: usize) -> bool {
    let [first, second] = turned_pair(size, total, |x| matrix.multiply(total, x));
    let largest = first.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
    let mut pairs = first.iter().zip(&second);
    pairs.all(|(a, b)| (a - b).abs() <= ALIKE * largest)
}
