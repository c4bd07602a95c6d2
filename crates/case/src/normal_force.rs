//! `normal_force`: the counterface is pushed in until it presses with a given force.
//!
//! Without friction the summed normal force of a contact rises with its interference, by straight pieces where contact
//! is rigid. The interference that belongs to a force is the one root of their difference.

use crate::Contact;
use crate::*;
use frictionsim_physics::linalg::{Bracket, newton_root};
use frictionsim_physics::mesh::Strip;
use frictionsim_physics::prestress::{PrestressError, SectorSliding, SolidSliding};

/// Factor of the steps up to an interference that presses enough.
const STEP: f64 = 4.0;
/// Steps up to it: from a micrometre to kilometres.
const MOST_STEPS: usize = 15;
/// Relative difference of forces below which the root is found.
const TOLERANCE: f64 = 1e-12;
/// The same that is said, and that rounding may leave of a body on soft springs.
const FOUND: f64 = 1e-9;
const MET: f64 = 1e-4;
/// Evaluations between two bounds.
const MOST_ROUNDS: usize = 60;

/// A contact that is pressed with a force.
struct Wanted {
    key: String,
    /// Its place in the body.
    contact: usize,
    force: f64,
}

/// Pushes every counterface in whose contact has a force.
pub(super) fn press(case: &mut Case) -> Result<(), CaseErrors> {
    let sections = case.contact_sections().into_iter().enumerate();
    let found = sections.filter_map(|(contact, (section, _))| {
        let key = format!("{section}.normal_force");
        Some(Wanted { force: case.number(&key)?, key, contact })
    });
    let wanted: Vec<Wanted> = found.collect();
    if wanted.is_empty() { Ok(()) } else { solve(case, &wanted) }
}

/// Pushes contacts in alike until the sum of their forces is reached, then each by Newton's method, and says how far:
/// they lean on each other, and forces have straight pieces or rise ever faster.
fn solve(case: &mut Case, wanted: &[Wanted]) -> Result<(), CaseErrors> {
    let own = |own: &Wanted| {
        let of_body = case.body.assembly().and_then(|body| body.contacts.get(own.contact));
        of_body.map_or(case.contact.sliding.interference, |own| own.counter.interference())
    };
    let mut places: Vec<f64> = wanted.iter().map(own).collect();
    let is_met = |left: &[f64]| left.iter().all(|own| own.abs() <= TOLERANCE);
    if !is_met(&excesses(case, wanted, &places)?) {
        let near = if wanted.len() == 1 { TOLERANCE } else { MET };
        let total: f64 = wanted.iter().map(|own| own.force).sum();
        let mut alike = |place: f64| -> Result<f64, CaseErrors> {
            let left = excesses(case, wanted, &vec![place; wanted.len()])?;
            Ok(left.iter().zip(wanted).map(|(left, own)| left * own.force).sum::<f64>() / total)
        };
        // Without any interference contacts without overlap have no force.
        let (mut low, mut own) = ((0.0, -1.0), (places[0], alike(places[0])?));
        let mut growths = 0..MOST_STEPS;
        while own.1 < -near && growths.next().is_some() {
            (low, own.0) = (own, STEP * own.0);
            own.1 = alike(own.0)?;
        }
        let is_within = own.1 >= -near;
        let (mut bracket, mut rounds) = (Bracket::new([low, own]), 0..MOST_ROUNDS);
        let is_open =
            |own: (f64, f64), width: f64| own.1.abs() > near && width > f64::EPSILON * own.0;
        while is_within && is_open(own, bracket.width()) && rounds.next().is_some() {
            own = bracket.narrow(&mut alike)?;
        }
        places.fill(own.0);
        if is_within {
            let each = |places: &[f64]| excesses(case, wanted, places);
            places = newton_root(places, [TOLERANCE, MET], each)?;
        }
    }
    let left = excesses(case, wanted, &places)?;
    for ((own, left), pushed) in wanted.iter().zip(&left).zip(&places) {
        if !(left.abs() <= MET) {
            return Err(refusal!(case, &own.key,
                "{} = {}: no interference presses with this force, {:.5e} is the nearest", own.key, own.force,
                own.force * (1.0 + left); "not reached";
                "a boundary pressure, or an overlap with the counterface, presses already; what nothing holds moves"));
        }
        let told = format!("{} = {}: the counterface is pushed in", own.key, own.force);
        // On soft springs a force is rounded.
        let rounded = match left.abs() > FOUND {
            true => format!("; rounding moves the force by {:.0e} of it", left.abs()),
            false => String::new(),
        };
        case.taken.notes.push(format!("{told} by {pushed:.6e} m{rounded}"));
    }
    Ok(())
}

/// The normal forces of contacts, each pushed in as far as its place says, less those wanted, over these.
fn excesses(case: &mut Case, wanted: &[Wanted], places: &[f64]) -> Result<Vec<f64>, CaseErrors> {
    wanted.iter().zip(places).for_each(|(own, &place)| set_interference(case, own.contact, place));
    let forces = case.normal_forces();
    let forces = forces.map_err(|why| case.error_at(&wanted[0].key, why, "no base state", None))?;
    Ok(wanted.iter().map(|own| forces[own.contact] / own.force - 1.0).collect())
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
        let Contact { sliding, stiffness } = &self.contact;
        let (materials, mass) = (&self.body.materials, self.mass());
        let pressed = match &self.body.kind {
            BodyKind::Annulus(annulus) => {
                let mesh = Strip::of_annulus(annulus).map_err(in_words)?;
                let elastic = mesh.stiffness_alike(materials);
                let base = SectorSliding::solve(&mesh, &elastic, sliding, stiffness.law);
                let whole = self.thickness * mesh.count as f64;
                base.map(|base| vec![whole * base.state.normal_forces[0].iter().sum::<f64>()])
            }
            BodyKind::Revolution(specification) => {
                let mesh = SolidSector::generate(specification).map_err(in_words)?;
                let elastic = mesh.strip.stiffness_alike(materials);
                let base = SolidSliding::solve(&mesh, &elastic, sliding, stiffness, mass);
                let whole = mesh.sector_count() as f64;
                base.map(|base| vec![whole * base.normal_forces().map(|own| own.1).sum::<f64>()])
            }
            BodyKind::Imported(_) | BodyKind::Assembly(_) => {
                let mesh = self.body.mesh().map_err(in_words)?;
                self.assembled(&mesh, mass).and_then(|assembly| {
                    let mut rest = assembly.state(0.0)?.normal_forces(0.0).into_iter();
                    let counts = assembly.contacts().iter().map(|own| own.1.points.len());
                    let sums = counts.map(|count| rest.by_ref().take(count).sum::<f64>());
                    Ok(sums.map(|sum| self.depth() * sum).collect())
                })
            }
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
