//! The terms of a body of revolution in three dimensions in steady sliding.

use super::solid_contact::contact_terms;
use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::SlidingContact;
use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
use crate::mesh::SolidSector;

impl WaveTangent {
    /// Finds the steady sliding state of a body of revolution and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let mut terms = WaveTerms::of(sector, material, (options.mass, options.damping));
        let base =
            SolidSliding::solve(sector, &terms.elastic(), contact, options.contact.base_law())?;
        if options.geometric_stiffness {
            let displacements = [&base.pressed_displacement[..], &base.sheared_displacement];
            terms.take_stress(sector, material, displacements);
            terms.turning = turning_forces(sector, &base);
        }
        terms.contact = contact_terms(&base, sector, &options.contact);
        let parts = (terms, rings(sector, &base, options));
        Ok(Self::new(sector, parts, options, base.sliding_direction))
    }
}

/// The dofs of the contact, ring by ring. Those of a ring are free to move along the normal, else they would not belong to it.
fn rings(sector: &SolidSector, base: &SolidSliding, options: &TangentOptions) -> WaveContact {
    let face = sector.specification.contact.face();
    let pressed = base.normal_forces.iter().map(|(node, _)| *node);
    let is_rigid = options.contact.normal_stiffness.is_none();
    let rigid = pressed.clone().filter(|_| is_rigid).map(|node| {
        let drag = base.friction(sector.nodes[node].radius).1.drag;
        let driven = vec![(3 * node + 1, face.inward_sign() * drag)];
        (3 * node + face.normal_component(), driven)
    });
    let places = sector.rings.iter();
    let dofs = |nodes: &Vec<usize>| nodes.iter().flat_map(|&node| 3 * node..3 * node + 3).collect();
    WaveContact {
        normal: face.normal_component(),
        places: places.map(|ring| dofs(&ring.nodes)).collect(),
        is_pressed: base.is_pressed.clone(),
        pairs: Vec::new(),
        rigid: rigid.collect(),
        pressed_nodes: pressed.collect(),
    }
}

/// What forces of the contact do that turn with their nodes: `N e_theta / r` on a cylinder and, for each unit of friction,
/// `-s N e_r / r` on both for each unit of `u_theta`.
fn turning_forces(sector: &SolidSector, base: &SolidSliding) -> [SectorMatrix; 2] {
    let is_cylinder = sector.specification.contact.face().normal_component() == 0;
    let forces = base.normal_forces.iter().map(|&(node, force)| {
        let radius = sector.nodes[node].radius;
        (3 * node, force / radius, base.friction(radius).1.drag)
    });
    let turning = forces.clone().filter(|_| is_cylinder);
    let turning = turning.map(|(dof, force, _)| (dof + 1, dof + 1, 0, -force));
    let dragging = forces.map(|(dof, force, drag)| (dof, dof + 1, 0, drag * force));
    [SectorMatrix::of_entries(3, turning), SectorMatrix::of_entries(3, dragging)]
}
