//! From a mesh file to a body: regions, boundaries with what holds them, and the contact edge.

use super::curve::{Curve, EdgeWeights};
use super::gmsh::{GmshFile, MeshFileError, PlaneElement};
use super::{Boundary, BoundaryCondition, Counterface, Mesh2d};
use std::collections::{BTreeMap, BTreeSet};

/// Relative distance from a circle up to which nodes lie on it.
const ROUND: f64 = 1e-4;

/// What makes a body of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpecification {
    /// Factor on the coordinates of the file.
    pub scale: f64,
    /// Physical curve that touches the counterface.
    pub contact: String,
    /// The counterface, as far as it is given.
    pub counterface: CounterfaceSpecification,
    /// What holds each boundary; those not named are free.
    pub conditions: Vec<(String, BoundaryCondition)>,
}

/// A counterface whose place follows from the contact curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CounterfaceSpecification {
    /// A cylinder.
    Cylinder {
        /// Its axis, m.
        center: [f64; 2],
        /// Its radius, m; `None` takes that of the contact curve, which must be a circle.
        radius: Option<f64>,
    },
    /// A plane that just touches the undeformed body.
    Plane {
        /// The way it slides.
        direction: [f64; 2],
    },
}

impl Mesh2d {
    /// The body that `specification` makes of a mesh file.
    ///
    /// Frames are those of the counterface, but along guides, where they are those of the boundary's normal.
    ///
    /// # Errors
    /// [`MeshFileError::Body`] says what is wrong with the mesh or with the names used, and what to do.
    pub fn from_gmsh(
        file: &GmshFile,
        specification: &BodySpecification,
    ) -> Result<Self, MeshFileError> {
        let mut mesh = plane_body(file, specification.scale)?;
        let index_of = used_nodes(file)?;
        let outline: BTreeMap<(u32, u32), (u32, u32, Option<u32>)> = mesh
            .outline_edges()
            .into_iter()
            .map(|edge| ((edge.0.min(edge.1), edge.0.max(edge.1)), edge))
            .collect();
        let labels: Vec<usize> = mesh.labels.clone();
        let mut curves: BTreeMap<&str, Curve> = BTreeMap::new();
        for (name, edges) in &file.curves {
            // Curves that are not the rim of the body bound nothing; they matter only if they are asked for.
            let rim = edges.iter().map(|&(p, q, _)| {
                let ends = [p, q].map(|node| index_of[node as usize]);
                let [p, q] = [ends[0]?, ends[1]?];
                outline.get(&(p.min(q), p.max(q))).copied()
            });
            if let Some(edges) = rim.collect::<Option<BTreeSet<_>>>() {
                curves.insert(name, Curve::chain(edges.into_iter().collect()));
            }
        }
        let find = |name: &str, key: &str| match curves.get(name) {
            Some(curve) => Ok(curve),
            None => Err(no_curve(file, name, key)),
        };

        // The contact edge first: its frames are those of the counterface.
        let contact = find(&specification.contact, "contact.boundary")?;
        contact.check_single(&specification.contact, &labels)?;
        mesh.counterface = counterface(&mesh, contact, specification)?;
        let counterface = mesh.counterface;
        let angles = mesh
            .nodes
            .iter()
            .map(|&point| counterface.normal_angle(point));
        mesh.frame_angles = angles.collect();
        let mut edge = contact_boundary(&mesh, contact, &specification.contact)?;
        edge.order_along(&mesh);
        let mut boundaries = vec![edge];
        for (name, condition) in &specification.conditions {
            if *name == specification.contact {
                if *condition != BoundaryCondition::Free {
                    return Err(body(format!(
                        "boundaries.{name} is the contact curve (contact.boundary): it can have no condition of its own"
                    )));
                }
                continue;
            }
            let curve = find(name, "boundaries")?;
            boundaries.push(held_boundary(
                &mut mesh,
                curve,
                name,
                *condition,
                &contact.nodes,
            ));
        }
        for (&name, curve) in &curves {
            if !boundaries.iter().any(|boundary| boundary.name == name) {
                let free = BoundaryCondition::Free;
                boundaries.push(held_boundary(&mut mesh, curve, name, free, &contact.nodes));
            }
        }
        mesh.boundaries = boundaries;
        mesh.check_held()?;
        Ok(mesh)
    }
}

pub(super) fn body(message: String) -> MeshFileError {
    MeshFileError::Body(message)
}

/// Position among the nodes of plane elements of each node of the file.
fn used_nodes(file: &GmshFile) -> Result<Vec<Option<u32>>, MeshFileError> {
    let mut is_plane = vec![false; file.points.len()];
    for element in &file.elements {
        element
            .nodes
            .iter()
            .for_each(|&node| is_plane[node as usize] = true);
    }
    if let Some(node) = (0..is_plane.len()).find(|&node| !file.is_used[node]) {
        return Err(body(format!(
            "node {} belongs to no element: the mesh has dangling nodes; remove them (Coherence Mesh; in Gmsh), or save \
             the physical groups alone (Mesh.SaveAll = 0)",
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
fn plane_body(file: &GmshFile, scale: f64) -> Result<Mesh2d, MeshFileError> {
    let index_of = used_nodes(file)?;
    let count = index_of.iter().flatten().count();
    let mut mesh = Mesh2d {
        nodes: vec![[0.0; 2]; count],
        frame_angles: vec![0.0; count],
        element_starts: vec![0],
        labels: vec![0; count],
        ..Mesh2d::default()
    };
    let depth = file.points[file.elements[0].nodes[0] as usize][2];
    let size = file
        .points
        .iter()
        .fold(0.0_f64, |m, p| m.max(p[0].abs()).max(p[1].abs()));
    for (node, (&[x, y, z], index)) in file.points.iter().zip(&index_of).enumerate() {
        let Some(index) = *index else { continue };
        if (z - depth).abs() > 1e-9 * size {
            return Err(body(format!(
                "node {} lies at z = {z}, others at {depth}: the body must be plane, in the x-y plane",
                file.labels[node]
            )));
        }
        mesh.nodes[index as usize] = [scale * x, scale * y];
        mesh.labels[index as usize] = file.labels[node];
    }
    let names: BTreeSet<&str> = file.elements.iter().map(|e| e.region.as_str()).collect();
    let names: Vec<&str> = names.into_iter().collect();
    if names.len() > usize::from(u16::MAX) {
        return Err(body(format!(
            "{} physical surfaces are more than can be told apart",
            names.len()
        )));
    }
    mesh.regions = names.iter().map(|name| (*name).to_owned()).collect();
    let is_reversed = reversed_surfaces(file)?;
    for (e, element) in file.elements.iter().enumerate() {
        let mut nodes: Vec<u32> = element
            .nodes
            .iter()
            .filter_map(|&node| index_of[node as usize])
            .collect();
        if is_reversed.contains(&element.entity) {
            let corners = element.kind.corner_count();
            nodes[..corners].reverse();
            // Middles follow their edges: edge i of the reversed outline was edge corners - 2 - i.
            nodes[corners..].reverse();
            if element.kind.is_quadratic() {
                nodes[corners..].rotate_left(1);
            }
        }
        mesh.elements.extend(nodes);
        mesh.element_starts.push(mesh.elements.len() as u32);
        mesh.element_kinds.push(element.kind);
        mesh.congruent_to.push(e as u32);
        let region = names.binary_search(&element.region.as_str()).unwrap_or(0);
        mesh.element_regions.push(region as u16);
    }
    mesh.check_elements(|e| file.elements[e].label)?;
    Ok(mesh)
}

/// Surfaces whose elements run clockwise, all of them: the surface is turned over, its elements are sound.
fn reversed_surfaces(file: &GmshFile) -> Result<BTreeSet<i64>, MeshFileError> {
    let area = |element: &PlaneElement| {
        let corners = element.kind.corner_count();
        let at = |i: usize| file.points[element.nodes[i % corners] as usize];
        let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        0.5 * (0..corners).map(|i| cross(at(i), at(i + 1))).sum::<f64>()
    };
    let mut balance: BTreeMap<i64, (usize, usize)> = BTreeMap::new();
    for element in &file.elements {
        let counts = balance.entry(element.entity).or_default();
        if area(element) < 0.0 {
            counts.0 += 1;
        } else {
            counts.1 += 1;
        }
    }
    for element in &file.elements {
        let (clockwise, counter) = balance[&element.entity];
        let is_minority = if area(element) < 0.0 {
            counter > 0
        } else {
            clockwise > counter
        };
        if is_minority {
            return Err(body(format!(
                "element {} is inverted: its nodes run the other way round than those of the {} other elements of \
                 surface {}; mesh the surface again",
                element.label,
                clockwise.max(counter),
                element.entity
            )));
        }
    }
    let reversed = balance
        .into_iter()
        .filter(|(_, (clockwise, counter))| clockwise > counter);
    Ok(reversed.map(|(entity, _)| entity).collect())
}

fn no_curve(file: &GmshFile, name: &str, key: &str) -> MeshFileError {
    if file.curves.contains_key(name) {
        return body(format!(
            "physical curve \"{name}\" ({key}) is not on the rim of the body: its edges are not edges of one element each"
        ));
    }
    let names: Vec<String> = file
        .curves
        .keys()
        .map(|name| format!("\"{name}\""))
        .collect();
    let nearest = file
        .curves
        .keys()
        .map(|known| (strsim::damerau_levenshtein(known, name), known))
        .min();
    let hint = match nearest {
        Some((distance, known)) if distance <= 1 + name.len() / 3 => {
            format!("; did you mean \"{known}\"?")
        }
        _ => String::new(),
    };
    let list = if names.is_empty() {
        "the file has none: put the curve in a physical group (Physical Curve in Gmsh)".to_owned()
    } else {
        format!("the file has {}", names.join(", "))
    };
    body(format!(
        "{key}: no physical curve is called \"{name}\"; {list}{hint}"
    ))
}

/// The counterface where the contact curve puts it.
fn counterface(
    mesh: &Mesh2d,
    contact: &Curve,
    specification: &BodySpecification,
) -> Result<Counterface, MeshFileError> {
    let points = contact.nodes.iter().map(|&node| mesh.nodes[node as usize]);
    match specification.counterface {
        CounterfaceSpecification::Plane { direction: [x, y] } => {
            let length = x.hypot(y);
            let direction = [x / length, y / length];
            let height = |p: &[f64; 2]| direction[0] * p[1] - direction[1] * p[0];
            let lowest = points.min_by(|a, b| height(a).total_cmp(&height(b)));
            Ok(Counterface::Plane {
                point: lowest.unwrap_or_default(),
                direction,
            })
        }
        CounterfaceSpecification::Cylinder { center, radius } => {
            let distance = |p: [f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
            let distances: Vec<f64> = points.map(distance).collect();
            let mean = distances.iter().sum::<f64>() / distances.len() as f64;
            let off = |&(_, d): &(usize, f64)| (d - mean).abs();
            let worst = distances
                .iter()
                .copied()
                .enumerate()
                .max_by(|a, b| off(a).total_cmp(&off(b)));
            if let (None, Some((i, d))) = (radius, worst)
                && (d - mean).abs() > ROUND * mean
            {
                return Err(body(format!(
                    "the contact curve \"{}\" is no circle about contact.center = [{}, {}]: node {} lies {d:.6e} m from \
                     it, the mean is {mean:.6e} m; correct contact.center, or give the cylinder's contact.radius",
                    specification.contact,
                    center[0],
                    center[1],
                    mesh.labels[contact.nodes[i] as usize]
                )));
            }
            // Inside where the body's outward normals point towards the axis.
            let inward: f64 = contact
                .edges
                .iter()
                .map(|&(p, q, _)| {
                    let [p, q] = [p, q].map(|node| mesh.nodes[node as usize]);
                    let middle = [
                        0.5 * (p[0] + q[0]) - center[0],
                        0.5 * (p[1] + q[1]) - center[1],
                    ];
                    middle[0] * (p[1] - q[1]) + middle[1] * (q[0] - p[0])
                })
                .sum();
            Ok(Counterface::Cylinder {
                center,
                radius: radius.unwrap_or(mean),
                is_inside: inward > 0.0,
            })
        }
    }
}

/// The contact edge with its weights along the counterface's normal.
fn contact_boundary(mesh: &Mesh2d, curve: &Curve, name: &str) -> Result<Boundary, MeshFileError> {
    let weights = EdgeWeights::of(mesh, curve);
    let mut lengths = Vec::new();
    for (&node, vector) in curve.nodes.iter().zip(&weights.normals) {
        let (sin, cos) = mesh.frame_angles[node as usize].sin_cos();
        let length = -(vector[0] * cos + vector[1] * sin);
        if length <= 0.0 {
            let [x, y] = mesh.nodes[node as usize];
            return Err(body(format!(
                "the contact curve \"{name}\" does not face the counterface at node {} ({x:.6e}, {y:.6e}) m: leave that \
                 part out of the physical curve, or correct contact.counterface, center or direction",
                mesh.labels[node as usize]
            )));
        }
        lengths.push(length);
    }
    Ok(Boundary {
        name: name.to_owned(),
        nodes: curve.nodes.clone(),
        tributary_lengths: lengths,
        normal_angles: weights.normal_angles(),
        is_closed: curve.is_closed,
        condition: BoundaryCondition::Free,
    })
}

/// A boundary with its condition; a guide turns the frames of its nodes, but for those of the contact.
fn held_boundary(
    mesh: &mut Mesh2d,
    curve: &Curve,
    name: &str,
    condition: BoundaryCondition,
    contact: &[u32],
) -> Boundary {
    let weights = EdgeWeights::of(mesh, curve);
    let normal_angles = weights.normal_angles();
    if condition == BoundaryCondition::Guide {
        for (&node, &angle) in curve.nodes.iter().zip(&normal_angles) {
            if !contact.contains(&node) {
                mesh.frame_angles[node as usize] = angle;
            }
        }
    }
    Boundary {
        name: name.to_owned(),
        nodes: curve.nodes.clone(),
        tributary_lengths: weights.lengths,
        normal_angles,
        is_closed: curve.is_closed,
        condition,
    }
}
