//! Where a body may be modified: not at its contacts, not where the case forbids it, not where nothing moves.

use super::base::Base;
use frictionsim_case::{CaseErrors, refusal};
use frictionsim_physics::mesh::{Counterface, Mesh};
use frictionsim_results::sorted;
use std::collections::BTreeSet;

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
    ///
    /// # Errors
    /// A forbidden name that the mesh does not have.
    pub fn of(base: &Base<'_>, radius: f64) -> Result<Self, CaseErrors> {
        let mesh = &base.mesh;
        let forbidden = &base.case.improve.forbidden;
        refuse_unknown(base, forbidden)?;
        let is_forbidden = |name: &String| forbidden.contains(name);
        let region = |e: usize| is_forbidden(&mesh.regions[mesh.region(e)]);

        // Nodes that nothing may touch.
        let mut closed: BTreeSet<u32> = contact_nodes(base);
        for boundary in mesh.boundaries.iter().filter(|own| is_forbidden(&own.name)) {
            closed.extend(&boundary.nodes);
        }
        for element in (0..mesh.element_count()).filter(|&e| region(e)) {
            closed.extend(mesh.element_nodes(element));
        }
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
        for element in 0..mesh.element_count() {
            for &node in mesh.element_nodes(element) {
                uses[node as usize] += 1;
            }
        }
        Ok(Self {
            uses,
            nodes: nodes.collect(),
            patches: patches.collect(),
            has_hole: has_hole(base, mesh),
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

/// Whether the contact curve of a plane body is a hole of one body with a rigid cylinder in it, and not its only curve.
fn has_hole(base: &Base<'_>, mesh: &Mesh) -> bool {
    let is_inside = matches!(mesh.counterface, Counterface::Cylinder { is_inside: true, .. });
    let is_alone = mesh.opposite.is_none() && mesh.boundaries.len() > 1;
    mesh.dimension == 2 && is_inside && is_alone && base.case.body.assembly().is_none()
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
