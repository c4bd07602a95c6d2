//! What modifications attach to a body, and the annulus whose symmetry they break.

use super::description::Description;
use super::modifications::{Misfit, Modification, reshaped};
use crate::*;
use frictionsim_physics::mesh::{AnnulusMesh, Attachment, DampedPatch};
use nalgebra::Matrix3;

/// A built-in annulus with modifications: no symmetry is left, and it is what a mesh file of it would be.
pub(super) fn reshaped_annulus(
    spec: &AnnulusSpecification,
    modifications: &[Modification],
) -> Result<ImportedBody, Misfit> {
    let first = modifications.first();
    let key = first.map_or_else(String::new, |own| format!("modifications.{}", own.name));
    if spec.shaft.is_some() {
        let why = "modifications are for one body on a rigid cylinder; give a disc with a \
        deformable shaft as a mesh file";
        return Err((key, why.to_owned()));
    }
    let mesh = AnnulusMesh::generate(spec).map_err(|error| (key.clone(), error.to_string()))?.mesh;
    let contact = mesh.contact_edge().name.clone();
    let file = Arc::new(mesh.to_file());
    let (file, center) = reshaped(file, 1.0, &contact, modifications)?;
    let specification = BodySpecification {
        scale: 1.0,
        contact,
        counterface: CounterfaceSpecification::Cylinder { center, radius: Some(spec.inner_radius) },
        opposite: None,
        conditions: vec![("outer".to_owned(), spec.outer)],
    };
    let body = Mesh::from_gmsh(&file, &specification).map_err(|error| (key, error.to_string()))?;
    Ok(ImportedBody::new(body, file, specification))
}

/// Attaches masses, springs, dashpots and damped patches to the mesh of a body.
pub(super) fn attach(case: &Description<'_>, body: &mut Body) {
    if case.modifications.is_empty() {
        return;
    }
    let all = case.root.section("modifications", false);
    let is_plane = body.dimension() == 2;
    let extent = if is_plane { case.thickness } else { 1.0 };
    let (mut attachments, mut patches) = (Vec::new(), Vec::new());
    let passing = body.assembly().map_or_else(BTreeSet::new, AssemblyBody::passing_nodes);
    for own in &case.modifications {
        let section = all.section(&own.name, false);
        let leaves = |vector: Option<[f64; 3]>| vector.is_some_and(|[.., z]| z != 0.0);
        let vectors = [("direction", own.direction), ("center", own.within.map(|own| own.0))];
        for (key, _) in vectors.into_iter().filter(|own| is_plane && leaves(own.1)) {
            refuse!(section, key => "leaves the plane"; "the body is plane"; "leave z out");
        }
        if let Some(place) = &own.at {
            let found = body.find_node(&section, "at", place);
            let passes = found.is_some_and(|(node, _)| passing.contains(&(node as u32)));
            refuse_if!(own.mass != 0.0 && passes; section, "mass" =>
                "lies on a body that turns, in the frame at rest: it would move through the mesh";
                "a mass turns with its body"; "give that [motion.NAME] frame = \"turning\"");
            attachments.extend(found.map(|(node, _)| own.attachment(node, extent)));
        }
        if own.coefficients == [0.0; 2] {
            continue;
        }
        let Some(((center, radius), mesh)) = own.within.zip(body.whole_mesh()) else { continue };
        let elements = mesh.elements_within(center, radius);
        refuse_if!(elements.is_empty(); section, "radius" => "holds no element's middle";
            "no element within it"; "center and radius are in metres");
        let [mass_coefficient, stiffness_coefficient] = own.coefficients;
        patches.push(DampedPatch { elements, mass_coefficient, stiffness_coefficient });
    }
    let mesh = match &mut body.kind {
        BodyKind::Imported(own) => Arc::make_mut(&mut own.mesh),
        BodyKind::Assembly(own) => Arc::make_mut(&mut own.mesh),
        BodyKind::Annulus(_) | BodyKind::Revolution(_) => return,
    };
    (mesh.attachments, mesh.patches) = (attachments, patches);
}

impl Modification {
    /// What it attaches to a node, for each metre of thickness in the plane.
    fn attachment(&self, node: usize, thickness: f64) -> Attachment {
        let law = match self.direction {
            None => Matrix3::identity(),
            Some(direction) => {
                let along = Vector3::from(direction).normalize();
                along * along.transpose()
            }
        };
        Attachment {
            node,
            mass: self.mass / thickness,
            stiffness: law * (self.stiffness / thickness),
            damping: law * (self.damping / thickness),
        }
    }
}
