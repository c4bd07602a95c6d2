//! Where the growth of a mode comes from, and which modes couple.
//!
//! With `phi` a mode over all dofs, `m = phi^H M phi`, `c` and `k` alike, and `p` the power-like product of the contact forces,
//!
//! ```text
//! lambda^2 m + lambda c + k + i h = p,     lambda = sigma + i omega
//! sigma = (Im p - omega c - h) / (2 omega m)
//! ```
//!
//! as `M`, `C`, `K` of the bodies are symmetric; `h` is `eta k` of each region and support with a loss factor. `m`, `c`, `k` are sums
//! over regions and supports, `p` over contacts: the growth rate is a sum of what each takes or feeds, without a remainder.

mod shapes;

use super::model::Model;
use super::sliding::{SlidingModel, SteadyState};
use crate::case::Case;
use crate::cea::{ComplexMode, FrictionPoint, FrictionSweep};
use crate::fem::{
    Triplets, assemble_patch_damping, assemble_point_masses, assemble_region,
    assemble_region_geometric_stiffness, assemble_supports,
};
use crate::linalg::{Mat, MatRef, MatrixPolynomial, c64};
use crate::mesh::{BoundaryCondition, Mesh};
use crate::prestress::{DampingModel, TangentOptions};
use crate::results::cea::{Contribution, Reading, Source};
use shapes::Shapes;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Bytes of mode shapes over a sweep beyond which they are taken at the ends and at the case's own friction alone.
const MOST_SHAPES: f64 = 5e8;

/// Friction coefficients whose shapes the reading needs, of those that are solved: all of them on a whole mesh, where shapes
/// are at hand; the lowest and the case's own where they are built harmonic by harmonic, or would fill the memory.
pub(super) fn shapes_needed(case: &Case, model: &Model, frictions: &[f64], modes: f64) -> Vec<f64> {
    let dofs = case.body.dimension() as f64 * case.body.node_count() as f64;
    let own = case.contact.sliding.friction_coefficient;
    match model {
        Model::SolidSectors(_) => Vec::new(),
        Model::Whole(_) | Model::Assembly(_)
            if 16.0 * dofs * modes * frictions.len() as f64 <= MOST_SHAPES =>
        {
            frictions.to_vec()
        }
        Model::Sectors(..) | Model::Whole(_) | Model::Assembly(_) => {
            let lowest = frictions.first().copied();
            let own = frictions.contains(&own).then_some(own);
            lowest.into_iter().chain(own).collect()
        }
    }
}

/// Reads every mode that has a shape; `None` where the body's matrices are not at hand: a body of revolution in three
/// dimensions, or one with the inertia of its rotation, whose gyroscopic forces the balance above has not.
pub(super) fn read(case: &Case, model: &SlidingModel, sweep: &FrictionSweep) -> Option<Reading> {
    if matches!(&model.model, Model::Assembly(own) if own.body.rotors().next().is_some()) {
        return None;
    }
    let parts = Parts::new(case, model)?;
    let mut reading = Reading::default();
    let shaped = |point: &&FrictionPoint| point.modes.iter().any(|mode| mode.shape.is_some());
    let points: Vec<&FrictionPoint> = sweep.points.iter().filter(shaped).collect();
    let lowest = points.first()?;
    let references = Shapes::of(lowest, case.has_sectors());
    let [reference_images, _] = parts.whole.multiply(references.columns.as_ref());
    for point in &points {
        let shapes = Shapes::of(point, case.has_sectors());
        if shapes.modes.is_empty() {
            continue;
        }
        parts.contributions(model, &shapes, &mut reading.contributions);
        let [own_images, _] = parts.whole.multiply(shapes.columns.as_ref());
        let couplings = shapes.couplings(&own_images, (&references, &reference_images));
        reading.couplings.extend(couplings);
    }
    Some(reading)
}

/// Mass and stiffness on one pattern.
struct Pair(MatrixPolynomial);

impl Pair {
    fn new(count: usize, [mass, stiffness]: [Triplets; 2]) -> Self {
        Self(MatrixPolynomial::from_triplets(
            count,
            &[mass.entries, stiffness.entries],
        ))
    }

    /// `M x` and `K x`.
    fn multiply(&self, x: MatRef<'_, f64>) -> [Mat<f64>; 2] {
        let [mass, stiffness] = self.0.coefficients() else {
            unreachable!("a pair has two coefficients")
        };
        self.0.pattern().multiply_each([mass, stiffness], x)
    }
}

/// The bodies of a model as sums.
struct Parts<'a> {
    case: &'a Case,
    mesh: &'a Mesh,
    options: &'a TangentOptions,
    /// Each region with its name and its coefficients `alpha`, `beta`, `eta`.
    regions: Vec<(String, Pair, [f64; 3])>,
    /// Dashpots and springs of each support with its `eta`, and last of the modifications.
    supports: Vec<(String, Pair, f64)>,
    /// Point masses.
    attached: Option<Pair>,
    /// Mass and stiffness of all regions, with point masses.
    whole: Pair,
    /// Each contact with the dofs of its surfaces.
    contacts: Vec<(String, Vec<usize>)>,
    /// Geometric stiffness by base state and region, a polynomial in friction.
    geometric: RefCell<BTreeMap<(usize, usize), MatrixPolynomial>>,
}

impl<'a> Parts<'a> {
    fn new(case: &'a Case, model: &'a SlidingModel) -> Option<Self> {
        let mesh = &*model.mesh;
        let (options, contacts) = match &model.model {
            Model::SolidSectors(_) => return None,
            Model::Sectors(_, options) => (options, Vec::new()),
            Model::Whole(whole) => (&whole.options, Vec::new()),
            Model::Assembly(assembly) => {
                let pairs = assembly.body.contacts.iter();
                let pairs = pairs.map(|own| (own.name.clone(), [own.surface, own.counter]));
                (
                    &assembly.options,
                    contact_dofs(mesh, &pairs.collect::<Vec<_>>()),
                )
            }
        };
        let materials = case.materials();
        let count = mesh.dof_count();
        let mut all = [Triplets::default(), Triplets::default()];
        let regions = mesh.regions.iter().enumerate().map(|(region, name)| {
            let own = assemble_region(mesh, materials, options.mass, region);
            for (sum, own) in all.iter_mut().zip(&own) {
                sum.entries.extend_from_slice(&own.entries);
            }
            let damping = materials.own_damping(region).unwrap_or(options.damping);
            let coefficients = [
                damping.mass_coefficient,
                damping.stiffness_coefficient,
                materials.of(region).loss_factor,
            ];
            (name.clone(), Pair::new(count, own), coefficients)
        });
        let regions = regions.collect();
        let masses = assemble_point_masses(mesh);
        all[0].entries.extend_from_slice(&masses.entries);
        let has_masses = !masses.entries.is_empty();
        let mut supports = supports(mesh);
        if !(mesh.attachments.is_empty() && mesh.patches.is_empty()) {
            let patches = assemble_patch_damping(mesh, materials, options.mass);
            supports.push(modifications(mesh, patches));
        }
        Some(Self {
            case,
            mesh,
            options,
            regions,
            supports,
            attached: has_masses.then(|| Pair::new(count, [masses, Triplets::default()])),
            whole: Pair::new(count, all),
            contacts: match contacts.is_empty() {
                true => vec![("contact".to_owned(), Vec::new())],
                false => contacts,
            },
            geometric: RefCell::default(),
        })
    }

    /// Forms `phi^H K_sigma phi` of a region for each shape, where the damping has a part of it.
    fn geometric_forms(
        &self,
        model: &SlidingModel,
        shapes: &Shapes<'_>,
        region: usize,
    ) -> Vec<f64> {
        let whole = self.options.damping_model == DampingModel::WholeTangent;
        let is_damped = whole && self.options.damping.stiffness_coefficient != 0.0;
        let base = base_state(self.case, model, shapes.friction);
        let base = base.filter(|_| is_damped && self.options.geometric_stiffness);
        let Some((state, displacements)) = base else {
            return vec![0.0; shapes.modes.len()];
        };
        // Linear in the displacement: assembled once for each state and power of friction.
        let mut known = self.geometric.borrow_mut();
        let geometric = known.entry((state, region)).or_insert_with(|| {
            let materials = self.case.materials();
            let terms = displacements.iter().map(|displacement| {
                assemble_region_geometric_stiffness(self.mesh, materials, displacement, region)
                    .entries
            });
            let terms: Vec<_> = terms.collect();
            MatrixPolynomial::from_triplets(self.mesh.dof_count(), &terms)
        });
        let values = geometric.evaluate(shapes.friction);
        let image = geometric
            .pattern()
            .multiply(&values, shapes.columns.as_ref());
        shapes.forms(&image)
    }

    /// What each region, support and contact adds to each mode of one friction value.
    fn contributions(
        &self,
        model: &SlidingModel,
        shapes: &Shapes<'_>,
        out: &mut Vec<Contribution>,
    ) {
        let count = shapes.modes.len();
        let beta = self.options.damping.stiffness_coefficient;
        // Energies and damping of every region and support, mode by mode.
        let mut kinetic = vec![0.0; count];
        let mut strain = vec![0.0; count];
        // The balance of the bodies, which the contacts' forces hold; only several contacts need it dof by dof.
        let mut balance =
            (self.contacts.len() > 1).then(|| vec![vec![c64::ZERO; self.mesh.dof_count()]; count]);
        let mut rows: Vec<(&str, Source, Vec<[f64; 3]>)> = Vec::new();
        for (region, (name, pair, [alpha, own_beta, eta])) in self.regions.iter().enumerate() {
            let [mass, stiffness] = pair.multiply(shapes.columns.as_ref());
            let (m, k) = (shapes.forms(&mass), shapes.forms(&stiffness));
            let g = self.geometric_forms(model, shapes, region);
            let each = (0..count).map(|i| {
                kinetic[i] += m[i];
                strain[i] += k[i];
                // A loss factor takes like a dashpot `eta k / omega`.
                let loss = eta * k[i] / shapes.modes[i].1.eigenvalue.im;
                [
                    m[i],
                    k[i],
                    alpha * m[i] + own_beta * k[i] + beta * g[i] + loss,
                ]
            });
            rows.push((name, Source::Part, each.collect()));
            if let Some(balance) = &mut balance {
                let factors = |lambda: c64| {
                    [
                        lambda * lambda + lambda * alpha,
                        lambda * own_beta + c64::new(1.0, *eta),
                    ]
                };
                shapes.add(balance, [&mass, &stiffness], factors);
            }
        }
        for (place, (name, pair, eta)) in self.supports.iter().enumerate() {
            let [dashpots, springs] = pair.multiply(shapes.columns.as_ref());
            let (c, k) = (shapes.forms(&dashpots), shapes.forms(&springs));
            // Point masses go with the modifications, which come last.
            let attached = self.attached.as_ref();
            let attached = attached.filter(|_| place + 1 == self.supports.len());
            let masses = attached.map(|own| own.multiply(shapes.columns.as_ref()));
            let m = masses.as_ref().map(|[mass, _]| shapes.forms(mass));
            let alpha = self.options.damping.mass_coefficient;
            let each = (0..count).map(|i| {
                strain[i] += k[i];
                let c = c[i] + eta * k[i] / shapes.modes[i].1.eigenvalue.im;
                let Some(m) = &m else {
                    return [f64::NAN, k[i], c];
                };
                kinetic[i] += m[i];
                [m[i], k[i], c + alpha * m[i]]
            });
            rows.push((name, Source::Support, each.collect()));
            let Some(balance) = &mut balance else {
                continue;
            };
            shapes.add(balance, [&dashpots, &springs], |lambda| {
                [lambda, c64::new(1.0, *eta)]
            });
            if let Some([mass, none]) = &masses {
                let factors = |lambda: c64| [lambda * lambda + lambda * alpha, c64::ZERO];
                shapes.add(balance, [mass, none], factors);
            }
        }
        for (i, (number, mode)) in shapes.modes.iter().enumerate() {
            let name = shapes.name(*number, mode);
            let rate = |damping: f64| -damping / (2.0 * kinetic[i]);
            let mut taken = 0.0;
            for (part, source, forms) in &rows {
                let [m, k, c] = forms[i];
                taken += rate(c);
                out.push(Contribution {
                    mode: name,
                    name: (*part).to_owned(),
                    source: *source,
                    kinetic_share: m.is_finite().then_some(m / kinetic[i]),
                    strain_share: Some(k / strain[i]),
                    growth_rate: rate(c),
                });
            }
            let fed = mode.growth_rate() - taken;
            let shares = match &balance {
                None => vec![fed],
                Some(balance) => self.feeds(shapes, (i, mode), (&balance[i], kinetic[i], fed)),
            };
            for ((contact, _), growth_rate) in self.contacts.iter().zip(shares) {
                out.push(Contribution {
                    mode: name,
                    name: contact.clone(),
                    source: Source::Contact,
                    kinetic_share: None,
                    strain_share: None,
                    growth_rate,
                });
            }
        }
    }

    /// `Im(phi^H f) / (2 omega m)` of the forces on the surfaces of each contact; what forces on nodes of two contacts leave of the
    /// sum `fed` is shared out evenly.
    fn feeds(
        &self,
        shapes: &Shapes<'_>,
        (i, mode): (usize, &ComplexMode),
        (balance, kinetic, fed): (&[c64], f64, f64),
    ) -> Vec<f64> {
        let (re, im) = (
            shapes.columns.col_as_slice(2 * i),
            shapes.columns.col_as_slice(2 * i + 1),
        );
        let work = |dof: &usize| (c64::new(re[*dof], -im[*dof]) * balance[*dof]).im;
        let contacts = self.contacts.iter();
        let works = contacts.map(|(_, dofs)| dofs.iter().map(work).sum::<f64>());
        let rates: Vec<f64> = works
            .map(|work| work / (2.0 * mode.eigenvalue.im * kinetic))
            .collect();
        let left = (fed - rates.iter().sum::<f64>()) / rates.len() as f64;
        rates.into_iter().map(|rate| rate + left).collect()
    }
}

/// The dofs on both surfaces of each contact; a node that several contacts touch is of the one whose finer surface is nearest.
fn contact_dofs(mesh: &Mesh, contacts: &[(String, [usize; 2])]) -> Vec<(String, Vec<usize>)> {
    let nodes = |boundary: usize| mesh.boundaries[boundary].nodes.iter().map(|&n| n as usize);
    let distance = |node: usize, contact: usize| {
        let at = mesh.nodes[node];
        let away = |other: usize| -> f64 {
            let place = mesh.nodes[other];
            (0..3).map(|k| (at[k] - place[k]).powi(2)).sum()
        };
        nodes(contacts[contact].1[0])
            .map(away)
            .fold(f64::INFINITY, f64::min)
    };
    let mut touched: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (contact, (_, surfaces)) in contacts.iter().enumerate() {
        for node in surfaces.iter().flat_map(|&surface| nodes(surface)) {
            let known = touched.entry(node).or_default();
            if !known.contains(&contact) {
                known.push(contact);
            }
        }
    }
    let mut dofs = vec![Vec::new(); contacts.len()];
    for (node, all) in touched {
        let nearest = all.iter().copied();
        let nearest = nearest.min_by(|a, b| distance(node, *a).total_cmp(&distance(node, *b)));
        let owner = nearest.unwrap_or(all[0]);
        let d = mesh.dimension;
        dofs[owner].extend((0..d).map(|k| d * node + k));
    }
    let names = contacts.iter().map(|(name, _)| name.clone());
    names.zip(dofs).collect()
}

/// Number and displacements, by power of friction, of the base state of a plane body at a friction coefficient.
fn base_state<'m>(
    case: &Case,
    model: &'m SlidingModel,
    friction: f64,
) -> Option<(usize, &'m [Vec<f64>])> {
    match (&model.model, &model.state) {
        (Model::Whole(whole), _) => {
            let solved = case.cea.as_ref()?.solved_friction_coefficients();
            let place = solved.iter().position(|&mu| mu == friction)?;
            let state = whole.range.state_of[place];
            Some((state, &whole.range.states[state].displacements))
        }
        (_, SteadyState::Plane(base)) => Some((0, &base.displacements)),
        (_, SteadyState::Solid(_) | SteadyState::Assembly(_)) => None,
    }
}

/// Dashpots and springs of the modifications, with the damping of their patches.
fn modifications(mesh: &Mesh, patches: Triplets) -> (String, Pair, f64) {
    let mut own = mesh.clone();
    for boundary in &mut own.boundaries {
        boundary.condition = BoundaryCondition::Free;
    }
    let [springs, mut dashpots] = assemble_supports(&own);
    dashpots.entries.extend(patches.entries);
    let pair = Pair::new(mesh.dof_count(), [dashpots, springs]);
    ("modifications".to_owned(), pair, 0.0)
}

/// Dashpots and springs of each supported boundary, with its loss factor.
fn supports(mesh: &Mesh) -> Vec<(String, Pair, f64)> {
    let supported = |boundary: usize| {
        let condition = &mesh.boundaries[boundary].condition;
        matches!(condition, BoundaryCondition::Support(_))
    };
    let of = |boundary: usize| {
        // The mesh with this support alone.
        let mut own = mesh.clone();
        own.attachments.clear();
        for (other, free) in own.boundaries.iter_mut().enumerate() {
            if other != boundary {
                free.condition = BoundaryCondition::Free;
            }
        }
        let [springs, dashpots] = assemble_supports(&own);
        let pair = Pair::new(mesh.dof_count(), [dashpots, springs]);
        let eta = match mesh.boundaries[boundary].condition {
            BoundaryCondition::Support(support) => support.loss_factor,
            _ => 0.0,
        };
        (mesh.boundaries[boundary].name.clone(), pair, eta)
    };
    (0..mesh.boundaries.len())
        .filter(|&b| supported(b))
        .map(of)
        .collect()
}
