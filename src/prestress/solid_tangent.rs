//! The terms of a body of revolution in three dimensions in steady sliding.

use super::face_conditions::each_support;
use super::solid_contact::contact_terms;
use super::wave_tangent::{RegionTerms, SectorLayout, WaveContact, WaveTerms};
use super::{PrestressError, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::SlidingContact;
use crate::fem::fold::SectorMatrix;
use crate::fem::solid;
use crate::fem::{ElasticMaterial, MassKind, RayleighDamping};
use crate::mesh::SolidSector;

impl WaveTangent {
    /// Finds the steady sliding state of a body of revolution and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &ElasticMaterial,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let elastic = solid::stiffness(sector, material);
        let base = SolidSliding::solve(sector, &elastic, contact, options.contact.base_law())?;
        let stress = |displacement| solid::geometric_stiffness(sector, material, displacement);
        let (stress, turning) = match options.geometric_stiffness {
            true => (
                [&base.pressed_displacement, &base.sheared_displacement].map(|u| stress(u)),
                turning_forces(sector, &base),
            ),
            false => Default::default(),
        };
        let mass = solid::mass(sector, material, options.mass);
        let terms = WaveTerms {
            regions: vec![RegionTerms { mass, elastic, stress, damping: None }],
            supports: supports_of(sector),
            turning,
            contact: contact_terms(&base, sector, &options.contact),
        };
        let parts = (terms, rings(sector, &base, options));
        Ok(Self::new(layout(sector), parts, options, base.sliding_direction))
    }

    /// A body of revolution without contact and prestress.
    pub fn of_free_revolution(
        sector: &SolidSector,
        material: &ElasticMaterial,
        mass: MassKind,
        damping: RayleighDamping,
    ) -> Self {
        let matrices = [solid::mass(sector, material, mass), solid::stiffness(sector, material)];
        Self::alone(layout(sector), matrices, supports_of(sector), (mass, damping))
    }
}

fn layout(sector: &SolidSector) -> SectorLayout {
    SectorLayout {
        components: 3,
        nodes: sector.nodes.iter().map(|node| node.half_step).enumerate().collect(),
        dofs: solid::wave_dofs(sector),
    }
}

fn supports_of(sector: &SolidSector) -> Vec<(String, [SectorMatrix; 2])> {
    let all = each_support(sector).into_iter();
    all.map(|(name, own)| (name.to_owned(), own)).collect()
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
