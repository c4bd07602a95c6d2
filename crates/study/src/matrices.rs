//! The matrices that the eigenvalue analysis of a case solves, over the friction coefficient, and the eigenvalues of
//! those of a superelement that stands free.

use super::eigenvalues::{BasePoint, Solver};
use crate::*;
use frictionsim_case::FreeSystem;
use frictionsim_physics::linalg::{MarketMatrix, MatrixPolynomial};
use frictionsim_physics::{cea::quadratic_modes, contact::Row};
use frictionsim_results::matrices::{
    ExportedContactPoint, ExportedMatrix, ExportedSystem, ExportedUnknown, FreeSpectrum,
    FreeSpectrumSummary, FrictionPower, MatrixRole,
};

/// Mass, damping, stiffness and contact rows of a case's body around steady sliding, by power of the distance from the
/// case's own friction coefficient, or from another one in its place: of a body of revolution those of its whole mesh.
/// The base states are those of the eigenvalue analysis.
///
/// # Errors
/// A case without `[cea]`; no steady sliding.
pub fn matrices(case: &Case, friction: Option<f64>) -> Result<ExportedSystem, StudyError> {
    let cea = case.require_cea()?;
    let frictions = cea.solved_friction_coefficients();
    let mut case = case.on_whole_mesh()?.into_owned();
    if let Some(friction) = friction {
        case.contact.sliding.friction_coefficient = friction;
    }
    let case = &case;
    if let Some(table) = case.body.tables().next() {
        return Err(refusal!(case, &table.key,
            "{}: the files hold one problem, and a modulus over frequency is another one at each frequency", table.key;
            "not written"; "give the material one modulus and a loss factor")
        .into());
    }
    // The whole mesh, whatever the case's own method; what no method solves is refused.
    Solver::of(case, CeaMethod::Auto)?;
    let body = WholeMesh::solve(case, tangent_options(case, cea.mass), &frictions)?;
    let tangent = &body.own_tangent(case)?;
    let friction = case.contact.sliding.friction_coefficient;
    let [smallest, largest] = order::range(frictions.iter().copied().chain([friction]));
    // The polynomials are those of one set of pressed points, which changes at `changes`.
    let changes = || body.range.changes.iter().copied();
    let below = changes().filter(|change| *change <= friction);
    let above = changes().filter(|change| *change > friction);
    let mut system = ExportedSystem {
        dimension: body.mesh.dimension,
        friction_coefficient: friction,
        friction_range: [below.fold(smallest, f64::max), above.fold(largest, f64::min)],
        proportional_damping: tangent
            .proportional
            .map(|rayleigh| [rayleigh.mass_coefficient, rayleigh.stiffness_coefficient]),
        matrices: Vec::new(),
        unknowns: unknowns(&body.mesh, tangent),
        contact: Vec::new(),
        is_at_one_friction: false,
    };
    let matrices = &mut system.matrices;
    let parts: [Part; 4] = [
        ("M", Some(&tangent.mass), MatrixRole::Mass),
        ("C", Some(&tangent.damping), MatrixRole::Damping),
        ("K", Some(&tangent.stiffness), MatrixRole::Stiffness),
        ("H", tangent.structural(), MatrixRole::Structural),
    ];
    for (name, polynomial, role) in parts {
        matrices.extend(polynomial.into_iter().flat_map(|own| powers(name, own, friction, role)));
    }
    contact_rows(&body, (case, tangent), &mut system);
    Ok(system)
}

/// Name, matrix by powers of friction, and what the matrix of a power is.
type Part<'a> = (&'static str, Option<&'a MatrixPolynomial>, fn(FrictionPower) -> MatrixRole);

/// The coefficients of a polynomial about a friction coefficient that are not zero, and always its value there.
fn powers<'a>(
    name: &'a str,
    polynomial: &'a MatrixPolynomial,
    friction: f64,
    role: fn(FrictionPower) -> MatrixRole,
) -> impl Iterator<Item = ExportedMatrix> + 'a {
    let (size, pattern) = (polynomial.dimension(), polynomial.pattern());
    polynomial.about(friction).into_iter().enumerate().filter_map(move |(power, values)| {
        let entries = (0..size).flat_map(|column| {
            let (nonzeros, values) = (pattern.column(column), &values);
            nonzeros.map(move |(position, row)| (row, column, values[position]))
        });
        let matrix = MarketMatrix {
            rows: size,
            columns: size,
            entries: entries.filter(|entry| entry.2 != 0.0).collect(),
        };
        (power == 0 || !matrix.entries.is_empty()).then(|| ExportedMatrix {
            name: if power == 0 { name.to_owned() } else { format!("{name}_mu{power}") },
            role: role(FrictionPower { friction_power: power }),
            matrix,
        })
    })
}

/// Node, direction and place of every unknown.
fn unknowns(mesh: &Mesh, tangent: &SlidingTangent) -> Vec<ExportedUnknown> {
    let distances: BTreeSet<usize> = tangent.distances.iter().map(|own| own.0).collect();
    let unknown = |(unknown, &dof): (usize, &usize)| {
        let (node, axis) = (dof / mesh.dimension, dof % mesh.dimension);
        let direction: [f64; 3] = mesh.frame(node).column(axis).into_owned().into();
        let ([direction_x, direction_y, direction_z], [x_m, y_m, z_m]) =
            (direction, mesh.nodes[node]);
        ExportedUnknown {
            unknown,
            node: mesh.node_label(node),
            kind: if distances.contains(&dof) { "distance" } else { "displacement" },
            direction_x,
            direction_y,
            direction_z,
            x_m,
            y_m,
            z_m,
        }
    };
    tangent.unknowns.dofs.iter().enumerate().map(unknown).collect()
}

/// The contact points and their motion along the normal and along the sliding. In rigid contact the normal motion of a
/// pressed point is no unknown: its row is empty.
fn contact_rows(
    body: &WholeMesh,
    (case, tangent): (&Case, &SlidingTangent),
    system: &mut ExportedSystem,
) {
    let distances = tangent.distances.iter();
    let combined: BTreeMap<usize, &Row> = distances.map(|(dof, row)| (*dof, row)).collect();
    // A row over all dofs as one over the unknowns, without what cancels.
    let over_unknowns = |row: &Row| -> Row {
        let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
        let mut largest = 0.0_f64;
        for &(dof, value) in row {
            let own = [(dof, 1.0)];
            let parts = combined.get(&dof).map_or(&own[..], |row| row.as_slice());
            for &(part, share) in parts {
                largest = largest.max((value * share).abs());
                if let Some(unknown) = tangent.unknowns.unknown_of[part] {
                    *sum.entry(unknown).or_default() += value * share;
                }
            }
        }
        sum.into_iter().filter(|entry| entry.1.abs() > 1e-14 * largest).collect()
    };
    let (mut normal, mut slip) = (Vec::new(), Vec::new());
    let points = body.contact_points(case);
    let forces = body.state().normal_forces(case.contact.sliding.friction_coefficient);
    for (i, own) in points.iter().enumerate() {
        let rows = [(&own.point.normal, &mut normal), (&own.point.slip, &mut slip)];
        for (row, entries) in rows {
            let row = over_unknowns(row).into_iter();
            entries.extend(row.map(|(unknown, share)| (i, unknown, share)));
        }
        system.contact.push(exported(body, (i, own), &forces));
    }
    for (name, role, entries) in [
        ("contact_normal", MatrixRole::ContactNormal, normal),
        ("contact_slip", MatrixRole::ContactSlip, slip),
    ] {
        system.matrices.push(ExportedMatrix {
            name: name.to_owned(),
            role,
            matrix: MarketMatrix { rows: points.len(), columns: system.unknowns.len(), entries },
        });
    }
}

/// A contact point: of a plane edge with its node, of solid bodies with its contact.
fn exported(
    body: &WholeMesh,
    (i, own): (usize, &BasePoint<'_>),
    forces: &[f64],
) -> ExportedContactPoint {
    let is_node = body.mesh.dimension == 2;
    let node = own.place.shares.first().filter(|_| is_node);
    ExportedContactPoint {
        node: node.map(|(node, _)| body.mesh.node_label(*node as usize)),
        contact: (!is_node).then(|| own.place.contact.clone()),
        place: own.place.position,
        is_pressed: body.state().is_pressed[i],
        weight: own.point.weight,
        normal_force: forces.get(i).copied().unwrap_or(0.0),
    }
}

/// The oscillating modes that a case asks for, out of all eigenvalues of its matrices.
///
/// # Errors
/// Matrices that are singular together.
pub fn free_spectrum(system: &FreeSystem) -> Result<FreeSpectrum, StudyError> {
    let own = &system.superelement;
    let [mass, damping, stiffness] = [&own.mass, &own.damping, &own.stiffness].map(dense);
    let all = quadratic_modes(mass.as_ref(), damping.as_ref(), stiffness.as_ref())?;
    let total = all.len();
    let oscillating = all.into_iter().filter(|mode| mode.eigenvalue.im > 0.0);
    let mut modes = sorted(oscillating, |mode| mode.eigenvalue.im);
    let overdamped = total - modes.len();
    modes.truncate(system.modes.selected(modes.iter().map(|mode| mode.eigenvalue.im)));
    let summary = FreeSpectrumSummary {
        superelement: own.name.clone(),
        dofs: own.mass.rows,
        method: "dense".to_owned(),
        modes: modes.len(),
        unstable: modes.iter().filter(|mode| mode.is_unstable()).count(),
        overdamped,
        max_residual: modes.iter().map(|mode| mode.residual).fold(0.0, f64::max),
    };
    Ok(FreeSpectrum { title: system.title.clone(), modes, summary })
}

fn dense(matrix: &MarketMatrix) -> Mat<f64> {
    let mut dense = Mat::zeros(matrix.rows, matrix.columns);
    for &(row, column, value) in &matrix.entries {
        dense[(row, column)] += value;
    }
    dense
}
