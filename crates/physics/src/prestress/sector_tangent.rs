//! The small motions of a body of equal sectors around its steady sliding.

use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SectorSliding, SolidSliding, TangentOptions, WaveTangent};
use crate::contact::{Point, PressedState, Row, SlidingContact, Turning, arc_stencil, scaled};
use crate::fem::MaterialField;
use crate::fem::fold::dof_ahead;
use crate::mesh::{SectorMesh, SolidSector, Strip};
use std::f64::consts::PI;

impl WaveTangent {
    /// Finds the steady sliding state of one sector of an annulus and linearises around it, for each metre of thickness.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist.
    pub fn of_annulus(
        sector: &SectorMesh,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let terms = WaveTerms::of_strip(&sector.strip, material, options, false);
        let base = SectorSliding::of(sector, &terms.alike(), contact, options.contact.law)?;
        let touching = Touching::edge(sector, base);
        Ok(touching.tangent((&sector.strip, material), terms, (options, contact)))
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
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let terms = WaveTerms::of_strip(&sector.strip, material, options, false);
        let stiffness = &options.contact;
        let base = SolidSliding::of(sector, &terms.alike(), contact, stiffness, options.mass)?;
        let touching = Touching::face(sector, base);
        Ok(touching.tangent((&sector.strip, material), terms, (options, contact)))
    }
}

/// The contact of one sector in steady sliding.
struct Touching {
    base: SectorSliding,
    /// How its points turn.
    turnings: Vec<Turning>,
    /// The points at which the law of the contact acts, and their state.
    points: Vec<Point>,
    state: PressedState,
    /// Nodes of each place of the contact, the other body's behind its own, and whether it is pressed.
    places: Vec<Vec<usize>>,
    is_pressed: Vec<bool>,
}

impl Touching {
    /// The contact edge of an annulus, which acts over the distances across it: of a pair that of the annulus's node stands for its
    /// separation.
    fn edge(sector: &SectorMesh, base: SectorSliding) -> Self {
        let over_distance =
            |point: &Point| Point { normal: point.normal[..1].to_vec(), ..point.clone() };
        let nodes = sector.contact_nodes();
        let both = |node: usize| [node].into_iter().chain(sector.opposite(node)).collect();
        Self {
            turnings: turnings_of_edge(sector),
            points: base.points.iter().map(over_distance).collect(),
            state: base.state.clone(),
            is_pressed: base.state.is_pressed.clone(),
            places: nodes.map(both).collect(),
            base,
        }
    }

    /// The face of a body of revolution, ring by ring. It turns about the axis on a cylinder, while on a face it is the sliding
    /// that does.
    fn face(sector: &SolidSector, own: SolidSliding) -> Self {
        let is_cylinder = sector.specification.contact.face().normal_component() == 0;
        let turning = |point: &Point| {
            let curvature = 1.0 / sector.nodes[point.normal[0].0 / 3].radius;
            match is_cylinder {
                true => Turning::along(curvature, Default::default()),
                false => Turning { veer: scaled(&point.slip, -curvature), ..Turning::default() },
            }
        };
        let (points, state) = own.points(sector);
        Self {
            turnings: own.sliding.points.iter().map(turning).collect(),
            points,
            state,
            places: sector.rings.iter().map(|ring| ring.nodes.clone()).collect(),
            is_pressed: own.is_pressed,
            base: own.sliding,
        }
    }

    fn tangent(
        self,
        (strip, material): (&Strip, &dyn MaterialField),
        mut terms: WaveTerms,
        (options, contact): (&TangentOptions, &SlidingContact),
    ) -> WaveTangent {
        let SectorSliding { points, state } = &self.base;
        if options.geometric_stiffness {
            terms.take_stress(strip, material, state);
            terms.add_turning(strip, (points, &self.turnings, state));
        }
        terms.add_points(strip, (&self.points, &self.state), &options.contact);
        let dofs = self.dofs(strip.mesh.dimension, options);
        WaveTangent::new(strip, (terms, dofs), options, contact.sliding_direction())
    }

    /// The dofs of the contact; those of a place are free to move along the normal.
    fn dofs(self, components: usize, options: &TangentOptions) -> WaveContact {
        let SectorSliding { points, .. } = &self.base;
        let is_rigid = options.contact.normal_stiffness.is_none() && options.contact.law.is_none();
        let rigid = points.iter().filter(|_| is_rigid).map(|point| {
            let (normal, along) = point.normal[0];
            (normal, scaled(&point.slip, along * point.friction.drag))
        });
        let pairs = points.iter().filter_map(|point| match point.normal[..] {
            [(own, _), (other, _)] => Some([own, other]),
            _ => None,
        });
        let nodes = points.iter().flat_map(|point| &point.normal).map(|own| own.0 / components);
        let dofs = |nodes: &Vec<usize>| {
            nodes.iter().flat_map(|node| components * node..components * (node + 1)).collect()
        };
        WaveContact {
            normal: points[0].normal[0].0 % components,
            places: self.places.iter().map(dofs).collect(),
            pairs: pairs.collect(),
            rigid: rigid.collect(),
            pressed_nodes: nodes.collect(),
            is_pressed: self.is_pressed,
        }
    }
}

/// How the contact edge of an annulus turns: on a rigid cylinder with the angle `u_t / a`. Of two bodies it stays normal to the
/// common surface, at the place of the annulus's node: with the derivatives along the arc of the shaft's displacement,
/// `u_n' - u_t / a` and `u_t' + u_n / a`.
fn turnings_of_edge(sector: &SectorMesh) -> Vec<Turning> {
    let (first, count) = (sector.contact_nodes().start, sector.contact_nodes().len());
    let curvature = 1.0 / sector.specification.inner_radius;
    let per_arc = (count * sector.strip.count) as f64 / (2.0 * PI) * curvature;
    let shaft = |i: usize| sector.opposite(first + i).map(|node| 2 * node);
    let turning = |i: usize| {
        let own = shaft(i).into_iter();
        let mut tilt: Row = own.clone().map(|dof| (dof + 1, -curvature)).collect();
        let mut stretch: Row = own.map(|dof| (dof, curvature)).collect();
        for &(offset, weight) in arc_stencil(count > 1, i) {
            let other = (i as isize + offset).rem_euclid(count as isize) as usize;
            let ahead = |dof| dof_ahead(dof, 2 * offset / count as isize, sector.strip.dof_count());
            if let Some(dof) = shaft(other) {
                tilt.push((ahead(dof), weight * per_arc));
                stretch.push((ahead(dof + 1), weight * per_arc));
            }
        }
        Turning::along(curvature, [tilt, stretch])
    };
    (0..count).map(turning).collect()
}
