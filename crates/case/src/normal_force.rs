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

/// Contacts that are pressed with a force.
struct Wanted {
    key: String,
    /// Their places in the body.
    contacts: Vec<usize>,
    force: f64,
}

/// Pushes every counterface in whose contact has a force, and says how far.
pub(super) fn press(case: &mut Case) -> Result<(), CaseErrors> {
    let sections = case.contact_sections().into_iter().enumerate();
    let found = sections.filter_map(|(contact, (section, _))| {
        let key = format!("{section}.normal_force");
        Some(Wanted { force: case.number(&key)?, key, contacts: vec![contact] })
    });
    let wanted: Vec<Wanted> = found.collect();
    match &wanted[..] {
        [] => return Ok(()),
        [own] => solve(case, own)?,
        all => press_together(case, all)?,
    }
    for own in &wanted {
        let pushed = interference_of(case, own.contacts[0]);
        let told = format!("{} = {}: the counterface is pushed in", own.key, own.force);
        case.taken.notes.push(format!("{told} by {pushed:.6e} m"));
    }
    Ok(())
}

/// Presses contacts that lean on each other: all of them alike with the sum of their forces, then each by Newton's method, as forces
/// have straight pieces.
fn press_together(case: &mut Case, wanted: &[Wanted]) -> Result<(), CaseErrors> {
    let all = wanted.iter().map(|own| own.contacts[0]);
    let mut places: Vec<f64> = all.clone().map(|contact| interference_of(case, contact)).collect();
    let mut left = excesses(case, wanted, &places)?;
    if largest(&left) > TOLERANCE {
        let force = wanted.iter().map(|own| own.force).sum();
        let whole = Wanted { key: wanted[0].key.clone(), contacts: all.clone().collect(), force };
        solve(case, &whole)?;
        places = all.map(|contact| interference_of(case, contact)).collect();
        left = excesses(case, wanted, &places)?;
    }
    for _ in 0..MOST_ROUNDS {
        if largest(&left) <= TOLERANCE {
            break;
        }
        // Slopes of all forces over each interference, by a step that no contact opens at.
        let count = wanted.len();
        let mut slopes = DMatrix::zeros(count, count);
        for j in 0..count {
            let mut step = SMALL_STEP * places[j];
            loop {
                let mut moved = places.clone();
                moved[j] += step;
                let beside = excesses(case, wanted, &moved)?;
                let change = DVector::from_fn(count, |i, _| beside[i] - left[i]);
                slopes.set_column(j, &(&change / step));
                if !(change.amax() > LITTLE) {
                    break;
                }
                step *= 0.5 * LITTLE / change.amax();
            }
        }
        let Some(change) = slopes.lu().solve(&DVector::from_column_slice(&left)) else { break };
        // As much of Newton's step as comes nearer.
        let mut nearer = None;
        for halvings in 0..MOST_STEPS {
            let share = 0.5_f64.powi(halvings as i32);
            let to = |(place, change): (&f64, &f64)| (place - share * change).max(0.1 * place);
            let next: Vec<f64> = places.iter().zip(change.iter()).map(to).collect();
            let found = excesses(case, wanted, &next)?;
            if largest(&found) < largest(&left) {
                nearer = Some((next, found));
                break;
            }
        }
        let Some(found) = nearer else { break };
        (places, left) = found;
    }
    // The case is left at what was found.
    left = excesses(case, wanted, &places)?;
    let missed = wanted.iter().zip(&left).find(|(_, left)| !(left.abs() <= MET));
    missed.map_or(Ok(()), |(own, _)| Err(not_reached(case, own)))
}

/// The largest of some excesses.
fn largest(excesses: &[f64]) -> f64 {
    excesses.iter().fold(0.0, |m, own| m.max(own.abs()))
}

/// Pushes contacts in alike until the sum of their forces is that wanted.
fn solve(case: &mut Case, wanted: &Wanted) -> Result<(), CaseErrors> {
    let first = interference_of(case, wanted.contacts[0]);
    let start = excess(case, wanted, first)?;
    if start.abs() <= TOLERANCE {
        return Ok(());
    }
    // Bounds on either side; without any interference a contact without overlap has no force.
    let (mut low, mut high) = ((0.0, -1.0), (first, start));
    let mut steps = 0..MOST_STEPS;
    while high.1 < 0.0 && steps.next().is_some() {
        (low, high.0) = (high, STEP * high.0);
        high.1 = excess(case, wanted, high.0)?;
    }
    // The secant meets straight pieces at once; the bound that stays has its weight halved, after the Illinois rule.
    let (mut side, mut left) = (None, high.1);
    for _ in 0..MOST_ROUNDS {
        if high.1 < 0.0 || high.0 - low.0 <= f64::EPSILON * high.0 {
            break;
        }
        let next = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        left = excess(case, wanted, next)?;
        if left.abs() <= TOLERANCE {
            return Ok(());
        }
        let (moved, other) = match left < 0.0 {
            true => (&mut low, &mut high),
            false => (&mut high, &mut low),
        };
        *moved = (next, left);
        other.1 *= if side == Some(left < 0.0) { 0.5 } else { 1.0 };
        side = Some(left < 0.0);
    }
    // On soft springs the force has no root beyond its rounding: between close bounds it is met.
    let is_rounded = high.1 >= 0.0 && high.0 - low.0 <= ROUNDED * high.0;
    let is_met = left.abs() <= 1e3 * TOLERANCE || is_rounded && left.abs() <= MET;
    if is_met { Ok(()) } else { Err(not_reached(case, wanted)) }
}

fn not_reached(case: &Case, wanted: &Wanted) -> CaseErrors {
    refusal!(case, &wanted.key,
        "{} = {}: no interference presses with this force", wanted.key, wanted.force; "not reached";
        "a surface that overlaps the counterface in the mesh presses already; one that nothing holds gives way")
}

/// The force of contacts pushed in alike, less that wanted, over that.
fn excess(case: &mut Case, wanted: &Wanted, interference: f64) -> Result<f64, CaseErrors> {
    wanted.contacts.iter().for_each(|&own| set_interference(case, own, interference));
    let forces = case.normal_forces();
    let forces = forces.map_err(|why| case.error_at(&wanted.key, why, "no base state", None))?;
    let own = wanted.contacts.iter().filter_map(|&contact| forces.get(contact));
    Ok(own.sum::<f64>() / wanted.force - 1.0)
}

/// The same of several, each pushed in as far as its place says.
fn excesses(case: &mut Case, wanted: &[Wanted], places: &[f64]) -> Result<Vec<f64>, CaseErrors> {
    for (own, &place) in wanted.iter().zip(places) {
        set_interference(case, own.contacts[0], place);
    }
    let forces = case.normal_forces();
    let forces = forces.map_err(|why| case.error_at(&wanted[0].key, why, "no base state", None))?;
    Ok(wanted.iter().map(|own| forces[own.contacts[0]] / own.force - 1.0).collect())
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
