//! Nodes and elements of a mesh file as a plane body.

use super::coincidence::refuse_doubled_elements;
use super::error::{BodyError, BodyPart};
use super::{Mesh, NodalFrames};
use frictionsim_formats::{FileElement, FileMesh};
use std::collections::{BTreeMap, BTreeSet};

/// Distances of the farthest node from the origin within which a body lies, m.
const SMALLEST: f64 = 1e-9;
const LARGEST: f64 = 1e6;

/// Position among the nodes of plane elements of each node of the file.
pub(super) fn used_nodes(file: &FileMesh) -> Result<Vec<Option<u32>>, BodyError> {
    let mut is_plane = vec![false; file.points.len()];
    for element in &file.elements {
        element.nodes.iter().for_each(|&node| is_plane[node as usize] = true);
    }
    if let Some(node) = (0..is_plane.len()).find(|&node| !file.is_used[node]) {
        return Err(BodyError::Body(format!(
            "node {} belongs to no element: the mesh has dangling nodes. Remove them (Coherence \
             Mesh; in Gmsh), or save the physical groups alone (Mesh.SaveAll = 0)",
            file.labels[node]
        )));
    }
    // In order of their numbers, so that a file numbered from 1 keeps them.
    let mut order: Vec<usize> = (0..is_plane.len()).filter(|&node| is_plane[node]).collect();
    order.sort_unstable_by_key(|&node| file.labels[node]);
    let mut index_of = vec![None; is_plane.len()];
    for (index, node) in order.into_iter().enumerate() {
        index_of[node] = Some(index as u32);
    }
    Ok(index_of)
}

/// Nodes and elements, counter-clockwise, without boundaries.
pub(super) fn plane_body(file: &FileMesh, scale: f64) -> Result<Mesh, BodyError> {
    let index_of = used_nodes(file)?;
    let depth = file.points[file.elements[0].nodes[0] as usize][2];
    let size = file.points.iter().fold(0.0_f64, |m, p| m.max(p[0].abs()).max(p[1].abs()));
    check_size(file, size, scale)?;
    refuse_doubled_elements(file)?;
    let mut used = (0..index_of.len()).filter(|&node| index_of[node].is_some());
    let is_off = |&node: &usize| (file.points[node][2] - depth).abs() > 1e-9 * size;
    if let Some(node) = used.find(is_off) {
        return Err(BodyError::Body(format!(
            "node {} lies at z = {}, others at {depth}: the body must be plane, in the x-y plane",
            file.labels[node], file.points[node][2]
        )));
    }
    let is_reversed = reversed_surfaces(file)?;
    let mut mesh = file_elements(file, (2, scale), &index_of, |element, nodes| {
        if is_reversed.contains(&element.entity) {
            let corners = element.kind.corner_count();
            nodes[..corners].reverse();
            // Middles follow their edges: edge i of the reversed outline was edge corners - 2 - i.
            nodes[corners..].reverse();
            if element.kind.is_quadratic() {
                nodes[corners..].rotate_left(1);
            }
        }
    })?;
    mesh.nodes.iter_mut().for_each(|point| point[2] = 0.0);
    mesh.check_elements(|e| file.elements[e].label)?;
    Ok(mesh)
}

/// Nodes, elements and regions of a file, without boundaries; `turn` may put the nodes of an element in another order.
pub(super) fn file_elements(
    file: &FileMesh,
    (dimension, scale): (usize, f64),
    index_of: &[Option<u32>],
    turn: impl Fn(&FileElement, &mut [u32]),
) -> Result<Mesh, BodyError> {
    let count = index_of.iter().flatten().count();
    let names: BTreeSet<&str> = file.elements.iter().map(|e| &*e.region).collect();
    let names: Vec<&str> = names.into_iter().collect();
    if names.len() > usize::from(u16::MAX) {
        let what = ["surfaces", "volumes"][dimension - 2];
        return Err(BodyError::Body(format!("{} physical {what} are too many", names.len())));
    }
    let mut mesh = Mesh {
        dimension,
        nodes: vec![[0.0; 3]; count],
        frames: NodalFrames::global(dimension, count),
        element_starts: vec![0],
        labels: vec![0; count],
        regions: names.iter().map(|name| (*name).to_owned()).collect(),
        ..Mesh::default()
    };
    for (node, (point, index)) in file.points.iter().zip(index_of).enumerate() {
        let Some(index) = *index else { continue };
        mesh.nodes[index as usize] = point.map(|coordinate| scale * coordinate);
        mesh.labels[index as usize] = file.labels[node];
    }
    for (e, element) in file.elements.iter().enumerate() {
        let nodes = element.nodes.iter().filter_map(|&node| index_of[node as usize]);
        let mut nodes: Vec<u32> = nodes.collect();
        turn(element, &mut nodes);
        let region = names.binary_search(&&*element.region);
        let region = region.expect("regions are those of the elements");
        mesh.push_element(element.kind, nodes, (region, e as u32));
    }
    Ok(mesh)
}

/// Refuses coordinates of which no length can be computed with: squares and products of them must be finite.
fn check_size(file: &FileMesh, size: f64, scale: f64) -> Result<(), BodyError> {
    let length = size * scale;
    if (SMALLEST..=LARGEST).contains(&length) {
        return Ok(());
    }
    let reaches = |p: &[f64; 3]| p[0].abs().max(p[1].abs()) == size;
    let node = file.points.iter().position(reaches);
    let label = node.map_or(0, |node| file.labels[node]);
    Err(BodyPart::Scale.refused(format!(
        "node {label} lies at {length:e} m, and no other one farther from the origin: a body of {SMALLEST:e} to {LARGEST:e} m is \
         expected. Is the file damaged, or mesh.scale = {scale:e} wrong?"
    )))
}

/// Surfaces whose elements run clockwise, all of them: the surface is turned over, its elements are sound.
fn reversed_surfaces(file: &FileMesh) -> Result<BTreeSet<i64>, BodyError> {
    let area = |element: &FileElement| {
        let corners = element.kind.corner_count();
        let at = |i: usize| file.points[element.nodes[i % corners] as usize];
        let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        0.5 * (0..corners).map(|i| cross(at(i), at(i + 1))).sum::<f64>()
    };
    // Elements that run counter-clockwise and clockwise.
    let mut balance: BTreeMap<i64, [usize; 2]> = BTreeMap::new();
    for element in &file.elements {
        let counts = balance.entry(element.entity).or_default();
        counts[usize::from(area(element) < 0.0)] += 1;
    }
    for element in &file.elements {
        let [counter, clockwise] = balance[&element.entity];
        let is_minority = if area(element) < 0.0 { counter > 0 } else { clockwise > counter };
        if is_minority {
            return Err(BodyError::Body(format!(
                "element {} is inverted: its nodes run the other way round than those of the {} \
                 other elements of surface {}. Mesh the surface again",
                element.label,
                clockwise.max(counter),
                element.entity
            )));
        }
    }
    let reversed = balance.into_iter().filter(|(_, [counter, clockwise])| clockwise > counter);
    Ok(reversed.map(|(entity, _)| entity).collect())
}
