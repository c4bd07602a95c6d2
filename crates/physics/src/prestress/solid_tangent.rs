//! The terms of a body of revolution in three dimensions in steady sliding.

use super::terms::{Kind, Part};
use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::{ContactStiffness, SlidingContact};
use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
use crate::fem::sector::Sectored;
use crate::fem::solid::{FaceTerm, face_matrix};
use crate::mesh::{FaceElement, SolidSector};

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
        let mut terms =
            WaveTerms::of_sector(sector, material, options, sector.supports(options.mass));
        let stiffness = &options.contact;
        let base = SolidSliding::of(sector, &terms.alike(), contact, stiffness, options.mass)?;
        if options.geometric_stiffness {
            let displacements = [&base.pressed_displacement[..], &base.sheared_displacement];
            terms.take_stress(sector, material, displacements);
            terms.add(Part::Contact(0), Kind::Prestress, turning_forces(sector, &base));
        }
        add_contact(&base, sector, &options.contact, &mut terms);
        let (own, parts) = ((sector, sector.wave_dofs()), (terms, rings(sector, &base, options)));
        Ok(Self::new(own, parts, options, contact.sliding_direction()))
    }
}

/// The dofs of the contact, ring by ring. Those of a ring are free to move along the normal, else they would not belong to it.
fn rings(sector: &SolidSector, base: &SolidSliding, options: &TangentOptions) -> WaveContact {
    let face = sector.specification.contact.face();
    let pressed = base.normal_forces.iter().map(|(node, _)| *node);
    let is_rigid = options.contact.normal_stiffness.is_none();
    let rigid = pressed.clone().filter(|_| is_rigid).map(|node| {
        let drag = base.friction(sector.nodes[node].radius).1.drag;
        (3 * node + face.normal_component(), vec![(3 * node + 1, face.inward_sign() * drag)])
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

/// A weight from the element, the radius (m) and the place along the element.
type Weight<'a> = &'a dyn Fn(&FaceElement, f64, f64) -> f64;

/// Adds the matrices of the contact of a state.
fn add_contact(
    base: &SolidSliding,
    sector: &SolidSector,
    contact: &ContactStiffness,
    terms: &mut WaveTerms,
) {
    let face = sector.specification.contact.face();
    let (normal, side) = (face.normal_component(), face.across_component());
    let faces = sector.contact_elements();
    let span = |element: &FaceElement| base.pressed_span(sector, element);
    let term = |row, column, weight: Weight<'_>| {
        let term = FaceTerm { row, column, weight, span: &span, rule: base.rule };
        face_matrix(sector, &faces, &term)
    };
    let pressure = |element: &FaceElement, at| base.pressure_along(sector, element, at);
    let pressed = |row, column, weight: Weight<'_>| {
        term(row, column, &|element, r, at| match pressure(element, at) > 0.0 {
            true => weight(element, r, at),
            false => 0.0,
        })
    };

    // What acts along the normal is dragged along by friction.
    let drag = |r: f64| face.inward_sign() * base.friction(r).1.drag;
    let normal_and_drag = |weight: Weight<'_>| {
        let dragged = |element: &FaceElement, r: f64, at: f64| weight(element, r, at) * drag(r);
        [pressed(normal, normal, weight), pressed(1, normal, &dragged)]
    };
    let mut dashpots: [SectorMatrix; 2] = match contact.normal_damping {
        0.0 => Default::default(),
        damping => normal_and_drag(&|_, _, _| damping),
    };
    let tangential = contact.tangential_damping;
    if tangential != 0.0 {
        for component in [1, side] {
            dashpots[0] = dashpots[0].plus(&pressed(component, component, &|_, _, _| tangential));
        }
    }

    // Coulomb's law as a vector, and its slope over the speed.
    let mut friction_dashpots = term(side, side, &|element, r, at| {
        let (speed, friction) = base.friction(r);
        pressure(element, at) * friction.drag * base.contact.sliding_direction() / speed
    });
    if base.contact.decay.is_some() {
        let slope = |r: f64| base.friction(r).1.slope;
        let along = term(1, 1, &|element, r, at| pressure(element, at) * slope(r));
        friction_dashpots = friction_dashpots.plus(&along);
    }
    let penalty = match (base.law, contact.normal_stiffness) {
        (Some(law), _) => normal_and_drag(&|element, _, at| {
            law.stiffness(base.approach_along(sector, element, at))
        }),
        (None, Some(own)) => normal_and_drag(&|_, _, _| own),
        (None, None) => Default::default(),
    };
    terms.add(Part::Contact(0), Kind::Stiffness, penalty);
    terms.add(Part::Contact(0), Kind::Dashpots, dashpots);
    terms.add(Part::Contact(0), Kind::FrictionDashpots, [friction_dashpots]);
}
