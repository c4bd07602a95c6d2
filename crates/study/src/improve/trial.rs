//! Candidates: where a body may be modified, which is not at its contacts, nor where the case forbids it, nor where
//! nothing moves. Where a modification of the size allowed helps most, to first order, and the derivatives as fields
//! over the mesh.

use super::base::{Base, target_modes};
use super::fields::Derivatives;
use crate::*;
use frictionsim_physics::{fem::element::ElementGeometry, mesh::Counterface};
use frictionsim_results::improve::{Sizes, TargetFields, TargetMode};
use nalgebra::SymmetricEigen;

/// Nodes and patches that may be modified.
pub(super) struct Places {
    /// Nodes of no contact that are not held.
    pub nodes: Vec<usize>,
    /// Elements with the patch about each, none of which touches a contact.
    pub patches: Vec<(usize, Vec<u32>)>,
    /// Elements about each node.
    pub uses: Vec<u32>,
    /// Whether the contact is a hole with a rigid cylinder in it, which can be moved.
    pub has_hole: bool,
}

impl Places {
    /// The places of a base, patches of some radius.
    pub fn of(base: &Base<'_>, radius: f64) -> Result<Self, CaseErrors> {
        let mesh = &base.mesh;
        let forbidden = &base.case.improve.forbidden;
        refuse_unknown(base, forbidden)?;
        let is_forbidden = |name: &String| forbidden.contains(name);
        let region = |e: usize| is_forbidden(&mesh.regions[mesh.region(e)]);

        // Nodes that nothing may touch.
        let mut closed: BTreeSet<u32> = contact_nodes(base);
        let boundaries = mesh.boundaries.iter().filter(|own| is_forbidden(&own.name));
        closed.extend(boundaries.flat_map(|own| &own.nodes));
        let elements = (0..mesh.element_count()).filter(|&e| region(e));
        closed.extend(elements.flat_map(|e| mesh.element_nodes(e)));
        let held: BTreeSet<usize> = mesh.held_dofs().collect();
        let d = mesh.dimension;
        let is_free = |node: usize| (0..d).any(|axis| !held.contains(&(d * node + axis)));
        let nodes = (0..mesh.node_count())
            .filter(|&node| is_free(node) && !closed.contains(&(node as u32)));

        // Patches of elements that may all be touched.
        let is_open = |e: usize| {
            let nodes = mesh.element_nodes(e);
            !region(e) && nodes.iter().all(|node| !closed.contains(node))
        };
        let open: Vec<bool> = (0..mesh.element_count()).map(is_open).collect();
        let middles: Vec<[f64; 3]> = (0..open.len()).map(|e| mesh.element_middle(e)).collect();
        let along = sorted(0..open.len(), |&element| middles[element][0]);
        let patch = |e: usize| -> Vec<u32> {
            let from = along.partition_point(|&other| middles[other][0] < middles[e][0] - radius);
            let beside = along[from..].iter();
            let beside = beside.take_while(|&&other| middles[other][0] <= middles[e][0] + radius);
            let away = |other: usize| -> f64 {
                (0..3).map(|k| (middles[e][k] - middles[other][k]).powi(2)).sum()
            };
            let near = beside.filter(|&&other| away(other) <= radius * radius);
            let mut near: Vec<u32> = near.map(|&other| other as u32).collect();
            near.sort_unstable();
            near
        };
        let patches = (0..open.len()).filter(|&e| open[e]).map(|e| (e, patch(e)));
        let patches = patches.filter(|(_, own)| own.iter().all(|&e| open[e as usize]));
        let mut uses = vec![0; mesh.node_count()];
        let all = (0..mesh.element_count()).flat_map(|e| mesh.element_nodes(e));
        all.for_each(|&node| uses[node as usize] += 1);
        // The contact curve of a plane body is a hole of one body with a rigid cylinder in it, and not its only curve.
        let is_inside = matches!(mesh.counterface, Counterface::Cylinder { is_inside: true, .. });
        let is_alone = mesh.opposite.is_none() && mesh.boundaries.len() > 1;
        let is_one = mesh.dimension == 2 && base.case.body.assembly().is_none();
        Ok(Self {
            uses,
            nodes: nodes.collect(),
            patches: patches.collect(),
            has_hole: is_inside && is_alone && is_one,
        })
    }
}

/// Nodes of all surfaces in contact or tied.
fn contact_nodes(base: &Base<'_>) -> BTreeSet<u32> {
    let mesh = &base.mesh;
    let boundaries: Vec<usize> = match base.case.body.assembly() {
        Some(assembly) => {
            let contacts = assembly.contacts.iter();
            let contacts =
                contacts.flat_map(|own| std::iter::once(own.surface).chain(own.counter.surface()));
            let ties = assembly.ties.iter();
            contacts.chain(ties.flat_map(|own| [own.surface, own.counter])).collect()
        }
        None => std::iter::once(mesh.contact).chain(mesh.opposite).collect(),
    };
    boundaries.iter().flat_map(|&b| &mesh.boundaries[b].nodes).copied().collect()
}

fn refuse_unknown(base: &Base<'_>, forbidden: &[String]) -> Result<(), CaseErrors> {
    let mesh = &base.mesh;
    let boundaries = mesh.boundaries.iter().map(|boundary| &boundary.name);
    let known: Vec<&String> = mesh.regions.iter().chain(boundaries).collect();
    let Some(unknown) = forbidden.iter().find(|name| !known.contains(name)) else { return Ok(()) };
    let names: Vec<String> = known.iter().map(|name| format!("\"{name}\"")).collect();
    Err(refusal!(base.case, "improve.forbidden",
        "improve.forbidden names \"{unknown}\", which the body does not have";
        "no such region or boundary"; "it has {}", names.join(", ")))
}

/// Places of each kind that are kept for a closer look, for each one that is listed.
const KEPT: usize = 6;

/// What is modified.
#[derive(Clone, Debug)]
pub(super) enum Target {
    /// A node, along a direction of a spring or dashpot.
    Node(usize, Option<[f64; 3]>),
    /// The elements of a patch about the middle of the first.
    Patch(usize, Vec<u32>),
    /// The hole, along a vector, m.
    Hole([f64; 2]),
}

/// One modification.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub kind: ModificationKind,
    pub target: Target,
    /// Largest growth rate of the targets to first order, 1/s; none of what has no first order.
    pub first_order: Option<f64>,
}

/// Looks for the best places of each kind.
pub(super) struct Search<'a> {
    pub base: &'a Base<'a>,
    pub sizes: Sizes,
    pub places: Places,
    pub derivatives: &'a [Derivatives],
}

impl Search<'_> {
    /// The best places of a kind by first order, apart from each other; those that do not help are left out.
    pub fn best(&self, kind: ModificationKind) -> Vec<Trial> {
        let mut found = match kind {
            ModificationKind::Damping | ModificationKind::Removal => self.in_patches(kind),
            ModificationKind::Offset => return self.of_hole(),
            _ => self.at_nodes(kind),
        };
        let before = self.growth(&|_| c64::ZERO);
        found.retain(|trial| trial.first_order.is_some_and(|growth| growth < before));
        let growth = |own: &Trial| own.first_order.unwrap_or(f64::INFINITY);
        order::sort_by_number(&mut found, growth);
        self.apart(found, KEPT * self.base.case.improve.candidates)
    }

    /// Largest growth rate of the targets with changes of their eigenvalues.
    fn growth(&self, change: &dyn Fn(&Derivatives) -> c64) -> f64 {
        let growth = self.derivatives.iter().map(|own| own.eigenvalue.re + change(own).re);
        growth.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The target that grows fastest.
    fn fastest(&self) -> &Derivatives {
        self.derivatives
            .iter()
            .max_by(|a, b| a.eigenvalue.re.total_cmp(&b.eigenvalue.re))
            .expect("there are targets, or nothing would be improved")
    }

    /// The key of what a kind attaches to a node, and its size: kg, N/m, N s/m.
    pub fn attached(&self, kind: ModificationKind) -> (&'static str, f64) {
        match kind {
            ModificationKind::Mass => ("mass", self.sizes.mass_kg),
            ModificationKind::Spring => ("stiffness", self.sizes.stiffness_n_per_m),
            _ => ("damping", self.sizes.damping_n_s_per_m),
        }
    }

    fn at_nodes(&self, kind: ModificationKind) -> Vec<Trial> {
        let amount = self.attached(kind).1 / self.base.case.depth();
        let trial = |&node: &usize| {
            let (direction, first_order) = match kind {
                ModificationKind::Mass => {
                    (None, self.growth(&|own| own.by_mass(node, self.base) * amount))
                }
                _ => {
                    let along =
                        steepest(&self.fastest().by_link(kind, node), self.base.mesh.dimension);
                    let change = |own: &Derivatives| {
                        let rate = along.dot(&(own.by_link(kind, node) * along));
                        c64::new(rate * amount, 0.0)
                    };
                    (Some([along.x, along.y, along.z]), self.growth(&change))
                }
            };
            Trial { kind, target: Target::Node(node, direction), first_order: Some(first_order) }
        };
        let body = self.base.case.body.assembly().filter(|_| kind == ModificationKind::Mass);
        let passing = body.map_or_else(BTreeSet::new, AssemblyBody::passing_nodes);
        let nodes = self.places.nodes.iter().filter(|&&node| !passing.contains(&(node as u32)));
        parallel::map(nodes.collect::<Vec<_>>(), trial)
    }

    fn in_patches(&self, kind: ModificationKind) -> Vec<Trial> {
        let beta = self.sizes.patch_damping_s;
        let trial = |(element, patch): &(usize, Vec<u32>)| {
            let change = |own: &Derivatives| {
                let each = patch.iter().map(|&e| match kind {
                    ModificationKind::Removal => own.removal[e as usize],
                    _ => own.damping[e as usize] * beta,
                });
                each.fold(c64::ZERO, |sum, value| sum + value)
            };
            Trial {
                kind,
                first_order: Some(self.growth(&change)),
                target: Target::Patch(*element, patch.clone()),
            }
        };
        parallel::map(&self.places.patches, trial)
    }

    /// Half and whole ways along the axes; a disc whose sectors are alike has no preferred one.
    fn of_hole(&self) -> Vec<Trial> {
        let ways: &[[f64; 2]] = match self.base.mesh.is_cyclic {
            true => &[[1.0, 0.0]],
            false => &[[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]],
        };
        let lengths = [0.5, 1.0].map(|share| share * self.sizes.offset_m);
        let all = ways.iter().flat_map(|&[x, y]| {
            lengths.map(|length| Trial {
                kind: ModificationKind::Offset,
                target: Target::Hole([length * x, length * y]),
                first_order: None,
            })
        });
        if self.places.has_hole { all.collect() } else { Vec::new() }
    }

    /// The first of some trials that lie at least a patch's width from each other.
    fn apart(&self, trials: Vec<Trial>, count: usize) -> Vec<Trial> {
        let mut kept: Vec<Trial> = Vec::new();
        for trial in trials {
            let place = |own: &Trial| Vector3::from(self.place(own));
            let away = |other: &Trial| (place(&trial) - place(other)).norm();
            let is_near = |other: &Trial| away(other) < 2.0 * self.sizes.patch_radius_m;
            if kept.len() < count && !kept.iter().any(is_near) {
                kept.push(trial);
            }
        }
        kept
    }

    /// Where a trial is, m.
    pub fn place(&self, trial: &Trial) -> [f64; 3] {
        match &trial.target {
            Target::Node(node, _) => self.base.mesh.nodes[*node],
            Target::Patch(element, _) => self.base.mesh.element_middle(*element),
            Target::Hole([x, y]) => [*x, *y, 0.0],
        }
    }
}

/// The unit vector along which a quadratic form is least, its first component that is not small positive.
fn steepest(form: &Matrix3<f64>, dimension: usize) -> Vector3<f64> {
    let mut own = *form;
    if dimension == 2 {
        // Nothing moves across the plane: that direction is the last to be chosen.
        own[(2, 2)] = 1.0 + form.abs().sum();
    }
    let eigen = SymmetricEigen::new(own);
    let vector: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    let first = vector.iter().find(|x| x.abs() > 0.1).copied();
    vector * first.unwrap_or(1.0).signum()
}

/// Mass of an element and its area or volume.
fn element_size(search: &Search<'_>, element: usize) -> [f64; 2] {
    let (base, mesh) = (search.base, &search.base.mesh);
    let material = base.case.materials().of(mesh.region(element));
    let mass: f64 = ElementGeometry::new(mesh, element).lumped_mass(material).iter().sum();
    [mass, mass / material.density]
}

/// Mass that a modification adds, kg.
pub(super) fn added_mass(search: &Search<'_>, trial: &Trial) -> f64 {
    match (&trial.target, trial.kind) {
        (_, ModificationKind::Mass) => search.sizes.mass_kg,
        (Target::Patch(_, elements), ModificationKind::Removal) => {
            let masses = elements.iter().map(|&e| element_size(search, e as usize)[0]);
            -search.base.case.depth() * masses.sum::<f64>()
        }
        _ => 0.0,
    }
}

/// The derivatives of all targets, for each unit of mass, stiffness and damping of the whole thickness.
pub(super) fn target_fields(search: &Search<'_>) -> Vec<TargetFields> {
    let modes = target_modes(search.base);
    let sizes = (0..search.base.mesh.element_count()).map(|e| element_size(search, e)[1]);
    let sizes: Vec<f64> = sizes.collect();
    let of = |(own, mode): (&Derivatives, TargetMode)| {
        let extent = search.base.case.depth();
        let nodes = || 0..own.nodes.len();
        let least = |form: Matrix3<f64>| {
            let along = steepest(&form, search.base.mesh.dimension);
            along.dot(&(form * along)) / extent
        };
        let of_links = |kind| nodes().map(|n| least(own.by_link(kind, n))).collect();
        TargetFields {
            mode,
            mass: nodes().map(|n| own.by_mass(n, search.base).re / extent).collect(),
            spring: of_links(ModificationKind::Spring),
            dashpot: of_links(ModificationKind::Dashpot),
            removal: own.removal.iter().zip(&sizes).map(|(d, v)| d.re / v).collect(),
            damping: own.damping.iter().zip(&sizes).map(|(d, v)| d.re / v).collect(),
        }
    };
    search.derivatives.iter().zip(modes).map(of).collect()
}
