//! The terms of a plane annulus in steady sliding.

use super::terms::{Kind, Part};
use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SectorSliding, TangentOptions, WaveTangent};
use crate::contact::{Point, SlidingContact};
use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
use crate::fem::sector::Sectored;
use crate::mesh::SectorMesh;
use std::f64::consts::PI;

/// An entry of a matrix of a sector, see [`SectorMatrix::of_entries`].
type Entry = (usize, usize, isize, f64);

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
            terms.add(Part::Contact(0), Kind::Prestress, edge.turning());
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
        let rigid = self.base.points.iter().filter(|_| is_rigid).map(|point| {
            let drag = |&(dof, along): &(usize, f64)| (dof, point.friction.drag * along);
            (point.normal[0].0, point.slip.iter().map(drag).collect())
        });
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
        terms.add_points((&points, &self.base.state), &options.contact, |own| {
            let entries = own.entries.iter().map(|&(row, column, value)| (row, column, 0, value));
            SectorMatrix::of_entries(2, entries)
        });
    }

    /// What the normal forces of the base state, and the friction `T = s mu N`, add to the stiffness as they turn and move with
    /// the edge.
    ///
    /// On a rigid cylinder they turn with the angle `u_t / a`. Of two bodies they stay normal to the common surface, at the
    /// place of the annulus's node: with `'` the derivative along the angle, `s` the annulus and `m` the shaft,
    ///
    /// ```text
    /// dF_t,s = (N / a) (u_s - u_n'),   dF_t,m = -(N / a) (u_m - u_n'),   dF_n,m = -(N / a) D^T (u_s - u_m)
    /// dF_n,s = -(T / a) (u_s - u_n'),  dF_n,m = (T / a) (u_m - u_n'),    dF_t,m = -(T / a) D^T (u_s - u_m)
    /// ```
    ///
    /// the first line symmetric, and zero under a rigid motion but for what the turned stress balances.
    fn turning(&self) -> [SectorMatrix; 2] {
        let radius = self.sector.specification.inner_radius;
        let turning: Vec<f64> =
            self.base.state.normal_forces[0].iter().map(|n| n / radius).collect();
        let drag = self.base.friction.drag;
        let (mut pressure, mut friction): (Vec<Entry>, Vec<Entry>) = (Vec::new(), Vec::new());
        for (node, value) in self.sector.contact_nodes().zip(&turning) {
            let own = [(node, 1.0)].into_iter();
            for (node, sign) in own.chain(self.sector.opposite(node).map(|node| (node, -1.0))) {
                pressure.push((2 * node + 1, 2 * node + 1, 0, -sign * value));
                friction.push((2 * node, 2 * node + 1, 0, sign * drag * value));
            }
        }
        for (i, j, ahead, slope) in self.slopes() {
            let node = self.sector.contact_start + i;
            let other = self.sector.opposite(self.sector.contact_start + j);
            let (Some(opposite), Some(other)) = (self.sector.opposite(node), other) else {
                continue;
            };
            let value = turning[i] * slope;
            for (node, value) in [(node, value), (opposite, -value)] {
                pressure.push((2 * node + 1, 2 * other, ahead, value));
                pressure.push((2 * other, 2 * node + 1, -ahead, value));
                friction.push((2 * node, 2 * other, ahead, -drag * value));
                friction.push((2 * other + 1, 2 * node + 1, -ahead, drag * value));
            }
        }
        [pressure, friction].map(|entries| SectorMatrix::of_entries(2, entries))
    }

    /// Derivative along the angle at the contact nodes, `u'_i = sum d_ij u_j`, the mean of both elements' at a corner:
    /// `(i, j, halves of a sector from i to j, d_ij)`.
    fn slopes(&self) -> Vec<Entry> {
        let share = self.sector.sector_count() as f64 / (4.0 * PI);
        let differences = match self.sector.contact_count {
            1 => vec![(0, 0, 2, share)],
            _ => vec![(0, 0, 2, -share), (0, 1, 1, 4.0 * share), (1, 0, 1, 2.0 * share)],
        };
        differences.into_iter().flat_map(|(i, j, k, d)| [(i, j, k, d), (i, j, -k, -d)]).collect()
    }
}
