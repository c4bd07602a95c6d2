//! The terms of a plane annulus in steady sliding.

use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SectorSliding, TangentOptions, WaveTangent};
use crate::contact::{Point, Row, SlidingContact, Turning, scaled};
use crate::fem::MaterialField;
use crate::fem::fold::dof_ahead;
use crate::fem::sector::Sectored;
use crate::mesh::SectorMesh;
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
        let mut terms =
            WaveTerms::of_sector(sector, material, options, sector.supports(options.mass));
        let base = SectorSliding::of(sector, &terms.alike(), contact, options.contact.law)?;
        let edge = Edge { sector, base: &base };
        if options.geometric_stiffness {
            terms.take_stress(sector, material, [0, 1].map(|p| &base.state.displacements[p][..]));
            terms.add_turning(sector, (&base.points, &edge.turnings(), &base.state));
        }
        edge.add_terms(options, &mut terms);
        let (own, parts) = ((sector, sector.wave_dofs()), (terms, edge.dofs(options)));
        Ok(Self::new(own, parts, options, contact.sliding_direction()))
    }
}

/// The contact edge of a sector in steady sliding.
struct Edge<'a> {
    sector: &'a SectorMesh,
    base: &'a SectorSliding,
}

impl Edge<'_> {
    fn dofs(&self, options: &TangentOptions) -> WaveContact {
        let nodes = self.sector.contact_nodes();
        let has_springs = !self.base.state.stiffnesses.is_empty();
        let is_rigid = options.contact.normal_stiffness.is_none() && !has_springs;
        let rigid = self
            .base
            .points
            .iter()
            .filter(|_| is_rigid)
            .map(|point| (point.normal[0].0, scaled(&point.slip, point.friction.drag)));
        let both = |node: usize| std::iter::once(node).chain(self.sector.opposite(node));
        let place = |node| both(node).flat_map(|node| [2 * node, 2 * node + 1]).collect();
        let pairs = nodes.clone().filter_map(|n| Some([2 * n, 2 * self.sector.opposite(n)?]));
        WaveContact {
            normal: 0,
            places: nodes.clone().map(place).collect(),
            is_pressed: vec![true; nodes.len()],
            pairs: pairs.collect(),
            rigid: rigid.collect(),
            pressed_nodes: nodes.flat_map(both).collect(),
        }
    }

    /// Adds the contact over the distances across it: of a pair that of the annulus's node stands for its separation.
    fn add_terms(&self, options: &TangentOptions, terms: &mut WaveTerms) {
        let over_distance =
            |point: &Point| Point { normal: point.normal[..1].to_vec(), ..point.clone() };
        let points: Vec<Point> = self.base.points.iter().map(over_distance).collect();
        terms.add_points(self.sector, (&points, &self.base.state), &options.contact);
    }

    /// How the contact turns: on a rigid cylinder with the angle `u_t / a`. Of two bodies it stays normal to the common surface, at the
    /// place of the annulus's node: with the derivatives along the arc of the shaft's displacement, `u_n' - u_t / a` and
    /// `u_t' + u_n / a`.
    fn turnings(&self) -> Vec<Turning> {
        let (sector, slopes) = (self.sector, self.slopes());
        let (curvature, dofs) = (1.0 / sector.specification.inner_radius, sector.dofs());
        let shaft = |i: usize| sector.opposite(sector.contact_start + i).map(|node| 2 * node);
        let turning = |i: usize| {
            let own = shaft(i).into_iter();
            let mut tilt: Row = own.clone().map(|dof| (dof + 1, -curvature)).collect();
            let mut stretch: Row = own.map(|dof| (dof, curvature)).collect();
            for &(_, j, ahead, slope) in slopes.iter().filter(|own| own.0 == i) {
                if let Some(dof) = shaft(j) {
                    tilt.push((dof_ahead(dof, ahead, dofs), curvature * slope));
                    stretch.push((dof_ahead(dof + 1, ahead, dofs), curvature * slope));
                }
            }
            Turning::along(curvature, [tilt, stretch])
        };
        (0..sector.contact_count).map(turning).collect()
    }

    /// Derivative along the angle at the contact nodes, `u'_i = sum d_ij u_j`, the mean of both elements' at a corner:
    /// `(i, j, halves of a sector from i to j, d_ij)`.
    fn slopes(&self) -> Vec<(usize, usize, isize, f64)> {
        let share = self.sector.sector_count() as f64 / (4.0 * PI);
        let differences = match self.sector.contact_count {
            1 => vec![(0, 0, 2, share)],
            _ => vec![(0, 0, 2, -share), (0, 1, 1, 4.0 * share), (1, 0, 1, 2.0 * share)],
        };
        differences.into_iter().flat_map(|(i, j, k, d)| [(i, j, k, d), (i, j, -k, -d)]).collect()
    }
}
