//! The terms of a plane annulus in steady sliding.

use super::solid_contact::ContactTerms;
use super::wave_tangent::WaveContact;
use super::wave_terms::WaveTerms;
use super::{PrestressError, SectorSliding, TangentOptions, WaveTangent};
use crate::contact::SlidingContact;
use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
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
        let mut terms = WaveTerms::of(sector, material, (options.mass, options.damping));
        let base = SectorSliding::solve(sector, &terms.elastic(), contact, options.contact.law)?;
        let edge = Edge { sector, base: &base };
        if options.geometric_stiffness {
            let displacements = [0, 1].map(|power| &base.state.displacements[power][..]);
            terms.take_stress(sector, material, displacements);
            terms.turning = edge.turning();
        }
        terms.contact = edge.terms(options);
        let parts = (terms, edge.dofs(options));
        Ok(Self::new(sector, parts, options, base.sliding_direction))
    }
}

/// The contact edge of a sector in steady sliding.
struct Edge<'a> {
    sector: &'a SectorMesh,
    base: &'a SectorSliding,
}

impl Edge<'_> {
    /// Stiffness `k_n w` of each contact node; `None` for rigid contact.
    fn normal_stiffness(&self, options: &TangentOptions) -> Option<Vec<f64>> {
        let penalty = options.contact.normal_stiffness.map(|k| self.over_lengths(k));
        self.base.state.stiffnesses.first().cloned().or(penalty)
    }

    /// A value per length at each contact node.
    fn over_lengths(&self, value: f64) -> Vec<f64> {
        self.sector.tributary_lengths().iter().map(|w| value * w).collect()
    }

    /// Slip at a contact node as `(dof, coefficient)`.
    fn slip(&self, node: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let opposite = self.sector.opposite(node);
        std::iter::once((2 * node + 1, 1.0)).chain(opposite.map(|node| (2 * node + 1, -1.0)))
    }

    fn dofs(&self, options: &TangentOptions) -> WaveContact {
        let nodes = self.sector.contact_nodes();
        let is_rigid = self.normal_stiffness(options).is_none();
        let rigid = nodes.clone().filter(|_| is_rigid).map(|node| {
            let drags = self.slip(node).map(|(dof, along)| (dof, self.base.friction.drag * along));
            (2 * node, drags.collect())
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

    /// The contact over the distances across it.
    fn terms(&self, options: &TangentOptions) -> ContactTerms {
        let contact = options.contact;
        let nodes = || self.sector.contact_nodes();
        let along_slip = |values: &[f64]| {
            let own = nodes().zip(values).flat_map(|(node, &value)| {
                let rows = self.slip(node);
                rows.flat_map(move |(row, a)| {
                    self.slip(node).map(move |(column, b)| (row, column, 0, a * value * b))
                })
            });
            SectorMatrix::of_entries(2, own)
        };
        // What acts along the normal is dragged along by friction.
        let normal_and_drag = |values: &[f64]| {
            let normal = nodes().zip(values).map(|(node, value)| (2 * node, 2 * node, 0, *value));
            let dragged = nodes().zip(values).flat_map(|(node, value)| {
                let value = self.base.friction.drag * value;
                self.slip(node).map(move |(row, along)| (row, 2 * node, 0, along * value))
            });
            [SectorMatrix::of_entries(2, normal), SectorMatrix::of_entries(2, dragged)]
        };
        let [normal, drag] = normal_and_drag(&self.over_lengths(contact.normal_damping));
        let tangential = along_slip(&self.over_lengths(contact.tangential_damping));
        let slope = self.base.friction.slope;
        let falling: Vec<f64> =
            self.base.state.normal_forces[0].iter().map(|n| slope * n).collect();
        let penalty = self.normal_stiffness(options);
        ContactTerms {
            penalty: penalty.map_or_else(Default::default, |values| normal_and_drag(&values)),
            dashpots: [normal.plus(&tangential), drag],
            friction_dashpots: along_slip(&falling),
        }
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
        let both = differences.into_iter();
        both.flat_map(|(i, j, k, d)| [(i, j, k, d), (i, j, -k, -d)]).collect()
    }
}
