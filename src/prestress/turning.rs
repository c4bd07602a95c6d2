//! Contact forces of steady sliding that turn with the edge.

use crate::contact::{ContactInterface, OppositeShare};

/// What a unit normal force at contact node `i` and a unit friction force add to the stiffness as they turn with the edge.
///
/// The normal is that of the surface that the node meets, `theta` its turn there; with `w` and `xi` the separation and the
/// slip of the node, `eta` and `epsilon` the slopes of the opposite body along normal and tangent, `kappa` the curvature,
///
/// ```text
/// theta = kappa xi - eta,   N: -kappa xi xi + xi eta + eta xi,   T: w theta + epsilon xi
/// ```
///
/// as products of a row and a column. On a rigid counterface `xi = u_t`, and both slopes vanish.
pub(super) fn turning_of(interface: &ContactInterface, i: usize) -> [Vec<(usize, usize, f64)>; 2] {
    let curvature = interface.counterface.curvature();
    let slope = |of: fn(&OppositeShare) -> f64| -> Vec<(usize, f64)> {
        let shares = interface.opposite_of(i).iter();
        let all = shares.map(|share| (share.dof, of(share)));
        all.filter(|(_, value)| *value != 0.0).collect()
    };
    let slip: Vec<(usize, f64)> = interface.slip(i).collect();
    let eta = slope(|share| share.normal_slope);
    let epsilon = slope(|share| share.tangential_slope);
    let product = |rows: &[(usize, f64)], columns: &[(usize, f64)], factor: f64| {
        let pairs = rows
            .iter()
            .flat_map(|row| columns.iter().map(move |column| (row, column)));
        let entries = pairs.map(|(row, column)| (row.0, column.0, factor * row.1 * column.1));
        entries.collect::<Vec<_>>()
    };
    let separation: Vec<(usize, f64)> = interface.separation(i).collect();
    let pressed = [
        product(&slip, &slip, -curvature),
        product(&slip, &eta, 1.0),
        product(&eta, &slip, 1.0),
    ];
    let sheared = [
        product(&separation, &slip, curvature),
        product(&separation, &eta, -1.0),
        product(&epsilon, &slip, 1.0),
    ];
    [pressed.concat(), sheared.concat()]
}
