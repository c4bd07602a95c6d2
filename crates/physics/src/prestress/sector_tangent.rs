//! The small motions of a body of equal sectors around its steady sliding.

use super::elimination::{Elimination, RigidFriction};
use super::tangent::ContactPart;
use super::terms::{Kind, Part, Terms};
use super::wave_tangent::WaveContact;
use super::{PrestressError, Result, SectorSliding, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::{
    ContactInterface, Point, PressedState, Row, SlidingContact, Turning, scaled, turned,
};
use crate::fem::fold::WaveDofs;
use crate::fem::{DofMap, MassKind, MaterialField, RayleighDamping, Triplets};
use crate::linalg::FrictionWeights;
use crate::mesh::{SolidSector, Strip};
use std::collections::BTreeSet;

/// The matrices of one sector before they are those of waves.
#[derive(Clone, Debug)]
pub struct SectorTangent {
    pub(super) strip: Strip,
    pub(super) terms: Terms<Triplets>,
    /// The contact of the sector.
    pub contact: WaveContact,
    pub(super) options: TangentOptions,
    pub(super) sliding_direction: f64,
}

impl WaveTangent {
    /// A body without contact and prestress, held by its supports or all of it free, `C = alpha_R M + beta_R K` and the dashpots
    /// of its supports.
    pub fn of_free(
        strip: &Strip,
        material: &dyn MaterialField,
        mass: MassKind,
        damping: RayleighDamping,
        is_held: bool,
    ) -> Self {
        let (options, contact) = (TangentOptions::of_free(mass, damping), WaveContact::default());
        let terms = Terms::of_mesh((&strip.mesh, material), !is_held, &options);
        let strip = if is_held { strip.clone() } else { strip.unheld() };
        SectorTangent { strip, terms, contact, options, sliding_direction: 1.0 }.waves()
    }
}

impl SectorTangent {
    /// That of waves around the body.
    pub fn waves(self) -> WaveTangent {
        let Self { strip, terms, contact, options, sliding_direction } = self;
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
        WaveTangent {
            dofs: WaveDofs::new(unknowns, half_bandwidth, strip.count),
            options,
            components: strip.mesh.dimension,
            halves: strip.halves.clone(),
            terms,
            contact,
            sliding_direction,
        }
    }

    /// `sum weight T` of tangents that differ in matrices alone, with weights that sum up to zero: a difference quotient. What they
    /// have alike leaves no round-off. `None` where they differ in more.
    pub fn quotient(sides: &[(f64, &Self)]) -> Option<WaveTangent> {
        let first = sides.first()?.1;
        fn shape(own: &SectorTangent) -> (f64, &WaveContact, WaveDofs) {
            (own.sliding_direction, &own.contact, own.strip.wave_dofs())
        }
        let is_alike = sides.iter().all(|(_, own)| shape(own) == shape(first));
        let terms: Vec<_> = sides.iter().map(|(weight, own)| (*weight, &own.terms)).collect();
        let terms = Terms::quotient(&terms).filter(|_| is_alike)?;
        Some(Self { terms, ..first.clone() }.waves())
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
        let base =
            SectorSliding::solve(strip, &alike(strip, &terms), contact, options.contact.law)?;
        let nodes = |point: &Point| point.normal.iter().map(|own| own.0 / 2).collect(); // Two dofs a node.
        let touching = Touching {
            turnings: ContactInterface::of_sector(strip).turnings(),
            places: base.points.iter().map(nodes).collect(),
            is_pressed: base.state.is_pressed.clone(),
            law: (base.points.clone(), base.state.clone()),
            base,
        };
        Ok(touching.tangent((strip, material), terms, (options, contact)))
    }

    /// Finds the steady sliding state of a body of revolution and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let strip = &sector.strip;
        let terms = Terms::of_mesh((&strip.mesh, material), false, options);
        let (elastic, stiffness) = (alike(strip, &terms), &options.contact);
        let own = SolidSliding::solve(sector, &elastic, contact, stiffness, options.mass)?;
        // It turns about the axis on a cylinder, while on a face it is the sliding that does.
        let is_cylinder = sector.specification.contact.face().normal_component() == 0;
        let turning = |point: &Point| {
            let curvature = 1.0 / sector.nodes[point.normal[0].0 / 3].radius;
            match is_cylinder {
                true => Turning::along(curvature, Default::default()),
                false => Turning { veer: scaled(&point.slip, -curvature), ..Turning::default() },
            }
        };
        let touching = Touching {
            turnings: own.sliding.points.iter().map(turning).collect(),
            law: own.points(sector),
            places: sector.rings.iter().map(|ring| ring.nodes.clone()).collect(),
            is_pressed: own.is_pressed,
            base: own.sliding,
        };
        Ok(touching.tangent((strip, material), terms, (options, contact)))
    }
}

/// [`Strip::stiffness_alike`] of regions and supports.
fn alike(strip: &Strip, terms: &Terms<Triplets>) -> Triplets {
    let elastic = terms.all.iter().filter(|term| term.kind == Kind::Stiffness);
    strip.alike(elastic.map(|term| &term.matrix))
}

/// The contact of one sector in steady sliding.
struct Touching {
    base: SectorSliding,
    /// How its points turn.
    turnings: Vec<Turning>,
    /// The points at which the law of the contact acts, and their state.
    law: (Vec<Point>, PressedState),
    /// Nodes of each place of the contact, the other body's behind its own, and whether it is pressed.
    places: Vec<Vec<usize>>,
    is_pressed: Vec<bool>,
}

impl Touching {
    fn tangent(
        self,
        (strip, material): (&Strip, &dyn MaterialField),
        mut terms: Terms<Triplets>,
        (options, contact): (&TangentOptions, &SlidingContact),
    ) -> SectorTangent {
        let (points, state) = &self.law;
        let stiffness = options.contact;
        let part =
            ContactPart { points, turnings: &[], state, first: 0, stiffness, has_own_dofs: false }; // The nodes turn, not these.
        part.add_to(&mut terms);
        if options.geometric_stiffness {
            let SectorSliding { points, state } = &self.base;
            terms.add_stress((&strip.mesh, material), &self.base.repeated(2)); // Elements reach into the next sector.
            let turned = turned(points, &self.turnings, (state, 0));
            terms.add(Part::Contact(0), Kind::Prestress, turned);
        }
        let dofs = self.dofs(strip.mesh.dimension, options);
        let (strip, sliding_direction) = (strip.clone(), contact.sliding_direction());
        SectorTangent { strip, terms, contact: dofs, options: *options, sliding_direction }
    }

    /// The dofs of the contact; those of a place are free to move along the normal.
    fn dofs(self, components: usize, options: &TangentOptions) -> WaveContact {
        let SectorSliding { points, .. } = &self.base;
        let is_rigid = options.contact.normal_stiffness.is_none() && options.contact.law.is_none();
        let rigid = points.iter().filter(|_| is_rigid).map(RigidFriction::of);
        let distances = points.iter().map(|point| &point.normal).filter(|row| row.len() > 1); // One dof alone is no distance.
        let nodes = points.iter().flat_map(|point| &point.normal).map(|own| own.0 / components);
        let dofs = |nodes: &Vec<usize>| {
            nodes.iter().flat_map(|node| components * node..components * (node + 1)).collect()
        };
        WaveContact {
            normal: points[0].normal[0].0 % components,
            places: self.places.iter().map(dofs).collect(),
            distances: distances.cloned().collect(),
            rigid: rigid.collect(),
            pressed_nodes: nodes.collect(),
            is_pressed: self.is_pressed,
        }
    }
}
