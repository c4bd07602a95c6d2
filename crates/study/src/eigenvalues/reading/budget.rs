//! What each region, support and contact adds to the growth of each mode.

use super::parts::Parts;
use super::shapes::Shapes;
use frictionsim_physics::cea::ComplexMode;
use frictionsim_physics::linalg::c64;
use frictionsim_results::cea::{Contribution, ModeName, Source};

/// Forms of each mode of one friction value in one region or support: `phi^H M phi` (NaN without mass), `phi^H K phi`,
/// and what takes part in the damping, `phi^H C phi`.
pub(super) struct Row {
    pub name: String,
    pub source: Source,
    pub forms: Vec<[f64; 3]>,
}

/// Sums over all regions and supports, mode by mode.
pub(super) struct Sums {
    /// `phi^H M phi`.
    pub kinetic: Vec<f64>,
    pub strain: Vec<f64>,
    /// The forces of the bodies at every dof, which the contacts' forces hold, where they are asked for.
    pub balance: Option<Vec<Vec<c64>>>,
}

impl Sums {
    /// Sums over nothing, for so many modes; with the forces at so many dofs.
    pub fn new(modes: usize, dofs: Option<usize>) -> Self {
        Self {
            kinetic: vec![0.0; modes],
            strain: vec![0.0; modes],
            balance: dofs.map(|dofs| vec![vec![c64::ZERO; dofs]; modes]),
        }
    }
}

impl Parts<'_> {
    /// What each region, support and contact adds to each mode of one friction value.
    pub fn contributions(&self, shapes: &Shapes<'_>, out: &mut Vec<Contribution>) {
        // Only several contacts need the balance of forces dof by dof.
        let dofs = (self.contacts.len() > 1).then(|| self.whole.mesh.dof_count());
        let mut sums = Sums::new(shapes.modes.len(), dofs);
        let mut rows = self.of_regions(shapes, &mut sums);
        rows.extend(self.of_supports(shapes, &mut sums));
        rows.extend(self.of_rotation(shapes, &mut sums));
        for mode in 0..shapes.modes.len() {
            let (name, own) = (shapes.name(mode), shapes.modes[mode].1);
            let contacts = |fed: f64| self.contact_rates(shapes, (mode, own), &sums, fed);
            let rows = rows.iter().map(|row| (&row.name, row.source, row.forms[mode]));
            write((name, own), rows, [sums.kinetic[mode], sums.strain[mode]], &contacts, out);
        }
    }

    /// Energies and damping of every region.
    pub fn of_regions(&self, shapes: &Shapes<'_>, sums: &mut Sums) -> Vec<Row> {
        let beta = self.whole.options.damping_of_tangent().stiffness_coefficient;
        let mut rows = Vec::new();
        for (region, own) in self.regions.iter().enumerate() {
            let [mass, stiffness] = own.pair.multiply(shapes.columns.as_ref());
            let (m, k) = (shapes.forms(&mass), shapes.forms(&stiffness));
            // The prestress takes part in the damping, and in the balance of forces.
            let is_asked_for = beta != 0.0 || sums.balance.is_some();
            let stressed = is_asked_for.then(|| self.geometric_image(shapes, region));
            let stressed = stressed.flatten();
            let none = || vec![0.0; shapes.modes.len()];
            let g = stressed.as_ref().map_or_else(none, |image| shapes.forms(image));
            let each = (0..shapes.modes.len()).map(|i| {
                let lambda = shapes.modes[i].1.eigenvalue;
                let ratio = own.ratio(lambda);
                let strain = ratio.re * k[i];
                sums.kinetic[i] += m[i];
                sums.strain[i] += strain;
                // A loss factor takes like a dashpot `eta k / omega`.
                let loss = ratio.im * k[i] / lambda.im;
                let damping = own.alpha * m[i] + own.beta * k[i] + beta * g[i] + loss;
                [m[i], strain, damping]
            });
            rows.push(Row { name: own.name.clone(), source: Source::Part, forms: each.collect() });
            if let Some(balance) = &mut sums.balance {
                let factors = |lambda: c64| {
                    [lambda * lambda + lambda * own.alpha, lambda * own.beta + own.ratio(lambda)]
                };
                shapes.add(balance, [&mass, &stiffness], factors);
                if let Some(image) = &stressed {
                    shapes.add(balance, [image], |lambda| [c64::ONE + lambda * beta]);
                }
            }
        }
        rows
    }

    /// Energies and damping of every support, with point masses those of the modifications, which come last.
    pub fn of_supports(&self, shapes: &Shapes<'_>, sums: &mut Sums) -> Vec<Row> {
        let alpha = self.whole.options.damping.mass_coefficient;
        let mut rows = Vec::new();
        for (place, (name, pair, eta)) in self.supports.iter().enumerate() {
            let [dashpots, springs] = pair.multiply(shapes.columns.as_ref());
            let (c, k) = (shapes.forms(&dashpots), shapes.forms(&springs));
            let attached = self.attached.as_ref();
            let attached = attached.filter(|_| place + 1 == self.supports.len());
            let masses = attached.map(|own| own.multiply(shapes.columns.as_ref()));
            let m = masses.as_ref().map(|[mass, _]| shapes.forms(mass));
            let each = (0..shapes.modes.len()).map(|i| {
                sums.strain[i] += k[i];
                let c = c[i] + eta * k[i] / shapes.modes[i].1.eigenvalue.im;
                let Some(m) = &m else {
                    return [f64::NAN, k[i], c];
                };
                sums.kinetic[i] += m[i];
                [m[i], k[i], c + alpha * m[i]]
            });
            rows.push(Row { name: name.clone(), source: Source::Support, forms: each.collect() });
            let Some(balance) = &mut sums.balance else {
                continue;
            };
            shapes.add(balance, [&dashpots, &springs], |lambda| [lambda, c64::new(1.0, *eta)]);
            if let Some([mass, none]) = &masses {
                let factors = |lambda: c64| [lambda * lambda + lambda * alpha, c64::ZERO];
                shapes.add(balance, [mass, none], factors);
            }
        }
        rows
    }

    /// What the gyroscopic forces `lambda G` of regions that turn add: `G` is skew, `phi^H G phi = i g`, and takes no
    /// power of a motion that neither grows nor decays; of one that does `-sigma g / (2 omega m)`.
    pub fn of_rotation(&self, shapes: &Shapes<'_>, sums: &mut Sums) -> Option<Row> {
        let [gyroscopic, transport] = self.rotation.as_ref()?.multiply(shapes.columns.as_ref());
        let skew = shapes.skew_forms(&gyroscopic);
        let modes = shapes.modes.iter().zip(skew);
        let forms = modes.map(|((_, mode), skew)| {
            let lambda = mode.eigenvalue;
            [f64::NAN, f64::NAN, lambda.re * skew / lambda.im]
        });
        if let Some(balance) = &mut sums.balance {
            shapes.add(balance, [&gyroscopic, &transport], |lambda| [lambda, c64::ONE]);
        }
        Some(Row { name: "rotation".to_owned(), source: Source::Rotation, forms: forms.collect() })
    }

    /// What each contact feeds of their sum `fed`.
    fn contact_rates(
        &self,
        shapes: &Shapes<'_>,
        (i, mode): (usize, &ComplexMode),
        sums: &Sums,
        fed: f64,
    ) -> Vec<(String, f64)> {
        let shares = match &sums.balance {
            None => vec![fed],
            Some(balance) => self.feeds(shapes, (i, mode), (&balance[i], sums.kinetic[i], fed)),
        };
        let names = self.contacts.iter().map(|(name, _)| name.clone());
        names.zip(shares).collect()
    }

    /// `Im(phi^H f) / (2 omega m)` of the forces on the surfaces of each contact; what forces on nodes of two contacts
    /// leave of the sum `fed` is shared out evenly.
    fn feeds(
        &self,
        shapes: &Shapes<'_>,
        (i, mode): (usize, &ComplexMode),
        (balance, kinetic, fed): (&[c64], f64, f64),
    ) -> Vec<f64> {
        let (re, im) = (shapes.columns.col_as_slice(2 * i), shapes.columns.col_as_slice(2 * i + 1));
        let work = |dof: &usize| (c64::new(re[*dof], -im[*dof]) * balance[*dof]).im;
        let contacts = self.contacts.iter();
        let works = contacts.map(|(_, dofs)| dofs.iter().map(work).sum::<f64>());
        let rates: Vec<f64> =
            works.map(|work| work / (2.0 * mode.eigenvalue.im * kinetic)).collect();
        let left = (fed - rates.iter().sum::<f64>()) / rates.len() as f64;
        rates.into_iter().map(|rate| rate + left).collect()
    }
}

/// The rows of a mode, each with its kinetic and strain energy and its damping, of what these are in all. Its contacts
/// feed what the others leave of its growth.
pub(super) fn write<'r>(
    (name, mode): (ModeName, &ComplexMode),
    rows: impl Iterator<Item = (&'r String, Source, [f64; 3])>,
    [kinetic, strain]: [f64; 2],
    contacts: &dyn Fn(f64) -> Vec<(String, f64)>,
    out: &mut Vec<Contribution>,
) {
    let rate = |damping: f64| -damping / (2.0 * kinetic);
    let mut taken = 0.0;
    for (row, source, [m, k, c]) in rows {
        taken += rate(c);
        out.push(Contribution {
            mode: name,
            name: row.clone(),
            kind: source,
            kinetic_share: m.is_finite().then_some(m / kinetic),
            strain_share: k.is_finite().then_some(k / strain),
            growth_rate_per_s: rate(c),
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
