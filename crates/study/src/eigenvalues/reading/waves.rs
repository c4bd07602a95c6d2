//! The same of a body solved harmonic by harmonic, from the matrices of one sector: every sector has an equal share.

use super::budget::write;
use super::harmonic::Harmonic;
use super::shapes::{couplings, name_of};
use crate::eigenvalues::contact::CONTACT;
use crate::eigenvalues::sliding::SlidingModel;
use crate::prelude::*;
use frictionsim_physics::cea::ModeWave;
use frictionsim_physics::prestress::WaveTangent;
use frictionsim_results::cea::{Contribution, Coupling, ModeFeed, ModeName, Reading, Source};

/// A body taken apart, and its harmonics as far as they were needed.
struct Apart<'a> {
    /// Regions, then supports.
    parts: Vec<(String, Source)>,
    harmonics: BTreeMap<usize, Harmonic<'a>>,
}

/// A mode with its wave, and `M x` of it.
struct Waving<'a> {
    name: ModeName,
    mode: &'a ComplexMode,
    wave: &'a ModeWave,
    momentum: Vec<c64>,
    /// `x^H M x`.
    mass: f64,
}

/// Reads every mode whose wave was kept.
pub(super) fn read(
    case: &Case,
    model: &SlidingModel,
    tangent: &WaveTangent,
    sweep: &FrictionSweep,
) -> Option<Reading> {
    let apart = Apart::new(model, tangent, sweep);
    let waving: Vec<Vec<Waving<'_>>> = sweep.points.iter().map(|p| apart.waving(p)).collect();
    let references = waving.iter().find(|modes| !modes.is_empty())?;
    let mut reading = Reading::default();
    for own in &waving {
        for waving in own {
            apart.contributions(waving, &mut reading.contributions);
            if waving.mode.is_unstable() {
                reading.couplings.extend(waving.couplings(references));
            }
        }
    }
    let friction = case.contact.sliding.friction_coefficient;
    let own = waving.iter().flatten();
    let own = own.filter(|own| own.name.friction_coefficient == friction);
    let unstable: Vec<&Waving<'_>> = own.filter(|own| own.mode.is_unstable()).collect();
    reading.feed = apart.feed(model, &unstable, &reading.contributions);
    Some(reading)
}

impl<'t> Apart<'t> {
    fn new(model: &SlidingModel, tangent: &'t WaveTangent, sweep: &FrictionSweep) -> Self {
        let modes = sweep.points.iter().flat_map(|point| &point.modes);
        let numbers: BTreeSet<usize> =
            modes.filter(|mode| mode.wave.is_some()).map(|mode| mode.harmonic).collect();
        let regions = model.mesh.regions.iter().map(|name| (name.clone(), Source::Part));
        let supports = tangent.terms.others.iter().map(|name| (name.clone(), Source::Support));
        let harmonics = numbers.into_iter().map(|n| (n, Harmonic::new(tangent, n))).collect();
        Self { parts: regions.chain(supports).collect(), harmonics }
    }

    fn waving<'a>(&self, point: &'a FrictionPoint) -> Vec<Waving<'a>> {
        let own = point.modes.iter().enumerate().filter_map(|(index, mode)| {
            let wave = mode.wave.as_ref()?;
            let momentum = self.harmonics[&mode.harmonic].momentum(&wave.unknowns);
            Some(Waving {
                name: name_of(point.friction_coefficient, (index + 1, mode), true),
                mass: product(&wave.unknowns, &momentum).re,
                mode,
                wave,
                momentum,
            })
        });
        own.collect()
    }

    /// What each region, support and the contact adds to a mode.
    fn contributions(&self, own: &Waving<'_>, out: &mut Vec<Contribution>) {
        let parts = &self.harmonics[&own.mode.harmonic];
        let (x, root) = (&own.wave.unknowns, own.wave.root(own.mode.eigenvalue));
        let forms = parts.forms(root, own.name.friction_coefficient, x);
        let energies = [own.mass, forms.iter().map(|own| own.stiffness).sum()];
        let rows = self.parts.iter().zip(&forms).map(|((name, source), own)| {
            // A support has no mass.
            let mass = if *source == Source::Support { f64::NAN } else { own.mass };
            (name, *source, [mass, own.stiffness, own.damping])
        });
        let contact = |fed: f64| vec![(CONTACT.to_owned(), fed)];
        write((own.name, own.mode), rows, energies, &contact, out);
    }

    /// The feed of the unstable modes at the case's own friction coefficient.
    ///
    /// What a small space of a harmonic, or round-off, leaves between the forces on the contact nodes and the contact's
    /// part in the budget is spread over the area.
    fn feed(
        &self,
        model: &SlidingModel,
        unstable: &[&Waving<'_>],
        contributions: &[Contribution],
    ) -> Vec<ModeFeed> {
        let contact = &model.contact;
        let area: f64 = contact.iter().map(|own| own.place.area).sum();
        let modes = unstable.iter().map(|own| {
            let root = own.wave.root(own.mode.eigenvalue);
            let parts = &self.harmonics[&own.mode.harmonic];
            let friction = own.name.friction_coefficient;
            // Of the contact nodes of one sector, or of rings, which are of all sectors.
            let works = parts.works_at_contact(root, friction, &own.wave.unknowns);
            let repeats = contact.len() / works.len();
            let scale = 1.0 / (2.0 * root.im * own.mass * repeats as f64);
            let is_own = |row: &&Contribution| row.mode == own.name && row.kind == Source::Contact;
            let fed = contributions.iter().find(is_own).map_or(0.0, |row| row.growth_rate_per_s);
            let rates = works.iter().cycle().take(contact.len()).map(|work| scale * work);
            let rates: Vec<f64> = rates.collect();
            let left = (fed - rates.iter().sum::<f64>()) / area;
            let pairs = rates.iter().zip(contact);
            ModeFeed {
                mode: own.name,
                rates: pairs.map(|(rate, own)| rate + left * own.place.area).collect(),
            }
        });
        modes.collect()
    }
}

impl Waving<'_> {
    /// The modes of the lowest friction value in this one, the largest share first. Waves of different harmonics, and
    /// those that travel in opposite directions, are orthogonal.
    fn couplings(&self, references: &[Waving<'_>]) -> Vec<Coupling> {
        let is_alike = |other: &&Waving<'_>| {
            (other.mode.harmonic, other.wave.is_backward)
                == (self.mode.harmonic, self.wave.is_backward)
        };
        let shares = references.iter().filter(is_alike).map(|other| {
            let overlap = product(&other.wave.unknowns, &self.momentum).norm_sqr();
            (other.name, overlap / (self.mass * other.mass))
        });
        couplings(self.name, self.mode.growth_rate(), shares)
    }
}

/// `y^H x`.
fn product(y: &[c64], x: &[c64]) -> c64 {
    y.iter().zip(x).map(|(y, x)| y.conj() * x).sum()
}
