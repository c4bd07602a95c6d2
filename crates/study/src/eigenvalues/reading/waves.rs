//! The same of a body solved harmonic by harmonic, from the matrices of one sector: every sector has an equal share.
//!
//! Everything is in the unknowns of the harmonic. A term that comes with friction is `i mu` times its matrix, Hermitian
//! as a whole.

use super::budget::{Row, rows, write};
use super::shapes::{couplings, name_of};
use crate::eigenvalues::contact::CONTACT;
use crate::eigenvalues::sliding::SlidingModel;
use crate::*;
use frictionsim_physics::prestress::{Kind, Part, PartForms, Term};
use frictionsim_physics::{cea::ModeWave, linalg::banded::BandedMatrix};
use frictionsim_results::cea::{Contribution, Coupling, ModeFeed, ModeName, Reading, Source};

/// A body taken apart.
struct Apart<'a> {
    tangent: &'a WaveTangent,
    /// Regions, then supports.
    rows: Vec<Row<'a>>,
    /// Their matrices in the harmonics that are needed.
    harmonics: BTreeMap<usize, Vec<Term<BandedMatrix>>>,
    /// Unknowns of each contact node, or ring of them.
    contact: Vec<Vec<usize>>,
}

/// A mode with its wave.
struct Waving<'a> {
    name: ModeName,
    mode: &'a ComplexMode,
    wave: &'a ModeWave,
    /// Eigenvalue of the wave `+n`.
    root: c64,
    /// Matrices of its harmonic, each with what friction multiplies it by.
    terms: Vec<(&'a Term<BandedMatrix>, c64)>,
    /// `M x` of all regions.
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
    fn new(model: &'t SlidingModel, tangent: &'t WaveTangent, sweep: &FrictionSweep) -> Self {
        let modes = sweep.points.iter().flat_map(|point| &point.modes);
        let numbers: BTreeSet<usize> =
            modes.filter(|mode| mode.wave.is_some()).map(|mode| mode.harmonic).collect();
        Self {
            rows: rows(&tangent.terms, &model.mesh.regions),
            harmonics: numbers.into_iter().map(|n| (n, tangent.body_terms(n))).collect(),
            contact: tangent.contact_unknowns(),
            tangent,
        }
    }

    fn waving<'a>(&'a self, point: &'a FrictionPoint) -> Vec<Waving<'a>> {
        let power = |term: &Term<BandedMatrix>| match term.power {
            0 => c64::ONE,
            _ => c64::new(0.0, point.friction_coefficient),
        };
        let own = point.modes.iter().enumerate().filter_map(|(index, mode)| {
            let (wave, terms) = (mode.wave.as_ref()?, &self.harmonics[&mode.harmonic]);
            let mut momentum = vec![c64::ZERO; wave.unknowns.len()];
            for term in terms.iter().filter(|term| term.kind == Kind::Mass) {
                term.matrix.add_product(c64::ONE, &wave.unknowns, &mut momentum);
            }
            Some(Waving {
                name: name_of(point.friction_coefficient, (index + 1, mode), true),
                root: wave.root(mode.eigenvalue),
                terms: terms.iter().map(|term| (term, power(term))).collect(),
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
        let (all, x) = (&self.tangent.terms, &own.wave.unknowns);
        let mut forms = vec![PartForms::default(); all.bodies.len()];
        for (term, power) in &own.terms {
            if let Part::Body(body) = term.part {
                all.add_form(term, own.root, power * term.matrix.form(x, x), &mut forms[body]);
            }
        }
        let energies = [own.mass, forms.iter().map(|own| own.stiffness).sum()];
        let contact = |fed: f64| vec![(CONTACT.to_owned(), fed)];
        write((own.name, own.mode), self.rows.iter().zip(&forms), energies, &contact, out);
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
            let x = &own.wave.unknowns;
            // `Im(x_i^H f_i)` of the forces `f = (lambda^2 M + lambda C + K) x` of bodies and supports: what the
            // contact's forces do on its nodes in one sector, or on rings, which are of all sectors.
            let mut forces = vec![c64::ZERO; x.len()];
            for (term, power) in &own.terms {
                let factor = self.tangent.terms.dynamic(term, own.root) * power;
                term.matrix.add_product(factor, x, &mut forces);
            }
            let work = |unknowns: &Vec<usize>| -> f64 {
                unknowns.iter().map(|&k| (x[k].conj() * forces[k]).im).sum()
            };
            let repeats = contact.len() / self.contact.len();
            let scale = 1.0 / (2.0 * own.root.im * own.mass * repeats as f64);
            let is_own = |row: &&Contribution| row.mode == own.name && row.kind == Source::Contact;
            let fed = contributions.iter().find(is_own).map_or(0.0, |row| row.growth_rate_per_s);
            let works: Vec<f64> = self.contact.iter().map(work).collect();
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
