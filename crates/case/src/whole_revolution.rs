//! A body of revolution in three dimensions on its whole mesh: what it is where something breaks the symmetry that its
//! harmonics are solved by.

use super::modifications::{Misfit, Modification, reshaped};
use super::{AssemblyBody, Contact};
use crate::*;

impl Case {
    /// The case with a body of revolution on its whole mesh, as with `cea.method = "sparse"`.
    ///
    /// # Errors
    /// What the whole mesh does not have, at its key.
    pub fn on_whole_mesh(&self) -> Result<Cow<'_, Self>, CaseErrors> {
        let BodyKind::Revolution(specification) = &self.body.kind else {
            return Ok(Cow::Borrowed(self));
        };
        let materials = &self.body.materials;
        let body = whole_revolution(specification, materials, &self.contact, None, &[]);
        let body = body.map_err(|(key, why)| {
            let label = "does not fit the whole mesh";
            // The example of the key is the value that does not fit.
            let help = (key == "contact.base_state").then(|| {
                "write base_state = \"compliant\", or leave normal_stiffness out".to_owned()
            });
            self.error_at(&key, format!("{key}: {why}"), label, help)
        })?;
        Ok(Cow::Owned(Self { body, ..self.clone() }))
    }
}

/// The whole mesh of a body of revolution on its rigid cylinder, or under its rigid ring. It turns as one.
pub(super) fn whole_revolution(
    specification: &SolidSpecification,
    materials: &[RegionMaterial],
    contact: &Contact,
    motion: Option<Motion>,
    modifications: &[Modification],
) -> Result<Body, Misfit> {
    let stiffness = &contact.stiffness;
    let has_springs = stiffness.law.is_none() && stiffness.normal_stiffness.is_some();
    if has_springs && !stiffness.is_base_compliant {
        let why = "on the whole mesh the springs of the contact carry the base state, too, which \"compliant\" says";
        return Err(("contact.base_state".to_owned(), why.to_owned()));
    }
    let of_mesh = |error: String| ("mesh".to_owned(), error);
    let sector = SolidSector::generate(specification).map_err(|e| of_mesh(e.to_string()))?;
    let conditions = SolidFace::ALL.into_iter().zip(specification.conditions);
    let conditions = conditions.filter(|(_, condition)| *condition != BoundaryCondition::Free);
    let conditions: Vec<_> =
        conditions.map(|(face, condition)| (face.name().to_owned(), condition)).collect();
    let mut file = Arc::new(sector.file());
    if !modifications.is_empty() {
        (file, _) = reshaped(file, 1.0, "", modifications)?;
    }
    let mesh = Mesh::from_solids(&file, 1.0, &conditions);
    let mesh = mesh.map_err(|error| of_mesh(error.to_string()))?;
    let surface = mesh.boundaries.iter().position(|own| own.name == sector.contact_surface());
    let surface = surface.ok_or_else(|| {
        let why = "nothing is left of the surface of the contact";
        ("modifications".to_owned(), why.to_owned())
    })?;
    let regions = (0..mesh.regions.len()).collect();
    // Regions are in the order of their names.
    let names = specification.region_names();
    let materials = mesh.regions.iter().map(|name| {
        let own = names.iter().position(|own| own == name);
        materials[own.unwrap_or(0)].clone()
    });
    let materials = materials.collect();
    let counterface = RigidCounterface {
        shape: match specification.contact {
            SolidContact::Inner => RigidShape::Cylinder(None),
            SolidContact::Ring { .. } => RigidShape::Plane,
        },
        center: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        motion: RigidMotion::Turning(contact.sliding.rotation_speed),
        interference: contact.sliding.interference,
    };
    let surfaces = SlidingSurfaces {
        name: SlidingSurfaces::SHORT_FORM.to_owned(),
        surface,
        counter: Counterpart::Rigid(counterface),
        friction: PairFriction { ratio: 1.0, decay: contact.sliding.decay },
        stiffness: *stiffness,
        topography: None,
    };
    let kind = BodyKind::Assembly(AssemblyBody {
        ties: Vec::new(),
        contacts: vec![surfaces],
        motions: motion.map(|own| Motion { regions, ..own }).into_iter().collect(),
        base: BaseChoice::Solved,
        mesh: Arc::new(mesh),
        made_of: Some(Box::new(specification.clone())),
    });
    Ok(Body { materials, kind })
}
