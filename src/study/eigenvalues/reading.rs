//! Where the growth of a mode comes from, and which modes couple.
//!
//! With `phi` a mode over all dofs, `m = phi^H M phi`, `c` and `k` alike, and `p` the power-like product of the contact forces,
//!
//! ```text
//! lambda^2 m + lambda c + k + i h = p,     lambda = sigma + i omega
//! sigma = (Im p - omega c - h) / (2 omega m)
//! ```
//!
//! as `M`, `C`, `K` of the bodies are symmetric; `h` is `eta k` of each region with a loss factor. `m`, `c`, `k` are sums over regions and supports, `p` over contacts: the growth
//! rate is a sum of what each takes or feeds, without a remainder.

use super::model::Model;
use super::sliding::{SlidingModel, SteadyState};
use crate::case::Case;
use crate::cea::{ComplexMode, FrictionPoint, FrictionSweep};
use crate::fem::{
    Triplets, assemble_region, assemble_region_geometric_stiffness, assemble_supports,
};
use crate::linalg::{Mat, MatRef, MatrixPolynomial, c64};
use crate::mesh::{BoundaryCondition, Mesh};
use crate::prestress::{DampingModel, TangentOptions};
use crate::results::cea::{Contribution, Coupling, ModeName, Reading, Source};
use std::collections::BTreeMap;

/// Bytes of mode shapes over a sweep beyond which they are taken at the ends and at the case's own friction alone.
const MOST_SHAPES: f64 = 5e8;

/// Share below which a mode of the lowest friction value is left out of the couplings.
const LEAST_SHARE: f64 = 0.01;

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
/// dimensions.
pub(super) fn read(case: &Case, model: &SlidingModel, sweep: &FrictionSweep) -> Option<Reading> {
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
        let couplings = shapes.couplings(&references, &reference_images, &parts);
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
    /// Dashpots and springs of each support.
    supports: Vec<(String, Pair)>,
    /// Mass and stiffness of all regions.
    whole: Pair,
    /// Each contact with the dofs of its surfaces.
    contacts: Vec<(String, Vec<usize>)>,
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
        Some(Self {
            case,
            mesh,
            options,
            regions,
            supports: supports(mesh),
            whole: Pair::new(count, all),
            contacts: match contacts.is_empty() {
                true => vec![("contact".to_owned(), Vec::new())],
                false => contacts,
            },
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
        let base = base_displacement(self.case, model, shapes.friction);
        let base = base.filter(|_| is_damped && self.options.geometric_stiffness);
        let Some(base) = base else {
            return vec![0.0; shapes.modes.len()];
        };
        let materials = self.case.materials();
        let geometric = assemble_region_geometric_stiffness(self.mesh, materials, &base, region);
        let pair = Pair::new(self.mesh.dof_count(), [geometric, Triplets::default()]);
        let [image, _] = pair.multiply(shapes.columns.as_ref());
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
        for (name, pair) in &self.supports {
            let [dashpots, springs] = pair.multiply(shapes.columns.as_ref());
            let (c, k) = (shapes.forms(&dashpots), shapes.forms(&springs));
            let each = (0..count).map(|i| {
                strain[i] += k[i];
                [f64::NAN, k[i], c[i]]
            });
            rows.push((name, Source::Support, each.collect()));
            if let Some(balance) = &mut balance {
                shapes.add(balance, [&dashpots, &springs], |lambda| [lambda, c64::ONE]);
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

/// The displacement of the base state of a plane body at a friction coefficient.
fn base_displacement(case: &Case, model: &SlidingModel, friction: f64) -> Option<Vec<f64>> {
    match (&model.model, &model.state) {
        (Model::Whole(whole), _) => {
            let solved = case.cea.as_ref()?.solved_friction_coefficients();
            let place = solved.iter().position(|&mu| mu == friction)?;
            let state = &whole.range.states[whole.range.state_of[place]];
            Some(state.displacement(friction))
        }
        (_, SteadyState::Plane(base)) => Some(base.displacement(friction)),
        (_, SteadyState::Solid(_) | SteadyState::Assembly(_)) => None,
    }
}

/// Dashpots and springs of each supported boundary.
fn supports(mesh: &Mesh) -> Vec<(String, Pair)> {
    let supported = |boundary: usize| {
        let condition = &mesh.boundaries[boundary].condition;
        matches!(condition, BoundaryCondition::Support(_))
    };
    let of = |boundary: usize| {
        // The mesh with this support alone.
        let mut own = mesh.clone();
        for (other, free) in own.boundaries.iter_mut().enumerate() {
            if other != boundary {
                free.condition = BoundaryCondition::Free;
            }
        }
        let [springs, dashpots] = assemble_supports(&own);
        let pair = Pair::new(mesh.dof_count(), [dashpots, springs]);
        (mesh.boundaries[boundary].name.clone(), pair)
    };
    (0..mesh.boundaries.len())
        .filter(|&b| supported(b))
        .map(of)
        .collect()
}

/// The shapes of one friction value, real and imaginary part of each in two columns.
struct Shapes<'a> {
    friction: f64,
    has_harmonics: bool,
    /// Number of each mode by frequency, from 1.
    modes: Vec<(usize, &'a ComplexMode)>,
    columns: Mat<f64>,
}

impl<'a> Shapes<'a> {
    fn of(point: &'a FrictionPoint, has_harmonics: bool) -> Self {
        let numbered = point.modes.iter().enumerate();
        let modes: Vec<(usize, &ComplexMode)> = numbered
            .filter(|(_, mode)| mode.shape.is_some())
            .map(|(index, mode)| (index + 1, mode))
            .collect();
        let shape = |column: usize| modes[column / 2].1.shape.as_deref().unwrap_or_default();
        let rows = modes.first().map_or(0, |_| shape(0).len());
        let columns = Mat::from_fn(rows, 2 * modes.len(), |row, column| {
            let value = shape(column)[row];
            if column % 2 == 0 { value.re } else { value.im }
        });
        Self {
            friction: point.friction_coefficient,
            has_harmonics,
            modes,
            columns,
        }
    }

    fn name(&self, number: usize, mode: &ComplexMode) -> ModeName {
        ModeName {
            friction_coefficient: self.friction,
            mode: number,
            frequency_hz: mode.frequency_hz(),
            harmonic: self.has_harmonics.then_some(mode.harmonic),
            branch: mode.branch,
            direction: self.has_harmonics.then_some(mode.direction),
        }
    }

    /// `phi^H A phi` of each mode, from the product of a symmetric `A` with the columns.
    fn forms(&self, image: &Mat<f64>) -> Vec<f64> {
        let product = |column: usize| -> f64 {
            let pairs = self
                .columns
                .col_as_slice(column)
                .iter()
                .zip(image.col_as_slice(column));
            pairs.map(|(x, y)| x * y).sum()
        };
        (0..self.modes.len())
            .map(|i| product(2 * i) + product(2 * i + 1))
            .collect()
    }

    /// Adds `factors_0 A_0 phi + factors_1 A_1 phi` of each mode to its balance.
    fn add(
        &self,
        balance: &mut [Vec<c64>],
        images: [&Mat<f64>; 2],
        factors: impl Fn(c64) -> [c64; 2],
    ) {
        for (i, ((_, mode), sum)) in self.modes.iter().zip(balance).enumerate() {
            for (image, factor) in images.into_iter().zip(factors(mode.eigenvalue)) {
                let (re, im) = (image.col_as_slice(2 * i), image.col_as_slice(2 * i + 1));
                for (sum, (re, im)) in sum.iter_mut().zip(re.iter().zip(im)) {
                    *sum += factor * c64::new(*re, *im);
                }
            }
        }
    }

    /// Shares of the reference modes in every unstable mode, the largest first.
    fn couplings(
        &self,
        references: &Shapes<'_>,
        images: &Mat<f64>,
        parts: &Parts<'_>,
    ) -> Vec<Coupling> {
        let [own_images, _] = parts.whole.multiply(self.columns.as_ref());
        let (own, of_references) = (self.forms(&own_images), references.forms(images));
        let mut all = Vec::new();
        for (i, (number, mode)) in self
            .modes
            .iter()
            .enumerate()
            .filter(|(_, (_, mode))| mode.is_unstable())
        {
            let phi = [2 * i, 2 * i + 1].map(|column| self.columns.col_as_slice(column));
            let mut shares: Vec<Coupling> = Vec::new();
            for (j, (reference, other)) in references.modes.iter().enumerate() {
                let image = [2 * j, 2 * j + 1].map(|column| images.col_as_slice(column));
                let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
                let re = dot(image[0], phi[0]) + dot(image[1], phi[1]);
                let im = dot(image[0], phi[1]) - dot(image[1], phi[0]);
                shares.push(Coupling {
                    mode: self.name(*number, mode),
                    growth_rate: mode.growth_rate(),
                    reference: references.name(*reference, other),
                    share: (re * re + im * im) / (own[i] * of_references[j]),
                });
            }
            shares.retain(|row| row.share >= LEAST_SHARE);
            shares.sort_by(|a, b| b.share.total_cmp(&a.share));
            all.extend(shares);
        }
        all
    }
}
