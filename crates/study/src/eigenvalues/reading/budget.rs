//! What each region, support and contact adds to the growth of each mode.

use super::{parts::Parts, shapes::Shapes};
use crate::*;
use frictionsim_physics::prestress::{Kind, Part, PartForms, Terms};
use frictionsim_results::cea::{Contribution, ModeName, Source};

/// A region, a support or the inertia of rotation. Only what has inertia has a kinetic energy, and a rotation has no
/// energy of its own.
pub(super) struct Row<'a> {
    name: &'a String,
    source: Source,
    has_mass: bool,
}

/// Those that some terms are of, the regions of a mesh before all others.
pub(super) fn rows<'a, M>(terms: &'a Terms<M>, regions: &'a [String]) -> Vec<Row<'a>> {
    let has = |body: usize, kind| terms.all.iter().any(|term| term.is(Part::Body(body), kind));
    let source = |body: usize| match body < terms.regions().len() {
        true => Source::Part,
        false if has(body, Kind::Transport) => Source::Rotation,
        false => Source::Support,
    };
    let names = regions[..terms.regions().len()].iter().chain(&terms.others).enumerate();
    let row = |(body, name)| Row { name, source: source(body), has_mass: has(body, Kind::Mass) };
    names.map(row).collect()
}

/// Sums over all regions and supports, mode by mode.
pub(super) struct Sums {
    /// `phi^H M phi`.
    pub kinetic: Vec<f64>,
    pub strain: Vec<f64>,
    /// `M phi` of all of them.
    pub momentum: Mat<f64>,
    /// The forces of the bodies at every dof, which the contacts' forces hold, where they are asked for.
    pub balance: Option<Vec<Vec<c64>>>,
}

impl Sums {
    /// Sums over nothing, for the modes of some shapes; with the forces where they are asked for.
    pub fn new(shapes: &Shapes<'_>, has_balance: bool) -> Self {
        let (modes, dofs) = (shapes.modes.len(), shapes.columns.nrows());
        Self {
            kinetic: vec![0.0; modes],
            strain: vec![0.0; modes],
            momentum: Mat::zeros(dofs, shapes.columns.ncols()),
            balance: has_balance.then(|| vec![vec![c64::ZERO; dofs]; modes]),
        }
    }
}

impl Parts<'_> {
    /// What each region, support and contact adds to each mode of one friction value, and `M phi` of each.
    pub fn contributions(&self, shapes: &Shapes<'_>) -> (Vec<Contribution>, Mat<f64>) {
        // Only several contacts need the balance of forces dof by dof.
        let mut sums = Sums::new(shapes, self.contacts.len() > 1);
        let forms = self.of_bodies(shapes, &mut sums);
        let rows = rows(&self.terms, &self.whole.mesh.regions);
        let mut out = Vec::new();
        for mode in 0..shapes.modes.len() {
            let (name, own) = (shapes.name(mode), shapes.modes[mode].1);
            let contacts = |fed: f64| self.contact_rates(shapes, (mode, own), &sums, fed);
            let rows = rows.iter().zip(forms.iter().map(|forms| &forms[mode]));
            write((name, own), rows, [sums.kinetic[mode], sums.strain[mode]], &contacts, &mut out);
        }
        (out, sums.momentum)
    }

    /// Energies and damping of every region and support, and of the inertia of rotation, in each mode.
    pub fn of_bodies(&self, shapes: &Shapes<'_>, sums: &mut Sums) -> Vec<Vec<PartForms>> {
        let (terms, modes) = (&self.terms, || shapes.modes.iter().map(|(_, mode)| mode.eigenvalue));
        // The prestress takes part in the damping, and in the balance of forces.
        let beta = self.whole.options.damping_of_tangent().stiffness_coefficient;
        let is_asked_for = beta != 0.0 || sums.balance.is_some();
        let stress = if is_asked_for { self.stress(shapes.friction) } else { Default::default() };
        let mut forms = vec![vec![PartForms::default(); shapes.modes.len()]; terms.bodies.len()];
        for term in terms.all.iter().chain(&*stress) {
            let image = self.image(term, shapes);
            if term.kind == Kind::Mass {
                sums.momentum += &image;
            }
            if let Part::Body(body) = term.part {
                let own = forms[body].iter_mut().zip(shapes.forms_of(term.kind, &image));
                let own = modes().zip(own);
                own.for_each(|(lambda, (sum, form))| terms.add_form(term, lambda, form, sum));
            }
            if let Some(balance) = &mut sums.balance {
                shapes.add(balance, &image, |lambda| terms.dynamic(term, lambda));
            }
        }
        for own in &forms {
            for (mode, own) in own.iter().enumerate() {
                sums.kinetic[mode] += own.mass;
                sums.strain[mode] += own.stiffness;
            }
        }
        forms
    }

    /// What each contact feeds of their sum `fed`: `Im(phi^H f) / (2 omega m)` of the forces on its surfaces. What
    /// forces on nodes of two contacts leave of the sum is shared out evenly.
    fn contact_rates(
        &self,
        shapes: &Shapes<'_>,
        (i, mode): (usize, &ComplexMode),
        sums: &Sums,
        fed: f64,
    ) -> Vec<(String, f64)> {
        let names = self.contacts.iter().map(|(name, _)| name.clone());
        let Some(balance) = &sums.balance else { return names.zip([fed]).collect() };
        let (re, im) = (shapes.columns.col_as_slice(2 * i), shapes.columns.col_as_slice(2 * i + 1));
        let work = |dof: &usize| (c64::new(re[*dof], -im[*dof]) * balance[i][*dof]).im;
        let works = self.contacts.iter().map(|(_, dofs)| dofs.iter().map(work).sum::<f64>());
        let rates: Vec<f64> =
            works.map(|work| work / (2.0 * mode.eigenvalue.im * sums.kinetic[i])).collect();
        let left = (fed - rates.iter().sum::<f64>()) / rates.len() as f64;
        names.zip(rates.into_iter().map(|rate| rate + left)).collect()
    }
}

/// The rows of a mode, each with its forms, shares of its energies. Its contacts feed what the others leave of
/// its growth.
pub(super) fn write<'r>(
    (name, mode): (ModeName, &ComplexMode),
    rows: impl Iterator<Item = (&'r Row<'r>, &'r PartForms)>,
    [kinetic, strain]: [f64; 2],
    contacts: &dyn Fn(f64) -> Vec<(String, f64)>,
    out: &mut Vec<Contribution>,
) {
    let mut taken = 0.0;
    for (row, own) in rows {
        let rate = -own.damping / (2.0 * kinetic);
        taken += rate;
        let has_strain = row.source != Source::Rotation;
        out.push(Contribution {
            mode: name,
            name: row.name.clone(),
            kind: row.source,
            kinetic_share: row.has_mass.then_some(own.mass / kinetic),
            strain_share: has_strain.then_some(own.stiffness / strain),
            growth_rate_per_s: rate,
        });
    }
    for (contact, growth_rate_per_s) in contacts(mode.growth_rate() - taken) {
        out.push(Contribution {
            mode: name,
            name: contact,
            kind: Source::Contact,
            kinetic_share: None,
            strain_share: None,
            growth_rate_per_s,
        });
    }
}
