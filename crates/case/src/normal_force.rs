//! `normal_force`: the counterface is pushed in until it presses with a given force.
//!
//! Without friction the summed normal force of a contact rises with its interference, by straight pieces where contact
//! is rigid. The interference that belongs to a force is the one root of their difference.

use super::{BodyKind, Case, CaseErrors, refusal};
use frictionsim_physics::contact::{Counterpart, SlidingContact};
use frictionsim_physics::fem::MassKind;
use frictionsim_physics::mesh::{SolidSector, Strip};
use frictionsim_physics::prestress::{Assembly, PrestressError, SectorSliding, SolidSliding};

/// Factor of the steps up to an interference that presses enough.
const STEP: f64 = 4.0;
/// Steps up to it: from a micrometre to kilometres.
const MOST_STEPS: usize = 15;
/// Relative difference of forces below which the root is found.
const TOLERANCE: f64 = 1e-12;
/// Relative distance of two bounds between which the force of a body on soft springs is rounded.
const ROUNDED: f64 = 1e-6;
/// Evaluations between two bounds, and rounds over contacts that lean on each other.
const MOST_ROUNDS: usize = 60;

/// A contact that is pressed with a force.
struct Wanted {
    key: String,
    /// Place of the contact in the body.
    contact: usize,
    force: f64,
}

/// Pushes every counterface in whose contact has a force, and says how far.
pub(super) fn press(case: &mut Case) -> Result<(), CaseErrors> {
    let wanted = wanted(case);
    for _ in 0..MOST_ROUNDS {
        let mut is_met = true;
        for own in &wanted {
            is_met &= solve(case, own)?;
        }
        // Contacts that others have not moved since are all met.
        if is_met || wanted.len() == 1 {
            break;
        }
    }
    for own in &wanted {
        let pushed = interference_of(case, own.contact);
        let told = format!("{} = {}: the counterface is pushed in", own.key, own.force);
        case.taken.notes.push(format!("{told} by {pushed:.6e} m"));
    }
    Ok(())
}

fn wanted(case: &Case) -> Vec<Wanted> {
    let sections = case.contact_sections().into_iter().enumerate();
    let found = sections.filter_map(|(contact, (section, _))| {
        let key = format!("{section}.normal_force");
        Some(Wanted { force: case.number(&key)?, key, contact })
    });
    found.collect()
}

/// Whether the interference of one contact is that of its force already, which it is afterwards.
fn solve(case: &mut Case, wanted: &Wanted) -> Result<bool, CaseErrors> {
    let (target, first) = (wanted.force, interference_of(case, wanted.contact));
    let start = excess(case, wanted, first)?;
    if start.abs() <= TOLERANCE * target {
        return Ok(true);
    }
    // Bounds on either side; without any interference a contact without overlap has no force.
    let (mut low, mut high) = ((0.0, -target), (first, start));
    let mut steps = 0..MOST_STEPS;
    while high.1 < 0.0 && steps.next().is_some() {
        (low, high.0) = (high, STEP * high.0);
        high.1 = excess(case, wanted, high.0)?;
    }
    // The secant meets straight pieces at once; the bound that stays has its weight halved, after the Illinois rule.
    let mut side = None;
    for _ in 0..MOST_ROUNDS {
        if high.1 < 0.0 || high.0 - low.0 <= f64::EPSILON * high.0 {
            break;
        }
        let next = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        let found = excess(case, wanted, next)?;
        if found.abs() <= TOLERANCE * target {
            return Ok(false);
        }
        let (moved, other) = match found < 0.0 {
            true => (&mut low, &mut high),
            false => (&mut high, &mut low),
        };
        *moved = (next, found);
        other.1 *= if side == Some(found < 0.0) { 0.5 } else { 1.0 };
        side = Some(found < 0.0);
    }
    let own = interference_of(case, wanted.contact);
    let left = excess(case, wanted, own)?.abs();
    // On soft springs the force has no root beyond its rounding: between close bounds it is met.
    let is_rounded = high.1 >= 0.0 && high.0 - low.0 <= ROUNDED * high.0;
    if left <= 1e3 * TOLERANCE * target || is_rounded && left <= 1e2 * ROUNDED * target {
        return Ok(is_rounded && (own - first).abs() <= ROUNDED * own);
    }
    Err(refusal!(case, &wanted.key,
        "{} = {target}: no interference presses with this force", wanted.key; "not reached";
        "a surface that overlaps the counterface in the mesh presses already; one that nothing holds gives way"))
}

/// The normal force of a contact pushed in so far, less the one that is wanted.
fn excess(case: &mut Case, wanted: &Wanted, interference: f64) -> Result<f64, CaseErrors> {
    set_interference(case, wanted.contact, interference);
    let forces = case.normal_forces();
    let forces = forces.map_err(|why| case.error_at(&wanted.key, why, "no base state", None))?;
    Ok(forces.get(wanted.contact).copied().unwrap_or(0.0) - wanted.force)
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
