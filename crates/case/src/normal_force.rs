//! `normal_force`: the counterface is pushed in until it presses with a given force.
//!
//! Without friction the summed normal force of a contact rises with its interference, by straight pieces where contact
//! is rigid. The interference that belongs to a force is the one root of their difference.

use super::{BodyKind, Case, CaseErrors, refusal};
use frictionsim_physics::contact::{Counterpart, SlidingContact};
use frictionsim_physics::fem::MassKind;
use frictionsim_physics::mesh::{SolidSector, Strip};
use frictionsim_physics::prestress::{Assembly, PrestressError, SectorSliding, SolidSliding};
use nalgebra::{DMatrix, DVector};

/// Factor of the steps up to an interference that presses enough.
const STEP: f64 = 4.0;
/// Steps up to it: from a micrometre to kilometres.
const MOST_STEPS: usize = 15;
/// Relative difference of forces below which the root is found.
const TOLERANCE: f64 = 1e-12;
/// Relative distance of two bounds between which the force of a body on soft springs is rounded.
const ROUNDED: f64 = 1e-6;
/// Relative difference of forces that such bodies may leave.
const MET: f64 = 1e-4;
/// Evaluations between two bounds, and steps of Newton's method.
const MOST_ROUNDS: usize = 60;
/// Step of an interference for slopes, relative to it, and the change of a force, relative to it, that a step may make.
const SMALL_STEP: f64 = 1e-4;
const LITTLE: f64 = 0.1;

/// A contact that is pressed with a force.
struct Wanted {
    key: String,
    /// Its place in the body.
    contact: usize,
    force: f64,
}

/// Pushes every counterface in whose contact has a force, and says how far.
pub(super) fn press(case: &mut Case) -> Result<(), CaseErrors> {
    let sections = case.contact_sections().into_iter().enumerate();
    let found = sections.filter_map(|(contact, (section, _))| {
        let key = format!("{section}.normal_force");
        Some(Wanted { force: case.number(&key)?, key, contact })
    });
    let wanted: Vec<Wanted> = found.collect();
    let places: Vec<f64> = wanted.iter().map(|own| interference_of(case, own.contact)).collect();
    if wanted.len() > 1 && largest(&excesses(case, &wanted, &places)?) > TOLERANCE {
        let alike = press_alike(case, &wanted, places[0])?;
        press_each(case, &wanted, vec![alike; wanted.len()])?;
    } else if wanted.len() == 1 {
        press_alike(case, &wanted, places[0])?;
    }
    for own in &wanted {
        let pushed = interference_of(case, own.contact);
        let told = format!("{} = {}: the counterface is pushed in", own.key, own.force);
        case.taken.notes.push(format!("{told} by {pushed:.6e} m"));
    }
    Ok(())
}

/// Presses contacts that lean on each other, from where all touch, by Newton's method: forces have straight pieces.
fn press_each(case: &mut Case, wanted: &[Wanted], mut places: Vec<f64>) -> Result<(), CaseErrors> {
    let (count, mut left) = (wanted.len(), excesses(case, wanted, &places)?);
    'steps: for _ in 0..MOST_ROUNDS {
        // Slopes of all forces over each interference, by a step at which no contact opens.
        let mut slopes = DMatrix::zeros(count, count);
        for j in 0..count {
            let mut step = SMALL_STEP * places[j];
            let mut reach = f64::INFINITY;
            while reach > LITTLE {
                let mut moved = places.clone();
                moved[j] += step;
                let beside = excesses(case, wanted, &moved)?;
                let change = DVector::from_fn(count, |i, _| beside[i] - left[i]);
                slopes.set_column(j, &(&change / step));
                reach = change.amax();
                step *= 0.5 * LITTLE / reach;
            }
        }
        let Some(change) = slopes.lu().solve(&DVector::from_column_slice(&left)) else { break };
        // As much of Newton's step as comes nearer.
        for halvings in 0..MOST_STEPS as i32 {
            let to = |(place, change): (&f64, &f64)| {
                (place - 0.5_f64.powi(halvings) * change).max(0.1 * place)
            };
            let next: Vec<f64> = places.iter().zip(change.iter()).map(to).collect();
            let found = excesses(case, wanted, &next)?;
            if largest(&found) < largest(&left) {
                (places, left) = (next, found);
                if largest(&left) <= TOLERANCE {
                    return Ok(());
                }
                continue 'steps;
            }
        }
        break;
    }
    left = excesses(case, wanted, &places)?;
    let missed = wanted.iter().zip(&left).find(|(_, left)| !(left.abs() <= MET));
    missed.map_or(Ok(()), |(own, _)| Err(not_reached(case, own)))
}

/// The largest of some excesses.
fn largest(excesses: &[f64]) -> f64 {
    excesses.iter().fold(0.0, |m, own| m.max(own.abs()))
}

/// Pushes contacts in alike, from a first place on, until the sum of their forces is that wanted; how far.
fn press_alike(case: &mut Case, wanted: &[Wanted], first: f64) -> Result<f64, CaseErrors> {
    let total: f64 = wanted.iter().map(|own| own.force).sum();
    let excess = |case: &mut Case, place: f64| {
        let all = excesses(case, wanted, &vec![place; wanted.len()])?;
        let sum: f64 = all.iter().zip(wanted).map(|(excess, own)| excess * own.force).sum();
        Ok(sum / total)
    };
    let start = excess(case, first)?;
    // Bounds on either side; without any interference a contact without overlap has no force.
    let (mut low, mut high) = ((0.0, -1.0), (first, start));
    let mut steps = 0..MOST_STEPS;
    while high.1 < -TOLERANCE && steps.next().is_some() {
        (low, high.0) = (high, STEP * high.0);
        high.1 = excess(case, high.0)?;
    }
    // The secant meets straight pieces at once; the bound that stays has its weight halved, after the Illinois rule.
    let (mut side, mut own, mut rounds) = (None, high, 0..MOST_ROUNDS);
    while own.1.abs() > TOLERANCE && rounds.next().is_some() {
        if high.1 < 0.0 || high.0 - low.0 <= f64::EPSILON * high.0 {
            break;
        }
        own.0 = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        own.1 = excess(case, own.0)?;
        let (moved, other) = match own.1 < 0.0 {
            true => (&mut low, &mut high),
            false => (&mut high, &mut low),
        };
        *moved = own;
        other.1 *= if side == Some(own.1 < 0.0) { 0.5 } else { 1.0 };
        side = Some(own.1 < 0.0);
    }
    // On soft springs the force has no root beyond its rounding: between close bounds it is met.
    let is_rounded = high.1 >= 0.0 && high.0 - low.0 <= ROUNDED * high.0;
    let is_met = own.1.abs() <= 1e3 * TOLERANCE || is_rounded && own.1.abs() <= MET;
    if is_met { Ok(own.0) } else { Err(not_reached(case, &wanted[0])) }
}

fn not_reached(case: &Case, wanted: &Wanted) -> CaseErrors {
    refusal!(case, &wanted.key,
        "{} = {}: no interference presses with this force", wanted.key, wanted.force; "not reached";
        "a surface that overlaps the counterface in the mesh presses already; one that nothing holds gives way")
}

/// The normal forces of contacts, each pushed in as far as its place says, less those wanted, over these.
fn excesses(case: &mut Case, wanted: &[Wanted], places: &[f64]) -> Result<Vec<f64>, CaseErrors> {
    wanted.iter().zip(places).for_each(|(own, &place)| set_interference(case, own.contact, place));
    let forces = case.normal_forces();
    let forces = forces.map_err(|why| case.error_at(&wanted[0].key, why, "no base state", None))?;
    Ok(wanted.iter().map(|own| forces[own.contact] / own.force - 1.0).collect())
}

fn interference_of(case: &Case, contact: usize) -> f64 {
    match case.body.assembly().and_then(|body| body.contacts.get(contact)) {
        Some(own) => own.counter.interference(),
        None => case.contact.sliding.interference,
    }
}

fn set_interference(case: &mut Case, contact: usize, interference: f64) {
    if let BodyKind::Assembly(body) = &mut case.body.kind
        && let Some(own) = body.contacts.get_mut(contact)
        && let Counterpart::Rigid(rigid) = &mut own.counter
    {
        rigid.interference = interference;
    }
    // That of the first contact is the common one.
    if contact == 0 {
        case.contact.sliding.interference = interference;
    }
}

impl Case {
    /// Mass of the analysis by harmonics, else that of a time step: contact of bricks follows it.
    pub fn mass(&self) -> MassKind {
        let own = self.cea.as_ref().map(|own| own.mass);
        let own = own.or(self.frf.as_ref().map(|own| own.mass));
        let is_stepped = self.transient.is_some();
        own.unwrap_or(if is_stepped { MassKind::Lumped } else { MassKind::Consistent })
    }

    /// Normal force of each contact without friction, N: the sum of its forces along its normals, none across a gap.
    pub fn normal_forces(&self) -> Result<Vec<f64>, String> {
        let contact = SlidingContact { friction_coefficient: 0.0, ..self.contact.sliding };
        let law = self.contact.stiffness.law;
        let (materials, mass) = (&self.body.materials, self.mass());
        let pressed = match &self.body.kind {
            BodyKind::Annulus(annulus) => {
                let mesh = Strip::of_annulus(annulus).map_err(in_words)?;
                let elastic = mesh.stiffness_alike(materials);
                let base = SectorSliding::solve(&mesh, &elastic, &contact, law);
                let whole = self.thickness * mesh.count as f64;
                base.map(|base| vec![whole * base.state.normal_forces[0].iter().sum::<f64>()])
            }
            BodyKind::Revolution(specification) => {
                let mesh = SolidSector::generate(specification).map_err(in_words)?;
                let elastic = mesh.strip.stiffness_alike(materials);
                let stiffness = &self.contact.stiffness;
                let base = SolidSliding::solve(&mesh, &elastic, &contact, stiffness, mass);
                let whole = mesh.sector_count() as f64;
                base.map(|base| vec![whole * base.normal_forces().map(|own| own.1).sum::<f64>()])
            }
            BodyKind::Imported(body) => {
                let stiffness = self.contact.stiffness;
                let body = Assembly::of_edge(&body.mesh, materials, &contact, stiffness);
                let forces = body.and_then(|body| Ok(body.state(0.0)?.normal_forces(0.0)));
                forces.map(|forces| vec![self.thickness * forces.iter().sum::<f64>()])
            }
            BodyKind::Assembly(body) => body.assembled(materials, mass).and_then(|assembly| {
                let mut rest = assembly.state(0.0)?.normal_forces(0.0).into_iter();
                let contacts = assembly.contacts().iter().map(|(_, surface)| surface.points.len());
                Ok(contacts.map(|count| rest.by_ref().take(count).sum()).collect())
            }),
        };
        match pressed {
            Err(PrestressError::GapEverywhere { .. }) => {
                Ok(vec![0.0; self.body.assembly().map_or(1, |body| body.contacts.len())])
            }
            other => other.map_err(in_words),
        }
    }
}

fn in_words(error: impl std::fmt::Display) -> String {
    error.to_string()
}
