//! The small motions of a body of equal sectors around its steady sliding.

use super::elimination::{Elimination, RigidFriction};
use super::tangent::ContactPart;
use super::terms::{Kind, Part, Terms};
use super::wave_tangent::WaveContact;
use super::{PrestressError, Result, SectorSliding, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::{Row, SlidingContact, turned};
use crate::fem::fold::WaveDofs;
use crate::fem::{DofMap, MassKind, MaterialField, RayleighDamping, Triplets};
use crate::linalg::FrictionWeights;
use crate::mesh::{SolidSector, Strip};
use std::collections::BTreeSet;

impl WaveTangent {
    /// The waves of the matrices of one sector and its contact.
    fn of(
        strip: &Strip,
        terms: Terms<Triplets>,
        (contact, sliding_direction): (WaveContact, f64),
        options: &TangentOptions,
    ) -> Self {
        // A node of the other body takes part in the motion of its pair, in the sectors beside as well.
        let half_bandwidth = strip.wave_dofs().half_bandwidth + 2 * contact.distances.len();
        let total = strip.dof_count();
        let mut basis = Elimination::holding(3 * total, []);
        let mut friction = Vec::new();
        // Rows reach into the sectors beside: its own, the next one and the one before.
        for sector in 0..3 {
            let there = |row: &Row| -> Row {
                row.iter().map(|&(dof, along)| (dof + sector * total, along)).collect()
            };
            for row in &contact.distances {
                basis.take(&there(row));
            }
            let own = contact.rigid.iter();
            friction.extend(own.map(|RigidFriction { lift, slip }| RigidFriction {
                lift: there(lift),
                slip: there(slip),
            }));
        }
        let (all, weights) = (basis.unknowns(), FrictionWeights::frozen_below(0.0));
        // T^T A T less mu times what normal forces do along slips, folded onto one sector.
        let terms = terms.map(|power, own| {
            let powers = basis.project((power, &own), &all, (&friction, weights));
            powers.iter().map(|own| strip.folded(own)).collect()
        });
        // In rigid contact normals stand still.
        let still: BTreeSet<usize> = contact.rigid.iter().map(|own| own.lift[0].0).collect();
        let moving = strip.free_dofs().filter(|dof| !still.contains(dof));
        let unknowns = DofMap::of(total, moving.collect());
        Self {
            dofs: WaveDofs::new(unknowns, half_bandwidth, strip.count),
            options: *options,
            components: strip.mesh.dimension,
            halves: strip.halves.clone(),
            terms,
            contact,
            sliding_direction,
        }
    }

    /// A body without contact and prestress, held by its supports or all of it free, `C = alpha_R M + beta_R K` and the dashpots
    /// of its supports.
    pub fn of_free(
        strip: &Strip,
        material: &dyn MaterialField,
        mass: MassKind,
        damping: RayleighDamping,
        is_held: bool,
    ) -> Self {
        let options = TangentOptions::of_free(mass, damping);
        let terms = Terms::of_mesh((&strip.mesh, material), !is_held, &options);
        let strip = if is_held { strip } else { &strip.unheld() };
        Self::of(strip, terms, (WaveContact::default(), 1.0), &options)
    }

    /// `sum weight T` of tangents that differ in matrices alone, with weights that sum up to zero: a difference quotient. What they
    /// have alike leaves no round-off. `None` where they differ in more.
    pub fn quotient(sides: &[(f64, &Self)]) -> Option<Self> {
        let first = sides.first()?.1;
        let is_alike = sides.iter().all(|(_, own)| {
            (own.sliding_direction, &own.contact) == (first.sliding_direction, &first.contact)
                && own.dofs == first.dofs
        });
        let mut sum = is_alike.then(|| first.clone())?;
        let terms: Vec<_> = sides.iter().map(|(weight, own)| (*weight, &own.terms)).collect();
        sum.terms.set_quotient(&terms).then_some(sum)
    }

    /// Finds the steady sliding state of one sector of an annulus and linearises around it, for each metre of thickness.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist.
    pub fn of_annulus(
        strip: &Strip,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self> {
        let terms = Terms::of_mesh((&strip.mesh, material), false, options);
        let elastic = alike(strip, &terms);
        let own = SectorSliding::solve(strip, &elastic, contact, options.contact.law)?;
        Ok(Self::around(&own, (strip, material), terms, (options, contact)))
    }

    /// Finds the steady sliding state of a body of revolution and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, or the rotor does not turn.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self> {
        if contact.rotation_speed == 0.0 {
            let problem = "contact.rotation_speed_rpm = 0: without sliding there is no steady sliding to study. Friction then holds a \
                           three-dimensional body across the sliding as an infinite dashpot (mu p / V) does. Give a speed";
            return Err(PrestressError::NoEquilibrium(problem.to_owned()));
        }
        let strip = &sector.strip;
        let terms = Terms::of_mesh((&strip.mesh, material), false, options);
        let (elastic, stiffness) = (alike(strip, &terms), &options.contact);
        let own = SolidSliding::solve(sector, &elastic, contact, stiffness, options.mass)?;
        Ok(Self::around(&own.sliding, (strip, material), terms, (options, contact)))
    }

    /// Small motions around steady sliding, with the `terms` of the bodies without stress and contact.
    fn around(
        base: &SectorSliding,
        (strip, material): (&Strip, &dyn MaterialField),
        mut terms: Terms<Triplets>,
        (options, contact): (&TangentOptions, &SlidingContact),
    ) -> Self {
        let SectorSliding { points, turnings, state, .. } = base;
        let (points_of_law, state_of_law) =
            base.on_face.as_ref().map_or((points, state), |own| (&own.0, &own.1));
        let part = ContactPart {
            points: points_of_law,
            turnings: &[], // The nodes turn, not these.
            state: state_of_law,
            first: 0,
            stiffness: options.contact,
            has_own_dofs: false,
        };
        part.add_to(&mut terms);
        if options.geometric_stiffness {
            terms.add_stress((&strip.mesh, material), &base.repeated(2)); // Elements reach into the next sector.
            terms.add(Part::Contact(0), Kind::Prestress, turned(points, turnings, (state, 0)));
        }
        // The dofs of the contact; those of a place are free to move along the normal.
        let components = strip.mesh.dimension;
        let is_rigid = options.contact.normal_stiffness.is_none() && options.contact.law.is_none();
        let rigid = points.iter().filter(|_| is_rigid).map(RigidFriction::of);
        let distances = points.iter().map(|point| &point.normal).filter(|row| row.len() > 1); // One dof alone is no distance.
        // Along the sliding, in space across it, and along the normal.
        let normal = points[0].normal[0].0 % components;
        let nodes = points.iter().flat_map(|point| &point.normal).map(|own| own.0 / components);
        let pressed = nodes.flat_map(|node| {
            let across = (components == 3).then_some(2 - normal); // e_z on a cylinder, e_r on a face.
            let own = [1].into_iter().chain(across).chain([normal]);
            own.map(move |component| components * node + component)
        });
        let dofs = |nodes: &Vec<usize>| {
            nodes.iter().flat_map(|node| components * node..components * (node + 1)).collect()
        };
        let touching = WaveContact {
            places: base.places.iter().map(dofs).collect(),
            distances: distances.cloned().collect(),
            rigid: rigid.collect(),
            pressed: pressed.collect(),
            is_pressed: base.is_pressed.clone(),
        };
        Self::of(strip, terms, (touching, contact.sliding_direction()), options)
    }
}

/// [`Strip::stiffness_alike`] of regions and supports.
fn alike(strip: &Strip, terms: &Terms<Triplets>) -> Triplets {
    let elastic = terms.all.iter().filter(|term| term.kind == Kind::Stiffness);
    strip.alike(elastic.map(|term| &term.matrix))
}
