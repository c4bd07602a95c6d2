//! A body as results show it.

use crate::prelude::*;
use crate::{EncodedMesh, Field};
use frictionsim_physics::fem::{revolved_stress, solid_stress};
use std::borrow::Cow;

/// A body in tables, fields and figures.
#[derive(Clone, Copy, Debug)]
pub struct ShownBody<'a> {
    /// The mesh; of a body of revolution in three dimensions the section across the axis.
    pub mesh: &'a Mesh,
    /// One sector of a body of revolution in three dimensions.
    pub sector: Option<&'a SolidSector>,
}

/// Stress at every node of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyStress {
    /// In the plane, in nodal frames.
    Plane(Vec<NodalStress>),
    /// In three dimensions: of a body of revolution in nodal frames, of solid bodies along global axes.
    Solid(Vec<SolidStress>),
}

impl<'a> ShownBody<'a> {
    /// Whether it has three dimensions.
    pub fn is_solid(&self) -> bool {
        self.sector.is_some() || self.mesh.dimension == 3
    }

    /// Components of a motion of a node.
    pub fn dimension(&self) -> usize {
        if self.is_solid() { 3 } else { 2 }
    }

    /// Whether it is solid bodies of a mesh, whose nodes move along x, y and z.
    pub fn is_assembly(&self) -> bool {
        self.sector.is_none() && self.mesh.dimension == 3
    }

    /// Where a node of the whole body is, m.
    pub fn position(&self, node: usize) -> [f64; 3] {
        let Some(sector) = self.sector else { return self.mesh.nodes[node] };
        let (own, turn) = (node % sector.node_count(), node / sector.node_count());
        let (sine, cosine) = sector.angle(own, turn).sin_cos();
        let place = &sector.nodes[own];
        [place.radius * cosine, place.radius * sine, place.height]
    }

    /// Its nodes and elements.
    pub fn whole(&self) -> Cow<'a, Mesh> {
        self.sector.map_or(Cow::Borrowed(self.mesh), |sector| Cow::Owned(sector.whole()))
    }

    /// The same for ParaView.
    pub fn encoded(&self) -> io::Result<EncodedMesh> {
        EncodedMesh::new(&self.whole())
    }

    /// Vectors at all nodes, given in their frames, along x, y and z.
    pub fn vectors(&self, name: &str, nodal: &[f64]) -> Field {
        Field::vectors(name, &self.whole(), nodal)
    }

    /// The stress of a displacement of all nodes in their frames, m; of a body of revolution one sector will do, which
    /// all others repeat.
    pub fn stress(&self, material: &dyn MaterialField, displacement: &[f64]) -> BodyStress {
        match self.sector {
            Some(sector) => {
                let own = revolved_stress(sector, material, displacement);
                let whole = sector.sector_count() * sector.node_count();
                BodyStress::Solid(own.repeat(whole / own.len()))
            }
            None if self.is_assembly() => {
                BodyStress::Solid(solid_stress(self.mesh, material, displacement))
            }
            None => BodyStress::Plane(nodal_stress(self.mesh, material, displacement)),
        }
    }

    /// Invariants and components of a stress at all nodes.
    pub fn stress_fields(&self, stress: &BodyStress) -> Vec<Field> {
        match stress {
            BodyStress::Plane(stress) => Field::plane_stresses(self.mesh, stress),
            BodyStress::Solid(stress) => {
                let axes = if self.is_assembly() { ["x", "y", "z"] } else { ["r", "t", "z"] };
                Field::solid_stresses(stress, axes)
            }
        }
    }

    /// The values at one instant of those nodes of the contact that figures over the angle show: of several rings of
    /// nodes the middle one.
    pub fn shown<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let rings = self.sector.map_or(1, |sector| sector.rings.len());
        values.iter().skip(rings / 2).step_by(rings).copied().collect()
    }

    /// What the contact slides on, in legends.
    pub fn counterface(&self) -> &'static str {
        match self.sector {
            Some(sector) if sector.specification.contact.face() != SolidFace::Inner => "ring",
            _ => "cylinder *Ωa*",
        }
    }
}
