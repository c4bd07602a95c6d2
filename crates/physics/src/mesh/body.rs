//! From a mesh file to a body: regions, boundaries with what holds them, and the contact edge.

use super::curve::{Curve, EdgeWeights};
use super::error::{BodyError, BodyPart, refuse_far};
use super::faces::face_key;
use super::plane_body::{plane_body, used_nodes};
use super::{Boundary, BoundaryCondition, BoundaryFace, Chord, Counterface, Mesh, NodalFrames};
use frictionsim_formats::FileMesh;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Relative distance from a circle up to which nodes lie on it.
const ROUND: f64 = 1e-4;
/// Largest angle between a plane and the contact curve from its first node to its last, degrees: a face that is tilted
/// more touches at a corner alone.
const LARGEST_TILT: f64 = 10.0;
/// Largest angle between what a guide holds at a node in contact and the axes of that contact, rad: what rounded coordinates make. The
/// force that it takes from the contact is the square of that.
const LARGEST_SLANT: f64 = 0.01;
/// Names that a message lists.
const NAMED: usize = 10;

/// What makes a body of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpecification {
    /// Factor on the coordinates of the file.
    pub scale: f64,
    /// Physical curve that touches the counterface.
    pub contact: String,
    /// The counterface, as far as it is given; of two bodies the surface that they share.
    pub counterface: CounterfaceSpecification,
    /// Physical curve of the other body that it slides on; `None` for a rigid counterface.
    pub opposite: Option<String>,
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
        /// The way it slides; `None` along the contact curve, from its first point to its last, the body on the left.
        direction: Option<[f64; 2]>,
    },
}

impl Mesh {
    /// The body that `specification` makes of a mesh file.
    ///
    /// Frames are those of the counterface, but along guides, where they are those of the boundary's normal. Whether it is held is for
    /// [`Self::check_held`] to say, once springs are attached.
    ///
    /// # Errors
    /// [`BodyError::Body`] says what is wrong with the mesh or with the names used, and what to do.
    pub fn from_gmsh(
        file: &FileMesh,
        specification: &BodySpecification,
    ) -> Result<Self, BodyError> {
        if file.dimension == 3 {
            return Err(BodyError::Body(
                "the mesh is of solid elements, and a body on a rigid counterface must be plane. Mesh its surface alone (gmsh -2), or \
                 name the contacts of solid bodies under [contacts.NAME]"
                    .to_owned(),
            ));
        }
        refuse_far(file, specification.scale)?;
        let mut mesh = plane_body(file, specification.scale)?;
        let curves = rim_curves(file, &mesh)?;
        let labels: Vec<usize> = mesh.labels.clone();
        let find = |name: &str, part: BodyPart| match curves.get(name) {
            Some(curve) => Ok(curve),
            None => Err(no_curve(file, name, part)),
        };

        // The contact edge first: its frames are those of the counterface.
        let contact = find(&specification.contact, BodyPart::Contact)?;
        contact.check_single(&specification.contact, &labels)?;
        mesh.counterface = counterface(&mesh, contact, specification)?;
        let counterface = mesh.counterface;
        let angles = mesh.plane_nodes().into_iter().map(|point| counterface.normal_angle(point));
        mesh.frames = NodalFrames::Plane(angles.collect());
        let mut edge = contact_boundary(&mut mesh, contact, &specification.contact)?;
        edge.order_along(&mesh);
        let (mut boundaries, free) = (vec![edge], BoundaryCondition::Free);
        for (name, condition) in &specification.conditions {
            if *name == specification.contact {
                refuse_condition(name, *condition, "the contact curve (contact.boundary)")?;
                continue;
            }
            let curve = find(name, BodyPart::Boundary(name.clone()))?;
            boundaries.push(held_boundary(&mut mesh, curve, name, *condition, &contact.nodes)?);
        }
        if let Some(name) = &specification.opposite {
            let curve = find(name, BodyPart::Opposite)?;
            Curve::check_apart([contact, curve], [&specification.contact, name], &labels)?;
            let place = boundaries.iter().position(|boundary| boundary.name == *name);
            if let Some(own) = place.map(|place| boundaries[place].condition) {
                let what = "the contact curve of the other body (contact.counter_boundary)";
                refuse_condition(name, own, what)?;
            }
            mesh.opposite = Some(place.unwrap_or(boundaries.len()));
            if place.is_none() {
                boundaries.push(held_boundary(&mut mesh, curve, name, free, &contact.nodes)?);
            }
        }
        for (&name, curve) in &curves {
            if !boundaries.iter().any(|boundary| boundary.name == name) {
                boundaries.push(held_boundary(&mut mesh, curve, name, free, &contact.nodes)?);
            }
        }
        mesh.boundaries = boundaries;
        mesh.take_symmetry(file.symmetry, specification.scale);
        Ok(mesh)
    }
}

/// The curves of a file that are the rim of its body: others bound nothing, and matter only if they are asked for.
fn rim_curves<'f>(file: &'f FileMesh, mesh: &Mesh) -> Result<BTreeMap<&'f str, Curve>, BodyError> {
    let index_of = used_nodes(file)?;
    let outer = mesh.outer_faces_by_key();
    let chains = file.curves.iter().filter_map(|(name, edges)| {
        let rim = edges.iter().map(|&(p, q, _)| {
            let [p, q] = [p, q].map(|node| index_of[node as usize]);
            outer.get(&face_key([p?, q?])).cloned()
        });
        let mut edges: Vec<BoundaryFace> = rim.collect::<Option<_>>()?;
        edges.sort_by(|a, b| a.nodes.cmp(&b.nodes));
        edges.dedup();
        Some((name.as_str(), Curve::chain(&edges)))
    });
    Ok(chains.collect())
}

/// Refuses a condition on a curve that is in contact.
fn refuse_condition(name: &str, own: BoundaryCondition, what: &str) -> Result<(), BodyError> {
    if own == BoundaryCondition::Free {
        return Ok(());
    }
    let message = format!("boundaries.{name} is {what}: it can have no condition of its own");
    Err(BodyPart::Boundary(name.to_owned()).refused(message))
}

fn no_curve(file: &FileMesh, name: &str, part: BodyPart) -> BodyError {
    if file.node_sets.contains_key(name) {
        return part.refused(format!(
            "node set \"{name}\" is not all nodes of some edges of the outline: a curve of a plane body consists of edges"
        ));
    }
    if file.curves.contains_key(name) {
        return part.refused(format!(
            "physical curve \"{name}\" is not on the rim of the body: its edges are not edges of one element each"
        ));
    }
    let instead = known_instead(file.curves.keys(), name, ["curve", "Curve"]);
    part.refused(format!("no physical curve is called \"{name}\"; {instead}"))
}

/// The names that a file has in place of an unknown one, with the nearest, or how a body's part gets one.
pub(super) fn known_instead<'a>(
    known: impl ExactSizeIterator<Item = &'a String> + Clone,
    name: &str,
    [part, in_gmsh]: [&str; 2],
) -> String {
    let is_near = |known: &&String| known.len().abs_diff(name.len()) <= 1 + name.len() / 3;
    let distances = known.clone().filter(is_near);
    let distances = distances.map(|known| (strsim::damerau_levenshtein(known, name), known));
    let nearest = distances.min().filter(|(distance, _)| *distance <= 1 + name.len() / 3);
    let hint = nearest.map_or_else(String::new, |own| format!("; did you mean \"{}\"?", own.1));
    let more = known.len().saturating_sub(NAMED);
    let names = known.take(NAMED).map(|name| format!("\"{name}\""));
    let names: Vec<String> = names.chain((more > 0).then(|| format!("{more} more"))).collect();
    if names.is_empty() {
        return format!(
            "the file has none: put the {part} in a physical group (Physical {in_gmsh} in Gmsh)"
        );
    }
    format!("the file has {}{hint}", names.join(", "))
}

/// Refuses a plane whose way does not lie along the contact curve: it would slide into the body or away from it.
fn check_along(
    [x, y]: [f64; 2],
    chord: [f64; 2],
    specification: &BodySpecification,
) -> Result<(), BodyError> {
    let length = chord[0].hypot(chord[1]);
    let off = (x * chord[1] - y * chord[0]).abs() / length;
    if length == 0.0 || off <= LARGEST_TILT.to_radians().sin() {
        return Ok(());
    }
    // Of the two ways along the curve the one with the body on its left-hand side: the chord runs so.
    // Rounded, and no minus sign before a zero.
    let [along_x, along_y] = chord.map(|part| (1e3 * part / length).round() / 1e3 + 0.0);
    Err(BodyPart::Direction.refused(format!(
        "contact.direction = [{x}, {y}] makes {:.0} degrees with the contact curve \"{}\": the \
         plane would slide into the body. It must lie along the face: [{along_x}, {along_y}]",
        off.clamp(0.0, 1.0).asin().to_degrees(),
        specification.contact,
    )))
}

/// The counterface where the contact curve puts it.
fn counterface(
    mesh: &Mesh,
    contact: &Curve,
    specification: &BodySpecification,
) -> Result<Counterface, BodyError> {
    let points = contact.nodes.iter().map(|&node| mesh.plane_node(node as usize));
    match specification.counterface {
        CounterfaceSpecification::Plane { direction } => {
            let last = contact.faces.len() - 1;
            let ends = [contact.faces[0].nodes[0], contact.faces[last].nodes[1]];
            let [from, to] = ends.map(|node| mesh.plane_node(node as usize));
            let [x, y] = direction.unwrap_or([to[0] - from[0], to[1] - from[1]]);
            let length = x.hypot(y);
            let direction = [x / length, y / length];
            check_along(direction, [to[0] - from[0], to[1] - from[1]], specification)?;
            let height = |p: &[f64; 2]| direction[0] * p[1] - direction[1] * p[0];
            let lowest = points.min_by(|a, b| height(a).total_cmp(&height(b)));
            Ok(Counterface::Plane { point: lowest.unwrap_or_default(), direction })
        }
        CounterfaceSpecification::Cylinder { center, radius } => {
            let distance = |p: [f64; 2]| (p[0] - center[0]).hypot(p[1] - center[1]);
            let chords = mesh.chords(&contact.faces, |[x, y, _]| {
                Vector3::new(x - center[0], y - center[1], 0.0).normalize()
            });
            let mut distances = contact.nodes.iter().copied().zip(points.map(distance)).collect();
            Chord::bridge(&chords, &mut distances);
            let mean = distances.values().sum::<f64>() / distances.len() as f64;
            let off = |&(_, d): &(&u32, &f64)| (d - mean).abs();
            let worst = distances.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
            if let (None, Some((&node, &d))) = (radius, worst)
                && (d - mean).abs() > ROUND * mean
            {
                let message = format!(
                    "the contact curve \"{}\" is not a circle about contact.center = [{}, {}]: node {} lies {d:.6e} m from it, the mean \
                     is {mean:.6e} m. Correct contact.center, or give the cylinder's contact.radius",
                    specification.contact, center[0], center[1], mesh.labels[node as usize]
                );
                return Err(BodyPart::Center.refused(message));
            }
            // Inside where the body's outward normals point towards the axis.
            let edges = contact.faces.iter().map(|face| {
                let [p, q] = [0, 1].map(|end| mesh.plane_node(face.nodes[end] as usize));
                let middle = [0.5 * (p[0] + q[0]) - center[0], 0.5 * (p[1] + q[1]) - center[1]];
                middle[0] * (p[1] - q[1]) + middle[1] * (q[0] - p[0])
            });
            let (radius, is_inside) = (radius.unwrap_or(mean), edges.sum::<f64>() > 0.0);
            Ok(Counterface::Cylinder { center, radius, is_inside })
        }
    }
}

/// The contact edge with its weights along the counterface's normal.
fn contact_boundary(mesh: &mut Mesh, curve: &Curve, name: &str) -> Result<Boundary, BodyError> {
    let weights = EdgeWeights::of(mesh, curve);
    let mut lengths = Vec::new();
    for (&node, vector) in curve.nodes.iter().zip(&weights.normals) {
        let (sin, cos) = mesh.frame_angles()[node as usize].sin_cos();
        let length = -(vector[0] * cos + vector[1] * sin);
        // A face along the normal leaves round-off of either sign.
        if length <= 1e-6 * vector[0].hypot(vector[1]) {
            let [x, y] = mesh.plane_node(node as usize);
            let part = match mesh.counterface {
                Counterface::Plane { .. } => BodyPart::Direction,
                Counterface::Cylinder { .. } => BodyPart::Contact,
            };
            let message = format!(
                "the contact curve \"{name}\" does not face the counterface at node {} ({x:.6e}, {y:.6e}) m. Leave that part out of the \
                 physical curve, or correct contact.counterface, center or direction",
                mesh.labels[node as usize]
            );
            return Err(part.refused(message));
        }
        lengths.push(length);
    }
    let free = held_boundary(mesh, curve, name, BoundaryCondition::Free, &[])?;
    Ok(Boundary { tributary_lengths: lengths, ..free })
}

/// A boundary with its condition; a guide or a fixed direction turns the frames of its nodes, but for those of the contact. These it
/// holds along one of their axes: across neither it would hold them as a clamp, or along another line than the nodes beside them.
fn held_boundary(
    mesh: &mut Mesh,
    curve: &Curve,
    name: &str,
    condition: BoundaryCondition,
    contact: &[u32],
) -> Result<Boundary, BodyError> {
    let weights = EdgeWeights::of(mesh, curve);
    let normal_angles = weights.normal_angles();
    let is_fixed = matches!(condition, BoundaryCondition::Fixed(_));
    if is_fixed || condition == BoundaryCondition::Guide {
        let mut angles = mesh.frame_angles().to_vec();
        let contact: BTreeSet<u32> = contact.iter().copied().collect();
        for (&node, &angle) in curve.nodes.iter().zip(&normal_angles) {
            // A guide holds along the normal of its boundary, a fixed direction is one of x and y.
            let own = if is_fixed { 0.0 } else { angle };
            // A turn by a right angle changes axes, and holds as well.
            let off = 0.5 * (2.0 * (own - angles[node as usize])).sin().abs().asin();
            if !contact.contains(&node) {
                angles[node as usize] = own;
            } else if off > LARGEST_SLANT
                && !matches!(condition, BoundaryCondition::Fixed([true, true, _]))
            {
                let (label, degrees) = (mesh.labels[node as usize], off.to_degrees());
                let message = format!(
                    "boundaries.{name} holds node {label} of the contact {degrees:.1} degrees off the contact's normal and tangent. \
                     Draw it perpendicular to the contact, or hold it by a \"support\" of large normal_stiffness"
                );
                return Err(BodyPart::Boundary(name.to_owned()).refused(message));
            }
        }
        mesh.frames = NodalFrames::Plane(angles);
    }
    Ok(Boundary {
        name: name.to_owned(),
        nodes: curve.nodes.clone(),
        faces: curve.faces.clone(),
        tributary_lengths: weights.lengths,
        normal_angles,
        is_closed: curve.is_closed,
        condition,
    })
}
