//! How the forces of the base state turn with the surfaces.

use super::linearized::{Products, power, sums};
use super::{
    ContactInterface, ContactSurface, Counterpart, Point, PressedState, Row, row_along, scaled,
    summed,
};
use crate::fem::Triplets;
use crate::linalg::FrictionWeights;
use crate::mesh::Mesh;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// How the directions at a contact point turn with small motions, along the sliding `t` and across it `d`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Turning {
    /// Rows of the slopes `eta` of the counterface's displacement along the normal, by arc along `t` and `d`, 1/m; empty on a rigid one.
    pub tilt: [Row; 2],
    /// Rows of the slopes `epsilon` of its displacement along `t`, 1/m.
    pub stretch: [Row; 2],
    /// Row of the turn of the sliding within the surface, `d . (grad V) u / V`, 1/m.
    pub veer: Row,
    /// Rates `kappa` at which the normal turns towards `t` and `d` as the point moves along them, 1/m.
    pub curvature: [[f64; 2]; 2],
}

impl Turning {
    /// On a line along the sliding with a curvature, 1/m, and the slopes of what the point meets there.
    pub fn along(curvature: f64, [tilt, stretch]: [Row; 2]) -> Self {
        Self {
            tilt: [tilt, Row::new()],
            stretch: [stretch, Row::new()],
            veer: Row::new(),
            curvature: [[curvature, 0.0], [0.0; 2]],
        }
    }
}

/// Forces at `points` of the base state, among whose points they begin at `first`, that turn as `turnings` say, by power of `mu`,
/// moved to the left-hand side.
///
/// The normal is that of the surface that the point meets, `theta` its turn there; with `w` the separation, `xi` the slip
/// along and across, `delta` the turn of the sliding,
///
/// ```text
/// theta_a = sum_b kappa_ab xi_b - eta_a
/// N: sum_a (xi_a eta_a + eta_a xi_a) - sum_ab kappa_ab xi_a xi_b
/// T: w theta_t + sum_a epsilon_a xi_a - xi_d delta
/// ```
///
/// as products of a row and a column: the second derivatives of the separation, and the friction along the counterface and at
/// its place. With the geometric stiffness they leave a rotation of everything, sliding included, without force. Shape: sums
/// over all dofs of both bodies, N/m.
pub fn turned(
    points: &[Point],
    turnings: &[Turning],
    (state, first): (&PressedState, usize),
) -> Vec<Triplets> {
    // The columns of the slips and of the normal, which combine rows.
    let columns = points.iter().zip(turnings).map(|(point, Turning { tilt, curvature, .. })| {
        let bent = |kappa: [f64; 2], eta: &Row| {
            let rows = [(&point.slip, -kappa[0]), (&point.across, -kappa[1]), (eta, 1.0)];
            summed(rows.into_iter().flat_map(|(row, factor)| scaled(row, factor)))
        };
        [0, 1].map(|a| bent(curvature[a], &tilt[a]))
    });
    let columns: Vec<[Row; 2]> = columns.collect();
    let mut products = Products::new();
    let weights = FrictionWeights::frozen_below(state.frozen_below);
    for (p, forces) in state.normal_forces.iter().enumerate() {
        let place = weights.place(p);
        for (i, (point, own)) in points.iter().zip(turnings).enumerate() {
            let ([t, d], [along, across]) = ([&point.slip, &point.across], &columns[i]);
            let ([tilt_t, tilt_d], [stretch_t, stretch_d]) = (&own.tilt, &own.stretch);
            let force = forces[first + i];
            let pressed = [(t, along), (d, across), (tilt_t, t), (tilt_d, d)];
            let pressed = pressed.map(|(row, column)| (force, &row[..], &column[..]));
            power(&mut products, place).extend(pressed);
            for (term, factor) in weights.times_mu(place) {
                let drag = factor * force * point.friction.drag;
                power(&mut products, term).extend([
                    (-drag, &point.normal[..], &along[..]),
                    (drag, stretch_t, t),
                    (drag, stretch_d, d),
                    (-drag, d, &own.veer),
                ]);
            }
        }
    }
    sums(&products)
}

impl ContactInterface {
    /// How its points turn; nothing is across in the plane.
    pub fn turnings(&self) -> Vec<Turning> {
        let curvature = self.counterface.curvature();
        let turning = |i: usize| {
            Turning::along(curvature, self.opposite.get(i).cloned().unwrap_or_default().slopes)
        };
        (0..self.len()).map(turning).collect()
    }
}

impl ContactSurface {
    /// How its points turn on what they meet. A surface of a body has the curvature of its nodes' mean normals. Points that do
    /// not slide have no directions to turn.
    pub fn turnings(&self, mesh: &Mesh, counterpart: &Counterpart) -> Vec<Turning> {
        if let Counterpart::Edge(_) = counterpart {
            return ContactInterface::of(mesh).turnings();
        }
        let counter = counterpart.surface().map(|place| &mesh.boundaries[place]);
        let normals = counter.map_or_else(BTreeMap::new, |own| mesh.nodal_normals(&own.faces));
        let turnings = self.sites.iter().zip(&self.points).map(|(site, point)| {
            if point.speed == 0.0 {
                return Turning::default();
            }
            let [n, t] = [site.normal, site.direction].map(Vector3::from);
            let directions = [t, n.cross(&t)];
            // Displacements of the counterface along a direction, by arc.
            let slope = |direction: Vector3<f64>, arc: Vector3<f64>| -> Row {
                let shares = site.slopes.iter().map(|(node, slope)| (*node, slope.dot(&arc)));
                row_along(mesh, &shares.collect::<Vec<_>>(), direction.into(), 1.0)
            };
            let turn = |a: Vector3<f64>, b: Vector3<f64>| match counterpart.rigid() {
                Some(rigid) => rigid.curvature(site.position, n, [a, b]),
                None => {
                    let slopes = site.slopes.iter();
                    slopes.map(|(node, g)| g.dot(&b) * Vector3::from(normals[node]).dot(&a)).sum()
                }
            };
            let [along, across] = [0, 1].map(|a| turn(directions[a], directions[a]));
            let mixed =
                0.5 * (turn(directions[0], directions[1]) + turn(directions[1], directions[0]));
            let veer = directions[1].cross(&self.spin) / point.speed;
            Turning {
                tilt: directions.map(|arc| slope(n, arc)),
                stretch: directions.map(|arc| slope(t, arc)),
                veer: row_along(mesh, &site.shares, veer.into(), 1.0),
                curvature: [[along, mixed], [mixed, across]],
            }
        });
        turnings.collect()
    }
}
