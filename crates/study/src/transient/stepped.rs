//! The body of a case as the time loop takes it.

use crate::*;
use frictionsim_physics::{cycle::OperatingPoint, transient::SteppedBody};

/// The mesh of a case and what belongs to it: a transient and the limit cycles that it may end on step the same body.
#[derive(Debug)]
pub struct SteppedMesh<'a> {
    /// The mesh; of a body of revolution in three dimensions the section across the axis.
    pub mesh: Arc<Mesh>,
    /// One sector of a body of revolution in three dimensions.
    pub sector: Option<SolidSector>,
    /// Solid bodies of a mesh with their ties and contacts.
    pub assembly: Option<Assembly<'a>>,
    annulus: Option<AnnulusMesh>,
    /// All of the body of revolution.
    whole: Option<Mesh>,
}

impl<'a> SteppedMesh<'a> {
    /// That of a case.
    pub fn of(case: &'a Case) -> Result<Self, StudyError> {
        let (mut annulus, mut sector, mut assembly) = (None, None, None);
        let mesh = match &case.body.kind {
            BodyKind::Annulus(specification) => {
                Arc::new(annulus.insert(AnnulusMesh::generate(specification)?).mesh.clone())
            }
            BodyKind::Revolution(specification) => {
                Arc::new(sector.insert(SolidSector::generate(specification)?).section()?)
            }
            BodyKind::Imported(imported) => Arc::clone(&imported.mesh),
            BodyKind::Assembly(body) => {
                assembly = Some(body.assembled(case.materials_in_time(), MassKind::Lumped)?);
                Arc::clone(&body.mesh)
            }
        };
        let whole = sector.as_ref().map(SolidSector::whole);
        Ok(Self { mesh, sector, assembly, annulus, whole })
    }

    /// The body of the case with its contact.
    pub fn body<'b>(&'b self, case: &'b Case) -> TransientModel<'b> {
        self.body_at(case, &operating_point(case))
    }

    /// The same at another operating point.
    pub fn body_at<'b>(&'b self, case: &'b Case, point: &OperatingPoint) -> TransientModel<'b> {
        let body = match (&self.assembly, self.sector.as_ref().zip(self.whole.as_ref())) {
            (Some(assembly), _) => {
                let axis = case.body.assembly().and_then(AssemblyBody::axis);
                let axis = axis.unwrap_or([[0.0; 3], [0.0, 0.0, 1.0]]);
                SteppedBody::Assembly { assembly, axis }
            }
            (None, Some((sector, mesh))) => SteppedBody::Revolution { sector, mesh },
            (None, None) => SteppedBody::Plane { mesh: &self.mesh, annulus: self.annulus.as_ref() },
        };
        let (material, beta) = (case.materials_in_time(), point.damping.stiffness_coefficient);
        TransientModel {
            stiffness: case.contact.stiffness,
            contact_damping: if case.damping.include_contact { beta } else { 0.0 },
            ..TransientModel::new(body, material, point.damping, point.contact)
        }
    }

    /// The body as results show it.
    pub fn shown(&self) -> ShownBody<'_> {
        ShownBody { mesh: &self.mesh, sector: self.sector.as_ref() }
    }
}
